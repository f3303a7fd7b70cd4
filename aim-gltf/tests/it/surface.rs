//! A file's surface: images and colours, normals read or computed, and its shape in a pose.

use crate::mesh::drawn;
use crate::support::{bytes_of, data_uri, put_together};
use aim_animation::glam::{Vec2, Vec3};
use aim_character::{Measurement, PAPER_AXES, Palette, Role, mannequin};
use aim_gltf::{Alpha, Document, Surface, Wrap};
use serde_json::{Value, json};

/// Placeholder for an encoded image; nothing here decodes it.
const PICTURE: &[u8] = b"a picture";

/// Returns one triangle in the plane z = 0, seen from +z, with two sets of texture coordinates, byte colours, and a
/// normal that leans towards +x. Its image is `bufferViews[4]`.
fn triangle() -> (Value, Vec<u8>) {
    let parts: [Vec<u8>; 5] = [
        bytes_of(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
        bytes_of(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]),
        [[255, 0, 0, 0], [0, 255, 0, 0], [0, 51, 255, 0]].concat(),
        bytes_of(&[0.6, 0.0, 0.8, 0.6, 0.0, 0.8, 0.6, 0.0, 0.8]),
        PICTURE.to_vec(),
    ];
    let (mut bin, mut views) = (Vec::new(), Vec::new());
    for part in parts {
        bin.resize(bin.len().next_multiple_of(4), 0);
        views.push(json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": part.len() }));
        bin.extend(part);
    }
    views[2]["byteStride"] = 4.into();
    let accessor = |view: usize, kind: u32, shape: &str| json!({ "bufferView": view, "componentType": kind, "count": 3, "type": shape, "normalized": kind == 5121 });
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 1, "COLOR_0": 2, "NORMAL": 3 },
            "material": 0,
        }] }],
        "accessors": [
            accessor(0, 5126, "VEC3"),
            accessor(1, 5126, "VEC2"),
            accessor(2, 5121, "VEC3"),
            accessor(3, 5126, "VEC3"),
        ],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }],
        "textures": [{ "source": 0 }],
        "images": [{ "bufferView": 4, "mimeType": "image/png" }],
        "bufferViews": views,
        "buffers": [{ "byteLength": bin.len() }],
    });
    (json, bin)
}

/// Returns the document of the triangle with a change to its JSON.
fn changed(change: impl FnOnce(&mut Value)) -> Document {
    let (mut json, bin) = triangle();
    change(&mut json);
    Document::from_bytes(&put_together(&json, &bin)).expect("what a surface needs is not looked at when loading")
}

/// Appends an element to one of the file's lists.
fn push(json: &mut Value, list: &str, element: Value) {
    json[list].as_array_mut().unwrap().push(element);
}

fn posed(document: &Document) -> (Surface, Vec<Vec3>, Vec<Vec3>) {
    let (positions, normals) = drawn(document, document.skeleton().rest());
    (document.surface(), positions, normals)
}

#[test]
fn materials_are_read() {
    let plain = changed(|_| {}).surface();
    let [material] = plain.materials() else { panic!("{:?}", plain.materials()) };
    assert_eq!((material.colour, material.alpha, material.is_double_sided), ([1.0; 4], Alpha::Opaque, false));
    let texture = material.texture.expect("it has a picture");
    assert_eq!((&*plain.images()[texture.image], texture.wrap), (PICTURE, [Wrap::Repeat; 2]));
    assert_eq!(plain.triangles()[0].material, Some(0));

    let full = changed(|json| {
        json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.5, 2.0, -1.0, 0.25]);
        json["materials"][0]["alphaMode"] = "MASK".into();
        json["materials"][0]["doubleSided"] = true.into();
        json["textures"][0]["sampler"] = 0.into();
        json["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648 }]);
        push(json, "materials", json!({ "alphaMode": "MASK", "alphaCutoff": 0.75 }));
        push(json, "materials", json!({ "alphaMode": "BLEND" }));
    })
    .surface();
    let [first, second, third] = full.materials() else { panic!("{:?}", full.materials()) };
    assert_eq!(first.colour, [0.5, 1.0, 0.0, 0.25], "kept within its range");
    assert_eq!((first.alpha, second.alpha, third.alpha), (Alpha::Mask(0.5), Alpha::Mask(0.75), Alpha::Blend));
    assert!(first.is_double_sided && !second.is_double_sided);
    assert_eq!(first.texture.unwrap().wrap, [Wrap::Clamp, Wrap::Mirror]);
    assert_eq!(second.texture, None);
}

#[test]
fn specular_glossiness_base_colours_are_read() {
    let old = changed(|json| {
        let extension = json!({ "diffuseFactor": [0.1, 0.2, 0.3, 1.0], "diffuseTexture": { "index": 0 } });
        json["materials"][0] = json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": extension } });
    })
    .surface();
    let material = &old.materials()[0];
    assert_eq!(material.colour, [0.1, 0.2, 0.3, 1.0]);
    assert!(material.texture.is_some());
}

#[test]
fn images_are_read_once_from_any_source() {
    let shared = changed(|json| {
        let first = json["materials"][0].clone();
        push(json, "materials", first);
        push(json, "materials", json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } } }));
        push(json, "textures", json!({ "source": 1 }));
        push(json, "images", json!({ "uri": data_uri(b"another") }));
    })
    .surface();
    let found: Vec<usize> = shared.materials().iter().map(|material| material.texture.unwrap().image).collect();
    assert_eq!(found, [0, 0, 1]);
    assert_eq!(shared.images().iter().map(|image| &**image).collect::<Vec<_>>(), [PICTURE, b"another"]);

    let (mut json, bin) = triangle();
    json["images"][0] = json!({ "uri": "skin%20one.png" });
    let folder = std::env::temp_dir().join(format!("aim-surface-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (file, picture) = (folder.join("model.glb"), folder.join("skin one.png"));
    std::fs::write(&file, put_together(&json, &bin)).unwrap();
    let without = Document::load(&file).unwrap().surface();
    assert_eq!((without.materials()[0].texture, without.images().len()), (None, 0), "it is not there");
    std::fs::write(&picture, PICTURE).unwrap();
    assert_eq!(&*Document::load(&file).unwrap().surface().images()[0], PICTURE);
    std::fs::remove_dir_all(&folder).unwrap();
    let from_memory = Document::from_bytes(&put_together(&json, &bin)).unwrap().surface();
    assert_eq!(from_memory.materials()[0].texture, None, "it was not looked for");
}

#[test]
fn broken_data_is_left_out() {
    for (pointer, value) in [
        ("/images/0/bufferView", json!(99)),
        ("/images/0/bufferView", json!(-1)),
        ("/images/0/bufferView", json!("four")),
        ("/images/0", json!({ "uri": "data:image/png;base64,%" })),
        ("/images/0", json!({ "uri": "https://example.org/skin.png" })),
        ("/images/0", json!({ "uri": "/etc/hostname" })),
        ("/images/0", json!(null)),
        ("/textures/0/source", json!(1)),
        ("/textures", json!("none")),
        ("/bufferViews/4/byteLength", json!(4_000_000)),
        ("/materials/0/pbrMetallicRoughness/baseColorTexture", json!([])),
        ("/materials/0/pbrMetallicRoughness/baseColorTexture/index", json!(18_446_744_073_709_551_615_u64)),
    ] {
        let surface = changed(|json| *json.pointer_mut(pointer).unwrap() = value.clone()).surface();
        assert_eq!(surface.materials()[0].texture, None, "{pointer}: {value}");
        assert_eq!((surface.triangles().len(), surface.images().len()), (1, 0), "{pointer}: {value}");
    }
    for (pointer, value) in [("/materials", json!({})), ("/meshes/0/primitives/0/material", json!(7))] {
        let surface = changed(|json| *json.pointer_mut(pointer).unwrap() = value.clone()).surface();
        assert_eq!(surface.triangles()[0].material, None, "{pointer}: {value}");
    }
    let attributes = "/meshes/0/primitives/0/attributes";
    for (name, accessor) in [("NORMAL", 1), ("NORMAL", 99), ("TEXCOORD_0", 0), ("COLOR_0", 1)] {
        let broken = changed(|json| json.pointer_mut(attributes).unwrap()[name] = accessor.into());
        let (surface, positions, normals) = posed(&broken);
        assert_eq!((positions.len(), normals.len()), (3, 3), "{name}");
        assert_eq!(normals[0] == Vec3::Z, name == "NORMAL", "made from the triangle instead: {normals:?}");
        assert_eq!(surface.texture_coordinates()[1] == Vec2::ZERO, name == "TEXCOORD_0");
        assert_eq!(surface.tints()[0] == [1.0; 4], name == "COLOR_0");
    }
}

#[test]
fn texture_coordinates_and_colours_are_converted() {
    let plain = changed(|_| {}).surface();
    assert_eq!(plain.texture_coordinates(), [Vec2::ZERO, Vec2::X, Vec2::Y]);
    assert_eq!(plain.tints(), [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.2, 1.0, 1.0]]);
    let moved = changed(|json| {
        let transform = json!({ "offset": [0.5, 0.25], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 3],
            "texCoord": 1 });
        let info = &mut json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
        info["extensions"] = json!({ "KHR_texture_transform": transform });
        json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("TEXCOORD_0");
    })
    .surface();
    // Scaled, rotated by a quarter turn counterclockwise as displayed (v points down), then offset.
    let expected = [Vec2::new(0.5, 0.25), Vec2::new(0.5, -1.75), Vec2::new(3.5, 0.25)];
    for (found, expected) in moved.texture_coordinates().iter().zip(expected) {
        assert!(found.abs_diff_eq(expected, 1e-6), "{found} is not {expected}");
    }
}

#[test]
fn mirrored_nodes_keep_the_winding() {
    for has_normals in [true, false] {
        for scale in [[1.0_f32, 1.0, 1.0], [-1.0, 1.0, 1.0], [2.0, 3.0, -0.5], [-0.1, -0.2, -0.3]] {
            let document = changed(|json| {
                json["nodes"][0]["scale"] = json!(scale);
                if !has_normals {
                    json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("NORMAL");
                }
            });
            let (surface, positions, normals) = posed(&document);
            let [a, b, c] = surface.triangles()[0].vertices.map(|vertex| positions[vertex]);
            let face = (b - a).cross(c - a).normalize();
            // +Z of mesh space, as the node transforms it.
            let outwards = Vec3::Z * scale[2].signum();
            assert!(face.abs_diff_eq(outwards, 1e-6), "{scale:?}: {face}");
            assert!(normals.iter().all(|normal| normal.dot(face) > 0.3), "{scale:?}, {has_normals}: {normals:?}");
            assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6), "{normals:?}");
        }
    }
}

#[test]
fn the_mannequin_walks_with_its_normals() {
    let document = Document::from_bytes(&mannequin(|_| PAPER_AXES).unwrap()).unwrap();
    let (surface, skeleton) = (document.surface(), document.skeleton());
    for seconds in [0.0, 0.3, 0.7] {
        let pose = skeleton.pose(document.clip("walk").unwrap(), seconds);
        let (positions, normals) = drawn(&document, &pose);
        let exact = Palette::new(skeleton, &skeleton.world_f64(&pose)).positions(&surface);
        assert_eq!((positions.len(), normals.len()), (exact.len(), exact.len()));
        for (position, exact) in positions.iter().zip(&exact) {
            assert!(position.abs_diff_eq(exact.as_vec3(), 2e-6), "{position} is not {exact} at {seconds} s");
        }
        assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5), "of length one at {seconds} s");
        let along = |vertices: [usize; 3]| {
            let [a, b, c] = vertices.map(|vertex| positions[vertex]);
            let face = (b - a).cross(c - a);
            vertices.iter().all(|vertex| normals[*vertex].dot(face) >= -1e-9)
        };
        let agree = surface.triangles().iter().filter(|triangle| along(triangle.vertices)).count();
        assert!(agree * 100 >= surface.triangles().len() * 98, "{agree} of {}", surface.triangles().len());
    }
}

#[test]
fn the_mannequin_is_drawn_where_it_is_measured() {
    let bytes = mannequin(|_| PAPER_AXES).expect("the mannequin is made of constants");
    let document = Document::from_bytes(&bytes).expect("what we write we read");
    let (surface, measured) = (document.surface(), Measurement::of(&document));
    let positions = Palette::new(document.skeleton(), &measured.bind_world).positions(&surface);
    let (low, high) = positions.iter().fold((f64::MAX, f64::MIN), |(lo, hi), p| (lo.min(p.y), hi.max(p.y)));
    assert!((high - low - measured.height).abs() < 1e-6, "{low} … {high} against {}", measured.height);
    assert!(surface.triangles().len() > 1000, "a whole figure");
    assert!(surface.triangles().iter().flat_map(|t| t.vertices).all(|v| v < positions.len()), "vertices exist");
    assert!(surface.triangles().iter().all(|t| t.material.is_some()), "every part has a colour");
    let eye = measured.with_role(Role::LeftEye).map(|bone| bone.node);
    let of_eye = (0..positions.len()).filter(|v| surface.node_of(document.skeleton(), *v) == eye);
    assert!(of_eye.count() > 100, "the eyeball hangs on the eye");
}

#[test]
fn triangles_with_broken_indices_are_left_out() {
    let json = r#"{"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}},
        {"attributes":{"POSITION":0},"indices":7},{"attributes":{"POSITION":0},"indices":"x"}]}]}"#;
    let document = Document::from_bytes(json.as_bytes()).expect("indices are not looked at when loading");
    assert_eq!(document.surface().triangles().len(), 1);
}
