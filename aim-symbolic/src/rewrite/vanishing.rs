//! Functions that vanish like a power of a length or of a number, split into that power and a factor that does not
//! vanish.

use rustc_hash::{FxHashMap, FxHashSet};

use super::cases::{comparisons, distinguished};
use super::length::Length;
use super::product::{Product, operands, parts, terms};
use super::series::{Expansion, NearZero};
use crate::ir::smooth::factorial;
use crate::{Function, Graph, Op, Scalar, ScalarNode, Stumpff};

/// Limit on the number of different sums that are visited.
const MOST_SUMS: usize = 100;

/// Limit on the number of subexpressions that are searched for a base.
const MOST_PARTS: usize = 100;

/// Limit on the number of products in which a series is tried.
const MOST_NUMBERS: usize = 4;

/// Limit on the number of comparisons by which cases are distinguished, one at a time.
const MOST_CASES: usize = 4;

/// Limit on the depth of functions within functions that vanish together.
const MOST_NESTED: u32 = 6;

/// The order of 0, which vanishes to any order.
const ORDER_OF_ZERO: i32 = 1 << 20;

/// A function of a length r as a sign times a power of r times a rest that is not 0 at r = 0.
#[derive(Clone)]
pub(super) struct Vanishing {
    length: Length,
    order: i32,
    negative: bool,
    rest: Rest,
    /// The length may itself be a function that vanishes, as in sin(atan2(r, w)).
    inside: Option<Box<Self>>,
}

#[derive(Clone)]
enum Rest {
    /// A smooth function of r².
    Stumpff(Stumpff),
    /// A smooth function of this argument.
    StumpffOf(Stumpff, Scalar),
    /// The Stumpff function of order 1 over that of order 0.
    Tangent(Stumpff),
    /// atan2(r, w)/r
    Arc(Scalar),
    /// A sum, each term of which is divided by the power. Selects in it may be stated as one.
    Sum { stated: Option<Scalar> },
    /// Common factors with their powers in halves, times a function `of` a `number`, the length; near 0 its quotient by
    /// the power is the series.
    Series { common: Vec<(Scalar, i32)>, of: Scalar, number: Scalar, series: NearZero },
}

fn one_minus(g: &mut Graph, square: Scalar) -> Scalar {
    let one = g.constant(1.0);
    g.sub(one, square)
}

impl Vanishing {
    fn new(length: Length, order: i32, rest: Rest) -> Self {
        Self { length, order, negative: false, rest, inside: None }
    }

    /// Finds how `s` vanishes: a known function by its argument, or a sum in which every term has a power of a divisor,
    /// by each such divisor.
    pub(super) fn of(g: &mut Graph, s: Scalar, divisors: &[Scalar]) -> Vec<Self> {
        let found = Self::of_functions(g, s, divisors, MOST_NESTED, false);
        if found.is_empty() { Self::of_sum(g, s, divisors) } else { found }
    }

    /// Finds how `s` vanishes like [`of`](Self::of), and also by power series in one of the divisors.
    pub(super) fn of_any(g: &mut Graph, s: Scalar, divisors: &[Scalar]) -> Vec<Self> {
        let mut found = Self::of_functions(g, s, divisors, MOST_NESTED, true);
        let series = Self::of_series(g, s, divisors);
        found.extend(series.filter(|series| found.iter().all(|function| function.base() != series.base())));
        if found.is_empty() { Self::of_sum(g, s, divisors) } else { found }
    }

    /// A sum in which each term has this power of the base, in halves.
    fn sum(base: Scalar, halves: i32) -> Self {
        Self::new(Length::plain(base, 1), halves, Rest::Sum { stated: None })
    }

    /// Returns the base with which a function vanishes.
    pub(super) fn base_of_function(g: &mut Graph, s: Scalar) -> Option<Scalar> {
        Some(Self::of_function(g, s, &[])?.base())
    }

    fn of_sum(g: &mut Graph, s: Scalar, divisors: &[Scalar]) -> Vec<Self> {
        if parts(g, s).is_none() {
            return Vec::new();
        }
        let found = Self::of_terms(g, s, divisors);
        if !found.is_empty() || !divisors.iter().any(|&base| g.may_be_of_length_zero(base)) {
            return found;
        }
        // In some cases it may vanish.
        let comparisons = comparisons(g, s);
        let of_cases = |comparison| {
            let stated = distinguished(g, s, comparison);
            let mut found = Self::of_terms(g, stated, divisors);
            found.retain(|found| found.order > 0);
            found.iter_mut().for_each(|found| found.rest = Rest::Sum { stated: Some(stated) });
            (!found.is_empty()).then_some(found)
        };
        comparisons.into_iter().take(MOST_CASES).find_map(of_cases).unwrap_or_default()
    }

    fn of_terms(g: &mut Graph, sum: Scalar, divisors: &[Scalar]) -> Vec<Self> {
        let orders = orders(g, sum, divisors, &mut FxHashMap::default()).unwrap_or_default();
        // A negative power of a plain input stays as stated.
        let is_plain = |g: &Graph, base| matches!(g.scalar_node(base), ScalarNode::Op(Op::Input(_)));
        let by = |(&base, order): (&Scalar, i32)| {
            (is_order(order) && !(order < 0 && is_plain(g, base))).then(|| Self::sum(base, order))
        };
        divisors.iter().zip(orders).filter_map(by).collect()
    }

    fn of_series(g: &mut Graph, s: Scalar, divisors: &[Scalar]) -> Option<Self> {
        let s = g.with_lengths_stated(s);
        let varies = |g: &Graph, &&base: &&Scalar| base != s && depends_on(g, s, base);
        let bases: Vec<Scalar> = divisors.iter().filter(|base| varies(g, base)).copied().collect();
        bases.into_iter().find_map(|base| {
            let root = root(g, base);
            // Where a root is taken, the base is not negative.
            let is_length = g.is_length(base) || depends_on(g, s, root);
            let mut numbers = vec![(base, Length::plain(base, 2), 1)];
            if is_length {
                numbers.push((root, Length::plain(base, 1), 1));
            }
            for (number, length) in multiples(g, s, base) {
                numbers.extend([1, 2].map(|power| (number, length.clone(), power)));
            }
            numbers.into_iter().find_map(|(number, length, power)| {
                let is_length = if power == 1 { g.is_length(number) } else { is_length && length.halves == 2 };
                let others = length.others.iter().map(|&(factor, _)| factor);
                let kept: Vec<Scalar> = divisors.iter().copied().chain(others).collect();
                let (s, common) = common_factors(g, s, base, &kept);
                let inside = Length::of_product(g, &length).unwrap_or_else(|| length.clone());
                let (order, series) = Expansion::new(&inside, power, is_length).near_zero(g, s)?;
                let order = i32::try_from(order).ok().filter(|&order| order > 0)?;
                Some(Self::new(length, order, Rest::Series { common, of: s, number, series }))
            })
        })
    }

    /// Finds how a function vanishes: by its argument, and by what the argument vanishes with, down to this depth; with
    /// `any` also by power series of the argument.
    fn of_functions(g: &mut Graph, s: Scalar, divisors: &[Scalar], depth: u32, any: bool) -> Vec<Self> {
        let Some(first) = Self::of_function(g, s, divisors) else { return Vec::new() };
        let mut found: Vec<Self> = Vec::new();
        for outer in Self::by_functions(g, s, &first) {
            let argument = outer.length.base;
            if outer.length.halves != 2 || depth == 0 {
                continue;
            }
            let others: Vec<Scalar> = divisors.iter().copied().filter(|&base| base != argument).collect();
            let mut insides = Self::of_functions(g, argument, &others, depth - 1, any);
            if insides.is_empty() {
                insides =
                    if parts(g, argument).is_some() { Self::of_sum } else { Self::of_terms }(g, argument, &others);
            }
            if insides.is_empty() && any {
                insides.extend(Self::of_series(g, argument, &others));
            }
            for inside in insides {
                let base = inside.base();
                let is_new = found.iter().all(|found| found.base() != base);
                if is_new && inside.halves() > 0 && others.contains(&base) {
                    found.push(Self { inside: Some(Box::new(inside)), ..outer.clone() });
                }
            }
        }
        found.push(first);
        found
    }

    /// Returns how a function vanishes, as `first` and with each other factor of its argument that is a function.
    fn by_functions(g: &mut Graph, s: Scalar, first: &Self) -> Vec<Self> {
        let mut factors = first.length.others.clone();
        if let Some(product) = Product::of(g, first.length.base) {
            factors.extend(product.powers.into_iter().filter(|&(factor, _)| factor != first.length.base));
        }
        let is_function = |g: &Graph, s| matches!(g.scalar_node(s), ScalarNode::Op(Op::Call(..) | Op::Atan2(..)));
        factors.retain(|&(factor, halves)| halves == 2 && is_function(g, factor));
        let others = factors.into_iter().filter_map(|(factor, _)| Self::of_function(g, s, &[factor]));
        [first.clone()].into_iter().chain(others).collect()
    }

    /// Finds how a function vanishes with one of these bases: by its argument, or by a function that is a factor of
    /// the argument.
    fn of_nested(g: &mut Graph, s: Scalar, bases: &[Scalar]) -> Option<Self> {
        let first = Self::of_function(g, s, bases)?;
        if bases.contains(&first.base()) {
            return Some(first);
        }
        Self::by_functions(g, s, &first).into_iter().filter(|outer| outer.length.halves == 2).find_map(|outer| {
            let inside = Self::of_function(g, outer.length.base, bases)?;
            let is_found = bases.contains(&inside.base()) && inside.halves() > 0;
            is_found.then(|| Self { inside: Some(Box::new(inside)), ..outer })
        })
    }

    fn of_function(g: &mut Graph, s: Scalar, divisors: &[Scalar]) -> Option<Self> {
        let [circular, hyperbolic] = [false, true].map(|hyperbolic| Stumpff { hyperbolic, order: 1 });
        let one = |length, rest| Some(Self::new(length, 1, rest));
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Call(function, a)) => match function {
                Function::Sin => one(Length::of(g, a, divisors)?, Rest::Stumpff(circular)),
                Function::Sinh => one(Length::of(g, a, divisors)?, Rest::Stumpff(hyperbolic)),
                Function::Tan => one(Length::of(g, a, divisors)?, Rest::Tangent(circular)),
                Function::Tanh => one(Length::of(g, a, divisors)?, Rest::Tangent(hyperbolic)),
                // asin t = atan2(t, √(1 − t²))
                Function::Asin => {
                    let length = Length::of(g, a, divisors)?;
                    let square = length.square(g);
                    let rest = one_minus(g, square);
                    one(length, Rest::Arc(g.sqrt(rest)))
                }
                // acos w = atan2(√(1 − w²), w)
                Function::Acos => {
                    let base = g.around_one(a);
                    one(Length::plain(base, 1), Rest::Arc(a))
                }
                _ => None,
            },
            ScalarNode::Op(Op::Atan2(y, x)) => one(Length::of(g, y, divisors)?, Rest::Arc(x)),
            ScalarNode::Op(Op::Sub(a, b)) => {
                let found =
                    Self::limit_of_stumpff(g, a, b, divisors).or_else(|| Self::power_from_one(g, a, b, divisors));
                if found.is_some() {
                    return found;
                }
                let (length, negative, function) = Self::difference(g, a, b)
                    .map(|(length, function)| (length, false, function))
                    .or_else(|| Self::difference(g, b, a).map(|(length, function)| (length, true, function)))?;
                let length = Length::of(g, length, divisors)?;
                Some(Self { negative, ..Self::new(length, function.order.into(), Rest::Stumpff(function)) })
            }
            _ => None,
        }
    }

    /// If a − b is 1 − cos r, r − sin r, cosh r − 1 or sinh r − r, returns r and the corresponding Stumpff function.
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

    /// 1/k! − cₖ(s) = s cₖ₊₂(s), or −s cₖ₊₂(−s) with the hyperbolic function.
    fn limit_of_stumpff(g: &mut Graph, a: Scalar, b: Scalar, divisors: &[Scalar]) -> Option<Self> {
        let (limit, other, negative) = match (g.constant_of(a), g.constant_of(b)) {
            (Some(limit), None) => (limit, b, false),
            (None, Some(limit)) => (limit, a, true),
            _ => return None,
        };
        let ScalarNode::Stumpff(function, s) = g.scalar_node(other) else { return None };
        let rest = Rest::StumpffOf(function.of_order(function.order + 2), s);
        let length = Length::of(g, s, divisors)?;
        let negative = negative != function.hyperbolic;
        (limit == 1.0 / factorial(function.order)).then_some(Self { negative, ..Self::new(length, 1, rest) })
    }

    /// aᵖ − 1 = eʷ − 1 with w = p ln a
    fn power_from_one(g: &mut Graph, a: Scalar, b: Scalar, divisors: &[Scalar]) -> Option<Self> {
        let (power, one, negative) = if g.constant_of(a).is_some() { (b, a, true) } else { (a, b, false) };
        let ScalarNode::Op(Op::Pow(a, p)) = g.scalar_node(power) else { return None };
        if g.constant_of(one) != Some(1.0) || g.constant_of(p).is_some() {
            return None;
        }
        let logarithm = g.call(Function::Ln, a);
        let (number, of) = (g.mul(p, logarithm), g.sub(power, one));
        let exponential = g.call(Function::Exp, number);
        let rest = g.sub(exponential, one);
        let (_, series) = Expansion::new(&Length::plain(number, 2), 1, false).near_zero(g, rest)?;
        let (base, other) = if divisors.contains(&p) { (p, logarithm) } else { (logarithm, p) };
        let length = Length { others: vec![(other, 2)], ..Length::plain(base, 2) };
        Some(Self { negative, ..Self::new(length, 1, Rest::Series { common: Vec::new(), of, number, series }) })
    }

    /// Returns the power of the base, in halves.
    pub(super) fn halves(&self) -> i32 {
        self.order * self.length.halves * self.inside.as_ref().map_or(2, |inside| inside.halves()) / 2
    }

    /// Returns `true` if the power of the length can be taken out of the function in `product`. If the product has an
    /// odd number of halves of it, a root, the factors must not be negative: the root of x² is |x|. No power may be less
    /// than a half. Neither may the factors be negative in a guarded reciprocal, or it could not be stated by them.
    pub(super) fn is_free_in(&self, g: &Graph, product: &Product, s: Scalar) -> bool {
        self.is_free(g, product, product.power_of(s), product.is_guarded(s))
    }

    fn is_free(&self, g: &Graph, product: &Product, power: i32, is_guarded: bool) -> bool {
        let is_root = power % 2 != 0;
        if !is_root && !is_guarded {
            return true;
        }
        let base = self.length.base;
        let is_of_root = self.length.halves == 1 && !matches!(self.rest, Rest::Sum { .. });
        let is_power = self.coefficient() > 0.0
            && self.halves() % 2 == 0
            && (is_of_root || product.power_of(base) % 2 != 0 || g.is_length(base));
        let common = if let Rest::Series { common, .. } = &self.rest { &common[..] } else { &[] };
        let others = self.length.others.iter().map(|&(factor, halves)| (factor, halves * self.order));
        let is_free = |(factor, halves): (Scalar, i32)| {
            g.is_length(factor) && halves * power % 2 == 0 || is_root && is_even_power(halves)
        };
        (!is_root || is_power)
            && others.chain(common.iter().copied()).all(is_free)
            && self.inside.as_ref().is_none_or(|inside| inside.is_free(g, product, self.order * power, is_guarded))
    }

    /// Returns the constant factor of the power of the length.
    fn coefficient(&self) -> f64 {
        let sign = if self.negative { -1.0 } else { 1.0 };
        sign * self.length.coefficient.powi(self.order)
    }

    /// Returns the base of the innermost length.
    pub(super) fn base(&self) -> Scalar {
        self.inside.as_ref().map_or(self.length.base, |inside| inside.base())
    }

    /// Takes the power of the length out of the function `s` in `product`; `None` if the product becomes too long.
    pub(super) fn take_out(
        &self,
        g: &mut Graph,
        product: &mut Product,
        s: Scalar,
        quotients: &mut Quotients,
    ) -> Option<()> {
        let is_guarded = product.is_guarded(s);
        let halves = product.remove(s);
        product.guard(is_guarded);
        product.coefficient *= self.coefficient().powi(halves / 2);
        if halves % 2 != 0 {
            product.coefficient *= self.coefficient().sqrt().powi(halves % 2);
        }
        product.power(self.length.base, self.order * self.length.halves * halves / 2);
        // The root of a square is not negative.
        let times = |g: &mut Graph, product: &mut Product, factor, power| {
            if halves % 2 != 0 && is_even_power(power) && !g.is_length(factor) {
                product.power_of_size(g, factor, power * halves / 2);
            } else {
                product.power(factor, power * halves / 2);
            }
        };
        self.length.others.iter().for_each(|&(factor, power)| times(g, product, factor, power * self.order));
        let square = self.length.square(g);
        match &self.rest {
            &Rest::Stumpff(function) => product.power(g.stumpff(function, square), halves),
            &Rest::StumpffOf(function, argument) => product.power(g.stumpff(function, argument), halves),
            &Rest::Tangent(function) if function.hyperbolic => {
                let tangent = Self::hyperbolic_tangent(g, function, square);
                product.power(tangent, halves);
            }
            &Rest::Tangent(function) => {
                product.power(g.stumpff(function, square), halves);
                product.power(g.stumpff(function.of_order(0), square), -halves);
            }
            &Rest::Arc(w) => product.power(g.arc(square, w), halves),
            Rest::Sum { stated } => {
                let rest = quotients.over(g, stated.unwrap_or(s), self.order)?;
                product.power(rest, halves);
            }
            Rest::Series { common, of, number, series } => {
                common.iter().for_each(|&(factor, power)| times(g, product, factor, power));
                let quotient = self.quotient(g, *of, *number, series);
                product.power(quotient, halves);
            }
        }
        product.guard(false);
        match &self.inside {
            Some(inside) => inside.take_out(g, product, self.length.base, quotients),
            None => Some(()),
        }
    }

    /// Returns tanh r / r of r²: c₁/c₀, and from r = 20 on, long before cosh r overflows, the quotient itself.
    fn hyperbolic_tangent(g: &mut Graph, function: Stumpff, square: Scalar) -> Scalar {
        let [odd, even] = [1, 0].map(|order| g.stumpff(function.of_order(order), square));
        let near = g.div(odd, even);
        let (edge, one) = (400.0, g.constant(1.0));
        // Avoids a division by 0 in the branch that is not taken.
        let guarded = Self::where_above(g, square, edge, square, one);
        let r = g.sqrt(guarded);
        // Dividing by r itself would be a quotient that the rule rewrites again.
        let divisor = Self::where_above(g, square, edge, r, one);
        let tangent = g.call(Function::Tanh, r);
        let far = g.div(tangent, divisor);
        Self::where_above(g, square, edge, far, near)
    }

    /// Returns `then` where a square is greater than the edge, else `otherwise`.
    fn where_above(g: &mut Graph, square: Scalar, edge: f64, then: Scalar, otherwise: Scalar) -> Scalar {
        let edge = g.constant(edge);
        let margin = g.sub(square, edge);
        let tiny = g.intern_scalar(ScalarNode::Op(Op::Tiny));
        g.select_less(tiny, margin, then, otherwise)
    }

    /// Returns `s` divided by the power of the length, as a series within the radius.
    fn quotient(&self, g: &mut Graph, s: Scalar, number: Scalar, near: &NearZero) -> Scalar {
        let NearZero { coefficients, radius, degrees } = near;
        let square = self.length.square(g);
        let is_even = coefficients.iter().skip(1).step_by(2).all(|&c| c == 0.0);
        let (step, x) = if is_even { (2, square) } else { (1, number) };
        let zero = g.constant(0.0);
        let series = coefficients.iter().step_by(step).rev().fold(zero, |sum, &c| {
            let (product, c) = (g.mul(sum, x), g.constant(c));
            g.add(product, c)
        });
        let mut homogeneous = Product::new();
        degrees.iter().for_each(|&(factor, degree)| homogeneous.power(factor, degree));
        let series = match homogeneous.stated(g) {
            Some(factor) => g.mul(factor, series),
            None => series,
        };
        // Avoids a division by 0 where the series is taken.
        let one = g.constant(1.0);
        let power = (0..self.order / 2).fold(one, |power, _| g.mul(power, square));
        let power = if self.order % 2 == 0 { power } else { g.mul(power, number) };
        let divisor = Self::where_above(g, square, radius.powi(2), power, one);
        let closed = g.div(s, divisor);
        Self::where_above(g, square, radius.powi(2), closed, series)
    }
}

/// Splits off the factors, other than divisors and what depends on the base, that all terms of a sum share. Returns the
/// rest, and the factors with their powers in halves.
fn common_factors(g: &mut Graph, s: Scalar, base: Scalar, divisors: &[Scalar]) -> (Scalar, Vec<(Scalar, i32)>) {
    let (mut rest, mut common) = (s, Vec::new());
    let first = terms(g, s).first().and_then(|&term| Product::of(g, term)).filter(|_| parts(g, s).is_some());
    let bases = first.map_or(Vec::new(), |first| first.powers.iter().map(|&(base, _)| base).collect());
    let is_free = |factor: &Scalar| !divisors.contains(factor) && !depends_on(g, *factor, base);
    let bases: Vec<Scalar> = bases.into_iter().filter(is_free).collect();
    let orders = orders(g, s, &bases, &mut FxHashMap::default()).unwrap_or_default();
    for (base, order) in bases.into_iter().zip(orders).filter(|&(_, order)| is_order(order)) {
        if let Some(without) = Quotients::by(base).over(g, rest, order) {
            rest = without;
            common.push((base, order));
        }
    }
    (rest, common)
}

/// Returns `true` if `s` depends on `base` or on its root.
fn depends_on(g: &Graph, s: Scalar, base: Scalar) -> bool {
    let (mut known, mut open) = (FxHashSet::default(), vec![s]);
    while let Some(s) = open.pop() {
        let is_root = match g.scalar_node(s) {
            ScalarNode::Norm(v) => g.scalar_node(base) == ScalarNode::Dot(v, v),
            ScalarNode::Op(Op::Sqrt(a)) => a == base,
            _ => false,
        };
        if s == base || is_root {
            return true;
        }
        if known.len() < MOST_PARTS && known.insert(s) {
            open.extend(operands(g, s));
        }
    }
    false
}

/// Returns the products in `s` of this factor or its square with others, those with fewest others first.
fn multiples(g: &mut Graph, s: Scalar, factor: Scalar) -> Vec<(Scalar, Length)> {
    let mut found: Vec<(Scalar, Length)> = Vec::new();
    let (mut known, mut open) = (FxHashSet::default(), vec![s]);
    while let Some(s) = open.pop().filter(|_| known.len() < MOST_PARTS) {
        if !known.insert(s) {
            continue;
        }
        open.extend(operands(g, s));
        if matches!(g.scalar_node(s), ScalarNode::Op(Op::Mul(..) | Op::Div(..) | Op::Neg(..)))
            && let Some(length) = Length::of_power(g, s, &[factor], &[1, 2, 4])
            && !length.others.is_empty()
        {
            found.push((s, length));
        }
    }
    found.sort_by_key(|(_, length)| (length.halves, length.others.len()));
    found.truncate(MOST_NUMBERS);
    found
}

fn root(g: &mut Graph, square: Scalar) -> Scalar {
    match g.scalar_node(square) {
        ScalarNode::Dot(v, w) if v == w => g.norm(v),
        _ => g.sqrt(square),
    }
}

/// Returns `true` for a power, in halves, that is the square of a number of any sign.
fn is_even_power(halves: i32) -> bool {
    halves % 4 == 0
}

/// Returns `true` if there is a power to take out: the base occurs, and the expression is not 0.
fn is_order(order: i32) -> bool {
    order != 0 && order < ORDER_OF_ZERO
}

/// The lowest powers of some bases in sums, in halves, by sum.
type Orders = FxHashMap<Scalar, Vec<i32>>;

/// Returns the lowest power of each base among the terms of a sum, in halves; `None` if the sum is too long.
/// Uses and adds to what is `known` of sums with these bases.
fn orders(g: &mut Graph, s: Scalar, bases: &[Scalar], known: &mut Orders) -> Option<Vec<i32>> {
    if let Some((a, b)) = parts(g, s) {
        if let Some(orders) = known.get(&s) {
            return Some(orders.clone());
        }
        if known.len() >= MOST_SUMS {
            return None;
        }
        // Counts before the sums within it do.
        known.insert(s, Vec::new());
        let (a, b) = (orders(g, a, bases, known)?, orders(g, b, bases, known)?);
        let is_choice = matches!(g.scalar_node(s), ScalarNode::Op(Op::SelectLess(..)));
        let of_both = |((a, b), &base): ((i32, i32), &Scalar)| match (a.min(b), a.max(b)) {
            (least, most) if is_choice && g.may_be_of_length_zero(base) => match (least, most) {
                (..0, 0..ORDER_OF_ZERO) => 0,
                // The other branch is divided by the length, too, by the convention for a length of 0.
                (0, 1..ORDER_OF_ZERO) => most,
                _ => least,
            },
            // A base that only one branch divides by may be invalid where the other branch is taken.
            (..0, 0..) if is_choice => 0,
            (least, _) => least,
        };
        let orders: Vec<i32> = a.into_iter().zip(b).zip(bases).map(of_both).collect();
        known.insert(s, orders.clone());
        return Some(orders);
    }
    let product = Product::of(g, s)?;
    if product.coefficient == 0.0 {
        return Some(vec![ORDER_OF_ZERO; bases.len()]);
    }
    let mut all: Vec<i32> = bases.iter().map(|&base| product.power_of(base)).collect();
    for &(factor, power) in product.powers.iter().filter(|(factor, _)| !bases.contains(factor)) {
        if parts(g, factor).is_some() {
            let of_sum = orders(g, factor, bases, known)?;
            if of_sum.contains(&ORDER_OF_ZERO) && power > 0 {
                return Some(of_sum);
            }
            for ((all, order), &base) in all.iter_mut().zip(of_sum).zip(bases) {
                let is_free = || Vanishing::sum(base, order).is_free_in(g, &product, factor);
                if is_order(order) && is_free() {
                    *all += order * power / 2;
                }
            }
        } else if let Some(found) = Vanishing::of_nested(g, factor, bases)
            && let Some(place) = bases.iter().position(|&base| base == found.base())
            && found.is_free_in(g, &product, factor)
        {
            all[place] += found.halves() * power / 2;
        }
    }
    Some(all)
}

/// Quotients of sums by powers of a base.
pub(super) struct Quotients {
    base: Scalar,
    orders: Orders,
    /// The quotients by sum and power, in halves.
    known: FxHashMap<(Scalar, i32), Scalar>,
}

impl Quotients {
    pub(super) fn by(base: Scalar) -> Self {
        Self { base, orders: Orders::default(), known: FxHashMap::default() }
    }

    /// Divides each term of `s` by a power of the base, in halves; `None` if the sum is too long.
    fn over(&mut self, g: &mut Graph, s: Scalar, halves: i32) -> Option<Scalar> {
        let Some((a, b)) = parts(g, s) else { return self.term_over(g, s, halves) };
        if let Some(&quotient) = self.known.get(&(s, halves)) {
            return Some(quotient);
        }
        if self.known.len() >= MOST_SUMS {
            return None;
        }
        // Counts before the sums within it do.
        self.known.insert((s, halves), s);
        let (a, b) = (self.over(g, a, halves)?, self.over(g, b, halves)?);
        let quotient = match g.scalar_node(s) {
            ScalarNode::Op(Op::Add(..)) => g.add(a, b),
            ScalarNode::Op(Op::SelectLess(less, than, ..)) => g.select_less(less, than, a, b),
            _ => g.sub(a, b),
        };
        self.known.insert((s, halves), quotient);
        Some(quotient)
    }

    /// Divides a term that is not a sum.
    fn term_over(&mut self, g: &mut Graph, s: Scalar, halves: i32) -> Option<Scalar> {
        let base = self.base;
        let mut product = Product::of(g, s)?;
        if product.coefficient == 0.0 {
            return Some(g.constant(0.0));
        }
        for (factor, _) in product.powers.clone() {
            let found = if factor == base {
                None
            } else if parts(g, factor).is_some() {
                Some(Vanishing::sum(base, orders(g, factor, &[base], &mut self.orders)?[0]))
            } else {
                Vanishing::of_nested(g, factor, &[base])
            };
            let is_free = |found: &Vanishing| is_order(found.halves()) && found.is_free_in(g, &product, factor);
            if let Some(found) = found.filter(is_free) {
                found.take_out(g, &mut product, factor, self)?;
            }
        }
        product.power(base, -halves);
        let missing = -product.power_of(base);
        if missing <= 0 || !g.is_length(base) {
            return Some(product.stated(g).unwrap_or_else(|| g.constant(1.0)));
        }
        product.remove(base);
        let stated = product.stated(g).unwrap_or_else(|| g.constant(1.0));
        let length = root(g, base);
        let reciprocal = g.reciprocal(length);
        Some((0..missing).fold(stated, |quotient, _| g.mul(quotient, reciprocal)))
    }
}
