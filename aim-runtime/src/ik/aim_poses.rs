//! Blends an animator's aim poses: each pose aims in a known direction, and the blend is chosen by the wanted
//! direction.
//!
//! A blend of poses does not aim exactly at the interpolated direction. Therefore the direction used for the blend is
//! corrected by the remaining error, iteratively, until the blended pose aims at the wanted direction. An aim solver
//! can remove what then remains.

use glam::{Quat, Vec3, Vec3A};

use crate::math::turn::{self, part, shortest};
use crate::math::{self, angle_between, cross, direction, turned};

/// A pose and the direction in which it aims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimPose<'a> {
    /// Direction in which the pose aims, of any length, in the same space for all poses of a set.
    pub direction: Vec3,
    /// Local rotations of the pose's bones; the same bones in the same order in every pose of a set.
    pub rotations: &'a [Quat],
}

/// Set of aim poses, triangulated by direction.
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
/// The blend observes no joint limits and cannot aim beyond the poses. Pass the blended pose to
/// [`Aim::aim`](crate::Aim::aim) as the animation to add the remaining angle within limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AimPoses<'a> {
    /// The poses.
    pub poses: &'a [AimPose<'a>],
    /// Triangles of pose indices, from [`grid`](super::grid) or [`triangulated`](super::triangulated). They must not
    /// overlap, and the region that they cover must be star-shaped about its middle. Triangles with an index out of
    /// range are ignored.
    pub triangles: &'a [[usize; 3]],
    /// Angle between aim and wanted direction up to which the aim counts as reached, radians. Default 1e-3.
    pub tolerance_rad: f32,
    /// Maximum number of corrections of the direction; 0 gives a plain blend. Default 8.
    pub iterations: u32,
}

/// Three poses and their weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    /// Indices of the poses.
    pub poses: [usize; 3],
    /// Weights of the poses, 0…1; their sum is 1.
    pub weights: [f32; 3],
    /// `true` if the direction lies within the region covered by the poses; otherwise it was moved to the region's
    /// edge, towards its middle.
    pub within: bool,
}

/// Result of [`AimPoses::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimPosesOutcome {
    /// Remaining angle between the aim of the blended pose and the wanted direction, radians; π/2 for a degenerate
    /// call.
    pub remaining_rad: f32,
    /// Number of corrections of the direction.
    pub iterations: u32,
    /// `Reached` if the blended pose aims in the wanted direction, otherwise the reason why not.
    pub status: AimPosesStatus,
}

/// Status of an [`AimPoses`] blend: success, or the reason for failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimPosesStatus {
    /// The remaining angle is within the tolerance.
    Reached,
    /// The direction lies outside the region that blends of the poses can aim at; the pose is at its edge.
    Outside,
    /// The maximum number of corrections was reached first.
    IterationLimit,
    /// No triangle is usable, an input is not finite, or slices differ in length. Rotations that were written are unit.
    Degenerate,
}

impl<'a> AimPoses<'a> {
    /// Creates a set of poses with these triangles, a tolerance of 1e-3 radians, and at most 8 corrections.
    #[must_use]
    pub const fn new(poses: &'a [AimPose<'a>], triangles: &'a [[usize; 3]]) -> Self {
        Self { poses, triangles, tolerance_rad: 1e-3, iterations: 8 }
    }

    /// Sets the [tolerance](Self::tolerance_rad), radians.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance_rad: f32) -> Self {
        self.tolerance_rad = tolerance_rad;
        self
    }

    /// Sets the maximum number of [corrections](Self::iterations).
    #[must_use]
    pub const fn with_iterations(mut self, iterations: u32) -> Self {
        self.iterations = iterations;
        self
    }

    /// Writes to `rotations` the blend of poses that aims along `wanted`. `aim` is the caller's forward kinematics: it
    /// returns the aimed direction for given local rotations.
    ///
    /// For the direction of a pose the result is that pose. It is continuous in `wanted` between the poses, and beyond
    /// them except at the direction opposite to their middle.
    pub fn solve(&self, wanted: Vec3, rotations: &mut [Quat], mut aim: impl FnMut(&[Quat]) -> Vec3) -> AimPosesOutcome {
        self.solve_with(wanted, |blend| self.mix(blend, rotations).then(|| aim(rotations)))
    }

    /// Finds the blend that aims along `wanted`, for poses that consist of more than [rotations](AimPose::rotations)
    /// (which may then be empty). `pose_and_aim` poses the character by a blend and returns the direction in which it
    /// then aims, or `None` if it cannot. Its last call is with the resulting blend.
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
            // Turn the requested direction by (a part of) the remaining error.
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

    /// Returns the triangle of poses that contains a direction, with the direction's coordinates in it as weights.
    /// `None` if the direction, or every triangle, is degenerate.
    #[must_use]
    pub fn weights(&self, wanted: Vec3) -> Option<Blend> {
        self.weights_at(direction(wanted.into())?)
    }

    /// Blends the poses' rotations. Returns `false` if a pose has another number of rotations.
    fn mix(&self, blend: &Blend, rotations: &mut [Quat]) -> bool {
        let poses = blend.poses.map(|pose| self.poses[pose].rotations);
        // Sums are taken in the quaternion hemisphere of one fixed pose, so that no sign flips between triangles.
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
        /// Rounding tolerance of a weight for a direction on an edge.
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

    /// Returns the blend at the point where the arc from `wanted` to the middle enters the region that the triangles
    /// cover.
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
                // Point of the arc in the plane of the edge: its component along the normal is 0.
                let (from, to) = (normal.dot(wanted), normal.dot(middle));
                let (Some(entry), Some(side)) = (direction(wanted * to - middle * from), direction(normal)) else {
                    continue;
                };
                if from > 0.0 || to <= 0.0 {
                    continue;
                }
                // Coordinates of the entry point along the edge; one is negative if the point lies beyond an end.
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

    /// Returns `true` if another triangle has the edge between poses `a` and `b` as well.
    fn is_shared(&self, of: &[usize; 3], a: usize, b: usize) -> bool {
        self.triangles.iter().any(|other| other != of && other.contains(&a) && other.contains(&b))
    }
}

/// Returns the coefficients of `wanted` as a linear combination of three directions; all are positive if it lies
/// between them. `None` for a flat triangle.
fn coordinates([a, b, c]: [Vec3A; 3], wanted: Vec3A) -> Option<[f32; 3]> {
    const FLAT: f32 = 1e-6;
    let volume = a.dot(cross(b, c));
    if !(volume.abs() > FLAT) {
        return None;
    }
    Some([cross(b, c), cross(c, a), cross(a, b)].map(|normal| wanted.dot(normal) / volume))
}

/// Clamps weights to at least 0 and normalises their sum to 1.
fn normalised(weights: [f32; 3]) -> [f32; 3] {
    let weights = weights.map(|weight| weight.max(0.0));
    let sum = weights[0] + weights[1] + weights[2];
    if sum > 0.0 { weights.map(|weight| weight / sum) } else { [1.0, 0.0, 0.0] }
}
