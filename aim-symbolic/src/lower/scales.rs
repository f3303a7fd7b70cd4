//! Constant factors on components, moved to where they cost least: a number may be computed some constant times too large, as
//! long as whatever uses it knows.
//!
//! Of `v = c a + d b` only `v/c = a + (d/c) b` is computed, one product less, where the factor c vanishes in other constants.
//! Each number has a scale. Terms of a sum have that of the sum, a product has the product of its factors' scales; inputs,
//! outputs and arguments of functions have 1: linear equations between logarithms. A product with a constant is free where
//! the scale of the result makes up for the constant: one more equation, added where it contradicts no other.

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::rebuild::{Exchange, Missing, Rebuild, operands};
use crate::{Graph, Op, Scalar, ScalarNode};

/// The logarithm of a scale: parameters that are still free and logarithms of constants, each with its factor.
#[derive(Clone, Debug, Default, PartialEq)]
struct Scale {
    /// By number, in order.
    free: Vec<(usize, f64)>,
    /// By the constant's place among all of them, in order.
    constants: Vec<(usize, f64)>,
}

/// `a + k b` of sums of terms in order.
fn combined(a: &[(usize, f64)], k: f64, b: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let (mut a, mut b) = (a.iter().copied().peekable(), b.iter().copied().peekable());
    let mut all = Vec::new();
    loop {
        let (place, factor) = match (a.peek().copied(), b.peek().copied()) {
            (None, None) => return all,
            (Some((i, x)), Some((j, y))) if i == j => {
                a.next();
                b.next();
                (i, x + k * y)
            }
            (Some((i, x)), other) if other.is_none_or(|(j, _)| i < j) => {
                a.next();
                (i, x)
            }
            (_, other) => {
                b.next();
                other.map_or((0, 0.0), |(j, y)| (j, k * y))
            }
        };
        if factor != 0.0 {
            all.push((place, factor));
        }
    }
}

impl Scale {
    /// The same without a whole factor of all terms: it is 0 where this is.
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

/// The scales of a program's numbers.
#[derive(Default)]
struct Scales {
    of: Table<Scalar, Scale>,
    /// By parameter: what it is in terms of those that are free, unless it is free itself.
    solved: Vec<Option<Scale>>,
    /// 2, and the significands of the constants.
    constants: Vec<f64>,
}

/// A constant that is larger, or smaller than one over it, keeps its place: no number may leave the range of floats.
const LARGEST: f64 = 1024.0;

/// Longer programs are left as they are.
const MOST_PRODUCTS: usize = 400;

/// `outputs`, which are lowered, with constants where they cost least; `None` if they are there already.
pub(crate) fn scaled(fold: &mut Fold, outputs: &[Scalar]) -> Option<Vec<Scalar>> {
    let order = parts_first(&fold.g, outputs);
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
    // What frees most first; then what changes least, as the larger of two components does.
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
    // There are few: a sort would be more code than they are worth.
    while let Some((next, _)) =
        equations.iter().enumerate().min_by(|(_, a), (_, b)| b.1.cmp(&a.1).then(a.2.total_cmp(&b.2)))
    {
        let (left, ..) = equations.remove(next);
        freed |= scales.solve(&left);
    }
    freed.then(|| Rebuild::outputs(fold, outputs, &mut scales))
}

/// All that the outputs are made of, parts first.
fn parts_first(g: &Graph, outputs: &[Scalar]) -> Vec<Scalar> {
    let (mut order, mut done) = (Vec::new(), Table::default());
    let mut open: Vec<(Scalar, bool)> = outputs.iter().rev().map(|&s| (s, false)).collect();
    while let Some((s, parts_are_done)) = open.pop() {
        if parts_are_done {
            order.push(s);
        } else if done.insert(s, ()) {
            open.push((s, true));
            open.extend(operands(g.scalar_node(s)).map(|part| (part, false)));
        }
    }
    order
}

/// Of a product with a constant: the constant, the other factor, and whether it is divided by instead.
fn by_constant(g: &Graph, s: Scalar) -> Option<(f64, Scalar, bool)> {
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

/// The ratio of a product with a constant to its other factor.
fn change(g: &Graph, s: Scalar) -> f64 {
    by_constant(g, s).map_or(1.0, |(c, ..)| c.abs().max(1.0 / c.abs()))
}

impl Scales {
    fn parameter(&mut self) -> Scale {
        self.solved.push(None);
        Scale { free: vec![(self.solved.len() - 1, 1.0)], constants: Vec::new() }
    }

    /// The scale of `s`, in terms of parameters that are free.
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

    /// The logarithm of a constant's size.
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

    /// The scale that `s` has by its parts', and what it demands of theirs.
    fn state(&mut self, g: &Graph, s: Scalar) {
        let ScalarNode::Op(op) = g.scalar_node(s) else { return };
        let one = Scale::default();
        let scale = match op {
            Op::Input(_) | Op::Tiny | Op::Constant(_) => one,
            _ if by_constant(g, s).is_some() => self.parameter(),
            Op::Neg(a) => self.of(a),
            // A constant in a sum keeps its digits: 1 − x may be small.
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

    /// The scale that two numbers have in common; constants have any.
    fn common(&mut self, g: &Graph, a: Scalar, b: Scalar) -> Scale {
        if g.constant_of(a).is_none() {
            let scale = self.of(a);
            self.equate(g, b, &scale);
        }
        self.of(if g.constant_of(a).is_none() { a } else { b })
    }

    /// Makes the scale of `s` that one, where no constant contradicts yet.
    fn equate(&mut self, g: &Graph, s: Scalar, scale: &Scale) {
        if g.constant_of(s).is_none() {
            self.solve(&self.of(s).plus(-1.0, scale));
        }
    }

    /// Makes the sum 0; `false` where it cannot be.
    fn solve(&mut self, sum: &Scale) -> bool {
        let sum = self.reduced(sum.clone()).divided();
        let Some(&(place, factor)) = sum.free.iter().rev().find(|(_, k)| k.abs() == 1.0) else {
            // Each by itself, so that no scale is a root.
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

    /// The factor that a product with a constant leaves.
    fn left(&mut self, g: &Graph, s: Scalar) -> Option<(Scalar, bool, Scale)> {
        let (c, a, over) = by_constant(g, s)?;
        let log = self.log(c);
        let left = self.of(s).plus(-1.0, &self.of(a)).plus(if over { -1.0 } else { 1.0 }, &log);
        Some((a, c < 0.0, left))
    }

    /// The number whose logarithm this is; free parameters are 0.
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

    /// A constant, as much larger as `scale` says.
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
        // What constants among the parts are multiplied by.
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
