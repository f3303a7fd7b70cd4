//! Differentiated functions of a Rust file, for emission in other languages.

use aim_symbolic::print::{Formula, Notation};
use aim_symbolic::{Derivation, Graph, Program, Want};
use syn::{Attribute, Item, ItemFn, ItemMod, Meta};

use super::arguments::{Argument, Arguments};
use super::companion::{Companion, Derived};
use super::items::Items;
use super::manifold::VaryingPart;
use super::options::Options;
use super::types::{Shape, Type};
use super::{Search, is_ours, messages};
use crate::declare::SourcePlace;
use crate::declare::parse::tokens::word_of;
use crate::declare::report::Report;
use crate::declare::report::diagnostics::{Diagnostic, Diagnostics, Source};
use crate::declare::tree;
use crate::emit::{Precision, Procedure};

/// A function of a file, with the programs of its derivatives.
#[derive(Debug)]
pub struct Differentiated {
    name: String,
    precision: Precision,
    programs: Vec<CompanionProgram>,
    /// Graph and outputs of the first companion.
    stated: (Graph, Vec<Want>),
}

/// A companion, to be emitted in another language.
#[derive(Debug)]
struct CompanionProgram {
    suffix: &'static str,
    /// Description of its outputs.
    outputs: String,
    parameters: Vec<(String, Option<usize>)>,
    program: Program,
}

impl Differentiated {
    /// Derives the companions that `#[differentiate(…)]` requests for the function of this name. The function may be in
    /// a module of the file.
    ///
    /// ```
    /// use aim_codegen::{Differentiated, emit::c};
    ///
    /// let file = "#[differentiate(wrt(x))] fn energy(x: f64, rest: f64) -> f64 { 0.5 * (x - rest).powi(2) }";
    /// let energy = Differentiated::from_file("energy.rs", file, "energy")?;
    /// assert!(c::emit_procedures("of energy.rs", &energy.procedures()).contains("energy_gradient"));
    /// # Ok::<(), aim_codegen::declare::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the text is not valid Rust, has no such function, or the function cannot be differentiated: returns all
    /// errors, with places in the text.
    pub fn from_file(file_name: &str, text: &str, name: &str) -> Result<Self, Diagnostics> {
        Self::derive_from_text(file_name, text, name, Search::Smallest)
    }

    /// Like [`from_file`](Self::from_file), but takes the first derivation found, which need not be the smallest. For
    /// tests of many functions.
    ///
    /// # Errors
    ///
    /// The same as [`from_file`](Self::from_file).
    pub fn from_file_at_once(file_name: &str, text: &str, name: &str) -> Result<Self, Diagnostics> {
        Self::derive_from_text(file_name, text, name, Search::Any)
    }

    fn derive_from_text(file_name: &str, text: &str, name: &str, search: Search) -> Result<Self, Diagnostics> {
        let mut report = Report::new(tree::Notation::Rust);
        let derived = derive(text, name, search, &mut report);
        let mut found = report.into_list();
        derived.filter(|_| found.is_empty()).ok_or_else(|| {
            found.iter_mut().for_each(Diagnostic::place_in_text);
            Diagnostics::new(found, Some(Source { name: file_name.to_owned(), text: text.to_owned() }))
        })
    }

    /// Returns the precision that the function computes in.
    #[must_use]
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Returns `true` if one of the programs contains a constant that is infinite or NaN.
    #[must_use]
    pub fn has_infinities(&self) -> bool {
        self.programs.iter().any(|CompanionProgram { program, .. }| {
            program.ops().iter().any(|op| match op {
                aim_symbolic::Op::Constant(constant) => !constant.value().is_finite(),
                _ => false,
            })
        })
    }

    /// Derives the first companion again and records every intermediate step.
    #[must_use]
    pub fn derivation(&self) -> Derivation {
        Derivation::new(&self.stated.0, &self.stated.1)
    }

    /// Returns the symbols of its arguments in formulas: the name of a number, the components' common name of a vector.
    #[must_use]
    pub fn notation(&self) -> Notation {
        let own = self.programs.first().map_or(&[][..], |first| &first.parameters);
        let numbers = own.iter().filter(|(_, size)| size.is_none());
        let symbol = |(name, _): &(String, _)| {
            let name = name.trim_start_matches("in_");
            (format!("{name}_0"), Formula::italic(name))
        };
        Notation { inputs: numbers.map(symbol).collect(), ..Notation::default() }
    }

    /// Returns the functions to emit: `NAME_gradient` or `NAME_jacobian`, and those that the attribute requests
    /// besides.
    #[must_use]
    pub fn procedures(&self) -> Vec<Procedure<'_>> {
        let programs = self.programs.iter();
        let procedures = programs.map(|CompanionProgram { suffix, outputs, parameters, program }| Procedure {
            name: format!("{}_{suffix}", self.name),
            doc: vec![outputs.clone(), format!("{}.", program.count())],
            parameters: parameters.clone(),
            precision: self.precision,
            program,
        });
        procedures.collect()
    }
}

fn derive(text: &str, name: &str, search: Search, report: &mut Report) -> Option<Differentiated> {
    let file = match syn::parse_file(text) {
        Ok(file) => file,
        Err(error) => {
            report.error(&SourcePlace::span(error.span()), messages::no_rust(&error.to_string()));
            return None;
        }
    };
    let mut functions = Vec::new();
    collect_requested(&file.items, false, &mut functions);
    let all: Vec<String> = functions.iter().map(|found| found.function.sig.ident.to_string()).collect();
    let Some(RequestedFunction { function, attribute, beside, is_in_read_module }) =
        functions.into_iter().find(|found| found.function.sig.ident == name)
    else {
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        report.error(&SourcePlace::Text(0..0), messages::no_such_function(name, &all));
        return None;
    };
    let arguments = match &attribute.meta {
        Meta::List(list) => list.tokens.clone(),
        _ => proc_macro2::TokenStream::new(),
    };
    let options = Options::parse(arguments, report).in_another_language();
    // An attribute on the function itself sees only the constants beside it.
    let items = if is_in_read_module { Items::of(beside) } else { Items::of(&constants_of(beside)) };
    let arguments = Arguments::check(&function.sig, &options, &items, report);
    let derived = Derived::all(function, &options, &arguments, &items, search, report)?;
    if derived.iter().any(|derived| !derived.kept_loops.is_empty()) {
        report.error_in(&function.sig.ident, messages::kept_loop_elsewhere(name));
        return None;
    }
    let result = arguments.result.as_ref()?;
    let outputs = Outputs {
        name,
        size: result.components(),
        variables: arguments.variables(),
        is_optional: arguments.is_optional,
    };
    let own = arguments.list.iter().enumerate().map(|(index, argument)| {
        // An argument with a pattern is named by its index.
        let name = argument.name.as_ref().map_or_else(|| index.to_string(), |name| word_of(name).text);
        parameter(&name, &argument.ty)
    });
    let own: Vec<_> = own.collect();
    let program_of = |Derived { companion, program, .. }: Derived| {
        let extra =
            arguments.extra_parameters(companion).into_iter().map(|(name, ty)| parameter(&name.to_string(), &ty));
        Some(CompanionProgram {
            suffix: arguments.suffix(companion)?,
            outputs: outputs.of(companion),
            parameters: own.iter().cloned().chain(extra).collect(),
            program,
        })
    };
    let stated = derived.first().map(|first| (first.graph.clone(), first.wanted.clone()))?;
    Some(Differentiated {
        stated,
        name: name.to_owned(),
        precision: arguments.precision(),
        programs: derived.into_iter().filter_map(program_of).collect(),
    })
}

/// Returns an argument's name, with a prefix that keeps it from being a keyword, and its number of elements.
fn parameter(name: &str, ty: &Type) -> (String, Option<usize>) {
    (format!("in_{name}"), (!matches!(ty.shape, Shape::Scalar)).then(|| ty.components()))
}

/// Returns the constants among these items and in modules, and the imports that they may be named by.
fn constants_of(items: &[Item]) -> Vec<Item> {
    let constants = items.iter().filter_map(|item| match item {
        Item::Const(_) | Item::Static(_) | Item::Use(_) => Some(item.clone()),
        Item::Mod(inner) => {
            let (brace, items) = inner.content.as_ref()?;
            Some(Item::Mod(ItemMod { content: Some((*brace, constants_of(items))), ..inner.clone() }))
        }
        _ => None,
    });
    constants.collect()
}

/// A function with the attribute, and the items of its module.
struct RequestedFunction<'f> {
    function: &'f ItemFn,
    attribute: &'f Attribute,
    beside: &'f [Item],
    /// `true` if the module has the attribute as well.
    is_in_read_module: bool,
}

/// Collects all functions with the attribute, including those in modules.
fn collect_requested<'f>(beside: &'f [Item], is_in_read_module: bool, functions: &mut Vec<RequestedFunction<'f>>) {
    for item in beside {
        match item {
            Item::Fn(function) => {
                let attribute = function.attrs.iter().find(|attribute| is_ours(attribute));
                functions.extend(attribute.map(|attribute| RequestedFunction {
                    function,
                    attribute,
                    beside,
                    is_in_read_module,
                }));
            }
            Item::Mod(inner) => {
                let items = inner.content.as_ref().map_or(&[][..], |(_, items)| items);
                collect_requested(items, inner.attrs.iter().any(is_ours), functions);
            }
            _ => {}
        }
    }
}

/// Describes the outputs of a program in words.
struct Outputs<'a> {
    name: &'a str,
    size: usize,
    variables: Vec<&'a Argument>,
    is_optional: bool,
}

impl Outputs<'_> {
    fn of(&self, companion: Companion) -> String {
        let (name, size, variables) = (self.name, self.size, self.variables());
        let last = if self.is_optional { " The last is 1 where there is a value, else 0." } else { "" };
        let value = if size == 1 { format!("The value of {name}") } else { format!("The {size} numbers of {name}") };
        let gradient = format!("{value}, then its derivative by each component of {variables}");
        let outputs = match companion {
            Companion::First if size == 1 => format!("{gradient}."),
            Companion::First => {
                format!("{value}, then the derivative of each of them by each component of {variables}.")
            }
            Companion::Hessian => format!("{gradient}; then the second derivatives: the upper triangle, row by row."),
            Companion::Jvp => format!("{value}, then the same of the derivative along the direction."),
            Companion::Vjp => {
                format!("{value}, then the derivative of the weighted sum by each component of {variables}.")
            }
            Companion::Hvp => format!(
                "The derivative of {name} along the direction, then the derivative of that by each component of {variables}."
            ),
            Companion::GaussNewton => format!(
                "{value}, r; then J^T r by each component of {variables}; then J^T J: the upper triangle, row by row."
            ),
        };
        outputs + last
    }

    /// Lists the variables, each with its number of components.
    fn variables(&self) -> String {
        let variable = |argument: &&Argument| {
            let name = argument.name.as_ref().map(ToString::to_string).unwrap_or_default();
            let tangent = if matches!(argument.varying_part, VaryingPart::Tangent(_)) { "the tangent of " } else { "" };
            format!("{tangent}{name} ({})", argument.slope.dimension())
        };
        self.variables.iter().map(variable).collect::<Vec<_>>().join(", ")
    }
}
