//! A conversation of three characters: the speaker looks from one listener to the other, and both look at the speaker.

use bevy::prelude::*;
use bevy_aim::{AimBinding, AimCharacter, AimPlugin, AimTarget};
use bevy_aim_examples::{Body, Stage};

/// Time for which each character speaks, seconds.
const SPEAKS_S: f32 = 4.0;
/// Time for which the speaker looks at one listener, seconds.
const LOOKS_S: f32 = 1.3;

/// The participants, in a circle, and the time since the conversation began.
#[derive(Resource)]
pub(crate) struct Conversation {
    pub(crate) people: Vec<Entity>,
    pub(crate) seconds: f32,
}

impl Conversation {
    /// Returns the speaker and the listener whom the speaker looks at.
    pub(crate) fn now(&self) -> Option<(Entity, Entity)> {
        let count = self.people.len();
        if count < 2 {
            return None;
        }
        let turn = |each: f32| (self.seconds / each) as usize;
        let speaker = turn(SPEAKS_S) % count;
        let other = (speaker + 1 + turn(LOOKS_S) % (count - 1)) % count;
        Some((self.people[speaker], self.people[other]))
    }
}

pub(crate) fn plugin(app: &mut App) {
    app.add_systems(Startup, spawn).add_systems(Update, converse);
}

fn spawn(mut commands: Commands) {
    let mut people = Vec::new();
    for place in 0..3_u8 {
        let angle = f32::from(place) * std::f32::consts::TAU / 3.0;
        let place = Transform::from_xyz(0.8 * angle.sin(), 0.0, 0.8 * angle.cos());
        // Turns the character's +Z towards the middle of the circle.
        let place = place.with_rotation(Quat::from_rotation_y(angle + std::f32::consts::PI));
        people.push(commands.spawn((Body, AimCharacter::measured(), place)).id());
    }
    commands.insert_resource(Conversation { people, seconds: 0.0 });
}

fn converse(
    time: Res<Time>,
    mut conversation: ResMut<Conversation>,
    bindings: Query<&AimBinding>,
    mut targets: Query<&mut AimTarget>,
) {
    conversation.seconds += time.delta_secs();
    let Some((speaker, listener)) = conversation.now() else { return };
    for &person in &conversation.people {
        let whom = if person == speaker { listener } else { speaker };
        // The target is the eye, which is the first joint.
        let eye = bindings.get(whom).ok().and_then(|binding| binding.joints().next());
        if let Some((eye, mut target)) = eye.zip(targets.get_mut(person).ok()) {
            target.set_if_neq(AimTarget::entity(eye));
        }
    }
}

#[allow(dead_code, reason = "tests have an app of their own")]
fn main() {
    let stage = Stage { camera: Vec3::new(0.4, 2.0, 2.6), middle: Vec3::new(0.0, 1.4, 0.0) };
    App::new().add_plugins((stage, AimPlugin::default(), plugin)).run();
}
