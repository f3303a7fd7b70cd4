//! Steps: vector variables of value 0 by which rotations move on their manifold.
//!
//! To take derivatives by a rotation R, it is stated as R exp δ or exp δ R with a step δ. The sweeps then need only
//! ∂(exp(δ) v) = δ̇ × v; no entry of the rotation itself is differentiated. They keep the terms of first order in δ, so
//! that second derivatives are right too. After the sweeps all steps are set to 0.

use crate::rewrite::rules::AT_REST;
use crate::{Graph, Rotation, RotationNode, Scalar, Vector, VectorNode};

impl Graph {
    /// Returns the step or motion of `rotation`, and `true` if `rotation` is the inverse of that rotation. The inverse
    /// of a moving rotation has the motion in the body.
    pub(crate) fn moved_by(&self, rotation: Rotation) -> Option<(Vector, bool)> {
        let (turn, back) = self.untransposed(rotation);
        match turn {
            RotationNode::Step(step) => Some((step, back)),
            RotationNode::Moving([_, body]) if back => Some((body, back)),
            RotationNode::Moving([world, _]) => Some((world, back)),
            _ => None,
        }
    }

    pub(crate) fn is_motion(&self, v: Vector) -> bool {
        matches!(self.vector_node(v), VectorNode::Motion(..))
    }

    /// Returns J m, with J the left Jacobian of the rotation about `v` by its length r:
    /// m sin r / r + (v × m)(1 − cos r)/r² + (v · m) v (r − sin r)/r³. With `curled_back` the cross product has the
    /// opposite sign: the right Jacobian, which is also the transpose of the left one.
    pub(crate) fn turned_rate(&mut self, v: Vector, m: Vector, curled_back: bool) -> Vector {
        let [_, kept, aside, along] = self.turn_factors(v);
        let (cross, dot) = (self.cross(v, m), self.dot(v, m));
        let along = self.mul(along, dot);
        let (kept, aside, along) = (self.scale(kept, m), self.scale(aside, cross), self.scale(along, v));
        let sum = self.add_vectors(kept, along);
        if curled_back { self.sub_vectors(sum, aside) } else { self.add_vectors(sum, aside) }
    }

    /// Returns `outputs` with all steps set to 0 and the rotations about them removed.
    pub(crate) fn at_rest(&mut self, outputs: &[Scalar]) -> Vec<Scalar> {
        if self.step_components() == 0 {
            return outputs.to_vec();
        }
        self.rewrite_by(outputs, &AT_REST)
    }
}
