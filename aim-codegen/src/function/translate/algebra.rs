//! [`Algebra`]: the graph's constructors, with constants folded and angles brought to one form.

use std::collections::HashMap;

use aim_symbolic::{Function, Graph, Plane, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// The graph that a function's value is built in.
pub(crate) struct Algebra {
    pub(crate) g: Graph,
    /// The inputs that derivatives are taken by.
    variables: Vec<Scalar>,
    varies: HashMap<Node, bool>,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Node {
    Scalar(Scalar),
    Vector(Vector),
    Rotation(Rotation),
}

/// The planes of the right-handed turns about X, Y and Z.
const ABOUT: [Plane; 3] = [Plane::YZ, Plane { from: 2, towards: 0 }, Plane::XY];

impl Algebra {
    pub(crate) fn new() -> Self {
        Self { g: Graph::new(), variables: Vec::new(), varies: HashMap::new() }
    }

    /// Derivatives will be taken by this input. To be told before anything is built of it.
    pub(crate) fn differentiate_by(&mut self, input: Scalar) {
        self.variables.push(input);
    }

    // Scalars.

    pub(crate) fn number(&mut self, value: f64) -> Scalar {
        self.g.constant(value)
    }

    /// The number that `x` is, whatever the arguments.
    pub(crate) fn known(&self, x: Scalar) -> Option<f64> {
        match self.g.scalar_node(x) {
            ScalarNode::Constant(c) => Some(c.value()),
            _ => None,
        }
    }

    fn fold<const N: usize>(&mut self, operands: [Scalar; N], value: impl Fn([f64; N]) -> f64) -> Option<Scalar> {
        let mut known = [0.0; N];
        for (known, x) in known.iter_mut().zip(operands) {
            *known = self.known(x)?;
        }
        let value = value(known);
        value.is_finite().then(|| self.number(value))
    }

    pub(crate) fn add(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.fold([a, b], |[a, b]| a + b).unwrap_or_else(|| self.g.add(a, b))
    }

    pub(crate) fn sub(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.fold([a, b], |[a, b]| a - b).unwrap_or_else(|| self.g.sub(a, b))
    }

    /// a b; a number times a reciprocal is a division.
    pub(crate) fn mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        for (factor, reciprocal) in [(a, b), (b, a)] {
            if let ScalarNode::Div(one, divisor) = self.g.scalar_node(reciprocal) {
                if self.known(one) == Some(1.0) {
                    return self.div(factor, divisor);
                }
            }
        }
        self.fold([a, b], |[a, b]| a * b).unwrap_or_else(|| self.g.mul(a, b))
    }

    pub(crate) fn div(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.fold([a, b], |[a, b]| a / b).unwrap_or_else(|| self.g.div(a, b))
    }

    pub(crate) fn neg(&mut self, a: Scalar) -> Scalar {
        match self.g.scalar_node(a) {
            ScalarNode::Neg(inner) => inner,
            _ => self.fold([a], |[a]| -a).unwrap_or_else(|| self.g.neg(a)),
        }
    }

    /// √a; that of a vector's square is its length.
    pub(crate) fn sqrt(&mut self, a: Scalar) -> Scalar {
        if let ScalarNode::Dot(v, w) = self.g.scalar_node(a) {
            if v == w {
                return self.norm(v);
            }
        }
        self.fold([a], |[a]| a.sqrt()).unwrap_or_else(|| self.g.sqrt(a))
    }

    pub(crate) fn recip(&mut self, a: Scalar) -> Scalar {
        let one = self.number(1.0);
        self.div(one, a)
    }

    pub(crate) fn select_less(&mut self, a: Scalar, b: Scalar, then: Scalar, otherwise: Scalar) -> Scalar {
        match (self.known(a), self.known(b)) {
            (Some(x), Some(y)) => {
                if x < y {
                    then
                } else {
                    otherwise
                }
            }
            _ if then == otherwise => then,
            _ => self.g.select_less(a, b, then, otherwise),
        }
    }

    pub(crate) fn min(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.select_less(b, a, b, a)
    }

    pub(crate) fn max(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.select_less(a, b, b, a)
    }

    pub(crate) fn clamp(&mut self, x: Scalar, low: Scalar, high: Scalar) -> Scalar {
        let x = self.max(x, low);
        self.min(x, high)
    }

    pub(crate) fn abs(&mut self, a: Scalar) -> Scalar {
        let (zero, minus) = (self.number(0.0), self.neg(a));
        self.select_less(a, zero, minus, a)
    }

    pub(crate) fn signum(&mut self, a: Scalar) -> Scalar {
        let [zero, one, minus] = [0.0, 1.0, -1.0].map(|value| self.number(value));
        self.select_less(a, zero, minus, one)
    }

    /// x to a whole power: squares and products, shared.
    pub(crate) fn power(&mut self, x: Scalar, exponent: i32) -> Scalar {
        let power = self.unsigned_power(x, exponent.unsigned_abs());
        if exponent < 0 { self.recip(power) } else { power }
    }

    fn unsigned_power(&mut self, x: Scalar, exponent: u32) -> Scalar {
        match exponent {
            0 => self.number(1.0),
            1 => x,
            _ if exponent % 2 == 0 => {
                let root = self.unsigned_power(x, exponent / 2);
                self.mul(root, root)
            }
            _ => {
                let even = self.unsigned_power(x, exponent - 1);
                self.mul(even, x)
            }
        }
    }

    pub(crate) fn call(&mut self, function: Function, x: Scalar) -> Scalar {
        self.fold([x], |[x]| function.of(x)).unwrap_or_else(|| self.g.call(function, x))
    }

    pub(crate) fn atan2(&mut self, y: Scalar, x: Scalar) -> Scalar {
        self.fold([y, x], |[y, x]| y.atan2(x)).unwrap_or_else(|| self.g.atan2(y, x))
    }

    /// sin x and cos x, those of −x being the same but for a sign.
    pub(crate) fn sin_cos(&mut self, x: Scalar) -> (Scalar, Scalar) {
        let (negative, x) = self.unsigned_angle(x);
        let (sin, cos) = (self.call(Function::Sin, x), self.call(Function::Cos, x));
        (if negative { self.neg(sin) } else { sin }, cos)
    }

    /// The angle without its sign and with one factor in front: whether it had a sign, and the rest.
    fn unsigned_angle(&mut self, x: Scalar) -> (bool, Scalar) {
        let (mut factor, mut base) = (1.0, x);
        loop {
            base = match self.g.scalar_node(base) {
                ScalarNode::Neg(inner) => {
                    factor = -factor;
                    inner
                }
                ScalarNode::Mul(a, b) => match (self.known(a), self.known(b)) {
                    (Some(k), _) => {
                        factor *= k;
                        b
                    }
                    (None, Some(k)) => {
                        factor *= k;
                        a
                    }
                    (None, None) => break,
                },
                ScalarNode::Div(a, b) => match self.known(b) {
                    Some(k) if k != 0.0 => {
                        factor /= k;
                        a
                    }
                    _ => break,
                },
                ScalarNode::Constant(c) => {
                    let value = factor * c.value();
                    if !value.is_finite() {
                        return (false, x);
                    }
                    return (value < 0.0, self.number(value.abs()));
                }
                _ => break,
            };
        }
        if !f64::is_finite(factor) {
            return (false, x);
        }
        let size = factor.abs();
        let angle = if size == 1.0 {
            base
        } else {
            let size = self.number(size);
            self.mul(size, base)
        };
        (factor < 0.0, angle)
    }

    // Vectors.

    pub(crate) fn vector(&mut self, components: [Scalar; 3]) -> Vector {
        self.g.components(components)
    }

    pub(crate) fn known_vector(&self, v: Vector) -> Option<[f64; 3]> {
        match self.g.vector_node(v) {
            VectorNode::Components([x, y, z]) => Some([self.known(x)?, self.known(y)?, self.known(z)?]),
            _ => None,
        }
    }

    pub(crate) fn number_vector(&mut self, components: [f64; 3]) -> Vector {
        self.g.constant_vector(components)
    }

    pub(crate) fn axis(&mut self, axis: usize) -> Vector {
        let mut components = [0.0; 3];
        components[axis] = 1.0;
        self.number_vector(components)
    }

    fn fold_vectors<const N: usize>(
        &mut self,
        operands: [Vector; N],
        value: impl Fn([[f64; 3]; N]) -> [f64; 3],
    ) -> Option<Vector> {
        let mut known = [[0.0; 3]; N];
        for (known, v) in known.iter_mut().zip(operands) {
            *known = self.known_vector(v)?;
        }
        let value = value(known);
        value.iter().all(|c| c.is_finite()).then(|| self.number_vector(value))
    }

    pub(crate) fn component(&mut self, v: Vector, axis: usize) -> Scalar {
        match self.g.vector_node(v) {
            VectorNode::Components(components) => components[axis],
            _ => self.g.component(v, u8::try_from(axis).unwrap_or_default()),
        }
    }

    pub(crate) fn parts(&mut self, v: Vector) -> [Scalar; 3] {
        [0, 1, 2].map(|axis| self.component(v, axis))
    }

    /// Component by component.
    pub(crate) fn map(&mut self, v: Vector, of: impl Fn(&mut Self, Scalar) -> Scalar) -> Vector {
        let parts = self.parts(v);
        let parts = parts.map(|c| of(self, c));
        self.vector(parts)
    }

    /// Component by component of two.
    pub(crate) fn zip(&mut self, v: Vector, w: Vector, of: impl Fn(&mut Self, Scalar, Scalar) -> Scalar) -> Vector {
        let (v, w) = (self.parts(v), self.parts(w));
        let parts = [0, 1, 2].map(|k| of(self, v[k], w[k]));
        self.vector(parts)
    }

    pub(crate) fn add_vectors(&mut self, v: Vector, w: Vector) -> Vector {
        self.fold_vectors([v, w], |[v, w]| core::array::from_fn(|k| v[k] + w[k]))
            .unwrap_or_else(|| self.g.add_vectors(v, w))
    }

    pub(crate) fn sub_vectors(&mut self, v: Vector, w: Vector) -> Vector {
        self.fold_vectors([v, w], |[v, w]| core::array::from_fn(|k| v[k] - w[k]))
            .unwrap_or_else(|| self.g.sub_vectors(v, w))
    }

    pub(crate) fn neg_vector(&mut self, v: Vector) -> Vector {
        self.fold_vectors([v], |[v]| v.map(|c| -c)).unwrap_or_else(|| self.g.neg_vector(v))
    }

    pub(crate) fn scale(&mut self, k: Scalar, v: Vector) -> Vector {
        let known = self.known(k);
        known.and_then(|k| self.fold_vectors([v], |[v]| v.map(|c| k * c))).unwrap_or_else(|| self.g.scale(k, v))
    }

    pub(crate) fn cross(&mut self, v: Vector, w: Vector) -> Vector {
        self.fold_vectors([v, w], |[v, w]| {
            [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]
        })
        .unwrap_or_else(|| self.g.cross(v, w))
    }

    pub(crate) fn dot(&mut self, v: Vector, w: Vector) -> Scalar {
        match (self.known_vector(v), self.known_vector(w)) {
            (Some(v), Some(w)) => self.number(v[0] * w[0] + v[1] * w[1] + v[2] * w[2]),
            _ => self.g.dot(v, w),
        }
    }

    pub(crate) fn norm(&mut self, v: Vector) -> Scalar {
        match self.known_vector(v) {
            Some([x, y, z]) => self.number((x * x + y * y + z * z).sqrt()),
            None => self.g.norm(v),
        }
    }

    pub(crate) fn normalize(&mut self, v: Vector) -> Vector {
        let unit = |[v]: [[f64; 3]; 1]| {
            let norm = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
            v.map(|c| if norm > 0.0 { c / norm } else { 0.0 })
        };
        self.fold_vectors([v], unit).unwrap_or_else(|| self.g.normalize(v).into())
    }

    // Rotations.

    /// The right-handed turn about X, Y or Z.
    pub(crate) fn turn(&mut self, axis: usize, radians: Scalar) -> Rotation {
        let plane = ABOUT[axis];
        let (negative, radians) = self.unsigned_angle(radians);
        let rotation = match self.known(radians) {
            Some(radians) => {
                // A quarter turn is one, though its angle is no number that is stored exactly.
                let exact = |x: f64| if (x - x.round()).abs() < 1e-15 { x.round() } else { x };
                let (sin, cos) = (exact(radians.sin()), exact(radians.cos()));
                let (from, towards) = (usize::from(plane.from), usize::from(plane.towards));
                let mut images = IDENTITY;
                images[from][from] = cos;
                images[from][towards] = sin;
                images[towards][from] = -sin;
                images[towards][towards] = cos;
                self.g.basis(images)
            }
            None => {
                let angle = self.g.angle_of(radians);
                self.g.turn(plane, angle)
            }
        };
        if negative { self.g.transpose(rotation) } else { rotation }
    }

    /// The right-handed turn about an axis of length 1 that no variable moves.
    pub(crate) fn about(&mut self, axis: Vector, radians: Scalar) -> Rotation {
        let (negative, radians) = self.unsigned_angle(radians);
        let angle = self.g.angle_of(radians);
        let rotation = self.g.about(axis, angle);
        if negative { self.g.transpose(rotation) } else { rotation }
    }

    pub(crate) fn identity(&mut self) -> Rotation {
        self.g.basis(IDENTITY)
    }

    // What depends on the variables.

    pub(crate) fn scalar_varies(&mut self, x: Scalar) -> bool {
        if let Some(&known) = self.varies.get(&Node::Scalar(x)) {
            return known;
        }
        let varies = match self.g.scalar_node(x) {
            ScalarNode::Constant(_) | ScalarNode::Tiny => false,
            ScalarNode::Input(_) => self.variables.contains(&x),
            ScalarNode::Add(a, b)
            | ScalarNode::Sub(a, b)
            | ScalarNode::Mul(a, b)
            | ScalarNode::Div(a, b)
            | ScalarNode::Atan2(a, b) => self.scalar_varies(a) || self.scalar_varies(b),
            ScalarNode::Neg(a) | ScalarNode::Sqrt(a) | ScalarNode::Reciprocal(a) | ScalarNode::Call(_, a) => {
                self.scalar_varies(a)
            }
            ScalarNode::SelectLess(a, b, c, d) => [a, b, c, d].into_iter().any(|x| self.scalar_varies(x)),
            ScalarNode::Dot(v, w) => self.vector_varies(v) || self.vector_varies(w),
            ScalarNode::Norm(v) | ScalarNode::Component(v, _) => self.vector_varies(v),
        };
        self.varies.insert(Node::Scalar(x), varies);
        varies
    }

    pub(crate) fn vector_varies(&mut self, v: Vector) -> bool {
        if let Some(&known) = self.varies.get(&Node::Vector(v)) {
            return known;
        }
        let varies = match self.g.vector_node(v) {
            VectorNode::Components(components) => components.into_iter().any(|c| self.scalar_varies(c)),
            VectorNode::Add(v, w) | VectorNode::Sub(v, w) | VectorNode::Cross(v, w) => {
                self.vector_varies(v) || self.vector_varies(w)
            }
            VectorNode::Neg(v) | VectorNode::Normalize(v) | VectorNode::Perp(_, v) => self.vector_varies(v),
            VectorNode::Scale(k, v) => self.scalar_varies(k) || self.vector_varies(v),
            VectorNode::Rotate(rotation, v) => self.rotation_varies(rotation) || self.vector_varies(v),
            VectorNode::Across(v, unit) => self.vector_varies(v) || self.vector_varies(unit.into()),
        };
        self.varies.insert(Node::Vector(v), varies);
        varies
    }

    fn rotation_varies(&mut self, rotation: Rotation) -> bool {
        if let Some(&known) = self.varies.get(&Node::Rotation(rotation)) {
            return known;
        }
        let varies = match self.g.rotation_node(rotation) {
            // Their numbers are never those of a variable.
            RotationNode::Matrix(_) | RotationNode::Basis(_) | RotationNode::Quaternion(..) => false,
            RotationNode::Turn(_, angle) | RotationNode::About(_, angle) => {
                self.g.radians(angle).is_some_and(|radians| self.scalar_varies(radians))
            }
            RotationNode::Compose(outer, inner) => self.rotation_varies(outer) || self.rotation_varies(inner),
            RotationNode::Transpose(rotation) => self.rotation_varies(rotation),
        };
        self.varies.insert(Node::Rotation(rotation), varies);
        varies
    }
}

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
