//! Kept loops: loops that stay loops in emitted code instead of being unrolled. Derives and emits their programs.
//!
//! The states, the numbers that an iteration changes, are carried from iteration to iteration with their derivatives.
//! If an iteration computes s' from the state s and the variable x, then ds'/dx = ∂s'/∂x + ∂s'/∂s ds/dx.

use std::rc::Rc;

use aim_symbolic::{Count, Graph, Op, Program, Scalar, Value, Want};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote, quote_spanned};

use super::lower::{ElementIndex, ExtraInput, KeptLoop, State};
use super::pruned_graph::PrunedGraph;
use super::types::{Precision, Type};
use crate::emit::body::{Arithmetic, Body, local};

/// The kept loops of a function.
#[derive(Default)]
pub(super) struct KeptLoops {
    loops: Vec<LoopPrograms>,
    /// Sources of the inputs that are not numbers of arguments; they follow the arguments' inputs. An element with a
    /// computed index has the program that computes the index.
    extra_inputs: Vec<(ExtraInput, Option<Rc<Program>>)>,
    /// The paths of constants among them.
    constants: Vec<syn::Path>,
    /// Number of variables.
    variables: usize,
    /// Final states of the outermost loops that have derivatives.
    final_states: Vec<VaryingState>,
}

/// The programs of a kept loop.
struct LoopPrograms {
    /// Index of the enclosing kept loop.
    within: Option<usize>,
    states: Vec<State>,
    /// Program before the first iteration. Outputs: the states, the number of iterations, then the derivatives with
    /// respect to the variables and to the states in `visible_at_entry`.
    entry: Program,
    visible_at_entry: Vec<VaryingState>,
    /// `true` if an iteration may end the loop early.
    may_exit: bool,
    /// Program of one iteration. Outputs: the next states, the exit flag if `may_exit`, then the derivatives with respect
    /// to the variables and to the states in `visible_in_iteration`: its own, and the final ones of loops inside it.
    iteration: Program,
    visible_in_iteration: Vec<VaryingState>,
}

/// A state that has derivatives: its input, its loop's index and its own index in that loop.
#[derive(Clone, Copy)]
struct VaryingState {
    input: Scalar,
    l: usize,
    k: usize,
}

/// Returns the states of loop `l` that have derivatives. `input` selects their value before an iteration or after the
/// loop.
fn varying(loops: &[KeptLoop], l: usize, input: fn(&State) -> Scalar) -> impl Iterator<Item = VaryingState> {
    let states = loops[l].states.iter().enumerate().filter(|(_, state)| state.varies);
    states.map(move |(k, state)| VaryingState { input: input(state), l, k })
}

/// Returns the final states of the loops directly inside `within`, or at the top level, whose index is below `before`.
fn final_states(loops: &[KeptLoop], within: Option<usize>, before: usize) -> Vec<VaryingState> {
    let earlier = (0..before).filter(|&l| loops[l].within == within);
    earlier.flat_map(|l| varying(loops, l, |state| state.after)).collect()
}

/// Returns the states that are visible before loop `l`: those of enclosing loops, and the final ones of earlier loops.
fn visible_states(loops: &[KeptLoop], l: usize) -> Vec<VaryingState> {
    let mut visible = final_states(loops, loops[l].within, l);
    if let Some(around) = loops[l].within {
        visible.extend(visible_states(loops, around));
        visible.extend(varying(loops, around, |state| state.before));
    }
    visible
}

impl KeptLoops {
    /// Derives the programs of all kept loops; `program` derives the program of requested outputs.
    pub(super) fn derive(
        pruned: &PrunedGraph,
        variables: &[Scalar],
        program: &dyn Fn(&Graph, &[Want]) -> Program,
    ) -> Self {
        let all = &pruned.loops;
        let derive_loop = |(l, kept): (usize, &KeptLoop)| {
            // The values, then the derivatives of those that have any.
            let wanted = |values: &dyn Fn(&State) -> Scalar, more: Option<Scalar>, visible: &[VaryingState]| {
                let numbers = kept.states.iter().map(values).chain(more).map(Want::Value);
                let by: Vec<Scalar> =
                    variables.iter().copied().chain(visible.iter().map(|varying| varying.input)).collect();
                let slopes = kept.states.iter().filter(|state| state.varies).flat_map(|state| {
                    let value = values(state);
                    by.iter().map(move |&input| Want::Derivative(value, input.into()))
                });
                program(&pruned.g, &numbers.chain(slopes).collect::<Vec<_>>())
            };
            let visible_at_entry = visible_states(all, l);
            let entry = wanted(&|state| state.first, Some(kept.count), &visible_at_entry);
            let mut visible_in_iteration = visible_at_entry.clone();
            visible_in_iteration.extend(varying(all, l, |state| state.before));
            visible_in_iteration.extend(final_states(all, Some(l), all.len()));
            let iteration = wanted(&|state| state.next, kept.exit_flag, &visible_in_iteration);
            let (states, may_exit) = (kept.states.clone(), kept.exit_flag.is_some());
            LoopPrograms {
                within: kept.within,
                states,
                may_exit,
                entry,
                visible_at_entry,
                iteration,
                visible_in_iteration,
            }
        };
        let mut numbers: Vec<(Scalar, Rc<Program>)> = Vec::new();
        let extra_inputs = pruned.extra_inputs.iter().map(|(which, _)| {
            let ExtraInput::Element { index: ElementIndex::Computed(index), .. } = *which else {
                return (*which, None);
            };
            let known = numbers.iter().find(|(known, _)| *known == index).map(|(_, program)| program.clone());
            let program = known.unwrap_or_else(|| {
                let made = Rc::new(program(&pruned.g, &[Want::Value(index)]));
                numbers.push((index, made.clone()));
                made
            });
            (*which, Some(program))
        });
        Self {
            extra_inputs: extra_inputs.collect(),
            loops: all.iter().enumerate().map(derive_loop).collect(),
            constants: pruned.constants.clone(),
            variables: variables.len(),
            final_states: final_states(all, None, all.len()),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.loops.is_empty()
    }

    /// Returns the final states, after all loops, that have derivatives.
    pub(super) fn final_states(&self) -> impl Iterator<Item = Scalar> {
        self.final_states.iter().map(|varying| varying.input)
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
        for (which, program) in &self.extra_inputs {
            let input = match *which {
                ExtraInput::Iteration(l) => {
                    let iteration = counter_variable(l);
                    quote!((#iteration as ::core::primitive::#name))
                }
                ExtraInput::StateBefore(l, k) | ExtraInput::StateAfter(l, k) => {
                    let state = state_variable(l, k);
                    quote!(#state)
                }
                ExtraInput::Constant(index) => {
                    let path = &self.constants[index];
                    // The compiler reports another type at the name that the user wrote.
                    let written = path.segments.last().map_or_else(Span::call_site, |name| name.ident.span());
                    let value = quote_spanned!(written=> number_constant::<::core::primitive::#name, _>(#path));
                    number.constant(quote!(#private::#value), private)
                }
                ExtraInput::CastConstant(index) => {
                    let path = &self.constants[index];
                    number.constant(quote!(::core::primitive::f64::from(#path as ::core::primitive::#name)), private)
                }
                ExtraInput::Element { slice, index, number: component } => {
                    let ((called, element), value) = (&slices[slice], local("element"));
                    let mut numbers = Vec::new();
                    element.numbers(&quote!((*#value)), precision, &mut numbers);
                    let component = &numbers[component];
                    let index = match (index, program) {
                        (ElementIndex::Iteration(l, more), _) => {
                            let (iteration, size) = (counter_variable(l), Literal::u64_unsuffixed(more.unsigned_abs()));
                            match more {
                                0 => quote!(#iteration),
                                1.. => quote!(#iteration + #size),
                                _ => quote!(#iteration.wrapping_sub(#size)),
                            }
                        }
                        (ElementIndex::Computed(_), Some(program)) => {
                            let input = |i: usize| inputs[i].clone();
                            let body = Body { program, number, private, input: &input };
                            let (steps, results) = (body.steps(), body.results());
                            quote!({ #steps #(#results)* } as ::core::primitive::usize)
                        }
                        (ElementIndex::Constant(index), _) => Literal::usize_unsuffixed(index).into_token_stream(),
                        (ElementIndex::Computed(_), None) => unreachable!("a computed index has a program"),
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
        self.loops
            .iter()
            .fold(Count::default(), |count, programs| count + programs.entry.count() + programs.iteration.count())
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
        for (l, programs) in self.loops.iter().enumerate().filter(|(_, programs)| programs.within == within) {
            let states: Vec<Ident> = (0..programs.states.len()).map(|k| state_variable(l, k)).collect();
            let varying = programs.states.iter().enumerate().filter(|(_, state)| state.varies);
            let slopes: Vec<Ident> =
                varying.flat_map(|(k, _)| (0..self.variables).map(move |j| slope_variable(l, k, j))).collect();
            let block = |program: &Program, visible: &[VaryingState], has_more: bool, inner: TokenStream| {
                let body = Body { program, number, private, input };
                let (steps, results) = (body.steps(), body.results().collect::<Vec<_>>());
                let (values, rest) = program.outputs().split_at(programs.states.len() + usize::from(has_more));
                let chain = &ChainRule::new(&body);
                let chained = rest.chunks((self.variables + visible.len()).max(1)).flat_map(|row| {
                    let (direct, by_visible) = row.split_at(self.variables);
                    (0..self.variables).map(move |j| chain.derivative(direct[j], by_visible, visible, j))
                });
                let (chained, values) = (chained.collect::<Vec<_>>(), &results[..values.len()]);
                quote!({ #inner #steps (#(#values,)* #(#chained,)*) })
            };
            let (count, iteration) = (local(&format!("count{l}")), counter_variable(l));
            let entry = block(&programs.entry, &programs.visible_at_entry, true, TokenStream::new());
            let inner = self.code(Some(l), number, private, input);
            let of_iteration = block(&programs.iteration, &programs.visible_in_iteration, programs.may_exit, inner);
            let exit_flag = programs.may_exit.then(|| local("leaves"));
            let end = exit_flag.iter().map(|exit_flag| quote!(if #exit_flag > 0.0 { break; }));
            let (declared, exit_flag) = (exit_flag.iter().map(|exit_flag| quote!(let #exit_flag;)), exit_flag.iter());
            code.extend(quote! {
                let (#(mut #states,)* #count, #(mut #slopes,)*) = #entry;
                for #iteration in 0..(#count as ::core::primitive::usize) {
                    #(#declared)*
                    (#(#states,)* #(#exit_flag,)* #(#slopes,)*) = #of_iteration;
                    #(#end)*
                }
            });
        }
        code
    }
}

/// Applies the chain rule: combines a program's derivatives with respect to variables and to states.
struct ChainRule<'a> {
    body: &'a Body<'a>,
    /// For each value, `true` if it depends on a select.
    is_selected: Vec<bool>,
}

impl<'a> ChainRule<'a> {
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
    fn derivative(&self, direct: Value, by_states: &[Value], states: &[VaryingState], j: usize) -> TokenStream {
        let known = |value: Value| match self.body.program.ops()[value.index()] {
            Op::Constant(constant) => Some(constant.value()),
            _ => None,
        };
        let mut terms = Vec::new();
        if known(direct) != Some(0.0) {
            terms.push(self.body.operand(direct));
        }
        for (&by_state, &VaryingState { l, k, .. }) in by_states.iter().zip(states) {
            let (factor, slope) = (self.body.operand(by_state), slope_variable(l, k, j));
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

impl KeptLoops {
    /// Returns the code before the function's own program, and the program's outputs. Derivatives with respect to
    /// variables include those through the loops.
    pub(super) fn outputs_through_loops(
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
        let (by_states, flag) = rest.split_at(size * self.final_states.len());
        let chain = ChainRule::new(body);
        let chained = (0..count).flat_map(|j| (0..size).map(move |i| (i, j))).map(|(i, j)| {
            let by_states: Vec<Value> = by_states.iter().skip(i).step_by(size).copied().collect();
            chain.derivative(direct[size * j + i], &by_states, &self.final_states, j)
        });
        let outputs = results[..values.len()].iter().cloned().chain(chained);
        let outputs = outputs.chain(results[results.len() - flag.len()..].iter().cloned()).collect();
        (self.code(None, body.number, body.private, inputs), outputs)
    }
}

/// Variable of a loop's state.
fn state_variable(l: usize, k: usize) -> Ident {
    local(&format!("state{l}_{k}"))
}

/// Variable of the derivative of a loop's state with respect to variable `j`.
fn slope_variable(l: usize, k: usize, j: usize) -> Ident {
    local(&format!("slope{l}_{k}_{j}"))
}

/// Variable of a loop's iteration counter.
fn counter_variable(l: usize) -> Ident {
    local(&format!("round{l}"))
}
