//! Rules that move a whole calculation into another frame. If several vectors are rotated back by the same rotation,
//! the few vectors that they meet are rotated forward instead. [`rules::FRAMES`](crate::rewrite::rules::FRAMES).
//!
//! They apply only to the rotations set by [`Graph::set_inner_frames`], and the result is kept only if it costs less than the
//! original.

use crate::rewrite::rotations::{leading, operation_before, turned_back};
use crate::rewrite::sums::{is_sum, terms};
use crate::{Graph, Plane, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// If the outermost rotation of `v` is the inverse of a kept rotation, returns that inverse and the vector inside.
fn turned(g: &Graph, v: Vector) -> Option<(Rotation, Vector)> {
    let (back, inner) = leading(g, v)?;
    let RotationNode::Transpose(rotation) = g.rotation_node(back) else { return None };
    g.is_inner_frame(rotation).then_some((back, inner))
}

/// `Rᵀ a + b = Rᵀ (a + R b)`
pub(crate) fn sum_in_frame(g: &mut Graph, v: Vector) -> Option<Vector> {
    if !is_sum(g, v) {
        return None;
    }
    let (back, _) = terms(g, v).into_iter().find_map(|(_, term)| turned(g, term))?;
    let inner = turned_back(g, back, v);
    Some(g.rotate(back, inner))
}

/// `k Rᵀ v = Rᵀ (k v)`, and likewise for directions, parts across a direction, negations and the perpendicular of R's
/// plane.
pub(crate) fn operation_in_frame(g: &mut Graph, v: Vector) -> Option<Vector> {
    if let VectorNode::Perp(plane, inner) = g.vector_node(v) {
        let (back, inner) = turned(g, inner)?;
        let moved = g.perp(plane, inner);
        return turns_in(g, back, plane).then(|| g.rotate(back, moved));
    }
    operation_before(g, v, turned)
}

/// Returns `true` if `back` is the inverse of a turn in this plane.
fn turns_in(g: &Graph, back: Rotation, plane: Plane) -> bool {
    matches!(g.untransposed(back), (RotationNode::Turn(own, _), true) if own == plane)
}

/// `Rᵀ v · w = v · R w`, `|Rᵀ v| = |v|`
pub(crate) fn number_in_frame(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    match g.scalar_node(s) {
        ScalarNode::Dot(a, b) => [(a, b), (b, a)].into_iter().find_map(|(v, w)| {
            let (back, inner) = turned(g, v)?;
            let other = turned_back(g, back, w);
            Some(g.dot(inner, other))
        }),
        ScalarNode::Norm(v) => {
            let (_, inner) = turned(g, v)?;
            Some(g.norm(inner))
        }
        _ => None,
    }
}
