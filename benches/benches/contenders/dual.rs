//! The same functions by num-dual: the aim function written once more, in dual numbers.
//!
//! Each of the two formulations uses the kind of dual number that takes fewer instructions for it. In f32, the paper's
//! takes 334 with one `DualSVec` and 473 with two `Dual`s; the turned-back one takes 229 with two `Dual`s, whose common
//! parts the compiler merges, and 233 with `DualSVec`.

use aim_benches::Float;
use aim_benches::pose::JointPose;
use nalgebra::{Const, U1};
use num_dual::{Dual, DualNum, DualNumFloat, DualSVec};

/// An `f32` or `f64` that num-dual can differentiate as well.
pub trait Real: Float + DualNum<Primitive = Self> + DualNumFloat {}
impl Real for f32 {}
impl Real for f64 {}

/// One joint from its angles, as the paper formulates it: the effector is rotated forward into joint space.
#[inline(always)]
pub fn paper<S: Real>(pose: &JointPose<S>) -> [S; 3] {
    let [pitch, heading] = pose.angles;
    let (sin_p, cos_p) = DualSVec::<S, 2>::from_re(pitch).derivative(0).sin_cos();
    let (sin_h, cos_h) = DualSVec::<S, 2>::from_re(heading).derivative(1).sin_cos();
    let aim = effector_turned(&pose.link, &pose.target, [sin_p, cos_p, sin_h, cos_h]);
    let by = aim.eps.unwrap_generic(Const::<2>, U1);
    [aim.re, by[0], by[1]]
}

/// One joint from its angles, with the derivation's main simplification applied by hand: the target is rotated back
/// instead.
#[inline(always)]
pub fn turned_back<S: Real>(pose: &JointPose<S>) -> [S; 3] {
    let [pitch, heading] = pose.angles;
    let ((sin_p, cos_p), (sin_h, cos_h)) = (Float::sin_cos(pitch), Float::sin_cos(heading));
    let aim = |sin_cos| target_turned(&pose.link, &pose.target, sin_cos);
    let fixed = Dual::from_re;
    let by_pitch = aim([Dual::new(sin_p, cos_p), Dual::new(cos_p, -sin_p), fixed(sin_h), fixed(cos_h)]);
    let by_heading = aim([fixed(sin_p), fixed(cos_p), Dual::new(sin_h, cos_h), Dual::new(cos_h, -sin_h)]);
    [by_pitch.re, by_pitch.eps, by_heading.eps]
}

#[inline(always)]
fn effector_turned<S: Real, D: DualNum<Primitive = S> + Copy>(link: &[S; 12], t: &[S; 3], sin_cos: [D; 4]) -> D {
    let [fx, fy, fz] = turn([link[3], link[4], link[5]], sin_cos);
    let [ox, oy, oz] = turn([link[9], link[10], link[11]], sin_cos);
    let (dx, dy, dz) = (-ox + t[0], -oy + t[1], -oz + t[2]);
    (dx * fx + dy * fy + dz * fz) / (dx * dx + dy * dy + dz * dz).sqrt()
}

#[inline(always)]
fn turn<S: Real, D: DualNum<Primitive = S> + Copy>([x, y, z]: [S; 3], [sp, cp, sh, ch]: [D; 4]) -> [D; 3] {
    let (u, v) = (cp * x + sp * y, cp * y - sp * x);
    [u, v * ch - sh * z, v * sh + ch * z]
}

#[inline(always)]
fn target_turned<S: Real, D: DualNum<Primitive = S> + Copy>(link: &[S; 12], t: &[S; 3], sin_cos: [D; 4]) -> D {
    let [sp, cp, sh, ch] = sin_cos;
    let (w, z) = (ch * t[1] + sh * t[2], ch * t[2] - sh * t[1]);
    let (x, y) = (cp * t[0] - w * sp, sp * t[0] + w * cp);
    let (dx, dy, dz) = (x - link[9], y - link[10], z - link[11]);
    (dx * link[3] + dy * link[4] + dz * link[5]) / (dx * dx + dy * dy + dz * dz).sqrt()
}
