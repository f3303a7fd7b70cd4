//! Solvers of [`aim_runtime::ik`] that can be used on the displayed character instead of its rig's solver.
//!
//! [`Tool`] selects the solver. [`Tools`] holds the bones that each one turns, found once for each character.
//! [`Tools::apply`] turns them on top of the animation of a frame and returns the result.

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

/// A solver that can be used instead of the rig's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tool {
    /// [`aim_runtime::ik::LookAt`]: turns only the head, relative to the neck.
    LookAt,
    /// [`aim_runtime::ik::OneBone`]: turns each eye, or the first joint of the chain.
    OneBone,
    /// [`aim_runtime::ik::Ccd`]: the right hand reaches with arm and chest, or without a hand the tip of the chain.
    Ccd,
    /// [`aim_runtime::ik::AimPoses`]: blends poses that the rig has generated.
    AimPoses,
}

impl Tool {
    pub(crate) const ALL: [Self; 4] = [Self::LookAt, Self::OneBone, Self::Ccd, Self::AimPoses];

    /// Returns the next tool in the cycle: none, then each of [`ALL`](Self::ALL).
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

/// Result of a tool in a frame.
#[derive(Clone, Debug)]
pub(crate) struct Tried {
    pub(crate) status: Status,
    /// Angle between the direction of pointing and the target, degrees. For a hand, the angle between hand and target
    /// seen from the root of the chain.
    pub(crate) error_deg: f64,
    /// Origins and directions of the rays.
    pub(crate) gazes: Vec<[Vec3; 2]>,
}

/// Input of a tool for a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Try {
    pub(crate) tool: Tool,
    pub(crate) target: Vec3,
    /// Duration of the frame, seconds.
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

    /// Turns the tool's bones in the pose. `head` is the local rotation of the head after the last frame of
    /// [`Tool::LookAt`].
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

/// A pose, in local and model space, whose bones are turned one by one.
struct Body<'a> {
    character: &'a Character,
    local: &'a mut [Transform],
    model: Vec<Affine3A>,
}

impl<'a> Body<'a> {
    fn new(character: &'a Character, local: &'a mut [Transform]) -> Self {
        let mut model = vec![Affine3A::IDENTITY; local.len()];
        // Cannot fail here or below: all slices have the skeleton's length.
        let _ = character.skeleton().to_model(local, &mut model);
        Self { character, local, model }
    }

    /// Turns a bone and its descendants by a rotation in model space.
    fn turn(&mut self, bone: usize, turn: Quat) {
        let skeleton = self.character.skeleton();
        let _ = skeleton.turn_in_model(bone, turn, &self.model, self.local);
        self.carry(bone);
    }

    /// Sets a bone's rotation in its parent's space.
    fn set(&mut self, bone: usize, rotation: Quat) {
        self.local[bone].rotation = rotation;
        self.carry(bone);
    }

    fn carry(&mut self, bone: usize) {
        let _ = self.character.skeleton().to_model_below(bone, self.local, &mut self.model);
    }

    /// Returns a direction of a bone in model space: a unit vector, or zero if it is degenerate.
    fn direction(&self, bone: usize, of_bone: Vec3) -> Vec3 {
        self.model[bone].transform_vector3(of_bone).normalize_or_zero()
    }

    fn origin(&self, bone: usize) -> Vec3 {
        self.model[bone].translation.into()
    }
}

/// Returns the angle between a gaze and its target, degrees; 90 if there is no direction.
fn error_deg([from, direction]: [Vec3; 2], target: Vec3) -> f64 {
    let (direction, wanted) = (direction.as_dvec3(), (target - from).as_dvec3());
    let [across, along] = [direction.cross(wanted).length(), direction.dot(wanted)];
    if across == 0.0 && along == 0.0 { 90.0 } else { across.atan2(along).to_degrees() }
}

/// Returns a bone's measured axes, or for a bone that was not measured the character's directions in the bone's space.
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
