//! `Default::default()` of the types that are understood.

use std::rc::Rc;

use syn::Expr;

use super::Translation;
use super::constants;
use super::fields::name_of;
use super::value::{Struct, Value};

/// Whether this is `Default::default()`, of whatever type is needed.
pub(super) fn is_default(value: &Expr) -> bool {
    let Expr::Call(call) = value else { return false };
    let Expr::Path(path) = &*call.func else { return false };
    let names: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
    call.args.is_empty() && names.ends_with(&["Default".to_owned(), "default".to_owned()])
}

impl Translation<'_> {
    /// What a type has by default; of a struct what it says itself, or what is derived.
    pub(super) fn default_of(&mut self, ty: &syn::Type) -> Option<Value> {
        match ty {
            syn::Type::Path(path) => {
                let name = path.path.segments.last()?.ident.to_string();
                let name = self.resolved(&name);
                if let Some(function) = self.items.function(Some(&name), "default").cloned() {
                    return Some(self.inline(ty, &function, Vec::new()));
                }
                if let Some(fields) = self.items.fields(&name) {
                    let fields = fields.to_vec();
                    let fields = fields.iter().map(|(member, ty)| Some((name_of(member), self.default_of(ty)?)));
                    return Some(Value::Struct(Rc::new(Struct { fields: fields.collect::<Option<_>>()?, name })));
                }
                match name.as_str() {
                    "f32" | "f64" => Some(Value::Scalar(self.algebra.number(0.0))),
                    _ if name.contains("Vec") => constants::associated(self.algebra, &name, "ZERO"),
                    _ => constants::associated(self.algebra, &name, "IDENTITY"),
                }
            }
            syn::Type::Array(array) => {
                let length = self.expression(&array.len);
                let length = self.algebra.known_index(&length)?;
                let value = self.default_of(&array.elem)?;
                Some(Value::Array(vec![value; length]))
            }
            _ => None,
        }
    }
}
