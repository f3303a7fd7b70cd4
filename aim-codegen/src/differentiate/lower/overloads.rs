//! Overload resolution: selects one of several functions of the same name, by the types of their parameters and
//! arguments.

use std::rc::Rc;

use syn::BinOp;

use super::expected::Expected;
use super::place_types::type_of;
use super::value::{Callable, Value};
use super::{Translation, operators};
use crate::declare::report::text::Text;
use crate::differentiate::messages;

impl Translation<'_> {
    /// Returns the functions with this name.
    pub(super) fn functions(&self, of: Option<&str>, name: &str) -> Vec<Rc<Callable>> {
        let of_value: Vec<_> = self.items.functions(of, name).cloned().collect();
        match of {
            Some(ty) if of_value.is_empty() => self.items.functions(Some(&format!("&{ty}")), name).cloned().collect(),
            _ => of_value,
        }
    }

    /// Returns the function with this name; `None` if there is none, or several.
    pub(super) fn only_function(&self, of: Option<&str>, name: &str) -> Option<Rc<Callable>> {
        match self.functions(of, name).as_slice() {
            [function] => Some(function.clone()),
            _ => None,
        }
    }

    /// Returns the one of several functions that accepts these arguments; `None` if there is none, or several.
    pub(super) fn function_for(&mut self, several: &[Rc<Callable>], arguments: &[Value]) -> Option<Rc<Callable>> {
        let mut fitting = Vec::new();
        for function in several {
            let fits = function.parameters.len() == arguments.len()
                && (0..arguments.len()).all(|index| self.parameter(function, index).fits(&arguments[index]));
            if fits {
                fitting.push(function.clone());
            }
        }
        if fitting.len() == 1 { fitting.pop() } else { None }
    }

    /// Returns the expected type of a parameter.
    pub(super) fn parameter(&mut self, function: &Callable, index: usize) -> Expected {
        match function.parameters.get(index) {
            Some((_, Some(ty))) => self.within(function.scope.clone(), |this| this.expected(ty)),
            _ => Expected::Any,
        }
    }

    /// Returns the expected type of an operator's right operand: that of the only overload, if the left one is a struct
    /// of the module.
    pub(super) fn right_operand(&mut self, operator: &BinOp, left: &Value) -> Expected {
        let (Value::Struct(of), Some(name)) = (left, operators::method(operator)) else { return Expected::Any };
        match self.only_function(Some(&of.name), name) {
            Some(function) => self.parameter(&function, 1),
            None => Expected::Any,
        }
    }

    /// Returns the name of a value's type.
    pub(super) fn type_name(&self, value: &Value) -> Option<String> {
        type_of(value, self.precision).name().map(str::to_owned)
    }

    /// Returns the overloaded operator for two values, one of which is a struct of the module; `None` if there is none.
    pub(super) fn own_operator(
        &mut self,
        operator: &BinOp,
        left: &Value,
        right: &Value,
    ) -> Option<Result<Rc<Callable>, Text>> {
        let name = operators::method(operator)?;
        if !matches!((left, right), (Value::Struct(_), _) | (_, Value::Struct(_))) {
            return None;
        }
        let ty = self.type_name(left)?;
        let mut several: Vec<_> = self.items.functions(Some(&ty), name).cloned().collect();
        // If operators for values and for references exist, use those for values.
        let by_value =
            |function: &&Rc<Callable>| !matches!(function.parameters.last(), Some((_, Some(syn::Type::Reference(_)))));
        let of_values: Vec<_> = several.iter().filter(by_value).cloned().collect();
        several.extend(self.items.functions(Some(&format!("&{ty}")), name).cloned());
        // The operand that is changed does not decide the overload.
        let arguments = [Value::Unknown, right.clone()];
        let found = self.function_for(&of_values, &arguments).or_else(|| self.function_for(&several, &arguments));
        match (found, several.len()) {
            (Some(found), _) => Some(Ok(found)),
            (None, 0 | 1) => None,
            (None, _) => Some(Err(messages::several_functions(name))),
        }
    }
}
