//! Values made of values that are there anyway: a step that is the sum, the difference or the product of two others, or
//! of such a pair and a third, is made of them where what it was made of goes.
//!
//! In the design of circuits this is called resubstitution (Mishchenko, Brayton, *Scalable logic synthesis using a simple
//! circuit structure*, 2006). Here a step is the same as another if it is modulo a prime, at a point as good as random, where what is no
//! rational function is as good as random, too. That keeps the value wherever both have one, so two things are asked for besides: what
//! takes a step's place needs no root, no function and no divisor that the step itself does not need, and at points of several
//! scales rounding does no more harm to any result than before, or hardly.

mod residue;
mod rounding;

use core::cmp::Reverse;

use rustc_hash::FxHashMap;

use self::residue::Residue;
use self::rounding::Rounded;
use crate::{Constant, Function, Number, Op, Program, Value};

/// Longer programs are left as they are, and of programs longer than this, steps are made of two others only.
const MOST_STEPS: usize = 300;
const MOST_IN_PAIRS: usize = 150;

/// How many pairs are tried before it is believed that none is worth it.
const MOST_SHARED: usize = 20;

/// A program that needs more is left as it is.
const MOST_SOURCES: usize = 256;

/// How many points rounding is looked at, and how many of them have to be within the domain.
const POINTS: u32 = 16;
const LEAST_POINTS: usize = 2;

/// By how much the bound of rounding may grow.
const MOST_ROUNDING: f64 = 1.3;

/// Operations that make a value of others, by places behind those that there are.
struct Form {
    ops: Vec<Op>,
    result: Value,
    /// How many operations fewer there are with it.
    gain: usize,
}

/// How a value is made of two.
#[derive(Clone, Copy)]
enum Kind {
    Sum,
    Difference,
    Product,
}

impl Kind {
    fn op<V>(self, a: V, b: V) -> Op<V> {
        match self {
            Self::Sum => Op::Add(a, b),
            Self::Difference => Op::Sub(a, b),
            Self::Product => Op::Mul(a, b),
        }
    }
}

type Pair = (Kind, Value, Value);

/// What there is to make values of, by their residues without the sign.
#[derive(Default)]
struct Known {
    values: FxHashMap<Residue, Value>,
    pairs: FxHashMap<Residue, Pair>,
    /// Whether there is a pair with such a residue: mostly there is none, and this is known at once.
    has_pair: Vec<bool>,
    products: Vec<(Residue, Value, Value)>,
}

/// A set of 256 at most; one too many stands for the last.
#[derive(Clone, Copy, Default)]
struct Sources(u128, u128);

impl Sources {
    fn of(source: usize) -> Self {
        match source.checked_sub(128) {
            None => Self(1 << source, 0),
            Some(source) => Self(0, 1 << source.min(127)),
        }
    }

    fn with(self, others: Self) -> Self {
        Self(self.0 | others.0, self.1 | others.1)
    }

    fn are_among(self, others: Self) -> bool {
        self.0 & !others.0 == 0 && self.1 & !others.1 == 0
    }
}

struct Search {
    /// Those that were given, and those that were added.
    ops: Vec<Op>,
    outputs: Vec<Value>,
    residues: Vec<Residue>,
    inverses: Vec<Residue>,
    /// What a value needs to be finite, and what takes its place may not need besides: inputs, what is no rational function, divisors.
    sources: Vec<Sources>,
    /// Those that there are; each has a bit of its own.
    all_sources: Vec<Residue>,
    /// Whether it counts: what only a series needs does not.
    counts: Vec<bool>,
    /// What is needed, parts first, and how often each is.
    order: Vec<Value>,
    uses: Vec<u32>,
    /// Inputs, and how much rounding there may be in outputs and in what is compared.
    points: Vec<(Vec<Rounded>, Vec<f64>)>,
    /// The comparisons of the given program.
    comparisons: Vec<usize>,
}

impl Program {
    /// Whether it is short enough for the steps to be made of others.
    pub(super) fn is_resubstitutable(&self) -> bool {
        self.ops().iter().filter(|op| op.is_step()).count() <= MOST_STEPS
    }

    /// The program with steps made of others, where that takes fewer operations.
    pub(super) fn resubstituted(&self) -> Self {
        let mut search = Search::new(self);
        if search.points.len() < LEAST_POINTS || search.all_sources.len() > MOST_SOURCES {
            return self.clone();
        }
        loop {
            let known = search.improved();
            if !search.shares(&known) {
                break;
            }
        }
        self.with(&search)
    }

    /// The same inputs with the operations that the search has left.
    fn with(&self, search: &Search) -> Self {
        let mut places = vec![Value::at(0); search.ops.len()];
        let mut ops = Vec::new();
        for &v in &search.order {
            places[v.index()] = Value::at(ops.len());
            ops.push(search.ops[v.index()].map(|part| places[part.index()]));
        }
        let mut program = self.clone();
        program.replace(ops, search.outputs.iter().map(|v| places[v.index()]).collect());
        program.number();
        program
    }
}

impl Search {
    fn new(program: &Program) -> Self {
        let is_comparison = |&place: &usize| matches!(program.ops()[place], Op::SelectLess(..));
        let mut search = Self {
            ops: Vec::new(),
            outputs: program.outputs().to_vec(),
            residues: Vec::new(),
            inverses: Vec::new(),
            sources: Vec::new(),
            all_sources: Vec::new(),
            counts: Vec::new(),
            order: Vec::new(),
            uses: Vec::new(),
            points: Vec::new(),
            comparisons: (0..program.ops().len()).filter(is_comparison).collect(),
        };
        program.ops().iter().for_each(|&op| search.push(op));
        search.counts = program.without_series();
        search.put_in_order();
        for number in 0..POINTS {
            let inputs: Vec<Rounded> = (0..program.inputs().len()).map(|input| at_random(number, input)).collect();
            let most = search.rounding(&inputs);
            if most.iter().all(|bound| bound.is_finite()) {
                search.points.push((inputs, most.into_iter().map(|bound| MOST_ROUNDING * bound).collect()));
            }
        }
        search
    }

    fn push(&mut self, op: Op) {
        let residue = match op {
            Op::Input(i) => Residue::random(("input", i)),
            op => op.map(|v| self.residues[v.index()]).value(&[]),
        };
        let unsigned = |v: Value| self.residues[v.index()].unsigned();
        let (mut sources, mut own) = (Sources::default(), Vec::new());
        match op {
            Op::Call(Function::Sin | Function::Cos, a) => own.push(Residue::random(("turn", unsigned(a)))),
            Op::Input(_) | Op::Tiny | Op::Sqrt(_) | Op::SelectLess(..) | Op::Call(..) | Op::Atan2(..) | Op::Pow(..) => {
                own.push(residue);
            }
            op => op.operands().for_each(|v| sources = sources.with(self.sources[v.index()])),
        }
        if let Op::Div(_, b) = op {
            own.extend(self.divisors(b));
        }
        for source in own {
            let known = self.all_sources.iter().position(|&known| known == source);
            sources = sources.with(Sources::of(known.unwrap_or_else(|| {
                self.all_sources.push(source);
                self.all_sources.len() - 1
            })));
        }
        self.ops.push(op);
        self.residues.push(residue);
        self.inverses.push(residue.inverse());
        self.sources.push(sources);
        self.counts.push(true);
    }

    /// The factors of what is divided by.
    fn divisors(&self, by: Value) -> Vec<Residue> {
        let (mut all, mut found) = (vec![by], Vec::new());
        let mut next = 0;
        while let Some(&v) = all.get(next) {
            next += 1;
            match self.ops[v.index()] {
                // A power's factor is looked at once.
                op @ (Op::Mul(..) | Op::Neg(_)) => op.operands().for_each(|part| {
                    if !all.contains(&part) {
                        all.push(part);
                    }
                }),
                _ => found.push(Residue::random(("divisor", self.residues[v.index()].unsigned()))),
            }
        }
        found
    }

    fn put_in_order(&mut self) {
        self.order.clear();
        self.uses = vec![0; self.ops.len()];
        let mut open: Vec<(Value, bool)> = self.outputs.iter().rev().map(|&v| (v, false)).collect();
        while let Some((v, done)) = open.pop() {
            if done {
                self.order.push(v);
                continue;
            }
            self.uses[v.index()] += 1;
            if self.uses[v.index()] == 1 {
                open.push((v, true));
                let parts: Vec<Value> = self.ops[v.index()].operands().collect();
                open.extend(parts.into_iter().rev().map(|part| (part, false)));
            }
        }
    }

    /// The bounds of what is compared, 0 where that is gone, and of outputs.
    fn rounding(&self, inputs: &[Rounded]) -> Vec<f64> {
        let mut values = vec![Rounded::constant(0.0); self.ops.len()];
        for &v in &self.order {
            values[v.index()] = self.ops[v.index()].map(|part| values[part.index()]).value(inputs);
        }
        let compared = self.comparisons.iter().flat_map(|&place| self.ops[place].operands().take(2));
        compared.chain(self.outputs.iter().copied()).map(|v| values[v.index()].bound).collect()
    }

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
    fn improves_at(&mut self, target: Value, known: &mut Known, added: Option<Value>) -> bool {
        let Some(mut target) = Target::of(self, target, known) else { return false };
        target.added = added;
        let place = target.place;
        let mut forms = target.forms(known);
        forms.sort_by_key(|form| Reverse(form.gain));
        let made = forms.iter().find_map(|form| self.replace(place, form));
        if let Some(made) = made {
            known.values.insert(self.residues[made.index()].unsigned(), made);
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
            let (kind, a, b) = known.pairs[&residue];
            let before = (self.operations(), self.ops.clone(), self.outputs.clone());
            self.push(kind.op(a, b));
            let pair = Value::at(self.ops.len() - 1);
            // As if it were wanted.
            self.outputs.push(pair);
            self.put_in_order();
            let mut known = Known { values: known.values.clone(), ..Known::default() };
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

    fn operations(&self) -> usize {
        self.order.iter().filter(|&&v| self.is_counted(v)).count()
    }

    /// What counts and is not 0.
    fn usable(&self) -> impl Iterator<Item = Value> {
        let usable = |v: &&Value| self.counts[v.index()] && self.residues[v.index()] != Residue::ZERO;
        self.order.iter().filter(usable).copied()
    }

    fn is_counted(&self, v: Value) -> bool {
        self.counts[v.index()] && is_counted(&self.ops[v.index()])
    }

    /// Of (x + 1) − 1 the rounding may be what is wanted.
    fn is_left_of_constants(&self, v: Value) -> bool {
        let constant = |v: Value| matches!(self.ops[v.index()], Op::Constant(_));
        let beside_constant = |v: Value| match self.ops[v.index()] {
            Op::Add(a, b) | Op::Sub(a, b) if constant(b) => Some(a),
            Op::Add(a, b) | Op::Sub(a, b) if constant(a) => Some(b),
            _ => None,
        };
        beside_constant(v).and_then(beside_constant).is_some()
    }

    /// How many operations go with `target` if these values are needed.
    fn freed(&self, target: Value, needed: impl Iterator<Item = Value>) -> usize {
        let mut uses = self.uses.clone();
        needed.for_each(|v| uses[v.index()] += 1);
        let (mut freed, mut open) = (0, vec![target]);
        while let Some(v) = open.pop() {
            freed += usize::from(self.is_counted(v));
            for part in self.ops[v.index()].operands() {
                uses[part.index()] -= 1;
                if uses[part.index()] == 0 {
                    open.push(part);
                }
            }
        }
        freed
    }

    /// Puts the form in the place of `target`, unless that harms the rounding; what now stands there.
    fn replace(&mut self, target: Value, form: &Form) -> Option<Value> {
        let before = (self.ops.clone(), self.outputs.clone());
        form.ops.iter().for_each(|&op| self.push(op));
        let exchange = |v: Value| if v == target { form.result } else { v };
        for &v in &self.order {
            self.ops[v.index()] = self.ops[v.index()].map(exchange);
        }
        self.outputs = self.outputs.iter().map(|&v| exchange(v)).collect();
        self.put_in_order();
        let is_within = |(inputs, most): &(Vec<Rounded>, Vec<f64>)| {
            self.rounding(inputs).iter().zip(most).all(|(bound, most)| bound <= most)
        };
        if self.points.iter().all(is_within) {
            return Some(form.result);
        }
        self.back_to(before.0, before.1);
        None
    }

    fn back_to(&mut self, ops: Vec<Op>, outputs: Vec<Value>) {
        (self.ops, self.outputs) = (ops, outputs);
        self.residues.truncate(self.ops.len());
        self.inverses.truncate(self.ops.len());
        self.sources.truncate(self.ops.len());
        self.counts.truncate(self.ops.len());
        self.put_in_order();
    }
}

/// A step that may be made of others.
struct Target<'s> {
    search: &'s Search,
    place: Value,
    wanted: Residue,
    /// How many operations go with it.
    goes: usize,
    /// What a form has to need.
    added: Option<Value>,
    /// What may be in its place: what does not need it, nor more than it.
    may: Vec<bool>,
}

impl<'s> Target<'s> {
    /// `None` of what stays as it is.
    fn of(search: &'s Search, place: Value, known: &Known) -> Option<Self> {
        if search.uses[place.index()] == 0
            || !search.is_counted(place)
            || !search.ops[place.index()].is_arithmetic()
            || search.is_left_of_constants(place)
        {
            return None;
        }
        let (wanted, goes) = (search.residues[place.index()], search.freed(place, core::iter::empty()));
        let is_known = known.values.get(&wanted.unsigned()).map_or(wanted == Residue::ZERO, |&v| v != place);
        if goes < 2 && !is_known {
            return None;
        }
        let mut after = vec![false; search.ops.len()];
        after[place.index()] = true;
        for &v in &search.order {
            after[v.index()] |= search.ops[v.index()].operands().any(|part| after[part.index()]);
        }
        let mut may = vec![false; search.ops.len()];
        for &v in &search.order {
            may[v.index()] = !after[v.index()] && search.sources[v.index()].are_among(search.sources[place.index()]);
        }
        Some(Self { search, place, wanted, goes, added: None, may })
    }

    fn value(&self, known: &Known, residue: Residue) -> Option<Value> {
        known.values.get(&residue.unsigned()).copied().filter(|v| self.may[v.index()])
    }

    fn pair(&self, known: &Known, residue: Residue) -> Option<Pair> {
        let residue = residue.unsigned();
        if !known.has_pair.get(residue.among(known.has_pair.len())).is_some_and(|&has| has) {
            return None;
        }
        known.pairs.get(&residue).copied().filter(|(_, a, b)| self.may[a.index()] && self.may[b.index()])
    }

    fn at_hand(&self) -> impl Iterator<Item = Value> {
        self.search.usable().filter(|v| self.may[v.index()])
    }

    /// What makes the target together with a value at hand, which comes second: its residue, and how.
    fn others(&self) -> impl Iterator<Item = (Residue, Kind, Value)> {
        self.at_hand().flat_map(move |v| {
            let r = self.search.residues[v.index()];
            [
                (self.wanted - r, Kind::Sum, v),
                (self.wanted + r, Kind::Difference, v),
                (self.wanted * self.search.inverses[v.index()], Kind::Product, v),
            ]
        })
    }

    /// The pairs that together with one other value make the target.
    fn pairs(&self, known: &Known) -> Vec<Residue> {
        let mut pairs: Vec<Residue> =
            self.others().map(|(rest, ..)| rest.unsigned()).filter(|&rest| self.pair(known, rest).is_some()).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// What may take its place.
    fn forms(&self, known: &Known) -> Vec<Form> {
        let Self { search, wanted, goes, .. } = *self;
        let made = || Made { search, ops: Vec::new() };
        if wanted == Residue::ZERO {
            let mut zero = made();
            let result = zero.push(Op::Constant(Constant::new(0.0)));
            return zero.form(self, result).into_iter().collect();
        }
        if let Some(same) = self.value(known, wanted) {
            let mut made = made();
            let result = made.signed(same, search.residues[same.index()], wanted);
            return made.form(self, result).into_iter().collect();
        }
        let mut found = Vec::new();
        for (rest, kind, b) in self.others() {
            let mut made = made();
            let a = if let Some(a) = self.value(known, rest) {
                made.signed(a, search.residues[a.index()], rest)
            } else if goes > 2
                && let Some(pair) = self.pair(known, rest)
            {
                made.pair(pair, rest)
            } else {
                continue;
            };
            let result = made.push(kind.op(a, b));
            found.extend(made.form(self, result));
        }
        if goes > 3 {
            for &(product, x, y) in &known.products {
                if !self.may[x.index()] || !self.may[y.index()] {
                    continue;
                }
                for (rest, kind) in [(wanted - product, Kind::Sum), (wanted + product, Kind::Difference)] {
                    if let Some(pair) = self.pair(known, rest) {
                        let mut made = made();
                        let a = made.pair(pair, rest);
                        let b = made.push(Op::Mul(x, y));
                        let result = made.push(kind.op(a, b));
                        found.extend(made.form(self, result));
                    }
                }
            }
        }
        found
    }
}

impl Known {
    fn of(search: &Search) -> Self {
        let mut known = Self::default();
        let usable: Vec<Value> = search.usable().collect();
        let residue = |v: Value| search.residues[v.index()];
        for &v in &usable {
            known.values.entry(residue(v).unsigned()).or_insert(v);
        }
        if usable.len() > MOST_IN_PAIRS {
            return known;
        }
        let most = usable.len() * (usable.len() + 1) * 3 / 2;
        known.pairs.reserve(most);
        known.has_pair = vec![false; (8 * most).next_power_of_two()];
        for (place, &a) in usable.iter().enumerate() {
            for &b in &usable[place..] {
                let (r, s) = (residue(a), residue(b));
                known.products.push((r * s, a, b));
                let made =
                    [(r + s, (Kind::Sum, a, b)), (r - s, (Kind::Difference, a, b)), (r * s, (Kind::Product, a, b))];
                for (made, pair) in made {
                    let made = made.unsigned();
                    let has = made.among(known.has_pair.len());
                    known.has_pair[has] = true;
                    known.pairs.entry(made).or_insert(pair);
                }
            }
        }
        known.pairs.remove(&Residue::ZERO);
        known
    }
}

/// Operations of a form.
struct Made<'s> {
    search: &'s Search,
    ops: Vec<Op>,
}

impl Made<'_> {
    fn push(&mut self, op: Op) -> Value {
        self.ops.push(op);
        Value::at(self.search.ops.len() + self.ops.len() - 1)
    }

    /// The form, if it is smaller.
    fn form(self, target: &Target<'_>, result: Value) -> Option<Form> {
        let added = self.ops.iter().filter(|op| is_counted(op)).count();
        if added >= target.goes + usize::from(target.added.is_some()) {
            return None;
        }
        let needed = || {
            self.ops.iter().flat_map(|op| op.operands()).chain([result]).filter(|v| v.index() < self.search.ops.len())
        };
        let gain = self.search.freed(target.place, needed()).checked_sub(added)?;
        if target.added.map_or(gain == 0, |added| needed().all(|v| v != added)) {
            return None;
        }
        Some(Form { ops: self.ops, result, gain })
    }

    /// `value` or its negation, whichever has the residue that is wanted.
    fn signed(&mut self, value: Value, residue: Residue, wanted: Residue) -> Value {
        if residue == wanted { value } else { self.push(Op::Neg(value)) }
    }

    fn pair(&mut self, (kind, a, b): Pair, wanted: Residue) -> Value {
        let residue = kind.op(a, b).map(|v| self.search.residues[v.index()]).value(&[]);
        let made = self.push(kind.op(a, b));
        self.signed(made, residue, wanted)
    }
}

fn is_counted(op: &Op) -> bool {
    op.is_step() && !matches!(op, Op::SelectLess(..))
}

/// An input of the point with this number: of two scales, or of many; of all signs, or positive.
fn at_random(number: u32, input: usize) -> Rounded {
    let unit = |what: &str| Residue::random((what, number, input)).unit();
    let size = if number % 4 < 2 { unit("size") } else { 10f64.powf(4.0 * unit("size") - 3.0) };
    Rounded::constant(if number % 2 == 0 && unit("sign") < 0.5 { -size } else { size })
}
