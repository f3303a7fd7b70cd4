//! Straight-line programs, which are emitted, interpreted and counted, and the search for the smallest one.

pub(crate) mod count;
pub(crate) mod derivation;
pub(crate) mod derive;
mod interpret;
mod resubstitution;
mod signs;
pub(crate) mod singular;

use crate::ir::table::Table;
use crate::lower::components::Lowering;
use crate::lower::rebuild::Uses;
use crate::lower::{Effort, best_arrangements, scaled};
use crate::rewrite::rules::{DIVIDE_ONCE, FACTOR, MATRIX, MOVE_CONSTANTS, RESUBSTITUTE, Rules, SHARE};
use crate::{Graph, Op, Scalar, ScalarNode, Value};

/// Limit on the number of operations that are written as one step, for readability.
const MOST_IN_A_STEP: usize = 6;

/// A list of operations without branches or loops, in which each operation comes after its operands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    inputs: Vec<String>,
    ops: Vec<Op>,
    outputs: Vec<Value>,
    /// For each operation, the number of steps before it.
    numbers: Vec<usize>,
    /// For each operation, `true` if it is written as part of another's expression.
    inline: Vec<bool>,
}

impl Program {
    /// Compiles `outputs` as they are stated: lowered, folded and ordered, with divisions guarded where they stand, but
    /// without rewriting and without sharing of products or factoring of sums.
    pub fn compile(g: &mut Graph, outputs: &[Scalar]) -> Self {
        Self::compile_with(
            g,
            outputs,
            &Rules { without: &[SHARE, FACTOR, MATRIX, MOVE_CONSTANTS], ..Rules::default() },
            Effort::Compare,
        )
    }

    /// Compiles `outputs` by these rules. Shares products and factors sums unless the rules switch that off.
    pub(crate) fn compile_with(g: &mut Graph, outputs: &[Scalar], rules: &Rules<'_>, effort: Effort) -> Self {
        let mut lowering = Lowering::new(core::mem::take(g), rules);
        let lowered = lowering.outputs(outputs);
        let mut arrangements = best_arrangements(&mut lowering.fold, lowered, rules, effort);
        if rules.has(&MOVE_CONSTANTS) {
            let moved: Vec<_> = arrangements.iter().filter_map(|lowered| scaled(&mut lowering.fold, lowered)).collect();
            arrangements.extend(moved);
        }
        *g = lowering.fold.g;
        let programs = arrangements.iter().map(|lowered| {
            let program = Self::scheduled(g, lowered, rules);
            match effort {
                Effort::Last { rival } if cfg!(not(aim_small)) && rules.has(&RESUBSTITUTE) => {
                    program.resubstituted(rival)
                }
                _ => program,
            }
        });
        programs.min_by_key(|program| program.count().total()).expect("there is an arrangement")
    }

    /// Orders lowered outputs into a program.
    fn scheduled(g: &mut Graph, lowered: &[Scalar], rules: &Rules<'_>) -> Self {
        let uses = rules.has(&DIVIDE_ONCE).then(|| Uses::count(g, lowered));
        let mut schedule = Schedule { g, uses, ops: Vec::new(), values: Table::default() };
        let outputs = lowered.iter().map(|&s| schedule.value(s)).collect();
        let ops = schedule.ops;
        let inputs = g.inputs().iter().map(|(name, _)| name.clone()).collect();
        let mut program = Self { inputs, ops, outputs, numbers: Vec::new(), inline: Vec::new() };
        program.number();
        program
    }

    /// Returns the names of the inputs, including those that no operation uses.
    #[must_use]
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// Returns the operations.
    #[must_use]
    pub fn ops(&self) -> &[Op] {
        &self.ops
    }

    /// Returns the outputs, in the order in which they were requested.
    #[must_use]
    pub fn outputs(&self) -> &[Value] {
        &self.outputs
    }

    /// Returns the operations that are written as steps, numbered from 0. Inputs, constants and negations are not
    /// steps, nor are sums and products that are used once and written where they are used.
    pub fn steps(&self) -> impl Iterator<Item = (usize, Op)> {
        let steps = (0..self.ops.len()).filter(|&place| self.is_step(place));
        steps.map(|place| (self.numbers[place], self.ops[place]))
    }

    /// Returns `true` if `value` is written where it is used, because it is used once and is small.
    #[must_use]
    pub fn is_inline(&self, value: Value) -> bool {
        self.inline[value.index()]
    }

    pub(crate) fn is_step(&self, place: usize) -> bool {
        self.ops[place].is_step() && !self.inline[place]
    }

    /// Returns the number of the step that computes `value`.
    #[must_use]
    pub fn step_number(&self, value: Value) -> usize {
        self.numbers[value.index()]
    }

    /// Returns the number of steps after which `value` is available.
    #[must_use]
    pub fn steps_until(&self, value: Value) -> usize {
        self.numbers[value.index()] + usize::from(self.is_step(value.index()))
    }

    fn number(&mut self) {
        self.find_inline();
        self.numbers.clear();
        let mut steps = 0;
        for place in 0..self.ops.len() {
            self.numbers.push(steps);
            steps += usize::from(self.is_step(place));
        }
    }

    /// Marks the operations that are written as part of another's expression.
    fn find_inline(&mut self) {
        let mut uses = vec![0; self.ops.len()];
        for op in self.ops.iter().filter(|op| op.is_step()) {
            op.operands().for_each(|v| uses[self.unsigned(v).index()] += 1);
        }
        // Outputs always get a name.
        self.outputs.iter().for_each(|&v| uses[self.unsigned(v).index()] += 2);
        self.inline = vec![false; self.ops.len()];
        let mut sizes = vec![1; self.ops.len()];
        for (place, op) in self.ops.iter().enumerate().filter(|(_, op)| op.is_arithmetic()) {
            for v in op.operands() {
                let part = self.unsigned(v).index();
                let size = sizes[place] + sizes[part];
                if uses[part] == 1 && self.ops[part].is_arithmetic() && size <= MOST_IN_A_STEP {
                    self.inline[part] = true;
                    sizes[place] = size;
                }
            }
        }
    }

    /// Returns the value without its negations.
    fn unsigned(&self, value: Value) -> Value {
        match self.ops[value.index()] {
            Op::Neg(a) => self.unsigned(a),
            _ => value,
        }
    }

    /// Returns the length of the longest chain of dependent operations.
    #[must_use]
    pub fn depth(&self) -> usize {
        let mut depths: Vec<usize> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let below = op.operands().map(|v| depths[v.index()]).max().unwrap_or(0);
            depths.push(below + usize::from(op.is_step()));
        }
        self.outputs.iter().map(|v| depths[v.index()]).max().unwrap_or(0)
    }

    /// Returns the program with the addition at index `place` turned into a subtraction, or the subtraction into an
    /// addition: a deliberate mistake, to test that tests detect it. Returns an equal program if there is neither.
    #[must_use]
    pub fn with_sign_flipped(&self, place: usize) -> Self {
        let mut flipped = self.clone();
        if let Some(op) = flipped.ops.get_mut(place) {
            *op = match *op {
                Op::Add(a, b) => Op::Sub(a, b),
                Op::Sub(a, b) => Op::Add(a, b),
                other => other,
            };
        }
        flipped
    }

    /// Returns the program as it is written, with as few negations as possible.
    pub(crate) fn finished(mut self) -> Self {
        self.remove_negations();
        self.number();
        self
    }

    pub(crate) fn replace(&mut self, ops: Vec<Op>, outputs: Vec<Value>) {
        (self.ops, self.outputs) = (ops, outputs);
    }
}

struct Schedule<'g> {
    g: &'g mut Graph,
    /// The uses of each scalar; `None` if no reciprocal becomes a division.
    uses: Option<Uses>,
    ops: Vec<Op>,
    values: Table<Scalar, Value>,
}

impl Schedule<'_> {
    fn value(&mut self, scalar: Scalar) -> Value {
        let mut wanted = vec![scalar];
        while let Some(&scalar) = wanted.last() {
            if self.values.contains(scalar) {
                wanted.pop();
                continue;
            }
            let (first, op) = self.op(scalar);
            match first.into_iter().chain(op.operands()).find(|&part| !self.values.contains(part)) {
                Some(missing) => wanted.push(missing),
                None => self.schedule(scalar, op),
            }
        }
        self.values[scalar]
    }

    /// Returns the operation, and the part that comes before all operands, if any. Of the operands of an addition a sum
    /// comes first, as in `x x + y y + z z`.
    fn op(&mut self, scalar: Scalar) -> (Option<Scalar>, Op<Scalar>) {
        let Some(op) = self.g.scalar_node(scalar).op() else {
            unreachable!("nodes are lowered before they are scheduled")
        };
        let is_sum = |s| matches!(self.g.scalar_node(s), ScalarNode::Op(Op::Add(..) | Op::Sub(..)));
        match op {
            Op::Add(a, b) if is_sum(b) && !is_sum(a) => (None, Op::Add(b, a)),
            Op::Mul(a, b) => match (self.quotient(a, b), self.quotient(b, a)) {
                (Some(quotient), _) => (Some(a), quotient),
                (None, quotient) => (None, quotient.unwrap_or(op)),
            },
            op => (None, op),
        }
    }

    /// If `reciprocal` is a guarded reciprocal that only its product with `x` uses, returns the product as a guarded
    /// division.
    fn quotient(&mut self, x: Scalar, reciprocal: Scalar) -> Option<Op<Scalar>> {
        let Op::SelectLess(a, b, then, otherwise) = self.g.scalar_node(reciprocal).op()? else { return None };
        let Op::Div(one, divisor) = self.g.scalar_node(then).op()? else { return None };
        let is = |s, c| self.g.constant_of(s) == Some(c);
        let once = self.uses.as_ref().is_some_and(|uses| uses.once(reciprocal) && uses.once(then));
        (once && is(one, 1.0) && is(otherwise, 0.0)).then(|| Op::SelectLess(a, b, self.g.div(x, divisor), otherwise))
    }

    fn schedule(&mut self, scalar: Scalar, op: Op<Scalar>) {
        let op = op.map(|s| self.values[s]);
        self.values.insert(scalar, Value::at(self.ops.len()));
        self.ops.push(op);
    }
}
