//! Functions of the module, inner functions, and closures. A call runs the body in a frame of its own.

use std::rc::Rc;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Expr, ExprClosure, ItemFn, Pat};

use super::expected::Expected;
use super::frame::Frame;
use super::translation::MAX_ITERATIONS;
use super::value::{Callable, ClosureOrigin, Place, Value};
use super::{Translation, strip};
use crate::differentiate::{items, messages};

/// Maximum recursion depth.
const DEEPEST: usize = 16;

/// Returns an inner function. It sees the items of its block and the functions outside, but no variables.
pub(super) fn inner(item: &ItemFn, frame: &Frame, depth: usize) -> Rc<Callable> {
    let (outside, items) = frame.variables().split_at(depth);
    let functions = outside.iter().filter(|(_, value)| matches!(value, Value::Function(_)));
    let captured = functions.chain(items).cloned().collect();
    Rc::new(Callable { captured, ..items::callable(&item.sig, &item.block, frame.scope.clone(), None) })
}

/// Returns `true` for a closure's parameter that is `&mut`.
fn is_lent(pattern: &Pat) -> bool {
    let Pat::Type(typed) = pattern else { return false };
    matches!(&*typed.ty, syn::Type::Reference(reference) if reference.mutability.is_some())
}

/// Returns `true` for a parameter without a written type.
fn is_untyped((pattern, ty): &(Pat, Option<syn::Type>)) -> bool {
    ty.is_none() && !matches!(pattern, Pat::Type(_))
}

impl Translation<'_> {
    pub(super) fn closure(&mut self, closure: &ExprClosure) -> Value {
        let parameters = closure.inputs.iter().map(|pattern| (pattern.clone(), None));
        Value::Function(Rc::new(Callable {
            name: None,
            parameters: parameters.collect(),
            changed: closure.inputs.iter().map(is_lent).collect(),
            body: (*closure.body).clone(),
            captured: self.frame.variables().to_vec(),
            origin: closure.capture.is_none().then(|| self.origin(closure)),
            result: match &closure.output {
                syn::ReturnType::Type(_, ty) => Some((**ty).clone()),
                syn::ReturnType::Default => None,
            },
            scope: self.frame.scope.clone(),
            of_trait: None,
        }))
    }

    /// Returns the frame in which a closure is created that captures by reference.
    fn origin(&self, closure: &ExprClosure) -> ClosureOrigin {
        let mut named = Vec::new();
        each_word(closure.body.to_token_stream(), &mut |word| {
            let place = self.frame.find(&word.to_string());
            named.extend(place.filter(|&place| self.frame.value(place).is_selectable() && !named.contains(&place)));
        });
        let names: Vec<&str> = named.iter().map(|&place| self.frame.variables()[place].0.as_str()).collect();
        let changes = assigns(closure.body.to_token_stream(), &names);
        ClosureOrigin { frame: self.frame.id.clone(), named, changes }
    }

    /// Runs a function's body with its parameters bound to the arguments.
    fn body(
        &mut self,
        place: &impl ToTokens,
        function: &Callable,
        arguments: Vec<Value>,
        expected: &Expected,
    ) -> Value {
        let mut frame = self.frame.frame_of_call(function.captured.clone(), function.scope.clone());
        // In the frame where it was created, a closure sees the variables' present values and may change them.
        if function.origin.as_ref().is_some_and(|origin| origin.frame != self.frame.id && origin.changes) {
            return self.refuse(place, messages::captured());
        }
        let origin = function.origin.as_ref().filter(|origin| origin.frame == self.frame.id);
        // Variables that are out of scope keep their captured values.
        let is_there = |variable: &usize| {
            let [then, now] =
                [&function.captured, self.frame.variables()].map(|all| all.get(*variable).map(|(name, _)| name));
            now.is_some() && then == now
        };
        let named: Vec<usize> =
            origin.map_or(&[][..], |origin| &origin.named).iter().copied().filter(is_there).collect();
        for &variable in &named {
            frame.assign(variable, self.frame.value(variable).clone());
            frame.lend(variable);
        }
        // Lent values are copied in, and copied back on return: nothing else can access them in between.
        let mut lent = Vec::new();
        let mut values = Vec::new();
        for ((argument, &changed), parameter) in arguments.into_iter().zip(&function.changed).zip(&function.parameters)
        {
            let is_reference = matches!(argument, Value::Reference(_));
            let changed = changed || is_reference && is_untyped(parameter);
            match &argument {
                Value::Reference(reference) if changed => lent.push(reference.clone()),
                Value::Reference(_) if matches!(parameter.1, Some(syn::Type::Reference(_))) => {}
                Value::Reference(_) => return self.refuse(place, messages::mutable_borrow()),
                _ if changed => return self.refuse(place, messages::mutable_borrow()),
                _ => {}
            }
            let value = self.referenced(argument);
            // A reference inside it would point to a variable of another function.
            if origin.is_none() && value.with_references(&|_| None).is_none() {
                return self.refuse(place, messages::mutable_borrow());
            }
            values.push((value, changed));
        }
        let outer = core::mem::replace(&mut self.frame, frame);
        let mut parameters = Vec::new();
        for ((pattern, ty), (value, changed)) in function.parameters.iter().zip(values) {
            if let Some(ty) = ty {
                self.bind_generics(ty, &value);
            }
            self.bind(pattern, value);
            if changed {
                let is_name = match pattern {
                    Pat::Type(typed) => matches!(*typed.pat, Pat::Ident(_)),
                    pattern => matches!(pattern, Pat::Ident(_)),
                };
                if !is_name {
                    self.refuse(pattern, messages::pattern());
                }
                parameters.push(self.frame.depth() - 1);
                self.frame.lend(self.frame.depth() - 1);
            }
        }
        let expected = function.result.as_ref().map_or_else(|| expected.clone(), |ty| self.expected(ty));
        self.frame.result_type = expected.clone();
        let end = self.expression_as(&function.body, &expected);
        let value = self.frame.result(self.algebra, end);
        let inner = core::mem::replace(&mut self.frame, outer);
        match value {
            // The call does not return.
            Some((Value::Never, _)) => Value::Never,
            Some((value, changed)) => {
                let mut changed = changed.into_iter();
                for (&variable, changed) in named.iter().zip(changed.by_ref()) {
                    if inner.has_changed(variable) {
                        self.frame.assign(variable, changed);
                    }
                }
                for (reference, changed) in lent.iter().zip(changed) {
                    self.write(place, reference, changed);
                }
                // A returned reference points to a lent parameter; translate it to the caller's variable.
                let lender = |inside: &Rc<Place>| {
                    if let Some(index) = parameters.iter().position(|&variable| variable == inside.variable) {
                        return Some(lent.get(index)?.lent_along(&inside.steps));
                    }
                    let is_own = origin.is_some() && inside.variable < function.captured.len();
                    is_own.then(|| Value::Reference(inside.clone()))
                };
                value.with_references(&lender).unwrap_or_else(|| self.refuse(place, messages::mutable_borrow()))
            }
            None => self.refuse(place, messages::returns_differ()),
        }
    }

    /// Calls a function with arguments as written; a method's receiver precedes them.
    pub(super) fn inline_written(
        &mut self,
        place: &impl ToTokens,
        function: &Rc<Callable>,
        receiver: Option<Value>,
        written: &Punctuated<Expr, Comma>,
    ) -> Value {
        let mut arguments: Vec<Value> = receiver.into_iter().collect();
        let first = arguments.len();
        for (index, argument) in written.iter().enumerate() {
            let is_untyped = function.parameters.get(first + index).is_some_and(is_untyped);
            let lent = function.changed.get(first + index) == Some(&true) || is_untyped && self.is_reference(argument);
            let expected = self.parameter(function, first + index);
            arguments.push(match strip(argument) {
                // Passes a reference on.
                place @ Expr::Path(_) if lent => self.reference(place),
                argument => self.expression_as(argument, &expected),
            });
        }
        self.inline(place, function, arguments)
    }

    /// Calls the one of several functions that accepts the arguments as written.
    pub(super) fn one_of(
        &mut self,
        place: &impl ToTokens,
        several: &[Rc<Callable>],
        receiver: Option<Value>,
        written: &Punctuated<Expr, Comma>,
    ) -> Value {
        if let [only] = several {
            return self.inline_written(place, only, receiver, written);
        }
        let mut arguments: Vec<Value> = receiver.into_iter().collect();
        arguments.extend(written.iter().map(|argument| self.expression(argument)));
        if let Some(without) = Value::without(&arguments) {
            return without;
        }
        match self.function_for(several, &arguments) {
            Some(function) => self.inline(place, &function, arguments),
            None => {
                let name = several.first().and_then(|function| function.name.clone()).unwrap_or_default();
                self.refuse(place, messages::several_functions(&name))
            }
        }
    }

    /// Evaluates a call.
    pub(super) fn inline(&mut self, place: &impl ToTokens, function: &Rc<Callable>, arguments: Vec<Value>) -> Value {
        self.inline_as(place, function, arguments, &Expected::Any)
    }

    /// Evaluates a call whose result has an expected type.
    pub(super) fn inline_as(
        &mut self,
        place: &impl ToTokens,
        function: &Rc<Callable>,
        arguments: Vec<Value>,
        expected: &Expected,
    ) -> Value {
        if let Some(without) = Value::without(&arguments) {
            return without;
        }
        if self.items.is_faulty(function) {
            return Value::Unknown;
        }
        // Known values decide the depth of the recursion.
        let is_it = |known: &&Rc<Callable>| {
            Rc::ptr_eq(known, function) || function.name.is_some() && known.name == function.name
        };
        let around = self.calls.iter().filter(is_it).count();
        self.iterations_run += usize::from(around > 0);
        if around == DEEPEST || self.iterations_run > MAX_ITERATIONS {
            let name = function.name.as_deref().unwrap_or("a closure");
            return self.refuse(place, messages::recursion(name));
        }
        // The compiler reports a wrong number of arguments.
        if function.parameters.len() != arguments.len() {
            return Value::Unknown;
        }
        let errors = self.report.count();
        self.calls.push(function.clone());
        let value = self.body(place, function, arguments, expected);
        self.calls.pop();
        if self.report.count() > errors {
            self.items.is_at_fault(function);
            return Value::Unknown;
        }
        if self.is_too_large() { self.refuse_too_large(place) } else { value }
    }

    /// Returns the function that an argument stands for; it will be called with `count` arguments.
    pub(super) fn function_argument(&mut self, argument: &Expr, count: usize) -> Option<Rc<Callable>> {
        let closure: ExprClosure = match argument {
            Expr::Closure(closure) => closure.clone(),
            Expr::Path(path)
                if path.path.get_ident().is_none_or(|name| self.frame.find(&name.to_string()).is_none()) =>
            {
                match count {
                    0 => syn::parse_quote!(|| #path()),
                    1 => syn::parse_quote!(|a| #path(a)),
                    _ => syn::parse_quote!(|a, b| #path(a, b)),
                }
            }
            other => {
                return match self.expression(other) {
                    Value::Function(function) => Some(function),
                    value => {
                        self.refuse_known(&value, other, messages::not_a_function_value());
                        None
                    }
                };
            }
        };
        match self.closure(&closure) {
            Value::Function(function) => Some(function),
            _ => None,
        }
    }
}

/// Calls `call` with each word in these tokens.
pub(in crate::differentiate) fn each_word(tokens: TokenStream, call: &mut dyn FnMut(&Ident)) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => each_word(group.stream(), call),
            TokenTree::Ident(word) => call(&word),
            _ => {}
        }
    }
}

/// Returns `true` if the tokens contain an assignment to one of these names, or to a part of one.
fn assigns(tokens: TokenStream, names: &[&str]) -> bool {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    tokens.iter().enumerate().any(|(start, token)| match token {
        TokenTree::Group(group) => assigns(group.stream(), names),
        TokenTree::Ident(name) if names.iter().any(|known| name == known) => {
            let is_declared =
                start > 0 && matches!(&tokens[start - 1], TokenTree::Ident(word) if word == "let" || word == "mut");
            let is_lent = start > 1 && is_punct(&tokens[start - 2], '&') && is_declared;
            let is_part = |token: &&TokenTree| {
                is_punct(token, '.')
                    || matches!(token, TokenTree::Ident(_) | TokenTree::Literal(_) | TokenTree::Group(_))
            };
            let rest = &tokens[start + 1..];
            let rest = &rest[rest.iter().take_while(is_part).count()..];
            is_lent
                || !is_declared
                    && match rest {
                        [equals, next, ..] if is_punct(equals, '=') => !is_punct(next, '=') && !is_punct(next, '>'),
                        [operator, equals, ..] if is_punct(equals, '=') => {
                            "+-*/%&|^".chars().any(|c| is_punct(operator, c))
                        }
                        _ => false,
                    }
        }
        _ => false,
    })
}

fn is_punct(token: &TokenTree, character: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == character)
}
