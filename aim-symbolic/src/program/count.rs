//! Operation counts. Sines and cosines are given, so calls of functions are counted apart.

use std::fmt;

use crate::{Op, Program};

/// How many operations of each kind a program performs. Negations are free.
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
}

impl Count {
    /// Powers: programs have no such operation.
    pub const POW: usize = 0;

    /// All operations but comparisons, selects and calls.
    pub fn total(&self) -> usize {
        self.add + self.mul + self.div + self.sqrt + Self::POW
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { add, mul, div, sqrt, select, call } = self;
        write!(f, "{} operations: {add} add, {mul} mul, {div} div, {sqrt} sqrt; {select} select", self.total())?;
        if *call > 0 { write!(f, ", {call} call") } else { Ok(()) }
    }
}

impl Program {
    /// The operations of this program.
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        for op in self.ops() {
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
}
