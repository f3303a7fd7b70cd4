//! Evaluates the data sent to the GPU as the vertex shader does, and compares the result with the definition in double
//! precision.

use aim_character::{PAPER_AXES, Palette, mannequin};
use aim_gltf::Document;
use aim_runtime::glam::{DMat3, DVec3};
use serde_json::json;

use super::*;
use crate::draw::Movers;

/// Returns the position and normal of a vertex as computed by the shader.
fn shaded(movers: &Movers, vertex: usize, rest: [Vec3; 2], (rows, weights): (&[[f32; 4]], &[f32])) -> [DVec3; 2] {
    let [mut place, mut normal] = rest.map(|v| v.as_dvec3());
    let [first, count] = movers.shifted[vertex].map(|number| number as usize);
    for shift in first..first + count {
        let [[x, y, z, target], [a, b, c, _]] = [movers.shifts[2 * shift], movers.shifts[2 * shift + 1]];
        let weight = weights.iter().zip(0_u16..).find(|(_, at)| f32::from(*at) == target);
        let weight = weight.map_or(0.0, |(weight, _)| f64::from(*weight));
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

/// Checks every vertex of a moving figure. Positions are compared with `Palette`, normals with the inverse transpose of
/// the local linear map, which is found by moving the vertex along each axis.
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
        assert_as_defined(tools::scaled(scale));
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

/// Names of the morph targets of the left eye: to the right, to the left, down and up.
const LEFT_EYE: [&str; 4] = ["eyeLookInLeft", "eyeLookOutLeft", "eyeLookDownLeft", "eyeLookUpLeft"];

/// Returns the mannequin with the morph targets of [`LEFT_EYE`] instead of eye bones. Target `k` moves the whole head
/// by `k + 1` centimetres.
fn with_morph_eye() -> Character {
    let glb = mannequin(|_| PAPER_AXES).expect("frames");
    let document = Document::from_bytes(&glb).expect("it can be read");
    let (skeleton, surface) = (document.skeleton(), document.surface());
    let head = skeleton.subtree(skeleton.find("head").expect("it has one"));
    let mut moves =
        (0..surface.points().len()).map(|at| head.contains(&surface.node_of(skeleton, at).expect("a node")));
    let file = tools::edited(&glb, |json, bin| {
        let mut primitives = json["meshes"][0]["primitives"].take();
        for primitive in primitives.as_array_mut().expect("primitives") {
            let position = primitive["attributes"]["POSITION"].as_u64().expect("an index");
            let count =
                json["accessors"][usize::try_from(position).expect("small")]["count"].as_u64().expect("a count");
            let moved: Vec<bool> = (0..count).map(|_| moves.next().expect("as many")).collect();
            let targets = [1.0_f32, 2.0, 3.0, 4.0].map(|part| {
                bin.resize(bin.len().next_multiple_of(4), 0);
                let (start, length) = (bin.len(), 12 * moved.len());
                let way = |moved: &bool| [0.0, 0.0, if *moved { 0.01 * part } else { 0.0 }];
                bin.extend(moved.iter().flat_map(way).flat_map(f32::to_le_bytes));
                let views = json["bufferViews"].as_array_mut().expect("views");
                views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": length }));
                let view = views.len() - 1;
                let accessors = json["accessors"].as_array_mut().expect("accessors");
                accessors.push(json!({ "bufferView": view, "componentType": 5126, "count": count, "type": "VEC3" }));
                json!({ "POSITION": accessors.len() - 1 })
            });
            primitive["targets"] = json!(targets);
        }
        json["meshes"][0]["primitives"] = primitives;
        json["meshes"][0]["extras"] = json!({ "targetNames": LEFT_EYE });
        json["buffers"][0]["byteLength"] = bin.len().into();
        for node in json["nodes"].as_array_mut().expect("nodes") {
            if node["name"].as_str().is_some_and(|name| name.ends_with("_eye")) {
                node["name"] = "socket".into();
            }
        }
    });
    Character::from_bytes("morphs.glb", &file).expect("as the mannequin")
}

#[test]
fn morph_targets_move_vertices_as_the_eye_looks() {
    let mut window = Window::new(with_morph_eye(), USUAL);
    assert_eq!(window.viewer().stage.character.skeleton().morph_eyes().len(), 1, "it is found by its targets");
    window.harness.state_mut().stage.clock.play.clip = None;
    for (left, expected) in [(1.0, 1), (-1.0, 0)] {
        let stage = &mut window.harness.state_mut().stage;
        stage.target.place = stage.room().point(left, 0.0, 1.0);
        // After a few frames the eye has turned and the head has hardly moved.
        window.frames(6);
        let stage = &window.viewer().stage;
        let skinning = &stage.character.skinning;
        let figure = skinning.figure(&stage.actors[0].posed, Vec3::ZERO);
        assert!(figure.morphs[expected] > 0.1 && figure.morphs[1 - expected] == 0.0, "{:?}", figure.morphs);
        let movers = Movers::new(&skinning.mesh);
        let surface = &stage.character.surface;
        let moved = |vertex: &usize| movers.shifted[*vertex][1] > 0;
        let vertex = (0..surface.points().len()).find(moved).expect("vertices of the head");
        let rest = [surface.points()[vertex].position(), surface.normals()[vertex]];
        let ways = figure.morphs.iter().zip([0.01, 0.02, 0.03, 0.04]).map(|(weight, way)| weight * way);
        let by = Vec3::Z * ways.sum::<f32>();
        let [found, _] = shaded(&movers, vertex, rest, (&figure.rows, &figure.morphs));
        let [wanted, _] = shaded(&movers, vertex, [rest[0] + by, rest[1]], (&figure.rows, &[0.0; 4]));
        assert!(found.distance(wanted) < 1e-6 && by.length() > 1e-3, "{found} {wanted} {by}");
        // Restart before looking the other way.
        window.harness.state_mut().stage.restart();
    }
}
