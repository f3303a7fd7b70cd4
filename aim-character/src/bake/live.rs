//! [`Live`]: one chain of one character, aimed frame by frame over its animation.

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

/// One chain of a character of a [`Document`], aimed in each frame after the animation.
///
/// It extends [`AimChain`] by the eyes that the file describes and by results measured in double precision. The steps
/// of a frame are:
///
/// - Sample the pose and compute its world transforms.
/// - Call [`animated`](Self::animated) with them.
/// - Call [`DynAim::aim`] or [`DynAim::snap`] with [`AimFrame::pose`].
/// - Call [`aimed`](Self::aimed), which writes the corrections into the pose.
///
/// A pose whose length differs from the skeleton's is not aimed.
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
    /// Time of the frame, seconds. It is only copied to the result.
    pub t: f32,
    /// Target in world space.
    pub target: DVec3,
    /// Animated world transform of every node.
    pub world: &'a [DAffine3],
    /// Result of [`Live::animated`].
    pub joints: &'a AimFrame,
    /// Outcome of the solver.
    pub outcome: Outcome,
    /// Aimed joint: [`Settings::effector`](aim_runtime::Settings::effector).
    pub effector: usize,
}

/// Result for one joint in one frame.
#[derive(Clone, Copy, Debug)]
pub struct JointFrame {
    /// Added heading, radians.
    pub heading: f32,
    /// Added pitch, radians.
    pub pitch: f32,
    /// Heading and pitch, radians, by which the animation turns the joint from its bind pose; `None` unless the joint's
    /// ranges are counted from the bind pose.
    pub animated_angles: Option<[f64; 2]>,
    /// `true` if an angle is at an end of its range.
    pub at_limit: bool,
    /// `true` if an angle is outside its range and returning to it.
    pub recovering: bool,
}

/// Result of one aimed frame.
#[derive(Clone, Debug)]
pub struct AimedFrame {
    /// Time of the frame, seconds.
    pub t: f32,
    /// Target in world space.
    pub target: DVec3,
    /// Angle between the effector's direction and the direction to the target, degrees, computed by forward kinematics
    /// of the written pose before the range maps of a VRM file's eyes are applied. 90 if either direction is undefined.
    pub error_deg: f64,
    /// Roll of the aimed joint about its gaze, less the roll in the animation, degrees, positive to the character's
    /// left. The roll is the angle, seen along the gaze, from the character's up to the bone's up. 0 if either of them
    /// lies within 1° of the gaze. The character's up is the world's while the character stands.
    pub roll_deg: f64,
    /// [`error_deg`](Self::error_deg) of the other eye, if both eyes are aimed. In the bind pose the other eye looks in
    /// the same direction as joint 0, from the mirrored point.
    pub pair_error_deg: Option<f64>,
    /// Added heading and pitch of the other eye, radians, about axes parallel to joint 0's; `None` unless both eyes are
    /// aimed.
    pub pair_angles: Option<[f32; 2]>,
    /// Outcome of the solver.
    pub outcome: Outcome,
    /// Results of the joints, from the effector inward.
    pub joints: Vec<JointFrame>,
    /// World transforms of the file's nodes after aiming.
    pub world: Vec<DAffine3>,
}

impl Live {
    /// Prepares a rig whose joints are the chain's nodes. If `both_eyes` is set and the chain has another eye, that eye
    /// is aimed itself; otherwise it turns as joint 0 does.
    ///
    /// # Errors
    /// Fails if the nodes do not form a chain of the document.
    pub fn new(
        rig: &dyn Rig,
        document: &Document,
        measurement: &Measurement,
        chain: &ChainNodes,
        both_eyes: bool,
    ) -> Result<Self, Error> {
        let skeleton = document.skeleton();
        let description = rig.description();
        let to_error = |error: AimChainError| Error::Chain(error.to_string());
        let mut aimed = AimChain::new(skeleton, chain.joints.clone())
            .and_then(|aimed| {
                let up = standing_up(rig, chain, measurement).as_vec3();
                aimed.with_standing_up(up, trunk(skeleton, chain, measurement))
            })
            .map_err(to_error)?
            .with_bind(&rounded(&measurement.bind_world))
            .map_err(|error| Error::Chain(error.to_string()))?;
        if let Some(eye) = chain.other_eye {
            aimed =
                if both_eyes { aimed.with_other_eye(eye) } else { aimed.with_following_eye(eye) }.map_err(to_error)?;
        }
        for hold in chain.held(&description, skeleton, measurement) {
            aimed = aimed.with_held(hold.node, hold.joint, description.carrier(hold.joint)).map_err(to_error)?;
        }
        Ok(Self {
            chain: aimed,
            sights: Sights::new(rig, chain, measurement),
            both_eyes: both_eyes && chain.other_eye.is_some(),
            maps: EyeMaps::find(document, measurement, chain),
            morphs: MorphEyes::find(document, measurement, chain),
        })
    }

    /// Returns the local transforms of all nodes at a time of a clip, or at rest, like [`Skeleton::pose`]. Eyes that
    /// look by morph targets are turned to the direction that their weights give.
    #[must_use]
    pub fn pose(&self, skeleton: &Skeleton, clip: Option<&Clip>, seconds: f32) -> Vec<Transform> {
        let mut pose = clip.map_or_else(|| skeleton.rest().to_vec(), |clip| skeleton.pose(clip, seconds));
        self.morphs.pose(clip, seconds, &mut pose);
        pose
    }

    /// Turns the eyes that look by morph targets to the direction that their weights give at a time of a clip. Needed
    /// before [`animated`](Self::animated) for a pose that does not come from [`pose`](Self::pose).
    pub fn pose_morph_eyes(&self, clip: Option<&Clip>, seconds: f32, pose: &mut [Transform]) {
        self.morphs.pose(clip, seconds, pose);
    }

    /// Returns the morph target weights for the directions of the eyes in an aimed pose, changed from those at a time
    /// of a clip. Each comes with its index among [`Document::morph_scalars`].
    pub fn morph_weights(&self, clip: Option<&Clip>, seconds: f32, pose: &[Transform]) -> Vec<(usize, f32)> {
        self.morphs.scalars().zip(self.morphs.aimed(clip, seconds, pose)).collect()
    }

    /// Returns the eyes that look by morph targets.
    pub(crate) fn morphs(&self) -> &MorphEyes {
        &self.morphs
    }

    /// Returns the [held](ChainNodes::holds) nodes in their order. They move with the carrier of the joint that they
    /// descend from.
    pub fn held(&self) -> impl Iterator<Item = usize> + '_ {
        self.chain.held()
    }

    /// Returns `true` if a node moves with the gaze while joint `effector` is aimed: its nearest turned ancestor (or
    /// the node itself) is that joint or one nearer the effector, or an eye, the head or the neck. A gaze cannot catch
    /// up with such a node. [Held](Self::held) nodes and their descendants do not move with it.
    #[must_use]
    pub fn looks_with(&self, skeleton: &Skeleton, node: usize, effector: usize) -> bool {
        let moving = skeleton.ancestry(node).find_map(|at| {
            let held = self.held().any(|held| held == at).then_some(false);
            held.or_else(|| self.sights.looks(at, effector))
        });
        moving.unwrap_or(false)
    }

    /// Returns the joints in the form that the solvers take, for a pose and its world transforms. If both eyes are
    /// aimed, the other eye is first turned parallel to joint 0, because animated eyes are seldom parallel.
    #[must_use]
    pub fn animated(&self, pose: &mut [Transform], world: &[DAffine3]) -> AimFrame {
        let mut frame = self.chain.frame();
        // A pose of another length is left unaimed.
        let _ = self.chain.gather(&mut frame, pose, &mut rounded(world));
        frame
    }

    /// Writes the rig's corrections into the pose, moves [held](Self::held) nodes back, and measures the result.
    ///
    /// The eyes of a VRM file then turn by its range maps. Errors and angles refer to the gaze before the maps, which
    /// is their input; the pose and [`world`](AimedFrame::world) hold the bones after the maps.
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
        // A pose of another length is left unaimed.
        let _ = self.chain.apply(joints, character.into(), pose, &mut joints.model().to_vec());
        let world = skeleton.world_f64(pose);
        let mut frame = AimedFrame {
            t,
            target,
            error_deg: sights.sight(effector).error_deg(&world, target),
            roll_deg: sights.roll_deg(effector, self.up(animated), [animated, &world]),
            pair_error_deg: sights.other_eye.filter(|_| self.both_eyes).map(|pair| pair.error_deg(&world, target)),
            pair_angles: character.state.memory.other_eye().filter(|_| self.both_eyes),
            outcome,
            joints: joint_frames(&character.state.joints, outcome, |joint| {
                animated_angles(&character.rig, joint, joints)
            }),
            world,
        };
        if !self.maps.is_empty() {
            self.maps.apply(&eyes, pose);
            frame.world = skeleton.world_f64(pose);
        }
        frame
    }

    /// Returns the character's up in the world: the up of the standing character, or one fixed to the trunk while it
    /// lies.
    pub(crate) fn up(&self, world: &[DAffine3]) -> DVec3 {
        self.chain.up(&rounded(world)).unwrap_or_default().as_dvec3()
    }

    /// Returns the point and the unit direction from and along which joint `effector` looks, in world space; for joint
    /// 0, those of the rig's effector. For joint 0 the other eye's follow, if the chain has one.
    #[must_use]
    pub fn gazes(&self, effector: usize, world: &[DAffine3]) -> Vec<[DVec3; 2]> {
        let pair = self.sights.other_eye.as_ref().filter(|_| effector == 0);
        core::iter::once(self.sights.sight(effector)).chain(pair).map(|sight| sight.gaze(world)).collect()
    }
}

/// Converts transforms to the solvers' single precision.
pub(crate) fn rounded(world: &[DAffine3]) -> Vec<Affine3A> {
    world.iter().map(DAffine3::as_affine3a).collect()
}

fn joint_frames(
    joints: &[Joint],
    outcome: Outcome,
    animated_angles: impl Fn(usize) -> Option<[f64; 2]>,
) -> Vec<JointFrame> {
    let joints = joints.iter().enumerate().map(|(i, joint)| JointFrame {
        heading: joint.heading(),
        pitch: joint.pitch(),
        animated_angles: animated_angles(i),
        at_limit: outcome.at_limit.contains(i),
        recovering: outcome.recovering.contains(i),
    });
    joints.collect()
}

/// Returns the heading and pitch, radians, by which the animation turns a joint from its bind pose relative to the next
/// joint inward; `None` unless the joint's ranges are counted from the bind pose.
fn animated_angles(rig: &dyn Rig, joint: usize, animated: &AimFrame) -> Option<[f64; 2]> {
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
