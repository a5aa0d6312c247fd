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
    LowPass,
    LowPassBox,
    Share,
    AffineMap,
    Contour,
    RayDepth,
    RayAxis,
    ApproximateSize,
    TriangleCorner,
    KernelTexture,
    NearestDepth,
    Widened,
    KeptDepth,
    Alpha,
    Peeled,
    TowardViewer,
    Transition,
    PolygonDepth,
    PolygonShift,
    Over,
    LitDiffuse,
    LitSpecular,
    Stacked,
    Lengthened,
    EyeDome,
    EdgeOpacity,
    ClipLine,
    ClipCurve,
    ClipRamp,
    Plane,
    Crease,
    SharpSum,
    Outlined,
    Reach,
    BorderDistance,
    LayerBehind,
    LayerBeside,
}

impl Formula {
    /// Those of transparency, polygons and lights.
    pub const OF_LAYERS: [Self; 11] = [
        Self::Alpha,
        Self::Peeled,
        Self::TowardViewer,
        Self::Transition,
        Self::PolygonDepth,
        Self::PolygonShift,
        Self::Over,
        Self::LitDiffuse,
        Self::LitSpecular,
        Self::Stacked,
        Self::Lengthened,
    ];

    /// Those of surfaces that cover pixels in part where they end.
    pub const OF_EDGES: [Self; 3] = [Self::EdgeOpacity, Self::Share, Self::LayerBehind];

    /// Those of splats at borders, where these cover pixels in part.
    pub const OF_BORDERS: [Self; 2] = [Self::Reach, Self::BorderDistance];

    /// Those of clip curves; the last five of them where these cover pixels in part.
    pub const OF_CLIPS: [Self; 7] = [
        Self::ClipLine,
        Self::ClipCurve,
        Self::ClipRamp,
        Self::Crease,
        Self::SharpSum,
        Self::Outlined,
        Self::LayerBeside,
    ];

    /// That of planes that cut what is seen.
    pub const OF_PLANES: [Self; 1] = [Self::Plane];

    /// That of eye-dome lighting.
    pub const OF_EYE_DOME: [Self; 1] = [Self::EyeDome];

    /// Those of opaque splats.
    pub const ALL: [Self; 42] = [
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
        Self::LowPass,
        Self::LowPassBox,
        Self::Share,
        Self::AffineMap,
        Self::Contour,
        Self::RayDepth,
        Self::RayAxis,
        Self::ApproximateSize,
        Self::TriangleCorner,
        Self::KernelTexture,
        Self::NearestDepth,
        Self::Widened,
        Self::KeptDepth,
    ];
}
