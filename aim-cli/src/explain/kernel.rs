//! One kernel of a rig with its derivation and what its parts are called.

use aim_codegen::objective::{ChainInputs, JointInputs, notation};
use aim_codegen::{Objective, RigSpec, derivation};
use aim_symbolic::print::{self, Formula, Notation};
use aim_symbolic::{Angle, Course, Derivation, Graph, Node, Variable};

use super::document::{Equation, Inline, code};
use super::values;

pub(super) struct Kernel<'a> {
    pub(super) spec: &'a RigSpec,
    pub(super) objective: Objective,
    /// The joints that it serves.
    pub(super) joints: Vec<usize>,
    pub(super) derivation: Derivation,
    pub(super) notation: Notation,
    /// What its outputs are called.
    pub(super) outputs: Vec<Formula>,
    /// The notation with names for what derivatives are taken through.
    pub(super) named: Notation,
    /// What those names stand for, each after those that it is made of.
    pub(super) parts: Vec<Equation>,
}

impl<'a> Kernel<'a> {
    pub(super) fn new(spec: &'a RigSpec, objective: Objective, joints: Vec<usize>) -> Self {
        let derivation = derivation(spec, objective);
        let notation = notation(spec, objective);
        // Inputs are declared in the same order everywhere, so angles are the same, too.
        let mut g = Graph::new();
        let angles = match objective {
            Objective::Joint(_) => {
                let inputs = JointInputs::declare(&mut g);
                vec![inputs.pitch, inputs.heading]
            }
            Objective::ChainAim | Objective::ChainResidual => {
                ChainInputs::declare(&mut g, spec.joints.len()).declared_angles(spec)
            }
        };
        let values = values(objective);
        let derivatives = values.iter().flat_map(|value| {
            let by = |&angle: &Angle| Formula::derivative(value.clone(), notation.angle(&g, angle));
            angles.iter().map(by).collect::<Vec<_>>()
        });
        let outputs = values.iter().cloned().chain(derivatives).collect();
        let (named, parts) = parts(&derivation, &notation, &values);
        Self { spec, objective, joints, derivation, notation, outputs, named, parts }
    }

    /// Its joints' names.
    pub(super) fn names(&self) -> Inline {
        code(self.joints.iter().map(|&joint| self.spec.joints[joint].name.as_str()).collect::<Vec<_>>().join(", "))
    }

    /// Its values' names.
    pub(super) fn values(&self) -> &[Formula] {
        &self.outputs[..self.derivation.stated.len()]
    }

    /// What a variable is called.
    pub(super) fn variable(&self, variable: Variable) -> Formula {
        let g = &self.derivation.graph;
        match variable {
            Variable::Angle(angle) => self.notation.angle(g, angle),
            Variable::Input(input) => print::scalar(g, input, &self.notation),
        }
    }

    /// Whether its formulas are short enough to be written out at every step.
    pub(super) fn is_small(&self) -> bool {
        matches!(self.objective, Objective::Joint(_))
    }
}

/// Names for what was swept over, and the equations that say what they stand for.
fn parts(derivation: &Derivation, notation: &Notation, values: &[Formula]) -> (Notation, Vec<Equation>) {
    let mut nodes: Vec<Node> = Vec::new();
    for swept in &derivation.sweeps {
        let mut passed: Vec<Node> = swept.passages.iter().map(|passage| passage.node).collect();
        if matches!(swept.course, Course::Back(_)) {
            passed.reverse();
        }
        passed.retain(|node| !nodes.contains(node));
        nodes.extend(passed);
    }
    let (mut named, mut equations) = (notation.clone(), Vec::new());
    let (mut vectors, mut scalars) = (0, 0);
    for node in nodes {
        let value = derivation.values.iter().position(|&value| node == Node::Scalar(value));
        let symbol = match (value, node) {
            (Some(place), _) => values[place].clone(),
            (None, Node::Scalar(_)) => {
                scalars += 1;
                Formula::italic("z").numbered(scalars)
            }
            (None, Node::Vector(_)) => {
                vectors += 1;
                Formula::vector("w").numbered(vectors)
            }
        };
        if value.is_none() {
            named.parts.push((node, symbol.clone()));
        }
        equations.push((symbol, print::definition(&derivation.graph, node, &named)).into());
    }
    (named, equations)
}
