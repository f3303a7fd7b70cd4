//! [`AimBinding`]: the state of a character whose bones have been found. [`AimedBone`]: one of these bones.

use std::fmt;

use aim::animation::{AimChain, AimFrame, GizmoLine, Gizmos, Skeleton, Transform as Local};
use aim::glam::{Affine3A, Quat};
use aim::{DynAim, Joint, Outcome, Pose, Rig as _, Settings, Target, Targets};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_transform::components::Transform;

use crate::SharedRig;

/// State of a character whose bones have been found: the bones, the angles, and the input and result of the last frame.
///
/// The plugin inserts it, and removes it if a bone is despawned or reparented. It then searches for the bones again.
#[derive(Component)]
pub struct AimBinding {
    /// Entity of each bone of `skeleton`: the aimed and held bones, and their ancestors below the character's entity.
    pub(crate) entities: Vec<Entity>,
    pub(crate) chain: AimChain,
    pub(crate) other_eye: Option<usize>,
    pub(crate) skeleton: Skeleton,
    pub(crate) aim: DynAim<SharedRig>,
    pub(crate) frame: AimFrame,
    /// Local transforms of the bones as animated, without corrections.
    pub(crate) animated: Vec<Local>,
    /// Local transforms of the bones with this frame's corrections.
    pub(crate) aimed: Vec<Local>,
    pub(crate) model: Vec<Affine3A>,
    pub(crate) targets: Vec<Target>,
    /// `true` if `animated` and `aimed` belong to this frame.
    pub(crate) is_solved: bool,
    /// `true` if a bone was despawned or reparented.
    pub(crate) is_broken: bool,
    /// `true` if the last solve ignored rates ([`AimSnap`](crate::AimSnap)).
    pub(crate) has_snapped: bool,
}

/// Marks a bone that a character aims or holds, and stores its transform with and without the correction.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct AimedBone {
    pub(crate) character: Entity,
    pub(crate) bone: usize,
    pub(crate) base: Transform,
    pub(crate) written: Transform,
}

impl AimedBone {
    /// Returns the entity of the character.
    #[must_use]
    pub fn character(&self) -> Entity {
        self.character
    }

    /// Returns the bone's animated transform of the last frame, without the correction.
    #[must_use]
    pub fn animated_transform(&self) -> Transform {
        self.base
    }
}

impl AimBinding {
    pub(crate) fn new(entities: Vec<Entity>, skeleton: Skeleton, chain: AimChain, rig: SharedRig) -> Self {
        let (frame, rest) = (chain.frame(), skeleton.rest().to_vec());
        Self {
            entities,
            other_eye: None,
            aim: DynAim::new(rig),
            frame,
            animated: rest.clone(),
            model: vec![Affine3A::IDENTITY; rest.len()],
            aimed: rest,
            targets: Vec::new(),
            is_solved: false,
            is_broken: false,
            has_snapped: false,
            chain,
            skeleton,
        }
    }

    /// Copies the solver's state from `before` if both rigs have the same joint names, so that the motion continues
    /// without a jump after the scene or rig is reloaded.
    pub(crate) fn go_on_from(&mut self, before: &Self) {
        let (rig, was) = (&self.aim.rig, &before.aim.rig);
        let count = self.angles().len();
        let is_same = |joint: usize| rig.joint_name(joint) == was.joint_name(joint);
        if before.angles().len() == count && (0..count).all(is_same) {
            self.aim.state = before.aim.state.clone();
        }
    }

    /// Returns the bone of each joint, from the effector inward.
    pub fn joints(&self) -> impl Iterator<Item = Entity> + '_ {
        self.chain.joints().iter().map(|&bone| self.entities[bone])
    }

    /// Returns the held bones.
    pub fn held(&self) -> impl Iterator<Item = Entity> + '_ {
        self.chain.held().map(|bone| self.entities[bone])
    }

    /// Returns the rig.
    #[must_use]
    pub fn rig(&self) -> &SharedRig {
        &self.aim.rig
    }

    /// Returns the angles of the joints, from the effector inward.
    #[must_use]
    pub fn angles(&self) -> &[Joint] {
        &self.aim.state.joints
    }

    /// Returns the corrections of the last frame, from the effector inward. An aimed local rotation is
    /// `animated * correction`.
    #[must_use]
    pub fn corrections(&self) -> &[Quat] {
        self.aim.corrections()
    }

    /// Returns the correction of the other eye, or `None` if it is not aimed.
    #[must_use]
    pub fn other_eye_correction(&self) -> Option<Quat> {
        self.aim.other_eye_correction()
    }

    /// Returns the pose that the solver received in the last frame, world space.
    #[must_use]
    pub fn pose(&self) -> Pose<&[Affine3A]> {
        self.frame.pose()
    }

    /// Returns the targets that the solver received in the last frame, world space.
    #[must_use]
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// Returns the gazes as line segments of this length, in metres, world space: see [`Gizmos::gazes`].
    pub fn gaze_lines(&self, length: f32) -> Vec<GizmoLine> {
        self.lines(|gizmos| gizmos.gazes(length).collect())
    }

    /// Returns the outlines of the ranges of motion, drawn at this distance in metres from the joints, world space: see
    /// [`Gizmos::ranges`].
    pub fn range_lines(&self, length: f32) -> Vec<GizmoLine> {
        self.lines(|gizmos| gizmos.ranges(length).collect())
    }

    /// Returns the axes of the joints' bones as line segments of this length, in metres, world space: see
    /// [`Gizmos::axes`].
    pub fn axis_lines(&self, length: f32) -> Vec<GizmoLine> {
        self.lines(|gizmos| gizmos.axes(length).collect())
    }

    fn lines(&self, of: impl Fn(Gizmos<'_>) -> Vec<GizmoLine>) -> Vec<GizmoLine> {
        let description = self.aim.rig.description();
        let Self { chain, frame, model, .. } = self;
        of(Gizmos { chain, frame, description: &description, corrections: (&self.aim).into(), model })
    }

    /// Aims the animated pose for a frame of `dt` seconds. With `dt` `None` it snaps: rates are ignored.
    pub(crate) fn solve(&mut self, place: Affine3A, dt: Option<f32>, settings: &Settings) -> Outcome {
        let Self { chain, skeleton, aim, frame, animated, aimed, model, targets, .. } = self;
        aimed.copy_from_slice(animated);
        frame.place = place;
        // Cannot fail here or below: all slices have the skeleton's length.
        let _ = skeleton.to_model(aimed, model);
        let _ = chain.gather(frame, aimed, model);
        let (pose, targets) = (frame.pose(), targets_of(targets));
        let outcome = match dt {
            Some(dt) => aim.aim(&pose, targets, dt, settings),
            None => aim.snap(&pose, targets, settings),
        };
        let _ = chain.apply(frame, (&*aim).into(), aimed, model);
        self.is_solved = true;
        outcome
    }
}

/// Passes a single target of weight 1 as [`Targets::Point`].
fn targets_of(targets: &[Target]) -> Targets<'_> {
    match targets {
        [only] if only.weight == 1.0 => Targets::Point(only.point),
        several => Targets::Weighted(several),
    }
}

impl fmt::Debug for AimBinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joints: Vec<Entity> = self.joints().collect();
        f.debug_struct("AimBinding").field("joints", &joints).field("angles", &self.angles()).finish_non_exhaustive()
    }
}
