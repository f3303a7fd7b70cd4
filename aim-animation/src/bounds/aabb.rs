//! [`Aabb`] and [`OrientedBox`]: bounding boxes.

use aim_runtime::glam::{Affine3A, Vec3, Vec3A};

use super::ray::Ray;

/// Axis-aligned bounding box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Corner with the smallest coordinates.
    pub min: Vec3,
    /// Corner with the largest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// The box that contains all of space.
    pub const INFINITE: Self = Self { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };

    /// Returns the smallest box that contains both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Returns `true` if a point is inside the box or on its boundary.
    #[must_use]
    pub fn contains(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    /// Returns the corners. x alternates fastest, then y, then z, each from `min` to `max`.
    #[must_use]
    pub fn corners(&self) -> [Vec3; 8] {
        let of = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
        core::array::from_fn(|corner| Vec3::new(of(corner, 0), of(corner, 1), of(corner, 2)))
    }

    /// Returns `true` if a ray meets the box. A ray that starts inside meets it.
    ///
    /// The test is conservative: rounding never makes it miss a box. An axis on which both bounds are NaN excludes no
    /// ray. An [unsound](Ray::is_sound) ray meets no box.
    #[must_use]
    pub fn is_met(&self, ray: &Ray) -> bool {
        ray.is_sound() && self.meets(ray, f64::from(ray.end))
    }

    /// Returns `true` if a sound ray meets the box at a ray parameter in 0…`end`, in lengths of its direction. The slab
    /// test: intersects the intervals in which the ray is between the two planes of each axis.
    pub(crate) fn meets(&self, ray: &Ray, end: f64) -> bool {
        let (mut enter, mut exit) = (0.0_f64, end);
        for axis in 0..3 {
            let [origin, direction, min, max] =
                [ray.origin[axis], ray.direction[axis], self.min[axis], self.max[axis]].map(f64::from);
            if direction == 0.0 {
                if origin < min || origin > max {
                    return false;
                }
                continue;
            }
            let [a, b] = [min, max].map(|side| (side - origin) / direction);
            // `max` and `min` ignore NaN, so that an axis with two NaN bounds excludes nothing.
            (enter, exit) = (enter.max(a.min(b)), exit.min(a.max(b)));
        }
        // Relative tolerance for the rounding of the divisions.
        !(enter * (1.0 - 1e-12) > exit)
    }

    /// Returns an axis-aligned box around this box transformed by `place`, or [`INFINITE`](Self::INFINITE) if that is
    /// not finite.
    ///
    /// The box is enlarged by the relative margin `rounding`, so that it also contains computed points with their
    /// rounding errors.
    pub(crate) fn placed(&self, place: &Affine3A, rounding: f32) -> Self {
        let (center, half) = ((self.min + self.max) * 0.5, (self.max - self.min) * 0.5);
        let m = place.matrix3;
        let [x, y, z] = [m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs()];
        // |M|·v bounds the components of M·u for all u with |u| ≤ v.
        let at_most = |v: Vec3| x * v.x + y * v.y + z * v.z;
        let size = at_most(center.abs() + half) + place.translation.abs();
        let reach = at_most(half) + size * rounding;
        let middle = place.transform_point3a(center.into());
        let (min, max): (Vec3A, Vec3A) = (middle - reach, middle + reach);
        if min.is_finite() && max.is_finite() { Self { min: min.into(), max: max.into() } } else { Self::INFINITE }
    }
}

/// Returns the relative margin by which boxes are enlarged for rounding errors, as a fraction of the largest number
/// that enters a vertex.
///
/// It is some tens of units in the last place, plus one for each joint or morph target that is summed in a vertex; each
/// sum has an error of half a unit.
#[expect(clippy::cast_precision_loss, reason = "a bound")]
pub(super) fn rounding(summands: usize) -> f32 {
    4e-6 + f32::EPSILON * summands as f32
}

/// Bounding box along the axes of a bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// The box in its own space.
    pub aabb: Aabb,
    /// Transform from the box's own space to the space of the pose.
    pub place: Affine3A,
}

impl OrientedBox {
    /// Returns the transformed corners, in the order of [`Aabb::corners`].
    #[must_use]
    pub fn corners(&self) -> [Vec3; 8] {
        self.aabb.corners().map(|corner| self.place.transform_point3(corner))
    }

    /// Returns the axis-aligned box around it; [`Aabb::INFINITE`] if that is not finite.
    #[must_use]
    pub fn aabb(&self) -> Aabb {
        self.aabb.placed(&self.place, rounding(1))
    }
}
