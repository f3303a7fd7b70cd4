//! One joint aiming at two targets at once: w₀ aim(P₀) + w₁ aim(P₁).
//!
//! Each target is treated as for [one joint](super::one_joint), with the same `f` and `t`.
//!
//! **Meeting between the rotations.** With one target, rotating `f` and `t` forward by pitch instead of the target back
//! is not worth it: it costs 6 more and saves 3, because both moments can be taken at once. With two targets it is
//! worth it: the two rotations of `f` and `t` replace those of the two targets, and 3 are saved for each.
//!
//! | | |
//! |---|---|
//! | f, t forward by pitch | 12 |
//! | for each target: back by heading | 6 |
//! | v, n, f · v | 3 + 6 + 5 |
//! | r = 1 / n, its aim, w aim, σ, w r | 1 + 1 + 1 + 1 + 1 |
//! | g = f − σ v, two moments | 6 + 6 |
//! | moments times w r | 2 |
//! | the sums | 3 |
//! | | 12 + 2 · 39 + 3 = 93 |
//!
//! Rejected:
//! - Both targets rotated back all the way: 99.
//! - Since `g` can also be `f + σ t`, the moments of all targets are those of `f` on `Σ w r q` and of `t` on
//!   `Σ w r σ q`: 9 + 9 for the two sums and 14 for the moments, instead of 12 + 12 + 4 + 2: + 2 with two targets. From
//!   three targets on this would be cheaper.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, Link, moment, reciprocal, turn, turn_back};

/// Returns w₀ aim(P₀) + w₁ aim(P₁) and its derivatives by pitch and heading: 93 operations.
#[inline]
pub fn aim_gradient<T: Number>(
    effector_to_joint: &[T; 12],
    targets: [[T; 3]; 2],
    weights: [T; 2],
    sin_cos: [T; 4],
) -> [T; 3] {
    let angles = Angles::of(sin_cos);
    let link = Link::of(effector_to_joint);
    let [f, t] = [link.forward, link.origin].map(|a| {
        let [forward, up] = turn([a.forward, a.up], angles.pitch);
        Axes { forward, left: a.left, up }
    });
    let one = |target: [T; 3], weight: T| {
        let p = Axes::of(target);
        let [forward, left] = turn_back([p.forward, p.left], angles.heading);
        let q = Axes { forward, left, up: p.up };
        let v = q - t;
        let r = reciprocal(v.norm());
        let aim = r * f.dot(v);
        let g = f - v.times(r * aim);
        let k = weight * r;
        let by_pitch = moment([g.forward, g.up], [q.forward, q.up]);
        let by_heading = moment([g.forward, g.left], [q.forward, q.left]);
        [weight * aim, k * by_pitch, k * by_heading]
    };
    let [a, b] = [one(targets[0], weights[0]), one(targets[1], weights[1])];
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
