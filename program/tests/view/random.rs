//! Numbers at random, and keys to press so.

/// All keys but those that end it and those that write files.
pub const KEYS: &str = "h f 1 2 3 4 5 6 7 u p t r R g G k n b v V l L bracketright bracketleft m period comma x z space y o question \
                        Escape F5 w a s d q e j X B equal minus O N H less greater 0";

/// Those of them that change no setting of the picture, so that after a while all pipelines are there.
pub const KEYS_OF_VIEWS: &str = "h f 1 2 3 4 5 6 7 u t o question Escape w a s d q e j";

/// Numbers at random, the same in every run.
pub struct Random(pub u64);

impl Random {
    /// Below `end`.
    pub fn below(&mut self, end: u32) -> u32 {
        // Knuth's MMIX.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(end)) as u32
    }
}
