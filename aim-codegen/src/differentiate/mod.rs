//! `#[differentiate]`: an ordinary function → the same function, and its derivatives beside it.
//!
//! 1. [`options`] reads the attribute's arguments, [`arguments`] the function's: the numbers of each argument become
//!    inputs of a graph.
//! 2. [`lower`] walks through the body and builds its value there. What is a rotation stays one.
//! 3. The graph is differentiated and compiled as the objectives of rigs are.
//! 4. [`emit`] writes the programs as functions of the same arguments.
//!
//! Every error is collected, with its place. The function itself is always emitted as it was written.

mod arguments;
mod emit;
pub(crate) mod file;
mod lower;
mod messages;
mod options;
mod types;

#[cfg(test)]
mod tests;

use aim_symbolic::{Graph, Program, Scalar, Want};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::ItemFn;

use self::arguments::{Arguments, Declared};
use self::emit::Companions;
use self::lower::{Algebra, Translation, Value};
use self::options::Options;
use self::types::{Shape, Type};
use crate::declare::report::Report;
use crate::declare::tree::Notation;

/// What `#[differentiate(…)]` on `item` expands to, `facade` being the name of the crate whose attribute it is.
pub fn differentiate(attribute: TokenStream, item: TokenStream, facade: &str) -> TokenStream {
    let mut report = Report::new(Notation::Rust);
    let function: ItemFn = match syn::parse2(item.clone()) {
        Ok(function) => function,
        Err(error) => {
            // What is no function at all is said in our words, what does not parse in the parser's.
            let errors = if syn::parse2::<syn::Item>(item.clone()).is_ok() {
                report.error_in(&item.clone().into_iter().next(), messages::not_a_function());
                report.into_compile_error()
            } else {
                error.into_compile_error()
            };
            return quote!(#item #errors);
        }
    };
    let options = Options::parse(attribute, &mut report);
    let arguments = Arguments::check(&function.sig, &options, &mut report);
    let programs = Programs::derive(&function, &options, &arguments, &mut report);
    let krate = options.krate.clone().unwrap_or_else(|| {
        let facade = format_ident!("{facade}");
        quote!(::#facade)
    });
    let inputs = programs.as_ref().map_or(&[][..], |programs| &programs.inputs);
    let companions = Companions { item: &function, arguments: &arguments, krate: &krate, inputs };
    let first = companions.first_derivatives(programs.as_ref().map(|programs| &programs.first));
    let second = options
        .hessian
        .as_ref()
        .and_then(|_| companions.hessian(programs.as_ref().and_then(|programs| programs.second.as_ref())));
    // Where `self` or a type is in the way, a stub would only be another error.
    let (first, second) =
        if arguments.faulty.is_empty() && function.sig.receiver().is_none() { (first, second) } else { (None, None) };
    let errors = report.into_compile_error();
    quote! {
        #[allow(dead_code, reason = "its derivatives may be all that is used")]
        #item
        #first
        #second
        #errors
    }
}

/// The derived programs.
struct Programs {
    /// The value, then by each component of each variable the derivative of each component of the value.
    first: Program,
    /// The value, the gradient, then the upper triangle of the second derivatives, row by row.
    second: Option<Program>,
    /// What the inputs are called.
    inputs: Vec<TokenStream>,
}

impl Programs {
    /// Derives them, unless there are errors.
    fn derive(function: &ItemFn, options: &Options, arguments: &Arguments, report: &mut Report) -> Option<Self> {
        let mut algebra = Algebra::new();
        let Declared { values, variables, inputs } = arguments.declare(&mut algebra);
        let body = Translation::new(&mut algebra, report, values).block(&function.block);
        let result = arguments.result.as_ref()?;
        if let (Some(place), true) = (&options.hessian, result.shape != Shape::Scalar) {
            report.error(place, messages::hessian_of_vector());
        }
        let numbers = numbers(&mut algebra, &body, result, report)?;
        if !report.is_empty() {
            return None;
        }
        let variables: Vec<Scalar> = variables.into_iter().flatten().collect();
        let values = numbers.iter().map(|&number| Want::Value(number));
        let by = |variable: Scalar| numbers.iter().map(move |&number| Want::Derivative(number, variable.into()));
        let mut wanted: Vec<Want> = values.chain(variables.iter().flat_map(|&variable| by(variable))).collect();
        let first = derived(&algebra.g, &wanted);
        if let Some((budget, place)) = &options.budget {
            let count = first.count();
            if count.total() > *budget {
                report.error(place, messages::over_budget(*budget, count));
                return None;
            }
        }
        let second = options.hessian.is_some().then(|| {
            for (i, &a) in variables.iter().enumerate() {
                wanted.extend(variables[i..].iter().map(|&b| Want::Second(numbers[0], a.into(), b.into())));
            }
            derived(&algebra.g, &wanted)
        });
        Some(Self { first, second, inputs })
    }
}

/// What a thread needs to walk down the longest functions that people write: each operation is a step down.
const STACK: usize = 512 << 20;

/// The program, derived where there is room for deep expressions; compilers give macros little of it.
fn derived(g: &Graph, wanted: &[Want]) -> Program {
    std::thread::scope(|scope| {
        let roomy = std::thread::Builder::new().stack_size(STACK);
        let thread = roomy.spawn_scoped(scope, || Program::derive_wanted(g, wanted)).ok();
        thread.and_then(|thread| thread.join().ok()).unwrap_or_else(|| Program::derive_wanted(g, wanted))
    })
}

/// The numbers of the function's value; `None` where it is not what the function's type says.
fn numbers(a: &mut Algebra, value: &Value, result: &Type, report: &mut Report) -> Option<Vec<Scalar>> {
    let numbers = match (value, result.shape) {
        (Value::Scalar(number), Shape::Scalar) => vec![*number],
        (Value::Planar(v), Shape::Planar) => a.parts(*v)[..2].to_vec(),
        (Value::Vector(v), Shape::Vector) => a.parts(*v).to_vec(),
        (Value::Unknown, _) => return None,
        (other, _) => {
            let expected = match result.shape {
                Shape::Scalar => "a number",
                Shape::Planar => "a vector of two",
                _ => "a vector",
            };
            report.error_in(&result.tokens, messages::wrong_result(&other.describe(), expected));
            return None;
        }
    };
    Some(numbers)
}
