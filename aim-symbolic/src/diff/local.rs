//! Local slopes: the derivatives of functions of one or two numbers by these numbers, computed once for all sweeps that
//! pass through them.
//!
//! A sweep multiplies its own adjoint or tangent by the partial derivative of each operation on its way. Several sweeps
//! through the same operations do so again and again, where a product with the slope of the whole function will do.

use rustc_hash::FxHashMap;

use crate::diff::differential::{Differential, Linear, ReciprocalPlacement, term};
use crate::diff::partial::Partials;
use crate::ir::node::Node;
use crate::ir::table::NodeSet;
use crate::{Graph, Op, Scalar, ScalarNode};

/// Largest number of arguments of a function whose slopes are computed on their own.
const MOST_ARGUMENTS: usize = 2;

/// The slopes of functions by their arguments.
#[derive(Default)]
pub(crate) struct LocalSlopes {
    known: FxHashMap<Scalar, Vec<(Scalar, Scalar)>>,
}

impl LocalSlopes {
    /// Returns the slopes of the functions in `order`, in which each node comes after its operands. An operation that
    /// depends on more numbers is an argument of those that use it.
    pub(crate) fn of(g: &mut Graph, order: &[Node], active: &NodeSet) -> Self {
        let mut slopes = Self::default();
        for &node in order {
            if let Node::Scalar(s) = node
                && active.contains(node)
                && g.is_operation(s)
                && g.plane_angle(s).is_none()
                && let Some(found) = slopes.of_operation(g, s, active)
            {
                slopes.known.insert(s, found);
            }
        }
        slopes
    }

    fn of_operation(&self, g: &mut Graph, s: Scalar, active: &NodeSet) -> Option<Vec<(Scalar, Scalar)>> {
        let mut slopes: Vec<(Scalar, Scalar)> = Vec::new();
        for (part, partial) in g.partials(s, |part| active.contains(part.into())) {
            let by_itself = [(part, g.constant(1.0))];
            for &(argument, slope) in self.known.get(&part).map_or(&by_itself[..], Vec::as_slice) {
                let change = g.times(slope, partial);
                match slopes.iter_mut().find(|(known, _)| *known == argument) {
                    Some((_, so_far)) => *so_far = g.add(*so_far, change),
                    None => slopes.push((argument, change)),
                }
            }
        }
        (slopes.len() <= MOST_ARGUMENTS).then_some(slopes)
    }

    /// Returns the differential of a node, for a function by its arguments.
    pub(crate) fn differential(
        &self,
        g: &mut Graph,
        node: Node,
        active: &NodeSet,
        placement: ReciprocalPlacement,
    ) -> Differential {
        let known = if let Node::Scalar(s) = node { self.known.get(&s) } else { None };
        match known {
            Some(slopes) => {
                let by = |&(argument, slope)| term(argument, [Linear::Factor(Partials::Factor(slope))]);
                Differential { terms: slopes.iter().map(by).collect(), after: None }
            }
            None => g.differential(node, active, placement),
        }
    }
}

impl Graph {
    /// Returns `true` for an operation on numbers. A select is none: it takes no product to pass through it.
    fn is_operation(&self, s: Scalar) -> bool {
        match self.scalar_node(s) {
            ScalarNode::Op(Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::SelectLess(..)) => false,
            ScalarNode::Op(_) | ScalarNode::Reciprocal(_) | ScalarNode::Stumpff(..) | ScalarNode::Arc(..) => true,
            _ => false,
        }
    }
}
