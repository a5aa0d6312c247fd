//! The values of settings that keys and the panel step through.

use surfel::{
    Result,
    scene::{OptionTable as _, Setting, Settings},
};

use super::keys::Step;

/// Settings in the panel, in its order, by the names of their options.
pub const IN_PANEL: &[&str] = &[
    "rasterizer",
    "filter",
    "filter-weight",
    "kernel",
    "epsilon",
    "edges",
    "backfaces",
    "last-layer",
    "shading",
    "outlines",
    "accumulate",
    "cull",
];

/// Values of settings that have no list of their own.
const LISTED: &[(&str, &[&str])] = &[
    ("kernel", &["gaussian:0.5", "gaussian:0.35", "gaussian:0.7", "psi_e:6,1.5,3"]),
    ("epsilon", &["auto", "0.5r", "1r", "2r", "4r"]),
];

/// A setting by its option's name.
pub fn setting(name: &str) -> Option<&'static Setting<Settings>> {
    Settings::OPTIONS.iter().find(|setting| setting.name == name)
}

/// The values that can be chosen.
pub fn values(setting: &Setting<Settings>) -> Vec<&'static str> {
    let listed = LISTED.iter().find(|(name, _)| *name == setting.name);
    listed.map_or_else(|| setting.choices.iter().map(|choice| choice.name).collect(), |(_, all)| all.to_vec())
}

/// Settings with another value.
pub fn with(settings: &Settings, setting: &Setting<Settings>, word: &str) -> Option<Settings> {
    let mut changed = settings.clone();
    (setting.set)(&mut changed, word).ok()?;
    Some(changed)
}

/// Settings with the next value that is accepted, or the one before; `None` where there is no other.
pub fn stepped(
    settings: &Settings,
    name: &str,
    step: Step,
    accept: impl Fn(&Settings) -> Result<()>,
) -> Option<Settings> {
    let setting = setting(name)?;
    let values = values(setting);
    let now = values.iter().position(|value| *value == (setting.get)(settings));
    let count = values.len();
    let order = (1..=count).map(|by| match (now, step) {
        (Some(now), Step::Next) => (now + by) % count,
        (Some(now), Step::Before) => (now + count - by) % count,
        (None, Step::Next) => by - 1,
        (None, Step::Before) => count - by,
    });
    let changed = order.filter_map(|index| with(settings, setting, values[index]));
    changed.filter(|changed| changed != settings).find(|changed| accept(changed).is_ok())
}

#[cfg(test)]
mod tests {
    use surfel::scene::{Epsilon, Filter};

    use super::*;

    #[test]
    fn every_setting_of_the_panel_steps_through_all_its_values_and_back() {
        for name in IN_PANEL {
            let of = setting(name).unwrap();
            let start = with(&Settings::default(), of, values(of)[0]).unwrap();
            let mut settings = start.clone();
            for _ in values(of) {
                settings = stepped(&settings, name, Step::Next, |_| Ok(())).unwrap();
            }
            assert_eq!(settings, start, "{name}");
            let next = stepped(&settings, name, Step::Next, |_| Ok(())).unwrap();
            assert_eq!(stepped(&next, name, Step::Before, |_| Ok(())).unwrap(), start, "{name}");
        }
    }

    #[test]
    fn what_is_refused_is_stepped_over() {
        let settings = Settings::default();
        let all: Vec<_> = values(setting("filter").unwrap());
        let without_none = |changed: &Settings| match changed.filter {
            Filter::None => Err(surfel::Error::option("--filter", "none")),
            _ => Ok(()),
        };
        let next = stepped(&settings, "filter", Step::Next, without_none).unwrap();
        assert!(all.contains(&"none") && next.filter != Filter::None && next.filter != settings.filter);
        let odd = Settings { epsilon: Epsilon::Length(0.123), ..settings };
        assert_eq!(stepped(&odd, "epsilon", Step::Next, |_| Ok(())).unwrap().epsilon, Epsilon::Auto);
    }
}
