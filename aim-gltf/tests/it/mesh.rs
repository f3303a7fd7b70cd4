//! A document's surface as one mesh with one skin: drawn as glTF defines it, with all influences and morph targets.

use std::path::Path;

use aim_animation::glam::{Affine3A, Vec3};
use aim_animation::{Mesh, MeshPose, Skin, Transform};
use aim_character::{PAPER_AXES, Palette, mannequin};
use aim_gltf::{Document, Surface};
use serde_json::{Value, json};

use crate::support::{bytes_of, data_uri};

/// Returns the vertices in a pose, as found and by the definition in f64.
fn placed(document: &Document, pose: &[Transform]) -> (Vec<Vec3>, Vec<Vec3>) {
    let (surface, skeleton) = (document.surface(), document.skeleton());
    let (mesh, skin) = surface.mesh(skeleton);
    let world = skeleton.world_f64(pose);
    let exact = Palette::new(skeleton, &world).positions(&surface);
    let found = deformed(document, &mesh, &skin, (pose, &[]));
    (found, exact.into_iter().map(|exact| exact.as_vec3()).collect())
}

fn deformed(document: &Document, mesh: &Mesh, skin: &Skin, (pose, weights): (&[Transform], &[f32])) -> Vec<Vec3> {
    let mut found = vec![Vec3::NAN; mesh.positions().len()];
    mesh.deform(&MeshPose::new(&matrices(document, skin, pose)).with_morph_weights(weights), &mut found).unwrap();
    found
}

fn matrices(document: &Document, skin: &Skin, pose: &[Transform]) -> Vec<Affine3A> {
    let mut model = vec![Affine3A::IDENTITY; pose.len()];
    document.skeleton().to_model(pose, &mut model).unwrap();
    let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
    skin.matrices(&model, &mut matrices).unwrap();
    matrices
}

/// Returns vertices and normals of a document's surface in a pose.
pub(crate) fn drawn(document: &Document, pose: &[Transform]) -> (Vec<Vec3>, Vec<Vec3>) {
    let surface = document.surface();
    let (mesh, skin) = surface.mesh(document.skeleton());
    let matrices = matrices(document, &skin, pose);
    let pose = MeshPose::new(&matrices).with_morph_weights(surface.morph_weights());
    let (mut positions, mut normals) = (vec![Vec3::NAN; mesh.positions().len()], mesh.positions().to_vec());
    mesh.deform(&pose, &mut positions).unwrap();
    mesh.deform_normals(&pose, usize::MAX, &mut normals).unwrap();
    (positions, normals)
}

/// Asserts that every vertex is at its expected position, to 1e-5 of the figure's size; returns their number.
fn judge(document: &Document, pose: &[Transform]) -> usize {
    let (found, exact) = placed(document, pose);
    assert_eq!(found.len(), exact.len());
    let size = exact.iter().map(|at| at.abs().max_element()).fold(0.0, f32::max);
    for (found, exact) in found.iter().zip(&exact) {
        assert!(found.abs_diff_eq(*exact, 1e-5 * size), "{found} is not {exact}, of {size}");
    }
    found.len()
}

#[test]
fn the_walking_mannequin_is_deformed_correctly() {
    let document = Document::from_bytes(&mannequin(|_| PAPER_AXES).unwrap()).unwrap();
    for seconds in [0.0, 0.3, 0.7] {
        let pose = document.skeleton().pose(document.clip("walk").unwrap(), seconds);
        assert!(judge(&document, &pose) > 1000);
    }
    let surface = document.surface();
    let (mesh, skin) = surface.mesh(document.skeleton());
    assert_eq!((mesh.normals(), mesh.triangles().len()), (surface.normals(), surface.triangles().len()));
    assert!(skin.len() < 60 && (0..mesh.positions().len()).all(|vertex| !mesh.influences(vertex).is_empty()));
}

/// Returns a file with a triangle that has two sets of joints and two morph targets. A rigid node and a node with a
/// skin of six joints (node 2) show it. Joint `k` is node `3 + k`, at a height of `k` m.
fn file() -> Value {
    let mut accessors = Vec::new();
    let mut views = Vec::new();
    let mut buffers = Vec::new();
    let mut add = |shape: &str, kind: u32, count: usize, bytes: Vec<u8>| {
        buffers.push(json!({ "byteLength": bytes.len(), "uri": data_uri(&bytes) }));
        views.push(json!({ "buffer": views.len(), "byteLength": bytes.len() }));
        accessors.push(json!({ "bufferView": accessors.len(), "componentType": kind, "count": count, "type": shape }));
        accessors.len() - 1
    };
    let positions = add("VEC3", 5126, 3, bytes_of(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]));
    let joints = [[0, 1, 2, 3], [4, 5, 0, 0]].map(|set: [u8; 4]| add("VEC4", 5121, 3, [set; 3].concat()));
    let weights =
        [[0.2, 0.1, 0.1, 0.1], [0.3, 0.2, 0.0, 0.0]].map(|set| add("VEC4", 5126, 3, bytes_of(&[set; 3].concat())));
    let morphs = [[0.0, 0.0, 1.0], [0.5, 0.0, 0.0]]
        .map(|way| add("VEC3", 5126, 3, bytes_of(&[[0.0; 3], way, [0.0; 3]].concat())));
    let mut nodes = vec![
        json!({ "mesh": 0, "name": "rigid", "translation": [5, 0, 0] }),
        json!({ "name": "plain" }),
        json!({ "mesh": 0, "skin": 0, "name": "skinned", "weights": [0.25, 0.5] }),
    ];
    nodes.extend((0..6).map(|height| json!({ "name": format!("joint{height}"), "translation": [0, height, 0] })));
    json!({
        "asset": { "version": "2.0" },
        "nodes": nodes,
        "skins": [{ "joints": [3, 4, 5, 6, 7, 8] }],
        "meshes": [{ "weights": [0.75], "primitives": [{
            "attributes": { "POSITION": positions, "JOINTS_0": joints[0], "JOINTS_1": joints[1], "WEIGHTS_0": weights[0], "WEIGHTS_1": weights[1] },
            "targets": [{ "POSITION": morphs[0] }, { "POSITION": morphs[1], "NORMAL": morphs[0] }],
        }] }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": buffers,
    })
}

fn read(json: &Value) -> (Document, Surface) {
    let document = Document::from_bytes(json.to_string().as_bytes()).unwrap();
    let surface = document.surface();
    (document, surface)
}

#[test]
fn all_sets_of_joints_and_all_morph_targets_are_read() {
    let (document, surface) = read(&file());
    let (mesh, skin) = surface.mesh(document.skeleton());
    assert_eq!((mesh.positions().len(), skin.len()), (6, 7), "the rigid node is a joint");
    assert_eq!((mesh.influences(0).len(), mesh.influences(3).len()), (1, 6));
    let weights: f32 = mesh.influences(4).iter().map(|influence| influence.weight).sum();
    assert!((weights - 1.0).abs() < 1e-6);

    // Default weights of the mesh, and of the node that overrides them.
    let (rigid, skinned) = (document.skeleton().find("rigid").unwrap(), document.skeleton().find("skinned").unwrap());
    assert_eq!(surface.morph_weights(), [0.75, 0.0, 0.25, 0.5]);
    assert_eq!((surface.morph_targets(rigid), surface.morph_targets(skinned)), (0..2, 2..4));
    assert_eq!(surface.morph_targets(1), 0..0);
    assert_eq!((mesh.morph_targets(), mesh.morphs(4)[1].normal), (4, Vec3::Z));

    let rest = document.skeleton().rest();
    let found = deformed(&document, &mesh, &skin, (rest, surface.morph_weights()));
    // Without inverse bind matrices: Σ weight · height.
    let height = 0.1 + 0.2 + 0.3 + 1.2 + 1.0;
    let expected = [
        Vec3::X * 5.0,
        Vec3::new(6.0, 0.0, 0.75),
        Vec3::new(5.0, 1.0, 0.0),
        Vec3::Y * height,
        Vec3::new(1.25, height, 0.25),
        Vec3::Y * (1.0 + height),
    ];
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.abs_diff_eq(expected, 1e-6), "{found} is not {expected}");
    }
}

#[test]
fn unreadable_data_is_left_out() {
    let plain = read(&file());
    let (plain, _) = plain.1.mesh(plain.0.skeleton());
    let changes: [(&str, Value); 7] = [
        ("/meshes/0/primitives/0/targets/0", json!(3)),
        ("/meshes/0/primitives/0/targets/0/POSITION", json!(99)),
        ("/meshes/0/primitives/0/targets/0/POSITION", json!(1)),
        ("/meshes/0/primitives/0/targets", json!("many")),
        ("/meshes/0/primitives/0/attributes/JOINTS_1", json!(99)),
        ("/meshes/0/primitives/0/attributes/WEIGHTS_1", json!(0)),
        ("/nodes/2/weights", json!(["heavy"])),
    ];
    for (pointer, value) in changes {
        let mut json = file();
        *json.pointer_mut(pointer).unwrap() = value;
        let (document, surface) = read(&json);
        let (mesh, skin) = surface.mesh(document.skeleton());
        assert_eq!(mesh.positions(), plain.positions(), "{pointer}");
        let found = deformed(&document, &mesh, &skin, (document.skeleton().rest(), surface.morph_weights()));
        assert!(found.iter().all(|vertex| vertex.is_finite()), "{pointer}");
    }
}

#[test]
fn a_bone_with_two_inverse_binds_is_two_joints() {
    let mut json = file();
    let binds: Vec<f32> =
        Affine3A::from_translation(Vec3::Z).to_cols_array_2d().iter().flat_map(|c| [c[0], c[1], c[2], 0.0]).collect();
    let mut binds: Vec<f32> = binds.repeat(6);
    binds.iter_mut().skip(15).step_by(16).for_each(|one| *one = 1.0);
    let bytes = bytes_of(&binds);
    let push = |json: &mut Value, list: &str, element: Value| json[list].as_array_mut().unwrap().push(element);
    push(&mut json, "buffers", json!({ "byteLength": bytes.len(), "uri": data_uri(&bytes) }));
    push(&mut json, "bufferViews", json!({ "buffer": 7, "byteLength": bytes.len() }));
    push(&mut json, "accessors", json!({ "bufferView": 7, "componentType": 5126, "count": 6, "type": "MAT4" }));
    push(&mut json, "skins", json!({ "joints": [3, 4, 5, 6, 7, 8], "inverseBindMatrices": 7 }));
    // The palette uses only the first four joints.
    let attributes = json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap();
    attributes.retain(|name, _| !name.ends_with("_1"));
    push(&mut json, "nodes", json!({ "mesh": 0, "skin": 1 }));
    push(&mut json, "nodes", json!({ "mesh": 0, "skin": 0 }));
    let (document, surface) = read(&json);
    let (mesh, skin) = surface.mesh(document.skeleton());
    assert_eq!((mesh.positions().len(), skin.len()), (12, 9));
    judge(&document, document.skeleton().rest());
}

#[test]
#[ignore = "needs the characters that AIM_RIGS names"]
fn characters_stand_and_move_where_they_are_drawn() {
    let folder = std::env::var("AIM_RIGS").expect("the folder of characters");
    let mut judged = 0;
    for path in files(Path::new(&folder)) {
        let Ok(document) = Document::load(&path) else { continue };
        let mut vertices = judge(&document, document.skeleton().rest());
        if let Some(clip) = document.default_clip() {
            vertices += judge(&document, &document.skeleton().pose(clip, clip.length_s() * 0.4));
        }
        println!("{}: {vertices} vertices", path.display());
        judged += usize::from(vertices > 0);
    }
    assert!(judged > 0);
}

/// Returns all files below a folder.
fn files(folder: &Path) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        match path.extension().and_then(|extension| extension.to_str()) {
            _ if path.is_dir() => found.extend(files(&path)),
            Some("glb" | "gltf" | "vrm") => found.push(path),
            _ => {}
        }
    }
    found.sort();
    found
}
