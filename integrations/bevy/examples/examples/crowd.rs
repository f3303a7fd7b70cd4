//! Two thousand characters that watch a ball.

use bevy::prelude::*;
use bevy_aim::{AimCharacter, AimPlugin, AimTarget};
use bevy_aim_examples::{Ball, Body, Stage};

/// Number of characters in a row.
const ROW: u16 = 50;
/// Number of rows.
const ROWS: u16 = 40;

#[derive(Component)]
pub(crate) struct Thrown;

pub(crate) fn plugin(app: &mut App) {
    app.add_systems(Startup, spawn).add_systems(Update, fly);
}

fn spawn(mut commands: Commands) {
    let ball = commands.spawn((Ball(0.15), Thrown)).id();
    for number in 0..ROW * ROWS {
        let [column, row] = [number % ROW, number / ROW].map(f32::from);
        // Rows of a grandstand, higher towards the back.
        let place = Transform::from_xyz(0.9 * (column - f32::from(ROW) / 2.0), 0.4 * row, -1.1 * row);
        commands.spawn((Body, AimCharacter::measured(), AimTarget::entity(ball), place));
    }
}

fn fly(time: Res<Time>, mut balls: Query<&mut Transform, With<Thrown>>) {
    let t = time.elapsed_secs();
    for mut place in &mut balls {
        place.translation = Vec3::new(2.5 * (0.5 * t).sin(), 1.8 + 1.2 * (1.7 * t).sin().abs(), 3.5);
    }
}

#[allow(dead_code, reason = "tests have an app of their own")]
fn main() {
    let stage = Stage { camera: Vec3::new(0.0, 2.6, 7.0), middle: Vec3::new(0.0, 1.8, 0.0) };
    App::new().add_plugins((stage, AimPlugin::default(), plugin)).run();
}
