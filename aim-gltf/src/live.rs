//! [`Live`]: one chain of one character, aimed frame by frame over whatever its animation does.

use aim_runtime::{AimRig, DetailedPose, Outcome, Pose};
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Quat};

use crate::bake::ChainNodes;
use crate::document::Document;
use crate::measure::Measurement;
use crate::skeleton::Skeleton;
use crate::stance::Stance;
use crate::trs::{Trs, orthonormal};

/// What a program does each frame after its animation, for a character of a [`Document`].
///
/// A frame is: the animation's pose and its nodes in the world; [`animated`](Self::animated) of them; a call of
/// [`AimRig::aim_with`] or another; then [`aimed`](Self::aimed), which puts the corrections into the pose.
#[derive(Clone, Debug)]
pub struct Live {
    stance: Stance,
    both_eyes: bool,
}

/// What a frame was aimed with.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a, A> {
    /// Seconds, for the record.
    pub t: f32,
    /// The target in the world.
    pub target: DVec3,
    /// Every node in the world, animated.
    pub world: &'a [DAffine3],
    /// What [`Live::animated`] gave.
    pub joints: &'a DetailedPose<A>,
    /// What the solver said.
    pub outcome: Outcome,
    /// What was aimed: [`Settings::effector`](aim_runtime::Settings::effector).
    pub effector: usize,
}

/// One joint in one frame.
#[derive(Clone, Copy, Debug)]
pub struct JointFrame {
    /// Added heading, radians.
    pub heading: f32,
    /// Added pitch, radians.
    pub pitch: f32,
    /// The heading and pitch, radians, by which the animation turns the joint out of its bind pose, where its ranges are
    /// counted from that.
    pub led: Option<[f64; 2]>,
    /// Whether an angle is at an end of its range.
    pub at_limit: bool,
    /// Whether an angle is on its way back into its range.
    pub recovering: bool,
}

/// One frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Seconds.
    pub t: f32,
    /// The target in the world.
    pub target: DVec3,
    /// Between the effector and the direction to the target by the forward kinematics of the file as it is written,
    /// degrees; 90 where either has no direction.
    pub error_deg: f64,
    /// By how much joint 0 is rolled about the gaze more than in the animation, degrees, positive to the character's
    /// left: a roll is the angle, seen along the gaze, from the character's up to the bone's up. 0 where either lies
    /// along the gaze (within 1°). The character's up is the world's as long as the character stands.
    pub roll_deg: f64,
    /// What [`error_deg`](Self::error_deg) is, of the other eye, where both are aimed: it looks as joint 0 does in the
    /// bind pose, from the mirrored point.
    pub pair_error_deg: Option<f64>,
    /// What the solver says.
    pub outcome: Outcome,
    /// Each joint, from the effector inward.
    pub joints: Vec<JointFrame>,
    /// The file's nodes in the world, aimed.
    pub world: Vec<DAffine3>,
}

impl Live {
    /// For a rig whose joints are the chain's nodes. With `both_eyes` the other eye is aimed itself, where the chain has
    /// one; else it turns as joint 0 does.
    pub fn new<R: AimRig>(
        rig: &R,
        document: &Document,
        measurement: &Measurement,
        chain: &ChainNodes,
        both_eyes: bool,
    ) -> Self {
        let both_eyes = both_eyes && chain.pair.is_some();
        Self { stance: Stance::new(rig, document.skeleton(), chain, measurement), both_eyes }
    }

    /// The joints as the solvers take them, for a pose and its nodes in the world. Where both eyes are aimed, the other
    /// one is first turned as joint 0 is: the eyes of animations are seldom parallel.
    pub fn animated<R: AimRig>(
        &self,
        rig: &R,
        skeleton: &Skeleton,
        pose: &mut [Trs],
        world: &[DAffine3],
    ) -> DetailedPose<R::Array<Affine3A>> {
        let joints = Pose { joints: joint_transforms(rig, &self.stance.chain, pose, world) };
        let joints = joints.with_up(self.stance.up(world).as_vec3()).with_bind(self.stance.bind(rig, world));
        match self.stance.chain.pair.filter(|_| self.both_eyes) {
            Some(pair) => {
                pose[pair].rotation = self.stance.parallel(skeleton, pose, world).unwrap_or(pose[pair].rotation);
                joints.with_pair(joint_transform(pose, &skeleton.world_f64(pose), pair))
            }
            None => joints,
        }
    }

    /// Puts the rig's corrections into the pose and tells what came of it.
    pub fn aimed<R: AimRig>(
        &self,
        rig: &R,
        skeleton: &Skeleton,
        pose: &mut [Trs],
        moment: &Moment<'_, R::Array<Affine3A>>,
    ) -> Frame {
        let &Moment { t, target, world: animated, joints, outcome, effector } = moment;
        let stance = &self.stance;
        apply(rig, &stance.chain, rig.pair_correction(), skeleton, pose);
        let world = skeleton.world_f64(pose);
        Frame {
            t,
            target,
            error_deg: stance.error_deg(effector, &world, target),
            roll_deg: stance.roll_deg(animated, &world),
            pair_error_deg: if self.both_eyes { stance.pair_error_deg(&world, target) } else { None },
            outcome,
            joints: joint_frames(rig, outcome, |joint| stance.led(rig, joint, joints)),
            world,
        }
    }

    /// Where joint `effector` looks from, and in which direction of length one, in the world; of joint 0 that of the
    /// rig's effector. The other eye's too, where it is aimed or follows and joint 0 is what looks.
    #[must_use]
    pub fn gazes(&self, effector: usize, world: &[DAffine3]) -> Vec<[DVec3; 2]> {
        let pair = if effector == 0 { self.stance.pair_gaze(world) } else { None };
        core::iter::once(self.stance.gaze(effector, world)).chain(pair).collect()
    }
}

/// The joints in the world as the solver takes them.
fn joint_transforms<R: AimRig>(rig: &R, chain: &ChainNodes, pose: &[Trs], world: &[DAffine3]) -> R::Array<Affine3A> {
    let mut joints = rig.array(Affine3A::IDENTITY);
    for (joint, &node) in joints.as_mut().iter_mut().zip(&chain.joints) {
        *joint = joint_transform(pose, world, node);
    }
    joints
}

/// A node in the world without its own non-uniform scale, so that a correction acts where the node's rotation does.
fn joint_transform(pose: &[Trs], world: &[DAffine3], node: usize) -> Affine3A {
    let scale = pose[node].scale.abs().as_dvec3();
    let uniform = (scale - DVec3::splat(scale.x)).abs().max_element() <= 1e-5 * scale.max_element();
    let own = if uniform || scale.min_element() == 0.0 { DVec3::ONE } else { scale.recip() };
    (world[node] * DAffine3::from_scale(own)).as_affine3a()
}

/// Multiplies the rig's corrections into the chain's local rotations, and the other eye's into its; without one that
/// eye turns in the world as joint 0 does.
fn apply<R: AimRig>(rig: &R, chain: &ChainNodes, pair: Option<Quat>, skeleton: &Skeleton, pose: &mut [Trs]) {
    let eye = chain.joints[0];
    let before = pose[eye].rotation.as_dquat();
    for (joint, correction) in rig.corrections() {
        pose[chain.joints[joint]].turn(correction);
    }
    match (chain.pair, pair) {
        (Some(node), Some(correction)) => pose[node].turn(correction),
        (Some(node), None) => follow(eye, before, node, skeleton, pose),
        (None, _) => {}
    }
}

/// Turns `pair` in the world as the `eye` turned from its rotation `before`.
fn follow(eye: usize, before: DQuat, pair: usize, skeleton: &Skeleton, pose: &mut [Trs]) {
    let turn = DMat3::from_quat(pose[eye].rotation.as_dquat() * before.inverse());
    let world = skeleton.world_f64(pose);
    // Orthogonal, but not always a rotation: a parent may be mirrored.
    let parent = |node: usize| match skeleton.nodes()[node].parent {
        Some(parent) => orthonormal(&world[parent].matrix3).0,
        None => DMat3::IDENTITY,
    };
    let to_pair = parent(pair).transpose() * parent(eye);
    let turn = DQuat::from_mat3(&(to_pair * turn * to_pair.transpose())).as_quat();
    pose[pair].rotation = (turn * pose[pair].rotation).normalize();
}

fn joint_frames<R: AimRig>(rig: &R, outcome: Outcome, led: impl Fn(usize) -> Option<[f64; 2]>) -> Vec<JointFrame> {
    let joints = rig.joints();
    let joints = joints.as_ref().iter().enumerate().map(|(i, joint)| JointFrame {
        heading: joint.heading(),
        pitch: joint.pitch(),
        led: led(i),
        at_limit: outcome.at_limit.contains(i),
        recovering: outcome.recovering.contains(i),
    });
    joints.collect()
}
