//! Rules that gather products with the same vector: a product of a sum instead of a sum of products.

use crate::rewrite::scaling::joined;
use crate::rewrite::sums::{is_sum, sum, terms};
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// Limit on the depth to which products are expanded.
const DEEPEST: u32 = 8;

/// Limit on the number of terms into which a sum of numbers is expanded.
const MOST_ADDENDS: usize = 16;

/// A product, as a constant and its other factors.
#[derive(Clone, Debug)]
struct Factors {
    constant: f64,
    others: Vec<Scalar>,
}

impl Factors {
    fn sign(negative: bool) -> Self {
        Self { constant: if negative { -1.0 } else { 1.0 }, others: Vec::new() }
    }

    fn times(&mut self, g: &Graph, s: Scalar, depth: u32) {
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Constant(c)) => self.constant *= c.value(),
            ScalarNode::Op(Op::Neg(a)) if depth > 0 => {
                self.constant = -self.constant;
                self.times(g, a, depth - 1);
            }
            ScalarNode::Op(Op::Mul(a, b)) if depth > 0 => {
                self.times(g, a, depth - 1);
                self.times(g, b, depth - 1);
            }
            _ => self.others.push(s),
        }
    }

    /// Returns the common factors of both, and the remaining factors of each.
    fn apart(&self, other: &Self) -> [Self; 3] {
        let [mut common, mut own, mut rest] = [Self::sign(false), Self::sign(false), other.clone()];
        for &factor in &self.others {
            match rest.others.iter().position(|&f| f == factor) {
                Some(place) => common.others.push(rest.others.remove(place)),
                None => own.others.push(factor),
            }
        }
        common.constant = self.constant;
        rest.constant = other.constant / self.constant;
        [common, own, rest]
    }

    /// Returns the product without one of its factors, or `None` if it lacks that factor.
    fn without(&self, factor: Scalar) -> Option<Self> {
        let place = self.others.iter().position(|&f| f == factor)?;
        let mut rest = self.clone();
        rest.others.remove(place);
        Some(rest)
    }

    /// Returns `true` if the product is −1 times the other.
    fn is_opposite(&self, other: &Self) -> bool {
        let [common, own, rest] = self.apart(other);
        common.constant != 0.0 && own.others.is_empty() && rest.others.is_empty() && rest.constant == -1.0
    }

    /// Expands the product if one of its factors is a sum of dot products; else returns it alone.
    fn spread(self, g: &Graph) -> Vec<Self> {
        let has_dot = |product: &Self| product.others.iter().any(|&s| matches!(g.scalar_node(s), ScalarNode::Dot(..)));
        let is_of_dots = |s: Scalar| Some(addends(g, s)).filter(|all| all.len() > 1 && all.iter().all(has_dot));
        let Some((sum, addends)) = self.others.iter().find_map(|&s| Some((s, is_of_dots(s)?))) else {
            return vec![self];
        };
        let Some(rest) = self.without(sum) else { return vec![self] };
        let times = |mut product: Self| {
            product.constant *= rest.constant;
            product.others.extend(&rest.others);
            product
        };
        addends.into_iter().map(times).collect()
    }

    /// Returns `true` if the product is negative, and its absolute value, `None` for 1.
    fn stated(&self, g: &mut Graph) -> (bool, Option<Scalar>) {
        let mut product = self.others.iter().copied().reduce(|a, b| g.mul(a, b));
        if self.constant.abs() != 1.0 {
            let constant = g.constant(self.constant.abs());
            product = Some(product.map_or(constant, |product| g.mul(constant, product)));
        }
        (self.constant < 0.0, product)
    }

    /// Returns the product times a vector, as a signed term of a sum.
    fn scaled(&self, g: &mut Graph, v: Vector) -> (bool, Vector) {
        let (negative, factor) = self.stated(g);
        (negative, factor.map_or(v, |k| g.scale(k, v)))
    }
}

/// Returns the terms of a sum of numbers as products.
fn addends(g: &Graph, s: Scalar) -> Vec<Factors> {
    let (mut all, mut open) = (Vec::new(), vec![(s, false)]);
    while let Some((s, negative)) = open.pop() {
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Add(a, b)) if all.len() + open.len() < MOST_ADDENDS => {
                open.extend([(b, negative), (a, negative)]);
            }
            ScalarNode::Op(Op::Sub(a, b)) if all.len() + open.len() < MOST_ADDENDS => {
                open.extend([(b, !negative), (a, negative)]);
            }
            _ => {
                let mut factors = Factors::sign(negative);
                factors.times(g, s, DEEPEST);
                all.push(factors);
            }
        }
    }
    all
}

/// Returns the terms of a sum of vectors, each as factors and a vector; `None` if `v` is not a sum.
fn products(g: &Graph, v: Vector) -> Option<Vec<(Factors, Vector)>> {
    is_sum(g, v).then(|| {
        let product = |(negative, mut v): (bool, Vector)| {
            let mut factors = Factors::sign(negative);
            loop {
                match g.vector_node(v) {
                    VectorNode::Scale(k, inner) => {
                        factors.times(g, k, DEEPEST);
                        v = inner;
                    }
                    VectorNode::Neg(inner) => {
                        factors.constant = -factors.constant;
                        v = inner;
                    }
                    _ => return (factors, v),
                }
            }
        };
        terms(g, v).into_iter().map(product).collect()
    })
}

/// Returns all pairs i < j of indices.
fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..count).flat_map(move |i| (i + 1..count).map(move |j| [i, j]))
}

/// `k a × c + m b × c = (k a + m b) × c`, with common factors of k and m taken out
pub(crate) fn crosses(g: &mut Graph, v: Vector) -> Option<Vector> {
    let all = products(g, v)?;
    // A ratio to a factor of 0 is undefined.
    let sides_of_cross = |(k, v): &(Factors, Vector)| match g.vector_node(*v) {
        VectorNode::Cross(a, b) if k.constant != 0.0 => vec![((a, false), b), ((b, true), a)],
        _ => Vec::new(),
    };
    let sides: Vec<_> = all.iter().map(sides_of_cross).collect();
    let ([i, j], [one, other], c) = shared_side(&sides)?;
    let [common, own, mut rest] = all[i].0.apart(&all[j].0);
    if one.1 != other.1 {
        rest.constant = -rest.constant;
    }
    let terms = [own.scaled(g, one.0), rest.scaled(g, other.0)];
    let gathered = sum(g, &terms);
    let cross = g.cross(gathered, c);
    let (negative, together) = common.scaled(g, cross);
    Some(joined(g, v, (i, j), (negative != one.1, together)))
}

/// `k (u · c) a − k (a · c) u = k (u × a) × c`, if u × a exists already
pub(crate) fn cross_of_dots(g: &mut Graph, v: Vector) -> Option<Vector> {
    let mut all: Vec<(Factors, Vector)> =
        products(g, v)?.into_iter().flat_map(|(k, v)| k.spread(g).into_iter().map(move |k| (k, v))).collect();
    let (at, of, k, cross, c) = (0..all.len()).find_map(|at| {
        let (k, a) = &all[at];
        k.others.iter().find_map(|&dot| {
            let ScalarNode::Dot(p, q) = g.scalar_node(dot) else { return None };
            let rest = k.without(dot)?;
            [(p, q), (q, p)].into_iter().find_map(|(u, c)| {
                let (cross, is_swapped) = g.known_cross(u, *a).filter(|_| u != *a)?;
                let other = g.dot(*a, c);
                let is_opposite =
                    |(m, v): &(Factors, Vector)| *v == u && m.without(other).is_some_and(|m| rest.is_opposite(&m));
                let of = all.iter().position(is_opposite)?;
                let mut rest = rest.clone();
                rest.constant *= if is_swapped { -1.0 } else { 1.0 };
                Some((at, of, rest, cross, c))
            })
        })
    })?;
    let twice = g.cross(cross, c);
    all[at] = (k, twice);
    all.remove(of);
    let terms: Vec<_> = all.into_iter().map(|(k, v)| k.scaled(g, v)).collect();
    Some(sum(g, &terms))
}

/// `k v + m (u × v) + n (u · v) u = M v`, with common factors of k, m and n taken out
pub(crate) fn linear_map(g: &mut Graph, v: Vector) -> Option<Vector> {
    let all = products(g, v)?;
    let ([kept, aside, along], u, inner, numbers) = (0..all.len()).find_map(|aside| {
        let VectorNode::Cross(a, b) = g.vector_node(all[aside].1) else { return None };
        [(a, b, 1.0), (b, a, -1.0)].into_iter().find_map(|(u, inner, sign)| {
            let dot = g.dot(u, inner);
            let kept = all.iter().position(|(k, v)| *v == inner && k.constant != 0.0)?;
            let part = |(k, v): &(Factors, Vector)| (*v == u).then(|| k.without(dot)).flatten();
            let (along, third) = all.iter().enumerate().find_map(|(i, term)| Some((i, part(term)?)))?;
            let mut second = all[aside].0.clone();
            second.constant *= sign;
            (u != inner).then(|| ([kept, aside, along], u, inner, [all[kept].0.clone(), second, third]))
        })
    })?;
    let [both, ..] = numbers[0].apart(&numbers[1]);
    let [common, ..] = both.apart(&numbers[2]);
    let numbers = numbers.map(|number| {
        let [.., rest] = common.apart(&number);
        rest
    });
    let rows = rows(g, u, &numbers);
    let image = rows.map(|row| g.dot(row, inner));
    let image = g.components(image);
    let mut terms = terms(g, v);
    terms[kept] = common.scaled(g, image);
    let mut place = 0..;
    terms.retain(|_| place.next().is_some_and(|i| i != aside && i != along));
    Some(sum(g, &terms))
}

/// Returns the rows of `k + m [u]× + n u uᵀ`.
fn rows(g: &mut Graph, u: Vector, [k, m, n]: &[Factors; 3]) -> [Vector; 3] {
    let (is_negative, kept) = k.stated(g);
    let kept = kept.unwrap_or_else(|| g.constant(1.0));
    let kept = if is_negative { g.neg(kept) } else { kept };
    let [(turns_back, aside), (draws_back, along)] = [m, n].map(|number| number.scaled(g, u));
    let u = [0, 1, 2].map(|i| g.component(u, i));
    let aside = [0, 1, 2].map(|i| g.component(aside, i));
    let along = [0, 1, 2].map(|i| g.component(along, i));
    let signed = |g: &mut Graph, a, b, negative| if negative { g.sub(a, b) } else { g.add(a, b) };
    let zero = g.constant(0.0);
    let mut rows = [[zero; 3]; 3];
    for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
        let square = g.mul(along[i], u[i]);
        rows[i][i] = signed(g, kept, square, draws_back);
        // u × eₖ has component −uᵢ at j, and u × eⱼ has component uᵢ at k.
        let both = g.mul(along[j], u[k]);
        let both = if draws_back { g.neg(both) } else { both };
        rows[j][k] = signed(g, both, aside[i], !turns_back);
        rows[k][j] = signed(g, both, aside[i], turns_back);
    }
    rows.map(|row| g.components(row))
}

/// `k a · c + m b · c = (k a + m b) · c`, with common factors of k and m taken out
pub(crate) fn dots(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    let ScalarNode::Op(Op::Add(..) | Op::Sub(..)) = g.scalar_node(s) else { return None };
    let mut all: Vec<Factors> = addends(g, s).into_iter().flat_map(|k| k.spread(g)).collect();
    // A ratio to a factor of 0 is undefined.
    all.retain(|k| k.constant != 0.0);
    let sides: Vec<_> = all.iter().map(|k| k.others.iter().flat_map(|&s| sides_of_dot(g, s)).collect()).collect();
    let ([i, j], [one, other], c) = shared_side(&sides)?;
    let [common, own, rest] = all[i].without(one.1)?.apart(&all[j].without(other.1)?);
    let terms = [own.scaled(g, one.0), rest.scaled(g, other.0)];
    let gathered = sum(g, &terms);
    all[i] = common;
    all[i].others.push(g.dot(gathered, c));
    all.remove(j);
    let mut total: Option<Scalar> = None;
    for product in all {
        let (negative, product) = product.stated(g);
        let product = product.unwrap_or_else(|| g.constant(1.0));
        total = Some(match (total, negative) {
            (None, false) => product,
            (None, true) => g.neg(product),
            (Some(total), false) => g.add(total, product),
            (Some(total), true) => g.sub(total, product),
        });
    }
    Some(total.unwrap_or_else(|| g.constant(0.0)))
}

/// Returns each vector of a dot product, paired with the product, and with the other vector.
fn sides_of_dot(g: &Graph, s: Scalar) -> Vec<((Vector, Scalar), Vector)> {
    match g.scalar_node(s) {
        ScalarNode::Dot(v, w) => vec![((v, s), w), ((w, s), v)],
        _ => Vec::new(),
    }
}

/// Returns the first two indices whose products share a vector, what they have beside it, and the vector.
fn shared_side<T: Copy>(sides: &[Vec<(T, Vector)>]) -> Option<([usize; 2], [T; 2], Vector)> {
    pairs(sides.len()).find_map(|[i, j]| {
        sides[i].iter().find_map(|&(one, c)| {
            let &(other, _) = sides[j].iter().find(|&&(_, other)| other == c)?;
            Some(([i, j], [one, other], c))
        })
    })
}
