//! Vectors and rotations in f64, by their definitions, to judge the limb and look-at solvers.

use aim_runtime::glam::{Quat, Vec3};

pub type Point = [f64; 3];

pub fn exact(v: Vec3) -> Point {
    v.to_array().map(f64::from)
}

pub fn minus(a: Point, b: Point) -> Point {
    core::array::from_fn(|i| a[i] - b[i])
}

pub fn plus(a: Point, b: Point) -> Point {
    core::array::from_fn(|i| a[i] + b[i])
}

pub fn length(a: Point) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn dot(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns `v` rotated, by the definition q v q*.
pub fn turned(q: Quat, v: Point) -> Point {
    let [x, y, z, w] = q.to_array().map(f64::from);
    let twice = cross([x, y, z], v).map(|c| 2.0 * c);
    let again = cross([x, y, z], twice);
    core::array::from_fn(|i| v[i] + w * twice[i] + again[i])
}

/// Returns the angle between two vectors, radians.
pub fn angle(a: Point, b: Point) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}

/// Returns the angle of a rotation along its shorter arc, radians.
pub fn angle_of(turn: Quat) -> f64 {
    let [x, y, z, w] = turn.to_array().map(f64::from);
    2.0 * length([x, y, z]).atan2(w.abs())
}

/// Returns `true` if a rotation is finite and unit, which every solver must guarantee.
pub fn is_sound(turn: Quat) -> bool {
    turn.is_finite() && (turn.length() - 1.0).abs() < 1e-6
}

/// Returns random numbers, some or all of which have arbitrary bits.
pub fn numbers<const N: usize>(rng: &mut super::Rng) -> [f32; N] {
    let share = [1, 4, 12][rng.below(3)];
    core::array::from_fn(|_| if rng.below(share) == 0 { rng.any() } else { rng.between(-1.0, 1.0) })
}
