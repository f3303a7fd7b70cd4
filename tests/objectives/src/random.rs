//! Seeded random arguments, so that the tests are the same on every machine.

use std::ops::Range;

/// A seeded generator of random arguments.
#[derive(Clone, Debug)]
pub struct Random(fastrand::Rng);

impl Random {
    /// Creates a generator with this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    /// Returns a random number in this range.
    pub fn within(&mut self, range: Range<f64>) -> f64 {
        range.start + (range.end - range.start) * self.0.f64()
    }

    /// Returns `count` random numbers in this range.
    pub fn numbers(&mut self, count: usize, range: Range<f64>) -> Vec<f64> {
        (0..count).map(|_| self.within(range.clone())).collect()
    }

    /// Returns 1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.0.bool() { 1.0 } else { -1.0 }
    }

    /// Returns a vector in a random direction, with a length in this range.
    pub fn vector(&mut self, length: Range<f64>) -> Vec<f64> {
        self.direction(3, length)
    }

    /// Returns a random quaternion with a length in this range.
    pub fn quaternion(&mut self, length: Range<f64>) -> Vec<f64> {
        self.direction(4, length)
    }

    /// Returns a random rigid transform: its rotation as a quaternion, and its translation of length up to `limit`.
    pub fn frame(&mut self, limit: f64) -> Vec<f64> {
        [self.quaternion(0.5..2.0), self.vector(0.0..limit)].concat()
    }

    /// Calls `sample` until `keep` accepts a point, and returns it.
    pub fn until(&mut self, sample: impl Fn(&mut Self) -> Vec<f64>, keep: impl Fn(&[f64]) -> bool) -> Vec<f64> {
        loop {
            let point = sample(self);
            if keep(&point) {
                return point;
            }
        }
    }

    fn direction(&mut self, count: usize, length: Range<f64>) -> Vec<f64> {
        let raw =
            self.until(|random| random.numbers(count, -1.0..1.0), |raw| raw.iter().map(|x| x * x).sum::<f64>() > 0.01);
        let scale = self.within(length) / raw.iter().map(|x| x * x).sum::<f64>().sqrt();
        raw.into_iter().map(|x| x * scale).collect()
    }
}
