//! Derivatives by a forward sweep, which computes the tangent of each node: its derivative by one variable.
//!
//! With ẋ the tangent of x:
//!
//! - (v · w)˙ = v̇ · w + v · ẇ
//! - |v|˙ = v̇ · v/|v|
//! - (R v)˙ = R v̇ + θ̇ J R v, where R turns by θ and J is the 90° turn in its plane or the cross product with its axis
//! - (R v)˙ = R v̇ + δ̇ × R v, where R turns by a step δ
//! - (v/|v|)˙ = across(v̇)/|v|, the part of v̇ perpendicular to v over |v|
//! - (v − (v · u) u)˙ = across(v̇) − (v · u̇) u − (v · u) u̇

use crate::diff::sweep::VisitedNode;
use crate::ir::node::Node;
use crate::ir::table::{NodeSet, Table};
use crate::rewrite::rules::COMPOSITIONS;
use crate::{Attitude, Graph, Op, Rotation, Scalar, ScalarNode, Space, Variable, Vector, VectorNode};

impl Graph {
    /// Returns the derivatives of each of `outputs` by `variable`, with the same conventions as
    /// [`gradient`](Self::gradient).
    pub fn tangents(&mut self, outputs: &[Scalar], variable: Variable) -> Vec<Scalar> {
        self.sweep_forward(outputs, variable).0
    }

    /// Returns the [`tangents`](Self::tangents) and the nodes that the sweep visited.
    pub(crate) fn sweep_forward(&mut self, outputs: &[Scalar], variable: Variable) -> (Vec<Scalar>, Vec<VisitedNode>) {
        let outputs = self.rewrite_by(outputs, &COMPOSITIONS);
        let order = self.order(&outputs);
        let seeds = self.components_of(variable);
        let variables: Vec<Variable> = seeds.iter().map(|(variable, _)| *variable).collect();
        let active = self.active(&order, &variables);
        let mut sweep = Sweep { g: self, seeds, active, scalars: Table::default(), vectors: Table::default() };
        let mut visited = Vec::new();
        for node in order {
            if sweep.active.contains(node) {
                let derivative = match node {
                    Node::Scalar(s) => {
                        let tangent = sweep.scalar(s);
                        sweep.scalars.insert(s, tangent);
                        Some(Node::Scalar(tangent))
                    }
                    Node::Vector(v) => sweep.vector(v).map(|tangent| {
                        sweep.vectors.insert(v, tangent);
                        Node::Vector(tangent)
                    }),
                };
                visited.extend(derivative.map(|derivative| VisitedNode {
                    node,
                    derivative,
                    contributions: Vec::new(),
                }));
            }
        }
        let found = sweep.scalars;
        let tangents = outputs.iter().map(|s| found.copied(*s).unwrap_or_else(|| self.constant(0.0))).collect();
        (tangents, visited)
    }
}

struct Sweep<'g> {
    g: &'g mut Graph,
    /// The tangents of the variables; `None` stands for 1.
    seeds: Vec<(Variable, Option<Scalar>)>,
    active: NodeSet,
    /// d scalar / d variable, for the scalars that depend on it.
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, Vector>,
}

impl Sweep<'_> {
    /// Returns the tangent of a variable, or `None` if it has none. An inner `None` stands for 1.
    fn seed(&self, variable: Variable) -> Option<Option<Scalar>> {
        self.seeds.iter().find(|(known, _)| *known == variable).map(|(_, seed)| *seed)
    }

    fn scalar_tangent(&mut self, scalar: Scalar) -> Scalar {
        self.scalars.copied(scalar).unwrap_or_else(|| self.g.constant(0.0))
    }

    fn vector_tangent(&self, vector: Vector) -> Option<Vector> {
        self.vectors.copied(vector)
    }

    fn sum(&mut self, terms: impl IntoIterator<Item = Option<Vector>>) -> Option<Vector> {
        terms.into_iter().flatten().reduce(|a, b| self.g.add_vectors(a, b))
    }

    fn dot(&mut self, v: Option<Vector>, w: Vector) -> Option<Scalar> {
        v.map(|v| self.g.dot(v, w))
    }

    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if let Some(sides) = self.g.plane_angle(scalar) {
            let terms = sides.map(|(side, slope)| self.dot(self.vector_tangent(side), slope));
            return terms.into_iter().flatten().reduce(|a, b| self.g.add(a, b)).unwrap_or_else(|| self.g.constant(0.0));
        }
        let terms: Vec<Scalar> = match self.g.scalar_node(scalar) {
            ScalarNode::Op(Op::Input(_)) => {
                let slope = self.g.slope_of_input(scalar);
                let variable = slope.as_ref().map_or(Variable::Input(scalar), |(angle, _)| Variable::Angle(*angle));
                let seed = self.seed(variable).flatten().unwrap_or_else(|| self.g.constant(1.0));
                vec![slope.map_or(seed, |(_, slope)| self.g.times(seed, slope))]
            }
            ScalarNode::Step(_) => {
                let seed = self.seed(Variable::Input(scalar)).flatten();
                vec![seed.unwrap_or_else(|| self.g.constant(1.0))]
            }
            ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) => {
                let (then, otherwise) = (self.scalar_tangent(then), self.scalar_tangent(otherwise));
                vec![self.g.select_less(a, b, then, otherwise)]
            }
            ScalarNode::Dot(v, w) if v == w => {
                let half = self.vector_tangent(v).map(|change| self.g.dot(change, v));
                half.map(|half| self.g.twice(half)).into_iter().collect()
            }
            ScalarNode::Dot(v, w) => {
                let (of_v, of_w) = (self.vector_tangent(v), self.vector_tangent(w));
                [self.dot(of_v, w), self.dot(of_w, v)].into_iter().flatten().collect()
            }
            ScalarNode::Norm(v) => {
                let (of_v, direction) = (self.vector_tangent(v), self.g.normalize(v));
                self.dot(of_v, direction.into()).into_iter().collect()
            }
            ScalarNode::Component(v, axis) => {
                self.vector_tangent(v).map(|change| self.g.component(change, axis)).into_iter().collect()
            }
            _ => {
                let scalars = &self.scalars;
                let partials = self.g.partials(scalar, |part| scalars.contains(part));
                partials
                    .into_iter()
                    .map(|(part, partial)| {
                        let change = self.scalar_tangent(part);
                        self.g.times(change, partial)
                    })
                    .collect()
            }
        };
        terms.into_iter().reduce(|a, b| self.g.add(a, b)).unwrap_or_else(|| self.g.constant(0.0))
    }

    /// Returns the contribution of a rotation about a step δ to the tangent of y: J δ̇ × y, or for the inverse
    /// −J δ̇ × y, with J = 1 ± ½ [δ]× to first order.
    fn step(&mut self, rotation: Rotation, rotated: Vector) -> Option<Vector> {
        let (step, back) = self.g.moved_by(rotation)?;
        let change = self.vector_tangent(step)?;
        if self.g.is_motion(step) {
            return Some(if back { self.g.cross(rotated, change) } else { self.g.cross(change, rotated) });
        }
        let curl = self.g.half_cross(step, change);
        if back {
            let rate = self.g.sub_vectors(change, curl);
            return Some(self.g.cross(rotated, rate));
        }
        let rate = self.g.add_vectors(change, curl);
        Some(self.g.cross(rate, rotated))
    }

    fn vector(&mut self, vector: Vector) -> Option<Vector> {
        match self.g.vector_node(vector) {
            VectorNode::Components(c) => {
                let c = c.map(|c| self.scalar_tangent(c));
                Some(self.g.components(c))
            }
            VectorNode::Add(v, w) => {
                let terms = [self.vector_tangent(v), self.vector_tangent(w)];
                self.sum(terms)
            }
            VectorNode::Sub(v, w) => match (self.vector_tangent(v), self.vector_tangent(w)) {
                (Some(v), Some(w)) => Some(self.g.sub_vectors(v, w)),
                (v, w) => v.or_else(|| w.map(|w| self.g.neg_vector(w))),
            },
            VectorNode::Neg(v) => self.vector_tangent(v).map(|v| self.g.neg_vector(v)),
            VectorNode::Scale(k, v) => {
                let of_k = self.scalars.copied(k);
                let of_k = of_k.map(|change| self.g.scale(change, v));
                let of_v = self.vector_tangent(v).map(|change| self.g.scale(k, change));
                self.sum([of_k, of_v])
            }
            VectorNode::Rotate(rotation, v) => {
                let of_v = self.vector_tangent(v).map(|change| self.g.rotate(rotation, change));
                let of_step = self.step(rotation, vector);
                let of_angle = self.g.swing(rotation, vector).and_then(|(angle, perp)| match self.g.radians(angle) {
                    Some(radians) => self.scalars.copied(radians).map(|change| self.g.scale(change, perp)),
                    None => self.seed(Variable::Angle(angle)).map(|seed| match seed {
                        Some(seed) => self.g.scale(seed, perp),
                        None => perp,
                    }),
                });
                self.sum([of_angle, of_step, of_v])
            }
            VectorNode::Normalize(v) => self.vector_tangent(v).map(|change| {
                let across = self.g.across(change, crate::Unit(vector));
                let norm = self.g.norm(v);
                let reciprocal = self.g.reciprocal(norm);
                self.g.scale(reciprocal, across)
            }),
            VectorNode::Perp(plane, v) => self.vector_tangent(v).map(|change| self.g.perp(plane, change)),
            VectorNode::Cross(v, w) => {
                let of_v = self.vector_tangent(v).map(|change| self.g.cross(change, w));
                let of_w = self.vector_tangent(w).map(|change| self.g.cross(v, change));
                self.sum([of_v, of_w])
            }
            VectorNode::Motion(space, Attitude::Quaternion(u, w)) => {
                // 2 (w u̇ − ẇ u ± u × u̇)/|q|²
                let of_u = self.vector_tangent(u).map(|change| {
                    let (kept, aside) = (self.g.scale(w, change), self.g.cross(u, change));
                    let is_world = space == Space::World;
                    if is_world { self.g.add_vectors(kept, aside) } else { self.g.sub_vectors(kept, aside) }
                });
                let of_w = self.scalars.copied(w).map(|change| {
                    let along = self.g.scale(change, u);
                    self.g.neg_vector(along)
                });
                let twice = self.g.twice_over_square(u, w);
                self.sum([of_u, of_w]).map(|change| self.g.scale(twice, change))
            }
            VectorNode::Motion(space, Attitude::Turn(v)) => {
                self.vector_tangent(v).map(|change| self.g.turned_rate(v, change, space == Space::Body))
            }
            VectorNode::Solve(m, v) => {
                // M⁻¹ (v̇ − Ṁ y)
                let of_v = self.vector_tangent(v);
                let changes = m.columns.map(|column| self.vector_tangent(column));
                let of_m = if m.transposed {
                    let zero = self.g.constant(0.0);
                    changes.iter().any(Option::is_some).then(|| {
                        let along = changes.map(|change| change.map_or(zero, |change| self.g.dot(change, vector)));
                        self.g.components(along)
                    })
                } else {
                    let along = [0, 1, 2].map(|k| {
                        let component = self.g.component(vector, k);
                        changes[usize::from(k)].map(|change| self.g.scale(component, change))
                    });
                    self.sum(along)
                };
                let of_m = of_m.map(|change| self.g.neg_vector(change));
                self.sum([of_v, of_m]).map(|change| self.g.solve(m, change))
            }
            VectorNode::Across(v, u) => {
                let of_v = self.vector_tangent(v).map(|change| self.g.across(change, u));
                let of_u = self.vector_tangent(u.into()).map(|change| {
                    let (along, moved) = (self.g.dot(v, u), self.g.dot(v, change));
                    let (first, second) = (self.g.scale(moved, u.into()), self.g.scale(along, change));
                    let sum = self.g.add_vectors(first, second);
                    self.g.neg_vector(sum)
                });
                self.sum([of_v, of_u])
            }
        }
    }
}
