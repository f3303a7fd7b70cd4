//! The example `first` with an animation: the character plays the first clip of its file, such as a walk.

use bevy::prelude::*;
use bevy_aim::{AimCharacter, AimPlugin, AimTarget};

fn main() {
    let mut app = App::new();
    app.add_plugins((DefaultPlugins, AimPlugin::default()));
    app.add_systems(Startup, spawn).add_systems(Update, swing).add_observer(walk).run();
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>) {
    let camera = Transform::from_xyz(0.0, 1.6, 2.0).looking_at(Vec3::Y * 1.45, Vec3::Y);
    commands.spawn((Camera3d::default(), camera));
    let lamp = commands.spawn((PointLight { intensity: 1e5, ..default() }, Transform::default())).id();
    let hero = WorldAssetRoot(assets.load(GltfAssetLabel::Scene(0).from_asset("hero.glb")));
    commands.spawn((hero, AimCharacter::measured(), AimTarget::entity(lamp)));
}

/// The lamp swings from side to side; a ball shows where it is.
fn swing(time: Res<Time>, mut lamp: Single<&mut Transform, With<PointLight>>, mut gizmos: Gizmos) {
    lamp.translation = Vec3::new(0.7 * time.elapsed_secs().sin(), 1.7, 0.8);
    gizmos.sphere(lamp.translation, 0.05, Color::WHITE);
}

/// Repeats the first clip of the file, as soon as the scene has an animation player.
fn walk(
    added: On<Add<AnimationPlayer>>,
    mut commands: Commands,
    assets: Res<AssetServer>,
    mut graphs: ResMut<Assets<AnimationGraph>>,
    mut players: Query<&mut AnimationPlayer>,
) {
    let clip = assets.load(GltfAssetLabel::Animation(0).from_asset("hero.glb"));
    let (graph, clip) = AnimationGraph::from_clip(clip);
    commands.entity(added.entity).insert(AnimationGraphHandle(graphs.add(graph)));
    if let Ok(mut player) = players.get_mut(added.entity) {
        player.play(clip).repeat();
    }
}
