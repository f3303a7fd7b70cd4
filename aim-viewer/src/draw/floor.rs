//! What is behind and below: the backdrop, the floor with its grid, and the figures' soft shadow on it.

use glam::{Vec2, Vec3};
use three_d::{
    Blend, BlendEquationType, BlendMultiplierType, ClearState, Context, CoreError, Interpolation, Mipmap, Program,
    RenderStates, Texture2D, VertexBuffer, Viewport, Wrapping, WriteMask,
};

use super::figures::Figures;
use super::light::Light;
use super::model::Model;
use super::sheet::{OVER_ALL, square};
use crate::picture::Ground;

/// Pixels along a side of the shadow.
const SHADOW: u32 = 512;
/// How far beyond the figures it reaches, in parts of their height.
const MARGIN: f32 = 0.25;

pub(super) struct Floor {
    backdrop: Program,
    floor: Program,
    caster: Program,
    square: VertexBuffer<[f32; 2]>,
    /// How near above each place of the floor something is: 1 on it, less the higher.
    shadow: Texture2D,
    /// The middle of the shadow in the floor's own coordinates, and half of its side; nothing casts if not positive.
    shadowed: (Vec2, f32),
}

impl Floor {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        let program = |vertex: &str, fragment: &str| Program::from_source(context, vertex, fragment);
        Ok(Self {
            backdrop: program(include_str!("shaders/screen.vert"), include_str!("shaders/backdrop.frag"))?,
            floor: program(include_str!("shaders/floor.vert"), include_str!("shaders/floor.frag"))?,
            caster: program(include_str!("shaders/shadow.vert"), include_str!("shaders/shadow.frag"))?,
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
            shadowed: (Vec2::ZERO, 0.0),
        })
    }

    /// Sees the figures from above.
    pub(super) fn cast(&mut self, ground: &Ground, figures: &Figures, model: &Model) {
        let [across, along] = sides(ground.up);
        let flat = |place: Vec3| Vec2::new((place - ground.centre).dot(across), (place - ground.centre).dot(along));
        let Some(bounds) = figures.bounds() else {
            self.shadowed.1 = 0.0;
            return;
        };
        let corners = corners(bounds);
        let (low, high) = corners
            .iter()
            .map(|corner| flat(*corner))
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let height = corners.iter().map(|corner| (*corner - ground.centre).dot(ground.up)).fold(0.0, f32::max);
        self.shadowed = (0.5 * (low + high), 0.5 * (high - low).max_element() + MARGIN * height);
        let (middle, half) = self.shadowed;
        let program = &self.caster;
        self.send_plane(program, ground, [across, along]);
        program.use_uniform("middle", three_d::Vec2::from(middle.to_array()));
        program.use_uniform("extent", half);
        program.use_uniform("up", three_d::Vec3::from(ground.up.to_array()));
        program.use_uniform("fading", 0.25 * height.max(f32::MIN_POSITIVE));
        let once = |equation| Blend::Enabled {
            source_rgb_multiplier: BlendMultiplierType::One,
            source_alpha_multiplier: BlendMultiplierType::One,
            destination_rgb_multiplier: BlendMultiplierType::One,
            destination_alpha_multiplier: BlendMultiplierType::One,
            rgb_equation: equation,
            alpha_equation: equation,
        };
        let states = RenderStates { blend: once(BlendEquationType::Max), ..OVER_ALL };
        let target = self.shadow.as_color_target(None);
        let cast: Result<_, CoreError> = target.clear(ClearState::color(0.0, 0.0, 0.0, 0.0)).write(|| {
            figures.cast(program, model, states, Viewport::new_at_origo(SHADOW, SHADOW));
            Ok(())
        });
        debug_assert!(cast.is_ok(), "drawing has no errors of its own");
    }

    pub(super) fn draw_backdrop(&self, light: &Light) {
        light.send(&self.backdrop);
        self.backdrop.use_vertex_attribute("corner", &self.square);
        self.backdrop.draw_arrays(OVER_ALL, light.viewport, self.square.vertex_count());
    }

    /// The floor, from above; from below one looks through it.
    pub(super) fn draw(&self, ground: &Ground, light: &Light) {
        if (light.eye - ground.centre).dot(ground.up) <= 0.0 {
            return;
        }
        let program = &self.floor;
        light.send(program);
        self.send_plane(program, ground, sides(ground.up));
        let (middle, half) = self.shadowed;
        program.use_uniform("radius", ground.radius);
        program.use_uniform("gap", ground.step);
        program.use_uniform("middle", three_d::Vec2::from(middle.to_array()));
        program.use_uniform("extent", half);
        program.use_texture("shadow", &self.shadow);
        program.use_vertex_attribute("corner", &self.square);
        let states = RenderStates { blend: Blend::TRANSPARENCY, write_mask: WriteMask::COLOR, ..Default::default() };
        program.draw_arrays(states, light.viewport, self.square.vertex_count());
    }

    fn send_plane(&self, program: &Program, ground: &Ground, [across, along]: [Vec3; 2]) {
        for (name, vector) in [("centre", ground.centre), ("across", across), ("along", along)] {
            program.use_uniform(name, three_d::Vec3::from(vector.to_array()));
        }
    }
}

/// Two directions along the floor.
fn sides(up: Vec3) -> [Vec3; 2] {
    let across = up.any_orthonormal_vector();
    [across, up.cross(across)]
}

fn corners([low, high]: [Vec3; 2]) -> [Vec3; 8] {
    std::array::from_fn(|i| Vec3::from_array(std::array::from_fn(|k| if i >> k & 1 == 0 { low[k] } else { high[k] })))
}
