//! Rewriting is idempotent, and derivatives do not require it.

use std::cell::Cell;

use aim_symbolic::rules::Sums;
use aim_symbolic::{Program, ReciprocalPlacement, Variable};
use fastrand::Rng;

use super::evaluate::Evaluation;
use super::judge::{JudgedCount, SETS, for_each, in_full, regular, same};
use super::material::moving;
use super::plain;

#[test]
fn rewriting_twice_changes_nothing() {
    for_each(20_000, 8, |recipe| {
        let mut stated = recipe.build();
        // Only sets with `Sums::Open`: for others, rewriting the users of a shared sum may leave it unshared, so that a
        // second pass finds more.
        for (name, set) in SETS.into_iter().filter(|(_, set)| set.sums == Sums::Open) {
            let once = stated.pools.g.rewrite_by(&stated.outputs, &set);
            let twice = stated.pools.g.rewrite_by(&once, &set);
            if once != twice {
                let texts = [once, twice].map(|all| plain::scalar(&stated.pools.g, all[0]));
                return Err(format!("{name}: {} becomes {}", texts[0], texts[1]));
            }
        }
        Ok(())
    });
}

/// Forward and reverse mode on unsimplified statements, with rotations placed early or late.
#[test]
fn derivatives_of_unsimplified_statements_are_correct() {
    let tally = JudgedCount::default();
    for_each(20_000, 8, |recipe| {
        let mut stated = recipe.build();
        let Some(mut regular) = regular(&stated, recipe.seed) else { return tally.discard() };
        tally.judge();
        let mut random = Rng::with_seed(recipe.seed);
        let variable = stated.pools.variables[random.usize(..stated.pools.variables.len())];
        let g = &mut stated.pools.g;
        for &s in &stated.outputs {
            let moving = moving(g, regular.evaluation.inputs(), variable);
            let slope = Evaluation::new(moving).scalar(g, s).slope;
            let found = [
                g.gradient(s, &[variable], ReciprocalPlacement::Late)[0],
                g.gradient(s, &[variable], ReciprocalPlacement::Early)[0],
                g.tangents(&[s], variable)[0],
            ];
            for (found, how) in found.into_iter().zip(["late", "early", "forward"]) {
                let found = regular.evaluation.scalar(g, found);
                same(slope, found, &format!("by {variable:?}, {how}"))?;
            }
        }
        Ok(())
    });
    tally.assert_few_discards();
}

/// The comparison can fail: flipping a sign anywhere in a program changes its results.
#[test]
fn the_comparison_detects_a_flipped_sign() {
    let (noticed, flipped) = (Cell::new(0), Cell::new(0));
    for_each(4_000, 8, |recipe| {
        let stated = recipe.build();
        let Some(regular) = regular(&stated, recipe.seed) else { return Ok(()) };
        let program = Program::derive::<Variable>(&stated.pools.g, &stated.outputs, &[]);
        // Exact numbers use the closed form; series are tested elsewhere.
        let places = if program.count().series > 0 { 0 } else { program.ops().len() };
        for place in 0..places {
            let wrong = program.with_sign_flipped(place);
            if wrong != program {
                flipped.set(flipped.get() + 1);
                noticed.set(noticed.get() + usize::from(regular.same_results(&wrong, "").is_err()));
            }
        }
        Ok(())
    });
    let (noticed, flipped) = (noticed.get(), flipped.get());
    let least = if in_full() { 2_000 } else { 125 };
    assert!(flipped > least && noticed * 100 > flipped * 95, "{noticed} of {flipped} were noticed");
}
