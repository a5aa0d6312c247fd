//! What settings ask of levels of detail, by a size and by a budget.

use super::{Budget, Lod, LodSteps, Settings};

impl Settings {
    /// Whether a scene has to have levels of detail for it.
    pub fn wants_levels(&self) -> bool {
        self.lod.wants_levels() || self.budget != Budget::Unlimited
    }

    /// The size up to which splats are drawn as one where they have levels of detail, in pixels; 0 draws all of them. A budget alone may
    /// be spent on all.
    pub fn tau_px(&self) -> f64 {
        match (self.lod, self.budget) {
            (Lod::Auto, Budget::Splats(_)) => 0.0,
            (lod, _) => lod.tau_px(self.size_px),
        }
    }

    /// The size over [`Self::tau_px`] up to which nodes are drawn, beside those below them: 1 unless they blend. Opaque ones do, by tiles.
    pub fn blended_size(&self) -> f64 {
        let blends = self.lod_steps == LodSteps::Blend && self.covers_in_part() && self.weighs_splats();
        if blends { LodSteps::BLENDED } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_the_default_of_what_has_levels_and_a_budget_asks_for_them_by_itself() {
        let default = Settings::default();
        assert!((default.tau_px(), default.wants_levels()) == (1.0, false));
        let scene_itself = Settings { lod: Lod::Px(0.0), ..default.clone() };
        assert!((scene_itself.tau_px(), scene_itself.wants_levels()) == (0.0, false));
        let budget = Budget::Splats(9);
        let within = Settings { budget, ..default };
        assert!((within.tau_px(), within.wants_levels()) == (0.0, true));
        assert_eq!(Settings { lod: Lod::Px(2.0), ..within }.tau_px(), 2.0);
    }
}
