//! Slices whose length depends on arguments: elements at computed indices, and parts.

use std::rc::Rc;

use aim_symbolic::{Function, Scalar};
use syn::{Expr, ExprRange, RangeLimits};

use super::Translation;
use super::algebra::Algebra;
use super::bounds::Linear;
use super::condition::Condition;
use super::extra_inputs::{ElementIndex, ExtraInput};
use super::value::{LoopSequence, SequenceItems, Slice, Value};

impl Slice {
    pub(super) fn element(&self, this: &mut Translation<'_>, index: Scalar) -> Value {
        let index = this.algebra.add(self.first, index);
        let index = this.element_index(index);
        let of = |number| ExtraInput::Element { slice: self.place, index, number };
        let inputs = (0..self.components).map(|number| this.algebra.extra_input(of(number))).collect();
        (self.make)(this.algebra, inputs)
    }

    /// Returns `len` elements, from the one with index `first` on.
    pub(super) fn part(&self, a: &mut Algebra, first: Scalar, len: Scalar) -> Self {
        Self { first: a.add(self.first, first), len, ..self.clone() }
    }
}

impl Translation<'_> {
    /// Classifies the index of an element.
    fn element_index(&mut self, index: Scalar) -> ElementIndex {
        let a = &*self.algebra;
        let iteration = |x: Scalar| {
            let source = a.extra_inputs.iter().find(|(_, input)| *input == x)?;
            if let ExtraInput::Iteration(number) = source.0 { Some(number) } else { None }
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was made of whole numbers")]
        match Linear::of(a, index) {
            Linear { x: None, c, .. } if c >= 0.0 => ElementIndex::Constant(c as usize),
            Linear { x: Some(x), k: 1.0, c } => {
                iteration(x).map_or(ElementIndex::Computed(index), |number| ElementIndex::Iteration(number, c as i64))
            }
            _ => ElementIndex::Computed(index),
        }
    }

    /// Returns an element of a slice.
    pub(super) fn element_of(&mut self, slice: &Slice, index: Scalar) -> Value {
        slice.element(self, index)
    }

    /// Evaluates `slice[start..end]`; `None` after an error.
    pub(super) fn part_of_slice(&mut self, slice: &Slice, range: &ExprRange) -> Option<Value> {
        let start = match &range.start {
            Some(start) => self.count(start)?,
            None => self.algebra.number(0.0),
        };
        let end = match &range.end {
            Some(end) => self.count(end)?,
            None => slice.len,
        };
        let a = &mut *self.algebra;
        let more = a.number(if matches!(range.limits, RangeLimits::Closed(_)) { 1.0 } else { 0.0 });
        let len = a.sub(end, start);
        let len = a.add(len, more);
        Some(Value::Slice(Rc::new(slice.part(a, start, len))))
    }

    /// Evaluates a method that only slices have, not other iterators; `None` if it is another one.
    pub(super) fn slice_method(&mut self, slice: &Rc<Slice>, name: &str, arguments: &[&Expr]) -> Option<Option<Value>> {
        let (zero, one) = (self.algebra.number(0.0), self.algebra.number(1.0));
        Some(match (name, arguments) {
            ("len", []) => Some(Value::Integer(slice.len)),
            ("is_empty", []) => Some(Value::Truth(Condition::at_most(self.algebra, slice.len, zero))),
            ("first", []) => Some(self.got(slice, zero)),
            ("last", []) => {
                let last = self.algebra.sub(slice.len, one);
                Some(self.got(slice, last))
            }
            ("split_first" | "split_last", []) => {
                let a = &mut *self.algebra;
                let is_some = Condition::at_most(a, one, slice.len);
                let left = a.sub(slice.len, one);
                let (place, first) = if name == "split_first" { (zero, one) } else { (left, zero) };
                let rest = Value::Slice(Rc::new(slice.part(a, first, left)));
                Some(Value::some_if(is_some, Value::Tuple(vec![slice.element(self, place), rest])))
            }
            ("split_at", [place]) => self.count(place).map(|place| {
                let a = &mut *self.algebra;
                let left = a.sub(slice.len, place);
                let parts = [slice.part(a, zero, place), slice.part(a, place, left)];
                Value::Tuple(parts.map(|part| Value::Slice(Rc::new(part))).into())
            }),
            ("get", [index]) => self.count(index).map(|index| self.got(slice, index)),
            ("windows" | "chunks_exact", [size]) => self.known_count(size).map(|size| {
                let (step, count) = match name {
                    "windows" => {
                        let less = self.algebra.count(size.saturating_sub(1));
                        (1, self.algebra.sub(slice.len, less))
                    }
                    _ => (size, self.parts(slice.len, size, 0)),
                };
                Value::LoopSequence(Rc::new(LoopSequence::of(
                    count,
                    SequenceItems::Parts { slice: slice.clone(), size, step },
                )))
            }),
            ("chunks", [size]) => self.count(size).map(|size| {
                let a = &mut *self.algebra;
                let less = a.sub(size, one);
                let count = a.add(slice.len, less);
                let count = a.div(count, size);
                let count = a.call(Function::Floor, count);
                Value::LoopSequence(Rc::new(LoopSequence::of(
                    count,
                    SequenceItems::Chunks { slice: slice.clone(), size },
                )))
            }),
            _ => return None,
        })
    }

    /// Returns an option of the element at this index, present if the index is in bounds.
    fn got(&mut self, slice: &Slice, index: Scalar) -> Value {
        let zero = self.algebra.number(0.0);
        let is_some = Condition::less(self.algebra, index, zero).not();
        let is_some = is_some.and(Condition::less(self.algebra, index, slice.len));
        Value::some_if(is_some, slice.element(self, index))
    }

    /// Returns the number of parts of this size in `count + more` elements.
    pub(super) fn parts(&mut self, count: Scalar, size: usize, more: usize) -> Scalar {
        let a = &mut *self.algebra;
        let [size, more] = [size, more].map(|number| a.count(number));
        let count = a.add(count, more);
        let parts = a.div(count, size);
        a.call(Function::Floor, parts)
    }
}
