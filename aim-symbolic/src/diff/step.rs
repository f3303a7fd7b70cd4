//! Steps: vector variables of value 0 by which rotations move on their manifold.
//!
//! To take derivatives by a rotation R, it is stated as R exp δ or exp δ R with a step δ. The sweeps then need only
//! ∂(exp(δ) v) = δ̇ × v; no entry of the rotation itself is differentiated. They keep the terms of first order in δ, so
//! that second derivatives are right too. After the sweeps all steps are set to 0.

use crate::rewrite::rules::AT_REST;
use crate::{Attitude, Graph, Rotation, RotationNode, Scalar, ScalarNode, Space, Vector, VectorNode};

/// Limit on the number of factors of a rotation whose motions are added up, counted with their products. A factor may
/// appear many times: squaring a rotation over and over doubles its factors.
const MOST_FACTORS: usize = 128;

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

    /// Returns `true` if all components of `v` are those of a step.
    pub(crate) fn is_step(&self, v: Vector) -> bool {
        let is_step = |s| matches!(self.scalar_node(s), ScalarNode::Step(_));
        matches!(self.vector_node(v), VectorNode::Components(c) if c.into_iter().all(is_step))
    }

    /// Returns `true` if `v` consists of motions, so that its value is 0.
    pub(crate) fn is_velocity(&self, v: Vector) -> bool {
        match self.vector_node(v) {
            VectorNode::Motion(..) => true,
            VectorNode::Neg(a) | VectorNode::Rotate(_, a) => self.is_velocity(a),
            VectorNode::Add(a, b) | VectorNode::Sub(a, b) => self.is_velocity(a) && self.is_velocity(b),
            _ => false,
        }
    }

    /// Returns the motion of `rotation` in the world: the sum of the motions of its factors, each turned by those
    /// outside of it; `Some(None)` if it does not move. `None` if it contains rotations by angles, or too many factors.
    fn motion(&mut self, rotation: Rotation, back: bool, left: &mut usize) -> Option<Option<Vector>> {
        *left = left.checked_sub(1)?;
        let signed = |g: &mut Self, v| if back { g.neg_vector(v) } else { v };
        match self.rotation_node(rotation) {
            RotationNode::Matrix(_) | RotationNode::Basis(_) | RotationNode::Quaternion(..) => Some(None),
            RotationNode::Turn(..) | RotationNode::About(..) => None,
            RotationNode::Moving([world, body]) => Some(Some(signed(self, if back { body } else { world }))),
            RotationNode::Step(v) => {
                let space = if back { Space::Body } else { Space::World };
                let motion = self.intern_vector(VectorNode::Motion(space, Attitude::Turn(v)));
                Some(Some(signed(self, motion)))
            }
            RotationNode::Transpose(inner) => self.motion(inner, !back, left),
            RotationNode::Compose(a, b) => {
                let [outer, inner] = if back { [b, a] } else { [a, b] };
                let (first, second) = (self.motion(outer, back, left)?, self.motion(inner, back, left)?);
                let outer = if back { self.transpose(outer) } else { outer };
                let second = second.map(|v| self.rotate(outer, v));
                Some(match (first, second) {
                    (Some(v), Some(w)) => Some(self.add_vectors(v, w)),
                    (first, second) => first.or(second),
                })
            }
        }
    }

    /// Returns the parts of the quaternion (u, w) of `rotation`, with derivatives by the rotation's motion where it has
    /// one.
    pub fn quaternion_parts(&mut self, rotation: Rotation, (u, w): (Vector, Scalar)) -> (Vector, Scalar) {
        match self.motion(rotation, false, &mut { MOST_FACTORS }).flatten() {
            Some(motion) => (self.imaginary(motion, u, w), self.real(motion, u, w)),
            None => (u, w),
        }
    }

    pub(crate) fn imaginary(&mut self, motion: Vector, u: Vector, w: Scalar) -> Vector {
        self.intern_vector(VectorNode::Imaginary(motion, u, w))
    }

    pub(crate) fn real(&mut self, motion: Vector, u: Vector, w: Scalar) -> Scalar {
        self.intern_scalar(ScalarNode::Real(motion, u, w))
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
        if self.step_components() == 0 && !self.has_quaternion_parts() {
            return outputs.to_vec();
        }
        self.rewrite_by(outputs, &AT_REST)
    }
}
