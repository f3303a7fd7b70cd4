//! [`Picture`]: what there is to see in one frame, as plain numbers in the world of the file. The state makes it, `draw`
//! shows it; neither knows the other.

use std::sync::Arc;

use aim_gltf::Surface;
use glam::Vec3;

/// Red, green, blue and opacity, sRGB.
pub type Colour = [u8; 4];

/// One frame.
#[derive(Clone, Debug)]
pub struct Picture {
    /// From where it is seen.
    pub view: View,
    /// What the figures are made of: the same [`Arc`] as long as the character stays the same.
    pub surface: Arc<Surface>,
    /// The figures: one, several side by side, or a crowd.
    pub figures: Vec<Figure>,
    /// Rods: gaze rays, bones' axes, trails.
    pub rods: Vec<Rod>,
    /// Balls: targets, where a gaze ends.
    pub balls: Vec<Ball>,
    /// Fans: limit cones.
    pub fans: Vec<Fan>,
    /// What they stand on.
    pub ground: Ground,
    /// Whether on a dark background.
    pub dark: bool,
}

/// A perspective view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the camera is.
    pub from: Vec3,
    /// What it looks at.
    pub at: Vec3,
    /// What is up for it, of length one.
    pub up: Vec3,
    /// The vertical angle of view, radians.
    pub field_rad: f32,
    /// Nearer than this, and further, nothing is seen.
    pub depth: [f32; 2],
}

/// One posed character.
#[derive(Clone, Debug)]
pub struct Figure {
    /// A place for each vertex of the surface.
    pub positions: Vec<Vec3>,
    /// A direction of length one for each vertex of the surface.
    pub normals: Vec<Vec3>,
    /// What its colours are multiplied by: white leaves them.
    pub tint: Colour,
}

/// A cylinder with round ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// One end.
    pub from: Vec3,
    /// The other.
    pub to: Vec3,
    /// Half as thick as it is.
    pub radius: f32,
    /// Unlit.
    pub colour: Colour,
    /// Whether it is seen through the figures: bones' axes are.
    pub in_front: bool,
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle.
    pub centre: Vec3,
    /// Its radius.
    pub radius: f32,
    /// Lit.
    pub colour: Colour,
}

/// A translucent cone of any shape: triangles from the apex to each piece of the closed rim, seen from both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Fan {
    /// Its tip.
    pub apex: Vec3,
    /// Its rim, in order; the last joins the first.
    pub rim: Vec<Vec3>,
    /// Unlit, translucent.
    pub colour: Colour,
}

/// A round floor with a grid, faint and fading towards its edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Its middle.
    pub centre: Vec3,
    /// What is up, of length one.
    pub up: Vec3,
    /// Its radius.
    pub radius: f32,
    /// Between the grid's lines.
    pub step: f32,
}
