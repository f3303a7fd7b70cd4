//! The frame that nearly every frame is: the pose rigid and of one scale, the target in front and within this frame's
//! reach, all of the weight on it. The same optimum as [`exact`](crate::exact)'s, on flat arrays and four angles at a
//! time, without what the other frames need; it gives up, having moved nothing, wherever anything is out of the ordinary.

use core::f32::consts::PI;

use glam::{Affine3A, BVec4A, Mat3A, Quat, Vec3A, Vec4};

use crate::chain::{self, Level};
use crate::dual::{DEAREST, STRAINED};
use crate::exact::{ENOUGH_RAD, STILL_RAD};
use crate::joint::{Side, turn};
use crate::limits::AT_LIMIT_RAD;
use crate::pose::Animated;
use crate::rig::along;
use crate::scalar::{Scalar, Sparse};
use crate::view::{Stretch, View};
use crate::{AimRig, JointInfo, JointSet, Outcome, Settings, Status, math, trig};

/// An angle to the target that needs no mending, radians (2.6e-3°).
const FINE_RAD: f32 = 4.5e-5;
/// How often the linear model is used again on what it missed.
const MENDINGS: usize = 2;
/// How many Newton steps its dual takes at most.
const NEWTON_STEPS: usize = 4;
/// Nearer to the effector than this part of the rig's extent a target is out of the ordinary.
const NEAR: f32 = 1e-3;
/// A residual from which joints that have to move do.
const AT_REST: f32 = 1e-4;
/// What sums begin with: added to a number it leaves the very number, which 0 does not, and so costs nothing.
const NOTHING: f32 = -0.0;

/// Does something for every joint, from the effector inward or (`rev`) outward. Written out for short chains, so that
/// what was declared of each joint is a constant to the compiler, which does not unroll loops as long as these.
macro_rules! each_joint {
    ($count:expr, $index:ident => $body:block) => {
        each_joint!($count, $index => $body, (0, 1, 2, 3), (0..$count))
    };
    ($count:expr, rev $index:ident => $body:block) => {
        each_joint!($count, $index => $body, (3, 2, 1, 0), (0..$count).rev())
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

/// Aims for one frame of `dt` seconds, positive, if it is an ordinary one. The solver is the exact one, without a second
/// eye.
#[inline]
pub(crate) fn aim<R: AimRig>(
    rig: &mut R,
    pose_ps: &Animated<'_>,
    target_ps: Vec3A,
    dt: f32,
    settings: &Settings,
    level: Level,
) -> Option<Outcome> {
    let count = rig.joint_infos().len();
    let pose = pose_ps.joints.get(..count)?;
    if !(count > 0 && settings.weight >= 1.0 && settings.effector == 0 && rig.joint_infos().iter().all(is_plain)) {
        return None;
    }
    let mut body = Body::new(rig);
    let mut angles = Angles::new(rig);
    if !(angles.read(rig) && body.read(rig, pose, target_ps, level)) {
        return None;
    }
    let residual = angles.linearise(rig, &body)?;
    if !angles.bound(rig, dt) {
        return None;
    }
    let view = angles.solve(rig, &body, residual)?;
    // So small an angle is its tangent, and its cosine 1, to the last bit.
    let remaining = view.tangent();
    if !(remaining <= settings.effective_tolerance() && view.forward * view.forward > body.near) {
        return None;
    }
    angles.keep(rig, &body);
    Some(Outcome {
        aim: 1.0,
        remaining,
        status: Status::Reached,
        at_limit: angles.limits_met(rig),
        recovering: JointSet::EMPTY,
        pair_remaining: None,
    })
}

/// Whether a joint's ranges are what was declared, and within half a turn. Known when compiling for a derived rig.
#[inline(always)]
pub(crate) fn is_plain(info: &JointInfo) -> bool {
    let within = |range: Option<[f32; 2]>| range.is_none_or(|[lo, hi]| -PI <= lo && lo <= hi && hi <= PI);
    !info.absolute && info.narrowing == 0.0 && within(info.pitch) && within(info.heading)
}

/// The pose: rigid links, and the target, in lengths of the bones' own spaces.
struct Body<R: AimRig> {
    links: R::Array<Affine3A>,
    tilts: R::Array<Quat>,
    /// The target in the innermost joint's levelled space.
    target: Vec3A,
    side: Side,
    /// How near to the effector an ordinary target may be; squared.
    near: f32,
}

impl<R: AimRig> Body<R> {
    #[inline(always)]
    fn new(rig: &R) -> Self {
        Self {
            links: rig.array(Affine3A::IDENTITY),
            tilts: rig.array(Quat::IDENTITY),
            target: Vec3A::ZERO,
            side: Side::None,
            near: 0.0,
        }
    }

    /// Whether the pose is an ordinary one.
    #[inline(always)]
    fn read(&mut self, rig: &R, pose: &[Affine3A], target: Vec3A, level: Level) -> bool {
        let infos = rig.joint_infos();
        let count = infos.len();
        let Some(scale) = chain::common_scale(pose) else { return false };
        let mut frames = rig.array(Mat3A::IDENTITY);
        for (frame, joint) in frames.as_mut().iter_mut().zip(pose) {
            *frame = joint.matrix3;
        }
        // The inverse of a frame that is turned and scaled is its transpose, divided by this.
        let mut square_scale = scale;
        if infos.iter().any(JointInfo::is_level) {
            // Lengths are the pose's then.
            square_scale = 1.0;
            let per_scale = 1.0 / math::sqrt(scale);
            frames.as_mut().iter_mut().for_each(|frame| *frame *= per_scale);
            chain::upright(infos, 0, level, frames.as_mut(), self.tilts.as_mut());
        }
        let (frames, per_square) = (frames.as_ref(), 1.0 / square_scale);
        let links = self.links.as_mut();
        let mut squares = Vec3A::splat(NOTHING);
        let origin = rig.effector().origin;
        if origin != [0.0; 3] {
            let offset = pose[0].transform_vector3a(origin.into());
            squares += offset * offset;
            links[0].translation = inverse(&frames[0], per_square) * offset;
        }
        let tilt = self.tilts.as_ref()[0];
        if !chain::is_identity(tilt) {
            links[0].matrix3 = Mat3A::from_quat(tilt.conjugate());
        }
        let to_target = target - pose[count - 1].translation;
        each_joint!(count, index => {
            let outward = inverse(&frames[index], per_square);
            if index > 0 {
                let step = pose[index - 1].translation - pose[index].translation;
                squares += step * step;
                links[index] = Affine3A { matrix3: outward * frames[index - 1], translation: outward * step };
            }
            if index + 1 == count {
                self.target = outward * to_target;
            }
        });
        let axes = &infos[count - 1].axes;
        self.side = Side::of(along(axes.left, self.target));
        let square = squares.x + squares.y + squares.z;
        self.near = square * per_square * (NEAR * NEAR);
        let far = to_target.dot(to_target);
        // In front, no mere direction, and of lengths whose squares are plain numbers. NaN is none of these.
        along(axes.forward, self.target) > 0.0 && far < 1e8 * square && square > 1e-12
    }
}

/// The inverse of a frame that is turned and scaled, by one over the square of its scale.
#[inline(always)]
fn inverse(frame: &Mat3A, per_square: f32) -> Mat3A {
    frame.transpose() * per_square
}

/// A vector turned back by a unit quaternion.
#[inline(always)]
pub(crate) fn unturned(turn: Quat, v: Vec3A) -> Vec3A {
    let axis = Vec3A::from_vec4(turn.into());
    let across = math::cross(v, axis) * 2.0;
    v + across * turn.w + math::cross(across, axis)
}

/// All angles, four a vector: each joint's pitch and heading in turn, 0 where there is none.
struct Angles<R: AimRig> {
    /// Where they are, and the sines and cosines of that.
    start: R::Array<Vec4>,
    sin_cos: R::Array<[f32; 4]>,
    /// Where this frame may take them.
    lo: R::Array<Vec4>,
    hi: R::Array<Vec4>,
    /// Half of the ease: half of the way to where they rest is left to later frames, as [`exact`](crate::exact) has it.
    ease: R::Array<Vec4>,
    /// The Jacobian.
    left: R::Array<Vec4>,
    up: R::Array<Vec4>,
    /// The dual point, the angles there, which of them are free, and joint by joint what follows from them.
    lambda: [f32; 2],
    now: R::Array<Vec4>,
    free: R::Array<BVec4A>,
    sin: R::Array<Vec4>,
    cos: R::Array<Vec4>,
    halves: R::Array<trig::Halves>,
    turns: R::Array<Quat>,
}

impl<R: AimRig> Angles<R> {
    #[inline(always)]
    fn new(rig: &R) -> Self {
        let empty = || rig.array(Vec4::ZERO);
        Self {
            start: empty(),
            sin_cos: rig.array([0.0; 4]),
            lo: empty(),
            hi: empty(),
            ease: empty(),
            left: empty(),
            up: empty(),
            lambda: [0.0; 2],
            now: empty(),
            free: rig.array(BVec4A::FALSE),
            sin: empty(),
            cos: empty(),
            halves: rig.array([0.0; 4]),
            turns: rig.array(Quat::IDENTITY),
        }
    }

    /// Whether the joints are as an ordinary frame finds them.
    #[inline(always)]
    fn read(&mut self, rig: &mut R) -> bool {
        let count = rig.joint_infos().len();
        let mut start = rig.array([0.0; 4]);
        each_joint!(count, index => {
            let Some(joint) = rig.joint_mut(index) else { return false };
            if !joint.is_halved() {
                return false;
            }
            if joint.bound_for.is_some() | joint.pair.is_some() {
                return false;
            }
            start.as_mut()[index / 2][2 * (index % 2)] = joint.pitch;
            start.as_mut()[index / 2][2 * (index % 2) + 1] = joint.heading;
            self.sin_cos.as_mut()[index] = trig::doubled(joint.halves);
            if index + 1 == count {
                if joint.behind || joint.memory.strain > 0.0 {
                    return false;
                }
                self.lambda = joint.memory.lambda;
            }
        });
        for k in 0..self.vectors() {
            self.start.as_mut()[k] = Vec4::from_array(start.as_ref()[k]);
        }
        true
    }

    /// How far the angles get in a frame of `dt` seconds, and how easily; whether that brings all into their ranges.
    #[inline(always)]
    fn bound(&mut self, rig: &R, dt: f32) -> bool {
        let infos = rig.joint_infos();
        let willing = infos.iter().fold(f32::INFINITY, |least, info| least.min(info.comfort));
        let mut outside = BVec4A::FALSE;
        for k in 0..self.vectors() {
            // Places without an angle stay 0.
            let [mut least, mut most, mut ease, mut rate] = [[0.0; 4]; 4];
            for place in 4 * k..(4 * k + 4).min(2 * infos.len()) {
                let (info, lane) = (&infos[place / 2], place - 4 * k);
                [least[lane], most[lane]] = declared(info, place).unwrap_or([0.0; 2]);
                ease[lane] = 0.5 * (willing / info.comfort).max(1e-6).min(1.0);
                rate[lane] = info.rate.max(0.0);
            }
            let [least, most, ease, rate] = [least, most, ease, rate].map(Vec4::from_array);
            let (start, step) = (self.start.as_ref()[k], rate * dt);
            let (lo, hi) = (least.max(start - step), most.min(start + step));
            outside |= lo.cmpgt(hi);
            (self.lo.as_mut()[k], self.hi.as_mut()[k], self.ease.as_mut()[k]) = (lo, hi, ease);
        }
        !outside.any()
    }

    /// The number of vectors.
    #[inline(always)]
    fn vectors(&self) -> usize {
        self.start.as_ref().len().div_ceil(2)
    }

    /// Makes the linear model where the angles are; returns the residual there.
    #[inline(always)]
    fn linearise(&mut self, rig: &R, body: &Body<R>) -> Option<[f32; 2]> {
        let infos = rig.joint_infos();
        let mut links = rig.array(Sparse::IDENTITY);
        let mut sin_cos = rig.array([Sparse::ZERO; 4]);
        each_joint!(infos.len(), index => {
            if index > 0 || rig.effector().origin != [0.0; 3] || infos[0].is_level() {
                links.as_mut()[index] = Sparse::link(&body.links.as_ref()[index]);
            }
            let [sin_p, cos_p, sin_h, cos_h] = self.sin_cos.as_ref()[index];
            sin_cos.as_mut()[index] = [Sparse::of(sin_p), Sparse::of(cos_p), Sparse::of(sin_h), Sparse::of(cos_h)];
        });
        let mut rows = 0;
        for info in infos {
            rows += usize::from(info.pitch.is_some()) + usize::from(info.heading.is_some());
        }
        let mut out = rig.array([Sparse::ZERO; 6]);
        let out = &mut out.as_mut().as_flattened_mut()[..2 + 2 * rows];
        let [x, y, z] = body.target.to_array();
        let target = [Sparse::of(x), Sparse::of(y), Sparse::of(z)];
        rig.chain_residual_jacobian::<Sparse>(links.as_ref(), &target, sin_cos.as_ref(), out);
        let residual = [out[0].value(), out[1].value()];
        let (left, up) = out[2..].split_at(rows);
        let mut row = 0;
        for k in 0..self.vectors() {
            let (left_4, up_4);
            if rows == 2 * infos.len() && rows >= 4 * k + 4 {
                let at = |row: &[Sparse], lane: usize| row[4 * k + lane].value();
                let four = |row: &[Sparse]| Vec4::new(at(row, 0), at(row, 1), at(row, 2), at(row, 3));
                (left_4, up_4) = (four(left), four(up));
                row += 4;
            } else {
                let [mut lefts, mut ups] = [[0.0; 4]; 2];
                for place in 4 * k..(4 * k + 4).min(2 * infos.len()) {
                    if declared(&infos[place / 2], place).is_some() {
                        lefts[place - 4 * k] = left[row].value();
                        ups[place - 4 * k] = up[row].value();
                        row += 1;
                    }
                }
                (left_4, up_4) = (Vec4::from_array(lefts), Vec4::from_array(ups));
            }
            self.left.as_mut()[k] = left_4;
            self.up.as_mut()[k] = up_4;
        }
        // A residual that is stretched is out of the ordinary.
        (square(residual) < Stretch::SMALL * Stretch::SMALL).then_some(residual)
    }

    /// The optimum; returns how the target is seen then.
    #[inline(always)]
    fn solve(&mut self, rig: &R, body: &Body<R>, residual: [f32; 2]) -> Option<View> {
        let mut at = rig.array(Vec4::ZERO);
        at.as_mut().copy_from_slice(self.start.as_ref());
        self.newton(residual, at.as_ref())?;
        // Joints that would hardly move stay exactly where they are.
        let rests = square(residual) < AT_REST * AT_REST && !self.moves();
        if rests {
            self.stay();
        }
        let mut view = self.see(rig, body);
        if view.is_within(FINE_RAD) {
            return Some(view);
        }
        // The linear model is used again on what it missed until that is fine. Rarely: a loop that began above would
        // cost every frame more.
        for _ in 0..MENDINGS {
            if rests || view.is_within(FINE_RAD) {
                break;
            }
            at.as_mut().copy_from_slice(self.now.as_ref());
            self.newton(view.residual(), at.as_ref())?;
            view = self.see(rig, body);
        }
        view.is_within(ENOUGH_RAD).then_some(view)
    }

    #[inline(always)]
    fn moves(&self) -> bool {
        let mut moves = BVec4A::FALSE;
        for k in 0..self.vectors() {
            let change = (self.now.as_ref()[k] - self.start.as_ref()[k]).abs();
            moves |= change.cmpge(Vec4::splat(STILL_RAD));
        }
        moves.any()
    }

    /// Puts the angles where they were, or where their ranges begin.
    #[inline(always)]
    fn stay(&mut self) {
        for k in 0..self.vectors() {
            self.now.as_mut()[k] = self.start.as_ref()[k].max(self.lo.as_ref()[k]).min(self.hi.as_ref()[k]);
        }
    }

    /// The dual's optimum by Newton steps, where the model has this residual at these angles; found when the same angles
    /// are free before and after a step. As a rule the first one does.
    #[inline(always)]
    fn newton(&mut self, residual: [f32; 2], at: &[Vec4]) -> Option<()> {
        self.place();
        if self.step(residual, at)? {
            return Some(());
        }
        for _ in 1..NEWTON_STEPS {
            if self.step(residual, at)? {
                return Some(());
            }
        }
        None
    }

    /// One Newton step; tells whether the same angles are free as before.
    #[inline(always)]
    fn step(&mut self, residual: [f32; 2], at: &[Vec4]) -> Option<bool> {
        let [mut left, mut up, mut ll, mut lu, mut uu] = [Vec4::splat(NOTHING); 5];
        for (k, at) in at.iter().enumerate().take(self.vectors()) {
            let (jl, ju) = (self.left.as_ref()[k], self.up.as_ref()[k]);
            let change = *at - self.now.as_ref()[k];
            left += jl * change;
            up += ju * change;
            let ease = Vec4::select(self.free.as_ref()[k], self.ease.as_ref()[k], Vec4::ZERO);
            let (el, eu) = (ease * jl, ease * ju);
            ll += el * jl;
            lu += el * ju;
            uu += eu * ju;
        }
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
        (square(self.lambda) < DEAREST * DEAREST).then(|| self.place())
    }

    /// Puts the angles where the dual point has them; tells whether the same are free as before.
    #[inline(always)]
    fn place(&mut self) -> bool {
        let [x, y] = self.lambda.map(Vec4::splat);
        let mut same = true;
        for k in 0..self.vectors() {
            let pull = self.left.as_ref()[k] * x + self.up.as_ref()[k] * y;
            let wanted = self.start.as_ref()[k] * 0.5 + self.ease.as_ref()[k] * pull;
            let held = wanted.max(self.lo.as_ref()[k]).min(self.hi.as_ref()[k]);
            let free = wanted.cmpeq(held);
            same &= free.bitmask() == self.free.as_ref()[k].bitmask();
            self.free.as_mut()[k] = free;
            self.now.as_mut()[k] = held;
        }
        same
    }

    /// The target as the effector sees it with the angles as they are now.
    #[inline(always)]
    fn see(&mut self, rig: &R, body: &Body<R>) -> View {
        let (infos, links) = (rig.joint_infos(), body.links.as_ref());
        let count = infos.len();
        for k in 0..self.vectors() {
            let (sin, cos) = trig::half_sin_cos_4(self.now.as_ref()[k]);
            self.sin.as_mut()[k] = sin;
            self.cos.as_mut()[k] = cos;
        }
        let mut target = body.target;
        each_joint!(count, rev index => {
            let (sin, cos) = (self.sin.as_ref()[index / 2].to_array(), self.cos.as_ref()[index / 2].to_array());
            let (pitch, heading) = (2 * (index % 2), 2 * (index % 2) + 1);
            let halves = [sin[pitch], cos[pitch], sin[heading], cos[heading]];
            let turn = turn(&infos[index].axes, &infos[index].planes, halves);
            self.halves.as_mut()[index] = halves;
            self.turns.as_mut()[index] = turn;
            target = unturned(turn, target);
            if index > 0 || rig.effector().origin != [0.0; 3] {
                target -= links[index].translation;
            }
            if index > 0 || !chain::is_identity(body.tilts.as_ref()[0]) {
                target = links[index].matrix3.transpose() * target;
            }
        });
        let [forward, left, up] = rig.effector().along_axes(&infos[0].axes, target);
        View { forward, left, up }
    }

    /// Leaves the angles in the joints, with what later calls would have to make of them.
    #[inline(always)]
    fn keep(&self, rig: &mut R, body: &Body<R>) {
        let count = rig.joint_infos().len();
        each_joint!(count, index => {
            let angles = self.now.as_ref()[index / 2].to_array();
            let Some(joint) = rig.joint_mut(index) else { return };
            let angles = [angles[2 * (index % 2)], angles[2 * (index % 2) + 1]];
            joint.put(angles, self.halves.as_ref()[index], self.turns.as_ref()[index], body.tilts.as_ref()[index]);
            if index + 1 == count {
                joint.side = body.side;
                joint.memory.lambda = self.lambda;
                joint.memory.blocked_s = 0.0;
            }
        });
    }

    /// The joints with an angle at an end of its range.
    #[inline(always)]
    fn limits_met(&self, rig: &R) -> JointSet {
        let mut met = JointSet::EMPTY;
        let infos = rig.joint_infos();
        for (k, now) in self.now.as_ref().iter().enumerate().take(self.vectors()) {
            let (mut lo, mut hi) = ([f32::NEG_INFINITY; 4], [f32::INFINITY; 4]);
            for place in 4 * k..(4 * k + 4).min(2 * infos.len()) {
                let info = &infos[place / 2];
                if let Some([least, most]) = declared(info, place) {
                    (lo[place - 4 * k], hi[place - 4 * k]) = (least + AT_LIMIT_RAD, most - AT_LIMIT_RAD);
                }
            }
            let at_limit = now.cmple(Vec4::from_array(lo)) | now.cmpge(Vec4::from_array(hi));
            if at_limit.any() {
                for index in 2 * k..(2 * k + 2).min(infos.len()) {
                    if at_limit.bitmask() >> (2 * (index % 2)) & 3 != 0 {
                        met.insert(index);
                    }
                }
            }
        }
        met
    }
}

/// The range of the angle at a place: each joint's pitch and heading in turn.
#[inline(always)]
fn declared(info: &JointInfo, place: usize) -> Option<[f32; 2]> {
    if place % 2 == 0 { info.pitch } else { info.heading }
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
