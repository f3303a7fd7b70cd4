//! Figures: instances of one model, each with its joint transforms and morph weights.

use aim_gltf::Alpha;
use aim_runtime::glam::Vec3;
use three_d::{Blend, Context, CoreError, Cull, DepthTest, Program, RenderStates, Texture2D, Viewport, WriteMask};

use super::light::{self, Light};
use super::model::{Model, Part};
use super::numbers;
use crate::picture::Figure;

/// GLSL function that poses vertices: `skin(normal, place, direction)`. [`Figures`] supplies its uniforms.
pub(super) const SKIN: &str = include_str!("shaders/skin.glsl");

/// The shader program, and the texture with the figures' data, reused from frame to frame.
pub(super) struct Figures {
    context: Context,
    program: Program,
    numbers: Option<Texture2D>,
    /// Texels per figure.
    stride: usize,
    /// Texels of a figure's joints.
    rows: usize,
    /// Number of figures in the picture.
    shown: usize,
    bounds: Option<[Vec3; 2]>,
}

/// Draw pass: opaque parts first, then translucent ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pass {
    Opaque,
    Translucent,
}

impl Figures {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        let vertex = [SKIN, include_str!("shaders/figure.vert")].concat();
        let fragment = [light::GLSL, include_str!("shaders/figure.frag")].concat();
        let program = Program::from_source(context, &vertex, &fragment)?;
        Ok(Self { context: context.clone(), program, numbers: None, stride: 0, rows: 0, shown: 0, bounds: None })
    }

    /// Uploads the figures' joint transforms and morph weights, one figure after the other.
    pub(super) fn fill(&mut self, figures: &[Figure]) {
        let mut texels = Vec::new();
        for Figure { rows, morphs, .. } in figures {
            texels.extend_from_slice(rows);
            // The same number for all figures, because they share one model.
            self.rows = rows.len();
            texels.extend(morphs.chunks(4).map(|four| std::array::from_fn(|at| four.get(at).copied().unwrap_or(0.0))));
        }
        self.shown = figures.len();
        self.stride = texels.len() / self.shown.max(1);
        numbers::fill(&self.context, &mut self.numbers, &texels);
        let bounds = figures.iter().map(|figure| figure.bounds).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        self.bounds = bounds.filter(|[low, high]| low.is_finite() && high.is_finite());
    }

    /// Returns the bounding box of all figures, `[low, high]`; `None` if there are no figures or it is not finite.
    pub(super) fn bounds(&self) -> Option<[Vec3; 2]> {
        self.bounds
    }

    pub(super) fn draw(&self, model: &Model, light: &Light, pass: Pass) {
        let program = &self.program;
        light.send(program);
        for part in model.parts.iter().filter(|part| pass_of(part) == pass) {
            let material = &part.material;
            program.use_uniform("colour", three_d::Vec4::from(material.colour));
            // Fragments with less alpha than `cutoff` are discarded. Opaque and masked materials ignore their own
            // alpha.
            let (cutoff, own) = match material.alpha {
                Alpha::Opaque => (0.0, 0.0),
                Alpha::Mask(cutoff) => (cutoff, 0.0),
                Alpha::Blend => (0.02, 1.0_f32),
            };
            program.use_uniform("cutoff", cutoff);
            program.use_uniform("ownOpacity", own);
            program.use_texture("picture", &part.texture);
            program.use_vertex_attribute("normal", &model.normals);
            program.use_vertex_attribute("textureCoordinates", &model.texture_coordinates);
            program.use_vertex_attribute("tint", &model.tints);
            let states = RenderStates {
                cull: if material.is_double_sided { Cull::None } else { Cull::Back },
                blend: if pass == Pass::Opaque { Blend::Disabled } else { Blend::TRANSPARENCY },
                depth_test: DepthTest::LessOrEqual,
                write_mask: WriteMask::COLOR_AND_DEPTH,
            };
            self.draw_part(program, model, part, (states, light.viewport));
        }
    }

    /// Draws all opaque and masked parts with a program that uses only positions.
    pub(super) fn cast(&self, program: &Program, model: &Model, states: RenderStates, viewport: Viewport) {
        for part in model.parts.iter().filter(|part| !part.is_translucent()) {
            self.draw_part(program, model, part, (states, viewport));
        }
    }

    /// Draws one part of all figures with a program whose source begins with [`SKIN`].
    fn draw_part(&self, program: &Program, model: &Model, part: &Part, (states, viewport): (RenderStates, Viewport)) {
        let Some(numbers) = self.numbers.as_ref().filter(|_| self.shown > 0) else { return };
        let count = |count: usize| i32::try_from(count).unwrap_or(i32::MAX);
        program.use_texture("numbers", numbers);
        program.use_texture("shifts", &model.shifts);
        program.use_uniform("stride", count(self.stride));
        program.use_uniform("rows", count(self.rows));
        program.use_vertex_attribute("position", &model.positions);
        program.use_vertex_attribute("joints", &model.joints);
        program.use_vertex_attribute("weights", &model.weights);
        program.use_vertex_attribute("shifted", &model.shifted);
        let shown = u32::try_from(self.shown).unwrap_or(u32::MAX);
        program.draw_elements_instanced(states, viewport, &part.triangles, shown);
    }
}

fn pass_of(part: &Part) -> Pass {
    if part.is_translucent() { Pass::Translucent } else { Pass::Opaque }
}
