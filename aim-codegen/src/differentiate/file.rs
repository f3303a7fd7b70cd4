//! Differentiated functions of a Rust file, for languages that are not Rust.

use aim_symbolic::Program;
use syn::{Attribute, Item, ItemFn, Meta};

use super::arguments::{Argument, Arguments};
use super::items::Items;
use super::options::Options;
use super::types::Shape;
use super::{Programs, is_ours, messages};
use crate::declare::Place;
use crate::declare::parse::tokens::word_of;
use crate::declare::report::Report;
use crate::declare::report::diagnostics::{Diagnostic, Diagnostics, Source};
use crate::declare::tree::Notation;
use crate::emit::{Precision, Procedure};

/// A function of a file, with the programs of its derivatives.
#[derive(Debug)]
pub struct Differentiated {
    name: String,
    precision: Precision,
    parameters: Vec<(String, Option<usize>)>,
    /// The suffix of a program's name, what its outputs are, and the program.
    programs: Vec<(&'static str, Vec<String>, Program)>,
}

impl Differentiated {
    /// Derives what `#[differentiate(…)]` asks for on the function of this name, which may be in a module of the file.
    ///
    /// # Errors
    /// Where the text is no Rust, has no such function, or one that cannot be differentiated: all that is wrong, with places
    /// in the text.
    pub fn from_file(file_name: &str, text: &str, name: &str) -> Result<Self, Diagnostics> {
        let mut report = Report::new(Notation::Rust);
        let derived = derive(text, name, &mut report);
        let mut found = report.into_list();
        derived.filter(|_| found.is_empty()).ok_or_else(|| {
            found.iter_mut().for_each(Diagnostic::place_in_text);
            Diagnostics::new(found, Some(Source { name: file_name.to_owned(), text: text.to_owned() }))
        })
    }

    /// What the function computes with.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Whether a number that is not finite is written out in one of its programs.
    pub fn has_infinities(&self) -> bool {
        self.programs.iter().any(|(.., program)| {
            program.ops().iter().any(|op| match op {
                aim_symbolic::Op::Constant(constant) => !constant.value().is_finite(),
                _ => false,
            })
        })
    }

    /// The functions to be written: `NAME_gradient` or `NAME_jacobian`, and `NAME_hessian` where it is asked for.
    pub fn procedures(&self) -> Vec<Procedure<'_>> {
        let programs = self.programs.iter();
        let procedures = programs.map(|(suffix, outputs, program)| Procedure {
            name: format!("{}_{suffix}", self.name),
            doc: outputs.iter().cloned().chain([format!("{}.", program.count())]).collect(),
            parameters: self.parameters.clone(),
            precision: self.precision,
            program,
        });
        procedures.collect()
    }
}

fn derive(text: &str, name: &str, report: &mut Report) -> Option<Differentiated> {
    let file = match syn::parse_file(text) {
        Ok(file) => file,
        Err(error) => {
            report.error(&Place::span(error.span()), messages::no_rust(&error.to_string()));
            return None;
        }
    };
    let mut functions = Vec::new();
    collect(&file.items, None, &mut functions);
    let all: Vec<String> = functions.iter().map(|found| found.function.sig.ident.to_string()).collect();
    let Some(Found { function, attribute, module }) =
        functions.into_iter().find(|found| found.function.sig.ident == name)
    else {
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        report.error(&Place::Text(0..0), messages::no_such_function(name, &all));
        return None;
    };
    let arguments = match &attribute.meta {
        Meta::List(list) => list.tokens.clone(),
        _ => proc_macro2::TokenStream::new(),
    };
    let options = Options::parse(arguments, report);
    let items = module.map(Items::of).unwrap_or_default();
    let arguments = Arguments::check(&function.sig, &options, &items, report);
    let programs = Programs::derive(function, &options, &arguments, &items, report)?;
    let result = arguments.result.as_ref()?;
    let outputs = Outputs { name, size: result.components(), variables: arguments.variables() };
    let is_number = matches!(result.shape, Shape::Scalar);
    let suffix = if is_number { "gradient" } else { "jacobian" };
    let mut derived = vec![(suffix, outputs.first(), programs.first)];
    derived.extend(programs.second.map(|second| ("hessian", outputs.second(), second)));
    Some(Differentiated {
        name: name.to_owned(),
        precision: arguments.precision(),
        parameters: arguments.list.iter().enumerate().map(parameter).collect(),
        programs: derived,
    })
}

/// An argument where its name is no word of another language; one that is taken apart is called by its number.
fn parameter((index, argument): (usize, &Argument)) -> (String, Option<usize>) {
    let name = argument.name.as_ref().map_or_else(|| index.to_string(), |name| word_of(name).text);
    let elements = (!matches!(argument.ty.shape, Shape::Scalar)).then(|| argument.ty.components());
    (format!("in_{name}"), elements)
}

/// A function with the attribute, and the items of its module where that has it, too.
struct Found<'f> {
    function: &'f ItemFn,
    attribute: &'f Attribute,
    module: Option<&'f [Item]>,
}

/// The functions with the attribute, in modules too.
fn collect<'f>(items: &'f [Item], module: Option<&'f [Item]>, functions: &mut Vec<Found<'f>>) {
    for item in items {
        match item {
            Item::Fn(function) => {
                let attribute = function.attrs.iter().find(|attribute| is_ours(attribute));
                functions.extend(attribute.map(|attribute| Found { function, attribute, module }));
            }
            Item::Mod(inner) => {
                let items = inner.content.as_ref().map_or(&[][..], |(_, items)| items);
                let seen = inner.attrs.iter().any(is_ours).then_some(items);
                collect(items, seen, functions);
            }
            _ => {}
        }
    }
}

/// What a program's outputs are, in words.
struct Outputs<'a> {
    name: &'a str,
    size: usize,
    variables: Vec<&'a Argument>,
}

impl Outputs<'_> {
    fn first(&self) -> Vec<String> {
        let (name, size) = (self.name, self.size);
        let value = if size == 1 { format!("The value of {name}") } else { format!("The {size} components of {name}") };
        let by = if size == 1 { "its derivative" } else { "the derivative of each of them" };
        vec![format!("{value}, then {by} by each component of {}.", self.variables())]
    }

    fn second(&self) -> Vec<String> {
        let mut lines = self.first();
        lines.push("Then the second derivatives: the upper triangle, row by row.".to_owned());
        lines
    }

    /// The variables and how many numbers each has.
    fn variables(&self) -> String {
        let variable = |argument: &&Argument| {
            let name = argument.name.as_ref().map(ToString::to_string).unwrap_or_default();
            format!("{name} ({})", argument.ty.components())
        };
        self.variables.iter().map(variable).collect::<Vec<_>>().join(", ")
    }
}
