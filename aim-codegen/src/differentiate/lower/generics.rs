//! Generic parameters: lengths and types that are known when a function is run. They are variables of its frame, under
//! their own names. Their values come from the arguments, or from the type whose associated function is called.

use std::rc::Rc;

use syn::{Expr, GenericArgument, PathArguments, Type};

use super::Translation;
use super::enums::field_of;
use super::expected::Expected;
use super::fields::name_of;
use super::value::{Callable, Scope, Struct, Value};
use crate::differentiate::generic_arguments;
use crate::differentiate::items::{Enumeration, Structure};
use crate::differentiate::names::{self, Meaning, segments};

/// Generic parameters with their values: a length, a type, or a value of the type.
type GenericValues = Vec<(String, Value)>;

impl Translation<'_> {
    /// Returns the name of the type that a generic parameter stands for.
    pub(super) fn generic(&self, name: &str) -> Option<String> {
        match self.frame.find(name).map(|place| self.frame.value(place)) {
            Some(Value::Type(ty)) => Some(ty.clone()),
            _ => None,
        }
    }

    /// Declares the generic parameters in a parameter's type, by its argument.
    pub(super) fn bind_generics(&mut self, ty: &Type, value: &Value) {
        let scope = self.frame.scope.clone();
        if scope.lengths.is_empty() && scope.generics.is_empty() {
            return;
        }
        let names: Vec<&String> = scope.lengths.iter().chain(&scope.generics).collect();
        let mut found = Vec::new();
        self.match_generics(&names, &scope, ty, value, &mut found);
        self.declare_generics(found);
    }

    fn declare_generics(&mut self, found: GenericValues) {
        for (name, value) in found {
            let value = match value {
                Value::Type(_) => Some(value),
                value if self.frame.scope.generics.contains(&name) => self.type_name(&value).map(Value::Type),
                value => Some(value),
            };
            if let Some(value) = value {
                self.frame.declare(name, value);
            }
        }
    }

    /// Finds these parameters in a written type, by a value of that type.
    fn match_generics(
        &mut self,
        names: &[&String],
        scope: &Scope,
        ty: &Type,
        value: &Value,
        found: &mut GenericValues,
    ) {
        match (ty, value) {
            (Type::Reference(reference), _) => self.match_generics(names, scope, &reference.elem, value, found),
            (Type::Group(group), _) => self.match_generics(names, scope, &group.elem, value, found),
            (Type::Paren(paren), _) => self.match_generics(names, scope, &paren.elem, value, found),
            (Type::Array(array), Value::Array(values)) => {
                if let Expr::Path(path) = &array.len
                    && let Some(name) =
                        path.path.get_ident().and_then(|name| names.iter().find(|known| name == **known))
                {
                    found.push(((*name).clone(), self.algebra.count_value(values.len())));
                }
                if let Some(first) = values.first() {
                    self.match_generics(names, scope, &array.elem, first, found);
                }
            }
            (Type::Slice(slice), Value::Array(values)) => {
                if let Some(first) = values.first() {
                    self.match_generics(names, scope, &slice.elem, first, found);
                }
            }
            (Type::Tuple(tuple), Value::Tuple(values)) => {
                for (part, value) in tuple.elems.iter().zip(values) {
                    self.match_generics(names, scope, part, value, found);
                }
            }
            (Type::Path(path), value) if path.path.is_ident("Self") => {
                if let Some(written) = scope.self_written.clone() {
                    let scope = Scope { self_written: None, ..scope.clone() };
                    self.match_generics(names, &scope, &written, value, found);
                }
            }
            (Type::Path(path), value) => {
                if let Meaning::Own(name) = self.items.meaning(scope, &segments(&path.path))
                    && let Some(alias) = self.items.alias(&name)
                    && let Some(ty) =
                        generic_arguments::substituted(&alias.ty, &alias.parameters, &path.path, scope, self.items)
                {
                    self.match_generics(names, scope, &ty, value, found);
                } else if let Some(name) =
                    path.path.get_ident().and_then(|name| names.iter().find(|known| name == **known))
                {
                    found.push(((*name).clone(), value.clone()));
                } else if let Value::Struct(of) = value {
                    let arguments = names::arguments(&path.path);
                    if !arguments.is_empty() {
                        let known = self.arguments_of(of);
                        self.match_arguments(names, scope, &arguments, &known, found);
                    }
                }
            }
            _ => {}
        }
    }

    /// Returns the generic arguments of a struct or an enum, in order, by a value of it.
    fn arguments_of(&mut self, of: &Struct) -> Vec<Value> {
        let (scope, parameters, fields): (_, _, Vec<(String, &Type)>) =
            if let Some(Structure { scope, parameters, fields, .. }) = self.items.structure(&of.name) {
                (scope, parameters, fields.iter().map(|(member, ty)| (name_of(member), ty)).collect())
            } else if let Some(Enumeration { scope, parameters, variants, .. }) = self.items.enumeration(&of.name) {
                let fields = variants.iter().flat_map(|variant| {
                    variant.fields.iter().map(|(member, ty)| (field_of(&variant.name, member), ty))
                });
                (scope, parameters, fields.collect())
            } else {
                return Vec::new();
            };
        let names: Vec<&String> = parameters.iter().map(|parameter| &parameter.name).collect();
        let mut found = Vec::new();
        for (name, ty) in fields {
            if let Some(value) = of.field(&name) {
                self.match_generics(&names, scope, ty, value, &mut found);
            }
        }
        let of_name = |name: &&String| found.iter().find(|(known, _)| known == *name).map(|(_, value)| value.clone());
        names.iter().map(|name| of_name(name).unwrap_or(Value::Unknown)).collect()
    }

    /// Finds parameters in written generic arguments, by the known arguments.
    fn match_arguments(
        &mut self,
        names: &[&String],
        scope: &Scope,
        written: &[&GenericArgument],
        known: &[Value],
        found: &mut GenericValues,
    ) {
        for (argument, value) in written.iter().zip(known).filter(|(_, value)| !value.is_unknown()) {
            match argument {
                GenericArgument::Type(ty) => self.match_generics(names, scope, ty, value, found),
                GenericArgument::Const(Expr::Path(path)) => {
                    self.match_generics(names, scope, &syn::parse_quote!(#path), value, found);
                }
                _ => {}
            }
        }
    }

    /// Returns the meaning of a type with generic arguments.
    pub(super) fn expected_generic(&mut self, path: &syn::Path, last: &syn::PathSegment) -> Expected {
        let scope = self.frame.scope.clone();
        if let Meaning::Own(name) = self.items.meaning(&scope, &segments(path))
            && let Some(alias) = self.items.alias(&name)
        {
            let ty = generic_arguments::substituted(&alias.ty, &alias.parameters, path, &scope, self.items);
            return ty.map_or(Expected::Any, |ty| self.within(alias.scope.clone(), |this| this.expected(&ty)));
        }
        let name = self.resolved(&segments(path));
        let structure = self.items.structure(&name).map(|structure| &structure.parameters);
        let enumeration = self.items.enumeration(&name).map(|enumeration| &enumeration.parameters);
        let Some(parameters) = structure.or(enumeration) else { return Expected::Any };
        let arguments = match &last.arguments {
            PathArguments::AngleBracketed(_) => names::arguments(path),
            _ => Vec::new(),
        };
        let mut known = Vec::new();
        for (argument, parameter) in arguments.into_iter().zip(parameters) {
            known.push(match argument {
                GenericArgument::Const(length) if parameter.is_length => self.length_of(length),
                // The parser reads the name of a constant as a type.
                GenericArgument::Type(Type::Path(name)) if parameter.is_length => {
                    self.length_of(&syn::parse_quote!(#name))
                }
                GenericArgument::Type(ty) => {
                    self.expected(ty).name().map_or(Value::Unknown, |name| Value::Type(name.to_owned()))
                }
                _ => Value::Unknown,
            });
        }
        Expected::Generic(name, known)
    }

    fn length_of(&mut self, length: &Expr) -> Value {
        match self.known_length(length) {
            Some(length) => self.algebra.count_value(length),
            None => Value::Unknown,
        }
    }

    /// Declares the parameters of a struct, as far as its arguments are known.
    pub(super) fn declare_arguments(&mut self, structure: &Structure, of: &Expected) {
        let Expected::Generic(_, known) = of else { return };
        for (parameter, value) in structure.parameters.iter().zip(known).filter(|(_, value)| !value.is_unknown()) {
            self.frame.declare(parameter.name.clone(), value.clone());
        }
    }

    /// Returns a function of a generic type, specialised to the type's arguments: those written before its name, or
    /// else those of its expected result.
    pub(super) fn specialised(
        &mut self,
        function: &Rc<Callable>,
        called: Option<&Expected>,
        result: &Expected,
    ) -> Rc<Callable> {
        let Some(own) = &function.scope.self_written else { return function.clone() };
        let is_self = |ty: &&Type| matches!(ty, Type::Path(path) if path.path.is_ident("Self"));
        let (of, written) = match (called, &function.result) {
            (Some(called), _) => (called, &**own),
            (None, Some(ty)) => (result, if is_self(&ty) { &**own } else { ty }),
            (None, None) => return function.clone(),
        };
        let (Expected::Generic(_, known), Type::Path(path)) = (of, written) else { return function.clone() };
        let names: Vec<&String> = function.scope.lengths.iter().chain(&function.scope.generics).collect();
        let mut found = Vec::new();
        self.match_arguments(&names, &function.scope, &names::arguments(&path.path), known, &mut found);
        let captured = function.captured.iter().cloned().chain(found).collect();
        Rc::new(Callable { captured, ..(**function).clone() })
    }

    /// Returns a function, specialised to the type that is expected of its result.
    pub(super) fn with_result(&mut self, function: &Rc<Callable>, expected: &Expected) -> Rc<Callable> {
        let names: Vec<&String> = function.scope.lengths.iter().chain(&function.scope.generics).collect();
        let Some(ty) = function.result.as_ref().filter(|_| !names.is_empty()) else { return function.clone() };
        let mut found = Vec::new();
        self.match_expected(&names, &function.scope, ty, expected, &mut found);
        let captured = function.captured.iter().cloned().chain(found).collect();
        Rc::new(Callable { captured, ..(**function).clone() })
    }

    /// Finds these parameters in a written type, by the type that is expected there.
    fn match_expected(
        &mut self,
        names: &[&String],
        scope: &Scope,
        ty: &Type,
        expected: &Expected,
        found: &mut GenericValues,
    ) {
        let named = |path: &syn::Path| {
            let name = path.get_ident()?.to_string();
            names.iter().find(|known| name == ***known).map(|name| (*name).clone())
        };
        match (ty, expected) {
            (Type::Group(group), _) => self.match_expected(names, scope, &group.elem, expected, found),
            (Type::Paren(paren), _) => self.match_expected(names, scope, &paren.elem, expected, found),
            (Type::Array(array), Expected::Array(element, length)) => {
                if let (Expr::Path(path), Some(length)) = (&array.len, length)
                    && let Some(name) = named(&path.path)
                {
                    found.push((name, self.algebra.count_value(*length)));
                }
                self.match_expected(names, scope, &array.elem, element, found);
            }
            (Type::Tuple(tuple), Expected::Tuple(parts)) => {
                for (ty, part) in tuple.elems.iter().zip(parts) {
                    self.match_expected(names, scope, ty, part, found);
                }
            }
            (Type::Path(path), Expected::Named(ty)) => {
                found.extend(named(&path.path).map(|name| (name, Value::Type(ty.clone()))));
            }
            (Type::Path(path), Expected::Generic(_, known)) => {
                self.match_arguments(names, scope, &names::arguments(&path.path), known, found);
            }
            _ => {}
        }
    }

    /// Returns a function, specialised to the generic arguments written after its name.
    pub(super) fn with_arguments(&mut self, function: &Rc<Callable>, path: &syn::Path) -> Rc<Callable> {
        let (lengths, types) = (&function.scope.lengths, &function.scope.generics);
        let arguments = names::arguments(path);
        if arguments.is_empty() || arguments.len() != lengths.len() + types.len() {
            return function.clone();
        }
        let (mut lengths, mut types) = (lengths.iter(), types.iter());
        let mut captured = function.captured.clone();
        for argument in arguments {
            let length = match argument {
                GenericArgument::Const(length) => self.length_of(length),
                // The parser reads the name of a constant as a type.
                GenericArgument::Type(Type::Path(name)) if lengths.len() > 0 => {
                    self.length_of(&syn::parse_quote!(#name))
                }
                _ => Value::Unknown,
            };
            let (name, value) = match argument {
                GenericArgument::Type(ty) if length.is_unknown() => {
                    let named = self.expected(ty).name().map(|name| Value::Type(name.to_owned()));
                    (types.next(), named.unwrap_or(Value::Unknown))
                }
                _ => (lengths.next(), length),
            };
            captured.extend(name.filter(|_| !value.is_unknown()).map(|name| (name.clone(), value)));
        }
        Rc::new(Callable { captured, ..(**function).clone() })
    }
}
