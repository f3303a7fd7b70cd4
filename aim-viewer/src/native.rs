//! The window, and pictures of it.

use std::path::PathBuf;

use eframe::egui;

use crate::app::App;

/// What to show.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A .glb, .gltf or .vrm file; the mannequin if not given.
    pub file: Option<PathBuf>,
    /// Its rig; proposed if not given.
    pub rig: Option<PathBuf>,
    /// A picture to write instead of staying open.
    pub shot: Option<Shot>,
}

/// A picture of the window.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The PNG file.
    pub out: PathBuf,
    /// After how many frames of a sixtieth of a second.
    pub frames: u32,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

/// Opens the window and stays until it is closed, or until the picture is taken.
///
/// # Errors
/// Files that cannot be used, no display, no OpenGL 3: in words.
pub fn run(options: Options) -> Result<(), String> {
    let size = options.shot.as_ref().map_or([1280, 800], |shot| shot.size);
    #[expect(clippy::cast_precision_loss, reason = "pixels")]
    let size = size.map(|side| side as f32);
    let viewport = egui::ViewportBuilder::default().with_title("aim").with_inner_size(size).with_drag_and_drop(true);
    let native = eframe::NativeOptions { viewport, multisampling: 4, depth_buffer: 24, ..Default::default() };
    let app = App::new(options.shot);
    eframe::run_native("aim", native, Box::new(|_| Ok(Box::new(app)))).map_err(|error| error.to_string())
}
