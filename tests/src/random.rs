//! A small seeded generator: the tests are the same everywhere.

/// `SplitMix64`.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The generator with this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end as u64).expect("it is below a usize")
    }

    /// A number in `-limit..limit`.
    pub fn within(&mut self, limit: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits are what an f64 holds")]
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        limit * (2.0 * unit - 1.0)
    }

    /// A vector with components in `-limit..limit`.
    pub fn vector(&mut self, limit: f64) -> [f64; 3] {
        [0; 3].map(|_| self.within(limit))
    }

    /// The rows of a proper rotation.
    pub fn rotation(&mut self) -> [[f64; 3]; 3] {
        let [a, b, c, d] = [0; 4].map(|_| self.within(1.0));
        let n = a * a + b * b + c * c + d * d;
        if n < 0.01 {
            return self.rotation();
        }
        [
            [(a * a + b * b - c * c - d * d) / n, 2.0 * (b * c + a * d) / n, 2.0 * (b * d - a * c) / n],
            [2.0 * (b * c - a * d) / n, (a * a - b * b + c * c - d * d) / n, 2.0 * (c * d + a * b) / n],
            [2.0 * (b * d + a * c) / n, 2.0 * (c * d - a * b) / n, (a * a - b * b - c * c + d * d) / n],
        ]
    }
}
