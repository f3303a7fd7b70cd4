//! Specialisation of the exact solver for a target that is followed: the same optimum on flat arrays, four angles at a
//! time, with one linear model for the frame, and compiled for each number of joints.
//!
//! Returns `None`, having changed nothing, unless all of these hold:
//!
//! - at most [`LANE_JOINTS`] joints;
//! - weight 1, effector 0, every range fixed and within ±π ([`Description::has_fixed_ranges`](crate::Description));
//! - no second eye, no turn-round in progress, no strain remembered, target not behind in the last frame;
//! - pose rigid with one uniform scale;
//! - target in front of the innermost joint, neither on the effector nor a mere direction;
//! - every angle can be within its range at the end of this frame;
//! - the linear model is closed by free angles that cover both directions of the gaze, and forward kinematics confirms the
//!   result to [`ENOUGH_RAD`].

use glam::{Affine3A, BVec4A, Mat3A, Quat, Vec3A, Vec4};

use super::dual::{DEAREST, STRAINED};
use super::{ENOUGH_RAD, IDENTITY_LINK, STILL_RAD};
use crate::kinematics::chain::{OFF, common_scale, upright};
use crate::kinematics::rotation::{is_identity, tilted, turn};
use crate::kinematics::view::{Stretch, View};
use crate::math::trig;
use crate::rig::{AllLanes, LANE_JOINTS, Lanes, PoseSlices, Side, StateSlices};
use crate::solve::call::{Call, upright_axis};
use crate::solve::judge::Verdict;
use crate::{Description, Joint, JointInfo, JointSet, Outcome, Rig, Solver, math};

/// An angle to the target that needs no mending, radians (2.6e-3°).
const FINE_RAD: f32 = 4.5e-5;
/// How often the linear model is used again on what it missed.
const MENDINGS: usize = 2;
/// The largest number of Newton steps of its dual.
const NEWTON_STEPS: usize = 4;
/// The least distance of the target from the effector, and the greatest, in parts of the rig's extent; squared.
const NEAR: f32 = 1e-6;
const FAR: f32 = 1e8;
/// The least residual that moves joints which need not move.
const AT_REST: f32 = 1e-4;
/// The start of sums: added to a number it leaves the very number, which 0 does not, and so costs nothing.
const NOTHING: f32 = -0.0;

/// Aims for one frame, of positive length, if the conditions above hold.
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
    // The cosine of an angle within ENOUGH_RAD is 1, to the last bit.
    Some(verdict.outcome_by(1.0, at_limit, JointSet::EMPTY))
}

/// Does something for each joint (or vector of joints), from the effector inward, or outward with `rev`.
///
/// Written out up to a count of four, so that every index is a constant: then the arrays of a frame are registers to the
/// compiler, which does not unroll bodies as long as these by itself.
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

/// Moves the joints; returns the angle that remains and the joints at a limit.
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
    let scale = common_scale(animated, OFF)?;
    // The inverse of a frame that is turned and scaled is its transpose, divided by the square of its scale.
    let (mut frames, mut per_square, mut tilts) = (animated, 1.0 / scale, None);
    let upright_pose;
    if rig.has_upright {
        // Lengths are the pose's then.
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
    if !angles.start(joints) {
        return None;
    }
    let residual = angles.linearise(kernels, rig, infos, &flat, &links.target)?;
    if !angles.bound(lanes, dt) {
        return None;
    }
    angles.lambda = state.memory.lambda;
    let first = links.has_first.then_some(&flat[0]);
    let mut turns = [Quat::IDENTITY; N];
    // The dual's optimum, which as a rule the first Newton step finds.
    let start = angles.start;
    angles.place(lanes);
    if !angles.step(lanes, residual, &start)? {
        angles = angles.after_more_steps(lanes, residual)?;
    }
    // Joints that would hardly move stay exactly where they are.
    let rests = square(residual) < AT_REST * AT_REST && !angles.moves();
    if rests {
        angles.rest();
    }
    let mut view = angles.see(rig, infos, &links, first, &mut turns);
    if !view.is_within(FINE_RAD) {
        if !rests {
            let mended = angles.mended(rig, infos, links, first, view)?;
            (angles, view, turns) = (mended.angles, mended.view, mended.turns);
        }
        if !view.is_within(ENOUGH_RAD) {
            return None;
        }
    }
    // So small an angle is its tangent.
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

/// A pose with the joints that have an upright heading tilted.
struct UprightPose<const N: usize> {
    /// The joints' upright frames, of scale 1, at the joints' places.
    joints: [Affine3A; N],
    /// How each stands in its bone.
    tilts: [Quat; N],
}

impl<const N: usize> UprightPose<N> {
    /// `scale` is the square of the joints' common scale.
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
    /// The links from joint i − 1 to joint i; none for joint 0.
    links: [Affine3A; N],
    /// Whether the first link, from the effector to joint 0, is more than the identity.
    has_first: bool,
    /// The sum of the squared steps from joint to joint, x, y and z apart.
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

    /// Whether the pose and the target meet the conditions; `axes` are the last joint's, `frames` the joints' upright frames,
    /// of a common scale whose square is one over `per_square`.
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
        // In front, and of lengths whose squares are plain numbers. NaN is none of these.
        ahead > 0.0 && square > 1e-12
    }
}

/// The inverse of a frame that is turned and scaled, by one over the square of its scale.
#[inline(always)]
fn inverse(frame: &Mat3A, per_square: f32) -> Mat3A {
    frame.transpose() * per_square
}

/// The product of two matrices. glam's own is not inlined.
#[inline(always)]
fn product(a: &Mat3A, b: &Mat3A) -> Mat3A {
    Mat3A::from_cols(*a * b.x_axis, *a * b.y_axis, *a * b.z_axis)
}

/// The product of a transposed matrix and a vector: the sums over its columns' products, by rows of those.
#[inline(always)]
fn transposed_product(m: &Mat3A, v: Vec3A) -> Vec3A {
    let rows = Mat3A::from_cols(m.x_axis * v, m.y_axis * v, m.z_axis * v).transpose();
    rows.x_axis + rows.y_axis + rows.z_axis
}

/// A vector turned back by a unit quaternion.
#[inline(always)]
pub(crate) fn unturned(turn: Quat, v: Vec3A) -> Vec3A {
    let axis = Vec3A::from_vec4(turn.into());
    let across = math::cross(v, axis) * 2.0;
    v + across * turn.w + math::cross(across, axis)
}

/// All angles of N joints in V vectors of four: each joint's pitch and heading in turn, 0 where there is none.
#[derive(Clone, Copy)]
struct Angles<const N: usize, const V: usize> {
    start: [Vec4; V],
    /// Where this frame may take them.
    lo: [Vec4; V],
    hi: [Vec4; V],
    /// The Jacobian.
    left: [Vec4; V],
    up: [Vec4; V],
    /// The dual point, the angles there, and which of them are free.
    lambda: [f32; 2],
    now: [Vec4; V],
    free: [BVec4A; V],
}

/// The angles after mending, and what follows from them.
struct Mended<const N: usize, const V: usize> {
    angles: Angles<N, V>,
    view: View,
    turns: [Quat; N],
}

/// Four lanes from pairs for the joints 2k and 2k + 1; 0 for a joint that there is not.
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

    /// Reads the angles; false where a joint is bound for somewhere.
    #[inline(always)]
    fn start(&mut self, joints: &[Joint; N]) -> bool {
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

    /// How far the angles get in a frame of `dt` seconds; false where that leaves one out of its range.
    #[inline(always)]
    fn bound(&mut self, lanes: &AllLanes, dt: f32) -> bool {
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

    /// Makes the linear model where the angles are; returns the residual there, `None` where it is not small.
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
        // The residual, then a row of derivatives by the declared angles, left and up.
        let mut out = [[0.0; 6]; N];
        let count = rig.angles;
        kernels.residual_jacobian(links, &target.to_array(), &sin_cos, &mut out.as_flattened_mut()[..2 + 2 * count]);
        let residual = [out[0][0], out[0][1]];
        // Above this the residual has to be stretched.
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

    /// Whether the dual's optimum moves an angle.
    #[inline(always)]
    fn moves(&self) -> bool {
        let mut moves = BVec4A::FALSE;
        each!(V, k => {
            moves |= (self.now[k] - self.start[k]).abs().cmpge(Vec4::splat(STILL_RAD));
        });
        moves.any()
    }

    /// Leaves the angles where they are, as far as their ranges let them.
    #[inline(always)]
    fn rest(&mut self) {
        each!(V, k => {
            self.now[k] = self.start[k].max(self.lo[k]).min(self.hi[k]);
        });
    }

    /// The optimum where the linear model is used again on what it missed, until that is fine. Rarely needed: apart, so
    /// that the other frames keep all of this in registers.
    #[cold]
    #[inline(never)]
    fn mended(
        mut self,
        rig: &Description<'_>,
        infos: &[JointInfo; N],
        links: Links<N>,
        first: Option<&[f32; 12]>,
        mut view: View,
    ) -> Option<Mended<N, V>> {
        let mut turns = [Quat::IDENTITY; N];
        for _ in 0..MENDINGS {
            if view.is_within(FINE_RAD) {
                break;
            }
            let at = self.now;
            self.place(&rig.lanes);
            self = self.after_steps(&rig.lanes, NEWTON_STEPS, view.residual(), &at)?;
            view = self.see(rig, infos, &links, first, &mut turns);
        }
        Some(Mended { angles: self, view, turns })
    }

    /// The dual's optimum by the Newton steps that are left after the first.
    #[cold]
    #[inline(never)]
    fn after_more_steps(self, lanes: &AllLanes, residual: [f32; 2]) -> Option<Self> {
        self.after_steps(lanes, NEWTON_STEPS - 1, residual, &self.start)
    }

    /// The dual's optimum by so many Newton steps at most, where the model has this residual at these angles; found when
    /// the same angles are free before and after a step.
    fn after_steps(mut self, lanes: &AllLanes, steps: usize, residual: [f32; 2], at: &[Vec4; V]) -> Option<Self> {
        for _ in 0..steps {
            if self.step(lanes, residual, at)? {
                return Some(self);
            }
        }
        None
    }

    /// One Newton step; tells whether the same angles are free as before.
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
        if !(square(self.lambda) < DEAREST * DEAREST) {
            return None;
        }
        Some(self.place(lanes))
    }

    /// Puts the angles where the dual point has them; tells whether the same are free as before.
    #[inline(always)]
    fn place(&mut self, lanes: &AllLanes) -> bool {
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

    /// The target as the effector sees it with the angles as they are now, and what the joints add; `first` is the link
    /// from the effector to joint 0, where it is more than the identity.
    #[inline(always)]
    fn see(
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

    /// The joints with an angle at an end of its range.
    #[inline(always)]
    fn limits_met(&self, lanes: &AllLanes) -> JointSet {
        // A bit for each angle: of joint i, bit 2i is the pitch's and bit 2i + 1 the heading's.
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

/// The numbers 2i and 2i + 1 of those that are three pairs a row.
#[inline(always)]
fn pair<const N: usize>(rows: &[[f32; 6]; N], i: usize) -> [f32; 2] {
    let row = &rows[i / 3];
    [row[2 * (i % 3)], row[2 * (i % 3) + 1]]
}

/// A vector of the bone's space along its axes, which are columns.
#[inline(always)]
pub(crate) fn view(axes: &Mat3A, v: Vec3A) -> View {
    let [forward, left, up] = transposed_product(axes, v).to_array();
    View { forward, left, up }
}

/// A vector's squared length.
#[inline(always)]
fn square([x, y]: [f32; 2]) -> f32 {
    x * x + y * y
}

/// The sum of the lanes, in one order on every machine.
#[inline(always)]
fn sum(v: Vec4) -> f32 {
    let [a, b, c, d] = v.to_array();
    (a + c) + (b + d)
}

/// [`sum`] of four vectors at a time.
#[inline(always)]
fn sums([a, b, c, d]: [Vec4; 4]) -> [f32; 4] {
    let pairs = |v: Vec4, w: Vec4| Vec4::new(v.x, v.y, w.x, w.y) + Vec4::new(v.z, v.w, w.z, w.w);
    let (v, w) = (pairs(a, b), pairs(c, d));
    (Vec4::new(v.x, v.z, w.x, w.z) + Vec4::new(v.y, v.w, w.y, w.w)).to_array()
}
