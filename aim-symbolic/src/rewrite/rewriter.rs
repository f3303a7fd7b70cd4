//! The driver of the rules: rewrites bottom up, each node once, until no rule applies.

use crate::ir::node::{Node, Parts};
use crate::ir::table::{NodeTable, Table};
use crate::rewrite::log::{Log, Rewrite};
use crate::rewrite::rules::{LIMITS, OTHER_SIDES, ROTATIONS, Rule, RuleSet, Rules, Sums};
use crate::{Angle, Graph, Op, Rotation, RotationNode, Scalar, ScalarNode, Vector};

/// Limit on rewrites per node of a statement. Rewriting normally terminates long before; the limit guarantees it.
const FUEL_PER_NODE: usize = 64;

impl Graph {
    /// Returns `scalar` with every rotation moved to where it cancels or costs least. The value stays the same.
    pub fn rewrite(&mut self, scalar: Scalar) -> Scalar {
        self.rewrite_by(&[scalar], &ROTATIONS)[0]
    }

    /// Returns `scalars` rewritten by `rules`. Common subexpressions stay shared.
    pub fn rewrite_by(&mut self, scalars: &[Scalar], rules: &RuleSet) -> Vec<Scalar> {
        self.rewrite_with(scalars, rules, &Rules::default(), &mut Log::default())
    }

    /// Rewrites by the rules of `set` that `rules` does not switch off, and records every application in `log`.
    pub(crate) fn rewrite_with(
        &mut self,
        scalars: &[Scalar],
        set: &RuleSet,
        rules: &Rules<'_>,
        log: &mut Log,
    ) -> Vec<Scalar> {
        let nodes: Vec<Node> = scalars.iter().map(|&s| Node::Scalar(s)).collect();
        let order = self.order_with_numbers(&nodes);
        let shared = match set.sums {
            Sums::Open => Table::default(),
            Sums::Shared => self.shared_vectors(scalars),
        };
        let mut rewriter = Rewriter {
            g: self,
            rules: set.rules.iter().copied().filter(|rule| rules.has(rule)).collect(),
            max_other_side: rules.max_other_side,
            log,
            fuel: FUEL_PER_NODE * order.len(),
            shared,
            nodes: NodeTable::default(),
            rotations: Table::default(),
        };
        // Operands first, so that the recursion is no deeper than what a rule makes.
        order.into_iter().for_each(|node| _ = rewriter.node(node));
        let rewritten = scalars.iter().map(|&s| rewriter.scalar(s)).collect();
        self.open_all();
        rewritten
    }

    /// Returns a derivative restated by [`LIMITS`] if it depends on the derivative of the root of a number, which is
    /// infinite at 0. A root of a length has the derivative 0 there.
    pub(crate) fn without_slopes_of_roots(&mut self, slope: Scalar, rules: &Rules<'_>, log: &mut Log) -> Scalar {
        let is_infinite = |node: Node| match node {
            Node::Scalar(s) => match self.scalar_node(s) {
                ScalarNode::Reciprocal(root) => {
                    matches!(self.scalar_node(root), ScalarNode::Op(Op::Sqrt(a)) if !self.is_length(a))
                }
                _ => false,
            },
            Node::Vector(_) => false,
        };
        // Builds with `aim_small` derive only rigs, which have no such roots.
        if cfg!(aim_small) || !self.order(&[slope]).into_iter().any(is_infinite) {
            return slope;
        }
        self.rewrite_with(&[slope], &LIMITS, rules, log)[0]
    }
}

struct Rewriter<'g> {
    g: &'g mut Graph,
    rules: Vec<Rule>,
    /// Limit on the applications of [`OTHER_SIDES`]; `None` for no limit.
    max_other_side: Option<usize>,
    log: &'g mut Log,
    fuel: usize,
    /// Vectors that are used in more than one place.
    shared: Table<Vector, ()>,
    nodes: NodeTable<Node>,
    rotations: Table<Rotation, Rotation>,
}

impl Rewriter<'_> {
    fn may_apply(&self, rule: &Rule) -> bool {
        let within = |most| self.log.applied.iter().filter(|done| OTHER_SIDES.contains(&done.rule)).count() < most;
        self.max_other_side.is_none_or(|most| !OTHER_SIDES.contains(rule) || within(most))
    }

    /// Returns the first rule that applies to the node, and the replacement.
    fn replacement(&mut self, node: Node) -> Option<(Rule, Node)> {
        (0..self.rules.len()).find_map(|i| {
            let rule = self.rules[i];
            if self.may_apply(&rule) { Some((rule, rule.apply(self.g, node)?)) } else { None }
        })
    }

    /// Returns the node with its operands rewritten.
    fn with_operands_rewritten(&mut self, node: Node) -> Node {
        match node {
            Node::Scalar(s) => {
                let node = self.g.scalar_node(s).map(self);
                Node::Scalar(self.g.remade_scalar(node))
            }
            Node::Vector(v) => {
                let node = self.g.vector_node(v).map(self);
                Node::Vector(self.g.intern_vector(node))
            }
        }
    }

    /// Returns the node rewritten, its operands first.
    fn node(&mut self, node: Node) -> Node {
        if let Some(done) = self.nodes.copied(node) {
            return done;
        }
        let mut current = self.with_operands_rewritten(node);
        while self.fuel > 0 && self.log.may_apply() {
            let Some((rule, next)) = self.replacement(current) else { break };
            self.fuel -= 1;
            self.log.applied.push(Rewrite { rule, from: current, to: next });
            current = self.with_operands_rewritten(next);
        }
        if let (Node::Vector(before), Node::Vector(after)) = (node, current)
            && self.shared.contains(before)
        {
            self.g.close(after);
        }
        self.nodes.insert(node, current);
        current
    }

    /// Returns `true` if the rotation is constant or consists of inputs, so that nothing in it can be rewritten.
    fn is_given(&self, rotation: Rotation) -> bool {
        let is_input = |&s: &Scalar| matches!(self.g.scalar_node(s), ScalarNode::Op(Op::Input(_)));
        match self.g.rotation_node(rotation) {
            RotationNode::Basis(_) => true,
            RotationNode::Matrix(entries) => entries.iter().all(is_input),
            _ => false,
        }
    }
}

impl Parts for Rewriter<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        match self.node(Node::Scalar(scalar)) {
            Node::Scalar(rewritten) => rewritten,
            Node::Vector(_) => unreachable!("a number stays a number"),
        }
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        match self.node(Node::Vector(vector)) {
            Node::Vector(rewritten) => rewritten,
            Node::Scalar(_) => unreachable!("a vector stays a vector"),
        }
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        if let Some(&done) = self.rotations.get(rotation) {
            return done;
        }
        let done = if self.is_given(rotation) {
            rotation
        } else {
            let node = self.g.rotation_node(rotation).map(self);
            self.g.remade_rotation(node)
        };
        self.rotations.insert(rotation, done);
        done
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
