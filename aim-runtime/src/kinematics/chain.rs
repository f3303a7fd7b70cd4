//! [`Chain`]: a pose prepared for aiming, in units of the rig's own size. It holds the true forward kinematics, which
//! measure the result, and the rigid links on which the derived kernels search.

use core::ops::Range;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec3Swizzles};

use crate::kinematics::rotation::{correction, is_identity, joint_turn, tilted};
use crate::rig::{ChainRig, PerJoint, PoseSlices};
use crate::{Axes, Description, Effector, Joint, JointInfo, Scalar, math};

/// Distance from the effector, relative to the rig's size, below which a target has no direction.
pub(crate) const TOO_NEAR: f32 = 1e-5;
/// Largest deviation of joints' axes from orthogonal and equally long in a rigid pose, summed over joints.
pub(crate) const RIGID_DEVIATION: f32 = 1e-4;
/// Largest such deviation at which orthogonal frames lead a gaze to within a small part of the tolerance (0.03°).
const SLIGHT_DEVIATION: f32 = 1e-3;
/// Largest such deviation at which results for orthogonal frames hold for the true pose to within rounding.
pub(crate) const NEGLIGIBLE_DEVIATION: f32 = 1e-5;
/// Distance, in sizes of the rig, beyond which a target is treated as a direction.
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

    /// Returns the angle between the ray and the direction to `target`, radians; `None` if it is undefined.
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

/// A pose prepared for aiming.
///
/// *Solver space* (`_ss`) has the pose's axes, its origin at the innermost joint, and the rig's size as its unit.
/// Therefore results depend neither on the rig's scale nor on its distance from the world's origin.
///
/// A joint with an *upright* heading is aimed in its upright frame: the bone's frame, tilted so that its up is the
/// character's.
pub(crate) struct Chain<const C: usize> {
    /// The joint that carries the effector; joints before it have no effect.
    pub(crate) first: usize,
    /// The number of joints.
    pub(crate) count: usize,
    /// Effector in its joint's bone space; for a rigid pose its origin is in solver-space lengths.
    effector: Ray,
    /// Animated effector, in solver space.
    animated: Ray,
    /// Each joint's animated transform in the next joint's space; the last one's in solver space. `None` for a rigid
    /// pose, where the links hold the same information.
    local: Option<PerJoint<Affine3A, C>>,
    /// Rigid links for the kernels, each from the previous joint (from effector space for the first): orthogonal, in
    /// solver-space lengths, between upright frames.
    pub(crate) links: PerJoint<Affine3A, C>,
    /// Orientation of each joint's upright frame in its bone's space.
    pub(crate) tilts: PerJoint<Quat, C>,
    /// Upright rigid frame of the last joint in solver space, with its origin at that of the space.
    pub(crate) base: Affine3A,
    space: Space,
}

/// Origin and scale of solver space in the pose's space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space {
    pub(crate) origin: Vec3A,
    pub(crate) per_size: f32,
}

impl Space {
    /// Returns the solver space of the joints from `first` on. `offset` leads from the origin of joint `first` to the
    /// effector, `None` if they coincide. `None` if the joints are not finite, or if their size is too large or too
    /// small to be inverted.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn of_pose(pose: &[Affine3A], first: usize, offset: Option<Vec3A>) -> Option<Self> {
        let origin = pose[pose.len() - 1].translation;
        let plain = extent(&pose[first..], offset, Vec3A::length);
        let size = if math::is_within_positive(plain, 1e-12..1e12) {
            plain
        } else {
            extreme_size(&pose[first..], offset).filter(|size| (1.0 / size).is_finite() && 1.0 / size > 0.0)?
        };
        origin.is_finite().then_some(Self { origin, per_size: 1.0 / size })
    }

    /// Converts a point of the pose's space to solver space. A point further than [`FAR`] is moved nearer in its
    /// direction. `None` if it is not finite.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn to_solver(self, point: Vec3A) -> Option<Vec3A> {
        let from_origin = point - self.origin;
        let plain = from_origin * self.per_size;
        let square = plain.dot(plain);
        // Only if the square neither underflows nor overflows.
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

    /// Converts a point of solver space to the pose's space.
    pub(crate) fn to_pose(self, point: Vec3A) -> Vec3A {
        self.origin + point / self.per_size
    }
}

/// Axis of upright headings.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Upright {
    /// Each bone's own up.
    Off,
    /// This direction of the pose's space.
    About(Vec3A),
    /// Animated up of the innermost joint.
    Innermost,
}

impl<const C: usize> Chain<C> {
    /// Prepares `pose` for aiming joint `first`. `None` if a transform is not finite or has linearly dependent axes.
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
        let space = Space::of_pose(pose, first, Some(offset))?;
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
            // A direction of length zero (or flattened to it by scale) cannot be aimed.
            math::direction(chain.animated.direction)?;
        }
        Some(chain)
    }

    /// Returns `true` if the links describe the pose completely: no shear, no non-uniform scale.
    pub(crate) fn is_rigid(&self) -> bool {
        self.local.is_none()
    }

    /// Returns origin and scale of solver space in the pose's space.
    pub(crate) fn space(&self) -> Space {
        self.space
    }

    /// Returns the effector before its joint's added rotation, in that joint's space.
    pub(crate) fn effector(&self) -> Ray {
        self.effector
    }

    /// Transforms a ray from a joint's space, after its added rotation, to the next joint's space (solver space for the
    /// last).
    pub(crate) fn outward(&self, joint: usize, ray: Ray) -> Ray {
        match &self.local {
            Some(local) => ray.through(&local[joint]),
            None => {
                // Links connect upright frames, so the tilts are undone before and applied after.
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

    /// Writes each joint's true frame in solver space before its added rotation. Only for chains without upright
    /// headings.
    pub(crate) fn frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let Some(local) = &self.local else { return self.rigid_frames(turns, frames) };
        let mut frame = Affine3A::IDENTITY;
        for index in (self.first..self.count).rev() {
            frame *= local[index];
            frames[index] = frame;
            frame *= Affine3A::from_quat(turns[index]);
        }
    }

    /// Writes each joint's frame along the rigid links in solver space before its added rotation. Only for chains
    /// without upright headings.
    pub(crate) fn rigid_frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let links = &self.links;
        let mut frame = self.base;
        for index in (self.first..self.count).rev() {
            frames[index] = frame;
            frame = frame * Affine3A::from_quat(turns[index]) * links[index];
        }
    }

    /// Returns the effector in solver space with the joints turned by these corrections: the true forward kinematics.
    pub(crate) fn gaze(&self, turns: &[Quat]) -> Ray {
        let mut ray = self.effector;
        for (index, turn) in turns.iter().enumerate().take(self.count).skip(self.first) {
            ray = self.outward(index, ray.turned(*turn));
        }
        ray
    }

    /// Returns the joints' corrections: the rotations that they add in their bones' own spaces.
    pub(crate) fn corrections(&self, rig: &ChainRig<'_, C>, joints: &[Joint]) -> PerJoint<Quat, C> {
        let mut corrections = self.tilts;
        corrections_of(rig, joints, &mut corrections);
        corrections
    }

    /// Returns the effector in solver space with the joints at these angles: the true forward kinematics.
    pub(crate) fn gaze_of(&self, rig: &ChainRig<'_, C>, joints: &[Joint]) -> Ray {
        self.gaze_and_corrections(rig, joints).0
    }

    /// Returns the effector in solver space with the joints at these angles, and the joints' corrections.
    pub(crate) fn gaze_and_corrections(&self, rig: &ChainRig<'_, C>, joints: &[Joint]) -> (Ray, PerJoint<Quat, C>) {
        if !self.is_rigid() {
            let corrections = self.corrections(rig, joints);
            return (self.gaze(&corrections), corrections);
        }
        // Links connect upright frames, so a tilt only enters the correction of its own bone.
        let mut corrections = self.tilts;
        let own = self.tilts[self.first];
        let mut ray = if is_identity(own) { self.effector } else { self.effector.turned(own.conjugate()) };
        for (index, (tilt, (joint, info))) in corrections.iter_mut().zip(joints.iter().zip(rig.joints)).enumerate() {
            let turn = joint_turn(info, joint);
            *tilt = tilted(turn, *tilt);
            if index >= self.first {
                let direction = math::turned(turn, ray.direction);
                // Most effectors start at joint 0's own origin.
                let origin = if ray.origin == Vec3A::ZERO { ray.origin } else { math::turned(turn, ray.origin) };
                ray = Ray { origin, direction }.through(self.links.get(index + 1).unwrap_or(&self.base));
            }
        }
        (ray, corrections)
    }

    /// Returns the animated effector in solver space.
    pub(crate) fn animated_gaze(&self) -> Ray {
        self.animated
    }

    /// Returns the target for which the rigid links have the same error as the true effector has for `target`. For a
    /// rigid pose this is `target` itself.
    ///
    /// `effector` and `rigid_effector` are the effector by the true forward kinematics and by the rigid links, all in
    /// solver space. Without this correction a search along the rigid links would converge to where *they* aim.
    pub(crate) fn rigid_target(&self, target: Vec3A, effector: Ray, rigid_effector: Ray) -> Vec3A {
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

/// Returns the ray that is aimed: for joint 0 the declared effector, for another joint its own forward from its own
/// origin.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn effector<const C: usize>(rig: &ChainRig<'_, C>, first: usize) -> Ray {
    if first == 0 {
        Ray { origin: Vec3A::from(rig.effector.origin), direction: Vec3A::from(rig.effector.forward) }
    } else {
        Ray { origin: Vec3A::ZERO, direction: Vec3A::from(rig.joints[first].axes.forward) }
    }
}

/// Returns the effector in solver space from the joints' exact transforms, with these corrections. `None` if a joint's
/// axes are linearly dependent.
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

/// Deviation of joints' axes from orthogonal and equally long, summed over joints.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Deviation(Vec3A);

impl Deviation {
    /// Returns `true` if joints have only rotation, uniform scale and mirroring. `false` if a number is NaN.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn is_rigid(self) -> bool {
        self.0.cmple(Vec3A::splat(RIGID_DEVIATION)).all()
    }

    /// Returns `true` if orthogonal frames suffice to lead a gaze, though not to measure it, as with the rounded scales
    /// of exported animations. `false` if a number is NaN.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn is_slight(self) -> bool {
        self.0.cmple(Vec3A::splat(SLIGHT_DEVIATION)).all()
    }

    /// Returns `true` if results for orthogonal frames hold for the true pose to within rounding.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn is_negligible(self) -> bool {
        self.0.cmple(Vec3A::splat(NEGLIGIBLE_DEVIATION)).all()
    }
}

/// Finds each joint's orthogonal frame from `first` on. Returns the deviation of the pose from these frames; `None` if
/// a joint's axes are linearly dependent.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn orthogonal_frames(pose: &[Affine3A], first: usize, frames: &mut [Mat3A]) -> Option<Deviation> {
    let deviation = similar(&pose[first..], &mut frames[first..]);
    if !deviation.is_rigid() {
        for (frame, joint) in frames.iter_mut().zip(pose).skip(first) {
            *frame = math::orthonormal(joint.matrix3)?;
        }
    }
    Some(deviation)
}

/// Replaces each joint's tilt (the orientation of its upright frame in its bone's space) by its correction.
pub(crate) fn corrections_of<const C: usize>(rig: &ChainRig<'_, C>, joints: &[Joint], tilts: &mut [Quat]) {
    for ((tilt, joint), info) in tilts.iter_mut().zip(joints).zip(rig.joints) {
        *tilt = correction(info, joint, *tilt);
    }
}

/// Returns the orientation of each joint's upright frame in its bone's space; identities if a joint's axes are linearly
/// dependent.
pub(crate) fn tilts<const C: usize>(rig: &ChainRig<'_, C>, pose: &[Affine3A], about: Upright) -> PerJoint<Quat, C> {
    let mut tilts = rig.array(Quat::IDENTITY);
    let mut frames = rig.array(Mat3A::IDENTITY);
    if pose.len() == rig.joints.len() && orthogonal_frames(pose, 0, &mut frames).is_some() {
        upright(rig.joints, 0, about, &mut frames, &mut tilts);
    }
    tilts
}

/// Finds the orthogonal frames of joints that have only rotation, uniform scale and mirroring. Returns the deviation
/// from that, which is NaN if squares of the numbers overflow or underflow.
#[cfg_attr(not(aim_small), inline(always))]
fn similar(pose: &[Affine3A], frames: &mut [Mat3A]) -> Deviation {
    // Starting the sum from −0 lets the compiler drop the first addition.
    let mut off = Vec3A::splat(-0.0);
    for (joint, frame) in pose.iter().zip(frames) {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = joint.matrix3;
        // If the rows of a matrix are orthogonal and equally long, so are its columns; and row products need no
        // horizontal sums.
        let squares = x * x + y * y + z * z;
        // Squares are not negative; NaN and 0 fail below.
        let per_length = 1.0 / <f32 as Scalar>::sqrt(squares.x);
        *frame = joint.matrix3 * per_length;
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = *frame;
        let products = x * x.yzx() + y * y.yzx() + z * z.yzx();
        // Sums, not maxima, because they propagate NaN. A length whose square overflows leaves NaN too.
        off += (squares * (per_length * per_length) - Vec3A::ONE).abs() + products.abs();
    }
    Deviation(off)
}

/// Returns the square of the scale common to joints that have only rotation, mirroring and one uniform scale. `None` if
/// the deviation from that exceeds `most_off`, or if squares of the numbers overflow or underflow.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn common_scale(pose: &[Affine3A], most_off: f32) -> Option<f32> {
    const PLAIN: Range<f32> = 1e-12..1e12;
    let squares = |Mat3A { x_axis: x, y_axis: y, z_axis: z }| x * x + y * y + z * z;
    let square = squares(pose.first()?.matrix3).x;
    let squares_alike = Vec3A::splat(square);
    // The deviation is summed, as in `similar`.
    let mut off = Vec3A::splat(-0.0);
    for joint in pose {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = joint.matrix3;
        let products = x * x.yzx() + y * y.yzx() + z * z.yzx();
        off += (squares(joint.matrix3) - squares_alike).abs() + products.abs();
    }
    (off.cmple(squares_alike * most_off).all() && math::is_within_positive(square, PLAIN)).then_some(square)
}

/// Returns each joint's animated transform in the next joint's space, the last one's in solver space.
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

/// Tilts the frames of joints with an upright heading upright, by the shortest arc, and writes the tilts in their
/// bones' spaces.
///
/// A bone that leans by more than 90° (of a character on all fours, for example) is tilted less and less, and not at
/// all from 120° on: upside down there is no unique shortest arc.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn upright(infos: &[JointInfo], first: usize, about: Upright, frames: &mut [Mat3A], tilts: &mut [Quat]) {
    /// Cosines of the leans at which tilting begins to fade, and at which it ends.
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
        // The unnormalised quaternion of the shortest arc is (a × b, 1 + a · b). For a partial tilt, take the point at
        // that part of the arc as the goal.
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

/// Returns the length from the innermost joint along the chain to the effector.
#[cfg_attr(not(aim_small), inline(always))]
fn extent(pose: &[Affine3A], offset: Option<Vec3A>, length: fn(Vec3A) -> f32) -> f32 {
    let links = pose.windows(2).map(|pair| length(pair[0].translation - pair[1].translation));
    links.fold(offset.map_or(0.0, length), |sum, link| sum + link)
}

/// Returns the size of a rig that is very large or very small: its extent or, for a chain of length zero, the length of
/// a bone's axis. `None` if it is not finite.
#[cold]
fn extreme_size(pose: &[Affine3A], offset: Option<Vec3A>) -> Option<f32> {
    let extent = extent(pose, offset, math::length);
    let axes = pose.iter().flat_map(|joint| [joint.matrix3.x_axis, joint.matrix3.y_axis, joint.matrix3.z_axis]);
    let scale = axes.map(math::length).fold(0.0, f32::max);
    let size = if extent > 1e-6 * scale { extent } else { scale };
    size.is_finite().then_some(size)
}

/// Returns the inverse of a transform that [`math::orthonormal`] accepts. The matrix is scaled first, because a
/// determinant is of the third order in its entries.
pub(crate) fn inverse(joint: &Affine3A) -> Affine3A {
    let scale = math::length(joint.matrix3.x_axis);
    let inverse = math::inverse(joint.matrix3 * (1.0 / scale)) * (1.0 / scale);
    Affine3A { matrix3: inverse, translation: -(inverse * joint.translation) }
}

/// Returns the effector by the rigid links, in the target space of `effector_to_joint`.
pub(crate) fn rigid_effector(effector: &Effector, effector_to_joint: &Affine3A) -> Ray {
    let forward = effector.forward.into();
    Ray { origin: effector_to_joint.translation, direction: effector_to_joint.transform_vector3a(forward) }
}

/// Returns the axes of effector space in the space of the joint that carries the effector. They coincide for joint 0.
/// For another joint, the direction that the kernels aim is mapped to that joint's own forward.
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

/// Returns `true` if an eye midway between two can lead: the effector is joint 0's own forward from its own origin, and
/// joint 0's heading is not upright.
pub(crate) fn can_lead(rig: &Description<'_>) -> bool {
    rig.joints.first().is_some_and(|info| rig.aims_joint_0() && !info.is_upright())
}

/// Returns the leading joint's transform in the pose's space: joint 0, or joint 0 moved to the midpoint between the
/// eyes.
pub(crate) fn leading_eye(rig: &Description<'_>, pose: &PoseSlices<'_>) -> Option<Affine3A> {
    let mut joint = *pose.joints.first()?;
    if let Some(other_eye) = pose.other_eye.filter(|_| can_lead(rig)) {
        joint.translation = 0.5 * joint.translation + 0.5 * other_eye.translation;
    }
    Some(joint)
}
