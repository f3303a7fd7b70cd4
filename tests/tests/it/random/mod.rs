//! Random functions in Rust, with loops, branches, arrays, vectors, matrices and a rotation that varies on its manifold:
//! values and derivatives against an interpreter of what was written, by dual numbers; modulo a prime, where equal is
//! equal, if nothing in them is a root, a sine or a comparison.

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

/// Functions of each kind.
const CASES: u32 = 1000;

/// Differentiates `written`; its program gives the value, then the gradient.
fn derived(written: &Written) -> Differentiated {
    let text = written.to_string();
    Differentiated::from_file("random.rs", &text, "f").unwrap_or_else(|errors| panic!("{errors:?} in\n{text}"))
}

fn cases() -> u64 {
    u64::from(if in_full() { CASES } else { CASES / 5 })
}

#[test]
fn rational_functions_are_exact_modulo_a_prime() {
    let mut judged = 0;
    for seed in 0..cases() {
        let written = Author::new(seed, true).function();
        let point = Point::random(&mut Rng::with_seed(!seed), |random| Modulo(Some(random.u64(..PRIME))));
        let derived = derived(&written);
        let mut found = [Modulo(None); 1 + VARIABLES];
        derived.procedures()[0].program.run(&point.inputs(), &mut found);
        let along = |variable| written.result(&point.moving(variable), |_, _| None).expect("nothing is compared");
        let expected: Vec<_> = [along(0).value].into_iter().chain((0..VARIABLES).map(|v| along(v).slope)).collect();
        // A constant that the program comes with may be no fraction of powers of two.
        if found.iter().all(|found| found.0.is_some()) {
            assert_eq!(found.as_slice(), expected, "seed {seed}:\n{written}");
            judged += 1;
        }
    }
    assert!(judged * 10 > cases() * 9, "{judged} of {} were judged", cases());
}

#[test]
fn functions_agree_with_dual_numbers() {
    let less = |a: Dual<Rounded>, b: Dual<Rounded>| {
        let (a, b) = (a.value, b.value);
        ((a.value - b.value).abs() > 1e-9 * (a.size + b.size)).then_some(a.value < b.value)
    };
    let mut judged = 0;
    for seed in 0..cases() {
        let written = Author::new(seed, false).function();
        let point = Point::random(&mut Rng::with_seed(!seed), |random| Rounded::constant(3.0 * random.f64() - 1.5));
        let derived = derived(&written);
        let mut found = [0.0; 1 + VARIABLES];
        let inputs: Vec<f64> = point.inputs().iter().map(|input| input.value).collect();
        derived.procedures()[0].program.run(&inputs, &mut found);
        let along: Option<Vec<_>> = (0..VARIABLES).map(|v| written.result(&point.moving(v), less)).collect();
        let Some(along) = along else { continue };
        let expected = [along[0].value].into_iter().chain(along.iter().map(|along| along.slope));
        for (i, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            // Beyond this, numbers have run away: nothing can be said of what is left of them.
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
    // The others' numbers, or a comparison too close to call.
    assert!(judged > cases() * 5, "{judged} outputs of {} functions", cases());
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
