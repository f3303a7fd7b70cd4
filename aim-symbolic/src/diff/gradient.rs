//! Derivatives by one reverse sweep over scalars and vectors: linear in the size of the expression, but for what stands
//! below selects.
//!
//! With x̄ the derivative of the output by x (of a vector a covector), each node adds to those of its parts:
//!
//! | node | adds |
//! |---|---|
//! | s = v · w | v̄ += s̄ w, w̄ += s̄ v |
//! | s = \|v\| | v̄ += s̄ v/\|v\| |
//! | y = k v | k̄ += ȳ · v, v̄ += k ȳ |
//! | y = R v, where R turns by θ | v̄ += Rᵀ ȳ, θ̄ += ȳ · J y with J the quarter turn in its plane or the cross product with its axis |
//! | y = v/\|v\| | v̄ += (ȳ − (ȳ · y) y)/\|v\| |
//! | y = J v | v̄ += Jᵀ ȳ = −J ȳ |
//! | y = v × w | v̄ += w × ȳ, w̄ += ȳ × v |
//! | y = v − (v · u) u | v̄ += ȳ − (ȳ · u) u, ū −= (v · u) ȳ + (ȳ · u) v |

use crate::diff::partial::Partials;
use crate::diff::sweep::Passage;
use crate::ir::node::Node;
use crate::ir::order::Selects;
use crate::ir::table::{NodeSet, Table};
use crate::rewrite::rules::COMPOSITIONS;
use crate::{Graph, Op, Rotation, RotationNode, Scalar, ScalarNode, Variable, Vector, VectorNode};

/// Where the reciprocal of a normalised vector's derivative goes: a choice that the length of the chain decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// It stays a scale factor, which may float out to each derivative.
    Late,
    /// It is multiplied into the vector at once, for all that comes after.
    Early,
}

impl Graph {
    /// The derivatives of `output` by each of `variables`.
    ///
    /// Matrices, quaternions and the axes of rotations count as constants. A guarded [`reciprocal`](Self::reciprocal) is 0
    /// with all its derivatives where it is guarded, and a root has derivative 0 where it is 0.
    pub fn gradient(&mut self, output: Scalar, variables: &[Variable], placement: Placement) -> Vec<Scalar> {
        self.swept_back(output, variables, placement).0
    }

    /// The same, with what the sweep passed on its way.
    pub(crate) fn swept_back(
        &mut self,
        output: Scalar,
        variables: &[Variable],
        placement: Placement,
    ) -> (Vec<Scalar>, Vec<Passage>) {
        let output = self.rewrite_by(&[output], &COMPOSITIONS)[0];
        let order = self.order(&[output], Selects::Through);
        let components: Vec<_> = variables.iter().map(|&variable| self.components_of(variable)).collect();
        let mut alone: Vec<Variable> = Vec::new();
        for &(variable, _) in components.iter().flatten() {
            if !alone.contains(&variable) {
                alone.push(variable);
            }
        }
        let active = self.active(&order, &alone);
        let mut below_selects = Table::default();
        let (gradient, passages) = Sweep::derivatives(self, output, &alone, &active, placement, &mut below_selects);
        let by = |variable| gradient[alone.iter().position(|&known| known == variable).expect("it was collected")];
        let sum = |terms: Vec<(Variable, Option<Scalar>)>| {
            let terms = terms.into_iter().map(|(variable, k)| (by(variable), k));
            let products: Vec<Scalar> = terms.map(|(slope, k)| k.map_or(slope, |k| self.mul(slope, k))).collect();
            products.into_iter().reduce(|a, b| self.add(a, b)).unwrap_or_else(|| self.constant(0.0))
        };
        (components.into_iter().map(sum).collect(), passages)
    }
}

/// The derivatives of what stands below a select, by each variable.
type BelowSelects = Table<Scalar, Vec<Scalar>>;

struct Sweep<'g> {
    g: &'g mut Graph,
    placement: Placement,
    active: &'g NodeSet,
    variables: &'g [Variable],
    below_selects: &'g mut BelowSelects,
    /// d output / d scalar
    scalars: Table<Scalar, Scalar>,
    /// d output / d vector, a covector
    vectors: Table<Vector, Vector>,
    /// d output / d variable
    found: Vec<Option<Scalar>>,
    /// What the node under way adds to that.
    gives: Vec<(Variable, Scalar)>,
}

impl Sweep<'_> {
    fn derivatives(
        g: &mut Graph,
        output: Scalar,
        variables: &[Variable],
        active: &NodeSet,
        placement: Placement,
        below_selects: &mut BelowSelects,
    ) -> (Vec<Scalar>, Vec<Passage>) {
        let order = g.order(&[output], Selects::Leaves);
        let one = g.constant(1.0);
        let mut sweep = Sweep {
            g,
            placement,
            active,
            variables,
            below_selects,
            scalars: Table::default(),
            vectors: Table::default(),
            found: vec![None; variables.len()],
            gives: Vec::new(),
        };
        let mut passages = Vec::new();
        sweep.add_to_scalar(output, |_| one);
        for node in order.into_iter().rev() {
            match node {
                Node::Scalar(s) => sweep.scalar(s),
                Node::Vector(v) => sweep.vector(v),
            }
            if let Some(derivative) = sweep.derivative(node) {
                passages.push(Passage { node, derivative, gives: core::mem::take(&mut sweep.gives) });
            }
        }
        let found = sweep.found;
        (found.into_iter().map(|found| found.unwrap_or_else(|| g.constant(0.0))).collect(), passages)
    }

    /// d output / d node, where the output depends on it.
    fn derivative(&self, node: Node) -> Option<Node> {
        match node {
            Node::Scalar(s) => self.scalars.copied(s).map(Node::Scalar),
            Node::Vector(v) => self.vectors.copied(v).map(Node::Vector),
        }
    }

    fn add_to_scalar(&mut self, scalar: Scalar, change: impl FnOnce(&mut Graph) -> Scalar) {
        if self.active.contains(Node::Scalar(scalar)) {
            let change = change(self.g);
            let total = match self.scalars.get(scalar) {
                Some(&so_far) => self.g.add(so_far, change),
                None => change,
            };
            self.scalars.insert(scalar, total);
        }
    }

    fn add_to_vector(&mut self, vector: Vector, change: impl FnOnce(&mut Graph) -> Vector) {
        if self.active.contains(Node::Vector(vector)) {
            let change = change(self.g);
            let total = match self.vectors.get(vector) {
                Some(&so_far) => self.g.add_vectors(so_far, change),
                None => change,
            };
            self.vectors.insert(vector, total);
        }
    }

    fn add_to_variable(&mut self, variable: Variable, change: Scalar) {
        self.gives.push((variable, change));
        let wanted = self.variables.iter().position(|&v| v == variable);
        if let Some(found) = wanted.map(|place| &mut self.found[place]) {
            *found = Some(match *found {
                Some(so_far) => self.g.add(so_far, change),
                None => change,
            });
        }
    }

    fn scalar(&mut self, scalar: Scalar) {
        let Some(&bar) = self.scalars.get(scalar) else { return };
        match self.g.scalar_node(scalar) {
            ScalarNode::Op(Op::Input(_)) => match self.g.slope_of_input(scalar) {
                Some((angle, slope)) => {
                    let along = self.g.times(bar, slope);
                    self.add_to_variable(angle.into(), along);
                }
                None => self.add_to_variable(scalar.into(), bar),
            },
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
                let active = self.active;
                for (part, partial) in self.g.partials(scalar, |part| active.contains(Node::Scalar(part))) {
                    self.add_to_scalar(part, |g| g.times(bar, partial));
                }
            }
        }
    }

    /// Each branch has a sweep of its own, so that what is not a number in the branch not taken stays there.
    fn select(&mut self, bar: Scalar, [a, b]: [Scalar; 2], branches: [Scalar; 2]) {
        let [then, otherwise] = branches.map(|branch| {
            if let Some(known) = self.below_selects.get(branch) {
                return known.clone();
            }
            let (variables, active, placement) = (self.variables, self.active, self.placement);
            let found = Sweep::derivatives(self.g, branch, variables, active, placement, self.below_selects).0;
            self.below_selects.insert(branch, found.clone());
            found
        });
        let variables = self.variables;
        for ((&variable, then), otherwise) in variables.iter().zip(then).zip(otherwise) {
            let is_zero = |s| self.g.constant_of(s) == Some(0.0);
            if !(is_zero(then) && is_zero(otherwise)) {
                let slope = self.g.select_less(a, b, then, otherwise);
                let along = self.g.times(bar, Partials::Factor(slope));
                self.add_to_variable(variable, along);
            }
        }
    }

    fn vector(&mut self, vector: Vector) {
        let Some(&bar) = self.vectors.get(vector) else { return };
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
                // d(v/|v|) is the part of dv across v, over |v|.
                let placement = self.placement;
                self.add_to_vector(v, |g| {
                    let across = g.across(bar, crate::Unit(vector));
                    let norm = g.norm(v);
                    let reciprocal = g.reciprocal(norm);
                    match placement {
                        Placement::Late => g.scale(reciprocal, across),
                        Placement::Early => {
                            let components = [0, 1, 2].map(|axis| {
                                let component = g.component(across, axis);
                                g.mul(reciprocal, component)
                            });
                            g.components(components)
                        }
                    }
                });
            }
            // The transpose of a quarter turn is the quarter turn back.
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
        }
    }

    /// What `rotation` adds to the derivative by its angle: it moves `rotated` along the result's own perpendicular, which
    /// is already at hand.
    fn turn(&mut self, rotation: Rotation, rotated: Vector, bar: Vector) {
        let Some((angle, perp)) = self.g.swing(rotation, rotated) else { return };
        let along = self.g.dot(bar, perp);
        match self.g.radians(angle) {
            Some(radians) => self.add_to_scalar(radians, |_| along),
            None => self.add_to_variable(angle.into(), along),
        }
    }
}

impl Graph {
    /// The angle that `rotation` turns by, and what it adds to its result `rotated` per radian.
    pub(crate) fn swing(&mut self, rotation: Rotation, rotated: Vector) -> Option<(crate::Angle, Vector)> {
        let (turn, back) = match self.rotation_node(rotation) {
            RotationNode::Transpose(inner) => (self.rotation_node(inner), true),
            node => (node, false),
        };
        let (angle, perp) = match turn {
            RotationNode::Turn(plane, angle) => (angle, self.perp(plane, rotated)),
            RotationNode::About(axis, angle) => (angle, self.cross(axis, rotated)),
            _ => return None,
        };
        Some((angle, if back { self.neg_vector(perp) } else { perp }))
    }
}
