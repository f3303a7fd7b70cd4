//! Seeded random geometry, so that the tests are the same on every machine.

/// A seeded generator of random geometry.
#[derive(Clone, Debug)]
pub struct Random(fastrand::Rng);

impl Random {
    /// Creates a generator with this seed.
    pub fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    /// Returns a whole number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.usize(..end)
    }

    /// Returns a number in `-limit..limit`.
    pub fn within(&mut self, limit: f64) -> f64 {
        limit * (2.0 * self.0.f64() - 1.0)
    }

    /// Returns a vector with components in `-limit..limit`.
    pub fn vector(&mut self, limit: f64) -> [f64; 3] {
        [0; 3].map(|_| self.within(limit))
    }

    /// Returns the rows of a proper rotation matrix.
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
