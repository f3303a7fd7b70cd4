//! Sampling, compared with values worked out by hand.

use crate::support::{bytes_of, data_uri};
use aim_animation::Transform;
use aim_animation::glam::{Quat, Vec3};
use aim_gltf::Document;
use serde_json::{Value, json};

/// Returns a document whose single node has one channel. `output` is an accessor without its `bufferView`, which is set
/// to 1.
fn one_channel(
    path: &str,
    interpolation: &str,
    times: &[f32],
    values: &[u8],
    output: Value,
    stride: Option<usize>,
) -> Value {
    let mut bytes = bytes_of(times);
    let start = bytes.len();
    bytes.extend_from_slice(values);
    let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": values.len() });
    if let Some(stride) = stride {
        view["byteStride"] = stride.into();
    }
    let mut output = output;
    output["bufferView"] = 1.into();
    json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "name": "only" }],
        "animations": [{
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": path } }],
            "samplers": [{ "input": 0, "output": 1, "interpolation": interpolation }],
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": times.len(), "type": "SCALAR" },
            output,
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": start }, view],
        "buffers": [{ "byteLength": bytes.len(), "uri": data_uri(&bytes) }],
    })
}

fn sample(json: &Value, seconds: f32) -> Transform {
    let document = Document::from_bytes(&serde_json::to_vec(json).unwrap()).unwrap();
    document.skeleton().pose(&document.clips()[0], seconds)[0]
}

fn floats(path: &str, interpolation: &str, times: &[f32], values: &[f32]) -> Value {
    let (shape, width) = if path == "rotation" { ("VEC4", 4) } else { ("VEC3", 3) };
    let output = json!({ "componentType": 5126, "count": values.len() / width, "type": shape });
    one_channel(path, interpolation, times, &bytes_of(values), output, None)
}

#[track_caller]
fn close(a: Vec3, b: [f32; 3]) {
    assert!((a - Vec3::from(b)).length() < 1e-5, "{a} is not {b:?}");
}

#[track_caller]
fn same_turn(a: Quat, b: Quat) {
    assert!(a.dot(b).abs() > 1.0 - 1e-6, "{a} is not {b}");
    assert!((a.length() - 1.0).abs() < 1e-6, "{a} is not unit");
}

#[test]
fn step_and_linear_keys_are_sampled() {
    let keys = [0.0, 0.0, 0.0, 4.0, 8.0, -2.0];
    let step = floats("translation", "STEP", &[1.0, 3.0], &keys);
    close(sample(&step, 2.999).translation, [0.0, 0.0, 0.0]);
    close(sample(&step, 3.0).translation, [4.0, 8.0, -2.0]);
    let linear = floats("translation", "LINEAR", &[1.0, 3.0], &keys);
    close(sample(&linear, 1.5).translation, [1.0, 2.0, -0.5]);
    // Clamped outside; NaN is harmless.
    close(sample(&linear, -5.0).translation, [0.0, 0.0, 0.0]);
    close(sample(&linear, 99.0).translation, [4.0, 8.0, -2.0]);
    close(sample(&linear, f32::NAN).translation, [0.0, 0.0, 0.0]);
}

#[test]
fn a_single_key_holds_everywhere() {
    let json = floats("scale", "LINEAR", &[0.7], &[2.0, 3.0, 4.0]);
    for t in [0.0, 0.7, 5.0] {
        close(sample(&json, t).scale, [2.0, 3.0, 4.0]);
    }
}

#[test]
fn rotations_take_the_shorter_arc_at_constant_speed() {
    let (a, b) = (Quat::from_rotation_y(0.2), Quat::from_rotation_y(1.4));
    let mut keys = a.to_array().to_vec();
    keys.extend((-b).to_array());
    let json = floats("rotation", "LINEAR", &[0.0, 1.0], &keys);
    same_turn(sample(&json, 0.25).rotation, Quat::from_rotation_y(0.5));
    same_turn(sample(&json, 1.0).rotation, b);
}

#[test]
fn cubic_splines_scale_their_tangents_by_the_interval() {
    // From 1 to 3 over two seconds along x, leaving with slope 2 and arriving with slope −1.
    let keys = [
        9.0, 9.0, 9.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, // in-tangent (unused), value, out-tangent
        -1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 9.0, 9.0, 9.0,
    ];
    let json = floats("translation", "CUBICSPLINE", &[1.0, 3.0], &keys);
    // u = 1/2: h00 = h01 = 1/2, h10 = 1/8, h11 = −1/8; 0.5 + 1.5 + 2·2/8 + 2·1/8 = 2.75
    close(sample(&json, 2.0).translation, [2.75, 0.0, 0.0]);
    // u = 1/4: h00 = 27/32, h10 = 9/64, h01 = 5/32, h11 = −3/64
    close(
        sample(&json, 1.5).translation,
        [27.0 / 32.0 + 2.0 * 2.0 * 9.0 / 64.0 + 15.0 / 32.0 + 2.0 * 3.0 / 64.0, 0.0, 0.0],
    );
    close(sample(&json, 3.0).translation, [3.0, 0.0, 0.0]);
}

#[test]
fn cubic_rotations_come_out_unit() {
    let (a, b) = (Quat::from_rotation_x(0.0), Quat::from_rotation_x(1.0));
    let mut keys = vec![0.0; 4];
    keys.extend(a.to_array());
    keys.extend([0.0; 8]);
    keys.extend(b.to_array());
    keys.extend([0.0; 4]);
    let json = floats("rotation", "CUBICSPLINE", &[0.0, 1.0], &keys);
    same_turn(sample(&json, 0.5).rotation, Quat::from_rotation_x(0.5));
}

#[test]
fn normalised_integers_of_every_width() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let quarter = Quat::from_xyzw(half, 0.0, 0.0, half);
    let check = |component: u32, bytes: Vec<u8>, stride: Option<usize>| {
        let output = json!({ "componentType": component, "count": 1, "type": "VEC4", "normalized": true });
        let json = one_channel("rotation", "LINEAR", &[0.0], &bytes, output, stride);
        let found = sample(&json, 0.0).rotation;
        assert!(found.dot(quarter) > 0.9999, "{component}: {found}");
        assert!((found.length() - 1.0).abs() < 1e-6);
    };
    check(5120, vec![90, 0, 0, 90], None);
    check(5121, vec![180, 0, 0, 180], None);
    check(5122, [23170_i16, 0, 0, 23170].iter().flat_map(|v| v.to_le_bytes()).collect(), None);
    check(5123, [46340_u16, 0, 0, 46340].iter().flat_map(|v| v.to_le_bytes()).collect(), None);
    // Both −128 and −127 decode to −1.
    let output = json!({ "componentType": 5120, "count": 1, "type": "VEC4", "normalized": true });
    let json = one_channel("rotation", "LINEAR", &[0.0], &[0x80, 0, 0, 0], output, None);
    same_turn(sample(&json, 0.0).rotation, Quat::from_xyzw(-1.0, 0.0, 0.0, 0.0));
}

#[test]
fn interleaved_keys_are_found_by_their_stride() {
    let values = bytes_of(&[1.0, 2.0, 3.0, 77.0, 5.0, 6.0, 7.0, 77.0]);
    let output = json!({ "componentType": 5126, "count": 2, "type": "VEC3" });
    let json = one_channel("translation", "LINEAR", &[0.0, 1.0], &values, output, Some(16));
    close(sample(&json, 1.0).translation, [5.0, 6.0, 7.0]);
}

#[test]
fn accessors_without_bytes_are_zeros_and_sparse_ones_are_patched() {
    let mut json = floats("translation", "LINEAR", &[0.0, 1.0, 2.0], &[1.0; 9]);
    let accessor = &mut json["accessors"][1];
    accessor.as_object_mut().unwrap().remove("bufferView");
    close(sample(&json, 1.0).translation, [0.0; 3]);
    let patch: Vec<u8> = [1_u8, 0, 0, 0].into_iter().chain(bytes_of(&[4.0, 5.0, 6.0])).collect();
    json["buffers"].as_array_mut().unwrap().push(json!({ "byteLength": patch.len(), "uri": data_uri(&patch) }));
    json["bufferViews"].as_array_mut().unwrap().push(json!({ "buffer": 1, "byteLength": 4 }));
    json["bufferViews"].as_array_mut().unwrap().push(json!({ "buffer": 1, "byteOffset": 4, "byteLength": 12 }));
    json["accessors"][1]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": 2, "componentType": 5121 },
        "values": { "bufferView": 3 },
    });
    close(sample(&json, 1.0).translation, [4.0, 5.0, 6.0]);
    close(sample(&json, 0.5).translation, [2.0, 2.5, 3.0]);
    close(sample(&json, 2.0).translation, [0.0; 3]);
}
