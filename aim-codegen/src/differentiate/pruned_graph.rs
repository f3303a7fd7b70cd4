//! [`ValueAndVariables`] and [`PrunedGraph`]: the result of running a function, without the nodes that it does not use.

use aim_symbolic::{Graph, Node, Scalar, Vector, Want};

use super::lower::{Algebra, ElementIndex, ExtraInput, KeptLoop, State};

/// The numbers that companions are derived from.
pub(super) struct ValueAndVariables {
    /// Numbers of the value.
    pub(super) values: Vec<Scalar>,
    /// The value, if it is a vector.
    pub(super) vector: Option<Vector>,
    pub(super) variables: Vec<Scalar>,
}

impl ValueAndVariables {
    /// Returns the derivatives of the value's numbers with respect to a final state of a loop.
    pub(super) fn derivatives_by(&self, x: Scalar) -> impl Iterator<Item = Want> {
        self.values.iter().map(move |&value| Want::Derivative(value, x.into()))
    }
}

/// Graph that holds only the nodes that the value and its loops need.
pub(super) struct PrunedGraph {
    pub(super) g: Graph,
    pub(super) loops: Vec<KeptLoop>,
    pub(super) extra_inputs: Vec<(ExtraInput, Scalar)>,
    pub(super) constants: Vec<syn::Path>,
}

impl PrunedGraph {
    /// Removes all nodes that are not needed, and updates `function` and `flag` to the new graph.
    pub(super) fn new(algebra: &Algebra, function: &mut ValueAndVariables, flag: &mut Option<Scalar>) -> Self {
        let mut nodes: Vec<Node> = function.vector.into_iter().map(Node::Vector).collect();
        let states = algebra.loops.iter().flat_map(|kept| &kept.states);
        let of_states = states.flat_map(|state| [state.first, state.before, state.next, state.after]);
        let of_loops = algebra.loops.iter().flat_map(|kept| [kept.count].into_iter().chain(kept.exit_flag));
        let of_function = function.values.iter().chain(&function.variables).copied().chain(*flag);
        nodes.extend(of_function.chain(of_loops).chain(of_states).map(Node::Scalar));
        let optional: Vec<Scalar> = algebra.extra_inputs.iter().map(|(_, input)| *input).collect();
        let pruned = loop {
            let pruned = algebra.g.pruned(&nodes, &optional);
            let has = |s: Scalar| pruned.scalar(s).is_some();
            // An element with a computed index needs the index.
            let numbers = algebra.extra_inputs.iter().filter_map(|(which, input)| match *which {
                ExtraInput::Element { index: ElementIndex::Computed(index), .. } if has(*input) && !has(index) => {
                    Some(index)
                }
                _ => None,
            });
            let more: Vec<Node> = numbers.map(Node::Scalar).collect();
            if more.is_empty() {
                break pruned;
            }
            nodes.extend(more);
        };
        let at = |s: Scalar| pruned.scalar(s).expect("it is needed");
        function.values.iter_mut().chain(&mut function.variables).chain(flag).for_each(|s| *s = at(*s));
        function.vector = function.vector.and_then(|v| pruned.vector(v));
        let of_state = |&State { first, before, next, after, varies }: &State| {
            let [first, before, next, after] = [first, before, next, after].map(at);
            State { first, before, next, after, varies }
        };
        let of_loop = |kept: &KeptLoop| KeptLoop {
            within: kept.within,
            count: at(kept.count),
            states: kept.states.iter().map(of_state).collect(),
            exit_flag: kept.exit_flag.map(at),
        };
        let of_extra_input = |&(which, input): &(ExtraInput, Scalar)| {
            let which = match which {
                ExtraInput::Element { slice, index: ElementIndex::Computed(index), number } => {
                    ExtraInput::Element { slice, index: ElementIndex::Computed(pruned.scalar(index)?), number }
                }
                which => which,
            };
            Some((which, pruned.scalar(input)?))
        };
        let loops = algebra.loops.iter().map(of_loop).collect();
        let extra_inputs = algebra.extra_inputs.iter().filter_map(of_extra_input).collect();
        Self { loops, extra_inputs, constants: algebra.constants.clone(), g: pruned.graph }
    }
}
