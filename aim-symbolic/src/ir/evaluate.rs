//! Evaluation of typed expressions in f64 without lowering: the independent oracle of the tests.

use crate::ir::smooth::arc_value;
use crate::{
    Angle, Attitude, Graph, InputKind, Number, Rotation, RotationNode, Scalar, ScalarNode, Stumpff, Vector, VectorNode,
};

/// Values for the inputs of a graph.
#[derive(Clone, Debug, Default)]
pub struct Bindings {
    inputs: Vec<f64>,
    angles: Vec<(Angle, f64)>,
}

impl Bindings {
    /// Binds the given inputs in order of declaration. Sines and cosines are omitted: they follow from `angles`, in
    /// radians. Missing inputs and angles are 0.
    #[must_use]
    pub fn new(g: &Graph, given: &[f64], angles: &[(Angle, f64)]) -> Self {
        let mut given = given.iter().copied();
        let radians = |angle| angles.iter().find(|(a, _)| *a == angle).map_or(0.0, |(_, radians)| *radians);
        let inputs = g
            .inputs()
            .iter()
            .map(|(_, kind)| match *kind {
                InputKind::Given => given.next().unwrap_or(0.0),
                InputKind::Sin(angle) => f64::sin(radians(angle)),
                InputKind::Cos(angle) => f64::cos(radians(angle)),
            })
            .collect();
        Self { inputs, angles: angles.to_vec() }
    }

    /// Returns one value for each input, in the order that [`Program::run`](crate::Program::run) takes.
    #[must_use]
    pub fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// Returns the bindings with one angle changed by `by` radians.
    #[must_use]
    pub fn moved(&self, g: &Graph, angle: Angle, by: f64) -> Self {
        let angles: Vec<_> = self.angles.iter().map(|&(a, x)| (a, if a == angle { x + by } else { x })).collect();
        let given: Vec<f64> = g
            .inputs()
            .iter()
            .zip(&self.inputs)
            .filter(|((_, kind), _)| *kind == InputKind::Given)
            .map(|(_, value)| *value)
            .collect();
        Self::new(g, &given, &angles)
    }
}

fn reciprocal(x: f64) -> f64 {
    if f64::tiny() < x { 1.0 / x } else { 0.0 }
}

fn dot(v: [f64; 3], w: [f64; 3]) -> f64 {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

/// The images of the axes under v ↦ kept v + aside (u × v) + along (u · v) u.
fn about(u: [f64; 3], [kept, aside, along]: [f64; 3]) -> [[f64; 3]; 3] {
    axes().map(|e| {
        let across = cross(u, e);
        core::array::from_fn(|k| kept * e[k] + aside * across[k] + along * dot(u, e) * u[k])
    })
}

fn axes() -> [[f64; 3]; 3] {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

fn cross(v: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]
}

impl Graph {
    /// Returns the value of `scalar`.
    #[must_use]
    pub fn evaluate(&self, scalar: Scalar, bindings: &Bindings) -> f64 {
        Evaluation::new(self, bindings).scalar(scalar)
    }

    /// Returns the value of `vector`.
    #[must_use]
    pub fn evaluate_vector(&self, vector: Vector, bindings: &Bindings) -> [f64; 3] {
        Evaluation::new(self, bindings).vector(vector)
    }

    /// Returns the rows of `rotation` in the row-vector layout.
    #[must_use]
    pub fn evaluate_rotation(&self, rotation: Rotation, bindings: &Bindings) -> [[f64; 3]; 3] {
        Evaluation::new(self, bindings).rotation(rotation)
    }
}

/// One evaluation: computes every expression once, however often it is used.
pub(crate) struct Evaluation<'a> {
    g: &'a Graph,
    bindings: &'a Bindings,
    scalars: Vec<Option<f64>>,
    vectors: Vec<Option<[f64; 3]>>,
    rotations: Vec<Option<[[f64; 3]; 3]>>,
}

impl<'a> Evaluation<'a> {
    pub(crate) fn new(g: &'a Graph, bindings: &'a Bindings) -> Self {
        let [scalars, vectors, rotations] = g.sizes();
        Self {
            g,
            bindings,
            scalars: vec![None; scalars],
            vectors: vec![None; vectors],
            rotations: vec![None; rotations],
        }
    }

    pub(crate) fn scalar(&mut self, scalar: Scalar) -> f64 {
        if let Some(known) = self.scalars[scalar.0 as usize] {
            return known;
        }
        let value = match self.g.scalar_node(scalar) {
            ScalarNode::Op(op) => op.map(|s| self.scalar(s)).value(&self.bindings.inputs),
            ScalarNode::Reciprocal(a) => reciprocal(self.scalar(a)),
            ScalarNode::Dot(a, b) => dot(self.vector(a), self.vector(b)),
            ScalarNode::Norm(a) => {
                let a = self.vector(a);
                dot(a, a).sqrt()
            }
            ScalarNode::Component(a, axis) => self.vector(a)[usize::from(axis)],
            ScalarNode::Step(_) => 0.0,
            ScalarNode::Stumpff(function, s) => function.value(self.scalar(s)),
            ScalarNode::Arc(order, s, w) => arc_value(order, self.scalar(s), self.scalar(w)),
            ScalarNode::Real(_, _, w) => self.scalar(w),
        };
        self.scalars[scalar.0 as usize] = Some(value);
        value
    }

    pub(crate) fn vector(&mut self, vector: Vector) -> [f64; 3] {
        if let Some(known) = self.vectors[vector.0 as usize] {
            return known;
        }
        let zip = |a: [f64; 3], b: [f64; 3], f: fn(f64, f64) -> f64| core::array::from_fn(|k| f(a[k], b[k]));
        let value = match self.g.vector_node(vector) {
            VectorNode::Components(c) => c.map(|c| self.scalar(c)),
            VectorNode::Add(a, b) => zip(self.vector(a), self.vector(b), |a, b| a + b),
            VectorNode::Sub(a, b) => zip(self.vector(a), self.vector(b), |a, b| a - b),
            VectorNode::Neg(a) => self.vector(a).map(|c| -c),
            VectorNode::Scale(k, a) => {
                let k = self.scalar(k);
                self.vector(a).map(|c| k * c)
            }
            VectorNode::Rotate(rotation, a) => {
                let rows = self.rotation(rotation);
                let a = self.vector(a);
                core::array::from_fn(|k| a[0] * rows[0][k] + a[1] * rows[1][k] + a[2] * rows[2][k])
            }
            VectorNode::Normalize(a) => {
                let a = self.vector(a);
                let k = reciprocal(dot(a, a).sqrt());
                a.map(|c| k * c)
            }
            VectorNode::Perp(plane, a) => {
                let a = self.vector(a);
                let (from, towards) = plane.axes();
                let mut out = [0.0; 3];
                out[from] = -a[towards];
                out[towards] = a[from];
                out
            }
            VectorNode::Cross(a, b) => cross(self.vector(a), self.vector(b)),
            VectorNode::Across(a, u) => {
                let (a, u) = (self.vector(a), self.vector(u.into()));
                let along = dot(a, u);
                zip(a, u.map(|u| along * u), |a, b| a - b)
            }
            VectorNode::Solve(m, a) => {
                let ([x, y, z], a) = (m.columns.map(|column| self.vector(column)), self.vector(a));
                let normals = [cross(y, z), cross(z, x), cross(x, y)];
                let over = 1.0 / dot(x, normals[0]);
                core::array::from_fn(|k| {
                    let row = if m.transposed { normals.map(|normal| normal[k]) } else { normals[k] };
                    over * dot(row, a)
                })
            }
            VectorNode::Motion(..) => [0.0; 3],
            VectorNode::Imaginary(_, u, _) => self.vector(u),
        };
        self.vectors[vector.0 as usize] = Some(value);
        value
    }

    fn rotation(&mut self, rotation: Rotation) -> [[f64; 3]; 3] {
        if let Some(known) = self.rotations[rotation.0 as usize] {
            return known;
        }
        let rows = |entries: [f64; 9]| core::array::from_fn(|i| core::array::from_fn(|k| entries[3 * i + k]));
        let value = match self.g.rotation_node(rotation) {
            RotationNode::Matrix(entries) => rows(entries.map(|s| self.scalar(s))),
            RotationNode::Basis(entries) => rows(entries.map(crate::Constant::value)),
            RotationNode::Turn(plane, angle) => {
                let (sin, cos) = self.g.sin_cos(angle);
                let (sin, cos) = (self.scalar(sin), self.scalar(cos));
                let (from, towards) = plane.axes();
                let mut rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                rows[from][from] = cos;
                rows[from][towards] = sin;
                rows[towards][from] = -sin;
                rows[towards][towards] = cos;
                rows
            }
            RotationNode::About(axis, angle) => {
                let (sin, cos) = self.g.sin_cos(angle);
                let (axis, sin, cos) = (self.vector(axis), self.scalar(sin), self.scalar(cos));
                about(axis, [cos, sin, 1.0 - cos])
            }
            RotationNode::Quaternion(u, w) => {
                let (u, w) = (self.vector(u), self.scalar(w));
                about(u, [w * w - dot(u, u), 2.0 * w, 2.0])
            }
            RotationNode::Moving(motions) => match self.g.attitude_of(motions) {
                Attitude::Quaternion(u, w) => {
                    let (u, w) = (self.vector(u), self.scalar(w));
                    let over = reciprocal(dot(u, u) + w * w);
                    about(u, [1.0 - 2.0 * over * dot(u, u), 2.0 * over * w, 2.0 * over])
                }
                Attitude::Turn(v) => {
                    let v = self.vector(v);
                    about(v, [0, 1, 2].map(|order| Stumpff { hyperbolic: false, order }.value(dot(v, v))))
                }
            },
            RotationNode::Step(_) => axes(),
            RotationNode::Compose(outer, inner) => {
                let (outer, inner) = (self.rotation(outer), self.rotation(inner));
                core::array::from_fn(|i| core::array::from_fn(|k| (0..3).map(|j| inner[i][j] * outer[j][k]).sum()))
            }
            RotationNode::Transpose(inner) => {
                let inner = self.rotation(inner);
                core::array::from_fn(|i| core::array::from_fn(|k| inner[k][i]))
            }
        };
        self.rotations[rotation.0 as usize] = Some(value);
        value
    }
}
