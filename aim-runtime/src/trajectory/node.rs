//! What is kept of each frame, and the arithmetic of points.

use glam::Vec3;

use crate::Scalar;

pub(super) type Point = [f64; 3];

/// The workspace of one frame. Make as many as there are frames, once, and keep them: their contents do not matter.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// As animated.
    pub(super) rest: Point,
    /// α and β as animated.
    pub(super) place: [f64; 2],
    /// The same, rounded.
    pub(super) rounded: [f64; 2],
    pub(super) point: Point,
    pub(super) trial: Point,
    pub(super) gradient: Point,
    pub(super) step: Point,
    /// The acceleration of the frame before, of this and of the next one's offsets: factors, with the root of its weight.
    pub(super) stencil: [f64; 3],
    /// Does not move.
    pub(super) fixed: bool,
    /// A spring to a point, and its weight.
    pub(super) spring: (f64, Point),
    /// Of the three rows of the symmetric matrix: the diagonal, then what is left of it, outward.
    pub(super) rows: [[f64; BAND]; 3],
}

/// The diagonal and what is beside it: a frame's number and two frames before.
pub(super) const BAND: usize = 9;

impl Default for Node {
    fn default() -> Self {
        Self {
            rest: [0.0; 3],
            place: [0.0; 2],
            rounded: [0.0; 2],
            point: [0.0; 3],
            trial: [0.0; 3],
            gradient: [0.0; 3],
            step: [0.0; 3],
            stencil: [0.0; 3],
            fixed: false,
            spring: (0.0, [0.0; 3]),
            rows: [[0.0; BAND]; 3],
        }
    }
}

pub(super) fn wide(point: Vec3) -> Point {
    point.to_array().map(f64::from)
}

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn scaled(factor: f64, a: Point) -> Point {
    a.map(|x| factor * x)
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn length(a: Point) -> f64 {
    <f64 as Scalar>::sqrt(dot(a, a))
}
