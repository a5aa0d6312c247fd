//! Why a key changes nothing of a scene.

use super::{keys::Action, viewer::Viewer};

/// Settings that are of splats alone.
const OF_SPLATS: [&str; 5] = ["rasterizer", "filter", "filter-weight", "kernel", "outlines"];

/// What of a scene there is to change.
#[derive(Clone, Copy, Debug)]
struct Holds {
    splats: bool,
    transparent: bool,
}

/// Why an action changes nothing of a scene, if so.
fn why(action: Action, holds: Holds) -> Option<String> {
    match action {
        Action::SplatScale(_) if !holds.splats => Some("no size changes: no splat is seen".to_owned()),
        Action::Setting(name, _) if OF_SPLATS.contains(&name) && !holds.splats => {
            Some(format!("{name} is of splats, of which none is seen"))
        }
        Action::Layers(_) if !holds.transparent => {
            Some("layers are of what is transparent, and nothing that is seen is".to_owned())
        }
        _ => None,
    }
}

impl Viewer {
    /// Tells why an action changes nothing of the scene that is on the device; whether that is so.
    pub fn tells_why_not(&mut self, action: Action) -> bool {
        let Some(prepared) = &self.prepared else { return false };
        let scene = prepared.scene();
        let transparent = scene.is_transparent();
        let (splats, pages) = (!scene.chunks().is_empty(), prepared.pages().is_some());
        // Of pages none may be there yet.
        let holds = Holds { splats: splats || pages, transparent };
        let why = why(action, holds);
        if let Some(why) = &why {
            self.ui.tell(why);
        }
        why.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::keys::Step;

    #[test]
    fn what_a_scene_lacks_is_why_nothing_changes() {
        let all = Holds { splats: true, transparent: true };
        let outlines = Action::Setting("outlines", Step::Next);
        let shading = Action::Setting("shading", Step::Next);
        for action in [Action::SplatScale(2.0), Action::Layers(1), outlines, shading, Action::Fit] {
            assert_eq!(why(action, all), None);
        }
        let polygons = Holds { splats: false, transparent: false };
        let told = [Action::SplatScale(2.0), Action::Layers(1), outlines]
            .map(|action| why(action, polygons).unwrap());
        assert!(
            told[0].contains("no splat")
                && told[1].contains("transparent")
                && told[2].starts_with("outlines")
        );
        assert_eq!(why(shading, polygons), None);
    }
}
