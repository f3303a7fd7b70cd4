//! Rules for products that are 0 / 0 somewhere and have a limit there. Part of [`LIMITS`](crate::rewrite::rules::LIMITS).
//!
//! A product is taken apart into powers of its factors, in halves, so that |v| is half a power of v · v. Functions that
//! vanish like a power of a length r, such as sin r or 1 − cos r, are that power times a [smooth](crate::ir::smooth) function
//! of r²; so are sums of which every term is. Where powers of one factor above and below the line meet and none is left below,
//! the product is stated without them: nothing is divided by what could be 0, and its derivatives are right there, too.

use rustc_hash::FxHashSet;

use super::vanishing::{Vanishing, parts};
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// A product of more parts is not looked at.
const MOST_PARTS: usize = 48;

/// A product with a higher power is not looked at, in halves.
const HIGHEST_POWER: i32 = 64;

/// `a b / a = b`, also where a is 0, and `sin r / r`, a series there.
pub(crate) fn cancelled_division(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    if !matches!(g.scalar_node(s), ScalarNode::Op(Op::Mul(..) | Op::Div(..)) | ScalarNode::Dot(..)) {
        return None;
    }
    let (product, ()) = cancelled(g, |g, product, whole| product.times(g, s, 2, whole))?;
    let stated = product.stated(g);
    Some(stated.unwrap_or_else(|| g.constant(1.0)))
}

/// The same of a vector's factors: `|v| (v / |v|) = v`.
pub(crate) fn cancelled_scale(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Scale(..) = g.vector_node(v) else { return None };
    let (product, rest) = cancelled(g, |g, product, whole| product.times_vector(g, v, whole))?;
    Some(match product.stated(g) {
        Some(factor) => g.scale(factor, rest),
        None => rest,
    })
}

/// The product that `collect` multiplies together, if something of it cancels, with what `collect` leaves.
fn cancelled<R>(
    g: &mut Graph,
    collect: impl Fn(&mut Graph, &mut Product, &[Scalar]) -> Option<R>,
) -> Option<(Product, R)> {
    let mut all = Product::new();
    collect(g, &mut all, &[])?;
    let divisors = all.divisors(g);
    if divisors.is_empty() {
        return None;
    }
    for (round, find) in [Vanishing::of, Vanishing::of_any].into_iter().enumerate() {
        let vanishing = all.vanishing(g, &divisors, find);
        if round > 0 && vanishing.is_empty() {
            break;
        }
        // The argument of a function may be a product itself.
        let whole: Vec<Scalar> = vanishing.iter().map(|(_, found)| found.base()).collect();
        let mut product = Product::new();
        let rest = collect(g, &mut product, &whole)?;
        if product.cancel(g, &vanishing)? {
            return Some((product, rest));
        }
    }
    None
}

impl Graph {
    /// True of what is not negative, as far as one can see.
    pub(crate) fn is_length(&self, s: Scalar) -> bool {
        match self.scalar_node(s) {
            ScalarNode::Norm(_) | ScalarNode::Op(Op::Sqrt(_)) => true,
            ScalarNode::Dot(v, w) => v == w,
            ScalarNode::Op(Op::Mul(a, b)) => a == b,
            _ => false,
        }
    }
}

impl Graph {
    /// (1 − a)(1 + a), which keeps its digits near 1.
    pub(crate) fn around_one(&mut self, a: Scalar) -> Scalar {
        let one = self.constant(1.0);
        let (below, above) = (self.sub(one, a), self.add(one, a));
        self.mul(below, above)
    }

    /// The same of 1 − a².
    fn one_minus_square(&mut self, s: Scalar) -> Option<Scalar> {
        let ScalarNode::Op(Op::Sub(one, square)) = self.scalar_node(s) else { return None };
        let ScalarNode::Op(Op::Mul(a, b)) = self.scalar_node(square) else { return None };
        (a == b && self.constant_of(one) == Some(1.0)).then(|| self.around_one(a))
    }
}

/// The terms of a sum, of which there is no more than one where it is none.
pub(super) fn terms(g: &Graph, sum: Scalar) -> Vec<Scalar> {
    let (mut terms, mut open) = (Vec::new(), vec![sum]);
    while let Some(s) = open.pop() {
        match parts(g, s) {
            Some((a, b)) if terms.len() + open.len() < MOST_PARTS => open.extend([b, a]),
            _ => terms.push(s),
        }
    }
    terms
}

/// A product as powers of its factors.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub(super) coefficient: f64,
    /// Factors and their powers in halves, in the order of their first appearance.
    pub(super) powers: Vec<(Scalar, i32)>,
    /// The factors that appear above the line, and those that do below.
    above: Vec<Scalar>,
    below: Vec<Scalar>,
    parts: usize,
}

impl Product {
    pub(super) const fn new() -> Self {
        Self { coefficient: 1.0, powers: Vec::new(), above: Vec::new(), below: Vec::new(), parts: 0 }
    }

    pub(super) fn power(&mut self, factor: Scalar, halves: i32) {
        let side = if halves < 0 { &mut self.below } else { &mut self.above };
        side.push(factor);
        match self.powers.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, power)) => *power += halves,
            None => self.powers.push((factor, halves)),
        }
    }

    pub(super) fn power_of(&self, factor: Scalar) -> i32 {
        self.powers.iter().find(|(known, _)| *known == factor).map_or(0, |(_, power)| *power)
    }

    /// The factors of a scalar; `None` where there are too many.
    pub(super) fn of(g: &mut Graph, s: Scalar) -> Option<Self> {
        let mut product = Self::new();
        product.times(g, s, 2, &[])?;
        Some(product)
    }

    /// Takes a factor away. Returns its power, in halves.
    pub(super) fn remove(&mut self, factor: Scalar) -> i32 {
        let power = self.power_of(factor);
        self.powers.retain(|(known, _)| *known != factor);
        power
    }

    /// What is divided by, also within sums, and then what that may vanish with, each once; nothing where nothing is divided by.
    fn divisors(&self, g: &mut Graph) -> Vec<Scalar> {
        let mut divisors = self.below.clone();
        for &factor in &self.above {
            for term in terms(g, factor).into_iter().filter(|&term| term != factor) {
                divisors.extend(Self::of(g, term).map_or(Vec::new(), |product| product.below));
            }
        }
        if !divisors.is_empty() {
            divisors.extend(&self.above);
            divisors.extend(self.powers.iter().filter_map(|&(factor, _)| Vanishing::base_of_function(g, factor)));
        }
        let mut known = FxHashSet::default();
        divisors.retain(|&divisor| known.insert(divisor));
        divisors
    }

    /// Multiplies by a power of `s`, in halves, an even number; `None` where that is too long. What is in `whole` is not
    /// taken apart.
    fn times(&mut self, g: &mut Graph, s: Scalar, halves: i32, whole: &[Scalar]) -> Option<()> {
        self.parts += 1;
        if self.parts > MOST_PARTS || halves.abs() > HIGHEST_POWER {
            return None;
        }
        if whole.contains(&s) {
            self.power(s, halves);
            return Some(());
        }
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Constant(c)) => self.coefficient *= c.value().powi(halves / 2),
            ScalarNode::Op(Op::Neg(a)) => {
                self.coefficient *= (-1.0_f64).powi(halves / 2);
                self.times(g, a, halves, whole)?;
            }
            ScalarNode::Op(Op::Mul(a, b)) if a == b => self.times(g, a, 2 * halves, whole)?,
            ScalarNode::Op(Op::Mul(a, b)) => {
                self.times(g, a, halves, whole)?;
                self.times(g, b, halves, whole)?;
            }
            ScalarNode::Op(Op::Div(a, b)) => {
                self.times(g, a, halves, whole)?;
                self.times(g, b, -halves, whole)?;
            }
            // A guarded reciprocal is 0 of what is negative.
            ScalarNode::Reciprocal(a) if g.is_length(a) => self.times(g, a, -halves, whole)?,
            ScalarNode::Op(Op::Sqrt(a)) => {
                let a = g.one_minus_square(a).unwrap_or(a);
                self.power(a, halves / 2);
            }
            ScalarNode::Norm(v) => {
                let square = g.dot(v, v);
                self.power(square, halves / 2);
            }
            ScalarNode::Dot(v, w) if v != w && halves == 2 => {
                let (v, w) = (self.times_vector(g, v, whole)?, self.times_vector(g, w, whole)?);
                let dot = g.dot(v, w);
                self.power(dot, halves);
            }
            ScalarNode::Component(v, axis) if halves == 2 => {
                let v = self.times_vector(g, v, whole)?;
                let component = g.component(v, axis);
                self.power(component, halves);
            }
            _ => {
                let s = g.one_minus_square(s).unwrap_or(s);
                self.power(s, halves);
            }
        }
        Some(())
    }

    /// Multiplies by the factors of `v`, and gives what is left of it.
    fn times_vector(&mut self, g: &mut Graph, v: Vector, whole: &[Scalar]) -> Option<Vector> {
        self.parts += 1;
        if self.parts > MOST_PARTS {
            return None;
        }
        Some(match g.vector_node(v) {
            VectorNode::Scale(k, inner) => {
                self.times(g, k, 2, whole)?;
                self.times_vector(g, inner, whole)?
            }
            VectorNode::Neg(inner) => {
                self.coefficient = -self.coefficient;
                self.times_vector(g, inner, whole)?
            }
            VectorNode::Normalize(inner) => {
                let square = g.dot(inner, inner);
                self.power(square, -1);
                self.times_vector(g, inner, whole)?
            }
            VectorNode::Cross(a, b) => {
                let (a, b) = (self.times_vector(g, a, whole)?, self.times_vector(g, b, whole)?);
                g.cross(a, b)
            }
            VectorNode::Rotate(rotation, inner) => {
                let inner = self.times_vector(g, inner, whole)?;
                g.rotate(rotation, inner)
            }
            VectorNode::Perp(plane, inner) => {
                let inner = self.times_vector(g, inner, whole)?;
                g.perp(plane, inner)
            }
            VectorNode::Across(inner, unit) => {
                let inner = self.times_vector(g, inner, whole)?;
                g.across(inner, unit)
            }
            _ => v,
        })
    }

    /// The factors that vanish with a length, or with what is divided by.
    fn vanishing(
        &self,
        g: &mut Graph,
        divisors: &[Scalar],
        find: impl Fn(&mut Graph, Scalar, &[Scalar]) -> Vec<Vanishing>,
    ) -> Vec<(Scalar, Vanishing)> {
        let of = |&(factor, _): &(Scalar, i32)| find(g, factor, divisors).into_iter().map(move |found| (factor, found));
        self.powers.iter().flat_map(of).collect()
    }

    /// Takes away what is above and below the line; false where nothing is, `None` where that is too long.
    fn cancel(&mut self, g: &mut Graph, vanishing: &[(Scalar, Vanishing)]) -> Option<bool> {
        let mut bases: Vec<Scalar> = Vec::new();
        for base in self.powers.iter().map(|&(s, _)| s).chain(vanishing.iter().map(|(_, found)| found.base())) {
            if !bases.contains(&base) {
                bases.push(base);
            }
        }
        let mut any = false;
        for base in bases {
            let functions: Vec<&(Scalar, Vanishing)> =
                vanishing.iter().filter(|(_, found)| found.base() == base).collect();
            // Where a function is infinite, it is on the other side of the line.
            let sides = [&self.above, &self.below];
            let functions_in = |side: usize| {
                functions.iter().any(|(s, found)| sides[if found.halves() < 0 { 1 - side } else { side }].contains(s))
            };
            let is_in = |side: usize| sides[side].contains(&base) || functions_in(side);
            let halves: i32 = functions.iter().map(|(s, found)| found.halves() * self.power_of(*s) / 2).sum();
            if !is_in(0) || !is_in(1) || self.power_of(base) + halves < 0 {
                continue;
            }
            any = true;
            let by_itself = self.above.contains(&base) && self.power_of(base) >= 0;
            if by_itself && !functions_in(1) {
                continue;
            }
            for (s, found) in functions {
                found.take_out(g, self, *s)?;
            }
        }
        Some(any)
    }

    /// The product, stated anew; `None` of 1.
    pub(super) fn stated(self, g: &mut Graph) -> Option<Scalar> {
        let [mut above, mut below]: [Vec<Scalar>; 2] = Default::default();
        for &(factor, halves) in &self.powers {
            let side = if halves > 0 { &mut above } else { &mut below };
            for _ in 0..halves.abs() / 2 {
                side.push(factor);
            }
            if halves % 2 != 0 {
                side.push(match g.scalar_node(factor) {
                    ScalarNode::Dot(v, w) if v == w => g.norm(v),
                    _ => g.sqrt(factor),
                });
            }
        }
        if self.coefficient.abs() != 1.0 {
            above.push(g.constant(self.coefficient.abs()));
        }
        let [above, below] = [above, below].map(|side| side.into_iter().reduce(|a, b| g.mul(a, b)));
        let stated = match below {
            Some(below) => {
                let above = above.unwrap_or_else(|| g.constant(1.0));
                Some(g.div(above, below))
            }
            None => above,
        };
        if self.coefficient >= 0.0 {
            return stated;
        }
        let stated = stated.unwrap_or_else(|| g.constant(1.0));
        Some(g.neg(stated))
    }
}
