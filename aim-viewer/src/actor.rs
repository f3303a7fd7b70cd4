//! [`Actor`]: a displayed character with its solver and the results of its last frame.

use std::sync::Arc;

use aim_character::AimedFrame;
use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::{DynAim, Rig, Solver};

use crate::feet::Feet;
use crate::player::Player;
use crate::skinning::Posed;
use crate::tools::Tool;
use crate::tuning::solver_name;

/// A rig, shared by characters. The crowd of mannequins uses a compiled rig, as a game would.
pub(crate) type SharedRig = Arc<dyn Rig>;

/// A displayed character with its solver.
#[derive(Debug)]
pub(crate) struct Actor {
    pub(crate) solver: Solver,
    /// Offset of the figure from the character's position in the file.
    pub(crate) shift: Vec3,
    pub(crate) player: Player,
    pub(crate) character: DynAim<SharedRig>,
    /// Tool that is used instead of the solver.
    pub(crate) tool: Option<Tool>,
    /// Head rotation after the last frame of [`Tool::LookAt`], which turns the head alone.
    pub(crate) head: Option<Quat>,
    /// The feet, while the sloped floor is on.
    pub(crate) feet: Option<Feet>,
    /// Result of the last frame; `None` before the first.
    pub(crate) frame: Option<AimedFrame>,
    /// Origins and directions of the rays in the last frame: those of both eyes, or of the joint that is aimed instead.
    pub(crate) gazes: Vec<[Vec3; 2]>,
    /// Joint transforms and morph weights that pose the mesh in the last frame.
    pub(crate) posed: Posed,
}

impl Actor {
    pub(crate) fn new(solver: Solver, shift: Vec3, player: Player, character: DynAim<SharedRig>) -> Self {
        Self {
            solver,
            shift,
            player,
            character,
            tool: None,
            head: None,
            feet: None,
            frame: None,
            gazes: Vec::new(),
            posed: Posed::default(),
        }
    }

    /// Returns the name of the tool or solver in use.
    pub(crate) fn name(&self) -> &'static str {
        self.tool.map_or_else(|| solver_name(self.solver), Tool::name)
    }

    /// Replaces the rig. The joints keep their angles if their number is the same.
    pub(crate) fn change_rig(&mut self, rig: SharedRig) {
        let mut character = DynAim::new(rig);
        if character.state.joints.len() == self.character.state.joints.len() {
            character.state.joints.clone_from(&self.character.state.joints);
        }
        self.character = character;
    }
}
