//! [`Body`]: the animated pose as the natural solver uses it.
//!
//! A joint's *frame* has its forward, left and up as columns, in solver space. It is upright if the joint has an
//! upright heading. The bones' axes are then no longer needed. Corrections by heading h and pitch p turn the frame (f,
//! l, u) to
//!
//! ```text
//! f′ = (f·cos h + l·sin h)·cos p + u·sin p,   l′ = l·cos h − f·sin h,   u′ = u·cos p − (f·cos h + l·sin h)·sin p
//! ```
//!
//! which equals `R_heading·R_pitch` even for mirrored axes.
//!
//! The pose is not carried outward along the chain. Instead, each joint's turn F·R·Fᵀ about its animated place x is
//! [undone](Body::undo_turn) on the point that is looked at: x + F·Rᵀ·Fᵀ·(point − x). This is equivalent, and
//! each joint is turned in its animated frame.

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec3Swizzles, Vec4};

use super::glide::Pair;
use crate::kinematics::bearing::Bearings;
use crate::kinematics::chain::{Deviation, Ray, Space, TOO_NEAR, Upright, effector, orthogonal_frames, upright};
use crate::math::trig::{self, Halves};
use crate::math::{self, Bounded};
use crate::rig::{ChainRig, EXACT_JOINTS, PerJoint};
use crate::solve::judge::Measured;
use crate::{Joint, JointInfo};

/// An animated pose.
pub(super) struct Body<'a, const C: usize> {
    pub(super) rig: &'a ChainRig<'a, C>,
    infos: &'a [JointInfo],
    /// `true` if any joint has an upright heading.
    has_upright: bool,
    /// See [`first`](Self::first).
    first: usize,
    /// The joints' frames.
    pub(super) frames: PerJoint<Mat3A, C>,
    /// The transposed frames.
    pub(super) rows: PerJoint<Mat3A, C>,
    /// The joints' positions; the innermost joint is the origin.
    pub(super) places: PerJoint<Vec3A, C>,
    /// The rotation of each joint's upright frame in its bone.
    pub(super) tilts: PerJoint<Quat, C>,
    /// The innermost joint's frame before it is made upright.
    pub(super) trunk: Mat3A,
    /// The effector in solver space; its direction is a unit vector.
    pub(super) gaze: Ray,
    /// The effector in the aimed joint's frame.
    pub(super) effector: Ray,
    /// `true` if the effector looks along its joint's forward from its origin.
    pub(super) is_plain: bool,
    /// Deviation of the pose, by shear and non-uniform scale, from what frames and positions can represent.
    pub(super) deviation: Deviation,
    pub(super) space: Space,
}

impl<'a, const C: usize> Body<'a, C> {
    /// Creates a body before a pose is read.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn unseen(rig: &'a ChainRig<'a, C>) -> Self {
        let ray = Ray { origin: Vec3A::ZERO, direction: Vec3A::X };
        Self {
            rig,
            infos: rig.joints,
            has_upright: rig.has_upright,
            first: 0,
            frames: rig.array(Mat3A::ZERO),
            rows: rig.array(Mat3A::ZERO),
            places: rig.array(Vec3A::ZERO),
            tilts: rig.array(Quat::IDENTITY),
            trunk: Mat3A::ZERO,
            gaze: ray,
            effector: ray,
            is_plain: true,
            deviation: Deviation::default(),
            space: Space { origin: Vec3A::ZERO, per_size: 1.0 },
        }
    }

    /// Returns the joint that carries the effector; joints outward of it do not matter.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn first(&self) -> usize {
        if C == EXACT_JOINTS { 0 } else { self.first }
    }

    /// Returns the number of joints.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn count(&self) -> usize {
        self.rig.count()
    }

    /// Returns the declared properties of the joints.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn infos(&self) -> &'a [JointInfo] {
        &self.infos[..self.count()]
    }

    /// Reads `pose` with `first` as the aimed joint; `None` if it is not finite or is singular.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn read(&mut self, pose: &[Affine3A], first: usize, about: Upright) -> Option<()> {
        let (rig, infos) = (self.rig, self.infos());
        if infos.is_empty() || pose.len() != infos.len() {
            return None;
        }
        let last = infos.len() - 1;
        if C != EXACT_JOINTS {
            self.first = first.min(last);
        }
        let (pose, first) = (&pose[..infos.len()], self.first());
        self.deviation = orthogonal_frames(pose, first, &mut self.frames)?;
        let has_origin = first == 0 && rig.has_origin;
        let offset = has_origin.then(|| pose[first].transform_vector3a(rig.effector.origin.into()));
        self.space = Space::of_pose(pose, first, offset)?;
        let Space { origin, per_size } = self.space;

        if self.has_upright {
            self.trunk = infos[last].planes.frame(&self.frames[last]);
            upright(infos, first, about, &mut self.frames, &mut self.tilts);
        }
        for index in first..infos.len() {
            let frame = infos[index].planes.frame(&self.frames[index]);
            self.frames[index] = frame;
            self.rows[index] = frame.transpose();
            self.places[index] = (pose[index].translation - origin) * per_size;
        }
        if !self.has_upright {
            self.trunk = self.frames[last];
        }
        self.gaze = Ray { origin: self.places[first], direction: self.frames[first].x_axis };
        if has_origin || self.is_tilted(first) || first == 0 && !rig.aims_forward {
            self.set_effector(offset.unwrap_or(Vec3A::ZERO) * per_size);
        }
        Some(())
    }

    /// Sets an effector that does not look along its joint's forward from its origin, but from `offset` out of it.
    #[cold]
    fn set_effector(&mut self, offset: Vec3A) {
        let first = self.first();
        let direction = self.upright_direction(first, effector(self.rig, first).direction);
        self.is_plain = false;
        self.effector = Ray { origin: self.rows[first] * offset, direction };
        self.gaze = Ray { origin: self.places[first] + offset, direction: self.frames[first] * direction };
    }

    /// Returns `true` if a joint's upright frame differs from that of its bone.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_tilted(&self, joint: usize) -> bool {
        self.has_upright && Vec4::from(self.tilts[joint]).cmpne(Vec4::ZERO).bitmask() & 7 != 0
    }

    /// Returns `true` if heading and elevation are measured in a joint's own frame, so that they are its angles.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn measures_bearings(&self, joint: usize, bearings: &Bearings) -> bool {
        joint + 1 == self.count() && bearings.are_of_trunk && !self.is_tilted(joint)
    }

    /// Transforms a direction of a joint's bone to its upright frame.
    #[cold]
    fn upright_direction(&self, joint: usize, direction: Vec3A) -> Vec3A {
        self.rig.joints[joint].planes.basis.transpose() * math::turned(self.tilts[joint].conjugate(), direction)
    }

    /// Returns a joint's declared forward in its upright frame.
    #[cold]
    pub(super) fn own_forward(&self, joint: usize) -> Vec3A {
        self.upright_direction(joint, self.infos()[joint].axes.forward.into())
    }

    /// Returns a joint's declared up in solver space.
    #[cold]
    pub(super) fn own_up(&self, joint: usize) -> Vec3A {
        if self.is_tilted(joint) {
            self.frames[joint] * self.upright_direction(joint, self.infos()[joint].axes.up.into())
        } else {
            self.frames[joint].z_axis
        }
    }

    /// Sets the effector from the true kinematics of a pose that is not rigid; `None` if its direction is zero.
    pub(super) fn set_gaze(&mut self, gaze: Ray) -> Option<()> {
        self.gaze = Ray { direction: math::unit(gaze.direction)?, ..gaze };
        self.effector.direction = self.rows[self.first()] * self.gaze.direction;
        self.is_plain = false;
        Some(())
    }

    /// Returns the angle between the effector, with the leading joint turned by `turn`, and its view of a point; `None`
    /// if it is undefined.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn measure(&self, view: Vec3A, turn: &Turn) -> Option<Measured> {
        let seen = turn.undo(view);
        if !self.is_plain {
            return self.effector.angle_to(seen).map(Measured::of_angle);
        }
        let aside = seen.y * seen.y + seen.z * seen.z;
        let square = aside + seen.x * seen.x;
        // The negation also catches NaN.
        if !(square > TOO_NEAR * TOO_NEAR && square < f32::INFINITY) {
            return None;
        }
        let aim = (seen.x / math::root(square)).at_least(-1.0).at_most(1.0);
        Some(Measured { remaining: trig::small_atan2(math::root(aside), seen.x), aim })
    }

    /// Returns `true` if any joint can turn all the way round.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn turns_round(&self) -> bool {
        let all = [f32::NEG_INFINITY, f32::INFINITY];
        let rig = self.rig;
        let is_free = |info: &JointInfo| info.heading == Some(all) && rig.budget(info.role).heading == all;
        !rig.has_fixed_ranges && rig.joints[self.first()..].iter().any(is_free)
    }

    /// Undoes a joint's turn on a direction.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn undo_turn(&self, joint: usize, turn: &Turn, direction: Vec3A) -> Vec3A {
        self.frames[joint] * turn.undo(self.rows[joint] * direction)
    }

    /// [`undo_turn`](Self::undo_turn) for several directions: multiplies them by Fᵀ, then by F·Rᵀ.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn undoing(&self, joint: usize, turn: &Turn) -> impl Fn(Vec3A) -> Vec3A {
        let (rows, undone) = (self.rows[joint], turn.undone(&self.frames[joint]));
        move |direction| undone * (rows * direction)
    }

    /// Returns a point with the turns of the joints inward of the leading one undone.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn unturned(&self, joints: &[Joint], mut point: Vec3A) -> Vec3A {
        let first = self.first();
        // The sines and cosines of two joints take little more time than those of one.
        for index in (first + 1..self.count()).rev().step_by(2) {
            let (inner, outer) = (&joints[index], &joints[index - 1]);
            let both = Vec4::new(inner.heading, inner.pitch, outer.heading, outer.pitch);
            let [inner, outer] = trig::halves_of_both(both).map(Turn::of_halves);
            point = self.undo_turn_at(index, &inner, point);
            if index - 1 > first {
                point = self.undo_turn_at(index - 1, &outer, point);
            }
        }
        point
    }

    /// Returns the leading joint's view of a point with these turns undone: the vector to it in the joint's frame.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn view(&self, unturned_point: Vec3A) -> Vec3A {
        let first = self.first();
        self.rows[first] * (unturned_point - self.places[first])
    }

    /// Undoes a joint's turn on a point.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn undo_turn_at(&self, joint: usize, turn: &Turn, point: Vec3A) -> Vec3A {
        let place = self.places[joint];
        place + self.undo_turn(joint, turn, point - place)
    }
}

/// The sines and cosines of a joint's pitch and heading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn(Vec4);

impl Turn {
    /// No turn: both angles are 0.
    pub(super) const NONE: Self = Self(Vec4::new(0.0, 1.0, 0.0, 1.0));

    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn new(angles: Pair) -> Self {
        Self::of_halves(trig::halves_of(angles))
    }

    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn of_halves(halves: Halves) -> Self {
        Self(trig::doubled(halves))
    }

    /// Undoes the turn on a vector along forward, left and up: applies its inverse.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn undo(&self, v: Vec3A) -> Vec3A {
        let [sin_p, cos_p, sin_h, cos_h] = self.0.to_array();
        // f·cos h + l·sin h, l·cos h − f·sin h, u; the same for the pitch with f and u.
        let level = v * Vec3A::new(cos_h, cos_h, 1.0) + v.yxz() * Vec3A::new(sin_h, -sin_h, 0.0);
        level * Vec3A::new(cos_p, 1.0, cos_p) + level.zyx() * Vec3A::new(sin_p, 0.0, -sin_p)
    }

    /// Returns the frame (f, l, u) times the inverse of the turn, F·Rᵀ.
    #[cfg_attr(not(aim_small), inline(always))]
    fn undone(&self, &Mat3A { x_axis: forward, y_axis: left, z_axis: up }: &Mat3A) -> Mat3A {
        let [sin_p, cos_p, sin_h, cos_h] = self.0.to_array();
        let level = forward * cos_p - up * sin_p;
        Mat3A::from_cols(level * cos_h - left * sin_h, level * sin_h + left * cos_h, forward * sin_p + up * cos_p)
    }

    /// Turns the frame (f, l, u).
    pub(super) fn of_frame(&self, frame: &Mat3A) -> Mat3A {
        let [sin_p, cos_p, sin_h, cos_h] = self.0.to_array();
        let Mat3A { x_axis: forward, y_axis: left, z_axis: up } = *frame;
        let level = forward * cos_h + left * sin_h;
        Mat3A::from_cols(level * cos_p + up * sin_p, left * cos_h - forward * sin_h, up * cos_p - level * sin_p)
    }
}

/// Returns a joint's angles as a pair.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn angles(joint: &Joint) -> Pair {
    Vec4::new(joint.heading, joint.pitch, joint.heading, joint.pitch)
}
