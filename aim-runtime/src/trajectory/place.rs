//! [`Place`]: where a point of a trajectory is in the frame of its neighbours.

use glam::Vec3;

use super::derived::place;
use super::node::{length, minus, plus, scaled, wide};

/// A point's place in the frame of its neighbours, `point = before + α·A + β·B`: what the deformation keeps.
///
/// ```
/// use aim_runtime::glam::Vec3;
/// use aim_runtime::trajectory::Place;
///
/// let place = Place::new([Vec3::ZERO, Vec3::new(1.0, 0.5, 0.0), Vec3::X * 3.0]);
/// assert_eq!((place.alpha, place.beta), (1.0, 0.5));
/// assert_eq!((place.along, place.beside), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
/// assert_eq!(place.point([0.0; 3]), [1.0, 0.5, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Place {
    /// α, how far the point is along A, in the trajectory's units.
    pub alpha: f64,
    /// β, how far it is beside A; not negative.
    pub beta: f64,
    /// A, the unit vector from the neighbour before to the one after; 0 where they are at one point.
    pub along: [f64; 3],
    /// B, the unit vector square to A on the point's side; 0 where β is.
    pub beside: [f64; 3],
}

impl Place {
    /// The place of the middle one of three points. What is not finite makes it not finite.
    #[must_use]
    pub fn new(points: [Vec3; 3]) -> Self {
        let points = points.map(wide);
        let [before, point, after] = points;
        let [alpha, beta] = place(&points);
        let unit = |v: [f64; 3], length: f64| if length == 0.0 { [0.0; 3] } else { v.map(|x| x / length) };
        let chord = minus(after, before);
        let along = unit(chord, length(chord));
        let beside = unit(minus(minus(point, before), scaled(alpha, along)), beta);
        Self { alpha, beta, along, beside }
    }

    /// The point of this place after another neighbour.
    #[must_use]
    pub fn point(&self, before: [f64; 3]) -> [f64; 3] {
        plus(before, plus(scaled(self.alpha, self.along), scaled(self.beta, self.beside)))
    }
}
