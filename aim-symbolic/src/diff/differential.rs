//! Differentials of nodes: the change of each node as a sum of linear maps of the changes of its parts. The forward
//! sweep applies the maps, the backward sweep their transposes.
//!
//! With ẋ the change of x:
//!
//! | node | change |
//! |---|---|
//! | v · w | v̇ · w + ẇ · v |
//! | \|v\| | v̇ · v/\|v\| |
//! | atan2(u · (v × w), v · w), v and w perpendicular to u | ẇ · (u × w)/w² − v̇ · (u × v)/v² |
//! | k v | k̇ v + k v̇ |
//! | y = R v, where R turns by θ | R v̇ + θ̇ J y with J the 90° turn in its plane or the cross product with its axis |
//! | y = R v, where R turns by a step or a motion δ | R v̇ + δ̇ × y |
//! | y = v/\|v\| | (v̇ − (v̇ · y) y)/\|v\| |
//! | v × w | v̇ × w + v × ẇ |
//! | v − (v · u) u | v̇ − (v̇ · u) u − (v · u) u̇ − (v · u̇) u |
//! | y = M⁻¹ v | M⁻¹ (v̇ − Ṁ y) |
//! | the parts of the quaternion (u, w) of a rotation with the motion m | u̇ = ½ (w ṁ + ṁ × u), ẇ = −½ ṁ · u |
//! | the motion of a quaternion (u, w) | 2 (w u̇ ± u × u̇ − ẇ u)/\|q\|², plus in the world |

use crate::diff::partial::Partials;
use crate::ir::node::Node;
use crate::ir::table::NodeSet;
use crate::{
    Angle, Attitude, Graph, Matrix, Op, Plane, Rotation, RotationNode, Scalar, ScalarNode, Space, Unit, Variable,
    Vector, VectorNode,
};

/// Placement of the reciprocal length in the derivative of a normalised vector. The length of the chain decides which
/// costs less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReciprocalPlacement {
    /// The reciprocal remains a scale factor, which later rules may move out to each derivative.
    Late,
    /// The reciprocal is multiplied into the vector at once, before everything that follows.
    Early,
}

/// The differential of a node: `after` of the sum of all terms.
pub(crate) struct Differential {
    pub(crate) terms: Vec<Term>,
    pub(crate) after: Option<Linear>,
}

/// The contribution of the change of one part.
pub(crate) struct Term {
    pub(crate) part: Part,
    /// The maps in the order of their application.
    pub(crate) maps: Vec<Linear>,
}

/// An operand, or a variable without a node of its own.
#[derive(Clone, Copy)]
pub(crate) enum Part {
    Node(Node),
    Variable(Variable),
}

/// A linear map of a number or vector x.
#[derive(Clone, Copy)]
pub(crate) enum Linear {
    /// A number times a partial derivative.
    Factor(Partials),
    /// x · v
    Dot(Vector),
    /// x v, for a number x.
    Along(Vector),
    /// A component of x.
    Component(u8),
    /// The vector with the number x on this axis.
    Axis(u8),
    /// −x, for a vector.
    Neg,
    /// k x, for a vector x.
    Scale(Scalar),
    /// R x
    Rotate(Rotation),
    /// x projected onto a plane and turned by 90°, or by −90° if `back`.
    Perp { plane: Plane, back: bool },
    /// x × v, or v × x if `swapped`.
    Cross { v: Vector, swapped: bool },
    /// x + ½ v × x, or x − ½ v × x if `back`.
    Curl { v: Vector, back: bool },
    /// [`Graph::turned_rate`]
    TurnedRate { v: Vector, curled_back: bool },
    /// The part of x perpendicular to a direction.
    Across(Unit),
    /// The part of x perpendicular to a direction, times a reciprocal.
    AcrossOver { unit: Unit, reciprocal: Scalar, placement: ReciprocalPlacement },
    /// −(k x + (x · v) w), with k, v and w called `along`, `from` and `to`.
    Tilted { along: Scalar, from: Vector, to: Vector },
    /// M⁻¹ x
    Solve(Matrix),
}

impl Graph {
    /// Returns the differential of a node by its `active` parts. Does not handle selects.
    pub(crate) fn differential(
        &mut self,
        node: Node,
        active: &NodeSet,
        placement: ReciprocalPlacement,
    ) -> Differential {
        let mut after = None;
        let mut terms = match node {
            Node::Scalar(s) => self.terms_of_scalar(s, active),
            Node::Vector(v) => self.terms_of_vector(v, placement, &mut after),
        };
        terms.retain(|term| !matches!(term.part, Part::Node(node) if !active.contains(node)));
        Differential { terms, after }
    }

    fn terms_of_scalar(&mut self, scalar: Scalar, active: &NodeSet) -> Vec<Term> {
        use Linear::{Component, Dot, Factor};
        if let Some(sides) = self.plane_angle(scalar) {
            return sides.map(|(side, slope)| term(side, [Dot(slope)])).into();
        }
        match self.scalar_node(scalar) {
            ScalarNode::Op(Op::Input(_)) | ScalarNode::Step(_) => {
                let by_angle = self.slope_of_input(scalar).map(|(angle, slope)| (angle.into(), vec![Factor(slope)]));
                let (variable, maps) = by_angle.unwrap_or((scalar.into(), vec![]));
                vec![Term { part: Part::Variable(variable), maps }]
            }
            ScalarNode::Dot(v, w) if v == w => vec![term(v, [Dot(v), Factor(Partials::Factor(self.constant(2.0)))])],
            ScalarNode::Dot(v, w) => vec![term(v, [Dot(w)]), term(w, [Dot(v)])],
            ScalarNode::Norm(v) => vec![term(v, [Dot(self.normalize(v).into())])],
            ScalarNode::Component(v, axis) => vec![term(v, [Component(axis)])],
            ScalarNode::Real(motion, u, w) => {
                let u = self.imaginary(motion, u, w);
                vec![term(motion, [Dot(u), Factor(Partials::Factor(self.constant(-0.5)))])]
            }
            _ => {
                let partials = self.partials(scalar, |part| active.contains(part.into()));
                partials.into_iter().map(|(part, partial)| term(part, [Factor(partial)])).collect()
            }
        }
    }

    fn terms_of_vector(
        &mut self,
        vector: Vector,
        placement: ReciprocalPlacement,
        after: &mut Option<Linear>,
    ) -> Vec<Term> {
        use Linear::{
            Across, AcrossOver, Along, Axis, Cross, Curl, Dot, Neg, Perp, Rotate, Scale, Solve, Tilted, TurnedRate,
        };
        match self.vector_node(vector) {
            VectorNode::Components(c) => c.into_iter().zip(0..).map(|(c, axis)| term(c, [Axis(axis)])).collect(),
            VectorNode::Add(v, w) => vec![term(v, []), term(w, [])],
            VectorNode::Sub(v, w) => vec![term(v, []), term(w, [Neg])],
            VectorNode::Neg(v) => vec![term(v, [Neg])],
            VectorNode::Scale(k, v) => vec![term(k, [Along(v)]), term(v, [Scale(k)])],
            // The vector is 0.
            VectorNode::Rotate(rotation, v) if self.is_velocity(v) => vec![term(v, [Rotate(rotation)])],
            VectorNode::Rotate(rotation, v) => {
                let mut terms = vec![];
                if let Some((step, back)) = self.moved_by(rotation) {
                    // J δ̇ × y, or for the inverse −J δ̇ × y, with J = 1 ± ½ [δ]× to first order. For motions, which are
                    // velocities, J is 1.
                    let curl = (!self.is_motion(step)).then_some(Curl { v: step, back });
                    let maps = curl.into_iter().chain([Cross { v: vector, swapped: back }]).collect();
                    terms.push(Term { part: Part::Node(step.into()), maps });
                }
                if let Some((angle, perp)) = self.swing(rotation, vector) {
                    let radians = self.radians(angle).map(|radians| Part::Node(radians.into()));
                    let part = radians.unwrap_or(Part::Variable(angle.into()));
                    terms.push(Term { part, maps: vec![Along(perp)] });
                }
                terms.push(term(v, [Rotate(rotation)]));
                terms
            }
            VectorNode::Normalize(v) => {
                let norm = self.norm(v);
                let reciprocal = self.reciprocal(norm);
                vec![term(v, [AcrossOver { unit: Unit(vector), reciprocal, placement }])]
            }
            VectorNode::Perp(plane, v) => vec![term(v, [Perp { plane, back: false }])],
            VectorNode::Cross(v, w) => {
                vec![term(v, [Cross { v: w, swapped: false }]), term(w, [Cross { v, swapped: true }])]
            }
            VectorNode::Across(v, u) => {
                let tilted = Tilted { along: self.dot(v, u), from: v, to: u.into() };
                vec![term(v, [Across(u)]), term(u, [tilted])]
            }
            VectorNode::Motion(space, Attitude::Quaternion(u, w)) => {
                *after = Some(Scale(self.twice_over_square(u, w)));
                let aside = term(u, [Cross { v: u, swapped: space == Space::World }]);
                vec![term(u, [Scale(w)]), aside, term(w, [Along(u), Neg])]
            }
            VectorNode::Motion(space, Attitude::Turn(v)) if self.is_step(v) => {
                vec![term(v, [Curl { v, back: space == Space::Body }])]
            }
            VectorNode::Imaginary(motion, u, w) => {
                *after = Some(Scale(self.constant(0.5)));
                let w = self.real(motion, u, w);
                vec![term(motion, [Scale(w)]), term(motion, [Cross { v: vector, swapped: false }])]
            }
            VectorNode::Motion(space, Attitude::Turn(v)) => {
                vec![term(v, [TurnedRate { v, curled_back: space == Space::Body }])]
            }
            VectorNode::Solve(m, v) => {
                *after = Some(Solve(m));
                let columns = m.columns.into_iter().zip(0..).map(|(column, k)| {
                    if m.transposed {
                        term(column, [Dot(vector), Axis(k), Neg])
                    } else {
                        term(column, [Scale(self.component(vector, k)), Neg])
                    }
                });
                [term(v, [])].into_iter().chain(columns).collect()
            }
        }
    }

    /// Returns the angle of `rotation`, and the derivative of the result `rotated` by that angle.
    fn swing(&mut self, rotation: Rotation, rotated: Vector) -> Option<(Angle, Vector)> {
        let (turn, back) = self.untransposed(rotation);
        let (angle, perp) = match turn {
            RotationNode::Turn(plane, angle) => (angle, self.perp(plane, rotated)),
            RotationNode::About(axis, angle) => (angle, self.cross(axis, rotated)),
            _ => return None,
        };
        Some((self.unshifted(angle), if back { self.neg_vector(perp) } else { perp }))
    }

    /// Returns the sum of two scalars or of two vectors.
    pub(crate) fn add_nodes(&mut self, one: Node, other: Node) -> Node {
        match (one, other) {
            (Node::Scalar(a), Node::Scalar(b)) => self.add(a, b).into(),
            (Node::Vector(v), Node::Vector(w)) => self.add_vectors(v, w).into(),
            _ => unreachable!("changes of a number are numbers, those of a vector vectors"),
        }
    }

    /// Returns the image of x.
    pub(crate) fn apply(&mut self, map: Linear, x: Node) -> Node {
        match x {
            Node::Scalar(x) => self.apply_to_scalar(map, x),
            Node::Vector(x) => self.apply_to_vector(map, x),
        }
    }

    fn apply_to_scalar(&mut self, map: Linear, x: Scalar) -> Node {
        match map {
            Linear::Factor(partial) => self.times(x, partial).into(),
            Linear::Along(v) if self.constant_of(x) == Some(1.0) => v.into(),
            Linear::Along(v) => self.scale(x, v).into(),
            Linear::Axis(axis) => {
                let zero = self.constant(0.0);
                let components = core::array::from_fn(|k| if k == usize::from(axis) { x } else { zero });
                self.components(components).into()
            }
            _ => unreachable!("a map of vectors"),
        }
    }

    fn apply_to_vector(&mut self, map: Linear, x: Vector) -> Node {
        let image = match map {
            Linear::Dot(v) => return self.dot(x, v).into(),
            Linear::Component(axis) => return self.component(x, axis).into(),
            Linear::Neg => self.neg_vector(x),
            Linear::Scale(k) => self.scale(k, x),
            Linear::Rotate(rotation) => self.rotate(rotation, x),
            Linear::Perp { plane, back } => {
                let perp = self.perp(plane, x);
                if back { self.neg_vector(perp) } else { perp }
            }
            Linear::Cross { v, swapped } => {
                if swapped {
                    self.cross(v, x)
                } else {
                    self.cross(x, v)
                }
            }
            Linear::Curl { v, back } => {
                let (half, cross) = (self.constant(0.5), self.cross(v, x));
                let curl = self.scale(half, cross);
                if back { self.sub_vectors(x, curl) } else { self.add_vectors(x, curl) }
            }
            Linear::TurnedRate { v, curled_back } => self.turned_rate(v, x, curled_back),
            Linear::Across(unit) => self.across(x, unit),
            Linear::AcrossOver { unit, reciprocal, placement } => {
                let across = self.across(x, unit);
                match placement {
                    ReciprocalPlacement::Late => self.scale(reciprocal, across),
                    ReciprocalPlacement::Early => {
                        let components = [0, 1, 2].map(|axis| self.component(across, axis));
                        let components = components.map(|component| self.mul(reciprocal, component));
                        self.components(components)
                    }
                }
            }
            Linear::Tilted { along, from, to } => {
                let moved = self.dot(x, from);
                let (kept, moved) = (self.scale(along, x), self.scale(moved, to));
                let sum = self.add_vectors(kept, moved);
                self.neg_vector(sum)
            }
            Linear::Solve(m) => self.solve(m, x),
            Linear::Factor(_) | Linear::Along(_) | Linear::Axis(_) => unreachable!("a map of numbers"),
        };
        image.into()
    }

    /// Returns the transposed map.
    pub(crate) fn transposed(&mut self, map: Linear) -> Linear {
        match map {
            Linear::Dot(v) => Linear::Along(v),
            Linear::Along(v) => Linear::Dot(v),
            Linear::Component(axis) => Linear::Axis(axis),
            Linear::Axis(axis) => Linear::Component(axis),
            Linear::Rotate(rotation) => Linear::Rotate(self.transpose(rotation)),
            Linear::Perp { plane, back } => Linear::Perp { plane, back: !back },
            Linear::Cross { v, swapped } => Linear::Cross { v, swapped: !swapped },
            Linear::Curl { v, back } => Linear::Curl { v, back: !back },
            Linear::TurnedRate { v, curled_back } => Linear::TurnedRate { v, curled_back: !curled_back },
            Linear::Tilted { along, from, to } => Linear::Tilted { along, from: to, to: from },
            Linear::Solve(m) => Linear::Solve(m.transpose()),
            Linear::Factor(_) | Linear::Neg | Linear::Scale(_) | Linear::Across(_) | Linear::AcrossOver { .. } => map,
        }
    }
}

/// The contribution of a node.
pub(crate) fn term<const N: usize>(part: impl Into<Node>, maps: [Linear; N]) -> Term {
    Term { part: Part::Node(part.into()), maps: maps.into() }
}
