//! One joint's aim and both derivatives, carefully optimised by hand: 46 operations.
//!
//! Only tests and benchmarks contain such code; the runtime's kernels are derived.

use crate::Float;
use crate::float::sin_cos;
use crate::pose::JointPose;

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of one joint, from its angles.
#[inline(always)]
pub fn joint<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    aim_gradient(&pose.link, &pose.target, &sin_cos(pose.angles))
}

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of one joint, from given sines and cosines.
#[inline(always)]
pub fn joint_given<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    aim_gradient(&pose.link, &pose.target, &pose.sin_cos)
}

/// Returns 1/length, or 0 if the length is not above the smallest allowed: the same guard as in the derived kernels.
#[inline(always)]
pub(crate) fn reciprocal<S: Float>(length: S) -> S {
    S::select_less(S::TINY, length, S::constant(1.0) / length, S::ZERO)
}

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of a joint with +X up, +Y forward, +Z left.
///
/// The target is rotated back into the space before the added rotation, in which the effector is fixed.
#[inline]
pub fn aim_gradient<S: Float>(link: &[S; 12], target: &[S; 3], sin_cos: &[S; 4]) -> [S; 3] {
    let [tx, ty, tz] = *target;
    let [sp, cp, sh, ch] = *sin_cos;
    // Undo heading, then pitch.
    let (w, z) = (ty * ch + tz * sh, tz * ch - ty * sh);
    let (x, y) = (tx * cp - w * sp, tx * sp + w * cp);
    // From the effector to the target.
    let (dx, dy, dz) = (x - link[9], y - link[10], z - link[11]);
    let r = reciprocal((dx * dx + dy * dy + dz * dz).sqrt());
    let (fx, fy, fz) = (link[3], link[4], link[5]);
    let aim = (fx * dx + fy * dy + fz * dz) * r;
    // ∂aim/∂d = (forward − aim·d/|d|)/|d|: the part of forward perpendicular to d. The last division follows at the
    // end.
    let k = aim * r;
    let (gx, gy, gz) = (fx - k * dx, fy - k * dy, fz - k * dz);
    let by_pitch = x * gy - y * gx;
    let by_heading = z * (cp * gy - sp * gx) - w * gz;
    [aim, by_pitch * r, by_heading * r]
}

/// Returns the aim alone, in 27 operations: the function that the central differences evaluate.
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
