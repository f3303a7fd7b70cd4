//! Powers, whole numbers and names mean the same in a companion as in Rust.

use aim::differentiate;

#[differentiate(wrt(x, p))]
fn power(x: f64, p: f64) -> f64 {
    x.powf(p)
}

#[differentiate(wrt(x))]
fn whole_power(x: f64, n: i32) -> f64 {
    x.powf(n as f64)
}

#[differentiate(wrt(x))]
fn power_by_branch(x: f64, y: f64) -> f64 {
    let p = if x < -1.0 { 2.0 } else { 3.0 };
    (x + y).powf(p)
}

/// The derivative by the exponent too, for negative bases where it exists.
#[test]
fn slopes_of_powers_of_any_base() {
    for x in [-2.5, -2.0, -1.0, -0.25, 0.25, 1.0, 3.0_f64] {
        for n in [-3, -2, -1, 0, 1, 2, 3, 4, 21] {
            let p = f64::from(n);
            let slope = p * x.powi(n - 1);
            let near = |found: f64| (found - slope).abs() <= 1e-12 * slope.abs();
            let (value, (by_x, by_p)) = power_gradient(x, p);
            assert!(value == power(x, p) && near(by_x), "{x} to {n}: {by_x} instead of {slope}");
            let by_exponent = if x > 0.0 { value * x.ln() } else { 0.0 };
            assert!((by_p - by_exponent).abs() <= 1e-12 * by_exponent.abs(), "{x} to {n}: {by_p} by the exponent");
            assert!(near(whole_power_gradient(x, n).1.0), "{x} to the whole number {n}");
        }
    }
    // At 0 the slope of a line is 1; an infinite derivative is taken as 0.
    let at_zero = [1.0, 2.0, 3.0, 0.5, -1.0].map(|p| power_gradient(0.0, p).1.0);
    assert_eq!(at_zero, [1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(power_by_branch_gradient(-2.0, 0.5), (2.25, (-3.0,)));
    assert_eq!(power_by_branch_gradient(-0.5, -0.5), (-1.0, (3.0,)));
}

#[differentiate]
mod names {
    const K: f64 = 0.5;

    fn twice(t: f64) -> f64 {
        let double = t * K;
        const K: f64 = 2.0;
        double
    }

    /// Items of a block are visible in the whole block, and shadow those of the module.
    #[differentiate(wrt(x))]
    pub(super) fn nearest(x: f64) -> f64 {
        fn times(t: f64) -> f64 {
            t * K
        }
        let early = x * K;
        const K: f64 = 7.0;
        early + times(x) + twice(x)
    }

    #[differentiate(wrt(x))]
    pub(super) fn module_wide(x: f64) -> f64 {
        x * K
    }
}

#[test]
fn items_of_a_block_are_known_in_all_of_it() {
    assert_eq!((names::nearest(1.0), names::nearest_gradient(1.0)), (16.0, (16.0, (16.0,))));
    assert_eq!(names::module_wide_gradient(1.0), (0.5, (0.5,)));
}

#[differentiate(wrt(x))]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is what is tested")]
fn wrapped(x: f64) -> f64 {
    let mut sum = 0.0;
    for i in 254..258 {
        sum += x * (i as u8) as f64;
    }
    sum + x * (300_i32 as u8) as f64 + x * (-1_i32 as u16) as f64 + x * (200_i32 as i8) as f64
}

#[test]
fn whole_numbers_wrap_as_they_are_cast() {
    assert_eq!(wrapped(1.0), 254.0 + 255.0 + 0.0 + 1.0 + 44.0 + 65535.0 - 56.0);
    assert_eq!(wrapped_gradient(1.0), (wrapped(1.0), (wrapped(1.0),)));
}

#[differentiate(wrt(x))]
fn growth(x: f64) -> f64 {
    x.exp_m1() / x
}

#[test]
fn small_growth_keeps_its_digits() {
    for x in [1e-12, 1e-8, 1e-4, 0.5, -3.0_f64] {
        let (value, (slope,)) = growth_gradient(x);
        let expected = x.exp_m1() / x;
        assert!((value - expected).abs() <= 1e-14 * expected, "{x}: {value} instead of {expected}");
        let expected = if x.abs() < 1e-3 { 0.5 + x / 3.0 + x * x / 8.0 } else { (x.exp() * (x - 1.0) + 1.0) / (x * x) };
        assert!((slope - expected).abs() < 1e-8, "{x}: {slope} instead of {expected}");
    }
    let (value, (slope,)) = growth_gradient(0.0);
    assert!((value - 1.0).abs() < 1e-12 && (slope - 0.5).abs() < 1e-12, "{value}, {slope} at 0");
}
