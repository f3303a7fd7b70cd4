//! The language of the generated functions: expressions and statements of Rust.

use std::fmt::{self, Display, Formatter};

/// The type of an expression: a number, a vector, a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Number,
    Vector,
    Matrix,
}

pub(super) const KINDS: [Kind; 3] = [Kind::Number, Kind::Vector, Kind::Matrix];

impl Kind {
    /// Returns the first letter of its variables' names.
    fn letter(self) -> char {
        ['n', 'v', 'm'][self as usize]
    }
}

#[derive(Clone, Debug)]
pub(super) enum Expression {
    Constant(f64),
    Variable(Kind, usize),
    /// The counter of the enclosing loop with this number, or its current element.
    Counter(usize),
    Item(usize),
    /// An element of the array.
    Element(Index),
    Sum(Box<[Self; 2]>),
    Difference(Box<[Self; 2]>),
    Negative(Box<Self>),
    /// Products `a * b` of glam: of numbers, of a number and a vector or a matrix, of matrices, of a matrix and a
    /// vector.
    Product(Box<[Self; 2]>),
    /// a / (b² + 1)
    Ratio(Box<[Self; 2]>),
    Sine(Box<Self>),
    /// √(a² + 1)
    Root(Box<Self>),
    Dot(Box<[Self; 2]>),
    Cross(Box<[Self; 2]>),
    Component(Box<Self>, usize),
    Column(Box<Self>, usize),
    Vector(Box<[Self; 3]>),
    Columns(Box<[Self; 3]>),
    Transpose(Box<Self>),
    Determinant(Box<Self>),
    /// A vector rotated by the rotation.
    Turned(Box<Self>),
}

/// An index into the array.
#[derive(Clone, Copy, Debug)]
pub(super) enum Index {
    Constant(usize),
    /// The counter of the enclosing loop with this number.
    Counter(usize),
}

/// The kind of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// `for i in 0..count`
    Up,
    /// `for i in (0..count).rev()`
    Down,
    /// `while i < count`, with a counter of its own
    While,
    /// `for e in` the array, as it is before the loop
    Each,
}

/// The exit that is taken if a condition holds.
#[derive(Clone, Debug)]
pub(super) enum Leave {
    Break,
    Continue,
    Return(Expression),
}

#[derive(Clone, Debug)]
pub(super) enum Condition {
    Less([Expression; 2]),
    /// The counter of the enclosing loop with this number has this value.
    Is(usize, u8),
}

#[derive(Clone, Debug)]
pub(super) enum Statement {
    Let(Kind, Expression),
    Set(Kind, usize, Expression),
    Increase(Kind, usize, Expression),
    /// Adds to an element of the array.
    Add(Index, Expression),
    Loop {
        count: u8,
        way: Way,
        number: usize,
        body: Vec<Self>,
    },
    Leave(Condition, Leave),
    If {
        less: [Expression; 2],
        then: Vec<Self>,
        otherwise: Vec<Self>,
    },
}

impl Display for Index {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(index) => write!(f, "{index}"),
            Self::Counter(number) => write!(f, "i{number}"),
        }
    }
}

impl Display for Condition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Less([a, b]) => write!(f, "{a} < {b}"),
            Self::Is(number, count) => write!(f, "i{number} == {count}"),
        }
    }
}

impl Display for Expression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "({value:?}_f64)"),
            Self::Variable(kind, number) => write!(f, "{}{number}", kind.letter()),
            Self::Counter(number) => write!(f, "(i{number} as f64)"),
            Self::Item(number) => write!(f, "e{number}"),
            Self::Element(index) => write!(f, "table[{index}]"),
            Self::Sum(of) => write!(f, "({} + {})", of[0], of[1]),
            Self::Difference(of) => write!(f, "({} - {})", of[0], of[1]),
            Self::Negative(of) => write!(f, "(-{of})"),
            Self::Product(of) => write!(f, "({} * {})", of[0], of[1]),
            Self::Ratio(of) => write!(f, "({} / ({} * {} + 1.0))", of[0], of[1], of[1]),
            Self::Sine(of) => write!(f, "{of}.sin()"),
            Self::Root(of) => write!(f, "({of} * {of} + 1.0).sqrt()"),
            Self::Dot(of) => write!(f, "{}.dot({})", of[0], of[1]),
            Self::Cross(of) => write!(f, "{}.cross({})", of[0], of[1]),
            Self::Component(of, axis) => write!(f, "{of}.{}", ["x", "y", "z"][*axis]),
            Self::Column(of, axis) => write!(f, "{of}.{}_axis", ["x", "y", "z"][*axis]),
            Self::Vector(of) => write!(f, "DVec3::new({}, {}, {})", of[0], of[1], of[2]),
            Self::Columns(of) => write!(f, "DMat3::from_cols({}, {}, {})", of[0], of[1], of[2]),
            Self::Transpose(of) => write!(f, "{of}.transpose()"),
            Self::Determinant(of) => write!(f, "{of}.determinant()"),
            Self::Turned(of) => write!(f, "(turn * {of})"),
        }
    }
}

/// A generated function: statements and a result.
#[derive(Clone, Debug)]
pub(super) struct Written {
    pub(super) body: Vec<Statement>,
    pub(super) result: Expression,
}

impl Display for Written {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(
            "#[differentiate(wrt(n0, v0, tangent(turn)))]\npub fn f(mut n0: f64, mut n1: f64, mut v0: DVec3, ",
        )?;
        f.write_str("mut v1: DVec3, mut m0: DMat3, turn: DQuat, mut table: [f64; 3]) -> f64 {\n")?;
        let mut known = [2, 2, 1];
        for statement in &self.body {
            write_statement(f, statement, &mut known)?;
        }
        write!(f, "{}\n}}\n", self.result)
    }
}

fn write_statement(f: &mut Formatter<'_>, statement: &Statement, known: &mut [usize; 3]) -> fmt::Result {
    let block = |f: &mut Formatter<'_>, body: &[Statement], known: &[usize; 3]| {
        let mut known = *known;
        body.iter().try_for_each(|statement| write_statement(f, statement, &mut known))
    };
    match statement {
        Statement::Let(kind, to) => {
            writeln!(f, "let mut {}{} = {to};", kind.letter(), known[*kind as usize])?;
            known[*kind as usize] += 1;
        }
        Statement::Set(kind, number, to) => writeln!(f, "{}{number} = {to};", kind.letter())?,
        Statement::Increase(kind, number, by) => writeln!(f, "{}{number} += {by};", kind.letter())?,
        Statement::Add(index, by) => writeln!(f, "table[{index}] += {by};")?,
        Statement::Loop { count, way, number, body } => {
            match way {
                Way::Up => writeln!(f, "for i{number} in 0..{count} {{")?,
                Way::Down => writeln!(f, "for i{number} in (0..{count}).rev() {{")?,
                Way::While => writeln!(f, "let mut i{number} = 0;\nwhile i{number} < {count} {{")?,
                Way::Each => writeln!(f, "for e{number} in table {{")?,
            }
            block(f, body, known)?;
            if *way == Way::While {
                writeln!(f, "i{number} += 1;")?;
            }
            f.write_str("}\n")?;
        }
        Statement::Leave(condition, Leave::Break) => writeln!(f, "if {condition} {{ break; }}")?,
        Statement::Leave(condition, Leave::Continue) => writeln!(f, "if {condition} {{ continue; }}")?,
        Statement::Leave(condition, Leave::Return(result)) => writeln!(f, "if {condition} {{ return {result}; }}")?,
        Statement::If { less: [a, b], then, otherwise } => {
            writeln!(f, "if {a} < {b} {{")?;
            block(f, then, known)?;
            f.write_str("} else {\n")?;
            block(f, otherwise, known)?;
            f.write_str("}\n")?;
        }
    }
    Ok(())
}
