//! Rules for scale factors; part of [`rules::SCALES`](crate::rules::SCALES).

use crate::{Graph, Scalar, ScalarNode, Vector, VectorNode};

fn scaled(g: &Graph, v: Vector) -> Option<(Scalar, Vector)> {
    match g.vector_node(v) {
        VectorNode::Scale(k, inner) => Some((k, inner)),
        _ => None,
    }
}

/// `v / |v| = (1 / |v|) v`: every use of the direction shares one reciprocal.
pub(crate) fn expand_normalize(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Normalize(inner) = g.vector_node(v) else { return None };
    let norm = g.norm(inner);
    let reciprocal = g.reciprocal(norm);
    Some(g.scale(reciprocal, inner))
}

/// `k (m v) = (k m) v`
pub(crate) fn merge(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (k, inner) = scaled(g, v)?;
    let (m, core) = scaled(g, inner)?;
    let product = g.mul(k, m);
    Some(g.scale(product, core))
}

/// `R (k v) = k (R v)`, and the same for perpendiculars and negation.
pub(crate) fn out_of_rotation(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (k, moved) = match g.vector_node(v) {
        VectorNode::Rotate(rotation, inner) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.rotate(rotation, core))
        }
        VectorNode::Perp(plane, inner) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.perp(plane, core))
        }
        VectorNode::Neg(inner) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.neg_vector(core))
        }
        _ => return None,
    };
    Some(g.scale(k, moved))
}

/// `(k v) · w = k (v · w)`
pub(crate) fn out_of_dot(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Dot(v, w) = g.scalar_node(s) else { return None };
    let (k, core, other) = match (scaled(g, v), scaled(g, w)) {
        (Some((k, core)), _) => (k, core, w),
        (None, Some((k, core))) => (k, core, v),
        (None, None) => return None,
    };
    let dot = g.dot(core, other);
    Some(g.mul(k, dot))
}
