//! Emits a program as Rust statements. Used for rig kernels and differentiated functions alike.

use core::fmt;
use std::collections::HashMap;

use aim_symbolic::print::{Printer, ProgramWriter};
use aim_symbolic::{Count, Function, Op, Program, Value};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

/// Body of one emitted function.
pub struct Body<'a> {
    /// Program that the function computes.
    pub program: &'a Program,
    /// Number type of the function.
    pub number: Arithmetic<'a>,
    /// Path of the facade's hidden module.
    pub private: &'a TokenStream,
    /// Returns the expression of an input, given its index.
    pub input: &'a dyn Fn(usize) -> TokenStream,
}

/// Maximum number of statements in one block.
const LONGEST_BLOCK: usize = 1000;

/// Number type of an emitted function.
#[derive(Clone, Copy, Debug)]
pub enum Arithmetic<'a> {
    /// A type that implements the runtime's `Scalar`; every operation goes through that trait.
    Generic(&'a TokenStream),
    /// `f32`, with its own operators and literals wherever they exist: in an unoptimised build, everything else is a
    /// function call.
    F32,
}

impl Arithmetic<'_> {
    fn number(self) -> TokenStream {
        match self {
            Self::Generic(number) => number.clone(),
            Self::F32 => quote!(::core::primitive::f32),
        }
    }

    /// Converts an expression of type `f64`.
    pub(crate) fn constant(self, value: TokenStream, private: &TokenStream) -> TokenStream {
        let number = self.number();
        quote!(<#number as #private::Scalar>::constant(#value))
    }
}

impl fmt::Debug for Body<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Body").field("program", self.program).finish_non_exhaustive()
    }
}

impl Body<'_> {
    /// Returns the statements of the program's steps. A long program is split into blocks, because the debug
    /// information of each variable nests in that of the previous one.
    #[must_use]
    pub fn steps(&self) -> TokenStream {
        let statements = self.statements();
        if statements.len() <= LONGEST_BLOCK {
            return statements.into_iter().map(|(_, statement)| statement).collect();
        }
        let ops: HashMap<usize, Op> = self.program.steps().collect();
        // The steps that one statement computes: sine and cosine of an angle share a statement.
        let computed = |number: usize| match ops[&number] {
            Op::Call(function, a) => self.sin_and_cos(function, a).map_or(vec![number], |(_, sin, cos)| vec![sin, cos]),
            _ => vec![number],
        };
        let blocks = statements.chunks(LONGEST_BLOCK).map(|block| {
            let names: Vec<Ident> = block.iter().flat_map(|(number, _)| computed(*number)).map(step).collect();
            let statements = block.iter().map(|(_, statement)| statement);
            quote!(let [#(#names),*] = { #(#statements)* [#(#names),*] };)
        });
        blocks.collect()
    }

    /// Returns the statements, each with the number of the step that it computes.
    pub fn statements(&self) -> Vec<(usize, TokenStream)> {
        let written = ProgramWriter { program: self.program, printer: self };
        let real = self.real();
        let mut statements = Vec::new();
        for (number, op) in self.program.steps() {
            if let Op::Call(function, a) = op
                && let Some((first, sin, cos)) = self.sin_and_cos(function, a)
            {
                if number == first {
                    let [sin, cos] = [sin, cos].map(step);
                    let a = written.operand(a);
                    statements.push((number, quote!(let (#sin, #cos) = #real::sin_cos(#a);)));
                }
                continue;
            }
            let right = written.operation(op);
            let name = step(number);
            statements.push((number, quote!(let #name = #right;)));
        }
        statements
    }

    /// Returns the expressions of the program's outputs, in order.
    pub fn results(&self) -> impl Iterator<Item = TokenStream> {
        self.program.outputs().iter().map(|&v| self.operand(v))
    }

    /// Returns the expression of a value where it is used.
    pub(crate) fn operand(&self, v: Value) -> TokenStream {
        ProgramWriter { program: self.program, printer: self }.operand(v)
    }

    /// Returns the step numbers if the program needs both sine and cosine of `a`: the lower of the two, the sine's, the
    /// cosine's.
    fn sin_and_cos(&self, function: Function, a: Value) -> Option<(usize, usize, usize)> {
        if !matches!(function, Function::Sin | Function::Cos) {
            return None;
        }
        let find =
            |function| self.program.steps().find(|(_, op)| *op == Op::Call(function, a)).map(|(number, _)| number);
        let (sin, cos) = (find(Function::Sin)?, find(Function::Cos)?);
        Some((sin.min(cos), sin, cos))
    }

    fn scalar(&self) -> TokenStream {
        let (number, private) = (self.number.number(), self.private);
        quote!(<#number as #private::Scalar>)
    }

    fn real(&self) -> TokenStream {
        let (number, private) = (self.number.number(), self.private);
        quote!(<#number as #private::Real>)
    }
}

impl Printer for Body<'_> {
    type Text = TokenStream;

    fn operation(&self, op: Op<TokenStream>) -> TokenStream {
        let (scalar, real) = (self.scalar(), self.real());
        match op {
            Op::Input(i) => (self.input)(i as usize),
            Op::Constant(c) => {
                let sign = (c.value() < 0.0).then(|| quote!(-));
                match self.number {
                    Arithmetic::Generic(_) if c.value() == 0.0 => quote!(#scalar::ZERO),
                    Arithmetic::Generic(_) => {
                        let magnitude = magnitude(c.value());
                        quote!(#scalar::constant(#sign #magnitude))
                    }
                    Arithmetic::F32 => {
                        let magnitude = magnitude_f32(c.value());
                        quote!(#sign #magnitude)
                    }
                }
            }
            Op::Tiny => quote!(#scalar::TINY),
            Op::Add(a, b) => quote!(#a + #b),
            Op::Sub(a, b) => quote!(#a - #b),
            Op::Mul(a, b) => quote!(#a * #b),
            Op::Div(a, b) => quote!(#a / #b),
            Op::Neg(a) => quote!(-#a),
            Op::Sqrt(a) => quote!(#scalar::sqrt(#a)),
            Op::SelectLess(a, b, then, otherwise) => match self.number {
                Arithmetic::Generic(_) => quote!(#scalar::select_less(#a, #b, #then, #otherwise)),
                Arithmetic::F32 => quote!(if #a < #b { #then } else { #otherwise }),
            },
            Op::Call(function, a) => {
                let function = format_ident!("{}", function.name());
                quote!(#real::#function(#a))
            }
            Op::Atan2(y, x) => quote!(#real::atan2(#y, #x)),
            Op::Pow(a, b) => quote!(#real::powf(#a, #b)),
        }
    }

    fn group(&self, operand: TokenStream) -> TokenStream {
        quote!((#operand))
    }

    fn step(&self, number: usize) -> TokenStream {
        let name = step(number);
        quote!(#name)
    }
}

/// Literal of the constant's absolute value. Constant folding may have made it infinite or NaN.
fn magnitude(value: f64) -> TokenStream {
    if value.is_nan() {
        quote!(<::core::primitive::f64>::NAN)
    } else if value.is_infinite() {
        quote!(<::core::primitive::f64>::INFINITY)
    } else {
        let literal = Literal::f64_unsuffixed(value.abs());
        quote!(#literal)
    }
}

/// `f32` literal of the constant's absolute value; infinite or NaN if the constant is, once rounded.
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is the purpose")]
fn magnitude_f32(value: f64) -> TokenStream {
    let value = value as f32;
    if value.is_nan() {
        quote!(<::core::primitive::f32>::NAN)
    } else if value.is_infinite() {
        quote!(<::core::primitive::f32>::INFINITY)
    } else {
        let literal = Literal::f32_unsuffixed(value.abs());
        quote!(#literal)
    }
}

/// Identifier of a local variable in emitted code.
///
/// Its mixed-site span keeps it apart from user variables. A constant of the same name at the call site would still
/// turn a binding into a comparison; hence the `__` prefix, which declarations may not use.
#[must_use]
pub fn local(name: &str) -> Ident {
    format_ident!("__{name}", span = Span::mixed_site())
}

/// Identifier of the variable that holds a step's value.
fn step(number: usize) -> Ident {
    local(&format!("v{number}"))
}

/// Formats a count for the start of a sentence, capitalised.
pub fn counted(count: Count) -> String {
    let text = count.to_string();
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
