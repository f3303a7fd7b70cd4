//! [`Ray`], and its intersection with a triangle.

use aim_runtime::glam::{Vec3, Vec3A};

/// Ray or line segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start point.
    pub origin: Vec3,
    /// Direction, of any length but zero.
    pub direction: Vec3,
    /// Ray parameter of the end, in lengths of the direction: at least 0, infinite for a ray without an end.
    pub end: f32,
}

impl Ray {
    /// Creates a ray without an end.
    #[must_use]
    pub const fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, end: f32::INFINITY }
    }

    /// Creates the segment between two points.
    #[must_use]
    pub fn segment(from: Vec3, to: Vec3) -> Self {
        Self { origin: from, direction: to - from, end: 1.0 }
    }

    /// Returns the point at ray parameter `part`: `origin + part · direction`.
    #[must_use]
    pub fn at(&self, part: f32) -> Vec3 {
        self.origin + self.direction * part
    }

    /// Returns `true` if the ray is valid: origin and direction are finite, the direction is not zero, and the end is
    /// not negative or NaN. Invalid rays meet nothing.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction != Vec3::ZERO && self.end >= 0.0
    }
}

/// Intersection of a ray with a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// Ray parameter, in lengths of the direction.
    pub(crate) part: f64,
    /// Barycentric coordinates.
    pub(crate) barycentric: [f64; 3],
}

/// Transform into a space in which a ray starts at the origin and runs along z: permutes the axes so that z is the
/// largest component of the direction, then shears.
///
/// After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", 2013.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shear {
    origin: [f64; 3],
    axes: [usize; 3],
    /// x, y and ray parameter per unit of z, along the ray.
    slopes: [f64; 3],
}

impl Shear {
    /// Creates the transform of a sound ray.
    pub(crate) fn new(ray: &Ray) -> Self {
        let direction = ray.direction.to_array().map(f64::from);
        let larger = |a: usize, b: usize| if direction[b].abs() > direction[a].abs() { b } else { a };
        let z = larger(larger(0, 1), 2);
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let slopes = [direction[axes[0]] / direction[z], direction[axes[1]] / direction[z], 1.0 / direction[z]];
        Self { origin: ray.origin.to_array().map(f64::from), axes, slopes }
    }

    /// Transforms a corner: sheared x and y, and the ray parameter as z. The result does not depend on the triangle, so
    /// that no ray passes between triangles that share the corner.
    fn sheared(&self, corner: Vec3A) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|axis| f64::from(corner[axis]) - self.origin[axis]);
        [x - self.slopes[0] * z, y - self.slopes[1] * z, z * self.slopes[2]]
    }

    /// Intersects the whole line of the ray with a triangle, from either side. A line through an edge meets all
    /// triangles of that edge.
    ///
    /// `None` if the line misses the triangle, if the triangle's projection along the line has no area, or if a corner
    /// is not finite.
    pub(crate) fn crossing(&self, corners: [Vec3A; 3]) -> Option<Crossing> {
        let [a, b, c] = corners.map(|corner| self.sheared(corner));
        // Edge functions: twice the signed area of the triangle of the origin and each edge. Two triangles that share
        // an edge get the same value with opposite signs.
        let area = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        let areas = [area(b, c), area(c, a), area(a, b)];
        if areas.iter().any(|area| *area < 0.0) && areas.iter().any(|area| *area > 0.0) {
            return None;
        }
        let total: f64 = areas.iter().sum();
        let barycentric = areas.map(|area| area / total);
        let part = barycentric[0] * a[2] + barycentric[1] * b[2] + barycentric[2] * c[2];
        // Not finite if the area is 0 or a corner is not finite.
        part.is_finite().then_some(Crossing { part, barycentric })
    }
}
