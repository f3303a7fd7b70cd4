//! [`Graph::pruned`]: removes unused nodes from a graph.

use super::{AngleEntry, Graph};
use crate::ir::node::{Node, Parts};
use crate::ir::table::Table;
use crate::{Angle, Op, Rotation, Scalar, ScalarNode, Variable, Vector};

/// The result of [`Graph::pruned`].
#[derive(Debug, Default)]
pub struct Pruned {
    /// The remaining graph; its scalars and vectors keep their order.
    pub graph: Graph,
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, Vector>,
}

impl Pruned {
    /// Returns the new id of a scalar, or `None` if it was dropped.
    #[must_use]
    pub fn scalar(&self, scalar: Scalar) -> Option<Scalar> {
        self.scalars.copied(scalar)
    }

    /// Returns the new id of a vector, or `None` if it was dropped.
    #[must_use]
    pub fn vector(&self, vector: Vector) -> Option<Vector> {
        self.vectors.copied(vector)
    }
}

impl Graph {
    /// Drops all nodes that `needed` does not depend on. Keeps angles, directions, and inputs that are not `optional`.
    #[must_use]
    pub fn pruned(&self, needed: &[Node], optional: &[Scalar]) -> Pruned {
        let (mut scalars, mut vectors) = (Vec::new(), Vec::new());
        for node in self.order_with_numbers(&self.roots(needed, optional)) {
            match node {
                Node::Scalar(s) => scalars.push(s),
                Node::Vector(v) => vectors.push(v),
            }
        }
        scalars.sort_unstable();
        vectors.sort_unstable();
        let mut pruning = Pruning { g: self, pruned: Pruned::default(), rotations: Table::default() };
        for (&s, new) in scalars.iter().zip((0..).map(Scalar)) {
            pruning.pruned.scalars.insert(s, new);
        }
        for (&v, new) in vectors.iter().zip((0..).map(Vector)) {
            pruning.pruned.vectors.insert(v, new);
        }
        for s in scalars {
            if let ScalarNode::Op(Op::Input(input)) = self.scalar_node(s) {
                let (name, kind) = self.inputs[input as usize].clone();
                pruning.pruned.graph.declare(name, kind);
            } else {
                let node = self.scalar_node(s).map(&mut pruning);
                pruning.pruned.graph.intern_scalar(node);
            }
        }
        for v in vectors {
            let node = self.vector_node(v).map(&mut pruning);
            pruning.pruned.graph.intern_vector(node);
        }
        pruning.copy_variables();
        pruning.pruned
    }

    /// Returns the nodes of which nothing is dropped: what is `needed`, angles, directions, and inputs.
    fn roots(&self, needed: &[Node], optional: &[Scalar]) -> Vec<Node> {
        let of_angles =
            self.angles.iter().flat_map(|angle| [Some(angle.sin), Some(angle.cos), angle.radians]).flatten();
        let of_directions = self.directions.iter().flatten().flat_map(|&(variable, component)| match variable {
            Variable::Input(input) => vec![input, component],
            _ => vec![component],
        });
        let is_input = |s: &Scalar| matches!(self.scalar_node(*s), ScalarNode::Op(Op::Input(_)));
        let all = (0..).map(Scalar).take(self.scalars.nodes.len());
        let inputs = all.filter(|s| is_input(s) && !optional.contains(s));
        needed.iter().copied().chain(of_angles.chain(of_directions).chain(inputs).map(Node::Scalar)).collect()
    }
}

/// Maps operands to the pruned graph, to which it adds the rotations.
struct Pruning<'g> {
    g: &'g Graph,
    pruned: Pruned,
    rotations: Table<Rotation, Rotation>,
}

impl Pruning<'_> {
    fn copy_variables(&mut self) {
        let g = self.g;
        for (angle, entry) in (0..).map(Angle).zip(&g.angles) {
            let [sin, cos] = [entry.sin, entry.cos].map(|s| self.scalar(s));
            let radians = entry.radians.map(|s| self.scalar(s));
            if let Some(radians) = radians {
                self.pruned.graph.angles_of.insert(radians, angle);
            }
            self.pruned.graph.angles.push(AngleEntry { sin, cos, radians, ..entry.clone() });
        }
        for components in &g.directions {
            let component = |&(variable, k): &(Variable, Scalar)| match variable {
                Variable::Input(input) => (self.scalar(input).into(), self.scalar(k)),
                variable => (variable, self.scalar(k)),
            };
            let components = components.iter().map(component).collect();
            self.pruned.graph.directions.push(components);
        }
        self.pruned.graph.steps = g.steps;
    }
}

impl Parts for Pruning<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        self.pruned.scalars[scalar]
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        self.pruned.vectors[vector]
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        if let Some(known) = self.rotations.copied(rotation) {
            return known;
        }
        let node = self.g.rotation_node(rotation).map(self);
        let new = self.pruned.graph.intern_rotation(node);
        self.rotations.insert(rotation, new);
        new
    }

    fn angle(&mut self, angle: Angle) -> Angle {
        angle
    }
}
