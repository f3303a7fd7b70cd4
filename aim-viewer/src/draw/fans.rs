//! Limit cones: translucent triangles.

use three_d::{Blend, Context, CoreError, Program, RenderStates, VertexBuffer, WriteMask};

use super::light::Light;
use crate::picture::Fan;

pub(super) struct Fans {
    program: Program,
    places: VertexBuffer<[f32; 3]>,
    colours: VertexBuffer<[f32; 4]>,
}

impl Fans {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self {
            program: Program::from_source(context, include_str!("shaders/fan.vert"), include_str!("shaders/fan.frag"))?,
            places: VertexBuffer::new(context),
            colours: VertexBuffer::new(context),
        })
    }

    pub(super) fn fill(&mut self, fans: &[Fan]) {
        let (mut places, mut colours) = (Vec::new(), Vec::new());
        for fan in fans {
            let next = fan.rim.iter().cycle().skip(1);
            for (from, to) in fan.rim.iter().zip(next) {
                places.extend([fan.apex, *from, *to].map(|place| place.to_array()));
            }
            colours.resize(places.len(), fan.colour.map(|part| f32::from(part) / 255.0));
        }
        self.places.fill(&places);
        self.colours.fill(&colours);
    }

    pub(super) fn draw(&self, light: &Light) {
        let count = self.places.vertex_count();
        if count == 0 {
            return;
        }
        light.send(&self.program);
        self.program.use_vertex_attribute("position", &self.places);
        self.program.use_vertex_attribute("colour", &self.colours);
        let states = RenderStates { blend: Blend::TRANSPARENCY, write_mask: WriteMask::COLOR, ..Default::default() };
        self.program.draw_arrays(states, light.viewport, count);
    }
}
