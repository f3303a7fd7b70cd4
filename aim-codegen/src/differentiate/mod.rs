//! `#[differentiate]`: emits a function unchanged, with its derivatives beside it. On a module, does so for each
//! function inside that has the attribute itself; such a function may use the module's other items ([`items`]).
//!
//! 1. [`options`] reads the attribute's arguments, [`arguments`] the function's. The numbers of each argument become
//!    inputs of a graph ([`inputs`]); rotations that derivatives are taken with respect to get steps there
//!    ([`manifold`]).
//! 2. [`lower`] runs the body symbolically, statement by statement, and builds its value in the graph. Rotations stay
//!    rotations.
//! 3. The graph is differentiated and compiled like the objectives of rigs. A kept loop ([`loop_programs`]) is compiled
//!    in three parts: the code before it, one iteration, and the code after it.
//! 4. [`emit`] writes the programs as functions of the same arguments. A derivative with respect to a value keeps the
//!    parts of that value that do not vary ([`slopes`]).
//!
//! All errors are collected, with their places. The function or module itself is always emitted as written.

mod arguments;
mod budget;
mod check;
mod companion;
mod constants;
mod emit;
pub(crate) mod file;
mod generic_arguments;
mod inputs;
mod items;
mod lanes;
mod loop_programs;
mod lower;
mod manifold;
mod messages;
mod names;
mod options;
mod pruned_graph;
mod slices;
mod slopes;
mod types;

#[cfg(test)]
mod tests;

use std::rc::Rc;

use aim_symbolic::{Graph, Program, Scalar, VectorNode, Want};
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::{Item, ItemFn};

use self::arguments::{Arguments, Declared};
use self::companion::{Companion, Derived};
use self::emit::Companions;
use self::items::Items;
use self::loop_programs::KeptLoops;
use self::lower::{Algebra, Translation, Value};
use self::options::Options;
use self::pruned_graph::{PrunedGraph, ValueAndVariables};
use self::types::{Shape, Type};
use crate::declare::report::Report;
use crate::declare::tree::Notation;

/// Expands `#[differentiate(…)]` on `item`. `facade` is the name of the crate that exports the attribute.
#[must_use]
pub fn differentiate(attribute: TokenStream, item: TokenStream, facade: &str) -> TokenStream {
    let mut report = Report::new(Notation::Rust);
    if let Ok(mut function) = syn::parse2::<ItemFn>(item.clone()) {
        let is_repeated = refuse_repetition(&mut function, &mut report);
        // The parser drops invisible groups: emit the tokens as they came, if possible.
        let item = if is_repeated { function.to_token_stream() } else { item };
        let options = Options::parse(attribute, &mut report).beside(facade);
        let items = Items::default().in_file_of(function.sig.ident.span());
        let companions = companions(&function, &options, &items, &mut report);
        let errors = report.into_compile_error();
        return quote! {
            #[allow(dead_code, reason = "its derivatives may be all that is used")]
            #item
            #companions
            #errors
        };
    }
    match syn::parse2::<Item>(item.clone()) {
        Ok(Item::Mod(syn::ItemMod { attrs, vis, mod_token, ident, content: Some((_, items)), .. })) => {
            let options = Options::parse_module(attribute, &mut report);
            let items = module(items, &options, &mod_token, facade, &mut report);
            let errors = report.into_compile_error();
            let (inner, outer): (Vec<_>, Vec<_>) =
                attrs.into_iter().partition(|attribute| matches!(attribute.style, syn::AttrStyle::Inner(_)));
            quote!(#(#outer)* #vis #mod_token #ident { #(#inner)* #items } #errors)
        }
        // Unsupported items get an error of ours, syntax errors the parser's message.
        Ok(_) => {
            report.error_in(&item.clone().into_iter().next(), messages::not_a_function());
            let errors = report.into_compile_error();
            quote!(#item #errors)
        }
        Err(error) => {
            let errors = error.into_compile_error();
            quote!(#item #errors)
        }
    }
}

/// Returns the items of a module, with the companions of each differentiated function after it.
fn module(
    mut items: Vec<Item>,
    of_module: &Options,
    place: &syn::Token![mod],
    facade: &str,
    report: &mut Report,
) -> TokenStream {
    let mut requests: Vec<Option<TokenStream>> = items.iter_mut().map(|item| take_request(item, report)).collect();
    let of_methods: Vec<syn::Attribute> = items.iter_mut().flat_map(take_requests_of_methods).collect();
    of_methods.iter().for_each(|attribute| report.error_in(attribute, messages::of_a_method()));
    if of_methods.is_empty() && requests.iter().all(Option::is_none) {
        report.error_in(place, messages::nothing_to_differentiate());
    }
    let known = Items::of(&items).in_file_of(place.span());
    let mut expanded = TokenStream::new();
    for (item, request) in items.iter().zip(&mut requests) {
        let (Item::Fn(function), Some(attribute)) = (item, request.take()) else {
            expanded.extend(quote!(#item));
            continue;
        };
        let options = Options::parse(attribute, report).within(of_module).beside(facade);
        let companions = companions(function, &options, &known, report);
        expanded.extend(quote! {
            #[allow(dead_code, reason = "its derivatives may be all that is used")]
            #function
            #companions
        });
    }
    expanded
}

/// Removes the attribute `differentiate` from a function and returns its arguments.
fn take_request(item: &mut Item, report: &mut Report) -> Option<TokenStream> {
    let Item::Fn(function) = item else { return None };
    let place = function.attrs.iter().position(is_ours)?;
    let request = function.attrs.remove(place);
    refuse_repetition(function, report);
    Some(match request.meta {
        syn::Meta::List(list) => list.tokens,
        _ => TokenStream::new(),
    })
}

/// Reports and removes further attributes of this kind, whose companions would have the same names. Returns `true` if
/// there are any.
fn refuse_repetition(function: &mut ItemFn, report: &mut Report) -> bool {
    let repeated: Vec<_> = function.attrs.extract_if(.., |attribute| is_ours(attribute)).collect();
    repeated.iter().for_each(|attribute| report.error_in(attribute, messages::repeated_attribute()));
    !repeated.is_empty()
}

/// Removes the attribute from methods, which have no companions.
fn take_requests_of_methods(item: &mut Item) -> Vec<syn::Attribute> {
    let Item::Impl(implementation) = item else { return Vec::new() };
    let methods = implementation.items.iter_mut().filter_map(|item| match item {
        syn::ImplItem::Fn(method) => Some(method),
        _ => None,
    });
    methods.flat_map(|method| method.attrs.extract_if(.., |attribute| is_ours(attribute)).collect::<Vec<_>>()).collect()
}

/// Returns `true` if a test is requested and test values for all arguments can be built.
fn checked(options: &Options, arguments: &Arguments, report: &mut Report) -> bool {
    let Some((true, place)) = &options.check else { return false };
    let without_test_value = arguments.list.iter().find(|argument| !argument.ty.is_whole());
    if let Some(argument) = without_test_value {
        report.error(place, messages::unchecked(&argument.ty.tokens.to_string()));
    }
    without_test_value.is_none()
}

/// Returns `true` if the attribute is `differentiate`.
fn is_ours(attribute: &syn::Attribute) -> bool {
    attribute.path().segments.last().is_some_and(|last| last.ident == "differentiate")
}

/// Returns the companions of a function.
fn companions(function: &ItemFn, options: &Options, items: &Items, report: &mut Report) -> TokenStream {
    let parts = [function.sig.to_token_stream(), function.block.to_token_stream()];
    if let Some(place) = parts.into_iter().find_map(items::depends_on_cfg) {
        report.error_in(&place, messages::conditional());
        return TokenStream::new();
    }
    let arguments = Arguments::check(&function.sig, options, items, report);
    let derived = Derived::all(function, options, &arguments, items, Search::Smallest, report);
    let assertions = items.surroundings.take_assertions();
    let krate = options.krate.clone().unwrap_or_default();
    let companions =
        Companions { item: function, arguments: &arguments, krate: &krate, assertions: &assertions, of_lanes: false };
    // With `self` or an unsupported type in the signature, a stub would only cause another error.
    if !arguments.faulty.is_empty() || function.sig.receiver().is_some() {
        return TokenStream::new();
    }
    let in_lanes = options.lanes.as_ref().and_then(|place| arguments.in_lanes(place, report));
    let in_lanes = in_lanes.as_ref().map(|arguments| Companions { arguments, of_lanes: true, ..companions });
    let requested = options.companions.iter().map(|(companion, _)| *companion);
    let mut all = TokenStream::new();
    for companion in [Companion::First].into_iter().chain(requested) {
        let derived = derived.iter().flatten().find(|derived| derived.companion == companion);
        all.extend(companions.companion(companion, derived));
        all.extend(in_lanes.as_ref().and_then(|companions| companions.companion(companion, derived)));
    }
    let first = derived.as_ref().and_then(|derived| derived.first());
    let check = first.filter(|_| checked(options, &arguments, report)).and_then(|first| companions.check(first));
    quote!(#all #check)
}

/// Decides whether competing rewrite rules are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Search {
    /// Search for the smallest program.
    Smallest,
    /// Take the first program found, for tests of many functions.
    Any,
}

impl Search {
    fn program(self, g: &Graph, wanted: &[Want]) -> Program {
        match self {
            Self::Smallest => Program::derive_wanted(g, wanted),
            Self::Any => Program::derive_at_once(g, wanted),
        }
    }
}

impl Derived {
    /// Derives all requested companions, unless there are errors.
    fn all(
        function: &ItemFn,
        options: &Options,
        arguments: &Arguments,
        items: &Items,
        search: Search,
        report: &mut Report,
    ) -> Option<Vec<Self>> {
        let errors = report.count();
        let mut algebra = Algebra::new();
        let Declared { values, variables, numbers: inputs } = arguments.declare(&mut algebra);
        let patterns = arguments.list.iter().map(|argument| &argument.pattern).zip(values);
        let mut translation = Translation::new(&mut algebra, report, items, Some(arguments.precision()));
        if options.may_keep_loops() {
            translation = translation.keeping_loops();
        }
        if options.may_read_constants() {
            translation = translation.reading_constants();
        }
        let body = translation.function(&function.block, &function.sig.output, patterns, &arguments.faulty);
        let result = arguments.result.as_ref()?;
        for (companion, place) in &options.companions {
            if companion.is_of_a_number() && !matches!(result.shape, Shape::Scalar) {
                report.error(place, messages::of_a_number(companion.key()));
            }
        }
        let (body, is_some) = match body {
            Value::Optional(option) if arguments.is_optional => (option.value.clone(), Some(option.is_some.clone())),
            body => (body, None),
        };
        let mut numbers = Vec::new();
        let fits = is_some.is_some() == arguments.is_optional && add_numbers(&mut algebra, &body, result, &mut numbers);
        if report.count() > errors || arguments.is_wrong || options.wrt.is_none() {
            return None;
        }
        if body.is_unknown() {
            // Either an error was reported for a helper that another function also calls, or the compiler reports one.
            if report.is_empty() {
                report.error_in(&function.sig.ident, messages::unknown_result());
            }
            return None;
        }
        if !fits {
            report.error_in(&result.tokens, messages::wrong_result(&body.describe(), &result.tokens.to_string()));
            return None;
        }
        let unit_axes: Rc<[(usize, usize)]> = unit_axes(&algebra, &inputs).into();
        let variables: Vec<Scalar> = variables.into_iter().flatten().collect();
        let vector = if let Value::Vector(v) = body { Some(v) } else { None };
        let mut flag = is_some.map(|is_some| algebra.number_of(&is_some));
        let mut stated = ValueAndVariables { values: numbers, vector, variables };
        let pruned = PrunedGraph::new(&algebra, &mut stated, &mut flag);
        let kept_loops = Rc::new(KeptLoops::derive(&pruned, &stated.variables, &|g, wanted| search.program(g, wanted)));
        let has_kept_loops = !kept_loops.is_empty();
        if has_kept_loops {
            for (companion, place) in &options.companions {
                report.error(place, messages::companion_of_kept_loop(companion.key()));
            }
            if let Some(place) = &options.lanes {
                report.error(place, messages::companion_of_kept_loop("lanes"));
            }
            if report.count() > errors {
                return None;
            }
        }
        let derive = |companion: Companion| {
            let mut g = pruned.g.clone();
            let extra = arguments.extra_inputs(companion, &mut g);
            let mut wanted = companion.wanted(&mut g, &stated, &extra);
            wanted.extend(kept_loops.final_states().flat_map(|after| stated.derivatives_by(after)));
            if let Some(flag) = flag {
                wanted.push(Want::Value(flag));
            }
            let program = search.program(&g, &wanted);
            let (kept_loops, unit_axes) = (kept_loops.clone(), unit_axes.clone());
            Self { companion, graph: g, wanted, program, kept_loops, unit_axes }
        };
        let first = derive(Companion::First);
        if let Some(budget) = &options.budget
            && !budget.judge(first.count(), report)
        {
            return None;
        }
        let requested = options.companions.iter().map(|(companion, _)| derive(*companion));
        Some([first].into_iter().chain(requested).collect())
    }
}

/// Returns the vectors among the arguments that are taken to have length 1; `inputs` are the numbers of each argument.
fn unit_axes(algebra: &Algebra, inputs: &[Vec<Scalar>]) -> Vec<(usize, usize)> {
    let axes = algebra.unit_axes.iter().filter_map(|&axis| {
        let VectorNode::Components(parts) = algebra.g.vector_node(axis) else { return None };
        inputs
            .iter()
            .enumerate()
            .find_map(|(argument, numbers)| Some((argument, numbers.windows(3).position(|numbers| numbers == parts)?)))
    });
    axes.collect()
}

/// Appends the numbers of a value; returns `true` if the value is of type `ty`.
fn add_numbers(a: &mut Algebra, value: &Value, ty: &Type, numbers: &mut Vec<Scalar>) -> bool {
    match (value, &ty.shape) {
        (Value::Scalar(number), Shape::Scalar) => numbers.push(*number),
        (Value::Planar(v), Shape::Planar) => numbers.extend_from_slice(&a.parts(*v)[..2]),
        (Value::Vector(v), Shape::Vector) => numbers.extend(a.parts(*v)),
        (Value::Four(parts), Shape::Four) => numbers.extend(parts),
        (Value::Quaternion(q), Shape::Quaternion) => {
            let (u, w) = q.parts;
            numbers.extend(a.parts(u));
            numbers.push(w);
        }
        (Value::Matrix(m), Shape::Matrix) => {
            numbers.extend(m.columns(a).into_iter().flat_map(|column| a.parts(column)));
        }
        (Value::Square(_) | Value::Homogeneous(_), Shape::Square(count)) => {
            let columns = lower::columns(a, value).unwrap_or_default();
            numbers.extend(columns.iter().flatten());
            return columns.len() == *count;
        }
        (Value::Affine(m), Shape::Rigid) => {
            numbers.extend(m.map.columns(a).into_iter().flat_map(|column| a.parts(column)));
            numbers.extend(a.parts(m.translation));
        }
        (Value::Array(values), Shape::Array(element, length)) => {
            return values.len() == *length && values.iter().all(|value| add_numbers(a, value, element, numbers));
        }
        (Value::Tuple(values), Shape::Tuple(types)) => {
            return values.len() == types.len()
                && values.iter().zip(types).all(|(value, ty)| add_numbers(a, value, ty, numbers));
        }
        (Value::Struct(of), Shape::Struct(name, fields, true)) => {
            return of.name == *name
                && fields.iter().all(|(member, ty)| {
                    let value = of.field(&member.to_token_stream().to_string());
                    value.is_some_and(|value| add_numbers(a, value, ty, numbers))
                });
        }
        _ => return false,
    }
    true
}
