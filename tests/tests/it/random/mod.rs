//! Random functions in Rust with loops and early exits, branches, arrays, vectors, matrices and a rotation that varies
//! on its manifold. Values and derivatives are compared with an interpreter of the same function, run on dual numbers.
//! Functions without roots, sines and comparisons are compared modulo a prime, where equality is exact.

mod author;
mod dual;
mod interpreter;
mod language;
mod modulo;
mod rounded;

use aim_codegen::Differentiated;
use aim_symbolic::Number;
use aim_tests::scale::in_full;
use author::Author;
use dual::Dual;
use fastrand::Rng;
use interpreter::{Point, VARIABLES};
use language::Written;
use modulo::{Modulo, PRIME};
use rounded::Rounded;

/// Number of functions that are derived with the search, as in normal use. `.ci/thorough` takes five times as many,
/// optimised.
const CASES: u64 = if cfg!(debug_assertions) { 400 } else { 2000 };
/// Number of short functions that are derived at once, without the search.
const SHORT_CASES: u64 = if cfg!(debug_assertions) { 10_000 } else { 50_000 };

/// The way in which a function is derived. The program gives the value, then the gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Derive {
    Searching,
    AtOnce,
}

impl Derive {
    fn cases(self) -> u64 {
        let all = if self == Self::Searching { CASES } else { SHORT_CASES };
        if in_full() { all } else { all / if self == Self::Searching { 5 } else { 20 } }
    }

    /// Generates a function and derives it.
    fn written(self, seed: u64, is_rational: bool) -> (Written, Differentiated) {
        let author = Author::new(seed, is_rational);
        let written = if self == Self::Searching { author } else { author.of_at_most(3) }.function();
        let text = written.to_string();
        let derived = match self {
            Self::Searching => Differentiated::from_file("random.rs", &text, "f"),
            Self::AtOnce => Differentiated::from_file_at_once("random.rs", &text, "f"),
        };
        let derived = derived.unwrap_or_else(|errors| panic!("{errors:?} in\n{text}"));
        (written, derived)
    }
}

fn are_exact_modulo_a_prime(derive: Derive) {
    let mut judged = 0;
    for seed in 0..derive.cases() {
        let (written, derived) = derive.written(seed, true);
        let point = Point::random(&mut Rng::with_seed(!seed), |random| Modulo(Some(random.u64(..PRIME))));
        let mut found = [Modulo(None); 1 + VARIABLES];
        derived.procedures()[0].program.run(&point.inputs(), &mut found);
        let along = |variable| written.result(&point.moving(variable), |_, _| None).expect("nothing is compared");
        let expected: Vec<_> = [along(0).value].into_iter().chain((0..VARIABLES).map(|v| along(v).slope)).collect();
        // A constant that the derivation introduces may not be a dyadic fraction.
        if found.iter().all(|found| found.0.is_some()) {
            assert_eq!(found.as_slice(), expected, "seed {seed}:\n{written}");
            judged += 1;
        }
    }
    assert!(judged * 10 > derive.cases() * 9, "{judged} of {} were judged", derive.cases());
}

#[test]
fn rational_functions_are_exact_modulo_a_prime() {
    are_exact_modulo_a_prime(Derive::Searching);
}

#[test]
fn short_rational_functions_are_exact_modulo_a_prime() {
    are_exact_modulo_a_prime(Derive::AtOnce);
}

fn agree_with_dual_numbers(derive: Derive) {
    let less = |a: Dual<Rounded>, b: Dual<Rounded>| {
        let (a, b) = (a.value, b.value);
        ((a.value - b.value).abs() > 1e-9 * (a.size + b.size)).then_some(a.value < b.value)
    };
    let mut judged = 0;
    for seed in 0..derive.cases() {
        let (written, derived) = derive.written(seed, false);
        let point = Point::random(&mut Rng::with_seed(!seed), |random| Rounded::constant(3.0 * random.f64() - 1.5));
        let mut found = [0.0; 1 + VARIABLES];
        let inputs: Vec<f64> = point.inputs().iter().map(|input| input.value).collect();
        derived.procedures()[0].program.run(&inputs, &mut found);
        let along: Option<Vec<_>> = (0..VARIABLES).map(|v| written.result(&point.moving(v), less)).collect();
        let Some(along) = along else { continue };
        let expected = [along[0].value].into_iter().chain(along.iter().map(|along| along.slope));
        for (i, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            // Beyond this size, the result is dominated by rounding errors.
            if !expected.size.is_finite() || expected.size > 1e6 * (1.0 + expected.value.abs()) {
                continue;
            }
            judged += 1;
            let off = (found - expected.value).abs();
            assert!(
                off <= 1e-11 * (1.0 + expected.size),
                "output {i}: {found} for {expected:?}, seed {seed}:\n{written}"
            );
        }
    }
    // The remaining outputs were too large, or a comparison was too close to decide.
    assert!(judged > derive.cases() * 5, "{judged} outputs of {} functions", derive.cases());
}

#[test]
fn functions_agree_with_dual_numbers() {
    agree_with_dual_numbers(Derive::Searching);
}

#[test]
fn short_functions_agree_with_dual_numbers() {
    agree_with_dual_numbers(Derive::AtOnce);
}

#[test]
fn short_functions_have_loops_branches_and_matrices() {
    let texts: Vec<String> =
        (0..1000).map(|seed| Author::new(seed, false).of_at_most(3).function().to_string()).collect();
    let kinds = [("for ", 300), ("while ", 100), ("if ", 100), ("turn *", 100), (" * m", 100)];
    let ways_out = [("break;", 15), ("continue;", 10), ("return ", 10), ("table[i", 30), ("] += ", 50)];
    for (what, least) in kinds.into_iter().chain(ways_out) {
        let found = texts.iter().filter(|text| text.contains(what)).count();
        assert!(found >= least, "{found} have `{what}`");
    }
}

#[test]
fn a_matrix_that_is_squared_in_every_round_grows_by_as_much_in_each() {
    for rounds in [4, 8, 16, 24] {
        let text = format!(
            "#[differentiate(wrt(x))]
            pub fn f(x: f64, mut m: DMat3, v: DVec3) -> f64 {{
                m = x * m;
                for _ in 0..{rounds} {{ m = m * m; }}
                (m * v).dot(v)
            }}"
        );
        let derived = Differentiated::from_file("squares.rs", &text, "f").unwrap_or_else(|errors| panic!("{errors:?}"));
        let total = derived.procedures()[0].program.count().total();
        println!("{rounds} rounds: {total}");
        assert!(total <= 120 * rounds, "{rounds} rounds are {total} operations");
    }
}
