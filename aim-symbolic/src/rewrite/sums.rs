//! Sums of vectors as lists of signed terms, and the rules for them that do not involve rotations.

use crate::{Graph, Vector, VectorNode};

/// Approximate limit on the number of terms into which a sum is expanded. Without it, shared partial sums could double
/// the number at each level.
pub(crate) const MOST_TERMS: usize = 64;

/// Returns the terms of a sum with their signs (`true` = subtracted).
pub(crate) fn terms(g: &Graph, v: Vector) -> Vec<(bool, Vector)> {
    fn collect(g: &Graph, v: Vector, negative: bool, root: bool, out: &mut Vec<(bool, Vector)>) {
        match g.vector_node(v) {
            _ if !root && (g.is_closed(v) || out.len() >= MOST_TERMS) => out.push((negative, v)),
            VectorNode::Add(a, b) => {
                collect(g, a, negative, false, out);
                collect(g, b, negative, false, out);
            }
            VectorNode::Sub(a, b) => {
                collect(g, a, negative, false, out);
                collect(g, b, !negative, false, out);
            }
            VectorNode::Neg(a) => collect(g, a, !negative, false, out),
            _ => out.push((negative, v)),
        }
    }
    let mut out = Vec::new();
    collect(g, v, false, true, &mut out);
    out
}

/// Returns the sum of `terms`.
pub(crate) fn sum(g: &mut Graph, terms: &[(bool, Vector)]) -> Vector {
    let mut total: Option<Vector> = None;
    for &(_, v) in terms.iter().filter(|(negative, _)| !negative) {
        total = Some(total.map_or(v, |t| g.add_vectors(t, v)));
    }
    for &(_, v) in terms.iter().filter(|(negative, _)| *negative) {
        total = Some(match total {
            Some(t) => g.sub_vectors(t, v),
            None => g.neg_vector(v),
        });
    }
    total.unwrap_or_else(|| g.constant_vector([0.0; 3]))
}

pub(crate) fn is_zero(g: &Graph, v: Vector) -> bool {
    g.constant_vector_of(v) == Some([0.0; 3])
}

pub(crate) fn is_sum(g: &Graph, v: Vector) -> bool {
    matches!(g.vector_node(v), VectorNode::Add(..) | VectorNode::Sub(..) | VectorNode::Neg(..))
}

/// Removes zeros and factors of ±1 from sums, scales, rotations and products.
pub(crate) fn fold_zero(g: &mut Graph, v: Vector) -> Option<Vector> {
    match g.vector_node(v) {
        VectorNode::Add(a, b) if is_zero(g, a) => Some(b),
        VectorNode::Add(a, b) | VectorNode::Sub(a, b) if is_zero(g, b) => Some(a),
        VectorNode::Sub(a, b) if is_zero(g, a) => Some(g.neg_vector(b)),
        VectorNode::Neg(a) | VectorNode::Rotate(_, a) | VectorNode::Perp(_, a) | VectorNode::Normalize(a)
            if is_zero(g, a) =>
        {
            Some(a)
        }
        VectorNode::Cross(a, b) if a == b || is_zero(g, a) || is_zero(g, b) => Some(g.constant_vector([0.0; 3])),
        VectorNode::Across(a, _) if is_zero(g, a) => Some(a),
        VectorNode::Neg(a) => match g.vector_node(a) {
            VectorNode::Neg(inner) => Some(inner),
            _ => g.constant_vector_of(a).map(|c| g.constant_vector(c.map(|c| -c))),
        },
        VectorNode::Scale(_, a) if is_zero(g, a) => Some(a),
        VectorNode::Scale(k, a) if g.constant_of(k) == Some(1.0) => Some(a),
        VectorNode::Scale(k, a) if g.constant_of(k) == Some(-1.0) => Some(g.neg_vector(a)),
        VectorNode::Scale(k, _) if g.constant_of(k) == Some(0.0) => Some(g.constant_vector([0.0; 3])),
        _ => None,
    }
}

/// `a + b − a = b`
pub(crate) fn cancel_terms(g: &mut Graph, v: Vector) -> Option<Vector> {
    if !is_sum(g, v) {
        return None;
    }
    let mut terms = terms(g, v);
    let (i, j) = (0..terms.len()).find_map(|i| {
        let (sign, term) = terms[i];
        let j = (i + 1..terms.len()).find(|&j| terms[j] == (!sign, term))?;
        Some((i, j))
    })?;
    terms.remove(j);
    terms.remove(i);
    Some(sum(g, &terms))
}
