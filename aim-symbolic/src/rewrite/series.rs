//! Power series of expressions in one length or number. They reveal that a sum vanishes at 0 even if none of its terms
//! does.

use rustc_hash::FxHashMap;

use super::length::Length;
use super::product::operands;
use crate::ir::smooth::factorial;
use crate::{Function, Graph, Op, Scalar, ScalarNode, Stumpff};

/// The number of coefficients of a series.
const TERMS: usize = 30;

/// Limit on the number of nodes; larger expressions are not expanded.
const MOST_NODES: usize = 200;

/// A coefficient, and as `size` the sum of the absolute values that it was computed from, which tells 0 from a rounding
/// residue.
#[derive(Clone, Copy, Debug, Default)]
struct Coefficient {
    value: f64,
    size: f64,
}

impl Coefficient {
    fn new(value: f64) -> Self {
        Self { value, size: value.abs() }
    }

    fn is_zero(self) -> bool {
        self.value.abs() <= 16.0 * f64::EPSILON * self.size
    }

    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, size: self.size + other.size }
    }

    fn times(self, other: Self) -> Self {
        Self { value: self.value * other.value, size: self.size * other.size }
    }

    fn scaled(self, by: f64) -> Self {
        Self { value: self.value * by, size: self.size * by.abs() }
    }
}

/// A power series in u, truncated after [`TERMS`] coefficients.
#[derive(Clone, Copy, Debug)]
struct Series([Coefficient; TERMS]);

/// The sum of f(j) over j.
fn sum(range: impl Iterator<Item = usize>, f: impl Fn(usize) -> Coefficient) -> Coefficient {
    range.fold(Coefficient::default(), |sum, j| sum.plus(f(j)))
}

#[expect(clippy::cast_precision_loss, reason = "small indices")]
fn real(k: usize) -> f64 {
    k as f64
}

impl Series {
    fn constant(value: f64) -> Self {
        Self::power(0).scaled(value)
    }

    /// uᵏ
    fn power(k: usize) -> Self {
        Self(core::array::from_fn(|j| Coefficient::new(if j == k { 1.0 } else { 0.0 })))
    }

    fn at_zero(&self) -> f64 {
        if self.0[0].is_zero() { 0.0 } else { self.0[0].value }
    }

    fn scaled(&self, by: f64) -> Self {
        Self(self.0.map(|c| c.scaled(by)))
    }

    fn plus(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k].plus(other.0[k])))
    }

    fn times(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|k| sum(0..k + 1, |j| self.0[j].times(other.0[k - j]))))
    }

    /// Returns the series with this first coefficient in which every other coefficient is computed from those before
    /// it.
    fn following(first: f64, next: impl Fn(usize, &[Coefficient; TERMS]) -> Coefficient) -> Option<Self> {
        let mut all = [Coefficient::default(); TERMS];
        all[0] = Coefficient::new(first);
        for k in 1..TERMS {
            all[k] = next(k, &all);
        }
        all.iter().all(|c| c.size.is_finite()).then_some(Self(all))
    }

    /// Returns aᵖ, by the recurrence k a₀ bₖ = Σ (p j − k + j) aⱼ bₖ₋ⱼ. A root is not negative, so that √u² is u only if
    /// `u` is a length.
    fn raised(&self, p: f64, is_length: bool) -> Option<Self> {
        let order = self.order()?;
        let power = (0..TERMS).find(|&k| real(k) == real(order) * p)?;
        let is_whole = p.fract() == 0.0;
        if order > 0 && !is_length && !is_whole && power % 2 != 0 {
            return None;
        }
        let a: [Coefficient; TERMS] = core::array::from_fn(|k| self.0.get(k + order).copied().unwrap_or_default());
        let first = a[0].value;
        if first < 0.0 && !is_whole {
            return None;
        }
        let raised = Self::following(first.powf(p), |k, b| {
            sum(1..k + 1, |j| a[j].times(b[k - j]).scaled((p * real(j) - real(k - j)) / (real(k) * first)))
        })?;
        Some(if power == 0 { raised } else { raised.times(&Self::power(power)) })
    }

    fn over(&self, other: &Self) -> Option<Self> {
        Some(self.times(&other.raised(-1.0, false)?))
    }

    fn derivative(&self) -> Self {
        Self(core::array::from_fn(|k| self.0.get(k + 1).map_or(Coefficient::default(), |c| c.scaled(real(k + 1)))))
    }

    /// Returns the antiderivative with this value at 0.
    fn integral(&self, at_zero: f64) -> Option<Self> {
        Self::following(at_zero, |k, _| self.0[k - 1].scaled(1.0 / real(k)))
    }

    /// Returns eᵃ, by the recurrence k bₖ = Σ j aⱼ bₖ₋ⱼ.
    fn exp(&self) -> Option<Self> {
        Self::following(self.at_zero().exp(), |k, b| {
            sum(1..k + 1, |j| self.0[j].times(b[k - j]).scaled(real(j) / real(k)))
        })
    }

    /// Returns sin a and cos a, or their hyperbolic counterparts.
    fn sine_and_cosine(&self, hyperbolic: bool) -> Option<[Self; 2]> {
        let first = self.at_zero();
        let (sine, cosine) = if hyperbolic { (first.sinh(), first.cosh()) } else { first.sin_cos() };
        let (mut s, mut c) = ([Coefficient::new(sine); TERMS], [Coefficient::new(cosine); TERMS]);
        for k in 1..TERMS {
            let next =
                |b: &[Coefficient; TERMS]| sum(1..k + 1, |j| self.0[j].times(b[k - j]).scaled(real(j) / real(k)));
            (s[k], c[k]) = (next(&c), next(&s).scaled(if hyperbolic { 1.0 } else { -1.0 }));
        }
        Some([Self(s), Self(c)])
    }

    fn call(&self, function: Function) -> Option<Self> {
        let [circular, hyperbolic] = [false, true];
        let first = self.at_zero();
        match function {
            Function::Sin => Some(self.sine_and_cosine(circular)?[0]),
            Function::Cos => Some(self.sine_and_cosine(circular)?[1]),
            Function::Sinh => Some(self.sine_and_cosine(hyperbolic)?[0]),
            Function::Cosh => Some(self.sine_and_cosine(hyperbolic)?[1]),
            Function::Tan | Function::Tanh => {
                let [sine, cosine] = self.sine_and_cosine(function == Function::Tanh)?;
                sine.over(&cosine)
            }
            Function::Exp => self.exp(),
            Function::Ln if first > 0.0 => self.derivative().over(self)?.integral(first.ln()),
            Function::Asin | Function::Acos if first.abs() < 1.0 => {
                let square = self.times(self).scaled(-1.0).plus(&Self::constant(1.0));
                let slope = self.derivative().times(&square.raised(-0.5, false)?);
                if function == Function::Asin {
                    slope.integral(first.asin())
                } else {
                    slope.scaled(-1.0).integral(first.acos())
                }
            }
            _ => None,
        }
    }

    fn atan2(&self, x: &Self) -> Option<Self> {
        let first = [self.at_zero(), x.at_zero()];
        if first[1] <= 0.0 && first[0] == 0.0 {
            return None;
        }
        let square = self.times(self).plus(&x.times(x));
        let turn = self.derivative().times(x).plus(&self.times(&x.derivative()).scaled(-1.0));
        turn.over(&square)?.integral(first[0].atan2(first[1]))
    }

    /// Returns cₖ(s) = Σ (−s)ʲ/(k + 2j)!, or cₖ(−s) if hyperbolic.
    fn stumpff(&self, function: Stumpff) -> Option<Self> {
        if self.at_zero() != 0.0 {
            return None;
        }
        let argument = self.scaled(if function.hyperbolic { 1.0 } else { -1.0 });
        let mut result = Self::constant(0.0);
        for j in (0..TERMS / 2).rev() {
            let coefficient = 1.0 / factorial(function.order + 2 * u8::try_from(j).ok()?);
            result = result.times(&argument).plus(&Self::constant(coefficient));
        }
        Some(result)
    }

    fn is_constant(&self) -> bool {
        self.0[1..].iter().all(|c| c.is_zero())
    }

    /// Returns the lowest power with a nonzero coefficient; `None` if all coefficients are 0.
    fn order(&self) -> Option<usize> {
        self.0.iter().position(|c| !c.is_zero())
    }

    /// Returns the coefficients from the lowest power on, up to the last that matters, and the radius, at most 1,
    /// within which they suffice for full f64 precision.
    fn near_zero(&self) -> (Vec<f64>, f64) {
        let mut coefficients: Vec<f64> = self.0[self.order().unwrap_or(TERMS)..].iter().map(|c| c.value).collect();
        let least = 0.25 * f64::EPSILON * coefficients.first().map_or(0.0, |c| c.abs());
        let last = coefficients.len().saturating_sub(4);
        let radius = (last..coefficients.len())
            .filter(|&k| coefficients[k] != 0.0)
            .fold(1.0, |radius: f64, k| radius.min((least / coefficients[k].abs()).powf(1.0 / real(k))));
        for (k, c) in coefficients.iter_mut().enumerate() {
            if c.abs() * radius.powf(real(k)) < least {
                *c = 0.0;
            }
        }
        let count = coefficients.iter().rposition(|&c| c != 0.0).map_or(0, |last| last + 1);
        coefficients.truncate(count);
        (coefficients, radius)
    }
}

/// A series near 0, divided by its lowest power.
#[derive(Clone)]
pub(super) struct NearZero {
    pub(super) coefficients: Vec<f64>,
    /// The radius within which the coefficients suffice for full f64 precision.
    pub(super) radius: f64,
    /// Other factors of the number and their powers in halves, by which the series is multiplied.
    pub(super) degrees: Vec<(Scalar, i32)>,
}

/// A series times powers of the number's other factors, in halves.
#[derive(Clone, Debug)]
struct Term {
    series: Series,
    degrees: Vec<i32>,
}

impl Term {
    /// Returns the series of a term of degree 0 in all factors.
    fn plain(&self) -> Option<&Series> {
        self.degrees.iter().all(|&degree| degree == 0).then_some(&self.series)
    }

    fn plus(&self, other: &Self, sign: f64) -> Option<Self> {
        let series = self.series.plus(&other.series.scaled(sign));
        match (self.series.order(), other.series.order()) {
            (None, _) => Some(Self { series, degrees: other.degrees.clone() }),
            (_, None) => Some(Self { series, degrees: self.degrees.clone() }),
            _ => (self.degrees == other.degrees).then(|| Self { series, degrees: self.degrees.clone() }),
        }
    }

    /// Returns the product with a power of the other term.
    fn times(&self, other: &Self, power: i32) -> Option<Self> {
        let series = if power < 0 { self.series.over(&other.series)? } else { self.series.times(&other.series) };
        let degrees = self.degrees.iter().zip(&other.degrees).map(|(a, b)| a + power * b).collect();
        Some(Self { series, degrees })
    }
}

/// Computes series of expressions in u, the square root or the first power of a number, a multiple c of a power of a
/// base times powers of other factors fᵢ. They are variables, too, so an expression has a series only if it is
/// homogeneous: a product of powers of the fᵢ and a function of u alone. `a (a + r)` is a² (1 + u) for u = r/a.
pub(super) struct Expansion<'a> {
    number: &'a Length,
    /// The power of u that is the number: 1 or 2. If it is 2, u itself is unknown and only even functions are found.
    exponent: i32,
    /// u is not negative.
    is_length: bool,
    known: FxHashMap<Scalar, Term>,
    /// Bound on u up to which every select so far takes the same branch as at 0.
    reach: f64,
}

impl<'a> Expansion<'a> {
    pub(super) fn new(number: &'a Length, exponent: i32, is_length: bool) -> Self {
        Self { number, exponent, is_length, known: FxHashMap::default(), reach: f64::INFINITY }
    }

    /// Returns the lowest power of the number in the series of `s`, and the series from that power on. `None` if the
    /// series is 0, if `s` depends on another variable, or if it has no series.
    pub(super) fn near_zero(mut self, g: &Graph, s: Scalar) -> Option<(usize, NearZero)> {
        let Term { series, degrees } = self.of(g, s)?;
        let (mut coefficients, radius) = series.near_zero();
        let (mut order, mut radius) = (series.order()?, radius.min(self.reach));
        let is_root = |(&(factor, _), degree): (&(Scalar, i32), &i32)| degree % 2 != 0 && !g.is_length(factor);
        if self.number.others.iter().zip(&degrees).any(is_root) {
            return None;
        }
        if self.exponent == 2 {
            if order % 2 != 0 || coefficients.iter().skip(1).step_by(2).any(|&c| c != 0.0) {
                return None;
            }
            order /= 2;
            radius *= radius;
            // u² is the size of the number.
            let signs = (0..).map(|k| self.number.coefficient.signum().powi(k)).skip(order);
            coefficients = coefficients.iter().step_by(2).zip(signs).map(|(c, sign)| c * sign).collect();
        }
        let degrees = self.number.others.iter().zip(degrees).map(|(&(factor, _), degree)| (factor, degree));
        Some((order, NearZero { coefficients, radius, degrees: degrees.collect() }))
    }

    /// Returns the series of `s`; `None` if `s` depends on another variable or has no series.
    fn of(&mut self, g: &Graph, s: Scalar) -> Option<Term> {
        let mut open = vec![s];
        while let Some(&s) = open.last() {
            if !self.known.contains_key(&s) {
                let given = self.given(g, s);
                let parts = if given.is_some() { Vec::new() } else { self.parts(g, s)? };
                let count = open.len();
                open.extend(parts.into_iter().filter(|part| !self.known.contains_key(part)));
                if self.known.len() + open.len() > MOST_NODES {
                    return None;
                }
                if open.len() > count {
                    continue;
                }
                let found = given.or_else(|| self.find(g, s))?;
                if let ScalarNode::Op(Op::SelectLess(a, b, ..)) = g.scalar_node(s) {
                    self.reach = self.reach.min(self.reach_of_branch(a, b).unwrap_or(f64::INFINITY));
                }
                self.known.insert(s, found);
            }
            open.pop();
        }
        self.known.get(&s).cloned()
    }

    /// Returns the parts of `s` from which its series is computed: of a select the comparison, then the branch that is
    /// taken near 0.
    fn parts(&self, g: &Graph, s: Scalar) -> Option<Vec<Scalar>> {
        Some(match g.scalar_node(s) {
            ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) => match [a, b].map(|part| self.known.get(&part)) {
                [Some(first), Some(second)] => {
                    let [first, second] = [first.plain()?.at_zero(), second.plain()?.at_zero()];
                    vec![(first != second).then_some(if first < second { then } else { otherwise })?]
                }
                _ => vec![a, b],
            },
            _ => operands(g, s),
        })
    }

    /// Returns a bound on u up to which a < b has the same result as at 0: the variable part of a − b is at most half
    /// of its constant part.
    fn reach_of_branch(&self, a: Scalar, b: Scalar) -> Option<f64> {
        let margin = self.known.get(&a)?.series.plus(&self.known.get(&b)?.series.scaled(-1.0));
        let (coefficients, mut reach) = margin.near_zero();
        let varies = |u: f64| coefficients.iter().skip(1).rfold(0.0, |sum, c| u * (sum + c.abs()));
        while margin.at_zero() != 0.0 && varies(reach) > 0.5 * margin.at_zero().abs() {
            reach *= 0.5;
        }
        Some(reach)
    }

    /// Returns the length, its square or one of the other factors; `None` for other expressions.
    fn given(&self, g: &Graph, s: Scalar) -> Option<Term> {
        // The power of a factor that `s` is, in halves.
        let power_of = |factor: Scalar| match g.scalar_node(s) {
            _ if s == factor => Some(2),
            ScalarNode::Norm(v) if g.scalar_node(factor) == ScalarNode::Dot(v, v) => Some(1),
            ScalarNode::Op(Op::Sqrt(a)) if a == factor => Some(1),
            _ => None,
        };
        let Length { coefficient, others, base, halves } = self.number;
        if let Some(power) = power_of(*base) {
            // The power of u. With it goes the same power of the other factors' roots.
            let exponent = power * self.exponent / halves;
            let is_whole = |power: i32| (power * self.exponent) % halves == 0;
            let is_found = is_whole(power) && others.iter().all(|(_, other)| (other * exponent) % self.exponent == 0);
            let size = if self.exponent == 2 { coefficient.abs().sqrt() } else { *coefficient };
            let series = Series::power(usize::try_from(exponent).ok()?).scaled(size.powi(-exponent));
            let degrees = others.iter().map(|(_, power)| -power * exponent / self.exponent).collect();
            return is_found.then_some(Term { series, degrees });
        }
        let (place, power) = (0..).zip(others).find_map(|(place, &(factor, _))| Some((place, power_of(factor)?)))?;
        let degrees = (0..others.len()).map(|other| if other == place { power } else { 0 }).collect();
        Some(Term { series: Series::constant(1.0), degrees })
    }

    /// Returns the product of two vectors of these components.
    fn dot(&self, a: [Scalar; 3], b: [Scalar; 3]) -> Option<Term> {
        let mut products = a.iter().zip(&b).map(|(a, b)| self.known.get(a)?.times(self.known.get(b)?, 1));
        let first = products.next()?;
        products.fold(first, |sum, product| sum?.plus(&product?, 1.0))
    }

    /// Computes the series of `s` from those of its parts.
    fn find(&self, g: &Graph, s: Scalar) -> Option<Term> {
        let of = |s: Scalar| self.known.get(&s);
        let plain = |s: Scalar| of(s)?.plain();
        let components = |v| g.stated_components(v);
        let series = match g.scalar_node(s) {
            ScalarNode::Op(Op::Add(a, b)) => return of(a)?.plus(of(b)?, 1.0),
            ScalarNode::Op(Op::Sub(a, b)) => return of(a)?.plus(of(b)?, -1.0),
            ScalarNode::Op(Op::Mul(a, b)) => return of(a)?.times(of(b)?, 1),
            ScalarNode::Op(Op::Div(a, b)) => return of(a)?.times(of(b)?, -1),
            ScalarNode::Op(Op::Neg(a)) => {
                let Term { series, degrees } = of(a)?.clone();
                return Some(Term { series: series.scaled(-1.0), degrees });
            }
            ScalarNode::Op(Op::SelectLess(..)) => return of(self.parts(g, s)?[0]).cloned(),
            ScalarNode::Dot(v, w) => return self.dot(components(v)?, components(w)?),
            ScalarNode::Norm(v) => self.dot(components(v)?, components(v)?)?.plain()?.raised(0.5, self.is_length)?,
            ScalarNode::Op(Op::Constant(c)) => Series::constant(c.value()),
            ScalarNode::Op(Op::Tiny) => Series::constant(0.0),
            ScalarNode::Op(Op::Sqrt(a)) => plain(a)?.raised(0.5, self.is_length)?,
            ScalarNode::Op(Op::Call(function, a)) => plain(a)?.call(function)?,
            ScalarNode::Op(Op::Atan2(y, x)) => plain(y)?.atan2(plain(x)?)?,
            ScalarNode::Op(Op::Pow(a, b)) => match (plain(a)?, plain(b)?) {
                (a, b) if b.is_constant() => a.raised(b.at_zero(), self.is_length)?,
                (a, b) => a.call(Function::Ln)?.times(b).exp()?,
            },
            ScalarNode::Stumpff(function, a) => plain(a)?.stumpff(function)?,
            ScalarNode::Reciprocal(a) if plain(a)?.at_zero() > 0.0 => plain(a)?.raised(-1.0, false)?,
            _ => return None,
        };
        Some(Term { series, degrees: vec![0; self.number.others.len()] })
    }
}
