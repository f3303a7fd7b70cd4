//! A turret that follows a ball and fires while it aims at it.

use aim::{AimRig, Joint};
use bevy::prelude::*;
use bevy_aim::{AimCharacter, AimOutcome, AimPlugin, AimTarget};
use bevy_aim_examples::{Ball, Block, Stage};

/// A base that turns without limits, and a barrel that pitches on it. Both point along +Z.
#[derive(AimRig)]
#[aim(axes(up = +Y, forward = +Z, left = +X))]
pub(crate) struct Turret {
    #[joint(bone = "barrel", pitch = -5deg..=80deg, rate = 70deg)]
    pub(crate) barrel: Joint,
    #[joint(bone = "base", heading = free, rate = 110deg)]
    pub(crate) base: Joint,
}

/// Time until the turret may fire again, and the number of its shots.
#[derive(Component, Default)]
pub(crate) struct Gun {
    wait_s: f32,
    pub(crate) shots: usize,
}

/// Marks the ball that flies in circles.
#[derive(Component)]
pub(crate) struct Drone;

pub(crate) fn plugin(app: &mut App) {
    app.add_systems(Startup, spawn).add_systems(Update, (fly, fire));
}

fn spawn(mut commands: Commands) {
    let drone = commands.spawn((Ball(0.15), Drone)).id();
    let block = |size: Vec3, middle: Vec3| Block { size, middle };
    commands
        .spawn((AimCharacter::of::<Turret>(), AimTarget::entity(drone), Gun::default(), Transform::IDENTITY))
        .with_children(|turret| {
            turret.spawn((Name::new("base"), block(Vec3::new(0.8, 0.5, 0.8), Vec3::Y * 0.25))).with_children(|base| {
                let at = Transform::from_xyz(0.0, 0.6, 0.0);
                base.spawn((Name::new("barrel"), block(Vec3::new(0.15, 0.15, 1.2), Vec3::Z * 0.5), at));
            });
        });
}

fn fly(time: Res<Time>, mut drones: Query<&mut Transform, With<Drone>>) {
    let t = time.elapsed_secs();
    for mut place in &mut drones {
        place.translation = Vec3::new(4.0 * (0.6 * t).sin(), 2.0 + (1.1 * t).sin(), 4.0 * (0.6 * t).cos());
    }
}

fn fire(time: Res<Time>, mut turrets: Query<(&AimOutcome, &mut Gun)>) {
    for (outcome, mut gun) in &mut turrets {
        gun.wait_s -= time.delta_secs();
        if outcome.status.is_reached() && gun.wait_s <= 0.0 {
            gun.wait_s = 0.5;
            gun.shots += 1;
            println!("It fires.");
        }
    }
}

#[allow(dead_code, reason = "tests have an app of their own")]
fn main() {
    let stage = Stage { camera: Vec3::new(5.0, 3.0, 6.0), middle: Vec3::new(0.0, 1.0, 0.0) };
    App::new().add_plugins((stage, AimPlugin::default(), plugin)).run();
}
