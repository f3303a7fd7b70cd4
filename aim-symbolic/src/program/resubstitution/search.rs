//! A program while its steps are made of others: what each value is, what needs it, and what rounding does.

use super::residue::Residue;
use super::rounding::Rounded;
use crate::{Function, Number, Op, Program, Value};

/// Rounding is looked at in so many points.
const POINTS: u32 = 16;

/// The bound of rounding may grow by this factor.
const MOST_ROUNDING: f64 = 1.3;

/// Operations that make a value of others, by places behind those that there are.
pub(super) struct Form {
    pub(super) ops: Vec<Op>,
    pub(super) result: Value,
    /// The operations that it saves.
    pub(super) gain: usize,
}

/// A set of 256 at most; one too many stands for the last.
#[derive(Clone, Copy, Default)]
pub(super) struct Sources(u128, u128);

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

    pub(super) fn are_among(self, others: Self) -> bool {
        self.0 & !others.0 == 0 && self.1 & !others.1 == 0
    }
}

/// A value's properties that stay whatever it is made of.
pub(super) struct Facts {
    pub(super) residue: Residue,
    /// One over it.
    pub(super) inverse: Residue,
    /// Inputs, divisors and what is no rational function: the value needs them to be finite, and what takes its place may need no
    /// others.
    pub(super) sources: Sources,
    /// False of what only a series needs.
    pub(super) counts: bool,
}

pub(super) struct Search {
    /// Those that were given, and those that were added.
    pub(super) ops: Vec<Op>,
    pub(super) outputs: Vec<Value>,
    /// For each of the operations.
    pub(super) facts: Vec<Facts>,
    /// All sources; each has a bit of its own.
    pub(super) all_sources: Vec<Residue>,
    /// All that is needed, parts first, and how often each is.
    pub(super) order: Vec<Value>,
    pub(super) uses: Vec<u32>,
    /// Inputs, and how much rounding there may be in outputs and in what is compared.
    pub(super) points: Vec<(Vec<Rounded>, Vec<f64>)>,
    /// The comparisons of the given program.
    comparisons: Vec<usize>,
}

impl Search {
    pub(super) fn new(program: &Program) -> Self {
        let is_comparison = |&place: &usize| matches!(program.ops()[place], Op::SelectLess(..));
        let mut search = Self {
            ops: Vec::new(),
            outputs: program.outputs().to_vec(),
            facts: Vec::new(),
            all_sources: Vec::new(),
            order: Vec::new(),
            uses: Vec::new(),
            points: Vec::new(),
            comparisons: (0..program.ops().len()).filter(is_comparison).collect(),
        };
        for (&op, counts) in program.ops().iter().zip(program.without_series()) {
            search.push(op, counts);
        }
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

    pub(super) fn push(&mut self, op: Op, counts: bool) {
        let residue = match op {
            Op::Input(i) => Residue::random(("input", i)),
            op => op.map(|v| self.facts[v.index()].residue).value(&[]),
        };
        let unsigned = |v: Value| self.facts[v.index()].residue.unsigned();
        let (mut sources, mut own) = (Sources::default(), Vec::new());
        match op {
            Op::Call(Function::Sin | Function::Cos, a) => own.push(Residue::random(("turn", unsigned(a)))),
            Op::Input(_) | Op::Tiny | Op::Sqrt(_) | Op::SelectLess(..) | Op::Call(..) | Op::Atan2(..) | Op::Pow(..) => {
                own.push(residue);
            }
            op => op.operands().for_each(|v| sources = sources.with(self.facts[v.index()].sources)),
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
        self.facts.push(Facts { residue, inverse: residue.inverse(), sources, counts });
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
                _ => found.push(Residue::random(("divisor", self.facts[v.index()].residue.unsigned()))),
            }
        }
        found
    }

    pub(super) fn put_in_order(&mut self) {
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

    pub(super) fn operations(&self) -> usize {
        self.order.iter().filter(|&&v| self.is_counted(v)).count()
    }

    /// The values that count and are not 0.
    pub(super) fn usable(&self) -> impl Iterator<Item = Value> {
        let usable = |v: &&Value| self.facts[v.index()].counts && self.facts[v.index()].residue != Residue::ZERO;
        self.order.iter().filter(usable).copied()
    }

    pub(super) fn is_counted(&self, v: Value) -> bool {
        self.facts[v.index()].counts && is_counted(&self.ops[v.index()])
    }

    /// Of (x + 1) − 1 the rounding may be what is wanted.
    pub(super) fn is_left_of_constants(&self, v: Value) -> bool {
        let constant = |v: Value| matches!(self.ops[v.index()], Op::Constant(_));
        let beside_constant = |v: Value| match self.ops[v.index()] {
            Op::Add(a, b) | Op::Sub(a, b) if constant(b) => Some(a),
            Op::Add(a, b) | Op::Sub(a, b) if constant(a) => Some(b),
            _ => None,
        };
        beside_constant(v).and_then(beside_constant).is_some()
    }

    /// The operations that go with `target` if these values are needed.
    pub(super) fn freed(&self, target: Value, needed: impl Iterator<Item = Value>) -> usize {
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
    pub(super) fn replace(&mut self, target: Value, form: &Form) -> Option<Value> {
        let before = (self.ops.clone(), self.outputs.clone());
        form.ops.iter().for_each(|&op| self.push(op, true));
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

    pub(super) fn back_to(&mut self, ops: Vec<Op>, outputs: Vec<Value>) {
        (self.ops, self.outputs) = (ops, outputs);
        self.facts.truncate(self.ops.len());
        self.put_in_order();
    }
}

pub(super) fn is_counted(op: &Op) -> bool {
    op.is_step() && !matches!(op, Op::SelectLess(..))
}

/// An input of the point with this number: of two scales, or of many; of all signs, or positive.
fn at_random(number: u32, input: usize) -> Rounded {
    let unit = |what: &str| Residue::random((what, number, input)).unit();
    let size = if number % 4 < 2 { unit("size") } else { 10f64.powf(4.0 * unit("size") - 3.0) };
    Rounded::constant(if number % 2 == 0 && unit("sign") < 0.5 { -size } else { size })
}
