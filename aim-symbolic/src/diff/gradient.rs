//! Derivatives by one reverse sweep over scalars and vectors, in time linear in the size of the expression.
//!
//! Let x̄, the adjoint of x, be the derivative of the output by x (for a vector x a covector). Each node y adds the
//! transpose of its [differential](crate::diff::differential) to the adjoints of its parts: where ẏ = A ẋ, x̄ += Aᵀ ȳ.
//! A select y = x where c, else z, adds ȳ to x̄ where c, and to z̄ elsewhere.

use rustc_hash::FxHashMap;

use crate::diff::differential::{Differential, Linear, Part, ReciprocalPlacement};
use crate::diff::growth::Growth;
use crate::diff::local::LocalSlopes;
use crate::diff::mask::{Mask, Masks};
use crate::diff::sweep::VisitedNode;
use crate::ir::node::Node;
use crate::ir::table::{NodeSet, NodeTable};
use crate::rewrite::rules::COMPOSITIONS;
use crate::{Graph, Op, Scalar, ScalarNode, Variable};

impl Graph {
    /// Returns the derivatives of `output` by each of `variables`.
    ///
    /// Matrices, quaternions and the axes of rotations are treated as constants. A guarded
    /// [`reciprocal`](Self::reciprocal) that is 0 by its guard has derivatives 0, and the derivative of a root is 0
    /// where the root is 0.
    pub fn gradient(&mut self, output: Scalar, variables: &[Variable], placement: ReciprocalPlacement) -> Vec<Scalar> {
        self.sweep_backward(output, variables, placement, false).0
    }

    /// Returns the [`gradient`](Self::gradient) and the nodes that the sweep visited.
    pub(crate) fn sweep_backward(
        &mut self,
        output: Scalar,
        variables: &[Variable],
        placement: ReciprocalPlacement,
        local: bool,
    ) -> (Vec<Scalar>, Vec<VisitedNode>) {
        let output = self.rewrite_by(&[output], &COMPOSITIONS)[0];
        let components: Vec<_> = variables.iter().map(|&variable| self.components_of(variable)).collect();
        let mut alone: Vec<Variable> = Vec::new();
        for &(variable, _) in components.iter().flatten() {
            if !alone.contains(&variable) {
                alone.push(variable);
            }
        }
        let (gradient, visited) = self.sweep_backward_to(output, &alone, placement, local);
        let by = |variable| gradient[alone.iter().position(|&known| known == variable).expect("it was collected")];
        let sum = |terms: Vec<(Variable, Option<Scalar>)>| {
            let terms = terms.into_iter().map(|(variable, k)| (by(variable), k));
            let products: Vec<Scalar> = terms.map(|(slope, k)| k.map_or(slope, |k| self.mul(slope, k))).collect();
            products.into_iter().reduce(|a, b| self.add(a, b)).unwrap_or_else(|| self.constant(0.0))
        };
        (components.into_iter().map(sum).collect(), visited)
    }

    /// Sweeps back to variables that are not directions.
    fn sweep_backward_to(
        &mut self,
        output: Scalar,
        variables: &[Variable],
        placement: ReciprocalPlacement,
        local: bool,
    ) -> (Vec<Scalar>, Vec<VisitedNode>) {
        let order = self.order(&[output]);
        let active = self.active(&order, variables);
        let slopes = if local { LocalSlopes::of(self, &order, &active) } else { LocalSlopes::default() };
        // Builds with `aim_small`, as for the web, derive only rigs, which have no selects.
        let (masks, growth) = if cfg!(not(aim_small)) && self.selects(&order) {
            (Masks::of(self, output, &order, &active), Growth::of(self, &order))
        } else {
            (Masks::default(), Growth::default())
        };
        let one = self.constant(1.0);
        let mut sweep = Sweep {
            g: self,
            placement,
            slopes,
            active,
            variables,
            growth,
            masks,
            unmasked: NodeSet::default(),
            current: CurrentNode { adjoint: Node::Scalar(one), mask: Mask::ALWAYS, unmasked: false },
            adjoints: NodeTable::default(),
            deferred: FxHashMap::default(),
            derivatives: vec![None; variables.len()],
            contributions: Vec::new(),
        };
        if sweep.active.contains(output.into()) {
            sweep.adjoints.insert(output.into(), one.into());
        }
        let mut visited = Vec::new();
        for node in order.into_iter().rev() {
            let Some(derivative) = sweep.adjoint(node) else { continue };
            sweep.current = CurrentNode {
                adjoint: derivative,
                mask: sweep.masks.of_node(node),
                unmasked: sweep.unmasked.contains(node),
            };
            sweep.visit(node, derivative);
            visited.push(VisitedNode { node, derivative, contributions: core::mem::take(&mut sweep.contributions) });
        }
        let found = sweep.derivatives;
        (found.into_iter().map(|found| found.unwrap_or_else(|| self.constant(0.0))).collect(), visited)
    }
}

/// The node that the sweep is visiting.
#[derive(Clone, Copy)]
struct CurrentNode {
    /// d output / d node.
    adjoint: Node,
    /// The condition under which the adjoint is needed.
    mask: Mask,
    /// `true` if the adjoint may differ from 0 where the mask does not hold.
    unmasked: bool,
}

struct Sweep<'g> {
    g: &'g mut Graph,
    placement: ReciprocalPlacement,
    slopes: LocalSlopes,
    active: NodeSet,
    variables: &'g [Variable],
    growth: Growth,
    masks: Masks,
    /// The nodes whose adjoint may have any value where their mask does not hold. All other adjoints are 0 there.
    unmasked: NodeSet,
    current: CurrentNode,
    /// d output / d node, for a vector a covector.
    adjoints: NodeTable<Node>,
    /// Contributions from unmasked adjoints that are not yet added to their node, by mask.
    deferred: FxHashMap<Node, Vec<(Mask, Node)>>,
    /// d output / d variable.
    derivatives: Vec<Option<Scalar>>,
    /// The contributions of the current node to `found`.
    contributions: Vec<(Variable, Scalar)>,
}

impl Sweep<'_> {
    /// Adds a contribution that is needed where the mask holds and is 0 elsewhere. If it is `unmasked`, so that it may
    /// differ from 0 elsewhere, and the node has another mask, it is deferred and later masked together with all
    /// contributions of the same mask.
    fn add(&mut self, node: Node, change: Node, mask: Mask, unmasked: bool) {
        if unmasked && self.masks.of_node(node) != mask {
            let waiting = self.deferred.entry(node).or_default();
            match waiting.iter_mut().find(|(known, _)| *known == mask) {
                Some((_, so_far)) => *so_far = self.g.add_nodes(*so_far, change),
                None => waiting.push((mask, change)),
            }
            return;
        }
        if unmasked {
            self.unmasked.insert(node, ());
        }
        let total = match self.adjoints.copied(node) {
            Some(so_far) => self.g.add_nodes(so_far, change),
            None => change,
        };
        self.adjoints.insert(node, total);
    }

    /// Returns d output / d node, or `None` if the output does not depend on the node. All users of the node must have
    /// been visited.
    fn adjoint(&mut self, node: Node) -> Option<Node> {
        for (mask, change) in self.deferred.remove(&node).unwrap_or_default() {
            let change = match change {
                Node::Scalar(change) => Node::Scalar(self.masks.masked(self.g, mask, change)),
                Node::Vector(change) => {
                    let components = [0, 1, 2].map(|axis| {
                        let component = self.g.component(change, axis);
                        self.masks.masked(self.g, mask, component)
                    });
                    Node::Vector(self.g.components(components))
                }
            };
            self.add(node, change, mask, false);
        }
        self.adjoints.copied(node)
    }

    fn add_to_variable(&mut self, variable: Variable, change: Scalar) {
        let is_unmasked = self.is_unmasked(Node::Scalar(change));
        let change = if is_unmasked { self.masks.masked(self.g, self.current.mask, change) } else { change };
        self.contributions.push((variable, change));
        let wanted = self.variables.iter().position(|&v| v == variable);
        if let Some(found) = wanted.map(|place| &mut self.derivatives[place]) {
            *found = Some(match *found {
                Some(so_far) => self.g.add(so_far, change),
                None => change,
            });
        }
    }

    /// Returns `true` if `change`, computed from the current adjoint, may differ from 0 where the current mask does not
    /// hold.
    fn is_unmasked(&self, change: Node) -> bool {
        let CurrentNode { adjoint, mask, unmasked } = self.current;
        mask != Mask::ALWAYS && (unmasked || !self.growth.keeps_zero(self.g, change, adjoint))
    }

    /// Adds the contributions of a node with this adjoint to the adjoints of its parts.
    fn visit(&mut self, node: Node, bar: Node) {
        if let (Node::Scalar(s), Node::Scalar(bar)) = (node, bar)
            && let ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) = self.g.scalar_node(s)
        {
            return self.select(bar, [a, b], [then, otherwise]);
        }
        let Differential { terms, after } = self.slopes.differential(self.g, node, &self.active, self.placement);
        let bar = after.map_or(bar, |map| self.transposed(map, bar));
        for term in terms {
            let change = term.maps.into_iter().rev().fold(bar, |bar, map| self.transposed(map, bar));
            match (term.part, change) {
                (Part::Node(part), _) => self.add(part, change, self.current.mask, self.is_unmasked(change)),
                (Part::Variable(variable), Node::Scalar(change)) => self.add_to_variable(variable, change),
                (Part::Variable(_), Node::Vector(_)) => unreachable!("variables are numbers"),
            }
        }
    }

    fn transposed(&mut self, map: Linear, bar: Node) -> Node {
        let transposed = self.g.transposed(map);
        self.g.apply(transposed, bar)
    }

    fn select(&mut self, bar: Scalar, [a, b]: [Scalar; 2], branches: [Scalar; 2]) {
        for (branch, holds) in branches.into_iter().zip([true, false]) {
            if self.active.contains(Node::Scalar(branch)) {
                let mask = self.masks.branch(a, b, holds, self.current.mask);
                let change = self.g.where_less(a, b, holds, bar);
                self.add(Node::Scalar(branch), Node::Scalar(change), mask, self.current.unmasked);
            }
        }
    }
}
