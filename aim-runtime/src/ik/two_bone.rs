//! Closed-form inverse kinematics of two bones: shoulder, elbow, hand; hip, knee, foot.
//!
//! The middle joint is a hinge. Its flexion alone determines the distance between root and tip. The root then turns the
//! bent limb until the tip points at the target and the middle joint lies on the requested side. Both are rotations, so
//! the bones keep their lengths.

use core::f32::consts::PI;

use glam::{Quat, Vec3, Vec3A};

use crate::math::trig::{atan2, sin_cos};
use crate::math::turn::{FLAT, across, between, normalized, part};
use crate::math::{self, cross, direction, product, turned};

/// Joint positions of two bones in a pose, in one space of the caller's choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    /// Shoulder or hip.
    pub root: Vec3,
    /// Elbow or knee.
    pub middle: Vec3,
    /// Hand or foot.
    pub tip: Vec3,
}

impl Limb {
    /// Returns the sum of both bones' lengths, which is the tip's largest possible distance from the root.
    #[must_use]
    pub fn length(&self) -> f32 {
        let [upper, lower] = self.bones();
        math::length(upper) + math::length(lower)
    }

    fn bones(&self) -> [Vec3A; 2] {
        let [root, middle, tip] = [self.root, self.middle, self.tip].map(Vec3A::from);
        [middle - root, tip - middle]
    }
}

/// Rule for the plane in which the limb bends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Bend {
    /// The animated plane, rotated by the shortest turn from the direction to the animated tip to the direction to the
    /// target.
    #[default]
    AsAnimated,
    /// The plane in which the middle joint lies on the side of this point, in the space of the limb. If the point is on
    /// the line from the root to the target, as [`AsAnimated`](Self::AsAnimated).
    Pole(Vec3),
}

/// Axis of the middle joint, and its range of flexion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Axis about which a turn of the lower bone by the right-hand rule flexes, in the animated pose, in the space of
    /// the limb, of any length. Only the component orthogonal to the line from the root to the animated tip is used; if
    /// it is zero, the normal of the animated bend takes its place.
    pub axis: Vec3,
    /// Smallest flexion, radians; 0 if the bones are in line. Negative values count as 0, so that no knee bends
    /// backwards.
    pub least_rad: f32,
    /// Largest flexion, radians; at most π.
    pub most_rad: f32,
}

/// Solver for a limb of two bones.
///
/// ```
/// use aim_runtime::glam::Vec3;
/// use aim_runtime::ik::{Limb, TwoBone, TwoBoneStatus};
///
/// let arm = Limb { root: Vec3::ZERO, middle: Vec3::new(0.3, 0.0, -0.05), tip: Vec3::new(0.55, 0.0, 0.0) };
/// let outcome = TwoBone::new().solve(&arm, Vec3::new(0.2, 0.3, 0.1));
/// assert_eq!(outcome.status, TwoBoneStatus::Reached);
/// // The world rotations of upper arm and forearm become `outcome.upper * upper` and `outcome.lower * lower`.
/// assert!(outcome.limb.tip.distance(Vec3::new(0.2, 0.3, 0.1)) < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TwoBone {
    /// Rule for the plane in which the limb bends. Default [`Bend::AsAnimated`].
    pub bend: Bend,
    /// Axis and range of the middle joint. `None`: it flexes about the normal of the animated bend, by 0…π. Default
    /// `None`.
    pub hinge: Option<Hinge>,
    /// Fraction of the limb's length from which the limb straightens softly instead of snapping straight, 0…1. With 1
    /// (the default), every target within reach is met exactly.
    pub soften: f32,
    /// Rotation of the bend plane about the line from root to target, radians. Default 0.
    pub twist_rad: f32,
    /// Fraction of both turns that is applied, 0…1. Values outside are clamped, NaN counts as 0. Default 1.
    pub weight: f32,
}

impl Default for TwoBone {
    fn default() -> Self {
        Self::new()
    }
}

/// Result of [`TwoBone::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBoneOutcome {
    /// Rotation to apply before the upper bone's rotation in the space of the limb: `upper * animated`. Unit and
    /// finite.
    pub upper: Quat,
    /// Rotation to apply before the lower bone's rotation in the space of the limb: `lower * animated`. Unit and
    /// finite.
    pub lower: Quat,
    /// Resulting joint positions, by forward kinematics.
    pub limb: Limb,
    /// Distance of the resulting tip from the target.
    pub error: f32,
    /// `Reached` if the target is met, otherwise the reason why not.
    pub status: TwoBoneStatus,
}

/// Status of a [`TwoBone`] solution: success, or the reason why the limb misses its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TwoBoneStatus {
    /// The tip is on the target to within 1e-5 of the limb's length.
    Reached,
    /// The target is further away than the limb is long: the limb is stretched towards it.
    TooFar,
    /// The target is nearer than the difference of the bones' lengths: the limb is folded.
    TooNear,
    /// The hinge's range ends before the tip reaches the target.
    AtHinge,
    /// Softening, or a weight below 1, left part of the distance.
    Partial,
    /// An input is not finite, or the limb has no length. Nothing is moved.
    Degenerate,
}

/// Distance up to which the target counts as met, as a fraction of the limb's length.
const MET: f32 = 1e-5;

impl TwoBone {
    /// Creates a solver that bends in the animated plane, without limits, softening or twist, at full weight.
    #[must_use]
    pub const fn new() -> Self {
        Self { bend: Bend::AsAnimated, hinge: None, soften: 1.0, twist_rad: 0.0, weight: 1.0 }
    }

    /// Sets the [bend](Self::bend) to a pole: a point in the space of the limb, on whose side the middle joint lies.
    #[must_use]
    pub const fn with_pole(mut self, pole: Vec3) -> Self {
        self.bend = Bend::Pole(pole);
        self
    }

    /// Sets axis and range of the [middle joint](Self::hinge).
    #[must_use]
    pub const fn with_hinge(mut self, hinge: Hinge) -> Self {
        self.hinge = Some(hinge);
        self
    }

    /// Sets the fraction of the limb's length from which the limb [straightens softly](Self::soften), 0…1.
    #[must_use]
    pub const fn with_softening(mut self, soften: f32) -> Self {
        self.soften = soften;
        self
    }

    /// Sets the [rotation of the bend plane](Self::twist_rad), radians.
    #[must_use]
    pub const fn with_twist(mut self, twist_rad: f32) -> Self {
        self.twist_rad = twist_rad;
        self
    }

    /// Sets the [`weight`](Self::weight), 0…1.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// Returns the turns that bring the tip of the animated `limb` to `target`, or as near as the limb reaches.
    ///
    /// All arguments are in one space. For every input the rotations are finite and unit. If an input is not finite or
    /// the limb has no length, nothing is moved ([`TwoBoneStatus::Degenerate`]).
    #[must_use]
    pub fn solve(&self, limb: &Limb, target: Vec3) -> TwoBoneOutcome {
        let unmoved = TwoBoneOutcome {
            upper: Quat::IDENTITY,
            lower: Quat::IDENTITY,
            limb: *limb,
            error: math::length(Vec3A::from(target - limb.tip)),
            status: TwoBoneStatus::Degenerate,
        };
        let scale = limb.length();
        // The negation also catches NaN.
        if !(scale > 0.0 && scale.is_finite() && limb.root.is_finite() && target.is_finite()) {
            return unmoved;
        }
        // From here on the root is the origin and the limb's length is 1.
        let bones = limb.bones().map(|bone| bone / scale);
        let to_target = Vec3A::from(target - limb.root) / scale;
        if !(bones[0].is_finite() && bones[1].is_finite() && to_target.is_finite()) {
            return unmoved;
        }
        let (upper, lower, cause) = self.turns(bones, to_target, |point| Vec3A::from(point - limb.root) / scale);

        let root = Vec3A::from(limb.root);
        let middle = root + turned(upper, bones[0]) * scale;
        let tip = middle + turned(lower, bones[1]) * scale;
        let error = math::length(Vec3A::from(target) - tip);
        let status = if error <= MET * scale { TwoBoneStatus::Reached } else { cause };
        let limb = Limb { root: limb.root, middle: middle.into(), tip: tip.into() };
        TwoBoneOutcome { upper, lower, limb, error, status }
    }

    /// Returns the turns of both bones, and the status to report if the target is not met.
    fn turns(
        &self,
        [upper, lower]: [Vec3A; 2],
        target: Vec3A,
        relative: impl Fn(Vec3) -> Vec3A,
    ) -> (Quat, Quat, TwoBoneStatus) {
        let animated = direction(upper + lower).or_else(|| direction(upper)).unwrap_or(Vec3A::X);
        let axis = self.axis([upper, lower], animated, &relative);
        let (flex, cause) = self.flexion([upper, lower], axis, math::length(target));
        let tip = upper + turned(flex, lower);

        // Frame of the bent limb: towards the tip, and orthogonal to that towards the middle joint.
        let from = direction(tip).unwrap_or(animated);
        let from_side = side(from, axis);
        let to = direction(target).unwrap_or(from);
        let to_side = match self.bend {
            Bend::Pole(pole) => across(relative(pole), to),
            Bend::AsAnimated => None,
        };
        let to_side = to_side.unwrap_or_else(|| carried(side(animated, axis), animated, to));
        let (sin, cos) = sin_cos(if self.twist_rad.is_finite() { self.twist_rad } else { 0.0 });
        let to_side = to_side * cos + cross(to, to_side) * sin;
        let root = between([from, from_side], [to, to_side]);

        let weight = self.weight.max(0.0).min(1.0);
        if weight < 1.0 {
            let root = part(root, weight);
            return (root, normalized(product(root, part(flex, weight))), TwoBoneStatus::Partial);
        }
        (root, normalized(product(root, flex)), cause)
    }

    /// Returns the axis about which the middle joint flexes: the hinge's, otherwise the normal of the animated bend.
    /// For a straight limb, the axis that bends it towards the pole, otherwise any axis orthogonal to the limb.
    fn axis(&self, [upper, lower]: [Vec3A; 2], along: Vec3A, relative: &impl Fn(Vec3) -> Vec3A) -> Vec3A {
        let hinge = self.hinge.and_then(|hinge| across(hinge.axis.into(), along));
        let bent = || {
            let (upper, lower) = (direction(upper)?, direction(lower)?);
            let normal = cross(upper, lower);
            (normal.length() > FLAT).then(|| direction(normal)).flatten()
        };
        let towards_pole = || match self.bend {
            Bend::Pole(pole) => across(relative(pole), along).map(|side| cross(side, along)),
            Bend::AsAnimated => None,
        };
        hinge.or_else(bent).or_else(towards_pole).unwrap_or_else(|| along.any_orthonormal_vector())
    }

    /// Returns the turn of the lower bone about `axis` that brings the tip to this distance from the root, and the
    /// status to report if the target is not met.
    ///
    /// With the bones' components along the axis (`z`, their sum) and orthogonal to it (`u`, `l`), a flexion `f` puts
    /// the tip at `d² = z² + u² + l² + 2 u l cos f`. The half angle keeps full precision near both ends of the range:
    /// `4 u l cos²(f/2) = d² − z² − (u − l)²`, `4 u l sin²(f/2) = (u + l)² − (d² − z²)`.
    fn flexion(&self, [upper, lower]: [Vec3A; 2], axis: Vec3A, distance: f32) -> (Quat, TwoBoneStatus) {
        let along = (upper + lower).dot(axis);
        let [flat_upper, flat_lower] = [upper, lower].map(|bone| bone - axis * bone.dot(axis));
        let [u, l] = [flat_upper, flat_lower].map(math::length);
        let both = 4.0 * u * l;
        let wanted = self.softened(distance);
        let in_plane = math::sqrt((wanted - along) * (wanted + along));
        // 4 u l cos²(f/2) and 4 u l sin²(f/2), by (a − b)(a + b).
        let (cos_2, sin_2) = ((in_plane - (u - l)) * (in_plane + (u - l)), (u + l - in_plane) * (u + l + in_plane));
        if !(both > f32::MIN_POSITIVE) {
            // A bone without length or along the axis: flexing has no effect.
            let cause =
                if distance > (upper + lower).length() { TwoBoneStatus::TooFar } else { TwoBoneStatus::TooNear };
            return (Quat::IDENTITY, cause);
        }
        let mut cause = if sin_2 < 0.0 || distance > 1.0 {
            TwoBoneStatus::TooFar
        } else if cos_2 < 0.0 {
            TwoBoneStatus::TooNear
        } else {
            TwoBoneStatus::Partial
        };
        let mut halves = unit(math::sqrt(cos_2), math::sqrt(sin_2));
        let mut half = atan2(halves.1, halves.0);
        if let Some(hinge) = self.hinge {
            let (least, most) = hinge.range();
            if !(half >= 0.5 * least && half <= 0.5 * most) {
                half = half.max(0.5 * least).min(0.5 * most);
                let (sin, cos) = sin_cos(half);
                halves = (cos, sin);
                cause = TwoBoneStatus::AtHinge;
            }
        }
        // Half of the animated flexion, the angle between the bones projected onto the plane of flexion: for unit
        // vectors, cos(f/2) = |u + l| / 2 and sin(f/2) = |u − l| / 2.
        let animated = {
            let (upper, lower) = (flat_upper / u, flat_lower / l);
            let (sum, difference) = ((upper + lower).length(), (upper - lower).length());
            let (cos, sin) = unit(sum, difference);
            if axis.dot(cross(upper, lower)) < 0.0 { (cos, -sin) } else { (cos, sin) }
        };
        // Difference of the half angles, by the addition theorems.
        let cos = halves.0 * animated.0 + halves.1 * animated.1;
        let sin = halves.1 * animated.0 - halves.0 * animated.1;
        let turn = axis * sin;
        (normalized(Quat::from_xyzw(turn.x, turn.y, turn.z, cos)), cause)
    }

    /// Returns the softened distance: beyond the softened fraction of the length it approaches the length without
    /// reaching it.
    fn softened(&self, distance: f32) -> f32 {
        let begin = self.soften.max(0.0).min(1.0);
        let rest = 1.0 - begin;
        if rest > 0.0 && distance > begin {
            let beyond = (distance - begin) / rest;
            begin + rest * (beyond / (1.0 + beyond))
        } else {
            distance.min(1.0)
        }
    }
}

impl Hinge {
    /// Returns the least and most flexion, radians, in order and within 0…π.
    fn range(&self) -> (f32, f32) {
        let least = self.least_rad.max(0.0).min(PI);
        (least, self.most_rad.min(PI).max(least))
    }
}

/// Returns (x, y) scaled to length 1; (1, 0) for a zero vector.
fn unit(x: f32, y: f32) -> (f32, f32) {
    let length = math::sqrt(x * x + y * y);
    if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) }
}

/// Returns the side of `along`, the direction to the tip, on which the middle joint lies if it flexes about `axis`.
fn side(along: Vec3A, axis: Vec3A) -> Vec3A {
    let side = direction(cross(along, axis)).unwrap_or_else(|| along.any_orthonormal_vector());
    direction(side - along * side.dot(along)).unwrap_or(side)
}

/// Returns `v`, which is orthogonal to `from`, rotated by the shortest turn from one unit vector to another: v −
/// (from + to) (v · to) / (1 + from · to).
fn carried(v: Vec3A, from: Vec3A, to: Vec3A) -> Vec3A {
    let along = 1.0 + from.dot(to);
    // For opposite vectors, the half turn about `v` leaves `v` unchanged.
    let carried = if along > FLAT * FLAT { v - (from + to) * (v.dot(to) / along) } else { v };
    across(carried, to).unwrap_or_else(|| to.any_orthonormal_vector())
}
