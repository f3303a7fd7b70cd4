//! Draws a [`Picture`](crate::picture::Picture) with OpenGL or WebGL 2.

use std::sync::Arc;

use eframe::glow;

use crate::picture::Picture;

/// What lies on the graphics card.
#[derive(Debug)]
pub(crate) struct Canvas;

/// Where on the screen to draw, in pixels from its lower left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// The whole screen.
    pub(crate) screen: [u32; 2],
}

impl Canvas {
    pub(crate) fn new(_gl: Arc<glow::Context>) -> Result<Self, String> {
        Ok(Self)
    }

    /// Clears the place and draws there.
    pub(crate) fn draw(&mut self, _picture: &Picture, _place: Place) {}
}
