//! [`Shift`]: one gaze shift, frame by frame, from a target straight ahead to one that appears to the side.

use aim::glam::{Affine3A, DVec3, Quat};
use aim::{AimRig, Rig, Settings};

use super::super::chain::{DEG, Gazer};
use super::super::model::{Angles, MOST, Model, angle};
use super::super::row::largest;
use super::super::sample::{Scene, frames};

/// Indices of the eye's pitch and heading among the declared angles.
const EYE: [usize; 2] = [0, 1];
/// Indices of the neck's pitch and heading among the declared angles.
pub(crate) const NECK: [usize; 2] = [2, 3];
/// Indices of the chest's pitch and heading among the declared angles.
pub(crate) const CHEST: [usize; 2] = [4, 5];
/// Angle within which the gaze has arrived, radians.
const ARRIVED: f64 = 0.1 * DEG;
/// Length of the observation, seconds.
const SECONDS: f64 = 1.5;

/// State of one frame; the first is before the target appears.
#[derive(Clone, Copy, Debug)]
struct Frame {
    angles: Angles,
    gaze: DVec3,
    remaining: f64,
}

/// A recorded gaze shift.
#[derive(Clone, Debug)]
pub(crate) struct Shift {
    frames: Vec<Frame>,
    hz: f64,
    /// Direction of the gaze before the shift.
    ahead: DVec3,
    /// Direction of the target after the shift.
    aside: DVec3,
    accelerations: Vec<f64>,
}

impl Shift {
    /// Records the shift to a target at 2 m that jumps by `degrees` in a direction: 0 is left, a quarter turn is up.
    pub(crate) fn new(pose: &[Affine3A; 3], degrees: f64, direction: f64, hz: f32, settings: &Settings) -> Self {
        let rig = Gazer::RIG;
        let model = Model::new(rig, pose);
        let [origin, ahead] = model.seen(&[Quat::IDENTITY; 3]);
        let left = DVec3::Y.cross(ahead).normalize();
        let up = ahead.cross(left);
        let ((sin, cos), (sin_d, cos_d)) = ((degrees * DEG).sin_cos(), direction.sin_cos());
        let aside = cos * ahead + sin * (cos_d * left + sin_d * up);
        let at = |towards: DVec3| (origin + 2.0 * towards).as_vec3();
        let accelerations =
            model.angles.iter().map(|angle| f64::from(rig.description().joints()[angle.joint].acceleration)).collect();
        let mut scene = Scene::new(rig, pose, at(ahead));
        scene.run(frames(0.5, hz), 1.0 / hz, settings);
        scene.target = at(aside);
        let mut seen = Vec::new();
        for frame in 0..=frames(SECONDS, hz) {
            if frame > 0 {
                scene.step(1.0 / hz, settings);
            }
            let [_, gaze] = model.seen(scene.rig.corrections());
            seen.push(Frame { angles: scene.angles(&model), gaze, remaining: scene.remaining(&model) });
        }
        Self { frames: seen, hz: hz.into(), ahead, aside, accelerations }
    }

    fn turned(frame: &Frame, [pitch, heading]: [usize; 2]) -> f64 {
        frame.angles[pitch].hypot(frame.angles[heading])
    }

    /// Returns the largest rotation of a joint, degrees.
    pub(crate) fn most(&self, joint: [usize; 2]) -> f64 {
        largest(self.frames.iter().map(|frame| Self::turned(frame, joint))) / DEG
    }

    /// Returns the delay between the eye's first degree of rotation and the neck's, milliseconds, interpolated within
    /// the frame.
    pub(crate) fn neck_after_eye(&self) -> f64 {
        1e3 * (self.begins(NECK) - self.begins(EYE))
    }

    fn begins(&self, joint: [usize; 2]) -> f64 {
        let turned: Vec<f64> = self.frames.iter().map(|frame| Self::turned(frame, joint) / DEG).collect();
        match turned.iter().position(|&turned| turned >= 1.0) {
            Some(0) => 0.0,
            Some(next) => {
                let part = (1.0 - turned[next - 1]) / (turned[next] - turned[next - 1]);
                (next as f64 - 1.0 + part) / self.hz
            }
            None => f64::NAN,
        }
    }

    fn arrival(&self) -> Option<usize> {
        self.frames.iter().position(|frame| frame.remaining <= ARRIVED)
    }

    /// Returns the time at which the gaze first reaches the target, milliseconds; NaN if it does not.
    pub(crate) fn arrives(&self) -> f64 {
        self.arrival().map_or(f64::NAN, |frame| 1e3 * frame as f64 / self.hz)
    }

    /// Returns the largest angle between gaze and target after arrival, degrees; NaN if it does not arrive.
    pub(crate) fn off_later(&self) -> f64 {
        let later = self.arrival().map_or(&[][..], |arrival| &self.frames[arrival..]);
        if later.is_empty() { f64::NAN } else { largest(later.iter().map(|frame| frame.remaining)) / DEG }
    }

    /// Returns the rotation of the neck between arrival and the end, degrees, which the eye has to compensate.
    pub(crate) fn neck_turns_later(&self) -> f64 {
        let end = self.frames[self.frames.len() - 1];
        self.arrival().map_or(f64::NAN, |arrival| {
            let there = self.frames[arrival];
            NECK.map(|i| end.angles[i] - there.angles[i]).iter().fold(0.0_f64, |sum, x| sum.hypot(*x)) / DEG
        })
    }

    /// Returns the eye's largest and final eccentricity, degrees.
    pub(crate) fn eccentricities(&self) -> [f64; 2] {
        let end = &self.frames[self.frames.len() - 1];
        [self.most(EYE), Self::turned(end, EYE) / DEG]
    }

    /// Returns the largest acceleration of a joint's angles, from second differences of the frames, relative to the
    /// declared limit.
    pub(crate) fn jerkiest(&self, joint: [usize; 2]) -> f64 {
        let dt = 1.0 / self.hz;
        largest(joint.into_iter().flat_map(|i| {
            // The joints are at rest before the first frame.
            let still = [self.frames[0]];
            let all: Vec<f64> = still.iter().chain(&self.frames).map(|frame| frame.angles[i]).collect();
            let changes: Vec<f64> = all.windows(3).map(|w| (w[2] - 2.0 * w[1] + w[0]).abs() / (dt * dt)).collect();
            let allowed = self.accelerations[i];
            changes.into_iter().map(move |change| change / allowed)
        }))
    }

    /// Returns the largest overshoot, degrees: of the gaze past the target, and of the chest alone and of neck and
    /// chest together past their final angles. The neck alone is left out, since it compensates for a chest that
    /// arrives later.
    pub(crate) fn overshoot(&self) -> f64 {
        let whole = angle(self.ahead, self.aside);
        let along = self.aside.reject_from_normalized(self.ahead).normalize();
        let past = self.frames.iter().map(|frame| frame.gaze.dot(along).atan2(frame.gaze.dot(self.ahead)) - whole);
        let gaze = largest(past);
        let (start, end) = (self.frames[0], self.frames[self.frames.len() - 1]);
        let sums = [[CHEST[0], MOST - 1], [CHEST[1], MOST - 1], [CHEST[0], NECK[0]], [CHEST[1], NECK[1]]];
        let joints = sums.map(|[i, j]| {
            let sum = |frame: &Frame| frame.angles[i] + frame.angles[j];
            let sense = (sum(&end) - sum(&start)).signum();
            largest(self.frames.iter().map(|frame| sense * (sum(frame) - sum(&end))))
        });
        largest(joints.into_iter().chain([gaze])) / DEG
    }

    /// Returns the largest deviation of the gaze from the great circle between its start and the target, degrees.
    pub(crate) fn off_arc(&self) -> f64 {
        let normal = self.ahead.cross(self.aside).normalize();
        largest(self.frames.iter().map(|frame| frame.gaze.dot(normal).asin().abs())) / DEG
    }
}
