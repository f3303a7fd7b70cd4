//! [`Comparison`] of the rotations that the bones actually received with the corrections.
//!
//! Let `P` be a joint's animated global transform and `A` the applied one, `P'` and `A'` those of the next joint
//! inward. Bones between the two are unknown but assumed unmoved. Then the joint added the rotation `(A' P'⁻¹ P)⁻¹ A`
//! in its own space, which equals its correction in a correct setup. The space of the applied joints cancels, except
//! for the innermost joint.

use glam::{Affine3A, Mat3A, Quat, Vec3A};

use crate::kinematics::chain;
use crate::math;

/// Error from which a joint counts as wrong, radians: 0.1°.
pub(super) const WRONG_RAD: f32 = 2e-3;
/// Displacement from which a joint counts as out of place, as a fraction of the chain's length.
const OUT_OF_PLACE: f32 = 2e-3;
/// Rounding error of coordinates, relative to their size.
const ROUNDING: f32 = 4e-6;

/// Values in pose order, read forward or in reverse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ordered<'a, T> {
    values: &'a [T],
    reversed: bool,
}

impl<'a, T: Copy> Ordered<'a, T> {
    pub(super) fn new(values: &'a [T]) -> Self {
        Self { values, reversed: false }
    }

    /// Returns the same values in opposite order if `reversed`.
    pub(super) fn reversed(self, reversed: bool) -> Self {
        Self { reversed: self.reversed != reversed, ..self }
    }

    pub(super) fn get(&self, index: usize) -> T {
        self.values[if self.reversed { self.values.len() - 1 - index } else { index }]
    }
}

/// A pose, its corrections and the applied joints, all of the same length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Comparison<'a> {
    pose: Ordered<'a, Affine3A>,
    applied: Ordered<'a, Affine3A>,
    corrections: Ordered<'a, Quat>,
    /// Displacement that is still tolerated: the invisible part, plus rounding far from the origin.
    slack: f32,
    is_in_place: bool,
}

impl<'a> Comparison<'a> {
    /// Creates a comparison. Needs at least one joint, slices of equal length, and transforms that are finite and
    /// invertible.
    pub(super) fn new(
        pose: Ordered<'a, Affine3A>,
        applied: Ordered<'a, Affine3A>,
        corrections: Ordered<'a, Quat>,
    ) -> Self {
        let mut comparison = Self { pose, applied, corrections, slack: 0.0, is_in_place: false };
        comparison.slack = comparison.slack();
        comparison.is_in_place = comparison.is_in_place();
        comparison
    }

    /// Returns a comparison with other applied joints.
    pub(super) fn with_applied(&self, applied: &'a [Affine3A]) -> Self {
        Self::new(self.pose, Ordered::new(applied), self.corrections)
    }

    /// Returns the comparison for a pose in opposite order, optionally with corrections and applied joints reversed
    /// too.
    pub(super) fn reversed(&self, corrections: bool, applied: bool) -> Self {
        Self::new(self.pose.reversed(true), self.applied.reversed(applied), self.corrections.reversed(corrections))
    }

    pub(super) fn count(&self) -> usize {
        self.pose.values.len()
    }

    pub(super) fn correction(&self, joint: usize) -> Quat {
        self.corrections.get(joint)
    }

    /// Returns the innermost joint's animated and applied transforms.
    fn innermost(&self) -> [Affine3A; 2] {
        let last = self.count() - 1;
        [self.pose.get(last), self.applied.get(last)]
    }

    fn slack(&self) -> f32 {
        let [pose, applied] = self.innermost();
        let axis = math::length(applied.matrix3.x_axis);
        let scale = axis / math::length(pose.matrix3.x_axis);
        let (mut size, mut farthest) = (0.0, 0.0_f32);
        for joint in 0..self.count() {
            let place = self.applied.get(joint).translation;
            if joint > 0 {
                size += (place - self.applied.get(joint - 1).translation).length();
            }
            farthest = farthest.max(place.length() + scale * self.pose.get(joint).translation.length());
        }
        // For a chain of length zero, the length of a bone's axis takes its place.
        OUT_OF_PLACE * if size > 1e-6 * axis { size } else { axis } + ROUNDING * farthest
    }

    /// Returns `true` if pose and applied joints are in the same space. Test: no correction moves or scales the
    /// innermost joint's origin.
    fn is_in_place(&self) -> bool {
        let [pose, applied] = self.innermost();
        let scale = 1.0 / math::length(pose.matrix3.x_axis);
        let [volume, applied_volume] = [pose, applied].map(|joint| {
            let Mat3A { x_axis, y_axis, z_axis } = joint.matrix3 * scale;
            math::cross(x_axis, y_axis).dot(z_axis)
        });
        let is_as_large = (0.97..1.03).contains(&(applied_volume / volume));
        is_as_large && (applied.translation - pose.translation).length() <= self.slack
    }

    /// Returns the joint's expected and actual offset from the next joint inward, in the applied space.
    fn link(&self, joint: usize) -> [Vec3A; 2] {
        let [pose, next_pose] = [joint, joint + 1].map(|joint| self.pose.get(joint));
        let [applied, next_applied] = [joint, joint + 1].map(|joint| self.applied.get(joint));
        let local = linear_inverse(&next_pose.matrix3) * (pose.translation - next_pose.translation);
        [next_applied.matrix3 * local, applied.translation - next_applied.translation]
    }

    /// Returns `true` if pose and applied joints are in the same space.
    pub(super) fn shares_space(&self) -> bool {
        self.is_in_place
    }

    /// Returns the transform from the pose's space to the applied joints' space, assuming that the innermost joint
    /// added `correction`.
    pub(super) fn space(&self, correction: Quat) -> Affine3A {
        if self.is_in_place {
            return Affine3A::IDENTITY;
        }
        let [pose, applied] = self.innermost();
        let matrix3 = applied.matrix3 * linear_inverse(&(pose.matrix3 * Mat3A::from_quat(correction)));
        Affine3A { matrix3, translation: applied.translation - matrix3 * pose.translation }
    }

    /// Returns the rotation that a joint actually added, in its own space. `None` for the innermost joint if pose and
    /// applied joints are in different spaces.
    pub(super) fn observed(&self, joint: usize) -> Option<Mat3A> {
        let (pose, applied) = (self.pose.get(joint).matrix3, self.applied.get(joint).matrix3);
        let unturned = if joint + 1 < self.count() {
            let outward = linear_inverse(&self.pose.get(joint + 1).matrix3) * pose;
            self.applied.get(joint + 1).matrix3 * outward
        } else if self.is_in_place {
            pose
        } else {
            return None;
        };
        Some(linear_inverse(&unturned) * applied)
    }

    /// Returns the largest error over all joints. A joint's error is the smaller of `error` for its observed rotation
    /// and the error against its own correction, because a mistake may affect only some joints.
    pub(super) fn error(&self, error: impl Fn(usize, &Mat3A) -> f32) -> f32 {
        let errors = (0..self.count()).map(|joint| {
            let Some(turn) = self.observed(joint) else { return 0.0 };
            turn_error(&turn, self.corrections.get(joint)).min(error(joint, &turn))
        });
        largest(errors)
    }

    /// Returns the largest displacement of a joint from the place that its parent implies, scaled so that the tolerated
    /// displacement is [`WRONG_RAD`].
    pub(super) fn shift_error(&self) -> f32 {
        let shifts = (1..self.count()).map(|next| {
            let [expected, seen] = self.link(next - 1);
            WRONG_RAD * (expected - seen).length() / self.slack
        });
        largest(shifts)
    }

    /// Returns the error under the assumption of a correct setup: each joint has its correction and its place.
    pub(super) fn right_error(&self) -> f32 {
        self.error(|_, _| f32::INFINITY).max(self.shift_error())
    }

    /// Returns the error under the assumption that each joint's global rotation was multiplied by its correction, on
    /// either side. Ignores positions.
    pub(super) fn onto_global_error(&self) -> f32 {
        let count = self.count();
        let space = self.space(self.corrections.get(count - 1)).matrix3;
        let globals = |joint| [space * self.pose.get(joint).matrix3, self.applied.get(joint).matrix3];
        let right = largest((0..count).map(|joint| {
            let [pose, applied] = globals(joint);
            turn_error(&(linear_inverse(&pose) * applied), self.corrections.get(joint))
        }));
        let left = largest((0..count).map(|joint| {
            let [pose, applied] = globals(joint);
            turn_error(&(applied * linear_inverse(&pose)), self.corrections.get(joint))
        }));
        right.min(left)
    }

    /// Returns the error under the assumption that the pose held local transforms, with each joint's bone a direct
    /// child of the next one's.
    pub(super) fn local_error(&self) -> f32 {
        if self.count() < 2 {
            return f32::INFINITY;
        }
        largest((1..self.count()).map(|next| {
            let (local, parent) = (self.pose.get(next - 1), self.applied.get(next).matrix3);
            let turn = linear_inverse(&(parent * local.matrix3)) * self.applied.get(next - 1).matrix3;
            let shift = (parent * local.translation - self.link(next - 1)[1]).length();
            turn_error(&turn, self.corrections.get(next - 1)).max(WRONG_RAD * shift / self.slack)
        }))
    }

    /// Returns `true` if the pose's origins may be offsets from parents: none is much longer than the corresponding
    /// link of the applied chain.
    pub(super) fn has_short_origins(&self) -> bool {
        (1..self.count()).all(|next| {
            let offset = self.applied.get(next).matrix3 * self.pose.get(next - 1).translation;
            offset.length() <= 1.5 * self.link(next - 1)[1].length()
        })
    }
}

/// Returns the largest error; NaN counts as infinite.
fn largest(errors: impl Iterator<Item = f32>) -> f32 {
    errors.fold(0.0, |largest, error| largest.max(if error.is_nan() { f32::INFINITY } else { error }))
}

/// Returns the distance of a linear map from a rotation, `‖A − B‖ / √2` (Frobenius norm). Between two rotations that is
/// `2 sin(angle / 2)`.
pub(super) fn turn_error(turn: &Mat3A, expected: Quat) -> f32 {
    let Mat3A { x_axis: x, y_axis: y, z_axis: z } = *turn - Mat3A::from_quat(expected);
    math::sqrt(0.5 * (x.dot(x) + y.dot(y) + z.dot(z)))
}

/// Returns the inverse of an invertible matrix of any scale.
pub(super) fn linear_inverse(matrix: &Mat3A) -> Mat3A {
    chain::inverse(&Affine3A { matrix3: *matrix, translation: Vec3A::ZERO }).matrix3
}
