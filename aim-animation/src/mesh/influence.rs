//! [`Influence`] and [`Morph`]: what moves a vertex.

use aim_runtime::glam::Vec3;

/// A joint's share in a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// The joint, counted as in the [`Skin`](crate::Skin).
    pub joint: u32,
    /// Its weight, 0 or more; those of a vertex need not sum to 1.
    pub weight: f32,
}

impl Influence {
    /// A joint with its weight.
    #[must_use]
    pub const fn new(joint: u32, weight: f32) -> Self {
        Self { joint, weight }
    }
}

/// The way of one vertex to a morph target's full weight, in the space of the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Morph {
    /// The number of the target.
    pub target: u32,
    /// The vertex.
    pub vertex: u32,
    /// Added to its position.
    pub position: Vec3,
    /// Added to its normal.
    pub normal: Vec3,
}
