//! Rules for vectors along a direction or perpendicular to it. Part of [`WORDING`](crate::rewrite::rules::WORDING),
//! [`DIRECTIONS`](crate::rewrite::rules::DIRECTIONS) and [`SCALES`](crate::rewrite::rules::SCALES).

use crate::rewrite::scaling::scaled;
use crate::rewrite::sums::{is_sum, is_zero, sum, terms};
use crate::{Graph, Op, Scalar, ScalarNode, Unit, Vector, VectorNode};

/// Returns `true` if `k` is `1 / |v|`.
fn is_reciprocal_norm(g: &Graph, k: Scalar, v: Vector) -> bool {
    let norm = match g.scalar_node(k) {
        ScalarNode::Reciprocal(norm) => norm,
        ScalarNode::Op(Op::Div(one, norm)) if g.constant_of(one) == Some(1.0) => norm,
        _ => return false,
    };
    g.scalar_node(norm) == ScalarNode::Norm(v)
}

/// `(1 / |v|) v = v / |v|`
pub(crate) fn recognize_direction(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Scale(k, inner) = g.vector_node(v) else { return None };
    is_reciprocal_norm(g, k, inner).then(|| g.normalize(inner).into())
}

/// `√(v · v) = |v|`
pub(crate) fn root_of_square(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Op(Op::Sqrt(square)) = g.scalar_node(s) else { return None };
    let ScalarNode::Dot(v, w) = g.scalar_node(square) else { return None };
    (v == w).then(|| g.norm(v))
}

/// `|v| |v| = v · v`, also as `k |v| |v|`: needs no root, and has derivatives where `v` is 0.
pub(crate) fn square_of_norm(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Op(Op::Mul(a, b)) = g.scalar_node(s) else { return None };
    let vector_of = |g: &Graph, s: Scalar| match g.scalar_node(s) {
        ScalarNode::Norm(v) => Some(v),
        _ => None,
    };
    [(a, b), (b, a)].into_iter().find_map(|(norm, other)| {
        let v = vector_of(g, norm)?;
        if other == norm {
            return Some(g.dot(v, v));
        }
        let ScalarNode::Op(Op::Mul(c, d)) = g.scalar_node(other) else { return None };
        let rest = [(c, d), (d, c)].into_iter().find_map(|(one, rest)| (one == norm).then_some(rest))?;
        let square = g.dot(v, v);
        Some(g.mul(rest, square))
    })
}

/// `a / |v| = a (1 / |v|)`, guarded like every division by a length; `v · w / |v|` becomes a dot product with a
/// direction.
pub(crate) fn guard_division(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Op(Op::Div(a, norm)) = g.scalar_node(s) else { return None };
    let ScalarNode::Norm(v) = g.scalar_node(norm) else { return None };
    if let ScalarNode::Dot(x, y) = g.scalar_node(a)
        && let Some(other) = [(x, y), (y, x)].into_iter().find_map(|(one, other)| (one == v).then_some(other))
    {
        let direction = g.normalize(v);
        return Some(g.dot(direction, other));
    }
    let reciprocal = g.reciprocal(norm);
    Some(if g.constant_of(a) == Some(1.0) { reciprocal } else { g.mul(a, reciprocal) })
}

/// Returns `v` as a unit vector if it is known to have length 1.
pub(crate) fn as_unit(g: &Graph, v: Vector) -> Option<Unit> {
    let is_unit = match g.vector_node(v) {
        VectorNode::Normalize(_) => true,
        VectorNode::Rotate(_, inner) | VectorNode::Neg(inner) => as_unit(g, inner).is_some(),
        _ => g.constant_vector_of(v).is_some_and(|c| (c.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-15),
    };
    is_unit.then_some(Unit(v))
}

/// `|v × u| = |v − (v · u) u|`
///
/// If `u` is the direction of a zero vector, and so 0, the left side is 0 and the right side `|v|`. This change of
/// value is accepted: both are finite, and a missing direction has no meaningful cross product.
pub(crate) fn norm_of_cross(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Norm(cross) = g.scalar_node(s) else { return None };
    let VectorNode::Cross(a, b) = g.vector_node(cross) else { return None };
    let (v, u) = [(a, b), (b, a)].into_iter().find_map(|(v, u)| Some((v, as_unit(g, u)?)))?;
    let across = g.across(v, u);
    Some(g.norm(across))
}

/// `|u| = 1`, `u · u = 1`, `(u − v)² = 2 − 2 u · v` for directions. A direction that is 0 contributes 0 instead of 1.
pub(crate) fn length_of_direction(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let v = match g.scalar_node(s) {
        ScalarNode::Dot(v, w) if v == w => v,
        ScalarNode::Norm(v) => return as_unit(g, v).map(|u| number_of(g, &[u], 0.0)),
        _ => return None,
    };
    if let Some(u) = as_unit(g, v) {
        return Some(number_of(g, &[u], 0.0));
    }
    let [(first, a), (second, b)] = terms(g, v)[..] else { return None };
    let (a, b) = (as_unit(g, a)?, as_unit(g, b)?);
    let (squares, dot) = (number_of(g, &[a, b], 0.0), g.dot(a, b));
    let twice = g.twice(dot);
    Some(if first == second { g.add(squares, twice) } else { g.sub(squares, twice) })
}

/// Returns `more` plus the number of these directions that are not 0.
fn number_of(g: &mut Graph, directions: &[Unit], more: f64) -> Scalar {
    let Some((&Unit(u), rest)) = directions.split_first() else { return g.constant(more) };
    match g.vector_node(u) {
        VectorNode::Rotate(_, inner) | VectorNode::Neg(inner) => {
            let unturned: Vec<Unit> = [Unit(inner)].into_iter().chain(rest.iter().copied()).collect();
            number_of(g, &unturned, more)
        }
        VectorNode::Normalize(v) => {
            let (tiny, length) = (g.intern_scalar(ScalarNode::Op(Op::Tiny)), g.norm(v));
            let [one, none] = [more + 1.0, more].map(|more| number_of(g, rest, more));
            g.select_less(tiny, length, one, none)
        }
        _ => number_of(g, rest, more + 1.0),
    }
}

/// Returns `true` if `v` is recognisably a multiple of `u`.
fn is_along(g: &Graph, v: Vector, u: Vector) -> bool {
    v == u
        || g.vector_node(u) == VectorNode::Normalize(v)
        || match g.vector_node(v) {
            VectorNode::Scale(_, inner) | VectorNode::Neg(inner) => is_along(g, inner, u),
            VectorNode::Normalize(inner) => inner == u,
            _ => false,
        }
}

/// Returns `true` if `v` is recognisably perpendicular to `u`.
pub(crate) fn is_across(g: &Graph, v: Vector, u: Vector) -> bool {
    is_across_within(g, v, u, DEEPEST_LOOK)
}

/// Limit on the recursion depth of [`is_across`].
const DEEPEST_LOOK: u32 = 8;

fn is_across_within(g: &Graph, v: Vector, u: Vector, depth: u32) -> bool {
    let Some(depth) = depth.checked_sub(1) else { return false };
    match g.vector_node(v) {
        VectorNode::Across(_, own) => Vector::from(own) == u,
        VectorNode::Scale(_, inner) | VectorNode::Neg(inner) | VectorNode::Normalize(inner) => {
            is_across_within(g, inner, u, depth)
        }
        VectorNode::Sub(a, b) if cfg!(not(aim_small)) && is_part_along(g, b, a, u) => true,
        VectorNode::Add(a, b) | VectorNode::Sub(a, b) => {
            is_across_within(g, a, u, depth) && is_across_within(g, b, u, depth)
        }
        VectorNode::Perp(_, inner) => is_along(g, inner, u),
        VectorNode::Cross(a, b) => is_along(g, a, u) || is_along(g, b, u),
        _ => is_zero(g, v),
    }
}

/// Returns `true` if `v` is the part of `whole` along `u`, (whole · u)/(u · u) u.
fn is_part_along(g: &Graph, v: Vector, whole: Vector, u: Vector) -> bool {
    let is_dot = |s, a: Vector, b: Vector| g.scalar_node(s) == ScalarNode::Dot(a.min(b), a.max(b));
    scaled(g, v).is_some_and(|(k, along)| {
        along == u
            && matches!(g.scalar_node(k), ScalarNode::Op(Op::Div(dot, square)) if is_dot(dot, whole, u) && is_dot(square, u, u))
    })
}

/// `v − (v · u) u` becomes the part of v perpendicular to the direction u.
pub(crate) fn recognize_across(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Sub(whole, along) = g.vector_node(v) else { return None };
    let (k, u) = scaled(g, along)?;
    let unit = as_unit(g, u)?;
    (g.dot(whole, u) == k).then(|| g.across(whole, unit))
}

fn as_across(g: &Graph, v: Vector) -> Option<(Vector, Unit)> {
    match g.vector_node(v) {
        VectorNode::Across(inner, u) => Some((inner, u)),
        _ => None,
    }
}

/// `v − (v · u) u = v` if `v · u = 0`
pub(crate) fn across_of_across(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (inner, u) = as_across(g, v)?;
    is_across(g, inner, u.into()).then_some(inner)
}

/// Drops the terms along the direction, keeps the terms perpendicular to it, and takes the part across of the rest.
pub(crate) fn across_of_sum(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (inner, u) = as_across(g, v)?;
    if !is_sum(g, inner) {
        return None;
    }
    let mut kept = Vec::new();
    let mut rest = Vec::new();
    for term in terms(g, inner) {
        if is_across(g, term.1, u.into()) {
            kept.push(term);
        } else if !is_along(g, term.1, u.into()) {
            rest.push(term);
        }
    }
    if kept.len() + rest.len() == terms(g, inner).len() && kept.is_empty() {
        return None;
    }
    if !rest.is_empty() {
        let rest = sum(g, &rest);
        kept.push((false, g.across(rest, u)));
    }
    Some(sum(g, &kept))
}

/// Returns `v` without scale factors and signs, for comparison with other directions.
fn axis(g: &Graph, v: Vector) -> Vector {
    match g.vector_node(v) {
        VectorNode::Scale(_, inner) | VectorNode::Neg(inner) => axis(g, inner),
        _ => v,
    }
}

/// `(a + k u) · w = a · w` if `w · u = 0`: terms perpendicular to the other side drop out.
pub(crate) fn dot_along_across(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Dot(a, b) = g.scalar_node(s) else { return None };
    [(a, b), (b, a)].into_iter().find_map(|(v, w)| {
        let all = terms(g, v);
        let kept: Vec<_> = all.iter().copied().filter(|&(_, t)| !are_square(g, t, w)).collect();
        if kept.len() == all.len() {
            return None;
        }
        if kept.is_empty() {
            return Some(g.constant(0.0));
        }
        let kept = sum(g, &kept);
        Some(g.dot(kept, w))
    })
}

/// `(a × b) × c = (a · c) b − (b · c) a`, if one of the two terms is 0.
pub(crate) fn cross_of_cross(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Cross(left, right) = g.vector_node(v) else { return None };
    [(left, right, false), (right, left, true)].into_iter().find_map(|(cross, c, is_swapped)| {
        let VectorNode::Cross(a, b) = g.vector_node(cross) else { return None };
        let [one, other] = [(a, b, is_swapped), (b, a, !is_swapped)];
        let (along, kept, negative) = [one, other].into_iter().find(|&(_, kept, _)| are_square(g, kept, c))?;
        let dot = g.dot(along, c);
        let scaled = g.scale(dot, kept);
        Some(if negative { g.neg_vector(scaled) } else { scaled })
    })
}

fn are_square(g: &Graph, v: Vector, w: Vector) -> bool {
    is_across(g, w, axis(g, v)) || is_across(g, v, axis(g, w))
}

/// `v − (v · u) u`
pub(crate) fn expand_across(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (inner, u) = as_across(g, v)?;
    let along = g.dot(inner, u);
    let radial = g.scale(along, u.into());
    Some(g.sub_vectors(inner, radial))
}
