//! Constants that stand outside of what the attribute sees: companions read them where they stand.

use aim::differentiate;
use aim::glam::DVec3;

const GRAVITY: f64 = 9.81;
const DRAG_1: f64 = 0.3;
static STIFFNESS: f64 = 40.0;
const SPRINGS: usize = 3;
const SIZE: usize = SPRINGS + 1;
const LAST: usize = SIZE - 1;
const MEAN: bool = true;

mod units {
    pub(super) const PER_MINUTE: f64 = 1.0 / 60.0;
    pub(super) const G: f32 = 6.5;
    pub(super) const TWICE: u32 = 2;
}

#[differentiate(wrt(v, t), lanes, hessian, check = true)]
fn thrown(v: f64, t: f64) -> f64 {
    let slowed = v * (-DRAG_1 * t).exp();
    slowed * t - 0.5 * GRAVITY * t * t + units::PER_MINUTE * t
}

#[differentiate(wrt(p), check = true)]
fn hung(p: DVec3) -> f64 {
    0.5 * STIFFNESS * SPRINGS as f64 * (p.length() - 1.0).powi(2) + GRAVITY * p.y
}

#[differentiate(wrt(w), hessian, check = true)]
fn polynomial(w: [f64; SIZE], x: f64) -> f64 {
    let (mut sum, mut power) = (w[LAST] * w[LAST], 1.0);
    for weight in w {
        sum += weight * power;
        power *= x;
    }
    for _ in 0..units::TWICE {
        sum *= 0.5;
    }
    if MEAN { sum / SIZE as f64 } else { sum }
}

const TAU: f64 = 0.05;

mod own {
    pub(super) mod consts {
        pub(in super::super) const SHARE: f64 = 0.25;
    }
}

/// The file's own `TAU`, and single-precision constants, which keep their rounding.
#[differentiate(wrt(x), check = true)]
fn of_own_names(x: f64) -> f64 {
    const STEPS: [f32; 2] = [0.1, 0.2];
    let half: f32 = 0.7;
    TAU * x + own::consts::SHARE * x + f64::from(STEPS[0]) * x * x + 1.3f32 as f64 * x * half as f64
}

/// The parameters of a method can use constants, too.
struct Filter;

impl Filter {
    #[differentiate(wrt(x))]
    fn smoothed(x: f64) -> f64 {
        let mut y = x;
        for _ in 0..SPRINGS {
            y = 0.5 * (y + y * y);
        }
        y * GRAVITY
    }
}

mod exchange {
    use std::mem::{self, swap};

    use aim::differentiate;

    #[differentiate(wrt(x, y), check = true)]
    pub(super) fn exchanged(x: f64, y: f64) -> f64 {
        let (mut a, mut b) = (x * x, y);
        swap(&mut a, &mut b);
        let before = mem::replace(&mut a, 3.0 * x);
        swap(&mut a, &mut b);
        before * a + b
    }
}

#[differentiate(check = true)]
mod of_a_module {
    use super::units::PER_MINUTE;

    fn settled(x: f64) -> f64 {
        super::GRAVITY * x / PER_MINUTE
    }

    #[differentiate(wrt(x))]
    pub(super) fn sum(x: f64, values: &[f64]) -> f64 {
        let mut sum = 0.0;
        for value in values {
            if *value < super::DRAG_1 {
                continue;
            }
            sum += settled(x * value) * PER_MINUTE;
        }
        sum
    }

    #[differentiate(wrt(x))]
    pub(super) fn table(x: f64) -> [f64; super::SIZE] {
        let mut table = [x; super::SIZE];
        for k in 1..super::SIZE {
            table[k] *= table[k - 1];
        }
        table
    }

    #[differentiate(wrt(x))]
    #[allow(clippy::cast_possible_truncation, reason = "as users write it")]
    pub(super) fn single(x: f32) -> f32 {
        use super::units::G;
        let most = 2.0 * G;
        (x * G).min(most) * (super::GRAVITY as f32 / 9.81)
    }
}

#[test]
fn values_are_those_of_the_functions() {
    let (value, (by_v, by_t), second) = thrown_hessian(8.0, 0.5);
    assert!((value - thrown(8.0, 0.5)).abs() < 1e-12);
    assert!((by_v - 0.5 * (-0.15_f64).exp()).abs() < 1e-12);
    let damped = 8.0 * (-0.15_f64).exp();
    assert!((by_t - (damped * (1.0 - 0.15) - GRAVITY * 0.5 + units::PER_MINUTE)).abs() < 1e-12);
    assert!((second[1][1] - (damped * (0.09 * 0.5 - 0.6) - GRAVITY)).abs() < 1e-12);
    assert_eq!(thrown_gradient_lanes(8.0_f64, 0.5), thrown_gradient(8.0, 0.5));
    assert!((hung_gradient(DVec3::Y).1.0 - DVec3::new(0.0, GRAVITY, 0.0)).length() < 1e-12);
    assert_eq!(of_a_module::sum_gradient(1.0, &[0.1, 0.5, 2.0]).1.0, 2.5 * GRAVITY);
    let (value, (by_w,), second) = polynomial_hessian([1.0, 2.0, 3.0, 4.0], 2.0);
    assert_eq!((value, by_w), ((16.0 + 49.0) / 16.0, [1.0, 2.0, 4.0, 16.0].map(|slope| slope / 16.0)));
    assert_eq!((second[3][3], second[0][3]), (2.0 / 16.0, 0.0));
    assert_eq!(of_a_module::table_jacobian(2.0), ([2.0, 4.0, 8.0, 16.0], ([1.0, 4.0, 12.0, 32.0],)));
    assert_eq!(of_a_module::single_gradient(1.0), (6.5, (6.5,)));
    assert_eq!(of_a_module::single_gradient(3.0), (13.0, (0.0,)));
    let (value, (slope,)) = of_own_names_gradient(1.5);
    let by_square = f64::from(0.1f32);
    let by_x = 0.05 + 0.25 + f64::from(1.3f32) * f64::from(0.7f32);
    assert!((value - of_own_names(1.5)).abs() < 1e-14 && (slope - by_x - 3.0 * by_square).abs() < 1e-14, "{value}");
    assert!((Filter::smoothed_gradient(0.5).0 - Filter::smoothed(0.5)).abs() < 1e-14);
    assert_eq!(exchange::exchanged_gradient(2.0, 5.0), (exchange::exchanged(2.0, 5.0), (23.0, 4.0)));
}
