//! What is derived: the objectives, each stated once, and the programs that come of them.

mod aim;
mod notation;
mod residual;
mod statement;
mod trajectory;

pub use aim::{chain_aim, joint_aim};
pub use notation::{basis_symbols, notation};
pub use residual::chain_residual;
pub use statement::{ChainInputs, HEADING, JointInputs, PITCH};
pub use trajectory::TrajectoryPrograms;

use aim_symbolic::{Derivation, Graph, Program, Scalar, Want};

use crate::{JointSpec, RigSpec};

/// All programs of a rig.
#[derive(Clone, Debug)]
pub struct RigPrograms {
    /// Aim, ∂aim/∂pitch, ∂aim/∂heading of each joint, from the effector inward.
    pub joints: Vec<Program>,
    /// The chain's aim, then its derivatives by the declared angles, pitch before heading, joint by joint.
    pub chain_value_gradient: Program,
    /// The chain's residual (left, up), then the derivatives of the first and those of the second.
    pub chain_residual_jacobian: Program,
}

impl RigPrograms {
    /// Derives them.
    pub fn derive(spec: &RigSpec) -> Self {
        let mut joints: Vec<Program> = Vec::new();
        for (i, joint) in spec.joints.iter().enumerate() {
            let same = spec.joints[..i].iter().position(|earlier| is_same_problem(earlier, joint));
            joints.push(match same {
                Some(same) => joints[same].clone(),
                None => joint_program(spec, i, JointOutput::ALL),
            });
        }
        let [chain_value_gradient, chain_residual_jacobian] =
            [chain_gradient(spec), chain_jacobian(spec)].map(|mut problem| problem.program());
        Self { joints, chain_value_gradient, chain_residual_jacobian }
    }
}

/// Whether two joints of a rig have the same kernel.
fn is_same_problem(a: &JointSpec, b: &JointSpec) -> bool {
    let angles = |joint: &JointSpec| (joint.pitch.is_some(), joint.heading.is_some());
    a.frame == b.frame && angles(a) == angles(b)
}

/// What a kernel computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// The aim and its derivatives by this joint's pitch and heading.
    Joint(usize),
    /// The chain's aim and its derivatives by all declared angles.
    ChainAim,
    /// The chain's residual and its derivatives by all declared angles.
    ChainResidual,
}

/// What is derived for a rig: each distinct kernel of the joints once, with the joints that it serves, then the chain's.
pub fn objectives(spec: &RigSpec) -> Vec<(Objective, Vec<usize>)> {
    let mut objectives: Vec<(Objective, Vec<usize>)> = Vec::new();
    for (i, joint) in spec.joints.iter().enumerate() {
        match objectives.iter_mut().find(|(_, served)| is_same_problem(&spec.joints[served[0]], joint)) {
            Some((_, served)) => served.push(i),
            None => objectives.push((Objective::Joint(i), vec![i])),
        }
    }
    let all: Vec<usize> = (0..spec.joints.len()).collect();
    objectives.extend([(Objective::ChainAim, all.clone()), (Objective::ChainResidual, all)]);
    objectives
}

/// A kernel's derivation, with everything on the way.
pub fn derivation(spec: &RigSpec, objective: Objective) -> Derivation {
    let Problem { g, wanted } = match objective {
        Objective::Joint(joint) => joint_problem(spec, joint, JointOutput::ALL),
        Objective::ChainAim => chain_gradient(spec),
        Objective::ChainResidual => chain_jacobian(spec),
    };
    Derivation::new(&g, &wanted)
}

/// A statement, and what is wanted of it.
struct Problem {
    g: Graph,
    wanted: Vec<Want>,
}

impl Problem {
    fn program(&mut self) -> Program {
        Program::derive_wanted(&self.g, &self.wanted)
    }
}

/// An output of a joint's function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointOutput {
    /// The aim.
    Aim,
    /// ∂aim/∂pitch
    ByPitch,
    /// ∂aim/∂heading
    ByHeading,
}

impl JointOutput {
    /// What the emitted function returns.
    pub const ALL: &'static [Self] = &[Self::Aim, Self::ByPitch, Self::ByHeading];
}

/// The program of some outputs of one joint's aim, everything nearer the effector held still.
pub fn joint_program(spec: &RigSpec, joint: usize, outputs: &[JointOutput]) -> Program {
    joint_problem(spec, joint, outputs).program()
}

fn joint_problem(spec: &RigSpec, joint: usize, outputs: &[JointOutput]) -> Problem {
    let mut g = Graph::new();
    let inputs = JointInputs::declare(&mut g);
    let aim = joint_aim(&mut g, spec, joint, &inputs);
    let want = |output: &JointOutput| match output {
        JointOutput::Aim => Want::Value(aim),
        JointOutput::ByPitch => Want::Derivative(aim, inputs.pitch.into()),
        JointOutput::ByHeading => Want::Derivative(aim, inputs.heading.into()),
    };
    let wanted = outputs.iter().map(want).collect();
    Problem { g, wanted }
}

fn chain_gradient(spec: &RigSpec) -> Problem {
    chain_problem(spec, |g, inputs| vec![chain_aim(g, spec, inputs)])
}

fn chain_jacobian(spec: &RigSpec) -> Problem {
    chain_problem(spec, |g, inputs| chain_residual(g, spec, inputs).to_vec())
}

fn chain_problem(spec: &RigSpec, objective: impl FnOnce(&mut Graph, &ChainInputs) -> Vec<Scalar>) -> Problem {
    let mut g = Graph::new();
    let inputs = ChainInputs::declare(&mut g, spec.joints.len());
    let values = objective(&mut g, &inputs);
    let wanted = Want::all(&values, &inputs.declared_angles(spec));
    Problem { g, wanted }
}
