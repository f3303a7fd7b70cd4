//! Steps: vectors that are 0 and by which rotations move on their manifold.
//!
//! A rotation R that derivatives are taken by is stated as R exp δ or exp δ R with a step δ. Then ∂(exp(δ) v) = δ̇ × v is all
//! that the sweeps need: no number of the rotation itself is differentiated. The terms of first order in δ that they keep make
//! the derivatives of the derivatives right, too; after the sweeps all steps are 0.

use crate::ir::node::{Node, Parts};
use crate::ir::table::Table;
use crate::{Angle, Graph, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

impl Graph {
    /// The step that `rotation` turns by, and whether it is the way back.
    pub(crate) fn turned_by_step(&self, rotation: Rotation) -> Option<(Vector, bool)> {
        match self.rotation_node(rotation) {
            RotationNode::Step(step) => Some((step, false)),
            RotationNode::Transpose(inner) => match self.rotation_node(inner) {
                RotationNode::Step(step) => Some((step, true)),
                _ => None,
            },
            _ => None,
        }
    }

    /// ½ v × w
    pub(crate) fn half_cross(&mut self, v: Vector, w: Vector) -> Vector {
        let (half, cross) = (self.constant(0.5), self.cross(v, w));
        self.scale(half, cross)
    }

    /// What a result of y = exp(δ) v adds to the derivative by δ: J(δ)ᵀ (y × ȳ), with J = 1 + ½ [δ]× to first order; of the
    /// way back, y = exp(−δ) v, it is J(−δ)ᵀ (ȳ × y).
    pub(crate) fn moment(&mut self, step: Vector, back: bool, rotated: Vector, bar: Vector) -> Vector {
        if back {
            let moment = self.cross(bar, rotated);
            let curl = self.half_cross(step, moment);
            return self.add_vectors(moment, curl);
        }
        let moment = self.cross(rotated, bar);
        let curl = self.half_cross(step, moment);
        self.sub_vectors(moment, curl)
    }

    /// `outputs` with all steps 0, and without the turns by them.
    pub(crate) fn at_rest(&mut self, outputs: &[Scalar]) -> Vec<Scalar> {
        if self.step_components() == 0 {
            return outputs.to_vec();
        }
        let nodes: Vec<Node> = outputs.iter().map(|&s| Node::Scalar(s)).collect();
        let order = self.order_with_numbers(&nodes);
        let mut rest = Rest { g: self, scalars: Table::default(), vectors: Table::default() };
        for node in order {
            match node {
                Node::Scalar(s) => rest.take_scalar(s),
                Node::Vector(v) => rest.take_vector(v),
            }
        }
        outputs.iter().map(|&s| rest.scalar(s)).collect()
    }
}

/// Makes expressions anew without steps, each after its parts.
struct Rest<'g> {
    g: &'g mut Graph,
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, Vector>,
}

impl Rest<'_> {
    fn take_scalar(&mut self, s: Scalar) {
        let made = match self.g.scalar_node(s) {
            ScalarNode::Step(_) => self.g.constant(0.0),
            node => {
                let node = node.map(self);
                self.g.remade_scalar(node)
            }
        };
        self.scalars.insert(s, made);
    }

    fn take_vector(&mut self, v: Vector) {
        let made = match self.g.vector_node(v) {
            VectorNode::Rotate(rotation, inner) if self.g.turned_by_step(rotation).is_some() => self.vector(inner),
            node => {
                let node = node.map(self);
                self.g.intern_vector(node)
            }
        };
        self.vectors.insert(v, made);
    }
}

impl Parts for Rest<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        self.scalars.copied(scalar).unwrap_or(scalar)
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        self.vectors.copied(vector).unwrap_or(vector)
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        let node = self.g.rotation_node(rotation).map(self);
        self.g.remade_rotation(node)
    }

    fn angle(&mut self, angle: Angle) -> Angle {
        match self.g.radians(angle) {
            Some(radians) => {
                let radians = self.scalar(radians);
                self.g.angle_of(radians)
            }
            None => angle,
        }
    }
}
