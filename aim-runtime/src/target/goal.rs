//! [`Goal`]: what a call turns to, after the weight and the policy for targets behind.

use glam::Vec3A;

use crate::kinematics::bearing::Bearings;
use crate::kinematics::chain::{Ray, Space};
use crate::limits::RangeOfMotion;
use crate::math::trig;
use crate::rig::{Memory, Side};
use crate::target::behind::{Front, Span};
use crate::{Behind, Description, Settings, math};

/// What a call turns to, in solver space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// The target, or the point on the arc from the animated gaze to it: what the outcome is measured against.
    pub(crate) wanted: Vec3A,
    /// What the joints are turned to: `wanted`, or what the policy for targets behind makes of it.
    pub(crate) aimed: Vec3A,
    /// What the joints do about it.
    pub(crate) course: Course,
    /// Whether the policy for targets behind is active.
    pub(crate) behind: bool,
    /// The side the target counts as being on.
    pub(crate) side: Side,
}

/// What the joints do in a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Course {
    /// They turn to [`Goal::aimed`].
    Aim,
    /// They stay as they are, but for those outside their ranges.
    Stay,
    /// They return to the animation.
    Rest,
}

/// What a goal is seen from: an animated pose.
pub(crate) struct Scene<'a> {
    pub(crate) space: Space,
    /// The animated effector.
    pub(crate) gaze: Ray,
    pub(crate) front: Front,
    pub(crate) rig: &'a Description<'a>,
    /// The joint that is aimed, and all joints' ranges.
    pub(crate) first: usize,
    pub(crate) motions: &'a [RangeOfMotion],
    /// Where weights and budgets count by heading and elevation, and not along arcs.
    pub(crate) bearings: Option<&'a Bearings>,
    /// Whether two eyes converge on the goal.
    pub(crate) has_two_eyes: bool,
}

impl Scene<'_> {
    /// How far the joints that have a part turn together.
    #[cold]
    fn span(&self) -> Span {
        let motions = &self.motions[self.first..];
        match self.bearings {
            Some(_) => Span::of_budgets(self.rig, &self.rig.joints[self.first..], motions),
            None => Span::of_ranges(motions),
        }
    }
}

impl Goal {
    /// The goal for a target of the pose's space; `before` remembers where it was seen. A weight takes its part of the way, and
    /// 0 is the animation, whatever the target. `None` where the target is not finite.
    #[inline(always)]
    pub(crate) fn new(scene: &Scene<'_>, target_ps: Vec3A, settings: &Settings, before: &Memory) -> Option<Self> {
        let weight = settings.effective_weight();
        let goal = if weight == 0.0 {
            Self::animation(scene.gaze, before)
        } else {
            Self::for_target(scene, scene.space.to_solver(target_ps)?, settings, before)
        };
        Some(if scene.has_two_eyes && weight < 1.0 { goal.receding(scene.gaze, weight) } else { goal })
    }

    #[inline(always)]
    fn for_target(scene: &Scene<'_>, target: Vec3A, settings: &Settings, before: &Memory) -> Self {
        let &Scene { gaze, ref front, bearings, .. } = scene;
        let side = front.side(target, before.side);
        let weight = settings.effective_weight();
        let wanted = match bearings {
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
        let behind = match settings.behind {
            Behind::Off => false,
            Behind::Plane => front.is_off_plane(wanted),
            Behind::Clip | Behind::Hold | Behind::Release => front.is_behind(wanted, before.behind),
        };
        let behind = behind && front.is_guarded(&scene.span());
        let (course, aimed) = match settings.behind {
            Behind::Hold if behind => (Course::Stay, wanted),
            Behind::Release if behind => (Course::Rest, wanted),
            Behind::Clip if behind => (Course::Aim, front.clip(wanted, side)),
            Behind::Plane if behind => (Course::Aim, front.clip_to_plane(wanted)),
            _ => (Course::Aim, wanted),
        };
        Self { wanted, aimed, course, behind, side }
    }

    /// The goal of weight 0: the animated gaze itself.
    fn animation(gaze: Ray, before: &Memory) -> Self {
        // Far enough that no correction brings the effector near it.
        let ahead = gaze.origin + math::direction(gaze.direction).unwrap_or(Vec3A::X) * 1e3;
        Self { wanted: ahead, aimed: ahead, course: Course::Rest, behind: false, side: before.side }
    }

    /// The same directions further away by as much as the weight is below 1, so that two eyes converge by that much less.
    fn receding(self, gaze: Ray, weight: f32) -> Self {
        let origin = gaze.origin;
        let further = 1.0 / weight.max(1e-3);
        let recede = |point: Vec3A| origin + (point - origin) * further;
        Self { wanted: recede(self.wanted), aimed: recede(self.aimed), ..self }
    }
}

/// The point `weight` of the way along the arc about the effector from the animated gaze to the target.
fn part_way(front: &Front, gaze: Ray, target: Vec3A, weight: f32, side: Side) -> Vec3A {
    let to_target = target - gaze.origin;
    let (Some(from), Some(to)) = (math::direction(gaze.direction), math::direction(to_target)) else {
        return target;
    };
    let angle = math::angle_between(from, to);
    // The arc's direction at its start; opposite directions have every arc, and the remembered side picks one.
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
