//! Sines, cosines and arctangents by our own polynomials: the same bits on every machine, in debug and release builds,
//! without library calls. Sines and cosines are finite for every input; the arctangent of NaN is NaN.
//!
//! Corrections are quaternions, so half angles are needed: for an angle within ±180° the half lies within ±90°, where
//! one polynomial suffices. The coefficients minimise the largest error there (the relative one for sines and
//! arctangents), rounded to f32.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::{BVec4A, Vec4, Vec4Swizzles};

use crate::math;
use crate::math::Bounded;
use aim_model::Scalar;

/// sin(p/2), cos(p/2), sin(h/2), cos(h/2) of a pitch p and a heading h.
pub(crate) type Halves = Vec4;

/// Coefficients of the sine after x, from x³.
const SIN: [f32; 4] = [-0.166_666_61, 0.008_333_088, -0.000_198_111_11, 2.608_929_2e-6];
/// Coefficients of the cosine after 1 − x²/2, from x⁴.
const COS: [f32; 4] = [0.041_666_657, -0.001_388_856_9, 2.476_930_2e-5, -2.619_379e-7];
/// Coefficients of the arctangent after x, from x³.
const ATAN: [f32; 8] = [
    -0.333_331_67,
    0.199_941_37,
    -0.142_142_07,
    0.106_789_31,
    -0.075_805_56,
    0.043_553_248,
    -0.016_580_988,
    0.002_974_536_7,
];
/// Bound below which the arctangent of a number is the number itself, to rounding: x³/3 is less than half a unit of
/// x's last place.
const SMALL: f32 = 1.0 / 4096.0;

/// Returns sine and cosine of an angle within ±90°; their squares add up to 1 within 2e-7.
#[cfg_attr(not(aim_small), inline(always))]
fn within_quarter(x: f32) -> (f32, f32) {
    let xx = x * x;
    let sin = xx * (SIN[0] + xx * (SIN[1] + xx * (SIN[2] + xx * SIN[3])));
    let cos = xx * (-0.5 + xx * (COS[0] + xx * (COS[1] + xx * (COS[2] + xx * COS[3]))));
    (x + x * sin, 1.0 + cos)
}

/// Returns sine and cosine of half an angle, radians. Beyond ±180° the angle is first wrapped by whole turns.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn half_sin_cos(angle_rad: f32) -> (f32, f32) {
    half_sin_cos_within(math::wrap_pi(angle_rad))
}

/// Returns sine and cosine of half an angle within ±180°, radians.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn half_sin_cos_within(angle_rad: f32) -> (f32, f32) {
    within_quarter(0.5 * angle_rad)
}

/// Returns sine and cosine of half an angle, given the tangent of that half.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn half_by_tangent(half_tangent: f32) -> (f32, f32) {
    let cos = 1.0 / <f32 as Scalar>::sqrt(1.0 + half_tangent * half_tangent);
    (half_tangent * cos, cos)
}

/// Returns sines and cosines of half of four angles within ±180°, radians. Bit-identical to four scalar calls.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn half_sin_cos_4(angles_rad: Vec4) -> (Vec4, Vec4) {
    let splat = Vec4::splat;
    let x = angles_rad * 0.5;
    let xx = x * x;
    let sin = xx * splat(SIN[3]);
    let sin = xx * (sin + splat(SIN[2]));
    let sin = xx * (sin + splat(SIN[1]));
    let sin = x + x * (xx * (sin + splat(SIN[0])));
    let cos = xx * splat(COS[3]);
    let cos = xx * (cos + splat(COS[2]));
    let cos = xx * (cos + splat(COS[1]));
    let cos = xx * (cos + splat(COS[0]));
    let cos = splat(1.0) + xx * (cos + splat(-0.5));
    (sin, cos)
}

/// Returns sine and cosine of an angle, radians.
pub(crate) fn sin_cos(angle_rad: f32) -> (f32, f32) {
    let (sin, cos) = half_sin_cos(angle_rad);
    (2.0 * sin * cos, 1.0 - 2.0 * sin * sin)
}

/// Returns the sines and the cosines of four angles within ±180°, radians.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn sin_cos_4(angles_rad: Vec4) -> [Vec4; 2] {
    let (sin, cos) = half_sin_cos_4(angles_rad);
    [sin * cos * 2.0, Vec4::ONE - sin * sin * 2.0]
}

/// Returns sines and cosines of half a pitch and half a heading, radians.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn halves(pitch_rad: f32, heading_rad: f32) -> Halves {
    let (sin, cos) = half_sin_cos_4(Vec4::new(math::wrap_pi(pitch_rad), math::wrap_pi(heading_rad), 0.0, 0.0));
    Vec4::new(sin.x, cos.x, sin.y, cos.y)
}

/// Returns sines and cosines of half a pitch and half a heading, radians, which are given as heading and pitch in the
/// first two lanes.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn halves_of(angles_rad: Vec4) -> Halves {
    let angles = angles_rad.yyxx();
    if !angles.abs().cmple(Vec4::splat(PI)).all() {
        return halves_beyond(angles.x, angles.z);
    }
    // Sines and cosines by one polynomial. The first coefficient, 0, gives both the same degree.
    let term = |power: usize, cos: f32| {
        let sin = if power < 4 { SIN[power] } else { 0.0 };
        Vec4::new(sin, cos, sin, cos)
    };
    let x = angles * 0.5;
    let xx = x * x;
    let sum = xx * term(4, COS[3]) + term(3, COS[2]);
    let sum = xx * sum + term(2, COS[1]);
    let sum = xx * sum + term(1, COS[0]);
    let sum = xx * (xx * sum + term(0, -0.5));
    let leading = Vec4::select(BVec4A::new(true, false, true, false), x, Vec4::ONE);
    leading + leading * sum
}

/// Returns sines and cosines of the halves of two pairs of heading and pitch, radians, given one pair after the other.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn halves_of_both(angles_rad: Vec4) -> [Halves; 2] {
    if !angles_rad.abs().cmple(Vec4::splat(PI)).all() {
        return [halves_beyond(angles_rad.y, angles_rad.x), halves_beyond(angles_rad.w, angles_rad.z)];
    }
    let (sin, cos) = half_sin_cos_4(angles_rad.yxwz());
    [Vec4::new(sin.x, cos.x, sin.y, cos.y), Vec4::new(sin.z, cos.z, sin.w, cos.w)]
}

#[cold]
#[inline(never)]
fn halves_beyond(pitch_rad: f32, heading_rad: f32) -> Halves {
    halves(pitch_rad, heading_rad)
}

/// Returns sin p, cos p, sin h, cos h, as kernels take them, from the sines and cosines of the halves.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn doubled(halves: Halves) -> Vec4 {
    halves.xxzz() * halves.yxwz() * Vec4::new(2.0, -2.0, 2.0, -2.0) + Vec4::new(0.0, 1.0, 0.0, 1.0)
}

/// Returns the angle of the point (x, y), radians, −π…π, with the sign of y; 0 for the origin.
pub(crate) fn atan2(y: f32, x: f32) -> f32 {
    let (across, along) = (y.abs(), x.abs());
    let turn = if across.at_least(along) > 0.0 { within_right_angle(across, along) } else { along };
    let turn = if x < 0.0 { PI - turn } else { turn };
    turn.copysign(y)
}

/// Returns the angles of four points (x, y), radians. For coordinates that are normal numbers or 0, bit-identical to
/// four scalar calls.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn atan2_of_4(y: Vec4, x: Vec4) -> Vec4 {
    let (across, along) = (y.abs(), x.abs());
    // The lower bound gives 0 for the origin.
    let t = across.min(along) / across.max(along).max(Vec4::splat(f32::MIN_POSITIVE));
    let tt = t * t;
    let turn = t + t * tt * series_of_4(tt);
    // |0 − turn| is turn: these select in fewer instructions than `select` of two numbers.
    let turn = (Vec4::select(across.cmpgt(along), Vec4::splat(FRAC_PI_2), Vec4::ZERO) - turn).abs();
    (Vec4::select(x.cmplt(Vec4::ZERO), Vec4::splat(PI), Vec4::ZERO) - turn).copysign(y)
}

/// Returns the angle of a point other than the origin whose coordinates are not negative.
#[cfg_attr(not(aim_small), inline(always))]
fn within_right_angle(across: f32, along: f32) -> f32 {
    let (small, large) = if across > along { (along, across) } else { (across, along) };
    let t = small / large;
    let turn = atan_within(t);
    if across > along { FRAC_PI_2 - turn } else { turn }
}

/// Returns the angle of the point (x, y), y ≥ 0, which is usually near the positive x axis. Bit-identical to [`atan2`].
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn small_atan2(y: f32, x: f32) -> f32 {
    match y / x {
        t if x > y && t < SMALL => t,
        t if x > y => atan_within(t),
        _ => atan2(y, x),
    }
}

/// Returns the angle, radians, whose half has this tangent: twice the arctangent of a number within ±1.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn twice_atan(half_tangent: f32) -> f32 {
    2.0 * atan_within(half_tangent)
}

/// Returns twice the arctangents of two numbers within ±1. Bit-identical to two scalar calls.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn twice_atan_of_both(half_tangents: [f32; 2]) -> [f32; 2] {
    atans_within(half_tangents).map(|turn| 2.0 * turn)
}

/// Returns the arctangents of two numbers within ±1.
#[cfg_attr(not(aim_small), inline(always))]
fn atans_within([a, b]: [f32; 2]) -> [f32; 2] {
    let t = Vec4::new(a, b, a, b);
    let tt = t * t;
    let [a, b, ..] = (t + t * tt * series_of_4(tt)).to_array();
    [a, b]
}

/// Returns the sums of the arctangent's series at four squares.
#[cfg_attr(not(aim_small), inline(always))]
fn series_of_4(squares: Vec4) -> Vec4 {
    let [rest @ .., last] = ATAN.map(Vec4::splat);
    rest.iter().rev().fold(last, |sum, &next| sum * squares + next)
}

/// Returns the arctangent of a number within ±1.
#[cfg_attr(not(aim_small), inline(always))]
fn atan_within(t: f32) -> f32 {
    let tt = t * t;
    let [rest @ .., last] = ATAN;
    t + t * tt * rest.iter().rev().fold(last, |sum, &next| sum * tt + next)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_agree_with_the_standard_library() {
        for step in -32_000_i16..=32_000 {
            let angle = f32::from(step) * 2e-4;
            let (sin, cos) = sin_cos(angle);
            let exact = f64::from(angle).sin_cos();
            // Wrapping subtracts a full turn rounded to f32.
            let error = if angle.abs() > PI { 2e-6 } else { 7e-7 };
            assert!((f64::from(sin) - exact.0).abs() < error, "{angle}: {sin}");
            assert!((f64::from(cos) - exact.1).abs() < error, "{angle}: {cos}");
            let (sin, cos) = half_sin_cos(angle);
            assert!((sin * sin + cos * cos - 1.0).abs() < 4e-7, "{angle}");
            for radius in [1e-20_f32, 1e-3, 1.0, 1e15] {
                let (y, x) = (radius * angle.sin(), radius * angle.cos());
                let exact = f64::from(y).atan2(f64::from(x));
                assert!((f64::from(atan2(y, x)) - exact).abs() < 4e-7, "{y}, {x}");
                let (ys, xs) = (Vec4::new(y, 0.5, -y, 0.0), Vec4::new(x, -2.0, x, 0.0));
                let one_by_one = [atan2(y, x), atan2(0.5, -2.0), atan2(-y, x), 0.0];
                assert_eq!(atan2_of_4(ys, xs).to_array(), one_by_one, "{y}, {x}");
            }
        }
        for step in -3141_i16..=3141 {
            let angle = f32::from(step) * 1e-3;
            let (sin, cos) = half_sin_cos_4(Vec4::new(0.1, angle, -angle, 3.0));
            assert_eq!((sin.y, cos.y), half_sin_cos(angle));
        }
        for step in -1000_i16..=1000 {
            let tangent = f32::from(step) * 1e-3;
            let angle = twice_atan(tangent);
            assert!((f64::from(angle) - 2.0 * f64::from(tangent).atan()).abs() < 4e-7, "{tangent}: {angle}");
            assert_eq!(twice_atan_of_both([tangent, 0.3]), [angle, twice_atan(0.3)]);
            let ((sin, cos), by_angle) = (half_by_tangent(tangent), half_sin_cos(angle));
            assert!((sin - by_angle.0).abs().at_least((cos - by_angle.1).abs()) < 4e-7, "{tangent}: {sin}, {cos}");
        }
        assert_eq!((half_by_tangent(0.0), twice_atan(0.0)), ((0.0, 1.0), 0.0));
        assert_eq!((half_sin_cos(0.0), atan2(0.0, 0.0), atan2(0.0, 1.0)), ((0.0, 1.0), 0.0, 0.0));
    }

    /// Small angles have a relative error as small as large ones.
    #[test]
    fn small_angles_have_small_relative_errors() {
        for exponent in 1..37 {
            let angle = 0.7 * 10.0_f32.powi(-exponent);
            assert!((sin_cos(angle).0 / angle - 1.0).abs() < 1e-2, "{angle}");
            assert!((atan2(angle, 1.0) / angle - 1.0).abs() < 1e-2, "{angle}");
        }
    }

    #[test]
    fn random_bits_give_bounded_results() {
        for bits in (0..=u32::MAX).step_by(65_521) {
            let x = f32::from_bits(bits);
            let (sin, cos) = sin_cos(x);
            assert!(sin.abs() < 1.000_001 && cos.abs() < 1.000_001, "{x}: {sin}, {cos}");
            for y in [0.0, 1.0, -1e30] {
                let angle = atan2(x, y);
                assert!(x.is_nan() || angle.abs() <= PI + 1e-6, "{x}, {y}: {angle}");
            }
        }
    }
}
