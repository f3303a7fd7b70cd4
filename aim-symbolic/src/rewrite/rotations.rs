//! Rules that move rotations to where they cancel or cost least: [`ROTATIONS`](crate::rewrite::rules::ROTATIONS).

use crate::rewrite::scaling::{factors, scaled};
use crate::rewrite::sums::{MOST_TERMS, is_sum, sum, terms};
use crate::{
    Attitude, Function, Graph, Op, Plane, Rotation, RotationNode, Scalar, ScalarNode, Stumpff, Unit, Vector, VectorNode,
};

/// Returns the outermost rotation of `v` and the vector that it rotates.
pub(crate) fn leading(g: &Graph, v: Vector) -> Option<(Rotation, Vector)> {
    match g.vector_node(v) {
        VectorNode::Rotate(rotation, inner) => Some((rotation, inner)),
        _ => None,
    }
}

impl Graph {
    /// Returns `true` unless the map is known to keep handedness.
    fn may_reflect(&self, rotation: Rotation) -> bool {
        matches!(
            self.untransposed(rotation).0,
            RotationNode::Matrix(_) | RotationNode::Basis(_) | RotationNode::Compose(..)
        )
    }
}

fn is_forward(g: &Graph, rotation: Rotation) -> bool {
    !matches!(g.rotation_node(rotation), RotationNode::Transpose(_))
}

fn is_basis(g: &Graph, rotation: Rotation) -> bool {
    matches!(g.untransposed(rotation), (RotationNode::Basis(_), _))
}

/// Returns `true` if `v` is a constant vector after at most one rotation, not counting changes of basis: nothing costs
/// less.
fn is_turned_constant(g: &Graph, v: Vector) -> bool {
    match leading(g, v) {
        Some((rotation, inner)) if is_basis(g, rotation) => is_turned_constant(g, inner),
        Some((_, inner)) => g.constant_vector_of(inner).is_some(),
        None => g.constant_vector_of(v).is_some(),
    }
}

/// Returns the number of changes of basis outside of the forward rotation of `v` that could be turned back instead, or
/// `None` if there is no such rotation.
///
/// Only such vectors lose their rotation, and among several the one with the fewest changes of basis does, so that
/// rewriting does not rotate a vector back and forth.
fn pushed_below(g: &Graph, v: Vector) -> Option<usize> {
    let (rotation, inner) = leading(g, v)?;
    if is_basis(g, rotation) {
        let below = terms(g, inner).iter().filter_map(|&(_, term)| pushed_below(g, term)).min()?;
        return Some(below + 1);
    }
    is_forward(g, rotation).then_some(0)
}

/// Rodrigues' formula: `p cos r + (u × p) sin r / r + u (u · p)(1 − cos r)/r²` with r = |u|, also as
/// `p + (u × p) sin r / r + u × (u × p)(1 − cos r)/r²`, becomes the rotation of p about u by r.
pub(crate) fn recognize_turn(g: &mut Graph, v: Vector) -> Option<Vector> {
    if !is_sum(g, v) {
        return None;
    }
    let all = terms(g, v);
    let (used, turn, back, point) = all.iter().enumerate().find_map(|(i, &(negative, aside))| {
        let (sine, cross) = scaled(g, aside)?;
        let VectorNode::Cross(a, b) = g.vector_node(cross) else { return None };
        [(a, b, negative), (b, a, !negative)].into_iter().find_map(|(u, p, back)| {
            let is = |s: Scalar, order| is_turn_factor(g, s, order, u);
            let is_kept = |term| scaled(g, term).is_some_and(|(cos, inner)| inner == p && is(cos, 0));
            let is_dot =
                |s: Scalar| matches!(g.scalar_node(s), ScalarNode::Dot(v, w) if [v, w] == [u.min(p), u.max(p)]);
            let is_along = |term| {
                scaled(g, term).is_some_and(|(k, inner)| match factors(g, k)[..] {
                    [x, y] => inner == u && (is(x, 2) && is_dot(y) || is(y, 2) && is_dot(x)),
                    _ => false,
                })
            };
            let is_twice = |term| {
                scaled(g, term).is_some_and(|(k, twice)| {
                    is(k, 2)
                        && matches!(g.vector_node(twice), VectorNode::Cross(v, w) if v == u && w == cross && a == u)
                })
            };
            let place =
                |fits: &dyn Fn(Vector) -> bool| all.iter().position(|&(negative, term)| !negative && fits(term));
            let others = match (place(&is_kept), place(&is_along)) {
                (Some(kept), Some(along)) => [kept, along],
                _ => [place(&|term| term == p)?, place(&is_twice)?],
            };
            is(sine, 1).then_some(([i, others[0], others[1]], u, back, p))
        })
    })?;
    let mut rotation = g.attitude(Attitude::Turn(turn));
    if back {
        rotation = g.transpose(rotation);
    }
    let rest = all.into_iter().enumerate().filter(|(i, _)| !used.contains(i)).map(|(_, term)| term);
    let turned = [(false, g.rotate(rotation, point))];
    let together: Vec<_> = turned.into_iter().chain(rest).collect();
    Some(sum(g, &together))
}

/// `(x cos θ − y sin θ, x sin θ + y cos θ, z)` becomes (x, y, z) turned by θ; likewise in the other planes.
pub(crate) fn recognize_plane_turn(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Components(c) = g.vector_node(v) else { return None };
    let (plane, radians, parts) = [(0, 1), (1, 0), (1, 2), (2, 1), (2, 0), (0, 2)].into_iter().find_map(|(i, k)| {
        let called = |function, s| match g.scalar_node(s) {
            ScalarNode::Op(Op::Call(own, radians)) if own == function => Some(radians),
            _ => None,
        };
        let (first, second) = (two_products(g, c[i])?, two_products(g, c[k])?);
        let (radians, x, y) = first.into_iter().zip([1, 0]).find_map(|((negative, factors), other)| {
            let (negative_sine, sine_factors) = first[other];
            let (cos, x) =
                factors.into_iter().zip([factors[1], factors[0]]).find(|(s, _)| called(Function::Cos, *s).is_some())?;
            let radians = called(Function::Cos, cos)?;
            let sines = sine_factors.into_iter().zip([sine_factors[1], sine_factors[0]]);
            let (_, y) = sines.into_iter().find(|(s, _)| called(Function::Sin, *s) == Some(radians))?;
            (!negative && negative_sine).then_some((radians, x, y))
        })?;
        let has = |function, part| {
            second.into_iter().any(|(negative, [a, b])| {
                let is = |s, other| other == part && called(function, s) == Some(radians);
                !negative && (is(a, b) || is(b, a))
            })
        };
        let mut parts = c;
        (parts[i], parts[k]) = (x, y);
        let number = |axis| u8::try_from(axis).unwrap_or_default();
        let plane = Plane { from: number(i), towards: number(k) };
        (has(Function::Sin, x) && has(Function::Cos, y)).then_some((plane, radians, parts))
    })?;
    let of_one = |axis: u8| match g.scalar_node(parts[usize::from(axis)]) {
        ScalarNode::Component(v, own) if own == axis => Some(v),
        _ => None,
    };
    let inner = match [0, 1, 2].map(of_one) {
        [Some(x), Some(y), Some(z)] if x == y && y == z => x,
        _ => g.components(parts),
    };
    let angle = g.angle_of(radians);
    let turn = g.turn(plane, angle);
    Some(g.rotate(turn, inner))
}

/// Returns the terms of a sum of two products, each with its sign and its factors.
fn two_products(g: &Graph, s: Scalar) -> Option<[(bool, [Scalar; 2]); 2]> {
    let (a, b, negative) = match g.scalar_node(s) {
        ScalarNode::Op(Op::Add(a, b)) => (a, b, false),
        ScalarNode::Op(Op::Sub(a, b)) => (a, b, true),
        _ => return None,
    };
    let unsigned = |s| match g.scalar_node(s) {
        ScalarNode::Op(Op::Neg(inner)) => (true, inner),
        _ => (false, s),
    };
    let product = |s, negative| {
        let (minus, s) = unsigned(s);
        let ScalarNode::Op(Op::Mul(a, b)) = g.scalar_node(s) else { return None };
        let ((minus_a, a), (minus_b, b)) = (unsigned(a), unsigned(b));
        Some((negative ^ minus ^ minus_a ^ minus_b, [a, b]))
    };
    Some([product(a, false)?, product(b, negative)?])
}

/// Returns `true` if `s` is cos r, sin r / r or (1 − cos r)/r², by `order` 0, 1 or 2, with r the length of `u`.
fn is_turn_factor(g: &Graph, s: Scalar, order: u8, u: Vector) -> bool {
    match g.scalar_node(s) {
        ScalarNode::Stumpff(Stumpff { hyperbolic: false, order: own }, square) => {
            own == order && g.scalar_node(square) == ScalarNode::Dot(u, u)
        }
        ScalarNode::Op(Op::Call(Function::Cos, length)) => order == 0 && g.scalar_node(length) == ScalarNode::Norm(u),
        _ => false,
    }
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

/// `δ = 0`, for a component of a step
pub(crate) fn step_at_rest(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    matches!(g.scalar_node(s), ScalarNode::Step(_)).then(|| g.constant(0.0))
}

/// The formula of a quaternion's vector part
pub(crate) fn formula_of_vector(g: &mut Graph, v: Vector) -> Option<Vector> {
    match g.vector_node(v) {
        VectorNode::Imaginary(_, u, _) => Some(u),
        _ => None,
    }
}

/// The formula of a quaternion's scalar part
pub(crate) fn formula_of_scalar(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    match g.scalar_node(s) {
        ScalarNode::Real(_, _, w) => Some(w),
        _ => None,
    }
}

/// `exp(δ) v = v`, with a step δ
pub(crate) fn turn_at_rest(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (rotation, inner) = leading(g, v)?;
    let (by, _) = g.moved_by(rotation)?;
    (!g.is_motion(by)).then_some(inner)
}

/// `Rᵀ R v = v`, and `Rᵀ (v × R w) = Rᵀ v × w` unless R may be a reflection
pub(crate) fn undo_rotation(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (outer, inner) = leading(g, v)?;
    let rotation = g.transpose(outer);
    let is_undone = |v| leading(g, v).is_some_and(|(r, _)| r == rotation);
    match g.vector_node(inner) {
        VectorNode::Cross(a, b) if !g.may_reflect(rotation) && (is_undone(a) || is_undone(b)) => {
            let [a, b] = [a, b].map(|v| turned_back(g, rotation, v));
            Some(g.cross(a, b))
        }
        VectorNode::Rotate(first, core) => (first == rotation).then_some(core),
        _ => None,
    }
}

/// `Rᵀ (a + k (R b + c)) = Rᵀ a + k b + k Rᵀ c`
pub(crate) fn undo_in_sum(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (outer, inner) = leading(g, v)?;
    if !is_sum(g, inner) {
        return None;
    }
    let rotation = g.transpose(outer);
    let spread = Spread { g, rotation, left: MOST_TERMS }.terms(inner, false, None)?;
    let inner = sum(g, &spread);
    Some(turned_back(g, rotation, inner))
}

/// Takes multiples of sums apart in which a term has this rotation.
struct Spread<'g> {
    g: &'g mut Graph,
    rotation: Rotation,
    /// The number of terms that may still be visited.
    left: usize,
}

impl Spread<'_> {
    /// Returns the signed terms of k v if one of them has the rotation: `k (R a + b) = R (k a) + k b`
    fn terms(&mut self, v: Vector, negative: bool, k: Option<Scalar>) -> Option<Vec<(bool, Vector)>> {
        self.left = self.left.checked_sub(1)?;
        match self.g.vector_node(v) {
            VectorNode::Rotate(own, core) if own == self.rotation => {
                let core = self.times(k, core);
                Some(vec![(negative, self.g.rotate(own, core))])
            }
            VectorNode::Scale(factor, inner) => {
                let k = k.map_or(factor, |k| self.g.mul(k, factor));
                self.terms(inner, negative, Some(k))
            }
            _ if is_sum(self.g, v) => {
                let mut has_rotation = false;
                let mut all = Vec::new();
                for (sign, term) in terms(self.g, v) {
                    let spread = self.terms(term, sign != negative, k);
                    has_rotation |= spread.is_some();
                    all.extend(spread.unwrap_or_else(|| vec![(sign != negative, self.times(k, term))]));
                }
                has_rotation.then_some(all)
            }
            _ => None,
        }
    }

    fn times(&mut self, k: Option<Scalar>, v: Vector) -> Vector {
        k.map_or(v, |k| self.g.scale(k, v))
    }
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

/// `R v / |R v| = R (v / |v|)`, and likewise for multiples, negations and parts across a direction.
pub(crate) fn operation_on_rotated(g: &mut Graph, v: Vector) -> Option<Vector> {
    // A rotated constant costs less if it is rotated before it is scaled, once.
    let last = |g: &Graph, v| leading(g, v).filter(|_| !is_turned_constant(g, v));
    operation_before(g, v, if matches!(g.vector_node(v), VectorNode::Scale(..)) { last } else { leading })
}

/// Moves an operation on a rotated vector inside the rotation, for the rotations that `last` finds.
pub(crate) fn operation_before(
    g: &mut Graph,
    v: Vector,
    last: impl Fn(&Graph, Vector) -> Option<(Rotation, Vector)>,
) -> Option<Vector> {
    let (rotation, moved) = match g.vector_node(v) {
        VectorNode::Scale(k, inner) => {
            let (rotation, inner) = last(g, inner)?;
            (rotation, g.scale(k, inner))
        }
        VectorNode::Neg(inner) => {
            let (rotation, inner) = last(g, inner)?;
            (rotation, g.neg_vector(inner))
        }
        VectorNode::Normalize(inner) => {
            let (rotation, inner) = last(g, inner)?;
            (rotation, g.normalize(inner).into())
        }
        VectorNode::Across(inner, unit) => {
            let (rotation, unit) = last(g, unit.into())?;
            let inner = turned_back(g, rotation, inner);
            (rotation, g.across(inner, Unit(unit)))
        }
        _ => return None,
    };
    Some(g.rotate(rotation, moved))
}

/// Returns Rᵀ v, term by term: `Rᵀ (a + R b) = Rᵀ a + b`
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

/// Rotates a sum back by the rotation of one of its terms, which keeps its length: `|a + R b| = |Rᵀ a + b|`.
fn pulled(g: &mut Graph, v: Vector) -> Option<(Rotation, Vector)> {
    if !is_sum(g, v) {
        return None;
    }
    let pushed = terms(g, v).into_iter().filter_map(|(_, term)| Some((pushed_below(g, term)?, term)));
    let (_, term) = pushed.min_by_key(|&(below, _)| below)?;
    let (rotation, _) = leading(g, term)?;
    Some((rotation, turned_back(g, rotation, v)))
}

/// `(a + R b) / |a + R b| · R w = (Rᵀ a + b) / |Rᵀ a + b| · w`, and likewise for the length of the part across that
/// direction.
pub(crate) fn dot_direction(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let (sides, is_dot) = match g.scalar_node(s) {
        ScalarNode::Dot(a, b) => (vec![(a, b), (b, a)], true),
        ScalarNode::Norm(v) => match g.vector_node(v) {
            VectorNode::Across(other, direction) => (vec![(direction.into(), other)], false),
            _ => return None,
        },
        _ => return None,
    };
    sides.into_iter().find_map(|(direction, other)| {
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
        if is_dot {
            return Some(g.dot(back, w));
        }
        let across = g.across(w, back);
        Some(g.norm(across))
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

/// Returns the sides of a dot product that have a forward rotation, as (other, side), the one with the fewest changes
/// of basis outside of it first.
fn pushed_sides(g: &Graph, s: Scalar) -> Vec<(Vector, Vector)> {
    let ScalarNode::Dot(a, b) = g.scalar_node(s) else { return Vec::new() };
    let mut sides: Vec<_> =
        [(a, b), (b, a)].into_iter().filter_map(|(v, pushed)| Some((pushed_below(g, pushed)?, v, pushed))).collect();
    if matches!(sides[..], [(first, ..), (second, ..)] if second < first) {
        sides.swap(0, 1);
    }
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
