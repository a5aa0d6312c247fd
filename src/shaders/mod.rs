//! The shaders of `glsl/`, compiled to SPIR-V by `build.rs`: one `static` each, named after pass and stage, as
//! `EXPORT_FRAG` for `glsl/export.frag.glsl`. A file with a line `// Permutations:` gives several, see
//! `build/permutations.rs`.
//!
//! Building the crate also checks that each struct which host and shaders share (`HOST_STRUCTS` in `build/mod.rs`) has the
//! same layout on both sides; a member that differs stops the build with its name.

#[cfg(feature = "live-shaders")]
pub mod live;

/// A compiled shader; its entry point is `main`.
#[derive(Debug)]
pub struct Shader {
    /// Pass and stage, such as `visibility.frag`.
    pub name: &'static str,
    bytes: &'static Aligned<[u8]>,
}

/// Bytes that begin where a `u32` may.
#[derive(Debug)]
#[repr(C, align(4))]
struct Aligned<T: ?Sized>(T);

impl Shader {
    /// SPIR-V 1.6 for Vulkan 1.3.
    pub fn spirv(&self) -> &'static [u32] {
        #[cfg(feature = "live-shaders")]
        if let Some(spirv) = live::spirv(self.name) {
            return spirv;
        }
        self.built()
    }

    /// As the crate was built.
    fn built(&self) -> &'static [u32] {
        bytemuck::cast_slice(&self.bytes.0)
    }
}

/// Names are unique.
impl PartialEq for Shader {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Shader {}

impl std::hash::Hash for Shader {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

include!(concat!(env!("OUT_DIR"), "/shaders/shaders.rs"));
