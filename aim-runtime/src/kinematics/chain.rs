//! [`Chain`]: a pose made ready for aiming, in units of the rig's own size, with the true forward kinematics that
//! judges and the rigid links that the derived kernels search with.

use core::ops::Range;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec3Swizzles};

use crate::kinematics::rotation::{correction, is_identity, joint_turn, tilted};
use crate::rig::{ChainRig, PerJoint, PoseSlices};
use crate::{Axes, Description, Effector, Joint, JointInfo, Scalar, math};

/// Nearer to the effector than this part of the rig's size a target has no direction.
pub(crate) const TOO_NEAR: f32 = 1e-5;
/// How far from square or from equal length joints' axes may be in a rigid pose, all that is off taken together.
pub(crate) const OFF: f32 = 1e-4;
/// The same where what is found as if they were square is true to rounding.
pub(crate) const OFF_BY_NOTHING: f32 = 1e-5;
/// Farther than this many sizes of the rig a target is a mere direction.
const FAR: f32 = 1e7;

/// A point and a direction (of any length but zero).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: Vec3A,
    pub(crate) direction: Vec3A,
}

impl Ray {
    pub(crate) fn turned(self, turn: Quat) -> Self {
        Self { origin: math::turned(turn, self.origin), direction: math::turned(turn, self.direction) }
    }

    pub(crate) fn through(self, transform: &Affine3A) -> Self {
        Self {
            origin: transform.transform_point3a(self.origin),
            direction: transform.transform_vector3a(self.direction),
        }
    }

    /// The angle between the ray and the direction to `target`, radians; `None` where that is undefined.
    pub(crate) fn angle_to(self, target: Vec3A) -> Option<f32> {
        let to_target = target - self.origin;
        // The negation also catches NaN.
        if !(to_target.dot(to_target) > TOO_NEAR * TOO_NEAR) {
            return None;
        }
        let square = self.direction.dot(self.direction);
        let is_plain = square > 1e-6 && square < 1e6;
        let direction = if is_plain { self.direction } else { math::direction(self.direction)? };
        let angle = math::angle_between(direction, to_target);
        angle.is_finite().then_some(angle)
    }
}

/// A pose made ready for aiming.
///
/// *Solver space* (`_ss`) has the pose's axes, its origin in the innermost joint and the rig's size as its unit: so
/// nothing depends on the scale of the rig, nor on how far it is from the world's origin.
///
/// A joint with an *upright* heading is aimed in its upright frame: its bone's, tilted upright.
pub(crate) struct Chain<const C: usize> {
    /// The joint that carries the effector; those before it do not matter.
    pub(crate) first: usize,
    /// The number of joints.
    pub(crate) count: usize,
    /// The effector in its joint's bone space; its origin in solver-space lengths where the pose is rigid.
    effector: Ray,
    /// The effector in solver space as the animation has it.
    animated: Ray,
    /// Each joint's animated transform in the next joint's space; the last one's in solver space. Only where the pose
    /// is not rigid: else the links say the same.
    local: Option<PerJoint<Affine3A, C>>,
    /// Rigid links for the kernels: from the joint before (from effector space for the first), orthogonal, in
    /// solver-space lengths, between upright frames.
    pub(crate) links: PerJoint<Affine3A, C>,
    /// How each joint's upright frame stands in its bone.
    pub(crate) tilts: PerJoint<Quat, C>,
    /// The last joint's upright rigid frame in solver space; its origin is the space's.
    pub(crate) base: Affine3A,
    space: Space,
}

/// The place of solver space in the pose's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space {
    pub(crate) origin: Vec3A,
    pub(crate) per_size: f32,
}

impl Space {
    /// The space of the joints from `first` on, the effector being this far from the origin of its own; `None` where the joints
    /// are not finite or too large or small to be seen.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn of_pose(pose: &[Affine3A], first: usize, offset: Vec3A) -> Option<Self> {
        let origin = pose[pose.len() - 1].translation;
        let size = size(&pose[first..], offset);
        let per_size = 1.0 / size;
        let is_seen = origin.is_finite() && size.is_finite() && per_size.is_finite() && per_size > 0.0;
        is_seen.then_some(Self { origin, per_size })
    }

    /// A point of the pose's space in solver space, brought near where it is a mere direction; `None` where it is not
    /// finite.
    pub(crate) fn to_solver(self, point: Vec3A) -> Option<Vec3A> {
        let from_origin = point - self.origin;
        let plain = from_origin * self.per_size;
        let square = plain.dot(plain);
        // Neither so small nor so large that its square would not do.
        if square > 1e-30 && square < FAR * FAR { Some(plain) } else { self.far_to_solver(from_origin) }
    }

    #[cold]
    fn far_to_solver(self, from_origin: Vec3A) -> Option<Vec3A> {
        let distance = math::length(from_origin) * self.per_size;
        if !from_origin.is_finite() || distance.is_nan() {
            return None;
        }
        if distance > FAR { Some(math::direction(from_origin)? * FAR) } else { Some(from_origin * self.per_size) }
    }

    /// A point of solver space in the pose's space.
    pub(crate) fn to_pose(self, point: Vec3A) -> Vec3A {
        self.origin + point / self.per_size
    }
}

/// What upright headings turn about.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Upright {
    /// Their bones' own up.
    Off,
    /// This direction of the pose's space.
    About(Vec3A),
    /// The innermost joint's animated up.
    Innermost,
}

impl<const C: usize> Chain<C> {
    /// `pose` with `first` as the joint that is aimed; `None` where it is not finite or does not span space.
    #[inline]
    pub(crate) fn new(rig: &ChainRig<'_, C>, pose: &[Affine3A], first: usize, about: Upright) -> Option<Self> {
        let infos = rig.joints;
        let count = infos.len();
        if count == 0 || pose.len() != count {
            return None;
        }
        let first = first.min(count - 1);
        let effector = effector(rig, first);
        let mut frames = rig.array(Mat3A::IDENTITY);
        let rigid = orthogonal_frames(pose, first, &mut frames)?.is_rigid();
        let offset = pose[first].transform_vector3a(effector.origin);
        let space = Space::of_pose(pose, first, offset)?;
        let Space { origin, per_size } = space;

        let mut tilts = rig.array(Quat::IDENTITY);
        upright(infos, first, about, &mut frames, &mut tilts);
        let mut links = rig.array(Affine3A::IDENTITY);
        for index in first..count {
            let outward = frames[index].transpose();
            links[index] = if index == first {
                let axes = effector_axes(rig, first);
                let tilt = tilts[first];
                Affine3A {
                    matrix3: if is_identity(tilt) { axes } else { Mat3A::from_quat(tilt.conjugate()) * axes },
                    translation: outward * (offset * per_size),
                }
            } else {
                let step = pose[index - 1].translation - pose[index].translation;
                Affine3A { matrix3: outward * frames[index - 1], translation: outward * (step * per_size) }
            };
        }
        let mut effector = effector;
        let local = if rigid {
            effector.origin = frames[first].transpose() * (offset * per_size);
            let tilt = tilts[first];
            if !is_identity(tilt) {
                effector.origin = math::turned(tilt, effector.origin);
            }
            None
        } else {
            Some(local(rig, pose, first, origin, per_size)?)
        };
        let base = Affine3A { matrix3: frames[count - 1], translation: Vec3A::ZERO };
        let tilt = tilts[first];
        let upright =
            if is_identity(tilt) { effector.direction } else { math::turned(tilt.conjugate(), effector.direction) };
        let animated =
            Ray { origin: (pose[first].translation - origin + offset) * per_size, direction: frames[first] * upright };
        let mut chain = Self { first, count, effector, animated, local, links, tilts, base, space };
        if !rigid {
            chain.animated = (first..count).fold(effector, |ray, index| chain.outward(index, ray));
            // A direction of no length (or of none after a flat scale) aims nowhere.
            math::direction(chain.animated.direction)?;
        }
        Some(chain)
    }

    /// Whether the links are all there is to the pose: no shear, no non-uniform scale.
    pub(crate) fn is_rigid(&self) -> bool {
        self.local.is_none()
    }

    /// The place of solver space in the pose's.
    pub(crate) fn space(&self) -> Space {
        self.space
    }

    /// The effector before its joint's added rotation, in that joint's space.
    pub(crate) fn effector(&self) -> Ray {
        self.effector
    }

    /// A ray in a joint's space, after its added rotation, in the next joint's space (solver space for the last).
    pub(crate) fn outward(&self, joint: usize, ray: Ray) -> Ray {
        match &self.local {
            Some(local) => ray.through(&local[joint]),
            None => {
                // Links stand between upright frames.
                let tilts = &self.tilts;
                let turned = |ray: Ray, tilt: Quat| if is_identity(tilt) { ray } else { ray.turned(tilt) };
                let ray = turned(ray, tilts[joint].conjugate());
                match tilts.get(joint + 1) {
                    Some(tilt) => turned(ray.through(&self.links[joint + 1]), *tilt),
                    None => ray.through(&self.base),
                }
            }
        }
    }

    /// Each joint's true frame in solver space before its added rotation.
    pub(crate) fn frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let Some(local) = &self.local else { return self.rigid_frames(turns, frames) };
        let mut frame = Affine3A::IDENTITY;
        for index in (self.first..self.count).rev() {
            frame *= local[index];
            frames[index] = frame;
            frame *= Affine3A::from_quat(turns[index]);
        }
    }

    /// The same for the rigid links. Both only for chains without upright headings.
    pub(crate) fn rigid_frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let links = &self.links;
        let mut frame = self.base;
        for index in (self.first..self.count).rev() {
            frames[index] = frame;
            frame = frame * Affine3A::from_quat(turns[index]) * links[index];
        }
    }

    /// The effector in solver space with the joints turned like this: the true forward kinematics.
    pub(crate) fn gaze(&self, turns: &[Quat]) -> Ray {
        let mut ray = self.effector;
        for (index, turn) in turns.iter().enumerate().take(self.count).skip(self.first) {
            ray = self.outward(index, ray.turned(*turn));
        }
        ray
    }

    /// The joints' corrections: the rotations that they add in their bones' own spaces.
    pub(crate) fn corrections(&self, rig: &ChainRig<'_, C>, joints: &[Joint]) -> PerJoint<Quat, C> {
        let mut corrections = self.tilts;
        corrections_of(rig, joints, &mut corrections);
        corrections
    }

    /// The effector in solver space with the joints at these angles: the true forward kinematics.
    pub(crate) fn gaze_of(&self, rig: &ChainRig<'_, C>, joints: &[Joint]) -> Ray {
        self.posed(rig, joints).0
    }

    /// The same, with the joints' corrections.
    pub(crate) fn posed(&self, rig: &ChainRig<'_, C>, joints: &[Joint]) -> (Ray, PerJoint<Quat, C>) {
        if !self.is_rigid() {
            let corrections = self.corrections(rig, joints);
            return (self.gaze(&corrections), corrections);
        }
        // Links stand between upright frames: a tilt is only for what a joint adds in its bone.
        let mut corrections = self.tilts;
        let own = self.tilts[self.first];
        let mut ray = if is_identity(own) { self.effector } else { self.effector.turned(own.conjugate()) };
        for (index, (tilt, (joint, info))) in corrections.iter_mut().zip(joints.iter().zip(rig.joints)).enumerate() {
            let turn = joint_turn(info, joint);
            *tilt = tilted(turn, *tilt);
            if index >= self.first {
                let direction = math::turned(turn, ray.direction);
                // Joint 0's effector is mostly its own origin.
                let origin = if ray.origin == Vec3A::ZERO { ray.origin } else { math::turned(turn, ray.origin) };
                ray = Ray { origin, direction }.through(self.links.get(index + 1).unwrap_or(&self.base));
            }
        }
        (ray, corrections)
    }

    /// The effector in solver space as the animation has it.
    pub(crate) fn animated_gaze(&self) -> Ray {
        self.animated
    }

    /// The target that makes the rigid links see what the true effector sees: for a rigid pose the target itself.
    ///
    /// `effector` and `rigid_effector` are the effector as the true forward kinematics and as the rigid links have
    /// it, all in solver space. Without this, a search along the rigid links would end where *they* aim.
    pub(crate) fn seen_target(&self, target: Vec3A, effector: Ray, rigid_effector: Ray) -> Vec3A {
        if self.is_rigid() {
            return target;
        }
        let to_target = target - effector.origin;
        let directions = math::direction(to_target)
            .zip(math::direction(effector.direction))
            .zip(math::direction(rigid_effector.direction));
        match directions {
            Some(((wanted, seen), rigid)) => {
                let turn = math::arc(seen, wanted);
                rigid_effector.origin + math::turned(turn, rigid) * to_target.length()
            }
            None => target,
        }
    }
}

/// The ray that is aimed by joint `first`: its own forward from its own origin, for joint 0 the declared effector.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn effector<const C: usize>(rig: &ChainRig<'_, C>, first: usize) -> Ray {
    if first == 0 {
        Ray { origin: Vec3A::from(rig.effector.origin), direction: Vec3A::from(rig.effector.forward) }
    } else {
        Ray { origin: Vec3A::ZERO, direction: Vec3A::from(rig.joints[first].axes.forward) }
    }
}

/// The effector in solver space by the joints' transforms as they are, with these corrections; `None` where a joint does not
/// span space.
#[cold]
pub(crate) fn true_gaze<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &[Affine3A],
    first: usize,
    space: Space,
    corrections: &[Quat],
) -> Option<Ray> {
    let local = local(rig, pose, first, space.origin, space.per_size)?;
    let joints = first..pose.len();
    Some(joints.fold(effector(rig, first), |ray, joint| ray.turned(corrections[joint]).through(&local[joint])))
}

/// The distance of joints' axes from square and from equal length, all that is off taken together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Off(Vec3A);

impl Off {
    /// True if joints are scaled, turned and mirrored alone; not where a number is NaN.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn is_rigid(self) -> bool {
        self.0.cmple(Vec3A::splat(OFF)).all()
    }

    /// True if what is found of orthogonal frames is true of the joints to rounding.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn is_nothing(self) -> bool {
        self.0.cmple(Vec3A::splat(OFF_BY_NOTHING)).all()
    }
}

/// Finds each joint's orthogonal frame from `first` on, and how far the pose is off those; `None` where a joint does not span
/// space.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn orthogonal_frames(pose: &[Affine3A], first: usize, frames: &mut [Mat3A]) -> Option<Off> {
    let off = similar(&pose[first..], &mut frames[first..]);
    if !off.is_rigid() {
        for (frame, joint) in frames.iter_mut().zip(pose).skip(first) {
            *frame = math::orthonormal(joint.matrix3)?;
        }
    }
    Some(off)
}

/// Turns how each joint's upright frame stands in its bone into what the joint adds in its bone's own space.
pub(crate) fn corrections_of<const C: usize>(rig: &ChainRig<'_, C>, joints: &[Joint], tilts: &mut [Quat]) {
    for ((tilt, joint), info) in tilts.iter_mut().zip(joints).zip(rig.joints) {
        *tilt = correction(info, joint, *tilt);
    }
}

/// How each joint's upright frame stands in its bone; not at all where a joint does not span space.
pub(crate) fn tilts<const C: usize>(rig: &ChainRig<'_, C>, pose: &[Affine3A], about: Upright) -> PerJoint<Quat, C> {
    let mut tilts = rig.array(Quat::IDENTITY);
    let mut frames = rig.array(Mat3A::IDENTITY);
    if pose.len() == rig.joints.len() && orthogonal_frames(pose, 0, &mut frames).is_some() {
        upright(rig.joints, 0, about, &mut frames, &mut tilts);
    }
    tilts
}

/// The orthogonal frames of joints that are scaled, turned and mirrored alone, and how far one is more than that; NaN where
/// its numbers are so large or small that their squares would not do.
#[cfg_attr(not(aim_small), inline(always))]
fn similar(pose: &[Affine3A], frames: &mut [Mat3A]) -> Off {
    // A sum that begins with −0 costs nothing for its first term.
    let mut off = Vec3A::splat(-0.0);
    for (joint, frame) in pose.iter().zip(frames) {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = joint.matrix3;
        // Of a matrix whose rows are square and equally long, so are the columns; and rows need no sums of lanes.
        let squares = x * x + y * y + z * z;
        // Squares are not negative, and NaN and 0 fail below.
        let per_length = 1.0 / <f32 as Scalar>::sqrt(squares.x);
        *frame = joint.matrix3 * per_length;
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = *frame;
        let products = x * x.yzx() + y * y.yzx() + z * z.yzx();
        // Sums, not maxima: they keep NaN. A length beyond what can be squared leaves one too.
        off += (squares * (per_length * per_length) - Vec3A::ONE).abs() + products.abs();
    }
    Off(off)
}

/// The square of the scale of joints that are turned and mirrored, and scaled all alike; `None` where they are more
/// than that by more than `most_off`, or where numbers are so large or small that their squares would not do.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn common_scale(pose: &[Affine3A], most_off: f32) -> Option<f32> {
    const PLAIN: Range<f32> = 1e-12..1e12;
    let squares = |Mat3A { x_axis: x, y_axis: y, z_axis: z }| x * x + y * y + z * z;
    let square = squares(pose.first()?.matrix3).x;
    let squares_alike = Vec3A::splat(square);
    // As in `similar`, all that is off taken together.
    let mut off = Vec3A::splat(-0.0);
    for joint in pose {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = joint.matrix3;
        let products = x * x.yzx() + y * y.yzx() + z * z.yzx();
        off += (squares(joint.matrix3) - squares_alike).abs() + products.abs();
    }
    (off.cmple(squares_alike * most_off).all() && math::is_within_positive(square, PLAIN)).then_some(square)
}

/// Each joint's animated transform in the next joint's space, the last one's in solver space.
#[cold]
fn local<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &[Affine3A],
    first: usize,
    origin: Vec3A,
    per_size: f32,
) -> Option<PerJoint<Affine3A, C>> {
    let mut local = rig.array(Affine3A::IDENTITY);
    let to_solver = |joint: &Affine3A| Affine3A {
        matrix3: joint.matrix3 * per_size,
        translation: (joint.translation - origin) * per_size,
    };
    for index in first..pose.len() {
        let joint = to_solver(&pose[index]);
        local[index] = match pose.get(index + 1) {
            Some(next) => inverse(&to_solver(next)) * joint,
            None => joint,
        };
    }
    local.iter().all(|transform| transform.is_finite()).then_some(local)
}

/// Tilts the frames of joints with an upright heading upright, by the shortest arc, and tells how in their bones' spaces.
///
/// A bone that leans by more than a right angle (of a character on all fours, say) is tilted less and less, and not at
/// all when it hangs upside down: there is no shortest arc.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn upright(infos: &[JointInfo], first: usize, about: Upright, frames: &mut [Mat3A], tilts: &mut [Quat]) {
    /// The cosines of the leans from which tilting fades, and at which nothing is left of it.
    const FADES: f32 = 0.0;
    const GONE: f32 = -0.5;
    let up = match about {
        Upright::Off => return,
        Upright::About(up) => up,
        Upright::Innermost => {
            let last = infos.len() - 1;
            frames[last] * Vec3A::from(infos[last].axes.up)
        }
    };
    for index in first..infos.len() {
        let share = infos[index].effective_upright();
        if !(share > 0.0) {
            continue;
        }
        let bone_up = Vec3A::from(infos[index].axes.up);
        let wanted = frames[index].transpose() * up;
        let cosine = bone_up.dot(wanted);
        let part = share * ((cosine - GONE) / (FADES - GONE)).max(0.0).min(1.0);
        if !(part > 0.0) {
            continue;
        }
        // Half of the arc is the quaternion of the whole; a part of it, of the part.
        let wanted = if part < 1.0 { math::part_of_arc(bone_up, wanted, part) } else { wanted };
        let axis = math::cross(bone_up, wanted);
        let along = 1.0 + bone_up.dot(wanted);
        let per_length = 1.0 / math::sqrt(axis.dot(axis) + along * along);
        let axis = axis * per_length;
        let tilt = Quat::from_xyzw(axis.x, axis.y, axis.z, along * per_length);
        if tilt.is_finite() {
            tilts[index] = tilt;
            frames[index] *= Mat3A::from_quat(tilt);
        }
    }
}

/// The length that stands for the rig: from the innermost joint along the chain to the effector; where the chain has
/// no length, that of a bone's axis.
#[inline]
fn size(pose: &[Affine3A], offset: Vec3A) -> f32 {
    let extent = |length: fn(Vec3A) -> f32| {
        let links = pose.windows(2).map(|pair| length(pair[0].translation - pair[1].translation));
        links.fold(length(offset), |sum, link| sum + link)
    };
    let plain = extent(Vec3A::length);
    if plain > 1e-12 && plain < 1e12 {
        return plain;
    }
    let extent = extent(math::length);
    let axes = pose.iter().flat_map(|joint| [joint.matrix3.x_axis, joint.matrix3.y_axis, joint.matrix3.z_axis]);
    let scale = axes.map(math::length).fold(0.0, f32::max);
    if extent > 1e-6 * scale { extent } else { scale }
}

/// The inverse of a transform that [`math::orthonormal`] accepted. Scaled first: a determinant is a cube.
pub(crate) fn inverse(joint: &Affine3A) -> Affine3A {
    let scale = math::length(joint.matrix3.x_axis);
    let inverse = math::inverse(joint.matrix3 * (1.0 / scale)) * (1.0 / scale);
    Affine3A { matrix3: inverse, translation: -(inverse * joint.translation) }
}

/// The effector as the rigid links have it, in the space that `effector_to_joint` leads to.
pub(crate) fn rigid_effector(effector: &Effector, effector_to_joint: &Affine3A) -> Ray {
    let forward = effector.forward.into();
    Ray { origin: effector_to_joint.translation, direction: effector_to_joint.transform_vector3a(forward) }
}

/// Effector space in the space of the joint that carries the effector. For joint 0 they have the same axes. For
/// another joint, the direction that the kernels aim becomes that joint's own forward.
fn effector_axes<const C: usize>(rig: &ChainRig<'_, C>, first: usize) -> Mat3A {
    if first == 0 {
        return Mat3A::IDENTITY;
    }
    let infos = rig.joints;
    let Axes { up, forward, left } = infos[first].axes;
    let [forward, left, up] = [forward, left, up].map(Vec3A::from);
    let [from_forward, from_left, from_up] = rig.effector.axes(&infos[0].axes);
    Mat3A::from_cols(forward, left, up) * Mat3A::from_cols(from_forward, from_left, from_up).transpose()
}

/// Whether an eye between two can lead: the eyes look along joint 0's own forward, from its own origin.
pub(crate) fn can_lead(rig: &Description<'_>) -> bool {
    rig.joints.first().is_some_and(|info| rig.aims_joint_0() && info.effective_upright() == 0.0)
}

/// The joint that leads, in the pose's space: joint 0 itself, or moved to the middle between the eyes.
pub(crate) fn leading_eye(rig: &Description<'_>, pose: &PoseSlices<'_>) -> Option<Affine3A> {
    let mut joint = *pose.joints.first()?;
    if let Some(other_eye) = pose.other_eye.filter(|_| can_lead(rig)) {
        joint.translation = 0.5 * joint.translation + 0.5 * other_eye.translation;
    }
    Some(joint)
}
