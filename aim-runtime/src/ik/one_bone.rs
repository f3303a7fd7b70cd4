//! One bone along a direction: eyeballs, cameras, barrels; the cross product gives the axis, and what is left is its roll.

use glam::{Affine3A, Quat, Vec3};

use crate::math::trig::sin_cos;
use crate::math::turn::{across, between, normalized, part, shortest};
use crate::math::{self, angle_between, direction, product, turned};

/// What decides how a bone is rolled about the direction it is pointed along.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Roll {
    /// The shortest turn from where the bone points to where it shall.
    #[default]
    Shortest,
    /// A direction of the bone's own space lies as near as it can to a direction in the space of the bone's transform.
    Up {
        /// In the bone's own space.
        bone: Vec3,
        /// In the space that the bone stands in.
        space: Vec3,
    },
}

/// The solver of a single bone.
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
    /// What is pointed: a direction of the bone's own space, of any length.
    pub axis: Vec3,
    /// What decides the roll. Default [`Roll::Shortest`].
    pub roll: Roll,
    /// Turns the bone about the direction beyond that, radians, by the right-hand rule. Default 0.
    pub roll_rad: f32,
    /// How much of it all is applied, 0…1, as a part of the turn. Default 1.
    pub weight: f32,
}

/// What became of a call of [`OneBone::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneBoneOutcome {
    /// Goes before the bone's rotation in its space: `turn * animated`. Unit and finite.
    pub turn: Quat,
    /// The angle left between the bone's axis and the direction, radians, 0…π; π/2 where the call is degenerate.
    pub remaining_rad: f32,
    /// Whether the bone points there, and if not, why.
    pub status: OneBoneStatus,
}

/// Whether a bone points along its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OneBoneStatus {
    /// It does, rolled as was asked for.
    Reached,
    /// It does, but what should be up lies along the direction: the roll is that of the shortest turn.
    RollUndefined,
    /// A weight below 1 left a part of the way.
    Partial,
    /// Something is no number, or has no direction: nothing is turned.
    Degenerate,
}

/// What counts as pointing there, radians.
const MET_RAD: f32 = 1e-5;

impl OneBone {
    /// Pointing this direction of the bone's own space by the shortest turn.
    #[must_use]
    pub const fn new(axis: Vec3) -> Self {
        Self { axis, roll: Roll::Shortest, roll_rad: 0.0, weight: 1.0 }
    }

    /// Rolled like this.
    #[must_use]
    pub const fn with_roll(mut self, roll: Roll) -> Self {
        self.roll = roll;
        self
    }

    /// Turned further about the direction, radians.
    #[must_use]
    pub const fn with_roll_by(mut self, roll_rad: f32) -> Self {
        self.roll_rad = roll_rad;
        self
    }

    /// Applied in part, 0…1.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// Points `bone`'s axis along `to`, a direction of any length in the space of the bone's transform.
    ///
    /// To point at a target, take the direction from the bone's origin to it. A mirrored or scaled bone is pointed just as
    /// well.
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
