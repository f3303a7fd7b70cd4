//! Triangulations of directions on the sphere for [`AimPoses`](super::AimPoses): computed once, when poses are loaded.

use glam::{Vec3, Vec3A};

use crate::math::{cross, direction};

/// Triangulates a grid, row by row. The direction at `row * columns + column` is joined with its neighbours.
///
/// Fills and returns the first `2 (columns − 1) (rows − 1)` elements of `triangles`. `None` if they do not fit.
pub fn grid(columns: usize, rows: usize, triangles: &mut [[usize; 3]]) -> Option<&[[usize; 3]]> {
    let (across, down) = (columns.checked_sub(1)?, rows.checked_sub(1)?);
    let count = across.checked_mul(down)?.checked_mul(2)?;
    let filled = triangles.get_mut(..count)?;
    for (cell, pair) in filled.chunks_exact_mut(2).enumerate() {
        let corner = cell / across * columns + cell % across;
        let below = corner + columns;
        pair.copy_from_slice(&[[corner, corner + 1, below], [below, corner + 1, below + 1]]);
    }
    Some(filled)
}

/// Triangulates scattered directions so that no direction lies inside the circumcircle of a triangle (a Delaunay
/// triangulation on the sphere). Of directions on one circle, as on a grid, the first triangles that fit are taken.
///
/// Fills and returns the first elements of `triangles`, at most `2 n − 4`. `None` if they do not fit, if a direction is
/// zero or not finite, if two are equal, or if no triangle results. Takes on the order of `n⁴` steps for `n`
/// directions, so it suits dozens of poses.
pub fn triangulated<'t>(directions: &[Vec3], triangles: &'t mut [[usize; 3]]) -> Option<&'t [[usize; 3]]> {
    /// Height above a plane from which a point of the unit sphere counts as above it.
    const ABOVE: f32 = 1e-5;
    const NEARLY: f32 = 1e-3;
    let at = |index: usize| direction(directions[index].into()).unwrap_or(Vec3A::ZERO);
    let count = directions.len();
    let is_alike = |a: usize| at(a) == Vec3A::ZERO || (0..a).any(|b| (at(a) - at(b)).length() < ABOVE);
    if (0..count).any(is_alike) {
        return None;
    }
    let mut filled = 0;
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                let normal = cross(at(b) - at(a), at(c) - at(a));
                let Some(normal) = direction(normal) else { continue };
                // Orient the plane away from the centre of the sphere. A face that closes the far side of the covered
                // region then has directions above it and is not taken.
                let height = normal.dot(at(a));
                let (normal, height) = if height < 0.0 { (-normal, -height) } else { (normal, height) };
                let is_empty = (0..count).all(|other| normal.dot(at(other)) <= height + ABOVE);
                if height <= ABOVE || !is_empty {
                    continue;
                }
                let candidate = [a, b, c];
                // Only directions on one circle can be joined in more than one way.
                let is_on_circle =
                    |triangle: &[usize; 3]| triangle.iter().all(|&i| normal.dot(at(i)) > height - NEARLY);
                let rivals = triangles[..filled].iter().filter(|triangle| is_on_circle(triangle));
                if rivals.into_iter().any(|triangle| overlap(triangle, &candidate, at)) {
                    continue;
                }
                *triangles.get_mut(filled)? = candidate;
                filled += 1;
            }
        }
    }
    (filled > 0).then(|| &triangles[..filled])
}

/// Returns `true` if two triangles of one hemisphere overlap in more than an edge, that is, if no edge of either
/// separates them.
fn overlap(one: &[usize; 3], other: &[usize; 3], at: impl Fn(usize) -> Vec3A) -> bool {
    const BEYOND: f32 = 1e-6;
    let parts = |one: &[usize; 3], other: &[usize; 3]| {
        (0..3).any(|corner| {
            let [a, b, c] = [0, 1, 2].map(|next| at(one[(corner + next) % 3]));
            let edge = cross(a, b);
            let inward = if edge.dot(c) < 0.0 { -edge } else { edge };
            other.iter().all(|&point| inward.dot(at(point)) <= BEYOND)
        })
    };
    !parts(one, other) && !parts(other, one)
}
