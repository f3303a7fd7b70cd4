//! One joint's aim and both derivatives as someone who has thought about it writes them: 46 operations.
//!
//! Outside tests and benchmarks nothing like this exists: kernels are derived.

use crate::Float;
use crate::float::sin_cos;
use crate::pose::JointPose;

/// One joint, from its angles.
#[inline(always)]
pub fn joint<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    aim_gradient(&pose.link, &pose.target, &sin_cos(pose.angles))
}

/// One joint, sines and cosines given.
#[inline(always)]
pub fn joint_given<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    aim_gradient(&pose.link, &pose.target, &pose.sin_cos)
}

/// 1/length, 0 where that is too small: the policy of the derived kernels.
#[inline(always)]
pub(crate) fn reciprocal<S: Float>(length: S) -> S {
    S::select_less(S::TINY, length, S::constant(1.0) / length, S::ZERO)
}

/// Aim, ∂aim/∂pitch, ∂aim/∂heading of a joint with +X up, +Y forward, +Z left.
///
/// The target is turned back into the space before the added rotation; there the effector stands still.
#[inline]
pub fn aim_gradient<S: Float>(link: &[S; 12], target: &[S; 3], sin_cos: &[S; 4]) -> [S; 3] {
    let [tx, ty, tz] = *target;
    let [sp, cp, sh, ch] = *sin_cos;
    // Heading undone, then pitch.
    let (w, z) = (ty * ch + tz * sh, tz * ch - ty * sh);
    let (x, y) = (tx * cp - w * sp, tx * sp + w * cp);
    // From the effector to the target.
    let (dx, dy, dz) = (x - link[9], y - link[10], z - link[11]);
    let r = reciprocal((dx * dx + dy * dy + dz * dz).sqrt());
    let (fx, fy, fz) = (link[3], link[4], link[5]);
    let aim = (fx * dx + fy * dy + fz * dz) * r;
    // The part of forward across the way to the target; 1/length follows at the end.
    let k = aim * r;
    let (gx, gy, gz) = (fx - k * dx, fy - k * dy, fz - k * dz);
    let by_pitch = x * gy - y * gx;
    let by_heading = z * (cp * gy - sp * gx) - w * gz;
    [aim, by_pitch * r, by_heading * r]
}

/// Aim alone, 27 operations: what central differences are taken of.
#[inline]
pub fn aim<S: Float>(link: &[S; 12], target: &[S; 3], sin_cos: &[S; 4]) -> S {
    let [tx, ty, tz] = *target;
    let [sp, cp, sh, ch] = *sin_cos;
    let (w, z) = (ty * ch + tz * sh, tz * ch - ty * sh);
    let (x, y) = (tx * cp - w * sp, tx * sp + w * cp);
    let (dx, dy, dz) = (x - link[9], y - link[10], z - link[11]);
    let r = reciprocal((dx * dx + dy * dy + dz * dz).sqrt());
    (link[3] * dx + link[4] * dy + link[5] * dz) * r
}
