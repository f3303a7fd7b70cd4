//! [`Target`]: one of several weighted targets, and blending them into one point.
//!
//! Sums are accumulated in integers, so that the result does not depend on the order of the targets, bit for bit.

use glam::{Vec3, Vec3A};

use crate::kinematics::chain::leading_eye;
use crate::rig::PoseSlices;
use crate::{Description, math};

/// Relative length below which a sum of directions counts as cancelled and has no direction.
const CANCELLED: f32 = 1e-3;

/// One of several weighted targets.
///
/// ```
/// use aim_runtime::Target;
/// use aim_runtime::glam::Vec3;
///
/// // Mostly at a face, now and then at the hands: weights may change every frame.
/// let targets = [Target::new(Vec3::new(0.0, 1.7, 2.0), 0.8), Target::new(Vec3::new(0.2, 1.1, 1.5), 0.2)];
/// assert_eq!(targets[1].weight, 0.2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Target {
    /// Position in the pose's space. A target that is not finite is ignored.
    pub point: Vec3,
    /// Share of the gaze. Only ratios matter if the weights add up to 1 or more; below 1, the animation keeps the
    /// remainder. NaN and negative weights count as 0.
    pub weight: f32,
}

impl Target {
    /// Creates a target with this weight.
    #[must_use]
    pub const fn new(point: Vec3, weight: f32) -> Self {
        Self { point, weight }
    }

    /// Returns the weight clamped to 0…1e30; 0 for a target that is ignored.
    fn effective_weight(&self) -> f32 {
        if self.point.is_finite() { self.weight.max(0.0).min(1e30) } else { 0.0 }
    }
}

/// Blends several targets of joint `effector` into one point and the weight to aim there with, 0…1.
pub(crate) fn blended(
    rig: &Description<'_>,
    pose: &PoseSlices<'_>,
    targets: &[Target],
    effector: usize,
) -> (Vec3, f32) {
    blend(animated_effector(rig, pose, effector), targets)
}

/// Returns the animated position of the effector; not finite if the pose is not.
fn animated_effector(rig: &Description<'_>, pose: &PoseSlices<'_>, effector: usize) -> Vec3A {
    let index = effector.min(rig.joints.len().saturating_sub(1));
    let joint = if index == 0 { leading_eye(rig, pose) } else { pose.joints.get(index).copied() };
    let origin = if index == 0 { rig.effector.origin.into() } else { Vec3A::ZERO };
    joint.map_or(Vec3A::NAN, |joint| joint.transform_point3a(origin))
}

/// An integer sum of terms between −1 and 1, in units of 2⁻⁴⁰.
#[derive(Clone, Copy, Default)]
struct Sum(i64);

impl Sum {
    const UNIT: f64 = (1_u64 << 40) as f64;

    #[expect(clippy::cast_possible_truncation, reason = "rounding to the unit is meant; NaN is 0")]
    fn add(&mut self, term: f32) {
        self.0 = self.0.saturating_add((f64::from(term) * Self::UNIT) as i64);
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "rounding to f32 is meant")]
    fn value(self) -> f32 {
        (self.0 as f64 / Self::UNIT) as f32
    }
}

/// Blends targets as seen from `origin` into one point. Returns it with the sum of the weights, at most 1.
///
/// The direction is that of the weighted sum of directions; the reciprocal of the distance is the weighted mean of the
/// targets' reciprocal distances. If the directions cancel, the point is the heaviest target, the first of equals. A
/// target at the origin has no direction and is left out unless there is no other.
fn blend(origin: Vec3A, targets: &[Target]) -> (Vec3, f32) {
    let counted =
        || targets.iter().map(|target| (target, target.effective_weight())).filter(|&(_, weight)| weight > 0.0);
    let Some((heaviest, most)) =
        counted().reduce(|best, next| if next.1 > best.1 { next } else { best }).filter(|_| origin.is_finite())
    else {
        // Either there is no target, or the pose is not finite.
        return counted().next().map_or((Vec3::ZERO, 0.0), |(target, weight)| (target.point, weight.min(1.0)));
    };
    let mut total = Sum::default();
    counted().for_each(|(_, weight)| total.add(weight / most));
    let total = (total.value() * most).min(1.0);

    let blended_from_origin = || {
        counted().filter_map(|(target, weight)| {
            let to_target = Vec3A::from(target.point) - origin;
            Some((math::direction(to_target)?, math::length(to_target), weight / most))
        })
    };
    let nearest = blended_from_origin().fold(f32::INFINITY, |nearest, (_, distance, _)| nearest.min(distance));
    let (mut direction, mut nearness, mut share) = ([Sum::default(); 3], Sum::default(), Sum::default());
    for (toward, distance, weight) in blended_from_origin() {
        for (sum, along) in direction.iter_mut().zip(toward.to_array()) {
            sum.add(weight * along);
        }
        nearness.add(weight * (nearest / distance));
        share.add(weight);
    }
    let (direction, nearness, share) = (Vec3A::from(direction.map(Sum::value)), nearness.value(), share.value());
    if counted().count() == 1 || !(direction.length() > CANCELLED * share) {
        return (heaviest.point, total);
    }
    let distance = (nearest * share / nearness).min(0.25 * f32::MAX);
    let toward = math::direction(direction).unwrap_or(direction);
    ((origin + toward * distance).into(), total)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: Target = Target::new(Vec3::new(0.0, 0.0, -2.0), 0.5);
    const LEFT: Target = Target::new(Vec3::new(-2.0, 0.0, 0.0), 0.5);

    fn blended_from_origin(targets: &[Target]) -> (Vec3, f32) {
        blend(Vec3A::ZERO, targets)
    }

    #[test]
    fn two_targets_give_a_point_between_them() {
        let (point, total) = blended_from_origin(&[AHEAD, LEFT]);
        assert!(point.abs_diff_eq(Vec3::new(-1.0, 0.0, -1.0) * 2.0_f32.sqrt(), 1e-6), "{point}");
        assert_eq!(total, 1.0);
        // The mean of 1/d: for 1 m and 3 m the distance is 1.5 m.
        let (point, _) = blended_from_origin(&[Target::new(Vec3::X, 1.0), Target::new(3.0 * Vec3::X, 1.0)]);
        assert!(point.abs_diff_eq(1.5 * Vec3::X, 1e-6), "{point}");
    }

    #[test]
    fn invalid_and_weightless_targets_are_ignored() {
        for left_out in [
            Target::new(Vec3::NAN, 1.0),
            Target::new(Vec3::INFINITY, 1.0),
            Target::new(Vec3::Y, 0.0),
            Target::new(Vec3::Y, -1.0),
            Target::new(Vec3::Y, f32::NAN),
        ] {
            assert_eq!(blended_from_origin(&[left_out, AHEAD]), blended_from_origin(&[AHEAD]));
            assert_eq!(blended_from_origin(&[left_out]).1, 0.0);
        }
        assert_eq!(blended_from_origin(&[]).1, 0.0);
        assert_eq!(blended_from_origin(&[AHEAD]), (AHEAD.point, 0.5));
    }

    #[test]
    fn of_opposite_targets_the_heavier_wins() {
        let behind = Target::new(-AHEAD.point, 0.5);
        assert_eq!(blended_from_origin(&[AHEAD, behind]).0, AHEAD.point);
        assert_eq!(blended_from_origin(&[behind, AHEAD]).0, behind.point);
        let heavier = Target { weight: 0.500_01, ..behind };
        assert_eq!(blended_from_origin(&[AHEAD, heavier]).0, behind.point);
        assert_eq!(
            blended_from_origin(&[Target::new(Vec3::ZERO, 1.0), AHEAD, LEFT]).0,
            blended_from_origin(&[AHEAD, LEFT]).0
        );
    }

    #[test]
    fn extremes_are_finite() {
        let awkward = [1e-42, 1e-20, 1.0, 1e20, f32::MAX, f32::INFINITY, f32::NAN, -1.0];
        for x in awkward {
            for weight in awkward {
                for y in awkward {
                    let targets = [Target::new(Vec3::new(x, 0.0, y), weight), Target::new(Vec3::Y * y, x), AHEAD];
                    let (point, total) = blended_from_origin(&targets);
                    assert!(point.is_finite() && (0.0..=1.0).contains(&total), "{targets:?}: {point} {total}");
                }
            }
        }
    }
}
