//! Rules for angles and directions, which depend only on ratios. Part of [`RATIOS`](crate::rewrite::rules::RATIOS).
//!
//! Lengths and their reciprocals are taken out of products, and out of sums in which every term has them.

use super::product::Product;
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// Limit on the depth to which expressions are searched.
const DEEPEST: u32 = 10;

/// `atan2(k y, k x) = atan2(y, x)` if k is a length or the reciprocal of one.
pub(crate) fn angle_of_scaled(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Op(Op::Atan2(y, x)) = g.scalar_node(s) else { return None };
    let (y, x) = (number(g, y, DEEPEST), number(g, x, DEEPEST));
    let mut lengths = Product::new();
    let [y, x] = lengths.common([y, x], |k, s| k.stated(g).map_or(s, |k| product(g, k, s)));
    if lengths.powers.is_empty() { None } else { Some(g.atan2(y, x)) }
}

/// `k v / |k v| = v / |v|` if k is a length or the reciprocal of one.
pub(crate) fn direction_of_scaled(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Normalize(inner) = g.vector_node(v) else { return None };
    let (lengths, rest) = vector(g, inner, DEEPEST);
    if lengths.powers.is_empty() { None } else { Some(g.normalize(rest).into()) }
}

/// Splits a number into a product of lengths and the remaining factor.
fn number(g: &mut Graph, s: Scalar, depth: u32) -> (Product, Scalar) {
    let mut lengths = Product::new();
    let Some(depth) = depth.checked_sub(1) else { return (lengths, s) };
    let rest = match g.scalar_node(s) {
        ScalarNode::Op(Op::Neg(a)) => {
            let a = lengths.with(number(g, a, depth), 1);
            g.neg(a)
        }
        ScalarNode::Op(Op::Mul(a, b)) if a != b => {
            let (a, b) = (lengths.with(number(g, a, depth), 1), lengths.with(number(g, b, depth), 1));
            product(g, a, b)
        }
        ScalarNode::Op(Op::Div(a, b)) => {
            let (a, b) = (lengths.with(number(g, a, depth), 1), lengths.with(number(g, b, depth), -1));
            if g.constant_of(b) == Some(1.0) { a } else { g.div(a, b) }
        }
        // A guarded reciprocal of a negative number is 0, so this holds only for lengths.
        ScalarNode::Reciprocal(a) if g.is_length(a) => {
            let a = lengths.with(number(g, a, depth), -1);
            if g.constant_of(a) == Some(1.0) { a } else { g.reciprocal(a) }
        }
        ScalarNode::Op(op @ (Op::Add(a, b) | Op::Sub(a, b))) => {
            let terms = [number(g, a, depth), number(g, b, depth)];
            let [a, b] = lengths.common(terms, |k, s| k.stated(g).map_or(s, |k| product(g, k, s)));
            if matches!(op, Op::Add(..)) { g.add(a, b) } else { g.sub(a, b) }
        }
        ScalarNode::Dot(v, w) if v != w => {
            let (v, w) = (lengths.with(vector(g, v, depth), 1), lengths.with(vector(g, w, depth), 1));
            g.dot(v, w)
        }
        ScalarNode::Component(v, axis) => {
            let v = lengths.with(vector(g, v, depth), 1);
            g.component(v, axis)
        }
        ScalarNode::Norm(v) => {
            let v = lengths.with(vector(g, v, depth), 1);
            let square = g.dot(v, v);
            lengths.power(square, 1);
            g.constant(1.0)
        }
        ScalarNode::Op(Op::Sqrt(square)) => {
            lengths.power(square, 1);
            g.constant(1.0)
        }
        _ => s,
    };
    (lengths, rest)
}

/// Splits a vector into a product of lengths and the remaining vector.
fn vector(g: &mut Graph, v: Vector, depth: u32) -> (Product, Vector) {
    let mut lengths = Product::new();
    let Some(depth) = depth.checked_sub(1) else { return (lengths, v) };
    let rest = match g.vector_node(v) {
        VectorNode::Scale(k, v) => {
            let (k, v) = (lengths.with(number(g, k, depth), 1), lengths.with(vector(g, v, depth), 1));
            scaled(g, k, v)
        }
        VectorNode::Normalize(v) => {
            let (_, v) = vector(g, v, depth);
            let square = g.dot(v, v);
            lengths.power(square, -1);
            v
        }
        VectorNode::Neg(v) => {
            let v = lengths.with(vector(g, v, depth), 1);
            g.neg_vector(v)
        }
        node @ (VectorNode::Add(v, w) | VectorNode::Sub(v, w)) => {
            let terms = [vector(g, v, depth), vector(g, w, depth)];
            let [v, w] = lengths.common(terms, |k, v| k.stated(g).map_or(v, |k| scaled(g, k, v)));
            if matches!(node, VectorNode::Add(..)) { g.add_vectors(v, w) } else { g.sub_vectors(v, w) }
        }
        VectorNode::Cross(v, w) => {
            let (v, w) = (lengths.with(vector(g, v, depth), 1), lengths.with(vector(g, w, depth), 1));
            g.cross(v, w)
        }
        VectorNode::Rotate(rotation, v) => {
            let v = lengths.with(vector(g, v, depth), 1);
            g.rotate(rotation, v)
        }
        VectorNode::Perp(plane, v) => {
            let v = lengths.with(vector(g, v, depth), 1);
            g.perp(plane, v)
        }
        VectorNode::Across(v, unit) => {
            let v = lengths.with(vector(g, v, depth), 1);
            g.across(v, unit)
        }
        _ => v,
    };
    (lengths, rest)
}

/// Returns a b, without factors of 1.
fn product(g: &mut Graph, a: Scalar, b: Scalar) -> Scalar {
    match (g.constant_of(a), g.constant_of(b)) {
        (Some(1.0), _) => b,
        (_, Some(1.0)) => a,
        _ => g.mul(a, b),
    }
}

/// Returns k v, or v if k is 1.
fn scaled(g: &mut Graph, k: Scalar, v: Vector) -> Vector {
    if g.constant_of(k) == Some(1.0) { v } else { g.scale(k, v) }
}

impl Product {
    /// Multiplies by a power of the lengths and returns the remaining factor.
    fn with<T>(&mut self, (lengths, rest): (Self, T), exponent: i32) -> T {
        for (length, halves) in lengths.powers {
            self.power(length, exponent * halves);
        }
        self.powers.retain(|&(_, halves)| halves != 0);
        rest
    }

    /// Multiplies by the lengths that both terms share, and multiplies each term by its remaining lengths.
    fn common<T>(&mut self, terms: [(Self, T); 2], mut times: impl FnMut(Self, T) -> T) -> [T; 2] {
        let [a, b] = [0, 1].map(|i: usize| terms[i].0.clone());
        for &(length, halves) in &a.powers {
            let other = b.power_of(length);
            if halves * other > 0 {
                self.power(length, if halves.abs() < other.abs() { halves } else { other });
            }
        }
        terms.map(|(lengths, rest)| {
            let mut own = Self::new();
            let rest = own.with((lengths, rest), 1);
            own.with((self.clone(), ()), -1);
            times(own, rest)
        })
    }
}
