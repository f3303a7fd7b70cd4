//! Enums. A value is a [`Struct`] of the variant's index and the fields of all variants, of which only its own
//! variant's are present. As a struct, it can be selected, stored and passed on like one.

use std::rc::Rc;

use quote::ToTokens;
use syn::parse::{ParseStream, Parser};
use syn::{BinOp, Expr, Member, Pat, Token};

use super::condition::Condition;
use super::expected::Expected;
use super::fields::name_of;
use super::patterns::placed;
use super::value::{Struct, Value};
use super::{Translation, operators};
use crate::differentiate::items::Enumeration;
use crate::differentiate::messages;

/// Name of the field that holds the variant's index. It is not an identifier, so no user's field has this name.
pub(in crate::differentiate) const TAG: &str = "#";

/// Returns the name of the field that holds this field of a variant.
pub(in crate::differentiate) fn field_of(variant: &str, member: &Member) -> String {
    format!("{variant}.{}", name_of(member))
}

impl Translation<'_> {
    /// Resolves a path to an enum and the index of a variant; `None` if it is something else.
    pub(super) fn variant(&self, path: &[String]) -> Option<(String, usize)> {
        let (variant, ty) = path.split_last()?;
        let (ty, variant) = if ty.is_empty() {
            // The variant's name alone, if it is imported.
            let full = self.resolved(path);
            let (ty, variant) = full.rsplit_once("::")?;
            (ty.to_owned(), variant.to_owned())
        } else {
            (self.resolved(ty), variant.clone())
        };
        let place = self.items.enumeration(&ty)?.variants.iter().position(|known| known.name == variant)?;
        Some((ty, place))
    }

    /// Builds a value of the variant with index `tag` and these fields.
    pub(super) fn of_variant(&mut self, ty: &str, tag: usize, mut fields: Vec<(String, Value)>) -> Value {
        let Some(Enumeration { variants, .. }) = self.items.enumeration(ty) else { return Value::Unknown };
        if fields.iter().any(|(_, value)| value.is_unknown()) {
            return Value::Unknown;
        }
        let mut all = vec![(TAG.to_owned(), self.algebra.count_value(tag))];
        for (place, variant) in variants.iter().enumerate() {
            all.extend(variant.fields.iter().map(|(member, _)| {
                let own = fields.iter().position(|(name, _)| place == tag && *name == name_of(member));
                let value = own.map_or(Value::Never, |own| fields.swap_remove(own).1);
                (field_of(&variant.name, member), value)
            }));
        }
        Value::Struct(Rc::new(Struct { name: ty.to_owned(), fields: all }))
    }

    /// Returns the discriminant of a variant, as in `value as u32`.
    pub(super) fn discriminant(&mut self, cast: &syn::ExprCast, of: &Struct) -> Value {
        let Some(Enumeration { scope, variants, .. }) = self.items.enumeration(&of.name) else { return Value::Unknown };
        let Some(Value::Integer(tag)) = of.field(TAG) else { return Value::Unknown };
        let (mut next, mut numbers) = (0, Vec::with_capacity(variants.len()));
        for variant in variants {
            if let Some(written) = &variant.discriminant {
                let value = self.within(scope.clone(), |this| this.expression(written));
                match self.algebra.known_integer(&value) {
                    Some(known) => next = known,
                    None => return self.refuse_known(&value, &cast.expr, messages::index_unknown()),
                }
            }
            numbers.push(self.algebra.integer(next));
            next += 1;
        }
        Value::Array(numbers).select_element(self.algebra, *tag).unwrap_or(Value::Unknown)
    }

    /// Returns the types of a variant's fields, as far as they are known.
    pub(super) fn expected_fields(&mut self, ty: &str, tag: usize) -> Vec<(String, Expected)> {
        let Some(Enumeration { scope, variants, .. }) = self.items.enumeration(ty) else { return Vec::new() };
        let fields = variants.get(tag).map_or(&[][..], |variant| &variant.fields);
        self.within(scope.clone(), |this| {
            fields.iter().map(|(member, ty)| (name_of(member), this.expected(ty))).collect()
        })
    }

    /// Returns the condition that a value is of this variant and that its fields match the patterns; `None` after an
    /// error.
    pub(super) fn matches_variant(
        &mut self,
        pattern: &Pat,
        (ty, tag): (&str, usize),
        value: &Value,
    ) -> Option<Condition> {
        let Value::Struct(of) = value else {
            self.refuse_known(value, pattern, messages::pattern_of(&value.describe()));
            return None;
        };
        // If the value is of another type, the compiler reports it.
        let Some(Value::Integer(found)) = of.field(TAG).filter(|_| of.name == ty) else { return None };
        let variant = self.items.enumeration(ty)?.variants.get(tag)?;
        let tag = self.algebra.count(tag);
        let is_it = Condition::equal(self.algebra, *found, tag);
        // Without its fields, the variant was constructed on no branch.
        let is_made =
            |(member, _): &(Member, _)| !of.field(&field_of(&variant.name, member)).is_some_and(Value::is_never);
        if matches!(is_it, Condition::Known(false)) || !variant.fields.iter().all(is_made) {
            return Some(Condition::Known(false));
        }
        let field = |member: &Member| of.field(&field_of(&variant.name, member)).cloned().unwrap_or(Value::Unknown);
        let parts: Vec<(&Pat, Value)> = match pattern {
            Pat::Struct(of) => of.fields.iter().map(|written| (&*written.pat, field(&written.member))).collect(),
            Pat::TupleStruct(of) => {
                let placed = placed(&of.elems, variant.fields.len()).into_iter();
                placed.map(|(place, element)| (element, field(&Member::from(place)))).collect()
            }
            _ => Vec::new(),
        };
        let inner = self.patterns(parts.iter().map(|(pattern, part)| (*pattern, part)))?;
        Some(is_it.and(inner))
    }

    /// Evaluates `==` or `!=` of composite values, by their own `eq` or as derived. `None` for anything else.
    pub(super) fn equality(&mut self, operator: &BinOp, left: &Value, right: &Value) -> Option<Value> {
        let is_equal = matches!(operator, BinOp::Eq(_));
        if !is_equal && !matches!(operator, BinOp::Ne(_)) {
            return None;
        }
        match self.equal(operator, left, right)? {
            Value::Truth(equal) => Some(Value::Truth(if is_equal { equal } else { equal.not() })),
            other => Some(other),
        }
    }

    /// Returns the condition that two values are equal; `None` if they cannot be compared.
    pub(super) fn equal(&mut self, operator: &impl ToTokens, left: &Value, right: &Value) -> Option<Value> {
        if let Value::Struct(of) = left {
            let several = self.functions(Some(&of.name), "eq");
            if let Some(own) = self.function_for(&several, &[left.clone(), right.clone()]) {
                return Some(self.inline(operator, &own, vec![left.clone(), right.clone()]));
            }
        }
        let parts: Vec<(Value, Value)> = match (left, right) {
            (Value::Struct(x), Value::Struct(y)) if x.name == y.name => {
                if self.items.enumeration(&x.name).is_some() {
                    return self.equal_variants(operator, x, y);
                }
                // Fields that are not read cannot be compared.
                if self.items.structure(&x.name)?.fields.len() != x.fields.len() {
                    return None;
                }
                x.fields.iter().zip(&y.fields).map(|((_, x), (_, y))| (x.clone(), y.clone())).collect()
            }
            (Value::Planar(_), Value::Planar(_))
            | (Value::Vector(_), Value::Vector(_))
            | (Value::Four(_), Value::Four(_))
            | (Value::Quaternion(_), Value::Quaternion(_)) => {
                let [x, y] = [left, right].map(|value| value.elements(self.algebra));
                if x.is_empty() {
                    return None;
                }
                x.into_iter().zip(y).collect()
            }
            (Value::Array(x), Value::Array(y)) | (Value::Tuple(x), Value::Tuple(y)) if x.len() == y.len() => {
                x.iter().cloned().zip(y.iter().cloned()).collect()
            }
            (Value::Optional(x), Value::Optional(y)) => {
                let (one, other) = (x.is_some.clone(), y.is_some.clone());
                let neither = one.clone().not().and(other.clone().not());
                if x.value.is_never() || y.value.is_never() {
                    return Some(Value::Truth(neither));
                }
                return match self.equal(operator, &x.value, &y.value)? {
                    Value::Truth(equal) => Some(Value::Truth(neither.or(one.and(other).and(equal)))),
                    other => Some(other),
                };
            }
            _ => return operators::binary(self.algebra, &syn::parse_quote!(==), left, right),
        };
        let mut all = Condition::Known(true);
        for (x, y) in parts {
            match self.equal(operator, &x, &y)? {
                Value::Truth(equal) => all = all.and(equal),
                other => return Some(other),
            }
        }
        Some(Value::Truth(all))
    }

    /// Returns the condition that the variants are the same and that their fields are equal.
    fn equal_variants(&mut self, operator: &impl ToTokens, x: &Struct, y: &Struct) -> Option<Value> {
        let variants = &self.items.enumeration(&x.name)?.variants;
        let (Value::Integer(tag), Value::Integer(other)) = (x.field(TAG)?, y.field(TAG)?) else { return None };
        let mut all = Condition::equal(self.algebra, *tag, *other);
        for (number, variant) in variants.iter().enumerate() {
            let number = self.algebra.count(number);
            let is_another = Condition::equal(self.algebra, *tag, number).not();
            for (member, _) in &variant.fields {
                let name = field_of(&variant.name, member);
                let (one, two) = (x.field(&name)?, y.field(&name)?);
                // At most one of the values has this field; where it has, the variants differ.
                if one.is_never() || two.is_never() {
                    continue;
                }
                match self.equal(operator, one, two)? {
                    Value::Truth(equal) => all = all.and(is_another.clone().or(equal)),
                    other => return Some(other),
                }
            }
        }
        Some(Value::Truth(all))
    }

    /// Evaluates `matches!(value, pattern if condition)`.
    pub(super) fn matches_macro(&mut self, call: &syn::Macro) -> Value {
        let parse = |input: ParseStream<'_>| {
            let value: Expr = input.parse()?;
            input.parse::<Token![,]>()?;
            let pattern = Pat::parse_multi_with_leading_vert(input)?;
            let guard = if input.peek(Token![if]) {
                input.parse::<Token![if]>()?;
                Some(input.parse::<Expr>()?)
            } else {
                None
            };
            input.parse::<Option<Token![,]>>()?;
            Ok((value, pattern, guard))
        };
        let Ok((value, pattern, guard)) = parse.parse2(call.tokens.clone()) else {
            return self.refuse(&call.path, messages::macro_call());
        };
        let value = self.expression(&value);
        if value.is_unknown() {
            return value;
        }
        let depth = self.frame.depth();
        let matched = self.guarded(&pattern, guard.as_ref(), &value);
        self.frame.end_scope(depth);
        matched.map_or(Value::Unknown, Value::Truth)
    }
}
