//! [`Node`] and [`Parameter`]: what a tree of blends is built of.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::mask::Mask;
use crate::space::{BlendLine, BlendPlane};
use crate::transform::Transform;

/// A number that a tree is told: always the same, or one of each frame's inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parameter {
    /// Always this.
    Fixed(f32),
    /// The input of this number; 0 if a frame has fewer.
    Input(usize),
}

impl From<f32> for Parameter {
    fn from(number: f32) -> Self {
        Self::Fixed(number)
    }
}

impl Parameter {
    pub(super) fn value(self, inputs: &[f32]) -> f32 {
        match self {
            Self::Fixed(number) => number,
            Self::Input(input) => inputs.get(input).copied().unwrap_or(0.0),
        }
    }
}

/// The most nodes one within the other.
const DEEPEST: usize = 64;

/// A blend, and those that it blends: what a [`Tree`](super::Tree) is made of. Weights are clamped to 0…1, NaN counts as 0.
///
/// A node with more than 64 nodes one within the other keeps none of them, and is refused by [`Tree::new`](super::Tree::new).
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub(super) kind: Kind,
    /// The number of nodes one within the other, with this one: at most [`DEEPEST`], so that clones and drops, which
    /// recurse, do not overflow the stack. What holds a [`Kind::Deep`] is one.
    depth: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Source(usize),
    Sum {
        nodes: Vec<Node>,
        weights: Weights,
    },
    Blend {
        nodes: Box<[Node; 2]>,
        weight: Parameter,
        mask: Option<Mask>,
    },
    Add {
        nodes: Box<[Node; 2]>,
        weight: Parameter,
        mask: Option<Mask>,
        reference: Option<Vec<Transform>>,
    },
    /// A mask or a reference was given to what has none.
    Mistaken,
    /// In place of a node with too many nodes one within the other.
    Deep,
}

impl Kind {
    /// The nodes that are blended.
    fn nodes(&self) -> &[Node] {
        match self {
            Self::Sum { nodes, .. } => nodes,
            Self::Blend { nodes, .. } | Self::Add { nodes, .. } => &nodes[..],
            Self::Source(_) | Self::Mistaken | Self::Deep => &[],
        }
    }
}

/// Where the weights of a sum come from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Weights {
    Each(Vec<Parameter>),
    Line(BlendLine, Parameter),
    Plane(BlendPlane, [Parameter; 2]),
}

impl Node {
    fn new(kind: Kind) -> Self {
        let depth = 1 + kind.nodes().iter().map(|node| node.depth).max().unwrap_or(0);
        if depth > DEEPEST { Self { kind: Kind::Deep, depth: DEEPEST } } else { Self { kind, depth } }
    }

    /// A pose that the caller writes when it is asked for, under a number of the caller's: a clip sampled, a pose held.
    #[must_use]
    pub fn source(number: usize) -> Self {
        Self::new(Kind::Source(number))
    }

    /// The weighted sum of any number of poses, Σ wᵢ·poseᵢ / Σ wᵢ, in any order: see
    /// [`Blender::sum`](crate::Blender::sum). The rest pose where all weights are 0.
    #[must_use]
    pub fn sum<W: Into<Parameter>>(nodes: impl IntoIterator<Item = (Self, W)>) -> Self {
        let (nodes, weights) = nodes.into_iter().map(|(node, weight)| (node, weight.into())).unzip();
        Self::new(Kind::Sum { nodes, weights: Weights::Each(weights) })
    }

    /// A blend space of one dimension: one node for each of its places.
    #[must_use]
    pub fn line(space: BlendLine, at: impl Into<Parameter>, nodes: impl Into<Vec<Self>>) -> Self {
        Self::new(Kind::Sum { nodes: nodes.into(), weights: Weights::Line(space, at.into()) })
    }

    /// A blend space of two dimensions: one node for each of its points.
    #[must_use]
    pub fn plane(space: BlendPlane, at: [Parameter; 2], nodes: impl Into<Vec<Self>>) -> Self {
        Self::new(Kind::Sum { nodes: nodes.into(), weights: Weights::Plane(space, at) })
    }

    /// This pose moved towards another by a weight; by bones if there is a [mask](Self::with_mask).
    #[must_use]
    pub fn blend(self, other: Self, weight: impl Into<Parameter>) -> Self {
        Self::new(Kind::Blend { nodes: Box::new([self, other]), weight: weight.into(), mask: None })
    }

    /// This pose and a part of the difference of another from its [reference](Self::with_reference), which is the rest pose if
    /// none is told.
    #[must_use]
    pub fn add(self, layer: Self, weight: impl Into<Parameter>) -> Self {
        Self::new(Kind::Add { nodes: Box::new([self, layer]), weight: weight.into(), mask: None, reference: None })
    }

    /// The same blend or addition with a weight for each bone beside its own. A node that is neither is refused by
    /// [`Tree::new`](super::Tree::new).
    #[must_use]
    pub fn with_mask(mut self, of_bones: Mask) -> Self {
        match &mut self.kind {
            Kind::Blend { mask, .. } | Kind::Add { mask, .. } => *mask = Some(of_bones),
            Kind::Deep => {}
            _ => self.kind = Kind::Mistaken,
        }
        self
    }

    /// The same addition with the pose that its layer is compared with, such as that of the layer's first frame. A node that
    /// is none is refused by [`Tree::new`](super::Tree::new).
    #[must_use]
    pub fn with_reference(mut self, pose: impl Into<Vec<Transform>>) -> Self {
        match &mut self.kind {
            Kind::Add { reference, .. } => *reference = Some(pose.into()),
            Kind::Deep => {}
            _ => self.kind = Kind::Mistaken,
        }
        self
    }
}
