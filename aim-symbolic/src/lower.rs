//! From typed expressions to components: scalars that only add, multiply, divide, take roots and select.

use std::collections::HashMap;

use crate::{Constant, Graph, Plane, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// Lowers expressions of one graph, each once.
pub(crate) struct Lowering<'g> {
    g: &'g mut Graph,
    scalars: HashMap<Scalar, Scalar>,
    vectors: HashMap<Vector, [Scalar; 3]>,
}

impl<'g> Lowering<'g> {
    pub(crate) fn new(g: &'g mut Graph) -> Self {
        Self { g, scalars: HashMap::new(), vectors: HashMap::new() }
    }

    pub(crate) fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if let Some(&done) = self.scalars.get(&scalar) {
            return done;
        }
        let lowered = match self.g.scalar_node(scalar) {
            ScalarNode::Constant(_) | ScalarNode::Input(_) | ScalarNode::Tiny => scalar,
            ScalarNode::Add(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.fold_add(a, b)
            }
            ScalarNode::Sub(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.fold_sub(a, b)
            }
            ScalarNode::Mul(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.fold_mul(a, b)
            }
            ScalarNode::Div(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.fold_div(a, b)
            }
            ScalarNode::Neg(a) => {
                let a = self.scalar(a);
                self.g.fold_neg(a)
            }
            ScalarNode::Sqrt(a) => {
                let a = self.scalar(a);
                self.g.sqrt(a)
            }
            ScalarNode::Reciprocal(a) => {
                let a = self.scalar(a);
                self.guarded_reciprocal(a)
            }
            ScalarNode::SelectLess(a, b, then, otherwise) => {
                let node =
                    ScalarNode::SelectLess(self.scalar(a), self.scalar(b), self.scalar(then), self.scalar(otherwise));
                self.g.intern_scalar(node)
            }
            ScalarNode::Dot(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                self.dot(v, w)
            }
            ScalarNode::Norm(v) => {
                let v = self.vector(v);
                let square = self.dot(v, v);
                self.g.sqrt(square)
            }
            ScalarNode::Component(v, axis) => self.vector(v)[usize::from(axis)],
        };
        self.scalars.insert(scalar, lowered);
        lowered
    }

    fn guarded_reciprocal(&mut self, a: Scalar) -> Scalar {
        let one = self.g.constant(1.0);
        let zero = self.g.constant(0.0);
        let tiny = self.g.intern_scalar(ScalarNode::Tiny);
        let reciprocal = self.g.div(one, a);
        self.g.intern_scalar(ScalarNode::SelectLess(tiny, a, reciprocal, zero))
    }

    fn dot(&mut self, v: [Scalar; 3], w: [Scalar; 3]) -> Scalar {
        let products = [0, 1, 2].map(|k| self.g.fold_mul(v[k], w[k]));
        let xy = self.g.fold_add(products[0], products[1]);
        self.g.fold_add(xy, products[2])
    }

    fn vector(&mut self, vector: Vector) -> [Scalar; 3] {
        if let Some(&done) = self.vectors.get(&vector) {
            return done;
        }
        let lowered = match self.g.vector_node(vector) {
            VectorNode::Components(c) => c.map(|c| self.scalar(c)),
            VectorNode::Add(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                [0, 1, 2].map(|k| self.g.fold_add(v[k], w[k]))
            }
            VectorNode::Sub(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                [0, 1, 2].map(|k| self.g.fold_sub(v[k], w[k]))
            }
            VectorNode::Neg(v) => self.vector(v).map(|c| self.g.fold_neg(c)),
            VectorNode::Scale(k, v) => {
                let (k, v) = (self.scalar(k), self.vector(v));
                v.map(|c| self.g.fold_mul(k, c))
            }
            VectorNode::Rotate(rotation, v) => {
                let v = self.vector(v);
                self.rotate(rotation, v)
            }
            VectorNode::Normalize(v) => {
                let v = self.vector(v);
                let square = self.dot(v, v);
                let norm = self.g.sqrt(square);
                let reciprocal = self.guarded_reciprocal(norm);
                v.map(|c| self.g.fold_mul(reciprocal, c))
            }
            VectorNode::Perp(plane, v) => {
                let v = self.vector(v);
                let (from, towards) = plane.axes();
                let mut out = [self.g.constant(0.0); 3];
                out[from] = self.g.fold_neg(v[towards]);
                out[towards] = v[from];
                out
            }
        };
        self.vectors.insert(vector, lowered);
        lowered
    }

    fn rotate(&mut self, rotation: Rotation, v: [Scalar; 3]) -> [Scalar; 3] {
        match self.g.rotation_node(rotation) {
            RotationNode::Matrix(rows) => self.matrix(rows, false, v),
            RotationNode::Basis(rows) => self.basis(rows, false, v),
            RotationNode::Turn(plane, angle) => {
                let (sin, cos) = self.g.sin_cos(angle);
                self.turn(plane, sin, cos, v)
            }
            RotationNode::Compose(outer, inner) => {
                let once = self.rotate(inner, v);
                self.rotate(outer, once)
            }
            RotationNode::Transpose(inner) => match self.g.rotation_node(inner) {
                RotationNode::Matrix(rows) => self.matrix(rows, true, v),
                RotationNode::Basis(rows) => self.basis(rows, true, v),
                RotationNode::Turn(plane, angle) => {
                    let (sin, cos) = self.g.sin_cos(angle);
                    let minus = self.g.fold_neg(sin);
                    self.turn(plane, minus, cos, v)
                }
                RotationNode::Compose(outer, first) => {
                    let (outer, first) = (self.g.transpose(outer), self.g.transpose(first));
                    let once = self.rotate(outer, v);
                    self.rotate(first, once)
                }
                RotationNode::Transpose(twice) => self.rotate(twice, v),
            },
        }
    }

    fn basis(&mut self, rows: [Constant; 9], transposed: bool, v: [Scalar; 3]) -> [Scalar; 3] {
        let rows = rows.map(|c| self.g.constant(c.value()));
        self.matrix(rows, transposed, v)
    }

    /// The row-vector product `v M`, or `v Mᵀ`.
    fn matrix(&mut self, rows: [Scalar; 9], transposed: bool, v: [Scalar; 3]) -> [Scalar; 3] {
        [0, 1, 2].map(|k| {
            let column = [0, 1, 2].map(|i| rows[if transposed { 3 * k + i } else { 3 * i + k }]);
            self.dot(v, column)
        })
    }

    fn turn(&mut self, plane: Plane, sin: Scalar, cos: Scalar, v: [Scalar; 3]) -> [Scalar; 3] {
        let (from, towards) = plane.axes();
        let mut out = v;
        let (kept, lost) = (self.g.fold_mul(cos, v[from]), self.g.fold_mul(sin, v[towards]));
        out[from] = self.g.fold_sub(kept, lost);
        let (won, kept) = (self.g.fold_mul(sin, v[from]), self.g.fold_mul(cos, v[towards]));
        out[towards] = self.g.fold_add(won, kept);
        out
    }
}
