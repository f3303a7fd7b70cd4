//! The figures: places and normals of each, one model for all.

use aim_gltf::Alpha;
use aim_runtime::glam::Vec3;
use three_d::{Blend, Context, CoreError, Cull, DepthTest, Program, RenderStates, VertexBuffer, Viewport, WriteMask};

use super::light::{self, Light};
use super::model::{Model, Part};
use crate::picture::Figure;

/// The program, and a place for each figure, kept from frame to frame.
pub(super) struct Figures {
    context: Context,
    program: Program,
    posed: Vec<Posed>,
    /// Number of them in the picture.
    shown: usize,
    bounds: Option<[Vec3; 2]>,
    scratch: Vec<[f32; 3]>,
}

struct Posed {
    positions: VertexBuffer<[f32; 3]>,
    normals: VertexBuffer<[f32; 3]>,
}

/// Pass of drawing: opaque parts first, then translucent ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pass {
    Opaque,
    Translucent,
}

impl Figures {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        let fragment = [light::GLSL, include_str!("shaders/figure.frag")].concat();
        let program = Program::from_source(context, include_str!("shaders/figure.vert"), &fragment)?;
        Ok(Self { context: context.clone(), program, posed: Vec::new(), shown: 0, bounds: None, scratch: Vec::new() })
    }

    /// Sends places and normals; a figure that has not one for each vertex of the model is left out.
    pub(super) fn fill(&mut self, model: &Model, figures: &[Figure]) {
        let count = model.surface().tints().len();
        let fits = |figure: &&Figure| count > 0 && figure.positions.len() == count && figure.normals.len() == count;
        self.shown = 0;
        let mut bounds = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        for figure in figures.iter().filter(fits) {
            if self.posed.len() == self.shown {
                let (positions, normals) = (VertexBuffer::new(&self.context), VertexBuffer::new(&self.context));
                self.posed.push(Posed { positions, normals });
            }
            let posed = &mut self.posed[self.shown];
            for (vectors, buffer) in [(&figure.positions, &mut posed.positions), (&figure.normals, &mut posed.normals)]
            {
                self.scratch.clear();
                self.scratch.extend(vectors.iter().map(Vec3::to_array));
                buffer.fill(&self.scratch);
            }
            for position in &figure.positions {
                bounds = [bounds[0].min(*position), bounds[1].max(*position)];
            }
            self.shown += 1;
        }
        // A smaller crowd gives its memory back.
        self.posed.truncate(self.shown);
        self.bounds = Some(bounds).filter(|[low, high]| low.is_finite() && high.is_finite());
    }

    /// The lowest and the highest coordinates of all; none if there is no figure, or not a finite one.
    pub(super) fn bounds(&self) -> Option<[Vec3; 2]> {
        self.bounds
    }

    pub(super) fn draw(&self, model: &Model, light: &Light, pass: Pass) {
        if self.shown == 0 {
            return;
        }
        let program = &self.program;
        light.send(program);
        for posed in &self.posed {
            for part in model.parts.iter().filter(|part| pass_of(part) == pass) {
                let material = &part.material;
                program.use_uniform("colour", three_d::Vec4::from(material.colour));
                // Below it nothing is seen; what is opaque has no opacity of its own.
                let (cutoff, own) = match material.alpha {
                    Alpha::Opaque => (0.0, 0.0),
                    Alpha::Mask(cutoff) => (cutoff, 0.0),
                    Alpha::Blend => (0.02, 1.0_f32),
                };
                program.use_uniform("cutoff", cutoff);
                program.use_uniform("ownOpacity", own);
                program.use_texture("picture", &part.texture);
                program.use_vertex_attribute("position", &posed.positions);
                program.use_vertex_attribute("normal", &posed.normals);
                program.use_vertex_attribute("textureCoordinates", &model.texture_coordinates);
                program.use_vertex_attribute("tint", &model.tints);
                let states = RenderStates {
                    cull: if material.is_double_sided { Cull::None } else { Cull::Back },
                    blend: if pass == Pass::Opaque { Blend::Disabled } else { Blend::TRANSPARENCY },
                    depth_test: DepthTest::LessOrEqual,
                    write_mask: WriteMask::COLOR_AND_DEPTH,
                };
                program.draw_elements(states, light.viewport, &part.triangles);
            }
        }
    }

    /// Draws with a program that needs places alone, all parts that hide something.
    pub(super) fn cast(&self, program: &Program, model: &Model, states: RenderStates, viewport: Viewport) {
        for posed in &self.posed {
            for part in model.parts.iter().filter(|part| !part.is_translucent()) {
                program.use_vertex_attribute("position", &posed.positions);
                program.draw_elements(states, viewport, &part.triangles);
            }
        }
    }
}

fn pass_of(part: &Part) -> Pass {
    if part.is_translucent() { Pass::Translucent } else { Pass::Opaque }
}
