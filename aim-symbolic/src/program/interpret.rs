//! The interpreter. It executes the same operations in the same order as the emitted code, so results agree bit for
//! bit.

use crate::{Number, Program};

impl Program {
    /// Runs the program and writes its outputs to `out`. Missing inputs count as 0; outputs beyond the length of `out`
    /// are dropped.
    pub fn run<T: Number>(&self, inputs: &[T], out: &mut [T]) {
        let values = self.values(inputs);
        for (out, value) in out.iter_mut().zip(self.outputs()) {
            *out = values[value.index()];
        }
    }

    /// Returns the value of every operation.
    pub(crate) fn values<T: Number>(&self, inputs: &[T]) -> Vec<T> {
        let mut values: Vec<T> = Vec::with_capacity(self.ops().len());
        for op in self.ops() {
            let value = op.map(|v| values[v.index()]).value(inputs);
            values.push(value);
        }
        values
    }
}
