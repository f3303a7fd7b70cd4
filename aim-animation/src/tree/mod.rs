//! [`Tree`]: nested blends, built once and evaluated every frame. `node.rs` defines the nodes, `compile.rs` translates
//! them to the operations of `plan.rs`, and `error.rs` has the errors.

mod compile;
mod error;
mod node;
mod plan;

use alloc::vec::Vec;

pub use error::TreeError;
pub use node::{Node, Parameter};

use crate::blend::{BoneSum, Method, added_to, blended, difference};
use crate::mask::clamped;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::Transform;
use node::Weights;
use plan::{Op, Plan, Rule, Shape};

/// A tree of blends for one skeleton. Immutable; shared by all characters that have this skeleton.
///
/// It is built once. Every frame the same list of operations is evaluated with other inputs. Subtrees without weight
/// are skipped, and their sources are not requested. Intermediate results are in a [`Scratch`] of the caller, so
/// evaluation does not allocate.
///
/// ```
/// use aim_animation::glam::{Quat, Vec3};
/// use aim_animation::{BlendLine, Bone, Mask, Node, Parameter, Skeleton, Transform, Tree};
///
/// let skeleton = Skeleton::new([Bone::new("hips", None), Bone::new("arm", Some(0))])?;
/// let (walk, run, wave) = (Node::source(0), Node::source(1), Node::source(2));
/// // Walk to run by speed, and a wave of the arm on top.
/// let legs = Node::line(BlendLine::new([1.0, 4.0])?, Parameter::Input(0), [walk, run]);
/// let root = legs.blend(wave, Parameter::Input(1)).with_mask(Mask::subtree(&skeleton, 1));
/// let tree = Tree::new(&skeleton, root)?;
///
/// let mut scratch = tree.scratch();
/// let mut pose = [Transform::IDENTITY; 2];
/// let mut asked = Vec::new();
/// tree.evaluate(&[2.5, 0.0], &mut scratch, &mut pose, |source, pose| {
///     asked.push(source);
///     pose[0].translation = Vec3::Y * [0.9, 0.7, 0.0][source];
/// })?;
/// assert_eq!(asked, [0, 1], "nobody waves");
/// assert!((pose[0].translation.y - 0.8).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    rest: Vec<Transform>,
    method: Method,
    plan: Plan,
}

/// Buffers for the evaluation of a [`Tree`], made by [`Tree::scratch`]. They carry no state between calls; one set
/// serves all characters that a thread evaluates.
#[derive(Clone, Debug, PartialEq)]
pub struct Scratch {
    poses: Vec<Transform>,
    sums: Vec<BoneSum>,
    weights: Vec<f32>,
    shares: Vec<f32>,
}

impl Tree {
    /// Builds a tree.
    ///
    /// # Errors
    /// See [`TreeError`]; returns the first error found.
    pub fn new(skeleton: &Skeleton, root: Node) -> Result<Self, TreeError> {
        let plan = compile::compiled(skeleton.len(), root)?;
        Ok(Self { rest: skeleton.rest().to_vec(), method: Method::default(), plan })
    }

    /// Sets the method by which all blends interpolate rotations.
    #[must_use]
    pub fn with_method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// Creates buffers of the size that this tree needs.
    #[must_use]
    pub fn scratch(&self) -> Scratch {
        let bones = self.rest.len();
        Scratch {
            poses: alloc::vec![Transform::IDENTITY; self.plan.slots * bones],
            sums: alloc::vec![BoneSum::ZERO; self.plan.sums * bones],
            weights: alloc::vec![0.0; self.plan.children.len()],
            shares: alloc::vec![0.0; self.plan.shapes.len()],
        }
    }

    /// Writes the blended pose. Calls `sample` for each source that has a weight, with its number and a pose to write
    /// to, which is initialised to the rest pose.
    ///
    /// # Errors
    /// `pose` has another length than the skeleton, or `scratch` belongs to another tree; then nothing is written.
    pub fn evaluate(
        &self,
        inputs: &[f32],
        scratch: &mut Scratch,
        pose: &mut [Transform],
        mut sample: impl FnMut(usize, &mut [Transform]),
    ) -> Result<(), PoseError> {
        let bones = self.rest.len();
        check_length(bones, pose.len())?;
        self.weigh(inputs, scratch)?;
        let Scratch { poses, sums, weights, .. } = scratch;
        let slot_of = |slot: usize| slot * bones..(slot + 1) * bones;
        let mut next = 0;
        while let Some(op) = self.plan.ops.get(next) {
            next += 1;
            match *op {
                Op::Skip { edge, to } => {
                    if !(weights[edge] > 0.0) {
                        next = to;
                    }
                }
                Op::Source { number, slot } => {
                    let pose = &mut poses[slot_of(slot)];
                    pose.copy_from_slice(&self.rest);
                    sample(number, pose);
                }
                Op::Begin { sum } => sums[slot_of(sum)].fill(BoneSum::ZERO),
                Op::Gather { edge, slot, sum } => {
                    let terms = poses[slot_of(slot)].iter().zip(&self.rest);
                    for (sum, (transform, rest)) in sums[slot_of(sum)].iter_mut().zip(terms) {
                        sum.add(transform, rest, weights[edge], self.method);
                    }
                }
                Op::Finish { sum, slot } => {
                    let terms = sums[slot_of(sum)].iter().zip(&self.rest);
                    for (transform, (sum, rest)) in poses[slot_of(slot)].iter_mut().zip(terms) {
                        *transform = sum.finish(rest, self.method);
                    }
                }
                Op::Blend { edge, slot, mask } => {
                    let (one, other) = poses[slot * bones..(slot + 2) * bones].split_at_mut(bones);
                    if weights[edge] > 0.0 {
                        for (bone, (one, other)) in one.iter_mut().zip(&*other).enumerate() {
                            let weight = weights[edge + 1] * self.mask_weight(mask, bone);
                            *one = blended([one, other, &self.rest[bone]], weight, self.method);
                        }
                    } else {
                        one.copy_from_slice(other);
                    }
                }
                Op::Add { edge, slot, mask, reference } => {
                    let reference = reference.map_or(&self.rest, |reference| &self.plan.references[reference]);
                    let (one, other) = poses[slot * bones..(slot + 2) * bones].split_at_mut(bones);
                    for (bone, (one, other)) in one.iter_mut().zip(&*other).enumerate() {
                        let weight = weights[edge + 1] * self.mask_weight(mask, bone);
                        *one = added_to(one, &difference(&reference[bone], other), weight, self.method);
                    }
                }
            }
        }
        pose.copy_from_slice(&poses[..bones]);
        Ok(())
    }

    /// Computes the share of each source in a bone's translation, indexed by source number. For the root bone, these
    /// are the weights of the sources' root motions. Sources whose number is past the end of `shares` are left out. The
    /// shares of blended poses sum to 1; added layers have none. No pose is evaluated.
    ///
    /// # Errors
    /// `scratch` belongs to another tree; then nothing is written.
    pub fn shares(
        &self,
        bone: usize,
        inputs: &[f32],
        scratch: &mut Scratch,
        shares: &mut [f32],
    ) -> Result<(), PoseError> {
        self.weigh(inputs, scratch)?;
        shares.fill(0.0);
        scratch.shares.fill(0.0);
        scratch.shares[0] = 1.0;
        for (node, Shape { rule, edges }) in self.plan.shapes.iter().enumerate() {
            let share = scratch.shares[node];
            let weights = &scratch.weights[edges.clone()];
            let total: f32 = weights.iter().sum();
            let mut give =
                |edge: usize, part: f32| scratch.shares[self.plan.children[edges.start + edge]] = share * part;
            match rule {
                Rule::Source(number) => {
                    if let Some(of_source) = shares.get_mut(*number) {
                        *of_source += share;
                    }
                }
                Rule::Sum(_) if !(total > 0.0) => {}
                Rule::Sum(_) => weights.iter().enumerate().for_each(|(edge, weight)| give(edge, weight / total)),
                Rule::Blend { mask, .. } => {
                    let weight = weights[1] * mask.map_or(1.0, |mask| self.mask_at(mask, bone));
                    give(0, 1.0 - weight);
                    give(1, weight);
                }
                Rule::Add { .. } => give(0, 1.0),
            }
        }
        Ok(())
    }

    /// Computes the weight of every edge.
    fn weigh(&self, inputs: &[f32], scratch: &mut Scratch) -> Result<(), PoseError> {
        let fits = |needed: usize, found: usize| check_length(needed, found);
        fits(self.plan.slots * self.rest.len(), scratch.poses.len())?;
        fits(self.plan.sums * self.rest.len(), scratch.sums.len())?;
        fits(self.plan.children.len(), scratch.weights.len())?;
        fits(self.plan.shapes.len(), scratch.shares.len())?;
        for Shape { rule, edges } in &self.plan.shapes {
            let weights = &mut scratch.weights[edges.clone()];
            match rule {
                Rule::Source(_) => {}
                Rule::Sum(Weights::Each(parameters)) => {
                    for (weight, parameter) in weights.iter_mut().zip(parameters) {
                        *weight = clamped(parameter.value(inputs));
                    }
                }
                Rule::Sum(Weights::Line(line, at)) => line.weights(at.value(inputs), weights),
                Rule::Sum(Weights::Plane(plane, at)) => {
                    plane.weights(at.map(|coordinate| coordinate.value(inputs)).into(), weights);
                }
                Rule::Blend { weight, mask } => {
                    let weight = clamped(weight.value(inputs));
                    // With a mask, the first pose is always needed, whatever the weight.
                    weights[0] = if mask.is_some() { 1.0 } else { 1.0 - weight };
                    weights[1] = weight;
                }
                Rule::Add { weight } => (weights[0], weights[1]) = (1.0, clamped(weight.value(inputs))),
            }
        }
        Ok(())
    }

    fn mask_weight(&self, mask: Option<usize>, bone: usize) -> f32 {
        mask.map_or(1.0, |mask| self.mask_at(mask, bone))
    }

    fn mask_at(&self, mask: usize, bone: usize) -> f32 {
        self.plan.masks[mask].weights().get(bone).copied().unwrap_or(0.0)
    }
}
