//! The vector operations of the derivations, each with its number of operations.

use std::ops::{Add, Sub};

use aim_symbolic::Number;

/// A vector with components along a joint's forward, left and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes<T> {
    /// Component along forward.
    pub forward: T,
    /// Component along left.
    pub left: T,
    /// Component along up.
    pub up: T,
}

impl<T: Number> Axes<T> {
    /// Converts a vector of the thug's bones, whose X is up, Y forward and Z left.
    #[inline]
    pub fn of([up, forward, left]: [T; 3]) -> Self {
        Self { forward, left, up }
    }

    /// Returns `k` times the vector: 3 operations.
    #[inline]
    #[must_use]
    pub fn times(self, k: T) -> Self {
        Self { forward: k * self.forward, left: k * self.left, up: k * self.up }
    }

    /// Returns the dot product: 5 operations.
    #[inline]
    pub fn dot(self, other: Self) -> T {
        self.forward * other.forward + self.left * other.left + self.up * other.up
    }

    /// Returns the length: 6 operations.
    #[inline]
    pub fn norm(self) -> T {
        self.dot(self).sqrt()
    }
}

/// Costs 3 operations.
impl<T: Number> Add for Axes<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { forward: self.forward + other.forward, left: self.left + other.left, up: self.up + other.up }
    }
}

/// Costs 3 operations.
impl<T: Number> Sub for Axes<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { forward: self.forward - other.forward, left: self.left - other.left, up: self.up - other.up }
    }
}

/// A link: the axes and the origin of the outer space, in inner coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Link<T> {
    /// Forward axis of the outer space.
    pub forward: Axes<T>,
    /// Left axis of the outer space.
    pub left: Axes<T>,
    /// Up axis of the outer space.
    pub up: Axes<T>,
    /// Origin of the outer space.
    pub origin: Axes<T>,
}

impl<T: Number> Link<T> {
    /// Converts twelve numbers: the rows are the images of X, Y and Z, which are up, forward and left, then the origin.
    #[inline]
    pub fn of(m: &[T; 12]) -> Self {
        Self {
            up: Axes::of([m[0], m[1], m[2]]),
            forward: Axes::of([m[3], m[4], m[5]]),
            left: Axes::of([m[6], m[7], m[8]]),
            origin: Axes::of([m[9], m[10], m[11]]),
        }
    }

    /// Converts an inner vector to outer components: 15 operations.
    #[inline]
    pub fn outward(&self, v: Axes<T>) -> Axes<T> {
        Axes { forward: self.forward.dot(v), left: self.left.dot(v), up: self.up.dot(v) }
    }

    /// Converts an outer vector to inner components: 15 operations.
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
    /// Converts sin p, cos p, sin h, cos h.
    #[inline]
    pub fn of([sin_p, cos_p, sin_h, cos_h]: [T; 4]) -> Self {
        Self { pitch: [sin_p, cos_p], heading: [sin_h, cos_h] }
    }
}

/// Rotates (a, b) by an angle, the first direction towards the second: 6 operations.
#[inline]
pub fn turn<T: Number>([a, b]: [T; 2], [sin, cos]: [T; 2]) -> [T; 2] {
    [turned_first([a, b], [sin, cos]), b * cos + a * sin]
}

/// Returns only the first component of [`turn`]: 3 operations.
#[inline]
pub fn turned_first<T: Number>([a, b]: [T; 2], [sin, cos]: [T; 2]) -> T {
    a * cos - b * sin
}

/// Rotates (a, b) by the negative angle: 6 operations.
#[inline]
pub fn turn_back<T: Number>([a, b]: [T; 2], [sin, cos]: [T; 2]) -> [T; 2] {
    [a * cos + b * sin, b * cos - a * sin]
}

/// Returns the derivative by the angle by which `q` was rotated back, for the covector `g` on `q`. Both may be taken
/// before or both after the rotation. 3 operations.
#[inline]
pub fn moment<T: Number>(g: [T; 2], q: [T; 2]) -> T {
    g[0] * q[1] - g[1] * q[0]
}

/// Returns `numerator` / `length`, or 0 if the length vanishes: 1 operation.
#[inline]
pub fn over<T: Number>(numerator: T, length: T) -> T {
    T::select_less(T::tiny(), length, numerator / length, T::constant(0.0))
}

/// Returns 1 / `length`, or 0 if the length vanishes: 1 operation.
#[inline]
pub fn reciprocal<T: Number>(length: T) -> T {
    over(T::constant(1.0), length)
}

/// A point rotated back by a joint's added rotation, with the intermediate result that the derivatives need.
#[derive(Clone, Copy, Debug)]
pub struct TurnedBack<T> {
    /// The point after heading is undone and before pitch is.
    pub between: Axes<T>,
    /// The point after both rotations are undone.
    pub q: Axes<T>,
}

impl<T: Number> TurnedBack<T> {
    /// Undoes heading first, which acted last, then pitch: 12 operations.
    #[inline]
    pub fn from(point: Axes<T>, angles: Angles<T>) -> Self {
        let [ahead, left] = turn_back([point.forward, point.left], angles.heading);
        let [forward, up] = turn_back([ahead, point.up], angles.pitch);
        Self { between: Axes { forward: ahead, left, up: point.up }, q: Axes { forward, left, up } }
    }

    /// Returns the derivative by pitch, for the covector `g` on `q`: 3 operations.
    #[inline]
    pub fn by_pitch(&self, g: Axes<T>) -> T {
        moment([g.forward, g.up], [self.q.forward, self.q.up])
    }

    /// Returns the derivative by heading, for the covector `g` on `q`. The moment is taken between the two rotations,
    /// so `g` must be rotated forward by pitch; only its forward component is needed. 6 operations.
    #[inline]
    pub fn by_heading(&self, g: Axes<T>, angles: Angles<T>) -> T {
        let ahead = turned_first([g.forward, g.up], angles.pitch);
        moment([ahead, g.left], [self.between.forward, self.between.left])
    }

    /// Returns both derivatives, and the covector on the point before it was rotated back: 18 operations.
    #[inline]
    pub fn pull(&self, g: Axes<T>, angles: Angles<T>) -> ([T; 2], Axes<T>) {
        let [ahead, up] = turn([g.forward, g.up], angles.pitch);
        // Take both moments between the two rotations.
        let at = self.between;
        let by_pitch = moment([ahead, up], [at.forward, at.up]);
        let by_heading = moment([ahead, g.left], [at.forward, at.left]);
        let [forward, left] = turn([ahead, g.left], angles.heading);
        ([by_pitch, by_heading], Axes { forward, left, up })
    }
}
