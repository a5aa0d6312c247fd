//! Random numbers that are the same on every machine.

/// A sequence of random numbers (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
/// Seeds that lie side by side give sequences that have nothing in common.
pub struct SplitMix(pub u64);

impl SplitMix {
    /// The next number: 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// The next number, from 0 to below 1.
    pub fn unit(&mut self) -> f64 {
        unit_from_bits(self.bits())
    }
}

/// The upper 53 bits as a fraction, from 0 to below 1.
pub fn unit_from_bits(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_that_of_the_published_code() {
        // The first outputs of Vigna's splitmix64.c for the seed 1234567.
        let mut random = SplitMix(1_234_567);
        let expected = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!([random.bits(), random.bits(), random.bits()], expected);
        assert_eq!((unit_from_bits(0), unit_from_bits(1 << 63)), (0.0, 0.5));
        assert!(unit_from_bits(u64::MAX) < 1.0);
    }
}
