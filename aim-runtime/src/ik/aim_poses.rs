//! Aiming as an animator posed it: poses that each aim in a known direction, blended by the direction that is wanted.
//!
//! What is blended does not aim exactly between, so the direction that is asked of the poses is corrected by what is
//! missed, until they aim right; the last of it is for an aim solver.

use glam::{Quat, Vec3, Vec3A};

use crate::math::turn::{self, part, shortest};
use crate::math::{self, angle_between, cross, direction, turned};

/// A pose and where it aims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimPose<'a> {
    /// Where it aims, of any length, in the same space for all poses of a set.
    pub direction: Vec3,
    /// The local rotations of its bones: in every pose of the same bones in the same order.
    pub rotations: &'a [Quat],
}

/// A set of poses to aim with.
///
/// ```
/// use aim_runtime::glam::{Quat, Vec3};
/// use aim_runtime::ik::{AimPose, AimPoses, AimPosesStatus, grid};
///
/// // A chest and a head that share the turn; a real set comes from an animator.
/// let turns = [[-1.0_f32, 0.6], [0.0, 0.6], [1.0, 0.6], [-1.0, -0.6], [0.0, -0.6], [1.0, -0.6]];
/// let rotations = turns.map(|[heading, pitch]| {
///     let half = Quat::from_rotation_y(0.5 * heading) * Quat::from_rotation_x(0.5 * -pitch);
///     [half, half]
/// });
/// // Where the head looks: the forward kinematics of these two bones.
/// let gaze = |rotations: &[Quat]| rotations[0] * rotations[1] * Vec3::Z;
/// let poses: [_; 6] = core::array::from_fn(|i| AimPose { direction: gaze(&rotations[i]), rotations: &rotations[i] });
/// let mut triangles = [[0; 3]; 4];
/// let aim_poses = AimPoses::new(&poses, grid(3, 2, &mut triangles).unwrap());
///
/// let wanted = Vec3::new(0.5, 0.1, 1.0);
/// let mut blended = [Quat::IDENTITY; 2];
/// let outcome = aim_poses.solve(wanted, &mut blended, gaze);
/// assert_eq!(outcome.status, AimPosesStatus::Reached);
/// assert!(gaze(&blended).angle_between(wanted) < 1e-3);
/// ```
///
/// Then comes what this cannot know: limits, and a direction beyond the poses. Give the blended pose to
/// [`Aim::aim`](crate::Aim::aim) as the animation; it adds what is left.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AimPoses<'a> {
    /// The poses.
    pub poses: &'a [AimPose<'a>],
    /// Three poses each, to blend between: from [`grid`](super::grid) or [`triangulated`](super::triangulated). They may
    /// not overlap, and what they cover has to be seen whole from its middle. Those with an index that is none are left out.
    pub triangles: &'a [[usize; 3]],
    /// The angle between the aim and the wanted direction that is good enough, radians. Default 1e-3.
    pub tolerance_rad: f32,
    /// How often the direction is corrected at most; with 0 it is a plain blend. Default 8.
    pub iterations: u32,
}

/// Which poses to blend, and how much of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    /// Indices of poses.
    pub poses: [usize; 3],
    /// The part of each, 0…1; together 1.
    pub weights: [f32; 3],
    /// Whether the direction lies within the poses' directions; else it was brought to their edge, towards their middle.
    pub within: bool,
}

/// What became of a call of [`AimPoses::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimPosesOutcome {
    /// The angle left between the aim of the blended pose and the wanted direction, radians; π/2 where that is degenerate.
    pub remaining_rad: f32,
    /// How often the direction was corrected.
    pub iterations: u32,
    /// Whether the blended pose aims there, and if not, why.
    pub status: AimPosesStatus,
}

/// Whether a blended pose aims where it shall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimPosesStatus {
    /// Within the tolerance.
    Reached,
    /// The direction lies beyond what blends of the poses aim at: the pose is at their edge.
    Outside,
    /// The iterations are used up.
    IterationLimit,
    /// There is no triangle, something is no number, or the slices differ in length. What is written, if anything, is unit.
    Degenerate,
}

impl<'a> AimPoses<'a> {
    /// These poses, joined like this; to 1e-3 radians, in 8 corrections at most.
    #[must_use]
    pub const fn new(poses: &'a [AimPose<'a>], triangles: &'a [[usize; 3]]) -> Self {
        Self { poses, triangles, tolerance_rad: 1e-3, iterations: 8 }
    }

    /// To this angle, radians.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance_rad: f32) -> Self {
        self.tolerance_rad = tolerance_rad;
        self
    }

    /// With so many corrections at most.
    #[must_use]
    pub const fn with_iterations(mut self, iterations: u32) -> Self {
        self.iterations = iterations;
        self
    }

    /// Writes to `rotations` the blend of poses that aims along `wanted`, as `aim` judges it: forward kinematics of the
    /// caller, from the poses' local rotations to where they aim.
    ///
    /// For the direction of a pose that is the pose itself; between poses it is continuous in `wanted`, beyond them but for
    /// the direction opposite to their middle.
    pub fn solve(&self, wanted: Vec3, rotations: &mut [Quat], mut aim: impl FnMut(&[Quat]) -> Vec3) -> AimPosesOutcome {
        self.solve_with(wanted, |blend| self.mix(blend, rotations).then(|| aim(rotations)))
    }

    /// Finds the blend of poses that aims along `wanted`, for poses that are more than [rotations](AimPose::rotations), which may then be
    /// empty. `pose_and_aim` poses the character by a blend and tells where it then aims, `None` where it cannot; its last call is
    /// with the blend that counts.
    pub fn solve_with(&self, wanted: Vec3, mut pose_and_aim: impl FnMut(&Blend) -> Option<Vec3>) -> AimPosesOutcome {
        let mut outcome =
            AimPosesOutcome { remaining_rad: math::UNDEFINED_RAD, iterations: 0, status: AimPosesStatus::Degenerate };
        let Some(wanted) = direction(wanted.into()) else { return outcome };
        let Some(blend) = self.weights_at(wanted) else { return outcome };
        let mut missed =
            |blend: &Blend| direction(pose_and_aim(blend)?.into()).map(|aim| (angle_between(aim, wanted), aim));
        let Some((mut remaining, mut aimed)) = missed(&blend) else { return outcome };
        let (mut asked, mut best, mut within) = (wanted, blend, blend.within);
        let (mut part_of_missed, mut shown) = (1.0, blend);
        outcome.status = AimPosesStatus::IterationLimit;
        while !(remaining <= self.tolerance_rad) && outcome.iterations < self.iterations {
            outcome.iterations += 1;
            // What is missed is asked for on top.
            let more = turned(part(shortest(aimed, wanted), part_of_missed), asked);
            let Some(blend) = direction(more).and_then(|more| self.weights_at(more)) else { break };
            within &= blend.within;
            shown = blend;
            match missed(&blend).filter(|(now, _)| *now < remaining) {
                Some(now) => ((remaining, aimed), asked, best) = (now, more, blend),
                None => part_of_missed *= 0.5,
            }
        }
        if shown != best {
            missed(&best);
        }
        outcome.remaining_rad = remaining;
        if remaining <= self.tolerance_rad {
            outcome.status = AimPosesStatus::Reached;
        } else if !within {
            outcome.status = AimPosesStatus::Outside;
        }
        outcome
    }

    /// Which poses a direction lies between, and how much of each: its coordinates in their triangle. `None` where the
    /// direction, or every triangle, is degenerate.
    #[must_use]
    pub fn weights(&self, wanted: Vec3) -> Option<Blend> {
        self.weights_at(direction(wanted.into())?)
    }

    /// Blends the poses' rotations; false where one lacks some.
    fn mix(&self, blend: &Blend, rotations: &mut [Quat]) -> bool {
        let poses = blend.poses.map(|pose| self.poses[pose].rotations);
        // All in the hemisphere of one pose, the same everywhere, so that no sign changes from triangle to triangle.
        let first = self.poses[self.triangles[0][0].min(self.poses.len() - 1)].rotations;
        if first.len() != rotations.len() || poses.iter().any(|pose| pose.len() != rotations.len()) {
            return false;
        }
        for (bone, rotation) in rotations.iter_mut().enumerate() {
            let like = turn::unit(first[bone]).unwrap_or(Quat::IDENTITY);
            let mut sum = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
            for (pose, weight) in poses.iter().zip(blend.weights) {
                let pose = turn::unit(pose[bone]).unwrap_or(Quat::IDENTITY);
                sum += if turn::dot(pose, like) < 0.0 { -pose } else { pose } * weight;
            }
            *rotation = turn::unit(sum).unwrap_or(like);
        }
        true
    }

    fn at(&self, pose: usize) -> Option<Vec3A> {
        direction(self.poses.get(pose)?.direction.into())
    }

    fn corners(&self, triangle: &[usize; 3]) -> Option<[Vec3A; 3]> {
        let [a, b, c] = triangle.map(|pose| self.at(pose));
        Some([a?, b?, c?])
    }

    fn weights_at(&self, wanted: Vec3A) -> Option<Blend> {
        /// How much a weight may lack for rounding to a direction on an edge.
        const EDGE: f32 = 1e-6;
        let mut best: Option<([usize; 3], [f32; 3], f32)> = None;
        let mut middle = Vec3A::ZERO;
        for triangle in self.triangles {
            let Some(corners) = self.corners(triangle) else { continue };
            let Some(weights) = coordinates(corners, wanted) else { continue };
            middle += corners[0] + corners[1] + corners[2];
            let least = weights[0].min(weights[1]).min(weights[2]);
            if best.as_ref().is_none_or(|(_, _, most)| least > *most) {
                best = Some((*triangle, weights, least));
            }
        }
        let (poses, weights, least) = best?;
        if least >= -EDGE {
            return Some(Blend { poses, weights: normalised(weights), within: true });
        }
        self.edge(wanted, direction(middle)?)
    }

    /// Where the arc from `wanted` to the middle comes in over the edge of what the triangles cover.
    fn edge(&self, wanted: Vec3A, middle: Vec3A) -> Option<Blend> {
        let mut best: Option<(Blend, f32)> = None;
        for triangle in self.triangles {
            let Some(corners) = self.corners(triangle) else { continue };
            if coordinates(corners, wanted).is_none() {
                continue;
            }
            for corner in 0..3 {
                let [i, j, k] = [0, 1, 2].map(|next| (corner + next) % 3);
                if self.is_shared(triangle, triangle[i], triangle[j]) {
                    continue;
                }
                let [a, b, c] = [corners[i], corners[j], corners[k]];
                let normal = cross(a, b);
                let normal = if normal.dot(c) < 0.0 { -normal } else { normal };
                // In at the edge: the point of the arc that has nothing along the normal.
                let (from, to) = (normal.dot(wanted), normal.dot(middle));
                let (Some(entry), Some(side)) = (direction(wanted * to - middle * from), direction(normal)) else {
                    continue;
                };
                if from > 0.0 || to <= 0.0 {
                    continue;
                }
                // Along the edge from its ends; negative where the entry lies beyond one.
                let sense = cross(a, b).dot(side);
                let parts = [cross(entry, b).dot(side) / sense, cross(a, entry).dot(side) / sense];
                let least = parts[0].min(parts[1]);
                if best.as_ref().is_none_or(|(_, most)| least > *most) {
                    let weights = normalised([parts[0], parts[1], 0.0]);
                    let poses = [triangle[i], triangle[j], triangle[k]];
                    best = Some((Blend { poses, weights, within: false }, least));
                }
            }
        }
        best.map(|(blend, _)| blend)
    }

    /// Whether an edge of a triangle is one of another, too.
    fn is_shared(&self, of: &[usize; 3], a: usize, b: usize) -> bool {
        self.triangles.iter().any(|other| other != of && other.contains(&a) && other.contains(&b))
    }
}

/// The parts of three directions that make up a fourth; all positive where it lies between them. `None` of a flat triangle.
fn coordinates([a, b, c]: [Vec3A; 3], wanted: Vec3A) -> Option<[f32; 3]> {
    const FLAT: f32 = 1e-6;
    let volume = a.dot(cross(b, c));
    if !(volume.abs() > FLAT) {
        return None;
    }
    Some([cross(b, c), cross(c, a), cross(a, b)].map(|normal| wanted.dot(normal) / volume))
}

/// Without what is negative, and together 1.
fn normalised(weights: [f32; 3]) -> [f32; 3] {
    let weights = weights.map(|weight| weight.max(0.0));
    let sum = weights[0] + weights[1] + weights[2];
    if sum > 0.0 { weights.map(|weight| weight / sum) } else { [1.0, 0.0, 0.0] }
}
