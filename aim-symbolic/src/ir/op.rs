//! Operations on numbers: the instructions of programs. Expressions consist of nothing else once they are lowered.

/// A constant. Compared by its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Constant(u64);

impl Constant {
    /// Creates a constant; −0 becomes 0.
    #[must_use]
    pub fn new(value: f64) -> Self {
        Self((value + 0.0).to_bits())
    }

    /// Returns the value.
    #[must_use]
    pub fn value(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// A function of one number from the mathematics library.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent.
    Tan,
    /// The arc sine.
    Asin,
    /// The arc cosine.
    Acos,
    /// The exponential.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
    /// The largest integer not greater than the argument.
    Floor,
}

impl Function {
    /// Returns the function's name, the same in Rust and in mathematics.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Floor => "floor",
        }
    }
}

/// The result of an operation of a [`Program`](crate::Program), identified by the operation's index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Value(pub(crate) u32);

impl Value {
    pub(crate) fn at(place: usize) -> Self {
        Self(u32::try_from(place).expect("four billion operations do not fit in memory"))
    }

    /// Returns the index in [`Program::ops`](crate::Program::ops).
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operation. Its operands can be earlier values of a program, scalars of a graph, numbers or pieces of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op<V = Value> {
    /// The input with this index.
    Input(u32),
    /// A number.
    Constant(Constant),
    /// The smallest length by which a guarded division divides.
    Tiny,
    /// a + b
    Add(V, V),
    /// a − b
    Sub(V, V),
    /// a b
    Mul(V, V),
    /// a / b
    Div(V, V),
    /// −a
    Neg(V),
    /// √a
    Sqrt(V),
    /// The third operand if the first is less than the second, else the fourth.
    SelectLess(V, V, V, V),
    /// A function of a.
    Call(Function, V),
    /// atan2(first, second): the angle of the point (second, first), measured from the first axis.
    Atan2(V, V),
    /// The first to the power of the second.
    Pow(V, V),
}

impl<V> Op<V> {
    /// Returns `true` if the operation costs a step. Inputs and constants are available anyway, and a negation is free.
    pub(crate) fn is_step(&self) -> bool {
        !matches!(self, Self::Input(_) | Self::Constant(_) | Self::Tiny | Self::Neg(_))
    }

    /// Returns `true` if the operation is written as an operator between two operands.
    pub(crate) fn is_arithmetic(&self) -> bool {
        matches!(self, Self::Add(..) | Self::Sub(..) | Self::Mul(..) | Self::Div(..))
    }

    /// Returns the operation with each operand mapped, in order.
    pub fn map<W>(self, mut exchange: impl FnMut(V) -> W) -> Op<W> {
        match self {
            Self::Input(i) => Op::Input(i),
            Self::Constant(c) => Op::Constant(c),
            Self::Tiny => Op::Tiny,
            Self::Add(a, b) => Op::Add(exchange(a), exchange(b)),
            Self::Sub(a, b) => Op::Sub(exchange(a), exchange(b)),
            Self::Mul(a, b) => Op::Mul(exchange(a), exchange(b)),
            Self::Div(a, b) => Op::Div(exchange(a), exchange(b)),
            Self::Neg(a) => Op::Neg(exchange(a)),
            Self::Sqrt(a) => Op::Sqrt(exchange(a)),
            Self::SelectLess(a, b, c, d) => Op::SelectLess(exchange(a), exchange(b), exchange(c), exchange(d)),
            Self::Call(function, a) => Op::Call(function, exchange(a)),
            Self::Atan2(y, x) => Op::Atan2(exchange(y), exchange(x)),
            Self::Pow(a, b) => Op::Pow(exchange(a), exchange(b)),
        }
    }

    /// Returns the operands in order.
    pub fn operands(self) -> impl Iterator<Item = V> {
        let mut operands = [None, None, None, None];
        let mut free = operands.iter_mut();
        self.map(|v| free.next().map(|place| *place = Some(v)));
        operands.into_iter().flatten()
    }
}
