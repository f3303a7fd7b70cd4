//! [`Tuning`]: the settings of the aiming and the number of characters.

use aim_codegen::{RigSpec, Role};
use aim_runtime::{Ascent, Settings, Solver};

use crate::character::Character;
use crate::tools::Tool;

/// The solvers that are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lineup {
    /// A single solver.
    One(Solver),
    /// All three solvers, side by side.
    All,
}

impl Lineup {
    pub(crate) const EACH: [Self; 4] =
        [Self::One(Solver::Natural), Self::One(Solver::Exact), Self::One(Solver::Ascent), Self::All];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::One(solver) => solver_name(solver),
            Self::All => "side by side",
        }
    }

    pub(crate) fn solvers(self) -> Vec<Solver> {
        match self {
            Self::One(solver) => vec![solver],
            Self::All => vec![Solver::Natural, Solver::Exact, Solver::Ascent],
        }
    }
}

pub(crate) fn solver_name(solver: Solver) -> &'static str {
    match solver {
        Solver::Natural => "natural",
        Solver::Exact => "exact",
        _ => "ascent",
    }
}

/// Settings of the aiming.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tuning {
    /// The rig, with the present ranges, rates and stiffness.
    pub(crate) spec: RigSpec,
    /// The runtime's settings. The solver comes from the lineup.
    pub(crate) settings: Settings,
    pub(crate) lineup: Lineup,
    /// `true` to aim the other eye at the target as well; otherwise it repeats the turn of the first.
    pub(crate) both_eyes: bool,
    /// Tool that is used instead of the rig's solver.
    pub(crate) tool: Option<Tool>,
    /// `true` to use the ascent as published, without later additions.
    pub(crate) as_published: bool,
    /// Number of characters. If there is more than one, all use the lineup's first solver.
    pub(crate) crowd: usize,
}

impl Tuning {
    pub(crate) fn new(character: &Character) -> Self {
        let spec = character.spec().clone();
        let has_roles = spec.joints.iter().any(|joint| joint.role != Role::None);
        Self {
            lineup: Lineup::One(if has_roles { Solver::Natural } else { Solver::Exact }),
            settings: Settings::default(),
            both_eyes: character.chain.other_eye.is_some(),
            tool: None,
            as_published: false,
            crowd: 1,
            spec,
        }
    }

    /// Returns the settings of a figure with this solver.
    pub(crate) fn settings(&self, solver: Solver) -> Settings {
        // A tool starts from the animation, so the rig must not add to it.
        let weight = if self.tool.is_some() { 0.0 } else { self.settings.weight };
        let ascent = if self.as_published { Ascent::paper() } else { Ascent::default() };
        self.settings.with_weight(weight).with_solver(solver).with_ascent(ascent)
    }
}
