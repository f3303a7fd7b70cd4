//! [`Actor`]: a character with a solver, frame by frame.

use std::sync::Arc;

use aim_character::AimedFrame;
use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::{DynAim, Rig, Solver};

use crate::feet::Feet;
use crate::player::Player;
use crate::skinning::Posed;
use crate::tools::Tool;
use crate::tuning::solver_name;

/// A rig that characters share: the crowd of mannequins has a compiled one, as a game's would be.
pub(crate) type SharedRig = Arc<dyn Rig>;

/// A character with a solver.
#[derive(Debug)]
pub(crate) struct Actor {
    pub(crate) solver: Solver,
    /// Offset from its place in the file.
    pub(crate) shift: Vec3,
    pub(crate) player: Player,
    pub(crate) character: DynAim<SharedRig>,
    /// What is tried in place of the solver.
    pub(crate) tool: Option<Tool>,
    /// How a head that is turned by itself was left by the last frame.
    pub(crate) head: Option<Quat>,
    /// Its feet, while they stand on a slope.
    pub(crate) feet: Option<Feet>,
    /// Result of the last frame; there from the first one on.
    pub(crate) frame: Option<AimedFrame>,
    /// Starts and directions of what points in that frame: of both eyes, or of the other joint that is aimed.
    pub(crate) gazes: Vec<[Vec3; 2]>,
    /// What moves its mesh in that frame.
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

    /// The name of its solver.
    pub(crate) fn name(&self) -> &'static str {
        self.tool.map_or_else(|| solver_name(self.solver), Tool::name)
    }

    /// Gives it another rig; its joints keep their angles where there are as many.
    pub(crate) fn change_rig(&mut self, rig: SharedRig) {
        let mut character = DynAim::new(rig);
        if character.state.joints.len() == self.character.state.joints.len() {
            character.state.joints.clone_from(&self.character.state.joints);
        }
        self.character = character;
    }
}
