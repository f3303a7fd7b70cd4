//! Small GLB reader for tests: nodes, clips and forward kinematics in double precision, written from the glTF 2.0
//! specification without any code of the library under test. Panics on unsupported content.

use aim_runtime::glam::{DMat4, DQuat, DVec3};
use base64::Engine as _;
use serde_json::Value;

/// Returns the JSON and the binary chunk of a GLB, or of a `.gltf` text with its only buffer as a data URI.
pub(crate) fn take_apart(glb: &[u8]) -> (Value, Vec<u8>) {
    if glb.starts_with(b"{") {
        let json: Value = serde_json::from_slice(glb).expect("JSON");
        let uri = json["buffers"][0]["uri"].as_str().expect("a data URI");
        let text = uri.split_once(";base64,").expect("a data URI").1;
        let bin = base64::engine::general_purpose::STANDARD.decode(text).expect("base 64");
        return (json, bin);
    }
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().expect("four bytes")) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()), "the GLB header");
    let json_end = 20 + word(12);
    let json = serde_json::from_slice(&glb[20..json_end]).expect("the JSON chunk parses");
    let bin = if glb.len() > json_end { glb[json_end + 8..json_end + 8 + word(json_end)].to_vec() } else { Vec::new() };
    (json, bin)
}

/// Returns the GLB of a JSON document and its binary chunk.
pub(crate) fn put_together(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = serde_json::to_vec(json).expect("JSON");
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let word = |n: usize| u32::try_from(n).expect("small").to_le_bytes();
    let total = word(28 + text.len() + bin.len());
    let parts: [&[u8]; 9] =
        [b"glTF", &word(2), &total, &word(text.len()), b"JSON", &text, &word(bin.len()), b"BIN\0", &bin];
    parts.concat()
}

/// Local transform of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    pub(crate) translation: DVec3,
    pub(crate) rotation: DQuat,
    pub(crate) scale: DVec3,
}

impl Local {
    pub(crate) fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(self.scale, self.rotation.normalize(), self.translation)
    }

    /// Returns the largest difference of two transforms: lengths relative to their size (at least 1), rotation in
    /// radians.
    pub(crate) fn difference(&self, other: &Self) -> f64 {
        let vector = |a: DVec3, b: DVec3| (a - b).length() / a.length().max(1.0);
        let turn = (self.rotation.normalize().inverse() * other.rotation.normalize()).xyz().length() * 2.0;
        turn.max(vector(self.translation, other.translation)).max(vector(self.scale, other.scale))
    }
}

#[derive(Debug)]
struct Channel {
    node: usize,
    path: String,
    interpolation: String,
    times: Vec<f64>,
    values: Vec<f64>,
}

/// One animation of the file.
#[derive(Debug)]
pub(crate) struct Clip {
    channels: Vec<Channel>,
    /// Time of the last key.
    pub(crate) seconds: f64,
}

/// Parsed model file.
pub(crate) struct Model {
    pub(crate) json: Value,
    pub(crate) bin: Vec<u8>,
    parents: Vec<Option<usize>>,
    rest: Vec<Local>,
}

fn items<'a>(json: &'a Value, key: &str) -> &'a [Value] {
    json[key].as_array().map_or(&[], Vec::as_slice)
}

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().expect("an index")).expect("small")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().map(|n| n.as_f64().expect("a number")).collect()
}

impl Model {
    pub(crate) fn new(glb: &[u8]) -> Self {
        let (json, bin) = take_apart(glb);
        let nodes = items(&json, "nodes");
        let mut parents = vec![None; nodes.len()];
        for (at, node) in nodes.iter().enumerate() {
            for child in items(node, "children") {
                parents[index(child)] = Some(at);
            }
        }
        let rest = nodes.iter().map(rest).collect();
        Self { parents, rest, json, bin }
    }

    /// Returns the only node with this name or, if there are several, the only one that a skin lists.
    pub(crate) fn node(&self, name: &str) -> usize {
        let called = |(at, node): &(usize, &Value)| match node.get("name") {
            Some(own) => own == name,
            None => name == format!("node{at}"),
        };
        let all = || items(&self.json, "nodes").iter().enumerate().filter(called);
        let joints: Vec<usize> =
            items(&self.json, "skins").iter().flat_map(|skin| items(skin, "joints")).map(index).collect();
        let mut named: Vec<usize> = all().map(|(at, _)| at).collect();
        if named.len() > 1 {
            named.retain(|at| joints.contains(at));
        }
        assert_eq!(named.len(), 1, "nodes called {name:?}");
        named[0]
    }

    pub(crate) fn parent(&self, node: usize) -> Option<usize> {
        self.parents[node]
    }

    pub(crate) fn rest(&self) -> &[Local] {
        &self.rest
    }

    /// Returns the index of the animation with this name; unnamed ones have the names that reports give them.
    pub(crate) fn clip_index(&self, name: &str) -> Option<usize> {
        let clips = items(&self.json, "animations").iter().enumerate();
        clips
            .map(|(at, clip)| clip["name"].as_str().map_or_else(|| format!("clip{at}"), str::to_owned))
            .position(|n| n == name)
    }

    pub(crate) fn clip(&self, at: usize) -> Clip {
        let clip = &self.json["animations"][at];
        let channels: Vec<Channel> = items(clip, "channels")
            .iter()
            .filter(|channel| channel["target"]["path"] != "weights")
            .map(|channel| {
                let sampler = &clip["samplers"][index(&channel["sampler"])];
                Channel {
                    node: index(&channel["target"]["node"]),
                    path: channel["target"]["path"].as_str().expect("a path").to_owned(),
                    interpolation: sampler["interpolation"].as_str().unwrap_or("LINEAR").to_owned(),
                    times: self.accessor(index(&sampler["input"])),
                    values: self.accessor(index(&sampler["output"])),
                }
            })
            .collect();
        let seconds = channels.iter().filter_map(|c| c.times.last()).fold(0.0, |a: f64, b| a.max(*b));
        Clip { channels, seconds }
    }

    /// Returns the local transforms of all nodes at a time of a clip.
    pub(crate) fn pose(&self, clip: &Clip, seconds: f64) -> Vec<Local> {
        let mut pose = self.rest.clone();
        for channel in &clip.channels {
            let value = channel.sample(seconds);
            let local = &mut pose[channel.node];
            match channel.path.as_str() {
                "translation" => local.translation = DVec3::from_slice(&value),
                "scale" => local.scale = DVec3::from_slice(&value),
                "rotation" => local.rotation = DQuat::from_slice(&value).normalize(),
                other => panic!("a channel of {other}"),
            }
        }
        pose
    }

    /// Returns the transform from node space to world space.
    pub(crate) fn world(&self, pose: &[Local], node: usize) -> DMat4 {
        let local = pose[node].matrix();
        self.parents[node].map_or(local, |parent| self.world(pose, parent) * local)
    }

    /// Returns the transform from node space to mesh space in the bind pose, for the first skin that lists the node.
    pub(crate) fn bind(&self, node: usize) -> DMat4 {
        let found = items(&self.json, "skins").iter().find_map(|skin| {
            let at = items(skin, "joints").iter().position(|joint| index(joint) == node)?;
            let matrices = self.accessor(index(skin.get("inverseBindMatrices")?));
            Some(DMat4::from_cols_slice(&matrices[16 * at..16 * (at + 1)]).inverse())
        });
        found.unwrap_or_else(|| panic!("no skin binds node {node}"))
    }

    /// Returns the numbers of an accessor, flattened.
    pub(crate) fn accessor(&self, at: usize) -> Vec<f64> {
        let accessor = &self.json["accessors"][at];
        assert!(accessor.get("sparse").is_none(), "sparse accessors are not read");
        let view = &self.json["bufferViews"][index(&accessor["bufferView"])];
        let offset = |v: &Value| v["byteOffset"].as_u64().map_or(0, |n| usize::try_from(n).expect("small"));
        let width = match accessor["type"].as_str().expect("a type") {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            other => panic!("an accessor of {other}"),
        };
        let kind = accessor["componentType"].as_u64().expect("a component type");
        let size = match kind {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let stride = view.get("byteStride").map_or(width * size, index);
        let start = offset(view) + offset(accessor);
        let component = |at: usize| {
            let b = &self.bin[at..at + size];
            match kind {
                5120 => (f64::from(i8::from_le_bytes([b[0]])) / 127.0).max(-1.0),
                5121 => f64::from(b[0]) / 255.0,
                5122 => (f64::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).max(-1.0),
                5123 => f64::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0,
                5126 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
                other => panic!("components of kind {other}"),
            }
        };
        let count = index(&accessor["count"]);
        (0..count)
            .flat_map(|k| (0..width).map(move |i| (k, i)))
            .map(|(k, i)| component(start + k * stride + i * size))
            .collect()
    }
}

fn rest(node: &Value) -> Local {
    if node.get("matrix").is_some() {
        let columns: [f64; 16] = numbers(&node["matrix"]).try_into().expect("16 numbers");
        let (scale, rotation, translation) = DMat4::from_cols_array(&columns).to_scale_rotation_translation();
        return Local { translation, rotation, scale };
    }
    let vector = |key: &str, default: DVec3| node.get(key).map_or(default, |v| DVec3::from_slice(&numbers(v)));
    Local {
        translation: vector("translation", DVec3::ZERO),
        rotation: node.get("rotation").map_or(DQuat::IDENTITY, |v| DQuat::from_slice(&numbers(v)).normalize()),
        scale: vector("scale", DVec3::ONE),
    }
}

impl Channel {
    fn sample(&self, seconds: f64) -> Vec<f64> {
        let cubic = self.interpolation == "CUBICSPLINE";
        let stride = self.values.len() / self.times.len();
        let width = if cubic { stride / 3 } else { stride };
        let part = |key: usize, part: usize| &self.values[key * stride + part * width..][..width];
        let value = |key: usize| part(key, usize::from(cubic));
        let next = self.times.partition_point(|t| *t <= seconds);
        if next == 0 || next == self.times.len() {
            return value(if next == 0 { 0 } else { next - 1 }).to_vec();
        }
        let span = self.times[next] - self.times[next - 1];
        let u = (seconds - self.times[next - 1]) / span;
        let (a, b) = (value(next - 1), value(next));
        match self.interpolation.as_str() {
            "STEP" => a.to_vec(),
            "LINEAR" if self.path == "rotation" => {
                slerp(DQuat::from_slice(a).normalize(), DQuat::from_slice(b).normalize(), u).to_array().to_vec()
            }
            "LINEAR" => a.iter().zip(b).map(|(a, b)| a + (b - a) * u).collect(),
            "CUBICSPLINE" => {
                let (out, into) = (part(next - 1, 2), part(next, 0));
                let hermite = |i: usize| {
                    (2.0 * u.powi(3) - 3.0 * u.powi(2) + 1.0) * a[i]
                        + span * (u.powi(3) - 2.0 * u.powi(2) + u) * out[i]
                        + (3.0 * u.powi(2) - 2.0 * u.powi(3)) * b[i]
                        + span * (u.powi(3) - u.powi(2)) * into[i]
                };
                (0..width).map(hermite).collect()
            }
            other => panic!("interpolation {other}"),
        }
    }
}

/// Interpolates along the shorter arc at constant speed.
fn slerp(a: DQuat, b: DQuat, u: f64) -> DQuat {
    let b = if a.dot(b) < 0.0 { -b } else { b };
    let half = (a.inverse() * b).xyz();
    let (sin, cos) = (half.length(), a.dot(b));
    if sin < 1e-9 {
        return (a * (1.0 - u) + b * u).normalize();
    }
    let angle = sin.atan2(cos) * u;
    let axis = half / sin * angle.sin();
    (a * DQuat::from_xyzw(axis.x, axis.y, axis.z, angle.cos())).normalize()
}
