//! The aim of one joint and its derivatives.
//!
//! With `q = P Rᵀ` the target rotated back, `t` the effector's origin and `f` its forward direction in the joint's
//! space:
//!
//! ```text
//! v = q − t     n = |v|     aim = f · v / n
//! ```
//!
//! because rotating the effector by `R` or the target back by it makes no difference to a dot product or a length. The
//! row of the link for the effector's forward direction is `f` itself, so it costs nothing.
//!
//! Derivatives: `d aim = (f − aim v / n) / n · dq`. So the covector on `q`, without a factor 1 / n that is applied at
//! the end, is `g = f − σ v` with `σ = f · v / n²`, and the derivatives are its moments.
//!
//! | | aim | ∂/∂pitch | ∂/∂heading | all |
//! |---|---|---|---|---|
//! | turn the target back | 12 | 12 | 12 | 12 |
//! | v, n | 3 + 6 | 9 | 9 | 9 |
//! | f · v | 5 | 5 | 5 | 5 |
//! | 1 / n, aim, σ | 1 | 3 | 3 | 3 |
//! | g | | 4 | 6 | 6 |
//! | its moment in the pitch's plane | | 3 | | 3 |
//! | g's part ahead, turned forward by pitch; its moment in the heading's plane | | | 3 + 3 | 3 + 3 |
//! | the factor 1 / n | | 1 | 1 | 2 |
//! | | 27 | 37 | 42 | 46 |
//!
//! Rejected:
//! - `g = f + σ t` gives the same moments, since `v` and `−t` differ by `q`: the same count.
//! - Rotating `f` and `t` forward by pitch, so that both moments are taken between the rotations, does not need `g`'s
//!   forward component (−3), but rotates two vectors instead of one (+6).
//! - `σ = f · v / (n n)` and dividing each output by `n` saves one or two multiplications and costs as many divisions.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, Link, TurnedBack, over, reciprocal};

/// The target relative to the effector, and what value and derivatives share.
struct View<T> {
    target: TurnedBack<T>,
    f: Axes<T>,
    /// Vector from the effector to the target.
    v: Axes<T>,
    distance: T,
    /// f · v
    ahead: T,
}

/// Costs 26 operations.
#[inline]
fn view<T: Number>(link: &[T; 12], target: [T; 3], angles: Angles<T>) -> View<T> {
    let link = Link::of(link);
    let target = TurnedBack::from(Axes::of(target), angles);
    let v = target.q - link.origin;
    View { target, f: link.forward, v, distance: v.norm(), ahead: link.forward.dot(v) }
}

/// Returns the aim: 27 operations.
#[inline]
pub fn aim<T: Number>(effector_to_joint: &[T; 12], target: [T; 3], sin_cos: [T; 4]) -> T {
    let view = view(effector_to_joint, target, Angles::of(sin_cos));
    over(view.ahead, view.distance)
}

/// Returns ∂aim / ∂pitch: 37 operations.
#[inline]
pub fn by_pitch<T: Number>(effector_to_joint: &[T; 12], target: [T; 3], sin_cos: [T; 4]) -> T {
    let View { target, f, v, distance, ahead } = view(effector_to_joint, target, Angles::of(sin_cos));
    let r = reciprocal(distance);
    let sigma = r * (r * ahead);
    // The left component of g is not needed.
    let g = Axes { forward: f.forward - sigma * v.forward, left: T::constant(0.0), up: f.up - sigma * v.up };
    r * target.by_pitch(g)
}

/// Returns ∂aim / ∂heading: 42 operations.
#[inline]
pub fn by_heading<T: Number>(effector_to_joint: &[T; 12], target: [T; 3], sin_cos: [T; 4]) -> T {
    let angles = Angles::of(sin_cos);
    let View { target, f, v, distance, ahead } = view(effector_to_joint, target, angles);
    let r = reciprocal(distance);
    let sigma = r * (r * ahead);
    let g = f - v.times(sigma);
    r * target.by_heading(g, angles)
}

/// Returns aim, ∂aim / ∂pitch, ∂aim / ∂heading: 46 operations.
#[inline]
pub fn aim_gradient<T: Number>(effector_to_joint: &[T; 12], target: [T; 3], sin_cos: [T; 4]) -> [T; 3] {
    let angles = Angles::of(sin_cos);
    let View { target, f, v, distance, ahead } = view(effector_to_joint, target, angles);
    let r = reciprocal(distance);
    let aim = r * ahead;
    let g = f - v.times(r * aim);
    [aim, r * target.by_pitch(g), r * target.by_heading(g, angles)]
}
