//! What is in sight stays there while the joints that support the eye go to their goals, each at its own pace.
//!
//! The eye makes up for what they do as far as its range goes, so together they may be no faster than that all of them
//! can stop before its end. A joint that turns towards the point is no help before it has done so, as another may be
//! quicker: what is judged is the sum of the worst that each angle does from now until it stops. Braking never makes
//! that worse, and so what can be kept in sight in one frame can be in the next.

use core::f32::consts::PI;

use glam::Vec3A;

use super::follow::Follower;
use super::{Gaze, Look, SAME_RAD};
use crate::Joint;
use crate::limits::reach::Reach;

/// What is out of the eye's range by no more than this is in sight, radians (0.03°).
const IN_SIGHT_RAD: f32 = 5e-4;
/// How much further the eye may have to turn than a joint does that it makes up for, the point being near.
const NEARBY: f32 = 2.0;
/// Halvings that find how much of its step a joint may take.
const HALVINGS: usize = 6;

/// An angle of a supporting joint in this frame, between the step that brakes it and the one that it would take.
#[derive(Clone, Copy, Debug, Default)]
struct Turning {
    /// How far it goes in the frame, and how fast it is then.
    ways: [f32; 2],
    speeds: [f32; 2],
    /// By how much that takes the point out of each end of the eye's range, a radian.
    out: [f32; 4],
    is_held_back: bool,
}

impl Turning {
    /// How far it goes with this part of the step, in the frame and until it stops.
    fn goes(&self, follower: &Follower<'_>, part: f32) -> [f32; 2] {
        let mix = |[braked, wanted]: [f32; 2]| braked + part * (wanted - braked);
        let way = mix(self.ways);
        [way, way + follower.stopping_distance(mix(self.speeds))]
    }

    /// The farthest that it may come to be from where it is.
    fn farthest(&self, follower: &Follower<'_>) -> f32 {
        let [braked, wanted] = [0.0, 1.0].map(|part| self.goes(follower, part)[1]);
        if braked.abs() > wanted.abs() { braked } else { wanted }
    }
}

impl<const C: usize> Gaze<'_, C> {
    /// Holds those of the supporting joints back that would take a point out of the eye's range: `moved` are the steps
    /// that they would take from `joints`. A point that is not in sight binds nobody.
    pub(super) fn keep_in_sight(
        &self,
        joints: &[Joint],
        moved: &mut [Joint],
        point: Vec3A,
        look: &Look,
        reaches: &[Reach],
        dt: f32,
    ) -> Option<()> {
        let range = &self.ranges[0];
        // An eye that cannot turn both ways keeps nothing in sight by itself.
        if !self.plain_eye || range.heading.is_point() || range.pitch.is_point() {
            return None;
        }
        let mut farther = 0.0;
        for index in self.supporting() {
            let follower = self.follower(index, reaches, dt);
            farther += moved[index].velocity.map(|speed| follower.stopping_distance(speed).abs()).iter().sum::<f32>();
        }
        let has_room = |out: [f32; 4], enough: f32| out.iter().all(|out| -*out >= enough);
        if look.within && has_room(self.out_of_range(look.angles), NEARBY * farther) {
            return None;
        }
        let out = self.out_of_range(self.bearing(joints, point)?.1);
        if !has_room(out, -IN_SIGHT_RAD) {
            return None;
        }
        let mut braked = self.rig.array(Joint::REST);
        let mut turnings = self.rig.array([Turning::default(); 2]);
        for index in self.supporting() {
            let follower = self.follower(index, reaches, dt);
            braked[index] = follower.stopping(&joints[index]);
            for (k, turning) in turnings[index].iter_mut().enumerate() {
                let steps = [&braked[index], &moved[index]];
                turning.ways = steps.map(|step| step.angles()[k] - joints[index].angles()[k]);
                turning.speeds = steps.map(|step| step.velocity[k]);
            }
        }
        self.see_what_turnings_do(joints, point, out, &mut turnings, reaches, dt)?;

        let worst = |turnings: &[[Turning; 2]], part: f32| {
            let mut worst = out;
            for index in self.supporting() {
                let follower = self.follower(index, reaches, dt);
                for turning in &turnings[index] {
                    let [soon, late] = turning.goes(&follower, if turning.is_held_back { part } else { 1.0 });
                    for (worst, out) in worst.iter_mut().zip(turning.out) {
                        *worst += (out * soon).max(out * late);
                    }
                }
            }
            worst
        };
        let left = worst(&turnings, 1.0).map(|out| out > 0.0);
        if left == [false; 4] {
            return None;
        }
        for index in self.supporting() {
            let follower = self.follower(index, reaches, dt);
            for turning in &mut turnings[index] {
                let gain = turning.goes(&follower, 1.0)[1] - turning.goes(&follower, 0.0)[1];
                turning.is_held_back = left.iter().zip(turning.out).any(|(left, out)| *left && out * gain > 0.0);
            }
        }
        let farthest_out = |part: f32| worst(&turnings, part).into_iter().fold(f32::NEG_INFINITY, f32::max);
        let (mut kept, mut lost) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let part = 0.5 * (kept + lost);
            if farthest_out(part) <= 0.0 { kept = part } else { lost = part }
        }
        // On to the very part along the chord: halves alone would make steps of rounding.
        let [inside, outside] = [kept, lost].map(farthest_out);
        if inside < 0.0 && outside > 0.0 {
            kept += (lost - kept) * inside / (inside - outside);
        }
        for index in self.supporting() {
            let parts = turnings[index].map(|turning| if turning.is_held_back { kept } else { 1.0 });
            let follower = self.follower(index, reaches, dt);
            moved[index] = follower.between(&joints[index], [&braked[index], &moved[index]], parts);
        }
        Some(())
    }

    /// Finds what each angle does to the sight of a point, turned as far as it may come to be.
    fn see_what_turnings_do(
        &self,
        joints: &[Joint],
        point: Vec3A,
        out: [f32; 4],
        turnings: &mut [[Turning; 2]],
        reaches: &[Reach],
        dt: f32,
    ) -> Option<()> {
        let mut turned = self.rig.array(Joint::REST);
        turned.copy_from_slice(joints);
        for index in self.supporting() {
            let follower = self.follower(index, reaches, dt);
            for (k, turning) in turnings[index].iter_mut().enumerate() {
                let farthest = turning.farthest(&follower);
                if farthest.abs() < SAME_RAD {
                    continue;
                }
                let mut angles = joints[index].angles();
                angles[k] += farthest;
                [turned[index].heading, turned[index].pitch] = angles;
                let there = self.out_of_range(self.bearing(&turned, point)?.1);
                turning.out = [0, 1, 2, 3].map(|end| (there[end] - out[end]) / farthest);
                turned[index] = joints[index];
            }
        }
        Some(())
    }

    /// By how much these angles of the eye are beyond each end of its range, to the right, to the left, down and up;
    /// negative within.
    fn out_of_range(&self, [heading, pitch]: [f32; 2]) -> [f32; 4] {
        let range = &self.ranges[0];
        let (headings, pitches) = (range.heading, range.pitch_at(range.heading.hold(heading)));
        let out = [headings.lo() - heading, heading - headings.hi(), pitches.lo() - pitch, pitch - pitches.hi()];
        // A range without an end has room enough.
        out.map(|out| out.max(-PI))
    }
}
