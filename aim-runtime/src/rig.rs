//! [`AimRig`]: what a rig's derived code offers the solvers, and what it offers its users.

use glam::{Affine3A, Quat, Vec3, Vec3A};

use crate::pose::Animated;
use crate::{ChainPose, Joint, JointInfo, Natural, Outcome, Scalar, Settings, Target, frame, math, targets};

/// Which way a bone points: three unit vectors in the bone's own space, square to each other.
///
/// `up × forward` is `left` for a right-handed triple and `-left` for a left-handed (or mirrored) one; nothing in the
/// runtime depends on which.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The bone-space direction that points up in the character.
    pub up: [f32; 3],
    /// The bone-space direction that the character faces.
    pub forward: [f32; 3],
    /// The bone-space direction of the character's left.
    pub left: [f32; 3],
}

/// What is aimed: a point and a unit direction fixed to joint 0, in joint 0's bone space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effector {
    /// The unit direction that is turned to the target.
    pub forward: [f32; 3],
    /// The point the direction starts from, in the units of the bone.
    pub origin: [f32; 3],
}

impl Effector {
    /// The axes that the residual is measured along: forward, left and up in effector space, which has joint 0's axes.
    ///
    /// Joint 0's own up and left, squared to the effector's forward; where that points along up, up is where the back
    /// of the head, or the face, was.
    #[inline(always)]
    pub(crate) fn axes(&self, first: &Axes) -> [Vec3A; 3] {
        let [up, forward, left] = [first.up, first.forward, first.left].map(Vec3A::from);
        if self.forward == first.forward { [forward, left, up] } else { self.turned_axes(up, forward, left) }
    }

    /// A vector's parts along those axes.
    #[inline(always)]
    pub(crate) fn along_axes(&self, first: &Axes, v: Vec3A) -> [f32; 3] {
        if self.forward == first.forward {
            return [along(first.forward, v), along(first.left, v), along(first.up, v)];
        }
        let [forward, left, up] = self.axes(first);
        [forward.dot(v), left.dot(v), up.dot(v)]
    }

    #[cold]
    fn turned_axes(&self, up: Vec3A, forward: Vec3A, left: Vec3A) -> [Vec3A; 3] {
        /// The sine of half a degree.
        const ALONG: f32 = 0.008_726_535;
        let handedness = math::cross(up, forward).dot(left).signum();
        let aimed = Vec3A::from(self.forward);
        let along = up.dot(aimed);
        let up = if math::cross(up, aimed).length() < ALONG { forward * -along.signum() } else { up };
        let up = math::direction(up - aimed * aimed.dot(up)).unwrap_or(Vec3A::ZERO);
        [aimed, math::cross(up, aimed) * handedness, up]
    }
}

/// A vector's part along an axis; costs nothing for an axis of coordinates, as those of bones mostly are.
#[inline(always)]
pub(crate) fn along(axis: [f32; 3], v: Vec3A) -> f32 {
    match axis {
        [x, 0.0, 0.0] => x * v.x,
        [0.0, y, 0.0] => y * v.y,
        [0.0, 0.0, z] => z * v.z,
        _ => v.dot(axis.into()),
    }
}

/// A rig: its joints from the effector inward, their state, and the kernels derived for it.
///
/// `#[derive(AimRig)]` implements the first part; the second part, from [`aim`](Self::aim) on, is what users call.
///
/// The kernels' links and targets are those of the generated C functions: a link is a rigid transform of twelve
/// numbers, the three rows of the rotation in the row-vector layout of the paper (`p' = p · M`), then the translation.
/// Its rotation part only has to be orthogonal: a mirror may stay in it.
pub trait AimRig: Sized {
    /// One value a joint: `[T; N]` for a derived rig, `Vec<T>` for one known only at run time.
    type Array<T: Copy>: AsRef<[T]> + AsMut<[T]>;

    /// `value` for every joint.
    fn array<T: Copy>(&self, value: T) -> Self::Array<T>;
    /// What was declared of each joint, from the effector inward.
    fn joint_infos(&self) -> &[JointInfo];
    /// What is aimed.
    fn effector(&self) -> Effector;
    /// How a natural gaze is shared on this rig. Default [`Natural::default`].
    fn natural(&self) -> Natural {
        Natural::default()
    }
    /// The joints' states, from the effector inward.
    fn joints(&self) -> Self::Array<Joint>;
    /// One joint's state; `None` where there is no such joint, or where the states cannot be lent. Without it everything
    /// works, at some more cost.
    fn joint(&self, joint: usize) -> Option<&Joint> {
        let _ = joint;
        None
    }
    /// One joint's state in place; `None` where there is no such joint, or where the states cannot be lent. Without it
    /// everything works, at some more cost.
    fn joint_mut(&mut self, joint: usize) -> Option<&mut Joint> {
        let _ = joint;
        None
    }
    /// Replaces the joints' states.
    fn set_joints(&mut self, joints: Self::Array<Joint>);

    /// Joint `joint`'s aim, ∂aim/∂pitch, ∂aim/∂heading, everything nearer the effector held still.
    ///
    /// `effector_to_joint` leads from effector space (joint 0's axes, origin at the effector) to the joint's space
    /// before its added rotation; `target` is in that joint's space; `sin_cos` is sin p, cos p, sin h, cos h. All zero
    /// where the target is on the effector, or where there is no such joint; finite for finite input.
    fn aim_gradient<S: Scalar>(
        &self,
        joint: usize,
        effector_to_joint: &[S; 12],
        target: &[S; 3],
        sin_cos: &[S; 4],
    ) -> [S; 3];

    /// The whole chain's aim, then its derivatives by the declared angles (pitch before heading, joint by joint).
    ///
    /// `links[0]` leads from effector space to joint 0, `links[i]` from joint i−1 to joint i; `target` is in the last
    /// joint's space. `out` holds 1 + the number of declared angles; slices of other lengths give zeros.
    fn chain_value_gradient<S: Scalar>(&self, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut [S]);

    /// The stereographic residual of the chain (left, up), then its Jacobian: the derivatives of the first by the
    /// declared angles, then those of the second.
    ///
    /// The residual is `2 lateral / (distance + forward)` of the target as seen from the effector, that is
    /// 2·tan(angle/2) in its direction, along joint 0's left and up squared to the effector's forward (where that
    /// points along up, up is where the back of the head was, and where it points down, the face). Zero where that is singular (target on the effector or exactly behind), so
    /// judge success by the angle, never by this. `out` holds 2 + 2 × the number of declared angles.
    fn chain_residual_jacobian<S: Scalar>(&self, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut [S]);

    /// Turns the rig towards `target` for one frame of `dt` seconds, with the default [`Settings`].
    ///
    /// See [`aim_with`](Self::aim_with).
    fn aim<P: ChainPose<Self::Array<Affine3A>>>(&mut self, pose: &P, target: Vec3, dt: f32) -> Outcome {
        self.aim_with(pose, target, dt, &Settings::default())
    }

    /// Turns the rig towards `target` for one frame of `dt` seconds.
    ///
    /// `pose` and `target` are in one common space. No angle changes by more than its joint's rate × `dt` (a free
    /// heading modulo a full turn), and none leaves its range of motion; one found outside goes back at its rate.
    /// With `dt` zero, negative or NaN nothing moves; above 0.1 s it counts as 0.1 s. Where there is nothing to aim
    /// ([`Status::Degenerate`](crate::Status::Degenerate)) the angles hold.
    fn aim_with<P: ChainPose<Self::Array<Affine3A>>>(
        &mut self,
        pose: &P,
        target: Vec3,
        dt: f32,
        settings: &Settings,
    ) -> Outcome {
        frame::aim(self, &Animated::new(pose), target, dt, settings)
    }

    /// Turns the rig towards several weighted targets for one frame of `dt` seconds.
    ///
    /// The targets are blended by their directions as the animated effector sees them (the weighted sum of unit
    /// vectors), and by how near they are; their order does not matter, and where no directions cancel the blend is
    /// continuous in points and weights. Weights that add up to less than 1 fade towards the animation as
    /// [`Settings::weight`] does, which multiplies them. A target that is not finite, or on the effector, is left out.
    /// Where directions cancel the heaviest target is aimed at, and of equals the first. No target at all is weight 0.
    ///
    /// For a single finite target of weight 1 this is [`aim_with`](Self::aim_with).
    fn aim_at<P: ChainPose<Self::Array<Affine3A>>>(
        &mut self,
        pose: &P,
        targets: &[Target],
        dt: f32,
        settings: &Settings,
    ) -> Outcome {
        let (target, settings) = targets::blended(self, &Animated::new(pose), targets, settings);
        self.aim_with(pose, target, dt, &settings)
    }

    /// Puts the rig on `target` at once, whatever the rates: for a spawn, a camera cut, scrubbing. The only jump.
    ///
    /// With the default [`Settings`]; see [`snap_with`](Self::snap_with).
    fn snap<P: ChainPose<Self::Array<Affine3A>>>(&mut self, pose: &P, target: Vec3) -> Outcome {
        self.snap_with(pose, target, &Settings::default())
    }

    /// Puts the rig on `target` at once, whatever the rates, within the ranges of motion.
    ///
    /// Starts from rest, so that the result does not depend on what came before wherever the target can be reached.
    /// Never [`RateLimited`](crate::Status::RateLimited).
    fn snap_with<P: ChainPose<Self::Array<Affine3A>>>(
        &mut self,
        pose: &P,
        target: Vec3,
        settings: &Settings,
    ) -> Outcome {
        frame::snap(self, &Animated::new(pose), target, settings)
    }

    /// Puts the rig at once on several weighted targets, blended as [`aim_at`](Self::aim_at) does, whatever the rates.
    fn snap_at<P: ChainPose<Self::Array<Affine3A>>>(
        &mut self,
        pose: &P,
        targets: &[Target],
        settings: &Settings,
    ) -> Outcome {
        let (target, settings) = targets::blended(self, &Animated::new(pose), targets, settings);
        self.snap_with(pose, target, &settings)
    }

    /// Each joint's index and correction, from the effector inward: what the bone's animated local rotation is
    /// multiplied by on the right. Unit to 1e-6; the exact identity at rest.
    ///
    /// A local *rotation* may be multiplied by it where the bone's own scale mirrors no axis, or all three. With scale −1
    /// along one axis the turn is behind the mirror: about the axis mirrored, the other way round.
    #[inline]
    fn corrections(&self) -> Corrections<Self::Array<Quat>> {
        let mut turns = self.array(Quat::IDENTITY);
        for (index, (turn, info)) in turns.as_mut().iter_mut().zip(self.joint_infos()).enumerate() {
            *turn = match self.joint(index) {
                Some(joint) => joint.own_correction(info),
                None => self.joints().as_ref()[index].own_correction(info),
            };
        }
        Corrections { turns, next: 0 }
    }

    /// The correction of the other eye: what its bone's animated local rotation is multiplied by on the right. `None`
    /// where the last pose had [no pair](crate::Pose::with_pair). Unit to 1e-6; the exact identity at rest.
    fn pair_correction(&self) -> Option<Quat> {
        self.joints().as_ref().first()?.pair.map(|pair| Quat::from_array(pair.correction))
    }

    /// Puts every joint at rest at once and forgets what was seen.
    fn reset(&mut self) {
        let rest = self.array(Joint::default());
        self.set_joints(rest);
    }
}

/// The iterator of [`AimRig::corrections`].
#[derive(Clone, Debug)]
pub struct Corrections<A> {
    turns: A,
    next: usize,
}

impl<A: AsRef<[Quat]>> Iterator for Corrections<A> {
    type Item = (usize, Quat);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let index = self.next;
        let turn = *self.turns.as_ref().get(index)?;
        self.next += 1;
        Some((index, turn))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.turns.as_ref().len().saturating_sub(self.next);
        (left, Some(left))
    }
}

impl<A: AsRef<[Quat]>> ExactSizeIterator for Corrections<A> {}
