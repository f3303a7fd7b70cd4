//! The target constraint: a bone's trajectory is deformed as a whole, so that it comes through given points at given
//! times and is otherwise as it was animated.
//!
//! Every point of the trajectory has a place in the frame of its neighbours, α along their chord and β beside it. The
//! deformed trajectory is that of the least change of these places, plus a little of its acceleration's change
//! ([`Trajectory::smoothing`]): places alone leave torsion free, so that different starts would lead to different curves.
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
//! Points are `f32`; inside everything is `f64`: a place is the difference of two near points, and of a place's change
//! nothing would be left in `f32`. The cost in time and memory is linear in the number of frames.

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

/// Where the trajectory has to be in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// The frame.
    pub frame: usize,
    /// The point, in the space of the trajectory.
    pub point: Vec3,
    /// How much being off counts, beside changes of places: infinite (as [`new`](Self::new) makes it) for a point that has
    /// to be met. 0 or less, or NaN: not at all.
    pub weight: f32,
}

impl Waypoint {
    /// A point that has to be met.
    #[must_use]
    pub const fn new(frame: usize, point: Vec3) -> Self {
        Self { frame, point, weight: f32::INFINITY }
    }

    /// Met as far as this weight is worth it.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }
}

/// What becomes of the first and the last point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ends {
    /// They stay, and what lies before and after them counts as unchanged, so that velocity hardly jumps there.
    #[default]
    Fixed,
    /// They go where it is cheapest.
    Free,
}

/// A trajectory to deform.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Trajectory<'a> {
    /// As animated, a point a frame, in any one space and unit.
    pub points: &'a [Vec3],
    /// The frames' times, increasing, in any unit; empty for frames at even times. Times make accelerations; frames nearer
    /// than a thousandth of the mean count as that far apart.
    pub times: &'a [f32],
    /// What becomes of the ends.
    pub ends: Ends,
    /// Over which part of the trajectory a change is spread rather than let it be sudden, 0…1; 0.04 by default. Less keeps
    /// places better and adds more acceleration. At 0 the curve is not unique.
    pub smoothing: f32,
    /// How often the cost is evaluated at most; 30 by default.
    pub evaluations: usize,
    /// The part of the first gradient that may be left; 1e-6 by default.
    pub tolerance: f32,
}

/// Whether a trajectory comes through its waypoints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// Through all of them, to 1e-6 of the trajectory's extent, and nothing cheaper is near.
    Met,
    /// Through all of them, but evaluations ran out before the gradient was small enough.
    Unsettled,
    /// Past one: its weight is finite, or another waypoint of the same frame says otherwise. As near as that lets it.
    Missed,
    /// Something is no number, a frame is not there, times do not increase, or a slice is too short: the output is the
    /// trajectory as animated.
    Degenerate,
}

/// What became of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Whether it comes through the waypoints.
    pub status: Status,
    /// How often the cost was evaluated.
    pub evaluations: usize,
    /// The gradient that is left, as a part of the first one.
    pub gradient: f64,
    /// Σ (Δα² + Δβ²), in the trajectory's units squared.
    pub distortion: f64,
    /// The largest distance from a waypoint, in the trajectory's units.
    pub missed: f64,
}

impl<'a> Trajectory<'a> {
    /// A trajectory at even times, its ends fixed.
    #[must_use]
    pub const fn new(points: &'a [Vec3]) -> Self {
        Self { points, times: &[], ends: Ends::Fixed, smoothing: 0.04, evaluations: 30, tolerance: 1e-6 }
    }

    /// With the frames' times.
    #[must_use]
    pub const fn with_times(mut self, times: &'a [f32]) -> Self {
        self.times = times;
        self
    }

    /// With the ends fixed or free.
    #[must_use]
    pub const fn with_ends(mut self, ends: Ends) -> Self {
        self.ends = ends;
        self
    }

    /// Spread over this part of the trajectory, 0…1.
    #[must_use]
    pub const fn with_smoothing(mut self, smoothing: f32) -> Self {
        self.smoothing = smoothing;
        self
    }

    /// With this many evaluations at most.
    #[must_use]
    pub const fn with_evaluations(mut self, evaluations: usize) -> Self {
        self.evaluations = evaluations;
        self
    }

    /// Until this part of the first gradient is left.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: f32) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The place of a frame's point as animated; `None` of the first and the last frame and of those that are not there.
    #[must_use]
    pub fn place(&self, frame: usize) -> Option<Place> {
        let points = self.points.get(frame.checked_sub(1)?..)?;
        points.first_chunk().map(|points| Place::new(*points))
    }

    /// Writes the trajectory through the waypoints to `out`. `workspace` and `out` are at least as long as the trajectory.
    ///
    /// It starts from [`smoothest`](Self::smoothest), so the same input gives the same curve.
    pub fn deform(&self, waypoints: &[Waypoint], out: &mut [Vec3], workspace: &mut [Node]) -> Outcome {
        self.run(waypoints, out, workspace, |problem, _| {
            problem.smooth();
            problem.minimise(self.evaluations, f64::from(self.tolerance))
        })
    }

    /// The same from another start, which `out` holds. In the end it makes no difference.
    pub fn deform_from_here(&self, waypoints: &[Waypoint], out: &mut [Vec3], workspace: &mut [Node]) -> Outcome {
        self.run(waypoints, out, workspace, |problem, start| {
            problem.start_at(start);
            problem.minimise(self.evaluations, f64::from(self.tolerance))
        })
    }

    /// Adds the smoothest bump that meets the waypoints, that of the least change of acceleration, whatever becomes of
    /// places: what [`deform`](Self::deform) starts from and is to be compared with.
    pub fn smoothest(&self, waypoints: &[Waypoint], out: &mut [Vec3], workspace: &mut [Node]) -> Outcome {
        self.run(waypoints, out, workspace, |problem, _| {
            problem.smooth();
            (1, 0.0)
        })
    }

    /// Gradient descent as published: no smoothing, every waypoint as a spring. Kept as the reference; slow, and where it
    /// ends depends on where it starts.
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

/// The largest distance of a waypoint that counts from the trajectory; ∞ where it has no number.
fn missed(waypoints: &[Waypoint], points: &[Vec3]) -> f64 {
    let distance = |waypoint: &Waypoint| match points.get(waypoint.frame) {
        Some(point) if point.is_finite() && waypoint.point.is_finite() => {
            node::length(node::minus(node::wide(*point), node::wide(waypoint.point)))
        }
        _ => f64::INFINITY,
    };
    waypoints.iter().filter(|waypoint| waypoint.weight > 0.0).map(distance).fold(0.0, f64::max)
}
