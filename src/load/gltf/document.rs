//! The JSON of a glTF file, as far as it says where surfaces are and what color they have.
//!
//! Numbers of nodes stay `f64`, as they are written: the crate `gltf` keeps them in `f32`, which loses the digits of
//! models that a node moves to world coordinates.

use std::{borrow::Cow, fmt, marker::PhantomData};

use serde::{
    Deserialize, Deserializer,
    de::{Error, IgnoredAny, SeqAccess, Visitor},
};

/// All that is read.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document<'a> {
    #[serde(borrow)]
    pub asset: Asset<'a>,
    #[serde(default, borrow)]
    pub extensions_required: Few<Cow<'a, str>>,
    pub scene: Option<u32>,
    #[serde(default)]
    pub scenes: Few<Scene>,
    #[serde(default)]
    pub nodes: Few<Node>,
    #[serde(default)]
    pub meshes: Few<Mesh>,
    #[serde(default, borrow)]
    pub materials: Few<Material<'a>>,
    #[serde(default, borrow)]
    pub accessors: Few<Accessor<'a>>,
    #[serde(default)]
    pub buffer_views: Few<BufferView>,
    #[serde(default, borrow)]
    pub buffers: Few<Buffer<'a>>,
    #[serde(default)]
    pub animations: Few<IgnoredAny>,
}

#[derive(Deserialize)]
pub(super) struct Asset<'a> {
    #[serde(borrow)]
    pub version: Cow<'a, str>,
}

#[derive(Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub nodes: Few<u32>,
}

/// Each may be `{}` in the file, and so has little in it that is not behind a pointer.
#[derive(Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub children: Few<u32>,
    pub mesh: Option<u32>,
    pub skin: Option<IgnoredAny>,
    pub matrix: Option<Box<[f64; 16]>>,
    pub translation: Option<Box<[f64; 3]>>,
    pub rotation: Option<Box<[f64; 4]>>,
    pub scale: Option<Box<[f64; 3]>>,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    #[serde(default)]
    pub primitives: Few<Primitive>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    #[serde(default)]
    pub attributes: Attributes,
    pub indices: Option<u32>,
    pub material: Option<u32>,
    pub mode: Option<u32>,
    #[serde(default)]
    pub targets: Few<IgnoredAny>,
}

/// Numbers of accessors.
#[derive(Clone, Copy, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub(super) struct Attributes {
    pub position: Option<u32>,
    pub normal: Option<u32>,
    #[serde(rename = "COLOR_0")]
    pub color: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Material<'a> {
    pub pbr_metallic_roughness: Option<Box<Pbr>>,
    #[serde(borrow)]
    pub alpha_mode: Option<Cow<'a, str>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Pbr {
    pub base_color_factor: Option<[f64; 4]>,
    pub base_color_texture: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor<'a> {
    pub buffer_view: Option<u32>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type", borrow)]
    pub shape: Cow<'a, str>,
    pub sparse: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub buffer: u32,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer<'a> {
    #[serde(borrow)]
    pub uri: Option<Cow<'a, str>>,
    pub byte_length: u64,
}

/// A list of the file's own length, up to a limit: elements may be larger in memory than in the file.
pub(super) struct Few<T>(Box<[T]>);

/// The longest list.
const MOST: usize = 1 << 19;

impl<T> Default for Few<T> {
    fn default() -> Self {
        Self(Box::default())
    }
}

impl<T> std::ops::Deref for Few<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Few<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(FewVisitor(PhantomData))
    }
}

struct FewVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for FewVisitor<T> {
    type Value = Few<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of at most {MOST}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Few<T>, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = list.next_element()? {
            if items.len() == MOST {
                return Err(A::Error::invalid_length(MOST + 1, &self));
            }
            items.push(item);
        }
        Ok(Few(items.into_boxed_slice()))
    }
}
