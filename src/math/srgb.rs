//! The sRGB transfer function (IEC 61966-2-1), both ways.

/// Linear light of an sRGB value, both 0–1.
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The sRGB value of linear light, both 0–1.
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_and_the_way_back() {
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-6);
        for byte in 0..=255_u8 {
            let encoded = f32::from(byte) / 255.0;
            assert!((srgb_from_linear(linear_from_srgb(encoded)) - encoded).abs() < 1e-6);
        }
    }
}
