//! Formulas in mathematical notation: a tree, built from expressions and programs and written by
//! [`latex`](super::latex), [`mathml`](super::mathml) and [`text`](super::text).

/// A formula.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Formula {
    /// A symbol: a letter or a word.
    Symbol(String, Typeface),
    /// A number, as digits.
    Number(String),
    /// A sign between two formulas, or before one.
    Sign(Sign),
    /// Formulas in sequence.
    Row(Vec<Self>),
    /// A formula with an index.
    Index(Box<Self>, Box<Self>),
    /// The square of a formula.
    Squared(Box<Self>),
    /// The transpose of a rotation or matrix.
    Transposed(Box<Self>),
    /// The inverse of a matrix.
    Inverse(Box<Self>),
    /// A fraction: numerator, denominator.
    Fraction(Box<Self>, Box<Self>),
    /// A square root.
    Root(Box<Self>),
    /// A formula in parentheses.
    Group(Box<Self>),
    /// A formula between bars: a length or an absolute value.
    Bars(Box<Self>),
    /// A formula with a bar over it: the derivative of the value by this part.
    Over(Box<Self>),
    /// A matrix, by rows; a single column is a vector.
    Matrix(Vec<Vec<Self>>),
    /// A case distinction: the first formula if the condition holds, else the second.
    Cases(Box<[Self; 2]>, Box<Self>),
}

/// The typeface of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Typeface {
    /// Numbers and matrices.
    Italic,
    /// Vectors.
    Bold,
    /// Words and functions.
    Upright,
}

/// Signs that join formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sign {
    /// +
    Plus,
    /// − between two terms.
    Minus,
    /// − before one term.
    Negative,
    /// ·, the dot product of two vectors.
    Dot,
    /// ×, the cross product of two vectors.
    Cross,
    /// A product without a visible sign.
    Times,
    /// A product of two numbers with a visible sign.
    Point,
    /// =
    Equals,
    /// <
    Less,
    /// ⊥, perpendicular to.
    Across,
    /// ∂, the sign of a partial derivative.
    Partial,
    /// →, the result of a rewriting.
    Becomes,
    /// A comma between the elements of a list.
    Comma,
}

impl Formula {
    /// Creates the symbol of a vector.
    #[must_use]
    pub fn vector(name: &str) -> Self {
        Self::Symbol(name.to_owned(), Typeface::Bold)
    }

    /// Creates the symbol of a number or a matrix.
    #[must_use]
    pub fn italic(name: &str) -> Self {
        Self::Symbol(name.to_owned(), Typeface::Italic)
    }

    /// Creates an upright word.
    #[must_use]
    pub fn upright(name: &str) -> Self {
        Self::Symbol(name.to_owned(), Typeface::Upright)
    }

    /// Creates a number, rounded to seven digits, with a minus sign if it is negative.
    #[must_use]
    pub fn number(value: f64) -> Self {
        let rounded: f64 = format!("{:.6e}", value.abs()).parse().unwrap_or(value);
        let digits = Self::Number(format!("{rounded}"));
        if value < 0.0 { Self::Row(vec![Self::Sign(Sign::Negative), digits]) } else { digits }
    }

    /// Adds an index, after any existing ones.
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

    /// Adds a number as index, after any existing indices.
    #[must_use]
    pub fn numbered(self, index: usize) -> Self {
        self.indexed(Self::Number(index.to_string()))
    }

    /// Joins two formulas by a sign.
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

    /// Joins formulas by commas.
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

    /// Creates the equation `left = right`.
    #[must_use]
    pub fn equals(left: Self, right: Self) -> Self {
        Self::infix(left, Sign::Equals, right)
    }

    /// Creates the partial derivative of `of` by `by`, as a fraction.
    #[must_use]
    pub fn derivative(of: Self, by: Self) -> Self {
        let d = |what| Box::new(Self::Row(vec![Self::Sign(Sign::Partial), what]));
        Self::Fraction(d(of), d(by))
    }

    /// Returns the transpose.
    #[must_use]
    pub fn transposed(self) -> Self {
        Self::Transposed(Box::new(self))
    }

    /// Returns the formula with a bar over it; a bar is set over the stem of an indexed symbol.
    #[must_use]
    pub fn barred(self) -> Self {
        match self {
            Self::Index(stem, index) => Self::Index(Box::new(stem.barred()), index),
            stem => Self::Over(Box::new(stem)),
        }
    }

    /// Returns `true` if the formula is higher than a line of text.
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

    /// Returns the number of symbols, numbers and signs in the formula. Indices are not counted.
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
