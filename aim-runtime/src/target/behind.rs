//! Whether a target is behind the character, and on which side it counts as being.
//!
//! A target passing behind a chain that cannot follow it would otherwise throw the chain from one end of its range to
//! the other and back with every tremble. Both answers look only at the animated pose and the target, never at the
//! corrections, so they cannot feed back into themselves; and both remember, so that a tremble changes neither.

use core::f32::consts::PI;

use glam::{Mat3A, Vec3A};

use crate::kinematics::chain::Ray;
use crate::limits::RangeOfMotion;
use crate::math;
use crate::math::trig;
use crate::rig::Side;
use crate::{Description, JointInfo, Role};

/// From this angle off the innermost joint's animated forward a target is behind.
const BEHIND_RAD: f32 = 150.0 * PI / 180.0;
/// The cosine of what is left of half a turn.
const COS_BACK: f32 = 0.866_025_4;
/// The same once a target is behind, 10° further out: one that trembles at the edge does not switch a policy on and off.
const COS_STILL_BACK: f32 = 0.766_044_4;
/// The cosine of how far to the side, 80°, the plane in front of the character lets a target be.
const COS_PLANE: f32 = 0.173_648_18;
/// The sine and cosine of how far a target has to pass the middle of the back before it counts as on the other side.
const HELD: (f32, f32) = (0.173_648_18, 0.984_807_7);

/// How far joints turn together, radians: headings right and left, pitches down and up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    heading: [f32; 2],
    /// `None` where no pitch leads over the head: a natural gaze turns round by its heading.
    pitch: Option<[f32; 2]>,
}

impl Span {
    /// That of joints with these ranges.
    pub(crate) fn of_ranges(motions: &[RangeOfMotion]) -> Self {
        let sum = |ends: fn(&RangeOfMotion) -> [f32; 2]| {
            motions.iter().map(ends).fold([0.0; 2], |[lo, hi], own| [lo + own[0], hi + own[1]])
        };
        Self { heading: sum(|motion| motion.heading.ends()), pitch: Some(sum(|motion| motion.pitch.ends())) }
    }

    /// That of joints with these ranges, of parts of the body that have budgets.
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

/// The character's front as the animation has it: the innermost joint's axes, seen from the effector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Front {
    origin: Vec3A,
    pub(crate) forward: Vec3A,
    pub(crate) left: Vec3A,
    pub(crate) up: Vec3A,
    gaze: Vec3A,
}

impl Front {
    /// The front of a chain whose animated effector is `gaze`, and whose innermost joint has its forward, left and up as these
    /// columns, in solver space.
    pub(crate) fn new(innermost: &Mat3A, gaze: Ray) -> Self {
        let Mat3A { x_axis: forward, y_axis: left, z_axis: up } = *innermost;
        Self { origin: gaze.origin, forward, left, up, gaze: gaze.direction }
    }

    /// Whether targets behind are out of reach of joints that turn so far together, so that the policy applies.
    pub(crate) fn is_guarded(&self, span: &Span) -> bool {
        let gaze_rad = trig::atan2(self.gaze.dot(self.left), self.gaze.dot(self.forward));
        let [right_rad, left_rad] = span.heading;
        let around = left_rad + gaze_rad >= BEHIND_RAD || right_rad + gaze_rad <= -BEHIND_RAD;
        let over = span.pitch.is_some_and(|[down_rad, up_rad]| up_rad >= 0.5 * PI || down_rad <= -0.5 * PI);
        !(around || over)
    }

    /// A point as its distance and its unit direction along forward, left, up.
    fn look(&self, target: Vec3A) -> Option<(f32, [f32; 3])> {
        let to_target = target - self.origin;
        let toward = math::direction(to_target)?;
        let look = [toward.dot(self.forward), toward.dot(self.left), toward.dot(self.up)];
        Some((to_target.length(), look))
    }

    fn point(&self, distance: f32, [forward, left, up]: [f32; 3]) -> Vec3A {
        self.origin + (self.forward * forward + self.left * left + self.up * up) * distance
    }

    /// The side that `target` is on: the one it was on before while it is near the middle of the back.
    pub(crate) fn side(&self, target: Vec3A, before: Side) -> Side {
        let to_target = target - self.origin;
        let (forward, left) = (to_target.dot(self.forward), to_target.dot(self.left));
        let (sin, cos) = HELD;
        let middle = forward < 0.0 && left.abs() * cos <= -forward * sin;
        if before != Side::Unseen && (middle || left == 0.0) { before } else { Side::of_coordinate(left) }
    }

    /// `target` where it is on `side`; just on that side of the middle where it is held there against its position.
    pub(crate) fn on_side(&self, target: Vec3A, side: Side) -> Vec3A {
        match self.look(target) {
            Some((distance, [forward, left, up])) if forward < 0.0 && left * side.sign() <= 0.0 => {
                self.point(distance, [forward, 1e-3 * side.sign(), up])
            }
            _ => target,
        }
    }

    /// Whether `target` is behind; `before` is whether it was so far.
    pub(crate) fn is_behind(&self, target: Vec3A, before: bool) -> bool {
        let edge = if before { COS_STILL_BACK } else { COS_BACK };
        self.look(target).is_some_and(|(_, [forward, ..])| forward < -edge)
    }

    /// `target` brought to the edge of the cone behind the character, at its own height; itself where it is not in the
    /// cone.
    pub(crate) fn clip(&self, target: Vec3A, side: Side) -> Vec3A {
        match self.look(target) {
            Some((distance, [forward, _, up])) if forward < -COS_BACK => {
                let left = side.sign() * math::sqrt(1.0 - COS_BACK * COS_BACK - up * up);
                self.point(distance, [-COS_BACK, left, up])
            }
            _ => target,
        }
    }

    /// Whether `target` is off the plane in front.
    pub(crate) fn is_off_plane(&self, target: Vec3A) -> bool {
        self.look(target).is_some_and(|(_, look)| look[0] < COS_PLANE * level(look))
    }

    /// `target` moved along forward to the plane in front, its distance and elevation kept; itself where it is in front of the
    /// plane, or straight above or below.
    pub(crate) fn clip_to_plane(&self, target: Vec3A) -> Vec3A {
        let Some((distance, look)) = self.look(target) else { return target };
        let ([forward, left, up], level) = (look, level(look));
        let forward = forward.max(COS_PLANE * level);
        let stretch = level / math::sqrt(forward * forward + left * left);
        if stretch.is_finite() { self.point(distance, [stretch * forward, stretch * left, up]) } else { target }
    }
}

/// The length of a direction's part across up.
fn level([forward, left, _]: [f32; 3]) -> f32 {
    math::sqrt(forward * forward + left * left)
}
