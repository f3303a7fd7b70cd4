use bevy::prelude::*;
use bevy_aim::{AimCharacter, AimPlugin, AimTarget};

fn main() {
    App::new().add_plugins((DefaultPlugins, AimPlugin::default())).add_systems(Startup, spawn).run();
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>) {
    let camera = Transform::from_xyz(0.0, 1.5, 3.0).looking_at(Vec3::Y * 1.3, Vec3::Y);
    commands.spawn((Camera3d::default(), camera));
    let lamp = commands.spawn((PointLight::default(), Transform::from_xyz(1.0, 1.7, 2.0))).id();
    let hero = WorldAssetRoot(assets.load(GltfAssetLabel::Scene(0).from_asset("hero.glb")));
    commands.spawn((hero, AimCharacter::measured(), AimTarget::entity(lamp)));
}
