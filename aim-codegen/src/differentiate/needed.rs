//! [`Stated`] and [`Needed`]: the result of running a function, without the nodes that it does not use.

use aim_symbolic::{Graph, Node, Scalar, Vector, Want};

use super::lower::{Algebra, At, KeptLoop, Outside, State};

/// The numbers that companions are derived from.
pub(super) struct Stated {
    /// Numbers of the value.
    pub(super) values: Vec<Scalar>,
    /// The value, if it is a vector.
    pub(super) vector: Option<Vector>,
    pub(super) variables: Vec<Scalar>,
}

impl Stated {
    /// Returns the derivatives of the value's numbers with respect to a final state of a loop.
    pub(super) fn derivatives_by(&self, x: Scalar) -> impl Iterator<Item = Want> {
        self.values.iter().map(move |&value| Want::Derivative(value, x.into()))
    }
}

/// Graph that holds only the nodes that the value and its loops need.
pub(super) struct Needed {
    pub(super) g: Graph,
    pub(super) loops: Vec<KeptLoop>,
    pub(super) outside: Vec<(Outside, Scalar)>,
    pub(super) constants: Vec<syn::Path>,
}

impl Needed {
    /// Removes all nodes that are not needed, and updates `stated` and `flag` to the new graph.
    pub(super) fn of(algebra: &Algebra, stated: &mut Stated, flag: &mut Option<Scalar>) -> Self {
        let mut nodes: Vec<Node> = stated.vector.into_iter().map(Node::Vector).collect();
        let states = algebra.loops.iter().flat_map(|kept| &kept.states);
        let of_states = states.flat_map(|state| [state.first, state.before, state.next, state.after]);
        let of_loops = algebra.loops.iter().flat_map(|kept| [kept.count].into_iter().chain(kept.leaves));
        let of_function = stated.values.iter().chain(&stated.variables).copied().chain(*flag);
        nodes.extend(of_function.chain(of_loops).chain(of_states).map(Node::Scalar));
        let optional: Vec<Scalar> = algebra.outside.iter().map(|(_, input)| *input).collect();
        let pruned = loop {
            let pruned = algebra.g.pruned(&nodes, &optional);
            let has = |s: Scalar| pruned.scalar(s).is_some();
            // An element with a computed index needs the index.
            let numbers = algebra.outside.iter().filter_map(|(which, input)| match *which {
                Outside::Element { at: At::Chosen(index), .. } if has(*input) && !has(index) => Some(index),
                _ => None,
            });
            let more: Vec<Node> = numbers.map(Node::Scalar).collect();
            if more.is_empty() {
                break pruned;
            }
            nodes.extend(more);
        };
        let at = |s: Scalar| pruned.scalar(s).expect("it is needed");
        stated.values.iter_mut().chain(&mut stated.variables).chain(flag).for_each(|s| *s = at(*s));
        stated.vector = stated.vector.and_then(|v| pruned.vector(v));
        let of_state = |&State { first, before, next, after, varies }: &State| {
            let [first, before, next, after] = [first, before, next, after].map(at);
            State { first, before, next, after, varies }
        };
        let of_loop = |kept: &KeptLoop| KeptLoop {
            within: kept.within,
            count: at(kept.count),
            states: kept.states.iter().map(of_state).collect(),
            leaves: kept.leaves.map(at),
        };
        let of_outside = |&(which, input): &(Outside, Scalar)| {
            let which = match which {
                Outside::Element { slice, at: At::Chosen(index), number } => {
                    Outside::Element { slice, at: At::Chosen(pruned.scalar(index)?), number }
                }
                which => which,
            };
            Some((which, pruned.scalar(input)?))
        };
        let loops = algebra.loops.iter().map(of_loop).collect();
        let outside = algebra.outside.iter().filter_map(of_outside).collect();
        Self { loops, outside, constants: algebra.constants.clone(), g: pruned.graph }
    }
}
