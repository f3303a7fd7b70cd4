//! An [`Objective`], and what it says of a rig: a [`Statement`].

use aim_symbolic::print::Formula;
use aim_symbolic::{Angle, Derivation, Graph, Program, Scalar, Want};

use super::chain::{Chain, FirstLink, Inputs};
use crate::{AngleRange, JointSpec, RigSpec};

/// What a kernel computes, for any rig: some values and their derivatives by the joints' angles.
///
/// Everything that follows (programs, emitted functions in every language, counts, checks, explanations) comes of these
/// few fields.
#[derive(Debug)]
pub struct Objective {
    /// What functions that compute it are called, in `snake_case`.
    pub name: &'static str,
    /// The values and derivatives in few words, such as `residual and Jacobian`.
    pub title: &'static str,
    /// The joints that it is stated over.
    pub scope: Scope,
    /// A sentence that tells the outputs in their order, given the joints' names and the number of declared angles.
    pub outputs: fn(&str, usize) -> String,
    /// The symbols of the values.
    pub symbols: fn() -> Vec<Formula>,
    /// States the values.
    pub state: fn(&mut Graph, &Chain<'_>) -> Vec<Scalar>,
}

/// By name: no two objectives share one.
impl PartialEq for Objective {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The joints that an objective is stated over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// One joint, everything nearer the effector held still. Derivatives are taken by its pitch and its heading; that by
    /// an angle that it does not have is 0.
    Joint,
    /// All joints. Derivatives are taken by the declared angles, pitch before heading, joint by joint.
    Chain,
}

impl Objective {
    /// The joints of each kernel that a rig needs: those with equal kernels together.
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

    /// What it says of a rig: of the chain, or of the first of `joints`.
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

/// An objective as it is stated for a rig, nothing rewritten.
#[derive(Clone, Debug)]
pub struct Statement {
    /// The graph that the values are stated in.
    pub graph: Graph,
    /// The values.
    pub values: Vec<Scalar>,
    /// What derivatives are taken by, with the declared ranges; the derivative by an undeclared angle is 0.
    pub angles: Vec<(Angle, Option<AngleRange>)>,
}

impl Statement {
    /// The values, then the derivatives of each by the angles.
    #[must_use]
    pub fn wanted(&self) -> Vec<Want> {
        let angles: Vec<Angle> = self.angles.iter().map(|&(angle, _)| angle).collect();
        Want::all(&self.values, &angles)
    }

    /// The program of all outputs.
    #[must_use]
    pub fn program(&self) -> Program {
        Program::derive_wanted(&self.graph, &self.wanted())
    }

    /// The program of the output with this number alone.
    #[must_use]
    pub fn program_of(&self, output: usize) -> Program {
        Program::derive_wanted(&self.graph, &self.wanted()[output..=output])
    }

    /// The derivation of all outputs, with everything on the way.
    #[must_use]
    pub fn derivation(&self) -> Derivation {
        Derivation::new(&self.graph, &self.wanted())
    }
}
