//! The chain's stereographic residual and its 2 × 2 N Jacobian.
//!
//! With `l`, `u`, `f` the effector's left, up and forward in joint 0's space (the rows of the first link, which cost
//! nothing), `v = q − t` the vector from the effector to the target, `n = |v|`:
//!
//! ```text
//! D = n + f · v     s = 2 (l · v, u · v) / D
//! ```
//!
//! **The covectors.** `dD = v/n · dv + f · dv = H · dv / n` with `H = v + n f`, so that
//!
//! ```text
//! ds_l = 2/D l · dv − s_l/D dD = τ g_l · dv     g_l = l − a H     a = s_l / 2n     τ = 2 / D
//! ```
//!
//! and likewise `g_u = u − b H`. (`|H|² = 2 n D` and `H · l = v · l`, so `g_l` is the reflection of `l` in the plane
//! perpendicular to `H`. The residual is conformal: its rows are a reflected frame. The short form uses that
//! reflection: `g_l` and `g_u` are formed from one vector `H` in joint 0's space, where `l`, `u` and `f` are given.)
//!
//! **H serves twice.** The effector's axes are orthogonal unit vectors: `l · H = l · v`, `u · H = u · v`, and
//! `f · H = n + f · v = D`. So the three products with `H` replace those with `v` and give the sum as well.
//!
//! | | each | how often |
//! |---|---|---|
//! | turn the target back | 12 | N |
//! | through a link | 3 + 15 | N − 1 |
//! | v, n | 3 + 6 | 1 |
//! | H; its products with l, u, f | 6 + 15 | 1 |
//! | τ; s | 1 + 2 | 1 |
//! | 1 / 2n; a, b; g | 1 + 2 + 12 | 1 |
//! | the factor τ of both g | 2 + 2 | 1 |
//! | two moments and two turns of both g | 12 + 24 | N − 1 |
//! | both g through a link | 30 | N − 2 |
//! | the last joint's two tangents brought to the outer side of its link | 9 + 2 + 15 | 1 |
//! | their products with both g | 20 | 1 |
//!
//! The total is 96 N − 16. One joint: 45 for the value and its intermediate results, 15 for both g, 9 for the moments
//! of each (18), the factor τ on four outputs: 82.
//!
//! **The factor is part of a rotation.** Multiplying both covectors by τ costs 6. But at joint 0 both are rotated by
//! the pitch: multiplying its sine and cosine by τ costs 2, and the left components, which that rotation does not
//! change, cost 2 more. Both moments are then taken after that rotation, which gives the same result.
//!
//! **At the last joint** tangents may replace covectors. Taking two covectors through the last link costs 30 and their
//! four moments 18. Taking the joint's two tangents `∂q/∂p = (q_u, 0, −q_f)` and `∂q/∂h = (y cos p, −x, −y sin p)` the
//! opposite way costs 9 (one component is 0) and 2 + 15, the four products 20: 46 instead of 48. At earlier joints the
//! covectors have to pass anyway.
//!
//! Rejected (counts for N ≥ 2 unless said otherwise):
//! - The products of v with the axes by converting v to effector space, and a reverse sweep from there: taking both g
//!   through the first link costs 30, instead of forming them from H; 96 N + 1.
//! - Scaling v to a unit vector first: 3 for the scaling and 1 for τ, saves 3 in H: + 1.
//! - One reciprocal, `1 / (n D)`, for both lengths: + 2.
//! - Only one covector propagated. The other is its cross product with `v / n`, but propagating `v / n` costs as much.
//!   It also follows from `q`, `g_l` and four dot products, but updating those costs 51 per joint instead of 27.
//! - Tangents of all joints propagated outward: quadratic in N.
//! - Frames propagated inward: `l`, `u` and the effector's origin (27 + 27 + 30 per joint) replace the two covectors
//!   but not `q`, which every derivative needs: + 30 per joint.
//! - Rotations and link composed to one matrix: 36 (33 with a cross product), which saves as much on three vectors, but
//!   `q` is needed between the rotations.
//! - Any other pair of directions perpendicular to v as the residual's axes, so that a component vanishes: rotating
//!   each derivative back to left and up costs 6.
//! - One joint, tangents instead of covectors: 26 for two tangents in effector space, 15 for their derivatives: + 5.

use aim_symbolic::Number;

use super::algebra::{Angles, Axes, Link, TurnedBack, over};
use super::chain::outward;

/// Returns the residual, left and up, and its derivatives (left, up) by pitch and heading, joint by joint: 96 N − 16
/// operations, 82 for one joint.
#[inline]
pub fn residual_jacobian<T: Number, const N: usize>(
    links: &[[T; 12]; N],
    target: [T; 3],
    sin_cos: &[[T; 4]; N],
) -> ([T; 2], [[[T; 2]; 2]; N]) {
    let links = links.each_ref().map(Link::of);
    let angles = sin_cos.map(Angles::of);
    let way = outward(&links, target, &angles);

    let Link { forward: f, left: l, up: u, origin } = links[0];
    let v = way[0].q - origin;
    let n = v.norm();
    let h = v + f.times(n);
    // 2 / (n + f · v)
    let tau = over(T::constant(2.0), f.dot(h));
    let s = [tau * l.dot(h), tau * u.dot(h)];
    let half = over(T::constant(0.5), n);
    let g = [l - h.times(half * s[0]), u - h.times(half * s[1])];

    let mut jacobian = [[[T::constant(0.0); 2]; 2]; N];
    if N == 1 {
        jacobian[0] = [g.map(|g| tau * way[0].by_pitch(g)), g.map(|g| tau * way[0].by_heading(g, angles[0]))];
        return (s, jacobian);
    }
    let mut g = g.map(|g| Axes { left: tau * g.left, ..g });
    for i in 0..N - 1 {
        let Angles { mut pitch, heading } = angles[i];
        if i == 0 {
            pitch = pitch.map(|part| tau * part);
        } else {
            g = g.map(|g| links[i].inward(g));
        }
        let [(left, l), (up, u)] = g.map(|g| way[i].pull(g, Angles { pitch, heading }));
        jacobian[i] = [[left[0], up[0]], [left[1], up[1]]];
        g = [l, u];
    }
    jacobian[N - 1] = tangents(&way[N - 1], angles[N - 1], &links[N - 1]).map(|tangent| g.map(|g| g.dot(tangent)));
    (s, jacobian)
}

/// Returns the derivatives by a joint's pitch and heading of the point that leaves through its link, in outer
/// components: 26 operations.
#[inline]
fn tangents<T: Number>(way: &TurnedBack<T>, angles: Angles<T>, link: &Link<T>) -> [Axes<T>; 2] {
    let TurnedBack { between, q } = *way;
    // ∂q / ∂pitch has no left component.
    let along = |axis: Axes<T>| axis.forward * q.up - axis.up * q.forward;
    let by_pitch = Axes { forward: along(link.forward), left: along(link.left), up: along(link.up) };
    let [sin, cos] = angles.pitch;
    let by_heading = Axes { forward: between.left * cos, left: -between.forward, up: -(between.left * sin) };
    [by_pitch, link.outward(by_heading)]
}
