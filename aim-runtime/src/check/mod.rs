//! Debug-build check of an engine integration: compares the pose that the engine shows with the corrections of the call
//! and, if they disagree, names the common mistake that explains the difference.
//!
//! A call measures its result from the pose and target that it was given. It cannot detect that the pose held local
//! transforms, or that the corrections were multiplied on the wrong side: it returns
//! [`Reached`](crate::Status::Reached) while on screen the eyes look past the target. [`Frame::check`] takes the inputs
//! and outputs of the call and the joints' global transforms after the engine has applied the corrections. It computes
//! the rotation that each bone actually received and compares it with the correction. The check neither allocates nor
//! changes anything, and costs a few thousand instructions.
//!
//! ```
//! use aim_runtime::check::{Applied, Frame, Mistake};
//! use aim_runtime::glam::{Affine3A, Quat, Vec3};
//! use aim_runtime::{Axes, Call, Description, Joint, JointInfo, Pose, Rig, Settings, State};
//! # struct Turret([JointInfo; 1]);
//! # impl Rig for Turret {
//! #     fn description(&self) -> Description<'_> {
//! #         Description::new(&self.0)
//! #     }
//! #     fn joint_name(&self, _: usize) -> Option<&str> {
//! #         None
//! #     }
//! #     fn bone_name(&self, _: usize, _: usize) -> Option<&str> {
//! #         None
//! #     }
//! #     fn residual_jacobian(&self, _: &[[f32; 12]], _: &[f32; 3], _: &[[f32; 4]], _: &mut [f32]) {}
//! #     fn aim_gradient(&self, _: usize, _: &[f32; 12], _: &[f32; 3], _: &[f32; 4]) -> [f32; 3] {
//! #         [0.0; 3]
//! #     }
//! # }
//! # let axes = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] };
//! # let turret = Turret([JointInfo::new(axes, 9.0).with_heading(-3.0, 3.0).with_pitch(-1.0, 1.0)]);
//! # let rig: &dyn Rig = &turret;
//! # let mut state = State::new([Joint::REST]);
//! # let animated = [Affine3A::from_translation(Vec3::Y)];
//! # let (target, settings) = (Vec3::new(0.2, 1.1, 4.0), Settings::default());
//! // As ever: the animated pose goes in, corrections come out.
//! let (pose, call) = (Pose::new(animated), Call { targets: target.into(), dt: Some(0.016), settings: &settings });
//! let mut corrections = [Quat::IDENTITY];
//! let outcome = rig.aim(&mut state, &pose, &call, &mut corrections);
//!
//! // The engine applies them and computes its global transforms. One bone, without a parent:
//! let shown = [animated[0] * Affine3A::from_quat(corrections[0])];
//!
//! // In debug builds:
//! let mut frame = Frame {
//!     rig: rig.description(),
//!     pose: &pose.joints,
//!     call,
//!     outcome,
//!     corrections: &corrections,
//!     applied: Applied { joints: &shown, target: Some(target) },
//!     previous: None,
//! };
//! if let Err(finding) = frame.check() {
//!     panic!("{finding}");
//! }
//!
//! // A wrong setup is named.
//! let inverted = [animated[0] * Affine3A::from_quat(corrections[0].inverse())];
//! frame.applied.joints = &inverted;
//! assert_eq!(frame.check().unwrap_err().mistake, Mistake::Inverted);
//! ```

mod comparison;
mod mistake;

use glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};

pub use self::mistake::{Finding, Mistake};

use self::comparison::{Comparison, Ordered, WRONG_RAD, linear_inverse, turn_error};
use crate::kinematics::chain;
use crate::rig::MOST_JOINTS;
use crate::{Call, Description, Effector, JointSet, Outcome, Target, Targets, math};

/// Angle from which the passed target and the engine's own target count as different, as seen from the effector,
/// radians: 1°.
const OTHER_TARGET_RAD: f32 = 0.017_453_293;
/// Errors below this are attributed to rounding, radians.
const ROUNDING_RAD: f32 = 2e-4;
/// Factor on the error of an explanation that matches rotation angles but not axes: such weak evidence must fit this
/// many times better.
const WEAK: f32 = 4.0;
/// Smallest correction of the previous frame that can identify feedback, radians.
const LEAST_FED_BACK_RAD: f32 = 1e-3;
/// Two successive frames at least this long, seconds, indicate that `dt` is in milliseconds.
const LONGEST_DT_S: f32 = 1.0;

/// Record of one call for the check: its inputs, its results, and the pose that the engine shows.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The rig's description: `Hero::RIG.description()`.
    pub rig: Description<'a>,
    /// Joints of the [pose](crate::Pose) passed to the call, from the effector inward.
    pub pose: &'a [Affine3A],
    /// Targets, frame time and settings passed to the call. The target is compared only if it is a single point.
    pub call: Call<'a>,
    /// Outcome returned by the call.
    pub outcome: Outcome,
    /// Corrections returned by the call.
    pub corrections: &'a [Quat],
    /// The pose that the engine shows after applying the corrections.
    pub applied: Applied<'a>,
    /// Previous call for the same character, if it was recorded.
    pub previous: Option<Previous<'a>>,
}

/// The pose and target of the engine itself, after it applied the corrections.
///
/// Everything is in one space, preferably world space. It may differ from the pose's space.
#[derive(Clone, Copy, Debug)]
pub struct Applied<'a> {
    /// Global transforms of the joints, in the order of the pose, read after the engine has applied the corrections of
    /// this call.
    pub joints: &'a [Affine3A],
    /// Point that the character should look at, taken from the engine's own data. If `None`, a target in the wrong
    /// space or unit is not detected.
    pub target: Option<Vec3>,
}

/// Previous call, for mistakes that show over two frames: [`Feedback`](Mistake::Feedback), [`Late`](Mistake::Late) and
/// [`Milliseconds`](Mistake::Milliseconds).
#[derive(Clone, Copy, Debug)]
pub struct Previous<'a> {
    /// [`Applied::joints`] of that call.
    pub applied: &'a [Affine3A],
    /// Corrections returned by that call.
    pub corrections: &'a [Quat],
    /// Frame time of that call, [`Call::dt`].
    pub dt: Option<f32>,
}

/// The rotation that a mistake applies, as a function of the correction.
type Rule = fn(Quat) -> Quat;

/// Mistakes that apply the same function to every correction.
const RULES: [(Mistake, Rule); 3] = [
    (Mistake::Forgotten, |_| Quat::IDENTITY),
    (Mistake::Inverted, |correction| correction.conjugate()),
    (Mistake::AppliedTwice, |correction| math::product(correction, correction)),
];

impl Frame<'_> {
    /// Compares the applied pose with the pose that the corrections should give.
    ///
    /// Returns `Ok` if every bone received its correction to within 0.1°, every joint is in the place that this
    /// implies, and the passed target lies within 1° of [`Applied::target`] as seen from the effector. Also returns
    /// `Ok` if there is nothing to compare: a number of joints that differs from the rig's, or transforms that are not
    /// finite or have linearly dependent axes.
    ///
    /// Limitations:
    ///
    /// - While the corrections are nearly zero, a mistake in applying them is not visible.
    /// - For a rig of one joint, local transforms are reported as [`TargetSpace`](Mistake::TargetSpace).
    /// - If the applied joints are in another space than the pose, the innermost joint's own rotation is only checked
    ///   through the target.
    /// - The [other eye](crate::Pose::with_other_eye) is not checked.
    ///
    /// # Errors
    ///
    /// The mistake that best explains the difference.
    pub fn check(&self) -> Result<(), Finding> {
        let count = self.rig.joints().len();
        let (pose, applied) = (self.pose, self.applied.joints);
        if !(1..=MOST_JOINTS).contains(&count) || [pose.len(), applied.len(), self.corrections.len()] != [count; 3] {
            return Ok(());
        }
        if !pose.iter().chain(applied).all(is_usable) || !self.corrections.iter().all(|turn| turn.is_finite()) {
            return Ok(());
        }
        let comparison = Comparison::new(Ordered::new(pose), Ordered::new(applied), Ordered::new(self.corrections));
        match self.mistake(&comparison) {
            Some(mistake) => Err(self.finding(&comparison, mistake)),
            None => Ok(()),
        }
    }

    fn mistake(&self, comparison: &Comparison<'_>) -> Option<Mistake> {
        let error = comparison.right_error();
        let is_wrong = error > WRONG_RAD;
        if is_wrong && self.order_error(comparison) < ROUNDING_RAD {
            return Some(Mistake::JointOrder);
        }
        if self.is_fed_back(comparison) {
            return Some(Mistake::Feedback);
        }
        if is_wrong {
            return Some(self.explanation(comparison, error));
        }
        let has_long_frames = [self.call.dt, self.previous.and_then(|previous| previous.dt)]
            .iter()
            .all(|dt| dt.is_some_and(|dt| dt >= LONGEST_DT_S));
        self.target_mistake(comparison).or_else(|| has_long_frames.then_some(Mistake::Milliseconds))
    }

    /// Returns the mistake with the least error that explains the applied pose, provided that its error is far below
    /// that of a correct setup. If several fit to within rounding, the one tested first.
    fn explanation(&self, comparison: &Comparison<'_>, right_error: f32) -> Mistake {
        let mut best = Best { mistake: Mistake::Unexplained, error: WRONG_RAD.min(0.25 * right_error) };
        let correction = |joint| comparison.correction(joint);
        // Mistakes in rotations alone leave each joint attached to its parent, so the displacement must also be small.
        let shift = comparison.shift_error();
        for (mistake, rule) in RULES {
            best.propose(mistake, shift.max(comparison.error(|joint, turn| turn_error(turn, rule(correction(joint))))));
        }
        if let Some(previous) = self.previous.filter(|previous| previous.corrections.len() == comparison.count()) {
            let late = |joint: usize, turn: &Mat3A| turn_error(turn, previous.corrections[joint]);
            best.propose(Mistake::Late, shift.max(comparison.error(late)));
        }
        let others = |joint, turn: &Mat3A| {
            let others = (0..comparison.count()).filter(|other| *other != joint);
            others.map(|other| turn_error(turn, correction(other))).fold(f32::INFINITY, f32::min)
        };
        best.propose(Mistake::WrongJoints, shift.max(comparison.error(others)));
        best.propose(Mistake::JointOrder, self.order_error(comparison));
        best.propose(Mistake::OntoGlobal, comparison.onto_global_error());
        best.propose(Mistake::LocalPose, comparison.local_error());
        if best.mistake != Mistake::Unexplained {
            return best.mistake;
        }
        // Weaker evidence: rotation angles without axes, then joints out of place without an explanation of the bones
        // between.
        let same_angle = |joint, turn: &Mat3A| {
            let expected = Mat3A::from_quat(correction(joint));
            (turn_error(turn, Quat::IDENTITY) - turn_error(&expected, Quat::IDENTITY)).abs()
        };
        best.propose(Mistake::Premultiplied, shift.max(WEAK * comparison.error(same_angle)));
        if best.mistake == Mistake::Unexplained && shift > WRONG_RAD && comparison.has_short_origins() {
            return Mistake::LocalPose;
        }
        best.mistake
    }

    /// Returns the error under the assumption that the joints were passed root first, with corrections and applied
    /// joints both in pose order, both in rig order, or only the corrections in pose order; the least of the three.
    fn order_error(&self, comparison: &Comparison<'_>) -> f32 {
        if comparison.count() < 2 {
            return f32::INFINITY;
        }
        let orders = [(true, true), (false, false), (true, false)];
        let errors = orders.map(|(corrections, applied)| comparison.reversed(corrections, applied).right_error());
        errors.into_iter().fold(f32::INFINITY, f32::min)
    }

    /// Returns `true` if the pose already contains corrections of the previous frame: some joint of the pose stands
    /// relative to the next one inward (the innermost one: in space) exactly as it was shown then.
    fn is_fed_back(&self, comparison: &Comparison<'_>) -> bool {
        let count = comparison.count();
        let Some(previous) = self.previous else { return false };
        if [previous.applied.len(), previous.corrections.len()] != [count; 2] || !previous.applied.iter().all(is_usable)
        {
            return false;
        }
        let shown = comparison.with_applied(previous.applied);
        (0..count).any(|joint| {
            let moved = turn_error(&Mat3A::IDENTITY, previous.corrections[joint]);
            let is_as_shown = |turn: Mat3A| turn_error(&turn, Quat::IDENTITY) < ROUNDING_RAD;
            // A bone that now shows no correction, or still the previous one, is a frame late: it cannot have shown the
            // previous correction a frame ago.
            let is_behind = comparison.observed(joint).is_some_and(|turn| {
                let is_last = turn_error(&turn, previous.corrections[joint]) < ROUNDING_RAD;
                let is_right = turn_error(&turn, comparison.correction(joint)) < ROUNDING_RAD;
                (is_as_shown(turn) || is_last) && !is_right
            });
            moved > LEAST_FED_BACK_RAD && !is_behind && shown.observed(joint).is_some_and(is_as_shown)
        })
    }

    /// Compares the passed target with the engine's own, both in the applied space.
    fn target_mistake(&self, comparison: &Comparison<'_>) -> Option<Mistake> {
        let (passed, meant) = (self.point()?, Vec3A::from(self.applied.target?));
        let innermost = comparison.correction(comparison.count() - 1);
        let space = comparison.space(innermost);
        let is_other = |space: Affine3A| self.sees_apart(space.transform_point3a(passed), meant);
        if !passed.is_finite() || !meant.is_finite() || !is_other(space) {
            return None;
        }
        // A wrong rotation of the innermost joint looks like a change of space; the target distinguishes the two.
        for (mistake, rule) in RULES {
            if !comparison.shares_space() && !is_other(comparison.space(rule(innermost))) {
                return Some(mistake);
            }
        }
        let to_pose = chain::inverse(&space);
        let meant_ps = to_pose.transform_point3a(meant);
        let factor = math::length(meant_ps) / math::length(passed);
        let is_parallel = math::length(passed * factor - meant_ps) < 0.01 * math::length(meant_ps);
        let is_other_unit = is_parallel && !(0.8..1.25).contains(&factor);
        Some(if is_other_unit { Mistake::TargetUnit } else { Mistake::TargetSpace })
    }

    /// Returns the passed target if it is a single point.
    fn point(&self) -> Option<Vec3A> {
        match self.call.targets {
            Targets::Point(point) | Targets::Weighted(&[Target { point, .. }]) => Some(point.into()),
            Targets::Weighted(_) => None,
        }
    }

    /// Returns `true` if two points lie in different directions from the applied effector.
    fn sees_apart(&self, a: Vec3A, b: Vec3A) -> bool {
        let [origin, _] = self.gaze(self.applied.joints);
        match [a, b].map(|point| math::direction(point - origin)) {
            [Some(a), Some(b)] => math::angle_between(a, b) > OTHER_TARGET_RAD,
            _ => false,
        }
    }

    /// Returns the origin and direction of the effector for these joint transforms.
    fn gaze(&self, joints: &[Affine3A]) -> [Vec3A; 2] {
        let aimed = self.call.settings.effector.min(joints.len() - 1);
        let Effector { forward, origin } = match aimed {
            0 => *self.rig.effector(),
            _ => Effector { forward: self.rig.joints()[aimed].axes().forward, origin: [0.0; 3] },
        };
        let joint = &joints[aimed];
        [joint.transform_point3a(origin.into()), joint.transform_vector3a(forward.into())]
    }

    /// Completes a finding: the angle by which the effector misses the target, and the joints that differ.
    fn finding(&self, comparison: &Comparison<'_>, mistake: Mistake) -> Finding {
        let innermost = comparison.correction(comparison.count() - 1);
        let passed = || Some(comparison.space(innermost).transform_point3a(self.point()?));
        let [origin, direction] = self.gaze(self.applied.joints);
        let target = self.applied.target.map(Vec3A::from).or_else(passed);
        let seen = target.filter(|_| mistake != Mistake::JointOrder).and_then(|target| {
            let angle = math::angle_between(math::direction(direction)?, math::direction(target - origin)?);
            angle.is_finite().then_some(angle)
        });
        let mut joints = JointSet::EMPTY;
        let is_pose_wrong = matches!(mistake, Mistake::LocalPose | Mistake::JointOrder | Mistake::Feedback);
        for joint in (0..comparison.count()).filter(|_| !is_pose_wrong) {
            let wrong = |turn: Mat3A| turn_error(&turn, comparison.correction(joint)) > WRONG_RAD;
            if comparison.observed(joint).is_some_and(wrong) {
                joints.insert(joint);
            }
        }
        Finding { mistake, seen, told: self.outcome.remaining, joints }
    }
}

/// The explanation with the least error so far.
struct Best {
    mistake: Mistake,
    error: f32,
}

impl Best {
    fn propose(&mut self, mistake: Mistake, error: f32) {
        let error = error.max(ROUNDING_RAD);
        if error < self.error {
            *self = Self { mistake, error };
        }
    }
}

/// Returns `true` if a transform is finite and its axes are linearly independent.
fn is_usable(joint: &Affine3A) -> bool {
    joint.is_finite() && math::orthonormal(joint.matrix3).is_some() && linear_inverse(&joint.matrix3).is_finite()
}
