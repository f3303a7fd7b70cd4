//! Evaluation of typed expressions in f64, without lowering: the independent oracle of the tests.

use crate::{Angle, Graph, InputKind, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// Values for the inputs of a graph.
#[derive(Clone, Debug, Default)]
pub struct Bindings {
    inputs: Vec<f64>,
    angles: Vec<(Angle, f64)>,
}

impl Bindings {
    /// The given inputs in order of their declaration, without the sines and cosines, which follow from `angles`.
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

    /// One value an input, as [`Program::run`](crate::Program::run) takes them.
    pub fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// The same with one angle moved by `by` radians.
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

const TINY: f64 = 1.491_668_146_240_041_3e-154;

fn reciprocal(x: f64) -> f64 {
    if TINY < x { 1.0 / x } else { 0.0 }
}

fn dot(v: [f64; 3], w: [f64; 3]) -> f64 {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

impl Graph {
    /// The value of `scalar`.
    pub fn evaluate(&self, scalar: Scalar, bindings: &Bindings) -> f64 {
        let s = |s| self.evaluate(s, bindings);
        let v = |v| self.evaluate_vector(v, bindings);
        match self.scalar_node(scalar) {
            ScalarNode::Constant(c) => c.value(),
            ScalarNode::Input(i) => bindings.inputs.get(i as usize).copied().unwrap_or(0.0),
            ScalarNode::Tiny => TINY,
            ScalarNode::Add(a, b) => s(a) + s(b),
            ScalarNode::Sub(a, b) => s(a) - s(b),
            ScalarNode::Mul(a, b) => s(a) * s(b),
            ScalarNode::Div(a, b) => s(a) / s(b),
            ScalarNode::Neg(a) => -s(a),
            ScalarNode::Sqrt(a) => s(a).sqrt(),
            ScalarNode::Reciprocal(a) => reciprocal(s(a)),
            ScalarNode::SelectLess(a, b, then, otherwise) => {
                if s(a) < s(b) {
                    s(then)
                } else {
                    s(otherwise)
                }
            }
            ScalarNode::Dot(a, b) => dot(v(a), v(b)),
            ScalarNode::Norm(a) => dot(v(a), v(a)).sqrt(),
            ScalarNode::Component(a, axis) => v(a)[usize::from(axis)],
        }
    }

    /// The value of `vector`.
    pub fn evaluate_vector(&self, vector: Vector, bindings: &Bindings) -> [f64; 3] {
        let s = |s| self.evaluate(s, bindings);
        let v = |v| self.evaluate_vector(v, bindings);
        let zip = |a: [f64; 3], b: [f64; 3], f: fn(f64, f64) -> f64| core::array::from_fn(|k| f(a[k], b[k]));
        match self.vector_node(vector) {
            VectorNode::Components(c) => c.map(s),
            VectorNode::Add(a, b) => zip(v(a), v(b), |a, b| a + b),
            VectorNode::Sub(a, b) => zip(v(a), v(b), |a, b| a - b),
            VectorNode::Neg(a) => v(a).map(|c| -c),
            VectorNode::Scale(k, a) => {
                let k = s(k);
                v(a).map(|c| k * c)
            }
            VectorNode::Rotate(rotation, a) => {
                let rows = self.evaluate_rotation(rotation, bindings);
                let a = v(a);
                core::array::from_fn(|k| a[0] * rows[0][k] + a[1] * rows[1][k] + a[2] * rows[2][k])
            }
            VectorNode::Normalize(a) => {
                let a = v(a);
                let k = reciprocal(dot(a, a).sqrt());
                a.map(|c| k * c)
            }
            VectorNode::Perp(plane, a) => {
                let a = v(a);
                let (from, towards) = plane.axes();
                let mut out = [0.0; 3];
                out[from] = -a[towards];
                out[towards] = a[from];
                out
            }
        }
    }

    /// The rows of `rotation` in the row-vector layout.
    pub fn evaluate_rotation(&self, rotation: Rotation, bindings: &Bindings) -> [[f64; 3]; 3] {
        let rows = |entries: [f64; 9]| core::array::from_fn(|i| core::array::from_fn(|k| entries[3 * i + k]));
        match self.rotation_node(rotation) {
            RotationNode::Matrix(entries) => rows(entries.map(|s| self.evaluate(s, bindings))),
            RotationNode::Basis(entries) => rows(entries.map(crate::Constant::value)),
            RotationNode::Turn(plane, angle) => {
                let (sin, cos) = self.sin_cos(angle);
                let (sin, cos) = (self.evaluate(sin, bindings), self.evaluate(cos, bindings));
                let (from, towards) = plane.axes();
                let mut rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                rows[from][from] = cos;
                rows[from][towards] = sin;
                rows[towards][from] = -sin;
                rows[towards][towards] = cos;
                rows
            }
            RotationNode::Compose(outer, inner) => {
                let (outer, inner) = (self.evaluate_rotation(outer, bindings), self.evaluate_rotation(inner, bindings));
                core::array::from_fn(|i| core::array::from_fn(|k| (0..3).map(|j| inner[i][j] * outer[j][k]).sum()))
            }
            RotationNode::Transpose(inner) => {
                let inner = self.evaluate_rotation(inner, bindings);
                core::array::from_fn(|i| core::array::from_fn(|k| inner[k][i]))
            }
        }
    }
}
