//! `Vec`: whoever reads a function sees an array, as the length is known at each place. What makes a list, makes it longer or
//! shorter, and sorts it.

use std::rc::Rc;

use quote::quote;
use syn::{Expr, ExprMethodCall};

use super::value::{Callable, Value};
use super::{Translation, is_place};
use crate::differentiate::messages;

/// The methods that change all of an array or a list, with the number of their arguments.
const CHANGING: &[(&str, usize)] = &[
    ("push", 1),
    ("pop", 0),
    ("clear", 0),
    ("truncate", 1),
    ("extend", 1),
    ("extend_from_slice", 1),
    ("copy_from_slice", 1),
    ("clone_from_slice", 1),
    ("fill", 1),
    ("reverse", 0),
    ("rotate_left", 1),
    ("rotate_right", 1),
    ("sort", 0),
    ("sort_unstable", 0),
    ("sort_by", 1),
    ("sort_unstable_by", 1),
];

/// The longest array that is sorted by conditions alone: every two elements are compared.
const LONGEST_SORTED: usize = 16;

/// The names of these methods.
pub(super) fn methods() -> impl Iterator<Item = &'static str> {
    CHANGING.iter().map(|(name, _)| *name)
}

impl Translation<'_> {
    /// `vec![…]`
    pub(super) fn list(&mut self, list: &syn::Macro) -> Value {
        let elements = &list.tokens;
        match syn::parse2::<Expr>(quote!([#elements])) {
            Ok(array) => self.expression(&array),
            Err(_) => self.refuse(&list.path, messages::macro_call()),
        }
    }

    /// A method that changes an array or a list as a whole; `None` if it is another one.
    pub(super) fn list_method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        if !CHANGING.contains(&(&name, call.args.len())) || !is_place(&call.receiver) {
            return None;
        }
        let place = self.place(&call.receiver)?;
        let Value::Array(mut values) = self.read(&place) else { return None };
        let result = self.changed(call, &name, call.args.first(), &mut values);
        if result.is_unknown() {
            return Some(result);
        }
        let written = self.write(&call.method, &place, Value::Array(values));
        Some(if written.is_unknown() { written } else { result })
    }

    /// What a method returns that changes these values.
    fn changed(
        &mut self,
        call: &ExprMethodCall,
        name: &str,
        argument: Option<&Expr>,
        values: &mut Vec<Value>,
    ) -> Value {
        match (name, argument) {
            ("pop", None) => return values.pop().map_or_else(Value::none, Value::some),
            ("clear", None) => values.clear(),
            ("reverse", None) => values.reverse(),
            (_, None) => {
                let Value::Function(compare) = self.closure(&syn::parse_quote!(|a, b| a.cmp(b))) else {
                    return Value::Unknown;
                };
                return self.sorted(call, &compare, values);
            }
            ("sort_by" | "sort_unstable_by", Some(compare)) => {
                let Some(compare) = self.function_argument(compare, 2) else { return Value::Unknown };
                return self.sorted(call, &compare, values);
            }
            (name, Some(argument)) => {
                let value = self.expression(argument);
                if value.is_unknown() {
                    return value;
                }
                match name {
                    "push" => values.push(value),
                    "fill" => values.fill(value),
                    "truncate" | "rotate_left" | "rotate_right" => match (self.algebra.known_index(&value), name) {
                        (Some(length), "truncate") => values.truncate(length),
                        (Some(count), _) if count > values.len() => {
                            return self.refuse(argument, messages::index_outside("this array"));
                        }
                        (Some(count), "rotate_left") => values.rotate_left(count),
                        (Some(count), _) => values.rotate_right(count),
                        (None, _) => return self.refuse(argument, messages::index_unknown()),
                    },
                    _ => {
                        let kind = value.describe();
                        match value.items() {
                            // Of another length it panics.
                            Some(others) if name.ends_with("_from_slice") && name != "extend_from_slice" => {
                                *values = others;
                            }
                            Some(others) => values.extend(others),
                            None => return self.refuse(argument, messages::not_iterable(&kind)),
                        }
                    }
                }
            }
        }
        Value::nothing()
    }

    /// Brings values in order: neighbours that are not are exchanged, so that equal ones stay as they are.
    fn sorted(&mut self, call: &ExprMethodCall, compare: &Rc<Callable>, values: &mut [Value]) -> Value {
        if values.len() > LONGEST_SORTED {
            return self.refuse(&call.method, messages::sorted_too_long(LONGEST_SORTED));
        }
        for end in (1..values.len()).rev() {
            for first in 0..end {
                let [one, other] = [values[first].clone(), values[first + 1].clone()];
                let order = match self.inline(&call.method, compare, vec![one.clone(), other.clone()]) {
                    Value::Ordering(order) => order,
                    order => {
                        return self.refuse_known(&order, &call.method, messages::not_an_ordering(&order.describe()));
                    }
                };
                values[first] = self.either_value(call, &order.greater, &other, &one);
                values[first + 1] = self.either_value(call, &order.greater, &one, &other);
            }
        }
        if values.iter().any(Value::is_unknown) { Value::Unknown } else { Value::nothing() }
    }
}
