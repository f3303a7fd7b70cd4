//! Solvers of [`aim_runtime::ik`] that are tried on the character that is shown, in place of its rig's.
//!
//! A [`Tool`] says which. [`Tools`] has found the bones that each of them turns, once for each character; [`Tools::apply`]
//! turns them over the animation of a frame and says what came of it.

mod aim_poses;
mod ccd;
mod look_at;
mod one_bone;

use aim_animation::Transform;
use aim_character::{InterpretedRig, Live};
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Axes, Status};

use self::aim_poses::PoseSet;
use self::ccd::Arm;
use self::look_at::Head;
use self::one_bone::Pointer;
use crate::character::Character;

/// Which solver is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tool {
    /// [`aim_runtime::ik::LookAt`]: the head alone, as it sits on its neck.
    LookAt,
    /// [`aim_runtime::ik::OneBone`]: each eye, or what is aimed first.
    OneBone,
    /// [`aim_runtime::ik::Ccd`]: a hand reaches by arm and chest, or the head by the trunk.
    Ccd,
    /// [`aim_runtime::ik::AimPoses`]: between poses that the rig itself has made.
    AimPoses,
}

impl Tool {
    pub(crate) const ALL: [Self; 4] = [Self::LookAt, Self::OneBone, Self::Ccd, Self::AimPoses];

    /// The next of none and all in a circle.
    pub(crate) fn after(tool: Option<Self>) -> Option<Self> {
        let at = Self::ALL.iter().position(|each| Some(*each) == tool);
        Self::ALL.get(at.map_or(0, |at| at + 1)).copied()
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::LookAt => "look at",
            Self::OneBone => "one bone",
            Self::Ccd => "ccd",
            Self::AimPoses => "aim poses",
        }
    }
}

/// What came of a tool in a frame.
#[derive(Clone, Debug)]
pub(crate) struct Tried {
    pub(crate) status: Status,
    /// Between where it points and the target, degrees: of a hand as the chain's root sees both.
    pub(crate) error_deg: f64,
    /// Starts and directions of what points.
    pub(crate) gazes: Vec<[Vec3; 2]>,
}

/// A frame for a tool.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Try {
    pub(crate) tool: Tool,
    pub(crate) target: Vec3,
    /// Seconds.
    pub(crate) dt: f32,
}

/// The bones that each tool turns on one character.
#[derive(Debug)]
pub(crate) struct Tools {
    head: Head,
    pointers: Vec<Pointer>,
    arm: Arm,
    poses: PoseSet,
}

impl Tools {
    pub(crate) fn new(character: &Character, rig: &InterpretedRig, live: &Live) -> Self {
        Self {
            head: Head::new(character),
            pointers: Pointer::each(character),
            arm: Arm::new(character),
            poses: PoseSet::new(character, rig, live),
        }
    }

    /// Turns the tool's bones in the pose. `head` is how a head that is turned was left by the last frame.
    pub(crate) fn apply(
        &self,
        character: &Character,
        tried: Try,
        pose: &mut [Transform],
        head: &mut Option<Quat>,
    ) -> Tried {
        let mut body = Body::new(character, pose);
        if tried.tool != Tool::LookAt {
            *head = None;
        }
        match tried.tool {
            Tool::LookAt => self.head.look(&mut body, tried, head),
            Tool::OneBone => Pointer::point(&self.pointers, &mut body, tried.target),
            Tool::Ccd => self.arm.reach(&mut body, tried.target),
            Tool::AimPoses => self.poses.aim(&mut body, tried.target),
        }
    }
}

/// A pose that is turned bone by bone.
struct Body<'a> {
    character: &'a Character,
    local: &'a mut [Transform],
    model: Vec<Affine3A>,
}

impl<'a> Body<'a> {
    fn new(character: &'a Character, local: &'a mut [Transform]) -> Self {
        let mut model = vec![Affine3A::IDENTITY; local.len()];
        // Of equal lengths, here and below.
        let _ = character.skeleton().to_model(local, &mut model);
        Self { character, local, model }
    }

    /// Turns a bone, and what hangs on it, in the space of the model.
    fn turn(&mut self, bone: usize, turn: Quat) {
        let skeleton = self.character.skeleton();
        let _ = skeleton.turn_in_model(bone, turn, &self.model, self.local);
        self.carry(bone);
    }

    /// Gives a bone a rotation in its parent's space.
    fn set(&mut self, bone: usize, rotation: Quat) {
        self.local[bone].rotation = rotation;
        self.carry(bone);
    }

    fn carry(&mut self, bone: usize) {
        let _ = self.character.skeleton().to_model_below(bone, self.local, &mut self.model);
    }

    /// Of length one, or zero.
    fn direction(&self, bone: usize, of_bone: Vec3) -> Vec3 {
        self.model[bone].transform_vector3(of_bone).normalize_or_zero()
    }

    fn origin(&self, bone: usize) -> Vec3 {
        self.model[bone].translation.into()
    }
}

/// Degrees between a gaze and its target; 90 where there is no direction.
fn error_deg([from, direction]: [Vec3; 2], target: Vec3) -> f64 {
    let (direction, wanted) = (direction.as_dvec3(), (target - from).as_dvec3());
    let [across, along] = [direction.cross(wanted).length(), direction.dot(wanted)];
    if across == 0.0 && along == 0.0 { 90.0 } else { across.atan2(along).to_degrees() }
}

/// A bone's measured axes; those of the world of the model for a bone that was not measured.
fn axes(character: &Character, bone: usize) -> Axes {
    let measured = character.measurement.bone(bone).map(|bone| bone.frame);
    let [up, forward, left] = measured.map_or_else(
        || {
            let world = character.measurement.bind_world[bone];
            let back = |direction: Vec3| world.matrix3.transpose() * direction.as_dvec3();
            character.directions().map(|direction| back(direction).as_vec3().normalize_or_zero())
        },
        |frame| [frame.up, frame.forward, frame.left].map(|axis| axis.as_vec3()),
    );
    Axes { up: up.to_array(), forward: forward.to_array(), left: left.to_array() }
}
