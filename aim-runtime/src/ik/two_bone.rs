//! Two bones in closed form: shoulder, elbow, hand; hip, knee, foot.
//!
//! The middle joint is a hinge: how far it flexes decides how far the tip is from the root, and nothing else does. The
//! root then turns the bent limb until the tip points at the target and the middle joint lies on the side that was asked
//! for. Both are rotations, so bones keep their lengths.

use core::f32::consts::PI;

use glam::{Quat, Vec3, Vec3A};

use crate::math::trig::{atan2, sin_cos};
use crate::math::turn::{FLAT, across, between, normalized, part};
use crate::math::{self, cross, direction, product, turned};

/// Two bones in a pose: where their joints are, in one space of the caller's choice.
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
    /// The length of both bones together; as far as the tip gets from the root.
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

/// The plane that the limb bends in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Bend {
    /// That of the animation, led along by the shortest way from where the tip was to where it goes.
    #[default]
    AsAnimated,
    /// The middle joint lies on the side of this point, in the space of the limb. As animated where the point is on the
    /// line from the root to the target.
    Pole(Vec3),
}

/// The middle joint's axis, and how far it flexes about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Turning the lower bone about this, by the right-hand rule, flexes; as the animation holds it, in the space of the
    /// limb, of any length. An axis along a bone, or none, counts as the normal of the animated bend.
    pub axis: Vec3,
    /// The least flexion, radians: 0 where the bones are in line. At least 0, so that no knee bends backwards.
    pub least_rad: f32,
    /// The most, radians; at most π.
    pub most_rad: f32,
}

/// A limb's solver: how to bend.
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
    /// The plane that it bends in.
    pub bend: Bend,
    /// The middle joint. `None`: it flexes about the normal of the animated bend, up to half a turn.
    pub hinge: Option<Hinge>,
    /// The part of the limb's length from which on it gives way softly instead of snapping straight, 0…1; 1 (the default)
    /// keeps every target in reach exact.
    pub soften: f32,
    /// Turns the bend plane about the line from root to target by this, radians.
    pub twist_rad: f32,
    /// How much of it all is applied, 0…1; 1 by default.
    pub weight: f32,
}

impl Default for TwoBone {
    fn default() -> Self {
        Self::new()
    }
}

/// What became of a call of [`TwoBone::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBoneOutcome {
    /// Goes before the upper bone's rotation in the space of the limb: `upper * animated`. Unit and finite.
    pub upper: Quat,
    /// The same for the lower bone.
    pub lower: Quat,
    /// Where the joints are then, by forward kinematics.
    pub limb: Limb,
    /// How far the tip is from the target.
    pub error: f32,
    /// Whether the target is met, and if not, why.
    pub status: TwoBoneStatus,
}

/// Whether a limb met its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TwoBoneStatus {
    /// The tip is on the target, to 1e-5 of the limb's length.
    Reached,
    /// The target is further than the limb is long: it is stretched towards it.
    TooFar,
    /// One bone is longer than the other and the target is nearer than their difference: it is folded.
    TooNear,
    /// The hinge flexes no further, or stretches no further.
    AtHinge,
    /// Softening or a weight below 1 left a part of the way.
    Partial,
    /// Something is no number, or the limb has no length: nothing is moved.
    Degenerate,
}

/// What counts as met, of the limb's length.
const MET: f32 = 1e-5;

impl TwoBone {
    /// In the plane of the animation, without limits, softening or twist, at full weight.
    #[must_use]
    pub const fn new() -> Self {
        Self { bend: Bend::AsAnimated, hinge: None, soften: 1.0, twist_rad: 0.0, weight: 1.0 }
    }

    /// With the middle joint on the side of a point, in the space of the limb.
    #[must_use]
    pub const fn with_pole(mut self, pole: Vec3) -> Self {
        self.bend = Bend::Pole(pole);
        self
    }

    /// With this middle joint.
    #[must_use]
    pub const fn with_hinge(mut self, hinge: Hinge) -> Self {
        self.hinge = Some(hinge);
        self
    }

    /// Giving way softly from this part of the limb's length on.
    #[must_use]
    pub const fn with_softening(mut self, soften: f32) -> Self {
        self.soften = soften;
        self
    }

    /// With the bend plane turned, radians.
    #[must_use]
    pub const fn with_twist(mut self, twist_rad: f32) -> Self {
        self.twist_rad = twist_rad;
        self
    }

    /// Applied in part, 0…1.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// Brings the tip of `limb`, as the animation left it, to `target`, or as near as the limb gets.
    ///
    /// All in one space. Whatever the bits, the rotations are finite and unit; only what is no number or has no length is
    /// left as it is ([`TwoBoneStatus::Degenerate`]).
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

    /// The turns of both bones, and what it is if the target is not met.
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

        // The bent limb's own frame: towards the tip, and square to it towards the middle joint.
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

    /// The axis that the middle joint flexes about: the hinge's, else the normal of the animated bend; of a straight limb,
    /// that which bends it towards the pole, else any.
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

    /// The turn about the axis that brings the tip to this distance from the root, and why it would not.
    ///
    /// With the bones' parts along the axis, `z`, and square to it, `u` and `l`, a flexion `f` leaves the tip at
    /// `d² = z² + u² + l² + 2 u l cos f`. By its half, so that near and far are as exact as what lies between:
    /// `4 u l cos²(f/2) = d² − z² − (u − l)²`, `4 u l sin²(f/2) = (u + l)² − (d² − z²)`.
    fn flexion(&self, [upper, lower]: [Vec3A; 2], axis: Vec3A, distance: f32) -> (Quat, TwoBoneStatus) {
        let along = (upper + lower).dot(axis);
        let [flat_upper, flat_lower] = [upper, lower].map(|bone| bone - axis * bone.dot(axis));
        let [u, l] = [flat_upper, flat_lower].map(math::length);
        let both = 4.0 * u * l;
        let wanted = self.softened(distance);
        let in_plane = math::sqrt((wanted - along) * (wanted + along));
        // Squares of the half angle's cosine and sine, but for the factor.
        let (cos_2, sin_2) = ((in_plane - (u - l)) * (in_plane + (u - l)), (u + l - in_plane) * (u + l + in_plane));
        if !(both > f32::MIN_POSITIVE) {
            // A bone without length, or along the axis: nothing flexes.
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
        // The flexion that the animation has: the angle between the flat bones, by its halves too.
        let animated = {
            let (upper, lower) = (flat_upper / u, flat_lower / l);
            let (sum, difference) = ((upper + lower).length(), (upper - lower).length());
            let (cos, sin) = unit(sum, difference);
            if axis.dot(cross(upper, lower)) < 0.0 { (cos, -sin) } else { (cos, sin) }
        };
        let cos = halves.0 * animated.0 + halves.1 * animated.1;
        let sin = halves.1 * animated.0 - halves.0 * animated.1;
        let turn = axis * sin;
        (normalized(Quat::from_xyzw(turn.x, turn.y, turn.z, cos)), cause)
    }

    /// The distance to go to: from the softened part of the length on it approaches the length but never arrives.
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
    /// Least and most flexion, radians, in order and within half a turn.
    fn range(&self) -> (f32, f32) {
        let least = self.least_rad.max(0.0).min(PI);
        (least, self.most_rad.min(PI).max(least))
    }
}

/// (x, y) at length 1; (1, 0) for what has none.
fn unit(x: f32, y: f32) -> (f32, f32) {
    let length = math::sqrt(x * x + y * y);
    if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) }
}

/// Where the middle joint lies beside the way to the tip, `along`, if it flexes about `axis`.
fn side(along: Vec3A, axis: Vec3A) -> Vec3A {
    let side = direction(cross(along, axis)).unwrap_or_else(|| along.any_orthonormal_vector());
    direction(side - along * side.dot(along)).unwrap_or(side)
}

/// `v`, square to `from`, carried along by the shortest turn from one unit vector to another.
fn carried(v: Vec3A, from: Vec3A, to: Vec3A) -> Vec3A {
    let along = 1.0 + from.dot(to);
    // Half a turn: about v itself.
    let carried = if along > FLAT * FLAT { v - (from + to) * (v.dot(to) / along) } else { v };
    across(carried, to).unwrap_or_else(|| to.any_orthonormal_vector())
}
