//! A program as Rust statements, for the kernels of rigs and for differentiated functions alike.

use aim_symbolic::{Count, Function, Op, Program, Value};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

/// The body of one function.
pub(crate) struct Body<'a> {
    pub(crate) program: &'a Program,
    /// The number type that it computes in.
    pub(crate) number: &'a TokenStream,
    /// The facade's hidden module.
    pub(crate) private: &'a TokenStream,
    /// What an input is called.
    pub(crate) input: &'a dyn Fn(usize) -> TokenStream,
}

impl Body<'_> {
    /// The program's steps.
    pub(crate) fn steps(&self) -> TokenStream {
        let Self { number: ty, private, .. } = self;
        let scalar = quote!(<#ty as #private::Scalar>);
        let real = quote!(<#ty as #private::Real>);
        let mut steps = TokenStream::new();
        for (number, op) in self.program.steps() {
            let at = |v: Value| self.operand(v);
            let right = match op {
                Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_) => continue,
                Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..) => self.arithmetic(op),
                Op::Sqrt(a) => {
                    let a = at(a);
                    quote!(#scalar::sqrt(#a))
                }
                Op::Call(function, a) => {
                    if let Some((first, sin, cos)) = self.pair(function, a) {
                        if number == first {
                            let [sin, cos] = [sin, cos].map(step);
                            let a = at(a);
                            steps.extend(quote!(let (#sin, #cos) = #real::sin_cos(#a);));
                        }
                        continue;
                    }
                    let (function, a) = (format_ident!("{}", function.name()), at(a));
                    quote!(#real::#function(#a))
                }
                Op::Atan2(y, x) => {
                    let (y, x) = (at(y), at(x));
                    quote!(#real::atan2(#y, #x))
                }
                Op::SelectLess(a, b, c, d) => {
                    let (a, b, c, d) = (at(a), at(b), at(c), at(d));
                    quote!(#scalar::select_less(#a, #b, #c, #d))
                }
            };
            let name = step(number);
            steps.extend(quote!(let #name = #right;));
        }
        steps
    }

    /// Where the sine and the cosine of one number are both needed: the first of the two steps, the sine's and the
    /// cosine's.
    fn pair(&self, function: Function, of: Value) -> Option<(usize, usize, usize)> {
        if !matches!(function, Function::Sin | Function::Cos) {
            return None;
        }
        let find =
            |function| self.program.steps().find(|(_, op)| *op == Op::Call(function, of)).map(|(number, _)| number);
        let (sin, cos) = (find(Function::Sin)?, find(Function::Cos)?);
        Some((sin.min(cos), sin, cos))
    }

    /// Grouped as it is computed, since sums and products round.
    fn arithmetic(&self, op: Op) -> TokenStream {
        match op {
            Op::Add(a, b) => infix(self.operand(a), '+', self.above(b, Binding::Sum)),
            Op::Sub(a, b) => infix(self.operand(a), '-', self.above(b, Binding::Sum)),
            Op::Mul(a, b) => infix(self.above(a, Binding::Sum), '*', self.above(b, Binding::Product)),
            Op::Div(a, b) => infix(self.above(a, Binding::Sum), '/', self.above(b, Binding::Product)),
            other => unreachable!("{other:?} is not arithmetic"),
        }
    }

    /// An operand, in parentheses unless it binds more tightly.
    fn above(&self, v: Value, binding: Binding) -> TokenStream {
        let operand = self.operand(v);
        let own = match self.program.ops()[v.index()] {
            Op::Add(..) | Op::Sub(..) if self.program.is_inline(v) => Binding::Sum,
            Op::Mul(..) | Op::Div(..) if self.program.is_inline(v) => Binding::Product,
            _ => Binding::Atom,
        };
        if own > binding { operand } else { quote!((#operand)) }
    }

    /// A value where it is used.
    pub(crate) fn operand(&self, v: Value) -> TokenStream {
        let Self { number: ty, private, .. } = self;
        let scalar = quote!(<#ty as #private::Scalar>);
        match self.program.ops()[v.index()] {
            Op::Input(i) => (self.input)(i as usize),
            Op::Constant(c) if c.value() == 0.0 => quote!(#scalar::ZERO),
            Op::Constant(c) => {
                let magnitude = magnitude(c.value());
                if c.value() < 0.0 {
                    quote!(#scalar::constant(-#magnitude))
                } else {
                    quote!(#scalar::constant(#magnitude))
                }
            }
            Op::Tiny => quote!(#scalar::TINY),
            Op::Neg(a) => {
                let a = self.above(a, Binding::Product);
                quote!(-#a)
            }
            op if self.program.is_inline(v) => self.arithmetic(op),
            _ => {
                let name = step(self.program.step_number(v));
                quote!(#name)
            }
        }
    }
}

/// What binds an expression together, the loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Atom,
}

/// A constant without its sign; folding may have made it infinite or no number.
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

/// A variable of emitted code. Mixed-site spans keep it apart from variables, but a pattern called as a constant at the
/// call site would compare instead of bind: hence the prefix, which declarations may not use.
pub(crate) fn local(name: &str) -> Ident {
    format_ident!("__{name}", span = Span::mixed_site())
}

/// The variable of a step.
fn step(number: usize) -> Ident {
    local(&format!("v{number}"))
}

/// A count at the start of a sentence.
pub(crate) fn counted(count: Count) -> String {
    let text = count.to_string();
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn infix(a: TokenStream, operator: char, b: TokenStream) -> TokenStream {
    let operator = proc_macro2::Punct::new(operator, proc_macro2::Spacing::Alone);
    quote!(#a #operator #b)
}
