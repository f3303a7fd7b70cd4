//! Linear maps, quaternions and affine transforms of a function.
//!
//! A map is kept as it was made, so that what is a rotation stays one: the rules of the engine know `R Rᵀ = 1` of
//! rotations alone. Only where its numbers are asked for are they worked out.

use std::rc::Rc;

use aim_symbolic::{Attitude, Function, Matrix, Node, Op, Rotation, Scalar, ScalarNode, Stumpff, Vector, VectorNode};

use super::algebra::Algebra;
use super::condition::Condition;

/// Branches of more maps are multiplied out: as matrices, which takes a vector for each axis, or as quaternions, which
/// takes longer to pay.
const MOST_BEFORE_MATRICES: usize = 6;
const MOST_BEFORE_QUATERNIONS: usize = 22;
/// Products of more maps are multiplied out, and so is the square of a product, as its number of maps would double in every
/// round of a loop. Rotations stay rotations for longer: their rules need them whole.
const MOST_FACTORS: usize = 16;
const MOST_TURNS: usize = 512;

/// A linear map of vectors.
#[derive(Clone, Debug)]
pub(crate) enum Map {
    /// A rotation, so that its transpose is its inverse.
    Rotation(Rotation),
    /// The images of the three axes.
    Columns([Vector; 3]),
    /// The transpose of that.
    Rows([Vector; 3]),
    /// What multiplies each component by its own number.
    Diagonal(Vector),
    /// The inverse of a matrix.
    Inverse(Matrix),
    /// v ↦ q v q*, for a quaternion of any length: its vector part and its scalar part.
    Spin(Vector, Scalar),
    /// The second, then the first.
    Compose(Rc<(Self, Self)>),
    /// The first where the condition holds, else the second.
    Select(Rc<(Condition, Self, Self)>),
}

impl Map {
    /// The right-handed turn about X, Y or Z.
    pub(crate) fn turn(a: &mut Algebra, axis: usize, radians: Scalar) -> Self {
        Self::Rotation(a.turn(axis, radians))
    }

    pub(crate) fn identity(a: &mut Algebra) -> Self {
        Self::Rotation(a.identity())
    }

    /// The map with these images of the axes: a rotation where they are written as those of a turn about an axis, and
    /// diagonal where the others are 0.
    pub(crate) fn of_columns(a: &mut Algebra, columns: [Vector; 3]) -> Self {
        let entries = columns.map(|column| a.parts(column));
        let is_aside = |(i, k): (usize, usize)| i == k || a.constant_of(entries[i][k]) == Some(0.0);
        if (0..9).map(|i| (i / 3, i % 3)).all(is_aside) {
            return Self::Diagonal(a.vector([0, 1, 2].map(|k| entries[k][k])));
        }
        let called = |a: &Algebra, function, s| match a.g.scalar_node(s) {
            ScalarNode::Op(Op::Call(own, radians)) if own == function => Some(radians),
            _ => None,
        };
        for (axis, [i, k]) in [[1, 2], [2, 0], [0, 1]].into_iter().enumerate() {
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            let [first, second] = [entries[i], entries[k]];
            let still = [first[axis], second[axis]].map(|s| a.constant_of(s)) == [Some(0.0); 2];
            if a.g.constant_vector_of(columns[axis]) != Some(unit) || !still {
                continue;
            }
            let Some(radians) = called(a, Function::Cos, first[i]) else { continue };
            let back = a.neg(radians);
            for (sine, minus, radians) in [(first[k], second[i], radians), (second[i], first[k], back)] {
                let is_sine = called(a, Function::Sin, sine) == called(a, Function::Cos, first[i]);
                if is_sine && a.neg(sine) == minus && second[k] == first[i] {
                    return Self::turn(a, axis, radians);
                }
            }
        }
        Self::Columns(columns)
    }

    /// `then` where the condition holds, else `otherwise`. Branches of many maps are multiplied out, so that what they have
    /// in common is not applied once a branch.
    pub(crate) fn select(a: &mut Algebra, condition: &Condition, then: &Self, otherwise: &Self) -> Self {
        if then.size() + otherwise.size() <= MOST_BEFORE_MATRICES {
            return Self::branches(condition, then, otherwise);
        }
        let (then, otherwise) = (then.columns(a), otherwise.columns(a));
        Self::Columns([0, 1, 2].map(|k| condition.select_vector(a, then[k], otherwise[k])))
    }

    fn branches(condition: &Condition, then: &Self, otherwise: &Self) -> Self {
        Self::Select(Rc::new((condition.clone(), then.clone(), otherwise.clone())))
    }

    /// How many maps are applied to a vector.
    fn size(&self) -> usize {
        match self {
            Self::Compose(pair) => pair.0.size() + pair.1.size(),
            Self::Select(choice) => choice.1.size() + choice.2.size(),
            _ => 1,
        }
    }

    pub(crate) fn apply(&self, a: &mut Algebra, v: Vector) -> Vector {
        match self {
            Self::Rotation(rotation) => a.g.rotate(*rotation, v),
            Self::Columns(columns) => {
                let parts = a.parts(v);
                let [x, y, z] = [0, 1, 2].map(|k| a.scale(parts[k], columns[k]));
                let xy = a.add_vectors(x, y);
                a.add_vectors(xy, z)
            }
            Self::Rows(rows) => {
                let parts = rows.map(|row| a.dot(row, v));
                a.vector(parts)
            }
            Self::Diagonal(numbers) => a.zip(*numbers, v, Algebra::mul),
            Self::Inverse(m) => a.g.solve(*m, v),
            Self::Spin(u, w) => spin(a, *u, *w, v),
            Self::Compose(pair) => {
                let once = pair.1.apply(a, v);
                pair.0.apply(a, once)
            }
            Self::Select(choice) => {
                let (then, otherwise) = (choice.1.apply(a, v), choice.2.apply(a, v));
                choice.0.select_vector(a, then, otherwise)
            }
        }
    }

    /// `inner`, then `self`.
    pub(crate) fn compose(&self, a: &mut Algebra, inner: &Self) -> Self {
        // Products begin with it.
        let identity = a.identity();
        match (self, inner) {
            (Self::Rotation(outer), _) if *outer == identity => inner.clone(),
            (_, Self::Rotation(inner)) if *inner == identity => self.clone(),
            (Self::Rotation(outer), Self::Rotation(inner)) => Self::Rotation(a.g.compose(*outer, *inner)),
            (Self::Compose(outer), Self::Compose(inner)) if Rc::ptr_eq(outer, inner) && !self.is_rotation() => {
                self.multiplied_out(a, self)
            }
            (Self::Compose(pair), _) => {
                let inner = pair.1.compose(a, inner);
                pair.0.compose(a, &inner)
            }
            (Self::Diagonal(outer), Self::Diagonal(inner)) => Self::Diagonal(a.zip(*outer, *inner, Algebra::mul)),
            (Self::Rotation(_), Self::Compose(pair)) if matches!(pair.0, Self::Rotation(_)) => {
                Self::Compose(Rc::new((self.compose(a, &pair.0), pair.1.clone())))
            }
            (Self::Diagonal(_), Self::Compose(pair)) if matches!(pair.0, Self::Diagonal(_)) => {
                Self::Compose(Rc::new((self.compose(a, &pair.0), pair.1.clone())))
            }
            _ => self.product(a, inner),
        }
    }

    fn product(&self, a: &mut Algebra, inner: &Self) -> Self {
        let most = if self.is_rotation() && inner.is_rotation() { MOST_TURNS } else { MOST_FACTORS };
        if self.size() + inner.size() <= most {
            return Self::Compose(Rc::new((self.clone(), inner.clone())));
        }
        self.multiplied_out(a, inner)
    }

    fn multiplied_out(&self, a: &mut Algebra, inner: &Self) -> Self {
        // Each by itself: those of a square are the same.
        let (outer, inner) = (Self::Columns(self.columns(a)), inner.columns(a));
        Self::Columns(inner.map(|column| outer.apply(a, column)))
    }

    pub(crate) fn transpose(&self, a: &mut Algebra) -> Self {
        match self {
            Self::Rotation(rotation) => Self::Rotation(a.g.transpose(*rotation)),
            Self::Columns(columns) => Self::Rows(*columns),
            Self::Rows(rows) => Self::Columns(*rows),
            Self::Diagonal(_) => self.clone(),
            Self::Inverse(m) => Self::Inverse(m.transpose()),
            Self::Spin(u, w) => Self::Spin(a.neg_vector(*u), *w),
            Self::Compose(pair) => {
                let (first, second) = (pair.0.transpose(a), pair.1.transpose(a));
                second.compose(a, &first)
            }
            Self::Select(choice) => {
                let (then, otherwise) = (choice.1.transpose(a), choice.2.transpose(a));
                Self::Select(Rc::new((choice.0.clone(), then, otherwise)))
            }
        }
    }

    /// The map back: of a rotation its transpose.
    pub(crate) fn inverse(&self, a: &mut Algebra) -> Self {
        if self.is_rotation() {
            return self.transpose(a);
        }
        match self {
            Self::Compose(pair) => {
                let (first, second) = (pair.0.inverse(a), pair.1.inverse(a));
                second.compose(a, &first)
            }
            Self::Inverse(Matrix { columns, transposed: false }) => Self::Columns(*columns),
            Self::Inverse(Matrix { columns, transposed: true }) => Self::Rows(*columns),
            Self::Rows(rows) => Self::Inverse(Matrix::new(*rows).transpose()),
            Self::Diagonal(numbers) => {
                let reciprocals = a.parts(*numbers).map(|number| a.recip(number));
                Self::Diagonal(a.vector(reciprocals))
            }
            _ => Self::Inverse(Matrix::new(self.columns(a))),
        }
    }

    /// Whether it is known to be a rotation.
    pub(crate) fn is_rotation(&self) -> bool {
        match self {
            Self::Rotation(_) => true,
            Self::Compose(pair) => pair.0.is_rotation() && pair.1.is_rotation(),
            Self::Select(choice) => choice.1.is_rotation() && choice.2.is_rotation(),
            _ => false,
        }
    }

    /// The images of the axes.
    pub(crate) fn columns(&self, a: &mut Algebra) -> [Vector; 3] {
        [0, 1, 2].map(|axis| self.column(a, axis))
    }

    /// The image of an axis.
    pub(crate) fn column(&self, a: &mut Algebra, axis: usize) -> Vector {
        match self {
            Self::Columns(columns) => columns[axis],
            Self::Rows(rows) => {
                let parts = rows.map(|row| a.component(row, axis));
                a.vector(parts)
            }
            _ => {
                let axis = a.axis(axis);
                self.apply(a, axis)
            }
        }
    }

    pub(crate) fn determinant(&self, a: &mut Algebra) -> Scalar {
        let [x, y, z] = self.columns(a);
        let normal = a.cross(x, y);
        a.dot(z, normal)
    }

    /// Column by column of two.
    pub(crate) fn zip(&self, a: &mut Algebra, other: &Self, of: fn(&mut Algebra, Vector, Vector) -> Vector) -> Self {
        let (mine, theirs) = (self.columns(a), other.columns(a));
        Self::Columns([0, 1, 2].map(|k| of(a, mine[k], theirs[k])))
    }

    /// Each column by itself.
    pub(crate) fn map(&self, a: &mut Algebra, of: impl Fn(&mut Algebra, Vector) -> Vector) -> Self {
        let columns = self.columns(a);
        Self::Columns(columns.map(|column| of(a, column)))
    }

    /// The right-handed turn about an axis that the variables move, as a matrix writes it: by Rodrigues' formula.
    pub(crate) fn rodrigues(a: &mut Algebra, axis: Vector, radians: Scalar) -> Self {
        let (sin, cos) = a.sin_cos(radians);
        let one = a.number(1.0);
        let rest = a.sub(one, cos);
        let parts = a.parts(axis);
        Self::Columns([0, 1, 2].map(|k| {
            let (unit, along) = (a.axis(k), a.mul(rest, parts[k]));
            about(a, unit, axis, [cos, along, sin])
        }))
    }
}

/// q v q* = v (w² − u·u) + 2 u (u·v) + 2 w (u × v)
fn spin(a: &mut Algebra, u: Vector, w: Scalar, v: Vector) -> Vector {
    let two = a.number(2.0);
    let (w2, u2, along) = (a.mul(w, w), a.dot(u, u), a.dot(u, v));
    let factors = [a.sub(w2, u2), a.mul(two, along), a.mul(two, w)];
    about(a, v, u, factors)
}

/// kept v + along u + aside (u × v)
fn about(a: &mut Algebra, v: Vector, u: Vector, [kept, along, aside]: [Scalar; 3]) -> Vector {
    let (kept, along, across) = (a.scale(kept, v), a.scale(along, u), a.cross(u, v));
    let (sum, aside) = (a.add_vectors(kept, along), a.scale(aside, across));
    a.add_vectors(sum, aside)
}

/// A quaternion: the map that it is used for, and its numbers where they are known.
#[derive(Clone, Debug)]
pub(crate) struct Quaternion {
    pub(crate) map: Map,
    /// The vector part and the scalar part.
    pub(crate) parts: Option<(Vector, Scalar)>,
}

impl Quaternion {
    /// The quaternion of these parts, of whatever length.
    pub(crate) fn from_parts(u: Vector, w: Scalar) -> Self {
        Self { map: Map::Spin(u, w), parts: Some((u, w)) }
    }

    /// One of length 1 that no variable moves.
    pub(crate) fn unit(a: &mut Algebra, u: Vector, w: Scalar) -> Self {
        let map = match (a.g.constant_vector_of(u), a.constant_of(w)) {
            (Some([x, y, z]), Some(w)) => Map::Rotation(a.g.basis(images(x, y, z, w))),
            _ => Map::Rotation(a.g.quaternion(u, w)),
        };
        Self { map, parts: Some((u, w)) }
    }

    pub(crate) fn identity(a: &mut Algebra) -> Self {
        let (u, w) = (a.number_vector([0.0; 3]), a.number(1.0));
        Self { map: Map::identity(a), parts: Some((u, w)) }
    }

    /// The right-handed turn about X, Y or Z.
    pub(crate) fn turn(a: &mut Algebra, axis: usize, radians: Scalar) -> Self {
        let unit = a.axis(axis);
        let parts = half_turn(a, unit, radians);
        Self { map: Map::turn(a, axis, radians), parts: Some(parts) }
    }

    pub(crate) fn about(a: &mut Algebra, axis: Vector, radians: Scalar) -> Self {
        let parts = half_turn(a, axis, radians);
        Self { map: Map::Rotation(a.about(axis, radians)), parts: Some(parts) }
    }

    /// One that the variables move, made of length 1.
    pub(crate) fn normalized(a: &mut Algebra, (u, w): (Vector, Scalar), reciprocal: Scalar) -> Self {
        let map = Map::Rotation(a.g.attitude(Attitude::Quaternion(u, w)));
        Self { map, parts: Some((a.scale(reciprocal, u), a.mul(reciprocal, w))) }
    }

    /// The turn about an axis that the variables move.
    pub(crate) fn about_varying(a: &mut Algebra, axis: Vector, radians: Scalar) -> Self {
        if let (VectorNode::Normalize(turn), ScalarNode::Norm(length)) =
            (a.g.vector_node(axis), a.g.scalar_node(radians))
            && turn == length
        {
            return Self::about_vector(a, turn);
        }
        let (u, w) = half_turn(a, axis, radians);
        Self::from_parts(u, w)
    }

    /// The turn about a vector by its length, also where that is 0.
    pub(crate) fn about_vector(a: &mut Algebra, turn: Vector) -> Self {
        let half = a.number(0.5);
        let half = a.scale(half, turn);
        let square = a.dot(half, half);
        let [w, sine] = [0, 1].map(|order| a.g.stumpff(Stumpff { hyperbolic: false, order }, square));
        let u = a.scale(sine, half);
        if a.varies(Node::Vector(turn)) {
            return Self { map: Map::Rotation(a.g.attitude(Attitude::Turn(turn))), parts: Some((u, w)) };
        }
        Self::unit(a, u, w)
    }

    /// `self` where the condition holds, else `otherwise`.
    pub(crate) fn select(&self, a: &mut Algebra, condition: &Condition, otherwise: &Self) -> Self {
        let parts = self.parts.zip(otherwise.parts).map(|((u, w), (v, x))| {
            let vector = condition.select_vector(a, u, v);
            (vector, condition.select(a, w, x))
        });
        let map = match parts {
            Some((u, w)) if self.map.size() + otherwise.map.size() > MOST_BEFORE_QUATERNIONS => Map::Spin(u, w),
            Some(_) => Map::branches(condition, &self.map, &otherwise.map),
            None => Map::select(a, condition, &self.map, &otherwise.map),
        };
        Self { map, parts }
    }

    pub(crate) fn conjugate(&self, a: &mut Algebra) -> Self {
        Self { map: self.map.transpose(a), parts: self.parts.map(|(u, w)| (a.neg_vector(u), w)) }
    }

    /// `inner`, then `self`.
    pub(crate) fn compose(&self, a: &mut Algebra, inner: &Self) -> Self {
        let parts = self.parts.zip(inner.parts).map(|((u, w), (v, x))| {
            let (wv, xu, uv) = (a.scale(w, v), a.scale(x, u), a.cross(u, v));
            let vector = a.add_vectors(wv, xu);
            let vector = a.add_vectors(vector, uv);
            let (wx, dot) = (a.mul(w, x), a.dot(u, v));
            (vector, a.sub(wx, dot))
        });
        Self { map: self.map.compose(a, &inner.map), parts }
    }
}

/// The parts of the quaternion that turns about `axis`.
fn half_turn(a: &mut Algebra, axis: Vector, radians: Scalar) -> (Vector, Scalar) {
    let half = a.number(0.5);
    let half = a.mul(half, radians);
    let (sin, cos) = a.sin_cos(half);
    (a.scale(sin, axis), cos)
}

/// The images of the axes under a constant quaternion, made of length 1.
fn images(x: f64, y: f64, z: f64, w: f64) -> [[f64; 3]; 3] {
    let norm = (x * x + y * y + z * z + w * w).sqrt();
    let [x, y, z, w] = [x, y, z, w].map(|c| c / norm);
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// A linear map, then a translation.
#[derive(Clone, Debug)]
pub(crate) struct Affine {
    pub(crate) map: Map,
    pub(crate) translation: Vector,
}

impl Affine {
    pub(crate) fn apply(&self, a: &mut Algebra, point: Vector) -> Vector {
        let image = self.map.apply(a, point);
        a.add_vectors(image, self.translation)
    }

    /// `inner`, then `self`.
    pub(crate) fn compose(&self, a: &mut Algebra, inner: &Self) -> Self {
        Self { map: self.map.compose(a, &inner.map), translation: self.apply(a, inner.translation) }
    }

    pub(crate) fn inverse(&self, a: &mut Algebra) -> Self {
        let map = self.map.inverse(a);
        let back = map.apply(a, self.translation);
        Self { map, translation: a.neg_vector(back) }
    }

    /// A linear map about the origin.
    pub(crate) fn about_origin(a: &mut Algebra, map: Map) -> Self {
        Self { map, translation: a.number_vector([0.0; 3]) }
    }
}
