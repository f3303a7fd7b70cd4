//! [`Gizmos`]: debug lines that visualise an aim, as plain data for any renderer.

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::rotation::{length, turned};
use aim_runtime::{Description, JointRange};

use crate::aim_chain::{AimChain, AimFrame, Corrections};

/// Kind of a [`GizmoLine`]. Joints are numbered from the effector inward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GizmoKind {
    /// The gaze: the direction of the effector, which is fixed to joint 0.
    Gaze,
    /// The gaze of the other eye.
    OtherGaze,
    /// An axis of a joint's bone.
    Axis {
        /// The joint.
        joint: usize,
        /// The axis of bone space: 0 is x, 1 is y, 2 is z.
        axis: usize,
    },
    /// A segment of the rim of a joint's range of motion.
    Rim {
        /// The joint.
        joint: usize,
    },
    /// A line from a joint's origin to a corner of the rim of its range of motion.
    Edge {
        /// The joint.
        joint: usize,
    },
}

/// A line segment to draw, in the space of the targets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GizmoLine {
    /// Start point. For gazes, axes and edges: the origin of the effector or joint.
    pub from: Vec3,
    /// End point.
    pub to: Vec3,
    /// Kind of the line: which part of the aim it shows.
    pub kind: GizmoKind,
}

/// Debug lines that visualise an aim: gazes, bone axes and ranges of motion.
///
/// The methods return iterators and do not allocate. Lines that are not finite are skipped.
///
/// ```
/// use aim_animation::glam::{Affine3A, Quat, Vec3};
/// use aim_animation::{AimChain, Bone, Corrections, GizmoKind, Gizmos, Skeleton};
/// use aim_runtime::{Axes, Description, JointInfo};
///
/// let axes = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] };
/// let neck = [JointInfo::new(axes, 3.0).with_heading(-1.0, 1.0).with_pitch(-0.5, 0.4)];
/// let skeleton = Skeleton::new([Bone::new("neck", None)])?;
/// let chain = AimChain::new(&skeleton, [0])?;
/// let (mut frame, mut local, mut model) = (chain.frame(), skeleton.rest().to_vec(), [Affine3A::IDENTITY]);
/// chain.gather(&mut frame, &mut local, &mut model)?;
/// // … aim, and apply …
/// let corrections = Corrections { joints: &[Quat::IDENTITY], other_eye: None };
/// let gizmos =
///     Gizmos { chain: &chain, frame: &frame, description: &Description::new(&neck), corrections, model: &model };
/// let gaze = gizmos.gazes(2.0).next().unwrap();
/// assert_eq!((gaze.kind, gaze.from, gaze.to), (GizmoKind::Gaze, Vec3::ZERO, 2.0 * Vec3::Z));
/// assert!(gizmos.ranges(0.3).all(|line| (line.to.length() - 0.3).abs() < 1e-6));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Gizmos<'a> {
    /// The chain that is aimed.
    pub chain: &'a AimChain,
    /// The frame that was [gathered](AimChain::gather) and aimed.
    pub frame: &'a AimFrame,
    /// The description of the rig.
    pub description: &'a Description<'a>,
    /// The corrections that were [applied](AimChain::apply).
    pub corrections: Corrections<'a>,
    /// The pose in model space, with the corrections applied.
    pub model: &'a [Affine3A],
}

/// Number of segments along each of the four sides of a rim.
const PIECES: u8 = 16;

impl<'a> Gizmos<'a> {
    /// Returns the gaze, and that of the other eye if the chain has one, as lines of this length.
    ///
    /// The two gazes are assumed to be parallel in the bind pose.
    pub fn gazes(self, length: f32) -> impl Iterator<Item = GizmoLine> + 'a {
        let effector = self.description.effector();
        let [origin, forward] = [effector.origin, effector.forward].map(Vec3A::from);
        let eye = self.joint(0);
        let gaze = eye.map(|at| (at.transform_point3a(origin), at.matrix3 * forward));
        let other = self.chain.other_eye_in_bind().and_then(|(bone, to_eye)| {
            let at = self.placed(bone)?;
            Some((at.translation, at.matrix3 * (to_eye * forward)))
        });
        let line = move |(from, direction): (Vec3A, Vec3A), kind| line(from, direction, length, kind);
        let gaze = gaze.and_then(move |gaze| line(gaze, GizmoKind::Gaze));
        gaze.into_iter().chain(other.and_then(move |gaze| line(gaze, GizmoKind::OtherGaze)))
    }

    /// Returns the axes of each joint's bone, as lines of this length.
    pub fn axes(self, length: f32) -> impl Iterator<Item = GizmoLine> + 'a {
        let joints = (0..self.chain.joints().len()).filter_map(move |joint| Some((joint, self.joint(joint)?)));
        joints.flat_map(move |(joint, at)| {
            (0..3).filter_map(move |axis| {
                line(at.translation, at.matrix3.col(axis), length, GizmoKind::Axis { joint, axis })
            })
        })
    }

    /// Returns each joint's range of motion: the directions that the joint's forward axis reaches by its own correction
    /// alone.
    ///
    /// It is drawn as a rim at distance `length` from the joint, with an edge to each corner of the rim. Headings are
    /// limited to ±180°, so that an unlimited heading is drawn as one full turn. The range of a joint with only one
    /// angle is an arc.
    pub fn ranges(self, length: f32) -> impl Iterator<Item = GizmoLine> + 'a {
        (0..self.chain.joints().len()).filter_map(move |joint| self.cone(joint, length)).flat_map(Cone::lines)
    }

    fn cone(&self, joint: usize, length: f32) -> Option<Cone> {
        let range = self.description.joint_range(joint, &self.frame.pose())?;
        let forward = Vec3A::from(self.description.joints()[joint].axes().forward);
        let turned = self.joint(joint)?;
        // Removes the joint's own correction, which was multiplied on the right: bone · R⁻¹.
        let own = self.corrections.joints.get(joint).copied().unwrap_or(Quat::IDENTITY);
        let matrix3 = turned.matrix3 * Mat3A::from_quat(own.conjugate());
        Some(Cone { joint, at: Affine3A { matrix3, ..turned }, range, forward, length })
    }

    /// Returns the transform of a joint's bone to the space of the targets.
    fn joint(&self, joint: usize) -> Option<Affine3A> {
        self.placed(*self.chain.joints().get(joint)?)
    }

    fn placed(&self, bone: usize) -> Option<Affine3A> {
        let at = self.frame.place * *self.model.get(bone)?;
        at.is_finite().then_some(at)
    }
}

/// A joint's range of motion, placed in the space of the targets.
#[derive(Clone, Copy, Debug)]
struct Cone {
    joint: usize,
    /// Transform of the bone without the joint's own correction.
    at: Affine3A,
    range: JointRange,
    forward: Vec3A,
    length: f32,
}

impl Cone {
    fn lines(self) -> impl Iterator<Item = GizmoLine> {
        let rim = move |k: u8| {
            let [from, to] = [self.corner(k), self.corner(k + 1)].map(|angles| self.point(angles));
            finite(GizmoLine { from: from.into(), to: to.into(), kind: GizmoKind::Rim { joint: self.joint } })
        };
        let edge = move |k: u8| {
            let (from, to) = (self.at.translation.into(), self.point(self.corner(k * PIECES)).into());
            finite(GizmoLine { from, to, kind: GizmoKind::Edge { joint: self.joint } })
        };
        (0..4 * PIECES).filter_map(rim).chain((0..4).filter_map(edge))
    }

    /// Returns heading and pitch at point `k` of the rim, 0 to 4 · [`PIECES`].
    ///
    /// The rim runs left along the least pitch, up at the left, right along the greatest pitch, and down at the right.
    fn corner(&self, k: u8) -> [f32; 2] {
        let within = |[lo, hi]: [f32; 2]| {
            let half_turn = core::f32::consts::PI;
            [lo.max(-half_turn), hi.min(half_turn)]
        };
        let [right, left] = within(self.range.heading());
        let (side, part) = (k / PIECES, f32::from(k % PIECES) / f32::from(PIECES));
        let share = |[from, to]: [f32; 2], part: f32| from + (to - from) * part;
        let heading = match side {
            0 => share([right, left], part),
            1 => left,
            2 => share([left, right], part),
            _ => right,
        };
        let pitch = within(self.range.pitch_at(heading));
        let pitch = match side {
            0 | 4 => pitch[0],
            1 => share(pitch, part),
            2 => pitch[1],
            _ => share([pitch[1], pitch[0]], part),
        };
        [heading, pitch]
    }

    fn point(&self, [heading, pitch]: [f32; 2]) -> Vec3A {
        let direction = self.at.matrix3 * turned(self.range.correction(heading, pitch), self.forward);
        self.at.translation + direction * (self.length / length(direction))
    }
}

fn line(from: Vec3A, direction: Vec3A, long: f32, kind: GizmoKind) -> Option<GizmoLine> {
    let to = from + direction * (long / length(direction));
    finite(GizmoLine { from: from.into(), to: to.into(), kind })
}

fn finite(line: GizmoLine) -> Option<GizmoLine> {
    (line.from.is_finite() && line.to.is_finite()).then_some(line)
}
