//! The name that was probably meant.

/// The fewest letters that say how a name goes on.
const SHORTEST_BEGINNING: usize = 3;

/// The names that may be meant, in words: the one that is nearest to `given` or goes on from it, or all where none does.
pub(super) fn suggestion<'a>(given: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    let begun = |name: &&str| given.len() >= SHORTEST_BEGINNING && name.starts_with(given);
    let distance = |name: &&str| if begun(name) { 0 } else { strsim::osa_distance(given, name) };
    match known.clone().min_by_key(distance) {
        // Half of the letters may be wrong.
        Some(nearest) if 2 * distance(&nearest) <= nearest.chars().count() => format!("'{nearest}'"),
        _ => {
            let names: Vec<String> = known.map(|name| format!("'{name}'")).collect();
            match names.split_last() {
                Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
                _ => names.concat(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_or_all() {
        let known = ["color", "alpha", "scale"];
        let suggest = |given| suggestion(given, known.into_iter());
        assert_eq!(suggest("colour"), "'color'");
        assert_eq!(suggest("Color"), "'color'");
        assert_eq!(suggest("aplha"), "'alpha'");
        assert_eq!(suggest("sca"), "'scale'");
        assert_eq!(suggest("radius"), "'color', 'alpha' or 'scale'");
        assert_eq!(suggestion("x", ["color"].into_iter()), "'color'");
    }
}
