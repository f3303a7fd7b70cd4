//! Humanoid bones of a VRM file, versions 0.x and 1.0.

use serde_json::Value;

/// Returns (VRM bone name, node index) pairs from a file's `extensions`; malformed entries are skipped.
pub(crate) fn vrm_bones(extensions: &Value) -> Vec<(String, usize)> {
    let index = |value: &Value| value.get("node").and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok());
    let bones = |name: &str| extensions.get(name)?.get("humanoid")?.get("humanBones");
    match (bones("VRMC_vrm"), bones("VRM")) {
        (Some(Value::Object(map)), _) => {
            map.iter().filter_map(|(bone, value)| Some((bone.clone(), index(value)?))).collect()
        }
        (_, Some(Value::Array(list))) => {
            let entry = |value: &Value| Some((value.get("bone")?.as_str()?.to_owned(), index(value)?));
            list.iter().filter_map(entry).collect()
        }
        _ => Vec::new(),
    }
}
