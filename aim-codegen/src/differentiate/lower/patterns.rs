//! Patterns: the condition that a value matches, and the values that names are bound to.

use std::rc::Rc;

use aim_symbolic::Scalar;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Expr, ExprMethodCall, Member, Pat, PatSlice, RangeLimits};

use super::condition::Condition;
use super::numbers;
use super::statements::is_rest;
use super::value::Value;
use super::{Translation, operators, strip};
use crate::differentiate::messages;
use crate::differentiate::names::{Meaning, segments};

impl Translation<'_> {
    /// Returns the condition that a value matches a pattern, and binds the pattern's names; `None` after an error.
    pub(super) fn pattern(&mut self, pattern: &Pat, value: &Value) -> Option<Condition> {
        if value.is_unknown() {
            // Declare its names without further errors.
            let before = self.report_counts();
            self.bind(pattern, Value::Unknown);
            self.forget_reports_since(before);
            return None;
        }
        if let Value::Reference(place) = value {
            match pattern {
                Pat::Paren(_) | Pat::Reference(_) | Pat::Guard(_) | Pat::Or(_) | Pat::Wild(_) => {}
                Pat::Ident(name) if self.is_variable(name) => {}
                Pat::Slice(slice) if slice.elems.iter().any(is_rest) => {
                    let is_long = !matches!(self.read(place), Value::Array(all) if all.len() + 1 < slice.elems.len());
                    if is_long {
                        self.bind(pattern, value.clone());
                    }
                    return Some(Condition::Known(is_long));
                }
                // The pattern takes the value apart, or compares the referenced value.
                _ => {
                    let parts = self.lent_parts(value.clone());
                    let parts = self.referenced(parts);
                    return self.pattern(pattern, &parts);
                }
            }
        }
        if let Some((ty, tag)) = path_of(pattern).and_then(|path| self.variant(&path)) {
            return self.matches_variant(pattern, (&ty, tag), value);
        }
        match pattern {
            Pat::Paren(paren) => self.pattern(&paren.pat, value),
            Pat::Reference(reference) => {
                let value = self.referenced(value.clone());
                self.pattern(&reference.pat, &value)
            }
            Pat::Guard(guard) => self.guarded(&guard.pat, Some(&guard.guard), value),
            Pat::Lit(literal) => self.equal_to(&Expr::Lit(literal.clone()), value),
            Pat::Ident(name) if name.ident == "None" && matches!(value, Value::Optional(_)) => match value {
                Value::Optional(optional) => Some(optional.is_some.clone().not()),
                _ => None,
            },
            Pat::Ident(name) if name.subpat.is_none() && self.named(&name.ident) == Named::Constant => {
                let path = &name.ident;
                self.equal_to(&syn::parse_quote!(#path), value)
            }
            Pat::Ident(name) if name.subpat.is_none() && self.named(&name.ident) == Named::Unknown => {
                self.refuse(name, messages::unknown_pattern(&name.ident.to_string()));
                None
            }
            Pat::Path(path) => self.equal_to(&Expr::Path(path.clone()), value),
            Pat::Or(or) => self.any_of(pattern, or.cases.iter(), None, value),
            Pat::Range(range) => {
                let ends = [&range.start, &range.end].map(Option::as_deref);
                self.is_between(number(value), ends, &range.limits)
            }
            Pat::Tuple(tuple) => match value {
                Value::Tuple(values) if fits(&tuple.elems, values.len()) => {
                    let placed = placed(&tuple.elems, values.len()).into_iter();
                    self.patterns(placed.map(|(place, element)| (element, &values[place])))
                }
                other => {
                    self.refuse(tuple, messages::pattern_of(&other.describe()));
                    None
                }
            },
            Pat::Slice(slice) => self.slice_pattern(slice, value),
            Pat::TupleStruct(of) => match (value, of.path.segments.last()) {
                (Value::Optional(optional), Some(last)) if last.ident == "Err" => {
                    if !of.elems.iter().all(|element| matches!(element, Pat::Wild(_) | Pat::Rest(_))) {
                        self.refuse(of, messages::error_value());
                        self.patterns(of.elems.iter().map(|element| (element, &Value::Unknown)));
                        return None;
                    }
                    Some(optional.is_some.clone().not())
                }
                (Value::Optional(optional), Some(last)) if last.ident == "Some" || last.ident == "Ok" => {
                    match &optional.is_some {
                        Condition::Known(false) => Some(Condition::Known(false)),
                        is_some if matches!(of.elems.first(), Some(Pat::Rest(_))) => Some(is_some.clone()),
                        is_some => {
                            let inner = of.elems.first().map(|inner| self.pattern(inner, &optional.value));
                            inner.flatten().map(|inner| is_some.clone().and(inner))
                        }
                    }
                }
                _ => {
                    let parts = self.parts_of(of, value);
                    self.patterns(parts.iter().map(|(element, part)| (*element, part)))
                }
            },
            Pat::Struct(of) => {
                let parts: Vec<Value> = of.fields.iter().map(|field| self.moved_part(value, &field.member)).collect();
                self.patterns(of.fields.iter().map(|field| &*field.pat).zip(&parts))
            }
            Pat::Ident(syn::PatIdent { subpat: Some((_, inner)), .. }) => {
                let mut name = pattern.clone();
                if let Pat::Ident(name) = &mut name {
                    name.subpat = None;
                }
                self.bind(&name, value.clone());
                self.pattern(inner, value)
            }
            Pat::Wild(_) | Pat::Ident(_) => {
                self.bind(pattern, value.clone());
                Some(Condition::Known(true))
            }
            other => {
                self.refuse(other, messages::match_pattern());
                None
            }
        }
    }

    /// Returns the condition that the number of elements fits a slice pattern and each element matches its part; `None`
    /// after an error.
    fn slice_pattern(&mut self, pattern: &PatSlice, value: &Value) -> Option<Condition> {
        let elements = &pattern.elems;
        let rest = elements.iter().position(is_rest);
        let count = elements.len() - usize::from(rest.is_some());
        let (mut matched, parts) = match value {
            Value::Slice(slice) => {
                let a = &mut *self.algebra;
                let (named, one) = (a.count(count), a.count(1));
                let left = a.sub(slice.len, named);
                let fits = match rest {
                    Some(_) => Condition::at_most(a, named, slice.len),
                    None => Condition::equal(a, named, slice.len),
                };
                let mut index = a.count(0);
                let parts = (0..elements.len()).map(|place| {
                    let first = index;
                    let is_rest = rest == Some(place);
                    index = self.algebra.add(index, if is_rest { left } else { one });
                    match is_rest {
                        true => Value::Slice(Rc::new(slice.part(self.algebra, first, left))),
                        false => self.element_of(slice, first),
                    }
                });
                (fits, parts.collect::<Vec<_>>())
            }
            value => {
                let parts = value.components(self.algebra).map_or_else(|| value.clone(), Value::Array);
                let Value::Array(values) = parts else {
                    self.refuse(pattern, messages::pattern_of(&value.describe()));
                    return None;
                };
                if !fits(elements, values.len()) {
                    return Some(Condition::Known(false));
                }
                let mut left = values.into_iter();
                let more = left.len() - count;
                let parts = (0..elements.len()).filter_map(|place| match rest == Some(place) {
                    true => Some(Value::Array(left.by_ref().take(more).collect())),
                    false => left.next(),
                });
                (Condition::Known(true), parts.collect())
            }
        };
        for (element, part) in elements.iter().zip(&parts) {
            match element {
                Pat::Rest(_) => {}
                Pat::Ident(name) if is_rest(element) => self.frame.declare(name.ident.to_string(), part.clone()),
                element => matched = matched.and(self.pattern(element, part)?),
            }
        }
        Some(matched)
    }

    /// Returns the condition that a value matches a pattern and its guard holds. The guard is evaluated for each
    /// alternative. `None` after an error.
    pub(super) fn guarded(&mut self, pattern: &Pat, guard: Option<&Expr>, value: &Value) -> Option<Condition> {
        if guard.is_none() {
            return self.pattern(pattern, value);
        }
        match alternatives(pattern).as_slice() {
            [_] => {
                let matched = self.pattern(pattern, value)?;
                self.and_guard(matched, guard)
            }
            cases => self.any_of(pattern, cases.iter(), guard, value),
        }
    }

    fn and_guard(&mut self, matched: Condition, guard: Option<&Expr>) -> Option<Condition> {
        match (matched, guard) {
            (matched @ Condition::Known(false), _) | (matched, None) => Some(matched),
            (matched, Some(guard)) => {
                let guard = self.run_under(guard, &matched, |this| this.condition(guard))?;
                Some(matched.and(guard))
            }
        }
    }

    /// Returns the condition that a value matches one of several patterns and that the guard holds with its bindings.
    /// Names get the values of the first alternative that matches.
    fn any_of<'p>(
        &mut self,
        place: &Pat,
        patterns: impl Iterator<Item = &'p Pat>,
        guard: Option<&Expr>,
        value: &Value,
    ) -> Option<Condition> {
        let depth = self.frame.depth();
        let mut cases: Vec<(Condition, Vec<(String, Value)>)> = Vec::new();
        for case in patterns {
            let matched = self.pattern(case, value)?;
            let matched = match guard {
                // The guard is evaluated only if no earlier alternative matched.
                Some(_) => cases.iter().fold(matched, |left, (before, _)| left.and(before.clone().not())),
                None => matched,
            };
            let matched = self.and_guard(matched, guard)?;
            // A pattern that cannot match binds nothing.
            if !matches!(matched, Condition::Known(false)) {
                cases.push((matched, self.frame.variables()[depth..].to_vec()));
            }
            self.frame.end_scope(depth);
        }
        let Some((_, names)) = cases.last().cloned() else { return Some(Condition::Known(false)) };
        for (name, value) in names {
            let chosen = cases.iter().rev().skip(1).try_fold(value, |otherwise, (matched, bound)| {
                let (_, value) = bound.iter().find(|(known, _)| *known == name)?;
                value.select(self.algebra, matched, &otherwise)
            });
            let chosen = chosen.unwrap_or_else(|| self.refuse(place, messages::match_pattern()));
            self.frame.declare(name, chosen);
        }
        Some(cases.into_iter().fold(Condition::Known(false), |any, (matched, _)| any.or(matched)))
    }

    /// Evaluates `(low..high).contains(&x)`; `None` for any other call.
    pub(super) fn contained(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let (Expr::Range(range), "contains", Some(x), 1) =
            (strip(&call.receiver), call.method.to_string().as_str(), call.args.first(), call.args.len())
        else {
            return None;
        };
        let x = self.expression(x);
        let x = number(&self.referenced(x));
        let ends = [&range.start, &range.end].map(Option::as_deref);
        Some(self.is_between(x, ends, &range.limits).map_or(Value::Unknown, Value::Truth))
    }

    /// Returns the condition that a number is in a range.
    fn is_between(
        &mut self,
        x: Option<Scalar>,
        [start, end]: [Option<&Expr>; 2],
        limits: &RangeLimits,
    ) -> Option<Condition> {
        let low = match start {
            Some(start) => {
                let start = number(&self.expression(start))?;
                Condition::at_most(self.algebra, start, x?)
            }
            None => Condition::Known(true),
        };
        let high = match end {
            Some(end) => {
                let end = number(&self.expression(end))?;
                match limits {
                    RangeLimits::Closed(_) => Condition::at_most(self.algebra, x?, end),
                    RangeLimits::HalfOpen(_) => Condition::less(self.algebra, x?, end),
                }
            }
            None => Condition::Known(true),
        };
        Some(low.and(high))
    }

    /// Returns the field patterns of a tuple struct, each with its field's value.
    pub(super) fn parts_of<'p>(&mut self, of: &'p syn::PatTupleStruct, value: &Value) -> Vec<(&'p Pat, Value)> {
        let count = match value {
            Value::Struct(of) => of.fields.len(),
            _ => of.elems.len(),
        };
        let placed = placed(&of.elems, count).into_iter();
        placed.map(|(place, element)| (element, self.moved_part(value, &Member::from(place)))).collect()
    }

    /// Returns the condition that each of several values matches its pattern.
    pub(super) fn patterns<'p>(&mut self, mut parts: impl Iterator<Item = (&'p Pat, &'p Value)>) -> Option<Condition> {
        parts.try_fold(Condition::Known(true), |matched, (pattern, value)| {
            let next = self.pattern(pattern, value)?;
            Some(matched.and(next))
        })
    }

    /// Returns `true` if the pattern is the name of a new variable.
    fn is_variable(&self, name: &syn::PatIdent) -> bool {
        let is_variant = || self.variant(&[name.ident.to_string()]).is_some();
        name.subpat.is_none() && name.ident != "None" && self.named(&name.ident) != Named::Constant && !is_variant()
    }

    /// Resolves a name in a pattern; only names of constants are capitalised.
    fn named(&self, name: &syn::Ident) -> Named {
        let name = name.to_string();
        let is_capital = name.starts_with(char::is_uppercase);
        if let Some(place) = self.frame.find(&name).filter(|_| is_capital) {
            return if self.frame.is_constant(place) { Named::Constant } else { Named::New };
        }
        // As in expressions, well-known names are assumed to be imported if imports are not visible.
        let is_taken_for_known = self.frame.scope.module.is_empty() && name.len() > 1 && numbers::is_known(&name);
        match self.items.meaning(&self.frame.scope, &[name]) {
            Meaning::Own(name) if self.items.constant(None, &name).is_some() => Named::Constant,
            Meaning::External(path) if is_taken_for_known || is_capital && path.len() > 1 => Named::Constant,
            Meaning::External(_) if is_capital => Named::Unknown,
            _ => Named::New,
        }
    }

    fn equal_to(&mut self, expected: &Expr, value: &Value) -> Option<Condition> {
        let expected_value = self.expression(expected);
        if expected_value.is_unknown() {
            return None;
        }
        match operators::binary(self.algebra, &syn::parse_quote!(==), value, &expected_value) {
            Some(Value::Truth(condition)) => Some(condition),
            _ => {
                self.refuse(expected, messages::pattern_of(&value.describe()));
                None
            }
        }
    }
}

/// Meaning of a name in a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Named {
    /// A constant of the module, of a block, or imported.
    Constant,
    /// A variable that the pattern binds.
    New,
    /// Either of them; imports are not visible.
    Unknown,
}

/// Returns the path of a pattern that may be a variant.
fn path_of(pattern: &Pat) -> Option<Vec<String>> {
    match pattern {
        Pat::Ident(name) if name.by_ref.is_none() && name.subpat.is_none() => Some(vec![name.ident.to_string()]),
        Pat::Path(path) => Some(segments(&path.path)),
        Pat::TupleStruct(of) => Some(segments(&of.path)),
        Pat::Struct(of) => Some(segments(&of.path)),
        _ => None,
    }
}

/// Returns `true` if these patterns fit `count` parts; `..` stands for any number of them.
fn fits(elements: &Punctuated<Pat, Comma>, count: usize) -> bool {
    let written = elements.len();
    written == count || elements.iter().any(is_rest) && written <= count + 1
}

/// Returns the patterns other than `..`, each with the index of its part among `count`.
pub(super) fn placed(elements: &Punctuated<Pat, Comma>, count: usize) -> Vec<(usize, &Pat)> {
    let rest = elements.iter().position(is_rest).unwrap_or(elements.len());
    let place = |index| if rest < index { (index + count).saturating_sub(elements.len()) } else { index };
    let written = elements.iter().enumerate().filter(|(index, _)| *index != rest);
    written.map(|(index, element)| (place(index), element)).collect()
}

/// Returns the direct subpatterns of a pattern.
fn parts(pattern: &mut Pat) -> Vec<&mut Pat> {
    match pattern {
        Pat::Paren(of) => vec![&mut of.pat],
        Pat::Reference(of) => vec![&mut of.pat],
        Pat::Ident(of) => of.subpat.iter_mut().map(|(_, inner)| &mut **inner).collect(),
        Pat::Or(of) => of.cases.iter_mut().collect(),
        Pat::Tuple(of) => of.elems.iter_mut().collect(),
        Pat::TupleStruct(of) => of.elems.iter_mut().collect(),
        Pat::Slice(of) => of.elems.iter_mut().collect(),
        Pat::Struct(of) => of.fields.iter_mut().map(|field| &mut *field.pat).collect(),
        _ => Vec::new(),
    }
}

/// Returns `true` if a pattern binds names, by which a guard can distinguish alternatives.
fn has_names(pattern: &mut Pat) -> bool {
    matches!(pattern, Pat::Ident(_)) || parts(pattern).into_iter().any(has_names)
}

/// Expands a pattern to the alternatives that it stands for, in the order in which they are tried: one for each
/// combination of nested alternatives that bind names.
fn alternatives(pattern: &Pat) -> Vec<Pat> {
    let mut pattern = pattern.clone();
    if !has_names(&mut pattern) {
        return vec![pattern];
    }
    if let Pat::Or(or) = &pattern {
        return or.cases.iter().flat_map(alternatives).collect();
    }
    (0..parts(&mut pattern).len()).fold(vec![pattern], |made, place| {
        let with_each = |mut one: Pat| {
            let choices = alternatives(parts(&mut one)[place]);
            choices.into_iter().map(move |choice| {
                let mut one = one.clone();
                *parts(&mut one)[place] = choice;
                one
            })
        };
        made.into_iter().flat_map(with_each).collect()
    })
}

fn number(value: &Value) -> Option<Scalar> {
    match value {
        Value::Scalar(x) | Value::Integer(x) => Some(*x),
        _ => None,
    }
}
