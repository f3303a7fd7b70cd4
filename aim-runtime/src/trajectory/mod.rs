//! Target constraints: deforms the whole trajectory of a bone so that it passes through given points at given times,
//! and otherwise stays as it was animated.
//!
//! Every point of the trajectory has a place in the frame of its two neighbours: α along their chord and β orthogonal
//! to it. The deformed trajectory minimises the change of these places, plus a small multiple of the change of
//! acceleration ([`Trajectory::smoothing`]). The second term is needed because places leave torsion undetermined;
//! without it, different starts would lead to different curves.
//!
//! ```
//! use aim_runtime::glam::Vec3;
//! use aim_runtime::trajectory::{Node, Status, Trajectory, Waypoint};
//!
//! // A hand on its way out and back, 61 frames.
//! let slap: [Vec3; 61] = core::array::from_fn(|i| {
//!     let angle = i as f32 / 60.0 * core::f32::consts::PI;
//!     Vec3::new(0.4 * angle.cos(), 1.2, 0.3 + 0.3 * angle.sin())
//! });
//! let waypoints = [Waypoint::new(25, Vec3::new(0.1, 1.4, 0.7))];
//! let (mut through, mut workspace) = ([Vec3::ZERO; 61], [Node::default(); 61]);
//! let outcome = Trajectory::new(&slap).deform(&waypoints, &mut through, &mut workspace);
//! assert_eq!(outcome.status, Status::Met);
//! assert_eq!(through[25], waypoints[0].point);
//! assert_eq!((through[0], through[60]), (slap[0], slap[60]));
//! ```
//!
//! Points are `f32`, but computations are in `f64`: a place is a difference of two near points, and its change would be
//! lost in `f32` rounding. Time and memory are linear in the number of frames.

mod banded;
mod cost;
#[rustfmt::skip]
#[allow(clippy::too_many_lines, clippy::unreadable_literal, reason = "derived code is for machines")]
mod derived;
mod descent;
mod newton;
mod node;
mod place;
#[cfg(test)]
mod tests;

use glam::Vec3;

pub use descent::Descent;
pub use node::Node;
pub use place::Place;

/// A point that the trajectory should pass through in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// Index of the frame.
    pub frame: usize,
    /// The point, in the space of the trajectory.
    pub point: Vec3,
    /// Weight of the squared distance to the point, relative to squared changes of places. Infinite (the value that
    /// [`new`](Self::new) sets): the point must be met. Zero, negative or NaN: the waypoint is ignored.
    pub weight: f32,
}

impl Waypoint {
    /// Creates a waypoint that must be met.
    #[must_use]
    pub const fn new(frame: usize, point: Vec3) -> Self {
        Self { frame, point, weight: f32::INFINITY }
    }

    /// Sets the [`weight`](Self::weight); with a finite one, the waypoint is met only approximately.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }
}

/// Boundary condition for the first and the last point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ends {
    /// The ends stay fixed. The frames before and after the trajectory count as unchanged, so that the velocity hardly
    /// jumps at the ends.
    #[default]
    Fixed,
    /// The ends move freely, to minimise the cost.
    Free,
}

/// A trajectory to deform, with the parameters of the deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Trajectory<'a> {
    /// Animated points, one per frame, in any space and unit.
    pub points: &'a [Vec3],
    /// Times of the frames, strictly increasing, in any unit; empty for evenly spaced frames. They enter the
    /// accelerations. Intervals below a thousandth of the mean are treated as that long.
    pub times: &'a [f32],
    /// Boundary condition for the ends. Default [`Ends::Fixed`].
    pub ends: Ends,
    /// Fraction of the trajectory over which a change is spread, 0…1. Smaller values preserve places better and add
    /// more acceleration; at 0 the curve is not unique. Default 0.04.
    pub smoothing: f32,
    /// Maximum number of evaluations of the cost. Default 30.
    pub evaluations: usize,
    /// Fraction of the initial gradient at which the iteration stops. Default 1e-6.
    pub tolerance: f32,
}

/// Status of a deformation: success, or the reason why the trajectory misses a waypoint or has not converged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// It passes through all waypoints to within 1e-6 of the trajectory's extent, and has converged to a minimum of the
    /// cost.
    Met,
    /// It passes through all waypoints, but the evaluations ran out before the gradient was small enough.
    Unsettled,
    /// It misses a waypoint, because its weight is finite or another waypoint of the same frame contradicts it. The
    /// result is the best compromise.
    Missed,
    /// An input is not finite, a waypoint's frame does not exist, times do not increase, or a slice is too short. The
    /// output is the animated trajectory.
    Degenerate,
}

/// Result of a deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// `Met` if the trajectory passes through its waypoints, otherwise the reason why not.
    pub status: Status,
    /// Number of evaluations of the cost.
    pub evaluations: usize,
    /// Final gradient, as a fraction of the initial one.
    pub gradient: f64,
    /// Total change of places, Σ (Δα² + Δβ²), in the trajectory's units squared.
    pub distortion: f64,
    /// Largest distance from a waypoint, in the trajectory's units.
    pub missed: f64,
}

impl<'a> Trajectory<'a> {
    /// Creates a trajectory with evenly spaced frames and fixed ends.
    #[must_use]
    pub const fn new(points: &'a [Vec3]) -> Self {
        Self { points, times: &[], ends: Ends::Fixed, smoothing: 0.04, evaluations: 30, tolerance: 1e-6 }
    }

    /// Sets the [`times`](Self::times) of the frames.
    #[must_use]
    pub const fn with_times(mut self, times: &'a [f32]) -> Self {
        self.times = times;
        self
    }

    /// Sets the boundary condition for the [`ends`](Self::ends).
    #[must_use]
    pub const fn with_ends(mut self, ends: Ends) -> Self {
        self.ends = ends;
        self
    }

    /// Sets the [`smoothing`](Self::smoothing), 0…1.
    #[must_use]
    pub const fn with_smoothing(mut self, smoothing: f32) -> Self {
        self.smoothing = smoothing;
        self
    }

    /// Sets the maximum number of [`evaluations`](Self::evaluations).
    #[must_use]
    pub const fn with_evaluations(mut self, evaluations: usize) -> Self {
        self.evaluations = evaluations;
        self
    }

    /// Sets the [`tolerance`](Self::tolerance), as a fraction of the initial gradient.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: f32) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Returns the place of a frame's animated point in the frame of its neighbours. `None` for the first and the last
    /// frame and for frames that do not exist.
    #[must_use]
    pub fn place(&self, frame: usize) -> Option<Place> {
        let points = self.points.get(frame.checked_sub(1)?..)?;
        points.first_chunk().map(|points| Place::new(*points))
    }

    /// Writes the deformed trajectory to `out`. `workspace` and `out` must be at least as long as the trajectory.
    ///
    /// The iteration starts from [`smoothest`](Self::smoothest), so the same input gives the same curve.
    pub fn deform(&self, waypoints: &[Waypoint], out: &mut [Vec3], workspace: &mut [Node]) -> Outcome {
        self.run(waypoints, out, workspace, |problem, _| {
            problem.smooth();
            problem.minimise(self.evaluations, f64::from(self.tolerance))
        })
    }

    /// Deforms the trajectory starting from the curve in `out`, and writes the result there. The result does not depend
    /// on the start, up to the tolerance. Other arguments as for [`deform`](Self::deform).
    pub fn deform_from_here(&self, waypoints: &[Waypoint], out: &mut [Vec3], workspace: &mut [Node]) -> Outcome {
        self.run(waypoints, out, workspace, |problem, start| {
            problem.start_at(start);
            problem.minimise(self.evaluations, f64::from(self.tolerance))
        })
    }

    /// Writes the trajectory that meets the waypoints with the least change of acceleration, regardless of places. The
    /// starting point of [`deform`](Self::deform), and a baseline to compare it with. Arguments as for
    /// [`deform`](Self::deform).
    pub fn smoothest(&self, waypoints: &[Waypoint], out: &mut [Vec3], workspace: &mut [Node]) -> Outcome {
        self.run(waypoints, out, workspace, |problem, _| {
            problem.smooth();
            (1, 0.0)
        })
    }

    /// Writes the result of gradient descent as published: no smoothing, every waypoint as a spring. A reference only:
    /// it is slow, and its result depends on its start. Arguments as for [`deform`](Self::deform).
    pub fn descend(
        &self,
        waypoints: &[Waypoint],
        descent: Descent,
        out: &mut [Vec3],
        workspace: &mut [Node],
    ) -> Outcome {
        self.run(waypoints, out, workspace, |problem, _| problem.descend(waypoints, descent))
    }

    fn run(
        &self,
        waypoints: &[Waypoint],
        out: &mut [Vec3],
        workspace: &mut [Node],
        solve: impl FnOnce(&mut cost::Problem<'_>, &[Vec3]) -> (usize, f64),
    ) -> Outcome {
        let frames = self.points.len();
        let solved = match (out.get_mut(..frames), workspace.get_mut(..frames)) {
            (Some(out), Some(nodes)) => cost::Problem::new(self, waypoints, nodes).and_then(|mut problem| {
                let (evaluations, gradient) = solve(&mut problem, out);
                problem.write(out).then(|| (evaluations, gradient, problem.distortion()))
            }),
            _ => None,
        };
        let Some((evaluations, gradient, distortion)) = solved else {
            for (out, &point) in out.iter_mut().zip(self.points) {
                *out = point;
            }
            let nothing = Outcome {
                status: Status::Degenerate,
                evaluations: 0,
                gradient: 0.0,
                distortion: 0.0,
                missed: missed(waypoints, self.points),
            };
            return nothing;
        };
        let missed = missed(waypoints, out);
        let status = if missed > 1e-6 * cost::extent(self.points) {
            Status::Missed
        } else if gradient <= f64::from(self.tolerance) {
            Status::Met
        } else {
            Status::Unsettled
        };
        Outcome { status, evaluations, gradient, distortion, missed }
    }
}

/// Returns the largest distance of a waypoint of positive weight from the trajectory; ∞ if it is not finite.
fn missed(waypoints: &[Waypoint], points: &[Vec3]) -> f64 {
    let distance = |waypoint: &Waypoint| match points.get(waypoint.frame) {
        Some(point) if point.is_finite() && waypoint.point.is_finite() => {
            node::length(node::minus(node::wide(*point), node::wide(waypoint.point)))
        }
        _ => f64::INFINITY,
    };
    waypoints.iter().filter(|waypoint| waypoint.weight > 0.0).map(distance).fold(0.0, f64::max)
}
