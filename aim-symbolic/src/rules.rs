//! The rules that rewrite a statement: each keeps the value, none is keyed to a particular objective.
//!
//! One exception is stated where it is: the length of a cross product with a direction, where that is 0.
//!
//! A rule looks at one node whose parts are already rewritten and offers a replacement. [`Graph::rewrite`] applies
//! them in the order of the tables, bottom up, until none applies.

use crate::derive::ARITHMETIC;
use crate::{Graph, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode, directions, frames};

/// A cross product with a direction is as long as the part across it: one of two ways to the same length.
pub(crate) const ACROSS_FOR_CROSS: &str = "the part across is as long as the cross product";
/// A scaled vector that is needed elsewhere too gives up its factor all the same.
pub(crate) const MERGE_SHARED: &str = "merge scales of shared vectors";
/// A constant direction gives up its largest component as a factor.
pub(crate) const CONSTANT_SCALE: &str = "a constant direction by its largest component";
/// A scaled difference in a sum with its own subtrahend is taken apart: one of two ways to write the sum.
pub(crate) const SPREAD: &str = "spread a scaled difference over its sum";

/// Of a dot's two sides either can be rotated; how far to go is a choice.
const OTHER_SIDE: &str = "rotation to the other side of a dot";
/// The same for the terms of a sum of which only the norm is needed.
const NORM_SIDE: &str = "pull a rotation out of a sum's norm";
/// The same for its square.
const SQUARE_SIDE: &str = "pull a rotation out of a sum's square";
/// The rules that turn something else than before by as much.
pub(crate) const OTHER_SIDES: [&str; 3] = [OTHER_SIDE, NORM_SIDE, SQUARE_SIDE];
/// The rules by which rotations vanish.
pub(crate) const CANCELLING: [&str; 2] =
    ["same rotation in a direction and beside it", "rotation cancels on the other side of a dot"];

/// A rule for vectors.
pub type VectorRule = fn(&mut Graph, Vector) -> Option<Vector>;
/// A rule for scalars.
pub type ScalarRule = fn(&mut Graph, Scalar) -> Option<Scalar>;

/// Rules applied together, in order, each with its name.
#[derive(Clone, Copy, Debug)]
pub struct RuleSet {
    /// The rules for vectors.
    pub vectors: &'static [(&'static str, VectorRule)],
    /// The rules for scalars.
    pub scalars: &'static [(&'static str, ScalarRule)],
    /// What a sum's terms are.
    pub sums: Sums,
}

/// What the terms of a sum are to the rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sums {
    /// Also the terms of its partial sums.
    Open,
    /// A partial sum that is needed elsewhere too is one term, so that it stays shared.
    Shared,
}

/// Which rules apply: all of them but a few.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules<'a> {
    /// The names of those switched off.
    pub without: &'a [&'a str],
    /// How often a rotation may go to the other side of a dot or norm without cancelling there; `None` for wherever it can.
    pub turned: Option<usize>,
}

impl Rules<'_> {
    /// Whether the rule of this name applies.
    pub fn has(&self, name: &str) -> bool {
        !self.without.contains(&name)
    }
}

/// The names of the rules of all sets, in the order of the passes that they belong to.
pub(crate) fn of_sets() -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for set in [WORDING, ROTATIONS, DIRECTIONS, FRAMES, SCALES] {
        let vectors = set.vectors.iter().map(|(name, _)| *name);
        for name in vectors.chain(set.scalars.iter().map(|(name, _)| *name)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

/// The names of all rules, those of arithmetic last.
pub fn names() -> Vec<&'static str> {
    of_sets().into_iter().chain(ARITHMETIC).collect()
}

/// What a statement says in other words: norms and directions spelled out.
pub const WORDING: RuleSet = RuleSet {
    vectors: &[("a vector over its length is a direction", directions::recognize_direction)],
    scalars: &[
        ("the root of a square is a norm", directions::root_of_square),
        ("the square of a norm is a dot", directions::square_of_norm),
        ("a division by a norm is guarded", directions::guard_division),
        (ACROSS_FOR_CROSS, directions::norm_of_cross),
    ],
    sums: Sums::Open,
};

/// Rotations to where they cancel, or to the side where they cost least.
pub const ROTATIONS: RuleSet = RuleSet {
    vectors: &[
        ("fold zero and one", fold_zero),
        ("split composition", split_composition),
        ("undo rotation", undo_rotation),
        ("cancel terms", cancel_terms),
        ("common rotation", common_rotation),
        ("normalize what was rotated", normalize_rotated),
    ],
    scalars: &[
        ("norm of what was rotated", norm_rotated),
        (NORM_SIDE, norm_pulls),
        (SQUARE_SIDE, square_pulls),
        (CANCELLING[0], dot_direction),
        (CANCELLING[1], dot_cancels),
        (OTHER_SIDE, dot_other_side),
    ],
    sums: Sums::Open,
};

/// Compositions into the rotations that they are made of, as the reverse sweep needs them.
pub(crate) const COMPOSITIONS: RuleSet =
    RuleSet { vectors: &[("split composition", split_composition)], scalars: &[], sums: Sums::Open };

/// A calculation in the frame before a turn that many vectors were turned back by.
pub const FRAMES: RuleSet = RuleSet {
    vectors: &[
        ("fold zero and one", fold_zero),
        ("undo rotation", undo_rotation),
        ("a sum in another frame", frames::sum_in_frame),
        ("an operation in another frame", frames::operation_in_frame),
    ],
    scalars: &[("a number in another frame", frames::number_in_frame)],
    sums: Sums::Open,
};

/// What is along a direction or square to it, and what follows for sums and dots.
pub const DIRECTIONS: RuleSet = RuleSet {
    vectors: &[
        ("fold zero and one", fold_zero),
        ("merge scales", crate::scaling::merge),
        ("scale after the operation", crate::scaling::out_of_operation),
        ("nothing of a direction is across it", directions::across_of_along),
        ("all of what is across is across", directions::across_of_across),
        ("the parts across of a sum", directions::across_of_sum),
    ],
    scalars: &[
        ("dot, then scale", crate::scaling::out_of_dot),
        ("dot, then sign", crate::scaling::sign_out_of_number),
        ("drop the radial part", directions::dot_along_across),
    ],
    sums: Sums::Open,
};

/// Scale factors out of the vector operations that they pass through unchanged.
pub const SCALES: RuleSet = RuleSet {
    vectors: &[
        ("fold zero and one", fold_zero),
        ("undo rotation", undo_rotation),
        ("one reciprocal for a direction", crate::scaling::expand_normalize),
        ("merge scales", crate::scaling::merge),
        (MERGE_SHARED, crate::scaling::merge_shared),
        ("scale after the operation", crate::scaling::out_of_operation),
        ("a part across is a difference", directions::expand_across),
        (SPREAD, crate::scaling::spread),
        ("common vector of a sum", crate::scaling::common_vector),
        (CONSTANT_SCALE, crate::scaling::constant_scale),
    ],
    scalars: &[("dot, then scale", crate::scaling::out_of_dot), ("dot, then sign", crate::scaling::sign_out_of_number)],
    sums: Sums::Shared,
};

/// A sum is taken apart into about so many terms at most: shared partial sums would double them again and again.
const MOST_TERMS: usize = 64;

/// The terms of a sum with their signs (`true` = subtracted).
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

/// The sum of `terms`.
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
    constant_components(g, v) == Some([0.0; 3])
}

pub(crate) fn constant_components(g: &Graph, v: Vector) -> Option<[f64; 3]> {
    let VectorNode::Components([x, y, z]) = g.vector_node(v) else { return None };
    Some([g.constant_of(x)?, g.constant_of(y)?, g.constant_of(z)?])
}

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
        Some((_, inner)) => constant_components(g, inner).is_some(),
        None => constant_components(g, v).is_some(),
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

pub(crate) fn is_sum(g: &Graph, v: Vector) -> bool {
    matches!(g.vector_node(v), VectorNode::Add(..) | VectorNode::Sub(..) | VectorNode::Neg(..))
}

/// 0 and 1 leave sums, scales and rotations.
fn fold_zero(g: &mut Graph, v: Vector) -> Option<Vector> {
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
            _ => None,
        },
        VectorNode::Scale(_, a) if is_zero(g, a) => Some(a),
        VectorNode::Scale(k, a) if g.constant_of(k) == Some(1.0) => Some(a),
        VectorNode::Scale(k, a) if g.constant_of(k) == Some(-1.0) => Some(g.neg_vector(a)),
        VectorNode::Scale(k, _) if g.constant_of(k) == Some(0.0) => Some(g.constant_vector([0.0; 3])),
        _ => None,
    }
}

/// `(A B) v = A (B v)`
fn split_composition(g: &mut Graph, v: Vector) -> Option<Vector> {
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
fn undo_rotation(g: &mut Graph, v: Vector) -> Option<Vector> {
    let (outer, inner) = leading(g, v)?;
    let (rotation, core) = leading(g, inner)?;
    (g.transpose(rotation) == outer).then_some(core)
}

/// `a + b − a = b`
fn cancel_terms(g: &mut Graph, v: Vector) -> Option<Vector> {
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

/// `R a + R b = R (a + b)`
fn common_rotation(g: &mut Graph, v: Vector) -> Option<Vector> {
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
fn normalize_rotated(g: &mut Graph, v: Vector) -> Option<Vector> {
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
fn dot_direction(g: &mut Graph, s: Scalar) -> Option<Scalar> {
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
fn norm_rotated(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Norm(v) = g.scalar_node(s) else { return None };
    let (_, core) = leading(g, v)?;
    Some(g.norm(core))
}

/// `|a + R b| = |Rᵀ a + b|`
fn norm_pulls(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Norm(v) = g.scalar_node(s) else { return None };
    let (_, turned_back) = pulled(g, v)?;
    Some(g.norm(turned_back))
}

/// `(a + R b)² = (Rᵀ a + b)²`
fn square_pulls(g: &mut Graph, s: Scalar) -> Option<Scalar> {
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
fn dot_cancels(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let (v, pushed) = pushed_sides(g, s).into_iter().find(|&(v, pushed)| {
        let (outer, _) = leading(g, pushed).unzip();
        terms(g, v).iter().any(|&(_, t)| leading(g, t).unzip().0 == outer)
    })?;
    turn_other_side(g, v, pushed)
}

/// `v · R w = Rᵀ v · w`, unless `R w` is a rotated constant, which costs least.
fn dot_other_side(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let (v, pushed) = pushed_sides(g, s).into_iter().find(|&(_, pushed)| !is_turned_constant(g, pushed))?;
    turn_other_side(g, v, pushed)
}
