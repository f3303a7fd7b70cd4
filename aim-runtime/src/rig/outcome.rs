//! [`Outcome`]: the result of a call, measured by forward kinematics.

use glam::Quat;

/// Measured result of a call.
///
/// Angles and status are measured with the true forward kinematics of the pose, not with the solver's model.
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
    /// Cosine of [`remaining`](Self::remaining), −1…1; 0 for a degenerate call.
    pub aim: f32,
    /// Angle between the effector's direction and the direction to the target, radians, 0…π; π/2 for a degenerate call.
    /// With a [weight](crate::Settings::weight) below 1 it is measured to the weighted goal.
    pub remaining: f32,
    /// Turn that the body would need for the target's heading to come within reach, radians about up, positive to the
    /// left; 0 if the heading is within reach. Set by the [natural](crate::Solver::Natural) solver; 0 from the others.
    pub body_turn: f32,
    /// Time for which the target has been out of reach or behind, seconds. Set by the [natural](crate::Solver::Natural)
    /// solver; 0 from the others.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub out_of_reach_for: f32,
    /// Remaining angle of the other eye, measured from its own origin, radians, 0…π; [`remaining`](Self::remaining) is
    /// joint 0's. `None` if the pose has [no other eye](crate::Pose::with_other_eye) or the call is degenerate.
    pub other_eye_remaining: Option<f32>,
    /// Correction of the other eye: multiply its bone's animated local rotation by it on the right. Unit to 1e-6;
    /// exactly the identity at rest. `None` if the pose has no other eye.
    pub other_eye_correction: Option<Quat>,
    /// `Reached` if the target is reached, otherwise the reason why not.
    pub status: Status,
    /// Joints with an angle at or past an end of its range. Joint 0 stands for both eyes.
    pub at_limit: JointSet,
    /// Joints with an angle outside its range, because the range moved. The angle returns at its rate.
    pub recovering: JointSet,
}

/// Status of a call: success, or the first applicable reason why the target is not reached.
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
    /// The remaining angle is within the tolerance: to the target, or to the weighted goal if the weight is below 1.
    /// With [two eyes](crate::Pose::with_other_eye), for both.
    Reached,
    /// There is nothing to aim, and the angles stay as they are: the pose or the target is not finite, a joint's scale
    /// is zero or flat, the target is at the effector, or the number of joints does not match.
    Degenerate,
    /// The target is behind the character and out of reach: the [policy](crate::Behind) for that is active.
    Behind,
    /// The target is out of reach of the ranges of motion, however long the joints take. For the
    /// [natural](crate::Solver::Natural) solver: the target's heading or elevation exceeds what ranges and
    /// [budgets](crate::Budgets) allow, although trading one for the other might bring the gaze nearer.
    AtLimit,
    /// The target is within reach, but the rates have not let the joints arrive yet.
    RateLimited,
}

/// A set of joints, stored by index. In an [`Outcome`], indices count from the effector inward. Indices from 64 on are
/// ignored.
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
    /// The empty set.
    pub const EMPTY: Self = Self(0);

    /// Returns `true` if the joint is in the set; `false` for indices from 64 on.
    #[must_use]
    pub const fn contains(self, joint: usize) -> bool {
        joint < 64 && self.0 >> joint & 1 == 1
    }

    /// Returns `true` if the set is empty.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns the number of joints in the set.
    #[must_use]
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Returns the joints in the set, in ascending order.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..64).filter(move |&joint| self.contains(joint))
    }

    /// Adds or removes a joint; its index must be below 64.
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

/// Serialises a [`JointSet`] as the list of its joints.
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
