//! Masks of adjoints: the conditions under which a value depends on a node.
//!
//! The adjoint ȳ of `if c { x } else { z }` is passed on as `c ? ȳ : 0` to x and `c ? 0 : ȳ` to z, so that each node
//! below a select is visited once. In the branch not taken, this 0 is multiplied by partial derivatives, and the
//! product is 0 as long as they are finite. Where they may not be finite ([`Growth`](crate::diff::growth::Growth)),
//! adjoints inside the branch may differ from 0, and are masked again on the edges that leave the branch, to nodes that
//! are also used elsewhere. For this each node has a [`Mask`], the condition under which it is needed.

use rustc_hash::FxHashMap;

use crate::ir::node::Node;
use crate::ir::table::{NodeSet, NodeTable};
use crate::{Graph, Op, Scalar, ScalarNode};

/// A condition on comparisons, interned: equal conditions have equal ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Mask(usize);

impl Mask {
    /// The condition that always holds.
    pub(crate) const ALWAYS: Self = Self(0);
}

/// The definition of a mask.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Condition {
    Always,
    /// The comparison a < b has the result `holds`, and the mask `within` holds.
    Less {
        a: Scalar,
        b: Scalar,
        holds: bool,
        within: Mask,
    },
    Either(Mask, Mask),
}

/// The masks of the nodes of one sweep. Nodes without an entry have [`Mask::ALWAYS`].
pub(crate) struct Masks {
    conditions: Vec<Condition>,
    index: FxHashMap<Condition, Mask>,
    /// Scalars that are 1 where a condition holds, else 0, as far as they have been needed.
    flags: Vec<Scalar>,
    needed: NodeTable<Mask>,
}

/// Limit on the number of alternatives of a node's mask that are searched for a pair to merge.
const MOST_JOINED: usize = 16;

/// Limit on the number of nested comparisons that are brought into a canonical order.
const MOST_ORDERED: usize = 4;

impl Default for Masks {
    fn default() -> Self {
        let mut masks = Self {
            conditions: Vec::new(),
            index: FxHashMap::default(),
            flags: Vec::new(),
            needed: NodeTable::default(),
        };
        masks.intern(Condition::Always);
        masks
    }
}

impl Masks {
    /// Computes the masks of the active nodes of `order`: the nodes on which `output` depends, each after its operands.
    pub(crate) fn of(g: &Graph, output: Scalar, order: &[Node], active: &NodeSet) -> Self {
        let mut masks = Self::default();
        masks.need(Node::Scalar(output), Mask::ALWAYS);
        for &node in order.iter().rev().filter(|&&node| active.contains(node)) {
            // A node that is only compared has no adjoint, and does not make its operands needed.
            let Some(mask) = masks.needed.copied(node) else { continue };
            match node {
                Node::Scalar(s) => match g.scalar_node(s) {
                    ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) => {
                        for (branch, holds) in [(then, true), (otherwise, false)] {
                            let mask = masks.branch(a, b, holds, mask);
                            masks.need(Node::Scalar(branch), mask);
                        }
                    }
                    _ => g.parts(node).into_iter().for_each(|part| masks.need(part, mask)),
                },
                Node::Vector(_) => g.parts(node).into_iter().for_each(|part| masks.need(part, mask)),
            }
        }
        masks
    }

    fn intern(&mut self, condition: Condition) -> Mask {
        let conditions = &mut self.conditions;
        *self.index.entry(condition).or_insert_with(|| {
            conditions.push(condition);
            Mask(conditions.len() - 1)
        })
    }

    /// Returns the mask of a branch of a select that is needed under the condition `within`.
    pub(crate) fn branch(&mut self, a: Scalar, b: Scalar, holds: bool, within: Mask) -> Mask {
        let mut all = vec![(a, b, holds)];
        let mut rest = within;
        while let Condition::Less { a, b, holds, within } = self.conditions[rest.0]
            && all.len() < MOST_ORDERED
        {
            all.push((a, b, holds));
            rest = within;
        }
        if rest != Mask::ALWAYS {
            return self.intern(Condition::Less { a, b, holds, within });
        }
        // Nodes deeper in the expression were created earlier and sort last, so that conditions of different depth
        // share the longest prefix.
        all.sort_unstable_by(|one, other| other.cmp(one));
        all.dedup();
        all.into_iter().fold(Mask::ALWAYS, |within, (a, b, holds)| self.intern(Condition::Less { a, b, holds, within }))
    }

    /// Returns the condition under which the node is needed.
    pub(crate) fn of_node(&self, node: Node) -> Mask {
        self.needed.copied(node).unwrap_or(Mask::ALWAYS)
    }

    fn need(&mut self, node: Node, mask: Mask) {
        let mask = match self.needed.copied(node) {
            Some(known) => self.either(known, mask),
            None => mask,
        };
        self.needed.insert(node, mask);
    }

    /// Returns a mask that holds where either mask does. `known` may be a list of alternatives; those that merge with
    /// `other` into a simpler mask are replaced by it.
    fn either(&mut self, known: Mask, other: Mask) -> Mask {
        let (mut rest, mut latest, mut other) = (known, Vec::new(), other);
        loop {
            let found = latest.iter().position(|&mask| self.joined(mask, other).is_some());
            if let Some(place) = found {
                other = self.joined(latest.remove(place), other).unwrap_or(other);
            } else if let Some(joined) = self.joined(rest, other) {
                // `rest` was the head of the list: the first of the later alternatives takes its place.
                let Some(first) = latest.pop() else { return joined };
                (rest, other) = (first, joined);
            } else if let Condition::Either(before, last) = self.conditions[rest.0]
                && latest.len() < MOST_JOINED
            {
                latest.push(last);
                rest = before;
            } else {
                break;
            }
        }
        let all = latest.into_iter().rev().chain([other]);
        all.fold(rest, |list, mask| self.intern(Condition::Either(list, mask)))
    }

    /// Returns the union of two masks if it is one of the two or the mask that both are within.
    fn joined(&self, one: Mask, other: Mask) -> Option<Mask> {
        match (self.conditions[one.0], self.conditions[other.0]) {
            _ if one == other => Some(one),
            (Condition::Always, _) | (_, Condition::Always) => Some(Mask::ALWAYS),
            (Condition::Less { within, .. }, _) if within == other => Some(other),
            (_, Condition::Less { within, .. }) if within == one => Some(one),
            (
                Condition::Less { a, b, holds, within },
                Condition::Less { a: a2, b: b2, holds: holds2, within: within2 },
            ) if (a, b, within) == (a2, b2, within2) && holds != holds2 => Some(within),
            _ => None,
        }
    }

    /// Returns `value` where the mask holds, else 0, even if `value` is not finite there.
    pub(crate) fn masked(&mut self, g: &mut Graph, mask: Mask, value: Scalar) -> Scalar {
        match self.conditions[mask.0] {
            Condition::Always => value,
            Condition::Less { a, b, holds, within } if self.is_simple(within) => {
                let value = self.masked(g, within, value);
                g.where_less(a, b, holds, value)
            }
            _ => {
                let (zero, flag) = (g.constant(0.0), self.flag(g, mask));
                g.where_less(zero, flag, true, value)
            }
        }
    }

    /// Returns `true` if the mask is at most one comparison.
    fn is_simple(&self, mask: Mask) -> bool {
        match self.conditions[mask.0] {
            Condition::Always => true,
            Condition::Less { within, .. } => within == Mask::ALWAYS,
            Condition::Either(..) => false,
        }
    }

    /// Returns a scalar that is 1 where the mask holds, else 0.
    fn flag(&mut self, g: &mut Graph, mask: Mask) -> Scalar {
        // A condition was interned after its parts.
        while self.flags.len() <= mask.0 {
            let flag = match self.conditions[self.flags.len()] {
                Condition::Always => g.constant(1.0),
                Condition::Less { a, b, holds, within } => g.where_less(a, b, holds, self.flags[within.0]),
                Condition::Either(one, other) => {
                    let (zero, one, other) = (g.constant(0.0), self.flags[one.0], self.flags[other.0]);
                    g.select_less(zero, one, one, other)
                }
            };
            self.flags.push(flag);
        }
        self.flags[mask.0]
    }
}

impl Graph {
    /// Returns `value` where the comparison a < b has the result `holds`, else 0.
    pub(crate) fn where_less(&mut self, a: Scalar, b: Scalar, holds: bool, value: Scalar) -> Scalar {
        let zero = self.constant(0.0);
        if holds { self.select_less(a, b, value, zero) } else { self.select_less(a, b, zero, value) }
    }
}
