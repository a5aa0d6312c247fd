//! Which sets a pass has bound last: one scene may stand in many places, and its sets need not be bound for each.

use std::cell::Cell;

use ash::vk;

use super::key::Layout;

/// Two sets of a layout, and the number of the first.
type Two = (Layout, u32, [vk::DescriptorSet; 2]);

/// The two sets that were bound last, if they were two.
#[derive(Default)]
pub(crate) struct LastSets(Cell<Option<Two>>);

impl LastSets {
    /// Whether these are still bound; from now on they are. Whatever else is bound meanwhile, of another layout or in other numbers, may have disturbed them.
    pub fn have(&self, layout: Layout, first: u32, sets: &[vk::DescriptorSet]) -> bool {
        let two = <[vk::DescriptorSet; 2]>::try_from(sets).ok().map(|two| (layout, first, two));
        self.0.replace(two) == two && two.is_some()
    }
}

#[cfg(test)]
mod tests {
    use ash::vk::Handle;

    use super::*;

    #[test]
    fn sets_are_bound_anew_after_any_other_layout_number_or_set() {
        let set = vk::DescriptorSet::from_raw;
        let (one, two, three) = (set(1), set(2), set(3));
        let own = [one, two];
        let others: [(Layout, u32, &[vk::DescriptorSet]); 7] = [
            (Layout::List, 0, &own),
            (Layout::Record, 1, &own),
            (Layout::Record, 0, &[one, three]),
            (Layout::Record, 0, &[three, two]),
            (Layout::Record, 0, &[two, one]),
            (Layout::Record, 0, &[three]),
            (Layout::Record, 2, &[three]),
        ];
        for (layout, first, other) in others {
            let last = LastSets::default();
            assert!(!last.have(Layout::Record, 0, &own), "nothing is bound at first");
            assert!(last.have(Layout::Record, 0, &own) && last.have(Layout::Record, 0, &own));
            assert!(!last.have(layout, first, other), "{layout:?} {first} {other:?}");
            assert_eq!(last.have(layout, first, other), other.len() == 2);
            assert!(!last.have(Layout::Record, 0, &own), "after {layout:?} {first} {other:?}");
        }
    }
}
