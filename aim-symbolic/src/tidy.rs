//! The driver of the rules: bottom up, each node once, until no rule applies.

use crate::derivation::{Rewrite, Swept};
use crate::node::Parts;
use crate::order::Node;
use crate::rules::{OTHER_SIDES, ROTATIONS, RuleSet, Rules, ScalarRule, Sums, VectorRule};
use crate::table::Table;
use crate::{Angle, Graph, Rotation, RotationNode, Scalar, ScalarNode, Vector};

/// Rewrites for each node of a statement. The rules end by themselves long before; this is what makes the end certain.
const FUEL_PER_NODE: usize = 64;

impl Graph {
    /// `scalar` with every rotation moved to where it cancels or costs least. The value stays the same.
    pub fn rewrite(&mut self, scalar: Scalar) -> Scalar {
        self.rewrite_by(&[scalar], &ROTATIONS)[0]
    }

    /// `scalars` rewritten by `rules`, sharing what they share.
    pub fn rewrite_by(&mut self, scalars: &[Scalar], rules: &RuleSet) -> Vec<Scalar> {
        self.rewrite_with(scalars, rules, &Rules::default(), &mut Log::default())
    }

    /// The same, with some of the rules switched off, and written down.
    pub(crate) fn rewrite_with(
        &mut self,
        scalars: &[Scalar],
        set: &RuleSet,
        rules: &Rules<'_>,
        log: &mut Log,
    ) -> Vec<Scalar> {
        let fuel = FUEL_PER_NODE * self.size(scalars);
        let shared = match set.sums {
            Sums::Open => Table::default(),
            Sums::Shared => self.shared_vectors(scalars),
        };
        let mut tidy = Tidy {
            g: self,
            vector_rules: set.vectors.iter().copied().filter(|(name, _)| rules.has(name)).collect(),
            scalar_rules: set.scalars.iter().copied().filter(|(name, _)| rules.has(name)).collect(),
            turned: rules.turned,
            log,
            fuel,
            shared,
            scalars: Table::default(),
            vectors: Table::default(),
            rotations: Table::default(),
        };
        let rewritten = scalars.iter().map(|&s| tidy.scalar(s)).collect();
        self.open_all();
        rewritten
    }
}

/// What was done, in order, and how many more rules may be applied.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log {
    pub(crate) applied: Vec<Rewrite>,
    /// How many may be applied in all; `None` for as many as there are.
    pub(crate) limit: Option<usize>,
    /// How derivatives were taken.
    pub(crate) sweeps: Vec<Swept>,
    /// What they were taken of, and what was wanted as it was just after that.
    pub(crate) values: Vec<Scalar>,
    pub(crate) derived: Vec<Scalar>,
    /// How many rules had been applied before.
    pub(crate) before_sweeps: usize,
}

impl Log {
    pub(crate) fn limited(limit: usize) -> Self {
        Self { limit: Some(limit), ..Self::default() }
    }

    pub(crate) fn may_apply(&self) -> bool {
        self.limit.is_none_or(|limit| self.applied.len() < limit)
    }
}

struct Tidy<'g> {
    g: &'g mut Graph,
    vector_rules: Vec<(&'static str, VectorRule)>,
    scalar_rules: Vec<(&'static str, ScalarRule)>,
    /// How many rotations may go to the other side.
    turned: Option<usize>,
    log: &'g mut Log,
    fuel: usize,
    /// What is needed in more than one place.
    shared: Table<Vector, ()>,
    scalars: Table<Scalar, Scalar>,
    vectors: Table<Vector, Vector>,
    rotations: Table<Rotation, Rotation>,
}

impl Tidy<'_> {
    fn may_apply(&self, rule: &str) -> bool {
        let within = |most| self.log.applied.iter().filter(|done| OTHER_SIDES.contains(&done.rule)).count() < most;
        self.turned.is_none_or(|most| !OTHER_SIDES.contains(&rule) || within(most))
    }

    fn apply_scalar_rule(&mut self, scalar: Scalar) -> Option<(&'static str, Scalar)> {
        (0..self.scalar_rules.len()).find_map(|i| {
            let (name, rule) = self.scalar_rules[i];
            if self.may_apply(name) { Some((name, rule(self.g, scalar)?)) } else { None }
        })
    }

    fn apply_vector_rule(&mut self, vector: Vector) -> Option<(&'static str, Vector)> {
        (0..self.vector_rules.len()).find_map(|i| {
            let (name, rule) = self.vector_rules[i];
            if self.may_apply(name) { Some((name, rule(self.g, vector)?)) } else { None }
        })
    }

    fn scalar_parts(&mut self, scalar: Scalar) -> Scalar {
        let node = self.g.scalar_node(scalar).map(self);
        self.g.remade_scalar(node)
    }

    fn vector_parts(&mut self, vector: Vector) -> Vector {
        let node = self.g.vector_node(vector).map(self);
        self.g.intern_vector(node)
    }
}

impl Parts for Tidy<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if let Some(&done) = self.scalars.get(scalar) {
            return done;
        }
        let mut current = self.scalar_parts(scalar);
        while self.fuel > 0 && self.log.may_apply() {
            let Some((name, next)) = self.apply_scalar_rule(current) else { break };
            self.fuel -= 1;
            self.log.applied.push(Rewrite { rule: name, from: Node::Scalar(current), to: Node::Scalar(next) });
            current = self.scalar_parts(next);
        }
        self.scalars.insert(scalar, current);
        current
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        if let Some(&done) = self.vectors.get(vector) {
            return done;
        }
        let mut current = self.vector_parts(vector);
        while self.fuel > 0 && self.log.may_apply() {
            let Some((name, next)) = self.apply_vector_rule(current) else { break };
            self.fuel -= 1;
            self.log.applied.push(Rewrite { rule: name, from: Node::Vector(current), to: Node::Vector(next) });
            current = self.vector_parts(next);
        }
        if self.shared.contains(vector) {
            self.g.close(current);
        }
        self.vectors.insert(vector, current);
        current
    }

    fn rotation(&mut self, rotation: Rotation) -> Rotation {
        if let Some(&done) = self.rotations.get(rotation) {
            return done;
        }
        let node = self.g.rotation_node(rotation);
        let is_given = |&s: &Scalar| matches!(self.g.scalar_node(s), ScalarNode::Input(_));
        let done = match node {
            RotationNode::Basis(_) => rotation,
            RotationNode::Matrix(entries) if entries.iter().all(is_given) => rotation,
            node => {
                let node = node.map(self);
                self.g.remade_rotation(node)
            }
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
