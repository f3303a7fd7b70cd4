//! [`Picture`]: what there is to see in one frame, as plain numbers in the world of the file. The state makes it, `draw`
//! shows it; neither knows the other.

use std::sync::Arc;

use aim_gltf::Surface;
use aim_runtime::glam::Vec3;

use crate::skinning::Skinning;

/// Red, green, blue and opacity, sRGB.
pub(crate) type Colour = [u8; 4];

/// One frame.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    /// From where it is seen.
    pub(crate) view: Perspective,
    /// Surface of the figures: the same [`Arc`] as long as the character stays the same.
    pub(crate) surface: Arc<Surface>,
    /// What moves its vertices.
    pub(crate) skinning: Arc<Skinning>,
    /// The figures: one, several side by side, or a crowd.
    pub(crate) figures: Vec<Figure>,
    /// Rods: gaze rays, bones' axes, trails, and targets, which are rods without length.
    pub(crate) rods: Vec<Rod>,
    /// Fans: limit cones.
    pub(crate) fans: Vec<Fan>,
    /// The floor.
    pub(crate) ground: Ground,
    /// True for a dark background.
    pub(crate) dark: bool,
}

/// A perspective view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Perspective {
    /// Place of the camera.
    pub(crate) from: Vec3,
    /// The point that it looks at.
    pub(crate) at: Vec3,
    /// Its up, of length one.
    pub(crate) up: Vec3,
    /// The vertical angle of view, radians.
    pub(crate) field_rad: f32,
    /// Nearer than this, and further, nothing is seen.
    pub(crate) depth: [f32; 2],
}

/// One posed character.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// Three rows for each joint, world ← mesh.
    pub(crate) rows: Vec<[f32; 4]>,
    /// A weight for each morph target.
    pub(crate) morphs: Vec<f32>,
    /// The lowest and the highest coordinates, which no vertex leaves.
    pub(crate) bounds: [Vec3; 2],
}

/// A cylinder with round ends; without length a ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rod {
    /// One end.
    pub(crate) from: Vec3,
    /// The other.
    pub(crate) to: Vec3,
    /// Half as thick as it is.
    pub(crate) radius: f32,
    pub(crate) colour: Colour,
    /// True if it is shaded.
    pub(crate) is_lit: bool,
    /// True to draw it over the figures, as bones' axes are.
    pub(crate) in_front: bool,
}

/// A translucent cone of any shape: triangles from the apex to each piece of the closed rim, seen from both sides.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fan {
    /// Its tip.
    pub(crate) apex: Vec3,
    /// Its rim, in order; the last joins the first.
    pub(crate) rim: Vec<Vec3>,
    /// Unlit, translucent.
    pub(crate) colour: Colour,
}

/// A round floor with a grid, faint and fading towards its edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ground {
    /// Its middle.
    pub(crate) centre: Vec3,
    /// Its normal, of length one.
    pub(crate) up: Vec3,
    /// Its radius.
    pub(crate) radius: f32,
    /// Between the grid's lines.
    pub(crate) step: f32,
}
