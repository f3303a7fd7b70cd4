//! Differentiated functions in lanes compared with their scalar companions, bit for bit. The lanes of one vector take
//! different branches, guards and series.

use aim::glam::{Affine3A, DVec3, Mat3, Quat, Vec2, Vec3};
use aim::wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
use aim::{Real, differentiate};
use aim_tests::random::Random;

use super::cases::{Lane, Lanes};

#[differentiate]
mod functions {
    use aim::glam::{Affine3A, DVec3, Mat3, Quat, Vec2, Vec3};

    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(super) struct Spring {
        pub(super) anchor: Vec3,
        pub(super) rest: f32,
        pub(super) is_slack: bool,
        pub(super) turns: i32,
    }

    /// A spring that is stretched, compressed or slack: three branches, a length and a whole number.
    #[differentiate(wrt(place), hessian, hvp, lanes)]
    pub(super) fn spring(place: Vec3, spring: &Spring) -> f32 {
        let stretch = (place - spring.anchor).length() - spring.rest;
        if spring.is_slack && stretch < 0.0 {
            return 0.0;
        }
        let stiffness = if stretch < -0.5 { 2.0 } else { spring.turns as f32 };
        0.5 * stiffness * stretch * stretch
    }

    /// A residual on a manifold, with rows of numbers, tuples and a transform.
    #[differentiate(wrt(tangent(turn), shift), gauss_newton, vjp, lanes)]
    pub(super) fn registered(
        turn: Quat,
        shift: Vec3,
        points: &[Vec3; 2],
        (normal, offset): (Vec3, f32),
        base: Affine3A,
    ) -> [f32; 2] {
        points.map(|point| normal.dot(base.transform_point3(turn * point + shift)) - offset)
    }

    /// A vector function of a vector, with a matrix argument, and a limit at 0.
    #[differentiate(wrt(w), jvp, lanes)]
    pub(super) fn turned(w: Vec3, stretch: Mat3) -> Vec3 {
        stretch * (Quat::from_scaled_axis(w) * Vec3::new(1.0, 2.0, 0.5))
    }

    /// Every elementary function.
    #[differentiate(wrt(x, y), lanes)]
    pub(super) fn called(x: f64, y: f64) -> (f64, DVec3) {
        let wave = x.sin() + y.cos() * (0.3 * x).tan();
        let bent = (x / 4.0).asin() - (y / 4.0).acos() + y.atan2(x);
        let grown = (-x).exp() + (x * x + 1.0).ln() + x.sinh() - y.cosh();
        (wave, DVec3::new(bent, grown + y.tanh(), (x + 3.5).powf(y) + x.rem_euclid(1.5)))
    }

    /// A loop with an early exit, and a clamped length.
    #[differentiate(wrt(v), lanes)]
    pub(super) fn tracked(v: Vec2, steps: [f32; 3]) -> Vec2 {
        let mut at = v;
        for step in steps {
            if at.length_squared() > 4.0 {
                break;
            }
            at += step * at.perp();
        }
        at.clamp_length(0.25, 2.0)
    }
}

use functions::Spring;

/// A function's companions as maps from its numbers to their outputs.
trait Function {
    type Number: Lane;
    /// Number of numbers that the function takes.
    const NUMBERS: usize;
    fn alone(numbers: &[Self::Number]) -> Vec<Self::Number>;
    fn in_lanes<S: Real>(numbers: &[S]) -> Vec<S>;
}

/// Takes the first numbers of the rest.
fn take<S: Copy, const N: usize>(numbers: &mut &[S]) -> [S; N] {
    let (first, rest) = numbers.split_first_chunk().expect("as many as the function takes");
    *numbers = rest;
    *first
}

fn vector(numbers: &mut &[f32]) -> Vec3 {
    Vec3::from_array(take(numbers))
}

struct InSpring;
impl Function for InSpring {
    type Number = f32;
    const NUMBERS: usize = 12;

    fn alone(mut n: &[f32]) -> Vec<f32> {
        let (place, anchor, [rest, slack, turns]) = (vector(&mut n), vector(&mut n), take(&mut n));
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and small")]
        let spring = Spring { anchor, rest, is_slack: truth(slack) > 0.0, turns: whole(turns) as i32 };
        let (value, (by,)) = functions::spring_gradient(place, &spring);
        let (again, (slope,), square) = functions::spring_hessian(place, &spring);
        let (along, (second,)) = functions::spring_hvp(place, &spring, vector(&mut n));
        let vectors = [by, slope, second].map(|v| v.to_array()).concat();
        [vec![value, again, along], vectors, square.concat()].concat()
    }

    fn in_lanes<S: Real>(mut n: &[S]) -> Vec<S> {
        let (place, anchor, [rest, slack, turns]) = (take(&mut n), take(&mut n), take(&mut n));
        let spring = (anchor, rest, truth(slack), whole(turns));
        let (value, (by,)) = functions::spring_gradient_lanes(place, &spring);
        let (again, (slope,), square) = functions::spring_hessian_lanes(place, &spring);
        let (along, (second,)) = functions::spring_hvp_lanes(place, &spring, take(&mut n));
        [vec![value, again, along], [by, slope, second].concat(), square.concat()].concat()
    }
}

/// Returns 1 if the number is above 0, otherwise 0: a `bool` in lanes.
fn truth<S: Real>(number: S) -> S {
    S::select_less(S::ZERO, number, S::constant(1.0), S::ZERO)
}

/// Rounds down to a whole number; returns 0 if it is far from 0 or NaN.
fn whole<S: Real>(number: S) -> S {
    let below = S::select_less(number, S::constant(4.0), number.floor(), S::ZERO);
    S::select_less(S::constant(-4.0), number, below, S::ZERO)
}

struct InRegistered;
impl Function for InRegistered {
    type Number = f32;
    const NUMBERS: usize = 31;

    fn alone(mut n: &[f32]) -> Vec<f32> {
        let (turn, shift) = (Quat::from_array(take(&mut n)), vector(&mut n));
        let points = [vector(&mut n), vector(&mut n)];
        let (plane, base) = ((vector(&mut n), take::<_, 1>(&mut n)[0]), Affine3A::from_cols_array(&take(&mut n)));
        let (value, (by_turn, by_shift)) = functions::registered_jacobian(turn, shift, &points, plane, base);
        let (again, (turned, shifted), square) = functions::registered_gauss_newton(turn, shift, &points, plane, base);
        let (last, (a, b)) = functions::registered_vjp(turn, shift, &points, plane, base, take(&mut n));
        let rows = [by_turn, by_shift, [turned, shifted], [a, b]].concat();
        let rows: Vec<f32> = rows.into_iter().flat_map(|row| row.to_array()).collect();
        [[value, again, last].concat(), rows, square.concat()].concat()
    }

    fn in_lanes<S: Real>(mut n: &[S]) -> Vec<S> {
        let (turn, shift) = (take(&mut n), take(&mut n));
        let points = [take(&mut n), take(&mut n)];
        let (plane, base) = ((take(&mut n), take::<_, 1>(&mut n)[0]), take(&mut n));
        let (value, (by_turn, by_shift)) = functions::registered_jacobian_lanes(turn, shift, &points, plane, base);
        let (again, (turned, shifted), square) =
            functions::registered_gauss_newton_lanes(turn, shift, &points, plane, base);
        let (last, (a, b)) = functions::registered_vjp_lanes(turn, shift, &points, plane, base, take(&mut n));
        let rows = [by_turn, by_shift, [turned, shifted], [a, b]].concat().concat();
        [[value, again, last].concat(), rows, square.concat()].concat()
    }
}

struct InTurned;
impl Function for InTurned {
    type Number = f32;
    const NUMBERS: usize = 15;

    fn alone(mut n: &[f32]) -> Vec<f32> {
        let (w, stretch) = (vector(&mut n), Mat3::from_cols_array(&take(&mut n)));
        let (value, (by,)) = functions::turned_jacobian(w, stretch);
        let (again, along) = functions::turned_jvp(w, stretch, vector(&mut n));
        // In lanes the Jacobian is stored by rows.
        [value, again, along].map(|v| v.to_array()).concat().into_iter().chain(by.transpose().to_cols_array()).collect()
    }

    fn in_lanes<S: Real>(mut n: &[S]) -> Vec<S> {
        let (w, stretch) = (take(&mut n), take(&mut n));
        let (value, (by,)) = functions::turned_jacobian_lanes(w, stretch);
        let (again, along) = functions::turned_jvp_lanes(w, stretch, take(&mut n));
        [[value, again, along].concat(), by.concat()].concat()
    }
}

struct InCalled;
impl Function for InCalled {
    type Number = f64;
    const NUMBERS: usize = 2;

    fn alone(n: &[f64]) -> Vec<f64> {
        let ((wave, rest), (by_x, by_y)) = functions::called_jacobian(n[0], n[1]);
        let DVec3 { x, y, z } = rest;
        [vec![wave, x, y, z], by_x.to_vec(), by_y.to_vec()].concat()
    }

    fn in_lanes<S: Real>(n: &[S]) -> Vec<S> {
        let ((wave, rest), (by_x, by_y)) = functions::called_jacobian_lanes(n[0], n[1]);
        [vec![wave], rest.to_vec(), by_x.to_vec(), by_y.to_vec()].concat()
    }
}

struct InTracked;
impl Function for InTracked {
    type Number = f32;
    const NUMBERS: usize = 5;

    fn alone(mut n: &[f32]) -> Vec<f32> {
        let (value, (by,)) = functions::tracked_jacobian(Vec2::from_array(take(&mut n)), take(&mut n));
        let [by_x, by_y] = by;
        [value, Vec2::new(by_x.x, by_y.x), Vec2::new(by_x.y, by_y.y)].map(|v| v.to_array()).concat()
    }

    fn in_lanes<S: Real>(mut n: &[S]) -> Vec<S> {
        let (value, (by,)) = functions::tracked_jacobian_lanes(take(&mut n), take(&mut n));
        [value.to_vec(), by.concat()].concat()
    }
}

/// Returns a random number of any size, or a special one at which formulas break down.
fn number<S: Lane>(random: &mut Random) -> S {
    S::rounded(match random.below(12) {
        0 | 1 => 0.0,
        2 => -1.0,
        3 => random.within(1e-4),
        4 => [1e-30, -1e30, f64::INFINITY, f64::NAN][random.below(4)],
        _ => random.within(3.0),
    })
}

/// Compares every lane, and returns the number of vectors in which an output is 0 in some lanes only.
fn compare<F: Function, V: Lanes<Lane = F::Number> + Real>(count: usize) -> usize {
    let mut random = Random::new(11);
    let mut mixed = 0;
    for _ in 0..count {
        let points: Vec<Vec<F::Number>> =
            (0..V::COUNT).map(|_| (0..F::NUMBERS).map(|_| number(&mut random)).collect()).collect();
        let gathered: Vec<V> = (0..F::NUMBERS).map(|k| V::gather(|lane| points[lane][k])).collect();
        let found = F::in_lanes(&gathered);
        let expected: Vec<Vec<F::Number>> = points.iter().map(|point| F::alone(point)).collect();
        for (lane, (point, expected)) in points.iter().zip(&expected).enumerate() {
            let found: Vec<F::Number> = found.iter().map(|v| v.lane(lane)).collect();
            let same = found.iter().map(|s| s.bits()).eq(expected.iter().map(|s| s.bits()));
            assert!(
                same,
                "{}, lane {lane} of {} at {point:?}: {found:?} instead of {expected:?}",
                std::any::type_name::<F>(),
                std::any::type_name::<V>()
            );
        }
        let zeros = |k: usize| expected.iter().filter(|lane| lane[k].into() == 0.0).count();
        mixed += usize::from((0..found.len()).any(|k| (1..V::COUNT).contains(&zeros(k))));
    }
    mixed
}

#[test]
fn every_lane_of_a_function_is_the_function() {
    fn single<F: Function<Number = f32>>() {
        let mixed = compare::<F, f32x4>(400) + compare::<F, f32x8>(400) + compare::<F, f32x16>(400);
        assert!(mixed > 100, "{}: {mixed} vectors of branches that differ", std::any::type_name::<F>());
    }
    single::<InSpring>();
    single::<InRegistered>();
    single::<InTurned>();
    single::<InTracked>();
    let mixed = compare::<InCalled, f64x2>(800) + compare::<InCalled, f64x4>(800) + compare::<InCalled, f64x8>(800);
    assert!(mixed > 100, "{mixed}");
}
