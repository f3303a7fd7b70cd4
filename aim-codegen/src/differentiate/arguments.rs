//! The function's signature: its arguments as inputs of the graph, and its result.

use aim_symbolic::{Graph, Scalar};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::{FnArg, GenericParam, Pat, ReturnType, Signature, WherePredicate};

use super::companion::{Companion, ExtraParameters};
use super::inputs::Inputs;
use super::items::Items;
use super::lower::{Algebra, Scope, Value, each_word};
use super::manifold::VaryingPart;
use super::messages;
use super::options::{Options, Variable};
use super::slices::slice_of;
use super::types::{Precision, Shape, Type};
use crate::declare::parse::tokens::word_of;
use crate::declare::report::Report;
use crate::declare::tree::Word;

/// An argument of a known type.
pub(super) struct Argument {
    /// Name of the argument; `None` for a pattern.
    pub(super) name: Option<Ident>,
    /// Expression for the argument in emitted code.
    pub(super) called: TokenStream,
    /// Pattern that the function binds the argument to.
    pub(super) pattern: Pat,
    pub(super) ty: Type,
    /// Type as declared.
    pub(super) declared: TokenStream,
    /// Position in `wrt`, if derivatives are taken with respect to the argument.
    pub(super) variable: Option<usize>,
    pub(super) varying_part: VaryingPart,
    /// Type of derivatives with respect to the argument: its own type, or that of its tangent.
    pub(super) slope: Type,
}

impl Argument {
    /// Builds the derivative with respect to the argument from the derivatives with respect to its varying numbers.
    pub(super) fn build_slope(&self, numbers: &[TokenStream]) -> TokenStream {
        let called = &self.called;
        self.slope.build_slope(&if self.ty.borrowed { quote!((*#called)) } else { quote!(#called) }, numbers)
    }
}

/// The checked arguments and result of a signature.
pub(super) struct Arguments {
    pub(super) list: Vec<Argument>,
    /// Names of the arguments whose type was reported.
    pub(super) faulty: Vec<Ident>,
    /// Type of the result, or of the value inside an option or `Result`, if it is a known type.
    pub(super) result: Option<Type>,
    /// `true` if the result may be absent: an option, or a `Result`, whose error type is ignored.
    pub(super) is_optional: bool,
    /// `true` if an error in the signature was reported.
    pub(super) is_wrong: bool,
}

impl Arguments {
    /// Reads a signature; reports errors and leaves out the arguments that have one.
    pub(super) fn check(signature: &Signature, options: &Options, items: &Items, report: &mut Report) -> Self {
        let errors = report.count();
        let generic = refuse_qualifiers(signature, report);
        let (mut list, mut faulty) = (Vec::new(), Vec::new());
        for (index, input) in signature.inputs.iter().enumerate() {
            let typed = match input {
                FnArg::Typed(typed) => typed,
                FnArg::Receiver(receiver) => {
                    report.error_in(receiver, messages::receiver());
                    faulty.push(Ident::new("self", receiver.self_token.span));
                    continue;
                }
            };
            let name = match &*typed.pat {
                Pat::Ident(name) if name.by_ref.is_none() && name.subpat.is_none() => Some(name.ident.clone()),
                _ => None,
            };
            let called =
                name.as_ref().map_or_else(|| pattern_argument(index).to_token_stream(), ToTokens::to_token_stream);
            let declared = name.as_ref().and_then(|name| sized(&typed.ty, name, options));
            let declared = declared.unwrap_or_else(|| (*typed.ty).clone());
            let variable = name.as_ref().and_then(|name| place_among(options.wrt.as_deref(), name));
            let slice = Type::slice(&declared, &Scope::default(), items).filter(|_| variable.is_none());
            let known = if slice.is_some() {
                slice
            } else if generic {
                // Generics have already been reported; do not report the type again.
                Type::parse(&declared, items).ok()
            } else {
                known_type(&declared, items, report)
            };
            match known {
                Some(ty) => {
                    let varying_part =
                        variable.map_or(VaryingPart::Nothing, |(_, variable)| options.varying_part(variable));
                    let slope = match varying_part {
                        VaryingPart::Tangent(_) => ty.tangent(options.krate.as_ref().unwrap_or(&TokenStream::new())),
                        _ => ty.owned(),
                    };
                    let (variable, pattern) = (variable.map(|(place, _)| place), (*typed.pat).clone());
                    let declared = declared.to_token_stream();
                    list.push(Argument { name, called, pattern, ty, declared, variable, varying_part, slope });
                }
                None => faulty.push(name.unwrap_or_else(|| pattern_argument(index))),
            }
        }
        let inside = inside(&signature.output);
        let result = match &signature.output {
            ReturnType::Default => {
                report.error_in(&signature.ident, messages::no_result());
                None
            }
            ReturnType::Type(_, ty) => {
                let ty = inside.unwrap_or(ty);
                known_type(ty, items, report).filter(|result| {
                    let fits = result.is_result() && result.precision.is_some() && !result.borrowed;
                    if !fits {
                        let field = result.field_without_numbers(items);
                        let text = field.map(|(of, field)| messages::result_field(&field, &of));
                        report.error_in(ty, text.unwrap_or_else(messages::result_type));
                    }
                    fits
                })
            }
        };
        let mut arguments = Self { list, faulty, result, is_optional: inside.is_some(), is_wrong: false };
        arguments.check_precision(report);
        arguments.check_variables(signature, options, report);
        arguments.is_wrong = report.count() > errors;
        arguments
    }

    /// Returns the variables, in the order of `wrt`.
    pub(super) fn variables(&self) -> Vec<&Argument> {
        let mut variables: Vec<&Argument> = self.list.iter().filter(|argument| argument.variable.is_some()).collect();
        variables.sort_by_key(|argument| argument.variable);
        variables
    }

    /// Returns the number type that the function computes in.
    pub(super) fn precision(&self) -> Precision {
        let types = self.result.iter().chain(self.list.iter().map(|argument| &argument.ty));
        types.filter_map(|ty| ty.precision).next().unwrap_or(Precision::Single)
    }

    fn check_precision(&self, report: &mut Report) {
        let first = self.precision();
        for ty in self.list.iter().map(|argument| &argument.ty).chain(&self.result) {
            if let Some(other) = ty.other_precision(first) {
                report.error_in(&ty.tokens, messages::mixed(first.name(), other.name()));
            }
        }
    }

    fn check_variables(&self, signature: &Signature, options: &Options, report: &mut Report) {
        let Some(wrt) = &options.wrt else {
            report.error_in(&signature.ident, messages::no_wrt());
            return;
        };
        let names: Vec<String> =
            self.list.iter().filter_map(|argument| Some(word_of(argument.name.as_ref()?).text)).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        for (word, _) in &options.lengths {
            let is_slice = |input: &FnArg| {
                let FnArg::Typed(typed) = input else { return false };
                let Pat::Ident(name) = &*typed.pat else { return false };
                is(&name.ident, word) && sized(&typed.ty, &name.ident, options).is_some()
            };
            if !signature.inputs.iter().any(is_slice) {
                report.error(&word.place, messages::no_slice(&word.text));
            }
        }
        for Variable { name: word, tangent } in wrt {
            let found = self.list.iter().find(|argument| argument.name.as_ref().is_some_and(|name| is(name, word)));
            match found {
                None if self.faulty.iter().any(|name| is(name, word)) => {}
                None if signature.inputs.iter().any(|input| is_bound_by(input, word)) => {
                    report.error(&word.place, messages::pattern_variable(&word.text));
                }
                None => report.error(&word.place, messages::unknown_variable(&word.text, &names)),
                Some(argument) => {
                    let text = argument.ty.no_variable(&word.text, *tangent);
                    let of_plain = || messages::no_tangent(&word.text);
                    let plain = *tangent && !argument.ty.has_rotation();
                    if let Some(text) = text.or_else(|| plain.then(of_plain)) {
                        report.error(&word.place, text);
                    }
                }
            }
        }
    }

    /// Declares every number of the arguments as an input.
    pub(super) fn declare(&self, a: &mut Algebra) -> Declared {
        let mut declared = Declared { values: Vec::new(), variables: Vec::new(), numbers: Vec::new() };
        let (mut variables, mut slices) = (Vec::new(), 0);
        for argument in &self.list {
            let named = argument.name.as_ref().map_or_else(String::new, |name| word_of(name).text);
            let numbers = (0..argument.ty.components()).map(|index| a.g.input(&format!("{named}_{index}")));
            let numbers: Vec<Scalar> = numbers.collect();
            declared.numbers.push(numbers.clone());
            let mut inputs = Inputs::new(a, numbers, argument.varying_part, slices);
            declared.values.push(inputs.value(&argument.ty));
            slices = inputs.slices;
            let by = inputs.variables;
            by.iter().for_each(|&variable| a.differentiate_by(variable));
            if let Some(place) = argument.variable {
                variables.push((place, by));
            }
        }
        variables.sort_by_key(|(place, _)| *place);
        declared.variables = variables.into_iter().map(|(_, inputs)| inputs).collect();
        declared
    }
}

impl Arguments {
    /// Returns the suffix of a companion's name; `None` without a result.
    pub(super) fn suffix(&self, companion: Companion) -> Option<&'static str> {
        let is_number = matches!(self.result.as_ref()?.shape, Shape::Scalar);
        Some(if companion == Companion::First && !is_number { "jacobian" } else { companion.key() })
    }

    /// Returns the names and types of a companion's additional parameters.
    pub(super) fn extra_parameters(&self, companion: Companion) -> Vec<(Ident, Type)> {
        match companion.extra_parameters() {
            ExtraParameters::Nothing => Vec::new(),
            ExtraParameters::Direction => {
                let variables = self.variables().into_iter();
                let named = variables.filter_map(|variable| Some((variable.name.as_ref()?, &variable.slope)));
                named.map(|(name, ty)| (self.free(format!("along_{}", word_of(name).text)), ty.owned())).collect()
            }
            ExtraParameters::Weights => {
                self.result.iter().map(|ty| (self.free("weights".to_owned()), ty.owned())).collect()
            }
        }
    }

    /// Returns this name, with `_` appended until no argument has it.
    fn free(&self, mut name: String) -> Ident {
        while self.list.iter().any(|argument| argument.name.as_ref().is_some_and(|known| *known == name)) {
            name.push('_');
        }
        format_ident!("{name}")
    }

    /// Declares the numbers of a companion's additional parameters as inputs.
    pub(super) fn extra_inputs(&self, companion: Companion, g: &mut Graph) -> Vec<Scalar> {
        let mut declared = Vec::new();
        for (name, ty) in self.extra_parameters(companion) {
            declared.extend((0..ty.dimension()).map(|index| g.input(&format!("{name}_{index}"))));
        }
        declared
    }

    /// Returns the slices among the arguments and their fields: the expression of each, and the type of its elements.
    pub(super) fn slices(&self) -> Vec<(TokenStream, &Type)> {
        let mut slices = Vec::new();
        self.list.iter().for_each(|argument| argument.ty.slices(&argument.called, &mut slices));
        slices
    }

    /// Returns the expressions of a companion's inputs in emitted code, in the order of their declaration.
    pub(super) fn inputs(&self, companion: Companion) -> Vec<TokenStream> {
        let (mut inputs, precision) = (Vec::new(), self.precision());
        for Argument { called, ty, .. } in &self.list {
            ty.numbers(called, precision, &mut inputs);
        }
        for (name, ty) in self.extra_parameters(companion) {
            inputs.extend(ty.varying(&quote!(#name), precision));
        }
        inputs
    }
}

/// The arguments, declared in the graph.
pub(super) struct Declared {
    /// Value of each argument.
    pub(super) values: Vec<Value>,
    /// Inputs of each variable, or the components of its step, in the order of `wrt`.
    pub(super) variables: Vec<Vec<Scalar>>,
    /// Numbers of each argument.
    pub(super) numbers: Vec<Vec<Scalar>>,
}

/// Returns the name that emitted code gives an argument with a pattern.
pub(super) fn pattern_argument(index: usize) -> Ident {
    crate::emit::body::local(&format!("argument{index}"))
}

fn is(name: &Ident, word: &Word) -> bool {
    word_of(name).text == word.text
}

/// Returns `true` if the pattern of an argument binds this name.
fn is_bound_by(input: &FnArg, word: &Word) -> bool {
    let FnArg::Typed(typed) = input else { return false };
    let mut is_bound = false;
    each_word(typed.pat.to_token_stream(), &mut |name| is_bound |= is(name, word));
    is_bound
}

/// Replaces a slice by an array of the length that the attribute gives; `None` for any other type.
fn sized(ty: &syn::Type, name: &Ident, options: &Options) -> Option<syn::Type> {
    let (_, element) = slice_of(ty)?;
    let (_, length) = options.lengths.iter().find(|(word, _)| is(name, word))?;
    let length = Literal::usize_unsuffixed(*length);
    Some(syn::parse_quote!(&[#element; #length]))
}

/// Returns the type inside an `Option` or `Result`.
fn inside(output: &ReturnType) -> Option<&syn::Type> {
    let ReturnType::Type(_, ty) = output else { return None };
    let syn::Type::Path(path) = &**ty else { return None };
    let last = path.path.segments.last().filter(|last| last.ident == "Option" || last.ident == "Result")?;
    let syn::PathArguments::AngleBracketed(of) = &last.arguments else { return None };
    of.args.iter().find_map(|argument| match argument {
        syn::GenericArgument::Type(inside) => Some(inside),
        _ => None,
    })
}

fn place_among<'w>(wrt: Option<&'w [Variable]>, name: &Ident) -> Option<(usize, &'w Variable)> {
    wrt?.iter().enumerate().find(|(_, variable)| is(name, &variable.name))
}

fn known_type(ty: &syn::Type, items: &Items, report: &mut Report) -> Option<Type> {
    Type::parse(ty, items).map_err(|(place, text)| report.error_in(&place, text)).ok()
}

/// Reports qualifiers that a companion cannot have: generic types and lengths, `async` and so on. Returns `true` if the
/// function is generic.
fn refuse_qualifiers(signature: &Signature, report: &mut Report) -> bool {
    let Signature { asyncness, safety, abi, variadic, generics, .. } = signature;
    let qualifiers = [
        (asyncness.to_token_stream(), "async"),
        (if let syn::Safety::Unsafe(word) = safety { quote!(#word) } else { quote!() }, "unsafe"),
        (abi.to_token_stream(), "extern"),
        (variadic.to_token_stream(), "variadic"),
    ];
    for (word, qualifier) in qualifiers.into_iter().filter(|(word, _)| !word.is_empty()) {
        report.error_in(&word, messages::qualifier(qualifier));
    }
    let mut predicates = generics.where_clause.iter().flat_map(|clause| &clause.predicates);
    let is_generic = generics.params.iter().any(|parameter| !matches!(parameter, GenericParam::Lifetime(_)));
    if is_generic {
        report.error_in(&generics.params, messages::generic());
    } else if predicates.any(|predicate| !matches!(predicate, WherePredicate::Lifetime(_))) {
        report.error_in(&generics.where_clause, messages::generic());
    }
    is_generic
}
