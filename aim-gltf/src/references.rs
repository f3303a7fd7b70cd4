//! All references of a document to its accessors and buffer views.

use std::collections::BTreeSet;

use serde_json::Value;

/// Name prefixes of extensions that refer to no accessor and no buffer view.
const WITHOUT_REFERENCES: [&str; 9] = [
    "KHR_animation_pointer",
    "KHR_lights_",
    "KHR_materials_",
    "KHR_mesh_quantization",
    "KHR_node_",
    "KHR_texture_",
    "KHR_xmp",
    "EXT_texture_",
    "VRM",
];
const DRACO: &str = "KHR_draco_mesh_compression";
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Returns `true` if the functions of this module visit all references of the document: it has no extension that may
/// contain others.
pub(crate) fn are_known(json: &Value) -> bool {
    let is_known = |name: &str| {
        [DRACO, INSTANCING].contains(&name) || WITHOUT_REFERENCES.iter().any(|begin| name.starts_with(begin))
    };
    match json {
        Value::Object(members) => members.iter().all(|(key, value)| {
            let extensions = if key == "extensions" { value.as_object() } else { None };
            extensions.is_none_or(|all| all.keys().all(|name| is_known(name))) && (key == "extras" || are_known(value))
        }),
        Value::Array(elements) => elements.iter().all(are_known),
        _ => true,
    }
}

/// Calls `visit` with each reference to an accessor.
pub(crate) fn visit_accessors(json: &mut Value, visit: &mut dyn FnMut(&mut Value)) {
    for primitive in list(json, "meshes").flat_map(|mesh| list(mesh, "primitives")) {
        members(primitive, "attributes").for_each(&mut *visit);
        primitive.get_mut("indices").into_iter().for_each(&mut *visit);
        let targets = list(primitive, "targets").filter_map(Value::as_object_mut);
        targets.flat_map(|target| target.values_mut()).for_each(&mut *visit);
    }
    list(json, "skins").filter_map(|skin| skin.get_mut("inverseBindMatrices")).for_each(&mut *visit);
    for sampler in list(json, "animations").flat_map(|animation| list(animation, "samplers")) {
        ["input", "output"].into_iter().for_each(|key| sampler.get_mut(key).into_iter().for_each(&mut *visit));
    }
    let instances = list(json, "nodes").filter_map(|node| node.get_mut("extensions")?.get_mut(INSTANCING));
    instances.flat_map(|instances| members(instances, "attributes")).for_each(visit);
}

/// Calls `visit` with each reference to a buffer view that does not come from an accessor.
pub(crate) fn visit_other_views(json: &mut Value, visit: &mut dyn FnMut(&mut Value)) {
    list(json, "images").filter_map(|image| image.get_mut("bufferView")).for_each(&mut *visit);
    let primitives = list(json, "meshes").flat_map(|mesh| list(mesh, "primitives"));
    primitives
        .filter_map(|primitive| primitive.get_mut("extensions")?.get_mut(DRACO)?.get_mut("bufferView"))
        .for_each(visit);
}

/// Calls `visit` with each reference from an accessor to a buffer view.
pub(crate) fn visit_views_of(accessor: &mut Value, visit: &mut dyn FnMut(&mut Value)) {
    accessor.get_mut("bufferView").into_iter().for_each(&mut *visit);
    for part in ["indices", "values"] {
        let view = accessor.get_mut("sparse").and_then(|sparse| sparse.get_mut(part)?.get_mut("bufferView"));
        view.into_iter().for_each(&mut *visit);
    }
}

/// Returns the indices of the accessors that an animation uses.
pub(crate) fn accessors_of(animation: &Value) -> BTreeSet<usize> {
    let samplers = animation.get("samplers").and_then(Value::as_array).into_iter().flatten();
    samplers.flat_map(|sampler| ["input", "output"].map(|key| index(sampler.get(key)))).flatten().collect()
}

/// Converts a reference to an index.
pub(crate) fn index(reference: Option<&Value>) -> Option<usize> {
    reference?.as_u64().and_then(|index| usize::try_from(index).ok())
}

/// Returns the elements of the array `key`; none if there is no such array.
pub(crate) fn list<'a>(json: &'a mut Value, key: &str) -> impl Iterator<Item = &'a mut Value> + use<'a> {
    json.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten()
}

fn members<'a>(json: &'a mut Value, key: &str) -> impl Iterator<Item = &'a mut Value> + use<'a> {
    json.get_mut(key).and_then(Value::as_object_mut).into_iter().flat_map(|members| members.values_mut())
}
