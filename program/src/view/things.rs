//! Things of a scene by key: one is meant, which is hidden and shown, and made more and less transparent.

use super::{keys::OnThing, viewer::Viewer};

/// By keys nothing is more transparent: what is hidden has a key of its own.
const LEAST_ALPHA: f32 = 0.1;

impl Viewer {
    /// Does what a key is for with the thing that is meant, or means the next one; says which it is, and how it is seen.
    pub fn on_thing(&mut self, what: OnThing) {
        let Some(document) = &self.document else { return };
        let names = document.things();
        let mut edits = self.edits.clone();
        let count = edits.things.len();
        if count == 0 {
            return;
        }
        if what == OnThing::Next {
            self.thing = (self.thing + 1) % count;
        }
        let (seen, alpha) = &mut edits.things[self.thing];
        match what {
            OnThing::Next => {}
            OnThing::Hide => *seen = !*seen,
            OnThing::Alpha(by) => *alpha = stepped(*alpha, by),
        }
        let how = if *seen { format!("{:.0}% of its alpha", 100.0 * *alpha) } else { "hidden".to_owned() };
        self.ui.tell(&format!("{} ({} of {count}): {how}", names[self.thing].0, self.thing + 1));
        if edits != self.edits {
            self.edit(edits);
        }
    }
}

/// The next tenth.
fn stepped(alpha: f32, by: f32) -> f32 {
    (((alpha + by) * 10.0).round() / 10.0).clamp(LEAST_ALPHA, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_steps_and_back_are_none() {
        let down = (0..12).fold(1.0, |alpha, _| stepped(alpha, -0.1));
        assert_eq!(down, LEAST_ALPHA);
        assert_eq!((0..9).fold(down, |alpha, _| stepped(alpha, 0.1)), 1.0);
        assert_eq!(stepped(0.05, 0.1), 0.2);
    }
}
