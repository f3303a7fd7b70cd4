//! Checks that the test harness itself detects wrong values and derivatives.

use aim_objectives::dual::Dual64;
use aim_objectives::{At, Random, singular};

/// The function x², whose derivatives the tests below falsify.
fn square(x: f64) -> f64 {
    x * x
}

fn right(x: f64) -> (f64, (f64,)) {
    (x * x, (2.0 * x,))
}

fn right_single(x: f32) -> (f32, (f32,)) {
    (x * x, (2.0 * x,))
}

fn of_duals(x: Dual64) -> Dual64 {
    x * x
}

const AT: At<fn(&mut Random) -> Vec<f64>> = At(|r| r.numbers(1, 0.5..1.0));

#[test]
fn takes_what_is_right() {
    AT.check(square, right, right_single, of_duals);
    singular(&[0.0], square, right, right_single, &[0.0]);
}

#[test]
#[should_panic(expected = "central differences")]
fn notices_a_derivative_that_is_not_the_functions() {
    AT.check(|x: f64| x * x + 1e-5 * x, |x: f64| (x * x + 1e-5 * x, (2.0 * x,)), right_single, of_duals);
}

#[test]
#[should_panic(expected = "num-dual")]
fn notices_a_small_mistake() {
    AT.check(square, |x: f64| (x * x, (2.0 * x + 1e-9,)), right_single, of_duals);
}

#[test]
#[should_panic(expected = "f32")]
fn notices_a_mistake_in_single_precision() {
    AT.check(square, right, |x: f32| (x * x, (2.0 * x + 1e-4,)), of_duals);
}

#[test]
#[should_panic(expected = "f32")]
fn notices_what_is_no_number() {
    AT.check(square, right, |x: f32| (x * x, (0.0 * x / 0.0,)), of_duals);
}

#[test]
#[should_panic(expected = "found")]
fn notices_what_is_no_number_at_a_singular_point() {
    singular(&[0.0], square, |x: f64| (x * x, (x / x,)), right_single, &[0.0]);
}

use aim::__private::differences::{Draw, agree};

const ONE: (&[Draw], &[usize; 1], bool) = (&[Draw::Number], &[0], false);

#[test]
fn the_written_test_takes_what_is_right_but_for_kinks() {
    agree("hinge", ONE, |[x]| [x.max(0.5)], |[x]| [[if *x > 0.5 { 1.0 } else { 0.0 }]]);
    agree("root", ONE, |[x]| [x.sqrt()], |[x]| [[0.5 / x.sqrt()]]);
}

#[test]
#[should_panic(expected = "square, component 0, by number 0 of [")]
fn the_written_test_notices_a_small_mistake() {
    agree("square", ONE, |[x]| [x * x], |[x]| [[2.0 * x + 1e-4]]);
}

#[test]
#[should_panic(expected = "square")]
fn the_written_test_notices_what_is_no_number() {
    agree("square", ONE, |[x]| [x * x], |[x]| [[2.0 * x + f64::NAN]]);
}

#[test]
#[should_panic(expected = "at none of")]
fn the_written_test_needs_a_point() {
    agree("nowhere", ONE, |[x]| [(-1.0 - x * x).sqrt()], |_| [[0.0]]);
}
