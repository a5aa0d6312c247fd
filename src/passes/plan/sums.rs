//! The precision of sums, and why it is that.
//!
//! Sums of 16 bits are wrong by more than 1/255 from some 100 splats in a pixel on, however little surfaces overlap on the average, and lose
//! colors where a kernel's weights are small. So `auto` has 32 bits wherever the device can add them. They are twice the bytes. On a CPU driver
//! points of a scan took about as long with them, and little in a large image probably longer (`DECISIONS.md`); on a GPU that was not
//! measured. Who needs the time more than the digits names `f16`.

use crate::{
    scene::{Accumulate, Settings, Shading},
    vk::Limits,
};

/// The reason where tiles weigh splats: in registers, and in the images where they leave sums to others.
pub(super) const OF_TILES: &str = "tiles weigh splats without floors, for which 16 bits are too few";

/// As a part of a sentence.
type Reason = &'static str;

/// The precision that sums have where nothing else decides, and why.
pub(super) fn sums(settings: &Settings, limits: &Limits) -> (Accumulate, Reason) {
    if settings.shading == Shading::EyeDome {
        return (Accumulate::F32, "16 bits would make steps of every slope");
    }
    match settings.accumulate {
        Accumulate::Auto if limits.blend_f32 => {
            (Accumulate::F32, "auto: colors are exact however many splats overlap")
        }
        Accumulate::Auto => (Accumulate::F16, "auto: the device can't blend 32-bit floats"),
        named => (named, "asked for"),
    }
}

/// These settings with the precision that sums have on the device.
pub fn with_sums(settings: &Settings, limits: &Limits) -> Settings {
    Settings { accumulate: sums(settings, limits).0, ..settings.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_has_32_bits_where_the_device_adds_them_and_names_are_kept() {
        let [with, without] = [true, false].map(|blend_f32| Limits { blend_f32, ..Limits::plain() });
        let of = |accumulate, limits| {
            with_sums(&Settings { accumulate, ..Settings::default() }, limits).accumulate
        };
        assert_eq!(Settings::default().accumulate, Accumulate::Auto);
        assert_eq!(of(Accumulate::Auto, &with), Accumulate::F32);
        assert_eq!(of(Accumulate::Auto, &without), Accumulate::F16);
        for (_, named) in Accumulate::PRECISIONS {
            assert_eq!([&with, &without].map(|limits| of(*named, limits)), [*named; 2]);
        }
    }
}
