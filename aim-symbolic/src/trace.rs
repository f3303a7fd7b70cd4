//! The book-keeping of a derivation: which rules brought the operation count from what to what.

use crate::derive::{ARITHMETIC, Way, choose};
use crate::program::Effort;
use crate::tidy::Log;
use crate::{Count, Graph, Program, Want};

/// Rules that together brought a program's operation count down.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Their names, in the order in which they were first applied, and how often each was.
    pub rules: Vec<(&'static str, usize)>,
    /// The operations of the program if rewriting had stopped before it.
    pub before: Count,
    /// The operations of the program if rewriting had stopped after it.
    pub after: Count,
}

impl Program {
    /// How rules led from the statement to the program: each step brings the count down that the program would have if
    /// rewriting had stopped there and derivatives had been taken of what was there.
    ///
    /// The first step starts from the statement as it stands: every operation of it and of its derivatives is done, also
    /// those with 0 and 1.
    pub fn trace(g: &Graph, wanted: &[Want]) -> Vec<Step> {
        let (_, choices) = choose(g, wanted, &[]);
        let way = |log: Log, off: &[&str]| Way::taken(g, wanted, choices.clone(), off, log, Effort::Finish);
        let count = |rewrites: usize, off: &[&str]| way(Log::limited(rewrites), off).program.count();
        let applied = way(Log::default(), &[]).log.applied;
        let mut book = Book { steps: Vec::new(), rules: Vec::new(), count: count(0, &ARITHMETIC) };
        for on in 1..=ARITHMETIC.len() {
            book.record(ARITHMETIC[on - 1], count(0, &ARITHMETIC[on..]));
            // What did nothing by itself is not part of what comes after it.
            book.rules.clear();
        }
        for (before, &rule) in applied.iter().enumerate() {
            book.record(rule, count(before + 1, &[]));
        }
        book.steps
    }
}

struct Book {
    steps: Vec<Step>,
    /// What was applied since the last step.
    rules: Vec<(&'static str, usize)>,
    /// The least count so far.
    count: Count,
}

impl Book {
    fn record(&mut self, rule: &'static str, after: Count) {
        match self.rules.iter_mut().find(|(known, _)| *known == rule) {
            Some((_, times)) => *times += 1,
            None => self.rules.push((rule, 1)),
        }
        if after.total() < self.count.total() {
            self.steps.push(Step { rules: core::mem::take(&mut self.rules), before: self.count, after });
            self.count = after;
        }
    }
}
