//! [`AimOutcome`]: what became of a frame.

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
    /// Whether the target is reached, and if not, why.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub status: AimStatus,
    /// The angle that remains to the target, radians; with a weight below 1 that to the weighted goal. 0 where nothing is
    /// aimed at. It is joint 0's, while the status tells of both eyes.
    pub remaining: f32,
    /// The turn, radians to the left, that the body would have to make for the target to come into reach: see
    /// [`Outcome::body_turn`].
    pub body_turn: f32,
    /// All that the solver says; `None` while the bones are not found.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub outcome: Option<Outcome>,
}

/// Whether a character's target is reached, and if not, why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimStatus {
    /// Nothing can be aimed yet.
    Unbound(Unbound),
    /// There is nothing to look at: the character returns to its animation, or has.
    NoTarget,
    /// See [`Status::Reached`].
    Reached,
    /// On the way: see [`Status::RateLimited`].
    RateLimited,
    /// Out of reach: see [`Status::AtLimit`].
    AtLimit,
    /// Behind, out of reach: see [`Status::Behind`].
    Behind,
    /// Pose or target are no place: see [`Status::Degenerate`].
    Degenerate,
}

/// Why nothing can be aimed; `Display` says it in a line, with what to do. Joints are counted from the effector inward.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unbound {
    /// There are no bones below the entity yet.
    #[default]
    Bones,
    /// The rig is not loaded yet.
    Rig,
    /// No rig can be proposed for the skeleton: neither names nor roles tell an eye, a head, a neck or anything that points.
    Measurement,
    /// Several bones share the name of a joint of the measured rig, and no skin tells them apart.
    Names,
    /// No bone has a name that the rig declares for this joint, or several have it that make a chain with the others.
    Joint(usize),
    /// The bone of the joint before this one does not hang on this one's.
    Order(usize),
    /// No bone, or more than one, has the other eye's name; or it is a joint.
    OtherEye,
    /// A bone to be held does not exist, or does not hang on its joint.
    Held,
    /// No bone has the trunk's name, or several have it.
    Trunk,
    /// A bone's transform was not finite, or its rotation no unit quaternion, when it appeared.
    RestPose,
    /// The entity, or one that it hangs on, has no `Transform`.
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
    /// Whether the target is reached.
    #[must_use]
    pub fn is_reached(self) -> bool {
        self == Self::Reached
    }

    /// Whether the target is out of reach.
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
