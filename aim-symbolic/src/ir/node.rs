//! Expression nodes: scalars, vectors and rotations, and the operands of each.

use crate::ir::op::{Constant, Op};
use crate::ir::smooth::Stumpff;

/// A scalar expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Scalar(pub(crate) u32);

/// A vector expression: a point or a direction of three-dimensional space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Vector(pub(crate) u32);

/// A vector of length 1: the type of a normalised vector. Zero if the normalised vector was too short to have a
/// direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Unit(pub(crate) Vector);

impl From<Unit> for Vector {
    fn from(unit: Unit) -> Self {
        unit.0
    }
}

/// An orthogonal map of vectors. The rules use only `R Rᵀ = 1`, so a reflection is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rotation(pub(crate) u32);

/// A part of an expression that has a value of its own: a scalar or a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Scalar(Scalar),
    /// A vector.
    Vector(Vector),
}

impl From<Scalar> for Node {
    fn from(scalar: Scalar) -> Self {
        Self::Scalar(scalar)
    }
}

impl From<Vector> for Node {
    fn from(vector: Vector) -> Self {
        Self::Vector(vector)
    }
}

impl From<Unit> for Node {
    fn from(unit: Unit) -> Self {
        Self::Vector(unit.0)
    }
}

/// A rotation followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rigid {
    /// The rotation, applied first.
    pub rotation: Rotation,
    /// The translation, applied second.
    pub translation: Vector,
}

/// An angle: a variable of rotations, by which derivatives can be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Angle(pub(crate) u32);

/// The plane of a rotation by an angle: the first axis turns towards the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane {
    /// The axis that is turned (0, 1, 2).
    pub from: u8,
    /// The axis towards which it is turned (0, 1, 2).
    pub towards: u8,
}

impl Plane {
    /// +X towards +Y.
    pub const XY: Self = Self { from: 0, towards: 1 };
    /// +X towards +Z.
    pub const XZ: Self = Self { from: 0, towards: 2 };
    /// +Y towards +Z.
    pub const YZ: Self = Self { from: 1, towards: 2 };

    pub(crate) fn axes(self) -> (usize, usize) {
        (self.from.into(), self.towards.into())
    }
}

/// The operation and operands of a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScalarNode {
    /// An operation on numbers.
    Op(Op<Scalar>),
    /// 1 / a, or 0 unless a > [`Tiny`](Op::Tiny): the policy for degenerate geometry.
    Reciprocal(Scalar),
    /// v · w
    Dot(Vector, Vector),
    /// |v|
    Norm(Vector),
    /// A component of a vector, by axis 0, 1 or 2.
    Component(Vector, u8),
    /// A component of a step: a variable that is 0 and by which derivatives are taken.
    Step(u32),
    /// A Stumpff function of r², see [`Graph::stumpff`](crate::Graph::stumpff).
    Stumpff(Stumpff, Scalar),
    /// The derivative of this order of [`Graph::arc`](crate::Graph::arc) by its first argument s, with D = 2 d/ds.
    Arc(u8, Scalar, Scalar),
    /// The scalar part w of the quaternion (u, w) of a rotation with this motion m, in the order m, u, w:
    /// ẇ = −½ ṁ · u.
    Real(Vector, Vector, Scalar),
}

/// The operation and operands of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VectorNode {
    /// A vector given by its components.
    Components([Scalar; 3]),
    /// v + w
    Add(Vector, Vector),
    /// v − w
    Sub(Vector, Vector),
    /// −v
    Neg(Vector),
    /// k v
    Scale(Scalar, Vector),
    /// R v
    Rotate(Rotation, Vector),
    /// v / |v|, or 0 unless |v| > [`Op::Tiny`].
    Normalize(Vector),
    /// v projected onto the plane and turned by 90°: the derivative of v by the angle of a rotation in that plane.
    Perp(Plane, Vector),
    /// v × w
    Cross(Vector, Vector),
    /// v − (v · u) u: the part of v perpendicular to the direction u, which has length 1 (or 0).
    Across(Vector, Unit),
    /// M⁻¹ v: the solution x of M x = v.
    Solve(Matrix, Vector),
    /// The infinitesimal rotation of an attitude. Its value is 0; its derivative is the angular velocity ω of the
    /// rotation, with Ṙ v = ω × R v in the world and Ṙ v = R (ω × v) in the body.
    Motion(Space, Attitude),
    /// The vector part u of the quaternion (u, w) of a rotation with this motion m in the world, in the order m, u, w:
    /// u̇ = ½ (w ṁ + ṁ × u).
    Imaginary(Vector, Vector, Scalar),
}

/// A 3×3 matrix, stored as columns or as rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Matrix {
    /// The columns, or the rows if `transposed`.
    pub columns: [Vector; 3],
    /// `true` if `columns` holds the rows.
    pub transposed: bool,
}

impl Matrix {
    /// The matrix with these columns.
    #[must_use]
    pub fn new(columns: [Vector; 3]) -> Self {
        Self { columns, transposed: false }
    }

    /// Returns the transpose.
    #[must_use]
    pub fn transpose(self) -> Self {
        Self { transposed: !self.transposed, ..self }
    }
}

/// The space in which an angular velocity is expressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Space {
    /// The space that the rotation maps to.
    World,
    /// The space that the rotation maps from.
    Body,
}

/// Variable numbers that define a rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Attitude {
    /// The vector part and the scalar part of a quaternion of any length but 0; the rotation does not depend on the
    /// length.
    Quaternion(Vector, Scalar),
    /// A rotation vector: the axis times the angle.
    Turn(Vector),
}

/// The operation and operands of a rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RotationNode {
    /// Nine numbers, the rows of a row-vector matrix: row k is the image of axis k.
    Matrix([Scalar; 9]),
    /// A constant row-vector matrix: a change of basis. Row k is the image of axis k.
    Basis([Constant; 9]),
    /// A rotation in the plane of two axes.
    Turn(Plane, Angle),
    /// A right-handed rotation about an axis of length 1.
    About(Vector, Angle),
    /// A quaternion of length 1: its vector part and its scalar part.
    Quaternion(Vector, Scalar),
    /// The rotation of an [`Attitude`], by its [motions](VectorNode::Motion) in the world and in the body.
    Moving([Vector; 2]),
    /// The right-handed rotation about a step by its length. Its value is the identity; it is the variable of
    /// derivatives by a rotation.
    Step(Vector),
    /// Composition: the second rotation is applied first.
    Compose(Rotation, Rotation),
    /// The inverse.
    Transpose(Rotation),
}

/// A direction in the space of the variables, whose components are expressions: the variable of directional
/// derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Direction(pub(crate) u32);

/// A variable of differentiation: an angle, an input, or a linear combination of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    /// An angle whose sine and cosine are inputs.
    Angle(Angle),
    /// An input that is not the sine or cosine of an angle, or a component of a step.
    Input(Scalar),
    /// A direction: the derivative is the sum of the derivatives by its variables, each times its component.
    Along(Direction),
}

impl From<Angle> for Variable {
    fn from(angle: Angle) -> Self {
        Self::Angle(angle)
    }
}

impl From<Scalar> for Variable {
    fn from(input: Scalar) -> Self {
        Self::Input(input)
    }
}

impl From<Direction> for Variable {
    fn from(direction: Direction) -> Self {
        Self::Along(direction)
    }
}

/// The meaning of a program's input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputKind {
    /// A number given by the caller.
    Given,
    /// The sine of an angle.
    Sin(Angle),
    /// The cosine of an angle.
    Cos(Angle),
}

/// A map over the operands of a node.
pub(crate) trait Parts {
    fn scalar(&mut self, scalar: Scalar) -> Scalar;
    fn vector(&mut self, vector: Vector) -> Vector;
    fn rotation(&mut self, rotation: Rotation) -> Rotation;
    fn angle(&mut self, angle: Angle) -> Angle;
}

impl ScalarNode {
    /// Returns the node with its operands mapped.
    pub(crate) fn map(self, parts: &mut impl Parts) -> Self {
        match self {
            Self::Op(op) => Self::Op(op.map(|s| parts.scalar(s))),
            Self::Reciprocal(a) => Self::Reciprocal(parts.scalar(a)),
            Self::Dot(v, w) => Self::Dot(parts.vector(v), parts.vector(w)),
            Self::Norm(v) => Self::Norm(parts.vector(v)),
            Self::Component(v, axis) => Self::Component(parts.vector(v), axis),
            Self::Step(_) => self,
            Self::Stumpff(stumpff, s) => Self::Stumpff(stumpff, parts.scalar(s)),
            Self::Arc(order, s, w) => Self::Arc(order, parts.scalar(s), parts.scalar(w)),
            Self::Real(m, u, w) => Self::Real(parts.vector(m), parts.vector(u), parts.scalar(w)),
        }
    }
}

impl VectorNode {
    /// Returns the node with its operands mapped.
    pub(crate) fn map(self, parts: &mut impl Parts) -> Self {
        match self {
            Self::Components(c) => Self::Components(c.map(|c| parts.scalar(c))),
            Self::Add(v, w) => Self::Add(parts.vector(v), parts.vector(w)),
            Self::Sub(v, w) => Self::Sub(parts.vector(v), parts.vector(w)),
            Self::Neg(v) => Self::Neg(parts.vector(v)),
            Self::Scale(k, v) => Self::Scale(parts.scalar(k), parts.vector(v)),
            Self::Rotate(rotation, v) => Self::Rotate(parts.rotation(rotation), parts.vector(v)),
            Self::Normalize(v) => Self::Normalize(parts.vector(v)),
            Self::Perp(plane, v) => Self::Perp(plane, parts.vector(v)),
            Self::Cross(v, w) => Self::Cross(parts.vector(v), parts.vector(w)),
            Self::Across(v, unit) => Self::Across(parts.vector(v), Unit(parts.vector(unit.0))),
            Self::Solve(m, v) => {
                let columns = m.columns.map(|column| parts.vector(column));
                Self::Solve(Matrix { columns, ..m }, parts.vector(v))
            }
            Self::Motion(space, Attitude::Quaternion(u, w)) => {
                Self::Motion(space, Attitude::Quaternion(parts.vector(u), parts.scalar(w)))
            }
            Self::Motion(space, Attitude::Turn(v)) => Self::Motion(space, Attitude::Turn(parts.vector(v))),
            Self::Imaginary(m, u, w) => Self::Imaginary(parts.vector(m), parts.vector(u), parts.scalar(w)),
        }
    }
}

impl RotationNode {
    /// Returns the node with its operands mapped.
    pub(crate) fn map(self, parts: &mut impl Parts) -> Self {
        match self {
            Self::Matrix(entries) => Self::Matrix(entries.map(|s| parts.scalar(s))),
            Self::Basis(_) => self,
            Self::Turn(plane, angle) => Self::Turn(plane, parts.angle(angle)),
            Self::About(axis, angle) => Self::About(parts.vector(axis), parts.angle(angle)),
            Self::Quaternion(v, w) => Self::Quaternion(parts.vector(v), parts.scalar(w)),
            Self::Moving(motions) => Self::Moving(motions.map(|v| parts.vector(v))),
            Self::Step(v) => Self::Step(parts.vector(v)),
            Self::Compose(outer, inner) => Self::Compose(parts.rotation(outer), parts.rotation(inner)),
            Self::Transpose(rotation) => Self::Transpose(parts.rotation(rotation)),
        }
    }
}

impl ScalarNode {
    /// Returns the node as an operation on numbers, or `None` if it has to be lowered first: guarded reciprocals and
    /// functions of vectors.
    pub(crate) fn op(self) -> Option<Op<Scalar>> {
        match self {
            Self::Op(op) => Some(op),
            _ => None,
        }
    }
}
