//! Decides whether a target is behind the character, and on which side it is.
//!
//! A target that passes behind a chain that cannot follow it would otherwise throw the chain from one end of its range
//! to the other, and back with every jitter of the target. Both decisions depend only on the animated pose and the
//! target, never on the corrections, which excludes feedback. Both have hysteresis, so that jitter does not toggle
//! them.

use core::f32::consts::PI;

use glam::{Mat3A, Vec3A};

use crate::kinematics::chain::Ray;
use crate::limits::RangeOfMotion;
use crate::math;
use crate::math::trig;
use crate::rig::Side;
use crate::{Description, JointInfo, Role};

/// Angle from the innermost joint's animated forward beyond which a target is behind.
const BEHIND_RAD: f32 = 150.0 * PI / 180.0;
/// cos(π − [`BEHIND_RAD`]): a target is behind if its forward component is below the negative of this.
const COS_BACK: f32 = 0.866_025_4;
/// Counterpart of [`COS_BACK`] for a target that was behind before, 10° wider: hysteresis against toggling the policy.
const COS_STILL_BACK: f32 = 0.766_044_4;
/// Cosine of the largest angle to the side, 80°, at which the plane policy leaves a target unchanged.
const COS_PLANE: f32 = 0.173_648_18;
/// Sine and cosine of the angle by which a target has to pass the middle of the back before it changes sides.
const SIDE_HYSTERESIS_SIN_COS: (f32, f32) = (0.173_648_18, 0.984_807_7);

/// Total turn that several joints allow together, radians: headings right and left, pitches down and up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    heading: [f32; 2],
    /// `None` for a natural gaze, which turns round by its heading and never over the head.
    pitch: Option<[f32; 2]>,
}

impl Span {
    /// Returns the sum of the joints' ranges.
    #[cold]
    #[inline(never)]
    pub(crate) fn of_ranges(motions: &[RangeOfMotion]) -> Self {
        let sum = |ends: fn(&RangeOfMotion) -> [f32; 2]| {
            motions.iter().map(ends).fold([0.0; 2], |[lo, hi], own| [lo + own[0], hi + own[1]])
        };
        Self { heading: sum(|motion| motion.heading.ends()), pitch: Some(sum(|motion| motion.pitch.ends())) }
    }

    /// Returns the sum of the joints' ranges, limited by the budgets of the body parts. Has no pitch.
    #[cold]
    #[inline(never)]
    pub(crate) fn of_budgets(rig: &Description<'_>, infos: &[JointInfo], motions: &[RangeOfMotion]) -> Self {
        let mut heading = [0.0; 2];
        for roles in [&[Role::Head, Role::Neck][..], &[Role::Chest], &[Role::Eye, Role::None]] {
            let own = infos.iter().zip(motions).filter(|(info, _)| roles.contains(&info.role));
            let sum = own.fold([0.0; 2], |[lo, hi], (_, motion)| [lo + motion.heading.lo(), hi + motion.heading.hi()]);
            let [least, most] = rig.budget(roles[0]).heading;
            heading = [heading[0] + sum[0].max(least), heading[1] + sum[1].min(most)];
        }
        Self { heading, pitch: None }
    }
}

/// The character's animated front: the axes of the innermost joint, at the effector's origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Front {
    origin: Vec3A,
    pub(crate) forward: Vec3A,
    pub(crate) left: Vec3A,
    pub(crate) up: Vec3A,
    gaze: Vec3A,
}

impl Front {
    /// Creates the front of a chain with the animated effector `gaze`. The columns of `innermost` are the innermost
    /// joint's forward, left and up in solver space.
    pub(crate) fn new(innermost: &Mat3A, gaze: Ray) -> Self {
        let Mat3A { x_axis: forward, y_axis: left, z_axis: up } = *innermost;
        Self { origin: gaze.origin, forward, left, up, gaze: gaze.direction }
    }

    /// Returns `true` if the policy for targets behind applies: the joints' total turn `span` cannot reach behind the
    /// character, neither round the side nor over the head.
    pub(crate) fn is_guarded(self, span: &Span) -> bool {
        let gaze_rad = trig::atan2(self.gaze.dot(self.left), self.gaze.dot(self.forward));
        let [right_rad, left_rad] = span.heading;
        let around = left_rad + gaze_rad >= BEHIND_RAD || right_rad + gaze_rad <= -BEHIND_RAD;
        let over = span.pitch.is_some_and(|[down_rad, up_rad]| up_rad >= 0.5 * PI || down_rad <= -0.5 * PI);
        !(around || over)
    }

    /// Returns the distance of a point and its unit direction along forward, left, up; `None` if it has no direction.
    fn distance_and_direction(self, target: Vec3A) -> Option<(f32, [f32; 3])> {
        let to_target = target - self.origin;
        let toward = math::direction(to_target)?;
        let direction = [toward.dot(self.forward), toward.dot(self.left), toward.dot(self.up)];
        Some((to_target.length(), direction))
    }

    fn point(self, distance: f32, [forward, left, up]: [f32; 3]) -> Vec3A {
        self.origin + (self.forward * forward + self.left * left + self.up * up) * distance
    }

    /// Returns the side of `target`. Near the middle of the back, keeps the side `before`.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn side(self, target: Vec3A, before: Side) -> Side {
        let to_target = target - self.origin;
        let (forward, left) = (to_target.dot(self.forward), to_target.dot(self.left));
        let (sin, cos) = SIDE_HYSTERESIS_SIN_COS;
        let middle = forward < 0.0 && left.abs() * cos <= -forward * sin;
        if before != Side::Unseen && (middle || left == 0.0) { before } else { Side::of_coordinate(left) }
    }

    /// Returns `target` if it lies on `side` or in front. A target behind that is held on the opposite side is moved
    /// just across the middle.
    pub(crate) fn on_side(self, target: Vec3A, side: Side) -> Vec3A {
        match self.distance_and_direction(target) {
            Some((distance, [forward, left, up])) if forward < 0.0 && left * side.sign() <= 0.0 => {
                self.point(distance, [forward, 1e-3 * side.sign(), up])
            }
            _ => target,
        }
    }

    /// Returns `true` if `target` is behind. `before` tells whether it was behind in the last frame.
    pub(crate) fn is_behind(self, target: Vec3A, before: bool) -> bool {
        let edge = if before { COS_STILL_BACK } else { COS_BACK };
        self.distance_and_direction(target).is_some_and(|(_, [forward, ..])| forward < -edge)
    }

    /// Moves a `target` inside the cone behind the character to the cone's edge on `side`, keeping distance and height.
    /// Returns any other target unchanged.
    pub(crate) fn clip(self, target: Vec3A, side: Side) -> Vec3A {
        match self.distance_and_direction(target) {
            Some((distance, [forward, _, up])) if forward < -COS_BACK => {
                let left = side.sign() * math::sqrt(1.0 - COS_BACK * COS_BACK - up * up);
                self.point(distance, [-COS_BACK, left, up])
            }
            _ => target,
        }
    }

    /// Returns `true` if `target` is not in front of the plane.
    pub(crate) fn is_off_plane(self, target: Vec3A) -> bool {
        self.distance_and_direction(target).is_some_and(|(_, direction)| direction[0] < COS_PLANE * level(direction))
    }

    /// Moves `target` along forward to the plane in front, keeping its distance and elevation. Returns it unchanged if
    /// it is in front of the plane, or straight above or below.
    pub(crate) fn clip_to_plane(self, target: Vec3A) -> Vec3A {
        let Some((distance, direction)) = self.distance_and_direction(target) else { return target };
        let ([forward, left, up], level) = (direction, level(direction));
        let forward = forward.max(COS_PLANE * level);
        let stretch = level / math::sqrt(forward * forward + left * left);
        if stretch.is_finite() { self.point(distance, [stretch * forward, stretch * left, up]) } else { target }
    }
}

/// Returns the length of the level component of a direction, perpendicular to up.
fn level([forward, left, _]: [f32; 3]) -> f32 {
    math::sqrt(forward * forward + left * left)
}
