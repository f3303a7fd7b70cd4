//! What is sent to the graphics card, evaluated as the vertex shader does, against the definition in double precision.

use std::f64::consts::PI;

use aim_character::{PAPER_AXES, Palette, mannequin};
use aim_gltf::Document;
use aim_runtime::glam::{DMat3, DVec3};
use serde_json::{Value, json};

use super::*;
use crate::draw::Movers;

/// A vertex as the shader places it, and its normal.
fn shaded(movers: &Movers, vertex: usize, rest: [Vec3; 2], (rows, weights): (&[[f32; 4]], &[f32])) -> [DVec3; 2] {
    let [mut place, mut normal] = rest.map(|v| v.as_dvec3());
    let [first, count] = movers.shifted[vertex].map(|number| number as usize);
    for shift in first..first + count {
        let [[x, y, z, target], [a, b, c, _]] = [movers.shifts[2 * shift], movers.shifts[2 * shift + 1]];
        let weight = f64::from(weights[target as usize]);
        place += weight * Vec3::new(x, y, z).as_dvec3();
        normal += weight * Vec3::new(a, b, c).as_dvec3();
    }
    let mut mean = [[0.0; 4]; 3];
    for (joint, weight) in movers.joints[vertex].into_iter().zip(movers.weights[vertex]) {
        for (row, mean) in mean.iter_mut().enumerate() {
            let of_joint = if weight == 0.0 { [0.0; 4] } else { rows[3 * joint as usize + row] };
            mean.iter_mut().zip(of_joint).for_each(|(mean, part)| *mean += f64::from(weight) * f64::from(part));
        }
    }
    let [x, y, z] = mean.map(|[x, y, z, _]| DVec3::new(x, y, z));
    let at = |row: DVec3, moved: f64| row.dot(place) + moved;
    let cofactors = [y.cross(z), z.cross(x), x.cross(y)].map(|row| row.dot(normal));
    let turned = DVec3::from_array(cofactors) * if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
    [DVec3::new(at(x, mean[0][3]), at(y, mean[1][3]), at(z, mean[2][3])), turned.normalize_or_zero()]
}

/// Holds every vertex of a moving figure against the definition: places by `Palette`, normals by the inverse's transpose
/// of a matrix that is found by moving the corners of a small tetrahedron.
fn assert_as_defined(character: Character) {
    let mut window = Window::new(character, USUAL);
    for frames in [1, 20, 40] {
        window.frames(frames);
        let stage = &window.viewer().stage;
        let (character, frame) = (&stage.character, stage.first().expect("a frame"));
        let movers = Movers::new(&character.skinning.mesh);
        let figure = character.skinning.figure(&stage.actors[0].posed, stage.actors[0].shift);
        let places = Palette::new(character.skeleton(), &frame.world).positions(&character.surface);
        let size = f64::from(character.metre());
        let (points, normals) = (character.surface.points(), character.surface.normals());
        for (vertex, (place, point)) in places.iter().zip(points).enumerate() {
            let rest = [point.position(), normals[vertex]];
            let numbers = (&figure.rows[..], &figure.morphs[..]);
            let [found, turned] = shaded(&movers, vertex, rest, numbers);
            assert!(found.distance(*place) < 1e-5 * size, "vertex {vertex} at {found} instead of {place}");
            let [low, high] = figure.bounds.map(|bound| bound.as_dvec3());
            let margin = DVec3::splat(1e-5 * size);
            assert!(
                found.cmpge(low - margin).all() && found.cmple(high + margin).all(),
                "{found} is out of {low} {high}"
            );
            let moved = |by: Vec3| shaded(&movers, vertex, [point.position() + by, rest[1]], numbers)[0] - found;
            let matrix = DMat3::from_cols(moved(Vec3::X), moved(Vec3::Y), moved(Vec3::Z));
            let wanted = (matrix.inverse().transpose() * rest[1].as_dvec3()).normalize_or_zero();
            assert!(turned.distance(wanted) < 1e-4, "normal {vertex} is {turned} instead of {wanted}");
        }
    }
}

#[test]
fn vertices_and_normals_are_where_the_definition_has_them() {
    for scale in [[1.0; 3], [-1.0, 1.0, 1.0], [-1.2, 0.9, 1.1], [1e-3; 3]] {
        assert_as_defined(super::tools::scaled(scale));
    }
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn vertices_of_real_characters_are_where_the_definition_has_them() {
    let rigs = std::path::PathBuf::from(std::env::var_os("AIM_RIGS").expect("a folder of real characters"));
    for file in ["dude.glb", "khronos_fox.glb", "cesium_man.gltf"] {
        assert_as_defined(Character::open(&rigs.join(file), None).expect("it is a character"));
    }
}

/// The mannequin whose left eye's mesh has two targets instead of a bone that turns it: `ARKit`'s to the left and up.
fn with_morph_eyes() -> Character {
    let file = super::tools::edited(&mannequin(|_| PAPER_AXES).expect("frames"), |document: &mut Value| {
        // A target that is the way of every vertex to the mesh's own position: twice as large.
        for mesh in document["meshes"].as_array_mut().expect("meshes") {
            let mut count = 0;
            for primitive in mesh["primitives"].as_array_mut().expect("primitives") {
                let position = primitive["attributes"]["POSITION"].clone();
                let target = json!({ "POSITION": position });
                primitive["targets"] = json!([target, target, target, target]);
                count = 4;
            }
            assert_eq!(count, 4);
            mesh["extras"] =
                json!({ "targetNames": ["eyeLookInLeft", "eyeLookOutLeft", "eyeLookDownLeft", "eyeLookUpLeft"] });
        }
    });
    Character::from_bytes("morphs.glb", &file).expect("as the mannequin")
}

#[test]
fn morph_targets_move_vertices_as_eyes_look() {
    let mut window = Window::new(with_morph_eyes(), USUAL);
    let stage = &mut window.harness.state_mut().stage;
    stage.clock.play.clip = None;
    assert!(!stage.character.skeleton().morph_eyes().is_empty(), "eyes are found by their targets");
    stage.target.place = stage.room().point(1.2, 0.6, 1.0);
    window.frames(3);
    let stage = &window.viewer().stage;
    let posed = &stage.actors[0].posed;
    assert!(posed.morphs.iter().any(|weight| *weight > 0.1), "{:?}", posed.morphs);
    assert!(posed.morphs.iter().all(|weight| (0.0..=1.0).contains(weight)), "{:?}", posed.morphs);
    // As the aimed eye's angles say, by the same map from degrees that the file's format states: full at 35° aside.
    let figure = stage.character.skinning.figure(posed, Vec3::ZERO);
    let movers = Movers::new(&stage.character.skinning.mesh);
    let vertex = 0;
    let rest = [stage.character.surface.points()[vertex].position(), stage.character.surface.normals()[vertex]];
    let [still, moved] = [vec![0.0; figure.morphs.len()], figure.morphs.clone()]
        .map(|weights| shaded(&movers, vertex, rest, (&figure.rows, &weights))[0]);
    let [first, count] = movers.shifted[vertex];
    assert_eq!((first, count), (0, 4));
    let total: f64 = figure.morphs[..4].iter().map(|weight| f64::from(*weight)).sum();
    let direct = shaded(&movers, vertex, [rest[0] * (1.0 + total as f32), rest[1]], (&figure.rows, &[0.0; 64]))[0];
    assert!(moved.distance(direct) < 1e-4 && moved.distance(still) > 1e-3, "{still} {moved} {direct}; {}", PI);
    let _ = Document::skeleton;
}
