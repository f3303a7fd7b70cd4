//! [`ReachState`]: the deformed path of one character, and the buffers for computing it.

use alloc::vec::Vec;
use core::mem::swap;

use aim_runtime::glam::{Affine3A, Vec3};
use aim_runtime::ik::CcdJoint;
use aim_runtime::trajectory::{Node, Outcome, Trajectory, Waypoint};

use crate::limb::Limb;
use crate::mask::clamped;
use crate::transform::Transform;

/// State of one character's limb: created by [`Reach::state`](super::Reach::state), changed by
/// [`Reach::aim`](super::Reach::aim).
#[derive(Clone, Debug)]
pub struct ReachState {
    /// Fraction of the deformation that is applied, 0…1; NaN is treated as 0. Default 1. In a blend, set it to the
    /// weight of the clip.
    pub weight: f32,
    shown: PathDeformation,
    /// The deformation that is fading out.
    from: PathDeformation,
    fade_s: f32,
    elapsed_s: f32,
    /// Input and output of a deformation: times, the animated path, the deformed path.
    pub(super) times: Vec<f32>,
    pub(super) rest: Vec<Vec3>,
    through: Vec<Vec3>,
    nodes: Vec<Node>,
    pub(super) waypoints: Vec<Waypoint>,
    pub(super) pose: Vec<Transform>,
    pub(super) model: Vec<Affine3A>,
    pub(super) joints: Vec<CcdJoint>,
}

/// Deformation of a path, in units of the limb's length: offsets at times, interpolated by cubics.
#[derive(Clone, Debug)]
struct PathDeformation {
    times: Vec<f32>,
    offsets: Vec<Vec3>,
}

impl ReachState {
    pub(super) fn new(times: &[f32], limb: &Limb) -> Self {
        let count = times.len();
        let still = PathDeformation { times: times.to_vec(), offsets: alloc::vec![Vec3::ZERO; count] };
        Self {
            weight: 1.0,
            from: still.clone(),
            fade_s: 0.0,
            elapsed_s: 0.0,
            times: times.to_vec(),
            rest: still.offsets.clone(),
            through: still.offsets.clone(),
            nodes: alloc::vec![Node::default(); count],
            // No two goals share a sample, so this capacity suffices.
            waypoints: Vec::with_capacity(count),
            pose: alloc::vec![Transform::IDENTITY; limb.bones()],
            model: alloc::vec![Affine3A::IDENTITY; limb.bones()],
            joints: limb.memory(),
            shown: still,
        }
    }

    /// Advances the fade by `dt_s` seconds; a value that is negative or not finite is treated as 0.
    pub fn advance(&mut self, dt_s: f32) {
        if dt_s.is_finite() {
            self.elapsed_s = (self.elapsed_s + dt_s.max(0.0)).min(self.fade_s);
        }
    }

    /// Returns `true` if no fade is in progress.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        !(self.elapsed_s < self.fade_s)
    }

    /// Deforms the path in `times` and `rest` through the waypoints, and starts to fade to it.
    pub(super) fn deform(&mut self, settings: &Trajectory<'_>, fade_s: f32) -> Outcome {
        let mut trajectory = *settings;
        (trajectory.points, trajectory.times) = (&self.rest, &self.times);
        let outcome = trajectory.deform(&self.waypoints, &mut self.through, &mut self.nodes);
        if !self.is_settled() {
            // Freeze the deformation displayed now, at the samples of the newer path.
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

    /// Deformation of the path at a time, times the weight, in units of the limb's length.
    pub(super) fn offset(&self, time_s: f32) -> Vec3 {
        let mut offset = self.shown.at(time_s);
        if !self.is_settled() {
            let from = self.from.at(time_s);
            offset = from + (offset - from) * self.part();
        }
        offset * clamped(self.weight)
    }

    /// Smoothstep weight of the new path.
    fn part(&self) -> f32 {
        let u = self.elapsed_s / self.fade_s;
        u * u * (3.0 - 2.0 * u)
    }
}

impl PathDeformation {
    /// Deformation at a time. The cubics have at each sample the velocity of the parabola through it and its
    /// neighbours, and zero velocity at the ends.
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
