//! [`AimOutcome`]: the result of a frame.

use std::fmt;

use aim::{Outcome, Status};
use bevy_ecs::component::Component;
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;

/// The outcome of a character's last frame.
#[derive(Component, Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Component, Default, Debug, PartialEq, Clone))]
pub struct AimOutcome {
    /// Result of the frame: reached, or the reason why not.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub status: AimStatus,
    /// Angle between the effector's direction and the target, radians; with a weight below 1, the angle to the weighted
    /// goal. 0 without a target. With two eyes this is the angle of joint 0, while [`status`](Self::status) considers
    /// both.
    pub remaining: f32,
    /// Turn that the body would have to make for the target to come into reach, radians, positive to the left: see
    /// [`Outcome::body_turn`].
    pub body_turn: f32,
    /// Complete outcome of the solver; `None` while the bones are not found.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub outcome: Option<Outcome>,
}

/// Status of a character's aim: the target is reached, or the reason why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimStatus {
    /// Nothing can be aimed yet, for this reason.
    Unbound(Unbound),
    /// There is no target: the character returns to its animation or already follows it.
    NoTarget,
    /// The target is reached: see [`Status::Reached`].
    Reached,
    /// The target is within reach, and the joints still move towards it: see [`Status::RateLimited`].
    RateLimited,
    /// The target is beyond the ranges of motion: see [`Status::AtLimit`].
    AtLimit,
    /// The target is behind the character and out of reach: see [`Status::Behind`].
    Behind,
    /// The pose or the target is not usable, for example not finite: see [`Status::Degenerate`].
    Degenerate,
}

/// Reason why nothing can be aimed. `Display` prints it in one line, with a remedy if there is one. Joints are counted
/// from the effector inward.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unbound {
    /// There are no bones below the entity yet.
    #[default]
    Bones,
    /// The rig is not loaded yet.
    Rig,
    /// No rig can be proposed for the skeleton: neither names nor roles identify an eye, a head, a neck or another part
    /// that points.
    Measurement,
    /// Several bones share a name that the measured rig needs, and no skin distinguishes them.
    Names,
    /// No bone has a name that the rig declares for this joint, or several do and each forms a chain with the other
    /// bones.
    Joint(usize),
    /// The bone of the previous joint is not a descendant of this joint's bone.
    Order(usize),
    /// No bone or more than one has the other eye's name, or the bone is a joint.
    OtherEye,
    /// A held bone does not exist, or is not a descendant of its joint's bone.
    Held,
    /// No bone or more than one has the trunk's name.
    Trunk,
    /// When it appeared, a bone's transform was not finite or its rotation was not a unit quaternion.
    RestPose,
    /// The entity or one of its ancestors has no `Transform`.
    Place,
}

impl fmt::Display for Unbound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bones => f.write_str("there are no bones below the entity yet; spawn its scene on it"),
            Self::Rig => f.write_str("the rig is not loaded yet, or could not be: see the log"),
            Self::Measurement => f.write_str(
                "nothing below the entity has the name of an eye, a head or a neck; declare a rig, \
                 as `aim rig FILE --chain a,b,c --format bevy` prints it",
            ),
            Self::Names => {
                f.write_str("several bones share a name that the measured rig needs; rename them in the file")
            }
            Self::Joint(joint) => write!(
                f,
                "joint {joint} has no bone, or several that may be meant; give its name or path with `with_bone`"
            ),
            Self::Order(joint) => {
                write!(f, "the bone of joint {} does not hang on that of joint {joint}", joint.saturating_sub(1))
            }
            Self::OtherEye => f.write_str(
                "the other eye has no bone, or several; give its name or path with `with_other_eye`, \
                 or leave it with `without_other_eye`",
            ),
            Self::Held => f.write_str("a bone to be held does not exist, or does not hang on its joint"),
            Self::Trunk => f.write_str("the trunk has no bone, or several; give its name or path with `with_trunk`"),
            Self::RestPose => f.write_str("a bone's transform is not finite, or its rotation no unit quaternion"),
            Self::Place => f.write_str("the entity, or one that it hangs on, has no `Transform`"),
        }
    }
}

impl Default for AimStatus {
    fn default() -> Self {
        Self::Unbound(Unbound::default())
    }
}

impl fmt::Display for AimStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unbound(why) => return why.fmt(f),
            Self::NoTarget => "there is nothing to look at",
            Self::Reached => "reached",
            Self::RateLimited => "on the way",
            Self::AtLimit => "out of reach",
            Self::Behind => "behind, out of reach",
            Self::Degenerate => "pose or target is not finite, or no place",
        })
    }
}

impl From<Status> for AimStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Reached => Self::Reached,
            Status::RateLimited => Self::RateLimited,
            Status::AtLimit => Self::AtLimit,
            Status::Behind => Self::Behind,
            _ => Self::Degenerate,
        }
    }
}

impl AimStatus {
    /// Returns `true` if the target is reached.
    #[must_use]
    pub fn is_reached(self) -> bool {
        self == Self::Reached
    }

    /// Returns `true` if the target is out of reach, in front or behind.
    #[must_use]
    pub fn is_out_of_reach(self) -> bool {
        matches!(self, Self::AtLimit | Self::Behind)
    }
}

impl AimOutcome {
    pub(crate) fn unbound(why: Unbound) -> Self {
        Self { status: AimStatus::Unbound(why), ..Self::default() }
    }

    pub(crate) fn of(outcome: Outcome, has_target: bool) -> Self {
        let (status, remaining) = match has_target {
            true => (outcome.status.into(), outcome.remaining),
            false => (AimStatus::NoTarget, 0.0),
        };
        Self { status, remaining, body_turn: outcome.body_turn, outcome: Some(outcome) }
    }
}
