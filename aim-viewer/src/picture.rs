//! [`Picture`]: the contents of one frame as plain numbers, in the file's world space. The stage builds it and `draw`
//! draws it; neither depends on the other.

use std::sync::Arc;

use aim_gltf::Surface;
use aim_runtime::glam::Vec3;

use crate::skinning::Skinning;

/// Red, green, blue and opacity, 0…255, sRGB.
pub(crate) type Colour = [u8; 4];

/// The contents of one frame.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    /// The camera.
    pub(crate) view: Perspective,
    /// Surface of the figures: the same [`Arc`] as long as the character stays the same.
    pub(crate) surface: Arc<Surface>,
    /// Skinning of the surface's vertices.
    pub(crate) skinning: Arc<Skinning>,
    /// The figures: one, several side by side, or a crowd.
    pub(crate) figures: Vec<Figure>,
    /// Rods: gaze rays, bone axes, trails, and targets, which are rods of length 0.
    pub(crate) rods: Vec<Rod>,
    /// Fans: limit cones.
    pub(crate) fans: Vec<Fan>,
    /// The floor.
    pub(crate) ground: Ground,
    /// `true` for a dark background.
    pub(crate) dark: bool,
}

/// A perspective view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Perspective {
    /// Position of the camera.
    pub(crate) from: Vec3,
    /// Point at which the camera looks.
    pub(crate) at: Vec3,
    /// Up direction of the camera, unit vector.
    pub(crate) up: Vec3,
    /// Vertical field of view, radians.
    pub(crate) field_rad: f32,
    /// Distances of the near and far clipping planes.
    pub(crate) depth: [f32; 2],
}

/// One posed character.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// Three rows of each joint's skinning matrix, world ← mesh.
    pub(crate) rows: Vec<[f32; 4]>,
    /// Weight of each morph target.
    pub(crate) morphs: Vec<f32>,
    /// Bounding box of all vertices, `[low, high]`.
    pub(crate) bounds: [Vec3; 2],
}

/// A capsule: a cylinder with hemispherical ends. With length 0, a ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rod {
    /// One end of the axis.
    pub(crate) from: Vec3,
    /// The other end of the axis.
    pub(crate) to: Vec3,
    /// Radius of the cylinder and its ends.
    pub(crate) radius: f32,
    pub(crate) colour: Colour,
    /// `true` if the rod is shaded.
    pub(crate) is_lit: bool,
    /// `true` if the rod is drawn over the figures, as the bones' axes are.
    pub(crate) in_front: bool,
}

/// A translucent cone with any base: triangles from the apex to each edge of the closed rim, visible from both sides.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fan {
    /// Tip of the cone.
    pub(crate) apex: Vec3,
    /// Points of the rim, in order; the last connects to the first.
    pub(crate) rim: Vec<Vec3>,
    /// Colour, drawn without lighting.
    pub(crate) colour: Colour,
}

/// A round floor with a faint grid that fades towards the edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ground {
    /// Centre of the floor.
    pub(crate) centre: Vec3,
    /// Unit normal of the floor.
    pub(crate) up: Vec3,
    /// Radius of the floor.
    pub(crate) radius: f32,
    /// Spacing of the grid's lines.
    pub(crate) step: f32,
}
