//! Settings as they are given on the command line, so that a report can be repeated.

use std::collections::BTreeMap;

use crate::scene::{Backfaces, Epsilon, Kernel, Settings, Shading};

/// Every setting by the name of its option, without the dashes.
pub fn settings_as_options(settings: &Settings) -> BTreeMap<&'static str, String> {
    let [width, height] = settings.size_px;
    let backfaces = match settings.backfaces {
        Backfaces::Auto => "auto",
        Backfaces::Flip => "flip",
        Backfaces::Cull => "cull",
    };
    let shading = match settings.shading {
        Shading::Phong => "phong",
        Shading::Lambert => "lambert",
        Shading::Normals => "normals",
        Shading::Albedo => "albedo",
    };
    let background = match settings.background {
        Some([red, green, blue]) => format!("{red},{green},{blue}"),
        None => "none".to_owned(),
    };
    BTreeMap::from([
        ("size", format!("{width}x{height}")),
        ("rasterizer", settings.rasterizer.name().to_owned()),
        ("tile-invocations", settings.tile_invocations.name().to_owned()),
        ("tile-memory", settings.tile_memory.to_string()),
        ("filter", settings.filter.name().to_owned()),
        ("filter-weight", settings.filter_weight.name().to_owned()),
        ("kernel", kernel_option(settings.kernel)),
        ("kernel-eval", settings.kernel_eval.name().to_owned()),
        ("cull", settings.cull.name().to_owned()),
        ("accumulate", settings.accumulate.name().to_owned()),
        ("epsilon", epsilon_option(settings.epsilon)),
        ("backfaces", backfaces.to_owned()),
        ("layers", settings.layers.to_string()),
        ("last-layer", settings.last_layer.name().to_owned()),
        ("transition", settings.transition.name().to_owned()),
        ("shading", shading.to_owned()),
        ("background", background),
    ])
}

/// The value of `--kernel`.
pub fn kernel_option(kernel: Kernel) -> String {
    match kernel {
        Kernel::Gaussian { sigma } => format!("gaussian:{sigma}"),
        Kernel::PsiE { a, b, n } => format!("psi_e:{a},{b},{n}"),
    }
}

/// The value of `--epsilon`.
pub fn epsilon_option(epsilon: Epsilon) -> String {
    match epsilon {
        Epsilon::Radii(radii) => format!("{radii}r"),
        Epsilon::Length(length) => format!("{length}"),
    }
}
