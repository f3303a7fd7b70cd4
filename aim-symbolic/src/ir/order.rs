//! Traversal of expressions in topological order: each node after its operands.

use crate::ir::node::{Node, Parts};
use crate::ir::table::{NodeSet, Table};
use crate::{Angle, Graph, Op, Rotation, RotationNode, Scalar, ScalarNode, Variable, Vector, VectorNode};

impl Graph {
    /// Returns `outputs` and everything they depend on, each node after its operands.
    pub(crate) fn order(&self, outputs: &[Scalar]) -> Vec<Node> {
        let outputs: Vec<Node> = outputs.iter().map(|&s| Node::Scalar(s)).collect();
        self.order_of_nodes(&outputs)
    }

    /// Returns `nodes` and everything they depend on, each node after its operands. Leaves out the numbers of matrices
    /// and quaternions and the axes of rotations.
    pub(crate) fn order_of_nodes(&self, nodes: &[Node]) -> Vec<Node> {
        self.ordered(nodes, Numbers::Constant)
    }

    /// Returns `nodes` and everything they depend on, including the numbers of rotations, each node after its operands.
    pub(crate) fn order_with_numbers(&self, nodes: &[Node]) -> Vec<Node> {
        self.ordered(nodes, Numbers::Parts)
    }

    fn ordered(&self, nodes: &[Node], numbers: Numbers) -> Vec<Node> {
        let mut seen = NodeSet::default();
        let mut order = Vec::new();
        let mut stack: Vec<(Node, bool)> = nodes.iter().rev().map(|&node| (node, false)).collect();
        let mut parts = Collect { numbers, ..Collect::new(self) };
        while let Some((node, parts_done)) = stack.pop() {
            if parts_done {
                order.push(node);
            } else if seen.insert(node, ()) {
                stack.push((node, true));
                parts.nodes.clear();
                parts.collect(node);
                stack.extend(parts.nodes.iter().rev().map(|&part| (part, false)));
            }
        }
        order
    }

    /// Returns `true` if `outputs` depend on a constant vector with more than one nonzero component.
    pub(crate) fn has_constant_direction(&self, outputs: &[Scalar]) -> bool {
        self.order(outputs).iter().any(|node| match *node {
            Node::Vector(v) => self.constant_vector_of(v).is_some_and(|c| c.iter().filter(|&&c| c != 0.0).count() > 1),
            Node::Scalar(_) => false,
        })
    }

    /// Returns the quaternions that rotate more than one of these vectors, forward or inverted.
    pub(crate) fn busy_quaternions(&self, nodes: &[Node]) -> Vec<Rotation> {
        let (mut once, mut busy): (Vec<Rotation>, Vec<Rotation>) = (Vec::new(), Vec::new());
        for node in nodes {
            let Node::Vector(v) = *node else { continue };
            let VectorNode::Rotate(rotation, _) = self.vector_node(v) else { continue };
            let there = match self.rotation_node(rotation) {
                RotationNode::Transpose(inner) => inner,
                _ => rotation,
            };
            if !matches!(self.rotation_node(there), RotationNode::Quaternion(..) | RotationNode::Moving(_)) {
                continue;
            }
            if !once.contains(&there) {
                once.push(there);
            } else if !busy.contains(&there) {
                busy.push(there);
            }
        }
        busy
    }

    /// Returns `true` if any of these nodes is a select.
    pub(crate) fn selects(&self, nodes: &[Node]) -> bool {
        let is_select = |s| matches!(self.scalar_node(s), ScalarNode::Op(Op::SelectLess(..)));
        nodes.iter().any(|node| matches!(*node, Node::Scalar(s) if is_select(s)))
    }

    /// Returns the operands of `node` that have a value of their own.
    #[must_use]
    pub fn parts(&self, node: Node) -> Vec<Node> {
        let mut parts = Collect::new(self);
        parts.collect(node);
        parts.nodes
    }

    /// Returns the operands of `rotation` that have a value of their own, including its numbers.
    pub(crate) fn numbers(&self, rotation: Rotation) -> Vec<Node> {
        let mut parts = Collect { numbers: Numbers::Parts, ..Collect::new(self) };
        parts.rotation(rotation);
        parts.nodes
    }

    /// Returns the vectors that have more than one user. Uses of single components count together as one.
    pub(crate) fn shared_vectors(&self, outputs: &[Scalar]) -> Table<Vector, ()> {
        let mut needed = Table::default();
        let mut shared = Table::default();
        let mut split = Table::default();
        let mut parts = Collect::new(self);
        for node in self.order(outputs) {
            parts.nodes.clear();
            parts.collect(node);
            let is_component =
                matches!(node, Node::Scalar(s) if matches!(self.scalar_node(s), ScalarNode::Component(..)));
            for &part in &parts.nodes {
                if let Node::Vector(v) = part
                    && (!is_component || split.insert(v, ()))
                    && !needed.insert(v, ())
                {
                    shared.insert(v, ());
                }
            }
        }
        shared
    }

    /// Returns `true` if `node` depends on any of `variables`. Matrices, quaternions and the axes of rotations count as
    /// constants.
    #[must_use]
    pub fn depends_on(&self, node: Node, variables: &[Variable]) -> bool {
        self.active(&self.order_of_nodes(&[node]), variables).contains(node)
    }

    /// Returns the nodes of `order` that depend on any of `variables`.
    pub(crate) fn active(&self, order: &[Node], variables: &[Variable]) -> NodeSet {
        let mut active = NodeSet::default();
        let mut parts = Collect::new(self);
        for &node in order {
            parts.nodes.clear();
            parts.angles.clear();
            parts.collect(node);
            let is_variable = matches!(node, Node::Scalar(s) if match self.slope_of_input(s) {
                Some((angle, _)) => variables.contains(&angle.into()),
                None => variables.contains(&s.into()),
            });
            let turns = parts.angles.iter().any(|&angle| variables.contains(&Variable::Angle(angle)));
            if is_variable || turns || parts.nodes.iter().any(|part| active.contains(*part)) {
                active.insert(node, ());
            }
        }
        active
    }
}

/// Treatment of the numbers of matrices and quaternions and of the axes of rotations: as constants, or as operands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Numbers {
    Constant,
    Parts,
}

/// Collects the operands of a node.
struct Collect<'g> {
    g: &'g Graph,
    numbers: Numbers,
    nodes: Vec<Node>,
    angles: Vec<Angle>,
}

impl<'g> Collect<'g> {
    fn new(g: &'g Graph) -> Self {
        Self { g, numbers: Numbers::Constant, nodes: Vec::new(), angles: Vec::new() }
    }

    fn collect(&mut self, node: Node) {
        match node {
            Node::Scalar(s) => {
                self.g.scalar_node(s).map(self);
            }
            Node::Vector(v) => match self.g.vector_node(v) {
                // The vector comes before the rotation, so that the order matches the written expression.
                VectorNode::Rotate(rotation, inner) => {
                    self.vector(inner);
                    self.rotation(rotation);
                }
                node => {
                    node.map(self);
                }
            },
        }
    }
}

impl Parts for Collect<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        self.nodes.push(Node::Scalar(scalar));
        scalar
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        self.nodes.push(Node::Vector(vector));
        vector
    }

    /// Collects the angles of a rotation, and its numbers if they count as operands.
    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        match (self.g.rotation_node(rotation), self.numbers) {
            (RotationNode::Matrix(_) | RotationNode::Quaternion(..), Numbers::Constant)
            | (RotationNode::Basis(_), _) => {}
            (RotationNode::About(_, angle), Numbers::Constant) => {
                self.angle(angle);
            }
            (node, _) => {
                node.map(self);
            }
        }
        rotation
    }

    fn angle(&mut self, angle: Angle) -> Angle {
        match self.g.radians(angle) {
            Some(radians) => {
                self.scalar(radians);
            }
            None => self.angles.push(self.g.unshifted(angle)),
        }
        angle
    }
}
