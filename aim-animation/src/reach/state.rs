//! [`ReachState`]: one character's way, and the memory that deforming it takes.

use alloc::vec::Vec;
use core::mem::swap;

use aim_runtime::glam::{Affine3A, Vec3};
use aim_runtime::ik::CcdJoint;
use aim_runtime::trajectory::{Node, Outcome, Trajectory, Waypoint};

use crate::limb::Limb;
use crate::mask::clamped;
use crate::transform::Transform;

/// The way of one character's limb: made once by [`Reach::state`](super::Reach::state), led by
/// [`Reach::aim`](super::Reach::aim).
#[derive(Clone, Debug)]
pub struct ReachState {
    /// The part of the deformation that is applied, 0…1; NaN counts as 0. 1 by default. That of the clip in a blend.
    pub weight: f32,
    shown: Way,
    /// The offset that fades out.
    from: Way,
    fade_s: f32,
    elapsed_s: f32,
    /// Input and result of a deformation: times, the way as animated and as deformed.
    pub(super) times: Vec<f32>,
    pub(super) rest: Vec<Vec3>,
    through: Vec<Vec3>,
    nodes: Vec<Node>,
    pub(super) waypoints: Vec<Waypoint>,
    pub(super) pose: Vec<Transform>,
    pub(super) model: Vec<Affine3A>,
    pub(super) joints: Vec<CcdJoint>,
}

/// By how much a way is deformed, in lengths of the limb: at times, and cubics in between.
#[derive(Clone, Debug)]
struct Way {
    times: Vec<f32>,
    offsets: Vec<Vec3>,
}

impl ReachState {
    pub(super) fn new(times: &[f32], limb: &Limb) -> Self {
        let count = times.len();
        let still = Way { times: times.to_vec(), offsets: alloc::vec![Vec3::ZERO; count] };
        Self {
            weight: 1.0,
            from: still.clone(),
            fade_s: 0.0,
            elapsed_s: 0.0,
            times: times.to_vec(),
            rest: still.offsets.clone(),
            through: still.offsets.clone(),
            nodes: alloc::vec![Node::default(); count],
            // No two goals have one sample.
            waypoints: Vec::with_capacity(count),
            pose: alloc::vec![Transform::IDENTITY; limb.bones()],
            model: alloc::vec![Affine3A::IDENTITY; limb.bones()],
            joints: limb.memory(),
            shown: still,
        }
    }

    /// Goes on fading by `dt_s` seconds; what is negative or not finite counts as 0.
    pub fn advance(&mut self, dt_s: f32) {
        if dt_s.is_finite() {
            self.elapsed_s = (self.elapsed_s + dt_s.max(0.0)).min(self.fade_s);
        }
    }

    /// True if no way fades any more.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        !(self.elapsed_s < self.fade_s)
    }

    /// Deforms the way that `times` and `rest` hold through the waypoints, and begins to fade to it.
    pub(super) fn deform(&mut self, settings: &Trajectory<'_>, fade_s: f32) -> Outcome {
        let mut trajectory = *settings;
        (trajectory.points, trajectory.times) = (&self.rest, &self.times);
        let outcome = trajectory.deform(&self.waypoints, &mut self.through, &mut self.nodes);
        if !self.is_settled() {
            // What is shown now, at the samples of the newer way.
            let part = self.part();
            for (offset, &time) in self.shown.offsets.iter_mut().zip(&self.shown.times) {
                let from = self.from.at(time);
                *offset = from + (*offset - from) * part;
            }
        }
        swap(&mut self.from, &mut self.shown);
        self.shown.times.copy_from_slice(&self.times);
        for ((offset, through), rest) in self.shown.offsets.iter_mut().zip(&self.through).zip(&self.rest) {
            *offset = *through - *rest;
        }
        (self.elapsed_s, self.fade_s) = (0.0, if fade_s.is_finite() { fade_s.max(0.0) } else { 0.0 });
        outcome
    }

    /// By how much the way is deformed at a time, times the weight, in lengths of the limb.
    pub(super) fn offset(&self, time_s: f32) -> Vec3 {
        let mut offset = self.shown.at(time_s);
        if !self.is_settled() {
            let from = self.from.at(time_s);
            offset = from + (offset - from) * self.part();
        }
        offset * clamped(self.weight)
    }

    /// The part of the new way that is shown.
    fn part(&self) -> f32 {
        let u = self.elapsed_s / self.fade_s;
        u * u * (3.0 - 2.0 * u)
    }
}

impl Way {
    /// The difference at a time: cubics whose velocity at a sample is that of the parabola through it and its neighbours, and
    /// at rest at the ends.
    fn at(&self, time_s: f32) -> Vec3 {
        let Self { times, offsets } = self;
        let last = times.len() - 1;
        let next = times.partition_point(|&time| time <= time_s);
        if next == 0 || next > last {
            return offsets[next.min(last)];
        }
        let k = next - 1;
        let interval = |k: usize| times[k + 1] - times[k];
        let velocity = |at: usize| {
            if at == 0 || at == last {
                return Vec3::ZERO;
            }
            let [before, after] = [interval(at - 1), interval(at)];
            let [arriving, leaving] =
                [(offsets[at] - offsets[at - 1]) / before, (offsets[at + 1] - offsets[at]) / after];
            (arriving * after + leaving * before) / (before + after)
        };
        let u = (time_s - times[k]) / interval(k);
        let v = 1.0 - u;
        // H₀ = v²(1 + 2u), H₁ = u·v², H₂ = u²(1 + 2v), H₃ = −u²·v.
        let ends = offsets[k] * (v * v * (1.0 + 2.0 * u)) + offsets[next] * (u * u * (1.0 + 2.0 * v));
        ends + (velocity(k) * (u * v * v) - velocity(next) * (u * u * v)) * interval(k)
    }
}
