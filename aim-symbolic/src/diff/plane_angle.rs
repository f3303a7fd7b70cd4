//! Angles between two vectors of a plane, given by their sine and cosine: `atan2(u · (v × w), v · w)` with v and w
//! perpendicular to the direction u.
//!
//! Such an angle changes by ẇ · (u × w)/w² − v̇ · (u × v)/v². A change of u does not contribute: u̇ is perpendicular to
//! u, while v × w is parallel to it. Differentiating atan2 by its two arguments would give the same result, but as two
//! vectors for each of v and w, which have to be added.

use crate::rewrite::directions::{as_unit, is_across};
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// A product of numbers: its sign, numerator factors and denominator factors.
#[derive(Default)]
struct Factors {
    negative: bool,
    above: Vec<Scalar>,
    below: Vec<Scalar>,
}

impl Factors {
    fn of(g: &Graph, product: Scalar) -> Self {
        let mut found = Self::default();
        let mut open = vec![(product, false)];
        while let Some((s, is_below)) = open.pop() {
            match g.scalar_node(s) {
                ScalarNode::Op(Op::Neg(a)) => {
                    found.negative = !found.negative;
                    open.push((a, is_below));
                }
                ScalarNode::Op(Op::Mul(a, b)) => open.extend([(a, is_below), (b, is_below)]),
                ScalarNode::Op(Op::Div(a, b)) => open.extend([(a, is_below), (b, !is_below)]),
                ScalarNode::Reciprocal(a) => open.push((a, !is_below)),
                _ if is_below => found.below.push(s),
                _ => found.above.push(s),
            }
            if open.len() + found.above.len() + found.below.len() > MOST_FACTORS {
                return Self::default();
            }
        }
        found
    }
}

/// Limit on the number of factors; longer products are not analysed.
const MOST_FACTORS: usize = 16;

impl Graph {
    /// If `angle` is the angle between two vectors of a plane, returns both vectors, each with the derivative of the
    /// angle by it.
    pub(crate) fn plane_angle(&mut self, angle: Scalar) -> Option<[(Vector, Vector); 2]> {
        let ScalarNode::Op(Op::Atan2(y, x)) = self.scalar_node(angle) else { return None };
        let (sines, cosines) = (Factors::of(self, y), Factors::of(self, x));
        let (negative, from, to, axis) = cosines.above.iter().find_map(|&cosine| {
            let ScalarNode::Dot(v, w) = self.scalar_node(cosine) else { return None };
            sines.above.iter().find_map(|&sine| {
                let (negative, axis, power) = self.sine(sine, v, w)?;
                let is_angle = v != w && self.is_ratio([(&sines, sine), (&cosines, cosine)], axis, power);
                is_angle.then_some((negative, v, w, axis))
            })
        })?;
        let backwards = negative ^ sines.negative ^ cosines.negative;
        let axis = if as_unit(self, axis).is_some() { axis } else { self.normalize(axis).into() };
        Some([(from, !backwards), (to, backwards)].map(|(v, is_minus)| {
            let (square, turned) = (self.dot(v, v), self.cross(axis, v));
            let reciprocal = self.reciprocal(square);
            let reciprocal = if is_minus { self.neg(reciprocal) } else { reciprocal };
            (v, self.scale(reciprocal, turned))
        }))
    }

    /// If `sine` is ± u · (v × w) |b|ᵏ, where u is the direction of b and v and w are perpendicular to u, returns
    /// whether the sign is negative, b and k.
    fn sine(&self, sine: Scalar, v: Vector, w: Vector) -> Option<(bool, Vector, i32)> {
        let (a, b) = match self.scalar_node(sine) {
            ScalarNode::Dot(a, b) => (a, b),
            ScalarNode::Norm(axis) => {
                let is_theirs =
                    matches!(self.vector_node(axis), VectorNode::Cross(a, b) if [(a, b), (b, a)].contains(&(v, w)));
                return is_theirs.then_some((self.vector_node(axis) != VectorNode::Cross(v, w), axis, 0));
            }
            _ => return None,
        };
        let across = |axis| is_across(self, v, axis) && is_across(self, w, axis);
        [(a, b), (b, a)].into_iter().find_map(|(cross, last)| {
            // A triple product with v and w among its factors.
            if let VectorNode::Cross(first, second) = self.vector_node(cross) {
                let cyclic = [[first, second, last], [second, last, first], [last, first, second]];
                let found = cyclic.into_iter().find_map(|[one, other, axis]| match () {
                    () if (one, other) == (v, w) => Some((false, axis, 1)),
                    () if (one, other) == (w, v) => Some((true, axis, 1)),
                    () => None,
                });
                if let Some(found) = found.filter(|&(_, axis, _)| across(axis)) {
                    return Some(found);
                }
            }
            // c · w with v = c × b: b · (v × w) = b² (c · w).
            [(v, w, false), (w, v, true)].into_iter().find_map(|(product, other, is_swapped)| {
                let VectorNode::Cross(one, two) = self.vector_node(product) else { return None };
                let (axis, is_reversed) = match () {
                    () if (one, other) == (cross, last) => (two, false),
                    () if (two, other) == (cross, last) => (one, true),
                    () => return None,
                };
                across(axis).then_some((is_swapped ^ is_reversed, axis, -1))
            })
        })
    }

    /// Returns `true` if all other factors of sine and cosine cancel, given that the sine contains |axis| to this
    /// power.
    fn is_ratio(&mut self, [sines, cosines]: [(&Factors, Scalar); 2], axis: Vector, power: i32) -> bool {
        let (mut above, mut below) = (sines.0.above.clone(), sines.0.below.clone());
        above.extend(&cosines.0.below);
        below.extend(&cosines.0.above);
        let norm = self.norm(axis);
        let is_unit = as_unit(self, axis).is_some();
        above.push(cosines.1);
        below.push(sines.1);
        match power {
            1 if !is_unit => above.push(norm),
            -1 if !is_unit => below.push(norm),
            _ => {}
        }
        above.sort_unstable();
        below.sort_unstable();
        above == below
    }
}
