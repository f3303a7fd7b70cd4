//! What is written over the scene: names, status, how long solving takes, and trouble.

use eframe::egui;

use crate::viewer::Viewer;

pub(crate) fn show(_context: &egui::Context, _scene: egui::Rect, _viewer: &mut Viewer) {}
