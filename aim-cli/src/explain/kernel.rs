//! [`Kernel`]: one kernel of a rig with its derivation and the symbols of its parts.

use aim_codegen::RigSpec;
use aim_codegen::objective::{self, Scope, notation};
use aim_symbolic::print::{self, Formula, Notation};
use aim_symbolic::{Derivation, Node, SweepDirection, Variable};

use super::document::{Equation, Inline, code};

pub(super) struct Kernel<'a> {
    pub(super) spec: &'a RigSpec,
    /// The kernel as it is emitted.
    pub(super) emitted: &'a objective::Kernel,
    pub(super) derivation: Derivation,
    pub(super) notation: Notation,
    /// Symbols of the outputs: the values, then the derivatives of each.
    pub(super) outputs: Vec<Formula>,
    /// The notation, with symbols for all parts that derivatives are taken through.
    pub(super) named: Notation,
    /// Definitions of the symbols in `named`, each after those that it depends on.
    pub(super) parts: Vec<Equation>,
}

impl<'a> Kernel<'a> {
    pub(super) fn new(spec: &'a RigSpec, emitted: &'a objective::Kernel) -> Self {
        let notation = notation(spec, emitted.objective.scope);
        let statement = emitted.statement(spec);
        let derivation = statement.derivation();
        let values = (emitted.objective.symbols)();
        let derivatives = values.iter().flat_map(|value| {
            let by = |&(angle, _): &_| Formula::derivative(value.clone(), notation.angle(&statement.graph, angle));
            statement.angles.iter().map(by).collect::<Vec<_>>()
        });
        let outputs = values.iter().cloned().chain(derivatives).collect();
        let (named, parts) = parts(&derivation, &notation, &values);
        Self { spec, emitted, derivation, notation, outputs, named, parts }
    }

    /// Returns the names of its joints.
    pub(super) fn names(&self) -> Inline {
        code(joint_names(self.spec, &self.emitted.joints))
    }

    /// Returns the symbols of its values.
    pub(super) fn values(&self) -> &[Formula] {
        &self.outputs[..self.derivation.stated.len()]
    }

    /// Returns the symbol of a variable.
    pub(super) fn variable(&self, variable: Variable) -> Formula {
        let g = &self.derivation.graph;
        match variable {
            Variable::Angle(angle) => self.notation.angle(g, angle),
            Variable::Input(input) => print::scalar(g, input, &self.notation),
            Variable::Along(_) => unreachable!("kernels are differentiated by angles"),
        }
    }

    /// Returns `true` for the kernel of a single joint, whose formulas are short enough to be written out at every
    /// step.
    pub(super) fn is_small(&self) -> bool {
        self.emitted.objective.scope == Scope::Joint
    }
}

/// Returns the names of these joints, separated by commas.
pub(super) fn joint_names(spec: &RigSpec, joints: &[usize]) -> String {
    joints.iter().map(|&joint| spec.joints[joint].name.as_str()).collect::<Vec<_>>().join(", ")
}

/// Returns the notation with symbols for all parts that the sweeps visit, and the definitions of these symbols.
fn parts(derivation: &Derivation, notation: &Notation, values: &[Formula]) -> (Notation, Vec<Equation>) {
    let mut nodes: Vec<Node> = Vec::new();
    for swept in &derivation.sweeps {
        let mut passed: Vec<Node> = swept.visited.iter().map(|passage| passage.node).collect();
        if matches!(swept.direction, SweepDirection::Backward(_)) {
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
