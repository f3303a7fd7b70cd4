//! Specialisation of the exact solver for following a target: the same optimum on flat arrays, four angles at a time,
//! with one linear model per frame, and monomorphised for each number of joints.
//!
//! Returns `None`, having changed nothing, unless all of these hold:
//!
//! - at most [`LANE_JOINTS`] joints;
//! - weight 1, effector 0, every range fixed and within ±π ([`Description::has_fixed_ranges`](crate::Description));
//! - no second eye, no turn-round in progress, no strain remembered, target not behind in the last frame;
//! - pose rigid with one uniform scale;
//! - target in front of the innermost joint, at a distance from the effector between [`NEAR`] and [`FAR`];
//! - every angle can be within its range at the end of this frame;
//! - the linear model is closed by free angles that cover both directions of the gaze, and forward kinematics confirms
//!   the result to [`ENOUGH_RAD`].

use glam::{Affine3A, BVec4A, Mat3A, Quat, Vec3A, Vec4};

use super::dual::{MIN_GAP_PRICE, STRAINED};
use super::{ENOUGH_RAD, IDENTITY_LINK, STILL_RAD};
use crate::kinematics::chain::{RIGID_DEVIATION, common_scale, upright};
use crate::kinematics::rotation::{is_identity, tilted, turn};
use crate::kinematics::view::{Stretch, View};
use crate::math::trig;
use crate::rig::{AllLanes, LANE_JOINTS, Lanes, PoseSlices, Side, StateSlices};
use crate::solve::call::{Call, upright_axis};
use crate::solve::judge::Verdict;
use crate::{Description, Joint, JointInfo, JointSet, Outcome, Rig, Solver, math};

/// Angle to the target below which no further correction is made, radians (2.6e-3°).
const FINE_RAD: f32 = 4.5e-5;
/// Largest number of corrections with the same linear model.
const REFINEMENTS: usize = 2;
/// Largest number of Newton steps on the dual of the linear model.
const NEWTON_STEPS: usize = 4;
/// Square of the least distance of the target from the effector, relative to the rig's extent.
const NEAR: f32 = 1e-6;
/// Square of the greatest distance of the target from the effector, relative to the rig's extent.
const FAR: f32 = 1e8;
/// Residual below which joints that hardly move stay where they are.
const AT_REST: f32 = 1e-4;
/// Start value of sums: −0 + x is x for every x, so the compiler can drop the addition. For +0 it cannot.
const NOTHING: f32 = -0.0;

/// Aims for one frame of positive length, or returns `None` if one of the conditions above does not hold.
#[inline(always)]
pub(crate) fn aim<K: Rig + ?Sized>(
    kernels: &K,
    rig: &Description<'_>,
    state: &mut StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &Call<'_>,
    corrections: &mut [Quat],
) -> Option<Outcome> {
    let settings = call.settings;
    if !(settings.has_full_weight() && settings.effector == 0 && rig.has_fixed_ranges) {
        return None;
    }
    const { assert!(LANE_JOINTS == 8, "one arm for each number of joints") }
    let (remaining, at_limit) = match rig.joints.len() {
        1 => aim_joints::<1, 1, K>(kernels, rig, state, pose, call, corrections),
        2 => aim_joints::<2, 1, K>(kernels, rig, state, pose, call, corrections),
        3 => aim_joints::<3, 2, K>(kernels, rig, state, pose, call, corrections),
        4 => aim_joints::<4, 2, K>(kernels, rig, state, pose, call, corrections),
        5 => aim_joints::<5, 3, K>(kernels, rig, state, pose, call, corrections),
        6 => aim_joints::<6, 3, K>(kernels, rig, state, pose, call, corrections),
        7 => aim_joints::<7, 4, K>(kernels, rig, state, pose, call, corrections),
        8 => aim_joints::<8, 4, K>(kernels, rig, state, pose, call, corrections),
        _ => None,
    }?;
    let tolerance = settings.effective_tolerance();
    let verdict = Verdict { remaining, tolerance, behind: false, within_reach: true };
    // The cosine of an angle within ENOUGH_RAD rounds to 1.
    Some(verdict.outcome_by(1.0, at_limit, JointSet::EMPTY))
}

/// Runs a block for each joint (or vector of joints), from the effector inward, or outward with `rev`.
///
/// Unrolled up to a count of four, so that every index is a constant and the compiler can keep a frame's arrays in
/// registers. It does not unroll bodies of this size by itself.
macro_rules! each {
    ($count:expr, $index:ident => $body:block) => {
        each!($count, $index => $body, (0, 1, 2, 3), (0..$count))
    };
    ($count:expr, rev $index:ident => $body:block) => {
        each!($count, $index => $body, (3, 2, 1, 0), (0..$count).rev())
    };
    ($count:expr, $index:ident => $body:block, ($($n:literal),*), $all:expr) => {
        if $count <= 4 {
            $(
                if $n < $count {
                    let $index = $n;
                    $body
                }
            )*
        } else {
            for $index in $all {
                $body
            }
        }
    };
}

/// Moves the joints. Returns the remaining angle and the joints at a limit.
#[inline(always)]
fn aim_joints<const N: usize, const V: usize, K: Rig + ?Sized>(
    kernels: &K,
    rig: &Description<'_>,
    state: &mut StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &Call<'_>,
    corrections: &mut [Quat],
) -> Option<(f32, JointSet)> {
    let infos: &[JointInfo; N] = rig.joints.try_into().ok()?;
    let joints: &mut [Joint; N] = (&mut *state.joints).try_into().ok()?;
    let animated: &[Affine3A; N] = pose.joints.try_into().ok()?;
    let corrections: &mut [Quat; N] = corrections.try_into().ok()?;
    let (lanes, dt) = (&rig.lanes, call.dt?);
    let scale = common_scale(animated, RIGID_DEVIATION)?;
    // The inverse of a rotated and uniformly scaled frame is its transpose divided by the squared scale.
    let (mut frames, mut per_square, mut tilts) = (animated, 1.0 / scale, None);
    let upright_pose;
    if rig.has_upright {
        // The upright frames have scale 1, so lengths are the pose's.
        upright_pose = UprightPose::new(infos, pose, animated, scale);
        (frames, per_square, tilts) = (&upright_pose.joints, 1.0, Some(&upright_pose.tilts));
    }
    let mut links = Links::<N>::EMPTY;
    let mut offset = Vec3A::ZERO;
    if rig.has_origin {
        offset = animated[0].transform_vector3a(rig.effector.origin.into());
        links.squares += offset * offset;
    }
    if !links.read(&rig.joints[rig.joints.len() - 1].planes.basis, frames, per_square, call.target_ps.into()) {
        return None;
    }
    let mut flat = [IDENTITY_LINK; N];
    each!(N, index => {
        if index > 0 {
            flat[index] = links.links[index].to_cols_array();
        }
    });
    if rig.has_origin {
        links.has_first = true;
        [flat[0][9], flat[0][10], flat[0][11]] = (inverse(&frames[0].matrix3, per_square) * offset).to_array();
    }
    if let Some(tilts) = tilts {
        if !is_identity(tilts[0]) {
            links.has_first = true;
            flat[0][..9].copy_from_slice(&Mat3A::from_quat(tilts[0].conjugate()).to_cols_array());
        }
    }

    let mut angles = Angles::<N, V>::EMPTY;
    if !angles.load(joints) {
        return None;
    }
    let residual = angles.linearise(kernels, rig, infos, &flat, &links.target)?;
    if !angles.set_bounds(lanes, dt) {
        return None;
    }
    angles.lambda = state.memory.lambda;
    let first = links.has_first.then_some(&flat[0]);
    let mut turns = [Quat::IDENTITY; N];
    // The optimum of the dual, usually found by the first Newton step.
    let start = angles.start;
    angles.set_from_dual(lanes);
    if !angles.step(lanes, residual, &start)? {
        angles = angles.after_more_steps(lanes, residual)?;
    }
    // Joints that would hardly move stay exactly where they are.
    let rests = square(residual) < AT_REST * AT_REST && !angles.moves();
    if rests {
        angles.stay();
    }
    let mut view = angles.forward_kinematics(rig, infos, &links, first, &mut turns);
    if !view.is_within(FINE_RAD) {
        if !rests {
            let refined = angles.refined(rig, infos, links, first, view)?;
            (angles, view, turns) = (refined.angles, refined.view, refined.turns);
        }
        if !view.is_within(ENOUGH_RAD) {
            return None;
        }
    }
    // For such small angles the tangent equals the angle.
    let remaining = view.tangent();
    let far = view.forward * view.forward;
    if !(remaining <= call.settings.effective_tolerance() && far > NEAR * links.extent && far < FAR * links.extent) {
        return None;
    }
    each!(N, index => {
        let [a, b, c, d] = angles.now[index / 2].to_array();
        let joint = &mut joints[index];
        [joint.pitch, joint.heading] = if index % 2 == 0 { [a, b] } else { [c, d] };
        joint.velocity = [0.0; 2];
        corrections[index] = turns[index];
    });
    if let Some(tilts) = tilts {
        for (correction, tilt) in corrections.iter_mut().zip(tilts) {
            *correction = tilted(*correction, *tilt);
        }
    }
    let memory = &mut *state.memory;
    (memory.side, memory.lambda, memory.blocked_s) = (links.side, angles.lambda, 0.0);
    Some((remaining, angles.limits_met(lanes)))
}

/// A pose in which the joints with an upright heading are replaced by their upright frames.
struct UprightPose<const N: usize> {
    /// The joints' upright frames, of scale 1, at the joints' places.
    joints: [Affine3A; N],
    /// The rotation of each upright frame in its bone.
    tilts: [Quat; N],
}

impl<const N: usize> UprightPose<N> {
    /// Creates the pose from `animated`; `scale` is the square of the joints' common scale.
    #[inline(never)]
    fn new(infos: &[JointInfo; N], pose: &PoseSlices<'_>, animated: &[Affine3A; N], scale: f32) -> Self {
        let per_scale = 1.0 / math::sqrt(scale);
        let (mut frames, mut tilts) = ([Mat3A::IDENTITY; N], [Quat::IDENTITY; N]);
        for (frame, joint) in frames.iter_mut().zip(animated) {
            *frame = joint.matrix3 * per_scale;
        }
        upright(infos, 0, upright_axis(pose, Solver::Exact), &mut frames, &mut tilts);
        let mut joints = *animated;
        for (joint, frame) in joints.iter_mut().zip(frames) {
            joint.matrix3 = frame;
        }
        Self { joints, tilts }
    }
}

/// The pose as rigid links, and the target, in lengths of the bones' own spaces.
#[derive(Clone, Copy)]
struct Links<const N: usize> {
    /// The link from joint i − 1 to joint i; unused for joint 0.
    links: [Affine3A; N],
    /// `true` if the first link, from the effector to joint 0, is not the identity.
    has_first: bool,
    /// The sum of the squared steps from joint to joint, separately for x, y and z.
    squares: Vec3A,
    /// The target in the innermost joint's upright space.
    target: Vec3A,
    side: Side,
    /// The square of the rig's extent.
    extent: f32,
}

impl<const N: usize> Links<N> {
    const EMPTY: Self = Self {
        links: [Affine3A::IDENTITY; N],
        has_first: false,
        squares: Vec3A::splat(NOTHING),
        target: Vec3A::ZERO,
        side: Side::Unseen,
        extent: 0.0,
    };

    /// Computes the links. Returns `true` if the pose and the target meet the conditions. `axes` are the innermost
    /// joint's, `frames` the joints' upright frames, `per_square` the reciprocal of their squared common scale.
    #[inline(always)]
    fn read(&mut self, axes: &Mat3A, frames: &[Affine3A; N], per_square: f32, target: Vec3A) -> bool {
        let to_target = target - frames[N - 1].translation;
        each!(N, index => {
            let outward = inverse(&frames[index].matrix3, per_square);
            if index > 0 {
                let step = frames[index - 1].translation - frames[index].translation;
                self.squares += step * step;
                self.links[index] =
                    Affine3A { matrix3: product(&outward, &frames[index - 1].matrix3), translation: outward * step };
            }
            if index + 1 == N {
                self.target = outward * to_target;
            }
        });
        let square = self.squares.x + self.squares.y + self.squares.z;
        let View { forward: ahead, left, .. } = view(axes, self.target);
        self.side = Side::of_coordinate(left);
        self.extent = square * per_square;
        // In front, with lengths whose squares are normal numbers. NaN fails both comparisons.
        ahead > 0.0 && square > 1e-12
    }
}

/// Returns the inverse of a rotated and uniformly scaled frame, given the reciprocal of its squared scale.
#[inline(always)]
fn inverse(frame: &Mat3A, per_square: f32) -> Mat3A {
    frame.transpose() * per_square
}

/// Returns the product of two matrices. glam's own is not inlined.
#[inline(always)]
fn product(a: &Mat3A, b: &Mat3A) -> Mat3A {
    Mat3A::from_cols(*a * b.x_axis, *a * b.y_axis, *a * b.z_axis)
}

/// Returns the product of a transposed matrix and a vector. Transposes the products instead of taking three dots.
#[inline(always)]
fn transposed_product(m: &Mat3A, v: Vec3A) -> Vec3A {
    let rows = Mat3A::from_cols(m.x_axis * v, m.y_axis * v, m.z_axis * v).transpose();
    rows.x_axis + rows.y_axis + rows.z_axis
}

/// Returns a vector rotated by the inverse of a unit quaternion.
#[inline(always)]
pub(crate) fn unturned(turn: Quat, v: Vec3A) -> Vec3A {
    let axis = Vec3A::from_vec4(turn.into());
    let across = math::cross(v, axis) * 2.0;
    v + across * turn.w + math::cross(across, axis)
}

/// The angles of N joints in V vectors of four: pitch and heading of each joint in turn, 0 for an angle that is
/// missing.
#[derive(Clone, Copy)]
struct Angles<const N: usize, const V: usize> {
    start: [Vec4; V],
    /// The least angles that this frame can reach.
    lo: [Vec4; V],
    /// The greatest angles that this frame can reach.
    hi: [Vec4; V],
    /// Row of the Jacobian: derivatives of the residual's left component.
    left: [Vec4; V],
    /// Row of the Jacobian: derivatives of the residual's up component.
    up: [Vec4; V],
    /// The dual point.
    lambda: [f32; 2],
    /// The angles at the dual point.
    now: [Vec4; V],
    /// `true` for the angles that are not at a bound at the dual point.
    free: [BVec4A; V],
}

/// The angles after correction, and the quantities derived from them.
struct RefinedAngles<const N: usize, const V: usize> {
    angles: Angles<N, V>,
    view: View,
    turns: [Quat; N],
}

/// Builds four lanes from the pairs of joints 2k and 2k + 1; 0 for a joint that does not exist.
macro_rules! lanes {
    ($k:expr, $index:ident => $pair:expr) => {{
        let $index = 2 * $k;
        let [a, b] = $pair;
        let [c, d] = if 2 * $k + 1 < N {
            let $index = 2 * $k + 1;
            $pair
        } else {
            [0.0; 2]
        };
        Vec4::new(a, b, c, d)
    }};
}

impl<const N: usize, const V: usize> Angles<N, V> {
    const EMPTY: Self = {
        let (zero, free) = ([Vec4::ZERO; V], [BVec4A::FALSE; V]);
        Self { start: zero, lo: zero, hi: zero, left: zero, up: zero, lambda: [0.0; 2], now: zero, free }
    };

    /// Loads the angles. Returns `false` if a joint has a destination.
    #[inline(always)]
    fn load(&mut self, joints: &[Joint; N]) -> bool {
        each!(N, index => {
            if joints[index].destination().is_some() {
                return false;
            }
        });
        each!(V, k => {
            self.start[k] = lanes!(k, index => [joints[index].pitch, joints[index].heading]);
        });
        true
    }

    /// Computes the angles that a frame of `dt` seconds can reach. Returns `false` if an angle cannot get into its
    /// range.
    #[inline(always)]
    fn set_bounds(&mut self, lanes: &AllLanes, dt: f32) -> bool {
        let mut outside = BVec4A::FALSE;
        each!(V, k => {
            let Lanes { least, most, rate, .. } = lanes[k];
            let step = rate * dt;
            self.lo[k] = least.max(self.start[k] - step);
            self.hi[k] = most.min(self.start[k] + step);
            outside |= self.lo[k].cmpgt(self.hi[k]);
        });
        !outside.any()
    }

    /// Evaluates the linear model at the start angles. Returns the residual there, or `None` if it is not small.
    #[inline(always)]
    fn linearise<K: Rig + ?Sized>(
        &mut self,
        kernels: &K,
        rig: &Description<'_>,
        infos: &[JointInfo; N],
        links: &[[f32; 12]; N],
        target: &Vec3A,
    ) -> Option<[f32; 2]> {
        let mut sin_cos = [[0.0; 4]; N];
        each!(V, k => {
            let [sin, cos] = trig::sin_cos_4(self.start[k]);
            sin_cos[2 * k] = Vec4::new(sin.x, cos.x, sin.y, cos.y).to_array();
            if 2 * k + 1 < N {
                sin_cos[2 * k + 1] = Vec4::new(sin.z, cos.z, sin.w, cos.w).to_array();
            }
        });
        // Layout: the residual, then one row of derivatives for left and one for up, by the declared angles.
        let mut out = [[0.0; 6]; N];
        let count = rig.angles;
        kernels.residual_jacobian(links, &target.to_array(), &sin_cos, &mut out.as_flattened_mut()[..2 + 2 * count]);
        let residual = [out[0][0], out[0][1]];
        // A larger residual would have to be converted to an angle by `Stretch`.
        if !(square(residual) < Stretch::SMALL * Stretch::SMALL) {
            return None;
        }
        if count == 2 * N {
            each!(V, k => {
                self.left[k] = lanes!(k, index => pair(&out, 1 + index));
                self.up[k] = lanes!(k, index => pair(&out, 1 + N + index));
            });
        } else {
            let out = out.as_flattened();
            let [mut left, mut up] = [[[0.0; 2]; N]; 2];
            let mut row = 2;
            for (index, info) in infos.iter().enumerate() {
                for (angle, is_declared) in [info.pitch.is_some(), info.heading.is_some()].into_iter().enumerate() {
                    if is_declared {
                        (left[index][angle], up[index][angle]) = (out[row], out[row + count]);
                        row += 1;
                    }
                }
            }
            each!(V, k => {
                self.left[k] = lanes!(k, index => left[index]);
                self.up[k] = lanes!(k, index => up[index]);
            });
        }
        Some(residual)
    }

    /// Returns `true` if the dual's optimum moves an angle by at least [`STILL_RAD`].
    #[inline(always)]
    fn moves(&self) -> bool {
        let mut moves = BVec4A::FALSE;
        each!(V, k => {
            moves |= (self.now[k] - self.start[k]).abs().cmpge(Vec4::splat(STILL_RAD));
        });
        moves.any()
    }

    /// Leaves the angles where they are, clamped to the frame's bounds.
    #[inline(always)]
    fn stay(&mut self) {
        each!(V, k => {
            self.now[k] = self.start[k].max(self.lo[k]).min(self.hi[k]);
        });
    }

    /// Corrects the angles with the same linear model until the error is below [`FINE_RAD`]. Rarely needed, and out of
    /// line so that the common path keeps all of this in registers.
    #[cold]
    #[inline(never)]
    fn refined(
        mut self,
        rig: &Description<'_>,
        infos: &[JointInfo; N],
        links: Links<N>,
        first: Option<&[f32; 12]>,
        mut view: View,
    ) -> Option<RefinedAngles<N, V>> {
        let mut turns = [Quat::IDENTITY; N];
        for _ in 0..REFINEMENTS {
            if view.is_within(FINE_RAD) {
                break;
            }
            let at = self.now;
            self.set_from_dual(&rig.lanes);
            self = self.after_steps(&rig.lanes, NEWTON_STEPS, view.residual(), &at)?;
            view = self.forward_kinematics(rig, infos, &links, first, &mut turns);
        }
        Some(RefinedAngles { angles: self, view, turns })
    }

    /// Finds the dual's optimum by the Newton steps that remain after the first.
    #[cold]
    #[inline(never)]
    fn after_more_steps(self, lanes: &AllLanes, residual: [f32; 2]) -> Option<Self> {
        self.after_steps(lanes, NEWTON_STEPS - 1, residual, &self.start)
    }

    /// Finds the dual's optimum in at most `steps` Newton steps, for a model with this residual at the angles `at`. It
    /// is found when a step leaves the set of free angles unchanged.
    fn after_steps(mut self, lanes: &AllLanes, steps: usize, residual: [f32; 2], at: &[Vec4; V]) -> Option<Self> {
        for _ in 0..steps {
            if self.step(lanes, residual, at)? {
                return Some(self);
            }
        }
        None
    }

    /// Takes one Newton step. Returns `true` if the set of free angles is unchanged, `None` if the problem is strained.
    #[inline(always)]
    fn step(&mut self, lanes: &AllLanes, residual: [f32; 2], at: &[Vec4; V]) -> Option<bool> {
        let [mut left, mut up, mut ll, mut lu, mut uu] = [Vec4::splat(NOTHING); 5];
        each!(V, k => {
            let (jl, ju) = (self.left[k], self.up[k]);
            let change = at[k] - self.now[k];
            left += jl * change;
            up += ju * change;
            let ease = Vec4::select(self.free[k], lanes[k].half_ease, Vec4::ZERO);
            let (el, eu) = (ease * jl, ease * ju);
            ll += el * jl;
            lu += el * ju;
            uu += eu * ju;
        });
        let ([left, up, ll, uu], lu) = (sums([left, up, ll, uu]), sum(lu));
        let (gap_left, gap_up) = (left - residual[0], up - residual[1]);
        let determinant = ll * uu - lu * lu;
        let trace = ll + uu;
        if !(determinant > STRAINED * trace * trace) {
            return None;
        }
        let inverse = 1.0 / determinant;
        self.lambda[0] += (uu * gap_left - lu * gap_up) * inverse;
        self.lambda[1] += (ll * gap_up - lu * gap_left) * inverse;
        if !(square(self.lambda) < MIN_GAP_PRICE * MIN_GAP_PRICE) {
            return None;
        }
        Some(self.set_from_dual(lanes))
    }

    /// Sets the angles to those of the dual point. Returns `true` if the set of free angles is unchanged.
    #[inline(always)]
    fn set_from_dual(&mut self, lanes: &AllLanes) -> bool {
        let (x, y) = (Vec4::splat(self.lambda[0]), Vec4::splat(self.lambda[1]));
        let mut changed = 0;
        each!(V, k => {
            let pull = self.left[k] * x + self.up[k] * y;
            let wanted = self.start[k] * 0.5 + lanes[k].half_ease * pull;
            let held = wanted.max(self.lo[k]).min(self.hi[k]);
            let free = wanted.cmpeq(held);
            changed |= free.bitmask() ^ self.free[k].bitmask();
            (self.free[k], self.now[k]) = (free, held);
        });
        changed == 0
    }

    /// Returns the target as seen from the effector at the present angles, and writes the joints' corrections. `first`
    /// is the link from the effector to joint 0, unless it is the identity.
    #[inline(always)]
    fn forward_kinematics(
        &self,
        rig: &Description<'_>,
        infos: &[JointInfo; N],
        links: &Links<N>,
        first: Option<&[f32; 12]>,
        turns: &mut [Quat; N],
    ) -> View {
        let (mut sin, mut cos) = ([Vec4::ZERO; V], [Vec4::ZERO; V]);
        each!(V, k => {
            (sin[k], cos[k]) = trig::half_sin_cos_4(self.now[k]);
        });
        let mut target = links.target;
        each!(N, rev index => {
            let (sin, cos) = (sin[index / 2], cos[index / 2]);
            let halves =
                if index % 2 == 0 { [sin.x, cos.x, sin.y, cos.y] } else { [sin.z, cos.z, sin.w, cos.w] };
            turns[index] = turn(&infos[index].axes, &infos[index].planes, halves);
            target = unturned(turns[index], target);
            if index > 0 {
                let Affine3A { matrix3, translation } = links.links[index];
                target = transposed_product(&matrix3, target - translation);
            }
        });
        if let Some(first) = first {
            let Affine3A { matrix3, translation } = Affine3A::from_cols_array(first);
            target = transposed_product(&matrix3, target - translation);
        }
        if rig.aims_forward {
            return view(&infos[0].planes.basis, target);
        }
        let [forward, left, up] = rig.effector.axes(&infos[0].axes);
        View { forward: forward.dot(target), left: left.dot(target), up: up.dot(target) }
    }

    /// Returns the joints with an angle at an end of its range.
    #[inline(always)]
    fn limits_met(&self, lanes: &AllLanes) -> JointSet {
        // One bit per angle: bit 2i is the pitch of joint i, bit 2i + 1 its heading.
        let mut at_end = 0;
        each!(V, k => {
            let ends = self.now[k].cmple(lanes[k].low) | self.now[k].cmpge(lanes[k].high);
            at_end |= ends.bitmask() << (4 * k);
        });
        let mut met = JointSet::EMPTY;
        if at_end != 0 {
            (0..N).filter(|index| at_end >> (2 * index) & 3 != 0).for_each(|index| met.insert(index));
        }
        met
    }
}

/// Returns elements 2i and 2i + 1 of an array stored in rows of six.
#[inline(always)]
fn pair<const N: usize>(rows: &[[f32; 6]; N], i: usize) -> [f32; 2] {
    let row = &rows[i / 3];
    [row[2 * (i % 3)], row[2 * (i % 3) + 1]]
}

/// Returns a vector's components along the axes, which are the columns of `axes`.
#[inline(always)]
pub(crate) fn view(axes: &Mat3A, v: Vec3A) -> View {
    let [forward, left, up] = transposed_product(axes, v).to_array();
    View { forward, left, up }
}

/// Returns a vector's squared length.
#[inline(always)]
fn square([x, y]: [f32; 2]) -> f32 {
    x * x + y * y
}

/// Returns the sum of the lanes, in the same order on every machine.
#[inline(always)]
fn sum(v: Vec4) -> f32 {
    let [a, b, c, d] = v.to_array();
    (a + c) + (b + d)
}

/// Returns the [`sum`] of each of four vectors.
#[inline(always)]
fn sums([a, b, c, d]: [Vec4; 4]) -> [f32; 4] {
    let pairs = |v: Vec4, w: Vec4| Vec4::new(v.x, v.y, w.x, w.y) + Vec4::new(v.z, v.w, w.z, w.w);
    let (v, w) = (pairs(a, b), pairs(c, d));
    (Vec4::new(v.x, v.z, w.x, w.z) + Vec4::new(v.y, v.w, w.y, w.w)).to_array()
}
