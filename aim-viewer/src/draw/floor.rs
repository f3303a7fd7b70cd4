//! Backdrop and floor. The floor has a grid and shows a soft shadow of the figures.

use std::convert::Infallible;

use aim_runtime::glam::{Vec2, Vec3};
use three_d::{
    Blend, BlendEquationType, BlendMultiplierType, ClearState, Context, CoreError, Interpolation, Mipmap, Program,
    RenderStates, Texture2D, VertexBuffer, Viewport, Wrapping, WriteMask,
};

use super::figures::{self, Figures};
use super::light::Light;
use super::model::Model;
use super::sheet::{OVER_ALL, square};
use crate::picture::Ground;

/// Side of the shadow texture, pixels.
const SHADOW: u32 = 512;
/// Margin of the shadow texture around the figures, relative to their height.
const MARGIN: f32 = 0.25;
/// Radius of the shadow's blur, relative to the figures' height.
const BLUR: f32 = 0.05;
/// Height at which a shadow is a third as strong, relative to the figures' height.
const FADING: f32 = 0.25;

pub(super) struct Floor {
    backdrop: Program,
    floor: Program,
    caster: Program,
    square: VertexBuffer<[f32; 2]>,
    /// Proximity of the lowest object above each point of the floor: 1 on the floor, decreasing with height.
    shadow: Texture2D,
    shadowed: Shadowed,
}

/// The square of the floor that the shadow texture covers, in floor coordinates.
#[derive(Clone, Copy, Debug, Default)]
struct Shadowed {
    middle: Vec2,
    /// Half of the square's side; 0 if nothing casts a shadow.
    extent: f32,
    /// Radius of the blur.
    blur: f32,
}

impl Floor {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        let program = |vertex: &str, fragment: &str| Program::from_source(context, vertex, fragment);
        Ok(Self {
            backdrop: program(include_str!("shaders/screen.vert"), include_str!("shaders/backdrop.frag"))?,
            floor: program(include_str!("shaders/floor.vert"), include_str!("shaders/floor.frag"))?,
            caster: program(
                &[figures::SKIN, include_str!("shaders/shadow.vert")].concat(),
                include_str!("shaders/shadow.frag"),
            )?,
            square: square(context),
            shadow: Texture2D::new_empty::<[u8; 4]>(
                context,
                SHADOW,
                SHADOW,
                Interpolation::Linear,
                Interpolation::Linear,
                Some(Mipmap::default()),
                Wrapping::ClampToEdge,
                Wrapping::ClampToEdge,
            ),
            shadowed: Shadowed::default(),
        })
    }

    /// Renders the figures into the shadow texture, seen from above.
    pub(super) fn cast(&mut self, ground: &Ground, figures: &Figures, model: &Model) {
        let [across, along] = sides(ground.up);
        let flat = |place: Vec3| Vec2::new((place - ground.centre).dot(across), (place - ground.centre).dot(along));
        let Some(bounds) = figures.bounds() else {
            self.shadowed = Shadowed::default();
            return;
        };
        let corners = corners(bounds);
        let low = corners.map(flat).into_iter().fold(Vec2::INFINITY, Vec2::min);
        let high = corners.map(flat).into_iter().fold(Vec2::NEG_INFINITY, Vec2::max);
        let height = corners.iter().map(|corner| (*corner - ground.centre).dot(ground.up)).fold(0.0, f32::max);
        let shadowed = Shadowed {
            middle: 0.5 * (low + high),
            extent: 0.5 * (high - low).max_element() + MARGIN * height,
            blur: BLUR * height,
        };
        self.shadowed = shadowed;
        let program = &self.caster;
        send_plane(program, ground, [across, along]);
        program.use_uniform("middle", three_d::Vec2::from(shadowed.middle.to_array()));
        program.use_uniform("extent", shadowed.extent);
        program.use_uniform("up", three_d::Vec3::from(ground.up.to_array()));
        program.use_uniform("fading", FADING * height.max(f32::MIN_POSITIVE));
        let nearest = Blend::Enabled {
            source_rgb_multiplier: BlendMultiplierType::One,
            source_alpha_multiplier: BlendMultiplierType::One,
            destination_rgb_multiplier: BlendMultiplierType::One,
            destination_alpha_multiplier: BlendMultiplierType::One,
            rgb_equation: BlendEquationType::Max,
            alpha_equation: BlendEquationType::Max,
        };
        let states = RenderStates { blend: nearest, ..OVER_ALL };
        let target = self.shadow.as_color_target(None);
        let Ok(_) = target.clear(ClearState::color(0.0, 0.0, 0.0, 0.0)).write::<Infallible>(|| {
            figures.cast(program, model, states, Viewport::new_at_origo(SHADOW, SHADOW));
            Ok(())
        });
    }

    pub(super) fn draw_backdrop(&self, light: &Light) {
        light.send(&self.backdrop);
        self.backdrop.use_vertex_attribute("corner", &self.square);
        self.backdrop.draw_arrays(OVER_ALL, light.viewport, self.square.vertex_count());
    }

    /// Draws the floor if the eye is above it; from below it is not drawn.
    pub(super) fn draw(&self, ground: &Ground, light: &Light) {
        if (light.eye - ground.centre).dot(ground.up) <= 0.0 {
            return;
        }
        let program = &self.floor;
        light.send(program);
        send_plane(program, ground, sides(ground.up));
        let Shadowed { middle, extent, blur } = self.shadowed;
        program.use_uniform("radius", ground.radius);
        program.use_uniform("gap", ground.step);
        program.use_uniform("middle", three_d::Vec2::from(middle.to_array()));
        program.use_uniform("extent", extent);
        program.use_uniform("blur", blur);
        program.use_texture("shadow", &self.shadow);
        program.use_vertex_attribute("corner", &self.square);
        let states = RenderStates { blend: Blend::TRANSPARENCY, write_mask: WriteMask::COLOR, ..Default::default() };
        program.draw_arrays(states, light.viewport, self.square.vertex_count());
    }
}

/// Sets the uniforms for the floor's coordinate system.
fn send_plane(program: &Program, ground: &Ground, [across, along]: [Vec3; 2]) {
    for (name, vector) in [("centre", ground.centre), ("across", across), ("along", along)] {
        program.use_uniform(name, three_d::Vec3::from(vector.to_array()));
    }
}

/// Returns two orthonormal directions in the plane of the floor.
fn sides(up: Vec3) -> [Vec3; 2] {
    let across = up.any_orthonormal_vector();
    [across, up.cross(across)]
}

fn corners([low, high]: [Vec3; 2]) -> [Vec3; 8] {
    std::array::from_fn(|i| Vec3::from_array(std::array::from_fn(|k| if i >> k & 1 == 0 { low[k] } else { high[k] })))
}
