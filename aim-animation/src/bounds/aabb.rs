//! [`Aabb`] and [`OrientedBox`].

use aim_runtime::glam::{Affine3A, Vec3, Vec3A};

use super::ray::Ray;

/// A box along the axes of its space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The corner with the least coordinates.
    pub min: Vec3,
    /// The corner with the largest.
    pub max: Vec3,
}

impl Aabb {
    /// All of space.
    pub const INFINITE: Self = Self { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// True if a point is within, or on the boundary.
    #[must_use]
    pub fn contains(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    /// The corners, x changing first, then y.
    #[must_use]
    pub fn corners(&self) -> [Vec3; 8] {
        let of = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
        core::array::from_fn(|corner| Vec3::new(of(corner, 0), of(corner, 1), of(corner, 2)))
    }

    /// True if a ray meets the box, from outside or from within. Never false of a box that it meets: a box that is not
    /// finite counts as met. No ray that is [none](Ray::is_sound) meets any.
    #[must_use]
    pub fn is_met(&self, ray: &Ray) -> bool {
        ray.is_sound() && self.meets(ray, f64::from(ray.end))
    }

    /// The same up to `end` on a ray that is sound.
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
            // `max` and `min` drop what is no number: then this axis rules nothing out.
            (enter, exit) = (enter.max(a.min(b)), exit.min(a.max(b)));
        }
        // The rounding of the divisions.
        !(enter * (1.0 - 1e-12) > exit)
    }

    /// The box around this one where a map places it, larger by the [rounding] of what is computed from within it.
    pub(crate) fn placed(&self, place: &Affine3A, rounding: f32) -> Self {
        let (center, half) = ((self.min + self.max) * 0.5, (self.max - self.min) * 0.5);
        let m = place.matrix3;
        let [x, y, z] = [m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs()];
        // |M|·v: what the map can do at most to a vector of such components.
        let at_most = |v: Vec3| x * v.x + y * v.y + z * v.z;
        let size = at_most(center.abs() + half) + place.translation.abs();
        let reach = at_most(half) + size * rounding;
        let middle = place.transform_point3a(center.into());
        let (min, max): (Vec3A, Vec3A) = (middle - reach, middle + reach);
        if min.is_finite() && max.is_finite() { Self { min: min.into(), max: max.into() } } else { Self::INFINITE }
    }
}

/// By how much boxes are enlarged, in parts of the largest number that goes into a vertex: some tens of units in the last
/// place, and one for each of the joints and morph targets that are added in a vertex, of half a unit each.
#[expect(clippy::cast_precision_loss, reason = "a bound")]
pub(super) fn rounding(summands: usize) -> f32 {
    4e-6 + f32::EPSILON * summands as f32
}

/// A box along the axes of a bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// The box in a space of its own.
    pub aabb: Aabb,
    /// The map from there.
    pub place: Affine3A,
}

impl OrientedBox {
    /// The corners where they are, in the order of [`Aabb::corners`].
    #[must_use]
    pub fn corners(&self) -> [Vec3; 8] {
        self.aabb.corners().map(|corner| self.place.transform_point3(corner))
    }

    /// The box along the axes around it; infinite if it is not finite.
    #[must_use]
    pub fn aabb(&self) -> Aabb {
        self.aabb.placed(&self.place, rounding(1))
    }
}
