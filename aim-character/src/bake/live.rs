//! [`Live`]: one chain of one character, aimed frame by frame over whatever its animation does.

use aim_runtime::{DynAim, Joint, Outcome, Pose, Rig};
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3};

use crate::bake::chain::ChainNodes;
use crate::bake::eye_maps::EyeMaps;
use crate::bake::held::Held;
use crate::bake::morph_eyes::MorphEyes;
use crate::bake::stance::Stance;
use crate::measure::Measurement;
use crate::measure::frame::parent_frame;
use aim_animation::{Clip, Transform};
use aim_gltf::Document;
use aim_gltf::Skeleton;

/// One chain of a character of a [`Document`], aimed in each frame after its animation.
///
/// A frame is: the animation's pose and its nodes in the world; [`animated`](Self::animated) of them; a call of
/// [`DynAim::aim`] or [`DynAim::snap`]; then [`aimed`](Self::aimed), which puts the corrections into the pose.
#[derive(Clone, Debug)]
pub struct Live {
    stance: Stance,
    both_eyes: bool,
    held: Vec<Held>,
    maps: EyeMaps,
    morphs: MorphEyes,
}

/// Inputs of one aimed frame.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// Seconds, for the record.
    pub t: f32,
    /// The target in the world.
    pub target: DVec3,
    /// Every node in the world, animated.
    pub world: &'a [DAffine3],
    /// The result of [`Live::animated`].
    pub joints: &'a Pose<Vec<Affine3A>>,
    /// The solver's outcome.
    pub outcome: Outcome,
    /// The aimed joint: [`Settings::effector`](aim_runtime::Settings::effector).
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
    /// True if an angle is at an end of its range.
    pub at_limit: bool,
    /// True if an angle is on its way back into its range.
    pub recovering: bool,
}

/// One frame.
#[derive(Clone, Debug)]
pub struct AimedFrame {
    /// Seconds.
    pub t: f32,
    /// The target in the world.
    pub target: DVec3,
    /// Between the effector and the direction to the target by the forward kinematics of the file as it is written (but for
    /// the range maps of a VRM file's eyes, which come after it), degrees; 90 where either has no direction.
    pub error_deg: f64,
    /// By how much the aimed joint is rolled about the gaze more than in the animation, degrees, positive to the character's
    /// left: a roll is the angle, seen along the gaze, from the character's up to the bone's up. 0 where either lies
    /// along the gaze (within 1°). The character's up is the world's as long as the character stands.
    pub roll_deg: f64,
    /// The same as [`error_deg`](Self::error_deg) of the other eye, if both are aimed: it looks as joint 0 does in the
    /// bind pose, from the mirrored point.
    pub pair_error_deg: Option<f64>,
    /// The solver's outcome.
    pub outcome: Outcome,
    /// Each joint, from the effector inward.
    pub joints: Vec<JointFrame>,
    /// The file's nodes in the world, aimed.
    pub world: Vec<DAffine3>,
}

impl Live {
    /// For a rig whose joints are the chain's nodes. With `both_eyes` the other eye is aimed itself, where the chain has
    /// one; else it turns as joint 0 does.
    pub fn new(
        rig: &dyn Rig,
        document: &Document,
        measurement: &Measurement,
        chain: &ChainNodes,
        both_eyes: bool,
    ) -> Self {
        let both_eyes = both_eyes && chain.other_eye.is_some();
        let skeleton = document.skeleton();
        let held = Held::find(rig, skeleton, measurement, chain);
        let maps = EyeMaps::find(document, measurement, chain);
        let morphs = MorphEyes::find(document, measurement, chain);
        Self { stance: Stance::new(rig, skeleton, chain, measurement), both_eyes, held, maps, morphs }
    }

    /// The local transforms of all nodes at a time of a clip, or at rest, as [`Skeleton::pose`] has them; eyes that look by morph
    /// targets are turned to where the weights have them.
    #[must_use]
    pub fn pose(&self, skeleton: &Skeleton, clip: Option<&Clip>, seconds: f32) -> Vec<Transform> {
        let mut pose = clip.map_or_else(|| skeleton.rest().to_vec(), |clip| skeleton.pose(clip, seconds));
        self.morphs.pose(clip, seconds, &mut pose);
        pose
    }

    /// The eyes that look by morph targets.
    pub(crate) fn morphs(&self) -> &MorphEyes {
        &self.morphs
    }

    /// The nodes that keep their place on what carries the joint that they hang on: [`ChainNodes::holds`].
    pub fn held(&self) -> impl Iterator<Item = usize> + '_ {
        self.held.iter().map(|held| held.node)
    }

    /// True if a node moves with what looks while joint `effector` is aimed: if it hangs on that joint or one outside it, on an
    /// eye, the head or the neck. A gaze cannot catch up with such a node. What is [held](Self::held) and hangs on a neck does
    /// not move with it.
    #[must_use]
    pub fn looks_with(&self, skeleton: &Skeleton, node: usize, effector: usize) -> bool {
        let moving = skeleton.ancestry(node).find_map(|at| {
            let held = self.held().any(|held| held == at).then_some(false);
            let turned = || self.stance.chain.turned().position(|joint| joint == at);
            held.or_else(|| Some(self.stance.looks(turned()?, effector)))
        });
        moving.unwrap_or(false)
    }

    /// The joints as the solvers take them, for a pose and its nodes in the world. Where both eyes are aimed, the other
    /// one is first turned as joint 0 is: the eyes of animations are seldom parallel.
    pub fn animated(&self, skeleton: &Skeleton, pose: &mut [Transform], world: &[DAffine3]) -> Pose<Vec<Affine3A>> {
        let joints = self.stance.chain.joints.iter().map(|&node| joint_transform(pose, world, node));
        let joints = Pose::new(joints.collect::<Vec<_>>())
            .with_up(self.stance.up(world).as_vec3())
            .with_bind(self.stance.bind(world));
        match self.stance.chain.other_eye.filter(|_| self.both_eyes) {
            Some(pair) => {
                pose[pair].rotation = self.stance.parallel(skeleton, pose, world).unwrap_or(pose[pair].rotation);
                joints.with_other_eye(joint_transform(pose, &skeleton.world_f64(pose), pair))
            }
            None => joints,
        }
    }

    /// Puts the rig's corrections into the pose, moves what is [held](Self::held) back, and tells what came of it. Eyes of a VRM file
    /// then turn by its range maps: errors and angles are those of where the character looks, which is what the maps start from;
    /// pose and [`world`](AimedFrame::world) have the bones as the maps turn them.
    pub fn aimed<R: Rig>(
        &self,
        character: &DynAim<R>,
        skeleton: &Skeleton,
        pose: &mut [Transform],
        moment: &Moment<'_>,
    ) -> AimedFrame {
        let &Moment { t, target, world: animated, joints, outcome, effector } = moment;
        let stance = &self.stance;
        let eyes = self.maps.rotations(pose);
        apply(character, &stance.chain, skeleton, pose);
        let mut world = skeleton.world_f64(pose);
        if !self.held.is_empty() {
            self.held.iter().for_each(|held| held.hold(skeleton, pose, animated, &world));
            world = skeleton.world_f64(pose);
        }
        let mut frame = AimedFrame {
            t,
            target,
            error_deg: stance.sight(effector).error_deg(&world, target),
            roll_deg: stance.roll_deg(effector, animated, &world),
            pair_error_deg: stance.other_eye.filter(|_| self.both_eyes).map(|pair| pair.error_deg(&world, target)),
            outcome,
            joints: joint_frames(&character.state.joints, outcome, |joint| stance.led(&character.rig, joint, joints)),
            world,
        };
        if !self.maps.is_empty() {
            self.maps.apply(&eyes, pose);
            frame.world = skeleton.world_f64(pose);
        }
        frame
    }

    /// The character's up in the world: that of the world as long as the character stands.
    pub(crate) fn up(&self, world: &[DAffine3]) -> DVec3 {
        self.stance.up(world)
    }

    /// Point and direction (of length one) that joint `effector` looks from and along, in the world; of joint 0 those of the
    /// rig's effector. The other eye's too, where it is aimed or follows and joint 0 is what looks.
    #[must_use]
    pub fn gazes(&self, effector: usize, world: &[DAffine3]) -> Vec<[DVec3; 2]> {
        let pair = self.stance.other_eye.as_ref().filter(|_| effector == 0);
        core::iter::once(self.stance.sight(effector)).chain(pair).map(|sight| sight.gaze(world)).collect()
    }
}

/// A node in the world without its own non-uniform scale, so that a correction acts where the node's rotation does.
fn joint_transform(pose: &[Transform], world: &[DAffine3], node: usize) -> Affine3A {
    let scale = pose[node].scale.abs().as_dvec3();
    let uniform = (scale - DVec3::splat(scale.x)).abs().max_element() <= 1e-5 * scale.max_element();
    let own = if uniform || scale.min_element() == 0.0 { DVec3::ONE } else { scale.recip() };
    (world[node] * DAffine3::from_scale(own)).as_affine3a()
}

/// Multiplies the rig's corrections into the chain's local rotations, and the other eye's into its; without one that
/// eye turns in the world as joint 0 does.
fn apply<R: Rig>(character: &DynAim<R>, chain: &ChainNodes, skeleton: &Skeleton, pose: &mut [Transform]) {
    let eye = chain.joints[0];
    let before = pose[eye].rotation.as_dquat();
    for (&node, &correction) in chain.joints.iter().zip(character.corrections()) {
        pose[node].turn(correction);
    }
    match (chain.other_eye, character.other_eye_correction()) {
        (Some(node), Some(correction)) => pose[node].turn(correction),
        (Some(node), None) => follow(eye, before, node, skeleton, pose),
        (None, _) => {}
    }
}

/// Turns `pair` in the world as the `eye` turned from its rotation `before`.
fn follow(eye: usize, before: DQuat, pair: usize, skeleton: &Skeleton, pose: &mut [Transform]) {
    let turn = DMat3::from_quat(pose[eye].rotation.as_dquat() * before.inverse());
    let world = skeleton.world_f64(pose);
    let to_pair = parent_frame(skeleton, &world, pair).transpose() * parent_frame(skeleton, &world, eye);
    let turn = DQuat::from_mat3(&(to_pair * turn * to_pair.transpose())).as_quat();
    pose[pair].rotation = (turn * pose[pair].rotation).normalize();
}

fn joint_frames(joints: &[Joint], outcome: Outcome, led: impl Fn(usize) -> Option<[f64; 2]>) -> Vec<JointFrame> {
    let joints = joints.iter().enumerate().map(|(i, joint)| JointFrame {
        heading: joint.heading(),
        pitch: joint.pitch(),
        led: led(i),
        at_limit: outcome.at_limit.contains(i),
        recovering: outcome.recovering.contains(i),
    });
    joints.collect()
}
