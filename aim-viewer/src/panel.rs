//! The panel at the side: everything that can be set.

use eframe::egui;

use crate::viewer::Viewer;

pub(crate) fn show(_ui: &mut egui::Ui, _viewer: &mut Viewer) {}
