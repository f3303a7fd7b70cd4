//! Expressions and programs as formulas.

use super::formula::{Formula, Sign};
use crate::order::Node;
use crate::{
    Angle, Function, Graph, Op, Plane, Program, Rotation, RotationNode, Scalar, ScalarNode, Value, Vector, VectorNode,
};

/// What things are called. What is not named here is called as it was declared.
#[derive(Clone, Debug, Default)]
pub struct Notation {
    /// Symbols for the stems of inputs' names: `m` for the inputs `m_00` to `m_22`, `p` for `sin_p` and `cos_p`.
    pub inputs: Vec<(String, Formula)>,
    /// Symbols for constant vectors.
    pub vectors: Vec<([f64; 3], Formula)>,
    /// Symbols for changes of basis, by the images of the axes.
    pub bases: Vec<([[f64; 3]; 3], Formula)>,
    /// Symbols for the planes of turns.
    pub planes: Vec<(Plane, Formula)>,
    /// Symbols for parts of expressions.
    pub parts: Vec<(Node, Formula)>,
    /// Whether parentheses tell what is multiplied first, also where that makes no difference.
    pub grouped: bool,
}

impl Notation {
    /// The symbol of an input, or of a vector of inputs, with this stem.
    pub fn input(&self, stem: &str) -> Formula {
        self.inputs.iter().find(|(known, _)| known == stem).map_or_else(|| declared(stem), |(_, symbol)| symbol.clone())
    }

    /// The symbol of a single input.
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

    /// The symbol of an angle.
    pub fn angle(&self, g: &Graph, angle: Angle) -> Formula {
        match g.radians(angle) {
            Some(radians) => scalar(g, radians, self),
            None => self.input(g.angle_name(angle)),
        }
    }

    /// The symbol of the quarter turn of a plane.
    pub fn plane(&self, plane: Plane) -> Formula {
        let named = self.planes.iter().find(|(known, _)| *known == plane);
        let axes = |axis: u8| ["x", "y", "z"][usize::from(axis)];
        named.map_or_else(
            || Formula::italic("J").indexed(Formula::upright(&[axes(plane.from), axes(plane.towards)].concat())),
            |(_, symbol)| symbol.clone(),
        )
    }
}

/// A component of a vector is a number.
fn plain(symbol: Formula) -> Formula {
    match symbol {
        Formula::Symbol(name, _) if name.chars().count() == 1 => Formula::italic(&name),
        Formula::Index(stem, index) => Formula::Index(Box::new(plain(*stem)), index),
        symbol => symbol,
    }
}

/// A name as it was declared: what stands after `_` is an index.
fn declared(name: &str) -> Formula {
    let mut parts = name.split('_').filter(|part| !part.is_empty());
    let part = |text: &str| {
        if text.chars().count() == 1 { Formula::italic(text) } else { Formula::upright(text) }
    };
    let stem = parts.next().map_or_else(|| Formula::upright(name), part);
    parts.fold(stem, |stem, index| stem.indexed(part(index)))
}

/// What binds a formula together, the loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Dot,
    Product,
    Atom,
}

type Bound = (Formula, Binding);

fn group(bound: Bound, above: Binding) -> Formula {
    let (formula, own) = bound;
    if own > above { formula } else { Formula::Group(Box::new(formula)) }
}

fn sum(a: Bound, b: Bound) -> Bound {
    // A negation that comes second is a difference.
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

fn constant(value: f64) -> Bound {
    (Formula::number(value), if value < 0.0 { Binding::Sum } else { Binding::Atom })
}

fn root(a: Formula) -> Bound {
    (Formula::Root(Box::new(a)), Binding::Atom)
}

fn call(function: Function, a: Formula) -> Bound {
    let name = match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        other => other.name(),
    };
    (Formula::Row(vec![Formula::upright(name), Formula::Group(Box::new(a))]), Binding::Atom)
}

fn atan2(y: Formula, x: Formula) -> Bound {
    let both = Formula::infix(y, Sign::Comma, x);
    (Formula::Row(vec![Formula::upright("atan2"), Formula::Group(Box::new(both))]), Binding::Atom)
}

fn cases(a: Formula, b: Formula, then: Formula, otherwise: Formula) -> Bound {
    let condition = Formula::infix(a, Sign::Less, b);
    (Formula::Cases(Box::new([then, otherwise]), Box::new(condition)), Binding::Atom)
}

fn tiny() -> Formula {
    Formula::italic("ε")
}

/// The expression as a formula.
pub fn scalar(g: &Graph, expression: Scalar, notation: &Notation) -> Formula {
    Writer { g, notation, whole: None }.scalar(expression).0
}

/// The expression as a formula.
pub fn vector(g: &Graph, expression: Vector, notation: &Notation) -> Formula {
    Writer { g, notation, whole: None }.vector(expression).0
}

/// The rotation as a formula.
pub fn rotation(g: &Graph, expression: Rotation, notation: &Notation) -> Formula {
    Writer { g, notation, whole: None }.rotation(expression).0
}

/// The expression as a formula.
pub fn node(g: &Graph, expression: Node, notation: &Notation) -> Formula {
    match expression {
        Node::Scalar(s) => scalar(g, s, notation),
        Node::Vector(v) => vector(g, v, notation),
    }
}

/// What a part of an expression is, where it has a symbol itself.
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
    /// The part that is spelled out although it has a symbol.
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
        let s = |e| self.scalar(e);
        match self.g.scalar_node(expression) {
            ScalarNode::Constant(c) => constant(c.value()),
            ScalarNode::Input(i) => (self.notation.scalar_input(&self.g.inputs()[i as usize].0), Binding::Atom),
            ScalarNode::Tiny => (tiny(), Binding::Atom),
            ScalarNode::Add(a, b) => sum(s(a), s(b)),
            ScalarNode::Sub(a, b) => difference(s(a), s(b)),
            ScalarNode::Mul(a, b) => product(s(a), s(b)),
            ScalarNode::Div(a, b) => quotient(s(a).0, s(b).0),
            ScalarNode::Neg(a) => negated(s(a)),
            ScalarNode::Sqrt(a) => root(s(a).0),
            ScalarNode::Reciprocal(a) => quotient(Formula::number(1.0), s(a).0),
            ScalarNode::SelectLess(a, b, c, d) => cases(s(a).0, s(b).0, s(c).0, s(d).0),
            ScalarNode::Call(function, a) => call(function, s(a).0),
            ScalarNode::Atan2(a, b) => atan2(s(a).0, s(b).0),
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
            VectorNode::Rotate(r, a) => self.moved(group(self.rotation(r), self.factors()), a),
            VectorNode::Normalize(a) => {
                let a = v(a).0;
                quotient(a.clone(), Formula::Bars(Box::new(a)))
            }
            VectorNode::Perp(plane, a) => self.moved(self.notation.plane(plane), a),
            VectorNode::Cross(a, b) => {
                let [a, b] = [a, b].map(|e| group(v(e), Binding::Dot));
                (Formula::infix(a, Sign::Cross, b), Binding::Dot)
            }
            VectorNode::Across(a, u) => {
                // A direction is told by whatever points there.
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

    /// What a factor has to bind more tightly than.
    fn factors(&self) -> Binding {
        if self.notation.grouped { Binding::Product } else { Binding::Dot }
    }

    fn moved(&self, by: Formula, v: Vector) -> Bound {
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

    fn rotation(&self, expression: Rotation) -> Bound {
        let formula = match self.g.rotation_node(expression) {
            RotationNode::Matrix(entries) => match self.g.scalar_node(entries[0]) {
                ScalarNode::Input(i) => {
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
            RotationNode::Compose(a, b) => {
                let [a, b] = [a, b].map(|r| group(self.rotation(r), Binding::Dot));
                return (Formula::infix(a, Sign::Times, b), Binding::Product);
            }
            RotationNode::Transpose(a) => group(self.rotation(a), Binding::Product).transposed(),
        };
        (formula, Binding::Atom)
    }
}

/// The name of a vector whose components are the inputs `name_x`, `name_y`, `name_z`.
pub(super) fn common_name(g: &Graph, components: [Scalar; 3]) -> Option<String> {
    let names = components.map(|c| match g.scalar_node(c) {
        ScalarNode::Input(i) => Some(g.inputs()[i as usize].0.as_str()),
        _ => None,
    });
    let stem = names[0]?.strip_suffix("_x")?;
    (names[1]?.strip_suffix("_y") == Some(stem) && names[2]?.strip_suffix("_z") == Some(stem)).then(|| stem.to_owned())
}

/// A program as formulas.
#[derive(Clone, Debug)]
pub struct Told {
    /// Each step's number, its symbol, and what it is.
    pub steps: Vec<(usize, Formula, Formula)>,
    /// The results.
    pub outputs: Vec<Formula>,
}

/// The program as formulas, step by step as every back end writes it.
pub fn program(program: &Program, notation: &Notation) -> Told {
    let writer = Steps { program, notation };
    let steps = program.steps().map(|(number, op)| (number, step(number), writer.operation(op).0)).collect();
    Told { steps, outputs: program.outputs().iter().map(|&v| writer.operand(v).0).collect() }
}

/// The symbol of a step.
fn step(number: usize) -> Formula {
    Formula::italic("v").numbered(number)
}

struct Steps<'a> {
    program: &'a Program,
    notation: &'a Notation,
}

impl Steps<'_> {
    fn operation(&self, op: Op) -> Bound {
        let at = |v| self.operand(v);
        match op {
            Op::Add(a, b) => sum(at(a), at(b)),
            Op::Sub(a, b) => difference(at(a), at(b)),
            Op::Mul(a, b) => product(at(a), at(b)),
            Op::Div(a, b) => quotient(at(a).0, at(b).0),
            Op::Sqrt(a) => root(at(a).0),
            Op::SelectLess(a, b, c, d) => cases(at(a).0, at(b).0, at(c).0, at(d).0),
            Op::Call(function, a) => call(function, at(a).0),
            Op::Atan2(y, x) => atan2(at(y).0, at(x).0),
            Op::Input(i) => (self.notation.scalar_input(&self.program.inputs()[i as usize]), Binding::Atom),
            Op::Constant(c) => constant(c.value()),
            Op::Tiny => (tiny(), Binding::Atom),
            Op::Neg(a) => negated(at(a)),
        }
    }

    fn operand(&self, v: Value) -> Bound {
        match self.program.ops()[v.index()] {
            op @ (Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_)) => self.operation(op),
            op if self.program.is_inline(v) => self.operation(op),
            _ => (step(self.program.step_number(v)), Binding::Atom),
        }
    }
}
