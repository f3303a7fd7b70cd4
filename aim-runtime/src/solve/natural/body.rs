//! [`Body`]: the animated pose as a natural gaze sees it, and [`Posture`], what becomes of it from the root outward.
//!
//! A joint's *frame* has its forward, left and up as columns, in solver space, upright where its heading is. So no axes are
//! needed any more: heading h and pitch p turn a frame (f, l, u) to
//!
//! ```text
//! f′ = (f·cos h + l·sin h)·cos p + u·sin p,   l′ = l·cos h − f·sin h,   u′ = u·cos p − (f·cos h + l·sin h)·sin p
//! ```
//!
//! which is `R_heading·R_pitch` also where the axes are mirrored.

use glam::{Affine3A, Mat3A, Quat, Vec3A};

use crate::kinematics::chain::{Ray, Space, Upright, effector, orthogonal_frames, upright};
use crate::kinematics::rotation::{is_identity, tilted, turn};
use crate::math;
use crate::math::trig::{self, Halves};
use crate::rig::{ChainRig, PerJoint};
use crate::{Joint, JointInfo};

/// An animated pose.
pub(super) struct Body<'a, const C: usize> {
    pub(super) rig: &'a ChainRig<'a, C>,
    /// The joint that carries the effector; those before it do not matter.
    pub(super) first: usize,
    pub(super) count: usize,
    /// The joints' frames and where they are; the innermost is the origin.
    pub(super) frames: PerJoint<Mat3A, C>,
    pub(super) positions: PerJoint<Vec3A, C>,
    /// The joints' own forwards in solver space, which those of upright frames are not.
    pub(super) forwards: PerJoint<Vec3A, C>,
    /// How each joint's upright frame stands in its bone.
    pub(super) tilts: PerJoint<Quat, C>,
    /// The innermost joint's frame before it is tilted upright.
    pub(super) trunk: Mat3A,
    /// The effector, and the same in the aimed joint's frame.
    pub(super) gaze: Ray,
    pub(super) effector: Ray,
    /// Whether the effector looks along its joint's forward from its origin.
    pub(super) is_plain: bool,
    /// Whether frames and positions are all there is to the pose: no shear, no non-uniform scale.
    pub(super) is_rigid: bool,
    pub(super) space: Space,
}

impl<'a, const C: usize> Body<'a, C> {
    /// A body of which nothing is known.
    #[inline(always)]
    pub(super) fn unseen(rig: &'a ChainRig<'a, C>) -> Self {
        let ray = Ray { origin: Vec3A::ZERO, direction: Vec3A::X };
        Self {
            rig,
            first: 0,
            count: rig.joints.len(),
            frames: rig.array(Mat3A::IDENTITY),
            positions: rig.array(Vec3A::ZERO),
            forwards: rig.array(Vec3A::X),
            tilts: rig.array(Quat::IDENTITY),
            trunk: Mat3A::IDENTITY,
            gaze: ray,
            effector: ray,
            is_plain: true,
            is_rigid: true,
            space: Space { origin: Vec3A::ZERO, per_size: 1.0 },
        }
    }

    /// Reads `pose` with `first` as the joint that is aimed; `None` where it is not finite or does not span space.
    #[inline(always)]
    pub(super) fn read(&mut self, pose: &[Affine3A], first: usize, about: Upright) -> Option<()> {
        let infos = self.rig.joints;
        if infos.is_empty() || pose.len() != infos.len() {
            return None;
        }
        let first = first.min(infos.len() - 1);
        self.first = first;
        self.is_rigid = orthogonal_frames(pose, first, &mut self.frames)?;
        let aimed = effector(self.rig, first);
        let has_origin = first == 0 && self.rig.has_origin;
        let offset = if has_origin { pose[first].transform_vector3a(aimed.origin) } else { Vec3A::ZERO };
        self.space = Space::of_pose(pose, first, offset)?;
        let Space { origin, per_size } = self.space;

        let last = infos.len() - 1;
        self.trunk = self.frames[last] * infos[last].planes.basis;
        upright(infos, first, about, &mut self.frames, &mut self.tilts);
        for index in first..infos.len() {
            let (bone, tilt) = (self.frames[index], self.tilts[index]);
            let frame = bone * infos[index].planes.basis;
            self.frames[index] = frame;
            self.forwards[index] = if is_identity(tilt) {
                frame.x_axis
            } else {
                bone * math::turned(tilt.conjugate(), infos[index].axes.forward.into())
            };
            self.positions[index] = (pose[index].translation - origin) * per_size;
        }
        let frame = self.frames[first];
        let tilt = self.tilts[first];
        self.is_plain = !has_origin && is_identity(tilt) && (first > 0 || self.rig.aims_forward);
        if !self.is_plain {
            let direction = math::turned(tilt.conjugate(), aimed.direction);
            let direction = infos[first].planes.basis.transpose() * direction;
            self.effector = Ray { origin: frame.transpose() * (offset * per_size), direction };
        }
        self.gaze = Ray {
            origin: self.positions[first] + offset * per_size,
            direction: if self.is_plain { frame.x_axis } else { frame * self.effector.direction },
        };
        Some(())
    }

    /// Takes the effector from the true kinematics of a pose that is not rigid; `None` where it looks nowhere.
    pub(super) fn look_along(&mut self, gaze: Ray) -> Option<()> {
        self.gaze = gaze;
        self.effector.direction = self.frames[self.first].transpose() * math::unit(gaze.direction)?;
        self.is_plain = false;
        Some(())
    }

    /// Whether a joint turns all the way round.
    #[inline(always)]
    pub(super) fn turns_round(&self) -> bool {
        let all = [f32::NEG_INFINITY, f32::INFINITY];
        let rig = self.rig;
        let is_free = |info: &JointInfo| info.heading == Some(all) && rig.budget(info.role).heading == all;
        !rig.has_fixed_ranges && rig.joints[self.first..].iter().any(is_free)
    }

    /// From a joint to the next one outward, from the aimed one to the effector.
    #[inline(always)]
    fn arm(&self, joint: usize) -> Vec3A {
        let end = if joint > self.first { self.positions[joint - 1] } else { self.gaze.origin };
        end - self.positions[joint]
    }
}

/// What the joints further in make of a joint: where they bring it, and its frame, in solver space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried {
    pub(super) at: Vec3A,
    pub(super) frame: Mat3A,
}

impl Carried {
    /// The innermost joint, as the animation has it.
    #[inline(always)]
    pub(super) fn root<const C: usize>(body: &Body<'_, C>) -> Self {
        Self { at: Vec3A::ZERO, frame: body.frames[body.count - 1] }
    }

    /// The same for the next joint outward; the effector for the aimed one.
    #[inline(always)]
    pub(super) fn outward<const C: usize>(&self, body: &Body<'_, C>, joint: usize, halves: Halves) -> Self {
        let frame = turned(&self.frame, halves);
        let turn = frame * body.frames[joint].transpose();
        let at = self.at + turn * body.arm(joint);
        Self { at, frame: if joint > body.first { turn * body.frames[joint - 1] } else { frame } }
    }

    /// The effector where all joints have had their turn.
    pub(super) fn gaze<const C: usize>(&self, body: &Body<'_, C>) -> Ray {
        // Not by the turn: a frame that is not quite square would count twice.
        Ray { origin: self.at, direction: self.frame * body.effector.direction }
    }
}

/// The halves of a joint's angles.
#[inline(always)]
pub(super) fn halves(joint: &Joint) -> Halves {
    trig::halves(joint.pitch, joint.heading)
}

/// A frame turned by heading and pitch of these halves.
#[inline(always)]
pub(super) fn turned(frame: &Mat3A, halves: Halves) -> Mat3A {
    let [sin_p, cos_p, sin_h, cos_h] = trig::doubled(halves);
    let Mat3A { x_axis: forward, y_axis: left, z_axis: up } = *frame;
    let level = forward * cos_h + left * sin_h;
    Mat3A::from_cols(level * cos_p + up * sin_p, left * cos_h - forward * sin_h, up * cos_p - level * sin_p)
}

/// The joints as they are turned in a call, from the root outward.
pub(super) struct Posture<const C: usize> {
    pub(super) joints: PerJoint<Joint, C>,
    /// What each joint adds in its bone.
    pub(super) corrections: PerJoint<Quat, C>,
    pub(super) carried: Carried,
}

impl<const C: usize> Posture<C> {
    /// The joints before any has had its turn.
    #[inline(always)]
    pub(super) fn new(body: &Body<'_, C>, joints: &[Joint]) -> Self {
        let rig = body.rig;
        let mut copy = rig.array(Joint::REST);
        copy.copy_from_slice(joints);
        Self { joints: copy, corrections: rig.array(Quat::IDENTITY), carried: Carried::root(body) }
    }

    /// Gives a joint its turn.
    #[inline(always)]
    pub(super) fn turn(&mut self, body: &Body<'_, C>, joint: usize) {
        let halves = self.correct(body, joint);
        self.carried = self.carried.outward(body, joint, halves);
    }

    /// Notes what a joint adds.
    #[inline(always)]
    pub(super) fn correct(&mut self, body: &Body<'_, C>, joint: usize) -> Halves {
        let (info, halves) = (&body.rig.joints[joint], halves(&self.joints[joint]));
        self.corrections[joint] = tilted(turn(&info.axes, &info.planes, halves), body.tilts[joint]);
        halves
    }
}
