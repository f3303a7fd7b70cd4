use bevy::prelude::*;
use bevy_aim::{AimCharacter, AimPlugin, AimTarget};

fn main() {
    App::new().add_plugins((DefaultPlugins, AimPlugin::default())).add_systems(Startup, spawn).run();
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>) {
    let lamp = commands.spawn(Transform::from_xyz(1.0, 1.7, 3.0)).id();
    let hero = WorldAssetRoot(assets.load(GltfAssetLabel::Scene(0).from_asset("hero.glb")));
    commands.spawn((hero, AimCharacter::measured(), AimTarget::entity(lamp)));
}
