//! The [`Kernel`]s derived from the objectives for a rig, and the functions that compute them.

use aim_symbolic::Program;

use super::aim::{AIM_GRADIENT, CHAIN_VALUE_GRADIENT};
use super::chain::FirstLink;
use super::residual::CHAIN_RESIDUAL_JACOBIAN;
use super::statement::{Objective, Scope, Statement};
use crate::RigSpec;
use crate::names::snake_case;

/// All objectives that are derived for rigs.
pub const OBJECTIVES: [&Objective; 3] = [&AIM_GRADIENT, &CHAIN_VALUE_GRADIENT, &CHAIN_RESIDUAL_JACOBIAN];

/// An objective's program for one or more joints of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    /// Objective that the program computes.
    pub objective: &'static Objective,
    /// Joints that the kernel serves: all with the same program, or the whole chain.
    pub joints: Vec<usize>,
    /// The derived program. Inputs are in the order of [`Inputs`](super::Inputs), outputs in that of
    /// [`Statement::wanted`].
    pub program: Program,
}

/// Derives the kernels of all [`OBJECTIVES`] for a rig.
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
    /// Derives the objective's distinct kernels for a rig, ordered by the first joint that each serves.
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
    /// Returns the statement that the kernel was derived from, with [`FirstLink::Given`].
    #[must_use]
    pub fn statement(&self, spec: &RigSpec) -> Statement {
        self.objective.statement(spec, &self.joints, FirstLink::Given)
    }
}

/// A function of emitted code: a kernel applied to the chain or to one of the joints that it serves.
#[derive(Clone, Copy, Debug)]
pub struct Function<'a> {
    /// Kernel that the function computes.
    pub kernel: &'a Kernel,
    /// Index of the joint; `None` for an objective of the chain.
    pub joint: Option<usize>,
}

/// Returns the functions that compute `kernels`: for joint objectives one for each joint, in joint order; for chain
/// objectives one for each kernel.
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
    /// Returns the joint's name, or `chain`.
    #[must_use]
    pub fn subject<'s>(&self, spec: &'s RigSpec) -> &'s str {
        self.joint.map_or("chain", |joint| &spec.joints[joint].name)
    }

    /// Returns the name in languages where all functions are global: `RIG_JOINT_aim_gradient`,
    /// `RIG_chain_value_gradient`.
    pub fn name(&self, spec: &RigSpec) -> String {
        let joint = self.joint.map_or_else(String::new, |joint| format!("{}_", snake_case(&spec.joints[joint].name)));
        format!("{}_{joint}{}", snake_case(&spec.name), self.kernel.objective.name)
    }

    /// Returns a sentence that describes the outputs.
    #[must_use]
    pub fn outputs(&self, spec: &RigSpec) -> String {
        (self.kernel.objective.outputs)(self.subject(spec), spec.angles())
    }
}
