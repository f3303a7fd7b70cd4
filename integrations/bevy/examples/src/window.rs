//! A window.

use std::path::PathBuf;
use std::time::Duration;

use aim_character::{PAPER_AXES, mannequin};
use bevy::camera::Camera3d;
use bevy::prelude::*;
use bevy::render::view::screenshot::{Screenshot, save_to_disk};
use bevy::time::TimeUpdateStrategy;
use bevy::window::PrimaryWindow;

use crate::{Ball, Block, Body, Pointer, Stage};

#[derive(Resource)]
struct View(Stage);

pub(crate) fn build(stage: Stage, app: &mut App) {
    // Beside the program, so that nothing is written into the checkout.
    let folder = std::env::temp_dir().join("bevy_aim_examples");
    let file = mannequin(|_| PAPER_AXES).expect("axes at right angles");
    std::fs::create_dir_all(&folder).and_then(|()| std::fs::write(folder.join("mannequin.glb"), file)).expect("a file");
    let assets = AssetPlugin { file_path: folder.to_string_lossy().into_owned(), ..default() };
    app.add_plugins(DefaultPlugins.set(assets));
    app.insert_resource(View(stage));
    app.add_observer(bodies).add_observer(balls).add_observer(blocks);
    app.add_systems(Startup, furnish);
    app.add_systems(PreUpdate, point);
    if let Some(picture) = std::env::var_os("AIM_SCREENSHOT") {
        let picture = PathBuf::from(picture);
        let shoot = move |mut commands: Commands, mut frame: Local<u32>, mut exit: MessageWriter<AppExit>| {
            *frame += 1;
            if *frame == 240 {
                commands.spawn(Screenshot::primary_window()).observe(save_to_disk(picture.clone()));
            }
            if *frame == 280 {
                exit.write(AppExit::Success);
            }
        };
        // Sixty frames a second, however long each takes to be drawn.
        let step = TimeUpdateStrategy::ManualDuration(Duration::from_secs(1) / 60);
        app.insert_resource(step).add_systems(Update, shoot);
    }
}

fn furnish(
    mut commands: Commands,
    view: Res<View>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let Stage { camera, middle } = view.0;
    commands.spawn((Camera3d::default(), Transform::from_translation(camera).looking_at(middle, Vec3::Y)));
    let light = DirectionalLight { shadow_maps_enabled: true, ..default() };
    commands.spawn((light, Transform::from_xyz(2.0, 6.0, 5.0).looking_at(Vec3::Y, Vec3::Y)));
    let floor = meshes.add(Plane3d::default().mesh().size(200.0, 200.0));
    commands.spawn((Mesh3d(floor), MeshMaterial3d(materials.add(Color::srgb(0.35, 0.4, 0.45)))));
}

fn bodies(added: On<Add<Body>>, mut commands: Commands, assets: Res<AssetServer>) {
    let scene = WorldAssetRoot(assets.load(GltfAssetLabel::Scene(0).from_asset("mannequin.glb")));
    commands.entity(added.entity).insert(scene);
}

fn balls(
    added: On<Add<Ball>>,
    balls: Query<&Ball>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let Ok(ball) = balls.get(added.entity) else { return };
    let material = materials.add(StandardMaterial {
        base_color: Color::srgb(1.0, 0.75, 0.2),
        emissive: LinearRgba::rgb(2.0, 1.2, 0.2),
        ..default()
    });
    commands.entity(added.entity).insert((Mesh3d(meshes.add(Sphere::new(ball.0))), MeshMaterial3d(material)));
}

fn blocks(
    added: On<Add<Block>>,
    blocks: Query<&Block>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let Ok(block) = blocks.get(added.entity) else { return };
    let mesh = meshes.add(Cuboid::from_size(block.size).mesh().build().translated_by(block.middle));
    commands.entity(added.entity).insert((Mesh3d(mesh), MeshMaterial3d(materials.add(Color::srgb(0.5, 0.55, 0.5)))));
}

fn point(
    windows: Query<&Window, With<PrimaryWindow>>,
    cameras: Query<(&Camera, &GlobalTransform)>,
    mut pointer: ResMut<Pointer>,
) {
    let cursor = windows.single().ok().and_then(Window::cursor_position);
    let ray = |cursor: Vec2| cameras.iter().find_map(|(camera, place)| camera.viewport_to_world(place, cursor).ok());
    pointer.0 = cursor.and_then(ray);
}
