//! The objectives' [`Kernel`]s of a rig, and the functions that compute them.

use aim_symbolic::Program;

use super::aim::{AIM_GRADIENT, CHAIN_VALUE_GRADIENT};
use super::chain::FirstLink;
use super::residual::CHAIN_RESIDUAL_JACOBIAN;
use super::statement::{Objective, Scope, Statement};
use crate::RigSpec;
use crate::names::snake_case;

/// Every objective that is derived for rigs.
pub const OBJECTIVES: [&Objective; 3] = [&AIM_GRADIENT, &CHAIN_VALUE_GRADIENT, &CHAIN_RESIDUAL_JACOBIAN];

/// What is derived of an objective for some joints of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    /// What it computes.
    pub objective: &'static Objective,
    /// The joints that it serves: those with equal kernels, or all of the chain.
    pub joints: Vec<usize>,
    /// How it computes it. Inputs and outputs are in the order of [`Inputs`](super::Inputs) and
    /// [`Statement::wanted`].
    pub program: Program,
}

/// The kernels of all [`OBJECTIVES`] for a rig.
///
/// ```
/// # #[cfg(feature = "toml")] {
/// let rig = "name = 'Lamp'\naxes = { up = '+Y', forward = '+Z' }\n[[joint]]\nname = 'base'\nheading = 'free'\nrate = '90deg'\n";
/// let spec = aim_codegen::declare::from_toml("lamp.toml", rig)?;
/// let kernels = aim_codegen::kernels(&spec);
/// let c = aim_codegen::emit::c::emit(&aim_codegen::emit::Rig { spec: &spec, kernels: &kernels });
/// assert!(c.contains("aim_gradient"));
/// # }
/// # Ok::<(), aim_codegen::declare::Diagnostics>(())
/// ```
#[must_use]
pub fn kernels(spec: &RigSpec) -> Vec<Kernel> {
    OBJECTIVES.into_iter().flat_map(|objective| objective.kernels(spec, FirstLink::Given)).collect()
}

impl Objective {
    /// Derives its distinct kernels for a rig, in the order of the first joints that they serve.
    #[must_use]
    pub fn kernels(&'static self, spec: &RigSpec, first_link: FirstLink) -> Vec<Kernel> {
        let kernel = |joints: Vec<usize>| {
            let program = self.statement(spec, &joints, first_link).program();
            Kernel { objective: self, joints, program }
        };
        self.groups(spec).into_iter().map(kernel).collect()
    }
}

impl Kernel {
    /// What it was derived from, where every link is given.
    #[must_use]
    pub fn statement(&self, spec: &RigSpec) -> Statement {
        self.objective.statement(spec, &self.joints, FirstLink::Given)
    }
}

/// A function of emitted code: a kernel, for the chain or for one of the joints that it serves.
#[derive(Clone, Copy, Debug)]
pub struct Function<'a> {
    /// What it computes.
    pub kernel: &'a Kernel,
    /// The joint, where the objective is that of one.
    pub joint: Option<usize>,
}

/// The functions that compute `kernels`: one a joint for those of joints, joint by joint, and one for each of the chain's.
#[must_use]
pub fn functions(kernels: &[Kernel]) -> Vec<Function<'_>> {
    let mut functions = Vec::new();
    for same in kernels.chunk_by(|a, b| a.objective == b.objective) {
        let mut each: Vec<Function<'_>> = Vec::new();
        for kernel in same {
            match kernel.objective.scope {
                Scope::Joint => each.extend(kernel.joints.iter().map(|&j| Function { kernel, joint: Some(j) })),
                Scope::Chain => each.push(Function { kernel, joint: None }),
            }
        }
        each.sort_by_key(|function| function.joint);
        functions.extend(each);
    }
    functions
}

impl Function<'_> {
    /// The joint's name, or `chain`.
    #[must_use]
    pub fn subject<'s>(&self, spec: &'s RigSpec) -> &'s str {
        self.joint.map_or("chain", |joint| &spec.joints[joint].name)
    }

    /// The name in languages where all functions are global: `RIG_JOINT_aim_gradient`, `RIG_chain_value_gradient`.
    pub fn name(&self, spec: &RigSpec) -> String {
        let joint = self.joint.map_or_else(String::new, |joint| format!("{}_", snake_case(&spec.joints[joint].name)));
        format!("{}_{joint}{}", snake_case(&spec.name), self.kernel.objective.name)
    }

    /// The sentence that tells its outputs.
    #[must_use]
    pub fn outputs(&self, spec: &RigSpec) -> String {
        (self.kernel.objective.outputs)(self.subject(spec), spec.angles())
    }
}
