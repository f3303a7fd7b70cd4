//! [`Viewer`]: the contents of the window, except for the drawing itself. Tests drive it as the window does.

use std::num::NonZeroUsize;
use std::sync::Arc;

use aim_runtime::glam::{Vec2, Vec3};
use eframe::egui;
use serde_json::{Value, json};

use crate::actor::Actor;
use crate::camera::Camera;
use crate::character::Character;
use crate::controls::{self, Held};
use crate::gizmos::Shown;
use crate::panel::widgets::named;
use crate::picture::Picture;
use crate::stage::{LONGEST, Stage};
use crate::{overlay, panel, plots};

/// Greatest frame time that is accepted, seconds. The stage has a smaller limit of its own.
const LONGEST_PAUSE: f32 = 60.0;

/// Least width of a window with a panel, points.
const NARROW: f32 = 480.0;

/// The state of the window.
#[derive(Debug)]
pub(crate) struct Viewer {
    pub(crate) stage: Stage,
    pub(crate) camera: Camera,
    pub(crate) shown: Shown,
    /// The last error, until it is dismissed.
    pub(crate) trouble: Option<String>,
    /// Joint whose angles are plotted; `None` for all.
    pub(crate) plotted: Option<usize>,
    /// The notation last copied, and the viewer's age at that time, seconds.
    pub(crate) copied: Option<(&'static str, f64)>,
    /// Time since the viewer was opened, seconds.
    pub(crate) age: f64,
    /// `true` once the camera has been placed so that everything is visible.
    is_framed: bool,
    /// Rectangle of the scene in the window, points.
    scene: egui::Rect,
    held: Option<Held>,
}

impl Viewer {
    /// Creates a viewer that shows a character.
    ///
    /// # Errors
    /// If the rig's bones do not form a chain in the character.
    pub(crate) fn new(character: Character) -> Result<Self, String> {
        let stage = Stage::new(character)?;
        let camera = camera(&stage, Vec2::ONE);
        let shown = Shown::default();
        Ok(Self {
            stage,
            camera,
            shown,
            trouble: None,
            plotted: None,
            copied: None,
            age: 0.0,
            is_framed: false,
            scene: egui::Rect::ZERO,
            held: None,
        })
    }

    /// Resets the camera in the next frame, when the size of the scene is known, so that everything is visible.
    pub(crate) fn step_back(&mut self) {
        self.is_framed = false;
    }

    /// Runs one frame: input, `seconds` of time, and the interface around the scene. `paint` receives the picture and
    /// the rectangle to draw it into.
    pub(crate) fn ui(
        &mut self,
        ui: &mut egui::Ui,
        seconds: f32,
        paint: impl FnOnce(&egui::Ui, egui::Rect, Arc<Picture>),
    ) {
        let context = ui.ctx().clone();
        // The clock may run backwards or return NaN.
        let seconds = if seconds.is_nan() { 0.0 } else { seconds.clamp(0.0, LONGEST_PAUSE) };
        // Allow only one pass per frame: a second one would apply input and time again.
        context.options_mut(|options| options.max_passes = NonZeroUsize::MIN);
        context.set_theme(if self.shown.dark { egui::Theme::Dark } else { egui::Theme::Light });
        self.open_dropped(&context);
        self.age += f64::from(seconds);
        controls::keys(&context, &mut self.stage, &mut self.camera, &mut self.shown, seconds.min(LONGEST));
        // In a narrow window the scene has priority.
        if self.shown.panel && ui.available_width() >= NARROW {
            panel::show(ui, self);
        }
        if self.shown.plots {
            plots::show(ui, &self.stage, &mut self.plotted);
        }
        let scene = egui::CentralPanel::default().frame(egui::Frame::NONE).show_inside(ui, |ui| {
            let (_, scene) = ui.allocate_exact_size(ui.available_size(), egui::Sense::click_and_drag());
            let scene = named(scene, "scene");
            if !self.is_framed {
                self.camera = camera(&self.stage, Vec2::new(scene.rect.width(), scene.rect.height()));
                self.is_framed = true;
            }
            controls::mouse(&scene, &mut self.stage, &mut self.camera, &mut self.held);
            self.stage.is_sloped = self.shown.feet;
            self.stage.advance(seconds);
            let pointer = scene.hover_pos().filter(|_| self.shown.boxes).map(|at| at - scene.rect.min);
            let size = Vec2::new(scene.rect.width(), scene.rect.height());
            self.stage.point_at(pointer.map(|at| self.camera.ray(Vec2::new(at.x, at.y), size)));
            paint(ui, scene.rect, Arc::new(self.stage.picture(&self.camera, self.shown)));
            scene
        });
        self.scene = scene.inner.rect;
        overlay::show(&context, self.scene, self);
        context.request_repaint();
    }

    /// Returns a description of the scene in one line. It is deterministic for the same input.
    pub(crate) fn caption(&self) -> String {
        let one = |actor: &Actor| {
            let frame = actor.frame.as_ref()?;
            Some(format!("{} {:?}, {:.2}° off", actor.name(), frame.outcome.status, frame.error_deg))
        };
        let each: Vec<String> = self.stage.actors.iter().filter_map(one).collect();
        format!("{}: {}", self.stage.character.name, each.join("; "))
    }

    /// Returns a description of the scene as JSON. For each actor it has solver, status, error in degrees, the target
    /// in world space, and the screen positions of the target and of the gazes' ends, in points from the window's upper
    /// left corner.
    pub(crate) fn state(&self) -> String {
        // Rounded to 1e-4, so that the output is the same on every platform. Values that are not finite become null.
        let rounded = |x: f64| (x * 1e4).round() / 1e4;
        let seen = |at: Vec3| {
            let at = overlay::on_screen(self, self.scene, at)?;
            Some([at.x, at.y].map(|x| rounded(x.into())))
        };
        let one = |actor: &Actor| {
            let frame = actor.frame.as_ref()?;
            let target = self.stage.target_now() + actor.shift;
            let gaze = |[from, direction]: [Vec3; 2]| {
                let to = from + direction * from.distance(frame.target.as_vec3());
                [from, to].map(|end| seen(end + actor.shift))
            };
            Some(json!({
                "solver": actor.name(),
                "status": format!("{:?}", frame.outcome.status),
                "error_deg": rounded(frame.error_deg),
                "target": target.to_array().map(|x| rounded(x.into())),
                "target_seen": seen(target),
                "gazes_seen": actor.gazes.iter().copied().map(gaze).collect::<Vec<_>>(),
            }))
        };
        self.stage.actors.iter().filter_map(one).collect::<Value>().to_string()
    }

    /// Shows another character and resets the camera; the choice of what is shown stays. An error is stored in
    /// `trouble`.
    pub(crate) fn open(&mut self, character: Result<Character, String>) {
        match character.and_then(Stage::new) {
            Ok(stage) => {
                self.stage = stage;
                self.step_back();
                self.plotted = None;
                self.trouble = None;
            }
            Err(trouble) => self.trouble = Some(trouble),
        }
    }

    /// Opens files dropped onto the window: models, and rigs for the model that is shown.
    fn open_dropped(&mut self, context: &egui::Context) {
        let dropped = context.input(|input| input.raw.dropped_files.clone());
        let name = |file: &egui::DroppedFile| match &file.path {
            Some(path) => path.display().to_string(),
            None => file.name.clone(),
        };
        let is_rig = |file: &egui::DroppedFile| name(file).to_lowercase().ends_with(".toml");
        // A rig that is dropped together with a model belongs to that model, so models go first.
        let (rigs, models): (Vec<_>, Vec<_>) = dropped.iter().partition(|file| is_rig(file));
        for file in models.into_iter().chain(rigs) {
            let (path, name, is_rig) = (file.path.as_deref(), name(file), is_rig(file));
            let character = match (path, file.bytes.as_deref(), is_rig) {
                (Some(path), _, false) => Character::open(path, None),
                (None, Some(bytes), false) => Character::from_bytes(&name, bytes),
                (_, bytes, true) => {
                    text(&name, path, bytes).and_then(|text| self.stage.character.with_rig(&name, &text))
                }
                (None, None, false) => Err(format!("{name}: nothing of it came through; open it from a folder")),
            };
            let failed = character.is_err();
            self.open(character);
            if failed {
                // The remaining files were meant for the one that failed.
                break;
            }
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

/// Returns a camera in front and a little to the right, so that a gaze to the left is seen from the side. The upper
/// bodies of all characters and the target's whole path fit into a scene of this size.
fn camera(stage: &Stage, scene: Vec2) -> Camera {
    let room = stage.room();
    let [up, ..] = room.directions;
    let shifts: Vec<Vec3> = stage.shifts().collect();
    let yaw = if stage.actors.len() > 1 { -0.15 } else { -0.45 };
    let pitch = if stage.crowd.is_empty() { 0.1 } else { 0.3 };
    let mut camera = Camera { focus: room.centre, yaw, pitch, distance: room.metre, directions: room.directions };
    let body = [room.centre + up * (0.2 * room.metre), room.centre - up * (0.8 * room.metre)];
    let bodies = shifts.iter().flat_map(|shift| body.map(|at| at + *shift));
    let targets = stage.target.way(&room).flat_map(|at| stage.actors.iter().map(move |actor| at + actor.shift));
    let points: Vec<Vec3> = bodies.chain(targets).collect();
    camera.fit(&points, scene);
    camera
}
