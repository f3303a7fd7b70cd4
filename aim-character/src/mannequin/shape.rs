//! Closed surfaces made of rings, with smooth normals and outward winding; every vertex is bound to its joints.

use core::f64::consts::TAU;

use aim_runtime::glam::DVec3;

use crate::num::count;

/// Up to four (joint, weight) pairs; weights sum to 1.
pub(crate) type Binding = [(usize, f64); 4];

/// Binds a vertex to one joint.
pub(crate) fn rigid(joint: usize) -> Binding {
    [(joint, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]
}

/// Binds a vertex between two joints; `t` = 0 is entirely the first, 1 entirely the second.
pub(crate) fn between(a: usize, b: usize, t: f64) -> Binding {
    let t = t.clamp(0.0, 1.0);
    if t <= 0.0 {
        rigid(a)
    } else if t >= 1.0 {
        rigid(b)
    } else {
        [(a, 1.0 - t), (b, t), (0, 0.0), (0, 0.0)]
    }
}

/// Returns sine and cosine of the angle 2π · `at` / `parts`.
fn around(at: usize, parts: usize) -> (f64, f64) {
    (TAU * count(at) / count(parts)).sin_cos()
}

/// Triangles of one material, in the character's space, metres.
#[derive(Default)]
pub(crate) struct ShapeMesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) normals: Vec<DVec3>,
    pub(crate) bindings: Vec<Binding>,
    pub(crate) triangles: Vec<[usize; 3]>,
}

/// A ring of a loft: its centre, and its half-widths ahead (towards +z) and to the side.
pub(crate) struct Ring {
    pub(crate) centre: DVec3,
    pub(crate) ahead: f64,
    pub(crate) aside: f64,
}

impl Ring {
    pub(crate) fn new(centre: impl Into<DVec3>, ahead: f64, aside: f64) -> Self {
        Self { centre: centre.into(), ahead, aside }
    }
}

impl ShapeMesh {
    /// Adds a tube through rings, closed at both ends. Each ring is perpendicular to the path.
    pub(crate) fn loft(&mut self, rings: &[Ring], sides: usize, bind: impl Fn(DVec3) -> Binding) {
        self.tube(rings, sides, None, bind);
    }

    /// Adds a stack of level rings, from the lowest to the highest.
    pub(crate) fn stack(&mut self, rings: &[Ring], sides: usize, bind: impl Fn(DVec3) -> Binding) {
        self.tube(rings, sides, Some(DVec3::Y), bind);
    }

    fn tube(&mut self, rings: &[Ring], sides: usize, along: Option<DVec3>, bind: impl Fn(DVec3) -> Binding) {
        let (Some(first), Some(last)) = (rings.first(), rings.last()) else {
            return;
        };
        let mut rows = Vec::with_capacity(rings.len());
        for (k, ring) in rings.iter().enumerate() {
            let (from, to) = (&rings[k.saturating_sub(1)], &rings[(k + 1).min(rings.len() - 1)]);
            let along = along.unwrap_or((to.centre - from.centre).normalize_or_zero());
            let ahead = (DVec3::Z - along * along.z).normalize_or_zero();
            let aside = along.cross(ahead);
            let point = |j: usize| {
                let (sin, cos) = around(j, sides);
                ring.centre + ahead * (ring.ahead * cos) + aside * (ring.aside * sin)
            };
            rows.push((0..sides).map(point).collect());
        }
        self.rows(&rows, first.centre, last.centre, bind);
    }

    /// Adds an ellipsoid with its poles at top and bottom.
    pub(crate) fn ellipsoid(
        &mut self,
        centre: impl Into<DVec3>,
        radii: impl Into<DVec3>,
        steps: usize,
        bind: impl Fn(DVec3) -> Binding,
    ) {
        let (centre, radii): (DVec3, DVec3) = (centre.into(), radii.into());
        let row = |i: usize| {
            let (polar, sides) = (TAU / 2.0 * count(i) / count(steps), steps * 2);
            let point = move |j: usize| {
                let (sin, cos) = around(j, sides);
                let unit = DVec3::new(polar.sin() * sin, -polar.cos(), polar.sin() * cos);
                centre + unit * radii
            };
            (0..sides).map(point).collect::<Vec<_>>()
        };
        let rows: Vec<_> = (1..steps).map(row).collect();
        self.rows(&rows, centre - DVec3::Y * radii.y, centre + DVec3::Y * radii.y, bind);
    }

    /// Adds a round cap of a sphere about `centre`, facing +z, out to `half_angle` radians.
    pub(crate) fn cap(&mut self, centre: DVec3, radius: f64, half_angle: f64, bind: impl Fn(DVec3) -> Binding) {
        let (steps, sides) = (5, 24);
        let ring = |i: usize| {
            let polar = half_angle * count(i) / count(steps);
            let point = move |j: usize| {
                let (sin, cos) = around(j, sides);
                centre + DVec3::new(polar.sin() * cos, polar.sin() * sin, polar.cos()) * radius
            };
            (0..sides).map(point).collect::<Vec<_>>()
        };
        let rows: Vec<_> = (1..=steps).rev().map(ring).collect();
        let (first, tip) = (self.positions.len(), centre + DVec3::Z * radius);
        // The centre of the rim closes the back: flat, and hidden.
        let back = centre + DVec3::Z * (radius * half_angle.cos());
        self.rows(&rows, back, tip, bind);
        // The cap keeps the normals of its sphere; averaged normals would darken the rim.
        for (normal, position) in self.normals.iter_mut().zip(&self.positions).skip(first) {
            *normal = (*position - centre).normalize_or(DVec3::Z);
        }
    }

    /// Adds a surface through rows of equally many points, closed by a point at each end. Each row runs
    /// counter-clockwise as seen from the next row.
    fn rows(&mut self, rows: &[Vec<DVec3>], start: DVec3, end: DVec3, bind: impl Fn(DVec3) -> Binding) {
        let sides = rows.first().map_or(0, Vec::len);
        let base = self.positions.len();
        let mut points = vec![start];
        points.extend(rows.iter().flatten());
        points.push(end);
        let at = |row: usize, j: usize| 1 + row * sides + j % sides;
        let mut triangles = Vec::new();
        for j in 0..sides {
            triangles.push([0, at(0, j + 1), at(0, j)]);
            for row in 1..rows.len() {
                triangles.push([at(row - 1, j), at(row - 1, j + 1), at(row, j + 1)]);
                triangles.push([at(row - 1, j), at(row, j + 1), at(row, j)]);
            }
            triangles.push([points.len() - 1, at(rows.len() - 1, j), at(rows.len() - 1, j + 1)]);
        }
        let mut normals = vec![DVec3::ZERO; points.len()];
        for &[a, b, c] in &triangles {
            let area = (points[b] - points[a]).cross(points[c] - points[a]);
            [a, b, c].into_iter().for_each(|i| normals[i] += area);
        }
        self.positions.extend(&points);
        self.normals.extend(normals.into_iter().map(|n| n.normalize_or(DVec3::Y)));
        self.bindings.extend(points.into_iter().map(bind));
        self.triangles.extend(triangles.iter().map(|t| t.map(|i| base + i)));
    }
}
