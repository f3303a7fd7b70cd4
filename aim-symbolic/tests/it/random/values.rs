//! Rules preserve values: each alone, each set, and all sets in sequence.

use std::cell::RefCell;

use aim_symbolic::rules::{ACROSS_FOR_CROSS, Rule};
use aim_symbolic::{Program, Want};

use super::evaluate::Evaluation;
use super::field::Field;
use super::judge::{JudgedCount, OF_LENGTHS, Regular, SETS, anywhere, for_each, in_full, regular, single_rules};

#[test]
fn every_rule_is_named_once() {
    for (set, rules) in SETS {
        let mut names: Vec<&str> = rules.rules.iter().map(|rule| rule.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{set}: {names:?}");
    }
}

/// Number of statements for each rule in full test runs.
const CASES: u64 = 80_000;
/// Number of statements, out of [`CASES`], that each rule must apply to. In shorter runs it is 1.
const LEAST: usize = 50;

#[test]
fn each_rule_alone_applies_and_preserves_the_value() {
    let rules = single_rules();
    let applied = RefCell::new(vec![0; rules.len()]);
    let tally = JudgedCount::default();
    for_each(CASES, 8, |recipe| {
        let mut stated = recipe.build();
        let Some(mut regular) = regular(&stated, recipe.seed) else { return tally.discard() };
        tally.judge();
        for (i, (set, rule, alone)) in rules.iter().enumerate() {
            if regular.without().contains(rule) {
                continue;
            }
            let rewritten = stated.pools.g.rewrite_by(&stated.outputs, alone);
            if rewritten != stated.outputs {
                applied.borrow_mut()[i] += 1;
                regular.same_values(&stated, &rewritten, &format!("{set}: {rule}"))?;
            }
        }
        Ok(())
    });
    tally.assert_few_discards();
    let least = if in_full() { LEAST } else { 1 };
    for ((set, rule, _), applied) in rules.iter().zip(applied.into_inner()) {
        println!("{applied} {set}: {rule}");
        assert!(applied >= least, "{set}: {rule} applied to {applied} statements");
    }
}

#[test]
fn rule_sets_preserve_the_value() {
    let tally = JudgedCount::default();
    for_each(20_000, 12, |recipe| {
        let mut stated = recipe.build();
        let Some(mut regular) = regular(&stated, recipe.seed) else { return tally.discard() };
        tally.judge();
        let program = Program::compile(&mut stated.pools.g, &stated.outputs);
        regular.same_results(&program, "as stated")?;
        let mut chained = stated.outputs.clone();
        for (name, set) in regular.sets() {
            let alone = stated.pools.g.rewrite_by(&stated.outputs, set);
            regular.same_values(&stated, &alone, name)?;
            let program = Program::compile(&mut stated.pools.g, &alone);
            regular.same_results(&program, name)?;
            chained = stated.pools.g.rewrite_by(&chained, set);
            regular.same_values(&stated, &chained, &format!("up to {name}"))?;
        }
        Ok(())
    });
    tally.assert_few_discards();
}

/// The only rule that changes a value if a vector has no direction: |v × 0| is 0, but |v − (v · 0) 0| is |v|.
const NEEDS_A_DIRECTION: Rule = ACROSS_FOR_CROSS;

#[test]
fn rules_preserve_the_value_at_zero_vectors() {
    let rules = single_rules();
    let tally = JudgedCount::default();
    for_each(50_000, 8, |recipe| {
        let mut stated = recipe.build();
        let mut evaluation: Evaluation<Field> = anywhere(recipe.seed);
        let g = &mut stated.pools.g;
        let values: Vec<Field> = stated.outputs.iter().map(|&s| evaluation.scalar(g, s)).collect();
        if !evaluation.singular || evaluation.no_axis || values.iter().any(|v| v.undefined().is_some()) {
            return Ok(());
        }
        tally.judge();
        let mut regular = Regular { evaluation, values };
        // A limit differs from a guard's 0 on purpose.
        let may_apply = |rule: &Rule| *rule != NEEDS_A_DIRECTION && !OF_LENGTHS.contains(rule);
        for (set, rule, alone) in rules.iter().filter(|(_, rule, _)| may_apply(rule)) {
            let rewritten = stated.pools.g.rewrite_by(&stated.outputs, alone);
            regular.same_values(&stated, &rewritten, &format!("{set}: {rule}"))?;
        }
        let wanted: Vec<Want> = stated.outputs.iter().map(|&s| Want::Value(s)).collect();
        let off: Vec<Rule> = rules.iter().map(|(_, rule, _)| *rule).filter(|rule| !may_apply(rule)).collect();
        let program = Program::derive_without(&stated.pools.g, &wanted, &off);
        regular.same_results(&program, "derived")
    });
    tally.assert_few_discards();
}
