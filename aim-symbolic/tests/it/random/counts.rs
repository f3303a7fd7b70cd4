//! Effect of rules on operation counts.

use std::cell::RefCell;

use aim_symbolic::rules::Rule;
use aim_symbolic::{Program, Scalar, Want};

use super::judge::{Verdict, for_each, single_rules, smallest_failure};
use super::plain;
use super::recipe::{BuiltStatement, Recipe};

/// Rules that only simplify or rephrase. Each other rule may raise a count when applied alone: it may take apart shared
/// expressions, or rely on other rules to finish.
const TAKE_AWAY: [&str; 8] = [
    "the root of a square is a norm",
    "fold zero and one",
    "split composition",
    "cancel terms",
    "all of what is across is across",
    "dot, then sign",
    "one reciprocal for a direction",
    "a part across is a difference",
];

fn operations(program: &Program) -> usize {
    program.count().total() + program.count().call
}

/// Effect of rules on a count, over many statements.
#[derive(Clone, Default)]
struct Change {
    applied: usize,
    raised: usize,
    lowered: usize,
    most_raised: usize,
    most_lowered: usize,
}

impl Change {
    fn add(&mut self, before: usize, after: usize) {
        self.applied += 1;
        self.raised += usize::from(after > before);
        self.lowered += usize::from(after < before);
        self.most_raised = self.most_raised.max(after.saturating_sub(before));
        self.most_lowered = self.most_lowered.max(before.saturating_sub(after));
    }

    fn print(&self, what: &str) {
        let Self { applied, raised, lowered, most_raised, most_lowered } = self;
        println!(
            "{what}: of {applied} raised {raised} (by up to {most_raised}), lowered {lowered} (by up to {most_lowered})"
        );
    }
}

fn texts(g: &aim_symbolic::Graph, all: &[Scalar]) -> String {
    let texts: Vec<String> = all.iter().map(|&s| plain::scalar(g, s)).collect();
    texts.join(" ; ")
}

/// Applies each rule alone and reports those that change something: index, counts before and after, and the result.
fn each_alone(recipe: &Recipe, mut print: impl FnMut(usize, usize, usize, String)) {
    let mut stated = recipe.build();
    let g = &mut stated.pools.g;
    let before = operations(&Program::compile(g, &stated.outputs));
    for (place, (.., alone)) in single_rules().iter().enumerate() {
        let rewritten = g.rewrite_by(&stated.outputs, alone);
        if rewritten != stated.outputs {
            let after = operations(&Program::compile(g, &rewritten));
            let made = if after > before { texts(g, &rewritten) } else { String::new() };
            print(place, before, after, made);
        }
    }
}

#[test]
fn removing_rules_never_raise_the_operation_count() {
    let rules = single_rules();
    for name in TAKE_AWAY {
        assert!(rules.iter().any(|(_, rule, _)| rule.name == name), "there is no rule “{name}”");
    }
    for_each(20_000, 8, |recipe| {
        let mut verdict = Ok(());
        each_alone(recipe, |place, before, after, made| {
            let (set, rule, _) = rules[place];
            if after > before && TAKE_AWAY.contains(&rule.name) {
                verdict = Err(format!("{set}: {rule}: {before} to {after} operations: {made}"));
            }
        });
        verdict
    });
}

/// Also prints how often each rule raises and lowers counts, with the smallest example that raises one.
#[test]
#[ignore = "some rules alone raise counts; the choices between them decide"]
fn no_single_rule_raises_the_operation_count() {
    let rules = single_rules();
    let changes = RefCell::new(vec![Change::default(); rules.len()]);
    for_each(20_000, 8, |recipe| {
        each_alone(recipe, |place, before, after, _| changes.borrow_mut()[place].add(before, after));
        Ok(())
    });
    for ((set, rule, _), change) in rules.iter().zip(changes.borrow().iter()) {
        change.print(&format!("{set}: {rule}"));
        let found = smallest_failure(if change.raised > 0 { 20_000 } else { 0 }, 8, |recipe| {
            let mut verdict = Ok(());
            each_alone(recipe, |place, before, after, made| {
                if after > before && rules[place].1 == *rule {
                    verdict = Err(format!("{before} to {after} operations: {made}"));
                }
            });
            verdict
        });
        if let Err((recipe, reason)) = found {
            println!("    {recipe:?}\n    {reason}");
        }
    }
    assert!(changes.borrow().iter().all(|change| change.raised == 0), "rules raise counts: see above");
}

/// Comparison of derivations with and without rules.
pub(crate) struct Comparison {
    off: Vec<Rule>,
    change: RefCell<Change>,
}

impl Default for Comparison {
    fn default() -> Self {
        // Limit rules do not aim at smaller counts.
        let of_counts = single_rules().into_iter().filter(|(set, ..)| *set != "limits");
        Self { off: of_counts.map(|(_, rule, _)| rule).collect(), change: RefCell::default() }
    }
}

impl Comparison {
    /// Checks that `program` needs no more operations than a derivation without rules. The rearrangement of the latter
    /// is bounded, so the check could fail in principle; it does for none of the tested statements.
    pub(crate) fn is_no_larger(&self, stated: &BuiltStatement, wanted: &[Want], program: &Program) -> Verdict {
        let plain = Program::derive_without(&stated.pools.g, wanted, &self.off);
        let (without, with) = (operations(&plain), operations(program));
        self.change.borrow_mut().add(without, with);
        if with > without { Err(format!("{with} operations instead of {without} for {wanted:?}")) } else { Ok(()) }
    }

    pub(crate) fn print(&self) {
        self.change.borrow().print("all rules");
    }
}
