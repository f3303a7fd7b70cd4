//! Eyes that a file moves with morph targets instead of bones: `ARKit` targets such as `eyeLookInLeft`, or the
//! expressions of a VRM file for looking left, right, up and down.
//!
//! Each such eye becomes a bone that is not a node of the file ([`Skeleton::is_in_file`](crate::Skeleton::is_in_file)).
//! It is placed in the middle of the vertices that its targets move, as a child of the joint that carries most of them.

use std::collections::BTreeMap;

use aim_animation::glam::{DAffine3, DVec3, Vec3};
use serde_json::Value;

use crate::accessor::Data;
use crate::look_at::{LookAt, LookAtKind, RangeMap};
use crate::raw::{Mesh, number};
use crate::skeleton::Skin;
use crate::skin::read_primitive;

/// Angles at which the targets of `ARKit` are assumed to have full weight, degrees: right, left, down, up. Files do not
/// state them; these are about the angles to which people turn their eyes before the head follows.
const FULL_DEG: [f64; 4] = [35.0, 35.0, 25.0, 20.0];
/// For each eye its bone name, its VRM bone name, and the `ARKit` targets for looking right, left, down and up.
const ARKIT: [(&str, &str, [&str; 4]); 2] = [
    ("left eye (morph targets)", "leftEye", ["eyeLookInLeft", "eyeLookOutLeft", "eyeLookDownLeft", "eyeLookUpLeft"]),
    (
        "right eye (morph targets)",
        "rightEye",
        ["eyeLookOutRight", "eyeLookInRight", "eyeLookDownRight", "eyeLookUpRight"],
    ),
];
/// Bone name, VRM bone name and expressions of VRM, which turn both eyes at once. Version 0.x spells the expressions in
/// lower case.
const EXPRESSIONS: (&str, &str, [&str; 4]) =
    ("eyes (morph targets)", "eyes", ["lookRight", "lookLeft", "lookDown", "lookUp"]);

/// An eye that looks by morph targets.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MorphEye {
    /// Its node in the skeleton, which is not a node of the file.
    pub node: usize,
    /// Looking right, left, down and up.
    pub ways: [MorphWay; 4],
}

/// Morph targets for looking in one direction.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MorphWay {
    /// Map from degrees to the common weight of the targets, 0…1; a map that moves nothing if there are no targets.
    pub map: RangeMap,
    /// The morph targets, of any meshes.
    pub binds: Vec<MorphBind>,
}

/// A morph target of a node's mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct MorphBind {
    /// The node that shows the mesh.
    pub node: usize,
    /// Index among the mesh's targets.
    pub target: usize,
    /// Its weight when the common weight is 1.
    pub weight: f64,
}

/// An eye to be added to the skeleton. All node indices are the file's, because adding bones renumbers the nodes.
pub(crate) struct FoundEye {
    pub(crate) name: &'static str,
    pub(crate) vrm_bone: &'static str,
    pub(crate) parent: usize,
    pub(crate) translation: Vec3,
    pub(crate) ways: [MorphWay; 4],
    /// Weights at rest of the meshes that show the eye, by node.
    pub(crate) at_rest: Vec<(usize, Vec<f32>)>,
}

/// Finds the eyes that look by morph targets. `extensions` are the document's.
pub(crate) fn find(data: &Data<'_>, skins: &[Skin], extensions: &Value) -> Vec<FoundEye> {
    let look = LookAt::read(extensions, &mut |_| ());
    let found = match look.filter(|look| look.kind == LookAtKind::Expression) {
        Some(look) => {
            let (name, bone, words) = EXPRESSIONS;
            let maps = [look.horizontal_outer, look.horizontal_outer, look.vertical_down, look.vertical_up];
            vec![(name, bone, ways(maps, words.map(|word| of_expression(data, extensions, word))))]
        }
        None => arkit(data),
    };
    let eye = |(name, vrm_bone, ways): (_, _, [MorphWay; 4])| {
        let place = place(data, skins, &ways).filter(|_| ways.iter().any(|way| way.map.moves()));
        let (parent, translation) = place?;
        let shown = ways.iter().flat_map(|way| &way.binds).map(|bind| bind.node);
        let at_rest = shown.map(|node| (node, weights_at_rest(data, node))).collect();
        Some(FoundEye { name, vrm_bone, parent, translation, ways, at_rest })
    };
    found.into_iter().filter_map(eye).collect()
}

fn ways(maps: [RangeMap; 4], binds: [Vec<MorphBind>; 4]) -> [MorphWay; 4] {
    let mut maps = maps.into_iter();
    binds.map(|binds| {
        let map = maps.next().filter(|_| !binds.is_empty());
        MorphWay { map: map.unwrap_or(RangeMap { input_max_value: 90.0, output_scale: 0.0 }), binds }
    })
}

/// Finds the eyes by the target names of `ARKit`.
fn arkit(data: &Data<'_>) -> Vec<(&'static str, &'static str, [MorphWay; 4])> {
    let mut named: BTreeMap<&str, Vec<MorphBind>> = BTreeMap::new();
    for (node, mesh) in data.raw.nodes.iter().enumerate().filter_map(|(at, node)| Some((at, node.mesh?))) {
        for (target, name) in target_names(data, mesh).enumerate().take(data.target_count(mesh)) {
            named.entry(name).or_default().push(MorphBind { node, target, weight: 1.0 });
        }
    }
    if !named.keys().any(|name| is_arkit(name)) {
        return Vec::new();
    }
    let maps = FULL_DEG.map(|input_max_value| RangeMap { input_max_value, output_scale: 1.0 });
    let eye = |(name, bone, words): (_, _, [&str; 4])| {
        (name, bone, ways(maps, words.map(|word| named.get(word).cloned().unwrap_or_default())))
    };
    ARKIT.map(eye).into()
}

/// Returns the names of a mesh's morph targets from `extras.targetNames`, which exporters attach to the mesh or to its
/// first primitive.
fn target_names<'a>(data: &Data<'a>, mesh: usize) -> impl Iterator<Item = &'a str> {
    let mesh = &data.raw.meshes[mesh];
    let names = |extras: &'a Value| extras.get("targetNames")?.as_array();
    let names = names(&mesh.extras).or_else(|| names(&mesh.primitives.first()?.extras));
    names.into_iter().flatten().map(|name| name.as_str().unwrap_or_default())
}

/// Returns `true` if a mesh names targets of `ARKit`.
pub(crate) fn names_morph_eyes(mesh: &Mesh) -> bool {
    let names = mesh.extras.get("targetNames").and_then(Value::as_array);
    names.into_iter().flatten().filter_map(Value::as_str).any(is_arkit)
}

fn is_arkit(name: &str) -> bool {
    name.starts_with("eyeLook")
}

/// Returns the morph targets bound to a VRM expression, in either version of the format; targets that do not exist are
/// skipped.
fn of_expression(data: &Data<'_>, extensions: &Value, word: &str) -> Vec<MorphBind> {
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
            // Version 0.x binds a target of a mesh, for every node that shows it. Its weights are percentages.
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
        mesh.is_some_and(|mesh| target < data.target_count(mesh))
    };
    let bind = |((node, target), weight)| MorphBind { node, target, weight };
    found.into_iter().map(bind).filter(|bind| is_there(bind.node, bind.target)).collect()
}

/// Returns the joint that carries most of the vertices moved by the targets, and their centre in the joint's space.
/// Each vertex is weighted by its squared displacement.
fn place(data: &Data<'_>, skins: &[Skin], ways: &[MorphWay; 4]) -> Option<(usize, Vec3)> {
    let mut moved: BTreeMap<usize, (f64, DVec3)> = BTreeMap::new();
    for MorphBind { node, target, .. } in ways.iter().flat_map(|way| &way.binds) {
        let skin = data.raw.nodes[*node].skin.and_then(|skin| skins.get(skin));
        for primitive in &data.raw.meshes[data.raw.nodes[*node].mesh?].primitives {
            let accessor = primitive.targets.get(target).and_then(|target| target.get("POSITION")?.as_u64());
            let Some(accessor) = accessor.and_then(|at| usize::try_from(at).ok()) else { continue };
            // Data that cannot be read does not contribute.
            let Ok(ways) = data.floats(accessor, &["VEC3"], "a morph target") else { continue };
            let Ok(points) = read_primitive(data, *node, primitive) else { continue };
            for (way, point) in ways.chunks_exact(3).zip(&points) {
                let share = Vec3::from_slice(way).as_dvec3().length_squared();
                let bound = point.heaviest().zip(skin);
                let (joint, bind) = bound.map_or((*node, None), |(at, skin)| (skin.joints[at], skin.binds[at]));
                let place = bind.unwrap_or(DAffine3::IDENTITY).transform_point3(point.position().as_dvec3());
                let (total, sum) = moved.entry(joint).or_default();
                *total += share;
                *sum += place * share;
            }
        }
    }
    let (joint, (total, sum)) = moved.into_iter().max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    Some((joint, (sum / total).as_vec3())).filter(|(_, place)| total > 0.0 && place.is_finite())
}

/// Returns the weights at rest of a node's mesh, one for each morph target.
pub(crate) fn weights_at_rest(data: &Data<'_>, node: usize) -> Vec<f32> {
    let node = &data.raw.nodes[node];
    let mesh = node.mesh.unwrap_or_default();
    let stated = [&node.weights, &data.raw.meshes[mesh].weights].into_iter().find_map(Value::as_array);
    let weight = |value: &Value| number(value).filter(|weight| weight.is_finite()).unwrap_or_default();
    let mut weights: Vec<f32> = stated.into_iter().flatten().map(weight).collect();
    weights.resize(data.target_count(mesh), 0.0);
    weights
}
