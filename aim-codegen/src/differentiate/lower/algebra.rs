//! [`Algebra`]: the graph's constructors, with constant folding and angles in a canonical form.

use core::ops::{Deref, DerefMut};
use std::collections::HashMap;

use super::extra_inputs::{ExtraInput, KeptLoop};
use aim_symbolic::rules::{NEGATIONS, ORDER, Rules};
use aim_symbolic::{
    Bindings, Fold, Function, Graph, Node, Op, Plane, Rotation, Scalar, ScalarNode, Variable, Vector, VectorNode,
};

/// Graph in which a function's value is built, with constant folding.
pub(crate) struct Algebra {
    fold: Fold,
    /// Inputs that derivatives are taken with respect to.
    variables: Vec<Variable>,
    /// Smallest and largest value of each input that is a whole number.
    extents: HashMap<Scalar, (f64, f64)>,
    /// Inputs that are not numbers of arguments, in the order of declaration.
    pub(crate) extra_inputs: Vec<(ExtraInput, Scalar)>,
    /// Kept loops.
    pub(crate) loops: Vec<KeptLoop>,
    /// Constants that companions read, by their paths.
    pub(crate) constants: Vec<syn::Path>,
    /// Vectors that are taken to have length 1, as axes of rotations.
    pub(crate) unit_axes: Vec<Vector>,
    /// Vector parts of quaternions of length 1, by their scalar parts.
    pub(crate) unit_parts: HashMap<Scalar, Vector>,
}

impl Deref for Algebra {
    type Target = Fold;

    fn deref(&self) -> &Fold {
        &self.fold
    }
}

impl DerefMut for Algebra {
    fn deref_mut(&mut self) -> &mut Fold {
        &mut self.fold
    }
}

/// Planes of the right-handed rotations about X, Y and Z.
const ABOUT: [Plane; 3] = [Plane::YZ, Plane { from: 2, towards: 0 }, Plane::XY];

impl Algebra {
    /// Creates an empty graph. Signs and operand order stay as written; lowering normalises them.
    pub(crate) fn new() -> Self {
        let rules = Rules { without: &[NEGATIONS, ORDER], max_other_side: None };
        Self {
            fold: Fold::new(Graph::new(), &rules),
            variables: Vec::new(),
            extents: HashMap::new(),
            extra_inputs: Vec::new(),
            loops: Vec::new(),
            constants: Vec::new(),
            unit_axes: Vec::new(),
            unit_parts: HashMap::new(),
        }
    }

    /// Registers an input that derivatives are taken with respect to.
    pub(crate) fn differentiate_by(&mut self, input: Scalar) {
        self.variables.push(input.into());
    }

    /// Returns the input with this source, declaring it on first use.
    pub(crate) fn extra_input(&mut self, which: ExtraInput) -> Scalar {
        if let Some((_, input)) = self.extra_inputs.iter().find(|(known, _)| *known == which) {
            return *input;
        }
        let name = format!("outside_{}", self.extra_inputs.len());
        let input = self.g.input(&name);
        self.extra_inputs.push((which, input));
        if matches!(which, ExtraInput::Iteration(_)) {
            self.set_extent(input, 0.0, f64::INFINITY);
        }
        input
    }

    /// Returns the constants that companions read as numbers, and their inputs.
    pub(crate) fn constants(&self) -> impl Iterator<Item = (syn::Path, Scalar)> {
        self.extra_inputs.iter().filter_map(|&(which, input)| match which {
            ExtraInput::Constant(index) => Some((self.constants[index].clone(), input)),
            _ => None,
        })
    }

    /// Returns `x` after a cast to its own type: a constant that the companion reads is then of any type.
    pub(crate) fn cast_constant(&mut self, x: Scalar) -> Scalar {
        match self.extra_inputs.iter().find(|(_, input)| *input == x) {
            Some(&(ExtraInput::Constant(index), _)) => self.extra_input(ExtraInput::CastConstant(index)),
            _ => x,
        }
    }

    /// Declares that an input is a whole number from `least` to `most`.
    pub(crate) fn set_extent(&mut self, input: Scalar, least: f64, most: f64) {
        self.extents.insert(input, (least, most));
    }

    /// Returns the smallest and the largest value of an input; `None` if it is not a whole number.
    pub(super) fn extent_of_input(&self, input: Scalar) -> Option<(f64, f64)> {
        self.extents.get(&input).copied()
    }

    /// Returns `true` if the node depends on a variable that derivatives are taken with respect to.
    pub(crate) fn varies(&self, node: Node) -> bool {
        self.g.depends_on(node, &self.variables)
    }

    // Scalars.

    pub(crate) fn number(&mut self, value: f64) -> Scalar {
        self.g.constant(value)
    }

    /// Returns a b; a number times a reciprocal becomes a division.
    pub(crate) fn mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        for (factor, reciprocal) in [(a, b), (b, a)] {
            if let ScalarNode::Op(Op::Div(one, divisor)) = self.g.scalar_node(reciprocal) {
                if self.constant_of(one) == Some(1.0) {
                    return self.div(factor, divisor);
                }
            }
        }
        self.fold.mul(a, b)
    }

    /// Returns the value of a constant, or of a quotient of constants, which the graph does not fold.
    pub(crate) fn known(&self, x: Scalar) -> Option<f64> {
        match self.g.scalar_node(x) {
            ScalarNode::Op(Op::Div(a, b)) => Some(self.constant_of(a)? / self.constant_of(b)?),
            _ => self.constant_of(x),
        }
    }

    /// Applies a function to a number; the floor of a constant is folded.
    pub(crate) fn call(&mut self, function: Function, x: Scalar) -> Scalar {
        match (function, self.known(x)) {
            (Function::Floor, Some(known)) => self.number(known.floor()),
            _ => self.g.call(function, x),
        }
    }

    /// Returns √a; the root of v · v becomes |v|.
    pub(crate) fn sqrt(&mut self, a: Scalar) -> Scalar {
        if let ScalarNode::Dot(v, w) = self.g.scalar_node(a) {
            if v == w {
                return self.norm(v);
            }
        }
        self.fold.sqrt(a)
    }

    pub(crate) fn recip(&mut self, a: Scalar) -> Scalar {
        let one = self.number(1.0);
        self.div(one, a)
    }

    /// Returns x to a whole power, by shared squares and products.
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

    /// Returns x to a power; by squares, products and roots if the exponent is a known multiple of ½ of at most 16.
    pub(crate) fn pow(&mut self, x: Scalar, exponent: Scalar) -> Scalar {
        let doubled = self.constant_of(exponent).map(|exponent| 2.0 * exponent);
        let Some(doubled) = doubled.filter(|doubled| doubled.fract() == 0.0 && doubled.abs() <= 32.0) else {
            return self.g.pow(x, exponent);
        };
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and small")]
        let size = doubled.abs() as u32;
        let whole = self.unsigned_power(x, size / 2);
        let power = if size % 2 == 0 {
            whole
        } else {
            let root = self.sqrt(x);
            self.mul(whole, root)
        };
        if doubled < 0.0 { self.recip(power) } else { power }
    }

    pub(crate) fn atan2(&mut self, y: Scalar, x: Scalar) -> Scalar {
        match (self.constant_of(y), self.constant_of(x)) {
            (Some(y), Some(x)) => self.number(y.atan2(x)),
            _ => self.g.atan2(y, x),
        }
    }

    /// Returns sin x and cos x. The sign of x is split off, so that x and −x share their sine and cosine.
    pub(crate) fn sin_cos(&mut self, x: Scalar) -> (Scalar, Scalar) {
        let (negative, x) = self.unsigned_angle(x);
        let (sin, cos) = (self.call(Function::Sin, x), self.call(Function::Cos, x));
        (if negative { self.neg(sin) } else { sin }, cos)
    }

    /// Splits the sign off an angle and gathers constant factors in front. Returns `true` if there was a sign, and the
    /// rest.
    fn unsigned_angle(&mut self, x: Scalar) -> (bool, Scalar) {
        let (mut factor, mut base) = (1.0, x);
        loop {
            base = match self.g.scalar_node(base) {
                ScalarNode::Op(Op::Neg(inner)) => {
                    factor = -factor;
                    inner
                }
                ScalarNode::Op(Op::Mul(a, b)) => match (self.constant_of(a), self.constant_of(b)) {
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
                ScalarNode::Op(Op::Div(a, b)) => match self.constant_of(b) {
                    Some(k) if k != 0.0 => {
                        factor /= k;
                        a
                    }
                    _ => break,
                },
                ScalarNode::Op(Op::Constant(c)) => {
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

    pub(crate) fn number_vector(&mut self, components: [f64; 3]) -> Vector {
        self.g.constant_vector(components)
    }

    pub(crate) fn axis(&mut self, axis: usize) -> Vector {
        let mut components = [0.0; 3];
        components[axis] = 1.0;
        self.number_vector(components)
    }

    /// Returns the vector that `make` builds; folds its components if all its parts are constant.
    fn computed(&mut self, make: impl FnOnce(&mut Graph) -> Vector) -> Vector {
        let v = make(&mut self.g);
        let is_constant = |part| match part {
            Node::Scalar(s) => self.g.constant_of(s).is_some(),
            Node::Vector(v) => self.g.constant_vector_of(v).is_some(),
        };
        if !self.g.parts(Node::Vector(v)).into_iter().all(is_constant) {
            return v;
        }
        let value = self.g.evaluate_vector(v, &Bindings::default());
        if value.iter().all(|c| c.is_finite()) { self.g.constant_vector(value) } else { v }
    }

    pub(crate) fn component(&mut self, v: Vector, axis: usize) -> Scalar {
        match self.g.vector_node(v) {
            VectorNode::Components(components) => components[axis],
            VectorNode::Scale(k, inner) if self.g.constant_vector_of(inner).is_some() => {
                let component = self.component(inner, axis);
                self.mul(k, component)
            }
            _ => self.g.component(v, u8::try_from(axis).unwrap_or_default()),
        }
    }

    pub(crate) fn parts(&mut self, v: Vector) -> [Scalar; 3] {
        [0, 1, 2].map(|axis| self.component(v, axis))
    }

    /// Combines two vectors component by component.
    pub(crate) fn zip(&mut self, v: Vector, w: Vector, of: impl Fn(&mut Self, Scalar, Scalar) -> Scalar) -> Vector {
        let (v, w) = (self.parts(v), self.parts(w));
        let parts = [0, 1, 2].map(|k| of(self, v[k], w[k]));
        self.vector(parts)
    }

    pub(crate) fn add_vectors(&mut self, v: Vector, w: Vector) -> Vector {
        match (self.is_zero(v), self.is_zero(w)) {
            (true, _) => return w,
            (_, true) => return v,
            _ => {}
        }
        self.computed(|g| g.add_vectors(v, w))
    }

    /// Returns `true` for the constant zero vector, with which sums begin.
    fn is_zero(&self, v: Vector) -> bool {
        self.g.constant_vector_of(v) == Some([0.0; 3])
    }

    pub(crate) fn sub_vectors(&mut self, v: Vector, w: Vector) -> Vector {
        if self.is_zero(w) {
            return v;
        }
        self.computed(|g| g.sub_vectors(v, w))
    }

    pub(crate) fn neg_vector(&mut self, v: Vector) -> Vector {
        self.computed(|g| g.neg_vector(v))
    }

    pub(crate) fn scale(&mut self, k: Scalar, v: Vector) -> Vector {
        if self.constant_of(k) == Some(1.0) || self.is_zero(v) {
            return v;
        }
        self.computed(|g| g.scale(k, v))
    }

    pub(crate) fn cross(&mut self, v: Vector, w: Vector) -> Vector {
        self.computed(|g| g.cross(v, w))
    }

    pub(crate) fn dot(&mut self, v: Vector, w: Vector) -> Scalar {
        match (self.g.constant_vector_of(v), self.g.constant_vector_of(w)) {
            (Some(v), Some(w)) => self.number(v[0] * w[0] + v[1] * w[1] + v[2] * w[2]),
            _ => self.g.dot(v, w),
        }
    }

    pub(crate) fn norm(&mut self, v: Vector) -> Scalar {
        match self.g.constant_vector_of(v) {
            Some([x, y, z]) => self.number((x * x + y * y + z * z).sqrt()),
            None => self.g.norm(v),
        }
    }

    pub(crate) fn normalize(&mut self, v: Vector) -> Vector {
        let Some(known) = self.g.constant_vector_of(v) else { return self.g.normalize(v).into() };
        let norm = known.iter().map(|c| c * c).sum::<f64>().sqrt();
        self.number_vector(known.map(|c| if norm > 0.0 { c / norm } else { 0.0 }))
    }

    // Rotations.

    /// Returns the right-handed rotation about X, Y or Z.
    pub(crate) fn turn(&mut self, axis: usize, radians: Scalar) -> Rotation {
        let plane = ABOUT[axis];
        let (negative, radians) = self.unsigned_angle(radians);
        let rotation = match self.constant_of(radians) {
            Some(radians) => {
                // Make quarter turns exact: their angle has no exact floating-point representation.
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

    /// Returns the right-handed rotation about an axis of length 1 that does not depend on the variables.
    pub(crate) fn about(&mut self, axis: Vector, radians: Scalar) -> Rotation {
        self.unit_axes.push(axis);
        let (negative, radians) = self.unsigned_angle(radians);
        let angle = self.g.angle_of(radians);
        let rotation = self.g.about(axis, angle);
        if negative { self.g.transpose(rotation) } else { rotation }
    }

    pub(crate) fn identity(&mut self) -> Rotation {
        self.g.basis(IDENTITY)
    }
}

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
