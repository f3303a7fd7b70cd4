//! Kept loops: loops that stay loops in emitted code instead of being unrolled. Derives and emits their programs.
//!
//! The states, the numbers that an iteration changes, are carried from iteration to iteration with their derivatives.
//! If an iteration computes s' from the state s and the variable x, then ds'/dx = ∂s'/∂x + ∂s'/∂s ds/dx.

use std::rc::Rc;

use aim_symbolic::{Count, Graph, Op, Program, Scalar, Value, Want};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote, quote_spanned};

use super::lower::{At, KeptLoop, Outside, State};
use super::needed::Needed;
use super::types::{Precision, Type};
use crate::emit::body::{Arithmetic, Body, local};

/// The kept loops of a function.
#[derive(Default)]
pub(super) struct Kept {
    loops: Vec<Stage>,
    /// Sources of the inputs that are not numbers of arguments; they follow the arguments' inputs. An element with a
    /// computed index has the program that computes the index.
    outside: Vec<(Outside, Option<Rc<Program>>)>,
    /// The paths of constants among them.
    constants: Vec<syn::Path>,
    /// Number of variables.
    variables: usize,
    /// Final states of the outermost loops that have derivatives.
    left: Vec<Varying>,
}

struct Stage {
    /// Index of the enclosing kept loop.
    within: Option<usize>,
    states: Vec<State>,
    /// Program before the first iteration. Outputs: the states, the number of iterations, then the derivatives with
    /// respect to the variables and to the states in `seen`.
    entry: Program,
    seen: Vec<Varying>,
    /// `true` if an iteration may end the loop early.
    leaves: bool,
    /// Program of one iteration. Outputs: the next states, the exit flag if `leaves`, then the derivatives with respect
    /// to the variables and to the states in `seen_in_round`: its own, and the final ones of loops inside it.
    round: Program,
    seen_in_round: Vec<Varying>,
}

/// A state that has derivatives: its input, its loop's index and its own index in that loop.
#[derive(Clone, Copy)]
struct Varying {
    input: Scalar,
    l: usize,
    k: usize,
}

/// Returns the states of loop `l` that have derivatives. `input` selects their value before an iteration or after the
/// loop.
fn varying(loops: &[KeptLoop], l: usize, input: fn(&State) -> Scalar) -> impl Iterator<Item = Varying> {
    let states = loops[l].states.iter().enumerate().filter(|(_, state)| state.varies);
    states.map(move |(k, state)| Varying { input: input(state), l, k })
}

/// Returns the final states of the loops directly inside `within`, or at the top level, whose index is below `before`.
fn left(loops: &[KeptLoop], within: Option<usize>, before: usize) -> Vec<Varying> {
    let earlier = (0..before).filter(|&l| loops[l].within == within);
    earlier.flat_map(|l| varying(loops, l, |state| state.after)).collect()
}

/// Returns the states that are visible before loop `l`: those of enclosing loops, and the final ones of earlier loops.
fn seen(loops: &[KeptLoop], l: usize) -> Vec<Varying> {
    let mut seen = left(loops, loops[l].within, l);
    if let Some(around) = loops[l].within {
        seen.extend(self::seen(loops, around));
        seen.extend(varying(loops, around, |state| state.before));
    }
    seen
}

impl Kept {
    /// Derives the programs of all kept loops; `program` derives the program of requested outputs.
    pub(super) fn derive(needed: &Needed, variables: &[Scalar], program: &dyn Fn(&Graph, &[Want]) -> Program) -> Self {
        let all = &needed.loops;
        let stage = |(l, kept): (usize, &KeptLoop)| {
            // The values, then the derivatives of those that have any.
            let wanted = |values: &dyn Fn(&State) -> Scalar, more: Option<Scalar>, seen: &[Varying]| {
                let numbers = kept.states.iter().map(values).chain(more).map(Want::Value);
                let by: Vec<Scalar> =
                    variables.iter().copied().chain(seen.iter().map(|varying| varying.input)).collect();
                let slopes = kept.states.iter().filter(|state| state.varies).flat_map(|state| {
                    let value = values(state);
                    by.iter().map(move |&input| Want::Derivative(value, input.into()))
                });
                program(&needed.g, &numbers.chain(slopes).collect::<Vec<_>>())
            };
            let seen = seen(all, l);
            let entry = wanted(&|state| state.first, Some(kept.count), &seen);
            let mut seen_in_round = seen.clone();
            seen_in_round.extend(varying(all, l, |state| state.before));
            seen_in_round.extend(left(all, Some(l), all.len()));
            let round = wanted(&|state| state.next, kept.leaves, &seen_in_round);
            let (states, leaves) = (kept.states.clone(), kept.leaves.is_some());
            Stage { within: kept.within, states, leaves, entry, seen, round, seen_in_round }
        };
        let mut numbers: Vec<(Scalar, Rc<Program>)> = Vec::new();
        let outside = needed.outside.iter().map(|(which, _)| {
            let Outside::Element { at: At::Chosen(index), .. } = *which else { return (*which, None) };
            let known = numbers.iter().find(|(known, _)| *known == index).map(|(_, program)| program.clone());
            let program = known.unwrap_or_else(|| {
                let made = Rc::new(program(&needed.g, &[Want::Value(index)]));
                numbers.push((index, made.clone()));
                made
            });
            (*which, Some(program))
        });
        Self {
            outside: outside.collect(),
            loops: all.iter().enumerate().map(stage).collect(),
            constants: needed.constants.clone(),
            variables: variables.len(),
            left: left(all, None, all.len()),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.loops.is_empty()
    }

    /// Returns the final states, after all loops, that have derivatives.
    pub(super) fn after(&self) -> impl Iterator<Item = Scalar> {
        self.left.iter().map(|varying| varying.input)
    }

    /// Appends the inputs that are not numbers of arguments.
    pub(super) fn add_inputs(
        &self,
        inputs: &mut Vec<TokenStream>,
        (number, private): (Arithmetic<'_>, &TokenStream),
        precision: Precision,
        slices: &[(TokenStream, &Type)],
    ) {
        let name = format_ident!("{}", precision.name());
        for (which, program) in &self.outside {
            let input = match *which {
                Outside::Round(l) => {
                    let round = round_number(l);
                    quote!((#round as ::core::primitive::#name))
                }
                Outside::Before(l, k) | Outside::After(l, k) => {
                    let state = state(l, k);
                    quote!(#state)
                }
                Outside::Constant(index) => {
                    let path = &self.constants[index];
                    // The compiler reports another type at the name that the user wrote.
                    let written = path.segments.last().map_or_else(Span::call_site, |name| name.ident.span());
                    let value = quote_spanned!(written=> number_constant::<::core::primitive::#name, _>(#path));
                    number.constant(quote!(#private::#value), private)
                }
                Outside::Cast(index) => {
                    let path = &self.constants[index];
                    number.constant(quote!(::core::primitive::f64::from(#path as ::core::primitive::#name)), private)
                }
                Outside::Element { slice, at, number: component } => {
                    let ((called, element), value) = (&slices[slice], local("element"));
                    let mut numbers = Vec::new();
                    element.numbers(&quote!((*#value)), precision, &mut numbers);
                    let component = &numbers[component];
                    let index = match (at, program) {
                        (At::Round(l, more), _) => {
                            let (round, size) = (round_number(l), Literal::u64_unsuffixed(more.unsigned_abs()));
                            match more {
                                0 => quote!(#round),
                                1.. => quote!(#round + #size),
                                _ => quote!(#round.wrapping_sub(#size)),
                            }
                        }
                        (At::Chosen(_), Some(program)) => {
                            let input = |i: usize| inputs[i].clone();
                            let body = Body { program, number, private, input: &input };
                            let (steps, results) = (body.steps(), body.results());
                            quote!({ #steps #(#results)* } as ::core::primitive::usize)
                        }
                        (At::Known(index), _) => Literal::usize_unsuffixed(index).into_token_stream(),
                        (At::Chosen(_), None) => unreachable!("a number that is chosen has a program"),
                    };
                    // Where the function would panic, the value is 0.
                    quote!((match #called.get(#index) {
                        ::core::option::Option::Some(#value) => #component,
                        ::core::option::Option::None => 0.0,
                    }))
                }
            };
            inputs.push(input);
        }
    }

    /// Returns the number of operations of all programs except the function's own; an iteration counts once.
    pub(super) fn count(&self) -> Count {
        self.loops.iter().fold(Count::default(), |count, stage| count + stage.entry.count() + stage.round.count())
    }

    /// Emits the loops directly inside loop `within`, or those at the top level.
    fn code(
        &self,
        within: Option<usize>,
        number: Arithmetic<'_>,
        private: &TokenStream,
        input: &dyn Fn(usize) -> TokenStream,
    ) -> TokenStream {
        let mut code = TokenStream::new();
        for (l, stage) in self.loops.iter().enumerate().filter(|(_, stage)| stage.within == within) {
            let states: Vec<Ident> = (0..stage.states.len()).map(|k| state(l, k)).collect();
            let varying = stage.states.iter().enumerate().filter(|(_, state)| state.varies);
            let slopes: Vec<Ident> =
                varying.flat_map(|(k, _)| (0..self.variables).map(move |j| slope(l, k, j))).collect();
            let block = |program: &Program, seen: &[Varying], has_more: bool, inner: TokenStream| {
                let body = Body { program, number, private, input };
                let (steps, results) = (body.steps(), body.results().collect::<Vec<_>>());
                let (values, rest) = program.outputs().split_at(stage.states.len() + usize::from(has_more));
                let chain = &Chain::new(&body);
                let chained = rest.chunks((self.variables + seen.len()).max(1)).flat_map(|row| {
                    let (direct, by_seen) = row.split_at(self.variables);
                    (0..self.variables).map(move |j| chain.derivative(direct[j], by_seen, seen, j))
                });
                let (chained, values) = (chained.collect::<Vec<_>>(), &results[..values.len()]);
                quote!({ #inner #steps (#(#values,)* #(#chained,)*) })
            };
            let (count, round) = (local(&format!("count{l}")), round_number(l));
            let entry = block(&stage.entry, &stage.seen, true, TokenStream::new());
            let inner = self.code(Some(l), number, private, input);
            let of_round = block(&stage.round, &stage.seen_in_round, stage.leaves, inner);
            let leaves = stage.leaves.then(|| local("leaves"));
            let end = leaves.iter().map(|leaves| quote!(if #leaves > 0.0 { break; }));
            let (declared, leaves) = (leaves.iter().map(|leaves| quote!(let #leaves;)), leaves.iter());
            code.extend(quote! {
                let (#(mut #states,)* #count, #(mut #slopes,)*) = #entry;
                for #round in 0..(#count as ::core::primitive::usize) {
                    #(#declared)*
                    (#(#states,)* #(#leaves,)* #(#slopes,)*) = #of_round;
                    #(#end)*
                }
            });
        }
        code
    }
}

/// Applies the chain rule: combines a program's derivatives with respect to variables and to states.
struct Chain<'a> {
    body: &'a Body<'a>,
    /// For each value, `true` if it depends on a select.
    is_selected: Vec<bool>,
}

impl<'a> Chain<'a> {
    fn new(body: &'a Body<'a>) -> Self {
        let mut is_selected = Vec::new();
        for op in body.program.ops() {
            let is_select = matches!(op, Op::SelectLess(..));
            is_selected.push(is_select || op.operands().any(|operand| is_selected[operand.index()]));
        }
        Self { body, is_selected }
    }

    /// Returns the derivative with respect to variable `j`: the direct one, plus the derivative with respect to each
    /// state times that state's own derivative.
    fn derivative(&self, direct: Value, by_states: &[Value], states: &[Varying], j: usize) -> TokenStream {
        let known = |value: Value| match self.body.program.ops()[value.index()] {
            Op::Constant(constant) => Some(constant.value()),
            _ => None,
        };
        let mut terms = Vec::new();
        if known(direct) != Some(0.0) {
            terms.push(self.body.operand(direct));
        }
        for (&by_state, &Varying { l, k, .. }) in by_states.iter().zip(states) {
            let (factor, slope) = (self.body.operand(by_state), slope(l, k, j));
            match known(by_state) {
                Some(0.0) => {}
                Some(1.0) => terms.push(quote!(#slope)),
                // The slope may be infinite in the branch that was not selected, and 0 · ∞ is NaN.
                _ if self.is_selected[by_state.index()] => {
                    terms.push(quote!((if #factor == 0.0 { 0.0 } else { (#factor) * #slope })));
                }
                _ => terms.push(quote!((#factor) * #slope)),
            }
        }
        if terms.is_empty() { quote!(0.0) } else { quote!(#(#terms)+*) }
    }
}

impl Kept {
    /// Returns the code before the function's own program, and the program's outputs. Derivatives with respect to
    /// variables include those through the loops.
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
        let count = self.variables;
        let outputs = body.program.outputs();
        let (values, rest) = outputs.split_at(size);
        let (direct, rest) = rest.split_at(size * count);
        let (by_states, flag) = rest.split_at(size * self.left.len());
        let chain = Chain::new(body);
        let chained = (0..count).flat_map(|j| (0..size).map(move |i| (i, j))).map(|(i, j)| {
            let by_states: Vec<Value> = by_states.iter().skip(i).step_by(size).copied().collect();
            chain.derivative(direct[size * j + i], &by_states, &self.left, j)
        });
        let outputs = results[..values.len()].iter().cloned().chain(chained);
        let outputs = outputs.chain(results[results.len() - flag.len()..].iter().cloned()).collect();
        (self.code(None, body.number, body.private, inputs), outputs)
    }
}

/// Variable of a loop's state.
fn state(l: usize, k: usize) -> Ident {
    local(&format!("state{l}_{k}"))
}

/// Variable of the derivative of a loop's state with respect to variable `j`.
fn slope(l: usize, k: usize, j: usize) -> Ident {
    local(&format!("slope{l}_{k}_{j}"))
}

/// Variable of a loop's iteration counter.
fn round_number(l: usize) -> Ident {
    local(&format!("round{l}"))
}
