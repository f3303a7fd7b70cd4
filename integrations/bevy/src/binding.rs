//! [`AimBinding`]: a character whose bones are found; [`AimedBone`]: one of them.

use std::fmt;

use aim::animation::{AimChain, AimFrame, GizmoLine, Gizmos, Skeleton, Transform as Local};
use aim::glam::{Affine3A, Quat};
use aim::{DynAim, Joint, Outcome, Pose, Rig as _, Settings, Target, Targets};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_transform::components::Transform;

use crate::SharedRig;

/// A character whose bones are found: what it remembers, and this frame's input and result. The plugin puts it on, and takes it
/// off where a bone is despawned or hung elsewhere; then the bones are looked for again.
#[derive(Component)]
pub struct AimBinding {
    /// The bones of `skeleton`: all that are aimed or held, and what they hang on up to the character's entity.
    pub(crate) entities: Vec<Entity>,
    pub(crate) chain: AimChain,
    pub(crate) other_eye: Option<usize>,
    pub(crate) skeleton: Skeleton,
    pub(crate) aim: DynAim<SharedRig>,
    pub(crate) frame: AimFrame,
    /// The bones as animated, without corrections.
    pub(crate) animated: Vec<Local>,
    /// The same with this frame's corrections.
    pub(crate) aimed: Vec<Local>,
    pub(crate) model: Vec<Affine3A>,
    pub(crate) targets: Vec<Target>,
    /// Whether `animated` and `aimed` are of this frame.
    pub(crate) is_solved: bool,
    /// Whether a bone is gone, or hangs elsewhere.
    pub(crate) is_broken: bool,
    /// Whether a call has put the character on its target at once.
    pub(crate) has_snapped: bool,
}

/// A bone that a character aims, or holds.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct AimedBone {
    pub(crate) character: Entity,
    pub(crate) bone: usize,
    pub(crate) base: Transform,
    pub(crate) written: Transform,
}

impl AimedBone {
    /// The entity of the character.
    #[must_use]
    pub fn character(&self) -> Entity {
        self.character
    }

    /// The bone as it was animated, without the correction, in the last frame.
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

    /// Takes over the angles of a character with the same joints, whose scene or rig was loaded anew: it goes on as it was.
    pub(crate) fn go_on_from(&mut self, before: &Self) {
        let (rig, was) = (&self.aim.rig, &before.aim.rig);
        let count = self.angles().len();
        let is_same = |joint: usize| rig.joint_name(joint) == was.joint_name(joint);
        if before.angles().len() == count && (0..count).all(is_same) {
            self.aim.state = before.aim.state.clone();
        }
    }

    /// The bone of each joint, from the effector inward.
    pub fn joints(&self) -> impl Iterator<Item = Entity> + '_ {
        self.chain.joints().iter().map(|&bone| self.entities[bone])
    }

    /// The bones that are held.
    pub fn held(&self) -> impl Iterator<Item = Entity> + '_ {
        self.chain.held().map(|bone| self.entities[bone])
    }

    /// The rig.
    #[must_use]
    pub fn rig(&self) -> &SharedRig {
        &self.aim.rig
    }

    /// The angles of the joints, from the effector inward.
    #[must_use]
    pub fn angles(&self) -> &[Joint] {
        &self.aim.state.joints
    }

    /// The corrections of the last frame, from the effector inward: what animated local rotations are multiplied by on the right.
    #[must_use]
    pub fn corrections(&self) -> &[Quat] {
        self.aim.corrections()
    }

    /// The correction of the other eye, if it is aimed.
    #[must_use]
    pub fn other_eye_correction(&self) -> Option<Quat> {
        self.aim.other_eye_correction()
    }

    /// The pose that the solver was given in the last frame, in the world.
    #[must_use]
    pub fn pose(&self) -> Pose<&[Affine3A]> {
        self.frame.pose()
    }

    /// The points that the solver was given in the last frame.
    #[must_use]
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// The gazes in the world, as lines of this length: see [`Gizmos::gazes`].
    pub fn gaze_lines(&self, length: f32) -> Vec<GizmoLine> {
        self.lines(|gizmos| gizmos.gazes(length).collect())
    }

    /// The ranges of motion in the world, as rims at this distance from the joints: see [`Gizmos::ranges`].
    pub fn range_lines(&self, length: f32) -> Vec<GizmoLine> {
        self.lines(|gizmos| gizmos.ranges(length).collect())
    }

    /// The axes of the joints' bones in the world: see [`Gizmos::axes`].
    pub fn axis_lines(&self, length: f32) -> Vec<GizmoLine> {
        self.lines(|gizmos| gizmos.axes(length).collect())
    }

    fn lines(&self, of: impl Fn(Gizmos<'_>) -> Vec<GizmoLine>) -> Vec<GizmoLine> {
        let description = self.aim.rig.description();
        let Self { chain, frame, model, .. } = self;
        of(Gizmos { chain, frame, description: &description, corrections: (&self.aim).into(), model })
    }

    /// Aims the animated pose for a frame, or at once without `dt`.
    pub(crate) fn solve(&mut self, place: Affine3A, dt: Option<f32>, settings: &Settings) -> Outcome {
        let Self { chain, skeleton, aim, frame, animated, aimed, model, targets, .. } = self;
        aimed.copy_from_slice(animated);
        frame.place = place;
        // Slices of the skeleton's own length.
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

/// A single target of full weight is a point.
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
