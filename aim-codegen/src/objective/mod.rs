//! What is derived: the objectives, each stated once, and the programs that come of them.

mod aim;
mod residual;
mod statement;

pub use aim::{chain_aim, joint_aim};
pub use residual::chain_residual;
pub use statement::{ChainInputs, JointInputs};

use aim_symbolic::{Graph, Program, Want};

use crate::RigSpec;

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
        Self {
            joints: (0..spec.joints.len()).map(|joint| joint_program(spec, joint, JointOutput::ALL)).collect(),
            chain_value_gradient: chain_program(spec, |g, inputs| vec![chain_aim(g, spec, inputs)]),
            chain_residual_jacobian: chain_program(spec, |g, inputs| chain_residual(g, spec, inputs).to_vec()),
        }
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
    let mut g = Graph::new();
    let inputs = JointInputs::declare(&mut g);
    let aim = joint_aim(&mut g, spec, joint, &inputs);
    let wanted: Vec<Want> = outputs
        .iter()
        .map(|output| match output {
            JointOutput::Aim => Want::Value(aim),
            JointOutput::ByPitch => Want::Derivative(aim, inputs.pitch.into()),
            JointOutput::ByHeading => Want::Derivative(aim, inputs.heading.into()),
        })
        .collect();
    Program::derive_wanted(&mut g, &wanted)
}

fn chain_program(
    spec: &RigSpec,
    objective: impl FnOnce(&mut Graph, &ChainInputs) -> Vec<aim_symbolic::Scalar>,
) -> Program {
    let mut g = Graph::new();
    let inputs = ChainInputs::declare(&mut g, spec.joints.len());
    let values = objective(&mut g, &inputs);
    Program::derive(&mut g, &values, &inputs.declared_angles(spec))
}
