//! Rules for products that are 0 / 0 somewhere and have a limit there. Part of [`LIMITS`](crate::rewrite::rules::LIMITS).
//!
//! A product is taken apart into powers of its factors, in halves, so that |v| is half a power of v · v. Functions that
//! vanish like a power of a length r, such as sin r or 1 − cos r, are that power times a [smooth](crate::ir::smooth) function
//! of r². Where powers of one factor above and below the line meet and none is left below, the product is stated without
//! them: nothing is divided by what could be 0, and its derivatives are right there, too.

use crate::{Function, Graph, Op, Scalar, ScalarNode, Stumpff, Vector, VectorNode};

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
    let mut product = Product::new();
    let mut rest = collect(g, &mut product, &[])?;
    if product.below.is_empty() {
        return None;
    }
    let vanishing = product.vanishing(g);
    // The argument of a function may be a product itself.
    let whole: Vec<Scalar> = vanishing.iter().map(|(_, found)| found.length.base).collect();
    if !whole.is_empty() {
        product = Product::new();
        rest = collect(g, &mut product, &whole)?;
    }
    product.cancel(g, &vanishing).then_some((product, rest))
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

/// A product as powers of its factors.
#[derive(Clone, Debug)]
struct Product {
    coefficient: f64,
    /// Factors and their powers in halves, in the order of their first appearance.
    powers: Vec<(Scalar, i32)>,
    /// The factors that appear above the line, and those that do below.
    above: Vec<Scalar>,
    below: Vec<Scalar>,
    parts: usize,
}

impl Product {
    const fn new() -> Self {
        Self { coefficient: 1.0, powers: Vec::new(), above: Vec::new(), below: Vec::new(), parts: 0 }
    }

    fn power(&mut self, factor: Scalar, halves: i32) {
        let side = if halves < 0 { &mut self.below } else { &mut self.above };
        side.push(factor);
        match self.powers.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, power)) => *power += halves,
            None => self.powers.push((factor, halves)),
        }
    }

    fn power_of(&self, factor: Scalar) -> i32 {
        self.powers.iter().find(|(known, _)| *known == factor).map_or(0, |(_, power)| *power)
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
            ScalarNode::Op(Op::Sqrt(a)) => self.power(a, halves / 2),
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
            _ => self.power(s, halves),
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

    /// The factors that vanish with a length.
    fn vanishing(&self, g: &mut Graph) -> Vec<(Scalar, Vanishing)> {
        self.powers.iter().filter_map(|&(factor, _)| Some((factor, Vanishing::of(g, factor)?))).collect()
    }

    /// Takes away what is above and below the line; false where nothing is.
    fn cancel(&mut self, g: &mut Graph, vanishing: &[(Scalar, Vanishing)]) -> bool {
        let mut bases: Vec<Scalar> = Vec::new();
        for base in self.powers.iter().map(|&(s, _)| s).chain(vanishing.iter().map(|(_, found)| found.length.base)) {
            if !bases.contains(&base) {
                bases.push(base);
            }
        }
        let mut any = false;
        for base in bases {
            let functions: Vec<&(Scalar, Vanishing)> =
                vanishing.iter().filter(|(_, found)| found.length.base == base).collect();
            let is_in = |side: &[Scalar]| side.contains(&base) || functions.iter().any(|(s, _)| side.contains(s));
            let halves: i32 = functions.iter().map(|(s, found)| found.halves() * self.power_of(*s) / 2).sum();
            if !is_in(&self.above) || !is_in(&self.below) || self.power_of(base) + halves < 0 {
                continue;
            }
            any = true;
            let by_itself = self.above.contains(&base) && self.power_of(base) >= 0;
            if by_itself && !functions.iter().any(|(s, _)| self.below.contains(s)) {
                continue;
            }
            for (s, found) in functions {
                found.take_out(g, self, *s);
            }
        }
        any
    }

    /// The product, stated anew; `None` of 1.
    fn stated(self, g: &mut Graph) -> Option<Scalar> {
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

/// A constant times a length, which is a norm, a root, or a number of any sign.
struct Length {
    coefficient: f64,
    base: Scalar,
    /// 1 where the length is the root of the base, 2 where it is the base.
    halves: i32,
}

impl Length {
    fn of(g: &mut Graph, mut s: Scalar) -> Option<Self> {
        let mut coefficient = 1.0;
        loop {
            match g.scalar_node(s) {
                ScalarNode::Op(Op::Constant(_)) => return None,
                ScalarNode::Op(Op::Neg(a)) => (coefficient, s) = (-coefficient, a),
                ScalarNode::Op(Op::Mul(a, b)) => match (g.constant_of(a), g.constant_of(b)) {
                    (Some(c), _) => (coefficient, s) = (coefficient * c, b),
                    (_, Some(c)) => (coefficient, s) = (coefficient * c, a),
                    _ => return Some(Self { coefficient, base: s, halves: 2 }),
                },
                ScalarNode::Op(Op::Div(a, b)) if g.constant_of(b).is_some() => {
                    (coefficient, s) = (coefficient / g.constant_of(b)?, a);
                }
                ScalarNode::Norm(v) => return Some(Self { coefficient, base: g.dot(v, v), halves: 1 }),
                ScalarNode::Op(Op::Sqrt(base)) => return Some(Self { coefficient, base, halves: 1 }),
                _ => return Some(Self { coefficient, base: s, halves: 2 }),
            }
        }
    }

    fn square(&self, g: &mut Graph) -> Scalar {
        let square = if self.halves == 1 { self.base } else { g.mul(self.base, self.base) };
        if self.coefficient.abs() == 1.0 {
            return square;
        }
        let factor = g.constant(self.coefficient * self.coefficient);
        g.mul(factor, square)
    }
}

/// A function as one of a length r: a sign, a power of r, and a rest that is not 0 where r is.
struct Vanishing {
    length: Length,
    order: u8,
    negative: bool,
    rest: Rest,
}

/// Smooth functions of r².
enum Rest {
    Stumpff(Stumpff),
    /// The Stumpff function of order 1 over that of order 0.
    Tangent(Stumpff),
    /// atan2(r, w)/r
    Arc(Scalar),
}

fn one_minus(g: &mut Graph, square: Scalar) -> Scalar {
    let one = g.constant(1.0);
    g.sub(one, square)
}

impl Vanishing {
    fn of(g: &mut Graph, s: Scalar) -> Option<Self> {
        let [circular, hyperbolic] = [false, true].map(|hyperbolic| Stumpff { hyperbolic, order: 1 });
        let one = |length, rest| Some(Self { length, order: 1, negative: false, rest });
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Call(function, a)) => match function {
                Function::Sin => one(Length::of(g, a)?, Rest::Stumpff(circular)),
                Function::Sinh => one(Length::of(g, a)?, Rest::Stumpff(hyperbolic)),
                Function::Tan => one(Length::of(g, a)?, Rest::Tangent(circular)),
                Function::Tanh => one(Length::of(g, a)?, Rest::Tangent(hyperbolic)),
                // asin t = atan2(t, √(1 − t²))
                Function::Asin => {
                    let length = Length::of(g, a)?;
                    let square = length.square(g);
                    let rest = one_minus(g, square);
                    one(length, Rest::Arc(g.sqrt(rest)))
                }
                // acos w = atan2(√(1 − w²), w)
                Function::Acos => {
                    let square = g.mul(a, a);
                    one(Length { coefficient: 1.0, base: one_minus(g, square), halves: 1 }, Rest::Arc(a))
                }
                _ => None,
            },
            ScalarNode::Op(Op::Atan2(y, x)) => one(Length::of(g, y)?, Rest::Arc(x)),
            ScalarNode::Op(Op::Sub(a, b)) => {
                let (length, negative, function) = Self::difference(g, a, b)
                    .map(|(length, function)| (length, false, function))
                    .or_else(|| Self::difference(g, b, a).map(|(length, function)| (length, true, function)))?;
                let length = Length::of(g, length)?;
                Some(Self { length, order: function.order, negative, rest: Rest::Stumpff(function) })
            }
            _ => None,
        }
    }

    /// The length of 1 − cos r, r − sin r, cosh r − 1 or sinh r − r, and the function.
    fn difference(g: &Graph, a: Scalar, b: Scalar) -> Option<(Scalar, Stumpff)> {
        let called = |s| match g.scalar_node(s) {
            ScalarNode::Op(Op::Call(function, r)) => Some((function, r)),
            _ => None,
        };
        let is_one = |s| g.constant_of(s) == Some(1.0);
        let function = |hyperbolic, order| Stumpff { hyperbolic, order };
        match (called(a), called(b)) {
            (_, Some((Function::Cos, r))) if is_one(a) => Some((r, function(false, 2))),
            (_, Some((Function::Sin, r))) if a == r => Some((r, function(false, 3))),
            (Some((Function::Cosh, r)), _) if is_one(b) => Some((r, function(true, 2))),
            (Some((Function::Sinh, r)), _) if b == r => Some((r, function(true, 3))),
            _ => None,
        }
    }

    /// The power of the length's base, in halves.
    fn halves(&self) -> i32 {
        i32::from(self.order) * self.length.halves
    }

    /// Takes the power of the length out of the function `s` in `product`.
    fn take_out(&self, g: &mut Graph, product: &mut Product, s: Scalar) {
        let halves = product.power_of(s);
        product.powers.retain(|(known, _)| *known != s);
        let sign = if self.negative { -1.0 } else { 1.0 };
        product.coefficient *= (sign * self.length.coefficient.powi(self.order.into())).powi(halves / 2);
        product.power(self.length.base, self.halves() * halves / 2);
        let square = self.length.square(g);
        match self.rest {
            Rest::Stumpff(function) => product.power(g.stumpff(function, square), halves),
            Rest::Tangent(function) => {
                product.power(g.stumpff(function, square), halves);
                product.power(g.stumpff(function.of_order(0), square), -halves);
            }
            Rest::Arc(w) => product.power(g.arc(square, w), halves),
        }
    }
}
