//! Methods of arrays, lists and slices that no iterator has.

use syn::{Expr, ExprMethodCall};

use super::Translation;
use super::condition::Condition;
use super::value::Value;
use crate::differentiate::messages;

/// Their names, for messages.
pub(super) const METHODS: &[&str] =
    &["get", "split_at", "split_first", "split_last", "concat", "contains", "partition_point"];

impl Translation<'_> {
    /// A method of an array of these elements that no iterator has; `None` if it is another one.
    pub(super) fn array_method(&mut self, items: &[Value], call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        Some(match (name.as_str(), arguments.as_slice()) {
            ("split_at", [place]) => {
                let value = self.expression(place);
                let known = self.algebra.known_index(&value);
                match known.filter(|place| *place <= items.len()) {
                    Some(place) => {
                        let (before, after) = items.split_at(place);
                        Value::Tuple(vec![Value::Array(before.to_vec()), Value::Array(after.to_vec())])
                    }
                    None if known.is_some() => self.refuse(*place, messages::index_outside("this array")),
                    None => self.refuse_known(&value, *place, messages::index_unknown()),
                }
            }
            ("get", [place]) => {
                let place = self.expression(place);
                match (&place, self.algebra.known_integer(&place)) {
                    (_, Some(known)) => {
                        let item = usize::try_from(known).ok().and_then(|known| items.get(known));
                        item.map_or_else(Value::none, |item| Value::some(item.clone()))
                    }
                    (Value::Integer(index), None) => {
                        let [before, count] =
                            [-1, i64::try_from(items.len()).ok()?].map(|end| self.algebra.integer(end));
                        let (Value::Integer(before), Value::Integer(count)) = (before, count) else { return None };
                        let is_some = Condition::less(self.algebra, *index, count);
                        let is_some = is_some.and(Condition::less(self.algebra, before, *index));
                        match Value::Array(items.to_vec()).chosen(self.algebra, *index) {
                            Some(item) => Value::some_if(is_some, item),
                            None if items.is_empty() => Value::none(),
                            None => self.refuse(&call.args, messages::no_such_choice("this array")),
                        }
                    }
                    _ => self.refuse_known(&place, &call.args, messages::index_unknown()),
                }
            }
            ("split_first" | "split_last", []) => {
                let split = if name == "split_first" { items.split_first() } else { items.split_last() };
                let pair = split.map(|(one, rest)| Value::Tuple(vec![one.clone(), Value::Array(rest.to_vec())]));
                pair.map_or_else(Value::none, Value::some)
            }
            ("concat", []) => {
                let parts: Option<Vec<Vec<Value>>> = items.iter().map(|item| item.clone().items()).collect();
                match parts {
                    Some(parts) => Value::Array(parts.concat()),
                    None => self.refuse(&call.method, messages::not_iterable("an element of it")),
                }
            }
            ("contains", [element]) => {
                let element = self.expression(element);
                let equal = |this: &mut Self, item: &Value| match this.equal(&call.method, item, &element) {
                    Some(Value::Truth(condition)) => Some(condition),
                    _ => None,
                };
                let equal: Option<Vec<Condition>> = items.iter().map(|item| equal(self, item)).collect();
                match equal {
                    Some(equal) => Value::Truth(equal.into_iter().fold(Condition::Known(false), Condition::or)),
                    None => self.refuse_known(&element, &call.args, messages::not_a_condition(&element.describe())),
                }
            }
            // Of what is partitioned so, as many as fulfil it.
            ("partition_point", [function]) => {
                let function = self.function_argument(function, 1)?;
                let mut all = Vec::with_capacity(items.len());
                for item in items {
                    let Value::Truth(holds) = self.inline(&call.method, &function, vec![item.clone()]) else {
                        return Some(Value::Unknown);
                    };
                    all.push(holds);
                }
                self.counted(call, all.iter())?
            }
            _ => return None,
        })
    }
}
