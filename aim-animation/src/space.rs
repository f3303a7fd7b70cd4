//! [`BlendLine`] and [`BlendPlane`]: blend weights of poses from one or two numbers, such as speed and direction.

use alloc::vec::Vec;
use core::fmt;

use aim_runtime::glam::Vec2;

use crate::float::narrow;

/// Limit to which coordinates are clamped, so that their squares do not overflow.
const FARTHEST: f32 = 1e9;

/// Reason why places do not form a blend space. Indices are those of the places as passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpaceError {
    /// No place is given.
    Empty,
    /// A coordinate of this place is not finite, or beyond ±10⁹.
    Place(usize),
    /// This place is equal to an earlier one; or, on a line, not greater than the one before.
    Order(usize),
    /// All places lie on one line, or so close to one that they span no triangle. For places on a line use a
    /// [`BlendLine`].
    Flat,
}

impl fmt::Display for SpaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a blend space needs at least one place"),
            Self::Place(place) => write!(f, "place {place} is not finite or beyond ±10⁹"),
            Self::Order(place) => write!(f, "place {place} is not after those before it, or the same as one of them"),
            Self::Flat => f.write_str("all places lie on one line; a line of its own takes them by one number"),
        }
    }
}

impl core::error::Error for SpaceError {}

fn check(coordinate: f32, place: usize) -> Result<(), SpaceError> {
    if coordinate.abs() <= FARTHEST { Ok(()) } else { Err(SpaceError::Place(place)) }
}

/// Clamps a coordinate to ±10⁹; NaN becomes 0.
fn clamped_coordinate(coordinate: f32) -> f32 {
    if coordinate.is_nan() { 0.0 } else { coordinate.max(-FARTHEST).min(FARTHEST) }
}

/// One-dimensional blend space: poses at places along a line. The two places next to a coordinate are blended.
///
/// ```
/// use aim_animation::BlendLine;
///
/// // Idle, walk and run by their speeds, m/s.
/// let speeds = BlendLine::new([0.0, 1.5, 4.5])?;
/// let mut weights = [0.0; 3];
/// speeds.weights(3.0, &mut weights);
/// assert_eq!(weights, [0.0, 0.5, 0.5]);
/// # Ok::<(), aim_animation::SpaceError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BlendLine {
    places: Vec<f32>,
}

impl BlendLine {
    /// A blend space of places in increasing order.
    ///
    /// # Errors
    /// See [`SpaceError`]; returns the first error found.
    pub fn new(places: impl Into<Vec<f32>>) -> Result<Self, SpaceError> {
        let places = places.into();
        if places.is_empty() {
            return Err(SpaceError::Empty);
        }
        for (k, place) in places.iter().enumerate() {
            check(*place, k)?;
            if k.checked_sub(1).is_some_and(|before| places[before] >= *place) {
                return Err(SpaceError::Order(k));
            }
        }
        Ok(Self { places })
    }

    /// The places.
    #[must_use]
    pub fn places(&self) -> &[f32] {
        &self.places
    }

    /// Computes the weight of each place at a coordinate. The weights sum to 1, and at most two of them are not 0.
    /// Beyond the ends, the outermost place has weight 1. NaN is treated as 0. Excess elements of `weights` are set to
    /// 0; if it is too short, the other weights are dropped.
    pub fn weights(&self, at: f32, weights: &mut [f32]) {
        weights.fill(0.0);
        let (at, last) = (clamped_coordinate(at), self.places.len() - 1);
        let next = self.places.partition_point(|place| *place <= at);
        let mut put = |place: usize, weight: f32| {
            if let Some(of_place) = weights.get_mut(place) {
                *of_place = weight;
            }
        };
        match next {
            0 => put(0, 1.0),
            next if next > last => put(last, 1.0),
            next => {
                let (a, b) = (self.places[next - 1], self.places[next]);
                let part = (at - a) / (b - a);
                put(next - 1, 1.0 - part);
                put(next, part);
            }
        }
    }
}

/// Two-dimensional blend space: poses at points of a plane. The three points around a coordinate are blended.
///
/// The plane is divided by a Delaunay triangulation, computed once. Weights are continuous everywhere; at the place of
/// a point, only its pose has weight.
///
/// ```
/// use aim_animation::BlendPlane;
/// use aim_animation::glam::Vec2;
///
/// // Idle in the middle, walks to the four sides, by velocity.
/// let walks = BlendPlane::new([Vec2::ZERO, Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y])?;
/// let mut weights = [0.0; 5];
/// walks.weights(Vec2::new(0.25, -0.5), &mut weights);
/// assert_eq!(weights, [0.25, 0.25, 0.0, 0.0, 0.5]);
/// # Ok::<(), aim_animation::SpaceError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BlendPlane {
    points: Vec<Vec2>,
    /// Counter-clockwise.
    triangles: Vec<[usize; 3]>,
}

impl BlendPlane {
    /// Triangulates the points; at least three must not lie on one line.
    ///
    /// # Errors
    /// See [`SpaceError`]; returns the first error found.
    pub fn new(points: impl Into<Vec<Vec2>>) -> Result<Self, SpaceError> {
        let points = points.into();
        for (k, point) in points.iter().enumerate() {
            point.to_array().into_iter().try_for_each(|coordinate| check(coordinate, k))?;
            if points[..k].contains(point) {
                return Err(SpaceError::Order(k));
            }
        }
        if points.is_empty() {
            return Err(SpaceError::Empty);
        }
        // Adding 0 turns −0 into 0, so that both are one place and are sorted as equal.
        let points: Vec<Vec2> = points.into_iter().map(|point| point + Vec2::ZERO).collect();
        let mut triangles = sweep_triangulation(&points)?;
        make_delaunay(&points, &mut triangles);
        Ok(Self { points, triangles })
    }

    /// The points.
    #[must_use]
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Triangles of the triangulation, as indices of their points, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Computes the weight of each point at a coordinate. The weights sum to 1, and at most three of them are not 0.
    /// Outside the triangulation, the nearest place in it is used. NaN is treated as 0. Excess elements of `weights`
    /// are set to 0; if it is too short, the other weights are dropped.
    pub fn weights(&self, at: Vec2, weights: &mut [f32]) {
        weights.fill(0.0);
        let at = Vec2::new(clamped_coordinate(at.x), clamped_coordinate(at.y));
        let (corners, found) = self.containing_triangle(at).unwrap_or_else(|| self.nearest(at));
        for (corner, weight) in corners.into_iter().zip(found) {
            if let Some(of_point) = weights.get_mut(corner) {
                *of_point += narrow(weight);
            }
        }
    }

    /// Returns the triangle that contains a place, and its barycentric coordinates there.
    fn containing_triangle(&self, at: Vec2) -> Option<([usize; 3], [f64; 3])> {
        self.triangles.iter().find_map(|&corners| {
            let [a, b, c] = corners.map(|corner| self.points[corner]);
            let areas = [area([b, c, at]), area([c, a, at]), area([a, b, at])];
            let whole = areas[0] + areas[1] + areas[2];
            let is_inside = whole > 0.0 && areas.iter().all(|area| *area >= 0.0);
            is_inside.then(|| (corners, areas.map(|area| area / whole)))
        })
    }

    /// Returns the nearest place on an edge to a place outside: a triangle with barycentric coordinates.
    fn nearest(&self, at: Vec2) -> ([usize; 3], [f64; 3]) {
        let mut best = (f64::INFINITY, [0; 3], [1.0, 0.0, 0.0]);
        for corners in &self.triangles {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let [[a_x, a_y], [b_x, b_y], [x, y]] = [self.points[a], self.points[b], at].map(wide);
                let (edge, way) = ([b_x - a_x, b_y - a_y], [x - a_x, y - a_y]);
                let part = (edge[0] * way[0] + edge[1] * way[1]) / (edge[0] * edge[0] + edge[1] * edge[1]);
                let part = part.max(0.0).min(1.0);
                let off = [way[0] - part * edge[0], way[1] - part * edge[1]];
                let square = off[0] * off[0] + off[1] * off[1];
                if square < best.0 {
                    best = (square, [a, b, a], [1.0 - part, part, 0.0]);
                }
            }
        }
        (best.1, best.2)
    }
}

fn wide(point: Vec2) -> [f64; 2] {
    point.to_array().map(f64::from)
}

/// Twice the area of a triangle, positive if it is counter-clockwise.
fn area(corners: [Vec2; 3]) -> f64 {
    let [[a_x, a_y], [b_x, b_y], [c_x, c_y]] = corners.map(wide);
    (b_x - a_x) * (c_y - a_y) - (b_y - a_y) * (c_x - a_x)
}

/// Computes any triangulation by a sweep: adds the points from left to right and joins each to the hull edges that it
/// sees.
fn sweep_triangulation(points: &[Vec2]) -> Result<Vec<[usize; 3]>, SpaceError> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].x.total_cmp(&points[b].x).then(points[a].y.total_cmp(&points[b].y)));
    let area_of = |a: usize, b: usize, c: usize| area([points[a], points[b], points[c]]);
    // The first points may be collinear; the first point off their line makes a fan with them.
    let apex = (2..order.len()).find(|&k| area_of(order[0], order[1], order[k]) != 0.0).ok_or(SpaceError::Flat)?;
    let mut triangles = Vec::new();
    let mut hull: Vec<usize> = order[..apex].to_vec();
    if area_of(order[0], order[1], order[apex]) < 0.0 {
        hull.reverse();
    }
    triangles.extend(hull.windows(2).map(|edge| [edge[0], edge[1], order[apex]]));
    hull.push(order[apex]);
    for &point in &order[apex + 1..] {
        let count = hull.len();
        let is_visible = |k: usize| area_of(hull[k % count], hull[(k + 1) % count], point) < 0.0;
        // The visible edges are consecutive: find the first one that follows an invisible edge.
        let first = (0..count).find(|&k| is_visible(k) && !is_visible(k + count - 1)).ok_or(SpaceError::Flat)?;
        let visible = (0..count).take_while(|&k| is_visible(first + k)).count();
        triangles.extend((first..first + visible).map(|k| [hull[(k + 1) % count], hull[k % count], point]));
        // The points between the ends of the visible part are no longer on the hull.
        let rest = (first + visible..=first + count).map(|k| hull[k % count]);
        hull = rest.chain([point]).collect();
    }
    Ok(triangles)
}

/// Makes a triangulation Delaunay: flips edges while a triangle's circumcircle contains the opposite corner of its
/// neighbour.
fn make_delaunay(points: &[Vec2], triangles: &mut [[usize; 3]]) {
    // Each flip increases the smallest of six angles, so this terminates in exact arithmetic; the limit guards against
    // cycles by rounding.
    let mut left = points.len() * points.len();
    while left > 0 {
        let Some((first, second, corners)) = find_edge_to_flip(points, triangles) else { return };
        let [a, b, c, d] = corners;
        (triangles[first], triangles[second]) = ([a, b, d], [b, c, d]);
        left -= 1;
    }
}

/// Finds two triangles a-b-c and a-c-d whose common edge should be b-d instead.
fn find_edge_to_flip(points: &[Vec2], triangles: &[[usize; 3]]) -> Option<(usize, usize, [usize; 4])> {
    for (first, one) in triangles.iter().enumerate() {
        for k in 0..3 {
            let [c, a, b] = [one[k], one[(k + 1) % 3], one[(k + 2) % 3]];
            for (second, other) in triangles.iter().enumerate().skip(first + 1) {
                // The edge c-a of one triangle is a-c in the other.
                let Some(at) = (0..3).find(|&at| other[at] == a && other[(at + 1) % 3] == c) else { continue };
                let d = other[(at + 2) % 3];
                if is_within_circle([a, b, c, d].map(|corner| points[corner])) {
                    return Some((first, second, [a, b, c, d]));
                }
            }
        }
    }
    None
}

/// Returns `true` if d lies inside the circle through a, b and c by more than rounding, and a-b-c-d is convex.
fn is_within_circle([a, b, c, d]: [Vec2; 4]) -> bool {
    let [origin_x, origin_y] = wide(d);
    let [a_d, b_d, c_d] = [a, b, c].map(|corner| {
        let [x, y] = wide(corner);
        let (x, y) = (x - origin_x, y - origin_y);
        [x, y, x * x + y * y]
    });
    let cross = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
    let terms = [c_d[2] * cross(a_d, b_d), a_d[2] * cross(b_d, c_d), b_d[2] * cross(c_d, a_d)];
    let size = terms.iter().map(|term| term.abs()).sum::<f64>();
    terms.iter().sum::<f64>() > 1e-9 * size && area([a, b, d]) > 0.0 && area([b, c, d]) > 0.0
}
