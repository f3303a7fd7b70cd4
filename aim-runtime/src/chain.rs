//! [`Chain`]: a pose made ready for aiming, in units of the rig's own size, with the true forward kinematics that
//! judges and the rigid links that the derived kernels search with.

use glam::{Affine3A, Mat3A, Quat, Vec3A};

use crate::{AimRig, Axes, Joint, math};

/// Nearer to the effector than this part of the rig's size a target has no direction.
const TOO_NEAR: f32 = 1e-5;
/// Farther than this many sizes of the rig a target is a mere direction.
const FAR: f32 = 1e6;
/// How far from square or from equal length a joint's axes may be to count as rigid.
const RIGID: f32 = 1e-4;

/// A point and a direction (of any length but zero).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: Vec3A,
    pub(crate) direction: Vec3A,
}

impl Ray {
    pub(crate) fn turned(self, turn: Quat) -> Self {
        Self { origin: turn.mul_vec3a(self.origin), direction: turn.mul_vec3a(self.direction) }
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
pub(crate) struct Chain<R: AimRig> {
    /// The joint that carries the effector; those before it do not matter.
    pub(crate) first: usize,
    /// The number of joints.
    pub(crate) count: usize,
    /// The effector in its joint's bone space.
    effector: Ray,
    /// Each joint's animated transform in the next joint's space; the last one's in solver space.
    local: R::Array<Affine3A>,
    /// Rigid links for the kernels: from the joint before (from effector space for the first), orthogonal, in
    /// solver-space lengths.
    pub(crate) links: R::Array<Affine3A>,
    /// The last joint's rigid frame in solver space.
    pub(crate) base: Affine3A,
    /// Whether the rigid links are all there is to the pose: no shear, no non-uniform scale.
    pub(crate) rigid: bool,
    /// Pose space to solver space.
    origin: Vec3A,
    per_size: f32,
}

impl<R: AimRig> Chain<R> {
    /// `pose` with `first` as the joint that is aimed; `None` where it is not finite or does not span space.
    pub(crate) fn new(rig: &R, pose: &[Affine3A], first: usize) -> Option<Self> {
        let infos = rig.joint_infos();
        let count = infos.len();
        if count == 0 || pose.len() < count {
            return None;
        }
        let first = first.min(count - 1);
        let pose = &pose[..count];
        if !pose[first..].iter().all(|joint| joint.is_finite()) {
            return None;
        }
        let declared = rig.effector();
        let effector = if first == 0 {
            Ray { origin: Vec3A::from(declared.origin), direction: Vec3A::from(declared.forward) }
        } else {
            Ray { origin: Vec3A::ZERO, direction: Vec3A::from(infos[first].axes.forward) }
        };
        let offset = pose[first].transform_vector3a(effector.origin);
        let size = size(&pose[first..], offset);
        let per_size = 1.0 / size;
        if !(size.is_finite() && per_size.is_finite() && per_size > 0.0) {
            return None;
        }

        let origin = pose[count - 1].translation;
        let mut local = rig.array(Affine3A::IDENTITY);
        let mut links = rig.array(Affine3A::IDENTITY);
        let mut base = Affine3A::IDENTITY;
        let mut rigid = true;
        {
            let (local, links) = (local.as_mut(), links.as_mut());
            let to_solver = |joint: &Affine3A| Affine3A {
                matrix3: joint.matrix3 * per_size,
                translation: (joint.translation - origin) * per_size,
            };
            let mut inner: Option<Affine3A> = None;
            let mut inner_frame = Affine3A::IDENTITY;
            for index in first..count {
                let joint = to_solver(&pose[index]);
                let frame = Affine3A { matrix3: math::orthonormal(joint.matrix3)?, translation: joint.translation };
                rigid &= is_rigid(&joint.matrix3, &frame.matrix3);
                let outward = math::rigid_inverse(&frame);
                match inner {
                    Some(inner) => {
                        local[index - 1] = inverse(&joint) * inner;
                        links[index] = outward * inner_frame;
                    }
                    None => {
                        links[index] = Affine3A {
                            matrix3: effector_axes(rig, first),
                            translation: outward.transform_vector3a(offset * per_size),
                        };
                    }
                }
                inner = Some(joint);
                inner_frame = frame;
            }
            local[count - 1] = inner?;
            base = inner_frame * base;
            let finite = |transforms: &[Affine3A]| transforms.iter().all(|transform| transform.is_finite());
            if !(finite(local) && finite(links) && base.is_finite()) {
                return None;
            }
        }
        let chain = Self { first, count, effector, local, links, base, rigid, origin, per_size };
        // A direction of no length (or of none after a flat scale) aims nowhere.
        math::direction(chain.animated_gaze().direction)?;
        Some(chain)
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

    /// The effector before its joint's added rotation, in that joint's space.
    pub(crate) fn effector(&self) -> Ray {
        self.effector
    }

    /// A ray in a joint's space, after its added rotation, in the next joint's space (solver space for the last).
    pub(crate) fn outward(&self, joint: usize, ray: Ray) -> Ray {
        ray.through(&self.local.as_ref()[joint])
    }

    /// Each joint's true frame in solver space before its added rotation.
    pub(crate) fn frames(&self, turns: &[Quat], frames: &mut [Affine3A]) {
        let local = self.local.as_ref();
        let mut frame = Affine3A::IDENTITY;
        for index in (self.first..self.count).rev() {
            frame *= local[index];
            frames[index] = frame;
            frame *= Affine3A::from_quat(turns[index]);
        }
    }

    /// The same for the rigid links.
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
        (self.first..self.count).fold(self.effector, |ray, index| self.outward(index, ray))
    }

    /// The target that makes the rigid links see what the true effector sees: for a rigid pose the target itself.
    ///
    /// `effector` and `rigid_effector` are the effector as the true forward kinematics and as the rigid links have
    /// it, all in solver space. Without this, a search along the rigid links would end where *they* aim.
    pub(crate) fn seen_target(&self, target: Vec3A, effector: Ray, rigid_effector: Ray) -> Vec3A {
        if self.rigid {
            return target;
        }
        let to_target = target - effector.origin;
        let directions = math::direction(to_target)
            .zip(math::direction(effector.direction))
            .zip(math::direction(rigid_effector.direction));
        match directions {
            Some(((wanted, seen), rigid)) => {
                let turn = Quat::from_rotation_arc(seen.into(), wanted.into());
                rigid_effector.origin + turn.mul_vec3a(rigid) * to_target.length()
            }
            None => target,
        }
    }
}

/// The rotations that the joints add, in their bones' own spaces.
pub(crate) fn turns<R: AimRig>(rig: &R, joints: &[Joint]) -> R::Array<Quat> {
    let mut turns = rig.array(Quat::IDENTITY);
    for ((turn, joint), info) in turns.as_mut().iter_mut().zip(joints).zip(rig.joint_infos()) {
        *turn = joint.correction(&info.axes);
    }
    turns
}

/// The length that stands for the rig: from the innermost joint along the chain to the effector; where the chain has
/// no length, that of a bone's axis.
fn size(pose: &[Affine3A], offset: Vec3A) -> f32 {
    let mut extent = math::length(offset);
    for pair in pose.windows(2) {
        extent += math::length(pair[0].translation - pair[1].translation);
    }
    let mut scale = 0.0_f32;
    for joint in pose {
        for column in [joint.matrix3.x_axis, joint.matrix3.y_axis, joint.matrix3.z_axis] {
            scale = scale.max(math::length(column));
        }
    }
    if extent > 1e-6 * scale { extent } else { scale }
}

/// The inverse of a transform that [`math::orthonormal`] accepted. Scaled first: a determinant is a cube.
fn inverse(joint: &Affine3A) -> Affine3A {
    let scale = math::length(joint.matrix3.x_axis);
    let inverse = (joint.matrix3 * (1.0 / scale)).inverse() * (1.0 / scale);
    Affine3A { matrix3: inverse, translation: -(inverse * joint.translation) }
}

fn is_rigid(matrix: &Mat3A, orthonormal: &Mat3A) -> bool {
    let scale = matrix.x_axis.length();
    let off = |axis: Vec3A, unit: Vec3A| !((axis - unit * scale).length() <= RIGID * scale);
    !(off(matrix.y_axis, orthonormal.y_axis) || off(matrix.z_axis, orthonormal.z_axis))
}

/// Effector space in the space of the joint that carries the effector. For joint 0 they have the same axes. For
/// another joint, the direction that the kernels aim becomes that joint's own forward.
fn effector_axes<R: AimRig>(rig: &R, first: usize) -> Mat3A {
    if first == 0 {
        return Mat3A::IDENTITY;
    }
    let infos = rig.joint_infos();
    let frame = |forward: [f32; 3], axes: &Axes| {
        let forward = Vec3A::from(forward);
        // An overridden effector may point along joint 0's up.
        math::orthonormal(Mat3A::from_cols(forward, axes.up.into(), axes.left.into()))
            .or_else(|| math::orthonormal(Mat3A::from_cols(forward, axes.left.into(), axes.forward.into())))
            .unwrap_or(Mat3A::IDENTITY)
    };
    let from = frame(rig.effector().forward, &infos[0].axes);
    let axes = &infos[first].axes;
    frame(axes.forward, axes) * from.transpose()
}
