//! The desktop window, and screenshots of it.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

use eframe::egui;
use image::ImageEncoder as _;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};

use crate::app::{After, App};
use crate::character::Character;
use crate::gizmos::Shown;
use crate::target::Path;
use crate::tuning::Lineup;
use crate::viewer::Viewer;

/// Options of the window.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Options {
    /// Model file, .glb, .gltf or .vrm; `None` for the mannequin.
    pub file: Option<PathBuf>,
    /// TOML file of the rig; `None` to propose one.
    pub rig: Option<PathBuf>,
    /// Name of the clip to play; `None` for the default.
    pub clip: Option<String>,
    /// Solvers to show; `None` for those that suit the rig.
    pub lineup: Option<Lineup>,
    /// Path of the target.
    pub path: Path,
    /// Number of characters; 0 is treated as 1.
    pub crowd: usize,
    /// Parts of the scene that are shown.
    pub shown: Shown,
    /// Screenshot to take, after which the window closes; `None` to stay open.
    pub shot: Option<Shot>,
}

impl Options {
    /// Returns the initial state of the window.
    fn viewer(&self) -> Result<Viewer, String> {
        let character = match &self.file {
            Some(file) => Character::open(file, self.rig.as_deref())?,
            None => Character::mannequin()?,
        };
        let clip = match &self.clip {
            Some(name) => Some(character.clip(name)?),
            None => None,
        };
        let mut viewer = Viewer::new(character)?;
        let stage = &mut viewer.stage;
        stage.clock.play.clip = clip.or(stage.clock.play.clip);
        stage.tuning.lineup = self.lineup.unwrap_or(stage.tuning.lineup);
        stage.tuning.crowd = self.crowd.max(1);
        stage.target.path = self.path;
        stage.counts_frames = self.shot.is_some();
        stage.advance(0.0);
        viewer.shown = self.shown;
        viewer.step_back();
        Ok(viewer)
    }
}

/// A screenshot of the window.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Path of the PNG file to write.
    pub out: PathBuf,
    /// Number of frames of 1/60 s before the screenshot.
    pub frames: u32,
    /// Width and height of the window, logical pixels.
    pub size: [u32; 2],
    /// `true` to return a description as JSON instead of a sentence.
    pub json: bool,
}

/// Opens the window and blocks until it is closed or the screenshot is taken. Returns the description of the
/// screenshot, or an empty string without one.
///
/// # Errors
/// A message, if a file cannot be used, there is no display or no OpenGL 3, or the window is closed before the
/// screenshot.
pub fn run(options: Options) -> Result<String, String> {
    let viewer = options.viewer()?;
    let size = options.shot.as_ref().map_or([1280, 800], |shot| shot.size);
    #[expect(clippy::cast_precision_loss, reason = "pixels")]
    let size = size.map(|side| side as f32);
    let viewport = egui::ViewportBuilder::default().with_title("aim").with_inner_size(size).with_drag_and_drop(true);
    let native = eframe::NativeOptions { viewport, ..Default::default() };
    let frames = options.shot.as_ref().map(|shot| shot.frames);
    let told = Rc::new(RefCell::new(match &options.shot {
        Some(shot) => Err(format!("{}: the window was closed before the picture was taken", shot.out.display())),
        None => Ok(String::new()),
    }));
    let after: After = match options.shot {
        Some(shot) => photographer(shot, told.clone()),
        None => Box::new(|_, _| ()),
    };
    let app = App { viewer, frames, after };
    eframe::run_native("aim", native, Box::new(|_| Ok(Box::new(app)))).map_err(|error| in_words(&error))?;
    told.replace(Ok(String::new()))
}

/// Returns an error message for a window that could not be opened.
fn in_words(error: &eframe::Error) -> String {
    const NO_OPENGL: &str = "there is no OpenGL 3 to draw with, by hardware or software";
    match error {
        eframe::Error::WinitEventLoop(_) => "no window can be opened: is there a display, and does DISPLAY or \
                                             WAYLAND_DISPLAY name it? With --screenshot none is needed"
            .into(),
        eframe::Error::Winit(error) => format!("no window can be opened: {error}"),
        eframe::Error::NoGlutinConfigs(_, error) => format!("{NO_OPENGL}: {error}"),
        other => format!("{NO_OPENGL}: {other}"),
    }
}

/// Returns a callback that waits for the frame of the screenshot, requests it, writes it, and closes the window.
fn photographer(shot: Shot, told: Rc<RefCell<Result<String, String>>>) -> After {
    let (mut frame, mut is_asked) = (0, false);
    Box::new(move |context, viewer| {
        frame += 1;
        let image = context.input(|input| {
            input.raw.events.iter().find_map(|event| match event {
                egui::Event::Screenshot { image, .. } => Some(image.clone()),
                _ => None,
            })
        });
        if let Some(image) = image {
            let (name, trouble) = (shot.out.display(), &viewer.trouble);
            let saved =
                trouble.clone().map_or_else(|| save(&image, &shot.out), |trouble| Err(format!("{name}: {trouble}")));
            let words = || if shot.json { viewer.state() } else { format!("{name}: {}", viewer.caption()) };
            *told.borrow_mut() = saved.map(|()| words());
            context.send_viewport_cmd(egui::ViewportCommand::Close);
        } else if frame > shot.frames && !std::mem::replace(&mut is_asked, true) {
            // Time stands still from here on, so it does not matter which frame is captured.
            context.send_viewport_cmd(egui::ViewportCommand::Screenshot(egui::UserData::default()));
        }
    })
}

/// Writes an image as PNG with the best compression. The file is written completely or not at all.
fn save(image: &egui::ColorImage, out: &std::path::Path) -> Result<(), String> {
    let [width, height] = image.size.map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let opaque: Vec<u8> = image.as_raw().chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(&opaque, width, height, image::ExtendedColorType::Rgb8)
        .map_err(|error| format!("{}: {error}", out.display()))?;
    aim_gltf::write_file(out, &png).map_err(|error| error.to_string())
}
