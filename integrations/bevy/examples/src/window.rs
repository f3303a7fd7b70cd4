//! The stage in a window.

use std::path::PathBuf;
use std::time::Duration;

use aim_character::{PAPER_AXES, mannequin};
use bevy::camera::Camera3d;
use bevy::prelude::*;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured, save_to_disk};
use bevy::time::TimeUpdateStrategy;
use bevy::window::PrimaryWindow;

use crate::{Ball, Block, Body, Pointer, Stage};

#[derive(Resource)]
struct View(Stage);

pub(crate) fn build(stage: Stage, app: &mut App) {
    // In the temporary directory, so that nothing is written to the checkout.
    let folder = std::env::temp_dir().join("bevy_aim_examples");
    let file = mannequin(|_| PAPER_AXES).expect("axes at right angles");
    std::fs::create_dir_all(&folder).and_then(|()| std::fs::write(folder.join("mannequin.glb"), file)).expect("a file");
    let assets = AssetPlugin { file_path: folder.to_string_lossy().into_owned(), ..default() };
    let picture = std::env::var_os("AIM_SCREENSHOT");
    // Screenshots may be rendered in software, which is faster at a lower resolution.
    let resolution = if picture.is_some() { (960, 540) } else { (1280, 720) };
    let window = Window { resolution: resolution.into(), ..default() };
    app.add_plugins(DefaultPlugins.set(assets).set(WindowPlugin { primary_window: Some(window), ..default() }));
    app.insert_resource(View(stage));
    app.add_observer(bodies).add_observer(balls).add_observer(blocks);
    app.add_systems(Startup, furnish);
    app.add_systems(PreUpdate, point);
    if let Some(picture) = picture {
        app.insert_resource(Picture { file: picture.into(), frames: 0 });
        // Fixed time per frame, independent of how long rendering takes.
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(1) / PICTURE_FPS));
        app.add_systems(Update, shoot);
    }
}

/// A requested screenshot, and the number of frames since all bodies have loaded.
#[derive(Resource)]
struct Picture {
    file: PathBuf,
    frames: u32,
}

/// Simulated frames per second until the screenshot is taken. No fewer than 10, because the solver clamps a frame to
/// 0.1 s.
const PICTURE_FPS: u32 = 10;
/// Number of the frame, counted from when all bodies have loaded, in which the screenshot is taken.
const PICTURE_FRAMES: u32 = 20;
/// Number of frames that are drawn at the end. In software, a frame of the crowd takes a minute.
const DRAWN_FRAMES: u32 = 3;

/// Puts the pointer above and to the left of the middle, takes the screenshot, and exits when it is saved.
fn shoot(
    mut commands: Commands,
    mut picture: ResMut<Picture>,
    mut windows: Query<&mut Window, With<PrimaryWindow>>,
    mut cameras: Query<&mut Camera>,
    loading: Query<(), (With<Body>, Without<Children>)>,
) {
    for mut camera in &mut cameras {
        camera.is_active = picture.frames + DRAWN_FRAMES >= PICTURE_FRAMES;
    }
    if !loading.is_empty() {
        return;
    }
    picture.frames += 1;
    if picture.frames == 1 {
        for mut window in &mut windows {
            let place = window.size() * Vec2::new(0.3, 0.3);
            window.set_cursor_position(Some(place));
        }
    } else if picture.frames == PICTURE_FRAMES {
        let mut screen = commands.spawn(Screenshot::primary_window());
        screen.observe(save_to_disk(picture.file.clone())).observe(
            |_: On<ScreenshotCaptured>, mut exit: MessageWriter<AppExit>| {
                exit.write(AppExit::Success);
            },
        );
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
