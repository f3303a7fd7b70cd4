//! [`Place`]: the position of a trajectory's point in the frame of its neighbours.

use glam::Vec3;

use super::derived::place;
use super::node::{length, minus, plus, scaled, wide};

/// Position of a point in the frame of its neighbours, `point = before + α·A + β·B`. Deformation preserves α and β as
/// far as possible.
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
    /// α, the component along A, in the trajectory's units.
    pub alpha: f64,
    /// β, the distance from the line along A, in the trajectory's units; not negative.
    pub beta: f64,
    /// A, the unit vector from the previous to the next neighbour; 0 if both are at one point.
    pub along: [f64; 3],
    /// B, the unit vector orthogonal to A on the point's side; 0 if β is 0.
    pub beside: [f64; 3],
}

impl Place {
    /// Returns the place of the middle one of three points. Not finite if a point is not.
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

    /// Returns the point that has this place if the previous neighbour is at `before`.
    #[must_use]
    pub fn point(&self, before: [f64; 3]) -> [f64; 3] {
        plus(before, plus(scaled(self.alpha, self.along), scaled(self.beta, self.beside)))
    }
}
