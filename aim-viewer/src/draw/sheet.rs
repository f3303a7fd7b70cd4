//! Off-screen target with four samples per pixel, independent of the window's, and its own depth buffer.

use std::convert::Infallible;

use three_d::{
    ClearState, Context, CoreError, DepthTest, Interpolation, Program, RenderStates, RenderTarget,
    RenderTargetMultisample, ScissorBox, Texture2D, VertexBuffer, Viewport, Wrapping, WriteMask,
};

/// Samples per pixel: every OpenGL 3.3 and WebGL 2 supports this number.
const SAMPLES: u32 = 4;

/// Part of the screen to draw on, in pixels from its lower left corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// Size of the whole screen, pixels.
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

    /// Clears the buffers selected by `clear`, then draws.
    pub(super) fn draw(&self, clear: ClearState, draw: impl FnOnce()) {
        let Ok(_) = self.samples.clear(clear).write::<Infallible>(|| {
            draw();
            Ok(())
        });
    }

    /// Resolves the samples and returns the resulting texture.
    fn resolved(&self) -> &Texture2D {
        self.samples.resolve_color_to(&self.pixels.as_color_target(None));
        &self.pixels
    }
}

/// Copies sheets to the screen.
pub(super) struct Printer {
    program: Program,
    /// Two triangles that cover −1…1 in x and y.
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

/// Two triangles that cover −1…1 in x and y.
pub(super) fn square(context: &Context) -> VertexBuffer<[f32; 2]> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    VertexBuffer::new_with_data(context, &corners)
}

/// Render states that draw over everything and write no depth, so that later objects are drawn in front.
pub(super) const OVER_ALL: RenderStates = RenderStates {
    write_mask: WriteMask::COLOR,
    depth_test: DepthTest::Always,
    blend: three_d::Blend::Disabled,
    cull: three_d::Cull::None,
};
