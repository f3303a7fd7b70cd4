//! [`Live`]: one chain of one character, aimed frame by frame over whatever its animation does.

use aim_animation::{AimChain, AimChainError, AimFrame, Clip, Transform};
use aim_gltf::{Document, Skeleton};
use aim_runtime::glam::{Affine3A, DAffine3, DMat3, DVec3, Vec3};
use aim_runtime::{DynAim, Joint, LimitsFrom, Outcome, Rig};

use crate::bake::chain::ChainNodes;
use crate::bake::eye_maps::EyeMaps;
use crate::bake::morph_eyes::MorphEyes;
use crate::bake::sights::{Sights, standing_up, trunk};
use crate::error::Error;
use crate::measure::Measurement;
use crate::measure::frame::orthonormal;

/// One chain of a character of a [`Document`], aimed in each frame after its animation: an [`AimChain`] with what a file says of
/// eyes, and a judge in double precision.
///
/// A frame is: the animation's pose and its nodes in the world; [`animated`](Self::animated) of them; a call of
/// [`DynAim::aim`] or [`DynAim::snap`] with [`AimFrame::pose`]; then [`aimed`](Self::aimed), which puts the corrections into the
/// pose. A pose of another length than the skeleton is not aimed.
#[derive(Clone, Debug)]
pub struct Live {
    chain: AimChain,
    sights: Sights,
    both_eyes: bool,
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
    pub joints: &'a AimFrame,
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
    ///
    /// # Errors
    /// Nodes that are no chain of the document.
    pub fn new(
        rig: &dyn Rig,
        document: &Document,
        measurement: &Measurement,
        chain: &ChainNodes,
        both_eyes: bool,
    ) -> Result<Self, Error> {
        let skeleton = document.skeleton();
        let description = rig.description();
        let told = |error: AimChainError| Error::Chain(error.to_string());
        let mut aimed = AimChain::new(skeleton, chain.joints.clone())
            .and_then(|aimed| {
                let up = standing_up(rig, chain, measurement).as_vec3();
                aimed.with_standing_up(up, trunk(skeleton, chain, measurement))
            })
            .map_err(told)?
            .with_bind(&rounded(&measurement.bind_world))
            .map_err(|error| Error::Chain(error.to_string()))?;
        if let Some(eye) = chain.other_eye {
            aimed = if both_eyes { aimed.with_other_eye(eye) } else { aimed.with_following_eye(eye) }.map_err(told)?;
        }
        for hold in chain.held(&description, skeleton, measurement) {
            aimed = aimed.with_held(hold.node, hold.joint, description.carrier(hold.joint)).map_err(told)?;
        }
        Ok(Self {
            chain: aimed,
            sights: Sights::new(rig, chain, measurement),
            both_eyes: both_eyes && chain.other_eye.is_some(),
            maps: EyeMaps::find(document, measurement, chain),
            morphs: MorphEyes::find(document, measurement, chain),
        })
    }

    /// The local transforms of all nodes at a time of a clip, or at rest, as [`Skeleton::pose`] has them; eyes that look by morph
    /// targets are turned to where the weights have them.
    #[must_use]
    pub fn pose(&self, skeleton: &Skeleton, clip: Option<&Clip>, seconds: f32) -> Vec<Transform> {
        let mut pose = clip.map_or_else(|| skeleton.rest().to_vec(), |clip| skeleton.pose(clip, seconds));
        self.morphs.pose(clip, seconds, &mut pose);
        pose
    }

    /// Turns the eyes that look by morph targets to where the weights at a time of a clip have them: before
    /// [`animated`](Self::animated), for a pose that comes from elsewhere than [`pose`](Self::pose).
    pub fn pose_morph_eyes(&self, clip: Option<&Clip>, seconds: f32, pose: &mut [Transform]) {
        self.morphs.pose(clip, seconds, pose);
    }

    /// The weights of the morph targets that turn the eyes as an aimed pose has them, over those at a time of a clip: each
    /// with its number among [`Document::morph_scalars`].
    pub fn morph_weights(&self, clip: Option<&Clip>, seconds: f32, pose: &[Transform]) -> Vec<(usize, f32)> {
        self.morphs.scalars().zip(self.morphs.aimed(clip, seconds, pose)).collect()
    }

    /// The eyes that look by morph targets.
    pub(crate) fn morphs(&self) -> &MorphEyes {
        &self.morphs
    }

    /// The nodes that keep their place on what carries the joint that they hang on: [`ChainNodes::holds`], in their order.
    pub fn held(&self) -> impl Iterator<Item = usize> + '_ {
        self.chain.held()
    }

    /// True if a node moves with what looks while joint `effector` is aimed: if it hangs on that joint or one outside it, on an
    /// eye, the head or the neck. A gaze cannot catch up with such a node. What is [held](Self::held) and hangs on a neck does
    /// not move with it.
    #[must_use]
    pub fn looks_with(&self, skeleton: &Skeleton, node: usize, effector: usize) -> bool {
        let moving = skeleton.ancestry(node).find_map(|at| {
            let held = self.held().any(|held| held == at).then_some(false);
            held.or_else(|| self.sights.looks(at, effector))
        });
        moving.unwrap_or(false)
    }

    /// The joints as the solvers take them, for a pose and its nodes in the world. Where both eyes are aimed, the other
    /// one is first turned as joint 0 is: the eyes of animations are seldom parallel.
    #[must_use]
    pub fn animated(&self, pose: &mut [Transform], world: &[DAffine3]) -> AimFrame {
        let mut frame = self.chain.frame();
        // Another length is left unaimed.
        let _ = self.chain.gather(&mut frame, pose, &mut rounded(world));
        frame
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
        let sights = &self.sights;
        let eyes = self.maps.rotations(pose);
        // Another length is left unaimed.
        let _ = self.chain.apply(joints, character.into(), pose, &mut joints.model().to_vec());
        let world = skeleton.world_f64(pose);
        let mut frame = AimedFrame {
            t,
            target,
            error_deg: sights.sight(effector).error_deg(&world, target),
            roll_deg: sights.roll_deg(effector, self.up(animated), [animated, &world]),
            pair_error_deg: sights.other_eye.filter(|_| self.both_eyes).map(|pair| pair.error_deg(&world, target)),
            outcome,
            joints: joint_frames(&character.state.joints, outcome, |joint| led(&character.rig, joint, joints)),
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
        self.chain.up(&rounded(world)).unwrap_or_default().as_dvec3()
    }

    /// Point and direction (of length one) that joint `effector` looks from and along, in the world; of joint 0 those of the
    /// rig's effector. The other eye's too, where it is aimed or follows and joint 0 is what looks.
    #[must_use]
    pub fn gazes(&self, effector: usize, world: &[DAffine3]) -> Vec<[DVec3; 2]> {
        let pair = self.sights.other_eye.as_ref().filter(|_| effector == 0);
        core::iter::once(self.sights.sight(effector)).chain(pair).map(|sight| sight.gaze(world)).collect()
    }
}

/// Transforms in the precision of the solvers.
pub(crate) fn rounded(world: &[DAffine3]) -> Vec<Affine3A> {
    world.iter().map(DAffine3::as_affine3a).collect()
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

/// The heading and pitch, radians, by which the animation turns a joint with an absolute range out of its bind pose,
/// as seen from the next joint; `None` where ranges are relative.
fn led(rig: &dyn Rig, joint: usize, animated: &AimFrame) -> Option<[f64; 2]> {
    let description = rig.description();
    let pose = animated.pose();
    let info = description.joints().get(joint).filter(|info| info.limits_from == LimitsFrom::BindPose)?;
    let local = |joints: &[Affine3A]| -> Option<DMat3> {
        let frame = |at: &Affine3A| orthonormal(&at.matrix3.as_dmat3()).0;
        let own = frame(joints.get(joint)?);
        Some(joints.get(joint + 1).map_or(own, |next| frame(next).transpose() * own))
    };
    let turn = local(pose.bind?)?.transpose() * local(pose.joints)?;
    let [up, ahead, left] =
        [info.axes().up, info.axes().forward, info.axes().left].map(|axis| Vec3::from(axis).as_dvec3());
    let forward = turn * ahead;
    let (up, ahead, left) = (forward.dot(up), forward.dot(ahead), forward.dot(left));
    Some([left.atan2(ahead), up.atan2(left.hypot(ahead))])
}
