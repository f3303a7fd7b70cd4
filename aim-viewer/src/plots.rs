//! Plots of the error and the angles over the last seconds.

use aim_character::range_in_frame;
use aim_codegen::JointSpec;
use eframe::egui::{self, Color32, Ui};
use egui_plot::{AxisHints, HLine, Line, LineStyle, Plot, PlotPoints, PlotUi};

use crate::gizmos;
use crate::overlay;
use crate::panel::widgets::named;
use crate::picture::Colour;
use crate::stage::{Memory, Stage};

/// Length of the time axis, seconds.
const PAST: f64 = 10.0;
/// Least width and height of the available space for which plots are shown, points.
const LEAST: [f32; 2] = [360.0, 300.0];

/// Shows the plots. `chosen` is the joint whose angles are plotted, or `None` for all.
pub(crate) fn show(ui: &mut Ui, stage: &Stage, chosen: &mut Option<usize>) {
    // With less space, there is no room for both the scene and the plots.
    if ui.available_width() < LEAST[0] || ui.available_height() < LEAST[1] {
        return;
    }
    egui::Panel::bottom("plots").resizable(true).default_size(168.0).size_range(110.0..=420.0).show_inside(ui, |ui| {
        ui.add_space(4.0);
        ui.columns(2, |columns| {
            error(&mut columns[0], stage);
            angles(&mut columns[1], stage, chosen);
        });
    });
}

fn error(ui: &mut Ui, stage: &Stage) {
    ui.horizontal(|ui| {
        ui.strong("Error");
        for actor in &stage.actors {
            overlay::dot(ui, gizmos::colour_of_solver(actor.solver));
            ui.label(actor.name());
        }
    });
    plot("error", "off the target [°]").include_y(0.0).include_y(1.0).show(ui, |plot| {
        set_time(plot);
        for (at, actor) in stage.actors.iter().enumerate() {
            let name = actor.name();
            let points = points(stage, |memory| memory.error_deg.get(at).copied());
            plot.line(Line::new(name, points).color(colour(gizmos::colour_of_solver(actor.solver))).width(1.6));
        }
    });
}

fn angles(ui: &mut Ui, stage: &Stage, chosen: &mut Option<usize>) {
    let joints = &stage.tuning.spec.joints;
    ui.horizontal_wrapped(|ui| {
        ui.strong("Angles");
        let each = joints.iter().enumerate().map(|(at, joint)| (Some(at), joint.name.as_str()));
        for (which, name) in std::iter::once((None, "all")).chain(each) {
            if let Some(at) = which {
                overlay::dot(ui, gizmos::colour_of_joint(at));
            }
            let item = ui.selectable_label(*chosen == which, name);
            let item = named(item, &format!("plot: {name}"));
            if item.on_hover_text("Whose heading (solid), pitch (dotted) and limits (dashed) are plotted.").clicked() {
                *chosen = which;
            }
        }
    });
    let chosen = *chosen;
    let is_chosen = move |at: usize| chosen.is_none_or(|chosen| chosen == at);
    let grid = egui_plot::uniform_grid_spacer(|_| [90.0, 30.0, 10.0]);
    plot("angles", "added [°]").y_grid_spacer(grid).show(ui, |plot| {
        set_time(plot);
        for (at, joint) in joints.iter().enumerate().filter(|(at, _)| is_chosen(*at)) {
            let colour = colour(gizmos::colour_of_joint(at));
            limits(plot, stage, at, joint, colour.gamma_multiply(if chosen.is_some() { 0.8 } else { 0.4 }));
            let ways =
                [(joint.heading, "heading", LineStyle::Solid), (joint.pitch, "pitch", LineStyle::dotted_dense())];
            for (way, (range, name, style)) in ways.into_iter().enumerate() {
                if range.is_some() {
                    let points = points(stage, |memory| Some(memory.angles_deg.get(at)?[way]));
                    let name = format!("{} {name}", joint.name);
                    plot.line(Line::new(name, points).color(colour).style(style).width(1.6));
                }
            }
        }
    });
}

/// Plots the ends of a joint's range, relative to the animation as the plotted angles are.
fn limits(plot: &mut PlotUi<'_>, stage: &Stage, at: usize, joint: &JointSpec, colour: Color32) {
    let Some(frame) = stage.first().and_then(|frame| frame.joints.get(at)) else { return };
    let declared = [(joint.heading, 10.0), (joint.pitch, 4.0)];
    for ((declared, length), ends) in declared.into_iter().zip(range_in_frame(joint, frame)) {
        for end in ends.into_iter().filter(|end| declared.is_some() && end.is_finite()) {
            let line = HLine::new("limit", end.to_degrees()).allow_hover(false);
            plot.hline(line.color(colour).style(LineStyle::Dashed { length }).width(1.0));
        }
    }
}

/// Returns a plot without interaction by scrolling or dragging.
fn plot<'a>(name: &str, y: &str) -> Plot<'a> {
    Plot::new(name)
        .custom_x_axes(vec![AxisHints::new_x().label("time [s]").label_spacing(16.0..=24.0)])
        .custom_y_axes(vec![AxisHints::new_y().label(y).label_spacing(10.0..=16.0).min_thickness(28.0)])
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_crosshair(false)
        .sense(egui::Sense::hover())
}

fn set_time(plot: &mut PlotUi<'_>) {
    plot.set_plot_bounds_x(-PAST..=0.0);
}

/// Returns the points of a value over the time before the present, seconds.
fn points<'a>(stage: &Stage, value: impl Fn(&Memory) -> Option<f64>) -> PlotPoints<'a> {
    let now = stage.memory.back().map_or(0.0, |memory| memory.t);
    let recent = stage.memory.iter().filter(|memory| now - memory.t <= PAST);
    recent.filter_map(|memory| Some([memory.t - now, value(memory)?])).collect()
}

fn colour([r, g, b, _]: Colour) -> Color32 {
    Color32::from_rgb(r, g, b)
}
