//! Reference evaluation of expressions in any number type, written from the definitions, with matrices for all
//! rotations.
//!
//! Each expression is evaluated once and cached while the graph grows, since rewritten expressions share existing ones.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

use aim_symbolic::{
    Attitude, Function, Graph, Op, Plane, Rotation, RotationNode, Scalar, ScalarNode, Stumpff, Vector, VectorNode,
};

use super::dual::Oracle;

/// Hasher for keys that are a single number.
#[derive(Default)]
pub(crate) struct NumberHasher(u64);

impl Hasher for NumberHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u32(byte.into());
        }
    }

    fn write_u32(&mut self, number: u32) {
        self.0 = (self.0 ^ u64::from(number)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(20);
    }
}

type Cache<K, V> = HashMap<K, V, BuildHasherDefault<NumberHasher>>;

type Triple<T> = [T; 3];

/// Cached values of a graph's expressions at one point.
pub(crate) struct Evaluation<T> {
    inputs: Vec<T>,
    scalars: Cache<Scalar, T>,
    vectors: Cache<Vector, Triple<T>>,
    rotations: Cache<Rotation, Triple<Triple<T>>>,
    /// `true` after a division by a zero length, the root of 0, or a function without a slope.
    pub(crate) singular: bool,
    /// `true` after a rotation about an axis of length 0, whose meaning is undefined.
    pub(crate) no_axis: bool,
    /// `true` if a root does not behave like a length, or the square of a vector is no square in the field.
    pub(crate) no_length: bool,
    /// `true` if something treated as a constant has a derivative.
    pub(crate) frozen: bool,
}

fn cached<K: Hash + Eq, V: Copy>(map: &Cache<K, V>, key: K) -> Option<V> {
    map.get(&key).copied()
}

fn dot<T: Oracle>(v: Triple<T>, w: Triple<T>) -> T {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

fn cross<T: Oracle>(v: Triple<T>, w: Triple<T>) -> Triple<T> {
    [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]
}

fn times<T: Oracle>(k: T, v: Triple<T>) -> Triple<T> {
    v.map(|c| k * c)
}

fn plus<T: Oracle>(v: Triple<T>, w: Triple<T>) -> Triple<T> {
    [v[0] + w[0], v[1] + w[1], v[2] + w[2]]
}

fn minus<T: Oracle>(v: Triple<T>, w: Triple<T>) -> Triple<T> {
    [v[0] - w[0], v[1] - w[1], v[2] - w[2]]
}

/// Multiplies a row vector by a matrix.
fn image<T: Oracle>(v: Triple<T>, rows: Triple<Triple<T>>) -> Triple<T> {
    plus(plus(times(v[0], rows[0]), times(v[1], rows[1])), times(v[2], rows[2]))
}

fn rows<T: Copy>(entries: [T; 9]) -> Triple<Triple<T>> {
    core::array::from_fn(|i| core::array::from_fn(|k| entries[3 * i + k]))
}

fn identity<T: Oracle>() -> Triple<Triple<T>> {
    core::array::from_fn(|i| core::array::from_fn(|k| T::constant(f64::from(u8::from(i == k)))))
}

fn axes(plane: Plane) -> (usize, usize) {
    (plane.from.into(), plane.towards.into())
}

/// Returns the matrix of `v → a × v` for row vectors.
fn crossing<T: Oracle>(a: Triple<T>) -> Triple<Triple<T>> {
    identity().map(|axis| cross(a, axis))
}

/// Closed form: cos r, sin r / r, and higher orders by (1/k! − cₖ)/r².
fn stumpff<T: Oracle>(Stumpff { hyperbolic, order }: Stumpff, s: T) -> T {
    let r = s.sqrt();
    let mut k = order % 2;
    let mut value = match (hyperbolic, k) {
        (false, 0) => r.call(Function::Cos),
        (false, _) => r.call(Function::Sin) / r,
        (true, 0) => r.call(Function::Cosh),
        (true, _) => r.call(Function::Sinh) / r,
    };
    while k < order {
        let factorial: f64 = (1..=k).map(f64::from).product();
        value = (T::constant(1.0 / factorial) - value) / if hyperbolic { -s } else { s };
        k += 2;
    }
    value
}

/// atan2(r, w)/r and its derivatives by 2 d/d(r²), from s aⱼ₊₁ = w (−2)ʲ j!/(s + w²)ʲ⁺¹ − (2j + 1) aⱼ.
fn arc<T: Oracle>(order: u8, s: T, w: T) -> T {
    let r = s.sqrt();
    let q = s + w * w;
    let mut value = r.atan2(w) / r;
    let mut term = w / q;
    for j in 0..order {
        value = (term - T::constant(2.0 * f64::from(j) + 1.0) * value) / s;
        term = term * T::constant(-2.0 * (f64::from(j) + 1.0)) / q;
    }
    value
}

impl<T: Oracle> Evaluation<T> {
    pub(crate) fn new(inputs: Vec<T>) -> Self {
        let (scalars, vectors, rotations) = Default::default();
        Self { inputs, scalars, vectors, rotations, singular: false, no_axis: false, no_length: false, frozen: false }
    }

    pub(crate) fn inputs(&self) -> &[T] {
        &self.inputs
    }

    fn constant_part(&mut self, value: T) -> T {
        let (value, lost) = value.frozen();
        self.frozen |= lost;
        value
    }

    fn reciprocal(&mut self, length: T) -> T {
        self.singular |= length.is_zero();
        T::select_less(T::tiny(), length, T::constant(1.0) / length, T::constant(0.0))
    }

    fn root(&mut self, square: T) -> T {
        self.singular |= square.is_zero();
        let root = square.sqrt();
        self.no_length |= !root.is_length();
        root
    }

    pub(crate) fn scalar(&mut self, g: &Graph, scalar: Scalar) -> T {
        if let Some(value) = cached(&self.scalars, scalar) {
            return value;
        }
        let value = match g.scalar_node(scalar) {
            ScalarNode::Op(Op::Constant(c)) => T::constant(c.value()),
            ScalarNode::Op(Op::Input(i)) => self.inputs[i as usize],
            ScalarNode::Op(Op::Tiny) => T::tiny(),
            ScalarNode::Op(Op::Add(a, b)) => self.scalar(g, a) + self.scalar(g, b),
            ScalarNode::Op(Op::Sub(a, b)) => self.scalar(g, a) - self.scalar(g, b),
            ScalarNode::Op(Op::Mul(a, b)) => self.scalar(g, a) * self.scalar(g, b),
            ScalarNode::Op(Op::Div(a, b)) => self.scalar(g, a) / self.scalar(g, b),
            ScalarNode::Op(Op::Neg(a)) => -self.scalar(g, a),
            ScalarNode::Op(Op::Sqrt(a)) => {
                let square = self.scalar(g, a);
                self.root(square)
            }
            ScalarNode::Reciprocal(a) => {
                let length = self.scalar(g, a);
                self.reciprocal(length)
            }
            ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) => {
                let [a, b, then, otherwise] = [a, b, then, otherwise].map(|s| self.scalar(g, s));
                T::select_less(a, b, then, otherwise)
            }
            ScalarNode::Op(Op::Call(function, a)) => {
                let a = self.scalar(g, a);
                self.singular |= match function {
                    Function::Sin | Function::Cos | Function::Tan | Function::Exp => false,
                    Function::Sinh | Function::Cosh | Function::Tanh | Function::Floor => false,
                    Function::Asin | Function::Acos => (T::constant(1.0) - a * a).is_zero(),
                    Function::Ln => a.is_zero(),
                };
                let value = a.call(function);
                // The arc over its sine is a length.
                self.no_length |= function == Function::Asin && !(value * a).is_length();
                value
            }
            ScalarNode::Op(Op::Atan2(y, x)) => {
                let (y, x) = (self.scalar(g, y), self.scalar(g, x));
                self.singular |= (y * y + x * x).is_zero();
                // A fraction has a sign of its own.
                let value = y.atan2(x);
                self.no_length |= !(y * y).sqrt().is_length() || !(value * y).is_length();
                value
            }
            ScalarNode::Op(Op::Pow(a, b)) => {
                let (a, b) = (self.scalar(g, a), self.scalar(g, b));
                self.singular |= a.is_zero();
                a.pow(b)
            }
            ScalarNode::Dot(v, w) => {
                let product = dot(self.vector(g, v), self.vector(g, w));
                self.no_length |= v == w && !product.is_length();
                product
            }
            ScalarNode::Norm(v) => {
                let v = self.vector(g, v);
                self.root(dot(v, v))
            }
            ScalarNode::Component(v, axis) => self.vector(g, v)[usize::from(axis)],
            ScalarNode::Stumpff(function, s) => {
                let s = self.scalar(g, s);
                self.singular |= s.is_zero();
                stumpff(function, s)
            }
            ScalarNode::Arc(order, s, w) => {
                let (s, w) = (self.scalar(g, s), self.scalar(g, w));
                self.singular |= s.is_zero();
                arc(order, s, w)
            }
            ScalarNode::Real(_, _, w) => self.scalar(g, w),
            // If the point moves with a step, its components follow the inputs.
            ScalarNode::Step(component) => {
                let place = g.inputs().len() + component as usize;
                self.inputs.get(place).copied().unwrap_or_else(|| T::constant(0.0))
            }
        };
        self.scalars.insert(scalar, value);
        value
    }

    fn vector(&mut self, g: &Graph, vector: Vector) -> Triple<T> {
        if let Some(value) = cached(&self.vectors, vector) {
            return value;
        }
        let value = match g.vector_node(vector) {
            VectorNode::Components(c) => c.map(|c| self.scalar(g, c)),
            VectorNode::Add(v, w) => plus(self.vector(g, v), self.vector(g, w)),
            VectorNode::Sub(v, w) => minus(self.vector(g, v), self.vector(g, w)),
            VectorNode::Neg(v) => self.vector(g, v).map(|c| -c),
            VectorNode::Scale(k, v) => times(self.scalar(g, k), self.vector(g, v)),
            VectorNode::Rotate(rotation, v) => {
                let rows = self.rotation(g, rotation);
                image(self.vector(g, v), rows)
            }
            VectorNode::Normalize(v) => {
                let v = self.vector(g, v);
                let length = self.root(dot(v, v));
                times(self.reciprocal(length), v)
            }
            VectorNode::Perp(plane, v) => {
                let v = self.vector(g, v);
                let (from, towards) = axes(plane);
                let mut perp = [T::constant(0.0); 3];
                perp[towards] = v[from];
                perp[from] = -v[towards];
                perp
            }
            VectorNode::Cross(v, w) => cross(self.vector(g, v), self.vector(g, w)),
            VectorNode::Across(v, unit) => {
                let (v, unit) = (self.vector(g, v), self.vector(g, unit.into()));
                minus(v, times(dot(v, unit), unit))
            }
            VectorNode::Solve(m, v) => {
                let columns = m.columns.map(|column| self.vector(g, column));
                let columns = if m.transposed { [0, 1, 2].map(|k| columns.map(|c| c[k])) } else { columns };
                let v = self.vector(g, v);
                let determinant = |[x, y, z]: Triple<Triple<T>>| dot(x, cross(y, z));
                let whole = determinant(columns);
                self.singular |= whole.is_zero();
                [0, 1, 2].map(|k| {
                    let mut replaced = columns;
                    replaced[k] = v;
                    determinant(replaced) / whole
                })
            }
            VectorNode::Motion(..) => [T::constant(0.0); 3],
            VectorNode::Imaginary(_, u, _) => self.vector(g, u),
        };
        self.vectors.insert(vector, value);
        value
    }

    fn rotation(&mut self, g: &Graph, rotation: Rotation) -> Triple<Triple<T>> {
        if let Some(value) = cached(&self.rotations, rotation) {
            return value;
        }
        let value = match g.rotation_node(rotation) {
            RotationNode::Matrix(entries) => rows(entries.map(|s| {
                let entry = self.scalar(g, s);
                self.constant_part(entry)
            })),
            RotationNode::Basis(entries) => rows(entries.map(|c| T::constant(c.value()))),
            RotationNode::Turn(plane, angle) => {
                let (sin, cos) = g.sin_cos(angle);
                let (sin, cos) = (self.scalar(g, sin), self.scalar(g, cos));
                let (from, towards) = axes(plane);
                let mut rows = identity();
                (rows[from][from], rows[from][towards]) = (cos, sin);
                (rows[towards][from], rows[towards][towards]) = (-sin, cos);
                rows
            }
            RotationNode::About(axis, angle) => {
                // 1 + sin K + (1 − cos) K², where K maps v to axis × v.
                let (sin, cos) = g.sin_cos(angle);
                let (sin, cos) = (self.scalar(g, sin), self.scalar(g, cos));
                let axis = self.vector(g, axis).map(|c| self.constant_part(c));
                self.no_axis |= dot(axis, axis).is_zero();
                let crossing = crossing(axis);
                let twice = crossing.map(|row| image(row, crossing));
                let versine = T::constant(1.0) - cos;
                let one = identity();
                core::array::from_fn(|i| plus(one[i], plus(times(sin, crossing[i]), times(versine, twice[i]))))
            }
            RotationNode::Quaternion(u, w) => {
                let [x, y, z] = self.vector(g, u).map(|c| self.constant_part(c));
                let w = self.scalar(g, w);
                let w = self.constant_part(w);
                let (one, two) = (T::constant(1.0), T::constant(2.0));
                [
                    [one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)],
                    [two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)],
                    [two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)],
                ]
            }
            RotationNode::Moving(motions) => match g.attitude_of(motions) {
                Attitude::Quaternion(u, w) => {
                    // 1 + 2 (w K + K²)/(w² + u²), where K maps v to u × v; the identity for a quaternion of length 0.
                    let (u, w) = (self.vector(g, u), self.scalar(g, w));
                    let twice = T::constant(2.0) * self.reciprocal(w * w + dot(u, u));
                    let (one, crossing) = (identity(), crossing(u));
                    core::array::from_fn(|i| {
                        let turned = plus(times(w, crossing[i]), image(crossing[i], crossing));
                        plus(one[i], times(twice, turned))
                    })
                }
                Attitude::Turn(v) => {
                    let v = self.vector(g, v);
                    let square = dot(v, v);
                    self.singular |= square.is_zero();
                    let factor = |order| stumpff(Stumpff { hyperbolic: false, order }, square);
                    let (one, crossing) = (identity(), crossing(v));
                    core::array::from_fn(|i| {
                        let kept = plus(times(factor(0), one[i]), times(factor(1), crossing[i]));
                        plus(kept, times(factor(2) * v[i], v))
                    })
                }
            },
            RotationNode::Step(step) => {
                // 1 + K + ½ K², where K maps v to step × v: the exponential up to second order, exact for derivatives
                // at a step of 0.
                let step = self.vector(g, step);
                let crossing = crossing(step);
                let twice = crossing.map(|row| image(row, crossing));
                let one = identity();
                core::array::from_fn(|i| plus(one[i], plus(crossing[i], times(T::constant(0.5), twice[i]))))
            }
            RotationNode::Compose(outer, inner) => {
                let (outer, inner) = (self.rotation(g, outer), self.rotation(g, inner));
                inner.map(|row| image(row, outer))
            }
            RotationNode::Transpose(inner) => {
                let rows = self.rotation(g, inner);
                core::array::from_fn(|i| core::array::from_fn(|k| rows[k][i]))
            }
        };
        self.rotations.insert(rotation, value);
        value
    }
}
