//! Newton's method with the derived second derivatives, damped if the matrix is not positive definite or if the
//! quadratic model does not hold over the whole step.
//!
//! Gauss–Newton blocks are not sufficient. Torsion does not change places to first order, so Gauss–Newton ignores it.
//! Only the smoothing term then resists it, and steps overshoot: more than sixty evaluations where this method takes
//! ten.

use super::banded::{factor, solve};
use super::cost::{At, Problem, extent_of, steps};
use super::node::{dot, plus};
use crate::Scalar;

/// Gradient that results from rounding a point, relative to the extent and to the weights of its second difference.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Largest step of a point, relative to the extent, at which the iteration counts as converged.
const SETTLED: f64 = 1e-4;
/// Damping below which it is set to 0; the second derivatives of a place are around 1.
const LEAST: f64 = 1e-9;
/// Initial damping after a step that led uphill, and after a matrix that was not positive definite.
const FIRST: [f64; 2] = [1e-4, 1e-6];
/// Damping at which steps are negligible and the iteration gives up.
const MOST: f64 = 1e12;

impl Problem<'_> {
    /// Sets the smoothest curve through everything that is fixed or has a spring.
    pub(super) fn smooth(&mut self) {
        for node in &mut *self.nodes {
            let is_held = node.fixed || node.spring.0 > 0.0;
            (node.point, node.fixed) = (if is_held { node.spring.1 } else { node.rest }, is_held);
        }
        let mut damping = 0.0;
        self.assemble(false);
        // With free ends the smoothing alone may leave the curve free to rotate.
        while !self.factored(damping, false) && damping < MOST {
            damping = FIRST[1].max(8.0 * damping);
        }
        solve(self.nodes);
        for node in &mut *self.nodes {
            node.point = plus(node.point, node.step);
            node.fixed &= !(node.spring.0 > 0.0);
        }
    }

    /// Assembles the matrix, adds the damping and factors it. Returns `false` if it is not positive definite.
    fn factored(&mut self, damping: f64, places: bool) -> bool {
        self.assemble(places);
        for node in self.nodes.iter_mut().filter(|node| !node.fixed) {
            node.rows.iter_mut().for_each(|row| row[0] += damping);
        }
        factor(self.nodes)
    }

    /// Minimises the cost from the current point. Returns the number of evaluations, and the remaining gradient as a
    /// fraction of the first.
    pub(super) fn minimise(&mut self, evaluations: usize, tolerance: f64) -> (usize, f64) {
        let (mut cost, mut evaluated) = (self.cost(At::Point), 1);
        let mut damping = 0.0;
        let mut first = None;
        let extent = extent_of(self.nodes);
        let weight = <f64 as Scalar>::sqrt(1.0 + self.epsilon);
        let rounding = ROUNDING * extent * weight * weight * <f64 as Scalar>::sqrt(steps(self.nodes.len()));
        let settled = SETTLED * extent;
        loop {
            while !self.factored(damping, true) && damping < MOST {
                damping = FIRST[1].max(4.0 * damping);
            }
            let gradient = self.gradient();
            let first = *first.get_or_insert(gradient);
            let left = if gradient > rounding { gradient / first } else { 0.0 };
            solve(self.nodes);
            let (mut slope, mut square, mut longest) = (0.0, 0.0, 0.0_f64);
            for node in &mut *self.nodes {
                let step = dot(node.step, node.step);
                (slope, square, longest) = (slope + dot(node.gradient, node.step), square + step, longest.max(step));
                node.trial = plus(node.point, node.step);
            }
            // After a start far away the first gradient is so large that a small fraction of it means little, so steps
            // must be small too.
            let is_settled = left <= tolerance && longest <= settled * settled;
            // The negation also catches NaN.
            if left == 0.0 || is_settled || evaluated >= evaluations || !(damping < MOST) || !(square < f64::MAX) {
                return (evaluated, left);
            }
            // Decrease of the cost that the quadratic model predicts for the damped step.
            let predicted = 0.5 * (damping * square - slope);
            let found = self.cost(At::Trial);
            evaluated += 1;
            // A place is known to within rounding of the extent, so a squared change to within that times the change.
            let noise = 2.0 * ROUNDING * extent * weight * <f64 as Scalar>::sqrt(cost);
            if found <= cost * (1.0 + 4.0 * f64::EPSILON) + noise {
                let is_trusted = cost - found > 0.5 * predicted;
                damping *= if is_trusted { 0.125 } else { 2.0 };
                if damping < LEAST {
                    damping = 0.0;
                }
                cost = found;
                self.nodes.iter_mut().for_each(|node| node.point = node.trial);
            } else {
                damping = FIRST[0].max(8.0 * damping);
            }
        }
    }

    fn gradient(&self) -> f64 {
        <f64 as Scalar>::sqrt(self.nodes.iter().map(|node| dot(node.gradient, node.gradient)).sum())
    }
}
