//! [`AimGizmos`]: draws how a character aims, as Bevy gizmos.

use aim::animation::{GizmoKind, GizmoLine};
use bevy_app::{App, PostUpdate};
use bevy_color::Color;
use bevy_ecs::component::Component;
use bevy_ecs::schedule::IntoScheduleConfigs;
use bevy_ecs::system::Query;
use bevy_gizmos::config::GizmoConfigStore;
use bevy_gizmos::gizmos::Gizmos;

use crate::{AimBinding, AimSystems};

/// Draws how a character aims: its gazes, the ranges of motion of its joints, and the axes of its bones. Each is drawn
/// with a length in metres, or not at all if its length is 0.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct AimGizmos {
    /// Length of the gazes, metres.
    pub gazes: f32,
    /// Distance of the outlines of the ranges of motion from their joints, metres.
    pub ranges: f32,
    /// Length of the bones' axes, metres.
    pub axes: f32,
}

impl Default for AimGizmos {
    /// Long gazes and short ranges.
    fn default() -> Self {
        Self { gazes: 2.0, ranges: 0.15, axes: 0.0 }
    }
}

pub(crate) fn build(app: &mut App) {
    if app.world().contains_resource::<GizmoConfigStore>() {
        app.add_systems(PostUpdate, draw.after(AimSystems));
    }
}

fn draw(mut gizmos: Gizmos<'_, '_>, characters: Query<'_, '_, (&AimBinding, &AimGizmos)>) {
    for (binding, of) in &characters {
        let gazes = (of.gazes > 0.0).then(|| binding.gaze_lines(of.gazes)).into_iter().flatten();
        let ranges = (of.ranges > 0.0).then(|| binding.range_lines(of.ranges)).into_iter().flatten();
        let axes = (of.axes > 0.0).then(|| binding.axis_lines(of.axes)).into_iter().flatten();
        for GizmoLine { from, to, kind } in gazes.chain(ranges).chain(axes) {
            gizmos.line(from, to, color(kind));
        }
    }
}

fn color(kind: GizmoKind) -> Color {
    match kind {
        GizmoKind::Gaze => Color::srgb(1.0, 0.85, 0.2),
        GizmoKind::OtherGaze => Color::srgb(1.0, 0.6, 0.2),
        GizmoKind::Axis { axis: 0, .. } => Color::srgb(0.9, 0.2, 0.2),
        GizmoKind::Axis { axis: 1, .. } => Color::srgb(0.2, 0.8, 0.2),
        GizmoKind::Axis { .. } => Color::srgb(0.3, 0.4, 1.0),
        _ => Color::srgb(0.3, 0.8, 0.9),
    }
}
