//! Eyes that a file shows by morph targets instead of bones: `eyeLookInLeft` and the others of `ARKit`, or the expressions
//! of a VRM file that look left, right, up and down.
//!
//! Such an eye becomes a node behind those of the file ([`Skeleton::is_in_file`]): it stands amid the vertices that its targets
//! move, on the joint that carries most of them, and is aimed as the bone of an eye is. [`MorphEyes`] turns its rotation into
//! weights, and the weights of a clip into its rotation.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use serde_json::Value;

use crate::accessor::Data;
use crate::chain::ChainNodes;
use crate::clip::{Channel, Clip, Property};
use crate::look_at::{LookAt, LookAtKind, RangeMap};
use crate::measure::{BoneFrame, Measurement};
use crate::num;
use crate::roles::{Role, Roles};
use crate::skeleton::Skeleton;
use crate::skin::{carrier, read_primitive};
use crate::trs::Trs;

/// Angles at which the targets of `ARKit` are taken to have their full weight, degrees: to the right, to the left, down and up, as
/// far as people turn their eyes before the head follows. Files do not tell.
const FULL_DEG: [f64; 4] = [35.0, 35.0, 25.0, 20.0];
/// For both eyes the targets of `ARKit` that look right, left, down and up.
const ARKIT: [(&str, &str, [&str; 4]); 2] = [
    ("left eye (morph targets)", "leftEye", ["eyeLookInLeft", "eyeLookOutLeft", "eyeLookDownLeft", "eyeLookUpLeft"]),
    (
        "right eye (morph targets)",
        "rightEye",
        ["eyeLookOutRight", "eyeLookInRight", "eyeLookDownRight", "eyeLookUpRight"],
    ),
];
/// The same of VRM's expressions, which turn both eyes at once; version 0 has these words in lower case.
const EXPRESSIONS: (&str, &str, [&str; 4]) =
    ("eyes (morph targets)", "eyes", ["lookRight", "lookLeft", "lookDown", "lookUp"]);

/// An eye that looks by morph targets.
#[derive(Debug, Clone)]
pub(crate) struct MorphEye {
    /// Its node, behind those of the file.
    pub(crate) node: usize,
    /// To the right, to the left, down, up.
    ways: [Way; 4],
}

/// What looking one way does.
#[derive(Debug, Clone)]
struct Way {
    /// From degrees to the weight of the expression.
    map: RangeMap,
    binds: Vec<Bind>,
}

/// A morph target of a node's mesh, and its weight at an expression's weight of 1.
#[derive(Debug, Clone, Copy)]
struct Bind {
    node: usize,
    target: usize,
    weight: f64,
}

impl MorphEye {
    /// From degrees to the weights of what looks right, left, down and up; one that moves nothing where no target does.
    pub(crate) fn maps(&self) -> [RangeMap; 4] {
        self.ways.each_ref().map(|way| way.map)
    }

    /// The weights, 0…1, of what looks right, left, down and up, at a heading and a pitch in radians.
    fn weights(&self, [heading, pitch]: [f64; 2]) -> [f64; 4] {
        let ways = [-heading, heading, -pitch, pitch].map(f64::to_degrees);
        core::array::from_fn(|at| self.ways[at].map.apply(ways[at]).min(1.0))
    }

    /// The heading and pitch, radians, at which the targets have these weights: what they look one way less what they look the
    /// other way.
    fn angles(&self, weight: impl Fn(&Bind) -> f64) -> [f64; 2] {
        let [right, left, down, up] = self.ways.each_ref().map(|way| {
            let of_expression = way.binds.first().map_or(0.0, |bind| weight(bind) / bind.weight);
            way.map.input(of_expression.min(1.0)).to_radians()
        });
        [left - right, up - down]
    }
}

/// Adds a node for each eye that looks by morph targets. `extensions` are the document's.
pub(crate) fn add(skeleton: &mut Skeleton, data: &Data<'_>, extensions: &Value) {
    let look = LookAt::read(extensions).map(|(look, _)| look);
    let found = match look.filter(|look| look.kind == LookAtKind::Expression) {
        Some(look) => {
            let (name, bone, words) = EXPRESSIONS;
            let maps = [look.horizontal_outer, look.horizontal_outer, look.vertical_down, look.vertical_up];
            vec![(name, bone, ways(maps, words.map(|word| of_expression(data, extensions, word))))]
        }
        None => arkit(skeleton, data),
    };
    for (name, bone, ways) in found {
        if let Some((parent, place)) = place(skeleton, data, &ways).filter(|_| ways.iter().any(|way| way.map.moves())) {
            let node = skeleton.add(name, bone, parent, place);
            for Bind { node, .. } in ways.iter().flat_map(|way| &way.binds) {
                skeleton.morph_weights.entry(*node).or_insert_with(|| weights_at_rest(data, *node));
            }
            skeleton.morph_eyes.push(MorphEye { node, ways });
        }
    }
}

fn ways(maps: [RangeMap; 4], binds: [Vec<Bind>; 4]) -> [Way; 4] {
    let mut maps = maps.into_iter();
    binds.map(|binds| {
        let map = maps.next().filter(|_| !binds.is_empty());
        Way { map: map.unwrap_or(RangeMap { input_max_value: 90.0, output_scale: 0.0 }), binds }
    })
}

/// The eyes by the names of `ARKit`, where no bone is an eye.
fn arkit(skeleton: &Skeleton, data: &Data<'_>) -> Vec<(&'static str, &'static str, [Way; 4])> {
    let mut named: BTreeMap<&str, Vec<Bind>> = BTreeMap::new();
    for (node, mesh) in data.raw.nodes.iter().enumerate().filter_map(|(at, node)| Some((at, node.mesh?))) {
        for (target, name) in target_names(data, mesh).enumerate().take(target_count(data, mesh)) {
            named.entry(name).or_default().push(Bind { node, target, weight: 1.0 });
        }
    }
    if !named.keys().any(|name| name.starts_with("eyeLook")) {
        return Vec::new();
    }
    let roles = Roles::find(skeleton);
    let is_eye = |node: usize| matches!(roles.of(node), Some(Role::LeftEye | Role::RightEye));
    if (0..skeleton.nodes().len()).any(is_eye) {
        return Vec::new();
    }
    let maps = FULL_DEG.map(|input_max_value| RangeMap { input_max_value, output_scale: 1.0 });
    let eye = |(name, bone, words): (_, _, [&str; 4])| {
        (name, bone, ways(maps, words.map(|word| named.get(word).cloned().unwrap_or_default())))
    };
    ARKIT.map(eye).into()
}

/// The names of a mesh's morph targets, as exporters write them: beside the mesh or beside its first primitive.
fn target_names<'a>(data: &Data<'a>, mesh: usize) -> impl Iterator<Item = &'a str> {
    let mesh = &data.raw.meshes[mesh];
    let names = |extras: &'a Value| extras.get("targetNames")?.as_array();
    let names = names(&mesh.extras).or_else(|| names(&mesh.primitives.first()?.extras));
    names.into_iter().flatten().map(|name| name.as_str().unwrap_or_default())
}

fn target_count(data: &Data<'_>, mesh: usize) -> usize {
    data.raw.meshes[mesh].primitives.first().and_then(|first| first.targets.as_array()).map_or(0, Vec::len)
}

/// What a VRM expression binds, in either version of the format; targets that are not there are left out.
fn of_expression(data: &Data<'_>, extensions: &Value, word: &str) -> Vec<Bind> {
    let index = |bind: &Value, key: &str| bind.get(key)?.as_u64().and_then(|at| usize::try_from(at).ok());
    let weight = |bind: &Value, whole: f64| {
        bind.get("weight").and_then(Value::as_f64).map(|weight| weight / whole).filter(|weight| *weight > 0.0)
    };
    let list = |value: Option<&Value>, key: &str| -> Vec<Value> {
        value.and_then(|value| value.get(key)?.as_array()).cloned().unwrap_or_default()
    };
    let mut found = Vec::new();
    if let Some(vrm) = extensions.get("VRMC_vrm") {
        let expression = vrm.get("expressions").and_then(|all| all.get("preset")?.get(word));
        for bind in list(expression, "morphTargetBinds") {
            found.extend(index(&bind, "node").zip(index(&bind, "index")).zip(weight(&bind, 1.0)));
        }
    } else if let Some(vrm) = extensions.get("VRM") {
        let is_meant = |group: &&Value| {
            group.get("presetName").and_then(Value::as_str).is_some_and(|name| name.eq_ignore_ascii_case(word))
        };
        let groups = list(vrm.get("blendShapeMaster"), "blendShapeGroups");
        for bind in list(groups.iter().find(is_meant), "binds") {
            // Of a mesh, whichever nodes show it; weights are percentages.
            let Some(((mesh, target), weight)) =
                index(&bind, "mesh").zip(index(&bind, "index")).zip(weight(&bind, 100.0))
            else {
                continue;
            };
            let shown = data.raw.nodes.iter().enumerate().filter(|(_, node)| node.mesh == Some(mesh));
            found.extend(shown.map(|(node, _)| ((node, target), weight)));
        }
    }
    let is_there = |node: usize, target: usize| {
        let mesh = data.raw.nodes.get(node).and_then(|node| node.mesh);
        mesh.is_some_and(|mesh| target < target_count(data, mesh))
    };
    let bind = |((node, target), weight)| Bind { node, target, weight };
    found.into_iter().map(bind).filter(|bind| is_there(bind.node, bind.target)).collect()
}

/// The joint that carries most of what the targets move, and the middle of that in the joint's space; vertices count by the
/// squares of their ways.
fn place(skeleton: &Skeleton, data: &Data<'_>, ways: &[Way; 4]) -> Option<(usize, Vec3)> {
    let mut moved: BTreeMap<usize, (f64, DVec3)> = BTreeMap::new();
    for Bind { node, target, .. } in ways.iter().flat_map(|way| &way.binds) {
        for primitive in &data.raw.meshes[data.raw.nodes[*node].mesh?].primitives {
            let accessor = primitive.targets.get(target).and_then(|target| target.get("POSITION")?.as_u64());
            let Some(accessor) = accessor.and_then(|at| usize::try_from(at).ok()) else { continue };
            // What cannot be read tells no place.
            let Ok(ways) = data.floats(accessor, &["VEC3"], "a morph target") else { continue };
            let Ok(points) = read_primitive(data, *node, primitive) else { continue };
            for (way, point) in ways.chunks_exact(3).zip(&points) {
                let share = Vec3::from_slice(way).as_dvec3().length_squared();
                let joint = carrier(skeleton, point);
                let place = skeleton.bound_place(*node, joint, point.position().as_dvec3());
                let (total, sum) = moved.entry(joint).or_default();
                *total += share;
                *sum += place * share;
            }
        }
    }
    let (joint, (total, sum)) = moved.into_iter().max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    Some((joint, (sum / total).as_vec3())).filter(|(_, place)| total > 0.0 && place.is_finite())
}

/// The weights of a node's mesh where no clip has any, one for each target.
fn weights_at_rest(data: &Data<'_>, node: usize) -> Vec<f32> {
    let node = &data.raw.nodes[node];
    let mesh = node.mesh.unwrap_or_default();
    let stated = [&node.weights, &data.raw.meshes[mesh].weights].into_iter().find_map(Value::as_array);
    let weight = |value: &Value| num::narrow(value.as_f64().unwrap_or_default());
    let mut weights: Vec<f32> = stated.into_iter().flatten().map(weight).map(finite).collect();
    weights.resize(target_count(data, mesh), 0.0);
    weights
}

fn finite(weight: f32) -> f32 {
    if weight.is_finite() { weight } else { 0.0 }
}

/// The eyes of a chain that look by morph targets.
#[derive(Debug, Clone)]
pub(crate) struct MorphEyes {
    /// Each with the axes of its node.
    eyes: Vec<(MorphEye, BoneFrame)>,
    /// The weights of the nodes that show them, where no clip has any.
    at_rest: BTreeMap<usize, Vec<f32>>,
}

impl MorphEyes {
    pub(crate) fn find(skeleton: &Skeleton, measurement: &Measurement, chain: &ChainNodes) -> Self {
        let is_turned = |eye: &&MorphEye| chain.turned().any(|node| node == eye.node);
        let eyes = skeleton.morph_eyes.iter().filter(is_turned);
        let eyes: Vec<_> = eyes.filter_map(|eye| Some((eye.clone(), measurement.bone(eye.node)?.frame))).collect();
        let binds = eyes.iter().flat_map(|(eye, _)| eye.ways.iter().flat_map(|way| &way.binds));
        let at_rest = binds.filter_map(|bind| Some((bind.node, skeleton.morph_weights.get(&bind.node)?.clone())));
        Self { at_rest: at_rest.collect(), eyes }
    }

    /// The nodes whose weights the eyes set.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.at_rest.keys().copied()
    }

    /// Turns each eye to where the weights at a time of a clip have it.
    pub(crate) fn pose(&self, clip: Option<&Clip>, seconds: f32, pose: &mut [Trs]) {
        for (eye, frame) in &self.eyes {
            let angles = eye.angles(|bind| f64::from(self.weights(clip, seconds, bind.node)[bind.target]));
            pose[eye.node].rotation = frame.turn(angles).as_quat();
        }
    }

    /// The weights of each of the [nodes](Self::nodes), in their order: those of a clip, changed by what `pose` turns the eyes
    /// further. No weight leaves 0…1 by that.
    pub(crate) fn aimed(&self, clip: Option<&Clip>, seconds: f32, pose: &[Trs]) -> Vec<Vec<f32>> {
        let animated: BTreeMap<usize, Vec<f32>> =
            self.nodes().map(|node| (node, self.weights(clip, seconds, node))).collect();
        let mut aimed = animated.clone();
        for (eye, frame) in &self.eyes {
            let before = eye.angles(|bind| f64::from(animated[&bind.node][bind.target]));
            let after = frame.angles(pose[eye.node].rotation.as_dquat());
            for ((way, before), after) in eye.ways.iter().zip(eye.weights(before)).zip(eye.weights(after)) {
                for bind in &way.binds {
                    let was = animated[&bind.node][bind.target];
                    if let Some(weight) = aimed.get_mut(&bind.node).and_then(|of| of.get_mut(bind.target)) {
                        let changed = *weight + num::narrow(bind.weight * (after - before));
                        *weight = changed.clamp(was.min(0.0), was.max(1.0));
                    }
                }
            }
        }
        aimed.into_values().collect()
    }

    /// All weights of a node at a time of a clip.
    fn weights(&self, clip: Option<&Clip>, seconds: f32, node: usize) -> Vec<f32> {
        let at_rest = &self.at_rest[&node];
        let is_of_node = |channel: &&Channel| channel.node == node && channel.property == Property::Weights;
        let channel = clip.and_then(|clip| clip.channels.iter().find(is_of_node));
        let mut weights = channel.map_or_else(|| at_rest.clone(), |channel| channel.sample(seconds));
        weights.resize(at_rest.len(), 0.0);
        weights
    }
}
