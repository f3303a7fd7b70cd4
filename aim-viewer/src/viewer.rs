//! [`Viewer`]: all that the window shows but the drawing itself. Tests drive it as the window does.

use std::num::NonZeroUsize;
use std::sync::Arc;

use eframe::egui;

use crate::camera::Camera;
use crate::character::Character;
use crate::controls::{self, Held};
use crate::gizmos::Shown;
use crate::picture::Picture;
use crate::stage::{Actor, LONGEST, Stage, solver_name};
use crate::{overlay, panel, plots};

/// The state of the window.
#[derive(Debug)]
pub(crate) struct Viewer {
    pub(crate) stage: Stage,
    pub(crate) camera: Camera,
    pub(crate) shown: Shown,
    /// What went wrong last, until it is dismissed.
    pub(crate) trouble: Option<String>,
    /// Of which joint the angles are plotted; of all if of none.
    pub(crate) plotted: Option<usize>,
    /// What was copied last, and when.
    pub(crate) copied: Option<(&'static str, f64)>,
    /// Seconds since it was opened.
    pub(crate) age: f64,
    held: Option<Held>,
}

impl Viewer {
    pub(crate) fn new(character: Character) -> Self {
        let stage = Stage::new(character);
        let camera = camera(&stage);
        let shown = Shown::default();
        Self { stage, camera, shown, trouble: None, plotted: None, copied: None, age: 0.0, held: None }
    }

    /// The camera where all is in sight.
    pub(crate) fn step_back(&mut self) {
        self.camera = camera(&self.stage);
    }

    /// One frame: input, `seconds` of time, and what is around the scene. `paint` is told what to draw where.
    pub(crate) fn ui(
        &mut self,
        ui: &mut egui::Ui,
        seconds: f32,
        paint: impl FnOnce(&egui::Ui, egui::Rect, Arc<Picture>),
    ) {
        let context = ui.ctx().clone();
        // A frame is one pass: another would take its input and its time again.
        context.options_mut(|options| options.max_passes = NonZeroUsize::MIN);
        context.set_theme(if self.shown.dark { egui::Theme::Dark } else { egui::Theme::Light });
        self.open_dropped(&context);
        self.age += f64::from(seconds);
        controls::keys(&context, &mut self.stage, &mut self.camera, &mut self.shown, seconds.min(LONGEST));
        if self.shown.panel {
            panel::show(ui, self);
        }
        if self.shown.plots {
            plots::show(ui, &self.stage, &mut self.plotted);
        }
        let scene = egui::CentralPanel::default().frame(egui::Frame::NONE).show_inside(ui, |ui| {
            let (_, scene) = ui.allocate_exact_size(ui.available_size(), egui::Sense::click_and_drag());
            controls::mouse(&scene, &mut self.stage, &mut self.camera, &mut self.held);
            self.stage.advance(seconds);
            paint(ui, scene.rect, Arc::new(self.stage.picture(&self.camera, self.shown)));
            scene
        });
        overlay::show(&context, scene.inner.rect, self);
        context.request_repaint();
    }

    /// What there is to see, in words: frame by frame the same for the same input.
    pub(crate) fn caption(&self) -> String {
        let one = |actor: &Actor| {
            let frame = actor.frame.as_ref()?;
            Some(format!("{} {:?}, {:.2}° off", solver_name(actor.solver), frame.outcome.status, frame.error_deg))
        };
        let each: Vec<String> = self.stage.actors.iter().filter_map(one).collect();
        format!("{}: {}", self.stage.character.name, each.join("; "))
    }

    /// The same as JSON, for programs.
    pub(crate) fn state(&self) -> String {
        let number = |x: f64| if x.is_finite() { format!("{x:.4}") } else { "null".into() };
        let errors = self.stage.actors.iter().filter_map(|actor| actor.frame.as_ref());
        let errors: Vec<String> = errors.map(|frame| number(frame.error_deg)).collect();
        let status = self.stage.first().map_or_else(String::new, |frame| format!("{:?}", frame.outcome.status));
        let target = self.stage.target_now().to_array().map(|c| number(c.into()));
        format!(r#"{{"status":"{status}","error_deg":[{}],"target":[{}]}}"#, errors.join(","), target.join(","))
    }

    /// Another character, seen from where its face is; what is shown stays.
    pub(crate) fn open(&mut self, character: Result<Character, String>) {
        match character {
            Ok(character) => {
                self.stage = Stage::new(character);
                self.step_back();
                self.plotted = None;
                self.trouble = None;
            }
            Err(trouble) => self.trouble = Some(trouble),
        }
    }

    /// Files dropped onto the window: a model, or a rig for the one that is shown.
    fn open_dropped(&mut self, context: &egui::Context) {
        let dropped = context.input(|input| input.raw.dropped_files.clone());
        for file in dropped {
            let path = file.path.as_deref();
            let name = path.map_or(file.name.clone(), |path| path.display().to_string());
            let is_rig = name.to_lowercase().ends_with(".toml");
            let character = match (path, file.bytes.as_deref(), is_rig) {
                (Some(path), _, false) => Character::open(path, None),
                (None, Some(bytes), false) => Character::from_bytes(&name, bytes),
                (_, bytes, true) => {
                    text(&name, path, bytes).and_then(|text| self.stage.character.with_rig(&name, &text))
                }
                (None, None, false) => Err(format!("{name}: nothing of it came through; open it from a folder")),
            };
            self.open(character);
        }
    }
}

fn text(name: &str, path: Option<&std::path::Path>, bytes: Option<&[u8]>) -> Result<String, String> {
    let bytes = match (bytes, path) {
        (Some(bytes), _) => bytes.to_vec(),
        (None, Some(path)) => std::fs::read(path).map_err(|error| format!("{name}: {error}"))?,
        (None, None) => Vec::new(),
    };
    String::from_utf8(bytes).map_err(|_| format!("{name}: is no text; drop a rig's TOML file"))
}

/// In front and a little to the right, so that a gaze to the left is seen from the side: the upper bodies of all actors and
/// the target in sight, a crowd from further away.
fn camera(stage: &Stage) -> Camera {
    let room = stage.room();
    let (wide, many) = (stage.actors.len() > 1, !stage.crowd.is_empty());
    let (focus, distance, pitch) = match (many, wide) {
        (true, _) => (room.point(0.0, -0.5, -2.0), 11.0, 0.3),
        (_, true) => (room.point(0.2, -0.35, 0.3), 4.4, 0.12),
        _ => (room.point(0.25, -0.22, 0.3), 2.9, 0.1),
    };
    Camera {
        focus,
        yaw: if wide { -0.15 } else { -0.45 },
        pitch,
        distance: distance * room.metre,
        directions: room.directions,
    }
}
