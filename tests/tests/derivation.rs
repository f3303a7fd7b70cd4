//! The rules of the derivation: what they reach on the recorded problems, and that each of them is needed.

use aim_symbolic::Program;
use aim_symbolic::rules;
use aim_tests::problems::{self, Problem};

#[test]
fn counts_are_the_recorded_ones() {
    for Problem { name, g, wanted, operations } in problems::all() {
        let count = Program::derive_wanted(&g, &wanted).count();
        assert_eq!(count.total(), operations, "{name}: {count}");
    }
}

#[test]
fn without_any_one_rule_a_count_rises() {
    for rule in rules::names() {
        let needed = problems::all().into_iter().any(|Problem { g, wanted, operations, .. }| {
            Program::derive_without(&g, &wanted, &[rule]).count().total() > operations
        });
        assert!(needed, "no recorded problem needs `{rule}`");
    }
}

#[test]
fn a_trace_leads_from_the_statement_to_the_program() {
    for Problem { name, g, wanted, operations } in problems::all() {
        let steps = Program::trace(&g, &wanted);
        assert!(steps.windows(2).all(|pair| pair[0].after == pair[1].before), "{name}: {steps:?}");
        assert!(steps.iter().all(|step| step.after.total() < step.before.total()), "{name}: {steps:?}");
        assert_eq!(steps.last().map(|step| step.after.total()), Some(operations), "{name}");
    }
}
