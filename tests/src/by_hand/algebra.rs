//! The few vector operations that the derivations use, each with its operation count.

use std::ops::{Add, Sub};

use aim_symbolic::Number;

/// A vector by its components along a joint's forward, left and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes<T> {
    /// Along forward.
    pub forward: T,
    /// Along left.
    pub left: T,
    /// Along up.
    pub up: T,
}

impl<T: Number> Axes<T> {
    /// A vector of the thug's bones, whose X is up, Y forward and Z left.
    #[inline]
    pub fn of([up, forward, left]: [T; 3]) -> Self {
        Self { forward, left, up }
    }

    /// `k` times the vector: 3.
    #[inline]
    #[must_use]
    pub fn times(self, k: T) -> Self {
        Self { forward: k * self.forward, left: k * self.left, up: k * self.up }
    }

    /// The scalar product: 5.
    #[inline]
    pub fn dot(self, other: Self) -> T {
        self.forward * other.forward + self.left * other.left + self.up * other.up
    }

    /// The length: 6.
    #[inline]
    pub fn norm(self) -> T {
        self.dot(self).sqrt()
    }
}

/// 3
impl<T: Number> Add for Axes<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { forward: self.forward + other.forward, left: self.left + other.left, up: self.up + other.up }
    }
}

/// 3
impl<T: Number> Sub for Axes<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { forward: self.forward - other.forward, left: self.left - other.left, up: self.up - other.up }
    }
}

/// A link: the directions of the outer space, and its origin, as the inner space sees them.
#[derive(Clone, Copy, Debug)]
pub struct Link<T> {
    /// The outer forward.
    pub forward: Axes<T>,
    /// The outer left.
    pub left: Axes<T>,
    /// The outer up.
    pub up: Axes<T>,
    /// The outer origin.
    pub origin: Axes<T>,
}

impl<T: Number> Link<T> {
    /// From the twelve numbers: the rows are the images of X, Y and Z, which are up, forward and left.
    #[inline]
    pub fn of(m: &[T; 12]) -> Self {
        Self {
            up: Axes::of([m[0], m[1], m[2]]),
            forward: Axes::of([m[3], m[4], m[5]]),
            left: Axes::of([m[6], m[7], m[8]]),
            origin: Axes::of([m[9], m[10], m[11]]),
        }
    }

    /// An inner vector in outer components: 15.
    #[inline]
    pub fn outward(&self, v: Axes<T>) -> Axes<T> {
        Axes { forward: self.forward.dot(v), left: self.left.dot(v), up: self.up.dot(v) }
    }

    /// An outer vector in inner components: 15.
    #[inline]
    pub fn inward(&self, v: Axes<T>) -> Axes<T> {
        self.forward.times(v.forward) + self.left.times(v.left) + self.up.times(v.up)
    }
}

/// Sines and cosines of a joint's pitch and heading.
#[derive(Clone, Copy, Debug)]
pub struct Angles<T> {
    /// Sine and cosine of the pitch.
    pub pitch: [T; 2],
    /// Sine and cosine of the heading.
    pub heading: [T; 2],
}

impl<T: Number> Angles<T> {
    /// From sin p, cos p, sin h, cos h.
    #[inline]
    pub fn of([sin_p, cos_p, sin_h, cos_h]: [T; 4]) -> Self {
        Self { pitch: [sin_p, cos_p], heading: [sin_h, cos_h] }
    }
}

/// (a, b) turned by the angle, the first direction towards the second: 6.
#[inline]
pub fn turn<T: Number>([a, b]: [T; 2], [sin, cos]: [T; 2]) -> [T; 2] {
    [turned_first([a, b], [sin, cos]), b * cos + a * sin]
}

/// The first component of [`turn`]: 3.
#[inline]
pub fn turned_first<T: Number>([a, b]: [T; 2], [sin, cos]: [T; 2]) -> T {
    a * cos - b * sin
}

/// (a, b) turned back: 6.
#[inline]
pub fn turn_back<T: Number>([a, b]: [T; 2], [sin, cos]: [T; 2]) -> [T; 2] {
    [a * cos + b * sin, b * cos - a * sin]
}

/// The derivative by the angle that `q` was turned back by, for the covector `g` on it; both on the same side of the
/// turn, whichever: 3.
#[inline]
pub fn moment<T: Number>(g: [T; 2], q: [T; 2]) -> T {
    g[0] * q[1] - g[1] * q[0]
}

/// `numerator` / `length`, 0 where there is no length: 1.
#[inline]
pub fn over<T: Number>(numerator: T, length: T) -> T {
    T::select_less(T::tiny(), length, numerator / length, T::constant(0.0))
}

/// 1 / `length`, 0 where there is no length: 1.
#[inline]
pub fn reciprocal<T: Number>(length: T) -> T {
    over(T::constant(1.0), length)
}

/// A point turned back by a joint's added rotation, and what the derivatives need of the way there.
#[derive(Clone, Copy, Debug)]
pub struct TurnedBack<T> {
    /// Where it is between the two turns.
    pub between: Axes<T>,
    /// Where it ends.
    pub q: Axes<T>,
}

impl<T: Number> TurnedBack<T> {
    /// Heading first, which acted last, then pitch: 12.
    #[inline]
    pub fn from(point: Axes<T>, angles: Angles<T>) -> Self {
        let [ahead, left] = turn_back([point.forward, point.left], angles.heading);
        let [forward, up] = turn_back([ahead, point.up], angles.pitch);
        Self { between: Axes { forward: ahead, left, up: point.up }, q: Axes { forward, left, up } }
    }

    /// The derivative by pitch, for the covector `g` on `q`: 3.
    #[inline]
    pub fn by_pitch(&self, g: Axes<T>) -> T {
        moment([g.forward, g.up], [self.q.forward, self.q.up])
    }

    /// The derivative by heading, for the covector `g` on `q`. It is a moment between the turns, so the covector must be
    /// turned forward by pitch; of that its forward component alone is needed: 6.
    #[inline]
    pub fn by_heading(&self, g: Axes<T>, angles: Angles<T>) -> T {
        let ahead = turned_first([g.forward, g.up], angles.pitch);
        moment([ahead, g.left], [self.between.forward, self.between.left])
    }

    /// Both derivatives, and the covector on the point before it was turned back: 18.
    #[inline]
    pub fn pull(&self, g: Axes<T>, angles: Angles<T>) -> ([T; 2], Axes<T>) {
        let [ahead, up] = turn([g.forward, g.up], angles.pitch);
        // Both moments are taken between the turns.
        let at = self.between;
        let by_pitch = moment([ahead, up], [at.forward, at.up]);
        let by_heading = moment([ahead, g.left], [at.forward, at.left]);
        let [forward, left] = turn([ahead, g.left], angles.heading);
        ([by_pitch, by_heading], Axes { forward, left, up })
    }
}
