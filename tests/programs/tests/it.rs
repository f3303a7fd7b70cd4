//! Compares the derivatives that `#[differentiate]` derives for random functions with dual numbers.

#![allow(warnings, clippy::all, clippy::pedantic, reason = "nobody has written these functions")]

use aim_programs::Dual;

type Companion = fn(f64, f64, &[f64], &[[f64; 2]], i32) -> (f64, (f64, f64));
type Twin = fn(Dual, Dual, &[Dual], &[[Dual; 2]], i32) -> Dual;

include!(concat!(env!("OUT_DIR"), "/programs.rs"));

/// Largest error, relative to the number, or to 1 if that is larger.
const ERROR: f64 = 1e-7;

/// Number of points at which each function is compared.
const POINTS: u64 = 60;

/// A value, and its derivatives by `x` and `y`.
type Triple = [f64; 3];

fn is_near(found: Triple, right: Triple) -> bool {
    found.iter().zip(right).all(|(found, right)| (found - right).abs() <= ERROR * (1.0 + right.abs()))
}

#[test]
fn random_programs() {
    let (mut wrong, mut left_out) = (Vec::new(), 0);
    for (number, companion, twin) in PROGRAMS {
        let mut random = fastrand::Rng::with_seed(*number);
        for _ in 0..POINTS {
            let mut draw = || 4.0 * random.f64() - 2.0;
            let (x, y) = (draw(), draw());
            let mut s = [0.0; 6].map(|_: f64| draw());
            let e = [[0.0; 2]; 4].map(|_: [f64; 2]| [draw(), draw()]);
            let (s, e, n) = (&s[..random.usize(..7)], &e[..random.usize(..5)], random.i32(0..5));
            let list: Vec<Dual> = s.iter().map(|&v| Dual::from(v)).collect();
            let pairs: Vec<[Dual; 2]> = e.iter().map(|pair| pair.map(Dual::from)).collect();
            let right_at = |x, y| -> Triple {
                let by = |dx, dy| twin(Dual::new(x, dx), Dual::new(y, dy), &list, &pairs, n);
                let (by_x, by_y) = (by(1.0, 0.0), by(0.0, 1.0));
                [by_x.re, by_x.eps, by_y.eps]
            };
            let right = right_at(x, y);
            // Comparisons such as `x + y - x > y` depend on rounding, which differs when terms are collected.
            if (0..8).any(|_| !is_near(right_at(x + 1e-12 * random.f64(), y), right)) {
                left_out += 1;
                continue;
            }
            let (value, (by_x, by_y)) = companion(x, y, s, e, n);
            let found = [value, by_x, by_y];
            if !is_near(found, right) {
                wrong.push(format!("{number}: of {x}, {y}, {s:?}, {e:?}, {n}: {found:?} instead of {right:?}"));
                break;
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {} functions are wrong:\n{}", wrong.len(), PROGRAMS.len(), wrong.join("\n"));
    let points = POINTS * PROGRAMS.len() as u64;
    assert!(100 * left_out < points, "{left_out} of {points} points are decided by rounding");
}
