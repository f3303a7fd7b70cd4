//! Points one bone along a direction: eyeballs, cameras, barrels. The cross product gives the axis of the turn; the
//! remaining freedom is the roll about the direction.

use glam::{Affine3A, Quat, Vec3};

use crate::math::trig::sin_cos;
use crate::math::turn::{across, between, normalized, part, shortest};
use crate::math::{self, angle_between, direction, product, turned};

/// Rule for the bone's roll about the direction that it points along.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Roll {
    /// The roll that results from the shortest turn between the old and the new direction.
    #[default]
    Shortest,
    /// The roll that brings a direction of the bone as near as possible to a direction in the space of the bone's
    /// transform.
    Up {
        /// The bone's direction, in its own space, of any length.
        bone: Vec3,
        /// The direction to approach, in the space of the bone's transform, of any length.
        space: Vec3,
    },
}

/// Solver that points a single bone along a direction.
///
/// ```
/// use aim_runtime::glam::{Affine3A, Quat, Vec3};
/// use aim_runtime::ik::{OneBone, OneBoneStatus, Roll};
///
/// let camera = Affine3A::from_rotation_x(0.4);
/// let level = OneBone::new(Vec3::NEG_Z).with_roll(Roll::Up { bone: Vec3::Y, space: Vec3::Y });
/// let outcome = level.solve(&camera, Vec3::new(1.0, 0.5, -2.0));
/// assert_eq!(outcome.status, OneBoneStatus::Reached);
/// // Its side is level.
/// let side = outcome.turn * camera.transform_vector3(Vec3::X);
/// assert!(side.y.abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OneBone {
    /// The direction to point, in the bone's own space, of any length.
    pub axis: Vec3,
    /// Rule for the roll about the direction. Default [`Roll::Shortest`].
    pub roll: Roll,
    /// Additional roll about the direction, radians, by the right-hand rule. Default 0.
    pub roll_rad: f32,
    /// Fraction of the whole turn that is applied, 0…1. Values outside are clamped, NaN counts as 0. Default 1.
    pub weight: f32,
}

/// Result of [`OneBone::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneBoneOutcome {
    /// Rotation to apply before the bone's rotation in its space: `turn * animated`. Unit and finite.
    pub turn: Quat,
    /// Remaining angle between the bone's axis and the direction, radians, 0…π; π/2 for a degenerate call.
    pub remaining_rad: f32,
    /// `Reached` if the bone points along the direction, otherwise the reason why not.
    pub status: OneBoneStatus,
}

/// Status of a [`OneBone`] turn: success, or the reason why the bone does not point along its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OneBoneStatus {
    /// The bone points along the direction, with the requested roll.
    Reached,
    /// The bone points along the direction with the roll of the shortest turn, because the requested roll is undefined:
    /// in [`Roll::Up`], `bone` is parallel to the pointed axis, or `space` to the direction.
    RollUndefined,
    /// A weight below 1 left part of the angle.
    Partial,
    /// An input is not finite or has no direction. Nothing is turned.
    Degenerate,
}

/// Remaining angle up to which the bone counts as pointing along the direction, radians.
const MET_RAD: f32 = 1e-5;

impl OneBone {
    /// Creates a solver that points `axis`, a direction of the bone's own space, by the shortest turn.
    #[must_use]
    pub const fn new(axis: Vec3) -> Self {
        Self { axis, roll: Roll::Shortest, roll_rad: 0.0, weight: 1.0 }
    }

    /// Sets the [roll rule](Self::roll).
    #[must_use]
    pub const fn with_roll(mut self, roll: Roll) -> Self {
        self.roll = roll;
        self
    }

    /// Sets the [additional roll](Self::roll_rad), radians.
    #[must_use]
    pub const fn with_roll_by(mut self, roll_rad: f32) -> Self {
        self.roll_rad = roll_rad;
        self
    }

    /// Sets the [`weight`](Self::weight), 0…1.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// Returns the turn that points `bone`'s axis along `to`, a direction of any length in the space of the bone's
    /// transform.
    ///
    /// To point at a target, pass the direction from the bone's origin to it. Mirrored and scaled bones are supported.
    #[must_use]
    pub fn solve(&self, bone: &Affine3A, to: Vec3) -> OneBoneOutcome {
        self.turned(bone, to).unwrap_or(OneBoneOutcome {
            turn: Quat::IDENTITY,
            remaining_rad: math::UNDEFINED_RAD,
            status: OneBoneStatus::Degenerate,
        })
    }

    fn turned(&self, bone: &Affine3A, to: Vec3) -> Option<OneBoneOutcome> {
        let in_space = |v: Vec3| direction(bone.matrix3 * direction(v.into())?);
        let (from, to) = (in_space(self.axis)?, direction(to.into())?);
        let (mut turn, mut status) = (shortest(from, to), OneBoneStatus::Reached);
        if let Roll::Up { bone, space } = self.roll {
            let sides = in_space(bone).and_then(|up| across(up, from)).zip(across(space.into(), to));
            match sides {
                Some((from_up, to_up)) => turn = between([from, from_up], [to, to_up]),
                None => status = OneBoneStatus::RollUndefined,
            }
        }
        if self.roll_rad != 0.0 && self.roll_rad.is_finite() {
            let up = to.any_orthonormal_vector();
            let (sin, cos) = sin_cos(self.roll_rad);
            let rolled = up * cos + math::cross(to, up) * sin;
            turn = normalized(product(between([to, up], [to, rolled]), turn));
        }
        // NaN counts as 0.
        let weight = self.weight.max(0.0).min(1.0);
        if weight < 1.0 {
            turn = part(turn, weight);
        }
        let remaining_rad = angle_between(turned(turn, from), to);
        if !(remaining_rad <= MET_RAD) {
            status = OneBoneStatus::Partial;
        }
        Some(OneBoneOutcome { turn, remaining_rad, status })
    }
}
