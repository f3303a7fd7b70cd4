//! The aim of a chain of N joints and its 2 N derivatives.
//!
//! One pass takes the target outward, from the last joint's space to the effector: each joint rotates it back, each
//! link subtracts the outer origin and converts the rest to outer components. At joint 0 it is compared with `f` and
//! `t` as for [one joint](super::one_joint). A second pass takes the covector `g` inward along the same way: moments at
//! each joint, then the forward rotation; a link applies its 3×3 part alone.
//!
//! | | each | how often |
//! |---|---|---|
//! | turn the target back | 12 | N |
//! | through a link | 3 + 15 | N − 1 |
//! | v, n, f · v, 1 / n, aim, σ | 3 + 6 + 5 + 3 | 1 |
//! | g = (f − σ v) / n | 6 + 3 | 1 |
//! | two moments and two turns of g | 6 + 12 | N − 1 |
//! | g through a link | 15 | N − 1 |
//! | at the last joint two moments, and g's part ahead | 6 + 3 | 1 |
//!
//! The total is 63 N − 16. Multiplying `g` by 1 / n at once costs 3; multiplying the outputs would cost 2 N. For one
//! joint the latter is cheaper, which gives 46.
//!
//! Rejected:
//! - Tangents instead of covectors at the last joint (as [the residual](super::residual) does): 9 + 17 to take two
//!   through the link and 10 for their products with `g`, instead of 15 + 9.
//! - Tangents of the half angles, or shears: the six operations of a rotation become four, with a factor 1 / cos that
//!   can be deferred, but each derivative must then be multiplied by it. The factor is also singular.
//! - The factor 1 / n in the sine and cosine of joint 0's pitch, which rotate `g`, and in its left component: also 3
//!   (with [two covectors](super::residual) it is 4 instead of 6).
//! - Rotating `f` and `t` forward by joint 0's pitch, to save rotating `q` back and `g` forward: 12 either way.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, Link, TurnedBack, reciprocal};
use super::one_joint;

/// Takes the target outward and returns it rotated back at each joint: 12 N + 18 (N − 1) operations.
#[inline]
pub(super) fn outward<T: Number, const N: usize>(
    links: &[Link<T>; N],
    target: [T; 3],
    angles: &[Angles<T>; N],
) -> [TurnedBack<T>; N] {
    let zero = T::constant(0.0);
    let nowhere = Axes { forward: zero, left: zero, up: zero };
    let mut way = [TurnedBack { between: nowhere, q: nowhere }; N];
    let mut point = Axes::of(target);
    for i in (0..N).rev() {
        way[i] = TurnedBack::from(point, angles[i]);
        if i > 0 {
            point = links[i].outward(way[i].q - links[i].origin);
        }
    }
    way
}

/// Returns the aim and its derivatives by pitch and heading, joint by joint: 63 N − 16 operations, 46 for one joint.
#[inline]
pub fn aim_gradient<T: Number, const N: usize>(
    links: &[[T; 12]; N],
    target: [T; 3],
    sin_cos: &[[T; 4]; N],
) -> (T, [[T; 2]; N]) {
    if N == 1 {
        let [aim, by_pitch, by_heading] = one_joint::aim_gradient(&links[0], target, sin_cos[0]);
        return (aim, [[by_pitch, by_heading]; N]);
    }
    let links = links.each_ref().map(Link::of);
    let angles = sin_cos.map(Angles::of);
    let way = outward(&links, target, &angles);

    let f = links[0].forward;
    let v = way[0].q - links[0].origin;
    let r = reciprocal(v.norm());
    let aim = r * f.dot(v);
    let mut g = (f - v.times(r * aim)).times(r);

    let mut gradient = [[T::constant(0.0); 2]; N];
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
