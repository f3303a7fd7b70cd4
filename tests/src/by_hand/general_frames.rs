//! The aim of joints whose bone axes are any constant orthonormal directions: forward `F`, left `L`, up `U` of either
//! handedness, given in bone components. The effector looks along joint 0's forward.
//!
//! The plain way changes basis around both turns of every joint, 15 operations for each vector on each side: the target
//! into the bone's axes and out again, the covector likewise. That adds 60 a joint. Two observations make it less.
//!
//! **A turn needs its axis, not the zero of its angle.** In its plane any two directions serve, `E₁` and `E₂` at `F` and
//! `U` turned by a constant ε: then the angle is p + ε. Choose ε so that `E₂` has no component along one of the bone's
//! coordinate axes `k`, `E₂ = (e_i, e_j, 0)`. With `N = (−e_j, e_i, 0)`, the direction across it in that coordinate plane,
//! `E₁` and `L` both lie in the plane of `N` and `k`, so that with `b = a · N`
//!
//! ```text
//! a · E₂ = e_i a_i + e_j a_j     a · E₁ = (E₁ · N) b + E₁ₖ a_k     a · L = (L · N) b + Lₖ a_k
//! ```
//!
//! **Constant scales are free.** All components may be some constant times too large, as long as it is known: divided by
//! `e_i`, the products `b` and `a · E₂` cost 2 each, the other two 3 whatever their scale: **10 instead of 15**. The way
//! back, to true components, is 11: 2 for `b`, 3 for each component. And of
//!
//! ```text
//! sin(p + ε) / cos ε = sin p + tan ε cos p     cos(p + ε) / cos ε = cos p − tan ε sin p
//! ```
//!
//! each is 2: 4 for an angle, however many vectors are turned by it. What a turn scales by 1 / cos ε, the other component
//! makes up for in the constants of the next change of basis. (ε, k and i are chosen so that cos ε ≥ 0.7 and `|e_i|` ≥ 0.7:
//! nothing here is ill conditioned.)
//!
//! So with β the scale of `q` between the two turns, `q` after pitch is in the plane at β / cos ε and along `L` at β; the
//! covector gets the inverse scales, so that moments come out true. What comes of that as one scale for the whole
//! covector, at each joint, is folded into the constants of the joint before, and at joint 0 into its reciprocal length.
//!
//! The effector's forward `f` in bone components is a [constant direction](super::general_forward) seen through the
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
//! In all 113 N − 13. With one joint the late factor 1 / n saves 1: 99. The aim alone is 27 + 4 + 10 + 4 + 11 + 12 + 1 = 69.
//!
//! Rejected:
//! - Change of basis by 15 (14 for one of the target's, scaled so that an entry is 1): 103 for one joint.
//! - One joint, compared between the turns: `f` and `t` into pitch's plane, turned by pitch: 101.
//! - One joint, compared in the bone's axes, `f` and `t` brought there: 100.
//! - Changes of basis multiplied into the links: 45, or 39 with a cross product, to save 30.

use aim_codegen::Frame;
use aim_symbolic::Number;

use super::algebra::{moment, over, reciprocal, turn, turn_back, turned_first};
use super::general_forward::Direction;

type Vector<T> = [T; 3];

/// A vector as a turn sees it: in the turn's plane, and along its axis.
#[derive(Clone, Copy, Debug)]
struct Split<T> {
    plane: [T; 2],
    axis: T,
}

/// The constants of one turn: its plane's two directions, one of which misses a coordinate axis, and its axis.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// Coordinate axes: the two that the sparse direction has, the larger first, and the one that it misses.
    axes: [usize; 3],
    /// Which of the plane's two directions is the sparse one.
    sparse: usize,
    /// Eᵢ and Eⱼ of the sparse direction.
    e: [f64; 2],
    /// The other direction's components along N and k.
    other: [f64; 2],
    /// The axis' components along N and k.
    axis: [f64; 2],
    /// tan and cos of the angle from (first, second) to the plane's two directions.
    tan: f64,
    cos: f64,
}

impl Turn {
    /// The turn from `first` towards `second` about `axis`, all constant.
    fn new(first: [f64; 3], second: [f64; 3], axis: [f64; 3]) -> Self {
        let k = (1..3).fold(0, |best, k| if axis[k].abs() < axis[best].abs() { k } else { best });
        // E₁ = cos first + sin second, E₂ = cos second − sin first: the sparse one is that which needs the smaller angle.
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

    /// Sine and cosine of the angle from the plane's own directions, where `q` is turned back from `first`, over cos:
    /// 4. `before` where the plane is that of the point to be turned, not of the result.
    #[inline]
    fn sin_cos<T: Number>(&self, [sin, cos]: [T; 2], before: bool) -> [T; 2] {
        let tan = T::constant(if before { -self.tan } else { self.tan });
        [sin + tan * cos, cos - tan * sin]
    }

    /// What [`split`](Self::split) multiplies the components in the plane by.
    fn scale(&self) -> f64 {
        1.0 / self.e[0]
    }

    /// `v` in the plane, multiplied by [`scale`](Self::scale), and along the axis, multiplied by `axis_scale`: 10.
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

    /// The vector whose components in the plane and along the axis are `factors` times those of `v`: 11.
    #[inline]
    fn join<T: Number>(&self, v: Split<T>, [plane, axis]: [f64; 2]) -> Vector<T> {
        let (sparse, other) = (v.plane[self.sparse], v.plane[1 - self.sparse]);
        let [other_n, axis_n] = [plane * self.other[0], axis * self.axis[0]];
        // Along N, over the larger of the two factors.
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

/// The constants of a joint.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    pitch: Turn,
    heading: Turn,
    /// β: what `q` is multiplied by between the turns.
    between: f64,
    /// What the covector that comes to this joint has to be multiplied by.
    covector: f64,
}

impl Joint {
    /// Of a joint with these bone axes.
    pub fn new(frame: &Frame) -> Self {
        let pitch = Turn::new(frame.forward, frame.up, frame.left);
        let heading = Turn::new(frame.forward, frame.left, frame.up);
        let between = heading.scale() / heading.cos;
        // In the plane, q is at β / cos ε; the covector must be at the inverse of that.
        let covector = pitch.cos / (between * pitch.scale());
        Self { pitch, heading, between, covector }
    }

    /// The target turned back: 8 + 10 + 12 + 11.
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

    /// The covector in the plane of pitch: 10.
    #[inline]
    fn split<T: Number>(&self, g: Vector<T>) -> Split<T> {
        self.pitch.split(g, 1.0 / (self.between * self.covector))
    }
}

/// What the derivatives need of a point's way through a joint.
#[derive(Clone, Copy, Debug)]
struct Way<T> {
    pitch: [T; 2],
    heading: [T; 2],
    /// Between the turns, in heading's plane.
    ahead: T,
    left: T,
    /// After both, in pitch's plane.
    plane: [T; 2],
}

impl<T: Number> Way<T> {
    /// By pitch, by heading: 9.
    #[inline]
    fn moments(&self, g: Split<T>) -> [T; 2] {
        let ahead = turned_first(g.plane, self.pitch);
        [moment(g.plane, self.plane), moment([ahead, g.axis], [self.ahead, self.left])]
    }

    /// By pitch, by heading; the covector turned forward, in heading's plane: 18.
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

/// aim: 69. `forward` is that of the joint.
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

/// aim; by pitch and heading, joint by joint. 113 N − 13, for one joint 99. `forward` is that of joint 0.
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
        // In heading's plane q came at that plane's scale, along its axis at β: the covector is at their inverses.
        let scale = joints[i + 1].covector;
        g = joints[i].heading.join(split, [scale * joints[i].heading.scale(), scale * joints[i].between]);
        let link = links[i + 1];
        g = core::array::from_fn(|k| link[k] * g[0] + link[3 + k] * g[1] + link[6 + k] * g[2]);
    }
    gradient[N - 1] = ways[N - 1].moments(joints[N - 1].split(g));
    (aim, gradient)
}
