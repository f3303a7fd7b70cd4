//! Moves constant factors on components to where they cost least. A number may be computed too large by a constant
//! factor, as long as every use of it compensates.
//!
//! Of `v = c a + d b` only `v/c = a + (d/c) b` is computed, one product less, if the factor c can be merged into other
//! constants. Each number has a scale. Terms of a sum have the scale of the sum, and a product has the product of its
//! factors' scales; inputs, outputs and arguments of functions have scale 1. In logarithms these are linear equations.
//! A product with a constant is free if the scale of the result compensates for the constant. This is one more
//! equation, which is added if it contradicts no other.

use crate::ir::node::Node;
use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::rebuild::{Exchange, Missing, Rebuild};
use crate::{Graph, Op, Scalar, ScalarNode};

/// The logarithm of a scale: a linear combination of free parameters and of logarithms of constants.
#[derive(Clone, Debug, Default, PartialEq)]
struct Scale {
    /// Index and coefficient of each free parameter, sorted by index.
    free: Vec<(usize, f64)>,
    /// Index into [`Scales::constants`] and coefficient of each constant, sorted by index.
    constants: Vec<(usize, f64)>,
}

/// Returns `a + k b`, for linear combinations sorted by index.
pub(super) fn combined<I: Copy + Ord>(a: &[(I, f64)], k: f64, b: &[(I, f64)]) -> Vec<(I, f64)> {
    let mut all = a.to_vec();
    for &(index, factor) in b {
        match all.binary_search_by_key(&index, |&(known, _)| known) {
            Ok(place) => all[place].1 += k * factor,
            Err(place) => all.insert(place, (index, k * factor)),
        }
    }
    all.retain(|&(_, factor)| factor != 0.0);
    all
}

impl Scale {
    /// Divides by a common factor of all coefficients. As an equation with right side 0 the result is equivalent.
    fn divided(mut self) -> Self {
        let least = self.free.iter().map(|(_, k)| k.abs()).fold(f64::INFINITY, f64::min);
        if least.is_finite() && self.free.iter().chain(&self.constants).all(|(_, k)| (k / least).fract() == 0.0) {
            self.free.iter_mut().chain(&mut self.constants).for_each(|(_, k)| *k /= least);
        }
        self
    }

    fn plus(&self, k: f64, other: &Self) -> Self {
        Self { free: combined(&self.free, k, &other.free), constants: combined(&self.constants, k, &other.constants) }
    }
}

/// The scales of a program's numbers, and the system of equations between them.
#[derive(Default)]
struct Scales {
    of: Table<Scalar, Scale>,
    /// For each parameter its solution in terms of free parameters; `None` if it is free itself.
    solved: Vec<Option<Scale>>,
    /// The number 2 and the significands of the constants.
    constants: Vec<f64>,
}

/// Limit on constants that may move, and on their reciprocals, so that no number leaves the range of floats.
const LARGEST: f64 = 1024.0;

/// Limit on the number of products with constants; longer programs are left as they are.
const MOST_PRODUCTS: usize = 400;

/// Returns `outputs`, which must be lowered, with constants where they cost least; `None` if nothing can be saved.
pub(crate) fn scaled(fold: &mut Fold, outputs: &[Scalar]) -> Option<Vec<Scalar>> {
    let order = scalars_in_order(&fold.g, outputs);
    let products: Vec<Scalar> = order.iter().copied().filter(|&s| by_constant(&fold.g, s).is_some()).collect();
    if products.is_empty() || products.len() > MOST_PRODUCTS {
        return None;
    }
    let mut scales = Scales { constants: vec![2.0], ..Scales::default() };
    for &s in &order {
        scales.state(&fold.g, s);
    }
    for &output in outputs {
        scales.equate(&fold.g, output, &Scale::default());
    }
    // First the equations that free the most products, then those with the smallest change of scale, as by the larger
    // of two components.
    let mut equations: Vec<(Scale, usize, f64)> = Vec::new();
    for s in products {
        let (change, Some((.., left))) = (change(&fold.g, s), scales.left(&fold.g, s)) else { continue };
        match equations.iter_mut().find(|(known, ..)| *known == left) {
            Some((_, number, _)) => *number += 1,
            None if change <= LARGEST => equations.push((left, 1, change)),
            None => {}
        }
    }
    let mut freed = false;
    // There are only a few equations, and a sort would add more code than it is worth.
    while let Some((next, _)) =
        equations.iter().enumerate().min_by(|(_, a), (_, b)| b.1.cmp(&a.1).then(a.2.total_cmp(&b.2)))
    {
        let (left, ..) = equations.remove(next);
        freed |= scales.solve(&left);
    }
    freed.then(|| Rebuild::outputs(fold, outputs, &mut scales))
}

/// Returns the scalars of lowered outputs, operands first.
pub(super) fn scalars_in_order(g: &Graph, outputs: &[Scalar]) -> Vec<Scalar> {
    let scalar = |node| if let Node::Scalar(s) = node { Some(s) } else { None };
    g.order(outputs).into_iter().filter_map(scalar).collect()
}

/// Splits a product with a constant into the constant, the other operand, and `true` if the constant is a divisor.
pub(super) fn by_constant(g: &Graph, s: Scalar) -> Option<(f64, Scalar, bool)> {
    let (c, a, over) = match g.scalar_node(s) {
        ScalarNode::Op(Op::Mul(a, b)) => match (g.constant_of(a), g.constant_of(b)) {
            (Some(c), None) => (c, b, false),
            (None, Some(c)) => (c, a, false),
            _ => return None,
        },
        ScalarNode::Op(Op::Div(a, b)) => (g.constant_of(b)?, a, true),
        _ => return None,
    };
    (c != 0.0 && c.is_finite() && g.constant_of(a).is_none()).then_some((c, a, over))
}

/// Returns the ratio of a product with a constant to its other factor, or the reciprocal ratio, whichever is at least
/// 1.
fn change(g: &Graph, s: Scalar) -> f64 {
    by_constant(g, s).map_or(1.0, |(c, ..)| c.abs().max(1.0 / c.abs()))
}

impl Scales {
    fn parameter(&mut self) -> Scale {
        self.solved.push(None);
        Scale { free: vec![(self.solved.len() - 1, 1.0)], constants: Vec::new() }
    }

    /// Returns the scale of `s` in terms of free parameters.
    fn of(&self, s: Scalar) -> Scale {
        self.reduced(self.of.copied(s).unwrap_or_default())
    }

    fn reduced(&self, scale: Scale) -> Scale {
        let places: Vec<usize> = scale.free.iter().map(|&(place, _)| place).collect();
        places.into_iter().fold(scale, |scale, place| match &self.solved[place] {
            Some(instead) => replaced(&scale, place, instead),
            None => scale,
        })
    }

    /// Returns the logarithm of |c|.
    fn log(&mut self, c: f64) -> Scale {
        let (mut significand, mut exponent) = (c.abs(), 0);
        while significand >= 2.0 {
            (significand, exponent) = (significand / 2.0, exponent + 1);
        }
        while significand < 1.0 && exponent > -1100 {
            (significand, exponent) = (significand * 2.0, exponent - 1);
        }
        let place = self.constants.iter().position(|&known| known == significand).unwrap_or_else(|| {
            self.constants.push(significand);
            self.constants.len() - 1
        });
        let of_two = [(0, f64::from(exponent))];
        let constants = if significand == 1.0 { Vec::new() } else { vec![(place, 1.0)] };
        Scale { free: Vec::new(), constants: combined(&constants, 1.0, &of_two) }
    }

    /// Computes the scale of `s` from those of its operands, and adds the equations that the operation requires.
    fn state(&mut self, g: &Graph, s: Scalar) {
        let ScalarNode::Op(op) = g.scalar_node(s) else { return };
        let one = Scale::default();
        let scale = match op {
            Op::Input(_) | Op::Tiny | Op::Constant(_) => one,
            _ if by_constant(g, s).is_some() => self.parameter(),
            Op::Neg(a) => self.of(a),
            // Sums with a constant have scale 1, so that the constant keeps its digits: 1 − x may be small.
            Op::Add(a, b) | Op::Sub(a, b) if [a, b].iter().any(|&part| g.constant_of(part).is_some()) => {
                [a, b].into_iter().for_each(|part| self.equate(g, part, &one));
                one
            }
            Op::Add(a, b) | Op::Sub(a, b) => self.common(g, a, b),
            Op::Mul(a, b) => self.of(a).plus(1.0, &self.of(b)),
            Op::Div(a, _) if g.constant_of(a).is_some() => self.parameter(),
            Op::Div(a, b) => self.of(a).plus(-1.0, &self.of(b)),
            Op::SelectLess(a, b, then, otherwise) => {
                [a, b].into_iter().for_each(|part| self.equate(g, part, &one));
                self.common(g, then, otherwise)
            }
            Op::Sqrt(_) | Op::Call(..) | Op::Atan2(..) | Op::Pow(..) => {
                op.operands().for_each(|part| self.equate(g, part, &one));
                one
            }
        };
        self.of.insert(s, scale);
    }

    /// Equates the scales of two numbers and returns their common scale. Constants may have any scale.
    fn common(&mut self, g: &Graph, a: Scalar, b: Scalar) -> Scale {
        if g.constant_of(a).is_none() {
            let scale = self.of(a);
            self.equate(g, b, &scale);
        }
        self.of(if g.constant_of(a).is_none() { a } else { b })
    }

    /// Equates the scale of `s` with `scale`, unless earlier equations contradict.
    fn equate(&mut self, g: &Graph, s: Scalar, scale: &Scale) {
        if g.constant_of(s).is_none() {
            self.solve(&self.of(s).plus(-1.0, scale));
        }
    }

    /// Adds the equation sum = 0. Returns `false` if it contradicts the others.
    fn solve(&mut self, sum: &Scale) -> bool {
        let sum = self.reduced(sum.clone()).divided();
        let Some(&(place, factor)) = sum.free.iter().rev().find(|(_, k)| k.abs() == 1.0) else {
            // Each parameter is set to 0 by itself, so that no scale is a root of constants.
            if sum.constants.is_empty() {
                sum.free.iter().for_each(|&(place, _)| self.replace(place, &Scale::default()));
            }
            return sum.constants.is_empty();
        };
        let rest: Vec<_> = sum.free.iter().copied().filter(|&(other, _)| other != place).collect();
        self.replace(place, &Scale::default().plus(-factor, &Scale { free: rest, constants: sum.constants }));
        true
    }

    fn replace(&mut self, place: usize, instead: &Scale) {
        for solved in self.solved.iter_mut().flatten() {
            *solved = replaced(solved, place, instead);
        }
        self.solved[place] = Some(instead.clone());
    }

    /// Splits a product with a constant into the other factor, `true` if the constant is negative, and the logarithm of
    /// the factor that remains.
    fn left(&mut self, g: &Graph, s: Scalar) -> Option<(Scalar, bool, Scale)> {
        let (c, a, over) = by_constant(g, s)?;
        let log = self.log(c);
        let left = self.of(s).plus(-1.0, &self.of(a)).plus(if over { -1.0 } else { 1.0 }, &log);
        Some((a, c < 0.0, left))
    }

    /// Returns the number with this logarithm, with free parameters 0.
    fn value(&self, scale: &Scale) -> f64 {
        let [mut above, mut below] = [1.0; 2];
        for &(place, factor) in &scale.constants {
            let product = if factor > 0.0 { &mut above } else { &mut below };
            let mut left = factor.abs();
            while left >= 1.0 {
                (*product, left) = (*product * self.constants[place], left - 1.0);
            }
        }
        above / below
    }

    /// Returns the constant multiplied by `scale`.
    fn constant(&mut self, fold: &mut Fold, c: f64, scale: &Scale) -> Scalar {
        if c == 0.0 || scale.constants.is_empty() {
            return fold.g.constant(c);
        }
        let size = self.log(c).plus(1.0, scale);
        let size = self.value(&size);
        fold.g.constant(if c < 0.0 { -size } else { size })
    }
}

fn replaced(scale: &Scale, place: usize, instead: &Scale) -> Scale {
    match scale.free.iter().position(|&(own, _)| own == place) {
        Some(i) => {
            let (_, factor) = scale.free[i];
            let mut without = scale.clone();
            without.free.remove(i);
            without.plus(factor, instead)
        }
        None => scale.clone(),
    }
}

impl Exchange for Scales {
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Result<Option<Scalar>, Missing> {
        if let Some((a, negative, left)) = self.left(&rebuild.fold.g, s) {
            let a = rebuild.scalar(a)?;
            let k = self.value(&left);
            let k = rebuild.fold.g.constant(if negative { -k } else { k });
            return Ok(Some(rebuild.fold.mul(k, a)));
        }
        let ScalarNode::Op(op) = rebuild.fold.g.scalar_node(s) else { return Ok(None) };
        // The factor of constant operands, and the positions of operands that may be constants.
        let (scale, places) = match op {
            Op::Add(..) | Op::Sub(..) => (self.of(s), 0..2),
            Op::Div(_, b) => (self.of(s).plus(1.0, &self.of(b)), 0..1),
            Op::SelectLess(..) => (self.of(s), 2..4),
            _ => return Ok(None),
        };
        let mut numbers = 0..;
        let mut missing = None;
        let op = op.map(|part| {
            let is_scaled = numbers.next().is_some_and(|place| places.contains(&place));
            match rebuild.fold.g.constant_of(part) {
                Some(c) if is_scaled => self.constant(rebuild.fold, c, &scale),
                Some(_) => part,
                None => rebuild.scalar(part).unwrap_or_else(|part| {
                    missing.get_or_insert(part);
                    s
                }),
            }
        });
        match missing {
            Some(missing) => Err(missing),
            None => Ok(Some(rebuild.fold.op(op))),
        }
    }
}
