//! Lowering of typed expressions to components, the scalars of which vectors and rotations consist.

use crate::ir::node::Node;
use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::limits::HighestOrders;
use crate::rewrite::rules::{MATRIX, Rules};
use crate::{Attitude, Constant, Graph, Plane, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

impl Graph {
    /// Returns the components of `v` in operations on numbers alone; factors and terms 0 and ±1 are folded.
    pub fn in_components(&mut self, v: impl Into<Vector>) -> [Scalar; 3] {
        let mut lowering = Lowering::new(core::mem::take(self), &Rules::default());
        let v = v.into();
        lowering.lower(&[Node::Vector(v)]);
        let components = lowering.vector(v);
        *self = lowering.fold.g;
        components
    }
}

/// Lowers expressions of one graph, each once.
pub(crate) struct Lowering {
    pub(crate) fold: Fold,
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, [Scalar; 3]>,
    /// The matrices of the quaternions that are applied as matrices.
    matrices: Table<Rotation, [Scalar; 9]>,
    by_matrices: bool,
    highest: HighestOrders,
}

impl Lowering {
    pub(crate) fn new(g: Graph, rules: &Rules<'_>) -> Self {
        let (scalars, vectors, matrices, highest) = Default::default();
        let by_matrices = rules.has(&MATRIX);
        Self { fold: Fold::new(g, rules), scalars, vectors, matrices, by_matrices, highest }
    }

    /// Lowers the nodes and everything they depend on, operands first, so that no recursion runs deep.
    fn lower(&mut self, nodes: &[Node]) {
        let order = self.fold.g.order_with_numbers(nodes);
        if cfg!(not(aim_small)) {
            self.highest.record_orders(&self.fold.g, &order);
        }
        if self.by_matrices {
            self.make_matrices(&order);
        }
        for node in order {
            match node {
                Node::Scalar(s) => {
                    self.scalar(s);
                }
                Node::Vector(v) => {
                    self.vector(v);
                }
            }
        }
    }

    /// Converts the quaternions that rotate several vectors to matrices.
    fn make_matrices(&mut self, order: &[Node]) {
        for rotation in self.fold.g.busy_quaternions(order) {
            let numbers = match self.fold.g.rotation_node(rotation) {
                RotationNode::Quaternion(u, w) => vec![Node::Vector(u), Node::Scalar(w)],
                RotationNode::Moving(motions) => motions.map(Node::Vector).to_vec(),
                _ => continue,
            };
            self.lower(&numbers);
            let matrix = match self.quaternion(rotation) {
                Some(quaternion) => self.matrix_of(quaternion),
                None => self.images(rotation),
            };
            self.matrices.insert(rotation, matrix);
        }
    }

    /// Lowers the scalars and returns the results.
    pub(crate) fn outputs(&mut self, outputs: &[Scalar]) -> Vec<Scalar> {
        self.lower(&outputs.iter().map(|&s| Node::Scalar(s)).collect::<Vec<_>>());
        outputs.iter().map(|&s| self.scalar(s)).collect()
    }

    pub(crate) fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if let Some(&done) = self.scalars.get(scalar) {
            return done;
        }
        let lowered = match self.fold.g.scalar_node(scalar) {
            ScalarNode::Op(op) => {
                let op = op.map(|s| self.scalar(s));
                self.fold.op(op)
            }
            ScalarNode::Reciprocal(a) => {
                let a = self.scalar(a);
                self.fold.guarded_reciprocal(a)
            }
            ScalarNode::Dot(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                self.dot(v, w)
            }
            ScalarNode::Norm(v) => {
                let v = self.vector(v);
                let square = self.dot(v, v);
                self.fold.sqrt(square)
            }
            ScalarNode::Component(v, axis) => self.vector(v)[usize::from(axis)],
            ScalarNode::Step(_) => self.fold.g.constant(0.0),
            ScalarNode::Real(_, _, w) => self.scalar(w),
            // These nodes come from limits, which builds with `aim_small` leave out.
            ScalarNode::Stumpff(..) | ScalarNode::Arc(..) if cfg!(aim_small) => unreachable!("no rig has one"),
            ScalarNode::Stumpff(function, s) => {
                let highest = self.highest.of_stumpff(function, s);
                let s = self.scalar(s);
                self.fold.stumpff(function, highest, s)
            }
            ScalarNode::Arc(order, s, w) => {
                let highest = self.highest.of_arc(order, s, w);
                let (s, w) = (self.scalar(s), self.scalar(w));
                self.fold.arc(order, highest, s, w)
            }
        };
        self.scalars.insert(scalar, lowered);
        lowered
    }

    fn dot(&mut self, v: [Scalar; 3], w: [Scalar; 3]) -> Scalar {
        let products = [0, 1, 2].map(|k| self.fold.mul(v[k], w[k]));
        let xy = self.fold.add(products[0], products[1]);
        self.fold.add(xy, products[2])
    }

    fn vector(&mut self, vector: Vector) -> [Scalar; 3] {
        if let Some(&done) = self.vectors.get(vector) {
            return done;
        }
        let lowered = match self.fold.g.vector_node(vector) {
            VectorNode::Components(c) => c.map(|c| self.scalar(c)),
            VectorNode::Add(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                [0, 1, 2].map(|k| self.fold.add(v[k], w[k]))
            }
            VectorNode::Sub(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                [0, 1, 2].map(|k| self.fold.sub(v[k], w[k]))
            }
            VectorNode::Neg(v) => self.vector(v).map(|c| self.fold.neg(c)),
            VectorNode::Scale(k, v) => {
                let (k, v) = (self.scalar(k), self.vector(v));
                v.map(|c| self.fold.mul(k, c))
            }
            VectorNode::Rotate(rotation, v) => {
                let v = self.vector(v);
                self.rotate_by(rotation, false, v)
            }
            VectorNode::Normalize(v) => {
                let v = self.vector(v);
                let square = self.dot(v, v);
                let norm = self.fold.sqrt(square);
                let reciprocal = self.fold.guarded_reciprocal(norm);
                v.map(|c| self.fold.mul(reciprocal, c))
            }
            VectorNode::Perp(plane, v) => {
                let v = self.vector(v);
                let (from, towards) = plane.axes();
                let mut out = [self.fold.g.constant(0.0); 3];
                out[from] = self.fold.neg(v[towards]);
                out[towards] = v[from];
                out
            }
            VectorNode::Cross(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                self.cross(v, w)
            }
            VectorNode::Solve(m, v) => {
                let solution = self.fold.g.by_cofactors(m, v);
                self.vector(solution)
            }
            VectorNode::Motion(..) => [self.fold.g.constant(0.0); 3],
            VectorNode::Imaginary(_, u, _) => self.vector(u),
            VectorNode::Across(v, u) => {
                let (v, u) = (self.vector(v), self.vector(u.into()));
                let along = self.dot(v, u);
                [0, 1, 2].map(|k| {
                    let radial = self.fold.mul(along, u[k]);
                    self.fold.sub(v[k], radial)
                })
            }
        };
        self.vectors.insert(vector, lowered);
        lowered
    }

    fn cross(&mut self, v: [Scalar; 3], w: [Scalar; 3]) -> [Scalar; 3] {
        [(1, 2), (2, 0), (0, 1)].map(|(i, k)| {
            let (first, second) = (self.fold.mul(v[i], w[k]), self.fold.mul(v[k], w[i]));
            self.fold.sub(first, second)
        })
    }

    /// Returns the image of `v`, or with `back` the vector whose image is `v`.
    fn rotate_by(&mut self, rotation: Rotation, back: bool, v: [Scalar; 3]) -> [Scalar; 3] {
        let node = self.fold.g.rotation_node(rotation);
        match node {
            RotationNode::Matrix(rows) => {
                let rows = rows.map(|s| self.scalar(s));
                self.matrix(rows, back, v)
            }
            RotationNode::Basis(rows) => self.basis(rows, back, v),
            RotationNode::Turn(_, angle) | RotationNode::About(_, angle) => {
                let (sin, cos) = self.fold.g.sin_cos(angle);
                let (sin, cos) = (self.scalar(sin), self.scalar(cos));
                let sin = if back { self.fold.neg(sin) } else { sin };
                match node {
                    RotationNode::Turn(plane, _) => self.turn(plane, sin, cos, v),
                    RotationNode::About(axis, _) => self.about(axis, sin, cos, v),
                    _ => unreachable!("turns are all that is left"),
                }
            }
            RotationNode::Quaternion(..) | RotationNode::Moving(_) => match self.matrices.copied(rotation) {
                Some(rows) => self.matrix(rows, back, v),
                None => self.turned(rotation, back, v),
            },
            RotationNode::Step(_) => v,
            RotationNode::Compose(outer, inner) => {
                let [first, second] = if back { [outer, inner] } else { [inner, outer] };
                let once = self.rotate_by(first, back, v);
                self.rotate_by(second, back, once)
            }
            RotationNode::Transpose(twice) => self.rotate_by(twice, !back, v),
        }
    }

    /// `cos v + sin a × v + (1 − cos)(a · v) a`
    fn about(&mut self, axis: Vector, sin: Scalar, cos: Scalar, v: [Scalar; 3]) -> [Scalar; 3] {
        let axis = self.vector(axis);
        let one = self.fold.g.constant(1.0);
        let versine = self.fold.sub(one, cos);
        self.axis_angle(axis, [cos, sin, versine], v)
    }

    /// `kept v + aside u × v + along (u · v) u`
    fn axis_angle(&mut self, u: [Scalar; 3], [kept, aside, along]: [Scalar; 3], v: [Scalar; 3]) -> [Scalar; 3] {
        let (across, dot) = (self.cross(u, v), self.dot(u, v));
        let along = self.fold.mul(along, dot);
        [0, 1, 2].map(|k| {
            let terms = [(kept, v[k]), (aside, across[k]), (along, u[k])].map(|(f, x)| self.fold.mul(f, x));
            let sum = self.fold.add(terms[0], terms[1]);
            self.fold.add(sum, terms[2])
        })
    }

    /// Returns the parts u and w of a rotation's quaternion, and 2 u/|q|²; `None` if it has no quaternion.
    fn quaternion(&mut self, rotation: Rotation) -> Option<([Scalar; 3], Scalar, [Scalar; 3])> {
        let (u, w, factor) = match self.fold.g.rotation_node(rotation) {
            RotationNode::Quaternion(u, w) => (u, w, None),
            RotationNode::Moving(motions) => match self.fold.g.attitude_of(motions) {
                Attitude::Quaternion(u, w) => (u, w, Some(self.fold.g.twice_over_square(u, w))),
                Attitude::Turn(_) => return None,
            },
            _ => return None,
        };
        let (u, w, factor) = (self.vector(u), self.scalar(w), factor.map(|factor| self.scalar(factor)));
        let twice = u.map(|c| match factor {
            Some(factor) => self.fold.mul(factor, c),
            None => self.fold.add(c, c),
        });
        Some((u, w, twice))
    }

    /// Returns `v` rotated by a quaternion, `v + w t + u × t` with `t = 2 u × v/|q|²`, or by a rotation vector.
    fn turned(&mut self, rotation: Rotation, back: bool, v: [Scalar; 3]) -> [Scalar; 3] {
        if let Some((u, w, twice)) = self.quaternion(rotation) {
            let w = if back { self.fold.neg(w) } else { w };
            let t = self.cross(twice, v);
            let aside = self.cross(u, t);
            return [0, 1, 2].map(|k| {
                let turned = self.fold.mul(w, t[k]);
                let sum = self.fold.add(v[k], turned);
                self.fold.add(sum, aside[k])
            });
        }
        let RotationNode::Moving(motions) = self.fold.g.rotation_node(rotation) else { return v };
        let Attitude::Turn(turn) = self.fold.g.attitude_of(motions) else { return v };
        let [cos, sine, versine, _] = self.fold.g.turn_factors(turn);
        let [cos, sine, versine] = [cos, sine, versine].map(|factor| self.scalar(factor));
        let sine = if back { self.fold.neg(sine) } else { sine };
        let turn = self.vector(turn);
        self.axis_angle(turn, [cos, sine, versine], v)
    }

    /// Returns the images of the axes, which are the rows of the matrix in the row-vector layout.
    fn images(&mut self, rotation: Rotation) -> [Scalar; 9] {
        let [zero, one] = [0.0, 1.0].map(|c| self.fold.g.constant(c));
        let axes: [[Scalar; 3]; 3] =
            core::array::from_fn(|i| core::array::from_fn(|k| if i == k { one } else { zero }));
        let images = axes.map(|axis| self.turned(rotation, false, axis));
        core::array::from_fn(|i| images[i / 3][i % 3])
    }

    /// Returns the matrix of a quaternion in the row-vector layout: row k is the image of axis k.
    fn matrix_of(&mut self, (u, w, twice): ([Scalar; 3], Scalar, [Scalar; 3])) -> [Scalar; 9] {
        let one = self.fold.g.constant(1.0);
        let mut rows = [one; 9];
        for (k, (i, j)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
            // Diagonal entries 1 − 2 (i² + j²), others 2 (i j ± w k).
            let (ii, jj) = (self.fold.mul(u[i], twice[i]), self.fold.mul(u[j], twice[j]));
            let squares = self.fold.add(ii, jj);
            rows[4 * k] = self.fold.sub(one, squares);
            let (ij, wk) = (self.fold.mul(u[i], twice[j]), self.fold.mul(w, twice[k]));
            rows[3 * i + j] = self.fold.add(ij, wk);
            rows[3 * j + i] = self.fold.sub(ij, wk);
        }
        rows
    }

    fn basis(&mut self, rows: [Constant; 9], transposed: bool, v: [Scalar; 3]) -> [Scalar; 3] {
        let at = |i: usize, k: usize| rows[if transposed { 3 * i + k } else { 3 * k + i }].value();
        let mut zeros = (0..9).filter(|&place| at(place / 3, place % 3) == 0.0);
        let (Some(zero), None) = (zeros.next(), zeros.next()) else {
            let rows = rows.map(|c| self.fold.g.constant(c.value()));
            return self.matrix(rows, transposed, v);
        };
        self.two_turns(core::array::from_fn(|place| at(place / 3, place % 3)), zero, v)
    }

    /// Applies an orthogonal matrix with one zero as two plane rotations, or one and a reflection. The row with the
    /// zero combines two components of `v`; the other rows need only the combination perpendicular to that one, and the
    /// third component.
    fn two_turns(&mut self, rows: [f64; 9], zero: usize, v: [Scalar; 3]) -> [Scalar; 3] {
        let (row, k) = (zero / 3, zero % 3);
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        let [a, b] = [rows[3 * row + i], rows[3 * row + j]];
        let aside = self.combination([-b, a], [v[i], v[j]]);
        [0, 1, 2].map(|own| {
            let of = |k: usize| rows[3 * own + k];
            if own == row {
                return self.combination([a, b], [v[i], v[j]]);
            }
            self.combination([a * of(j) - b * of(i), of(k)], [aside, v[k]])
        })
    }

    fn combination(&mut self, factors: [f64; 2], parts: [Scalar; 2]) -> Scalar {
        let [x, y] = [0, 1].map(|i| {
            let factor = self.fold.g.constant(factors[i]);
            self.fold.mul(factor, parts[i])
        });
        self.fold.add(x, y)
    }

    /// Returns the row-vector product `v M`, or `v Mᵀ` if `transposed`.
    fn matrix(&mut self, rows: [Scalar; 9], transposed: bool, v: [Scalar; 3]) -> [Scalar; 3] {
        [0, 1, 2].map(|k| {
            let column = [0, 1, 2].map(|i| rows[if transposed { 3 * k + i } else { 3 * i + k }]);
            self.dot(v, column)
        })
    }

    fn turn(&mut self, plane: Plane, sin: Scalar, cos: Scalar, v: [Scalar; 3]) -> [Scalar; 3] {
        let (from, towards) = plane.axes();
        let mut out = v;
        let (cos_from, sin_towards) = (self.fold.mul(cos, v[from]), self.fold.mul(sin, v[towards]));
        out[from] = self.fold.sub(cos_from, sin_towards);
        let (sin_from, cos_towards) = (self.fold.mul(sin, v[from]), self.fold.mul(cos, v[towards]));
        out[towards] = self.fold.add(sin_from, cos_towards);
        out
    }
}
