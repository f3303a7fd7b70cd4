//! A chain's gradient and Jacobian by hand, in reverse mode: one pass takes the target from the root to the effector, a
//! second one takes covectors back from the effector to the root.

use crate::Float;
use crate::by_hand::reciprocal;
use crate::float::sin_cos;
use crate::pose::ChainPose;

/// Returns the chain's aim and six derivatives, from its angles.
#[inline(always)]
pub fn gradient<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    value_gradient(&pose.links, &pose.target, &pose.angles.map(sin_cos))
}

/// Returns the chain's aim and six derivatives, from given sines and cosines.
#[inline(always)]
pub fn gradient_given<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    value_gradient(&pose.links, &pose.target, &pose.sin_cos)
}

/// Returns the chain's residual and Jacobian, from its angles.
#[inline(always)]
pub fn jacobian<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    residual_jacobian(&pose.links, &pose.target, &pose.angles.map(sin_cos))
}

/// Returns the chain's residual and Jacobian, from given sines and cosines.
#[inline(always)]
pub fn jacobian_given<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    residual_jacobian(&pose.links, &pose.target, &pose.sin_cos)
}

/// Intermediate results of one joint in the first pass: `w` after the heading is undone, `q` the target after both
/// angles are undone.
#[derive(Clone, Copy)]
struct Turned<S> {
    w: S,
    q: [S; 3],
}

/// Runs the first pass. Returns the vector from the effector to the target, in joint 0's space before its added
/// rotation, and each joint's intermediate results.
#[inline(always)]
fn inward<S: Float>(links: &[[S; 12]; 3], target: &[S; 3], sin_cos: &[[S; 4]; 3]) -> ([S; 3], [Turned<S>; 3]) {
    let mut seen = [Turned { w: S::ZERO, q: [S::ZERO; 3] }; 3];
    let mut point = *target;
    for i in (0..3).rev() {
        let [tx, ty, tz] = point;
        let [sp, cp, sh, ch] = sin_cos[i];
        let (w, z) = (ty * ch + tz * sh, tz * ch - ty * sh);
        let q = [tx * cp - w * sp, tx * sp + w * cp, z];
        seen[i] = Turned { w, q };
        let m = &links[i];
        let d = [q[0] - m[9], q[1] - m[10], q[2] - m[11]];
        point = if i == 0 { d } else { [dot(row(m, 0), d), dot(row(m, 1), d), dot(row(m, 2), d)] };
    }
    (point, seen)
}

/// Runs the second pass. Returns the derivatives by pitch and heading of every joint, for a function whose gradient by
/// the vector `d` at the effector is `g`.
#[inline(always)]
fn outward<S: Float>(g: [S; 3], links: &[[S; 12]; 3], sin_cos: &[[S; 4]; 3], seen: &[Turned<S>; 3]) -> [S; 6] {
    let mut derivatives = [S::ZERO; 6];
    let mut g = g;
    for i in 0..3 {
        let [sp, cp, sh, ch] = sin_cos[i];
        let Turned { w, q: [x, y, z] } = seen[i];
        let [gx, gy, gz] = g;
        let gw = cp * gy - sp * gx;
        derivatives[2 * i] = x * gy - y * gx;
        derivatives[2 * i + 1] = z * gw - w * gz;
        if i < 2 {
            let (gx, gy, gz) = (cp * gx + sp * gy, ch * gw - sh * gz, sh * gw + ch * gz);
            let m = &links[i + 1];
            g = std::array::from_fn(|k| gx * m[k] + gy * m[3 + k] + gz * m[6 + k]);
        }
    }
    derivatives
}

#[inline(always)]
fn row<S: Float>(m: &[S; 12], i: usize) -> [S; 3] {
    [m[3 * i], m[3 * i + 1], m[3 * i + 2]]
}

#[inline(always)]
fn dot<S: Float>(a: [S; 3], b: [S; 3]) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the chain's aim, then its derivatives, joint by joint from the effector inward, pitch before heading.
#[inline]
pub fn value_gradient<S: Float>(links: &[[S; 12]; 3], target: &[S; 3], sin_cos: &[[S; 4]; 3]) -> [S; 7] {
    let (d, seen) = inward(links, target, sin_cos);
    let f = row(&links[0], 1);
    let r = reciprocal(dot(d, d).sqrt());
    let aim = dot(f, d) * r;
    let k = aim * r;
    let g = std::array::from_fn(|i| (f[i] - k * d[i]) * r);
    let [a, b, c, d, e, f] = outward(g, links, sin_cos, &seen);
    [aim, a, b, c, d, e, f]
}

/// Returns the stereographic residual (left, up), then the six derivatives of the first and of the second.
#[inline]
pub fn residual_jacobian<S: Float>(links: &[[S; 12]; 3], target: &[S; 3], sin_cos: &[[S; 4]; 3]) -> [S; 14] {
    let (d, seen) = inward(links, target, sin_cos);
    let f = row(&links[0], 1);
    let length = dot(d, d).sqrt();
    let r = reciprocal(length);
    let u = reciprocal(length + dot(f, d));
    let two_u = u + u;
    // The gradient of the denominator |d| + f·d.
    let below: [S; 3] = std::array::from_fn(|i| d[i] * r + f[i]);
    let of = |axis: [S; 3]| {
        let s = two_u * dot(axis, d);
        let k = s * u;
        let g = std::array::from_fn(|i| two_u * axis[i] - k * below[i]);
        (s, outward(g, links, sin_cos, &seen))
    };
    let (left, by_left) = of(row(&links[0], 2));
    let (up, by_up) = of(row(&links[0], 0));
    let mut out = [S::ZERO; 14];
    (out[0], out[1]) = (left, up);
    out[2..8].copy_from_slice(&by_left);
    out[8..].copy_from_slice(&by_up);
    out
}

/// Returns the chain's aim alone: the function that the central differences evaluate.
#[inline]
pub fn aim<S: Float>(links: &[[S; 12]; 3], target: &[S; 3], sin_cos: &[[S; 4]; 3]) -> S {
    let (d, _) = inward(links, target, sin_cos);
    dot(row(&links[0], 1), d) * reciprocal(dot(d, d).sqrt())
}

/// Returns the chain's residual alone: the function that the central differences evaluate.
#[inline]
pub fn residual<S: Float>(links: &[[S; 12]; 3], target: &[S; 3], sin_cos: &[[S; 4]; 3]) -> [S; 2] {
    let (d, _) = inward(links, target, sin_cos);
    let u = reciprocal(dot(d, d).sqrt() + dot(row(&links[0], 1), d));
    let two_u = u + u;
    [two_u * dot(row(&links[0], 2), d), two_u * dot(row(&links[0], 0), d)]
}
