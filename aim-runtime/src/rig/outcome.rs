//! [`Outcome`]: what a call achieved, judged by forward kinematics.

use glam::Quat;

/// What became of a call.
///
/// Angles and status are measured with the true forward kinematics of the pose, never with the solver's own model.
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_runtime::glam::{Affine3A, Vec3};
/// use aim_runtime::{Aim, Pose, Settings, Status};
///
/// let (mut turret, pose) = (Aim::<Turret>::new(), Pose::new([Affine3A::IDENTITY]));
/// let outcome = turret.aim(&pose, Vec3::new(0.1, 0.0, 3.0), 0.1, &Settings::default()).outcome;
/// assert_eq!(outcome.status, Status::Reached);
/// assert!(outcome.remaining < Settings::default().tolerance && outcome.aim > 0.999);
/// assert!(outcome.at_limit.is_empty() && outcome.recovering.is_empty());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Outcome {
    /// Cosine of [`remaining`](Self::remaining), −1…1; 0 where the call is degenerate.
    pub aim: f32,
    /// The angle between the effector's direction and the direction to the target, radians, 0…π; π/2 where the call
    /// is degenerate. With a [weight](crate::Settings::weight) below 1 the target is the weighted goal.
    pub remaining: f32,
    /// The turn that the body would have to make for the target's heading to come into reach, radians about up, positive to the
    /// left; 0 where its heading is within reach. Told by the [natural](crate::Solver::Natural) solver; 0 from the others.
    pub body_turn: f32,
    /// The time for which the target has been out of reach or behind, seconds. Told by the natural solver; 0 from the others.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub out_of_reach_for: f32,
    /// The same angle for the other eye, from its own origin; `None` where the pose has
    /// [no other eye](crate::Pose::with_other_eye), or the call is degenerate. [`remaining`](Self::remaining) is joint 0's
    /// own.
    pub other_eye_remaining: Option<f32>,
    /// The other eye's correction: what its bone's animated local rotation is multiplied by on the right. Unit to 1e-6; the
    /// exact identity at rest; `None` where the pose has no other eye.
    pub other_eye_correction: Option<Quat>,
    /// Whether the target is reached, and if not, why.
    pub status: Status,
    /// The joints that have an angle at (or past) an end of its range. Joint 0 stands for both eyes.
    pub at_limit: JointSet,
    /// The joints that have an angle outside its range, because the range moved: it goes back at its rate.
    pub recovering: JointSet,
}

/// Whether the target is reached; if not, the first reason that holds.
///
/// ```
/// use aim_runtime::Status;
///
/// fn mood(status: Status) -> &'static str {
///     match status {
///         Status::Reached | Status::RateLimited => "attentive",
///         Status::AtLimit | Status::Behind => "about to turn the body",
///         // Degenerate, and what later versions may tell.
///         _ => "as before",
///     }
/// }
/// assert_eq!(mood(Status::Behind), "about to turn the body");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Status {
    /// Forward kinematics puts the remaining angle within the tolerance: of the target, or of the weighted goal where
    /// the weight is below 1. With [two eyes](crate::Pose::with_other_eye), of both.
    Reached,
    /// There is nothing to aim: the pose or the target is not finite, a joint's scale is zero or flat, or the target
    /// lies on the effector. The angles hold.
    Degenerate,
    /// The target is behind the character, out of reach: the [policy](crate::Behind) for that is active.
    Behind,
    /// Out of reach of the ranges of motion, even if the joints had all the time they need. For the
    /// [natural](crate::Solver::Natural) solver: the target's heading or its elevation does not fit what ranges and
    /// [budgets](crate::Budgets) allow, though joints that trade one for the other may come nearer.
    AtLimit,
    /// On the way: within reach, as soon as the rates allow.
    RateLimited,
}

/// A set of joints, by their index from the effector inward. Joints from 64 on are not recorded.
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_runtime::glam::{Affine3A, Vec3};
/// use aim_runtime::{Aim, Pose, Settings, Status};
///
/// // Straight up, which is further than its pitch goes.
/// let aimed = Aim::<Turret>::new().snap(&Pose::new([Affine3A::IDENTITY]), Vec3::Y, &Settings::default());
/// assert_eq!(aimed.outcome.status, Status::AtLimit);
/// assert!(aimed.outcome.at_limit.contains(0) && aimed.outcome.at_limit.iter().eq([0]));
/// ```
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct JointSet(u64);

impl JointSet {
    /// The set without joints.
    pub const EMPTY: Self = Self(0);

    /// Whether the joint is in the set; false for indices from 64 on.
    #[must_use]
    pub const fn contains(self, joint: usize) -> bool {
        joint < 64 && self.0 >> joint & 1 == 1
    }

    /// Whether no joint is in the set.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many joints are in the set.
    #[must_use]
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The joints in the set, ascending.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..64).filter(move |&joint| self.contains(joint))
    }

    /// Whether a joint is to be in the set.
    #[inline(always)]
    pub(crate) fn set(&mut self, joint: usize, is_in: bool) {
        self.0 = self.0 & !(1 << joint) | u64::from(is_in) << joint;
    }

    pub(crate) fn insert(&mut self, joint: usize) {
        if joint < 64 {
            self.0 |= 1 << joint;
        }
    }
}

impl core::fmt::Debug for JointSet {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

/// Stored as the list of its joints.
#[cfg(feature = "serde")]
mod stored {
    use core::fmt;

    use serde::de::{self, SeqAccess, Visitor};
    use serde::ser::SerializeSeq;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::JointSet;

    impl Serialize for JointSet {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let mut sequence = serializer.serialize_seq(Some(self.len()))?;
            for joint in self.iter() {
                sequence.serialize_element(&joint)?;
            }
            sequence.end()
        }
    }

    struct Joints;

    impl<'de> Visitor<'de> for Joints {
        type Value = JointSet;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("indices of joints below 64")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<JointSet, A::Error> {
            let mut set = JointSet::EMPTY;
            while let Some(joint) = sequence.next_element::<usize>()? {
                if joint >= 64 {
                    return Err(de::Error::invalid_value(de::Unexpected::Unsigned(joint as u64), &self));
                }
                set.insert(joint);
            }
            Ok(set)
        }
    }

    impl<'de> Deserialize<'de> for JointSet {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_seq(Joints)
        }
    }
}
