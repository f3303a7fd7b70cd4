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
    places: Places,
}

impl Pruned {
    /// Returns the new id of a scalar, or `None` if it was dropped.
    #[must_use]
    pub fn scalar(&self, scalar: Scalar) -> Option<Scalar> {
        self.places.scalars.copied(scalar)
    }

    /// Returns the new id of a vector, or `None` if it was dropped.
    #[must_use]
    pub fn vector(&self, vector: Vector) -> Option<Vector> {
        self.places.vectors.copied(vector)
    }
}

impl Graph {
    /// Drops all nodes that `needed` does not depend on. Keeps angles, directions, and inputs that are not `optional`.
    #[must_use]
    pub fn pruned(&self, needed: &[Node], optional: &[Scalar]) -> Pruned {
        let mut reached = Reached::default();
        for &node in needed {
            match node {
                Node::Scalar(s) => _ = reached.scalar(s),
                Node::Vector(v) => _ = reached.vector(v),
            }
        }
        for angle in &self.angles {
            [Some(angle.sin), Some(angle.cos), angle.radians].into_iter().flatten().for_each(|s| _ = reached.scalar(s));
        }
        for &(variable, component) in self.directions.iter().flatten() {
            reached.scalar(component);
            exchanged(variable, &mut reached);
        }
        for (s, node) in (0..).map(Scalar).zip(&self.scalars.nodes) {
            if matches!(node, ScalarNode::Op(Op::Input(_))) && !optional.contains(&s) {
                reached.scalar(s);
            }
        }
        while let Some(part) = reached.open.pop() {
            match part {
                Part::Scalar(s) => _ = self.scalar_node(s).map(&mut reached),
                Part::Vector(v) => _ = self.vector_node(v).map(&mut reached),
                Part::Rotation(r) => _ = self.rotation_node(r).map(&mut reached),
            }
        }
        let [scalars, vectors, rotations] = self.sizes();
        let mut places = reached.places;
        number(&mut places.scalars, scalars, Scalar);
        number(&mut places.vectors, vectors, Vector);
        number(&mut places.rotations, rotations, Rotation);
        Pruned { graph: self.moved(&mut places), places }
    }

    fn moved(&self, places: &mut Places) -> Self {
        let mut left = Self { steps: self.steps, ..Self::new() };
        for (s, &node) in (0..).map(Scalar).zip(&self.scalars.nodes) {
            match node {
                _ if !places.scalars.contains(s) => {}
                ScalarNode::Op(Op::Input(input)) => {
                    let (name, kind) = self.inputs[input as usize].clone();
                    left.declare(name, kind);
                }
                node => _ = left.intern_scalar(node.map(places)),
            }
        }
        for (v, &node) in (0..).map(Vector).zip(&self.vectors.nodes) {
            if places.vectors.contains(v) {
                left.intern_vector(node.map(places));
            }
        }
        for (r, &node) in (0..).map(Rotation).zip(&self.rotations.nodes) {
            if places.rotations.contains(r) {
                left.intern_rotation(node.map(places));
            }
        }
        for (angle, entry) in (0..).map(Angle).zip(&self.angles) {
            let [sin, cos] = [entry.sin, entry.cos].map(|s| places.scalar(s));
            let radians = entry.radians.map(|s| places.scalar(s));
            if let Some(radians) = radians {
                left.angles_of.insert(radians, angle);
            }
            left.angles.push(AngleEntry { name: entry.name.clone(), sin, cos, radians, shifted: entry.shifted });
        }
        let mut components = |all: &Vec<(Variable, Scalar)>| {
            all.iter().map(|&(variable, k)| (exchanged(variable, places), places.scalar(k))).collect()
        };
        left.directions = self.directions.iter().map(&mut components).collect();
        left
    }
}

/// Numbers the remaining ids consecutively.
fn number<K: Id>(places: &mut Table<K, K>, count: usize, id: fn(u32) -> K) {
    let mut next = 0..;
    for old in (0..).take(count).map(id) {
        if places.contains(old) {
            places.insert(old, id(next.next().unwrap_or_default()));
        }
    }
}

/// Old ids mapped to ids in the pruned graph.
#[derive(Clone, Debug, Default)]
struct Places {
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, Vector>,
    rotations: Table<Rotation, Rotation>,
}

impl Parts for Places {
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
struct Reached {
    places: Places,
    open: Vec<Part>,
}

enum Part {
    Scalar(Scalar),
    Vector(Vector),
    Rotation(Rotation),
}

impl Parts for Reached {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if self.places.scalars.insert(scalar, scalar) {
            self.open.push(Part::Scalar(scalar));
        }
        scalar
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        if self.places.vectors.insert(vector, vector) {
            self.open.push(Part::Vector(vector));
        }
        vector
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        if self.places.rotations.insert(rotation, rotation) {
            self.open.push(Part::Rotation(rotation));
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
