//! Packs the parts of the mannequin into a GLB.

use std::sync::Arc;

use aim_animation::{Clip, Root};
use aim_gltf::{Document, Skeleton, to_glb};
use aim_runtime::glam::{DMat3, DQuat, DVec3, Quat, Vec3};
use serde_json::{Value, json};

use super::blend::walk_to_run;
use super::body::{MATERIALS, surfaces};
use super::joints::{Bone, Joint};
use super::moves::{self, Move};
use super::shape::ShapeMesh;
use super::vrm::{Vrm, t_pose};
use super::walk;
use crate::bake::{continuous, line};
use crate::error::Error;
use crate::num;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The binary chunk under construction, with its views and accessors.
#[derive(Default)]
struct Data {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Data {
    /// Adds an accessor with a view of its own; returns its index.
    fn add(&mut self, bytes: &[u8], target: Option<u32>, mut accessor: Value) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        accessor["bufferView"] = self.views.len().into();
        self.views.push(view);
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], target: Option<u32>, bounds: bool) -> usize {
        let bytes: Vec<u8> = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let shape = match N {
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        let mut accessor = json!({ "componentType": 5126, "count": values.len(), "type": shape });
        if bounds {
            let extreme = |pick: fn(f32, f32) -> f32, start: f32| {
                let of = |i: usize| f64::from(values.iter().map(|v| v[i]).fold(start, pick));
                (0..N).map(of).collect::<Vec<_>>()
            };
            accessor["min"] = extreme(f32::min, f32::INFINITY).into();
            accessor["max"] = extreme(f32::max, f32::NEG_INFINITY).into();
        }
        self.add(&bytes, target, accessor)
    }
}

/// Contents of a file besides the figure and its walk.
pub(super) struct Contents<'a> {
    pub(super) moves: &'a [Move],
    pub(super) walks_to_run: bool,
    pub(super) vrm: Option<Vrm>,
}

/// Returns the whole file as a GLB.
pub(super) fn pack(contents: &Contents<'_>, joints: &[Joint], rig: &[Bone]) -> Result<Vec<u8>, Error> {
    let vrm = contents.vrm;
    let mut data = Data::default();
    let scene = vrm.map_or(DMat3::IDENTITY, Vrm::scene);
    let mut surfaces = surfaces(joints);
    for surface in &mut surfaces {
        surface.positions.iter_mut().chain(&mut surface.normals).for_each(|v| *v = scene * *v);
    }
    let primitives: Vec<Value> = surfaces.iter().enumerate().map(|(k, s)| primitive(&mut data, s, k)).collect();
    let binds: Vec<[f32; 16]> = joints.iter().zip(rig).map(|(joint, bone)| inverse_bind(joint, bone, scene)).collect();
    let binds = data.floats(&binds, None, false);
    let mut nodes: Vec<Value> = (0..joints.len()).map(|index| node(vrm, joints, rig, index)).collect();
    nodes.push(json!({ "name": "body", "mesh": 0, "skin": 0 }));
    let material = |m: &super::body::Tint| {
        let [r, g, b] = m.colour;
        json!({
            "name": m.name,
            "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": m.roughness },
        })
    };
    let mut json = json!({
        "asset": { "version": "2.0", "generator": concat!("aim-gltf ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": "mannequin", "nodes": [0, joints.len()] }],
        "nodes": nodes,
        "meshes": [{ "name": "body", "primitives": primitives }],
        "skins": [{ "name": "mannequin", "inverseBindMatrices": binds, "skeleton": 0, "joints": (0..joints.len()).collect::<Vec<_>>() }],
        "materials": MATERIALS.iter().map(material).collect::<Vec<_>>(),
    });
    json["accessors"] = data.accessors.into();
    json["bufferViews"] = data.views.into();
    json["buffers"] = json!([{ "byteLength": data.bytes.len() }]);
    if let Some(version) = vrm {
        version.write(joints, &mut json);
    }
    let glb = to_glb(json.to_string().as_bytes(), Some(&data.bytes))?;
    let document = Document::from_bytes(&glb)?;
    let bones = (document.skeleton(), rig);
    let moved = |one: &Move| clip(one.name, one.times(), bones, |t| one.at(joints, t));
    let mut clips = Vec::new();
    if contents.walks_to_run {
        let root = Root::Shadow { bone: document.skeleton().find(&joints[0].name)?, up: (scene * DVec3::Y).as_vec3() };
        let [walk, run] = [moved(&moves::WALK_AHEAD)?, moved(&moves::RUN)?];
        clips.push(walk_to_run(document.skeleton(), [&walk, &run], root)?);
    }
    clips.push(clip("walk", walk::times(), bones, |t| walk::at(joints, t))?);
    for one in contents.moves {
        clips.push(moved(one)?);
    }
    Ok(document.with_clips(&clips)?)
}

fn narrow3(v: DVec3) -> [f32; 3] {
    // Adding zero turns −0 into 0, which reads better in a file.
    v.to_array().map(|x| num::narrow(x) + 0.0)
}

fn narrow4(q: DQuat) -> [f32; 4] {
    q.to_array().map(|x| num::narrow(x) + 0.0)
}

fn node(vrm: Option<Vrm>, joints: &[Joint], rig: &[Bone], index: usize) -> Value {
    let bone = &rig[index];
    let place = |name: &str| joints.iter().find(|joint| joint.name == name).map_or(DVec3::ZERO, |joint| joint.position);
    let rest = vrm.map_or(DQuat::IDENTITY, |_| t_pose(&joints[index].name, place));
    let mut node = json!({
        "name": joints[index].name,
        "translation": narrow3(bone.translation(DVec3::ZERO)).map(f64::from),
        "rotation": narrow4(bone.rotation(rest)).map(f64::from),
    });
    if bone.mirror != DVec3::ONE {
        node["scale"] = json!(bone.mirror.to_array());
    }
    let children: Vec<usize> = (0..joints.len()).filter(|i| joints[*i].parent == Some(index)).collect();
    if !children.is_empty() {
        node["children"] = json!(children);
    }
    node
}

fn inverse_bind(joint: &Joint, bone: &Bone, scene: DMat3) -> [f32; 16] {
    let turn = bone.frame.transpose();
    let from_mesh = turn * scene.transpose();
    let [x, y, z] = [from_mesh.x_axis, from_mesh.y_axis, from_mesh.z_axis].map(narrow3);
    let t = narrow3(-(turn * joint.position));
    [x[0], x[1], x[2], 0.0, y[0], y[1], y[2], 0.0, z[0], z[1], z[2], 0.0, t[0], t[1], t[2], 1.0]
}

fn primitive(data: &mut Data, surface: &ShapeMesh, material: usize) -> Value {
    let positions: Vec<[f32; 3]> = surface.positions.iter().map(|p| narrow3(*p)).collect();
    let normals: Vec<[f32; 3]> = surface.normals.iter().map(|n| narrow3(*n)).collect();
    let weights: Vec<[f32; 4]> = surface.bindings.iter().map(|b| b.map(|(_, w)| num::narrow(w))).collect();
    // glTF requires index 0 for a joint without weight. There are far fewer than 256 joints and 65 536 vertices.
    let joint = |(joint, weight): (usize, f64)| {
        if weight == 0.0 { 0 } else { u8::try_from(joint).unwrap_or(0) }
    };
    let joints: Vec<u8> = surface.bindings.iter().flat_map(|b| b.map(joint)).collect();
    let index = |i: &usize| u16::try_from(*i).unwrap_or(0).to_le_bytes();
    let indices: Vec<u8> = surface.triangles.iter().flatten().flat_map(index).collect();
    let position = data.floats(&positions, Some(ARRAY_BUFFER), true);
    let normal = data.floats(&normals, Some(ARRAY_BUFFER), false);
    let described = json!({ "componentType": 5121, "count": surface.bindings.len(), "type": "VEC4" });
    let joints = data.add(&joints, Some(ARRAY_BUFFER), described);
    let weights = data.floats(&weights, Some(ARRAY_BUFFER), false);
    let described = json!({ "componentType": 5123, "count": surface.triangles.len() * 3, "type": "SCALAR" });
    let indices = data.add(&indices, Some(ELEMENT_ARRAY_BUFFER), described);
    json!({
        "attributes": { "POSITION": position, "NORMAL": normal, "JOINTS_0": joints, "WEIGHTS_0": weights },
        "indices": indices,
        "material": material,
    })
}

/// Makes a clip from the hips' offset and the rotation of every joint at each of its times.
fn clip(
    name: &str,
    times: impl Iterator<Item = f64>,
    (skeleton, rig): (&Skeleton, &[Bone]),
    at: impl Fn(f64) -> (DVec3, Vec<DQuat>),
) -> Result<Clip, Error> {
    let seconds: Vec<f64> = times.collect();
    let postures: Vec<_> = seconds.iter().map(|&t| at(t)).collect();
    let times: Arc<[f32]> = seconds.into_iter().map(num::narrow).collect();
    let places: Vec<Vec3> = postures.iter().map(|(hips, _)| narrow3(rig[0].translation(*hips)).into()).collect();
    let mut clip = Clip::new(name);
    if let Some(root) = skeleton.bone_of(0) {
        clip = clip.with_translation(root, line(&times, places)?);
    }
    for (index, bone) in rig.iter().enumerate() {
        let Some(node) = skeleton.bone_of(index) else { continue };
        if postures.iter().all(|(_, turns)| turns[index] == DQuat::IDENTITY) {
            continue;
        }
        let mut turns: Vec<Quat> = Vec::new();
        for (_, posture) in &postures {
            let turn = Quat::from_array(narrow4(bone.rotation(posture[index])));
            turns.push(continuous(turns.last(), turn));
        }
        clip = clip.with_rotation(node, line(&times, turns)?);
    }
    Ok(clip)
}
