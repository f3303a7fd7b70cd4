//! [`Node`] and [`Parameter`]: the building blocks of a tree of blends.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::mask::Mask;
use crate::space::{BlendLine, BlendPlane};
use crate::transform::Transform;

/// A number used by a tree: a constant, or one of the inputs of each frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parameter {
    /// A constant.
    Fixed(f32),
    /// The input with this number; 0 if a frame has fewer inputs.
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

/// Maximum nesting depth of nodes.
const DEEPEST: usize = 64;

/// A blend of other nodes, or a source: the building block of a [`Tree`](super::Tree). Weights are clamped to 0…1; NaN
/// is treated as 0.
///
/// A node nested more than 64 deep discards its children, and is rejected by [`Tree::new`](super::Tree::new).
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub(super) kind: Kind,
    /// Nesting depth including this node. At most [`DEEPEST`], so that clones and drops, which recurse, do not overflow
    /// the stack. A [`Kind::Deep`] that replaces a deeper node has this maximum too.
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
    /// A mask or a reference was given to a node that cannot have one.
    Mistaken,
    /// Replaces a node that is nested too deep.
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

/// Source of the weights of a sum.
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

    /// A pose that the caller writes on request, such as a sampled clip. The number is chosen by the caller and
    /// identifies it.
    #[must_use]
    pub fn source(number: usize) -> Self {
        Self::new(Kind::Source(number))
    }

    /// The weighted mean of any number of poses, Σ wᵢ·poseᵢ / Σ wᵢ, in any order; see
    /// [`Blender::sum`](crate::Blender::sum). The rest pose if all weights are 0.
    #[must_use]
    pub fn sum<W: Into<Parameter>>(nodes: impl IntoIterator<Item = (Self, W)>) -> Self {
        let (nodes, weights) = nodes.into_iter().map(|(node, weight)| (node, weight.into())).unzip();
        Self::new(Kind::Sum { nodes, weights: Weights::Each(weights) })
    }

    /// A one-dimensional blend space, with one node for each of its places.
    #[must_use]
    pub fn line(space: BlendLine, at: impl Into<Parameter>, nodes: impl Into<Vec<Self>>) -> Self {
        Self::new(Kind::Sum { nodes: nodes.into(), weights: Weights::Line(space, at.into()) })
    }

    /// A two-dimensional blend space, with one node for each of its points.
    #[must_use]
    pub fn plane(space: BlendPlane, at: [Parameter; 2], nodes: impl Into<Vec<Self>>) -> Self {
        Self::new(Kind::Sum { nodes: nodes.into(), weights: Weights::Plane(space, at) })
    }

    /// This pose blended towards another by a weight, multiplied for each bone by the [mask](Self::with_mask), if any.
    #[must_use]
    pub fn blend(self, other: Self, weight: impl Into<Parameter>) -> Self {
        Self::new(Kind::Blend { nodes: Box::new([self, other]), weight: weight.into(), mask: None })
    }

    /// This pose plus a weighted part of the difference of a layer from its [reference](Self::with_reference), by
    /// default the rest pose.
    #[must_use]
    pub fn add(self, layer: Self, weight: impl Into<Parameter>) -> Self {
        Self::new(Kind::Add { nodes: Box::new([self, layer]), weight: weight.into(), mask: None, reference: None })
    }

    /// Sets the mask of a blend or addition, which multiplies its weight for each bone. Any other node is then rejected
    /// by [`Tree::new`](super::Tree::new).
    #[must_use]
    pub fn with_mask(mut self, of_bones: Mask) -> Self {
        match &mut self.kind {
            Kind::Blend { mask, .. } | Kind::Add { mask, .. } => *mask = Some(of_bones),
            Kind::Deep => {}
            _ => self.kind = Kind::Mistaken,
        }
        self
    }

    /// Sets the reference pose of an addition, from which the layer's difference is taken, such as the layer's first
    /// frame. Any other node is then rejected by [`Tree::new`](super::Tree::new).
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
