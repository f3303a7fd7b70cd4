//! In-place Cholesky factorisation of the symmetric band matrix, linear in the number of frames.

use super::node::{BAND, Node};
use crate::Scalar;

/// Fraction of a diagonal entry that must remain as a pivot for the matrix to count as positive definite.
const PIVOT: f64 = 1e-13;

/// Replaces the rows by those of the lower factor L of L·Lᵀ. Returns `false` if the matrix is not positive definite.
pub(super) fn factor(nodes: &mut [Node]) -> bool {
    for row in 0..3 * nodes.len() {
        let mut entries = nodes[row / 3].rows[row % 3];
        let width = (BAND - 1).min(row);
        // From the leftmost column to the diagonal.
        for k in (0..=width).rev() {
            let column = row - k;
            let other = if k == 0 { entries } else { nodes[column / 3].rows[column % 3] };
            let mut left = entries[k];
            for m in k + 1..=width {
                left -= entries[m] * other[m - k];
            }
            if k == 0 {
                // The negation also catches NaN.
                if !(left > PIVOT * entries[0]) || !left.is_finite() {
                    return false;
                }
                entries[0] = <f64 as Scalar>::sqrt(left);
            } else {
                entries[k] = left / other[0];
            }
        }
        nodes[row / 3].rows[row % 3] = entries;
    }
    true
}

/// Sets the step: the solution of matrix · step = −gradient, from the factored matrix.
pub(super) fn solve(nodes: &mut [Node]) {
    let rows = 3 * nodes.len();
    // L·y = −gradient.
    for row in 0..rows {
        let entries = nodes[row / 3].rows[row % 3];
        let mut left = -nodes[row / 3].gradient[row % 3];
        for k in 1..BAND.min(row + 1) {
            left -= entries[k] * nodes[(row - k) / 3].step[(row - k) % 3];
        }
        nodes[row / 3].step[row % 3] = left / entries[0];
    }
    // Lᵀ·step = y.
    for row in (0..rows).rev() {
        let entries = nodes[row / 3].rows[row % 3];
        let solved = nodes[row / 3].step[row % 3] / entries[0];
        nodes[row / 3].step[row % 3] = solved;
        for k in 1..BAND.min(row + 1) {
            nodes[(row - k) / 3].step[(row - k) % 3] -= entries[k] * solved;
        }
    }
}
