//! Candidate forms of a step: one existing value, two of them, a pair and a third value, or two pairs.

use rustc_hash::FxHashMap;

use super::residue::Residue;
use super::search::{Form, Search, is_counted};
use crate::{Constant, Op, Value};

/// Limit on the number of values of which pairs are formed.
const MOST_IN_PAIRS: usize = 150;

/// An operation on two values.
#[derive(Clone, Copy)]
pub(super) enum PairOp {
    Sum,
    Difference,
    Product,
}

impl PairOp {
    pub(super) fn op<V>(self, a: V, b: V) -> Op<V> {
        match self {
            Self::Sum => Op::Add(a, b),
            Self::Difference => Op::Sub(a, b),
            Self::Product => Op::Mul(a, b),
        }
    }
}

pub(super) type Pair = (PairOp, Value, Value);

/// The existing values, and pairs of them, by their residues up to sign.
#[derive(Default)]
pub(super) struct ValuesByResidue {
    pub(super) values: FxHashMap<Residue, Value>,
    pub(super) pairs: Pairs,
    /// Residues of signed products, with the operation that adds the product and its two factors.
    products: Vec<(Residue, PairOp, Value, Value)>,
}

/// A step that may be computed from others.
pub(super) struct Target<'s> {
    search: &'s Search,
    pub(super) place: Value,
    wanted: Residue,
    /// The number of operations that are dropped together with the step.
    pub(super) dropped: usize,
    /// The value that a form must use.
    required: Option<Value>,
    /// For each value, `true` if a replacement may use it: it does not depend on the step and needs no sources beyond
    /// the step's.
    is_usable: Vec<bool>,
}

impl<'s> Target<'s> {
    /// Returns `None` if the step cannot be replaced.
    pub(super) fn of(search: &'s Search, place: Value, known: &ValuesByResidue) -> Option<Self> {
        if search.uses[place.index()] == 0
            || !search.is_counted(place)
            || !search.ops[place.index()].is_arithmetic()
            || search.is_left_of_constants(place)
        {
            return None;
        }
        let (wanted, dropped) = (search.facts[place.index()].residue, search.count_freed(place, core::iter::empty()));
        let is_known = known.values.get(&wanted.unsigned()).map_or(wanted == Residue::ZERO, |&v| v != place);
        if dropped < 2 && !is_known {
            return None;
        }
        let sources = search.facts[place.index()].sources;
        let mut after = vec![false; search.ops.len()];
        let mut is_usable = vec![false; search.ops.len()];
        let mut is_past = false;
        for &v in &search.order {
            is_past |= v == place;
            after[v.index()] =
                is_past && (v == place || search.ops[v.index()].operands().any(|part| after[part.index()]));
            is_usable[v.index()] = !after[v.index()] && search.facts[v.index()].sources.are_among(sources);
        }
        Some(Self { search, place, wanted, dropped, required: None, is_usable })
    }

    /// Requires forms to use this value; such a form need not save operations.
    pub(super) fn requiring(self, required: Option<Value>) -> Self {
        Self { required, ..self }
    }

    fn value(&self, known: &ValuesByResidue, residue: Residue) -> Option<Value> {
        known.values.get(&residue.unsigned()).copied().filter(|v| self.is_usable[v.index()])
    }

    fn pair(&self, known: &ValuesByResidue, residue: Residue) -> Option<Pair> {
        known.pairs.get(residue.unsigned()).filter(|(_, a, b)| self.is_usable[a.index()] && self.is_usable[b.index()])
    }

    /// For each usable value, the residue that combines with it to the target, the operation, and the value as second
    /// operand.
    fn others(&self) -> impl Iterator<Item = (Residue, PairOp, Value)> {
        let at_hand = |v: &Value| self.is_usable[v.index()] && self.required.is_none_or(|required| *v == required);
        self.search.usable().filter(at_hand).flat_map(move |v| {
            let r = self.search.facts[v.index()].residue;
            [
                (self.wanted - r, PairOp::Sum, v),
                (self.wanted + r, PairOp::Difference, v),
                (self.wanted * self.search.facts[v.index()].inverse, PairOp::Product, v),
            ]
        })
    }

    /// Returns the pairs that combine with one other value to the target.
    pub(super) fn pairs(&self, known: &ValuesByResidue) -> Vec<Residue> {
        let mut pairs: Vec<Residue> =
            self.others().map(|(rest, ..)| rest.unsigned()).filter(|&rest| self.pair(known, rest).is_some()).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Returns the forms that may replace the target.
    pub(super) fn forms(&self, known: &ValuesByResidue) -> Vec<Form> {
        let Self { search, wanted, dropped, .. } = *self;
        let made = || FormBuilder { search, ops: Vec::new() };
        if wanted == Residue::ZERO {
            let mut zero = made();
            let result = zero.push(Op::Constant(Constant::new(0.0)));
            return zero.form(self, result).into_iter().collect();
        }
        if let Some(same) = self.value(known, wanted) {
            let mut made = made();
            let result = made.signed(same, search.facts[same.index()].residue, wanted);
            return made.form(self, result).into_iter().collect();
        }
        let mut found = Vec::new();
        for (rest, kind, b) in self.others() {
            let mut made = made();
            let a = if let Some(a) = self.value(known, rest) {
                made.signed(a, search.facts[a.index()].residue, rest)
            } else if dropped > 2
                && let Some(pair) = self.pair(known, rest)
            {
                made.pair(pair, rest)
            } else {
                continue;
            };
            let result = made.push(kind.op(a, b));
            found.extend(made.form(self, result));
        }
        if dropped > 3 {
            for &(product, kind, x, y) in &known.products {
                if self.is_usable[x.index()]
                    && self.is_usable[y.index()]
                    && let Some(pair) = self.pair(known, wanted - product)
                {
                    let mut made = made();
                    let a = made.pair(pair, wanted - product);
                    let b = made.push(Op::Mul(x, y));
                    let result = made.push(kind.op(a, b));
                    found.extend(made.form(self, result));
                }
            }
        }
        found
    }
}

impl ValuesByResidue {
    /// Returns only the values.
    pub(super) fn without_pairs(&self) -> Self {
        Self { values: self.values.clone(), ..Self::default() }
    }

    pub(super) fn of(search: &Search) -> Self {
        let mut known = Self::default();
        let usable: Vec<Value> = search.usable().collect();
        let residue = |v: Value| search.facts[v.index()].residue;
        for &v in &usable {
            known.values.entry(residue(v).unsigned()).or_insert(v);
        }
        if usable.len() > MOST_IN_PAIRS {
            return known;
        }
        let most = usable.len() * (usable.len() + 1) * 3 / 2;
        known.pairs = Pairs::with_room_for(most);
        for (place, &a) in usable.iter().enumerate() {
            for &b in &usable[place..] {
                let (r, s) = (residue(a), residue(b));
                known.products.push((r * s, PairOp::Sum, a, b));
                known.products.push((-(r * s), PairOp::Difference, a, b));
                let made = [
                    (r + s, (PairOp::Sum, a, b)),
                    (r - s, (PairOp::Difference, a, b)),
                    (r * s, (PairOp::Product, a, b)),
                ];
                for (made, pair) in made {
                    known.pairs.insert(made.unsigned(), pair);
                }
            }
        }
        known
    }
}

/// Pairs by their residues, with open addressing: fast even without optimisation, and procedural macros are usually
/// compiled without.
#[derive(Default)]
pub(super) struct Pairs {
    slots: Vec<Option<(Residue, Pair)>>,
    /// A bit filter that is small enough to stay in the cache: most residues have no pair.
    bits: Vec<u64>,
}

impl Pairs {
    fn with_room_for(most: usize) -> Self {
        Self { slots: vec![None; (2 * most).next_power_of_two()], bits: vec![0; (most / 4).next_power_of_two()] }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    pub(super) fn get(&self, residue: Residue) -> Option<Pair> {
        if self.is_empty() || self.bits[residue.among(self.bits.len())] & residue.bit() == 0 {
            return None;
        }
        self.slots[self.place(residue)].map(|(_, pair)| pair)
    }

    /// Inserts a pair, unless its residue has one already or is 0.
    fn insert(&mut self, residue: Residue, pair: Pair) {
        let (place, word) = (self.place(residue), residue.among(self.bits.len()));
        self.bits[word] |= residue.bit();
        if residue != Residue::ZERO && self.slots[place].is_none() {
            self.slots[place] = Some((residue, pair));
        }
    }

    fn place(&self, residue: Residue) -> usize {
        let mut place = residue.among(self.slots.len());
        while let Some((known, _)) = self.slots[place]
            && known != residue
        {
            place = (place + 1) % self.slots.len();
        }
        place
    }
}

/// The operations of a form under construction.
struct FormBuilder<'s> {
    search: &'s Search,
    ops: Vec<Op>,
}

impl FormBuilder<'_> {
    fn push(&mut self, op: Op) -> Value {
        self.ops.push(op);
        Value::at(self.search.ops.len() + self.ops.len() - 1)
    }

    /// Returns the form if it saves operations.
    fn form(self, target: &Target<'_>, result: Value) -> Option<Form> {
        let added = self.ops.iter().filter(|op| is_counted(op)).count();
        if added >= target.dropped + usize::from(target.required.is_some()) {
            return None;
        }
        let needed = || {
            self.ops.iter().flat_map(|op| op.operands()).chain([result]).filter(|v| v.index() < self.search.ops.len())
        };
        let gain = self.search.count_freed(target.place, needed()).checked_sub(added)?;
        if target.required.map_or(gain == 0, |required| needed().all(|v| v != required)) {
            return None;
        }
        Some(Form { ops: self.ops, result, gain })
    }

    /// Returns `value` or its negation, whichever has the wanted residue.
    fn signed(&mut self, value: Value, residue: Residue, wanted: Residue) -> Value {
        if residue == wanted { value } else { self.push(Op::Neg(value)) }
    }

    fn pair(&mut self, (kind, a, b): Pair, wanted: Residue) -> Value {
        let residue = Residue::result(kind.op(a, b).map(|v| self.search.facts[v.index()].residue));
        let made = self.push(kind.op(a, b));
        self.signed(made, residue, wanted)
    }
}
