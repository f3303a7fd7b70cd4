//! Reverses differences to avoid negations: `-(a − b)` is `b − a`.
//!
//! Folding moves every negation outward, in the end to the outputs, where each costs an instruction. This pass rewrites
//! a program with some of its values stored negated: a sum of a plain and a negated value becomes a difference, and a
//! difference can be stored with either sign. Only signs change, never the rounding or the number of counted
//! operations; the sign of a zero may differ. If a = b, −(a − b) is −0, and an angle with this ordinate is −π instead
//! of π. So differences that are ordinates of angles are reversed first.

use std::ops::Range;

use crate::{Constant, Op, Program, Value};

/// Limit on the number of trials.
const MOST_TRIALS: usize = 24;

/// Limit on the depth to which differences are searched behind an output.
const DEEPEST: usize = 2000;

/// The value in the new program that stands for a value of the old one, and whether it is stored negated.
#[derive(Clone, Copy, PartialEq)]
struct SignedValue {
    value: Value,
    negated: bool,
}

/// A rewritten program.
struct RewrittenProgram {
    ops: Vec<Op>,
    outputs: Vec<Value>,
    stored: Vec<SignedValue>,
    /// The number of angles with a negated ordinate.
    angles: usize,
    negations: usize,
}

impl Program {
    /// Removes the negations that can be avoided at no cost.
    ///
    /// For each negated ordinate of an angle and each negated output, the differences behind it are reversed, first
    /// through left operands, then through right ones. A trial is kept if it leaves fewer negated ordinates, or as many
    /// and fewer negations. The number of trials is bounded, and so is the work.
    pub(crate) fn remove_negations(&mut self) {
        let mut reversed = vec![false; self.ops().len()];
        let mut best = self.rewrite_with_reversed(&reversed);
        let mut trials = 0..MOST_TRIALS;
        while let Some((trial, written)) = self.better_trial(&reversed, &best, &mut trials) {
            (reversed, best) = (trial, written);
        }
        self.replace(best.ops, best.outputs);
    }

    fn better_trial(
        &self,
        reversed: &[bool],
        best: &RewrittenProgram,
        trials: &mut Range<usize>,
    ) -> Option<(Vec<bool>, RewrittenProgram)> {
        let ordinates = self.ops().iter().filter_map(|op| match op {
            Op::Atan2(y, _) => Some(y),
            _ => None,
        });
        let negated = ordinates.chain(self.outputs()).filter(|v| best.stored[v.index()].negated);
        negated.flat_map(|&value| [(value, false), (value, true)]).find_map(|(value, right_first)| {
            trials.next()?;
            let mut trial = reversed.to_vec();
            let mut search = ReversalSearch {
                program: self,
                right_first,
                stored: &best.stored,
                steps: self.ops().len(),
                depth: DEEPEST,
            };
            search.reverse(value, &mut trial)?;
            let written = self.rewrite_with_reversed(&trial);
            ((written.angles, written.negations) < (best.angles, best.negations)).then_some((trial, written))
        })
    }

    fn is_zero(&self, value: Value) -> bool {
        self.ops()[value.index()] == Op::Constant(Constant::new(0.0))
    }

    fn is_difference(&self, value: Value, stored: &[SignedValue]) -> bool {
        let unlike = |a: Value, b: Value| stored[a.index()].negated != stored[b.index()].negated;
        match self.ops()[value.index()] {
            Op::Add(a, b) => unlike(a, b),
            Op::Sub(a, b) => !unlike(a, b),
            _ => false,
        }
    }

    /// Rewrites the program with these differences reversed.
    fn rewrite_with_reversed(&self, reversed: &[bool]) -> RewrittenProgram {
        let mut new =
            RewrittenProgram { ops: Vec::new(), outputs: Vec::new(), stored: Vec::new(), angles: 0, negations: 0 };
        for (&op, &reversed) in self.ops().iter().zip(reversed) {
            let at = |v: Value| new.stored[v.index()];
            let stored = match op {
                Op::Neg(a) => SignedValue { negated: !at(a).negated, ..at(a) },
                Op::Add(a, b) => new.sum(at(a), at(b), reversed),
                Op::Sub(a, b) => {
                    let b = at(b);
                    new.sum(at(a), SignedValue { negated: !b.negated, ..b }, reversed)
                }
                Op::Mul(a, b) => new.push(Op::Mul(at(a).value, at(b).value), at(a).negated != at(b).negated),
                Op::Div(a, b) => new.push(Op::Div(at(a).value, at(b).value), at(a).negated != at(b).negated),
                Op::SelectLess(a, b, then, otherwise) if self.is_zero(otherwise) => {
                    let (then, otherwise) = (at(then), at(otherwise));
                    let [a, b] = [a, b].map(|v| new.without_sign(new.stored[v.index()]));
                    new.push(Op::SelectLess(a, b, then.value, otherwise.value), then.negated)
                }
                op => {
                    new.angles += usize::from(matches!(op, Op::Atan2(y, _) if at(y).negated));
                    let op = op.map(|v| new.without_sign(new.stored[v.index()]));
                    new.push(op, false)
                }
            };
            new.stored.push(stored);
        }
        new.outputs = self.outputs().iter().map(|v| new.without_sign(new.stored[v.index()])).collect();
        new
    }
}

/// A search for differences to reverse, bounded in steps and depth.
struct ReversalSearch<'a> {
    program: &'a Program,
    right_first: bool,
    stored: &'a [SignedValue],
    steps: usize,
    /// The remaining depth.
    depth: usize,
}

impl ReversalSearch<'_> {
    /// Chooses differences to reverse so that `value` is stored with the opposite sign; `None` if there are none.
    fn reverse(&mut self, value: Value, reversed: &mut [bool]) -> Option<()> {
        self.steps = self.steps.checked_sub(1)?;
        self.depth = self.depth.checked_sub(1)?;
        let found = self.reverse_operands(value, reversed);
        self.depth += 1;
        found
    }

    fn reverse_operands(&mut self, value: Value, reversed: &mut [bool]) -> Option<()> {
        match self.program.ops()[value.index()] {
            Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Sqrt(_) | Op::Call(..) | Op::Atan2(..) | Op::Pow(..) => {
                None
            }
            Op::Add(a, b) | Op::Sub(a, b) => {
                if !self.program.is_difference(value, self.stored) {
                    // Reverse all operands rather than one, so that they stay alike: a compiler then finds the same
                    // work in each.
                    let mut both = reversed.to_vec();
                    if self.reverse(a, &mut both).is_some() && self.reverse(b, &mut both).is_some() {
                        reversed.copy_from_slice(&both);
                        return Some(());
                    }
                    // With one operand negated the sum becomes a difference.
                    self.either(a, b, reversed)?;
                }
                reversed[value.index()] ^= true;
                Some(())
            }
            Op::Mul(a, b) if a != b => self.either(a, b, reversed),
            Op::Mul(..) => None,
            // A divisor is a length, which its guard compares, so its sign must not change.
            Op::Div(a, _) | Op::Neg(a) => self.reverse(a, reversed),
            Op::SelectLess(_, _, then, otherwise) if self.program.is_zero(otherwise) => self.reverse(then, reversed),
            Op::SelectLess(..) => None,
        }
    }

    fn either(&mut self, a: Value, b: Value, reversed: &mut [bool]) -> Option<()> {
        let (first, second) = if self.right_first { (b, a) } else { (a, b) };
        self.reverse(first, reversed).or_else(|| self.reverse(second, reversed))
    }
}

impl RewrittenProgram {
    fn push(&mut self, op: Op, negated: bool) -> SignedValue {
        self.ops.push(op);
        SignedValue { value: Value::at(self.ops.len() - 1), negated }
    }

    /// Adds stored values. If the result is a difference, `reversed` chooses its sign.
    fn sum(&mut self, a: SignedValue, b: SignedValue, reversed: bool) -> SignedValue {
        match (a.negated, b.negated) {
            (false, false) => self.push(Op::Add(a.value, b.value), false),
            (true, true) => self.push(Op::Add(a.value, b.value), true),
            (a_negated, _) => {
                let (plus, minus) = if a_negated { (b, a) } else { (a, b) };
                let (from, what) = if reversed { (minus, plus) } else { (plus, minus) };
                self.push(Op::Sub(from.value, what.value), reversed)
            }
        }
    }

    /// Returns the value itself, adding a negation if it is stored negated.
    fn without_sign(&mut self, stored: SignedValue) -> Value {
        if !stored.negated {
            return stored.value;
        }
        if let Op::Constant(c) = self.ops[stored.value.index()] {
            return self.push(Op::Constant(Constant::new(-c.value())), false).value;
        }
        self.negations += 1;
        self.push(Op::Neg(stored.value), false).value
    }
}
