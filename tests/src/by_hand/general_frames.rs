//! The aim of joints whose bone axes are any constant orthonormal directions: forward `F`, left `L`, up `U` of either
//! handedness, given in bone components. The effector looks along joint 0's forward.
//!
//! The straightforward way changes basis around both rotations of every joint, at 15 operations per vector and side:
//! the target into the bone's axes and out again, and the covector likewise. This adds 60 per joint. Two observations
//! reduce it.
//!
//! **A rotation needs its axis, not the zero of its angle.** Any two orthogonal directions in its plane will do: `E₁`
//! and `E₂`, which are `F` and `U` rotated by a constant ε; the angle is then p + ε. Choose ε so that `E₂` has no
//! component along one of the bone's coordinate axes `k`, `E₂ = (e_i, e_j, 0)`. With `N = (−e_j, e_i, 0)`, the
//! perpendicular direction in that coordinate plane, `E₁` and `L` both lie in the plane of `N` and `k`, so that with
//! `b = a · N`
//!
//! ```text
//! a · E₂ = e_i a_i + e_j a_j     a · E₁ = (E₁ · N) b + E₁ₖ a_k     a · L = (L · N) b + Lₖ a_k
//! ```
//!
//! **Constant scales are free.** All components may be too large by a known constant. Divided by `e_i`, the products
//! `b` and `a · E₂` cost 2 each, the other two cost 3 whatever their scale: **10 instead of 15**. The way back, to true
//! components, is 11: 2 for `b`, 3 for each component. And of
//!
//! ```text
//! sin(p + ε) / cos ε = sin p + tan ε cos p     cos(p + ε) / cos ε = cos p − tan ε sin p
//! ```
//!
//! each is 2: 4 for an angle, however many vectors are rotated by it. The rotation scales its plane by 1 / cos ε; the
//! constants of the next change of basis compensate in the remaining component. (ε, k and i are chosen so that cos ε ≥
//! 0.7 and `|e_i|` ≥ 0.7, so nothing here is ill conditioned.)
//!
//! With β the scale of `q` between the two rotations, `q` after pitch has the scale β / cos ε in the plane and β along
//! `L`. The covector gets the inverse scales, so that the moments are true. The remaining common scale of the covector
//! is folded, at each joint, into the constants of the joint before, and at joint 0 into its reciprocal length.
//!
//! The effector's forward `f` in bone components is a [constant direction](super::general_forward) transformed by the
//! link: 12, not 15.
//!
//! | | each | how often |
//! |---|---|---|
//! | a chain of cardinal joints | 63 N − 16 | 1 |
//! | sine and cosine of p + ε and of h + δ | 8 | N |
//! | the target into heading's plane, out of pitch's | 10 + 11 | N |
//! | the covector into pitch's plane | 10 | N |
//! | the covector out of heading's plane | 11 | N − 1 |
//! | f; its scale and the covector's | 12 + 2 | 1 |
//!
//! The total is 113 N − 13. For one joint, applying the factor 1 / n last saves 1: 99. The aim alone is 27 + 4 + 10 + 4
//! + 11 + 12 + 1 = 69.
//!
//! Rejected:
//! - Change of basis by 15 (14 for one of the target's, scaled so that an entry is 1): 103 for one joint.
//! - One joint, compared between the rotations: `f` and `t` into pitch's plane, rotated by pitch: 101.
//! - One joint, compared in the bone's axes, with `f` and `t` converted to them: 100.
//! - Changes of basis multiplied into the links: 45, or 39 with a cross product, to save 30.

use aim_codegen::Frame;
use aim_symbolic::Number;

use super::algebra::{moment, over, reciprocal, turn, turn_back, turned_first};
use super::general_forward::Direction;

type Vector<T> = [T; 3];

/// A vector split into its components in a rotation's plane and along its axis.
#[derive(Clone, Copy, Debug)]
struct Split<T> {
    plane: [T; 2],
    axis: T,
}

/// The constants of one rotation: two directions of its plane, one of which has no component along a coordinate axis,
/// and its axis.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// Coordinate axes: the two of the sparse direction, the larger component first, and the one along which it has no
    /// component.
    axes: [usize; 3],
    /// Index of the sparse one among the plane's two directions.
    sparse: usize,
    /// Components Eᵢ and Eⱼ of the sparse direction.
    e: [f64; 2],
    /// Components of the other direction along N and k.
    other: [f64; 2],
    /// Components of the rotation axis along N and k.
    axis: [f64; 2],
    /// Tangent of the angle from (first, second) to the plane's two directions.
    tan: f64,
    /// Cosine of the angle from (first, second) to the plane's two directions.
    cos: f64,
}

impl Turn {
    /// Creates the rotation from `first` towards `second` about `axis`, all constant.
    fn new(first: [f64; 3], second: [f64; 3], axis: [f64; 3]) -> Self {
        let k = (1..3).fold(0, |best, k| if axis[k].abs() < axis[best].abs() { k } else { best });
        // E₁ = cos first + sin second, E₂ = cos second − sin first. The sparse one is that which needs the smaller
        // angle.
        let (sparse, tan) =
            if first[k].abs() >= second[k].abs() { (1, second[k] / first[k]) } else { (0, -first[k] / second[k]) };
        let cos = 1.0 / (1.0 + tan * tan).sqrt();
        let sin = tan * cos;
        let plane: [[f64; 3]; 2] = [
            core::array::from_fn(|i| cos * first[i] + sin * second[i]),
            core::array::from_fn(|i| cos * second[i] - sin * first[i]),
        ];
        let flat = plane[sparse];
        let (mut i, mut j) = ((k + 1) % 3, (k + 2) % 3);
        if flat[j].abs() > flat[i].abs() {
            (i, j) = (j, i);
        }
        let e = [flat[i], flat[j]];
        let along = |v: [f64; 3]| [e[0] * v[j] - e[1] * v[i], v[k]];
        Self { axes: [i, j, k], sparse, e, other: along(plane[1 - sparse]), axis: along(axis), tan, cos }
    }

    /// Returns sine and cosine of the angle relative to the plane's own directions, divided by cos ε, for rotating `q`
    /// back: 4 operations. `before` if the plane is that of the point before the rotation, not of the result.
    #[inline]
    fn sin_cos<T: Number>(&self, [sin, cos]: [T; 2], before: bool) -> [T; 2] {
        let tan = T::constant(if before { -self.tan } else { self.tan });
        [sin + tan * cos, cos - tan * sin]
    }

    /// Returns the factor by which [`split`](Self::split) multiplies the components in the plane.
    fn scale(&self) -> f64 {
        1.0 / self.e[0]
    }

    /// Splits `v` into its components in the plane, multiplied by [`scale`](Self::scale), and along the axis,
    /// multiplied by `axis_scale`: 10 operations.
    #[inline]
    fn split<T: Number>(&self, v: Vector<T>, axis_scale: f64) -> Split<T> {
        let [a, b, c] = self.axes.map(|axis| v[axis]);
        let ratio = T::constant(self.e[1] / self.e[0]);
        let sparse = a + ratio * b;
        // v · N / e_i
        let n = b - ratio * a;
        let of = |[along_n, along_k]: [f64; 2], scale: f64| {
            T::constant(scale * along_n * self.e[0]) * n + T::constant(scale * along_k) * c
        };
        let other = of(self.other, self.scale());
        let plane = if self.sparse == 0 { [sparse, other] } else { [other, sparse] };
        Split { plane, axis: of(self.axis, axis_scale) }
    }

    /// Returns the vector whose components in the plane and along the axis are `factors` times those of `v`: 11
    /// operations.
    #[inline]
    fn join<T: Number>(&self, v: Split<T>, [plane, axis]: [f64; 2]) -> Vector<T> {
        let (sparse, other) = (v.plane[self.sparse], v.plane[1 - self.sparse]);
        let [other_n, axis_n] = [plane * self.other[0], axis * self.axis[0]];
        // The component along N, divided by the larger of the two factors.
        let (n, scale) = if other_n.abs() >= axis_n.abs() {
            (other + T::constant(axis_n / other_n) * v.axis, other_n)
        } else {
            (v.axis + T::constant(other_n / axis_n) * other, axis_n)
        };
        let [i, j, k] = self.axes;
        let mut joined = [v.axis; 3];
        joined[i] = T::constant(plane * self.e[0]) * sparse - T::constant(scale * self.e[1]) * n;
        joined[j] = T::constant(plane * self.e[1]) * sparse + T::constant(scale * self.e[0]) * n;
        joined[k] = T::constant(plane * self.other[1]) * other + T::constant(axis * self.axis[1]) * v.axis;
        joined
    }
}

/// The constants of a joint with general axes.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    pitch: Turn,
    heading: Turn,
    /// Scale β of `q` between the two rotations.
    between: f64,
    /// Factor by which the covector that enters this joint must be multiplied.
    covector: f64,
}

impl Joint {
    /// Computes the constants of a joint with these bone axes.
    pub fn new(frame: &Frame) -> Self {
        let pitch = Turn::new(frame.forward, frame.up, frame.left);
        let heading = Turn::new(frame.forward, frame.left, frame.up);
        let between = heading.scale() / heading.cos;
        // In the plane, q has the scale β / cos ε; the covector must have the inverse.
        let covector = pitch.cos / (between * pitch.scale());
        Self { pitch, heading, between, covector }
    }

    /// Rotates the target back: 8 + 10 + 12 + 11 operations.
    #[inline]
    fn turn_back<T: Number>(&self, point: Vector<T>, [sin_p, cos_p, sin_h, cos_h]: [T; 4]) -> (Way<T>, Vector<T>) {
        let pitch = self.pitch.sin_cos([sin_p, cos_p], false);
        let heading = self.heading.sin_cos([sin_h, cos_h], true);
        let split = self.heading.split(point, self.between);
        let [ahead, left] = turn_back(split.plane, heading);
        let plane = turn_back([ahead, split.axis], pitch);
        let scales = [self.pitch.cos / self.between, 1.0 / self.between];
        let q = self.pitch.join(Split { plane, axis: left }, scales);
        (Way { pitch, heading, ahead, left, plane }, q)
    }

    /// Splits the covector in the plane of pitch: 10 operations.
    #[inline]
    fn split<T: Number>(&self, g: Vector<T>) -> Split<T> {
        self.pitch.split(g, 1.0 / (self.between * self.covector))
    }
}

/// Intermediate results of a point's way through a joint, which the derivatives need.
#[derive(Clone, Copy, Debug)]
struct Way<T> {
    pitch: [T; 2],
    heading: [T; 2],
    /// Forward component between the rotations, in heading's plane.
    ahead: T,
    /// Left component between the rotations, in heading's plane.
    left: T,
    /// Components after both rotations, in pitch's plane.
    plane: [T; 2],
}

impl<T: Number> Way<T> {
    /// Returns the derivatives by pitch and heading: 9 operations.
    #[inline]
    fn moments(&self, g: Split<T>) -> [T; 2] {
        let ahead = turned_first(g.plane, self.pitch);
        [moment(g.plane, self.plane), moment([ahead, g.axis], [self.ahead, self.left])]
    }

    /// Returns the derivatives by pitch and heading, and the covector rotated forward, in heading's plane: 18
    /// operations.
    #[inline]
    fn pull(&self, g: Split<T>) -> ([T; 2], Split<T>) {
        let [ahead, up] = turn(g.plane, self.pitch);
        let between = [ahead, g.axis];
        let moments = [moment(g.plane, self.plane), moment(between, [self.ahead, self.left])];
        (moments, Split { plane: turn(between, self.heading), axis: up })
    }
}

fn sub<T: Number>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot<T: Number>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn origin<T: Number>(link: &[T; 12]) -> Vector<T> {
    [link[9], link[10], link[11]]
}

/// Returns the aim: 69 operations. `forward` is the joint's.
#[inline]
pub fn aim<T: Number>(
    joint: &Joint,
    forward: &Direction,
    effector_to_joint: &[T; 12],
    target: [T; 3],
    sin_cos: [T; 4],
) -> T {
    let (_, q) = joint.turn_back(target, sin_cos);
    let v = sub(q, origin(effector_to_joint));
    over(forward.size(), dot(v, v).sqrt()) * dot(forward.seen(effector_to_joint), v)
}

/// Returns the aim and its derivatives by pitch and heading, joint by joint: 113 N − 13 operations, 99 for one joint.
/// `forward` is joint 0's.
#[inline]
pub fn aim_gradient<T: Number, const N: usize>(
    joints: &[Joint; N],
    forward: &Direction,
    links: &[[T; 12]; N],
    target: [T; 3],
    sin_cos: &[[T; 4]; N],
) -> (T, [[T; 2]; N]) {
    let zero = T::constant(0.0);
    let mut ways = [Way { pitch: [zero; 2], heading: [zero; 2], ahead: zero, left: zero, plane: [zero; 2] }; N];
    let mut v = target;
    for i in (0..N).rev() {
        let (way, q) = joints[i].turn_back(v, sin_cos[i]);
        ways[i] = way;
        v = sub(q, origin(&links[i]));
        if i > 0 {
            v = core::array::from_fn(|row| dot([links[i][3 * row], links[i][3 * row + 1], links[i][3 * row + 2]], v));
        }
    }

    let f = forward.seen(&links[0]);
    let r = reciprocal(dot(v, v).sqrt());
    let over_n = r * dot(f, v);
    let aim = forward.size::<T>() * over_n;
    let sigma = r * over_n;
    let rho = T::constant(joints[0].covector * forward.size) * r;
    let mut g: Vector<T> = core::array::from_fn(|i| f[i] - sigma * v[i]);

    let mut gradient = [[zero; 2]; N];
    if N == 1 {
        gradient[0] = ways[0].moments(joints[0].split(g)).map(|moment| rho * moment);
        return (aim, gradient);
    }
    g = g.map(|g| rho * g);
    for i in 0..N - 1 {
        let split;
        (gradient[i], split) = ways[i].pull(joints[i].split(g));
        // In heading's plane q has that plane's scale, along its axis β; the covector has the inverses.
        let scale = joints[i + 1].covector;
        g = joints[i].heading.join(split, [scale * joints[i].heading.scale(), scale * joints[i].between]);
        let link = links[i + 1];
        g = core::array::from_fn(|k| link[k] * g[0] + link[3 + k] * g[1] + link[6 + k] * g[2]);
    }
    gradient[N - 1] = ways[N - 1].moments(joints[N - 1].split(g));
    (aim, gradient)
}
