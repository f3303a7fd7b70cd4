//! Seeded random geometry: the tests are the same everywhere.

/// A seeded generator.
#[derive(Clone, Debug)]
pub struct Random(fastrand::Rng);

impl Random {
    /// The generator with this seed.
    pub fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    /// A whole number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.usize(..end)
    }

    /// A number in `-limit..limit`.
    pub fn within(&mut self, limit: f64) -> f64 {
        limit * (2.0 * self.0.f64() - 1.0)
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
