//! A character that looks at the mouse.

use bevy::prelude::*;
use bevy_aim::{AimCharacter, AimPlugin, AimTarget};
use bevy_aim_examples::{Body, Pointer, Stage};

/// Distance of the pointer in front of the character, metres.
const IN_FRONT: f32 = 1.2;

pub(crate) fn plugin(app: &mut App) {
    app.add_systems(Startup, spawn).add_systems(Update, look_at_pointer);
}

fn spawn(mut commands: Commands) {
    commands.spawn((Body, AimCharacter::measured()));
}

/// Looks at the point where the pointer's ray meets a plane in front of the character, or at nothing while there is no
/// pointer.
fn look_at_pointer(pointer: Res<Pointer>, mut characters: Query<(&Transform, &mut AimTarget)>) {
    for (place, mut target) in &mut characters {
        // The mannequin faces +Z, as characters of glTF files do.
        let front = InfinitePlane3d::new(place.rotation * Vec3::Z);
        let middle = place.transform_point(Vec3::Z * IN_FRONT);
        let point = pointer.0.and_then(|ray| ray.plane_intersection_point(middle, front));
        target.set_if_neq(point.map_or_else(AimTarget::nothing, AimTarget::point));
    }
}

#[allow(dead_code, reason = "tests have an app of their own")]
fn main() {
    let stage = Stage { camera: Vec3::new(0.0, 1.65, 2.2), middle: Vec3::new(0.0, 1.5, 0.0) };
    App::new().add_plugins((stage, AimPlugin::default(), plugin)).run();
}
