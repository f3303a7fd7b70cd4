//! Resubstitution: a step that is the sum, difference or product of two existing values, or of such a pair and a third
//! value, is computed from them if the operations that computed it before can be dropped.
//!
//! The term is from circuit design (Mishchenko, Brayton, *Scalable logic synthesis using a simple circuit structure*,
//! 2006). Here two steps are taken for equal if they agree modulo a prime at a pseudorandom point, where everything but
//! rational functions has pseudorandom values, too. This keeps the value wherever both are defined. Two further
//! conditions apply: the replacement needs no root, function or divisor that the step itself does not need, and at
//! points of several scales it does not increase the rounding error of any result by more than a small factor.

mod forms;
mod residue;
mod rounding;
mod search;

use core::cmp::Reverse;

use rustc_hash::FxHashMap;

use self::forms::{Target, ValuesByResidue};
use self::residue::Residue;
use self::search::Search;
use crate::{Program, Value};

/// Limit on the number of steps; longer programs are left as they are.
const MOST_STEPS: usize = 300;

/// Limit on the number of shared pairs that are tried in a row without success.
const MOST_SHARED: usize = 20;

/// Limit on the number of sources; programs with more are left as they are.
const MOST_SOURCES: usize = 256;

/// The least number of points with finite rounding errors that is needed to check replacements.
const LEAST_POINTS: usize = 2;

/// With this many operations more than a rival, sharing pairs is unlikely to make the program smaller than the rival.
const FAR_BEHIND: usize = 24;

impl Program {
    /// Returns the program with steps computed from others, if that takes fewer operations. Stops early if a rival
    /// stays far ahead.
    pub(super) fn resubstituted(self, rival: Option<usize>) -> Self {
        if self.ops().iter().filter(|op| op.is_step()).count() > MOST_STEPS {
            return self;
        }
        let mut search = Search::new(&self);
        if search.points.len() < LEAST_POINTS || search.all_sources.len() > MOST_SOURCES {
            return self;
        }
        loop {
            let known = search.improve();
            let is_behind = rival.is_some_and(|rival| search.operations() > rival + FAR_BEHIND);
            if is_behind || !search.share_pair(&known) {
                break;
            }
        }
        self.with(&search)
    }

    /// Returns the program with the operations of the search result.
    fn with(mut self, search: &Search) -> Self {
        let mut places = vec![Value::at(0); search.ops.len()];
        let mut ops = Vec::new();
        for &v in &search.order {
            places[v.index()] = Value::at(ops.len());
            ops.push(search.ops[v.index()].map(|part| places[part.index()]));
        }
        self.replace(ops, search.outputs.iter().map(|v| places[v.index()]).collect());
        self.number();
        self
    }
}

impl Search {
    /// Replaces steps until no replacement saves operations. Returns the values that are known then.
    fn improve(&mut self) -> ValuesByResidue {
        loop {
            let mut known = ValuesByResidue::of(self);
            let mut improves = false;
            for target in self.order.clone() {
                improves |= self.replace_step(target, &mut known, None);
            }
            if !improves {
                return known;
            }
        }
    }

    /// Replaces the step at `place` if that saves operations; with `required`, if the replacement uses that value and
    /// costs no more. Returns `true` if the step was replaced.
    fn replace_step(&mut self, place: Value, known: &mut ValuesByResidue, required: Option<Value>) -> bool {
        let Some(target) = Target::of(self, place, known) else { return false };
        let mut forms = target.requiring(required).forms(known);
        forms.sort_by_key(|form| Reverse(form.gain));
        let made = forms.iter().find_map(|form| self.replace(place, form));
        if let Some(made) = made {
            known.values.insert(self.facts[made.index()].residue.unsigned(), made);
        }
        made.is_some()
    }

    /// Adds the pair that makes the most steps smaller, if it pays for several together. Returns `true` if the program
    /// became smaller.
    fn share_pair(&mut self, known: &ValuesByResidue) -> bool {
        if known.pairs.is_empty() {
            return false;
        }
        let mut targets: FxHashMap<Residue, (usize, Vec<Value>)> = FxHashMap::default();
        for target in self.order.iter().filter_map(|&v| Target::of(self, v, known)).filter(|target| target.dropped > 1)
        {
            for pair in target.pairs(known) {
                let (gain, of) = targets.entry(pair).or_default();
                *gain += target.dropped - 1;
                of.push(target.place);
            }
        }
        let mut all: Vec<_> = targets.into_iter().filter(|(_, (_, of))| of.len() > 1).collect();
        all.sort_unstable_by_key(|&(pair, (gain, _))| (Reverse(gain), pair));
        all.into_iter().take(MOST_SHARED).any(|(residue, (_, targets))| {
            let Some((kind, a, b)) = known.pairs.get(residue) else { return false };
            let before = (self.operations(), self.ops.clone(), self.outputs.clone());
            self.push(kind.op(a, b), true);
            let pair = Value::at(self.ops.len() - 1);
            // Counts as an output while it is tried.
            self.outputs.push(pair);
            self.update_order();
            let mut known = known.without_pairs();
            known.values.insert(residue, pair);
            for target in targets {
                self.replace_step(target, &mut known, Some(pair));
            }
            self.outputs.pop();
            self.update_order();
            let is_smaller = self.operations() < before.0;
            if !is_smaller {
                self.restore(before.1, before.2);
            }
            is_smaller
        })
    }
}
