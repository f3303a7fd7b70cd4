//! Derivatives by a forward sweep, which computes the tangent of each node: its derivative by one variable.

use crate::diff::differential::{Differential, Part, ReciprocalPlacement};
use crate::diff::local::LocalSlopes;
use crate::diff::sweep::VisitedNode;
use crate::ir::node::Node;
use crate::ir::table::{NodeSet, NodeTable};
use crate::rewrite::rules::COMPOSITIONS;
use crate::{Graph, Op, Scalar, ScalarNode, Variable, VectorNode};

impl Graph {
    /// Returns the derivatives of each of `outputs` by `variable`, with the same conventions as
    /// [`gradient`](Self::gradient).
    pub fn tangents(&mut self, outputs: &[Scalar], variable: Variable) -> Vec<Scalar> {
        self.sweep_forward(outputs, variable, false).0
    }

    /// Returns the [`tangents`](Self::tangents) and the nodes that the sweep visited.
    pub(crate) fn sweep_forward(
        &mut self,
        outputs: &[Scalar],
        variable: Variable,
        local: bool,
    ) -> (Vec<Scalar>, Vec<VisitedNode>) {
        let outputs = self.rewrite_by(outputs, &COMPOSITIONS);
        let order = self.order(&outputs);
        let seeds = self.components_of(variable);
        let variables: Vec<Variable> = seeds.iter().map(|(variable, _)| *variable).collect();
        let active = self.active(&order, &variables);
        let slopes = if local { LocalSlopes::of(self, &order, &active) } else { LocalSlopes::default() };
        let mut sweep = Sweep { g: self, seeds, slopes, active, tangents: NodeTable::default() };
        let mut visited = Vec::new();
        for node in order {
            if sweep.active.contains(node)
                && let Some(derivative) = sweep.tangent(node)
            {
                sweep.tangents.insert(node, derivative);
                visited.push(VisitedNode { node, derivative, contributions: Vec::new() });
            }
        }
        let tangents = outputs.iter().map(|&output| sweep.of_scalar(output)).collect();
        (tangents, visited)
    }
}

struct Sweep<'g> {
    g: &'g mut Graph,
    /// The tangents of the variables; `None` stands for 1.
    seeds: Vec<(Variable, Option<Scalar>)>,
    slopes: LocalSlopes,
    active: NodeSet,
    /// d node / d variable, for the nodes that depend on it.
    tangents: NodeTable<Node>,
}

impl Sweep<'_> {
    /// Returns the tangent of a part that depends on the variable.
    fn of_part(&mut self, part: Part) -> Option<Node> {
        match part {
            Part::Node(node) => self.tangents.copied(node),
            Part::Variable(variable) => {
                let (_, seed) = *self.seeds.iter().find(|(known, _)| *known == variable)?;
                Some(seed.unwrap_or_else(|| self.g.constant(1.0)).into())
            }
        }
    }

    fn of_scalar(&mut self, scalar: Scalar) -> Scalar {
        match self.tangents.copied(scalar.into()) {
            Some(Node::Scalar(tangent)) => tangent,
            _ => self.g.constant(0.0),
        }
    }

    /// Returns the tangent of a node from those of its parts.
    fn tangent(&mut self, node: Node) -> Option<Node> {
        match node {
            Node::Scalar(s) => {
                if let ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) = self.g.scalar_node(s) {
                    let (then, otherwise) = (self.of_scalar(then), self.of_scalar(otherwise));
                    return Some(self.g.select_less(a, b, then, otherwise).into());
                }
            }
            Node::Vector(v) => {
                if let VectorNode::Components(c) = self.g.vector_node(v) {
                    let c = c.map(|c| self.of_scalar(c));
                    return Some(self.g.components(c).into());
                }
            }
        }
        let Differential { terms, after } =
            self.slopes.differential(self.g, node, &self.active, ReciprocalPlacement::Late);
        let mut sum: Option<Node> = None;
        for term in terms {
            let Some(change) = self.of_part(term.part) else { continue };
            let change = term.maps.into_iter().fold(change, |change, map| self.g.apply(map, change));
            sum = Some(sum.map_or(change, |sum| self.g.add_nodes(sum, change)));
        }
        sum.map(|sum| after.map_or(sum, |map| self.g.apply(map, sum)))
    }
}
