//! Rules for scale factors and signs. Part of [`DIRECTIONS`](crate::rewrite::rules::DIRECTIONS) and
//! [`SCALES`](crate::rewrite::rules::SCALES).

use crate::rewrite::sums::{is_sum, sum, terms};
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

pub(crate) fn scaled(g: &Graph, v: Vector) -> Option<(Scalar, Vector)> {
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

/// `k (m v) = (k m) v`, if `m v` is used nowhere else.
pub(crate) fn merge(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (_, inner) = scaled(g, v)?;
    if g.is_closed(inner) { None } else { merged(g, v) }
}

/// `k (m v) = (k m) v`, if `m v` is also used elsewhere.
pub(crate) fn merge_shared(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (_, inner) = scaled(g, v)?;
    if g.is_closed(inner) { merged(g, v) } else { None }
}

fn merged(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (k, inner) = scaled(g, v)?;
    let (m, core) = scaled(g, inner)?;
    let product = g.mul(k, m);
    Some(g.scale(product, core))
}

fn negated(g: &Graph, v: Vector) -> Option<Vector> {
    match g.vector_node(v) {
        VectorNode::Neg(inner) => Some(inner),
        _ => None,
    }
}

/// `(−v) · w = −(v · w)`, `|−v| = |v|`
pub(crate) fn sign_out_of_number(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    match g.scalar_node(s) {
        ScalarNode::Dot(v, w) => {
            let (positive, other) = match (negated(g, v), negated(g, w)) {
                (Some(v), _) => (v, w),
                (None, Some(w)) => (v, w),
                (None, None) => return None,
            };
            let dot = g.dot(positive, other);
            Some(g.neg(dot))
        }
        ScalarNode::Norm(v) => {
            let v = negated(g, v)?;
            Some(g.norm(v))
        }
        ScalarNode::Component(v, axis) => {
            let v = negated(g, v)?;
            let component = g.component(v, axis);
            Some(g.neg(component))
        }
        _ => None,
    }
}

/// `R (k v) = k (R v)`, and likewise for perpendiculars, parts across a direction, cross products and solutions.
pub(crate) fn out_of_operation(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (k, moved) = match g.vector_node(v) {
        VectorNode::Rotate(rotation, inner) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.rotate(rotation, core))
        }
        VectorNode::Perp(plane, inner) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.perp(plane, core))
        }
        VectorNode::Across(inner, unit) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.across(core, unit))
        }
        VectorNode::Cross(a, b) => match (scaled(g, a), scaled(g, b)) {
            (Some((k, core)), _) => (k, g.cross(core, b)),
            (None, Some((k, core))) => (k, g.cross(a, core)),
            (None, None) => return None,
        },
        VectorNode::Solve(m, inner) => {
            let (k, core) = scaled(g, inner)?;
            (k, g.solve(m, core))
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

/// Returns the terms of a sum, each as sign, factor (`None` for 1) and vector.
fn weighted(g: &mut Graph, v: Vector) -> Vec<(bool, Option<Scalar>, Vector)> {
    terms(g, v)
        .into_iter()
        .map(|(negative, term)| match scaled(g, term) {
            Some((k, inner)) => (negative, Some(k), inner),
            None => (negative, None, term),
        })
        .collect()
}

fn signed(g: &mut Graph, negative: bool, k: Option<Scalar>) -> Scalar {
    let k = k.unwrap_or_else(|| g.constant(1.0));
    if negative { g.neg(k) } else { k }
}

/// Returns the sum `v` with its terms i and j replaced by `together`.
pub(crate) fn joined(g: &mut Graph, v: Vector, (i, j): (usize, usize), together: (bool, Vector)) -> Vector {
    let mut all = terms(g, v);
    all.remove(j);
    all[i] = together;
    sum(g, &all)
}

/// `c = cₖ (c / cₖ)` with cₖ the largest component of a constant vector: saves a multiplication in each of its
/// products.
pub(crate) fn constant_scale(g: &mut Graph, v: Vector) -> Option<Vector> {
    let c = g.constant_vector_of(v)?;
    let largest = c.into_iter().fold(0.0, |largest: f64, c| if c.abs() > largest.abs() { c } else { largest });
    if largest == 0.0 || largest.abs() == 1.0 || c.iter().filter(|&&c| c != 0.0).count() < 2 {
        return None;
    }
    let unit = g.constant_vector(c.map(|c| c / largest));
    let factor = g.constant(largest);
    Some(g.scale(factor, unit))
}

/// `k (v − m w) + n w = k v + (n − k m) w`, with a common factor of `n` and `m` taken out
pub(crate) fn spread(g: &mut Graph, v: Vector) -> Option<Vector> {
    if !is_sum(g, v) {
        return None;
    }
    let all = weighted(g, v);
    let difference = |g: &Graph, inner: Vector| match g.vector_node(inner) {
        VectorNode::Sub(v, along) => scaled(g, along).map(|(m, w)| (v, m, w)),
        _ => None,
    };
    let (i, j, (core, m, w)) = (0..all.len()).find_map(|i| {
        let taken_apart = difference(g, all[i].2)?;
        let j = (0..all.len()).find(|&j| j != i && all[j].2 == taken_apart.2)?;
        Some((i, j, taken_apart))
    })?;
    let (k, n) = (signed(g, all[i].0, all[i].1), signed(g, all[j].0, all[j].1));
    let first = g.scale(k, core);
    let rest = match common_part(g, n, m) {
        Some((common, n, m)) => {
            let product = g.mul(k, m);
            let rest = g.sub(n, product);
            g.mul(common, rest)
        }
        None => {
            let product = g.mul(k, m);
            g.sub(n, product)
        }
    };
    let second = g.scale(rest, w);
    let mut kept: Vec<_> = terms(g, v);
    kept[i] = (false, first);
    kept[j] = (false, second);
    Some(sum(g, &kept))
}

/// Returns a common factor of both products, and the remaining factors of each.
fn common_part(g: &mut Graph, a: Scalar, b: Scalar) -> Option<(Scalar, Scalar, Scalar)> {
    let factors = factors(g, a);
    let (common, rest_of_b) = factors.into_iter().find_map(|f| Some((f, without(g, b, f)?)))?;
    let rest_of_a = without(g, a, common)?;
    Some((common, rest_of_a, rest_of_b))
}

/// Returns the factors of a product, expanded to a limited depth. Signs are ignored.
pub(crate) fn factors(g: &Graph, product: Scalar) -> Vec<Scalar> {
    fn collect(g: &Graph, product: Scalar, depth: u32, out: &mut Vec<Scalar>) {
        match g.scalar_node(product) {
            ScalarNode::Op(Op::Mul(a, b)) if depth > 0 => {
                collect(g, a, depth - 1, out);
                collect(g, b, depth - 1, out);
            }
            ScalarNode::Op(Op::Neg(a)) if depth > 0 => collect(g, a, depth - 1, out),
            _ => out.push(product),
        }
    }
    let mut out = Vec::new();
    collect(g, product, DEEPEST_PRODUCT, &mut out);
    out
}

/// Limit on the depth to which products are expanded.
const DEEPEST_PRODUCT: u32 = 5;

/// Returns `product` without one of its factors, or `None` if it lacks that factor.
fn without(g: &mut Graph, product: Scalar, factor: Scalar) -> Option<Scalar> {
    without_within(g, product, factor, DEEPEST_PRODUCT)
}

fn without_within(g: &mut Graph, product: Scalar, factor: Scalar, depth: u32) -> Option<Scalar> {
    if product == factor {
        return Some(g.constant(1.0));
    }
    let deeper = depth.checked_sub(1)?;
    match g.scalar_node(product) {
        ScalarNode::Op(Op::Mul(a, b)) => match without_within(g, a, factor, deeper) {
            Some(a) => Some(g.mul(a, b)),
            None => without_within(g, b, factor, deeper).map(|b| g.mul(a, b)),
        },
        ScalarNode::Op(Op::Neg(a)) => without_within(g, a, factor, deeper).map(|a| g.neg(a)),
        _ => None,
    }
}
