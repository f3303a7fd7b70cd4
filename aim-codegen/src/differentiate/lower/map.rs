//! Linear maps, quaternions and affine transforms of an interpreted function.
//!
//! A map is stored as it was constructed, so that a rotation stays one: the engine's rules know `R Rᵀ = 1` for
//! rotations only. Matrix entries are computed only when they are needed.

use std::rc::Rc;

use aim_symbolic::{Attitude, Function, Matrix, Node, Op, Rotation, Scalar, ScalarNode, Stumpff, Vector, VectorNode};

use super::algebra::Algebra;
use super::condition::Condition;

/// Largest number of maps in the branches of a select of matrices. Branches with more are multiplied out, which takes a
/// vector for each axis.
const MOST_BEFORE_MATRICES: usize = 6;
/// Largest number of maps in the branches of a select of quaternions. Branches with more are replaced by a select of
/// the components, which pays off later than for matrices.
const MOST_BEFORE_QUATERNIONS: usize = 22;
/// Largest number of maps in a product; longer products are multiplied out. So is the square of a product, whose number
/// of maps would double in every iteration of a loop.
const MOST_FACTORS: usize = 16;
/// Largest number of maps in a product of rotations. Larger than [`MOST_FACTORS`], because the rules for rotations only
/// apply to products that are not multiplied out.
const MOST_TURNS: usize = 512;

/// A linear map of vectors.
#[derive(Clone, Debug)]
pub(crate) enum Map {
    /// A rotation: its transpose is its inverse.
    Rotation(Rotation),
    /// The images of the three axes.
    Columns([Vector; 3]),
    /// The transpose of the matrix with these columns.
    Rows([Vector; 3]),
    /// Multiplies each component by its own number.
    Diagonal(Vector),
    /// The inverse of a matrix.
    Inverse(Matrix),
    /// v ↦ q v q*, for a quaternion of any length, given by its vector part and scalar part.
    Spin(Vector, Scalar),
    /// The second map followed by the first.
    Compose(Rc<(Self, Self)>),
    /// The transpose of the second map followed by the first.
    Transposed(Rc<(Self, Self)>),
    /// The first map where the condition holds, else the second.
    Select(Rc<(Condition, Self, Self)>),
}

impl Map {
    /// Returns the right-handed rotation about X, Y or Z.
    pub(crate) fn turn(a: &mut Algebra, axis: usize, radians: Scalar) -> Self {
        Self::Rotation(a.turn(axis, radians))
    }

    pub(crate) fn identity(a: &mut Algebra) -> Self {
        Self::Rotation(a.identity())
    }

    /// Returns the map with these images of the axes: diagonal if all other entries are 0, a rotation if the entries
    /// are written like those of a rotation about an axis.
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

    /// Returns `then` where the condition holds, else `otherwise`. Branches of many maps are multiplied out, so that
    /// maps that they share are not applied once for each branch.
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

    /// Returns the number of maps that are applied to a vector.
    fn size(&self) -> usize {
        match self {
            Self::Compose(pair) | Self::Transposed(pair) => pair.0.size() + pair.1.size(),
            Self::Select(choice) => choice.1.size() + choice.2.size(),
            _ => 1,
        }
    }

    /// Returns `true` for a product of matrices: if entries of it are needed, it is multiplied out.
    fn is_product_of_matrices(&self) -> bool {
        fn matrices(map: &Map) -> usize {
            match map {
                Map::Rotation(_) | Map::Diagonal(_) => 0,
                Map::Compose(pair) | Map::Transposed(pair) => matrices(&pair.0) + matrices(&pair.1),
                _ => 1,
            }
        }
        matrices(self) > 1
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
            Self::Transposed(pair) => {
                let once = pair.0.transpose(a).apply(a, v);
                pair.1.transpose(a).apply(a, once)
            }
            Self::Select(choice) => {
                let (then, otherwise) = (choice.1.apply(a, v), choice.2.apply(a, v));
                choice.0.select_vector(a, then, otherwise)
            }
        }
    }

    /// Returns `inner` followed by `self`.
    pub(crate) fn compose(&self, a: &mut Algebra, inner: &Self) -> Self {
        // Products begin with the identity.
        let identity = a.identity();
        match (self, inner) {
            (Self::Rotation(outer), _) if *outer == identity => inner.clone(),
            (_, Self::Rotation(inner)) if *inner == identity => self.clone(),
            (Self::Rotation(outer), Self::Rotation(turn)) => {
                let composed = a.g.compose(*outer, *turn);
                if a.g.repeats_factors(composed) { self.multiplied_out(a, inner) } else { Self::Rotation(composed) }
            }
            (Self::Compose(outer), Self::Compose(inner)) if Rc::ptr_eq(outer, inner) && !self.is_rotation() => {
                self.multiplied_out(a, self)
            }
            (Self::Diagonal(outer), Self::Diagonal(inner)) => Self::Diagonal(a.zip(*outer, *inner, Algebra::mul)),
            (Self::Compose(pair), _) if self.meets(inner) => {
                let inner = pair.1.compose(a, inner);
                pair.0.compose(a, &inner)
            }
            (_, Self::Compose(pair)) if self.meets(inner) => {
                let outer = self.compose(a, &pair.0);
                outer.compose(a, &pair.1)
            }
            _ => self.product(a, inner),
        }
    }

    /// Returns `true` if the last map of this product and the first of the other become one.
    fn meets(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Compose(pair), _) => pair.1.meets(inner),
            (_, Self::Compose(pair)) => self.meets(&pair.0),
            (Self::Rotation(_), Self::Rotation(_)) | (Self::Diagonal(_), Self::Diagonal(_)) => true,
            _ => false,
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
        // Compute the columns of each factor by itself: those of a square are shared.
        let (outer, inner) = (Self::Columns(self.columns(a)), inner.columns(a));
        Self::Columns(inner.map(|column| outer.apply(a, column)))
    }

    /// Returns a product of matrices as one matrix, any other map as it is. The transpose has the same numbers.
    fn as_one(&self, a: &mut Algebra) -> Self {
        match self {
            Self::Compose(_) if self.is_product_of_matrices() => Self::Columns(self.columns(a)),
            Self::Transposed(pair) => Self::Rows(Self::Compose(pair.clone()).columns(a)),
            _ => self.clone(),
        }
    }

    pub(crate) fn transpose(&self, a: &mut Algebra) -> Self {
        match self {
            Self::Rotation(rotation) => Self::Rotation(a.g.transpose(*rotation)),
            Self::Columns(columns) => Self::Rows(*columns),
            Self::Rows(rows) => Self::Columns(*rows),
            Self::Diagonal(_) => self.clone(),
            Self::Inverse(m) => Self::Inverse(m.transpose()),
            Self::Spin(u, w) => Self::Spin(a.neg_vector(*u), *w),
            Self::Transposed(pair) => Self::Compose(pair.clone()),
            Self::Compose(pair) if self.is_product_of_matrices() => Self::Transposed(pair.clone()),
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

    /// Returns the inverse map; for a rotation its transpose.
    pub(crate) fn inverse(&self, a: &mut Algebra) -> Self {
        if self.is_rotation() {
            return self.transpose(a);
        }
        match self {
            Self::Compose(pair) => {
                let (first, second) = (pair.0.inverse(a), pair.1.inverse(a));
                second.compose(a, &first)
            }
            Self::Transposed(pair) => Self::Compose(pair.clone()).inverse(a).transpose(a),
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

    /// Returns `true` if the map is known to be a rotation.
    pub(crate) fn is_rotation(&self) -> bool {
        match self {
            Self::Rotation(_) => true,
            Self::Compose(pair) => pair.0.is_rotation() && pair.1.is_rotation(),
            Self::Select(choice) => choice.1.is_rotation() && choice.2.is_rotation(),
            _ => false,
        }
    }

    /// Returns the images of the axes.
    pub(crate) fn columns(&self, a: &mut Algebra) -> [Vector; 3] {
        match self {
            Self::Compose(pair) => {
                let (outer, inner) = (pair.0.as_one(a), pair.1.columns(a));
                let columns = inner.map(|column| outer.apply(a, column));
                if !self.is_product_of_matrices() || !self.is_symmetric(a) {
                    return columns;
                }
                let [[xx, xy, xz], [_, yy, yz], [.., zz]] = columns.map(|column| a.parts(column));
                [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|column| a.vector(column))
            }
            Self::Transposed(_) => self.as_one(a).columns(a),
            _ => [0, 1, 2].map(|axis| self.column(a, axis)),
        }
    }

    /// Returns `true` if the map is known to be its own transpose: a product of A, a symmetric map, and the transpose
    /// of A.
    fn is_symmetric(&self, a: &mut Algebra) -> bool {
        let mut factors = Vec::new();
        self.factors(a, &mut factors);
        let mirrored = factors.iter().zip(factors.iter().rev()).take(factors.len() / 2);
        let [is_mirrored, is_even] =
            [mirrored.into_iter().all(|(f, g)| f.is_transpose_of(a, g)), factors.len() % 2 == 0];
        is_mirrored && (is_even || factors[factors.len() / 2].is_transpose_of(a, &factors[factors.len() / 2]))
    }

    /// Lists the factors of a product from the outermost to the innermost.
    fn factors(&self, a: &mut Algebra, into: &mut Vec<Self>) {
        match self {
            Self::Compose(pair) => {
                pair.0.factors(a, into);
                pair.1.factors(a, into);
            }
            Self::Transposed(pair) => {
                let factors = [&pair.1, &pair.0].map(|factor| factor.transpose(a));
                factors.iter().for_each(|factor| factor.factors(a, into));
            }
            _ => into.push(self.clone()),
        }
    }

    /// Returns `true` if the entries of both maps are known to be those of each other's transpose.
    fn is_transpose_of(&self, a: &mut Algebra, other: &Self) -> bool {
        match (self, other) {
            (Self::Rotation(turn), Self::Rotation(back)) => a.g.transpose(*turn) == *back,
            (Self::Diagonal(v), Self::Diagonal(w)) => v == w,
            (Self::Columns(v), Self::Rows(w)) | (Self::Rows(v), Self::Columns(w)) => v == w,
            (Self::Columns(v), Self::Columns(w)) | (Self::Rows(v), Self::Rows(w)) => {
                let [v, w] = [v, w].map(|columns| columns.map(|column| a.parts(column)));
                (0..9).all(|i| v[i / 3][i % 3] == w[i % 3][i / 3])
            }
            (Self::Inverse(m), Self::Inverse(n)) => {
                let [m, n] =
                    [m, n].map(|m| if m.transposed { Self::Rows(m.columns) } else { Self::Columns(m.columns) });
                m.is_transpose_of(a, &n)
            }
            _ => false,
        }
    }

    /// Returns the image of an axis.
    pub(crate) fn column(&self, a: &mut Algebra, axis: usize) -> Vector {
        match self {
            Self::Columns(columns) => columns[axis],
            Self::Rows(rows) => {
                let parts = rows.map(|row| a.component(row, axis));
                a.vector(parts)
            }
            Self::Compose(_) | Self::Transposed(_) => self.columns(a)[axis],
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

    /// Combines two maps column by column.
    pub(crate) fn zip(&self, a: &mut Algebra, other: &Self, of: fn(&mut Algebra, Vector, Vector) -> Vector) -> Self {
        let (mine, theirs) = (self.columns(a), other.columns(a));
        Self::Columns([0, 1, 2].map(|k| of(a, mine[k], theirs[k])))
    }

    /// Applies a function to each column.
    pub(crate) fn map(&self, a: &mut Algebra, of: impl Fn(&mut Algebra, Vector) -> Vector) -> Self {
        let columns = self.columns(a);
        Self::Columns(columns.map(|column| of(a, column)))
    }

    /// Returns the matrix of a right-handed rotation about an axis that depends on the variables, by Rodrigues'
    /// formula.
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

/// Returns q v q* = v (w² − u·u) + 2 u (u·v) + 2 w (u × v).
fn spin(a: &mut Algebra, u: Vector, w: Scalar, v: Vector) -> Vector {
    let two = a.number(2.0);
    let (w2, u2, along) = (a.mul(w, w), a.dot(u, u), a.dot(u, v));
    let factors = [a.sub(w2, u2), a.mul(two, along), a.mul(two, w)];
    about(a, v, u, factors)
}

/// Returns kept v + along u + aside (u × v).
fn about(a: &mut Algebra, v: Vector, u: Vector, [kept, along, aside]: [Scalar; 3]) -> Vector {
    let (kept, along, across) = (a.scale(kept, v), a.scale(along, u), a.cross(u, v));
    let (sum, aside) = (a.add_vectors(kept, along), a.scale(aside, across));
    a.add_vectors(sum, aside)
}

/// A quaternion: the map that it stands for, and its components.
#[derive(Clone, Debug)]
pub(crate) struct Quaternion {
    pub(crate) map: Map,
    /// Vector part and scalar part.
    pub(crate) parts: (Vector, Scalar),
}

impl Quaternion {
    /// Returns the quaternion with these parts, of any length.
    pub(crate) fn from_parts(u: Vector, w: Scalar) -> Self {
        Self { map: Map::Spin(u, w), parts: (u, w) }
    }

    /// Returns a quaternion of length 1 that does not depend on the variables.
    pub(crate) fn unit(a: &mut Algebra, u: Vector, w: Scalar) -> Self {
        let map = match (a.g.constant_vector_of(u), a.constant_of(w)) {
            (Some([x, y, z]), Some(w)) => Map::Rotation(a.g.basis(images(x, y, z, w))),
            _ => Map::Rotation(a.g.quaternion(u, w)),
        };
        Self { map, parts: (u, w) }
    }

    /// Returns the vector part and the scalar part. Their derivatives are those of a rotation if it is one.
    pub(crate) fn turning_parts(&self, a: &mut Algebra) -> (Vector, Scalar) {
        match self.map {
            Map::Rotation(rotation) => a.g.quaternion_parts(rotation, self.parts),
            _ => self.parts,
        }
    }

    pub(crate) fn identity(a: &mut Algebra) -> Self {
        let (u, w) = (a.number_vector([0.0; 3]), a.number(1.0));
        Self { map: Map::identity(a), parts: (u, w) }
    }

    /// Returns the right-handed rotation about X, Y or Z.
    pub(crate) fn turn(a: &mut Algebra, axis: usize, radians: Scalar) -> Self {
        let unit = a.axis(axis);
        let parts = half_turn(a, unit, radians);
        Self { map: Map::turn(a, axis, radians), parts }
    }

    pub(crate) fn about(a: &mut Algebra, axis: Vector, radians: Scalar) -> Self {
        let parts = half_turn(a, axis, radians);
        Self { map: Map::Rotation(a.about(axis, radians)), parts }
    }

    /// Normalises a quaternion that depends on the variables; `reciprocal` is 1 / its length.
    pub(crate) fn normalized(a: &mut Algebra, (u, w): (Vector, Scalar), reciprocal: Scalar) -> Self {
        let map = Map::Rotation(a.g.attitude(Attitude::Quaternion(u, w)));
        Self { map, parts: (a.scale(reciprocal, u), a.mul(reciprocal, w)) }
    }

    /// Returns the rotation about an axis that depends on the variables.
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

    /// Returns the rotation about a vector by its length in radians; also defined for length 0.
    pub(crate) fn about_vector(a: &mut Algebra, turn: Vector) -> Self {
        let half = a.number(0.5);
        let half = a.scale(half, turn);
        let square = a.dot(half, half);
        let [w, sine] = [0, 1].map(|order| a.g.stumpff(Stumpff { hyperbolic: false, order }, square));
        let u = a.scale(sine, half);
        if a.varies(Node::Vector(turn)) {
            return Self { map: Map::Rotation(a.g.attitude(Attitude::Turn(turn))), parts: (u, w) };
        }
        Self::unit(a, u, w)
    }

    /// Returns `self` where the condition holds, else `otherwise`.
    pub(crate) fn select(&self, a: &mut Algebra, condition: &Condition, otherwise: &Self) -> Self {
        let ((u, w), (v, x)) = (self.parts, otherwise.parts);
        let (u, w) = (condition.select_vector(a, u, v), condition.select(a, w, x));
        let map = if self.map.size() + otherwise.map.size() > MOST_BEFORE_QUATERNIONS {
            Map::Spin(u, w)
        } else {
            Map::branches(condition, &self.map, &otherwise.map)
        };
        Self { map, parts: (u, w) }
    }

    pub(crate) fn conjugate(&self, a: &mut Algebra) -> Self {
        Self { map: self.map.transpose(a), parts: (a.neg_vector(self.parts.0), self.parts.1) }
    }

    /// Returns `inner` followed by `self`.
    pub(crate) fn compose(&self, a: &mut Algebra, inner: &Self) -> Self {
        let ((u, w), (v, x)) = (self.parts, inner.parts);
        let (wv, xu, uv) = (a.scale(w, v), a.scale(x, u), a.cross(u, v));
        let vector = a.add_vectors(wv, xu);
        let vector = a.add_vectors(vector, uv);
        let (wx, dot) = (a.mul(w, x), a.dot(u, v));
        let parts = (vector, a.sub(wx, dot));
        let map = match (&self.map, &inner.map, self.map.compose(a, &inner.map)) {
            (Map::Rotation(_), Map::Rotation(_), Map::Columns(_)) => Map::Spin(parts.0, parts.1),
            (_, _, map) => map,
        };
        Self { map, parts }
    }
}

/// Returns the parts of the quaternion that rotates about `axis`.
fn half_turn(a: &mut Algebra, axis: Vector, radians: Scalar) -> (Vector, Scalar) {
    let half = a.number(0.5);
    let half = a.mul(half, radians);
    let (sin, cos) = a.sin_cos(half);
    (a.scale(sin, axis), cos)
}

/// Returns the images of the axes under a constant quaternion, which is normalised.
fn images(x: f64, y: f64, z: f64, w: f64) -> [[f64; 3]; 3] {
    let norm = (x * x + y * y + z * z + w * w).sqrt();
    let [x, y, z, w] = [x, y, z, w].map(|c| c / norm);
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// A linear map followed by a translation.
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

    /// Returns `inner` followed by `self`.
    pub(crate) fn compose(&self, a: &mut Algebra, inner: &Self) -> Self {
        Self { map: self.map.compose(a, &inner.map), translation: self.apply(a, inner.translation) }
    }

    pub(crate) fn inverse(&self, a: &mut Algebra) -> Self {
        let map = self.map.inverse(a);
        let back = map.apply(a, self.translation);
        Self { map, translation: a.neg_vector(back) }
    }

    /// Returns a linear map without translation.
    pub(crate) fn about_origin(a: &mut Algebra, map: Map) -> Self {
        Self { map, translation: a.number_vector([0.0; 3]) }
    }
}
