//! The hash-consed graph: equal expressions are one node, so that sharing is found by construction.

use std::collections::HashMap;
use std::hash::Hash;

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

/// A finite constant, compared by its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Constant(u64);

impl Constant {
    /// `value`, with −0 made 0.
    pub fn new(value: f64) -> Self {
        Self((value + 0.0).to_bits())
    }

    /// Its value.
    pub fn value(self) -> f64 {
        f64::from_bits(self.0)
    }
}

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
    /// A number.
    Constant(Constant),
    /// The input with this index.
    Input(u32),
    /// The smallest length that is divided by, of the number type that the program runs in.
    Tiny,
    /// a + b
    Add(Scalar, Scalar),
    /// a − b
    Sub(Scalar, Scalar),
    /// a b
    Mul(Scalar, Scalar),
    /// a / b
    Div(Scalar, Scalar),
    /// −a
    Neg(Scalar),
    /// √a
    Sqrt(Scalar),
    /// 1 / a, and 0 where a is not above [`Tiny`](Self::Tiny): the policy for degenerate geometry.
    Reciprocal(Scalar),
    /// The third where the first is below the second, else the fourth.
    SelectLess(Scalar, Scalar, Scalar, Scalar),
    /// v · w
    Dot(Vector, Vector),
    /// |v|
    Norm(Vector),
    /// A component of a vector.
    Component(Vector, u8),
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
    /// v / |v|, and 0 where |v| is not above [`ScalarNode::Tiny`].
    Normalize(Vector),
    /// v's part in the plane, turned by a quarter: what a turn in that plane adds to v per radian.
    Perp(Plane, Vector),
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
    /// The second, then the first.
    Compose(Rotation, Rotation),
    /// The way back.
    Transpose(Rotation),
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

#[derive(Clone, Debug)]
struct Arena<N> {
    nodes: Vec<N>,
    index: HashMap<N, u32>,
}

impl<N: Copy + Eq + Hash> Arena<N> {
    fn new() -> Self {
        Self { nodes: Vec::new(), index: HashMap::new() }
    }

    fn intern(&mut self, node: N) -> u32 {
        let nodes = &mut self.nodes;
        *self.index.entry(node).or_insert_with(|| {
            nodes.push(node);
            u32::try_from(nodes.len() - 1).expect("a graph of four billion nodes does not fit in memory")
        })
    }
}

/// Expressions, each stored once.
///
/// The constructors state; they do not simplify. That is [`rewrite`](Self::rewrite)'s and the lowering's work.
#[derive(Clone, Debug)]
pub struct Graph {
    scalars: Arena<ScalarNode>,
    vectors: Arena<VectorNode>,
    rotations: Arena<RotationNode>,
    inputs: Vec<(String, InputKind)>,
    angles: Vec<(String, Scalar, Scalar)>,
}

impl Default for Graph {
    fn default() -> Self {
        Self::new()
    }
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self {
            scalars: Arena::new(),
            vectors: Arena::new(),
            rotations: Arena::new(),
            inputs: Vec::new(),
            angles: Vec::new(),
        }
    }

    /// What `scalar` is made of.
    pub fn scalar_node(&self, scalar: Scalar) -> ScalarNode {
        self.scalars.nodes[scalar.0 as usize]
    }

    /// What `vector` is made of.
    pub fn vector_node(&self, vector: Vector) -> VectorNode {
        self.vectors.nodes[vector.0 as usize]
    }

    /// What `rotation` is made of.
    pub fn rotation_node(&self, rotation: Rotation) -> RotationNode {
        self.rotations.nodes[rotation.0 as usize]
    }

    /// How many scalars, vectors and rotations there are.
    pub(crate) fn sizes(&self) -> [usize; 3] {
        [self.scalars.nodes.len(), self.vectors.nodes.len(), self.rotations.nodes.len()]
    }

    pub(crate) fn intern_scalar(&mut self, node: ScalarNode) -> Scalar {
        Scalar(self.scalars.intern(node))
    }

    pub(crate) fn intern_vector(&mut self, node: VectorNode) -> Vector {
        Vector(self.vectors.intern(node))
    }

    fn intern_rotation(&mut self, node: RotationNode) -> Rotation {
        Rotation(self.rotations.intern(node))
    }

    /// The inputs in order of their declaration.
    pub fn inputs(&self) -> &[(String, InputKind)] {
        &self.inputs
    }

    /// The name of an angle.
    pub fn angle_name(&self, angle: Angle) -> &str {
        &self.angles[angle.0 as usize].0
    }

    /// The inputs that stand for an angle's sine and cosine.
    pub fn sin_cos(&self, angle: Angle) -> (Scalar, Scalar) {
        let (_, sin, cos) = self.angles[angle.0 as usize];
        (sin, cos)
    }

    fn declare(&mut self, name: String, kind: InputKind) -> Scalar {
        let index = u32::try_from(self.inputs.len()).expect("four billion inputs do not fit in memory");
        self.inputs.push((name, kind));
        self.intern_scalar(ScalarNode::Input(index))
    }

    /// A number given by the caller.
    pub fn input(&mut self, name: &str) -> Scalar {
        self.declare(name.to_owned(), InputKind::Given)
    }

    /// An angle; its sine and its cosine become the next two inputs.
    pub fn angle(&mut self, name: &str) -> Angle {
        let angle = Angle(u32::try_from(self.angles.len()).expect("four billion angles do not fit in memory"));
        let sin = self.declare(format!("sin_{name}"), InputKind::Sin(angle));
        let cos = self.declare(format!("cos_{name}"), InputKind::Cos(angle));
        self.angles.push((name.to_owned(), sin, cos));
        angle
    }

    /// A vector of three inputs.
    pub fn vector_input(&mut self, name: &str) -> Vector {
        let components = ["x", "y", "z"].map(|axis| self.input(&format!("{name}_{axis}")));
        self.components(components)
    }

    /// A rotation of nine inputs, rows of the row-vector layout.
    pub fn rotation_input(&mut self, name: &str) -> Rotation {
        let entries = core::array::from_fn(|i| self.input(&format!("{name}_{}{}", i / 3, i % 3)));
        self.matrix(entries)
    }

    /// A rigid transform of twelve inputs: the rotation's rows, then the translation.
    pub fn rigid_input(&mut self, name: &str) -> Rigid {
        let rotation = self.rotation_input(name);
        let translation = self.vector_input(&format!("{name}_t"));
        Rigid { rotation, translation }
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> Scalar {
        self.intern_scalar(ScalarNode::Constant(Constant::new(value)))
    }

    /// a + b
    pub fn add(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Add(a, b))
    }

    /// a − b
    pub fn sub(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Sub(a, b))
    }

    /// a b
    pub fn mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Mul(a, b))
    }

    /// a / b
    pub fn div(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Div(a, b))
    }

    /// −a
    pub fn neg(&mut self, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Neg(a))
    }

    /// √a
    pub fn sqrt(&mut self, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Sqrt(a))
    }

    /// 1 / a, and 0 where a is not above the smallest length that is divided by.
    pub fn reciprocal(&mut self, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Reciprocal(a))
    }

    /// v · w
    pub fn dot(&mut self, v: impl Into<Vector>, w: impl Into<Vector>) -> Scalar {
        let (v, w) = (v.into(), w.into());
        self.intern_scalar(ScalarNode::Dot(v.min(w), v.max(w)))
    }

    /// |v|
    pub fn norm(&mut self, v: Vector) -> Scalar {
        self.intern_scalar(ScalarNode::Norm(v))
    }

    /// v's component on axis 0, 1 or 2.
    pub fn component(&mut self, v: Vector, axis: u8) -> Scalar {
        self.intern_scalar(ScalarNode::Component(v, axis))
    }

    /// The vector with these components.
    pub fn components(&mut self, components: [Scalar; 3]) -> Vector {
        self.intern_vector(VectorNode::Components(components))
    }

    /// A constant vector.
    pub fn constant_vector(&mut self, components: [f64; 3]) -> Vector {
        let components = components.map(|c| self.constant(c));
        self.components(components)
    }

    /// v + w
    pub fn add_vectors(&mut self, v: Vector, w: Vector) -> Vector {
        self.intern_vector(VectorNode::Add(v, w))
    }

    /// v − w
    pub fn sub_vectors(&mut self, v: Vector, w: Vector) -> Vector {
        self.intern_vector(VectorNode::Sub(v, w))
    }

    /// −v
    pub fn neg_vector(&mut self, v: Vector) -> Vector {
        self.intern_vector(VectorNode::Neg(v))
    }

    /// k v
    pub fn scale(&mut self, k: Scalar, v: Vector) -> Vector {
        self.intern_vector(VectorNode::Scale(k, v))
    }

    /// v / |v|, and 0 where that has no direction.
    pub fn normalize(&mut self, v: Vector) -> Unit {
        Unit(self.intern_vector(VectorNode::Normalize(v)))
    }

    /// v's part in the plane, turned by a quarter.
    pub fn perp(&mut self, plane: Plane, v: Vector) -> Vector {
        self.intern_vector(VectorNode::Perp(plane, v))
    }

    /// R v
    pub fn rotate(&mut self, rotation: Rotation, v: impl Into<Vector>) -> Vector {
        self.intern_vector(VectorNode::Rotate(rotation, v.into()))
    }

    /// The rotation with these rows in the row-vector layout. Whether they are orthogonal is the caller's business.
    pub fn matrix(&mut self, rows: [Scalar; 9]) -> Rotation {
        self.intern_rotation(RotationNode::Matrix(rows))
    }

    /// The change of basis that takes axis k to `images[k]`; the images must be unit and square to each other.
    pub fn basis(&mut self, images: [[f64; 3]; 3]) -> Rotation {
        let entries = core::array::from_fn(|i| Constant::new(images[i / 3][i % 3]));
        self.intern_rotation(RotationNode::Basis(entries))
    }

    /// The turn of `plane` by `angle`.
    pub fn turn(&mut self, plane: Plane, angle: Angle) -> Rotation {
        self.intern_rotation(RotationNode::Turn(plane, angle))
    }

    /// `inner`, then `outer`.
    pub fn compose(&mut self, outer: Rotation, inner: Rotation) -> Rotation {
        self.intern_rotation(RotationNode::Compose(outer, inner))
    }

    /// The way back.
    pub fn transpose(&mut self, rotation: Rotation) -> Rotation {
        if let RotationNode::Transpose(inner) = self.rotation_node(rotation) {
            return inner;
        }
        self.intern_rotation(RotationNode::Transpose(rotation))
    }

    /// `rotation` as a rigid transform about the origin.
    pub fn about_origin(&mut self, rotation: Rotation) -> Rigid {
        Rigid { rotation, translation: self.constant_vector([0.0; 3]) }
    }

    /// `inner`, then `outer`.
    pub fn compose_rigid(&mut self, outer: Rigid, inner: Rigid) -> Rigid {
        Rigid {
            rotation: self.compose(outer.rotation, inner.rotation),
            translation: self.transform_point(outer, inner.translation),
        }
    }

    /// The image of a point.
    pub fn transform_point(&mut self, rigid: Rigid, point: Vector) -> Vector {
        let rotated = self.rotate(rigid.rotation, point);
        self.add_vectors(rotated, rigid.translation)
    }

    pub(crate) fn constant_of(&self, scalar: Scalar) -> Option<f64> {
        match self.scalar_node(scalar) {
            ScalarNode::Constant(c) => Some(c.value()),
            _ => None,
        }
    }
}
