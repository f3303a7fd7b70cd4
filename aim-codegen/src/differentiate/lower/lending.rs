//! Mutable references to elements and parts, by methods of arrays and lists and by patterns on `&mut`.

use std::rc::Rc;

use syn::{Expr, ExprMethodCall};

use super::Translation;
use super::condition::Condition;
use super::enums::TAG;
use super::iterators::ranks;
use super::value::{Element, Place, Step, Struct, Value};
use crate::differentiate::messages;

/// Methods of an array that lend its elements or parts mutably.
pub(super) const LENDING: [&str; 9] = [
    "iter_mut",
    "first_mut",
    "last_mut",
    "get_mut",
    "split_first_mut",
    "split_last_mut",
    "split_at_mut",
    "chunks_mut",
    "chunks_exact_mut",
];

impl Translation<'_> {
    /// Returns an iterator over mutable references to the elements of an array or a list; `None` for any other value.
    pub(super) fn references(&mut self, target: &Place) -> Option<Value> {
        match self.read(target) {
            Value::Array(values) => {
                Some(Value::iterator((0..values.len()).map(|index| target.lent(Step::Index(index)))))
            }
            Value::List(items) => {
                let ranks = ranks(self.algebra, &items);
                Some(Value::iterator_of(items.into_iter().zip(ranks).map(|(Element { is_there, .. }, rank)| Element {
                    is_there,
                    value: target.lent(Step::Computed(rank)),
                })))
            }
            _ => None,
        }
    }

    /// Evaluates a method that lends elements or parts of an array mutably; `None` if it is another one, or after an
    /// error.
    pub(super) fn lending_method(&mut self, call: &ExprMethodCall, array: &Place) -> Option<Value> {
        let Value::Array(values) = self.read(array) else { return None };
        let (count, name) = (values.len(), call.method.to_string());
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let some = |value: Option<Value>| value.map_or_else(Value::none, Value::some);
        let last = count.checked_sub(1);
        Some(match (name.as_str(), arguments.as_slice()) {
            ("iter_mut", []) => self.references(array)?,
            ("first_mut", []) => some(last.map(|_| array.lent(Step::Index(0)))),
            ("last_mut", []) => some(last.map(|last| array.lent(Step::Index(last)))),
            ("get_mut", [index]) => match self.step(index)? {
                Step::Index(index) => some((index < count).then(|| array.lent(Step::Index(index)))),
                Step::Computed(index) => {
                    let count = self.algebra.count(count);
                    let is_some = Condition::is_index(self.algebra, index, count);
                    Value::some_if(is_some, array.lent(Step::Computed(index)))
                }
                _ => return None,
            },
            ("split_first_mut", []) => {
                some(last.map(|others| Value::Tuple(vec![array.lent(Step::Index(0)), array.lent_part(1, others)])))
            }
            ("split_last_mut", []) => {
                some(last.map(|last| Value::Tuple(vec![array.lent(Step::Index(last)), array.lent_part(0, last)])))
            }
            ("split_at_mut", [place]) => match self.known_count(place)? {
                first if first <= count => {
                    Value::Tuple(vec![array.lent_part(0, first), array.lent_part(first, count - first)])
                }
                _ => self.refuse(*place, messages::index_outside("this array")),
            },
            ("chunks_mut" | "chunks_exact_mut", [size]) => match self.known_count(size)? {
                0 => self.refuse(*size, messages::index_outside("a chunk size")),
                size => {
                    let starts = (0..count).step_by(size).map(|first| (first, size.min(count - first)));
                    let whole = starts.filter(|&(_, len)| name == "chunks_mut" || len == size);
                    Value::iterator(whole.map(|(first, len)| array.lent_part(first, len)))
                }
            },
            _ => return None,
        })
    }

    /// Evaluates a method that lends elements of a list mutably, whose length depends on arguments; `None` if it is
    /// another method, or after an error.
    pub(super) fn lent_by_list(&mut self, call: &ExprMethodCall, list: &Place) -> Option<Value> {
        let Value::List(items) = self.read(list) else { return None };
        let Value::Integer(count) = self.counted(&items)? else { return None };
        let index = match (call.method.to_string().as_str(), call.args.first()) {
            ("iter_mut", None) => return self.references(list),
            ("first_mut", None) => self.algebra.count(0),
            ("last_mut", None) => {
                let one = self.algebra.count(1);
                self.algebra.sub(count, one)
            }
            ("get_mut", Some(index)) => self.count(index)?,
            _ => return None,
        };
        let is_some = Condition::is_index(self.algebra, index, count);
        Some(Value::some_if(is_some, list.lent(Step::Computed(index))))
    }

    /// Returns the value that a pattern takes apart; for a `&mut`, a value made of references to its parts.
    pub(super) fn lent_parts(&mut self, value: Value) -> Value {
        let Value::Reference(place) = &value else { return value };
        match self.read(place) {
            Value::Array(values) => {
                Value::Array((0..values.len()).map(|index| place.lent(Step::Index(index))).collect())
            }
            Value::Tuple(values) => {
                Value::Tuple((0..values.len()).map(|index| place.lent(Step::Field(index.to_string()))).collect())
            }
            Value::Struct(of) => {
                let fields = of.fields.iter().map(|(name, value)| {
                    // The variant can only be changed as a whole, and other variants have no fields.
                    let part = if name == TAG || value.is_never() {
                        value.clone()
                    } else {
                        place.lent(Step::Field(name.clone()))
                    };
                    (name.clone(), part)
                });
                Value::Struct(Rc::new(Struct { name: of.name.clone(), fields: fields.collect() }))
            }
            Value::Optional(of) => Value::some_if(of.is_some.clone(), place.lent(Step::Inside)),
            _ => value,
        }
    }
}
