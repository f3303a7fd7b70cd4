//! Cost of a trajectory, its gradient and its second derivatives: sums over all frames of the derived term, the
//! smoothing term and the springs.

use glam::Vec3;

use super::derived::{place, rounded_place, rounded_term_hessian, term_gradient};
use super::node::{BAND, Node, Point, dot, length, minus, plus, scaled, wide};
use super::{Ends, Trajectory, Waypoint};
use crate::Scalar;

/// A trajectory prepared for minimisation, with each frame's node initialised.
pub(super) struct Problem<'a> {
    pub(super) nodes: &'a mut [Node],
    /// Weight of the change of acceleration, in frames to the fourth power.
    pub(super) epsilon: f64,
    /// Radius by which the singular tips of the terms are rounded, in the trajectory's units.
    pub(super) delta: f64,
}

/// Rounding radius of the tips, relative to the mean step from frame to frame.
const ROUND: f64 = 0.1;

/// Selects one of the two points of each node.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum At {
    Point,
    Trial,
}

impl<'a> Problem<'a> {
    /// Prepares a trajectory. `None` if an input is not finite, a waypoint's frame does not exist, or times do not
    /// increase.
    pub(super) fn new(of: &Trajectory<'_>, waypoints: &[Waypoint], nodes: &'a mut [Node]) -> Option<Self> {
        for (node, &point) in nodes.iter_mut().zip(of.points) {
            let rest = wide(point);
            *node = Node { rest, point: rest, spring: (0.0, rest), ..Node::default() };
            if !point.is_finite() {
                return None;
            }
        }
        set_stencils(nodes, of.times, of.ends)?;
        if let (Ends::Fixed, [first, .., last]) = (of.ends, &mut *nodes) {
            (first.fixed, last.fixed) = (true, true);
        }
        for waypoint in waypoints.iter().filter(|waypoint| waypoint.weight > 0.0) {
            let node = nodes.get_mut(waypoint.frame).filter(|_| waypoint.point.is_finite())?;
            let (weight, goal) = (f64::from(waypoint.weight), wide(waypoint.point));
            if waypoint.weight.is_infinite() {
                (node.fixed, node.spring) = (true, (0.0, goal));
            } else if !node.fixed {
                // Several springs of one frame combine into one, at their weighted mean.
                let sum = node.spring.0 + weight;
                let (old, new) = (node.spring.0 / sum, weight / sum);
                node.spring = (sum, plus(scaled(old, node.spring.1), scaled(new, goal)));
            }
        }
        let smoothing = f64::from(of.smoothing.max(0.0).min(1.0)) * steps(nodes.len());
        let path = nodes.windows(2).map(|pair| length(minus(pair[1].rest, pair[0].rest))).sum::<f64>();
        let away = nodes.iter().map(|node| length(minus(node.spring.1, node.rest))).sum::<f64>();
        let delta = ROUND * (path + away) / steps(nodes.len()).max(1.0);
        // A trajectory that does not move has no scale of its own.
        let delta = if delta > 0.0 { delta } else { 1.0 };
        for i in 1..nodes.len().saturating_sub(1) {
            let points = [nodes[i - 1].rest, nodes[i].rest, nodes[i + 1].rest];
            (nodes[i].place, nodes[i].rounded) = (place(&points), rounded_place(&points, &[delta]));
        }
        Some(Self { nodes, epsilon: smoothing * smoothing, delta })
    }

    /// Starts from these points, except for fixed nodes; from the animated point where one is not finite.
    pub(super) fn start_at(&mut self, points: &[Vec3]) {
        for (node, &point) in self.nodes.iter_mut().zip(points) {
            node.point = if point.is_finite() { wide(point) } else { node.rest };
            if node.fixed {
                node.point = node.spring.1;
            }
        }
    }

    /// Returns the total change of places, Σ (Δα² + Δβ²).
    pub(super) fn distortion(&self) -> f64 {
        let changes = self.nodes.windows(3).map(|three| {
            let place = place(&[three[0].point, three[1].point, three[2].point]);
            squared_difference(place, three[1].place)
        });
        changes.sum()
    }

    pub(super) fn cost(&self, at: At) -> f64 {
        let places: f64 = self.nodes.windows(3).map(|three| self.term(three, at)).sum();
        let bends: f64 = (0..self.nodes.len()).map(|i| self.bend(i, at)).map(|bend| dot(bend, bend)).sum();
        let springs = self.nodes.iter().filter(|node| node.spring.0 > 0.0).map(|node| {
            let off = minus(node.at(at), node.spring.1);
            node.spring.0 * dot(off, off)
        });
        places + self.epsilon * bends + springs.sum::<f64>()
    }

    fn term(&self, three: &[Node], at: At) -> f64 {
        let points = [three[0].at(at), three[1].at(at), three[2].at(at)];
        squared_difference(rounded_place(&points, &[self.delta]), three[1].rounded)
    }

    /// Returns the change of acceleration in frame `i`, scaled by the root of the frame's share of time.
    fn bend(&self, i: usize, at: At) -> Point {
        let offset = |i: usize| self.nodes.get(i).map_or([0.0; 3], |node| minus(node.at(at), node.rest));
        let [before, here, after] = self.nodes[i].stencil;
        let sides = plus(scaled(before, offset(i.wrapping_sub(1))), scaled(after, offset(i + 1)));
        plus(sides, scaled(here, offset(i)))
    }

    /// Sets the gradient of the term for places alone.
    pub(super) fn set_gradient_of_places(&mut self) {
        self.clear();
        for i in 1..self.nodes.len().saturating_sub(1) {
            let derivatives = term_gradient(&self.points_about(i), &self.nodes[i].place);
            self.add_gradient(i, &derivatives[1..]);
        }
    }

    /// Assembles gradient and matrix at the current point. Without `places`, only smoothing (with weight 1) and springs
    /// enter. A fixed node gets gradient 0 and rows of the identity.
    pub(super) fn assemble(&mut self, places: bool) {
        self.clear();
        for i in 0..self.nodes.len() {
            if places && i > 0 && i + 1 < self.nodes.len() {
                self.add_term(i);
            }
            self.add_smoothing(i, if places { self.epsilon } else { 1.0 });
            let node = &mut self.nodes[i];
            let (weight, goal) = node.spring;
            if weight > 0.0 {
                node.gradient = plus(node.gradient, scaled(2.0 * weight, minus(node.point, goal)));
                node.rows.iter_mut().for_each(|row| row[0] += 2.0 * weight);
            }
        }
        self.hold_fixed();
    }

    /// Adds the gradient and second derivatives of the rounded term of frame `i`.
    fn add_term(&mut self, i: usize) {
        let [along, beside] = self.nodes[i].rounded;
        let derivatives = rounded_term_hessian(&self.points_about(i), &[self.delta, along, beside]);
        self.add_gradient(i, &derivatives[1..10]);
        let mut second = derivatives[10..].iter();
        for row in 0..9 {
            let entries = &mut self.nodes[i - 1 + row / 3].rows[row % 3];
            for (column, &value) in (0..=row).zip(&mut second) {
                entries[row - column] += value;
            }
        }
    }

    fn clear(&mut self) {
        for node in &mut *self.nodes {
            (node.gradient, node.rows) = ([0.0; 3], [[0.0; BAND]; 3]);
        }
    }

    fn points_about(&self, i: usize) -> [Point; 3] {
        [self.nodes[i - 1].point, self.nodes[i].point, self.nodes[i + 1].point]
    }

    fn add_gradient(&mut self, i: usize, derivatives: &[f64]) {
        for (k, &derivative) in derivatives.iter().enumerate() {
            self.nodes[i - 1 + k / 3].gradient[k % 3] += derivative;
        }
    }

    /// Adds the derivatives of `weight` times the squared change of acceleration in frame `i`.
    fn add_smoothing(&mut self, i: usize, weight: f64) {
        let (bend, stencil) = (self.bend(i, At::Point), self.nodes[i].stencil);
        for (row, &factor) in stencil.iter().enumerate() {
            // Frames before the first and after the last are fixed.
            let Some(node) = (i + row).checked_sub(1).and_then(|at| self.nodes.get_mut(at)) else { continue };
            node.gradient = plus(node.gradient, scaled(2.0 * weight * factor, bend));
            let first = usize::from(i == 0);
            for column in first..=row {
                let value = 2.0 * weight * factor * stencil[column];
                node.rows.iter_mut().for_each(|entries| entries[3 * (row - column)] += value);
            }
        }
    }

    fn hold_fixed(&mut self) {
        for i in 0..self.nodes.len() {
            for axis in 0..3 {
                for k in 1..BAND.min(3 * i + axis + 1) {
                    if self.nodes[i].fixed || self.nodes[(3 * i + axis - k) / 3].fixed {
                        self.nodes[i].rows[axis][k] = 0.0;
                    }
                }
                if self.nodes[i].fixed {
                    (self.nodes[i].rows[axis][0], self.nodes[i].gradient[axis]) = (1.0, 0.0);
                }
            }
        }
    }

    /// Writes the points in single precision. Returns `false` if one is not finite.
    pub(super) fn write(&self, out: &mut [Vec3]) -> bool {
        for (out, node) in out.iter_mut().zip(&*self.nodes) {
            #[expect(clippy::cast_possible_truncation, reason = "the caller's points are single")]
            let point = node.point.map(|x| x as f32);
            *out = Vec3::from_array(point);
            if !out.is_finite() {
                return false;
            }
        }
        true
    }
}

fn squared_difference(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, beside) = (a[0] - b[0], a[1] - b[1]);
    along * along + beside * beside
}

impl Node {
    pub(super) fn at(&self, at: At) -> Point {
        match at {
            At::Point => self.point,
            At::Trial => self.trial,
        }
    }
}

/// Returns the largest distance of a point from the first one.
pub(super) fn extent(points: &[Vec3]) -> f64 {
    spread(points.iter().map(|&point| wide(point)))
}

/// Returns the largest distance of an animated point from the first one.
pub(super) fn extent_of(nodes: &[Node]) -> f64 {
    spread(nodes.iter().map(|node| node.rest))
}

fn spread(mut points: impl Iterator<Item = Point>) -> f64 {
    let Some(first) = points.next() else { return 0.0 };
    points.map(|point| length(minus(point, first))).fold(0.0, f64::max)
}

/// Returns the number of steps from the first to the last of `frames`.
#[expect(clippy::cast_precision_loss, reason = "no trajectory has so many frames")]
pub(super) fn steps(frames: usize) -> f64 {
    frames.saturating_sub(1) as f64
}

/// Lower bound of the interval between frames, relative to the mean.
const NEAREST: f64 = 1e-3;

/// Sets the stencils of second differences over uneven times, in units of the mean step; exact for parabolas. `None` if
/// the times are not increasing.
fn set_stencils(nodes: &mut [Node], times: &[f32], ends: Ends) -> Option<()> {
    let frames = nodes.len();
    let even = times.is_empty();
    if frames < 2 {
        return Some(());
    }
    if !even && (times.len() != frames || times.iter().any(|time| !time.is_finite())) {
        return None;
    }
    let mean = if even { 1.0 } else { (f64::from(times[frames - 1]) - f64::from(times[0])) / steps(frames) };
    if !(mean > 0.0) || times.windows(2).any(|pair| pair[0] >= pair[1]) {
        return None;
    }
    let gap = |i: usize| {
        let gap = if even { 1.0 } else { (f64::from(times[i + 1]) - f64::from(times[i])) / mean };
        gap.max(NEAREST)
    };
    for (i, node) in nodes.iter_mut().enumerate() {
        let is_end = i == 0 || i + 1 == frames;
        if is_end && ends == Ends::Free {
            continue;
        }
        let (before, after) = (gap(i.max(1) - 1), gap(i.min(frames - 2)));
        let span = before + after;
        let root = <f64 as Scalar>::sqrt(0.5 * span);
        let (before, after) = (2.0 * root / (before * span), 2.0 * root / (after * span));
        node.stencil = [before, -(before + after), after];
    }
    Some(())
}
