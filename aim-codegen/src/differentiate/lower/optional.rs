//! Options, which have a value under a condition, and orderings of two numbers.

use std::rc::Rc;

use aim_symbolic::Scalar;
use syn::{Expr, ExprMethodCall, ExprTry, Pat};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::frame::Target;
use super::place_types::type_of;
use super::value::{Callable, Optional, Order, Value};
use super::{Translation, methods, numbers};
use crate::differentiate::messages;

/// Methods of options, for messages.
pub(super) const METHODS: &[&str] = &[
    "is_some",
    "is_none",
    "is_some_and",
    "is_none_or",
    "unwrap",
    "expect",
    "unwrap_or",
    "unwrap_or_else",
    "unwrap_or_default",
    "map",
    "map_or",
    "map_or_else",
    "and_then",
    "filter",
    "or",
    "or_else",
    "and",
    "xor",
    "zip",
    "iter",
    "as_mut",
    "take",
    "replace",
    "insert",
    "get_or_insert",
    "get_or_insert_with",
];

impl Value {
    pub(super) fn none() -> Self {
        Self::Optional(Rc::new(Optional { is_some: Condition::Known(false), value: Self::Never }))
    }

    pub(super) fn some(value: Self) -> Self {
        Self::some_if(Condition::Known(true), value)
    }

    /// Returns `Some` where the condition holds, else `None`.
    pub(super) fn some_if(is_some: Condition, value: Self) -> Self {
        match is_some {
            Condition::Known(false) => Self::none(),
            _ if value.is_unknown() => value,
            is_some => Self::Optional(Rc::new(Optional { is_some, value })),
        }
    }

    /// Returns `Ordering::Less` and the like, by name.
    pub(super) fn ordering(name: &str) -> Option<Self> {
        let known = |name: &str, expected: &str| Condition::Known(name == expected);
        let is_one = numbers::ORDERINGS.contains(&name);
        is_one.then(|| Self::Ordering(Rc::new(Order { less: known(name, "Less"), greater: known(name, "Greater") })))
    }
}

impl Order {
    /// Compares two numbers.
    pub(super) fn of(a: &Algebra, x: Scalar, y: Scalar) -> Self {
        Self { less: Condition::less(a, x, y), greater: Condition::less(a, y, x) }
    }
}

impl Translation<'_> {
    /// Returns the function that is called if there is no value. A closure may ignore an error, whose value is not
    /// tracked. `None` after an error.
    fn function_without_value(&mut self, function: &Expr) -> Option<Rc<Callable>> {
        match function {
            Expr::Closure(closure) if closure.inputs.len() == 1 => {
                let Pat::Wild(_) = closure.inputs[0] else {
                    self.refuse(&closure.inputs, messages::error_value());
                    return None;
                };
                let mut closure = closure.clone();
                closure.inputs.clear();
                self.function_argument(&Expr::Closure(closure), 0)
            }
            function => self.function_argument(function, 0),
        }
    }

    fn ordering_method(&mut self, order: &Order, call: &ExprMethodCall, arguments: &[&Expr]) -> Option<Value> {
        let Order { less, greater } = order.clone();
        let equal = less.clone().or(greater.clone()).not();
        let name = call.method.to_string();
        let truth = match (name.as_str(), arguments) {
            ("is_lt", []) => less,
            ("is_le", []) => greater.not(),
            ("is_gt", []) => greater,
            ("is_ge", []) => less.not(),
            ("is_eq", []) => equal,
            ("is_ne", []) => equal.not(),
            ("reverse", []) => return Some(Value::Ordering(Rc::new(Order { less: greater, greater: less }))),
            ("then" | "then_with", [next]) => {
                let next = if name == "then" {
                    self.expression(next)
                } else {
                    let function = self.function_argument(next, 0)?;
                    self.run_under(call, &equal, |this| this.inline(&call.method, &function, Vec::new()))
                };
                let Value::Ordering(next) = &next else {
                    let text = messages::not_an_ordering(&next.describe());
                    return Some(self.refuse_known(&next, &call.method, text));
                };
                let less = less.or(equal.clone().and(next.less.clone()));
                let greater = greater.or(equal.and(next.greater.clone()));
                return Some(Value::Ordering(Rc::new(Order { less, greater })));
            }
            _ => {
                let known = ["reverse", "then", "then_with", "is_lt", "is_le", "is_gt", "is_ge", "is_eq", "is_ne"];
                return Some(self.refuse(&call.method, methods::unknown_method(&name, "an ordering", &known)));
            }
        };
        Some(Value::Truth(truth))
    }

    /// Evaluates a method of an option or an ordering, or a method of a condition that returns an option; `None` for
    /// any other receiver.
    pub(super) fn optional_method(
        &mut self,
        receiver: &Value,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let optional = match (receiver, name.as_str()) {
            (Value::Ordering(order), _) => return self.ordering_method(order, call, &arguments),
            (Value::Truth(holds), "then_some") if arguments.len() == 1 => {
                let value = self.expression(arguments[0]);
                return Some(Value::some_if(holds.clone(), value));
            }
            (Value::Truth(holds), "then") if arguments.len() == 1 => {
                let function = self.function_argument(arguments[0], 0)?;
                if matches!(holds, Condition::Known(false)) {
                    return Some(Value::none());
                }
                let value = self.run_under(call, holds, |this| this.inline(&call.method, &function, Vec::new()));
                return Some(Value::some_if(holds.clone(), value));
            }
            (Value::Optional(optional), _) => optional,
            _ => return None,
        };
        let Optional { is_some, value } = &**optional;
        let nothing = matches!(is_some, Condition::Known(false));
        Some(match (name.as_str(), arguments.as_slice()) {
            ("clone" | "copied" | "cloned" | "as_ref", []) => receiver.clone(),
            ("iter" | "into_iter", []) => Value::iterator_of(receiver.clone().items()?),
            ("ok", []) | ("map_err", [_]) => receiver.clone(),
            ("ok_or", [error]) => self.without_error_effect(error, receiver.clone()),
            ("is_some" | "is_ok", []) => Value::Truth(is_some.clone()),
            ("is_none" | "is_err", []) => Value::Truth(is_some.clone().not()),
            ("unwrap", []) | ("expect", [_]) if nothing => {
                self.refuse(&call.method, messages::unwrapped_none());
                Value::Never
            }
            // If the option is `None`, these panic and the function has no value.
            ("unwrap", []) | ("expect", [_]) => value.clone(),
            ("unwrap_or", [otherwise]) => {
                let otherwise = self.expression_as(otherwise, expected);
                self.either_value(call, is_some, value, &otherwise)
            }
            ("unwrap_or_default", []) => {
                let ty = if nothing { expected.clone() } else { type_of(value, self.precision) };
                let otherwise = self.default_value(&call.method, &ty);
                self.either_value(call, is_some, value, &otherwise)
            }
            ("unwrap_or_else", [otherwise]) => {
                let function = self.function_without_value(otherwise)?;
                if matches!(is_some, Condition::Known(true)) {
                    return Some(value.clone());
                }
                let is_none = is_some.clone().not();
                let otherwise = self.run_under(call, &is_none, |this| this.inline(&call.method, &function, Vec::new()));
                self.either_value(call, is_some, value, &otherwise)
            }
            ("map", [_]) if nothing => receiver.clone(),
            ("map", [function]) => {
                let function = self.function_argument(function, 1)?;
                let mapped =
                    self.run_under(call, is_some, |this| this.inline(&call.method, &function, vec![value.clone()]));
                Value::some_if(is_some.clone(), mapped)
            }
            ("map_or" | "map_or_else", [otherwise, function]) => {
                let otherwise = if name == "map_or" {
                    self.expression_as(otherwise, expected)
                } else {
                    let otherwise = self.function_without_value(otherwise)?;
                    let is_none = is_some.clone().not();
                    self.run_under(call, &is_none, |this| this.inline(&call.method, &otherwise, Vec::new()))
                };
                let function = self.function_argument(function, 1)?;
                let mapped = if nothing {
                    Value::Never
                } else {
                    self.run_under(call, is_some, |this| this.inline(&call.method, &function, vec![value.clone()]))
                };
                self.either_value(call, is_some, &mapped, &otherwise)
            }
            ("and_then", [_]) if nothing => receiver.clone(),
            ("and_then", [function]) => {
                let function = self.function_argument(function, 1)?;
                let next =
                    self.run_under(call, is_some, |this| this.inline(&call.method, &function, vec![value.clone()]));
                self.either_value(call, is_some, &next, &Value::none())
            }
            ("is_some_and", [_]) | ("filter", [_]) if nothing => match name.as_str() {
                "filter" => receiver.clone(),
                _ => Value::Truth(Condition::Known(false)),
            },
            ("is_none_or", [_]) if nothing => Value::Truth(Condition::Known(true)),
            ("is_some_and" | "is_none_or" | "filter", [function]) => {
                let function = self.function_argument(function, 1)?;
                match self.run_under(call, is_some, |this| this.inline(&call.method, &function, vec![value.clone()])) {
                    Value::Truth(holds) if name == "filter" => {
                        Value::some_if(is_some.clone().and(holds), value.clone())
                    }
                    Value::Truth(holds) if name == "is_none_or" => Value::Truth(is_some.clone().not().or(holds)),
                    Value::Truth(holds) => Value::Truth(is_some.clone().and(holds)),
                    other => self.refuse_known(&other, &call.args, messages::not_a_condition(&other.describe())),
                }
            }
            ("or", [other]) => {
                let other = self.expression(other);
                self.either_value(call, is_some, receiver, &other)
            }
            ("and", [other]) => {
                let other = self.expression(other);
                self.either_value(call, is_some, &other, &Value::none())
            }
            ("xor" | "zip", [other]) => {
                let other = self.expression(other);
                let Value::Optional(of_other) = &other else {
                    return Some(self.refuse_known(&other, &call.args, messages::not_an_option(&other.describe())));
                };
                let both = is_some.clone().and(of_other.is_some.clone());
                if name == "zip" {
                    return Some(Value::some_if(both, Value::Tuple(vec![value.clone(), of_other.value.clone()])));
                }
                let one = self.either_value(call, is_some, receiver, &other);
                self.either_value(call, &both, &Value::none(), &one)
            }
            ("or_else", [_]) if matches!(is_some, Condition::Known(true)) => receiver.clone(),
            ("or_else", [function]) => {
                let function = self.function_without_value(function)?;
                let is_none = is_some.clone().not();
                let other = self.run_under(call, &is_none, |this| this.inline(&call.method, &function, Vec::new()));
                self.either_value(call, is_some, receiver, &other)
            }
            _ => self.refuse(&call.method, methods::unknown_method(&name, &receiver.describe(), METHODS)),
        })
    }

    pub(super) fn either_value(
        &mut self,
        call: &ExprMethodCall,
        condition: &Condition,
        then: &Value,
        otherwise: &Value,
    ) -> Value {
        then.select(self.algebra, condition, otherwise).unwrap_or_else(|| {
            let text = messages::branches_differ(&then.describe(), &otherwise.describe());
            self.refuse(&call.method, text)
        })
    }

    /// Evaluates `value?`, which returns from the function if there is no value.
    pub(super) fn try_value(&mut self, e: &ExprTry) -> Value {
        match self.expression(&e.expr) {
            Value::Optional(optional) => {
                let Optional { is_some, value } = (*optional).clone();
                self.branch(
                    &e.question_token,
                    Some(is_some),
                    |_| value,
                    |this| {
                        this.frame.exit(Target::Function, Value::none());
                        Value::Never
                    },
                )
            }
            value => self.refuse_known(&value, &e.question_token, messages::not_an_option(&value.describe())),
        }
    }
}
