//! Joints with a third angle: roll about the bone's forward, which turns left towards up and acts first, nearest the
//! effector; then pitch, then heading.
//!
//! The target is rotated back by heading, pitch and roll, 18. The rest is as for [one joint](super::one_joint): the
//! covector `g = f − σ v`, its moment in roll's plane, rotated forward by roll, its moment in pitch's plane, and so on.
//!
//! | | one joint |
//! |---|---|
//! | turn the target back | 18 |
//! | v, n, f · v, 1 / n, aim, σ | 3 + 6 + 5 + 3 |
//! | g | 6 |
//! | moment by roll; turn by roll; moment by pitch; part ahead; moment by heading | 3 + 6 + 3 + 3 + 3 |
//! | the factor 1 / n | 3 |
//! | | 62 |
//!
//! A chain of two: 2 · 18 + 18 outward, 3 + 6 + 5 + 3 + 6 + 3 for the covector, 9 + 18 for three moments and three
//! rotations at joint 0, 15 through the link, 18 at the last joint: 140. Every further joint adds 78.
//!
//! Rejected, all at the same count:
//! - `f` and `t` rotated forward by roll (12) instead of `q` back (6) and `g` forward (6).
//! - One moment vector `m = q × g` (9), whose components are the derivatives: `m_f` by roll; rotated by roll, its left
//!   component by pitch (3); rotated by pitch as well (3 + 3), by heading. In a chain `g` must be rotated in addition.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, Link, TurnedBack, moment, reciprocal, turn, turn_back};

/// Sines and cosines of roll, pitch and heading.
#[derive(Clone, Copy, Debug)]
struct Three<T> {
    roll: [T; 2],
    others: Angles<T>,
}

impl<T: Number> Three<T> {
    #[inline]
    fn of([sin_r, cos_r, sin_p, cos_p, sin_h, cos_h]: [T; 6]) -> Self {
        Self { roll: [sin_r, cos_r], others: Angles::of([sin_p, cos_p, sin_h, cos_h]) }
    }
}

/// A point rotated back by all three angles.
#[derive(Clone, Copy, Debug)]
struct Rolled<T> {
    before: TurnedBack<T>,
    q: Axes<T>,
}

impl<T: Number> Rolled<T> {
    /// Rotates the point back by all three angles: 18 operations.
    #[inline]
    fn from(point: Axes<T>, angles: Three<T>) -> Self {
        let before = TurnedBack::from(point, angles.others);
        let [left, up] = turn_back([before.q.left, before.q.up], angles.roll);
        Self { before, q: Axes { forward: before.q.forward, left, up } }
    }

    /// Returns the moment by roll, and the covector rotated forward by roll: 9 operations.
    #[inline]
    fn pull_roll(&self, g: Axes<T>, angles: Three<T>) -> (T, Axes<T>) {
        let by_roll = moment([g.left, g.up], [self.q.left, self.q.up]);
        let [left, up] = turn([g.left, g.up], angles.roll);
        (by_roll, Axes { forward: g.forward, left, up })
    }

    /// Returns the moments by roll, pitch and heading: 18 operations.
    #[inline]
    fn moments(&self, g: Axes<T>, angles: Three<T>) -> [T; 3] {
        let (by_roll, g) = self.pull_roll(g, angles);
        [by_roll, self.before.by_pitch(g), self.before.by_heading(g, angles.others)]
    }

    /// Returns the moments, and the covector on the point before it was rotated back: 27 operations.
    #[inline]
    fn pull(&self, g: Axes<T>, angles: Three<T>) -> ([T; 3], Axes<T>) {
        let (by_roll, g) = self.pull_roll(g, angles);
        let ([by_pitch, by_heading], g) = self.before.pull(g, angles.others);
        ([by_roll, by_pitch, by_heading], g)
    }
}

/// Returns aim, g and 1 / n: 23 operations.
#[inline]
fn covector<T: Number>(link: &Link<T>, q: Axes<T>) -> (T, Axes<T>, T) {
    let (f, v) = (link.forward, q - link.origin);
    let r = reciprocal(v.norm());
    let aim = r * f.dot(v);
    (aim, f - v.times(r * aim), r)
}

/// Returns the aim and its derivatives by roll, pitch and heading: 62 operations. `sin_cos` holds sine and cosine of
/// roll, pitch and heading.
#[inline]
pub fn aim_gradient<T: Number>(effector_to_joint: &[T; 12], target: [T; 3], sin_cos: [T; 6]) -> (T, [T; 3]) {
    let angles = Three::of(sin_cos);
    let way = Rolled::from(Axes::of(target), angles);
    let (aim, g, r) = covector(&Link::of(effector_to_joint), way.q);
    (aim, way.moments(g, angles).map(|moment| r * moment))
}

/// Returns the aim and its derivatives by roll, pitch and heading of joint 0, then of joint 1: 140 operations.
#[inline]
pub fn chain_of_two<T: Number>(links: &[[T; 12]; 2], target: [T; 3], sin_cos: &[[T; 6]; 2]) -> (T, [[T; 3]; 2]) {
    let [outer, inner] = links.each_ref().map(Link::of);
    let angles = sin_cos.map(Three::of);
    let last = Rolled::from(Axes::of(target), angles[1]);
    let first = Rolled::from(inner.outward(last.q - inner.origin), angles[0]);
    let (aim, g, r) = covector(&outer, first.q);
    let (by_first, g) = first.pull(g.times(r), angles[0]);
    (aim, [by_first, last.moments(inner.inward(g), angles[1])])
}
