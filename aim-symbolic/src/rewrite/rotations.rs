//! Rules that move rotations to where they cancel or cost least; [`ROTATIONS`](crate::rewrite::rules::ROTATIONS).

use crate::rewrite::sums::{is_sum, sum, terms};
use crate::{Graph, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// The outermost rotation of `v`, and what it rotates.
pub(crate) fn leading(g: &Graph, v: Vector) -> Option<(Rotation, Vector)> {
    match g.vector_node(v) {
        VectorNode::Rotate(rotation, inner) => Some((rotation, inner)),
        _ => None,
    }
}

fn is_forward(g: &Graph, rotation: Rotation) -> bool {
    !matches!(g.rotation_node(rotation), RotationNode::Transpose(_))
}

fn is_basis(g: &Graph, rotation: Rotation) -> bool {
    match g.rotation_node(rotation) {
        RotationNode::Basis(_) => true,
        RotationNode::Transpose(inner) => matches!(g.rotation_node(inner), RotationNode::Basis(_)),
        _ => false,
    }
}

/// Whether `v` is a constant vector after at most one rotation that is not a change of basis: nothing costs less.
fn is_turned_constant(g: &Graph, v: Vector) -> bool {
    match leading(g, v) {
        Some((rotation, inner)) if is_basis(g, rotation) => is_turned_constant(g, inner),
        Some((_, inner)) => g.constant_vector_of(inner).is_some(),
        None => g.constant_vector_of(v).is_some(),
    }
}

/// How many changes of basis stand before the rotation that pushed `v` forward and could be turned back instead;
/// `None` where there is none.
///
/// Only such vectors give up their rotation, and of several the one with the fewest changes of basis does, so that
/// nothing is turned back and forth.
fn pushed_below(g: &Graph, v: Vector) -> Option<usize> {
    let (rotation, inner) = leading(g, v)?;
    if is_basis(g, rotation) {
        let below = terms(g, inner).iter().filter_map(|&(_, term)| pushed_below(g, term)).min()?;
        return Some(below + 1);
    }
    is_forward(g, rotation).then_some(0)
}

/// `(A B) v = A (B v)`
pub(crate) fn split_composition(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (rotation, inner) = leading(g, v)?;
    let (outer, first) = match g.rotation_node(rotation) {
        RotationNode::Compose(a, b) => (a, b),
        RotationNode::Transpose(composed) => {
            let RotationNode::Compose(a, b) = g.rotation_node(composed) else { return None };
            (g.transpose(b), g.transpose(a))
        }
        _ => return None,
    };
    let once = g.rotate(first, inner);
    Some(g.rotate(outer, once))
}

/// `R Rᵀ v = v`
pub(crate) fn undo_rotation(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (outer, inner) = leading(g, v)?;
    let (rotation, core) = leading(g, inner)?;
    (g.transpose(rotation) == outer).then_some(core)
}

/// `R a + R b = R (a + b)`
pub(crate) fn common_rotation(g: &mut Graph, v: Vector) -> Option<Vector> {
    if !is_sum(g, v) {
        return None;
    }
    let mut terms = terms(g, v);
    let (i, j, rotation) = (0..terms.len()).find_map(|i| {
        let (rotation, _) = leading(g, terms[i].1)?;
        let j = (i + 1..terms.len()).find(|&j| leading(g, terms[j].1).is_some_and(|(r, _)| r == rotation))?;
        Some((i, j, rotation))
    })?;
    let (sign_j, term_j) = terms.remove(j);
    let (sign_i, term_i) = terms[i];
    let inner = [(sign_i, leading(g, term_i)?.1), (sign_j, leading(g, term_j)?.1)];
    let together = sum(g, &inner);
    terms[i] = (false, g.rotate(rotation, together));
    Some(sum(g, &terms))
}

/// `R v / |R v| = R (v / |v|)`
pub(crate) fn normalize_rotated(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Normalize(inner) = g.vector_node(v) else { return None };
    let (rotation, core) = leading(g, inner)?;
    let direction = g.normalize(core);
    Some(g.rotate(rotation, direction))
}

/// `Rᵀ (a + R b) = Rᵀ a + b`
pub(crate) fn turned_back(g: &mut Graph, rotation: Rotation, v: Vector) -> Vector {
    let (cores, rest): (Vec<_>, Vec<_>) =
        terms(g, v).into_iter().partition(|&(_, term)| leading(g, term).is_some_and(|(r, _)| r == rotation));
    let mut all: Vec<_> = cores.into_iter().filter_map(|(sign, term)| Some((sign, leading(g, term)?.1))).collect();
    if !rest.is_empty() {
        let back = g.transpose(rotation);
        let rest = sum(g, &rest);
        all.insert(0, (false, g.rotate(back, rest)));
    }
    sum(g, &all)
}

/// A rotation that a sum's norm does not see: `a + R b` is as long as `Rᵀ a + b`.
fn pulled(g: &mut Graph, v: Vector) -> Option<(Rotation, Vector)> {
    if !is_sum(g, v) {
        return None;
    }
    let pushed = terms(g, v).into_iter().filter_map(|(_, term)| Some((pushed_below(g, term)?, term)));
    let (_, term) = pushed.min_by_key(|&(below, _)| below)?;
    let (rotation, _) = leading(g, term)?;
    Some((rotation, turned_back(g, rotation, v)))
}

/// `(a + R b) / |a + R b| · R w = (Rᵀ a + b) / |Rᵀ a + b| · w`
pub(crate) fn dot_direction(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Dot(a, b) = g.scalar_node(s) else { return None };
    [(a, b), (b, a)].into_iter().find_map(|(direction, other)| {
        let VectorNode::Normalize(inner) = g.vector_node(direction) else { return None };
        let (rotation, w) = leading(g, other)?;
        let is_pushed = |&(_, term): &(bool, Vector)| leading(g, term).is_some_and(|(r, _)| r == rotation);
        if !is_sum(g, inner) || !terms(g, inner).iter().any(is_pushed) {
            return None;
        }
        if !is_basis(g, rotation) {
            g.cancel(rotation);
        }
        let back = turned_back(g, rotation, inner);
        let back = g.normalize(back);
        Some(g.dot(back, w))
    })
}

/// `|R v| = |v|`
pub(crate) fn norm_rotated(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Norm(v) = g.scalar_node(s) else { return None };
    let (_, core) = leading(g, v)?;
    Some(g.norm(core))
}

/// `|a + R b| = |Rᵀ a + b|`
pub(crate) fn norm_pulls(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Norm(v) = g.scalar_node(s) else { return None };
    let (_, turned_back) = pulled(g, v)?;
    Some(g.norm(turned_back))
}

/// `(a + R b)² = (Rᵀ a + b)²`
pub(crate) fn square_pulls(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Dot(v, w) = g.scalar_node(s) else { return None };
    let (_, turned_back) = if v == w { pulled(g, v)? } else { return None };
    Some(g.dot(turned_back, turned_back))
}

/// The sides of a dot that a rotation pushed forward, the one with the fewest changes of basis before it first.
fn pushed_sides(g: &Graph, s: Scalar) -> Vec<(Vector, Vector)> {
    let ScalarNode::Dot(a, b) = g.scalar_node(s) else { return Vec::new() };
    let mut sides: Vec<_> =
        [(a, b), (b, a)].into_iter().filter_map(|(v, pushed)| Some((pushed_below(g, pushed)?, v, pushed))).collect();
    sides.sort_by_key(|&(below, ..)| below);
    sides.into_iter().map(|(_, v, pushed)| (v, pushed)).collect()
}

fn turn_other_side(g: &mut Graph, v: Vector, pushed: Vector) -> Option<Scalar> {
    let (rotation, w) = leading(g, pushed)?;
    let back = turned_back(g, rotation, v);
    Some(g.dot(back, w))
}

/// `(a + R b) · R w = (Rᵀ a + b) · w`
pub(crate) fn dot_cancels(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let (v, pushed) = pushed_sides(g, s).into_iter().find(|&(v, pushed)| {
        let (outer, _) = leading(g, pushed).unzip();
        terms(g, v).iter().any(|&(_, t)| leading(g, t).unzip().0 == outer)
    })?;
    turn_other_side(g, v, pushed)
}

/// `v · R w = Rᵀ v · w`, unless `R w` is a rotated constant, which costs least.
pub(crate) fn dot_other_side(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let (v, pushed) = pushed_sides(g, s).into_iter().find(|&(_, pushed)| !is_turned_constant(g, pushed))?;
    turn_other_side(g, v, pushed)
}
