//! The aim of an effector whose forward is any constant direction `F`, with joints in cardinal frames.
//!
//! The effector's own origin is part of the first link's translation and costs nothing. Its forward direction in joint
//! 0's space is `f = F₀ m₀ + F₁ m₁ + F₂ m₂` with the rows of the link: 15 operations. The rest is as for [one
//! joint](super::one_joint) and [a chain](super::chain).
//!
//! **One component of a constant direction can be scaled to 1.** With `k` the largest component,
//! `f / Fₖ = mₖ + (Fᵢ / Fₖ) mᵢ + (Fⱼ / Fₖ) mⱼ` costs 12. The factor `Fₖ` then moves to aim and derivatives. A constant
//! over a length is one operation, like 1 over the length:
//!
//! ```text
//! w = f / Fₖ · v     ρ = Fₖ / n     aim = ρ w     σ = w / n² = (1 / Fₖ²) ρ aim     ∂aim = ρ · moments of f / Fₖ − σ v
//! ```
//!
//! This is 4 for ρ, aim and σ, instead of 3 for one joint with `f` given. So:
//!
//! | | |
//! |---|---|
//! | aim (12 for f; ρ and a product instead of one division) | 27 + 12 + 1 = 40 |
//! | all three of one joint | 46 + 12 + 1 = 59 |
//! | chain | 63 N − 16 + 12 + 1 = 63 N − 3 |
//!
//! Rejected: `v` in effector space (15) and its product with `F` there (4, and 1 for the scale): 42.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, Link, TurnedBack, over};
use super::chain::outward;

/// A constant direction with its largest component factored out.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// Index of the largest component.
    largest: usize,
    /// The largest component.
    pub(super) size: f64,
    /// The other two components divided by the largest, in cyclic order after it.
    ratios: [f64; 2],
}

impl Direction {
    /// Creates a direction from a unit vector.
    pub fn new(f: [f64; 3]) -> Self {
        let largest = (1..3).fold(0, |best, k| if f[k].abs() > f[best].abs() { k } else { best });
        let [i, j] = [(largest + 1) % 3, (largest + 2) % 3];
        Self { largest, size: f[largest], ratios: [f[i] / f[largest], f[j] / f[largest]] }
    }

    /// The largest component.
    #[inline]
    pub fn size<T: Number>(&self) -> T {
        T::constant(self.size)
    }

    /// Returns the direction in joint 0's space, divided by its largest component: 12 operations.
    #[inline]
    pub fn seen<T: Number>(&self, link: &[T; 12]) -> [T; 3] {
        let k = self.largest;
        let row = |k: usize, axis: usize| link[3 * (k % 3) + axis];
        let [i, j] = self.ratios.map(T::constant);
        core::array::from_fn(|axis| row(k, axis) + i * row(k + 1, axis) + j * row(k + 2, axis))
    }

    /// Returns 1 / the square of the largest component.
    #[inline]
    fn rest<T: Number>(&self) -> T {
        T::constant(1.0 / (self.size * self.size))
    }
}

/// Returns the aim: 40 operations.
#[inline]
pub fn aim<T: Number>(forward: &Direction, effector_to_joint: &[T; 12], target: [T; 3], sin_cos: [T; 4]) -> T {
    let q = TurnedBack::from(Axes::of(target), Angles::of(sin_cos)).q;
    let v = q - Link::of(effector_to_joint).origin;
    let f = Axes::of(forward.seen(effector_to_joint));
    over(forward.size(), v.norm()) * f.dot(v)
}

/// Returns the aim and its derivatives by pitch and heading, joint by joint: 63 N − 3 operations, 59 for one joint.
#[inline]
pub fn aim_gradient<T: Number, const N: usize>(
    forward: &Direction,
    links: &[[T; 12]; N],
    target: [T; 3],
    sin_cos: &[[T; 4]; N],
) -> (T, [[T; 2]; N]) {
    let f = Axes::of(forward.seen(&links[0]));
    let links = links.each_ref().map(Link::of);
    let angles = sin_cos.map(Angles::of);
    let way = outward(&links, target, &angles);

    let v = way[0].q - links[0].origin;
    let rho = over(forward.size(), v.norm());
    let aim = rho * f.dot(v);
    let sigma = forward.rest::<T>() * rho * aim;
    let mut g = f - v.times(sigma);

    let mut gradient = [[T::constant(0.0); 2]; N];
    if N == 1 {
        gradient[0] = [rho * way[0].by_pitch(g), rho * way[0].by_heading(g, angles[0])];
        return (aim, gradient);
    }
    g = g.times(rho);
    for i in 0..N {
        if i > 0 {
            g = links[i].inward(g);
        }
        if i < N - 1 {
            (gradient[i], g) = way[i].pull(g, angles[i]);
        } else {
            gradient[i] = [way[i].by_pitch(g), way[i].by_heading(g, angles[i])];
        }
    }
    (aim, gradient)
}
