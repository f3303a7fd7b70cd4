//! Draws a [`Picture`] with OpenGL or WebGL 2.

mod fans;
mod figures;
mod floor;
mod light;
mod marks;
mod model;
mod movers;
mod numbers;
mod sheet;

use std::sync::Arc;

use eframe::glow;
use three_d::{ClearState, Context, CoreError, Viewport};

use crate::picture::Picture;
use fans::Fans;
use figures::{Figures, Pass};
use floor::Floor;
use light::Light;
use marks::Marks;
use model::Model;
#[cfg(test)]
pub(crate) use movers::Movers;
pub(crate) use sheet::Place;
use sheet::{Printer, Sheet};

/// GPU resources.
pub(crate) struct Canvas {
    context: Context,
    /// Buffers of the current surface; `None` before the first picture.
    model: Option<Model>,
    figures: Figures,
    marks: Marks,
    fans: Fans,
    floor: Floor,
    /// Off-screen target with the size of the destination.
    sheet: Option<Sheet>,
    printer: Printer,
}

impl Canvas {
    /// # Errors
    /// If shaders or buffers cannot be created with this OpenGL context.
    pub(crate) fn new(gl: Arc<glow::Context>) -> Result<Self, String> {
        let make = || {
            let context = Context::from_gl_context(gl)?;
            Ok(Self {
                model: None,
                figures: Figures::new(&context)?,
                marks: Marks::new(&context)?,
                fans: Fans::new(&context)?,
                floor: Floor::new(&context)?,
                sheet: None,
                printer: Printer::new(&context)?,
                context,
            })
        };
        make().map_err(|error: CoreError| format!("the graphics need OpenGL 3.3 or WebGL 2: {error}"))
    }

    /// Draws the picture over the whole of `place`.
    pub(crate) fn draw(&mut self, picture: &Picture, place: Place) {
        let size = [place.width, place.height].map(|side| side.max(1));
        let light = Light::new(picture, Viewport::new_at_origo(size[0], size[1]));
        let context = &self.context;
        if self.model.as_ref().is_some_and(|model| !Arc::ptr_eq(model.surface(), &picture.surface)) {
            self.model = None;
        }
        let model = self.model.get_or_insert_with(|| Model::new(context, &picture.surface, &picture.skinning.mesh));
        if self.sheet.as_ref().is_some_and(|sheet| sheet.size() != size) {
            self.sheet = None;
        }
        let sheet = self.sheet.get_or_insert_with(|| Sheet::new(context, size));
        self.figures.fill(&picture.figures);
        self.marks.fill(picture);
        self.fans.fill(&picture.fans);
        self.floor.cast(&picture.ground, &self.figures, model);
        sheet.draw(ClearState::default(), || {
            self.floor.draw_backdrop(&light);
            self.figures.draw(model, &light, Pass::Opaque);
            self.marks.draw(&light, false);
            self.floor.draw(&picture.ground, &light);
            self.figures.draw(model, &light, Pass::Translucent);
            self.fans.draw(&light);
        });
        sheet.draw(ClearState::depth(1.0), || self.marks.draw(&light, true));
        self.printer.print(context, sheet, place);
    }
}
