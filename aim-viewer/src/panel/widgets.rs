//! Widgets of the panel. Every control has an accessible name, for screen readers and for tests.

use std::ops::RangeInclusive;

use eframe::egui::{self, Response, RichText, Ui};

/// Width of the column of names, points.
const NAMES: f32 = 62.0;
/// Width of the text with a slider's value, points.
const VALUE: f32 = 40.0;

/// Sets a widget's accessible name, and returns its response.
pub(crate) fn named(response: Response, name: &str) -> Response {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
    response
}

/// Shows a section that can be collapsed.
pub(super) fn group(ui: &mut Ui, heading: &str, is_open: bool, contents: impl FnOnce(&mut Ui)) {
    ui.add_space(4.0);
    let folded = egui::CollapsingHeader::new(RichText::new(heading).strong()).default_open(is_open);
    // The contents are not indented, because the headings separate the sections well enough.
    let shown = folded.show_unindented(ui, |ui| {
        contents(ui);
        ui.add_space(2.0);
    });
    named(shown.header_response, &format!("group {heading}"));
}

/// Shows a line with a name and controls. The controls may wrap to further lines.
pub(super) fn row<R>(ui: &mut Ui, name: &str, hover: &str, controls: impl FnOnce(&mut Ui) -> R) -> R {
    let line = |ui: &mut Ui| {
        let size = egui::vec2(NAMES, ui.spacing().interact_size.y);
        let label = |ui: &mut Ui| {
            ui.set_min_size(size);
            let label = ui.add(egui::Label::new(name).truncate().selectable(false));
            if !hover.is_empty() {
                label.on_hover_text(hover);
            }
        };
        ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), label);
        ui.horizontal_wrapped(controls).inner
    };
    ui.horizontal_top(line).inner
}

/// Shows a note in small text.
pub(super) fn note(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).weak().small()).wrap());
}

pub(crate) fn button(ui: &mut Ui, text: &str, name: &str, hover: &str) -> Response {
    named(ui.button(text), name).on_hover_text(hover)
}

/// Shows a choice of one of several options, `(value, name, hover text)`.
pub(super) fn choice<'a, T: PartialEq>(
    ui: &mut Ui,
    what: &str,
    chosen: &mut T,
    options: impl IntoIterator<Item = (T, &'a str, &'a str)>,
) {
    ui.spacing_mut().item_spacing.x = 3.0;
    for (option, name, hover) in options {
        let item = ui.selectable_label(*chosen == option, name);
        if named(item, &format!("{what}: {name}")).on_hover_text(hover).clicked() {
            *chosen = option;
        }
    }
}

/// Shows a checkbox. `can` says whether it is enabled, and otherwise why not.
pub(super) fn check(ui: &mut Ui, flag: &mut bool, text: &str, name: &str, can: (bool, &str), hover: &str) -> Response {
    let (enabled, why_not) = can;
    let shown = ui.add_enabled(enabled, egui::Checkbox::new(flag, text));
    named(shown, name).on_hover_text(hover).on_disabled_hover_text(why_not)
}

/// Shows a slider that fills the line, followed by its value.
pub(super) fn slider<T: egui::emath::Numeric>(
    ui: &mut Ui,
    value: &mut T,
    range: RangeInclusive<T>,
    name: &str,
    shown: impl FnOnce(T) -> String,
) {
    ui.spacing_mut().slider_width = (ui.available_width() - VALUE - ui.spacing().item_spacing.x).max(40.0);
    let slider = egui::Slider::new(value, range).show_value(false).clamping(egui::SliderClamping::Never);
    named(ui.add(slider), name);
    ui.label(shown(*value));
}
