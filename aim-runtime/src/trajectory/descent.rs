//! Gradient descent, as published.

use super::Waypoint;
use super::cost::Problem;
use super::node::{dot, minus, plus, scaled, wide};
use crate::Scalar;

/// Parameters of [`Trajectory::descend`](super::Trajectory::descend).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Descent {
    /// Number of steps.
    pub steps: usize,
    /// Step size: each step is this multiple of the negative gradient.
    pub rate: f64,
    /// Weight of every waypoint's spring.
    pub gamma: f64,
}

impl Problem<'_> {
    /// Descends from the animated trajectory. Returns the number of steps, and the last gradient as a fraction of the
    /// first.
    pub(super) fn descend(&mut self, waypoints: &[Waypoint], descent: Descent) -> (usize, f64) {
        let last = self.nodes.len().saturating_sub(1);
        let (mut first, mut left) = (None, 0.0);
        for _ in 0..descent.steps {
            self.set_gradient_of_places();
            for waypoint in waypoints.iter().filter(|waypoint| waypoint.weight > 0.0) {
                let node = &mut self.nodes[waypoint.frame];
                let off = minus(node.point, wide(waypoint.point));
                node.gradient = plus(node.gradient, scaled(2.0 * descent.gamma, off));
            }
            let mut square = 0.0;
            for (i, node) in self.nodes.iter_mut().enumerate() {
                let stays = node.fixed && (i == 0 || i == last);
                if !stays {
                    square += dot(node.gradient, node.gradient);
                    node.point = minus(node.point, scaled(descent.rate, node.gradient));
                }
            }
            let gradient = <f64 as Scalar>::sqrt(square);
            let first = *first.get_or_insert(gradient);
            left = if gradient > 0.0 { gradient / first } else { 0.0 };
        }
        (descent.steps, left)
    }
}
