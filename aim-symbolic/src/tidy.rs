//! The driver of the rules: bottom up, each node once, until no rule applies.

use std::collections::HashMap;

use crate::rules::{ROTATIONS, RuleSet};
use crate::{Graph, Scalar, ScalarNode, Vector, VectorNode};

/// Rewrites for each node of a statement. The rules end by themselves long before; this is what makes the end certain.
const FUEL_PER_NODE: usize = 64;

impl Graph {
    /// `scalar` with every rotation moved to where it cancels or costs least. The value stays the same.
    pub fn rewrite(&mut self, scalar: Scalar) -> Scalar {
        self.rewrite_by(&[scalar], &ROTATIONS)[0]
    }

    /// `scalars` rewritten by `rules`, sharing what they share.
    pub fn rewrite_by(&mut self, scalars: &[Scalar], rules: &RuleSet) -> Vec<Scalar> {
        let fuel = FUEL_PER_NODE * scalars.iter().map(|&s| self.size(s)).sum::<usize>();
        let mut tidy = Tidy { g: self, rules, fuel, scalars: HashMap::new(), vectors: HashMap::new() };
        scalars.iter().map(|&s| tidy.scalar(s)).collect()
    }
}

struct Tidy<'g> {
    g: &'g mut Graph,
    rules: &'g RuleSet,
    fuel: usize,
    scalars: HashMap<Scalar, Scalar>,
    vectors: HashMap<Vector, Vector>,
}

impl Tidy<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Scalar {
        if let Some(&done) = self.scalars.get(&scalar) {
            return done;
        }
        let mut current = self.scalar_parts(scalar);
        while self.fuel > 0 {
            let Some(next) = self.rules.scalars.iter().find_map(|(_, rule)| rule(self.g, current)) else { break };
            self.fuel -= 1;
            current = self.scalar_parts(next);
        }
        self.scalars.insert(scalar, current);
        current
    }

    fn vector(&mut self, vector: Vector) -> Vector {
        if let Some(&done) = self.vectors.get(&vector) {
            return done;
        }
        let mut current = self.vector_parts(vector);
        while self.fuel > 0 {
            let Some(next) = self.rules.vectors.iter().find_map(|(_, rule)| rule(self.g, current)) else { break };
            self.fuel -= 1;
            current = self.vector_parts(next);
        }
        self.vectors.insert(vector, current);
        current
    }

    fn scalar_parts(&mut self, scalar: Scalar) -> Scalar {
        match self.g.scalar_node(scalar) {
            ScalarNode::Constant(_) | ScalarNode::Input(_) | ScalarNode::Tiny => scalar,
            ScalarNode::Add(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.add(a, b)
            }
            ScalarNode::Sub(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.sub(a, b)
            }
            ScalarNode::Mul(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.mul(a, b)
            }
            ScalarNode::Div(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.g.div(a, b)
            }
            ScalarNode::Neg(a) => {
                let a = self.scalar(a);
                self.g.neg(a)
            }
            ScalarNode::Sqrt(a) => {
                let a = self.scalar(a);
                self.g.sqrt(a)
            }
            ScalarNode::Reciprocal(a) => {
                let a = self.scalar(a);
                self.g.reciprocal(a)
            }
            ScalarNode::SelectLess(a, b, then, otherwise) => {
                let node =
                    ScalarNode::SelectLess(self.scalar(a), self.scalar(b), self.scalar(then), self.scalar(otherwise));
                self.g.intern_scalar(node)
            }
            ScalarNode::Dot(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                self.g.dot(v, w)
            }
            ScalarNode::Norm(v) => {
                let v = self.vector(v);
                self.g.norm(v)
            }
            ScalarNode::Component(v, axis) => {
                let v = self.vector(v);
                self.g.component(v, axis)
            }
        }
    }

    fn vector_parts(&mut self, vector: Vector) -> Vector {
        match self.g.vector_node(vector) {
            VectorNode::Components(c) => {
                let c = c.map(|c| self.scalar(c));
                self.g.components(c)
            }
            VectorNode::Add(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                self.g.add_vectors(v, w)
            }
            VectorNode::Sub(v, w) => {
                let (v, w) = (self.vector(v), self.vector(w));
                self.g.sub_vectors(v, w)
            }
            VectorNode::Neg(v) => {
                let v = self.vector(v);
                self.g.neg_vector(v)
            }
            VectorNode::Scale(k, v) => {
                let (k, v) = (self.scalar(k), self.vector(v));
                self.g.scale(k, v)
            }
            VectorNode::Rotate(rotation, v) => {
                let v = self.vector(v);
                self.g.rotate(rotation, v)
            }
            VectorNode::Normalize(v) => {
                let v = self.vector(v);
                self.g.normalize(v).into()
            }
            VectorNode::Perp(plane, v) => {
                let v = self.vector(v);
                self.g.perp(plane, v)
            }
        }
    }
}
