//! [`Goal`]: the point that a call turns to, after the weight and the policy for targets behind.

use glam::Vec3A;

use crate::kinematics::bearing::Bearings;
use crate::kinematics::chain::{Ray, Space};
use crate::limits::RangeOfMotion;
use crate::math::trig;
use crate::rig::{Memory, Side};
use crate::target::behind::{Front, Span};
use crate::{Behind, Description, Settings, math};

/// The goal of a call, in solver space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// The point that the outcome is measured against: the target, or at a weight below 1 a point on the way from the
    /// animated gaze to it.
    pub(crate) measured_point: Vec3A,
    /// The point that the joints turn to: `measured_point`, or its replacement by the policy for targets behind.
    pub(crate) aim_point: Vec3A,
    /// The movement of the joints in this call.
    pub(crate) movement: Movement,
    /// `true` if the policy for targets behind is active.
    pub(crate) behind: bool,
    /// The side on which the target counts as being, with hysteresis.
    pub(crate) side: Side,
}

/// The movement of the joints in a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Movement {
    /// The joints turn to [`Goal::aim_point`].
    Aim,
    /// The joints keep their angles, except those outside their ranges.
    Stay,
    /// The joints return to the animation.
    Rest,
}

/// The part of the memory of the last target on which a goal depends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) side: Side,
    pub(crate) behind: bool,
}

impl Seen {
    /// Returns what a call considers. A snap keeps only the side: it should depend on the past as little as possible.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn of(memory: &Memory, is_frame: bool) -> Self {
        Self { side: memory.side, behind: memory.behind && is_frame }
    }
}

/// The animated pose from which a target is seen, and the rig's limits.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) space: Space,
    /// The animated effector.
    pub(crate) gaze: Ray,
    pub(crate) front: Front,
    pub(crate) rig: &'a Description<'a>,
    /// Index of the joint that is aimed.
    pub(crate) first: usize,
    /// All joints' ranges of motion.
    pub(crate) motions: &'a [RangeOfMotion],
    /// `Some` for a natural gaze: weights and budgets then apply to heading and elevation instead of arcs.
    pub(crate) bearings: Option<&'a Bearings>,
    /// `true` if two eyes converge on the goal.
    pub(crate) has_two_eyes: bool,
}

impl Scene<'_> {
    /// Returns the total turn that the joints from `first` inward allow.
    #[inline(always)]
    fn span(&self) -> Span {
        let motions = &self.motions[self.first..];
        match self.bearings {
            Some(_) => Span::of_budgets(self.rig, &self.rig.joints[self.first..], motions),
            None => Span::of_ranges(motions),
        }
    }
}

impl Goal {
    /// Creates the goal for a target in the pose's space. `before` is what is remembered of the last target. The weight
    /// scales the way from the animated gaze to the target; at weight 0 the goal is the animation, whatever the target.
    /// `None` if the target is not finite.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn new(scene: &Scene<'_>, target_ps: Vec3A, settings: &Settings, before: Seen) -> Option<Self> {
        let weight = settings.effective_weight();
        let mut goal = if weight == 0.0 {
            Self::animation(scene.gaze, before.side)
        } else {
            Self::for_target(scene, scene.space.to_solver(target_ps)?, settings, before)
        };
        if scene.has_two_eyes && weight < 1.0 {
            goal = goal.receding(scene.gaze, weight);
        }
        Some(goal)
    }

    #[cfg_attr(not(aim_small), inline(always))]
    fn for_target(scene: &Scene<'_>, target: Vec3A, settings: &Settings, before: Seen) -> Self {
        let &Scene { gaze, ref front, bearings, .. } = scene;
        let side = front.side(target, before.side);
        let weight = settings.effective_weight();
        let measured_point = match bearings {
            _ if weight >= 1.0 => target,
            Some(bearings) => {
                let to_target = target - gaze.origin;
                match (math::direction(gaze.direction), math::direction(to_target)) {
                    (Some(from), Some(to)) => {
                        gaze.origin + bearings.part_way([from, to], weight, side) * math::length(to_target)
                    }
                    _ => target,
                }
            }
            None => part_way(front, gaze, front.on_side(target, side), weight, side),
        };
        let is_seen_behind = || match settings.behind {
            Behind::Plane => front.is_off_plane(measured_point),
            _ => front.is_behind(measured_point, before.behind),
        };
        let behind = settings.behind != Behind::Off && is_seen_behind() && front.is_guarded(&scene.span());
        let (movement, aim_point) = match settings.behind {
            Behind::Hold if behind => (Movement::Stay, measured_point),
            Behind::Release if behind => (Movement::Rest, measured_point),
            Behind::Clip if behind => (Movement::Aim, front.clip(measured_point, side)),
            Behind::Plane if behind => (Movement::Aim, front.clip_to_plane(measured_point)),
            _ => (Movement::Aim, measured_point),
        };
        Self { measured_point, aim_point, movement, behind, side }
    }

    /// Returns the goal for weight 0: the animated gaze itself.
    #[cfg_attr(not(aim_small), inline(always))]
    fn animation(gaze: Ray, side: Side) -> Self {
        // Far enough away that no correction brings the effector near it.
        let ahead = gaze.origin + math::direction(gaze.direction).unwrap_or(Vec3A::X) * 1e3;
        Self { measured_point: ahead, aim_point: ahead, movement: Movement::Rest, behind: false, side }
    }

    /// Moves the goal's points away from the effector by the reciprocal of the weight, so that two eyes converge
    /// proportionally less.
    #[cfg_attr(not(aim_small), inline(always))]
    fn receding(self, gaze: Ray, weight: f32) -> Self {
        let origin = gaze.origin;
        let further = 1.0 / weight.max(1e-3);
        let recede = |point: Vec3A| origin + (point - origin) * further;
        Self { measured_point: recede(self.measured_point), aim_point: recede(self.aim_point), ..self }
    }
}

/// Returns the point `weight` of the way along the arc about the effector from the animated gaze to the target.
fn part_way(front: &Front, gaze: Ray, target: Vec3A, weight: f32, side: Side) -> Vec3A {
    let to_target = target - gaze.origin;
    let (Some(from), Some(to)) = (math::direction(gaze.direction), math::direction(to_target)) else {
        return target;
    };
    let angle = math::angle_between(from, to);
    // The direction of the arc at its start. Between opposite directions every arc is shortest; the remembered side
    // picks one.
    let square_to_gaze = |v: Vec3A| math::direction(v - from * from.dot(v));
    let lateral = to - from * from.dot(to);
    let start = if lateral.length() > 1e-5 {
        square_to_gaze(lateral)
    } else if angle < 1.0 {
        None
    } else {
        square_to_gaze(front.left * side.sign()).or_else(|| square_to_gaze(front.forward))
    };
    let (sin, cos) = trig::sin_cos(weight * angle);
    let toward = start.map_or(from, |start| from * cos + start * sin);
    gaze.origin + toward * to_target.length()
}
