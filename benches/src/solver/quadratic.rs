//! The quadratic program of the reference, solved by two nested root searches of increasing functions: slow, but
//! robust.
//!
//! Minimises `½ Σ wᵢ xᵢ² + |A x − b|² / 2μ` within `lo ≤ x ≤ hi`, where `A` has two rows. For `μ → 0` this is the least
//! displacement subject to `A x = b` if the box allows it, and otherwise the point nearest to it. At the minimum
//! `xᵢ = clamp(aᵢ·λ / wᵢ)` and `A x + μ λ = b`: two equations in two unknowns, each increasing in its own unknown.

use super::model::{Angles, MOST};

/// The objective and its bounds.
#[derive(Clone, Copy, Debug)]
pub struct Program<'a> {
    /// Number of unknowns.
    pub count: usize,
    /// `aᵢ`, the columns of `A`.
    pub columns: &'a [[f64; 2]; MOST],
    /// `b`
    pub right: [f64; 2],
    /// `wᵢ`
    pub weights: &'a Angles,
    /// `lo` and `hi`
    pub bounds: &'a [Angles; 2],
    /// `μ`
    pub softness: f64,
}

impl Program<'_> {
    /// Returns the minimiser `x` and the multipliers `λ`.
    pub fn solve(&self) -> (Angles, [f64; 2]) {
        let first = zero(|first| {
            let second = self.second(first);
            self.excess([first, second])[0]
        });
        let multipliers = [first, self.second(first)];
        (self.at(multipliers), multipliers)
    }

    fn at(&self, multipliers: [f64; 2]) -> Angles {
        let mut x = [0.0; MOST];
        for (i, x) in x.iter_mut().enumerate().take(self.count) {
            let [a, b] = self.columns[i];
            let wanted = (a * multipliers[0] + b * multipliers[1]) / self.weights[i];
            *x = wanted.max(self.bounds[0][i]).min(self.bounds[1][i]);
        }
        x
    }

    /// Returns `A x + μ λ − b`.
    fn excess(&self, multipliers: [f64; 2]) -> [f64; 2] {
        let x = self.at(multipliers);
        let mut excess = [0, 1].map(|k| self.softness * multipliers[k] - self.right[k]);
        for (column, x) in self.columns.iter().zip(x).take(self.count) {
            excess[0] += column[0] * x;
            excess[1] += column[1] * x;
        }
        excess
    }

    /// Returns the second multiplier, which satisfies the second equation for a given first one.
    fn second(&self, first: f64) -> f64 {
        zero(|second| self.excess([first, second])[1])
    }
}

/// Returns the zero of an increasing, piecewise linear function without flat pieces.
fn zero(f: impl Fn(f64) -> f64) -> f64 {
    let (mut lo, mut hi) = (-1.0, 1.0);
    let (mut f_lo, mut f_hi) = (f(lo), f(hi));
    while f_lo > 0.0 && lo > -1e15 {
        (hi, f_hi) = (lo, f_lo);
        lo *= 8.0;
        f_lo = f(lo);
    }
    while f_hi < 0.0 && hi < 1e15 {
        (lo, f_lo) = (hi, f_hi);
        hi *= 8.0;
        f_hi = f(hi);
    }
    // A secant step is exact within one linear piece, and bisection always converges. One step in three bisects, so
    // that a bad sequence of secants cannot stall the search.
    for round in 0..200 {
        if f_lo >= 0.0 {
            return lo;
        }
        if f_hi <= 0.0 {
            return hi;
        }
        let secant = lo - f_lo * (hi - lo) / (f_hi - f_lo);
        let middle = if round % 3 == 2 { 0.5 * (lo + hi) } else { secant };
        if !(middle > lo && middle < hi) || hi - lo <= 1e-15 * (lo.abs() + hi.abs()) {
            break;
        }
        let f_middle = f(middle);
        if f_middle < 0.0 {
            (lo, f_lo) = (middle, f_middle);
        } else {
            (hi, f_hi) = (middle, f_middle);
        }
    }
    if -f_lo < f_hi { lo } else { hi }
}
