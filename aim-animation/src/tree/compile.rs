//! Compiles nodes to operations. A node's slot is its depth on the stack of poses, which minimises the number held at
//! once.

use alloc::vec::Vec;

use super::error::TreeError;
use super::node::{Kind, Node, Weights};
use super::plan::{Op, Plan, Rule, Shape};
use crate::mask::Mask;
use crate::transform::Transform;

/// Compiles a tree for a skeleton of this many bones.
pub(super) fn compiled(bones: usize, root: Node) -> Result<Plan, TreeError> {
    let mut compiler = Compiler { plan: Plan::default(), bones };
    compiler.node(root, 0, 0)?;
    Ok(compiler.plan)
}

struct Compiler {
    plan: Plan,
    bones: usize,
}

impl Compiler {
    /// Appends the operations that write a node's pose to `slot`, using only sums from `sum` on. Returns the node's
    /// index.
    fn node(&mut self, Node { kind, .. }: Node, slot: usize, sum: usize) -> Result<usize, TreeError> {
        let shape = self.plan.shapes.len();
        self.plan.slots = self.plan.slots.max(slot + 1);
        match kind {
            Kind::Source(number) => {
                self.shape(Rule::Source(number), 0);
                self.plan.ops.push(Op::Source { number, slot });
            }
            Kind::Sum { nodes, weights } => {
                check_places(&weights, nodes.len())?;
                let first = self.shape(Rule::Sum(weights), nodes.len());
                self.plan.sums = self.plan.sums.max(sum + 1);
                self.plan.ops.push(Op::Begin { sum });
                for (edge, node) in (first..).zip(nodes) {
                    let skip = self.skip(edge);
                    self.plan.children[edge] = self.node(node, slot, sum + 1)?;
                    self.plan.ops.push(Op::Gather { edge, slot, sum });
                    self.end_skip(skip);
                }
                self.plan.ops.push(Op::Finish { sum, slot });
            }
            Kind::Blend { nodes, weight, mask } => {
                let mask = self.mask(mask)?;
                self.pair(*nodes, Rule::Blend { weight, mask }, [slot, sum], |edge| Op::Blend { edge, slot, mask })?;
            }
            Kind::Add { nodes, weight, mask, reference } => {
                let mask = self.mask(mask)?;
                let reference = self.reference(reference)?;
                let op = |edge| Op::Add { edge, slot, mask, reference };
                self.pair(*nodes, Rule::Add { weight }, [slot, sum], op)?;
            }
            Kind::Mistaken => return Err(TreeError::Mistaken),
            Kind::Deep => return Err(TreeError::Deep),
        }
        Ok(shape)
    }

    /// Appends a node of two poses: the first in `slot`, the second in the next one, combined by `op`.
    fn pair(
        &mut self,
        [one, other]: [Node; 2],
        rule: Rule,
        [slot, sum]: [usize; 2],
        op: impl Fn(usize) -> Op,
    ) -> Result<(), TreeError> {
        let edge = self.shape(rule, 2);
        let skip = self.skip(edge);
        self.plan.children[edge] = self.node(one, slot, sum)?;
        self.end_skip(skip);
        let skip = self.skip(edge + 1);
        self.plan.children[edge + 1] = self.node(other, slot + 1, sum)?;
        self.plan.ops.push(op(edge));
        self.end_skip(skip);
        Ok(())
    }

    /// Appends a node with unconnected edges. Returns the index of the first edge.
    fn shape(&mut self, rule: Rule, edges: usize) -> usize {
        let first = self.plan.children.len();
        self.plan.children.resize(first + edges, 0);
        self.plan.shapes.push(Shape { rule, edges: first..first + edges });
        first
    }

    /// Starts the operations that are skipped if an edge has no weight.
    fn skip(&mut self, edge: usize) -> usize {
        self.plan.ops.push(Op::Skip { edge, to: 0 });
        self.plan.ops.len() - 1
    }

    fn end_skip(&mut self, skip: usize) {
        let end = self.plan.ops.len();
        if let Some(Op::Skip { to, .. }) = self.plan.ops.get_mut(skip) {
            *to = end;
        }
    }

    fn mask(&mut self, mask: Option<Mask>) -> Result<Option<usize>, TreeError> {
        let Some(mask) = mask else { return Ok(None) };
        self.check_length(mask.weights().len())?;
        self.plan.masks.push(mask);
        Ok(Some(self.plan.masks.len() - 1))
    }

    fn reference(&mut self, pose: Option<Vec<Transform>>) -> Result<Option<usize>, TreeError> {
        let Some(pose) = pose else { return Ok(None) };
        self.check_length(pose.len())?;
        if let Some(bone) = pose.iter().position(|transform| !transform.is_sound()) {
            return Err(TreeError::Reference(bone));
        }
        self.plan.references.push(pose);
        Ok(Some(self.plan.references.len() - 1))
    }

    fn check_length(&self, found: usize) -> Result<(), TreeError> {
        let bones = self.bones;
        if found == bones { Ok(()) } else { Err(TreeError::Length { bones, found }) }
    }
}

fn check_places(weights: &Weights, nodes: usize) -> Result<(), TreeError> {
    let places = match weights {
        Weights::Each(parameters) => parameters.len(),
        Weights::Line(line, _) => line.places().len(),
        Weights::Plane(plane, _) => plane.points().len(),
    };
    if places == nodes { Ok(()) } else { Err(TreeError::Places { places, nodes }) }
}
