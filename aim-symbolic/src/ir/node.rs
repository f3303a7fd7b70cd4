//! What expressions are made of: scalars, vectors, rotations, and the parts of each.

use crate::ir::op::{Constant, Op};
use crate::ir::smooth::Stumpff;

/// A scalar expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Scalar(pub(crate) u32);

/// A vector expression: a point or a direction of three-dimensional space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Vector(pub(crate) u32);

/// A vector of length 1: the type that a normalised vector has. Zero where its vector had no direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Unit(pub(crate) Vector);

impl From<Unit> for Vector {
    fn from(unit: Unit) -> Self {
        unit.0
    }
}

/// An orthogonal map of vectors. `R Rᵀ = 1` is all that the rules use, so a mirror is one too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rotation(pub(crate) u32);

/// A part of an expression that has a value of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Scalar(Scalar),
    /// A vector.
    Vector(Vector),
}

/// A rotation followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rigid {
    /// Its rotation.
    pub rotation: Rotation,
    /// Its translation.
    pub translation: Vector,
}

/// An angle: a variable that rotations turn by and gradients are taken in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Angle(pub(crate) u32);

/// The plane of a turn: the first axis turns towards the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane {
    /// The axis that turns (0, 1, 2).
    pub from: u8,
    /// The axis it turns towards (0, 1, 2).
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

/// What a scalar is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScalarNode {
    /// An operation on numbers.
    Op(Op<Scalar>),
    /// 1 / a, and 0 where a is not above [`Tiny`](Op::Tiny): the policy for degenerate geometry.
    Reciprocal(Scalar),
    /// v · w
    Dot(Vector, Vector),
    /// |v|
    Norm(Vector),
    /// A component of a vector.
    Component(Vector, u8),
    /// A component of a step: a number that is 0, and that derivatives are taken by.
    Step(u32),
    /// A Stumpff function of a square.
    Stumpff(Stumpff, Scalar),
    /// The derivative of this order of [`Graph::arc`](crate::Graph::arc) by its first argument, by D = 2 d/ds.
    Arc(u8, Scalar, Scalar),
}

/// What a vector is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VectorNode {
    /// Its components.
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
    /// v / |v|, and 0 where |v| is not above [`Op::Tiny`].
    Normalize(Vector),
    /// v's part in the plane, turned by a quarter: what a turn in that plane adds to v per radian.
    Perp(Plane, Vector),
    /// v × w
    Cross(Vector, Vector),
    /// v − (v · u) u: v's part across the direction u, which has length 1 (or 0).
    Across(Vector, Unit),
    /// M⁻¹ v: the vector that M takes to v.
    Solve(Matrix, Vector),
    /// 0, whose derivative is the angular velocity of a rotation: ω of Ṙ v = ω × R v in space, of Ṙ v = R (ω × v) in the
    /// body.
    Motion(Space, Attitude),
}

/// A matrix of three columns, or of three rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Matrix {
    /// Its columns; where it is transposed, its rows.
    pub columns: [Vector; 3],
    /// Whether these are rows.
    pub transposed: bool,
}

impl Matrix {
    /// The matrix with these columns.
    #[must_use]
    pub fn new(columns: [Vector; 3]) -> Self {
        Self { columns, transposed: false }
    }

    /// Its transpose.
    #[must_use]
    pub fn transpose(self) -> Self {
        Self { transposed: !self.transposed, ..self }
    }
}

/// Where an angular velocity is seen from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Space {
    /// The space that the rotation leads to.
    World,
    /// The space that it leads from.
    Body,
}

/// Numbers that a rotation is given by and that may vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Attitude {
    /// The vector part and the scalar part of a quaternion of any length but 0, which does not matter.
    Quaternion(Vector, Scalar),
    /// The vector that is turned about, by its length.
    Turn(Vector),
}

/// What a rotation is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RotationNode {
    /// Nine numbers, the rows of a row-vector matrix: row k is the image of axis k.
    Matrix([Scalar; 9]),
    /// The same with constant numbers: a change of basis.
    Basis([Constant; 9]),
    /// A turn in a plane of two axes.
    Turn(Plane, Angle),
    /// A right-handed turn about an axis of length 1.
    About(Vector, Angle),
    /// A quaternion of length 1: its vector part and its scalar part.
    Quaternion(Vector, Scalar),
    /// What an [`Attitude`] gives: its motions in the world and in the body.
    Moving([Vector; 2]),
    /// The right-handed turn by a step, about it and by its length: the identity, and what derivatives by a rotation are
    /// taken by.
    Step(Vector),
    /// The second, then the first.
    Compose(Rotation, Rotation),
    /// The way back.
    Transpose(Rotation),
}

/// A direction in the space of the variables, with components that are expressions: derivatives by it are along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Direction(pub(crate) u32);

/// What derivatives are taken by: an angle, a number of the caller's, or several of them at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    /// An angle whose sine and cosine are inputs.
    Angle(Angle),
    /// An input, or a component of a step.
    Input(Scalar),
    /// Along a direction: the sum of the derivatives by its variables, each times its component.
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

/// What an input of the program stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputKind {
    /// A number given by the caller.
    Given,
    /// The sine of an angle.
    Sin(Angle),
    /// The cosine of an angle.
    Cos(Angle),
}

/// Something done to each part of a node.
pub(crate) trait Parts {
    fn scalar(&mut self, scalar: Scalar) -> Scalar;
    fn vector(&mut self, vector: Vector) -> Vector;
    fn rotation(&mut self, rotation: Rotation) -> Rotation;
    fn angle(&mut self, angle: Angle) -> Angle;
}

impl ScalarNode {
    /// The node with its parts exchanged.
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
        }
    }
}

impl VectorNode {
    /// The node with its parts exchanged.
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
        }
    }
}

impl RotationNode {
    /// The node with its parts exchanged.
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
    /// The operation that the node is; `None` for what has to be lowered first: guarded reciprocals and what is made of
    /// vectors.
    pub(crate) fn op(self) -> Option<Op<Scalar>> {
        match self {
            Self::Op(op) => Some(op),
            _ => None,
        }
    }
}
