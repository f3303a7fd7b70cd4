//! [`Product`]: an expression as a product of powers.

use rustc_hash::FxHashMap;

use crate::{Function, Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// Limit on the number of parts; longer products are not analysed.
const MOST_PARTS: usize = 128;

/// Limit on the depth to which numbers are searched for whether they may be negative.
const DEEPEST_LENGTH: u32 = 6;

/// Limit on the number of nodes in which lengths are stated as products.
const MOST_NODES: usize = 200;

/// Limit on powers, in halves; products with higher powers are not analysed.
const HIGHEST_POWER: i32 = 64;

impl Graph {
    /// Returns `true` if the number is recognisably not negative.
    pub(crate) fn is_length(&self, s: Scalar) -> bool {
        self.is_length_within(s, DEEPEST_LENGTH)
    }

    fn is_length_within(&self, s: Scalar, depth: u32) -> bool {
        match self.scalar_node(s) {
            ScalarNode::Norm(_) | ScalarNode::Op(Op::Sqrt(_) | Op::Call(Function::Exp, _)) | ScalarNode::Arc(0, ..) => {
                true
            }
            ScalarNode::Op(Op::Constant(c)) => c.value() > 0.0,
            ScalarNode::Dot(v, w) => v == w,
            ScalarNode::Op(Op::Mul(a, b)) if a == b => true,
            ScalarNode::Op(Op::Add(a, b) | Op::Mul(a, b) | Op::Div(a, b)) if depth > 0 => {
                self.is_length_within(a, depth - 1) && self.is_length_within(b, depth - 1)
            }
            _ => false,
        }
    }

    /// Returns `true` for an exponential, or a sum of non-negative terms with one, which is never 0. Nothing vanishes
    /// with it, and multiplying by it could make a finite number infinite.
    pub(super) fn is_never_zero(&self, s: Scalar) -> bool {
        let is_exponential = |s: Scalar| matches!(self.scalar_node(s), ScalarNode::Op(Op::Call(Function::Exp, _)));
        self.is_length(s) && terms(self, s).into_iter().any(is_exponential)
    }

    /// Returns `true` if the number is recognisably not negative, and not a sum with a positive constant.
    pub(super) fn may_be_of_length_zero(&self, s: Scalar) -> bool {
        let is_positive = |s: Scalar| self.constant_of(s).is_some_and(|c| c > 0.0);
        self.is_length(s) && !self.is_never_zero(s) && !terms(self, s).into_iter().any(is_positive)
    }

    /// (1 − a)(1 + a) = 1 − a², without loss of digits near |a| = 1.
    pub(crate) fn around_one(&mut self, a: Scalar) -> Scalar {
        let one = self.constant(1.0);
        if let ScalarNode::Op(Op::Sqrt(square)) = self.scalar_node(a) {
            return self.sub(one, square);
        }
        let (below, above) = (self.sub(one, a), self.add(one, a));
        self.mul(below, above)
    }

    /// Returns one vector for all that have the same length as `v` by their components: w − v for v − w, and the
    /// components in one order, without their signs.
    fn of_same_length(&mut self, v: Vector) -> Vector {
        match self.vector_node(v) {
            VectorNode::Sub(a, b) => self.known_difference(b, a).map_or(v, |opposite| opposite.min(v)),
            VectorNode::Components(c) => self.sorted(c),
            // A part is left out along an axis.
            VectorNode::Cross(a, b) => {
                let axis = |of: &Self, v| {
                    let c = of.constant_vector_of(v)?;
                    let is_axis = c.iter().filter(|c| **c == 0.0).count() == 2;
                    c.iter().position(|c| c.abs() == 1.0).filter(|_| is_axis)
                };
                let Some((axis, other)) = axis(self, b).map(|k| (k, a)).or_else(|| Some((axis(self, a)?, b))) else {
                    return v;
                };
                let VectorNode::Components(mut c) = self.vector_node(other) else { return v };
                c[axis] = self.constant(0.0);
                self.sorted(c)
            }
            _ => v,
        }
    }

    /// Returns the components of a vector that is stated by them.
    pub(super) fn stated_components(&self, v: Vector) -> Option<[Scalar; 3]> {
        match self.vector_node(v) {
            VectorNode::Components(c) => Some(c),
            _ => None,
        }
    }

    /// Returns the vector of these components, without their signs, in the order of their first use, zeros last.
    fn sorted(&mut self, components: [Scalar; 3]) -> Vector {
        let mut components = components.map(|c| match self.scalar_node(c) {
            ScalarNode::Op(Op::Neg(a)) => a,
            _ => c,
        });
        components.sort_by_key(|&c| (self.constant_of(c) == Some(0.0), c));
        self.components(components)
    }

    /// Returns the vector of which `s` is the square, if `s` is a sum of two or three squares of numbers.
    fn as_square(&mut self, s: Scalar) -> Option<Vector> {
        let (mut components, mut open) = (Vec::new(), vec![s]);
        while let Some(s) = open.pop() {
            match self.scalar_node(s) {
                ScalarNode::Op(Op::Add(a, b)) if open.len() < 3 => open.extend([a, b]),
                ScalarNode::Op(Op::Mul(a, b)) if a == b && components.len() < 3 => components.push(a),
                _ => return None,
            }
        }
        if components.len() < 2 {
            return None;
        }
        components.resize(3, self.constant(0.0));
        Some(self.components([components[0], components[1], components[2]]))
    }

    /// Returns `s` with each length and square in it stated as the product of factors that it is: |k v| as k |v|, the root
    /// of a sum of squares as a length.
    pub(super) fn with_lengths_stated(&mut self, s: Scalar) -> Scalar {
        self.stated_within(s, &mut FxHashMap::default())
    }

    fn stated_within(&mut self, s: Scalar, known: &mut FxHashMap<Scalar, Scalar>) -> Scalar {
        if known.contains_key(&s) || known.len() >= MOST_NODES {
            return known.get(&s).copied().unwrap_or(s);
        }
        known.insert(s, s);
        let stated = match self.scalar_node(s) {
            ScalarNode::Norm(_) | ScalarNode::Dot(..) | ScalarNode::Op(Op::Sqrt(_)) => {
                Product::of(self, s).and_then(|product| product.stated(self)).unwrap_or(s)
            }
            ScalarNode::Op(op) => {
                let op = op.map(|part| self.stated_within(part, known));
                self.intern_scalar(ScalarNode::Op(op))
            }
            _ => s,
        };
        known.insert(s, stated);
        stated
    }

    /// Returns (1 − a)(1 + a) if `s` is 1 − a².
    fn one_minus_square(&mut self, s: Scalar) -> Option<Scalar> {
        let ScalarNode::Op(Op::Sub(one, square)) = self.scalar_node(s) else { return None };
        let ScalarNode::Op(Op::Mul(a, b)) = self.scalar_node(square) else { return None };
        (a == b && self.constant_of(one) == Some(1.0)).then(|| self.around_one(a))
    }
}

/// Returns the vector of which `v` is the direction.
fn normalized(g: &Graph, v: Vector) -> Option<Vector> {
    match g.vector_node(v) {
        VectorNode::Normalize(inner) => Some(inner),
        _ => None,
    }
}

/// Returns the two terms of a sum, or the two branches of a select.
pub(super) fn parts(g: &Graph, s: Scalar) -> Option<(Scalar, Scalar)> {
    match g.scalar_node(s) {
        ScalarNode::Op(Op::Add(a, b) | Op::Sub(a, b) | Op::SelectLess(_, _, a, b)) => Some((a, b)),
        _ => None,
    }
}

/// Returns the terms of a sum, or `sum` itself if it is not one. Branches of selects count as terms.
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

/// Returns the numbers of which `s` is a function, those of vectors where they are stated by their components.
pub(super) fn operands(g: &Graph, s: Scalar) -> Vec<Scalar> {
    let components = |v| g.stated_components(v).map_or(Vec::new(), |c| c.to_vec());
    match g.scalar_node(s) {
        ScalarNode::Op(op) => op.operands().collect(),
        ScalarNode::Stumpff(_, argument) | ScalarNode::Reciprocal(argument) => vec![argument],
        ScalarNode::Norm(v) => components(v),
        ScalarNode::Dot(v, w) => [components(v), components(w)].concat(),
        _ => Vec::new(),
    }
}

/// A product of a coefficient and powers of factors.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub(super) coefficient: f64,
    /// Factors and their powers in halves, in order of first appearance.
    pub(super) powers: Vec<(Scalar, i32)>,
    /// The factors that appear in the numerator.
    pub(super) above: Vec<Scalar>,
    /// The factors that appear in the denominator.
    pub(super) below: Vec<Scalar>,
    /// The factors that appear in the denominator of a guarded reciprocal, which is 0 where they are.
    guarded: Vec<Scalar>,
    /// The factors that appear in a root, so that they are not negative.
    in_roots: Vec<Scalar>,
    /// `true` if the factors to come are those of a guarded reciprocal.
    in_guard: bool,
    parts: usize,
}

impl Product {
    pub(super) const fn new() -> Self {
        Self {
            coefficient: 1.0,
            powers: Vec::new(),
            above: Vec::new(),
            below: Vec::new(),
            guarded: Vec::new(),
            in_roots: Vec::new(),
            in_guard: false,
            parts: 0,
        }
    }

    pub(super) fn power(&mut self, factor: Scalar, halves: i32) {
        let side = if halves < 0 { &mut self.below } else { &mut self.above };
        side.push(factor);
        if halves < 0 && self.in_guard {
            self.guarded.push(factor);
        }
        match self.powers.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, power)) => *power += halves,
            None => self.powers.push((factor, halves)),
        }
    }

    /// Multiplies by a power of |factor|, in halves.
    pub(super) fn power_of_size(&mut self, g: &mut Graph, factor: Scalar, halves: i32) {
        let (zero, opposite) = (g.constant(0.0), g.neg(factor));
        let size = g.select_less(factor, zero, opposite, factor);
        self.in_roots.push(size);
        self.power(size, halves);
    }

    /// Returns `true` if the factor appears in the denominator of a guarded reciprocal.
    pub(super) fn is_guarded(&self, factor: Scalar) -> bool {
        self.guarded.contains(&factor)
    }

    /// Sets whether the factors to come are those of a guarded reciprocal.
    pub(super) fn guard(&mut self, in_guard: bool) {
        self.in_guard = in_guard;
    }

    pub(super) fn power_of(&self, factor: Scalar) -> i32 {
        self.powers.iter().find(|(known, _)| *known == factor).map_or(0, |(_, power)| *power)
    }

    /// Splits a scalar into factors; `None` if there are too many.
    pub(super) fn of(g: &mut Graph, s: Scalar) -> Option<Self> {
        let mut product = Self::new();
        product.times(g, s, 2, &[])?;
        Some(product)
    }

    /// Removes a factor. Returns its power, in halves.
    pub(super) fn remove(&mut self, factor: Scalar) -> i32 {
        let power = self.power_of(factor);
        self.powers.retain(|(known, _)| *known != factor);
        power
    }

    /// Multiplies by a power of `s`, in halves, which must be even; `None` if the product becomes too long. Expressions
    /// in `whole` are not taken apart.
    pub(super) fn times(&mut self, g: &mut Graph, s: Scalar, halves: i32, whole: &[Scalar]) -> Option<()> {
        self.parts += 1;
        if self.parts > MOST_PARTS || halves.abs() > HIGHEST_POWER {
            return None;
        }
        if whole.contains(&s) {
            self.power(s, halves);
            return Some(());
        }
        match g.scalar_node(s) {
            // Nothing cancels in a quotient with divisor 0.
            ScalarNode::Op(Op::Constant(c)) if c.value() == 0.0 && halves < 0 => return None,
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
            // A guarded reciprocal of a negative number is 0, so this holds only for lengths.
            ScalarNode::Reciprocal(a) if g.is_length(a) => {
                let outer = std::mem::replace(&mut self.in_guard, true);
                self.times(g, a, -halves, whole)?;
                self.in_guard = outer;
            }
            ScalarNode::Op(Op::Sqrt(a)) => self.times_root(g, a, halves / 2, whole)?,
            ScalarNode::Norm(v) => self.times_square(g, v, halves / 2, whole)?,
            ScalarNode::Dot(v, w) if v == w => self.times_square(g, v, halves, whole)?,
            ScalarNode::Dot(v, w) if v != w && halves == 2 => {
                let (v, w) = (self.times_vector(g, v, whole)?, self.times_vector(g, w, whole)?);
                let dot = g.dot(v, w);
                self.power(dot, halves);
            }
            ScalarNode::Component(v, axis) if halves == 2 => {
                let v = self.times_vector(g, v, whole)?;
                match g.vector_node(v) {
                    VectorNode::Components(c) => self.times(g, c[usize::from(axis)], halves, whole)?,
                    _ => {
                        let component = g.component(v, axis);
                        self.power(component, halves);
                    }
                }
            }
            _ => self.times_plain(g, s, halves, whole)?,
        }
        Some(())
    }

    /// Multiplies by a power of `s`, in halves, as a square if it is a sum of squares.
    fn times_plain(&mut self, g: &mut Graph, s: Scalar, halves: i32, whole: &[Scalar]) -> Option<()> {
        if let Some(v) = g.as_square(s) {
            return self.times_square(g, v, halves, whole);
        }
        let s = g.one_minus_square(s).unwrap_or(s);
        self.power(s, halves);
        Some(())
    }

    /// Multiplies by a power of the root of `s`, which is not negative then: `halves` of a power of `s`.
    fn times_root(&mut self, g: &mut Graph, s: Scalar, halves: i32, whole: &[Scalar]) -> Option<()> {
        self.parts += 1;
        if self.parts > MOST_PARTS {
            return None;
        }
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Constant(c)) if c.value() > 0.0 => {
                self.coefficient *= c.value().powf(f64::from(halves) / 2.0);
            }
            ScalarNode::Op(Op::Mul(a, b)) if a == b => match g.scalar_node(a) {
                // (p q)² = p² q²
                ScalarNode::Op(Op::Mul(p, q)) if g.is_length(p) != g.is_length(q) => {
                    for side in [p, q] {
                        let square = g.mul(side, side);
                        self.times_root(g, square, halves, whole)?;
                    }
                }
                _ if halves % 2 == 0 || g.is_length(a) => self.times(g, a, 2 * halves, whole)?,
                _ => self.power(s, halves),
            },
            ScalarNode::Op(Op::Mul(a, b)) if g.is_length(a) || g.is_length(b) => {
                self.times_root(g, a, halves, whole)?;
                self.times_root(g, b, halves, whole)?;
            }
            _ => {
                self.in_roots.push(g.one_minus_square(s).unwrap_or(s));
                self.times_plain(g, s, halves, whole)?;
            }
        }
        Some(())
    }

    /// Multiplies by a power of v · v, in halves. Vectors that obviously have the same length have the same square.
    fn times_square(&mut self, g: &mut Graph, v: Vector, halves: i32, whole: &[Scalar]) -> Option<()> {
        self.parts += 1;
        if self.parts > MOST_PARTS {
            return None;
        }
        match g.vector_node(v) {
            VectorNode::Neg(inner) | VectorNode::Rotate(_, inner) => self.times_square(g, inner, halves, whole)?,
            VectorNode::Scale(k, inner) => {
                if let Some(k) = g.constant_of(k) {
                    self.coefficient *= k.abs().powi(halves);
                } else if halves % 2 == 0 || g.is_length(k) {
                    self.times(g, k, 2 * halves, whole)?;
                } else {
                    self.power_of_size(g, k, 2 * halves);
                }
                self.times_square(g, inner, halves, whole)?;
            }
            VectorNode::Cross(a, b) if [a, b].iter().any(|&side| normalized(g, side).is_some()) => {
                let mut sides = [a, b];
                for side in &mut sides {
                    if let Some(inner) = normalized(g, *side) {
                        self.times_square(g, inner, -halves, whole)?;
                        *side = inner;
                    }
                }
                let cross = g.cross(sides[0], sides[1]);
                self.times_square(g, cross, halves, whole)?;
            }
            _ => {
                let v = g.of_same_length(v);
                let square = g.dot(v, v);
                self.power(square, halves);
            }
        }
        Some(())
    }

    /// Multiplies by the scalar factors of `v` and returns the remaining vector.
    pub(super) fn times_vector(&mut self, g: &mut Graph, v: Vector, whole: &[Scalar]) -> Option<Vector> {
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
                self.times_square(g, inner, -1, whole)?;
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

    /// Returns the product as an expression, or `None` if it is 1.
    pub(super) fn stated(self, g: &mut Graph) -> Option<Scalar> {
        let [mut above, mut below, mut guarded]: [Vec<Scalar>; 3] = Default::default();
        for &(factor, halves) in &self.powers {
            // A guarded reciprocal of a negative number is 0.
            let is_not_negative = halves.abs() % 4 != 2 || g.is_length(factor) || self.in_roots.contains(&factor);
            let is_guarded = self.is_guarded(factor) && is_not_negative;
            let side = match halves {
                1.. => &mut above,
                _ if is_guarded => &mut guarded,
                _ => &mut below,
            };
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
        if let Some(product) = guarded.into_iter().reduce(|a, b| g.mul(a, b)) {
            above.push(g.reciprocal(product));
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
