//! Which methods are compared, and how they are named.

use serde::Serialize;

use crate::scene::{Accumulate, Filter, FilterWeight, KernelEval, Rasterizer, Settings};

/// One way to draw: what the papers vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Method {
    /// How a splat becomes fragments.
    pub rasterizer: Rasterizer,
    /// The screen-space low-pass filter.
    pub filter: Filter,
    /// What a splat weighs that the filter has enlarged.
    pub filter_weight: FilterWeight,
    /// The precision of the sums.
    pub accumulate: Accumulate,
    /// How the kernel is evaluated.
    pub kernel_eval: KernelEval,
}

/// A method by the names of its options, as reports write it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct MethodNames {
    /// `--rasterizer`.
    pub rasterizer: &'static str,
    /// `--filter`.
    pub filter: &'static str,
    /// `--filter-weight`.
    pub filter_weight: &'static str,
    /// `--accumulate`.
    pub accumulate: &'static str,
    /// `--kernel-eval`.
    pub kernel_eval: &'static str,
}

/// What decides the exact picture of a method: methods of one key share their reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PictureKey {
    /// One of the rasterizers that draw this picture.
    pub rasterizer: Rasterizer,
    /// The filter.
    pub filter: Filter,
    /// Its weight.
    pub filter_weight: FilterWeight,
}

impl Method {
    /// These settings, drawn with this method.
    pub fn settings(&self, base: &Settings) -> Settings {
        Settings {
            rasterizer: self.rasterizer,
            filter: self.filter,
            filter_weight: self.filter_weight,
            accumulate: self.accumulate,
            kernel_eval: self.kernel_eval,
            ..base.clone()
        }
    }

    /// What its exact picture depends on: not on how sums and kernels are rounded, nor on which of the rasterizers
    /// that are exact draws it.
    pub fn picture_key(&self) -> PictureKey {
        let rasterizer = self.rasterizer.family();
        PictureKey { rasterizer, filter: self.filter, filter_weight: self.filter_weight }
    }

    /// The names of its options.
    pub fn names(&self) -> MethodNames {
        MethodNames {
            rasterizer: self.rasterizer.name(),
            filter: self.filter.name(),
            filter_weight: self.filter_weight.name(),
            accumulate: self.accumulate.name(),
            kernel_eval: self.kernel_eval.name(),
        }
    }
}

impl MethodNames {
    /// The filter with its weight, where that is not the default: `adjust`, `adjust unit`.
    pub fn filter_and_weight(&self) -> String {
        match self.filter_weight {
            weight if weight == FilterWeight::default().name() => self.filter.to_owned(),
            weight => format!("{} {weight}", self.filter),
        }
    }

    /// All in one line, such as `perspective, adjust, f16, analytic`.
    pub fn line(&self) -> String {
        let filter = self.filter_and_weight();
        format!("{}, {filter}, {}, {}", self.rasterizer, self.accumulate, self.kernel_eval)
    }
}

/// The values that are compared, of each option.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Of `--rasterizer`.
    pub rasterizers: Vec<Rasterizer>,
    /// Of `--filter`.
    pub filters: Vec<Filter>,
    /// Of `--filter-weight`.
    pub filter_weights: Vec<FilterWeight>,
    /// Of `--accumulate`.
    pub accumulates: Vec<Accumulate>,
    /// Of `--kernel-eval`.
    pub kernel_evals: Vec<KernelEval>,
}

impl Selection {
    /// Every combination, whether it exists or not, each once.
    pub fn product(&self) -> Vec<Method> {
        let mut methods = Vec::new();
        for &rasterizer in &self.rasterizers {
            for &filter in &self.filters {
                // Only tangent adjustment leaves a splat a weight to choose.
                let default = [FilterWeight::default()];
                let filter_weights: &[_] = if filter.adjusts() { &self.filter_weights } else { &default };
                for &filter_weight in filter_weights {
                    for &accumulate in &self.accumulates {
                        for &kernel_eval in &self.kernel_evals {
                            methods.push(Method {
                                rasterizer,
                                filter,
                                filter_weight,
                                accumulate,
                                kernel_eval,
                            });
                        }
                    }
                }
            }
        }
        methods.dedup();
        methods
    }

    /// The combination of all first values, and those that differ from it in one option: what each option changes by
    /// itself.
    pub fn one_at_a_time(&self) -> Vec<Method> {
        let all = self.product();
        let Some(&first) = all.first() else { return all };
        let differences = |method: &Method| {
            [
                method.rasterizer != first.rasterizer,
                method.filter != first.filter,
                method.filter_weight != first.filter_weight,
                method.accumulate != first.accumulate,
                method.kernel_eval != first.kernel_eval,
            ]
            .into_iter()
            .filter(|differs| *differs)
            .count()
        };
        all.into_iter().filter(|method| differences(method) <= 1).collect()
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
            accumulates: values(Accumulate::NAMES),
            kernel_evals: values(KernelEval::NAMES),
        }
    }

    #[test]
    fn every_combination_comes_once_the_default_first() {
        let methods = all().product();
        assert_eq!(methods.len(), 9 * 5 * 2 * 2);
        let different: std::collections::HashSet<_> = methods.iter().collect();
        assert_eq!(different.len(), methods.len());
        let first = Settings { rasterizer: Rasterizer::Perspective, ..Settings::default() };
        assert_eq!(methods[0].settings(&Settings::default()), first);
    }

    #[test]
    fn one_at_a_time_is_the_default_and_a_method_for_each_other_value() {
        let methods = all().one_at_a_time();
        assert_eq!(methods.len(), 1 + 8 + 4 + 1 + 1);
        assert_eq!(methods[0].names().line(), "perspective, adjust, f16, analytic");
        assert!(methods.iter().any(|method| method.names().line() == "quad, adjust, f16, analytic"));
        assert!(!methods.iter().any(|method| method.names().line() == "quad, none, f16, analytic"));
    }

    #[test]
    fn exact_rasterizers_share_a_picture_and_the_others_have_their_own() {
        let keys: std::collections::HashSet<_> = all().product().iter().map(Method::picture_key).collect();
        // The exact one, the chopped one, two affine ones; with five filters each.
        assert_eq!(keys.len(), 4 * 5);
    }

    #[test]
    fn every_part_of_a_method_reaches_the_settings_and_the_line() {
        let method = Method {
            rasterizer: Rasterizer::Raycast,
            filter: Filter::AdjustPaper,
            filter_weight: FilterWeight::Unit,
            accumulate: Accumulate::F32,
            kernel_eval: KernelEval::Texture,
        };
        assert_eq!(method.names().line(), "raycast, adjust-paper unit, f32, texture");
        let settings = method.settings(&Settings::default());
        let options = settings.as_options();
        let names = method.names();
        let expected = [
            ("rasterizer", names.rasterizer),
            ("filter", names.filter),
            ("filter-weight", names.filter_weight),
            ("accumulate", names.accumulate),
            ("kernel-eval", names.kernel_eval),
        ];
        for (option, name) in expected {
            assert_eq!(options[option], name, "{option}");
        }
    }
}
