//! Off-screen target with four samples a pixel, whatever the window has, and a depth of its own.

use std::convert::Infallible;

use three_d::{
    ClearState, Context, CoreError, DepthTest, Interpolation, Program, RenderStates, RenderTarget,
    RenderTargetMultisample, ScissorBox, Texture2D, VertexBuffer, Viewport, Wrapping, WriteMask,
};

/// Samples a pixel: as many as each OpenGL 3.3 and WebGL 2 has.
const SAMPLES: u32 = 4;

/// Part of the screen to draw on, in pixels from its lower left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// The whole screen.
    pub(crate) screen: [u32; 2],
}

pub(super) struct Sheet {
    samples: RenderTargetMultisample<[u8; 4], f32>,
    pixels: Texture2D,
}

impl Sheet {
    pub(super) fn new(context: &Context, [width, height]: [u32; 2]) -> Self {
        let filter = Interpolation::Nearest;
        let wrap = Wrapping::ClampToEdge;
        Self {
            samples: RenderTargetMultisample::new(context, width, height, SAMPLES),
            pixels: Texture2D::new_empty::<[u8; 4]>(context, width, height, filter, filter, None, wrap, wrap),
        }
    }

    pub(super) fn size(&self) -> [u32; 2] {
        [self.pixels.width(), self.pixels.height()]
    }

    /// Clears what is asked for, then draws.
    pub(super) fn draw(&self, clear: ClearState, draw: impl FnOnce()) {
        let Ok(_) = self.samples.clear(clear).write::<Infallible>(|| {
            draw();
            Ok(())
        });
    }

    /// The mean of the samples.
    fn resolved(&self) -> &Texture2D {
        self.samples.resolve_color_to(&self.pixels.as_color_target(None));
        &self.pixels
    }
}

/// Brings sheets onto the screen.
pub(super) struct Printer {
    program: Program,
    /// Two triangles from −1 to 1.
    square: VertexBuffer<[f32; 2]>,
}

impl Printer {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        let (vertex, fragment) = (include_str!("shaders/screen.vert"), include_str!("shaders/sheet.frag"));
        let program = Program::from_source(context, vertex, fragment)?;
        Ok(Self { program, square: square(context) })
    }

    pub(super) fn print(&self, context: &Context, sheet: &Sheet, place: Place) {
        let viewport = Viewport { x: place.x, y: place.y, width: place.width, height: place.height };
        let pixels = sheet.resolved();
        let screen = RenderTarget::screen(context, place.screen[0], place.screen[1]);
        let Ok(_) = screen.write_partially::<Infallible>(ScissorBox::from(viewport), || {
            self.program.use_texture("pixels", pixels);
            self.program.use_vertex_attribute("corner", &self.square);
            self.program.draw_arrays(OVER_ALL, viewport, self.square.vertex_count());
            Ok(())
        });
    }
}

/// Two triangles from −1 to 1.
pub(super) fn square(context: &Context) -> VertexBuffer<[f32; 2]> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    VertexBuffer::new_with_data(context, &corners)
}

/// Over all that is there, and behind all that comes.
pub(super) const OVER_ALL: RenderStates = RenderStates {
    write_mask: WriteMask::COLOR,
    depth_test: DepthTest::Always,
    blend: three_d::Blend::Disabled,
    cull: three_d::Cull::None,
};
