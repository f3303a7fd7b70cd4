//! Text over the scene: names, status, solving time, and errors.

use aim_runtime::Status;
use aim_runtime::glam::{self, Vec3};
use eframe::egui::{self, Align2, Color32, Id, Pos2, Rect, RichText, Ui, Vec2};

use crate::actor::Actor;
use crate::gizmos::colour_of;
use crate::panel::widgets::{button, named};
use crate::picture::Colour;
use crate::stage::{SIXTIETH, Stage};
use crate::viewer::Viewer;

/// Distance from the scene's edges, points.
const MARGIN: f32 = 10.0;
/// Least width of a note, points.
const NARROWEST: f32 = 80.0;
/// Height of a figure's label, points.
const LABEL: f32 = 30.0;
/// Time for which the hint is shown, seconds.
const HINT: f64 = 8.0;
/// Duration of the hint's fading, at the end of its time, seconds.
const FADE: f64 = 2.0;

pub(crate) fn show(context: &egui::Context, scene: Rect, viewer: &mut Viewer) {
    trouble(context, viewer);
    if scene.width() < 1.0 || scene.height() < 1.0 {
        return;
    }
    let stage = &viewer.stage;
    note(context, scene, "status", Align2::LEFT_TOP, |ui| status(ui, stage, viewer.age));
    if viewer.shown.timing {
        note(context, scene, "timing", Align2::LEFT_BOTTOM, |ui| timing(ui, stage));
    }
    if stage.actors.len() > 1 {
        for (at, actor) in stage.actors.iter().enumerate() {
            label(context, scene, viewer, at, actor);
        }
    }
    if !viewer.shown.panel {
        open_panel(context, scene, viewer);
    }
}

/// Shows contents in a corner of the scene, transparent to the mouse.
fn note(context: &egui::Context, scene: Rect, id: &str, corner: Align2, contents: impl FnOnce(&mut Ui)) {
    let at = corner.pos_in_rect(&scene.shrink(MARGIN));
    area(scene, Id::new(id)).interactable(false).pivot(corner).fixed_pos(at).show(context, |ui| {
        ui.style_mut().interaction.selectable_labels = false;
        let frame = egui::Frame::new().inner_margin(8).corner_radius(6);
        frame.fill(ui.visuals().panel_fill.gamma_multiply(0.75)).show(ui, |ui| {
            ui.set_max_width((scene.width() - 4.0 * MARGIN).max(NARROWEST));
            contents(ui);
        });
    });
}

fn area(scene: Rect, id: Id) -> egui::Area {
    egui::Area::new(id).order(egui::Order::Middle).constrain_to(scene)
}

fn status(ui: &mut Ui, stage: &Stage, age: f64) {
    ui.strong(&stage.character.name);
    let shown = stage.actors.iter().filter_map(|actor| Some((actor, actor.frame.as_ref()?)));
    egui::Grid::new("status").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        for (actor, frame) in shown {
            let (name, meaning) = words(frame.outcome.status);
            ui.horizontal(|ui| {
                dot(ui, colour_of(frame.outcome.status));
                ui.label(actor.name());
            });
            ui.strong(name);
            ui.label(format!("{:.2}° off", frame.error_deg));
            ui.weak(meaning);
            ui.end_row();
        }
    });
    if stage.clock.paused {
        ui.weak("paused");
    }
    #[expect(clippy::cast_possible_truncation, reason = "an opacity")]
    let left = ((HINT - age) / FADE).clamp(0.0, 1.0) as f32;
    if left > 0.0 {
        ui.multiply_opacity(left);
        ui.weak("Drop a .glb here. Drag the target. H: the panel.");
    }
}

/// Adds a coloured dot, as high as a line of text.
pub(crate) fn dot(ui: &mut Ui, [r, g, b, _]: Colour) {
    let size = Vec2::splat(ui.text_style_height(&egui::TextStyle::Body));
    let (rect, _) = ui.allocate_exact_size(size, egui::Sense::empty());
    ui.painter().circle_filled(rect.center(), 0.3 * rect.width(), Color32::from_rgb(r, g, b));
}

/// Returns the name of a status and its meaning.
fn words(status: Status) -> (&'static str, &'static str) {
    match status {
        Status::Reached => ("reached", "on the target"),
        Status::RateLimited => ("on the way", "as fast as the rates allow"),
        Status::AtLimit => ("at a limit", "out of reach of the ranges"),
        Status::Behind => ("behind", "as the policy for targets behind says"),
        _ => ("nothing to aim", "the target is on the effector, or not finite"),
    }
}

fn timing(ui: &mut Ui, stage: &Stage) {
    let timing = stage.timing;
    let percent = timing.one / f64::from(SIXTIETH) * 100.0;
    let solving = RichText::new(format!("{:.1} µs", timing.one * 1e6)).strong();
    ui.horizontal(|ui| {
        ui.label("solving");
        ui.label(solving);
        ui.label(format!("a character, {percent:.2} % of a 60 Hz frame"));
    });
    if !stage.crowd.is_empty() {
        let all = timing.one + timing.crowd;
        ui.label(format!("crowd of {}: {:.2} ms a frame", stage.crowd.len() + 1, all * 1e3));
    }
    if timing.between > 0.0 && !stage.counts_frames {
        ui.weak(format!("{:.0} frames a second", 1.0 / timing.between));
    }
}

/// Shows a solver's name below its figure; above the figure are gazes and targets.
fn label(context: &egui::Context, scene: Rect, viewer: &Viewer, at: usize, actor: &Actor) {
    let Some(feet) = on_screen(viewer, scene, viewer.stage.character.floor + actor.shift) else { return };
    let place = feet.min(Pos2::new(f32::INFINITY, scene.bottom() - LABEL));
    if !scene.contains(place) {
        return;
    }
    let area = area(scene, Id::new(("figure", at))).interactable(false).pivot(Align2::CENTER_TOP);
    area.fixed_pos(place).show(context, |ui| {
        let frame = egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 2)).corner_radius(6);
        frame.fill(ui.visuals().panel_fill.gamma_multiply(0.75)).show(ui, |ui| {
            ui.add(egui::Label::new(RichText::new(actor.name()).strong()).selectable(false).extend());
        });
    });
}

/// Returns the screen position of a world point; `None` if it is behind the camera.
pub(crate) fn on_screen(viewer: &Viewer, scene: Rect, point: Vec3) -> Option<Pos2> {
    let seen = viewer.camera.project(point, glam::Vec2::new(scene.width(), scene.height()))?;
    Some(scene.min + Vec2::new(seen.x, seen.y))
}

/// Shows a button that opens the panel.
fn open_panel(context: &egui::Context, scene: Rect, viewer: &mut Viewer) {
    let corner = Align2::RIGHT_TOP;
    let at = corner.pos_in_rect(&scene.shrink(MARGIN));
    area(scene, Id::new("open panel")).pivot(corner).fixed_pos(at).show(context, |ui| {
        if button(ui, "«", "show the panel", "Show the panel (H).").clicked() {
            viewer.shown.panel = true;
        }
    });
}

fn trouble(context: &egui::Context, viewer: &mut Viewer) {
    let Some(text) = viewer.trouble.clone() else { return };
    let window = context.content_rect().shrink(MARGIN);
    // The text is part of the id, so that each text gets its own size.
    let area = area(window, Id::new(("trouble", &text))).order(egui::Order::Foreground);
    area.pivot(Align2::CENTER_TOP).fixed_pos(window.center_top()).show(context, |ui| {
        let red = ui.visuals().error_fg_color;
        let frame = egui::Frame::new().fill(ui.visuals().window_fill).stroke((1.5, red)).corner_radius(6);
        frame.inner_margin(10).show(ui, |ui| {
            ui.set_width((window.width() - 4.0 * MARGIN).clamp(80.0, 560.0));
            egui::ScrollArea::vertical().max_height(window.height() * 0.6).show(ui, |ui| {
                ui.add(egui::Label::new(RichText::new(text).monospace()).wrap());
            });
            ui.add_space(4.0);
            if named(ui.button("Dismiss"), "dismiss").clicked() {
                viewer.trouble = None;
            }
        });
    });
}
