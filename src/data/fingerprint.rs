//! Names of contents: equal data have equal fingerprints, and different data practically never.

/// A hash in the making: each step is a bijection of the state, so that contents that differ in one word never collide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fingerprint(u128);

impl Fingerprint {
    /// The beginning, for one kind of content.
    pub(super) fn new(kind: u64) -> Self {
        let mut all = Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        all.add(kind);
        all
    }

    pub(super) fn add(&mut self, word: u64) {
        const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013B;
        self.0 = ((self.0 ^ u128::from(word)).wrapping_mul(PRIME)).rotate_left(29);
    }

    pub(super) fn value(self) -> u128 {
        self.0
    }
}
