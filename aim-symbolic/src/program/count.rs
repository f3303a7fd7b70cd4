//! Operation counts. Sines and cosines of angles are inputs, so calls of functions are counted separately.

use std::fmt;

use crate::{Op, Program};

/// The number of operations of each kind in a program. Negations are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Additions and subtractions.
    pub add: usize,
    /// Multiplications.
    pub mul: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Comparisons and selects; not in the total.
    pub select: usize,
    /// Calls of functions (sines, exponentials, …); not in the total.
    pub call: usize,
    /// Operations of series and of their margins, which are computed beside closed forms that are 0 / 0 somewhere. Not
    /// in any other count.
    pub series: usize,
}

impl core::ops::Add for Count {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            add: self.add + other.add,
            mul: self.mul + other.mul,
            div: self.div + other.div,
            sqrt: self.sqrt + other.sqrt,
            select: self.select + other.select,
            call: self.call + other.call,
            series: self.series + other.series,
        }
    }
}

impl Count {
    /// The number of powers in the total: always 0, since [`Op::Pow`] counts as a call.
    pub const POW: usize = 0;

    /// Returns the number of operations, except comparisons, selects, calls and series.
    #[must_use]
    pub fn total(&self) -> usize {
        self.add + self.mul + self.div + self.sqrt + Self::POW
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { add, mul, div, sqrt, select, call, series } = self;
        write!(f, "{} operations: {add} add, {mul} mul, {div} div, {sqrt} sqrt; {select} select", self.total())?;
        if *call > 0 {
            write!(f, ", {call} call")?;
        }
        if *series > 0 { write!(f, ", {series} of series") } else { Ok(()) }
    }
}

impl Program {
    /// Counts the operations of the program.
    #[must_use]
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        let plain = self.without_series();
        for (op, is_plain) in self.ops().iter().zip(plain) {
            if !is_plain && !matches!(op, Op::SelectLess(..)) {
                count.series += usize::from(op.is_step());
                continue;
            }
            match op {
                Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_) => {}
                Op::Add(..) | Op::Sub(..) => count.add += 1,
                Op::Mul(..) => count.mul += 1,
                Op::Div(..) => count.div += 1,
                Op::Sqrt(_) => count.sqrt += 1,
                // A comparison and a select.
                Op::SelectLess(..) => count.select += 2,
                Op::Call(..) | Op::Atan2(..) | Op::Pow(..) => count.call += 1,
            }
        }
        count
    }

    /// Returns for each operation whether it is used outside of series and their margins.
    pub(super) fn without_series(&self) -> Vec<bool> {
        let mut plain = vec![false; self.ops().len()];
        self.outputs().iter().for_each(|v| plain[v.index()] = true);
        for (place, op) in self.ops().iter().enumerate().rev() {
            if plain[place] {
                match *op {
                    Op::SelectLess(tiny, _, closed, _) if self.ops()[tiny.index()] == Op::Tiny => {
                        plain[closed.index()] = true;
                    }
                    _ => op.operands().for_each(|v| plain[v.index()] = true),
                }
            }
        }
        plain
    }
}
