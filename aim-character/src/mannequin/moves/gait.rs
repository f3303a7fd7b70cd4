//! Walking and running, straight ahead and along an arc.

use std::f64::consts::{PI, TAU};

use aim_runtime::glam::{DQuat, DVec3};

use super::curve::through;
use super::posture::{Foot, Posture};

/// A gait at constant speed. A foot's cycle begins where it comes down.
pub(super) struct Gait {
    /// Of two steps, seconds.
    pub(super) period: f64,
    /// Of two steps, metres.
    stride: f64,
    /// To the left, a metre; 0 is straight ahead.
    curvature: f64,
    /// Part of its cycle that a foot is down, and the part of that at which it is below the hips.
    stance: f64,
    below: f64,
    /// The foot's roll over its cycle.
    roll: &'static [(f64, f64)],
    /// The heights of a swing: that of its middle, and that from which it comes down.
    lift: [f64; 2],
    /// Feet aside of the way, metres, and turned out, radians.
    aside: f64,
    out: f64,
    /// The hips' height relative to the bind pose, how far they bob, and where in a cycle they are highest.
    height: f64,
    bob: f64,
    highest: f64,
    /// Forward lean of the trunk, radians.
    lean: f64,
    /// How late in the cycle of the foot the arm of its side is farthest back, how far it swings, its mean bend at the elbow, and
    /// how far that swings.
    late: f64,
    arm: f64,
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

/// Cycles in one time round the circle.
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
        // Over the left foot, and over the right one.
        let over = (p - TAU * self.stance * self.below).cos();
        let bob = self.bob * (2.0 * (p - TAU * self.highest)).cos();
        let hips = place + heading * DVec3::new(0.018 * over, self.height + bob, 0.0);
        // The hip of the leg in front leads, the shoulder on the other side, too.
        let lead = p.cos();
        // Into the bend.
        let inward = -0.6 * self.curvature * (self.stride / self.period).powi(2) / 9.8;
        let turn = heading * DQuat::from_rotation_y(-0.09 * lead) * DQuat::from_rotation_z(0.025 * over + inward);
        let turns = move |joint: &str| self.turn(joint, p);
        Posture {
            hips: (hips, turn),
            feet: [(0.0, 1.0), (0.5, -1.0)].map(|foot| self.foot(cycle, foot)),
            turns: Box::new(turns),
        }
    }

    /// The place and the heading after a way, from the origin along +z.
    fn way(&self, way: f64) -> (DVec3, DQuat) {
        let angle = way * self.curvature;
        let place = if self.curvature == 0.0 {
            DVec3::Z * way
        } else {
            DVec3::new(1.0 - angle.cos(), 0.0, angle.sin()) / self.curvature
        };
        (place, DQuat::from_rotation_y(angle))
    }

    /// A foot that is `late` cycles behind, on the side of `sign`.
    fn foot(&self, cycle: f64, (late, sign): (f64, f64)) -> Foot {
        let (step, phase) = ((cycle - late).floor(), (cycle - late).rem_euclid(1.0));
        // Where the way will be when the hips pass over it.
        let mark = |step: f64| (step + late + self.stance * self.below) * self.stride;
        let u = ((phase - self.stance) / (1.0 - self.stance)).max(0.0);
        // Slow from the ground, and not ahead of the hips for long.
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

    /// The turn of a joint above the legs.
    fn turn(&self, joint: &str, p: f64) -> DQuat {
        let (tip, yaw, roll) = (DQuat::from_rotation_x, DQuat::from_rotation_y, DQuat::from_rotation_z);
        let lead = p.cos();
        let (side, own) = match joint.split_once('_') {
            Some(("left", name)) => (1.0, (name, p)),
            Some(("right", name)) => (-1.0, (name, p + PI)),
            _ => (0.0, (joint, p)),
        };
        // Back while the leg of its side is in front.
        let swing = (own.1 - TAU * self.late).cos();
        match own.0 {
            "spine" | "spine1" | "spine2" | "spine3" => yaw(0.045 * lead) * tip(0.25 * self.lean),
            // The head is kept where the trunk would turn it away.
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
