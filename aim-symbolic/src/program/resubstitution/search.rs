//! The state of a program during resubstitution: the identity of each value, its uses, and its rounding error.

use super::residue::Residue;
use super::rounding::Rounded;
use crate::{Function, Op, Program, Value};

/// The number of points at which rounding errors are compared.
const POINTS: u32 = 16;

/// The factor by which the bound on a rounding error may grow.
const MOST_ROUNDING: f64 = 1.3;

/// The most steps of the secant method to a zero of a sum.
const SECANTS: usize = 16;

/// The relative distance from a zero at which rounding errors are compared, too.
const NEAR_ZERO: f64 = 1e-4;

/// Operations that compute a value from others. Their indices follow those of the existing operations.
pub(super) struct Form {
    pub(super) ops: Vec<Op>,
    pub(super) result: Value,
    /// The number of operations that the form saves.
    pub(super) gain: usize,
}

/// A set of at most 256 sources. Any source beyond that is represented by the last.
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

/// The properties of a value that do not depend on how it is computed.
pub(super) struct ValueFacts {
    pub(super) residue: Residue,
    /// The inverse of the residue.
    pub(super) inverse: Residue,
    /// Inputs, divisors and functions that are not rational. They must be finite for the value to be finite, and a
    /// replacement may need no others.
    pub(super) sources: Sources,
    /// `false` if only a series uses the value.
    pub(super) counts: bool,
}

pub(super) struct Search {
    /// The given operations, followed by the added ones.
    pub(super) ops: Vec<Op>,
    pub(super) outputs: Vec<Value>,
    /// The facts of each operation.
    pub(super) facts: Vec<ValueFacts>,
    /// All sources; each has a bit in [`Sources`].
    pub(super) all_sources: Vec<Residue>,
    /// All values that are used, operands first.
    pub(super) order: Vec<Value>,
    /// The number of uses of each value.
    pub(super) uses: Vec<u32>,
    /// Inputs, and the limits on the rounding errors of comparisons and outputs.
    pub(super) points: Vec<(Vec<Rounded>, Vec<f64>)>,
    /// The indices of the comparisons of the given program.
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
        search.update_order();
        let at_random = |number| (0..program.inputs().len()).map(|input| at_random(number, input)).collect::<Vec<_>>();
        for number in 0..POINTS {
            search.add_point(at_random(number));
        }
        // (1 − x)(1 + x) keeps its digits near x = 1, where 1 − x² has lost them.
        for (sum, number) in search.ill_conditioned().into_iter().zip((0..POINTS).cycle()) {
            if let Some((input, zero)) = search.zero(sum, &at_random(number)) {
                let sides = [1.0, -1.0].map(|side| zero + side * NEAR_ZERO * zero.abs().max(NEAR_ZERO));
                let beside = sides.map(|beside| {
                    let mut inputs = at_random(number);
                    inputs[input] = Rounded::exact(beside);
                    inputs
                });
                beside.into_iter().any(|inputs| search.add_point(inputs));
            }
        }
        search
    }

    /// Adds a point at which rounding errors are compared, if it is in the domain.
    fn add_point(&mut self, inputs: Vec<Rounded>) -> bool {
        let most = self.rounding(&inputs);
        let is_in_domain = most.iter().all(|bound| bound.is_finite());
        if is_in_domain {
            self.points.push((inputs, most.into_iter().map(|bound| MOST_ROUNDING * bound).collect()));
        }
        is_in_domain
    }

    /// Returns the sums whose relative error matters near their zeros: factors of divisors and of arguments of roots.
    fn ill_conditioned(&self) -> Vec<Value> {
        let mut sums = Vec::new();
        for &v in &self.order {
            let (Op::Sqrt(a) | Op::Div(_, a)) = self.ops[v.index()] else { continue };
            for factor in self.factors(a) {
                let is_sum = matches!(self.ops[factor.index()], Op::Add(..) | Op::Sub(..));
                if is_sum && !self.is_square(factor) && !sums.contains(&factor) {
                    sums.push(factor);
                }
            }
        }
        sums
    }

    /// Returns `true` for sums of squares, which lose no digits.
    fn is_square(&self, v: Value) -> bool {
        match self.ops[v.index()] {
            Op::Mul(a, b) => a == b,
            Op::Add(a, b) => self.is_square(a) && self.is_square(b),
            Op::Constant(constant) => constant.value() >= 0.0,
            _ => false,
        }
    }

    /// Returns a zero of a sum along one of its inputs, by the secant method from `start`: the input and its value there.
    fn zero(&self, sum: Value, start: &[Rounded]) -> Option<(usize, f64)> {
        (0..start.len()).find_map(|input| {
            let at = |x: f64| {
                let mut inputs = start.to_vec();
                inputs[input] = Rounded::exact(x);
                self.values(&inputs)[sum.index()]
            };
            let mut before = start[input].value;
            let (mut x, mut of_before) = (1.1 * before, at(before).value);
            for _ in 0..SECANTS {
                let found = at(x);
                if found.value.abs() <= 1e-9 * found.bound {
                    return Some((input, x));
                }
                let next = x - found.value * (x - before) / (found.value - of_before);
                (before, x, of_before) = (x, next, found.value);
            }
            None
        })
    }

    pub(super) fn push(&mut self, op: Op, counts: bool) {
        let residue = Residue::result(op.map(|v| self.facts[v.index()].residue));
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
            let divisor = |v: Value| Residue::random(("divisor", unsigned(v)));
            own.extend(self.factors(b).into_iter().map(divisor));
        }
        for source in own {
            let known = self.all_sources.iter().position(|&known| known == source);
            sources = sources.with(Sources::of(known.unwrap_or_else(|| {
                self.all_sources.push(source);
                self.all_sources.len() - 1
            })));
        }
        self.ops.push(op);
        self.facts.push(ValueFacts { residue, inverse: residue.inverse(), sources, counts });
    }

    /// Returns the factors of a product, without signs.
    fn factors(&self, product: Value) -> Vec<Value> {
        let (mut all, mut found) = (vec![product], Vec::new());
        let mut next = 0;
        while let Some(&v) = all.get(next) {
            next += 1;
            match self.ops[v.index()] {
                // A factor of a power is visited once.
                op @ (Op::Mul(..) | Op::Neg(_)) => op.operands().for_each(|part| {
                    if !all.contains(&part) {
                        all.push(part);
                    }
                }),
                _ => found.push(v),
            }
        }
        found
    }

    pub(super) fn update_order(&mut self) {
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

    /// Returns the error bounds of compared values, 0 for comparisons that were dropped, and of outputs.
    fn rounding(&self, inputs: &[Rounded]) -> Vec<f64> {
        let values = self.values(inputs);
        let compared = self.comparisons.iter().flat_map(|&place| self.ops[place].operands().take(2));
        compared.chain(self.outputs.iter().copied()).map(|v| values[v.index()].bound).collect()
    }

    /// Returns all values that are used, the others 0.
    fn values(&self, inputs: &[Rounded]) -> Vec<Rounded> {
        let mut values = vec![Rounded::exact(0.0); self.ops.len()];
        for &v in &self.order {
            values[v.index()] = Rounded::result(self.ops[v.index()].map(|part| values[part.index()]), inputs);
        }
        values
    }

    pub(super) fn operations(&self) -> usize {
        self.order.iter().filter(|&&v| self.is_counted(v)).count()
    }

    /// Returns the values that count and are not 0.
    pub(super) fn usable(&self) -> impl Iterator<Item = Value> {
        let usable = |v: &&Value| self.facts[v.index()].counts && self.facts[v.index()].residue != Residue::ZERO;
        self.order.iter().filter(usable).copied()
    }

    pub(super) fn is_counted(&self, v: Value) -> bool {
        self.facts[v.index()].counts && is_counted(&self.ops[v.index()])
    }

    /// Returns `true` for sums such as (x + 1) − 1, which may be meant to round.
    pub(super) fn is_left_of_constants(&self, v: Value) -> bool {
        let constant = |v: Value| matches!(self.ops[v.index()], Op::Constant(_));
        let beside_constant = |v: Value| match self.ops[v.index()] {
            Op::Add(a, b) | Op::Sub(a, b) if constant(b) => Some(a),
            Op::Add(a, b) | Op::Sub(a, b) if constant(a) => Some(b),
            _ => None,
        };
        beside_constant(v).and_then(beside_constant).is_some()
    }

    /// Returns the number of operations that are dropped with `target` if the `needed` values are kept.
    pub(super) fn count_freed(&self, target: Value, needed: impl Iterator<Item = Value>) -> usize {
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

    /// Replaces `target` by the form and returns the new value; `None` if that increases rounding errors too much.
    pub(super) fn replace(&mut self, target: Value, form: &Form) -> Option<Value> {
        let before = (self.ops.clone(), self.outputs.clone());
        form.ops.iter().for_each(|&op| self.push(op, true));
        let exchange = |v: Value| if v == target { form.result } else { v };
        for &v in &self.order {
            self.ops[v.index()] = self.ops[v.index()].map(exchange);
        }
        self.outputs = self.outputs.iter().map(|&v| exchange(v)).collect();
        self.update_order();
        let is_within = |(inputs, most): &(Vec<Rounded>, Vec<f64>)| {
            self.rounding(inputs).iter().zip(most).all(|(bound, most)| bound <= most)
        };
        if self.points.iter().all(is_within) {
            return Some(form.result);
        }
        self.restore(before.0, before.1);
        None
    }

    pub(super) fn restore(&mut self, ops: Vec<Op>, outputs: Vec<Value>) {
        (self.ops, self.outputs) = (ops, outputs);
        self.facts.truncate(self.ops.len());
        self.update_order();
    }
}

pub(super) fn is_counted(op: &Op) -> bool {
    op.is_step() && !matches!(op, Op::SelectLess(..))
}

/// Returns an input of the point with this number: of one scale or of many, of either sign or positive.
fn at_random(number: u32, input: usize) -> Rounded {
    let unit = |what: &str| Residue::random((what, number, input)).unit();
    let size = if number % 4 < 2 { unit("size") } else { 10f64.powf(4.0 * unit("size") - 3.0) };
    Rounded::exact(if number % 2 == 0 && unit("sign") < 0.5 { -size } else { size })
}
