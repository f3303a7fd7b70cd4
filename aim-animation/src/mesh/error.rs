//! [`MeshError`] and [`SkinError`].

use core::fmt;

/// Reason why a mesh is invalid or cannot be deformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// The mesh has more vertices, triangles, influences or joints than 32 bits can count.
    Size,
    /// The length of a slice differs from the number of vertices.
    Length {
        /// The number of vertices.
        vertices: usize,
        /// The length of the slice.
        found: usize,
    },
    /// The position or the normal of this vertex is not finite.
    Vertex(usize),
    /// A corner of this triangle refers to a vertex that does not exist.
    Triangle(usize),
    /// A weight of this vertex is negative or not finite.
    Weight(usize),
    /// This vertex has no weight above 0.
    Unmoved(usize),
    /// The morph at this index refers to a vertex that does not exist, has a target number of `u32::MAX`, or is not
    /// finite.
    Morph(usize),
    /// There are fewer matrices, or joints of a skin, than the mesh needs.
    Joints {
        /// The largest joint number that moves a vertex, plus one.
        needed: usize,
        /// The number of matrices or joints.
        found: usize,
    },
    /// The mesh has no normals.
    NoNormals,
    /// The boxes belong to another mesh.
    OtherMesh,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size => {
                write!(f, "the mesh has more vertices, triangles, influences or joints than 32 bits count; split it")
            }
            Self::Length { vertices, found } => write!(f, "a slice of {found} elements for {vertices} vertices"),
            Self::Vertex(vertex) => write!(f, "the position or normal of vertex {vertex} is not finite"),
            Self::Triangle(triangle) => write!(f, "a corner of triangle {triangle} is a vertex that does not exist"),
            Self::Weight(vertex) => write!(f, "a weight of vertex {vertex} is negative or not finite"),
            Self::Unmoved(vertex) => {
                write!(f, "vertex {vertex} has no weight above 0; give it weight 1 of the joint that carries it")
            }
            Self::Morph(morph) => write!(f, "morph {morph} moves a vertex that does not exist, or is not finite"),
            Self::Joints { needed, found } => write!(f, "{found} joints for a mesh that hangs on {needed}"),
            Self::NoNormals => write!(f, "the mesh has no normals; add them by `with_normals`"),
            Self::OtherMesh => write!(f, "the boxes were made of another mesh"),
        }
    }
}

impl core::error::Error for MeshError {}

/// Reason why a skin is invalid, or a slice does not fit it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SkinError {
    /// This joint refers to a bone that the skeleton does not have.
    Bone {
        /// Index of the joint.
        joint: usize,
        /// Index of the bone.
        bone: usize,
    },
    /// The rest transform of this joint is singular, or the inverse given for it is not finite.
    Rest(usize),
    /// The length of a slice is wrong.
    Length {
        /// Expected length: the number of joints or of bones.
        expected: usize,
        /// The length of the slice.
        found: usize,
    },
}

impl fmt::Display for SkinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bone { joint, bone } => write!(f, "joint {joint} is bone {bone}, which does not exist"),
            Self::Rest(joint) => {
                write!(f, "the rest of joint {joint} is flat or not finite; its scale may not be zero")
            }
            Self::Length { expected, found } => write!(f, "a slice of {found} elements, expected {expected}"),
        }
    }
}

impl core::error::Error for SkinError {}
