//! Formulas as people write them: one tree, made of expressions and programs, from which [`latex`](super::latex) and
//! [`mathml`](super::mathml) are written.

/// A formula.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Formula {
    /// A letter or a word that stands for something.
    Symbol(String, Face),
    /// A number, as it is written.
    Number(String),
    /// A sign between two formulas, or before one.
    Sign(Sign),
    /// Formulas side by side.
    Row(Vec<Self>),
    /// With an index.
    Index(Box<Self>, Box<Self>),
    /// Times itself.
    Squared(Box<Self>),
    /// The way back of a rotation.
    Transposed(Box<Self>),
    /// The inverse of a matrix.
    Inverse(Box<Self>),
    /// A fraction.
    Fraction(Box<Self>, Box<Self>),
    /// A square root.
    Root(Box<Self>),
    /// In parentheses.
    Group(Box<Self>),
    /// Between bars: a length.
    Bars(Box<Self>),
    /// Under a bar: what the value changes by with this part.
    Over(Box<Self>),
    /// Rows of a matrix; a single column is a vector.
    Matrix(Vec<Vec<Self>>),
    /// The first where the condition holds, else the second.
    Cases(Box<[Self; 2]>, Box<Self>),
}

/// How a symbol is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// Numbers and matrices.
    Italic,
    /// Vectors.
    Bold,
    /// Words and functions.
    Upright,
}

/// The signs that formulas are joined by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sign {
    /// +
    Plus,
    /// − between two terms.
    Minus,
    /// − before one.
    Negative,
    /// The product of two vectors that is a number.
    Dot,
    /// The product of two vectors that is a vector.
    Cross,
    /// A product that is not written.
    Times,
    /// A product of two numbers, which has to be written.
    Point,
    /// =
    Equals,
    /// <
    Less,
    /// Square to.
    Across,
    /// The sign of a derivative.
    Partial,
    /// Leads to.
    Becomes,
    /// Between the parts of a list.
    Comma,
}

impl Formula {
    /// A vector's symbol.
    #[must_use]
    pub fn vector(name: &str) -> Self {
        Self::Symbol(name.to_owned(), Face::Bold)
    }

    /// A number's or a matrix's symbol.
    #[must_use]
    pub fn italic(name: &str) -> Self {
        Self::Symbol(name.to_owned(), Face::Italic)
    }

    /// A word.
    #[must_use]
    pub fn upright(name: &str) -> Self {
        Self::Symbol(name.to_owned(), Face::Upright)
    }

    /// A number to seven digits, a minus sign before it if need be.
    #[must_use]
    pub fn number(value: f64) -> Self {
        let rounded: f64 = format!("{:.6e}", value.abs()).parse().unwrap_or(value);
        let digits = Self::Number(format!("{rounded}"));
        if value < 0.0 { Self::Row(vec![Self::Sign(Sign::Negative), digits]) } else { digits }
    }

    /// With this index, after those that it has.
    #[must_use]
    pub fn indexed(self, index: Self) -> Self {
        match self {
            Self::Index(stem, before) => {
                let both = Self::Row(vec![*before, Self::Sign(Sign::Comma), index]);
                Self::Index(stem, Box::new(both))
            }
            stem => Self::Index(Box::new(stem), Box::new(index)),
        }
    }

    /// The same with a number as index.
    #[must_use]
    pub fn numbered(self, index: usize) -> Self {
        self.indexed(Self::Number(index.to_string()))
    }

    /// `left`, the sign, `right`.
    #[must_use]
    pub fn infix(left: Self, sign: Sign, right: Self) -> Self {
        let mut row = Vec::new();
        for part in [left, Self::Sign(sign), right] {
            match part {
                Self::Row(parts) => row.extend(parts),
                part => row.push(part),
            }
        }
        Self::Row(row)
    }

    /// The formulas one after the other, with commas between them.
    pub fn list(formulas: impl IntoIterator<Item = Self>) -> Self {
        let mut row = Vec::new();
        for formula in formulas {
            if !row.is_empty() {
                row.push(Self::Sign(Sign::Comma));
            }
            row.push(formula);
        }
        Self::Row(row)
    }

    /// `left = right`
    #[must_use]
    pub fn equals(left: Self, right: Self) -> Self {
        Self::infix(left, Sign::Equals, right)
    }

    /// The derivative of `of` by `by`, as a fraction.
    #[must_use]
    pub fn derivative(of: Self, by: Self) -> Self {
        let d = |what| Box::new(Self::Row(vec![Self::Sign(Sign::Partial), what]));
        Self::Fraction(d(of), d(by))
    }

    /// The way back of a rotation.
    #[must_use]
    pub fn transposed(self) -> Self {
        Self::Transposed(Box::new(self))
    }

    /// Under a bar.
    #[must_use]
    pub fn barred(self) -> Self {
        match self {
            Self::Index(stem, index) => Self::Index(Box::new(stem.barred()), index),
            stem => Self::Over(Box::new(stem)),
        }
    }

    /// Whether it is higher than a line of text.
    pub fn is_high(&self) -> bool {
        match self {
            Self::Symbol(..) | Self::Number(_) | Self::Sign(_) => false,
            Self::Row(parts) => parts.iter().any(Self::is_high),
            Self::Index(a, _)
            | Self::Squared(a)
            | Self::Transposed(a)
            | Self::Inverse(a)
            | Self::Group(a)
            | Self::Bars(a)
            | Self::Over(a) => a.is_high(),
            Self::Fraction(..) | Self::Root(_) | Self::Matrix(_) | Self::Cases(..) => true,
        }
    }

    /// How many symbols, numbers and signs it is written with.
    pub fn length(&self) -> usize {
        match self {
            Self::Symbol(..) | Self::Number(_) | Self::Sign(_) => 1,
            Self::Row(parts) => parts.iter().map(Self::length).sum(),
            Self::Index(stem, _) | Self::Squared(stem) | Self::Transposed(stem) | Self::Inverse(stem) => stem.length(),
            Self::Fraction(a, b) => a.length() + b.length(),
            Self::Root(a) | Self::Group(a) | Self::Bars(a) | Self::Over(a) => a.length(),
            Self::Matrix(rows) => rows.iter().flatten().map(Self::length).sum(),
            Self::Cases(branches, condition) => branches.iter().map(Self::length).sum::<usize>() + condition.length(),
        }
    }
}
