//! Loops that stay loops: what is derived of them, and their code. The numbers that a round changes go from round to round with their
//! derivatives by the variables: where a round makes s' of s and x, ds'/dx = ∂s'/∂x + ∂s'/∂s ds/dx.

use aim_symbolic::{Count, Graph, Op, Program, Scalar, Value, Want};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::lower::{Algebra, At, Outside, State};
use super::types::{Precision, Type};
use crate::emit::body::{Arithmetic, Body, local};

/// The loops of a function.
#[derive(Default)]
pub(super) struct Kept {
    loops: Vec<Stage>,
    /// The sources of the inputs that are not the numbers of arguments, after which all of them stand.
    outside: Vec<Outside>,
    /// The number of the variables.
    variables: usize,
}

struct Stage {
    states: Vec<State>,
    /// The program before the first round: the states, how many rounds there are, and derivatives by the variables and by what
    /// the loops before have left.
    entry: Program,
    /// True if a round may be the last one.
    leaves: bool,
    /// The program of a round: the states after it, whether it is the last one, and derivatives by the variables, the states, and
    /// what the loops before have left.
    round: Program,
}

impl Stage {
    /// The numbers of the states that have derivatives.
    fn varying(&self) -> impl Iterator<Item = usize> {
        self.states.iter().enumerate().filter(|(_, state)| state.varies).map(|(k, _)| k)
    }
}

impl Kept {
    /// Those of a function's graph, with `program` for what is wanted of it.
    pub(super) fn derive(
        algebra: &Algebra,
        variables: &[Scalar],
        program: &dyn Fn(&Graph, &[Want]) -> Program,
    ) -> Self {
        let mut loops: Vec<Stage> = Vec::new();
        let mut left: Vec<Scalar> = Vec::new();
        for kept in &algebra.loops {
            let varying: Vec<&State> = kept.states.iter().filter(|state| state.varies).collect();
            let by = |value: Scalar, inputs: &[&[Scalar]]| -> Vec<Want> {
                inputs.concat().into_iter().map(|input| Want::Derivative(value, input.into())).collect()
            };
            let before: Vec<Scalar> = varying.iter().map(|state| state.before).collect();
            let first = kept.states.iter().map(|state| state.first).chain([kept.count]).map(Want::Value);
            let slopes = varying.iter().flat_map(|state| by(state.first, &[variables, &left]));
            let entry = program(&algebra.g, &first.chain(slopes).collect::<Vec<_>>());
            let next = kept.states.iter().map(|state| state.next).chain(kept.leaves).map(Want::Value);
            let slopes = varying.iter().flat_map(|state| by(state.next, &[variables, &before, &left]));
            let round = program(&algebra.g, &next.chain(slopes).collect::<Vec<_>>());
            left.extend(varying.iter().map(|state| state.after));
            loops.push(Stage { states: kept.states.clone(), leaves: kept.leaves.is_some(), entry, round });
        }
        let outside = algebra.outside.iter().map(|(which, _)| *which).collect();
        Self { loops, outside, variables: variables.len() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.loops.is_empty()
    }

    /// What the loops have left that has derivatives.
    pub(super) fn after(&self) -> impl Iterator<Item = Scalar> {
        self.loops.iter().flat_map(|stage| stage.varying().map(|k| stage.states[k].after))
    }

    /// The inputs that come from outside of the arguments' numbers.
    pub(super) fn inputs<'a>(
        &self,
        precision: Precision,
        slice: &dyn Fn(usize) -> (&'a TokenStream, &'a Type),
    ) -> Vec<TokenStream> {
        let number = format_ident!("{}", precision.name());
        let round = round_number();
        let input = |which: &Outside| match *which {
            Outside::Round => quote!((#round as ::core::primitive::#number)),
            Outside::Before(l, k) | Outside::After(l, k) => {
                let state = state(l, k);
                quote!(#state)
            }
            Outside::Element { argument, at, number } => {
                let ((called, element), value) = (slice(argument), local("element"));
                let mut numbers = Vec::new();
                element.numbers(&quote!((*#value)), precision, &mut numbers);
                let (number, literal) = (&numbers[number], Literal::usize_unsuffixed);
                let index = match at {
                    At::First(index) => {
                        let index = literal(index);
                        quote!(#index)
                    }
                    At::Last(back) => {
                        let back = literal(back);
                        quote!(#called.len().wrapping_sub(#back))
                    }
                    At::Round(more) => {
                        let size = Literal::u64_unsuffixed(more.unsigned_abs());
                        match more {
                            0 => quote!(#round),
                            1.. => quote!(#round + #size),
                            _ => quote!(#round.wrapping_sub(#size)),
                        }
                    }
                };
                // Where the function would panic, it is 0.
                quote!((match #called.get(#index) {
                    ::core::option::Option::Some(#value) => #number,
                    ::core::option::Option::None => 0.0,
                }))
            }
        };
        self.outside.iter().map(input).collect()
    }

    /// The operations of all programs but the function's own, those of a round once.
    pub(super) fn count(&self) -> Count {
        self.loops.iter().fold(Count::default(), |count, stage| count + stage.entry.count() + stage.round.count())
    }

    /// The code of the loops.
    fn code(&self, number: Arithmetic<'_>, private: &TokenStream, input: &dyn Fn(usize) -> TokenStream) -> TokenStream {
        let mut code = TokenStream::new();
        let mut left: Vec<(usize, usize)> = Vec::new();
        for (l, stage) in self.loops.iter().enumerate() {
            let states: Vec<Ident> = (0..stage.states.len()).map(|k| state(l, k)).collect();
            let own: Vec<(usize, usize)> = stage.varying().map(|k| (l, k)).collect();
            let slopes: Vec<Ident> =
                own.iter().flat_map(|&(l, k)| (0..self.variables).map(move |j| slope(l, k, j))).collect();
            let block = |program: &Program, before: &[(usize, usize)], has_more: bool| {
                let body = Body { program, number, private, input };
                let (steps, results) = (body.steps(), body.results().collect::<Vec<_>>());
                let (values, rest) = program.outputs().split_at(stage.states.len() + usize::from(has_more));
                let derivatives = rest.chunks(self.variables + before.len()).take(own.len());
                let chained = derivatives.flat_map(|row| {
                    let row: Vec<Value> = row.to_vec();
                    (0..self.variables).map({
                        let body = &body;
                        move |j| chain(body, &row[..self.variables], &row[self.variables..], before, j)
                    })
                });
                let (chained, values) = (chained.collect::<Vec<_>>(), &results[..values.len()]);
                quote!({ #steps (#(#values,)* #(#chained,)*) })
            };
            let (entry, count, rounds) =
                (block(&stage.entry, &left, true), local(&format!("count{l}")), round_number());
            let of_round = block(&stage.round, &[own.as_slice(), &left].concat(), stage.leaves);
            let leaves = stage.leaves.then(|| local("leaves"));
            let end = leaves.iter().map(|leaves| quote!(if #leaves > 0.0 { break; }));
            let (declared, leaves) = (leaves.iter().map(|leaves| quote!(let #leaves;)), leaves.iter());
            code.extend(quote! {
                let (#(mut #states,)* #count, #(mut #slopes,)*) = #entry;
                for #rounds in 0..(#count as ::core::primitive::usize) {
                    #(#declared)*
                    (#(#states,)* #(#leaves,)* #(#slopes,)*) = #of_round;
                    #(#end)*
                }
            });
            left.extend(own);
        }
        code
    }
}

/// The derivative by the variable `j`, of those by all variables and by states that have derivatives themselves.
fn chain(body: &Body<'_>, direct: &[Value], by_states: &[Value], states: &[(usize, usize)], j: usize) -> TokenStream {
    let known = |value: Value| match body.program.ops()[value.index()] {
        Op::Constant(constant) => Some(constant.value()),
        _ => None,
    };
    let mut terms = Vec::new();
    if known(direct[j]) != Some(0.0) {
        terms.push(body.operand(direct[j]));
    }
    for (&by_state, &(l, k)) in by_states.iter().zip(states) {
        let (factor, slope) = (body.operand(by_state), slope(l, k, j));
        match known(by_state) {
            Some(0.0) => {}
            Some(1.0) => terms.push(quote!(#slope)),
            _ => terms.push(quote!((#factor) * #slope)),
        }
    }
    if terms.is_empty() { quote!(0.0) } else { quote!(#(#terms)+*) }
}

impl Kept {
    /// The code before the function's own program, and the outputs of that, with the derivatives through loops in those by
    /// the variables.
    pub(super) fn through_loops(
        &self,
        body: &Body<'_>,
        inputs: &dyn Fn(usize) -> TokenStream,
        size: usize,
    ) -> (TokenStream, Vec<TokenStream>) {
        let results: Vec<TokenStream> = body.results().collect();
        if self.is_empty() {
            return (TokenStream::new(), results);
        }
        let states: Vec<(usize, usize)> =
            self.loops.iter().enumerate().flat_map(|(l, stage)| stage.varying().map(move |k| (l, k))).collect();
        let count = self.variables;
        let outputs = body.program.outputs();
        let (values, rest) = outputs.split_at(size);
        let (direct, rest) = rest.split_at(size * count);
        let (by_states, flag) = rest.split_at(size * states.len());
        let chained = (0..count).flat_map(|j| (0..size).map(move |i| (i, j))).map(|(i, j)| {
            let of_value = |all: &[Value]| -> Vec<Value> { all.iter().skip(i).step_by(size).copied().collect() };
            chain(body, &of_value(direct), &of_value(by_states), &states, j)
        });
        let outputs = results[..values.len()].iter().cloned().chain(chained);
        let outputs = outputs.chain(results[results.len() - flag.len()..].iter().cloned()).collect();
        (self.code(body.number, body.private, inputs), outputs)
    }
}

/// A state of a loop.
fn state(l: usize, k: usize) -> Ident {
    local(&format!("state{l}_{k}"))
}

/// Its derivative by a variable.
fn slope(l: usize, k: usize, j: usize) -> Ident {
    local(&format!("slope{l}_{k}_{j}"))
}

fn round_number() -> Ident {
    local("round")
}
