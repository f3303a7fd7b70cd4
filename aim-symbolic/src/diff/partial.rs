//! Partial derivatives of scalar operations by their operands, shared by both sweeps.

use crate::ir::smooth::arc_factor;
use crate::{Angle, Function, Graph, InputKind, Op, Scalar, ScalarNode, Stumpff};

/// A partial derivative, in the form that is cheapest to multiply by.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Partials {
    /// 1
    One,
    /// −1
    MinusOne,
    /// A factor f.
    Factor(Scalar),
    /// A factor with a minus sign, −f.
    MinusFactor(Scalar),
    /// The reciprocal of a divisor, 1/d.
    Over(Scalar),
    /// A quotient with a minus sign, −f/d.
    MinusOver(Scalar, Scalar),
}

impl Graph {
    /// Returns `bar` times a partial derivative.
    pub(crate) fn times(&mut self, bar: Scalar, partial: Partials) -> Scalar {
        let one = self.constant_of(bar) == Some(1.0);
        match partial {
            Partials::One => bar,
            Partials::MinusOne => self.neg(bar),
            Partials::Factor(factor) if one => factor,
            Partials::Factor(factor) => self.mul(bar, factor),
            Partials::MinusFactor(factor) => {
                let along = self.times(bar, Partials::Factor(factor));
                self.neg(along)
            }
            Partials::Over(divisor) => self.div(bar, divisor),
            Partials::MinusOver(factor, divisor) => {
                let over = self.div(bar, divisor);
                let along = self.mul(over, factor);
                self.neg(along)
            }
        }
    }

    /// 2 a
    pub(crate) fn twice(&mut self, a: Scalar) -> Scalar {
        let two = self.constant(2.0);
        self.times(a, Partials::Factor(two))
    }

    /// Returns the partial derivatives of `scalar` by its `wanted` scalar operands. Does not handle selects and
    /// functions of vectors.
    pub(crate) fn partials(&mut self, scalar: Scalar, wanted: impl Fn(Scalar) -> bool) -> Vec<(Scalar, Partials)> {
        use Partials::{Factor, MinusFactor, MinusOne, MinusOver, One, Over};
        let mut partials = match self.scalar_node(scalar) {
            ScalarNode::Op(Op::Add(a, b)) => vec![(a, One), (b, One)],
            ScalarNode::Op(Op::Sub(a, b)) => vec![(a, One), (b, MinusOne)],
            ScalarNode::Op(Op::Mul(a, b)) if a == b => {
                let twice = if wanted(a) { self.twice(a) } else { a };
                vec![(a, Factor(twice))]
            }
            ScalarNode::Op(Op::Mul(a, b)) => vec![(a, Factor(b)), (b, Factor(a))],
            ScalarNode::Op(Op::Div(a, b)) => vec![(a, Over(b)), (b, MinusOver(scalar, b))],
            ScalarNode::Op(Op::Neg(a)) => vec![(a, MinusOne)],
            ScalarNode::Op(Op::Sqrt(a)) if wanted(a) => {
                let (half, reciprocal) = (self.constant(0.5), self.reciprocal(scalar));
                vec![(a, Factor(self.mul(half, reciprocal)))]
            }
            ScalarNode::Stumpff(function, s) if wanted(s) => vec![(s, Factor(self.slope_of_stumpff(function, s)))],
            ScalarNode::Arc(order, s, w) => self.slopes_of_arc(order, s, w),
            ScalarNode::Reciprocal(a) if wanted(a) => vec![(a, MinusFactor(self.mul(scalar, scalar)))],
            // Piecewise constant.
            ScalarNode::Op(Op::Call(Function::Floor, _)) => vec![],
            ScalarNode::Op(Op::Call(function, a)) if wanted(a) => vec![(a, self.slope(function, a, scalar))],
            ScalarNode::Op(Op::Atan2(y, x)) if wanted(y) || wanted(x) => {
                let (yy, xx) = (self.mul(y, y), self.mul(x, x));
                let square = self.add(yy, xx);
                let reciprocal = self.reciprocal(square);
                let (by_y, by_x) = (self.mul(x, reciprocal), self.mul(y, reciprocal));
                vec![(y, Factor(by_y)), (x, MinusFactor(by_x))]
            }
            ScalarNode::Op(Op::Pow(a, b)) if wanted(a) || wanted(b) => {
                // ∂(aᵇ)/∂a = b aᵇ⁻¹ and ∂(aᵇ)/∂b = aᵇ ln a; both are set to 0 at a = 0 if they would be infinite there.
                let (one, zero) = (self.constant(1.0), self.constant(0.0));
                let by_a = if self.constant_of(b).is_some_and(|b| b.fract() != 0.0) {
                    // Negative bases have no power with a fractional exponent.
                    let (product, over) = (self.mul(b, scalar), self.over_positive(a));
                    self.mul(product, over)
                } else {
                    let less = self.sub(b, one);
                    let power = self.pow(a, less);
                    let slope = self.mul(b, power);
                    let at_zero = self.select_less(b, one, zero, slope);
                    let below = self.select_less(a, zero, slope, at_zero);
                    self.select_less(zero, a, slope, below)
                };
                let log = self.call(Function::Ln, a);
                let along = self.mul(scalar, log);
                let by_b = self.select_less(zero, a, along, zero);
                vec![(a, Factor(by_a)), (b, Factor(by_b))]
            }
            _ => vec![],
        };
        partials.retain(|&(part, _)| wanted(part));
        partials
    }

    /// Returns 1 / a, or 0 unless a > 0.
    fn over_positive(&mut self, a: Scalar) -> Scalar {
        let (one, zero) = (self.constant(1.0), self.constant(0.0));
        let over = self.div(one, a);
        self.select_less(zero, a, over, zero)
    }

    /// Returns the angle of an input that is its sine or cosine, and the derivative of the input by the angle.
    pub(crate) fn slope_of_input(&self, scalar: Scalar) -> Option<(Angle, Partials)> {
        let ScalarNode::Op(Op::Input(index)) = self.scalar_node(scalar) else { return None };
        match self.inputs().get(index as usize)?.1 {
            InputKind::Given => None,
            InputKind::Sin(angle) => Some((angle, Partials::Factor(self.sin_cos(angle).1))),
            InputKind::Cos(angle) => Some((angle, Partials::MinusFactor(self.sin_cos(angle).0))),
        }
    }

    /// dcₖ/ds = (k cₖ₊₂ − cₖ₊₁)/2; the hyperbolic function of −s has the opposite sign.
    fn slope_of_stumpff(&mut self, function: Stumpff, s: Scalar) -> Scalar {
        let k = function.order;
        let [next, second] = [1, 2].map(|more| self.stumpff(function.of_order(k + more), s));
        let [half, times] = [if function.hyperbolic { 0.5 } else { -0.5 }, f64::from(k)].map(|c| self.constant(c));
        let second = self.mul(times, second);
        let difference = if k == 0 { next } else { self.sub(next, second) };
        self.mul(half, difference)
    }

    /// ∂aⱼ/∂s = aⱼ₊₁/2 and ∂aⱼ/∂w = −(−2)ʲ j!/qʲ⁺¹ with q = s + w².
    fn slopes_of_arc(&mut self, order: u8, s: Scalar, w: Scalar) -> Vec<(Scalar, Partials)> {
        let (half, factor) = (self.constant(0.5), self.constant(arc_factor(order)));
        let next = self.intern_scalar(ScalarNode::Arc(order + 1, s, w));
        let square = self.mul(w, w);
        let q = self.add(s, square);
        let reciprocal = self.reciprocal(q);
        let by_w = (0..=order).fold(factor, |product, _| self.mul(product, reciprocal));
        vec![(s, Partials::Factor(self.mul(half, next))), (w, Partials::MinusFactor(by_w))]
    }

    /// The derivative of `value = function(a)`.
    fn slope(&mut self, function: Function, a: Scalar, value: Scalar) -> Partials {
        match function {
            Function::Sin => Partials::Factor(self.call(Function::Cos, a)),
            Function::Cos => Partials::MinusFactor(self.call(Function::Sin, a)),
            Function::Tan => {
                let (one, square) = (self.constant(1.0), self.mul(value, value));
                Partials::Factor(self.add(one, square))
            }
            Function::Asin | Function::Acos => {
                // Computing 1 − a² directly would lose its digits near |a| = 1.
                let square = self.around_one(a);
                let root = self.sqrt(square);
                let reciprocal = self.reciprocal(root);
                if function == Function::Asin {
                    Partials::Factor(reciprocal)
                } else {
                    Partials::MinusFactor(reciprocal)
                }
            }
            Function::Exp => Partials::Factor(value),
            Function::Ln => Partials::Factor(self.over_positive(a)),
            Function::Sinh => Partials::Factor(self.call(Function::Cosh, a)),
            Function::Cosh => Partials::Factor(self.call(Function::Sinh, a)),
            Function::Tanh => {
                let (one, square) = (self.constant(1.0), self.mul(value, value));
                Partials::Factor(self.sub(one, square))
            }
            Function::Floor => Partials::Factor(self.constant(0.0)),
        }
    }
}
