//! Writes what fuzzing starts from: `seeds CORPUS [RIGS]`, a folder for each target below `CORPUS`.
//!
//! It stands here and not in `fuzz/`, a workspace of its own, because all that it needs is built for the tests.
//!
//! Models are the mannequin in two conventions, as glTF and as both versions of VRM, and each file in the folder `RIGS`, all of
//! them cut down. Animations start from nothing. Declarations are the bundled rigs in TOML, items those of the tests of error messages.

use std::fs;
use std::path::{Path, PathBuf};

use aim_character::{Measurement, PAPER_AXES, Role, mannequin};
use aim_gltf::Document;
use quote::ToTokens;
use serde_json::{Value, json};

#[expect(
    clippy::cast_possible_truncation,
    unreachable_pub,
    reason = "the library of fuzz/, for files of a few kilobytes"
)]
#[path = "../../fuzz/src/lib.rs"]
mod inputs;

type Result<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let corpus = arguments.next().ok_or("the corpus' folder is missing")?;
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");

    let models = corpus.join("model");
    fs::create_dir_all(&models)?;
    let leaning = [[0.6, 0.8, 0.0], [0.8, -0.6, 0.0], [0.0, 0.0, -1.0]];
    for (name, axes) in [("paper", PAPER_AXES), ("leaning", leaning)] {
        let document = Document::from_bytes(&mannequin(|_| axes)?)?;
        let plain = reduced(&document, &Value::Null)?;
        fs::write(models.join(format!("{name}.glb")), inputs::model_file(&plain))?;
        fs::write(models.join(name), plain)?;
        for version in [0, 1] {
            fs::write(models.join(format!("{name}-vrm{version}")), reduced(&document, &vrm(&document, version))?)?;
        }
    }
    if let Some(rigs) = arguments.next() {
        for file in files(&rigs, &["glb", "gltf", "vrm"])? {
            let name = file.file_name().unwrap_or_default();
            let document = Document::load(&file)?;
            fs::write(models.join(name), reduced(&document, &document.json()["extensions"])?)?;
        }
    }

    for target in ["animation", "declaration", "tokens"] {
        fs::create_dir_all(corpus.join(target))?;
    }
    for file in files(&repository.join("rigs"), &["toml"])? {
        let name = file.file_name().unwrap_or_default();
        fs::copy(&file, corpus.join("declaration").join(name))?;
    }
    for folder in ["tests/ui/ok", "tests/ui/err"] {
        for file in files(&repository.join(folder), &["rs"])? {
            // Some of those errors are the lexer's.
            let Ok(source) = syn::parse_file(&fs::read_to_string(&file)?) else { continue };
            for (number, item) in source.items.iter().enumerate() {
                if let syn::Item::Struct(_) | syn::Item::Enum(_) = item {
                    let name = format!("{}-{number}", file.file_stem().unwrap_or_default().display());
                    fs::write(corpus.join("tokens").join(name), item.to_token_stream().to_string())?;
                }
            }
        }
    }
    Ok(())
}

/// The files in a folder with one of these extensions, in the order of their names.
fn files(folder: &Path, extensions: &[&str]) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if extensions.iter().any(|extension| path.extension().is_some_and(|found| found == *extension)) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// A humanoid of VRM 0.x or 1.0 with the bones whose roles are known.
fn vrm(document: &Document, version: u32) -> Value {
    let measured = Measurement::of(document);
    let roles = [("leftEye", Role::LeftEye), ("rightEye", Role::RightEye), ("head", Role::Head), ("neck", Role::Neck)];
    let bones = roles.iter().filter_map(|(name, role)| Some((*name, measured.with_role(*role)?.node)));
    if version == 0 {
        let bones: Vec<Value> = bones.map(|(bone, node)| json!({ "bone": bone, "node": node })).collect();
        json!({ "VRM": { "humanoid": { "humanBones": bones } } })
    } else {
        let bones: Value = bones.map(|(bone, node)| (bone.to_owned(), json!({ "node": node }))).collect();
        json!({ "VRMC_vrm": { "specVersion": "1.0", "humanoid": { "humanBones": bones } } })
    }
}

/// A file cut down so that it can be changed often: no pictures, of meshes and clips a few elements, bind poses whole.
fn reduced(document: &Document, extensions: &Value) -> Result<Vec<u8>> {
    const VERTICES: usize = 48;
    const KEYS: usize = 4;
    let json = document.json();
    let chunk = document.binary_chunk().unwrap_or_default();
    let mut data = Data { json, chunk, accessors: Vec::new(), views: Vec::new(), bin: Vec::new() };
    let mut small = json!({ "asset": json["asset"] });
    for key in ["scene", "scenes", "nodes", "skins", "meshes", "animations"] {
        if !json[key].is_null() {
            small[key] = json[key].clone();
        }
    }
    if !extensions.is_null() {
        small["extensions"] = extensions.clone();
    }
    for skin in items(&mut small["skins"]) {
        data.keep(skin, "inverseBindMatrices", usize::MAX);
    }
    for mesh in items(&mut small["meshes"]) {
        for primitive in items(&mut mesh["primitives"]) {
            let mut attributes = json!({});
            for key in ["POSITION", "JOINTS_0", "WEIGHTS_0"] {
                attributes[key] = primitive["attributes"][key].clone();
                data.keep(&mut attributes, key, VERTICES);
            }
            *primitive = json!({ "attributes": attributes });
        }
    }
    if let Some(animations) = small["animations"].as_array_mut() {
        animations.truncate(1);
    }
    for animation in items(&mut small["animations"]) {
        for sampler in items(&mut animation["samplers"]) {
            data.keep(sampler, "input", KEYS);
            data.keep(sampler, "output", KEYS);
        }
    }
    small["accessors"] = data.accessors.into();
    small["bufferViews"] = data.views.into();
    small["buffers"] = json!([{ "byteLength": data.bin.len() }]);
    Ok(inputs::input_of(&serde_json::to_vec(&small)?, &data.bin))
}

fn items(list: &mut Value) -> impl Iterator<Item = &mut Value> {
    list.as_array_mut().into_iter().flatten()
}

/// The data kept of a file.
struct Data<'d> {
    json: &'d Value,
    chunk: &'d [u8],
    accessors: Vec<Value>,
    views: Vec<Value>,
    bin: Vec<u8>,
}

impl Data<'_> {
    /// Lets `owner[key]` name an accessor of at most so many elements, evenly chosen; removes it where there is no data.
    fn keep(&mut self, owner: &mut Value, key: &str, most: usize) {
        let kept = self.elements(&owner[key], most);
        let Some(owner) = owner.as_object_mut() else { return };
        let Some((mut accessor, elements)) = kept else {
            owner.remove(key);
            return;
        };
        accessor["bufferView"] = self.views.len().into();
        accessor["byteOffset"] = 0.into();
        accessor["count"] = elements.len().into();
        owner.insert(key.to_owned(), self.accessors.len().into());
        self.accessors.push(accessor);
        let bytes = elements.concat();
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len() }));
        self.bin.extend(bytes);
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
    }

    fn elements(&self, accessor: &Value, most: usize) -> Option<(Value, Vec<Vec<u8>>)> {
        let number = |value: &Value| value.as_u64().and_then(|value| usize::try_from(value).ok());
        let accessor = &self.json["accessors"][number(accessor)?];
        let view = &self.json["bufferViews"][number(&accessor["bufferView"])?];
        let components = match accessor["type"].as_str()? {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            _ => return None,
        };
        let size = components
            * match accessor["componentType"].as_u64()? {
                5120 | 5121 => 1,
                5122 | 5123 => 2,
                _ => 4,
            };
        let stride = number(&view["byteStride"]).unwrap_or(size);
        let start = number(&view["byteOffset"]).unwrap_or(0) + number(&accessor["byteOffset"]).unwrap_or(0);
        let count = number(&accessor["count"])?;
        let kept = count.min(most);
        let element = |i: usize| {
            let at = start + i * count / kept * stride;
            Some(self.chunk.get(at..at + size)?.to_vec())
        };
        Some((accessor.clone(), (0..kept).map(element).collect::<Option<_>>()?))
    }
}
