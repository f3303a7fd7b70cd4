//! [`Influence`] and [`Morph`]: movers of a vertex.

use aim_runtime::glam::Vec3;

/// Weight of a joint for a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// Index of the joint in the [`Skin`](crate::Skin).
    pub joint: u32,
    /// Weight, 0 or more. The weights of a vertex need not sum to 1.
    pub weight: f32,
}

impl Influence {
    /// A joint with its weight.
    #[must_use]
    pub const fn new(joint: u32, weight: f32) -> Self {
        Self { joint, weight }
    }
}

/// Displacement of one vertex at full weight of a morph target, in mesh space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Morph {
    /// Number of the morph target.
    pub target: u32,
    /// Index of the vertex.
    pub vertex: u32,
    /// Displacement of its position.
    pub position: Vec3,
    /// Displacement of its normal.
    pub normal: Vec3,
}
