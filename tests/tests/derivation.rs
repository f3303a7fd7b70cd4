//! The rules of the derivation: what they reach on the recorded problems, and that each of them is needed.

use aim_symbolic::Program;
use aim_symbolic::rules;
use aim_tests::problems::{self, Problem};

/// Rules that no recorded problem needs, each with the reason for which it stays.
const SPARE: [(&str, &str); 0] = [];

#[test]
fn counts_are_the_recorded_ones() {
    for Problem { name, mut g, wanted, operations } in problems::all() {
        let count = Program::derive_wanted(&mut g, &wanted).count();
        assert_eq!(count.total(), operations, "{name}: {count}");
    }
}

#[test]
fn without_any_one_rule_a_count_rises() {
    let mut idle = Vec::new();
    for rule in rules::names() {
        let mut rises = Vec::new();
        for Problem { name, mut g, wanted, operations } in problems::all() {
            let count = Program::derive_without(&mut g, &wanted, &[rule]).count().total();
            if count < operations {
                println!("{rule}: {name} {operations} -> {count} LESS");
            }
            if count > operations {
                rises.push((name, count - operations));
            }
        }
        println!("{rule}: {rises:?}");
        if rises.is_empty() && !SPARE.iter().any(|(spare, _)| *spare == rule) {
            idle.push(rule);
        }
    }
    assert!(idle.is_empty(), "not needed: {idle:?}");
}

#[test]
fn a_trace_leads_from_the_statement_to_the_program() {
    for Problem { name, mut g, wanted, operations } in problems::all() {
        let steps = Program::trace(&mut g, &wanted);
        assert!(steps.windows(2).all(|pair| pair[0].after == pair[1].before), "{name}: {steps:?}");
        assert!(steps.iter().all(|step| step.after.total() < step.before.total()), "{name}: {steps:?}");
        assert_eq!(steps.last().map(|step| step.after.total()), Some(operations), "{name}");
    }
}
