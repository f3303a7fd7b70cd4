//! The squared distance between a target and an effector's origin that is rotated by pitch, then heading.
//!
//! With `e = t R(p, h)`, the value is `|P − e|²`, with both derivatives.
//!
//! **Meeting between the rotations.** `t` is rotated forward by pitch and `P` back by heading, and they are compared
//! there. Each rotation is done once, and both moments can be taken without any further rotation.
//!
//! `d|q − t|² = 2 (q − t) · dq`, where `dq` is perpendicular to `q`: `q` drops out of the covector, and `−2 t` remains.
//! So each derivative is −2 times a moment of `t` on `q`, and a moment can be taken on either side of a rotation.
//!
//! | | |
//! |---|---|
//! | t forward by pitch, P back by heading | 6 + 6 |
//! | their difference, squared | 3 + 5 |
//! | two moments, times −2 | 6 + 2 |
//! | | 28 |
//!
//! Rejected:
//! - All rotations on one side: 12 + 3 + 5, then 3 + 1 and, with t's forward component rotated by pitch, 3 + 3 + 1: 31.
//! - Expanding to `|P|² + |t|² − 2 q · t`: 18 instead of 8, and it cancels.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, moment, turn, turn_back};

/// Returns |P − e|² and its derivatives by pitch and heading: 28 operations.
#[inline]
pub fn squared_distance_gradient<T: Number>(t: [T; 3], target: [T; 3], sin_cos: [T; 4]) -> [T; 3] {
    let angles = Angles::of(sin_cos);
    let (t, p) = (Axes::of(t), Axes::of(target));
    let [forward, up] = turn([t.forward, t.up], angles.pitch);
    let t = Axes { forward, left: t.left, up };
    let [forward, left] = turn_back([p.forward, p.left], angles.heading);
    let q = Axes { forward, left, up: p.up };

    let v = q - t;
    let twice = T::constant(-2.0);
    let by_pitch = moment([t.forward, t.up], [q.forward, q.up]);
    let by_heading = moment([t.forward, t.left], [q.forward, q.left]);
    [v.dot(v), twice * by_pitch, twice * by_heading]
}
