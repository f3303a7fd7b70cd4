//! `Default::default()` of supported types.

use std::rc::Rc;

use quote::ToTokens;

use super::Translation;
use super::condition::Condition;
use super::constants;
use super::expected::Expected;
use super::fields::name_of;
use super::value::{Struct, Value};
use crate::differentiate::types;

impl Translation<'_> {
    /// Returns the default value of a type; for a struct by its own or its derived `Default`. `None` if it has neither.
    pub(super) fn default_of(&mut self, place: &impl ToTokens, of: &Expected) -> Option<Value> {
        match of {
            Expected::Named(name) | Expected::Generic(name, _) => {
                let own: Vec<_> = self.items.functions(Some(name), "default").cloned().collect();
                let mut own = own.into_iter().filter(|function| function.of_trait.as_deref() == Some("Default"));
                if let Some(function) = own.next() {
                    let function = self.specialised(&function, Some(of), of);
                    return own.next().is_none().then(|| self.inline(place, &function, Vec::new()));
                }
                if let Some(structure) = self.items.structure(name) {
                    if !structure.has_default {
                        return None;
                    }
                    let types = self.field_types(structure, of);
                    let fields = structure
                        .fields
                        .iter()
                        .zip(types)
                        .map(|((member, _), ty)| Some((name_of(member), self.default_of(place, &ty)?)));
                    let fields = fields.collect::<Option<_>>()?;
                    return Some(Value::Struct(Rc::new(Struct { fields, name: name.clone() })));
                }
                if let Some(enumeration) = self.items.enumeration(name) {
                    let default = enumeration.default?;
                    return Some(self.of_variant(name, default, Vec::new()));
                }
                match name.as_str() {
                    "bool" => Some(Value::Truth(Condition::Known(false))),
                    name if types::is_integer(name) => Some(self.algebra.integer(0)),
                    "f32" | "f64" => Some(Value::Scalar(self.algebra.number(0.0))),
                    name => ["ZERO", "IDENTITY"].iter().find_map(|constant| match (*constant, types::named(name)?.0) {
                        ("ZERO", types::Shape::Matrix | types::Shape::Square(_)) => None,
                        (constant, _) => constants::associated(self.algebra, name, constant),
                    }),
                }
            }
            Expected::Array(element, Some(length)) => {
                let value = self.default_of(place, element)?;
                Some(Value::Array(vec![value; *length]))
            }
            Expected::Tuple(parts) => {
                let values = parts.iter().map(|part| self.default_of(place, part));
                Some(Value::Tuple(values.collect::<Option<_>>()?))
            }
            Expected::Optional => Some(Value::none()),
            Expected::Array(_, None) | Expected::Other | Expected::Any => None,
        }
    }
}
