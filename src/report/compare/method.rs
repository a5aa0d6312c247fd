//! Which methods are compared, and how they are named.

use std::{collections::HashSet, fmt};

use serde::Serialize;

use crate::scene::{Accumulate, Filter, FilterWeight, KernelEval, Rasterizer, Settings, with_each};

/// One way to draw: what the papers vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Method {
    /// How a splat becomes fragments.
    pub rasterizer: Rasterizer,
    /// The screen-space low-pass filter, and what a splat weighs that it has enlarged.
    #[serde(flatten)]
    pub filter: WeightedFilter,
    /// The precision of the sums.
    pub accumulate: Accumulate,
    /// How the kernel is evaluated.
    pub kernel_eval: KernelEval,
}

/// A filter and its weight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
pub struct WeightedFilter {
    /// The screen-space low-pass filter.
    pub filter: Filter,
    /// The weight of a splat that the filter has enlarged.
    pub filter_weight: FilterWeight,
}

impl Method {
    /// The options that tell one method from another.
    pub const OPTIONS: [&str; 5] = ["rasterizer", "filter", "filter-weight", "accumulate", "kernel-eval"];

    /// These settings, drawn with this method.
    pub fn settings(&self, base: &Settings) -> Settings {
        Settings {
            rasterizer: self.rasterizer,
            filter: self.filter.filter,
            filter_weight: self.filter.filter_weight,
            accumulate: self.accumulate,
            kernel_eval: self.kernel_eval,
            ..base.clone()
        }
    }

    /// The method whose exact picture is also its own: it does not depend on how sums and kernels are rounded, nor on which of
    /// the rasterizers that are exact draws it. What 16-bit sums ask of weights is an error of theirs.
    pub fn exact(&self) -> Self {
        let (accumulate, kernel_eval) = (Accumulate::F32, KernelEval::default());
        Self { rasterizer: self.rasterizer.family(), filter: self.filter, accumulate, kernel_eval }
    }

    /// The method of these settings.
    fn of(settings: &Settings) -> Self {
        let Settings { rasterizer, filter, filter_weight, accumulate, kernel_eval, .. } = *settings;
        Self { rasterizer, filter: WeightedFilter { filter, filter_weight }, accumulate, kernel_eval }
    }
}

/// In a line, such as `perspective, adjust, f16, analytic`.
impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rasterizer, filter, accumulate, kernel_eval } = self;
        write!(f, "{}, {filter}, {}, {}", rasterizer.name(), accumulate.name(), kernel_eval.name())
    }
}

/// The filter, with its weight where that is not the default: `adjust`, `adjust unit`.
impl fmt::Display for WeightedFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.filter.name())?;
        match self.filter_weight == FilterWeight::default() {
            true => Ok(()),
            false => write!(f, " {}", self.filter_weight.name()),
        }
    }
}

/// The values that are compared, of each option.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Values of `--rasterizer`.
    pub rasterizers: Vec<Rasterizer>,
    /// Values of `--filter`.
    pub filters: Vec<Filter>,
    /// Values of `--filter-weight`.
    pub filter_weights: Vec<FilterWeight>,
    /// Values of `--accumulate`.
    pub accumulates: Vec<Accumulate>,
    /// Values of `--kernel-eval`.
    pub kernel_evals: Vec<KernelEval>,
}

impl Selection {
    /// Every combination, whether it exists or not, each once.
    pub fn product(&self) -> Vec<Method> {
        let all = vec![Settings::default()];
        let all = with_each(all, &self.rasterizers, |settings, value| settings.rasterizer = value);
        let all = with_each(all, &self.filters, |settings, value| settings.filter = value);
        let all = with_each(all, &self.filter_weights, |settings, value| {
            // Only tangent adjustment leaves a splat a weight to choose.
            settings.filter_weight = if settings.filter.adjusts() { value } else { FilterWeight::default() };
        });
        let all = with_each(all, &self.accumulates, |settings, value| settings.accumulate = value);
        let all = with_each(all, &self.kernel_evals, |settings, value| settings.kernel_eval = value);
        let mut seen = HashSet::new();
        all.iter().map(Method::of).filter(|method| seen.insert(*method)).collect()
    }

    /// The combination of all first values, and those that differ from it in one option: what each option changes by
    /// itself.
    pub fn one_at_a_time(&self) -> Vec<Method> {
        let all = self.product();
        let Some(&first) = all.first() else { return all };
        let differs = |method: &Method| {
            [
                method.rasterizer != first.rasterizer,
                method.filter.filter != first.filter.filter,
                method.filter.filter_weight != first.filter.filter_weight,
                method.accumulate != first.accumulate,
                method.kernel_eval != first.kernel_eval,
            ]
        };
        let one = |method: &Method| differs(method).into_iter().filter(|differs| *differs).count() <= 1;
        all.into_iter().filter(one).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Selection {
        fn values<T: Copy>(names: &[(&str, T)]) -> Vec<T> {
            names.iter().map(|(_, value)| *value).collect()
        }
        Selection {
            rasterizers: values(Rasterizer::METHODS),
            filters: values(Filter::NAMES),
            filter_weights: vec![FilterWeight::default()],
            accumulates: values(Accumulate::PRECISIONS),
            kernel_evals: values(KernelEval::NAMES),
        }
    }

    #[test]
    fn every_combination_comes_once_the_default_first() {
        let methods = all().product();
        assert_eq!(methods.len(), 9 * 5 * 2 * 2);
        let different: std::collections::HashSet<_> = methods.iter().collect();
        assert_eq!(different.len(), methods.len());
        let accumulate = Accumulate::PRECISIONS[0].1;
        let first = Settings { rasterizer: Rasterizer::Perspective, accumulate, ..Settings::default() };
        assert_eq!(methods[0].settings(&Settings::default()), first);
    }

    #[test]
    fn one_at_a_time_is_the_default_and_a_method_for_each_other_value() {
        let methods = all().one_at_a_time();
        assert_eq!(methods.len(), 1 + 8 + 4 + 1 + 1);
        assert_eq!(methods[0].to_string(), "perspective, adjust, f16, analytic");
        assert!(methods.iter().any(|method| method.to_string() == "quad, adjust, f16, analytic"));
        assert!(!methods.iter().any(|method| method.to_string() == "quad, none, f16, analytic"));
    }

    #[test]
    fn exact_rasterizers_share_a_picture_and_the_others_have_their_own() {
        let keys: std::collections::HashSet<_> = all().product().iter().map(Method::exact).collect();
        // The exact one, the chopped one, two affine ones; with five filters each.
        assert_eq!(keys.len(), 4 * 5);
    }

    #[test]
    fn every_part_of_a_method_reaches_the_settings_and_the_line() {
        let method = Method {
            rasterizer: Rasterizer::Raycast,
            filter: WeightedFilter { filter: Filter::AdjustPaper, filter_weight: FilterWeight::Unit },
            accumulate: Accumulate::F32,
            kernel_eval: KernelEval::Texture,
        };
        assert_eq!(method.to_string(), "raycast, adjust-paper unit, f32, texture");
        let settings = method.settings(&Settings::default());
        let options = settings.as_options();
        let json = serde_json::to_value(method).unwrap();
        for option in Method::OPTIONS {
            let name = option.replace('-', "_");
            assert_eq!(json[name], options[option].as_str(), "{option}");
        }
    }
}
