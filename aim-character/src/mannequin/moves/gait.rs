//! Walking and running, straight ahead and along an arc.

use std::f64::consts::{PI, TAU};

use aim_runtime::glam::{DQuat, DVec3};

use super::curve::through;
use super::posture::{Foot, Posture};

/// A gait at constant speed. The cycle of a foot begins when it touches down.
pub(super) struct Gait {
    /// Duration of two steps, seconds.
    pub(super) period: f64,
    /// Length of two steps, metres.
    stride: f64,
    /// Curvature of the path to the left, 1/m; 0 for straight ahead.
    curvature: f64,
    /// Share of its cycle during which a foot is on the ground.
    stance: f64,
    /// Share of the stance after which the foot is below the hips.
    below: f64,
    /// Roll of the foot over its cycle: (phase, radians).
    roll: &'static [(f64, f64)],
    /// Peaks of the two terms of a swing's height, metres: in its middle, and late, before the foot comes down.
    lift: [f64; 2],
    /// Distance of the feet from the path, metres.
    aside: f64,
    /// Angle by which the feet are turned out, radians.
    out: f64,
    /// Mean height of the hips relative to the bind pose, metres.
    height: f64,
    /// Amplitude of the hips' vertical oscillation, metres.
    bob: f64,
    /// Phase at which the hips are highest; again half a cycle later.
    highest: f64,
    /// Forward lean of the trunk, radians.
    lean: f64,
    /// Phase of a foot's cycle at which the arm on its side is furthest back.
    late: f64,
    /// Amplitude of the arms' swing, radians.
    arm: f64,
    /// Bend of the elbow, radians: mean and amplitude.
    elbow: [f64; 2],
}

pub(super) const WALK: Gait = Gait {
    period: 1.1,
    stride: 1.2,
    curvature: 0.0,
    stance: 0.62,
    below: 0.44,
    roll: &[(0.0, -0.30), (0.11, 0.0), (0.32, 0.0), (0.64, 0.72), (0.69, 0.72), (0.95, -0.30), (1.0, -0.30)],
    lift: [0.06, 0.009],
    aside: 0.06,
    out: 0.1,
    height: -0.042,
    bob: 0.018,
    highest: 0.31,
    lean: 0.04,
    late: 0.07,
    arm: 0.38,
    elbow: [0.35, 0.14],
};

/// Number of cycles in a full circle.
pub(super) const CIRCLE_CYCLES: f64 = 8.0;

pub(super) const CIRCLE: Gait = Gait { curvature: TAU / (CIRCLE_CYCLES * WALK.stride), height: -0.06, ..WALK };

pub(super) const RUN: Gait = Gait {
    period: 0.7,
    stride: 2.0,
    curvature: 0.0,
    stance: 0.34,
    below: 0.42,
    roll: &[(0.0, -0.12), (0.06, 0.0), (0.12, 0.0), (0.36, 1.0), (0.55, 1.15), (0.9, -0.12), (1.0, -0.12)],
    lift: [0.27, 0.025],
    aside: 0.035,
    out: 0.05,
    height: -0.09,
    bob: 0.035,
    highest: 0.42,
    lean: 0.13,
    late: -0.07,
    arm: 0.62,
    elbow: [1.5, 0.25],
};

impl Gait {
    pub(super) fn posture(&'static self, seconds: f64) -> Posture {
        let cycle = seconds / self.period;
        let (place, heading) = self.way(cycle * self.stride);
        let p = TAU * cycle;
        // 1 with the hips over the left foot, −1 over the right one.
        let over = (p - TAU * self.stance * self.below).cos();
        let bob = self.bob * (2.0 * (p - TAU * self.highest)).cos();
        let hips = place + heading * DVec3::new(0.018 * over, self.height + bob, 0.0);
        // 1 with the left leg in front: the left hip and the right shoulder lead.
        let lead = p.cos();
        // Lean into the bend, in proportion to curvature · speed² / g.
        let inward = -0.6 * self.curvature * (self.stride / self.period).powi(2) / 9.8;
        let turn = heading * DQuat::from_rotation_y(-0.09 * lead) * DQuat::from_rotation_z(0.025 * over + inward);
        let turns = move |joint: &str| self.turn(joint, p);
        Posture {
            hips: (hips, turn),
            feet: [(0.0, 1.0), (0.5, -1.0)].map(|foot| self.foot(cycle, foot)),
            turns: Box::new(turns),
        }
    }

    /// Returns position and heading after a distance along the path, which starts at the origin along +z.
    fn way(&self, way: f64) -> (DVec3, DQuat) {
        let angle = way * self.curvature;
        let place = if self.curvature == 0.0 {
            DVec3::Z * way
        } else {
            DVec3::new(1.0 - angle.cos(), 0.0, angle.sin()) / self.curvature
        };
        (place, DQuat::from_rotation_y(angle))
    }

    /// Returns the foot on the side of `sign`, whose cycle is `late` cycles behind.
    fn foot(&self, cycle: f64, (late, sign): (f64, f64)) -> Foot {
        let (step, phase) = ((cycle - late).floor(), (cycle - late).rem_euclid(1.0));
        // Distance along the path at which the foot stands: where the hips pass over it.
        let mark = |step: f64| (step + late + self.stance * self.below) * self.stride;
        let u = ((phase - self.stance) / (1.0 - self.stance)).max(0.0);
        // The swing starts slowly, and the foot is ahead of the hips only for a short time.
        let along = mark(step) + u * u * u * (4.0 - 3.0 * u) * self.stride;
        let (place, heading) = self.way(along);
        let v = 1.0 - u;
        Foot {
            at: place + heading * DVec3::X * (sign * self.aside),
            yaw: along * self.curvature + sign * self.out,
            lift: u * u * v * (16.0 * self.lift[0] * v + 6.75 * self.lift[1]),
            roll: through(self.roll, phase),
        }
    }

    /// Returns the rotation of a joint above the legs.
    fn turn(&self, joint: &str, p: f64) -> DQuat {
        let (tip, yaw, roll) = (DQuat::from_rotation_x, DQuat::from_rotation_y, DQuat::from_rotation_z);
        let lead = p.cos();
        let (side, own) = match joint.split_once('_') {
            Some(("left", name)) => (1.0, (name, p)),
            Some(("right", name)) => (-1.0, (name, p + PI)),
            _ => (0.0, (joint, p)),
        };
        // The arm swings back while the leg on its side is in front.
        let swing = (own.1 - TAU * self.late).cos();
        match own.0 {
            "spine" | "spine1" | "spine2" | "spine3" => yaw(0.045 * lead) * tip(0.25 * self.lean),
            // Neck and head compensate for the rotation of the trunk.
            "neck" => yaw(-0.05 * lead) * tip(-0.4 * self.lean),
            "head" => yaw(-0.04 * lead) * tip(-0.5 * self.lean - 0.015 * (2.0 * p).cos()),
            "clavicle" => yaw(-side * 0.06 * swing * self.arm),
            "upper_arm" => roll(side * 0.06) * tip(0.06 + self.arm * swing),
            "lower_arm" => tip(-self.elbow[0] + self.elbow[1] * swing) * yaw(-side * 0.25 * self.elbow[0]),
            "hand" => tip(-0.08 + 0.06 * (own.1 - 0.6).cos()),
            _ => DQuat::IDENTITY,
        }
    }
}
