//! The contract of `surfel::embed` for C. `include/surfel.h` is made of this crate by cbindgen, and a test holds it to that.
//!
//! Each function is a border: arguments are checked as far as C lets them be, an error becomes a code and a sentence, and no panic leaves
//! (`result.rs`). Structs that C fills grow at their ends (`structs.rs`).

mod arrays;
mod handle;
mod images;
mod structs;

// From here on in the order of the header.
mod result;

mod requirements;

mod memory;

mod device;

mod scene;
mod splats;

mod contents;

mod levels;
mod mesh;

mod hybrid_levels;

mod listener;

// Without files nothing reads one, but the header has it.
#[cfg_attr(not(feature = "files"), expect(dead_code))]
mod description;

mod load_options;

mod load;

mod made;

mod save;

mod lights;
mod names;

mod dynamic;
mod renderer;
mod rooms;

mod settings;

mod frame;
mod view;

mod needs;

mod measured;

mod ahead;
mod pick;

mod camera;

mod picture;

mod headless;

#[cfg(test)]
mod without_device;

/// The version of this header: as `VK_MAKE_API_VERSION(0, major, minor, patch)`.
pub const SURFEL_VERSION: u32 = 1 << 12;

/// The version of the library that runs, as `SURFEL_VERSION` is that of the header that was compiled with. Before 1.0 both must have the
/// same minor number, then the same major number.
#[unsafe(no_mangle)]
pub extern "C" fn surfel_version() -> u32 {
    SURFEL_VERSION
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_version_is_that_of_the_package() {
        let [major, minor, patch] = env!("CARGO_PKG_VERSION").split('.').collect::<Vec<_>>()[..] else {
            panic!("three numbers")
        };
        let number = |text: &str| text.parse::<u32>().unwrap();
        assert_eq!(super::surfel_version(), number(major) << 22 | number(minor) << 12 | number(patch));
    }
}
