//! Derivatives by one reverse sweep over scalars and vectors, in time linear in the size of the expression.
//!
//! Let x̄, the adjoint of x, be the derivative of the output by x (for a vector x a covector). Each node adds to the
//! adjoints of its operands:
//!
//! | node | adds |
//! |---|---|
//! | s = v · w | v̄ += s̄ w, w̄ += s̄ v |
//! | s = \|v\| | v̄ += s̄ v/\|v\| |
//! | s = atan2(u · (v × w), v · w), v and w perpendicular to u | v̄ −= s̄ (u × v)/v², w̄ += s̄ (u × w)/w² |
//! | y = k v | k̄ += ȳ · v, v̄ += k ȳ |
//! | y = R v, where R turns by θ | v̄ += Rᵀ ȳ, θ̄ += ȳ · J y with J the 90° turn in its plane or the cross product with its axis |
//! | y = R v, where R turns by a step or a motion δ | δ̄ += y × ȳ, v̄ += Rᵀ ȳ |
//! | y = v/\|v\| | v̄ += (ȳ − (ȳ · y) y)/\|v\| |
//! | y = J v | v̄ += Jᵀ ȳ = −J ȳ |
//! | y = v × w | v̄ += w × ȳ, w̄ += ȳ × v |
//! | y = x where c, else z | x̄ += ȳ where c, else 0; z̄ += 0 where c, else ȳ |
//! | y = v − (v · u) u | v̄ += ȳ − (ȳ · u) u, ū −= (v · u) ȳ + (ȳ · u) v |
//! | y = M⁻¹ v | v̄ += w, M̄ −= w yᵀ with w = M⁻ᵀ ȳ |

use rustc_hash::FxHashMap;

use crate::diff::growth::Growth;
use crate::diff::mask::{Mask, Masks};
use crate::diff::sweep::VisitedNode;
use crate::ir::node::Node;
use crate::ir::table::{NodeSet, NodeTable};
use crate::rewrite::rules::COMPOSITIONS;
use crate::{Attitude, Graph, Op, Rotation, RotationNode, Scalar, ScalarNode, Space, Variable, Vector, VectorNode};

/// Placement of the reciprocal length in the derivative of a normalised vector. The length of the chain decides which
/// costs less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReciprocalPlacement {
    /// The reciprocal remains a scale factor, which later rules may move out to each derivative.
    Late,
    /// The reciprocal is multiplied into the vector at once, before everything that follows.
    Early,
}

impl Graph {
    /// Returns the derivatives of `output` by each of `variables`.
    ///
    /// Matrices, quaternions and the axes of rotations are treated as constants. A guarded
    /// [`reciprocal`](Self::reciprocal) that is 0 by its guard has derivatives 0, and the derivative of a root is 0
    /// where the root is 0.
    pub fn gradient(&mut self, output: Scalar, variables: &[Variable], placement: ReciprocalPlacement) -> Vec<Scalar> {
        self.sweep_backward(output, variables, placement).0
    }

    /// Returns the [`gradient`](Self::gradient) and the nodes that the sweep visited.
    pub(crate) fn sweep_backward(
        &mut self,
        output: Scalar,
        variables: &[Variable],
        placement: ReciprocalPlacement,
    ) -> (Vec<Scalar>, Vec<VisitedNode>) {
        let output = self.rewrite_by(&[output], &COMPOSITIONS)[0];
        let components: Vec<_> = variables.iter().map(|&variable| self.components_of(variable)).collect();
        let mut alone: Vec<Variable> = Vec::new();
        for &(variable, _) in components.iter().flatten() {
            if !alone.contains(&variable) {
                alone.push(variable);
            }
        }
        let (gradient, visited) = self.sweep_backward_to(output, &alone, placement);
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
    ) -> (Vec<Scalar>, Vec<VisitedNode>) {
        let order = self.order(&[output]);
        let active = self.active(&order, variables);
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
        sweep.add_to_scalar(output, |_| one);
        let mut visited = Vec::new();
        for node in order.into_iter().rev() {
            let Some(derivative) = sweep.adjoint(node) else { continue };
            sweep.current = CurrentNode {
                adjoint: derivative,
                mask: sweep.masks.of_node(node),
                unmasked: sweep.unmasked.contains(node),
            };
            match (node, derivative) {
                (Node::Scalar(s), Node::Scalar(bar)) => sweep.scalar(s, bar),
                (Node::Vector(v), Node::Vector(bar)) => sweep.vector(v, bar),
                _ => unreachable!("the derivative by a number is one, that by a vector one"),
            }
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
    fn add_to_scalar(&mut self, scalar: Scalar, change: impl FnOnce(&mut Graph) -> Scalar) {
        if self.active.contains(Node::Scalar(scalar)) {
            let change = Node::Scalar(change(self.g));
            self.add(Node::Scalar(scalar), change, self.current.mask, self.is_unmasked(change));
        }
    }

    fn add_to_vector(&mut self, vector: Vector, change: impl FnOnce(&mut Graph) -> Vector) {
        if self.active.contains(Node::Vector(vector)) {
            let change = Node::Vector(change(self.g));
            self.add(Node::Vector(vector), change, self.current.mask, self.is_unmasked(change));
        }
    }

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

    fn scalar(&mut self, scalar: Scalar, bar: Scalar) {
        if let Some(sides) = self.g.plane_angle(scalar) {
            for (side, slope) in sides {
                self.add_to_vector(side, |g| g.scale(bar, slope));
            }
            return;
        }
        match self.g.scalar_node(scalar) {
            ScalarNode::Op(Op::Input(_)) => match self.g.slope_of_input(scalar) {
                Some((angle, slope)) => {
                    let along = self.g.times(bar, slope);
                    self.add_to_variable(angle.into(), along);
                }
                None => self.add_to_variable(scalar.into(), bar),
            },
            ScalarNode::Step(_) => self.add_to_variable(scalar.into(), bar),
            ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) => self.select(bar, [a, b], [then, otherwise]),
            ScalarNode::Dot(v, w) if v == w => self.add_to_vector(v, |g| {
                let twice = g.twice(bar);
                g.scale(twice, v)
            }),
            ScalarNode::Dot(v, w) => {
                self.add_to_vector(v, |g| g.scale(bar, w));
                self.add_to_vector(w, |g| g.scale(bar, v));
            }
            ScalarNode::Norm(v) => self.add_to_vector(v, |g| {
                let direction = g.normalize(v);
                g.scale(bar, direction.into())
            }),
            ScalarNode::Component(v, axis) => self.add_to_vector(v, |g| {
                let zero = g.constant(0.0);
                g.components(core::array::from_fn(|k| if k == usize::from(axis) { bar } else { zero }))
            }),
            _ => {
                let active = &self.active;
                for (part, partial) in self.g.partials(scalar, |part| active.contains(Node::Scalar(part))) {
                    self.add_to_scalar(part, |g| g.times(bar, partial));
                }
            }
        }
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

    fn vector(&mut self, vector: Vector, bar: Vector) {
        match self.g.vector_node(vector) {
            VectorNode::Components(c) => {
                for (c, axis) in c.into_iter().zip(0..) {
                    self.add_to_scalar(c, |g| g.component(bar, axis));
                }
            }
            VectorNode::Add(v, w) => {
                self.add_to_vector(v, |_| bar);
                self.add_to_vector(w, |_| bar);
            }
            VectorNode::Sub(v, w) => {
                self.add_to_vector(v, |_| bar);
                self.add_to_vector(w, |g| g.neg_vector(bar));
            }
            VectorNode::Neg(v) => self.add_to_vector(v, |g| g.neg_vector(bar)),
            VectorNode::Scale(k, v) => {
                self.add_to_scalar(k, |g| g.dot(bar, v));
                self.add_to_vector(v, |g| g.scale(k, bar));
            }
            VectorNode::Rotate(rotation, v) => {
                self.turn(rotation, vector, bar);
                self.add_to_vector(v, |g| {
                    let inverse = g.transpose(rotation);
                    g.rotate(inverse, bar)
                });
            }
            VectorNode::Normalize(v) => {
                // d(v/|v|) is the part of dv perpendicular to v, over |v|.
                let placement = self.placement;
                self.add_to_vector(v, |g| {
                    let across = g.across(bar, crate::Unit(vector));
                    let norm = g.norm(v);
                    let reciprocal = g.reciprocal(norm);
                    match placement {
                        ReciprocalPlacement::Late => g.scale(reciprocal, across),
                        ReciprocalPlacement::Early => {
                            let components = [0, 1, 2].map(|axis| {
                                let component = g.component(across, axis);
                                g.mul(reciprocal, component)
                            });
                            g.components(components)
                        }
                    }
                });
            }
            VectorNode::Motion(space, Attitude::Quaternion(u, w)) => {
                // The motion of a quaternion is 2 q̇ q*/|q|² in the world and 2 q* q̇/|q|² in the body.
                let twice = self.g.twice_over_square(u, w);
                let moment = self.g.scale(twice, bar);
                self.add_to_vector(u, |g| {
                    let (kept, aside) = (g.scale(w, moment), g.cross(moment, u));
                    if space == Space::World { g.add_vectors(kept, aside) } else { g.sub_vectors(kept, aside) }
                });
                self.add_to_scalar(w, |g| {
                    let along = g.dot(moment, u);
                    g.neg(along)
                });
            }
            VectorNode::Motion(space, Attitude::Turn(v)) => {
                self.add_to_vector(v, |g| g.turned_rate(v, bar, space == Space::World));
            }
            // The transpose of a 90° turn is the 90° turn back.
            VectorNode::Perp(plane, v) => self.add_to_vector(v, |g| {
                let perp = g.perp(plane, bar);
                g.neg_vector(perp)
            }),
            VectorNode::Cross(v, w) => {
                self.add_to_vector(v, |g| g.cross(w, bar));
                self.add_to_vector(w, |g| g.cross(bar, v));
            }
            VectorNode::Across(v, u) => {
                self.add_to_vector(v, |g| g.across(bar, u));
                self.add_to_vector(u.into(), |g| {
                    let (along, bar_along) = (g.dot(v, u), g.dot(bar, u));
                    let (first, second) = (g.scale(along, bar), g.scale(bar_along, v));
                    let sum = g.add_vectors(first, second);
                    g.neg_vector(sum)
                });
            }
            VectorNode::Solve(m, v) => {
                let back = self.g.solve(m.transpose(), bar);
                self.add_to_vector(v, |_| back);
                let [moved, by] = if m.transposed { [vector, back] } else { [back, vector] };
                for (column, k) in m.columns.into_iter().zip(0..) {
                    self.add_to_vector(column, |g| {
                        let component = g.component(by, k);
                        let along = g.scale(component, moved);
                        g.neg_vector(along)
                    });
                }
            }
        }
    }

    /// Adds the derivative by the angle of `rotation`: the dot product of the adjoint with the perpendicular of
    /// `rotated`, which is already available. For a step or a motion, adds the moment to its adjoint.
    fn turn(&mut self, rotation: Rotation, rotated: Vector, bar: Vector) {
        if let Some((step, back)) = self.g.moved_by(rotation) {
            self.add_to_vector(step, |g| g.moment(step, back, rotated, bar));
            return;
        }
        let Some((angle, perp)) = self.g.swing(rotation, rotated) else { return };
        let along = self.g.dot(bar, perp);
        match self.g.radians(angle) {
            Some(radians) => self.add_to_scalar(radians, |_| along),
            None => self.add_to_variable(angle.into(), along),
        }
    }
}

impl Graph {
    /// Returns the angle of `rotation`, and the derivative of the result `rotated` by that angle.
    pub(crate) fn swing(&mut self, rotation: Rotation, rotated: Vector) -> Option<(crate::Angle, Vector)> {
        let (turn, back) = self.untransposed(rotation);
        let (angle, perp) = match turn {
            RotationNode::Turn(plane, angle) => (angle, self.perp(plane, rotated)),
            RotationNode::About(axis, angle) => (angle, self.cross(axis, rotated)),
            _ => return None,
        };
        Some((self.unshifted(angle), if back { self.neg_vector(perp) } else { perp }))
    }

    /// Returns the sum of two scalars or of two vectors.
    fn add_nodes(&mut self, one: Node, other: Node) -> Node {
        match (one, other) {
            (Node::Scalar(a), Node::Scalar(b)) => Node::Scalar(self.add(a, b)),
            (Node::Vector(v), Node::Vector(w)) => Node::Vector(self.add_vectors(v, w)),
            _ => unreachable!("derivatives by a number are numbers, those by a vector vectors"),
        }
    }
}
