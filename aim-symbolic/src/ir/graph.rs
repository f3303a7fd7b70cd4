//! The hash-consed graph: equal expressions are one node, so that common subexpressions are shared by construction.

pub(crate) mod prune;

use std::hash::Hash;

use rustc_hash::FxHashMap;

use crate::ir::node::{
    Angle, Attitude, Direction, InputKind, Matrix, Plane, Rigid, Rotation, RotationNode, Scalar, ScalarNode, Space,
    Unit, Variable, Vector, VectorNode,
};
use crate::ir::op::{Constant, Function, Op};
use crate::ir::smooth::Stumpff;
use crate::ir::table::Table;

/// Limit on the number of factors of a rotation that are taken one by one if most of them repeat others.
const MOST_REPEATED: usize = 16;

#[derive(Clone, Debug)]
struct Arena<N> {
    nodes: Vec<N>,
    index: FxHashMap<N, u32>,
}

impl<N: Copy + Eq + Hash> Arena<N> {
    fn new() -> Self {
        Self { nodes: Vec::new(), index: FxHashMap::default() }
    }

    fn intern(&mut self, node: N) -> u32 {
        let nodes = &mut self.nodes;
        *self.index.entry(node).or_insert_with(|| {
            nodes.push(node);
            u32::try_from(nodes.len() - 1).expect("a graph of four billion nodes does not fit in memory")
        })
    }
}

/// An expression graph in which equal expressions are stored once.
///
/// The constructors build nodes as stated and do not simplify; [`rewrite`](Self::rewrite) and the lowering do.
#[derive(Clone, Debug)]
pub struct Graph {
    scalars: Arena<ScalarNode>,
    vectors: Arena<VectorNode>,
    rotations: Arena<RotationNode>,
    inputs: Vec<(String, InputKind)>,
    angles: Vec<AngleEntry>,
    /// The angles of [`angle_of`](Graph::angle_of), by their expressions in radians.
    angles_of: Table<Scalar, Angle>,
    directions: Vec<Vec<(Variable, Scalar)>>,
    /// The total number of components of steps.
    steps: u32,
    /// Vectors that are used more than once and that the rules of the current pass may not take apart.
    closed: Table<Vector, ()>,
    /// Rotations whose inner frame the calculation should move to; see [`set_inner_frames`](Graph::set_inner_frames).
    inner_frames: Vec<Rotation>,
    /// Rotations that cancelled between a direction and the other side of a dot product, in order, with repetitions.
    cancelled: Vec<Rotation>,
}

#[derive(Clone, Debug)]
struct AngleEntry {
    name: String,
    sin: Scalar,
    cos: Scalar,
    /// The expression in radians; `None` if the sine and cosine are inputs.
    radians: Option<Scalar>,
    /// The angle of which this is the sum with a constant.
    shifted: Option<Angle>,
}

impl Default for Graph {
    fn default() -> Self {
        Self::new()
    }
}

impl Graph {
    /// Creates an empty graph.
    #[must_use]
    pub fn new() -> Self {
        Self {
            scalars: Arena::new(),
            vectors: Arena::new(),
            rotations: Arena::new(),
            inputs: Vec::new(),
            angles: Vec::new(),
            angles_of: Table::default(),
            directions: Vec::new(),
            steps: 0,
            closed: Table::default(),
            inner_frames: Vec::new(),
            cancelled: Vec::new(),
        }
    }

    /// Returns the operation and operands of `scalar`.
    #[must_use]
    pub fn scalar_node(&self, scalar: Scalar) -> ScalarNode {
        self.scalars.nodes[scalar.0 as usize]
    }

    /// Returns the operation and operands of `vector`.
    #[must_use]
    pub fn vector_node(&self, vector: Vector) -> VectorNode {
        self.vectors.nodes[vector.0 as usize]
    }

    /// Returns the operation and operands of `rotation`.
    #[must_use]
    pub fn rotation_node(&self, rotation: Rotation) -> RotationNode {
        self.rotations.nodes[rotation.0 as usize]
    }

    /// Returns the number of nodes.
    #[expect(clippy::len_without_is_empty, reason = "an empty graph is of no interest")]
    #[must_use]
    pub fn len(&self) -> usize {
        self.sizes().iter().sum()
    }

    /// Returns the numbers of scalars, vectors and rotations.
    pub(crate) fn sizes(&self) -> [usize; 3] {
        [self.scalars.nodes.len(), self.vectors.nodes.len(), self.rotations.nodes.len()]
    }

    pub(crate) fn intern_scalar(&mut self, node: ScalarNode) -> Scalar {
        Scalar(self.scalars.intern(node))
    }

    pub(crate) fn intern_vector(&mut self, node: VectorNode) -> Vector {
        Vector(self.vectors.intern(node))
    }

    /// Looks up an existing difference v − w.
    pub(crate) fn known_difference(&self, v: Vector, w: Vector) -> Option<Vector> {
        self.vectors.index.get(&VectorNode::Sub(v, w)).map(|&place| Vector(place))
    }

    /// Looks up an existing cross product of the two vectors in either order. The flag is `true` if the order is w × v.
    pub(crate) fn known_cross(&self, v: Vector, w: Vector) -> Option<(Vector, bool)> {
        let known = |v, w| self.vectors.index.get(&VectorNode::Cross(v, w)).map(|&place| Vector(place));
        known(v, w).map(|cross| (cross, false)).or_else(|| known(w, v).map(|cross| (cross, true)))
    }

    /// Stores a node that a pass has built from other nodes, in the form that the constructors give it.
    pub(crate) fn remade_scalar(&mut self, node: ScalarNode) -> Scalar {
        match node {
            ScalarNode::Dot(v, w) => self.dot(v, w),
            node => self.intern_scalar(node),
        }
    }

    pub(crate) fn remade_rotation(&mut self, node: RotationNode) -> Rotation {
        match node {
            RotationNode::Transpose(rotation) => self.transpose(rotation),
            node => self.intern_rotation(node),
        }
    }

    fn intern_rotation(&mut self, node: RotationNode) -> Rotation {
        Rotation(self.rotations.intern(node))
    }

    pub(crate) fn is_closed(&self, sum: Vector) -> bool {
        self.closed.contains(sum)
    }

    pub(crate) fn close(&mut self, sum: Vector) {
        self.closed.insert(sum, ());
    }

    /// Sets the rotations to whose inner frame [`FRAMES`](crate::rewrite::rules::FRAMES) moves calculations from now
    /// on.
    pub fn set_inner_frames(&mut self, rotations: &[Rotation]) {
        self.inner_frames = rotations.to_vec();
        self.cancelled.clear();
    }

    pub(crate) fn is_inner_frame(&self, rotation: Rotation) -> bool {
        self.inner_frames.contains(&rotation)
    }

    pub(crate) fn cancel(&mut self, rotation: Rotation) {
        self.cancelled.push(rotation);
    }

    /// Returns the rotations that cancelled between a direction and the other side of a dot product since
    /// [`set_inner_frames`](Self::set_inner_frames), with repetitions.
    pub(crate) fn cancelled(&self) -> &[Rotation] {
        &self.cancelled
    }

    pub(crate) fn open_all(&mut self) {
        self.closed = Table::default();
    }

    /// Returns the inputs in order of declaration.
    #[must_use]
    pub fn inputs(&self) -> &[(String, InputKind)] {
        &self.inputs
    }

    /// Returns the name of an angle.
    #[must_use]
    pub fn angle_name(&self, angle: Angle) -> &str {
        &self.angles[angle.0 as usize].name
    }

    /// Returns an angle's sine and cosine: inputs, or functions of the angle's expression in radians.
    #[must_use]
    pub fn sin_cos(&self, angle: Angle) -> (Scalar, Scalar) {
        let AngleEntry { sin, cos, .. } = self.angles[angle.0 as usize];
        (sin, cos)
    }

    /// Returns an angle's expression in radians, or `None` if its sine and cosine are inputs.
    #[must_use]
    pub fn radians(&self, angle: Angle) -> Option<Scalar> {
        self.angles[angle.0 as usize].radians
    }

    fn declare(&mut self, name: String, kind: InputKind) -> Scalar {
        let index = u32::try_from(self.inputs.len()).expect("four billion inputs do not fit in memory");
        self.inputs.push((name, kind));
        self.intern_scalar(ScalarNode::Op(Op::Input(index)))
    }

    /// Declares an input: a number given by the caller.
    pub fn input(&mut self, name: &str) -> Scalar {
        self.declare(name.to_owned(), InputKind::Given)
    }

    fn next_angle(&self) -> Angle {
        Angle(u32::try_from(self.angles.len()).expect("four billion angles do not fit in memory"))
    }

    /// Declares an angle; its sine and its cosine become the next two inputs.
    pub fn angle(&mut self, name: &str) -> Angle {
        let angle = self.next_angle();
        let sin = self.declare(format!("sin_{name}"), InputKind::Sin(angle));
        let cos = self.declare(format!("cos_{name}"), InputKind::Cos(angle));
        self.angles.push(AngleEntry { name: name.to_owned(), sin, cos, radians: None, shifted: None });
        angle
    }

    /// Returns the angle with this value in radians, for rotations by an expression.
    pub fn angle_of(&mut self, radians: Scalar) -> Angle {
        if let Some(&known) = self.angles_of.get(radians) {
            return known;
        }
        let angle = self.next_angle();
        let (sin, cos) = (self.call(Function::Sin, radians), self.call(Function::Cos, radians));
        self.angles.push(AngleEntry { name: format!("a{}", angle.0), sin, cos, radians: Some(radians), shifted: None });
        self.angles_of.insert(radians, angle);
        angle
    }

    /// Returns the sum of `angle` and a constant angle with this sine and cosine.
    pub(crate) fn shifted_angle(&mut self, angle: Angle, [sine, cosine]: [f64; 2]) -> Angle {
        if let Some(radians) = self.radians(angle) {
            let shift = self.constant(sine.atan2(cosine));
            let sum = self.add(radians, shift);
            return self.angle_of(sum);
        }
        let ((sin, cos), [sine, cosine]) = (self.sin_cos(angle), [sine, cosine].map(|c| self.constant(c)));
        let [sin_cosine, cos_sine] = [self.mul(cosine, sin), self.mul(sine, cos)];
        let [cos_cosine, sin_sine] = [self.mul(cosine, cos), self.mul(sine, sin)];
        let (sin, cos) = (self.add(sin_cosine, cos_sine), self.sub(cos_cosine, sin_sine));
        let base = self.unshifted(angle);
        if let Some(known) = self.angles.iter().position(|a| (a.sin, a.cos, a.shifted) == (sin, cos, Some(base))) {
            return Angle(u32::try_from(known).unwrap_or_default());
        }
        let shifted = self.next_angle();
        self.angles.push(AngleEntry { name: format!("a{}", shifted.0), sin, cos, radians: None, shifted: Some(base) });
        shifted
    }

    /// Returns the angle without the constant that was added to it. Both have the same derivatives.
    pub(crate) fn unshifted(&self, angle: Angle) -> Angle {
        self.angles[angle.0 as usize].shifted.unwrap_or(angle)
    }

    /// Creates a direction with these components along inputs and angles. Derivatives treat the components as
    /// constants.
    pub fn direction(&mut self, components: &[(Variable, Scalar)]) -> Direction {
        let direction = Direction(u32::try_from(self.directions.len()).expect("directions fit in memory"));
        self.directions.push(components.to_vec());
        direction
    }

    /// Returns the components of a direction.
    #[must_use]
    pub fn direction_components(&self, direction: Direction) -> &[(Variable, Scalar)] {
        &self.directions[direction.0 as usize]
    }

    /// Returns a variable's components: those of a direction, or the variable itself with component `None`, which
    /// stands for 1.
    pub(crate) fn components_of(&self, variable: Variable) -> Vec<(Variable, Option<Scalar>)> {
        match variable {
            Variable::Along(direction) => {
                self.direction_components(direction).iter().map(|&(variable, k)| (variable, Some(k))).collect()
            }
            _ => vec![(variable, None)],
        }
    }

    /// Creates a step: a vector variable whose value is 0, by whose components derivatives can be taken.
    pub fn step(&mut self) -> Vector {
        let components = [0, 1, 2].map(|axis| self.intern_scalar(ScalarNode::Step(self.steps + axis)));
        self.steps += 3;
        self.components(components)
    }

    /// Returns the total number of components of all steps.
    #[must_use]
    pub fn step_components(&self) -> usize {
        self.steps as usize
    }

    /// Declares a vector of three inputs.
    pub fn vector_input(&mut self, name: &str) -> Vector {
        let components = ["x", "y", "z"].map(|axis| self.input(&format!("{name}_{axis}")));
        self.components(components)
    }

    /// Declares a rotation of nine inputs, the rows of the row-vector layout.
    pub fn rotation_input(&mut self, name: &str) -> Rotation {
        let entries = core::array::from_fn(|i| self.input(&format!("{name}_{}{}", i / 3, i % 3)));
        self.matrix(entries)
    }

    /// Declares a rigid transform of twelve inputs: the rotation's rows, then the translation.
    pub fn rigid_input(&mut self, name: &str) -> Rigid {
        let rotation = self.rotation_input(name);
        let translation = self.vector_input(&format!("{name}_t"));
        Rigid { rotation, translation }
    }

    /// A constant number.
    pub fn constant(&mut self, value: f64) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Constant(Constant::new(value))))
    }

    /// a + b
    pub fn add(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Add(a, b)))
    }

    /// a − b
    pub fn sub(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Sub(a, b)))
    }

    /// a b
    pub fn mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Mul(a, b)))
    }

    /// a / b
    pub fn div(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Div(a, b)))
    }

    /// −a
    pub fn neg(&mut self, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Neg(a)))
    }

    /// √a
    pub fn sqrt(&mut self, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Sqrt(a)))
    }

    /// 1 / a, or 0 unless a is greater than the smallest length by which a guarded division divides, [`Op::Tiny`].
    pub fn reciprocal(&mut self, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Reciprocal(a))
    }

    /// `then` where `a < b`, else `otherwise`.
    pub fn select_less(&mut self, a: Scalar, b: Scalar, then: Scalar, otherwise: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)))
    }

    /// A function of `a`.
    pub fn call(&mut self, function: Function, a: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Call(function, a)))
    }

    /// atan2(`y`, `x`): the angle of the point (`x`, `y`), measured from the first axis, −π…π.
    pub fn atan2(&mut self, y: Scalar, x: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Atan2(y, x)))
    }

    /// a to the power of b
    pub fn pow(&mut self, a: Scalar, b: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Op(Op::Pow(a, b)))
    }

    /// A Stumpff function of `s` = r².
    pub fn stumpff(&mut self, function: Stumpff, s: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Stumpff(function, s))
    }

    /// atan2(√s, w)/√s; for positive w it is 1/w at s = 0.
    pub fn arc(&mut self, s: Scalar, w: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Arc(0, s, w))
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

    /// v / |v|, or 0 if v is too short to have a direction.
    pub fn normalize(&mut self, v: Vector) -> Unit {
        Unit(self.intern_vector(VectorNode::Normalize(v)))
    }

    /// v projected onto the plane and turned by 90°.
    pub fn perp(&mut self, plane: Plane, v: Vector) -> Vector {
        self.intern_vector(VectorNode::Perp(plane, v))
    }

    /// v × w
    pub fn cross(&mut self, v: Vector, w: Vector) -> Vector {
        self.intern_vector(VectorNode::Cross(v, w))
    }

    /// v − (v · u) u: the part of v perpendicular to the direction u.
    pub fn across(&mut self, v: Vector, u: Unit) -> Vector {
        self.intern_vector(VectorNode::Across(v, u))
    }

    /// M⁻¹ v. Not finite if M is singular.
    pub fn solve(&mut self, m: Matrix, v: Vector) -> Vector {
        self.intern_vector(VectorNode::Solve(m, v))
    }

    /// M⁻¹ v by Cramer's rule: with the columns c₀, c₁, c₂ and n₀ = c₁ × c₂, n₁ = c₂ × c₀, n₂ = c₀ × c₁, component k is
    /// nₖ · v over the determinant c₂ · n₂. For the transpose it is the sum of vₖ nₖ over the determinant.
    pub(crate) fn by_cofactors(&mut self, m: Matrix, v: Vector) -> Vector {
        let [x, y, z] = m.columns;
        let normals = [self.cross(y, z), self.cross(z, x), self.cross(x, y)];
        let numerator = if m.transposed {
            let along = [0, 1, 2].map(|k| {
                let component = self.component(v, k);
                self.scale(component, normals[usize::from(k)])
            });
            let sum = self.add_vectors(along[0], along[1]);
            self.add_vectors(sum, along[2])
        } else {
            let components = normals.map(|normal| self.dot(normal, v));
            self.components(components)
        };
        let (one, determinant) = (self.constant(1.0), self.dot(z, normals[2]));
        let over = self.div(one, determinant);
        self.scale(over, numerator)
    }

    /// R v
    pub fn rotate(&mut self, rotation: Rotation, v: impl Into<Vector>) -> Vector {
        self.intern_vector(VectorNode::Rotate(rotation, v.into()))
    }

    /// The rotation with these rows in the row-vector layout. The caller guarantees that they are orthonormal.
    pub fn matrix(&mut self, rows: [Scalar; 9]) -> Rotation {
        self.intern_rotation(RotationNode::Matrix(rows))
    }

    /// The change of basis that maps axis k to `images[k]`. The images must be unit vectors, perpendicular to each
    /// other.
    pub fn basis(&mut self, images: [[f64; 3]; 3]) -> Rotation {
        let entries = core::array::from_fn(|i| Constant::new(images[i / 3][i % 3]));
        self.intern_rotation(RotationNode::Basis(entries))
    }

    /// The rotation in `plane` by `angle`.
    pub fn turn(&mut self, plane: Plane, angle: Angle) -> Rotation {
        self.intern_rotation(RotationNode::Turn(plane, angle))
    }

    /// The right-handed rotation about `axis` by `angle`. The axis must have length 1; derivatives treat it as a
    /// constant.
    pub fn about(&mut self, axis: Vector, angle: Angle) -> Rotation {
        self.intern_rotation(RotationNode::About(axis, angle))
    }

    /// The rotation of a quaternion of length 1. Derivatives treat the quaternion as a constant.
    pub fn quaternion(&mut self, vector: Vector, scalar: Scalar) -> Rotation {
        self.intern_rotation(RotationNode::Quaternion(vector, scalar))
    }

    /// The rotation defined by an attitude. It can be differentiated by the attitude's numbers.
    pub fn attitude(&mut self, attitude: Attitude) -> Rotation {
        let motions = [Space::World, Space::Body].map(|space| self.intern_vector(VectorNode::Motion(space, attitude)));
        self.intern_rotation(RotationNode::Moving(motions))
    }

    /// Returns the attitude of a rotation from its motions.
    #[must_use]
    pub fn attitude_of(&self, [motion, _]: [Vector; 2]) -> Attitude {
        match self.vector_node(motion) {
            VectorNode::Motion(_, attitude) => attitude,
            _ => unreachable!("a motion stays a motion"),
        }
    }

    /// 2/|q|² of the quaternion with these parts; 0 if the quaternion is 0.
    pub(crate) fn twice_over_square(&mut self, u: Vector, w: Scalar) -> Scalar {
        let (u2, w2) = (self.dot(u, u), self.mul(w, w));
        let square = self.add(u2, w2);
        let (two, reciprocal) = (self.constant(2.0), self.reciprocal(square));
        self.mul(two, reciprocal)
    }

    /// cos r, sin r / r, (1 − cos r)/r² and (r − sin r)/r³ with r = |v|.
    pub(crate) fn turn_factors(&mut self, v: Vector) -> [Scalar; 4] {
        let square = self.dot(v, v);
        [0, 1, 2, 3].map(|order| self.stumpff(Stumpff { hyperbolic: false, order }, square))
    }

    pub(crate) fn has_quaternion_parts(&self) -> bool {
        self.vectors.nodes.iter().any(|node| matches!(node, VectorNode::Imaginary(..)))
    }

    /// The rotation about a [`step`](Self::step) by its length. Composed with a rotation R it moves R on the rotation
    /// manifold; first and second derivatives by the step are those of the exponential map.
    pub fn turn_by_step(&mut self, step: Vector) -> Rotation {
        self.intern_rotation(RotationNode::Step(step))
    }

    /// The composition that applies `inner`, then `outer`.
    pub fn compose(&mut self, outer: Rotation, inner: Rotation) -> Rotation {
        self.intern_rotation(RotationNode::Compose(outer, inner))
    }

    /// Returns `true` for a composition of many factors most of which appear again and again, such as a rotation that
    /// was squared over and over: it costs less to rotate by it as one.
    #[must_use]
    pub fn repeats_factors(&self, rotation: Rotation) -> bool {
        let mut known = FxHashMap::default();
        let factors = self.factors(rotation, &mut known);
        factors > MOST_REPEATED && factors > 2 * known.len()
    }

    /// Returns the number of factors of a composition, and as `known` that of each different part of it.
    fn factors(&self, rotation: Rotation, known: &mut FxHashMap<Rotation, usize>) -> usize {
        if let Some(&factors) = known.get(&rotation) {
            return factors;
        }
        let factors = match self.rotation_node(rotation) {
            RotationNode::Compose(a, b) => self.factors(a, known).saturating_add(self.factors(b, known)),
            RotationNode::Transpose(inner) => self.factors(inner, known),
            _ => 1,
        };
        known.insert(rotation, factors);
        factors
    }

    /// The inverse rotation.
    pub fn transpose(&mut self, rotation: Rotation) -> Rotation {
        if let RotationNode::Transpose(inner) = self.rotation_node(rotation) {
            return inner;
        }
        self.intern_rotation(RotationNode::Transpose(rotation))
    }

    /// Returns the node of a rotation, and `false`; for an inverse the node of the rotation that it inverts, and `true`.
    pub(crate) fn untransposed(&self, rotation: Rotation) -> (RotationNode, bool) {
        match self.rotation_node(rotation) {
            RotationNode::Transpose(inner) => (self.rotation_node(inner), true),
            node => (node, false),
        }
    }

    /// `rotation` as a rigid transform about the origin.
    pub fn about_origin(&mut self, rotation: Rotation) -> Rigid {
        Rigid { rotation, translation: self.constant_vector([0.0; 3]) }
    }

    /// The composition that applies `inner`, then `outer`.
    pub fn compose_rigid(&mut self, outer: Rigid, inner: Rigid) -> Rigid {
        Rigid {
            rotation: self.compose(outer.rotation, inner.rotation),
            translation: self.transform_point(outer, inner.translation),
        }
    }

    /// The image of a point under a rigid transform.
    pub fn transform_point(&mut self, rigid: Rigid, point: Vector) -> Vector {
        let rotated = self.rotate(rigid.rotation, point);
        self.add_vectors(rotated, rigid.translation)
    }

    /// Returns the value if `scalar` is a constant.
    #[must_use]
    pub fn constant_of(&self, scalar: Scalar) -> Option<f64> {
        match self.scalar_node(scalar) {
            ScalarNode::Op(Op::Constant(c)) => Some(c.value()),
            _ => None,
        }
    }

    /// Returns the components if `v` is a vector of constants.
    #[must_use]
    pub fn constant_vector_of(&self, v: Vector) -> Option<[f64; 3]> {
        let VectorNode::Components([x, y, z]) = self.vector_node(v) else { return None };
        Some([self.constant_of(x)?, self.constant_of(y)?, self.constant_of(z)?])
    }
}
