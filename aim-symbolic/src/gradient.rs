//! Derivatives by one reverse sweep over scalars and vectors: linear in the size of the expression.

use std::collections::{HashMap, HashSet};

use crate::rules::COMPOSITIONS;
use crate::{Angle, Graph, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// Where the reciprocal of a normalised vector's derivative goes: a choice that the length of the chain decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// It stays a scale factor, which may float out to each derivative.
    Late,
    /// It is multiplied into the vector at once, for all that comes after.
    Early,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Node {
    Scalar(Scalar),
    Vector(Vector),
}

impl Graph {
    /// The derivatives of `output` by each of `angles`. Entries of matrices count as constants.
    ///
    /// A guarded [`reciprocal`](Self::reciprocal) is 0 with all its derivatives where it is guarded.
    pub fn gradient(&mut self, output: Scalar, angles: &[Angle], placement: Placement) -> Vec<Scalar> {
        let output = self.rewrite_by(&[output], &COMPOSITIONS)[0];
        let order = self.order(output);
        let one = self.constant(1.0);
        let mut sweep = Sweep {
            g: self,
            placement,
            scalars: HashMap::from([(output, one)]),
            vectors: HashMap::new(),
            angles: HashMap::new(),
        };
        for node in order.into_iter().rev() {
            match node {
                Node::Scalar(s) => sweep.scalar(s),
                Node::Vector(v) => sweep.vector(v),
            }
        }
        let found = sweep.angles;
        angles.iter().map(|angle| found.get(angle).copied().unwrap_or_else(|| self.constant(0.0))).collect()
    }

    /// The number of nodes that `output` is made of.
    pub(crate) fn size(&self, output: Scalar) -> usize {
        self.order(output).len()
    }

    /// Everything that `output` is made of, each after its parts.
    fn order(&self, output: Scalar) -> Vec<Node> {
        let mut seen = HashSet::new();
        let mut order = Vec::new();
        let mut stack = vec![(Node::Scalar(output), false)];
        while let Some((node, parts_done)) = stack.pop() {
            if parts_done {
                order.push(node);
            } else if seen.insert(node) {
                stack.push((node, true));
                stack.extend(self.parts(node).into_iter().rev().map(|part| (part, false)));
            }
        }
        order
    }

    fn parts(&self, node: Node) -> Vec<Node> {
        use Node::{Scalar as S, Vector as V};
        match node {
            S(s) => match self.scalar_node(s) {
                ScalarNode::Constant(_) | ScalarNode::Input(_) | ScalarNode::Tiny => vec![],
                ScalarNode::Add(a, b) | ScalarNode::Sub(a, b) | ScalarNode::Mul(a, b) | ScalarNode::Div(a, b) => {
                    vec![S(a), S(b)]
                }
                ScalarNode::Neg(a) | ScalarNode::Sqrt(a) | ScalarNode::Reciprocal(a) => vec![S(a)],
                ScalarNode::SelectLess(_, _, then, otherwise) => vec![S(then), S(otherwise)],
                ScalarNode::Dot(v, w) => vec![V(v), V(w)],
                ScalarNode::Norm(v) | ScalarNode::Component(v, _) => vec![V(v)],
            },
            V(v) => match self.vector_node(v) {
                VectorNode::Components(c) => c.map(S).to_vec(),
                VectorNode::Add(v, w) | VectorNode::Sub(v, w) => vec![V(v), V(w)],
                VectorNode::Neg(v) | VectorNode::Rotate(_, v) | VectorNode::Normalize(v) | VectorNode::Perp(_, v) => {
                    vec![V(v)]
                }
                VectorNode::Scale(k, v) => vec![S(k), V(v)],
            },
        }
    }
}

struct Sweep<'g> {
    g: &'g mut Graph,
    placement: Placement,
    /// d output / d scalar
    scalars: HashMap<Scalar, Scalar>,
    /// d output / d vector, a covector
    vectors: HashMap<Vector, Vector>,
    angles: HashMap<Angle, Scalar>,
}

impl Sweep<'_> {
    fn add_to_scalar(&mut self, scalar: Scalar, change: Scalar) {
        let total = match self.scalars.get(&scalar) {
            Some(&so_far) => self.g.add(so_far, change),
            None => change,
        };
        self.scalars.insert(scalar, total);
    }

    fn add_to_vector(&mut self, vector: Vector, change: Vector) {
        let total = match self.vectors.get(&vector) {
            Some(&so_far) => self.g.add_vectors(so_far, change),
            None => change,
        };
        self.vectors.insert(vector, total);
    }

    fn add_to_angle(&mut self, angle: Angle, change: Scalar) {
        let total = match self.angles.get(&angle) {
            Some(&so_far) => self.g.add(so_far, change),
            None => change,
        };
        self.angles.insert(angle, total);
    }

    fn scalar(&mut self, scalar: Scalar) {
        let Some(&bar) = self.scalars.get(&scalar) else { return };
        match self.g.scalar_node(scalar) {
            ScalarNode::Constant(_) | ScalarNode::Input(_) | ScalarNode::Tiny => {}
            ScalarNode::Add(a, b) => {
                self.add_to_scalar(a, bar);
                self.add_to_scalar(b, bar);
            }
            ScalarNode::Sub(a, b) => {
                self.add_to_scalar(a, bar);
                let minus = self.g.neg(bar);
                self.add_to_scalar(b, minus);
            }
            ScalarNode::Mul(a, b) => {
                let (by_a, by_b) = (self.g.mul(bar, b), self.g.mul(bar, a));
                self.add_to_scalar(a, by_a);
                self.add_to_scalar(b, by_b);
            }
            ScalarNode::Div(a, b) => {
                let by_a = self.g.div(bar, b);
                let along = self.g.mul(by_a, scalar);
                let by_b = self.g.neg(along);
                self.add_to_scalar(a, by_a);
                self.add_to_scalar(b, by_b);
            }
            ScalarNode::Neg(a) => {
                let minus = self.g.neg(bar);
                self.add_to_scalar(a, minus);
            }
            ScalarNode::Sqrt(a) => {
                let twice = self.g.add(scalar, scalar);
                let by_a = self.g.div(bar, twice);
                self.add_to_scalar(a, by_a);
            }
            ScalarNode::Reciprocal(a) => {
                let square = self.g.mul(scalar, scalar);
                let along = self.g.mul(bar, square);
                let by_a = self.g.neg(along);
                self.add_to_scalar(a, by_a);
            }
            ScalarNode::SelectLess(a, b, then, otherwise) => {
                let zero = self.g.constant(0.0);
                let by_then = self.g.intern_scalar(ScalarNode::SelectLess(a, b, bar, zero));
                let by_otherwise = self.g.intern_scalar(ScalarNode::SelectLess(a, b, zero, bar));
                self.add_to_scalar(then, by_then);
                self.add_to_scalar(otherwise, by_otherwise);
            }
            ScalarNode::Dot(v, w) => {
                let (by_v, by_w) = (self.g.scale(bar, w), self.g.scale(bar, v));
                self.add_to_vector(v, by_v);
                self.add_to_vector(w, by_w);
            }
            ScalarNode::Norm(v) => {
                let direction = self.g.normalize(v);
                let by_v = self.g.scale(bar, direction.into());
                self.add_to_vector(v, by_v);
            }
            ScalarNode::Component(v, axis) => {
                let zero = self.g.constant(0.0);
                let by_v = core::array::from_fn(|k| if k == usize::from(axis) { bar } else { zero });
                let by_v = self.g.components(by_v);
                self.add_to_vector(v, by_v);
            }
        }
    }

    fn vector(&mut self, vector: Vector) {
        let Some(&bar) = self.vectors.get(&vector) else { return };
        match self.g.vector_node(vector) {
            VectorNode::Components(c) => {
                for (c, axis) in c.into_iter().zip(0..) {
                    if self.g.constant_of(c).is_none() {
                        let by_c = self.g.component(bar, axis);
                        self.add_to_scalar(c, by_c);
                    }
                }
            }
            VectorNode::Add(v, w) => {
                self.add_to_vector(v, bar);
                self.add_to_vector(w, bar);
            }
            VectorNode::Sub(v, w) => {
                self.add_to_vector(v, bar);
                let minus = self.g.neg_vector(bar);
                self.add_to_vector(w, minus);
            }
            VectorNode::Neg(v) => {
                let minus = self.g.neg_vector(bar);
                self.add_to_vector(v, minus);
            }
            VectorNode::Scale(k, v) => {
                let (by_k, by_v) = (self.g.dot(bar, v), self.g.scale(k, bar));
                self.add_to_scalar(k, by_k);
                self.add_to_vector(v, by_v);
            }
            VectorNode::Rotate(rotation, v) => {
                // A turn moves its result along the result's own perpendicular, which is already at hand.
                let (turn, back) = match self.g.rotation_node(rotation) {
                    RotationNode::Transpose(inner) => (self.g.rotation_node(inner), true),
                    node => (node, false),
                };
                if let RotationNode::Turn(plane, angle) = turn {
                    let perp = self.g.perp(plane, vector);
                    let along = self.g.dot(bar, perp);
                    let by_angle = if back { self.g.neg(along) } else { along };
                    self.add_to_angle(angle, by_angle);
                }
                let inverse = self.g.transpose(rotation);
                let by_v = self.g.rotate(inverse, bar);
                self.add_to_vector(v, by_v);
            }
            VectorNode::Normalize(v) => {
                // d(v/|v|) is the part of dv across v, over |v|.
                let along = self.g.dot(vector, bar);
                let radial = self.g.scale(along, vector);
                let across = self.g.sub_vectors(bar, radial);
                let norm = self.g.norm(v);
                let reciprocal = self.g.reciprocal(norm);
                let by_v = match self.placement {
                    Placement::Late => self.g.scale(reciprocal, across),
                    Placement::Early => {
                        let components = [0, 1, 2].map(|axis| {
                            let component = self.g.component(across, axis);
                            self.g.mul(reciprocal, component)
                        });
                        self.g.components(components)
                    }
                };
                self.add_to_vector(v, by_v);
            }
            VectorNode::Perp(plane, v) => {
                // The transpose of a quarter turn is the quarter turn back.
                let perp = self.g.perp(plane, bar);
                let by_v = self.g.neg_vector(perp);
                self.add_to_vector(v, by_v);
            }
        }
    }
}
