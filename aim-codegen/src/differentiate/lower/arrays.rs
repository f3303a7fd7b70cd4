//! Non-mutating methods of arrays, slices and lists.

use syn::{Expr, ExprMethodCall};

use super::condition::Condition;
use super::expected::Expected;
use super::value::{Element, Value};
use super::{Translation, iterators, lending, lists, methods};
use crate::differentiate::messages;

const METHODS: &[&str] = &[
    "iter",
    "into_iter",
    "map",
    "len",
    "is_empty",
    "first",
    "last",
    "get",
    "contains",
    "windows",
    "chunks",
    "chunks_exact",
    "split_at",
    "split_first",
    "split_last",
    "concat",
    "partition_point",
    "swap",
];

/// Returns the names of all methods of arrays, slices and lists.
pub(super) fn names() -> Vec<&'static str> {
    METHODS.iter().copied().chain(lists::methods()).chain(lending::LENDING).collect()
}

impl Translation<'_> {
    /// Evaluates a method of an array or an iterator; `None` if it is not one of theirs.
    pub(super) fn sequence_method(
        &mut self,
        receiver: &Value,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let errors = self.report.count();
        if let Some(value) = self.loop_sequence_method(receiver, call, expected) {
            return Some(value);
        }
        if self.report.count() > errors {
            return Some(Value::Unknown);
        }
        let items = match receiver {
            Value::Iterator(items) => return Some(self.iterator_method(items, call, expected)),
            Value::Array(_) | Value::List(_) => receiver.clone().items()?,
            _ => return None,
        };
        let value = match receiver {
            Value::Array(values) => self.array_method(values, call),
            _ => None,
        };
        if let Some(value) = value.or_else(|| self.list_query(receiver, items, call)) {
            return Some(value);
        }
        if self.report.count() > errors {
            return Some(Value::Unknown);
        }
        let name = call.method.to_string();
        // On an array, these can only be methods of a trait.
        Some(if iterators::has_method(&call.method) && !names().contains(&&*name) {
            self.refuse(&call.method, messages::trait_method(&name))
        } else {
            self.refuse(&call.method, methods::unknown_method(&name, &receiver.describe(), &names()))
        })
    }

    /// Evaluates a method of an array or a list; `None` if it is another one, or after an error.
    fn list_query(&mut self, receiver: &Value, items: Vec<Element>, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        Some(match (name.as_str(), arguments.as_slice()) {
            ("iter" | "into_iter", []) => Value::Iterator(items),
            ("clone" | "as_slice" | "as_ref" | "into" | "to_owned" | "to_vec", []) => receiver.clone(),
            ("len", []) => self.counted(&items)?,
            ("is_empty", []) => {
                let any = items.into_iter().map(|item| item.is_there).fold(Condition::Known(false), Condition::or);
                Value::Truth(any.not())
            }
            ("first", []) => self.first(call, items),
            ("last", []) => self.first(call, items.into_iter().rev().collect()),
            ("get", [place]) => {
                let value = self.expression(place);
                let Value::Integer(index) = value else {
                    return Some(self.refuse_known(&value, *place, messages::index_unknown()));
                };
                let Value::Integer(count) = self.counted(&items)? else { return None };
                let is_some = Condition::is_index(self.algebra, index, count);
                if matches!(is_some, Condition::Known(false)) {
                    return Some(Value::none());
                }
                match receiver.select_element(self.algebra, index) {
                    Some(item) => Value::some_if(is_some, item),
                    None => self.refuse(*place, messages::no_such_choice(&receiver.describe())),
                }
            }
            ("contains", [element]) => {
                let element = self.expression(element);
                let mut contains = Condition::Known(false);
                for Element { is_there, value } in items {
                    match self.equal(&call.method, &value, &element) {
                        Some(Value::Truth(equal)) => contains = contains.or(is_there.and(equal)),
                        _ => {
                            let text = messages::not_a_condition(&element.describe());
                            return Some(self.refuse_known(&element, &call.args, text));
                        }
                    }
                }
                Value::Truth(contains)
            }
            _ => return None,
        })
    }

    /// Evaluates a method of an array with these elements; `None` if it is another one, or after an error.
    fn array_method(&mut self, values: &[Value], call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let parts =
            |parts: &mut dyn Iterator<Item = &[Value]>| Value::iterator(parts.map(|part| Value::Array(part.to_vec())));
        Some(match (name.as_str(), arguments.as_slice()) {
            ("map", [function]) => {
                let mapped = self.mapped(call, function, values.iter().cloned().map(Element::new).collect())?;
                Value::Array(mapped.into_iter().map(|item| item.value).collect())
            }
            // The number of elements does not change.
            ("try_into", []) => Value::some(Value::Array(values.to_vec())),
            ("windows" | "chunks" | "chunks_exact", [count]) => match (self.known_count(count)?, name.as_str()) {
                (0, _) => self.refuse(*count, messages::index_outside("a chunk size")),
                (count, "windows") => parts(&mut values.windows(count)),
                (count, "chunks") => parts(&mut values.chunks(count)),
                (count, _) => parts(&mut values.chunks_exact(count)),
            },
            ("split_at", [place]) => {
                let known = self.known_count(place)?;
                match values.split_at_checked(known) {
                    Some((before, after)) => {
                        Value::Tuple(vec![Value::Array(before.to_vec()), Value::Array(after.to_vec())])
                    }
                    None => self.refuse(*place, messages::index_outside("this array")),
                }
            }
            ("split_first" | "split_last", []) => {
                let split = if name == "split_first" { values.split_first() } else { values.split_last() };
                let pair = split.map(|(one, rest)| Value::Tuple(vec![one.clone(), Value::Array(rest.to_vec())]));
                pair.map_or_else(Value::none, Value::some)
            }
            ("concat", []) => {
                let parts: Option<Vec<Vec<Element>>> = values.iter().map(|value| value.clone().items()).collect();
                match parts {
                    Some(parts) => Value::list(parts.concat()),
                    None => self.refuse(&call.method, messages::not_iterable("an element of this array")),
                }
            }
            // In a partitioned array, the partition point is the number of elements that satisfy the predicate.
            ("partition_point", [function]) => {
                let items: Vec<Element> = values.iter().cloned().map(Element::new).collect();
                let items = self.filtered(call, function, &items)?;
                self.counted(&items)?
            }
            _ => return None,
        })
    }
}
