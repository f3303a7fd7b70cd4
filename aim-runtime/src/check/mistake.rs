//! [`Mistake`] and [`Finding`]: the results of a check, with messages that say what to do.

use core::fmt;

use crate::JointSet;

/// A mistake in passing a pose or target, or in applying corrections.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Mistake {
    /// The pose held local transforms.
    LocalPose,
    /// The target was in another space than the pose.
    TargetSpace,
    /// The target was in another unit of length than the pose.
    TargetUnit,
    /// The joints were passed root first instead of from the effector inward.
    JointOrder,
    /// The inverses of the corrections were applied.
    Inverted,
    /// Corrections were not applied.
    Forgotten,
    /// Corrections were multiplied on the left: each joint turns by the right angle, about another axis.
    Premultiplied,
    /// Corrections were applied to the wrong joints.
    WrongJoints,
    /// Corrections were applied twice.
    AppliedTwice,
    /// `dt` was passed in milliseconds.
    Milliseconds,
    /// Corrections were multiplied onto global rotations, without carrying the joints further out along.
    OntoGlobal,
    /// The pose contained the corrections of the previous frame.
    Feedback,
    /// The applied joints show the corrections of the previous call.
    Late,
    /// The applied joints differ from the corrected pose, and no other mistake in this list explains the difference.
    Unexplained,
}

/// Describes the observation and how to fix it.
impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LocalPose => {
                "The pose seems to hold local transforms: pass each joint's global transform, in model or world \
                 space."
            }
            Self::TargetSpace => {
                "The target that was passed is not in the pose's space: pass both in world space, or both in the \
                 character's; the pose must hold global transforms."
            }
            Self::TargetUnit => {
                "The target that was passed is in another unit of length than the pose: convert one to the other's."
            }
            Self::JointOrder => {
                "The joints were passed root first: pass them from the effector inward, and apply the corrections in \
                 the same order."
            }
            Self::Inverted => {
                "The corrections were applied inverted: multiply by the correction itself, not by its inverse."
            }
            Self::Forgotten => {
                "Corrections do not show in the applied pose: write them to the bones after the animation and before \
                 global transforms are computed, and pass the pose without them."
            }
            Self::Premultiplied => {
                "Joints turned by the right angles about wrong axes: multiply the correction on the right, `local * \
                 correction`, and keep its components as they are."
            }
            Self::WrongJoints => {
                "Corrections were applied to the wrong joints: they come in the order of the rig, from the effector \
                 inward."
            }
            Self::AppliedTwice => {
                "The corrections were applied twice: multiply each animated local rotation by its correction once a \
                 frame."
            }
            Self::Milliseconds => {
                "Two frames in a row took a second or longer: `dt` counts in seconds, not in milliseconds."
            }
            Self::OntoGlobal => {
                "The corrections were multiplied onto global rotations, each joint by itself: multiply local \
                 rotations, so that each joint carries those that hang on it."
            }
            Self::Feedback => {
                "The pose already contains the corrections of the frame before: let the animation write the bones \
                 again (restore those that it does not key), and read the pose before corrections are applied."
            }
            Self::Late => {
                "The applied pose shows the corrections of the call before: read it after the engine has computed \
                 the global transforms of this frame."
            }
            Self::Unexplained => {
                "The applied pose is not what the corrections make of the animated pose: pass the animated global \
                 transforms, and multiply each animated local rotation by its correction, `local * correction`."
            }
        })
    }
}

/// A mistake together with the evidence for it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Finding {
    /// The mistake that best explains the difference.
    pub mistake: Mistake,
    /// Angle between the applied effector's direction and the direction to the target, both from the engine's data,
    /// radians. `None` if the target is not known, or if the joints were passed in the wrong order.
    pub seen: Option<f32>,
    /// The same angle as the call returned it: [`Outcome::remaining`](crate::Outcome::remaining), radians.
    pub told: f32,
    /// Joints whose applied rotation differs from their correction. Empty if the pose itself is wrong.
    pub joints: JointSet,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.mistake)?;
        if let Some(seen) = self.seen {
            let [seen, told] = [seen, self.told].map(f32::to_degrees);
            write!(f, " The effector looks {seen:.1}° past its target; by the outcome it should be {told:.1}°.")?;
        }
        if !self.joints.is_empty() {
            write!(
                f,
                " Joints that are not where their corrections turn them, from the effector inward: {:?}.",
                self.joints
            )?;
        }
        Ok(())
    }
}

impl core::error::Error for Finding {}
