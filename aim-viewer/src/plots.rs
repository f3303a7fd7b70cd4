//! Error and angles over the last seconds.

use eframe::egui;

use crate::stage::Stage;

pub(crate) fn show(_ui: &mut egui::Ui, _stage: &Stage) {}
