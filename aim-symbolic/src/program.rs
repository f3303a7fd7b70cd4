//! Straight-line programs: what is emitted, interpreted and counted.

use std::collections::HashMap;

use crate::lower::Lowering;
use crate::rules::SCALES;
use crate::{Angle, Constant, Graph, Placement, Scalar, ScalarNode};

/// The result of an operation of a [`Program`]: its place in the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Value(pub(crate) u32);

impl Value {
    /// The place in [`Program::ops`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operation on earlier values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// The input with this index.
    Input(u32),
    /// A number.
    Constant(Constant),
    /// The smallest length that is divided by.
    Tiny,
    /// a + b
    Add(Value, Value),
    /// a − b
    Sub(Value, Value),
    /// a b
    Mul(Value, Value),
    /// a / b
    Div(Value, Value),
    /// −a
    Neg(Value),
    /// √a
    Sqrt(Value),
    /// The third where the first is below the second, else the fourth.
    SelectLess(Value, Value, Value, Value),
}

impl Op {
    /// Whether it is written as a step of its own.
    fn is_step(self) -> bool {
        !matches!(self, Self::Input(_) | Self::Constant(_) | Self::Tiny | Self::Neg(_))
    }

    /// The values it needs.
    pub fn operands(self) -> impl Iterator<Item = Value> {
        let operands = match self {
            Self::Input(_) | Self::Constant(_) | Self::Tiny => [None; 4],
            Self::Neg(a) | Self::Sqrt(a) => [Some(a), None, None, None],
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) => [Some(a), Some(b), None, None],
            Self::SelectLess(a, b, c, d) => [Some(a), Some(b), Some(c), Some(d)],
        };
        operands.into_iter().flatten()
    }
}

/// Operations in an order in which each comes after what it needs; no branch, no loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    inputs: Vec<String>,
    ops: Vec<Op>,
    outputs: Vec<Value>,
    /// For each operation the number of steps before it.
    numbers: Vec<usize>,
}

/// What a program is asked for: a value, or its derivative by an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// The expression's value.
    Value(Scalar),
    /// The expression's derivative by an angle.
    Derivative(Scalar, Angle),
}

impl Program {
    /// The program of `values` and, after them, of each value's derivatives by `angles`, value by value.
    pub fn derive(g: &mut Graph, values: &[Scalar], angles: &[Angle]) -> Self {
        let derivatives = values.iter().flat_map(|&v| angles.iter().map(move |&a| Want::Derivative(v, a)));
        let wanted: Vec<Want> = values.iter().map(|&v| Want::Value(v)).chain(derivatives).collect();
        Self::derive_wanted(g, &wanted)
    }

    /// The program of just what is wanted, in that order.
    ///
    /// Where two rewritings compete, the smaller program wins; on a tie the shallower, then the first.
    pub fn derive_wanted(g: &mut Graph, wanted: &[Want]) -> Self {
        let candidates = [Placement::Late, Placement::Early].map(|placement| Self::derive_placed(g, wanted, placement));
        let [late, early] = candidates;
        let cost = |p: &Self| (p.count().total(), p.depth());
        if cost(&early) < cost(&late) { early } else { late }
    }

    fn derive_placed(g: &mut Graph, wanted: &[Want], placement: Placement) -> Self {
        let mut rewritten: HashMap<Scalar, Scalar> = HashMap::new();
        let mut gradients: HashMap<Scalar, Vec<(Angle, Scalar)>> = HashMap::new();
        let mut outputs = Vec::new();
        for &want in wanted {
            let (Want::Value(stated) | Want::Derivative(stated, _)) = want;
            let value = *rewritten.entry(stated).or_insert_with(|| g.rewrite(stated));
            outputs.push(match want {
                Want::Value(_) => value,
                Want::Derivative(_, angle) => {
                    let gradient = gradients.entry(stated).or_insert_with(|| {
                        let angles: Vec<Angle> = wanted
                            .iter()
                            .filter_map(|w| match w {
                                Want::Derivative(s, a) if *s == stated => Some(*a),
                                _ => None,
                            })
                            .collect();
                        let gradient = g.gradient(value, &angles, placement);
                        angles.into_iter().zip(gradient).collect()
                    });
                    let (_, derivative) = gradient
                        .iter()
                        .find(|(a, _)| *a == angle)
                        .expect("the gradient was taken by every wanted angle");
                    *derivative
                }
            });
        }
        let outputs = g.rewrite_by(&outputs, &SCALES);
        Self::compile(g, &outputs)
    }

    /// The program of `outputs` as they are stated: lowered, folded and ordered, nothing else.
    pub fn compile(g: &mut Graph, outputs: &[Scalar]) -> Self {
        let mut lowering = Lowering::new(g);
        let lowered: Vec<Scalar> = outputs.iter().map(|&s| lowering.scalar(s)).collect();
        let mut schedule = Schedule { g, ops: Vec::new(), values: HashMap::new() };
        let outputs = lowered.iter().map(|&s| schedule.value(s)).collect();
        let ops = schedule.ops;
        let inputs = g.inputs().iter().map(|(name, _)| name.clone()).collect();
        let mut program = Self { inputs, ops, outputs, numbers: Vec::new() };
        program.divide_once();
        program.drop_unused();
        program.settle_signs();
        program.number();
        program
    }

    /// The names of the inputs, also of those that no operation needs.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// The operations.
    pub fn ops(&self) -> &[Op] {
        &self.ops
    }

    /// The outputs, in the order they were asked for.
    pub fn outputs(&self) -> &[Value] {
        &self.outputs
    }

    /// The operations that are written as steps, numbered from 0: all but inputs, constants and negations, which stand
    /// where they are used.
    pub fn steps(&self) -> impl Iterator<Item = (usize, Op)> {
        self.ops.iter().zip(&self.numbers).filter(|(op, _)| op.is_step()).map(|(&op, &number)| (number, op))
    }

    /// The number of the step that gives `value`.
    pub fn step_number(&self, value: Value) -> usize {
        self.numbers[value.index()]
    }

    fn number(&mut self) {
        let mut steps = 0;
        for op in &self.ops {
            self.numbers.push(steps);
            steps += usize::from(op.is_step());
        }
    }

    /// The longest chain of operations that wait for each other.
    pub fn depth(&self) -> usize {
        let mut depths: Vec<usize> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let below = op.operands().map(|v| depths[v.index()]).max().unwrap_or(0);
            depths.push(below + usize::from(op.is_step()));
        }
        self.outputs.iter().map(|v| depths[v.index()]).max().unwrap_or(0)
    }

    /// The program with operation `place` added where it subtracted and the other way round: a mistake made on purpose,
    /// for tests of tests. The same program where there is no such operation.
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

    fn uses(&self) -> Vec<u32> {
        let mut uses = vec![0; self.ops.len()];
        for v in self.ops.iter().flat_map(|op| op.operands()).chain(self.outputs.iter().copied()) {
            uses[v.index()] += 1;
        }
        uses
    }

    pub(crate) fn replace(&mut self, ops: Vec<Op>, outputs: Vec<Value>) {
        (self.ops, self.outputs) = (ops, outputs);
    }

    /// A guarded reciprocal that only one product needs becomes that product's division.
    fn divide_once(&mut self) {
        let uses = self.uses();
        let mut places = Vec::with_capacity(self.ops.len());
        let mut ops: Vec<Op> = Vec::with_capacity(self.ops.len());
        for &op in &self.ops {
            let new = match self.single_reciprocal(op, &uses) {
                Some((x, divisor, [tiny, length, _, zero])) => {
                    ops.push(Op::Div(x, divisor).renumbered(&places));
                    let quotient = Value(index(ops.len() - 1));
                    let at = |v: Value| places[v.index()];
                    Op::SelectLess(at(tiny), at(length), quotient, at(zero))
                }
                None => op.renumbered(&places),
            };
            places.push(Value(index(ops.len())));
            ops.push(new);
        }
        self.outputs = self.outputs.iter().map(|v| places[v.index()]).collect();
        self.ops = ops;
    }

    /// For a product with a guarded reciprocal used nowhere else: the other factor, the divisor, and the guard's parts.
    fn single_reciprocal(&self, op: Op, uses: &[u32]) -> Option<(Value, Value, [Value; 4])> {
        let Op::Mul(a, b) = op else { return None };
        [(a, b), (b, a)].into_iter().find_map(|(x, guard)| {
            let Op::SelectLess(tiny, length, then, otherwise) = self.ops[guard.index()] else { return None };
            let Op::Div(one, divisor) = self.ops[then.index()] else { return None };
            let is = |v: Value, c: f64| self.ops[v.index()] == Op::Constant(Constant::new(c));
            let once = uses[guard.index()] == 1 && uses[then.index()] == 1;
            (once && is(one, 1.0) && is(otherwise, 0.0)).then_some((x, divisor, [tiny, length, then, otherwise]))
        })
    }

    fn drop_unused(&mut self) {
        let mut used = vec![false; self.ops.len()];
        for v in &self.outputs {
            used[v.index()] = true;
        }
        for place in (0..self.ops.len()).rev() {
            if used[place] {
                for v in self.ops[place].operands() {
                    used[v.index()] = true;
                }
            }
        }
        let mut places = Vec::with_capacity(self.ops.len());
        let mut kept: Vec<Op> = Vec::new();
        for (place, &op) in self.ops.iter().enumerate() {
            places.push(Value(index(kept.len())));
            if used[place] {
                kept.push(op.renumbered(&places));
            }
        }
        self.outputs = self.outputs.iter().map(|v| places[v.index()]).collect();
        self.ops = kept;
    }
}

pub(crate) fn index(place: usize) -> u32 {
    u32::try_from(place).expect("four billion operations do not fit in memory")
}

impl Op {
    fn renumbered(self, places: &[Value]) -> Self {
        let at = |v: Value| places[v.index()];
        match self {
            Self::Input(_) | Self::Constant(_) | Self::Tiny => self,
            Self::Add(a, b) => Self::Add(at(a), at(b)),
            Self::Sub(a, b) => Self::Sub(at(a), at(b)),
            Self::Mul(a, b) => Self::Mul(at(a), at(b)),
            Self::Div(a, b) => Self::Div(at(a), at(b)),
            Self::Neg(a) => Self::Neg(at(a)),
            Self::Sqrt(a) => Self::Sqrt(at(a)),
            Self::SelectLess(a, b, c, d) => Self::SelectLess(at(a), at(b), at(c), at(d)),
        }
    }
}

struct Schedule<'g> {
    g: &'g Graph,
    ops: Vec<Op>,
    values: HashMap<Scalar, Value>,
}

impl Schedule<'_> {
    fn value(&mut self, scalar: Scalar) -> Value {
        if let Some(&done) = self.values.get(&scalar) {
            return done;
        }
        let op = match self.g.scalar_node(scalar) {
            ScalarNode::Constant(c) => Op::Constant(c),
            ScalarNode::Input(i) => Op::Input(i),
            ScalarNode::Tiny => Op::Tiny,
            ScalarNode::Add(a, b) => Op::Add(self.value(a), self.value(b)),
            ScalarNode::Sub(a, b) => Op::Sub(self.value(a), self.value(b)),
            ScalarNode::Mul(a, b) => Op::Mul(self.value(a), self.value(b)),
            ScalarNode::Div(a, b) => Op::Div(self.value(a), self.value(b)),
            ScalarNode::Neg(a) => Op::Neg(self.value(a)),
            ScalarNode::Sqrt(a) => Op::Sqrt(self.value(a)),
            ScalarNode::SelectLess(a, b, c, d) => {
                Op::SelectLess(self.value(a), self.value(b), self.value(c), self.value(d))
            }
            node @ (ScalarNode::Reciprocal(_)
            | ScalarNode::Dot(..)
            | ScalarNode::Norm(_)
            | ScalarNode::Component(..)) => unreachable!("{node:?} is lowered before it is scheduled"),
        };
        let value = Value(index(self.ops.len()));
        self.ops.push(op);
        self.values.insert(scalar, value);
        value
    }
}
