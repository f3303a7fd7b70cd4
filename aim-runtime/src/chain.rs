//! [`Chain`]: a pose made ready for aiming, in units of the rig's own size, with the true forward kinematics that
//! judges and the rigid links that the derived kernels search with.

use core::ops::Range;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec3Swizzles};

use crate::{AimRig, Axes, Joint, JointInfo, Scalar, math};

/// Nearer to the effector than this part of the rig's size a target has no direction.
pub(crate) const TOO_NEAR: f32 = 1e-5;
/// How far from square or from equal length joints' axes may be in a rigid pose, all that is off taken together.
const OFF: f32 = 1e-4;
/// Farther than this many sizes of the rig a target is a mere direction.
const FAR: f32 = 1e6;

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
        let distance = to_target.length();
        // The negation also catches NaN.
        if !(distance > TOO_NEAR) {
            return None;
        }
        let angle = math::angle_between(math::direction(self.direction)?, to_target / distance);
        angle.is_finite().then_some(angle)
    }
}

/// A pose made ready for aiming.
///
/// *Solver space* (`_ss`) has the pose's axes, its origin in the innermost joint and the rig's size as its unit: so
/// nothing depends on the scale of the rig, nor on how far it is from the world's origin.
///
/// A joint with a *level* heading is aimed in its levelled frame: its bone's, tilted upright.
pub(crate) struct Chain<R: AimRig> {
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
    local: Option<R::Array<Affine3A>>,
    /// Rigid links for the kernels: from the joint before (from effector space for the first), orthogonal, in
    /// solver-space lengths, between levelled frames.
    pub(crate) links: R::Array<Affine3A>,
    /// How each joint's levelled frame stands in its bone.
    pub(crate) tilts: R::Array<Quat>,
    /// The last joint's levelled rigid frame in solver space; its origin is the space's.
    pub(crate) base: Affine3A,
    /// Pose space to solver space.
    origin: Vec3A,
    per_size: f32,
}

/// What headings of level joints turn about.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Level {
    /// Their bones' own up.
    Off,
    /// This direction of the pose's space.
    About(Vec3A),
    /// The innermost joint's animated up.
    Innermost,
}

impl<R: AimRig> Chain<R> {
    /// `pose` with `first` as the joint that is aimed; `None` where it is not finite or does not span space.
    #[inline]
    pub(crate) fn new(rig: &R, pose: &[Affine3A], first: usize, level: Level) -> Option<Self> {
        let infos = rig.joint_infos();
        let count = infos.len();
        if count == 0 || pose.len() < count {
            return None;
        }
        let first = first.min(count - 1);
        let pose = &pose[..count];
        let declared = rig.effector();
        let effector = if first == 0 {
            Ray { origin: Vec3A::from(declared.origin), direction: Vec3A::from(declared.forward) }
        } else {
            Ray { origin: Vec3A::ZERO, direction: Vec3A::from(infos[first].axes.forward) }
        };

        let mut frames = rig.array(Mat3A::IDENTITY);
        let rigid = similar(&pose[first..], &mut frames.as_mut()[first..]);
        if !rigid {
            for (frame, joint) in frames.as_mut().iter_mut().zip(pose).skip(first) {
                *frame = math::orthonormal(joint.matrix3)?;
            }
        }
        let origin = pose[count - 1].translation;
        let offset = pose[first].transform_vector3a(effector.origin);
        let size = size(&pose[first..], offset);
        let per_size = 1.0 / size;
        if !(origin.is_finite() && size.is_finite() && per_size.is_finite() && per_size > 0.0) {
            return None;
        }

        let mut tilts = rig.array(Quat::IDENTITY);
        upright(infos, first, level, frames.as_mut(), tilts.as_mut());
        let frames = frames.as_ref();
        let mut links = rig.array(Affine3A::IDENTITY);
        for index in first..count {
            let outward = frames[index].transpose();
            links.as_mut()[index] = if index == first {
                let axes = effector_axes(rig, first);
                let tilt = tilts.as_ref()[first];
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
            let tilt = tilts.as_ref()[first];
            if !is_identity(tilt) {
                effector.origin = math::turned(tilt, effector.origin);
            }
            None
        } else {
            Some(local(rig, pose, first, origin, per_size)?)
        };
        let base = Affine3A { matrix3: frames[count - 1], translation: Vec3A::ZERO };
        let tilt = tilts.as_ref()[first];
        let upright =
            if is_identity(tilt) { effector.direction } else { math::turned(tilt.conjugate(), effector.direction) };
        let animated =
            Ray { origin: (pose[first].translation - origin + offset) * per_size, direction: frames[first] * upright };
        let mut chain = Self { first, count, effector, animated, local, links, tilts, base, origin, per_size };
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

    /// A point of the pose's space in solver space, brought near where it is a mere direction; `None` where it is not
    /// finite.
    pub(crate) fn to_solver(&self, point: Vec3A) -> Option<Vec3A> {
        let from_origin = point - self.origin;
        let distance = math::length(from_origin) * self.per_size;
        if !from_origin.is_finite() || distance.is_nan() {
            return None;
        }
        if distance > FAR { Some(math::direction(from_origin)? * FAR) } else { Some(from_origin * self.per_size) }
    }

    /// A point of solver space in the pose's space.
    pub(crate) fn to_pose(&self, point: Vec3A) -> Vec3A {
        self.origin + point / self.per_size
    }

    /// The effector before its joint's added rotation, in that joint's space.
    pub(crate) fn effector(&self) -> Ray {
        self.effector
    }

    /// A ray in a joint's space, after its added rotation, in the next joint's space (solver space for the last).
    pub(crate) fn outward(&self, joint: usize, ray: Ray) -> Ray {
        match &self.local {
            Some(local) => ray.through(&local.as_ref()[joint]),
            None => {
                // Links stand between levelled frames.
                let tilts = self.tilts.as_ref();
                let turned = |ray: Ray, tilt: Quat| if is_identity(tilt) { ray } else { ray.turned(tilt) };
                let ray = turned(ray, tilts[joint].conjugate());
                match tilts.get(joint + 1) {
                    Some(tilt) => turned(ray.through(&self.links.as_ref()[joint + 1]), *tilt),
                    None => ray.through(&self.base),
                }
            }
        }
    }

    /// Each joint's true frame in solver space before its added rotation.
    pub(crate) fn frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let Some(local) = &self.local else { return self.rigid_frames(turns, frames) };
        let local = local.as_ref();
        let mut frame = Affine3A::IDENTITY;
        for index in (self.first..self.count).rev() {
            frame *= local[index];
            frames[index] = frame;
            frame *= Affine3A::from_quat(turns[index]);
        }
    }

    /// The same for the rigid links. Both only for chains without level headings.
    pub(crate) fn rigid_frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let links = self.links.as_ref();
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

/// The rotations that the joints add, in their bones' own spaces.
pub(crate) fn turns<R: AimRig>(rig: &R, joints: &[Joint]) -> R::Array<Quat> {
    let mut turns = rig.array(Quat::IDENTITY);
    for ((turn, joint), info) in turns.as_mut().iter_mut().zip(joints).zip(rig.joint_infos()) {
        *turn = joint.own_correction(info);
    }
    turns
}

/// The orthogonal frames of joints that are scaled, turned and mirrored alone; false where one is more than that, or
/// where its numbers are so large or small that their squares would not do.
#[inline(always)]
pub(crate) fn similar(pose: &[Affine3A], frames: &mut [Mat3A]) -> bool {
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
    off.cmple(Vec3A::splat(OFF)).all()
}

/// The square of the scale of joints that are turned and mirrored, and scaled all alike; `None` where they are more
/// than that, or where numbers are so large or small that their squares would not do.
#[inline(always)]
pub(crate) fn common_scale(pose: &[Affine3A]) -> Option<f32> {
    const PLAIN: Range<f32> = 1e-12..1e12;
    let squares = |Mat3A { x_axis: x, y_axis: y, z_axis: z }| x * x + y * y + z * z;
    let square = squares(pose.first()?.matrix3).x;
    // As in `similar`, all that is off taken together.
    let mut off = Vec3A::splat(-0.0);
    for joint in pose {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = joint.matrix3;
        let products = x * x.yzx() + y * y.yzx() + z * z.yzx();
        off += (squares(joint.matrix3) - square).abs() + products.abs();
    }
    (off.cmple(Vec3A::splat(OFF * square)).all() && PLAIN.contains(&square)).then_some(square)
}

/// Each joint's animated transform in the next joint's space, the last one's in solver space.
#[cold]
fn local<R: AimRig>(
    rig: &R,
    pose: &[Affine3A],
    first: usize,
    origin: Vec3A,
    per_size: f32,
) -> Option<R::Array<Affine3A>> {
    let mut local = rig.array(Affine3A::IDENTITY);
    let to_solver = |joint: &Affine3A| Affine3A {
        matrix3: joint.matrix3 * per_size,
        translation: (joint.translation - origin) * per_size,
    };
    for index in first..pose.len() {
        let joint = to_solver(&pose[index]);
        local.as_mut()[index] = match pose.get(index + 1) {
            Some(next) => inverse(&to_solver(next)) * joint,
            None => joint,
        };
    }
    local.as_ref().iter().all(|transform| transform.is_finite()).then_some(local)
}

/// Tilts the frames of joints with a level heading upright, by the shortest arc, and tells how in their bones' spaces.
///
/// A bone that leans by more than a right angle (of a character on all fours, say) is tilted less and less, and not at
/// all when it hangs upside down: there is no shortest arc.
#[inline(always)]
pub(crate) fn upright(infos: &[JointInfo], first: usize, level: Level, frames: &mut [Mat3A], tilts: &mut [Quat]) {
    /// The cosines of the leans from which tilting fades, and at which nothing is left of it.
    const FADES: f32 = 0.0;
    const GONE: f32 = -0.5;
    let up = match level {
        Level::Off => return,
        Level::About(up) => up,
        Level::Innermost => {
            let last = infos.len() - 1;
            frames[last] * Vec3A::from(infos[last].axes.up)
        }
    };
    for index in first..infos.len() {
        let level = infos[index].effective_level();
        if !(level > 0.0) {
            continue;
        }
        let bone_up = Vec3A::from(infos[index].axes.up);
        let wanted = frames[index].transpose() * up;
        let cosine = bone_up.dot(wanted);
        let part = level * ((cosine - GONE) / (FADES - GONE)).max(0.0).min(1.0);
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

#[inline(always)]
pub(crate) fn is_identity(turn: Quat) -> bool {
    turn.x == 0.0 && turn.y == 0.0 && turn.z == 0.0
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

/// Effector space in the space of the joint that carries the effector. For joint 0 they have the same axes. For
/// another joint, the direction that the kernels aim becomes that joint's own forward.
fn effector_axes<R: AimRig>(rig: &R, first: usize) -> Mat3A {
    if first == 0 {
        return Mat3A::IDENTITY;
    }
    let infos = rig.joint_infos();
    let Axes { up, forward, left } = infos[first].axes;
    let [forward, left, up] = [forward, left, up].map(Vec3A::from);
    let [from_forward, from_left, from_up] = rig.effector().axes(&infos[0].axes);
    Mat3A::from_cols(forward, left, up) * Mat3A::from_cols(from_forward, from_left, from_up).transpose()
}
