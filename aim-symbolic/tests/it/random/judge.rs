//! Runs tests on random statements and compares results.
//!
//! `AIM_RANDOM_TIMES=20` runs twenty times as many cases, `AIM_RANDOM_SEED=7` different ones, `AIM_RANDOM_STEPS=16`
//! larger ones.

use std::cell::Cell;
use std::sync::LazyLock;

use aim_symbolic::rules::{
    ANGLE_OF_SCALED, CANCELLED_DIVISION, CANCELLED_SCALE, DIRECTION_OF_SCALED, DIRECTIONS, FRAMES, LIMITS, PRODUCTS,
    RATIOS, ROTATIONS, Rule, RuleSet, SCALES, WORDING,
};
use aim_symbolic::{Program, Scalar};
use fastrand::Rng;
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};

use super::evaluate::Evaluation;
use super::field::{Field, Undefined, hash};
use super::material::{Sample, point};
use super::recipe::{BuiltStatement, Recipe, Recipes};

/// Rule sets in the order in which they are applied.
pub(crate) const SETS: [(&str, RuleSet); 8] = [
    ("limits", LIMITS),
    ("wording", WORDING),
    ("ratios", RATIOS),
    ("rotations", ROTATIONS),
    ("directions", DIRECTIONS),
    ("frames", FRAMES),
    ("scales", SCALES),
    ("products", PRODUCTS),
];

fn setting(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Returns `true` if all cases are tested, as in `.ci/run`. Plain `cargo test` runs a sixteenth.
pub(crate) fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// Returns the factor on the number of cases.
pub(crate) fn times() -> u64 {
    setting("AIM_RANDOM_TIMES").unwrap_or(1)
}

/// Returns the number of cases to run.
fn scaled(cases: u64) -> u64 {
    let part = if in_full() { cases } else { cases.div_ceil(16) };
    part * times()
}

/// Result of a test on a recipe.
pub(crate) type Verdict = Result<(), String>;

/// Tests `cases` random statements of at most `most` steps; panics with the smallest failing one.
pub(crate) fn for_each(cases: u64, most: usize, test: impl Fn(&Recipe) -> Verdict) {
    if let Err((recipe, reason)) = smallest_failure(cases, most, test) {
        panic!("{reason}\nin the statement {recipe:?}");
    }
}

/// Returns the smallest failing statement and the reason.
pub(crate) fn smallest_failure(
    cases: u64,
    most: usize,
    test: impl Fn(&Recipe) -> Verdict,
) -> Result<(), (Recipe, String)> {
    let cases = scaled(cases);
    let mut runner = TestRunner::new(Config {
        cases: u32::try_from(cases).expect("fewer than four billion"),
        rng_seed: RngSeed::Fixed(setting("AIM_RANDOM_SEED").unwrap_or(1)),
        failure_persistence: None,
        max_shrink_iters: 100_000,
        ..Config::default()
    });
    let most = setting("AIM_RANDOM_STEPS").map_or(most, |steps| usize::try_from(steps).expect("a few"));
    match runner.run(&Recipes { most }, |recipe| test(&recipe).map_err(TestCaseError::fail)) {
        Ok(()) => Ok(()),
        Err(TestError::Fail(reason, recipe)) => Err((recipe, reason.message().to_owned())),
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

/// Returns a rule set for each single rule: the original set's name, the rule, the set.
pub(crate) fn single_rules() -> Vec<(&'static str, Rule, RuleSet)> {
    let mut single = Vec::new();
    for (name, set) in SETS {
        for (i, rule) in set.rules.iter().enumerate() {
            single.push((name, *rule, RuleSet { rules: &set.rules[i..=i], sums: set.sums }));
        }
    }
    single
}

/// Point at which a statement has a value and is not singular.
pub(crate) struct Regular {
    pub(crate) evaluation: Evaluation<Field>,
    pub(crate) values: Vec<Field>,
}

/// Looks for a regular point, preferably one at which roots are lengths. The required roots must exist, which holds for
/// half of the points per nested root.
pub(crate) fn regular(stated: &BuiltStatement, seed: u64) -> Option<Regular> {
    let mut found = None;
    for attempt in 0..16 {
        let mut random = Rng::with_seed(hash(&[seed, attempt]));
        let mut evaluation = Evaluation::new(point(&mut random));
        let values: Vec<Field> = stated.outputs.iter().map(|&s| evaluation.scalar(&stated.pools.g, s)).collect();
        let undefined = values.iter().find_map(|v| v.undefined());
        match undefined {
            None if !evaluation.singular => {
                let has_lengths = !evaluation.no_length;
                found = Some(Regular { evaluation, values });
                if has_lengths {
                    break;
                }
            }
            Some(Undefined::Root) => {}
            _ => break,
        }
    }
    found
}

impl Regular {
    /// Returns the rules that need not hold here.
    pub(crate) fn without(&self) -> &'static [Rule] {
        if self.evaluation.no_length { &OF_LENGTHS } else { &[] }
    }

    /// Returns the sets of rules that hold here.
    pub(crate) fn sets(&self) -> &'static [(&'static str, RuleSet)] {
        static OF_ANYTHING: LazyLock<Vec<(&str, RuleSet)>> = LazyLock::new(|| {
            let holds = |rule: &Rule| !OF_LENGTHS.contains(rule);
            let of_anything = |set: RuleSet| {
                let rules: Vec<Rule> = set.rules.iter().copied().filter(holds).collect();
                RuleSet { rules: rules.leak(), ..set }
            };
            SETS.map(|(name, set)| (name, of_anything(set))).to_vec()
        });
        if self.evaluation.no_length { &OF_ANYTHING } else { &SETS }
    }
}

/// Rules that hold for lengths only; other roots have an arbitrary sign.
pub(crate) const OF_LENGTHS: [Rule; 4] = [ANGLE_OF_SCALED, DIRECTION_OF_SCALED, CANCELLED_DIVISION, CANCELLED_SCALE];

/// Returns a random point, for number types that have all roots.
pub(crate) fn anywhere<T: Sample>(seed: u64) -> Evaluation<T> {
    Evaluation::new(point(&mut Rng::with_seed(seed)))
}

impl Regular {
    /// Checks that `rewritten` has the same values.
    pub(crate) fn same_values(&mut self, stated: &BuiltStatement, rewritten: &[Scalar], what: &str) -> Verdict {
        for (i, &s) in rewritten.iter().enumerate() {
            let value = self.evaluation.scalar(&stated.pools.g, s);
            same(self.values[i], value, what)?;
        }
        Ok(())
    }

    /// Checks that `program` gives the same results.
    pub(crate) fn same_results(&self, program: &Program, what: &str) -> Verdict {
        let mut results = vec![Field::ZERO; self.values.len()];
        program.run(self.evaluation.inputs(), &mut results);
        self.values.iter().zip(results).try_for_each(|(&value, result)| same(value, result, what))
    }
}

/// Checks that `found` equals `expected`. Values lost to missing roots or constants are not compared.
pub(crate) fn same(expected: Field, found: Field, what: &str) -> Verdict {
    let lost = matches!(expected.undefined(), Some(Undefined::Root | Undefined::Constant))
        || found.undefined() == Some(Undefined::Constant);
    if lost || (expected == found && expected.undefined().is_none()) {
        return Ok(());
    }
    Err(format!("{what}: {found:?} instead of {expected:?}"))
}

/// Number of statements that were judged, and of those that could not be.
#[derive(Default)]
pub(crate) struct JudgedCount {
    judged: Cell<u32>,
    discarded: Cell<u32>,
}

impl JudgedCount {
    pub(crate) fn judge(&self) {
        self.judged.set(self.judged.get() + 1);
    }

    pub(crate) fn discard(&self) -> Verdict {
        self.discarded.set(self.discarded.get() + 1);
        Ok(())
    }

    pub(crate) fn assert_few_discards(&self) {
        let (judged, discarded) = (self.judged.get(), self.discarded.get());
        println!("{judged} judged, {discarded} discarded");
        assert!(discarded * 3 < judged, "{judged} judged, {discarded} discarded");
    }
}
