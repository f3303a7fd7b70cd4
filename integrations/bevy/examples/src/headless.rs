//! Mannequins without meshes or a window: only their bones.

use std::time::Duration;

use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::Document;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;

use crate::Body;

#[derive(Resource)]
struct Model(Document);

pub(crate) fn build(app: &mut App) {
    let file = mannequin(|_| PAPER_AXES).expect("axes at right angles");
    app.insert_resource(Model(Document::from_bytes(&file).expect("a file")));
    app.add_plugins((TaskPoolPlugin::default(), bevy::time::TimePlugin, TransformPlugin));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_nanos(16_666_667)));
    app.add_observer(spawn);
}

fn spawn(added: On<Add<Body>>, mut commands: Commands, model: Res<Model>) {
    let skeleton = model.0.skeleton();
    let mut bones: Vec<Entity> = Vec::new();
    for (bone, rest) in skeleton.rest().iter().enumerate() {
        let parent = skeleton.parents()[bone].map_or(added.entity, |parent| bones[parent]);
        let place = Transform { translation: rest.translation, rotation: rest.rotation, scale: rest.scale };
        bones.push(commands.spawn((Name::new(skeleton.names()[bone].clone()), place, ChildOf(parent))).id());
    }
}
