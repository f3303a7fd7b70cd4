//! [`Ray`], and where it meets a triangle.

use aim_runtime::glam::{Vec3, Vec3A};

/// A half line, or a part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The start.
    pub origin: Vec3,
    /// Its direction, of any length but zero.
    pub direction: Vec3,
    /// The end, in lengths of the direction: infinite, or 0 or more.
    pub end: f32,
}

impl Ray {
    /// A ray without an end.
    #[must_use]
    pub const fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, end: f32::INFINITY }
    }

    /// The segment between two points.
    #[must_use]
    pub fn segment(from: Vec3, to: Vec3) -> Self {
        Self { origin: from, direction: to - from, end: 1.0 }
    }

    /// The point at a part of the way, in lengths of the direction.
    #[must_use]
    pub fn at(&self, part: f32) -> Vec3 {
        self.origin + self.direction * part
    }

    /// True if origin and direction are finite, the direction is not zero and the end not negative. Others meet nothing.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction != Vec3::ZERO && self.end >= 0.0
    }
}

/// The point at which a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// In lengths of the direction.
    pub(crate) part: f64,
    /// The shares of the corners.
    pub(crate) barycentric: [f64; 3],
}

/// The space of a ray in which it runs along z from the origin: axes exchanged so that z is its largest direction, then
/// sheared. After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", 2013.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shear {
    origin: [f64; 3],
    axes: [usize; 3],
    /// x and y for each z, and the part of the direction for each z.
    slopes: [f64; 3],
}

impl Shear {
    /// Of a ray that is sound.
    pub(crate) fn new(ray: &Ray) -> Self {
        let direction = ray.direction.to_array().map(f64::from);
        let larger = |a: usize, b: usize| if direction[b].abs() > direction[a].abs() { b } else { a };
        let z = larger(larger(0, 1), 2);
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let slopes = [direction[axes[0]] / direction[z], direction[axes[1]] / direction[z], 1.0 / direction[z]];
        Self { origin: ray.origin.to_array().map(f64::from), axes, slopes }
    }

    /// A corner in this space. The same for all triangles that share it, so that no ray slips through between them.
    fn sheared(&self, corner: Vec3A) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|axis| f64::from(corner[axis]) - self.origin[axis]);
        [x - self.slopes[0] * z, y - self.slopes[1] * z, z * self.slopes[2]]
    }

    /// The point at which the ray meets a triangle from either side, at any part of its line; `None` if it passes by, if the triangle has
    /// no area across the ray, or if a corner is not finite. A ray through an edge meets all triangles of that edge.
    pub(crate) fn crossing(&self, corners: [Vec3A; 3]) -> Option<Crossing> {
        let [a, b, c] = corners.map(|corner| self.sheared(corner));
        // Twice the areas that the ray spans with the edges; of a shared edge they differ by their sign alone.
        let area = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        let areas = [area(b, c), area(c, a), area(a, b)];
        if areas.iter().any(|area| *area < 0.0) && areas.iter().any(|area| *area > 0.0) {
            return None;
        }
        let total: f64 = areas.iter().sum();
        let barycentric = areas.map(|area| area / total);
        let part = barycentric[0] * a[2] + barycentric[1] * b[2] + barycentric[2] * c[2];
        // No area, or what is not finite.
        part.is_finite().then_some(Crossing { part, barycentric })
    }
}
