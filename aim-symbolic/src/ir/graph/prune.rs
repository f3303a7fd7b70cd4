//! [`Graph::pruned`]: removes unused nodes from a graph.

use super::{AngleEntry, Graph};
use crate::ir::node::{Node, Parts};
use crate::ir::table::{Id, Table};
use crate::{Angle, Op, Rotation, Scalar, ScalarNode, Variable, Vector};

/// The result of [`Graph::pruned`].
#[derive(Debug)]
pub struct Pruned {
    /// The remaining graph; its nodes keep their order.
    pub graph: Graph,
    ids: IdMap,
}

impl Pruned {
    /// Returns the new id of a scalar, or `None` if it was dropped.
    #[must_use]
    pub fn scalar(&self, scalar: Scalar) -> Option<Scalar> {
        self.ids.scalars.copied(scalar)
    }

    /// Returns the new id of a vector, or `None` if it was dropped.
    #[must_use]
    pub fn vector(&self, vector: Vector) -> Option<Vector> {
        self.ids.vectors.copied(vector)
    }
}

impl Graph {
    /// Drops all nodes that `needed` does not depend on. Keeps angles, directions, and inputs that are not `optional`.
    #[must_use]
    pub fn pruned(&self, needed: &[Node], optional: &[Scalar]) -> Pruned {
        let mut reachable = ReachableNodes::default();
        for &node in needed {
            match node {
                Node::Scalar(s) => _ = reachable.scalar(s),
                Node::Vector(v) => _ = reachable.vector(v),
            }
        }
        for angle in &self.angles {
            [Some(angle.sin), Some(angle.cos), angle.radians]
                .into_iter()
                .flatten()
                .for_each(|s| _ = reachable.scalar(s));
        }
        for &(variable, component) in self.directions.iter().flatten() {
            reachable.scalar(component);
            exchanged(variable, &mut reachable);
        }
        for (s, node) in (0..).map(Scalar).zip(&self.scalars.nodes) {
            if matches!(node, ScalarNode::Op(Op::Input(_))) && !optional.contains(&s) {
                reachable.scalar(s);
            }
        }
        while let Some(part) = reachable.unvisited.pop() {
            match part {
                Part::Scalar(s) => _ = self.scalar_node(s).map(&mut reachable),
                Part::Vector(v) => _ = self.vector_node(v).map(&mut reachable),
                Part::Rotation(r) => _ = self.rotation_node(r).map(&mut reachable),
            }
        }
        let [scalars, vectors, rotations] = self.sizes();
        let mut ids = reachable.ids;
        number(&mut ids.scalars, scalars, Scalar);
        number(&mut ids.vectors, vectors, Vector);
        number(&mut ids.rotations, rotations, Rotation);
        Pruned { graph: self.with_new_ids(&mut ids), ids }
    }

    fn with_new_ids(&self, ids: &mut IdMap) -> Self {
        let mut pruned = Self { steps: self.steps, ..Self::new() };
        for (s, &node) in (0..).map(Scalar).zip(&self.scalars.nodes) {
            match node {
                _ if !ids.scalars.contains(s) => {}
                ScalarNode::Op(Op::Input(input)) => {
                    let (name, kind) = self.inputs[input as usize].clone();
                    pruned.declare(name, kind);
                }
                node => _ = pruned.intern_scalar(node.map(ids)),
            }
        }
        for (v, &node) in (0..).map(Vector).zip(&self.vectors.nodes) {
            if ids.vectors.contains(v) {
                pruned.intern_vector(node.map(ids));
            }
        }
        for (r, &node) in (0..).map(Rotation).zip(&self.rotations.nodes) {
            if ids.rotations.contains(r) {
                pruned.intern_rotation(node.map(ids));
            }
        }
        for (angle, entry) in (0..).map(Angle).zip(&self.angles) {
            let [sin, cos] = [entry.sin, entry.cos].map(|s| ids.scalar(s));
            let radians = entry.radians.map(|s| ids.scalar(s));
            if let Some(radians) = radians {
                pruned.angles_of.insert(radians, angle);
            }
            pruned.angles.push(AngleEntry { name: entry.name.clone(), sin, cos, radians, shifted: entry.shifted });
        }
        let mut components = |all: &Vec<(Variable, Scalar)>| {
            all.iter().map(|&(variable, k)| (exchanged(variable, ids), ids.scalar(k))).collect()
        };
        pruned.directions = self.directions.iter().map(&mut components).collect();
        pruned
    }
}

/// Numbers the remaining ids consecutively.
fn number<K: Id>(ids: &mut Table<K, K>, count: usize, id: fn(u32) -> K) {
    let mut next = 0..;
    for old in (0..).take(count).map(id) {
        if ids.contains(old) {
            ids.insert(old, id(next.next().unwrap_or_default()));
        }
    }
}

/// Old ids mapped to ids in the pruned graph.
#[derive(Clone, Debug, Default)]
struct IdMap {
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, Vector>,
    rotations: Table<Rotation, Rotation>,
}

impl Parts for IdMap {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        self.scalars[scalar]
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        self.vectors[vector]
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        self.rotations[rotation]
    }

    fn angle(&mut self, angle: Angle) -> Angle {
        angle
    }
}

/// Nodes that are needed, and a stack of those among them whose operands have not been visited.
#[derive(Default)]
struct ReachableNodes {
    ids: IdMap,
    unvisited: Vec<Part>,
}

enum Part {
    Scalar(Scalar),
    Vector(Vector),
    Rotation(Rotation),
}

impl Parts for ReachableNodes {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if self.ids.scalars.insert(scalar, scalar) {
            self.unvisited.push(Part::Scalar(scalar));
        }
        scalar
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        if self.ids.vectors.insert(vector, vector) {
            self.unvisited.push(Part::Vector(vector));
        }
        vector
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        if self.ids.rotations.insert(rotation, rotation) {
            self.unvisited.push(Part::Rotation(rotation));
        }
        rotation
    }

    fn angle(&mut self, angle: Angle) -> Angle {
        angle
    }
}

/// Returns a variable with its operand mapped.
fn exchanged(variable: Variable, parts: &mut impl Parts) -> Variable {
    match variable {
        Variable::Input(input) => Variable::Input(parts.scalar(input)),
        variable => variable,
    }
}
