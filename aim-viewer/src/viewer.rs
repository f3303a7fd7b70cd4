//! [`Viewer`]: all that the window shows but the drawing itself. Tests drive it as the window does.

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

/// Longest time of a frame, seconds.
const LONGEST_PAUSE: f32 = 60.0;

/// A window narrower than this has no room for the panel, points.
const NARROW: f32 = 480.0;

/// The state of the window.
#[derive(Debug)]
pub(crate) struct Viewer {
    pub(crate) stage: Stage,
    pub(crate) camera: Camera,
    pub(crate) shown: Shown,
    /// The last error, until it is dismissed.
    pub(crate) trouble: Option<String>,
    /// Of which joint the angles are plotted; of all if of none.
    pub(crate) plotted: Option<usize>,
    /// The notation copied last, and the time of that.
    pub(crate) copied: Option<(&'static str, f64)>,
    /// Seconds since it was opened.
    pub(crate) age: f64,
    /// True once the camera has been placed so that all is in sight.
    is_framed: bool,
    /// Rectangle of the scene, points.
    scene: egui::Rect,
    held: Option<Held>,
}

impl Viewer {
    /// A window onto a character.
    ///
    /// # Errors
    /// A rig whose bones are no chain of the character.
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

    /// The camera where all is in sight, as soon as it is known how much room the scene has.
    pub(crate) fn step_back(&mut self) {
        self.is_framed = false;
    }

    /// One frame: input, `seconds` of time, and what is around the scene. `paint` is told what to draw where.
    pub(crate) fn ui(
        &mut self,
        ui: &mut egui::Ui,
        seconds: f32,
        paint: impl FnOnce(&egui::Ui, egui::Rect, Arc<Picture>),
    ) {
        let context = ui.ctx().clone();
        // Also where a clock goes backwards, or tells nothing.
        let seconds = if seconds.is_nan() { 0.0 } else { seconds.clamp(0.0, LONGEST_PAUSE) };
        // A frame is one pass: another would take its input and its time again.
        context.options_mut(|options| options.max_passes = NonZeroUsize::MIN);
        context.set_theme(if self.shown.dark { egui::Theme::Dark } else { egui::Theme::Light });
        self.open_dropped(&context);
        self.age += f64::from(seconds);
        controls::keys(&context, &mut self.stage, &mut self.camera, &mut self.shown, seconds.min(LONGEST));
        // In a narrow window the scene comes first.
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

    /// Description of the scene in words, the same for the same input.
    pub(crate) fn caption(&self) -> String {
        let one = |actor: &Actor| {
            let frame = actor.frame.as_ref()?;
            Some(format!("{} {:?}, {:.2}° off", actor.name(), frame.outcome.status, frame.error_deg))
        };
        let each: Vec<String> = self.stage.actors.iter().filter_map(one).collect();
        format!("{}: {}", self.stage.character.name, each.join("; "))
    }

    /// The same as JSON, for programs: each actor's solver, status and error, degrees, where its target and its gazes'
    /// ends are in the world and, in points from the window's upper left, on the screen.
    pub(crate) fn state(&self) -> String {
        // Ten-thousandths are the same wherever it runs; what is not finite becomes null.
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

    /// Another character, seen from where its face is; what is shown stays.
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

    /// Files dropped onto the window: a model, or a rig for the one that is shown.
    fn open_dropped(&mut self, context: &egui::Context) {
        let dropped = context.input(|input| input.raw.dropped_files.clone());
        let name = |file: &egui::DroppedFile| match &file.path {
            Some(path) => path.display().to_string(),
            None => file.name.clone(),
        };
        let is_rig = |file: &egui::DroppedFile| name(file).to_lowercase().ends_with(".toml");
        // A rig that comes with a model is that model's.
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
                // What came with it was meant for it.
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

/// In front and a little to the right, so that a gaze to the left is seen from the side: the upper bodies of all, and the
/// target on all of its path, fill a scene of this shape.
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
