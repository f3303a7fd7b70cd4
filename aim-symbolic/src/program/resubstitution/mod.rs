//! Values made of values that are there anyway: a step that is the sum, the difference or the product of two others, or
//! of such a pair and a third, is made of them where what it was made of goes.
//!
//! In the design of circuits this is called resubstitution (Mishchenko, Brayton, *Scalable logic synthesis using a simple
//! circuit structure*, 2006). Here a step is the same as another if it is modulo a prime, at a point as good as random, where what is no
//! rational function is as good as random, too. That keeps the value wherever both have one, so two things are asked for besides: what
//! takes a step's place needs no root, no function and no divisor that the step itself does not need, and at points of several
//! scales rounding does no more harm to any result than before, or hardly.

mod forms;
mod residue;
mod rounding;
mod search;

use core::cmp::Reverse;

use rustc_hash::FxHashMap;

use self::forms::{Known, Target};
use self::residue::Residue;
use self::search::Search;
use crate::{Program, Value};

/// Longer programs are left as they are.
const MOST_STEPS: usize = 300;

/// So many pairs are tried before it is believed that none is worth it.
const MOST_SHARED: usize = 20;

/// A program that needs more is left as it is.
const MOST_SOURCES: usize = 256;

/// So many of the points at least have to be within the domain.
const LEAST_POINTS: usize = 2;

/// With so many operations more than a rival's, shared pairs will hardly make it smaller than that.
const FAR_BEHIND: usize = 24;

impl Program {
    /// The program with steps made of others, where that takes fewer operations; it is given up where a rival stays ahead.
    pub(super) fn resubstituted(self, rival: Option<usize>) -> Self {
        if self.ops().iter().filter(|op| op.is_step()).count() > MOST_STEPS {
            return self;
        }
        let mut search = Search::new(&self);
        if search.points.len() < LEAST_POINTS || search.all_sources.len() > MOST_SOURCES {
            return self;
        }
        loop {
            let known = search.improved();
            let is_behind = rival.is_some_and(|rival| search.operations() > rival + FAR_BEHIND);
            if is_behind || !search.shares(&known) {
                break;
            }
        }
        self.with(&search)
    }

    /// The same inputs with the operations that the search has left.
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
    /// Rounds over all steps while one is made of others; what is known then.
    fn improved(&mut self) -> Known {
        loop {
            let mut known = Known::of(self);
            let mut improves = false;
            for target in self.order.clone() {
                improves |= self.improves_at(target, &mut known, None);
            }
            if !improves {
                return known;
            }
        }
    }

    /// With `added`, whatever is no worse and needs that.
    fn improves_at(&mut self, place: Value, known: &mut Known, added: Option<Value>) -> bool {
        let Some(target) = Target::of(self, place, known) else { return false };
        let mut forms = target.with(added).forms(known);
        forms.sort_by_key(|form| Reverse(form.gain));
        let made = forms.iter().find_map(|form| self.replace(place, form));
        if let Some(made) = made {
            known.values.insert(self.facts[made.index()].residue.unsigned(), made);
        }
        made.is_some()
    }

    /// Adds the pair that makes most steps smaller, which alone it would not; true if there is one.
    fn shares(&mut self, known: &Known) -> bool {
        if known.pairs.is_empty() {
            return false;
        }
        let mut targets: FxHashMap<Residue, (usize, Vec<Value>)> = FxHashMap::default();
        for target in self.order.iter().filter_map(|&v| Target::of(self, v, known)).filter(|target| target.goes > 1) {
            for pair in target.pairs(known) {
                let (gain, of) = targets.entry(pair).or_default();
                *gain += target.goes - 1;
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
            // As if it were wanted.
            self.outputs.push(pair);
            self.put_in_order();
            let mut known = known.without_pairs();
            known.values.insert(residue, pair);
            for target in targets {
                self.improves_at(target, &mut known, Some(pair));
            }
            self.outputs.pop();
            self.put_in_order();
            let is_smaller = self.operations() < before.0;
            if !is_smaller {
                self.back_to(before.1, before.2);
            }
            is_smaller
        })
    }
}
