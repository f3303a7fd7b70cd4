//! Expressions and programs as formulas.

use super::formula::{Formula, Sign};
use super::steps::{Binding, Printer, ProgramWriter};
use crate::ir::node::Node;
use crate::{
    Angle, Attitude, Condition, Function, Graph, Op, Plane, Program, Rotation, RotationNode, Scalar, ScalarNode,
    Stumpff, Vector, VectorNode,
};

/// Symbols for the elements of formulas. Anything without an entry appears under its declared name.
#[derive(Clone, Debug, Default)]
pub struct Notation {
    /// Symbols for the stems of input names: `m` for the inputs `m_00` to `m_22`, `p` for `sin_p` and `cos_p`.
    pub inputs: Vec<(String, Formula)>,
    /// Symbols for constant vectors.
    pub vectors: Vec<([f64; 3], Formula)>,
    /// Symbols for changes of basis, by the images of the axes.
    pub bases: Vec<([[f64; 3]; 3], Formula)>,
    /// Symbols for the planes of turns.
    pub planes: Vec<(Plane, Formula)>,
    /// Symbols for parts of expressions.
    pub parts: Vec<(Node, Formula)>,
    /// `true` to set parentheses around factors even where the order of multiplication does not matter.
    pub grouped: bool,
}

impl Notation {
    /// Returns the symbol of the input, or vector of inputs, with this stem.
    #[must_use]
    pub fn input(&self, stem: &str) -> Formula {
        self.inputs.iter().find(|(known, _)| known == stem).map_or_else(|| declared(stem), |(_, symbol)| symbol.clone())
    }

    /// Returns the symbol of a single input.
    fn scalar_input(&self, name: &str) -> Formula {
        if self.inputs.iter().any(|(known, _)| known == name) {
            return self.input(name);
        }
        for (prefix, function) in [("sin_", "s"), ("cos_", "c")] {
            if let Some(angle) = name.strip_prefix(prefix) {
                return Formula::italic(function).indexed(self.input(angle));
            }
        }
        match name.rsplit_once('_') {
            Some((stem, axis @ ("x" | "y" | "z"))) => plain(self.input(stem)).indexed(Formula::italic(axis)),
            Some((stem, entry)) if entry.bytes().all(|b| b.is_ascii_digit()) => {
                self.input(stem).indexed(Formula::Number(entry.to_owned()))
            }
            _ => self.input(name),
        }
    }

    /// Returns the symbol of an angle.
    #[must_use]
    pub fn angle(&self, g: &Graph, angle: Angle) -> Formula {
        match g.radians(angle) {
            Some(radians) => scalar(g, radians, self),
            None => self.input(g.angle_name(angle)),
        }
    }

    /// Returns the symbol of the 90° turn in a plane.
    #[must_use]
    pub fn plane(&self, plane: Plane) -> Formula {
        let named = self.planes.iter().find(|(known, _)| *known == plane);
        let axes = |axis: u8| ["x", "y", "z"][usize::from(axis)];
        named.map_or_else(
            || Formula::italic("J").indexed(Formula::upright(&[axes(plane.from), axes(plane.towards)].concat())),
            |(_, symbol)| symbol.clone(),
        )
    }
}

/// Returns an italic symbol for a component, which is a number, from the symbol of its vector.
fn plain(symbol: Formula) -> Formula {
    match symbol {
        Formula::Symbol(name, _) if name.chars().count() == 1 => Formula::italic(&name),
        Formula::Index(stem, index) => Formula::Index(Box::new(plain(*stem)), index),
        symbol => symbol,
    }
}

/// Returns the symbol for a declared name. Parts after `_` become indices.
fn declared(name: &str) -> Formula {
    let mut parts = name.split('_').filter(|part| !part.is_empty());
    let part = |text: &str| {
        if text.chars().count() == 1 { Formula::italic(text) } else { Formula::upright(text) }
    };
    let stem = parts.next().map_or_else(|| Formula::upright(name), part);
    parts.fold(stem, |stem, index| stem.indexed(part(index)))
}

type Bound = (Formula, Binding);

fn group(bound: Bound, above: Binding) -> Formula {
    let (formula, own) = bound;
    if own > above { formula } else { Formula::Group(Box::new(formula)) }
}

fn sum(a: Bound, b: Bound) -> Bound {
    // Adding a negation is written as a difference.
    if let Formula::Row(parts) = &b.0
        && let [Formula::Sign(Sign::Negative), rest @ ..] = parts.as_slice()
    {
        return (Formula::infix(a.0, Sign::Minus, Formula::Row(rest.to_vec())), Binding::Sum);
    }
    (Formula::infix(a.0, Sign::Plus, b.0), Binding::Sum)
}

fn difference(a: Bound, b: Bound) -> Bound {
    (Formula::infix(a.0, Sign::Minus, group(b, Binding::Sum)), Binding::Sum)
}

fn negated(a: Bound) -> Bound {
    (prefixed(Formula::Sign(Sign::Negative), group(a, Binding::Sum)), Binding::Sum)
}

fn prefixed(first: Formula, rest: Formula) -> Formula {
    let mut row = vec![first];
    match rest {
        Formula::Row(parts) => row.extend(parts),
        part => row.push(part),
    }
    Formula::Row(row)
}

fn product(a: Bound, b: Bound) -> Bound {
    if a.0 == b.0 && !matches!(a.0, Formula::Number(_)) {
        return (Formula::Squared(Box::new(group(a, Binding::Product))), Binding::Product);
    }
    let (a, b) = (group(a, Binding::Dot), group(b, Binding::Dot));
    let starts_with_digit = match &b {
        Formula::Row(parts) => matches!(parts.first(), Some(Formula::Number(_))),
        b => matches!(b, Formula::Number(_)),
    };
    let sign = if starts_with_digit { Sign::Point } else { Sign::Times };
    (Formula::infix(a, sign, b), Binding::Product)
}

fn quotient(a: Formula, b: Formula) -> Bound {
    (Formula::Fraction(Box::new(a), Box::new(b)), Binding::Atom)
}

/// Writes an operation as a formula, without parentheses that make no difference to a reader.
fn operation(op: Op<Bound>, input: impl Fn(usize) -> Formula) -> Bound {
    let formula = match op {
        Op::Add(a, b) => return sum(a, b),
        Op::Sub(a, b) => return difference(a, b),
        Op::Mul(a, b) => return product(a, b),
        Op::Neg(a) => return negated(a),
        Op::Div((a, _), (b, _)) => return quotient(a, b),
        Op::Constant(c) if c.value() < 0.0 => return (Formula::number(c.value()), Binding::Sum),
        Op::Constant(c) => Formula::number(c.value()),
        Op::Input(i) => input(i as usize),
        Op::Tiny => Formula::italic("ε"),
        Op::Sqrt((a, _)) => Formula::Root(Box::new(a)),
        Op::Call(function, (a, _)) => {
            let name = match function {
                Function::Asin => "arcsin",
                Function::Acos => "arccos",
                other => other.name(),
            };
            Formula::Row(vec![Formula::upright(name), Formula::Group(Box::new(a))])
        }
        Op::Atan2((y, _), (x, _)) => {
            let both = Formula::infix(y, Sign::Comma, x);
            Formula::Row(vec![Formula::upright("atan2"), Formula::Group(Box::new(both))])
        }
        Op::Pow((a, _), (b, _)) => {
            let both = Formula::infix(a, Sign::Comma, b);
            Formula::Row(vec![Formula::upright("pow"), Formula::Group(Box::new(both))])
        }
        Op::SelectLess((a, _), (b, _), (then, _), (otherwise, _)) => {
            Formula::Cases(Box::new([then, otherwise]), Box::new(Formula::infix(a, Sign::Less, b)))
        }
    };
    (formula, Binding::Atom)
}

/// Returns the scalar expression as a formula.
#[must_use]
pub fn scalar(g: &Graph, expression: Scalar, notation: &Notation) -> Formula {
    Writer { g, notation, whole: None }.scalar(expression).0
}

/// Returns the vector expression as a formula.
#[must_use]
pub fn vector(g: &Graph, expression: Vector, notation: &Notation) -> Formula {
    Writer { g, notation, whole: None }.vector(expression).0
}

/// Returns the rotation as a formula.
#[must_use]
pub fn rotation(g: &Graph, expression: Rotation, notation: &Notation) -> Formula {
    Writer { g, notation, whole: None }.rotation(expression).0
}

/// Returns the expression as a formula.
#[must_use]
pub fn node(g: &Graph, expression: Node, notation: &Notation) -> Formula {
    match expression {
        Node::Scalar(s) => scalar(g, s, notation),
        Node::Vector(v) => vector(g, v, notation),
    }
}

/// Returns the condition as an equation.
#[must_use]
pub fn condition(g: &Graph, condition: Condition, notation: &Notation) -> Formula {
    let writer = Writer { g, notation, whole: None };
    let is = |left, right| Formula::equals(left, right);
    let (zero, number) = (|| Formula::number(0.0), |s| writer.scalar(s).0);
    match condition {
        Condition::Zero(a) => is(number(a), zero()),
        Condition::NoLength(v) => is(Formula::Bars(Box::new(writer.vector(v).0)), zero()),
        Condition::One(a) => is(Formula::Bars(Box::new(number(a))), Formula::number(1.0)),
        Condition::Origin(a, b) => Formula::list([a, b].map(|s| is(number(s), zero()))),
        Condition::Equal(a, b) => is(number(a), number(b)),
        Condition::NoInverse(m) => {
            let columns = Formula::Matrix(vec![m.columns.map(|column| writer.vector(column).0).to_vec()]);
            is(Formula::Row(vec![Formula::upright("det"), columns]), zero())
        }
    }
}

/// Returns the definition of a part of an expression, even if the part itself has a symbol.
#[must_use]
pub fn definition(g: &Graph, part: Node, notation: &Notation) -> Formula {
    let writer = Writer { g, notation, whole: Some(part) };
    match part {
        Node::Scalar(s) => writer.scalar(s).0,
        Node::Vector(v) => writer.vector(v).0,
    }
}

struct Writer<'a> {
    g: &'a Graph,
    notation: &'a Notation,
    /// The node that is written out although it has a symbol.
    whole: Option<Node>,
}

impl Writer<'_> {
    fn symbol(&self, part: Node) -> Option<Formula> {
        if self.whole == Some(part) {
            return None;
        }
        self.notation.parts.iter().find(|(known, _)| *known == part).map(|(_, symbol)| symbol.clone())
    }

    fn scalar(&self, expression: Scalar) -> Bound {
        if let Some(symbol) = self.symbol(Node::Scalar(expression)) {
            return (symbol, Binding::Atom);
        }
        match self.g.scalar_node(expression) {
            ScalarNode::Op(op) => {
                operation(op.map(|s| self.scalar(s)), |i| self.notation.scalar_input(&self.g.inputs()[i].0))
            }
            ScalarNode::Step(component) => {
                let axis = ["x", "y", "z"][component as usize % 3];
                (Formula::italic("δ").indexed(Formula::italic(axis)), Binding::Atom)
            }
            ScalarNode::Stumpff(Stumpff { hyperbolic, order }, s) => {
                let name = Formula::italic(if hyperbolic { "h" } else { "c" }).numbered(order.into());
                (Formula::Row(vec![name, Formula::Group(Box::new(self.scalar(s).0))]), Binding::Atom)
            }
            ScalarNode::Arc(order, s, w) => {
                let name = Formula::italic("a").numbered(order.into());
                let arguments = Formula::list([s, w].map(|part| self.scalar(part).0));
                (Formula::Row(vec![name, Formula::Group(Box::new(arguments))]), Binding::Atom)
            }
            ScalarNode::Real(_, _, w) => self.scalar(w),
            ScalarNode::Reciprocal(a) => quotient(Formula::number(1.0), self.scalar(a).0),
            ScalarNode::Dot(a, b) => {
                let [a, b] = [a, b].map(|v| group(self.vector(v), Binding::Dot));
                (Formula::infix(a, Sign::Dot, b), Binding::Dot)
            }
            ScalarNode::Norm(a) => (Formula::Bars(Box::new(self.vector(a).0)), Binding::Atom),
            ScalarNode::Component(a, axis) => {
                let a = group(self.vector(a), Binding::Product);
                (a.indexed(Formula::italic(["x", "y", "z"][usize::from(axis)])), Binding::Atom)
            }
        }
    }

    fn vector(&self, expression: Vector) -> Bound {
        if let Some(symbol) = self.symbol(Node::Vector(expression)) {
            return (symbol, Binding::Atom);
        }
        let v = |e| self.vector(e);
        match self.g.vector_node(expression) {
            VectorNode::Components(c) => (self.components(c), Binding::Atom),
            VectorNode::Add(a, b) => sum(v(a), v(b)),
            VectorNode::Sub(a, b) => difference(v(a), v(b)),
            VectorNode::Neg(a) => negated(v(a)),
            VectorNode::Scale(k, a) => {
                let is_scaled = matches!(self.g.vector_node(a), VectorNode::Scale(..));
                let a = if is_scaled { (group(v(a), self.factors()), Binding::Atom) } else { v(a) };
                product((group(self.scalar(k), self.factors()), Binding::Atom), a)
            }
            VectorNode::Rotate(r, a) => self.multiplied(group(self.rotation(r), self.factors()), a),
            VectorNode::Normalize(a) => {
                let a = v(a).0;
                quotient(a.clone(), Formula::Bars(Box::new(a)))
            }
            VectorNode::Perp(plane, a) => self.multiplied(self.notation.plane(plane), a),
            VectorNode::Cross(a, b) => {
                let [a, b] = [a, b].map(|e| group(v(e), Binding::Dot));
                (Formula::infix(a, Sign::Cross, b), Binding::Dot)
            }
            VectorNode::Solve(m, a) => {
                let columns = Formula::Matrix(vec![m.columns.map(|column| v(column).0).to_vec()]);
                let matrix = if m.transposed { columns.transposed() } else { columns };
                self.multiplied(Formula::Inverse(Box::new(matrix)), a)
            }
            VectorNode::Motion(_, Attitude::Quaternion(u, _) | Attitude::Turn(u)) => {
                (Formula::italic("ω").indexed(v(u).0), Binding::Atom)
            }
            VectorNode::Imaginary(_, u, _) => v(u),
            VectorNode::Across(a, u) => {
                // The index is any vector along the direction.
                let along = match self.g.vector_node(u.into()) {
                    VectorNode::Normalize(inner) | VectorNode::Scale(_, inner)
                        if self.symbol(Node::Vector(u.into())).is_none() =>
                    {
                        inner
                    }
                    _ => u.into(),
                };
                let index = prefixed(Formula::Sign(Sign::Across), v(along).0);
                let stem = group(v(a), Binding::Product);
                (Formula::Index(Box::new(stem), Box::new(index)), Binding::Atom)
            }
        }
    }

    /// Returns the binding that the operands of a product must exceed to be written without parentheses.
    fn factors(&self) -> Binding {
        if self.notation.grouped { Binding::Product } else { Binding::Dot }
    }

    fn multiplied(&self, by: Formula, v: Vector) -> Bound {
        (Formula::infix(by, Sign::Times, group(self.vector(v), Binding::Dot)), Binding::Product)
    }

    fn components(&self, components: [Scalar; 3]) -> Formula {
        if let Some(name) = common_name(self.g, components) {
            return match self.notation.input(&name) {
                Formula::Symbol(name, _) => Formula::vector(&name),
                symbol => symbol,
            };
        }
        if let [Some(x), Some(y), Some(z)] = components.map(|c| self.g.constant_of(c)) {
            let same = |known: &[f64; 3]| *known == [x, y, z];
            if let Some((_, symbol)) = self.notation.vectors.iter().find(|(known, _)| same(known)) {
                return symbol.clone();
            }
            if [x, y, z] == [0.0; 3] {
                return Formula::vector("0");
            }
        }
        Formula::Matrix(components.map(|c| vec![self.scalar(c).0]).to_vec())
    }

    /// Returns the rotation by a rotation vector, as an exponential.
    fn exponential(&self, v: Vector) -> Formula {
        Formula::Row(vec![Formula::italic("exp"), self.vector(v).0.indexed(Formula::italic("×"))])
    }

    fn rotation(&self, expression: Rotation) -> Bound {
        let formula = match self.g.rotation_node(expression) {
            RotationNode::Matrix(entries) => match self.g.scalar_node(entries[0]) {
                ScalarNode::Op(Op::Input(i)) => {
                    let name = &self.g.inputs()[i as usize].0;
                    name.strip_suffix("_00").map_or_else(|| Formula::italic("M"), |stem| self.notation.input(stem))
                }
                _ => Formula::italic("M"),
            },
            RotationNode::Basis(entries) => {
                let rows: [[f64; 3]; 3] =
                    core::array::from_fn(|i| core::array::from_fn(|k| entries[3 * i + k].value()));
                let known = self.notation.bases.iter().find(|(known, _)| *known == rows);
                known.map_or_else(|| Formula::italic("B"), |(_, symbol)| symbol.clone())
            }
            RotationNode::Turn(_, angle) => Formula::italic("R").indexed(self.notation.angle(self.g, angle)),
            RotationNode::About(axis, angle) => Formula::Row(vec![
                Formula::italic("R").indexed(self.vector(axis).0),
                Formula::Group(Box::new(self.notation.angle(self.g, angle))),
            ]),
            RotationNode::Quaternion(v, w) => Formula::italic("Q").indexed(self.vector(v).0).indexed(self.scalar(w).0),
            RotationNode::Moving(motions) => match self.g.attitude_of(motions) {
                Attitude::Quaternion(v, w) => Formula::italic("Q").indexed(self.vector(v).0).indexed(self.scalar(w).0),
                Attitude::Turn(v) => self.exponential(v),
            },
            RotationNode::Step(v) => self.exponential(v),
            RotationNode::Compose(a, b) => {
                let [a, b] = [a, b].map(|r| group(self.rotation(r), Binding::Dot));
                return (Formula::infix(a, Sign::Times, b), Binding::Product);
            }
            RotationNode::Transpose(a) => group(self.rotation(a), Binding::Product).transposed(),
        };
        (formula, Binding::Atom)
    }
}

/// Returns the name of the vector whose components are the inputs `name_x`, `name_y`, `name_z`, or `name_0`, `name_1`,
/// `name_2` if there are no further inputs of that name.
fn common_name(g: &Graph, components: [Scalar; 3]) -> Option<String> {
    let names = components.map(|c| match g.scalar_node(c) {
        ScalarNode::Op(Op::Input(i)) => Some(g.inputs()[i as usize].0.as_str()),
        _ => None,
    });
    let [x, y, z] = [names[0]?, names[1]?, names[2]?];
    [["_x", "_y", "_z"], ["_0", "_1", "_2"]].into_iter().find_map(|[first, second, third]| {
        let stem = x.strip_suffix(first)?;
        let is_whole = !g.inputs().iter().any(|(name, _)| name.strip_suffix("_3") == Some(stem));
        let fits = y.strip_suffix(second) == Some(stem) && z.strip_suffix(third) == Some(stem);
        (fits && is_whole).then(|| stem.to_owned())
    })
}

/// A program as formulas.
#[derive(Clone, Debug)]
pub struct ProgramFormulas {
    /// The number, symbol and formula of each step.
    pub steps: Vec<(usize, Formula, Formula)>,
    /// The formulas of the outputs.
    pub outputs: Vec<Formula>,
}

/// Returns the program as formulas, in the same steps that every back end writes.
#[must_use]
pub fn program(program: &Program, notation: &Notation) -> ProgramFormulas {
    let steps = Steps { inputs: program.inputs(), notation };
    let written = ProgramWriter { program, printer: &steps };
    ProgramFormulas {
        steps: written.steps().map(|(number, (formula, _))| (number, steps.step(number).0, formula)).collect(),
        outputs: written.outputs().into_iter().map(|(formula, _)| formula).collect(),
    }
}

/// Writes steps as formulas.
struct Steps<'a> {
    inputs: &'a [String],
    notation: &'a Notation,
}

impl Printer for Steps<'_> {
    type Text = Bound;

    fn operation(&self, op: Op<Bound>) -> Bound {
        operation(op, |i| self.notation.scalar_input(&self.inputs[i]))
    }

    /// Returns the operand unchanged: formulas need other parentheses than source text, which are set elsewhere.
    fn group(&self, operand: Bound) -> Bound {
        operand
    }

    fn step(&self, number: usize) -> Bound {
        (Formula::italic("v").numbered(number), Binding::Atom)
    }
}
