//! The formulas of the GPU path, for tests that falsify them one by one; see `glsl/inc/perturb.glsl`.

/// A formula that a test build can make wrong by 1%. The numbers are those of the shaders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
#[allow(missing_docs, reason = "each is named after what it is in glsl/inc")]
pub enum Formula {
    InverseMappingU = 1,
    InverseMappingV,
    InverseMappingW,
    ExpansionPoint,
    CenterConstants,
    BoxCenter,
    BoxHalfSize,
    NearBox,
    EpsilonShift,
    FilterRadius,
    FilterRotation,
    Kernel,
    TangentFrame,
    Normal,
    Color,
    DepthSum,
    ViewTransform,
    ElsewhereConstants,
    Coverage,
    NearCut,
    KernelPower,
    PointCenter,
    PointSize,
    QuadCorner,
    NormalizedColor,
    NormalizedDepth,
    EyeDirection,
    Diffuse,
    Specular,
}

impl Formula {
    /// All of them.
    pub const ALL: [Self; 29] = [
        Self::InverseMappingU,
        Self::InverseMappingV,
        Self::InverseMappingW,
        Self::ExpansionPoint,
        Self::CenterConstants,
        Self::BoxCenter,
        Self::BoxHalfSize,
        Self::NearBox,
        Self::EpsilonShift,
        Self::FilterRadius,
        Self::FilterRotation,
        Self::Kernel,
        Self::TangentFrame,
        Self::Normal,
        Self::Color,
        Self::DepthSum,
        Self::ViewTransform,
        Self::ElsewhereConstants,
        Self::Coverage,
        Self::NearCut,
        Self::KernelPower,
        Self::PointCenter,
        Self::PointSize,
        Self::QuadCorner,
        Self::NormalizedColor,
        Self::NormalizedDepth,
        Self::EyeDirection,
        Self::Diffuse,
        Self::Specular,
    ];
}
