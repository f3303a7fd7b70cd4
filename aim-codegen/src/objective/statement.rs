//! [`Objective`], and its [`Statement`] for a rig.

use aim_symbolic::print::Formula;
use aim_symbolic::{Angle, Derivation, Graph, Program, Scalar, Want};

use super::chain::{Chain, FirstLink, Inputs};
use crate::{AngleRange, JointSpec, RigSpec};

/// An objective: the values that a kernel computes for any rig, with their derivatives with respect to the joints'
/// angles.
///
/// Everything else (programs, emitted functions in every language, counts, checks, explanations) is derived from these
/// fields.
#[derive(Debug)]
pub struct Objective {
    /// Name of the functions that compute it, in `snake_case`.
    pub name: &'static str,
    /// Short title of the values and derivatives, such as `residual and Jacobian`.
    pub title: &'static str,
    /// Joints that the objective is stated over.
    pub scope: Scope,
    /// Returns a sentence that lists the outputs in order, given the joints' names and the number of declared angles.
    pub outputs: fn(&str, usize) -> String,
    /// Returns the symbols of the values.
    pub symbols: fn() -> Vec<Formula>,
    /// States the values in a graph.
    pub state: fn(&mut Graph, &Chain<'_>) -> Vec<Scalar>,
}

/// Compares by name: names are unique.
impl PartialEq for Objective {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Joints that an objective is stated over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// One joint; those nearer the effector are held still. Derivatives are with respect to its pitch and its heading;
    /// the derivative with respect to an angle that the joint does not have is 0.
    Joint,
    /// All joints. Derivatives are with respect to the declared angles, pitch before heading, joint by joint.
    Chain,
}

impl Objective {
    /// Groups a rig's joints by equal kernels: one group for each kernel.
    #[must_use]
    pub fn groups(&self, spec: &RigSpec) -> Vec<Vec<usize>> {
        if self.scope == Scope::Chain {
            return vec![(0..spec.joints.len()).collect()];
        }
        let is_same = |a: &JointSpec, b: &JointSpec| {
            let angles = |joint: &JointSpec| (joint.pitch.is_some(), joint.heading.is_some());
            a.frame == b.frame && angles(a) == angles(b)
        };
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for (i, joint) in spec.joints.iter().enumerate() {
            match groups.iter_mut().find(|group| is_same(&spec.joints[group[0]], joint)) {
                Some(group) => group.push(i),
                None => groups.push(vec![i]),
            }
        }
        groups
    }

    /// States the objective for a rig: for the chain, or for the first of `joints`.
    #[must_use]
    pub fn statement(&self, spec: &RigSpec, joints: &[usize], first_link: FirstLink) -> Statement {
        let mut graph = Graph::new();
        let (joints, inputs) = match self.scope {
            Scope::Joint => (&spec.joints[joints[0]..=joints[0]], Inputs::of_joint(&mut graph)),
            Scope::Chain => (&spec.joints[..], Inputs::of_chain(&mut graph, spec.joints.len())),
        };
        let angles = joints
            .iter()
            .zip(&inputs.angles)
            .flat_map(|(joint, &(pitch, heading))| [(pitch, joint.pitch), (heading, joint.heading)]);
        let angles = angles.filter(|(_, range)| self.scope == Scope::Joint || range.is_some()).collect();
        let chain = Chain { effector: &spec.effector, joints, first_link, inputs };
        let values = (self.state)(&mut graph, &chain);
        Statement { graph, values, angles }
    }
}

/// An objective stated for a rig, before any rewriting.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Graph that holds the values.
    pub graph: Graph,
    /// The stated values.
    pub values: Vec<Scalar>,
    /// Angles of differentiation, each with its declared range. The derivative with respect to an undeclared angle is
    /// 0.
    pub angles: Vec<(Angle, Option<AngleRange>)>,
}

impl Statement {
    /// Returns all outputs: the values, then the derivatives of each with respect to the angles.
    #[must_use]
    pub fn wanted(&self) -> Vec<Want> {
        let angles: Vec<Angle> = self.angles.iter().map(|&(angle, _)| angle).collect();
        Want::all(&self.values, &angles)
    }

    /// Derives the program of all outputs.
    #[must_use]
    pub fn program(&self) -> Program {
        Program::derive_wanted(&self.graph, &self.wanted())
    }

    /// Derives the program of a single output, given its index.
    #[must_use]
    pub fn program_of(&self, output: usize) -> Program {
        Program::derive_wanted(&self.graph, &self.wanted()[output..=output])
    }

    /// Derives all outputs and records every intermediate step.
    #[must_use]
    pub fn derivation(&self) -> Derivation {
        Derivation::new(&self.graph, &self.wanted())
    }
}
