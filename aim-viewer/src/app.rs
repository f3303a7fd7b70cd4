//! The application of the window: runs the viewer each frame and draws its picture to the screen.

use std::cell::RefCell;
use std::sync::Arc;

use eframe::{egui, egui_glow};

use crate::draw::{Canvas, Place};
use crate::picture::Picture;
use crate::stage::SIXTIETH;
use crate::viewer::Viewer;

thread_local! {
    // GL objects belong to the window's thread, and a paint callback must be `Send`, so it cannot own them.
    static CANVAS: RefCell<Option<Result<Canvas, String>>> = const { RefCell::new(None) };
}

/// The viewer, in a window or on a web page.
pub(crate) struct App {
    pub(crate) viewer: Viewer,
    /// Remaining number of frames of 1/60 s, after which time stands still. `None` advances by real time.
    pub(crate) frames: Option<u32>,
    pub(crate) after: After,
}

/// A callback after each frame.
pub(crate) type After = Box<dyn FnMut(&egui::Context, &Viewer)>;

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        let seconds = match &mut self.frames {
            Some(0) => 0.0,
            Some(left) => {
                *left -= 1;
                SIXTIETH
            }
            None => context.input(|input| input.unstable_dt),
        };
        self.viewer.ui(ui, seconds, paint);
        if let Some(trouble) =
            CANVAS.with_borrow(|canvas| canvas.as_ref().and_then(|canvas| canvas.as_ref().err().cloned()))
        {
            self.viewer.trouble.get_or_insert(trouble);
        }
        (self.after)(&context, &self.viewer);
    }
}

/// Adds a paint callback that draws the picture into `rect`.
fn paint(ui: &egui::Ui, rect: egui::Rect, picture: Arc<Picture>) {
    let callback = egui_glow::CallbackFn::new(move |info, painter| {
        let at = info.viewport_in_pixels();
        let size = |pixels: i32| u32::try_from(pixels).unwrap_or(0).max(1);
        let place = Place {
            x: at.left_px,
            y: at.from_bottom_px,
            width: size(at.width_px),
            height: size(at.height_px),
            screen: info.screen_size_px,
        };
        CANVAS.with_borrow_mut(|canvas| {
            if let Ok(canvas) = canvas.get_or_insert_with(|| Canvas::new(painter.gl().clone())) {
                canvas.draw(&picture, place);
            }
        });
    });
    ui.painter().add(egui::PaintCallback { rect, callback: Arc::new(callback) });
}
