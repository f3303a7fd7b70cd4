//! The side panel with all settings.

mod joint;
pub(crate) mod widgets;

use std::ops::RangeInclusive;

use aim_character::{Proposal, declaration};
use aim_codegen::Role;
use aim_runtime::{Behind, Solver};
use eframe::egui::{self, Ui};

use self::widgets::{button, check, choice, group, named, note, row, slider};
use crate::controls;
use crate::player::LONGEST_FADE;
use crate::stage::Stage;
use crate::target::{Path, Target};
use crate::tools::Tool;
use crate::tuning::Lineup;
use crate::viewer::Viewer;

/// Default width of the panel, points.
const WIDTH: f32 = 330.0;
/// Widths to which the panel can be resized, points.
const WIDTHS: RangeInclusive<f32> = 250.0..=460.0;
/// Range of the animation's speed; 1 is real time.
const SPEEDS: RangeInclusive<f32> = 0.0..=3.0;
/// Range of the number of characters.
const CROWD: RangeInclusive<usize> = 1..=100;
/// Range of the target's coordinates relative to the effector in the bind pose, metres of a 1.7 m character.
const PLACES: RangeInclusive<f32> = -20.0..=20.0;

pub(crate) fn show(ui: &mut Ui, viewer: &mut Viewer) {
    egui::Panel::right("panel").resizable(true).default_size(WIDTH).size_range(WIDTHS).show_inside(ui, |ui| {
        ui.add_space(6.0);
        head(ui, viewer);
        ui.separator();
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            group(ui, "Animation", true, |ui| animation(ui, &mut viewer.stage));
            group(ui, "Aiming", true, |ui| aiming(ui, &mut viewer.stage));
            group(ui, "Target", true, |ui| target(ui, &mut viewer.stage));
            group(ui, "Joints", true, |ui| joints(ui, &mut viewer.stage));
            group(ui, "Show", true, |ui| shown(ui, viewer));
            group(ui, "Rig", true, |ui| rig(ui, viewer));
            group(ui, "Help", false, help);
            ui.add_space(12.0);
        });
    });
}

fn head(ui: &mut Ui, viewer: &mut Viewer) {
    ui.horizontal(|ui| {
        let hide = |ui: &mut Ui| {
            if button(ui, "»", "hide the panel", "Hide the panel (H).").clicked() {
                viewer.shown.panel = false;
            }
            let name = egui::RichText::new(&viewer.stage.character.name).heading();
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                ui.add(egui::Label::new(name).truncate());
            });
        };
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), hide);
    });
}

fn animation(ui: &mut Ui, stage: &mut Stage) {
    let clips: Vec<String> = std::iter::once(None)
        .chain((0..stage.character.clips().len()).map(Some))
        .map(|clip| clip_name(stage, clip))
        .collect();
    let before = stage.clock.play.clip;
    row(ui, "Clip", "What the character does by itself.", |ui| {
        pick(ui, "clip", &mut stage.clock.play.clip, &clips);
    });
    if stage.clock.play.clip != before {
        stage.clock.time = 0.0;
    }
    row(ui, "Time", "Seconds since the beginning of the clip: drag to any time of it.", |ui| {
        let length = stage.clip_length();
        let mut time = stage.actors.first().map_or(0.0, |actor| actor.player.time());
        let before = time;
        slider(ui, &mut time, 0.0..=length, "time", |time| format!("{time:.2} s"));
        if time != before {
            stage.seek(time.clamp(0.0, length));
        }
    });
    row(ui, "Upper", "A clip of its own for all that hangs on the rig's innermost joint: the upper body.", |ui| {
        let mut clips = clips.clone();
        clips[0] = "as the clip".into();
        pick(ui, "upper", &mut stage.clock.play.over, &clips);
    });
    row(ui, "Fade", "Seconds from one clip to another: the old one goes on by its momentum and fades.", |ui| {
        slider(ui, &mut stage.clock.play.fade_s, 0.0..=LONGEST_FADE, "fade", |fade| format!("{fade:.2} s"));
    });
    row(ui, "", "", |ui| {
        let hover = "Without the movement of its root over the ground: as on a treadmill.";
        check(ui, &mut stage.clock.play.in_place, "In place", "in place", (true, ""), hover);
    });
    row(ui, "Speed", "Of the animation and of the target's path: 1 is real time.", |ui| {
        slider(ui, &mut stage.clock.speed, SPEEDS, "speed", |speed| format!("{speed:.2}×"));
    });
    row(ui, "", "", |ui| {
        let (text, name) = if stage.clock.paused { ("▶ Go on", "go on") } else { ("⏸ Pause", "pause") };
        if button(ui, text, name, "Pause, go on (Space).").clicked() {
            stage.clock.paused = !stage.clock.paused;
        }
        if button(ui, "⏭ Step", "step", "Pause and go on by a sixtieth of a second (.).").clicked() {
            stage.clock.paused = true;
            stage.clock.step = true;
        }
        if button(ui, "↺ Restart", "restart", "The clip and the target's path from their beginning, joints at rest.")
            .clicked()
        {
            stage.restart();
        }
    });
}

/// Shows a list of clips; the first entry means no clip.
fn pick(ui: &mut Ui, what: &str, chosen: &mut Option<usize>, clips: &[String]) {
    let at = chosen.map_or(0, |clip| clip + 1);
    let width = ui.available_width();
    let list = egui::ComboBox::from_id_salt(what).selected_text(clips.get(at).map_or("", String::as_str));
    let shown = list.width(width).truncate().show_ui(ui, |ui| {
        for (entry, name) in clips.iter().enumerate() {
            let item = ui.selectable_label(entry == at, name);
            if named(item, &format!("{what}: {name}")).clicked() {
                *chosen = entry.checked_sub(1);
            }
        }
    });
    named(shown.response, what);
}

fn clip_name(stage: &Stage, clip: Option<usize>) -> String {
    match clip.and_then(|clip| Some((clip, stage.character.clips().get(clip)?))) {
        None => "rest pose".into(),
        Some((at, clip)) if clip.name().is_empty() => format!("clip {}", at + 1),
        Some((_, clip)) => clip.name().to_owned(),
    }
}

fn aiming(ui: &mut Ui, stage: &mut Stage) {
    let crowded = stage.tuning.crowd > 1;
    row(ui, "Solver", "What turns a target to joint angles.", |ui| {
        let hover = |lineup| match lineup {
            Lineup::One(Solver::Natural) => "Eyes leap to the target, head and spine follow as people's do.",
            Lineup::One(Solver::Exact) => "All joints at once: the least stiffness-weighted displacement.",
            Lineup::One(_) => "The paper's steepest ascent, joint by joint.",
            Lineup::All => "All three, each with a figure and a target of its own.",
        };
        choice(ui, "solver", &mut stage.tuning.lineup, Lineup::EACH.map(|each| (each, each.name(), hover(each))));
    });
    if crowded && stage.tuning.lineup == Lineup::All {
        note(ui, "A crowd has one solver: the natural one.");
    }
    row(ui, "Instead", "A solver of one bone, of a chain or of poses in place of the rig's (T: the next).", |ui| {
        let hover = |tool| match tool {
            Tool::LookAt => "The head alone, as it sits on its neck: 70° to either side, 230° a second.",
            Tool::OneBone => "Each eye by itself, at once and without limits, or what the rig aims.",
            Tool::Ccd => {
                "The right hand reaches for the target by arm and chest; without a hand the head by the trunk."
            }
            Tool::AimPoses => "Between fifteen poses that the rig has made itself, three by five.",
        };
        let none = (None, "none", "The rig's solver.");
        let tools = Tool::ALL.map(|tool| (Some(tool), tool.name(), hover(tool)));
        choice(ui, "instead", &mut stage.tuning.tool, std::iter::once(none).chain(tools));
    });
    let climbs = stage.tuning.lineup.solvers().contains(&Solver::Ascent);
    row(ui, "", "", |ui| {
        let why = "Choose the ascent, or side by side.";
        let hover = "The ascent without what was added to it since: as its paper has it.";
        check(ui, &mut stage.tuning.as_published, "As published", "as published", (climbs, why), hover);
    });
    row(ui, "Effector", "What is aimed (E).", |ui| {
        let joints = &stage.tuning.spec.joints;
        let name = |at: usize| match (at, joints[at].role) {
            (0, Role::Eye) => "eyes",
            _ => joints[at].name.as_str(),
        };
        let options: Vec<_> =
            (0..joints.len()).map(|at| (at, name(at), "Aim this one; those outward of it rest.")).collect();
        choice(ui, "effector", &mut stage.tuning.settings.effector, options);
    });
    let has_pair = stage.character.chain.other_eye.is_some();
    row(ui, "", "", |ui| {
        let why = "The rig names no other eye as a pair.";
        let hover = "The other eye is aimed itself, so that both meet the target; else it turns as the first does.";
        check(ui, &mut stage.tuning.both_eyes, "Both eyes", "both eyes", (has_pair, why), hover);
    });
    let share = |share: f32| format!("{:.0} %", share * 100.0);
    row(ui, "Weight", "How much of the way from the animation to the target: 0 leaves the animation.", |ui| {
        slider(ui, &mut stage.tuning.settings.weight, 0.0..=1.0, "weight", share);
    });
    row(
        ui,
        "Attention",
        "How much the head comes along in a natural gaze: at 100 % it ends up facing the target.",
        |ui| {
            slider(ui, &mut stage.tuning.settings.attention, 0.0..=1.0, "attention", share);
        },
    );
    row(ui, "Behind", "What becomes of a target behind the character.", |ui| {
        let policies = [
            (Behind::Off, "off", "No policy: as near as the joints come, on the side they are on."),
            (Behind::Clip, "clip", "Turn to the edge of what is in reach, on the target's side."),
            (Behind::Plane, "plane", "Turn to it as a plane in front has it: back through the front."),
            (Behind::Hold, "hold", "Stay as it is."),
            (Behind::Release, "release", "Return to the animation."),
        ];
        choice(ui, "behind", &mut stage.tuning.settings.behind, policies);
    });
    row(ui, "Crowd", "How many characters look at the target.", |ui| {
        slider(ui, &mut stage.tuning.crowd, CROWD, "crowd", |crowd| crowd.to_string());
    });
}

fn target(ui: &mut Ui, stage: &mut Stage) {
    let room = stage.room();
    row(ui, "Path", "How the target moves.", |ui| {
        let hover = |path| match path {
            Path::Still => "It stays where it is.",
            Path::Orbit => "Around the character.",
            Path::Eight => "An eight on its side, in front of the character.",
            Path::Noise => "Here and there, in front of the character.",
        };
        let mut path = stage.target.path;
        choice(ui, "path", &mut path, Path::ALL.map(|path| (path, path.name(), hover(path))));
        stage.target.follow(&room, path);
    });
    row(ui, "Place", "From the effector of the bind pose, metres of a character of 1.7 m.", |ui| {
        let mut place = room.place(stage.target_now());
        let mut moved = false;
        let width = (ui.available_width() - 2.0 * ui.spacing().item_spacing.x) / 3.0;
        for (metres, (text, name)) in place.iter_mut().zip([("left ", "left"), ("up ", "up"), ("front ", "front")]) {
            let value = egui::DragValue::new(metres).speed(0.01).fixed_decimals(2).prefix(text).range(PLACES);
            let field = ui.add_sized([width, ui.spacing().interact_size.y], value.clamp_existing_to_range(false));
            moved |= named(field, &format!("target {name}")).on_hover_text(format!("Metres, {name}.")).changed();
        }
        if moved {
            let [left, up, forward] = place;
            stage.target = Target { place: room.point(left, up, forward), path: Path::Still, ..stage.target };
        }
    });
    row(ui, "", "", |ui| {
        if button(ui, "↺ Reset", "reset the target", "Where it was at first, still.").clicked() {
            stage.target = Target::new(&room);
        }
    });
}

fn joints(ui: &mut Ui, stage: &mut Stage) {
    let declared = &stage.character.declared.spec.joints;
    for (joint, declared) in stage.tuning.spec.joints.iter_mut().zip(declared) {
        joint::show(ui, joint, declared);
    }
}

fn shown(ui: &mut Ui, viewer: &mut Viewer) {
    let has = [viewer.stage.lamp.is_some(), viewer.stage.feet.is_some()];
    let shown = &mut viewer.shown;
    let flags = [
        (&mut shown.gaze, "Gaze", "Rays from the eyes, as far as the target is away."),
        (&mut shown.limits, "Limits", "Each joint's range of motion, as a cone."),
        (&mut shown.axes, "Reference frames", "Each bone's own X, Y and Z (Q on, A off)."),
        (&mut shown.boxes, "Boxes", "The box of each bone; the mouse points at the triangle that it is over (B)."),
        (&mut shown.lamp, "Lamp", "A lamp in the right hand (G)."),
        (&mut shown.feet, "Slope", "A sloped floor, and feet planted on it (F)."),
        (&mut shown.trail, "Trail", "Where the target has been."),
        (&mut shown.plots, "Plots", "Error and angles over time."),
        (&mut shown.timing, "Timing", "How long solving takes."),
        (&mut shown.dark, "Dark", "On dark ground."),
    ];
    ui.columns(2, |columns| {
        for (at, (flag, name, hover)) in flags.into_iter().enumerate() {
            let can = match name {
                "Lamp" => (has[0], "No right hand is told by the names of the bones."),
                "Slope" => (has[1], "No feet are told by the names of the bones."),
                _ => (true, ""),
            };
            check(&mut columns[at % 2], flag, name, &format!("show {}", name.to_lowercase()), can, hover);
        }
    });
    if button(ui, "Reset the view", "reset the view", "The camera back to where it was at first.").clicked() {
        viewer.step_back();
    }
}

fn rig(ui: &mut Ui, viewer: &mut Viewer) {
    let stage = &viewer.stage;
    ui.horizontal_wrapped(|ui| {
        for (notation, text) in
            [("Rust", declared_as(stage, declaration::rust)), ("TOML", declared_as(stage, declaration::toml))]
        {
            let hover = "The rig as it is set now, ranges, rates and stiffness, to the clipboard.";
            if button(ui, &format!("Copy as {notation}"), &format!("copy as {notation}"), hover).clicked() {
                ui.ctx().copy_text(text);
                viewer.copied = Some((notation, viewer.age));
            }
        }
        if let Some((notation, _)) = viewer.copied.filter(|(_, at)| viewer.age - at < 2.5) {
            ui.weak(format!("✔ {notation} copied"));
        }
    });
}

/// Returns the rig with its present settings, in one of the two notations.
fn declared_as(stage: &Stage, notation: fn(&Proposal, &str) -> String) -> String {
    let Proposal { reasons, .. } = &stage.character.declared;
    let now = Proposal { spec: stage.tuning.spec.clone(), reasons: reasons.clone() };
    notation(&now, &format!("The rig of {}, as it was set in the viewer.", stage.character.name))
}

fn help(ui: &mut Ui) {
    egui::Grid::new("keys").num_columns(2).spacing([14.0, 4.0]).show(ui, |ui| {
        for (keys, what) in controls::KEYS.into_iter().chain(controls::MOUSE) {
            ui.label(egui::RichText::new(keys).strong());
            ui.add(egui::Label::new(what).wrap());
            ui.end_row();
        }
    });
    note(
        ui,
        "Drop a model (.glb, .gltf, .vrm) onto the window to open it, or a rig (.toml) for the model that is shown.",
    );
}
