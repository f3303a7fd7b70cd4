//! What an expression is made of: each part after its own parts.

use crate::ir::node::{Node, Parts};
use crate::ir::table::{NodeSet, Table};
use crate::{Angle, Graph, Op, Rotation, RotationNode, Scalar, ScalarNode, Variable, Vector, VectorNode};

impl Graph {
    /// The number of scalars and vectors that `outputs` are made of.
    pub(crate) fn size(&self, outputs: &[Scalar]) -> usize {
        self.order(outputs).len()
    }

    /// Everything that `outputs` are made of, each after its parts.
    pub(crate) fn order(&self, outputs: &[Scalar]) -> Vec<Node> {
        let outputs: Vec<Node> = outputs.iter().map(|&s| Node::Scalar(s)).collect();
        self.order_of_nodes(&outputs)
    }

    /// Everything that `nodes` are made of, each after its parts.
    pub(crate) fn order_of_nodes(&self, nodes: &[Node]) -> Vec<Node> {
        self.ordered(nodes, Numbers::Constant)
    }

    /// The same with the numbers that rotations are made of.
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

    /// Whether a constant vector of more than one component is among what `outputs` are made of.
    pub(crate) fn has_constant_direction(&self, outputs: &[Scalar]) -> bool {
        self.order(outputs).iter().any(|node| match *node {
            Node::Vector(v) => self.constant_vector_of(v).is_some_and(|c| c.iter().filter(|&&c| c != 0.0).count() > 1),
            Node::Scalar(_) => false,
        })
    }

    /// The quaternions that turn several of these vectors, there or back.
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

    /// Whether there is a select among these nodes.
    pub(crate) fn selects(&self, nodes: &[Node]) -> bool {
        let is_select = |s| matches!(self.scalar_node(s), ScalarNode::Op(Op::SelectLess(..)));
        nodes.iter().any(|node| matches!(*node, Node::Scalar(s) if is_select(s)))
    }

    /// What `node` is made of, as far as it has a value of its own.
    #[must_use]
    pub fn parts(&self, node: Node) -> Vec<Node> {
        let mut parts = Collect::new(self);
        parts.collect(node);
        parts.nodes
    }

    /// The vectors that more than one other needs; its components together are one need.
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

    /// Whether `node` depends on any of `variables`. Matrices, quaternions and the axes of rotations count as constants.
    #[must_use]
    pub fn depends_on(&self, node: Node, variables: &[Variable]) -> bool {
        self.active(&self.order_of_nodes(&[node]), variables).contains(node)
    }

    /// Of `order`, what depends on any of `variables`.
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

/// What the numbers of matrices and quaternions and the axes of rotations count as.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Numbers {
    Constant,
    Parts,
}

/// Gathers the parts of a node.
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
                // The vector first, so that an order reads as the expression is written.
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

    /// Of a rotation its angles, unless its numbers are parts, too.
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
