//! [`Node`]: the workspace of each frame, and the arithmetic of points.

use glam::Vec3;

use crate::Scalar;

pub(super) type Point = [f64; 3];

/// Workspace of one frame. Allocate one per frame and reuse them: their contents do not matter.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Animated point.
    pub(super) rest: Point,
    /// Animated place, α and β.
    pub(super) place: [f64; 2],
    /// Animated place of the rounded term.
    pub(super) rounded: [f64; 2],
    /// Current point.
    pub(super) point: Point,
    /// Point after the step that is tried.
    pub(super) trial: Point,
    /// Gradient of the cost by this point.
    pub(super) gradient: Point,
    /// Step of the linear solve.
    pub(super) step: Point,
    /// Coefficients of the change of acceleration on the offsets of the previous, this and the next frame, scaled by
    /// the root of the frame's share of time.
    pub(super) stencil: [f64; 3],
    /// `true` if the point is fixed.
    pub(super) fixed: bool,
    /// Weight and anchor of a spring; for a fixed point, weight 0 and its position.
    pub(super) spring: (f64, Point),
    /// Three rows of the lower triangle of the symmetric matrix: the diagonal entry, then the entries left of it,
    /// outward.
    pub(super) rows: [[f64; BAND]; 3],
}

/// Band width including the diagonal: a point interacts with itself and the two points before it, three coordinates
/// each.
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
