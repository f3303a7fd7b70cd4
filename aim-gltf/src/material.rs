//! [`Material`]: base colours of surfaces and their images. Parts that cannot be read are left out.

use std::collections::HashMap;
use std::sync::Arc;

use aim_animation::glam::{Affine2, Vec2};
use serde_json::Value;

use crate::accessor::Data;
use crate::document::Document;
use crate::raw::number;
use crate::uri::{self, Uri};

/// Maximum total size of the images read, bytes; images that would exceed it are left out.
const MOST_IMAGE_BYTES: usize = 1 << 28;

/// Appearance of a part of the surface.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Material {
    /// Base colour: linear red, green, blue and opacity, in 0…1. Multiplies the texture.
    pub colour: [f32; 4],
    /// Picture of the base colour, if there is one that can be read.
    pub texture: Option<Texture>,
    /// Interpretation of opacity.
    pub alpha: Alpha,
    /// `true` if the back of a triangle is drawn.
    pub is_double_sided: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self { colour: [1.0; 4], texture: None, alpha: Alpha::Opaque, is_double_sided: false }
    }
}

/// Interpretation of opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Alpha {
    /// Opacity is ignored.
    Opaque,
    /// Fully opaque where opacity is at least this cutoff, invisible below it.
    Mask(f32),
    /// Opacity is the fraction blended over the background.
    Blend,
}

/// A picture and how it continues beyond its edges.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Texture {
    /// Index into [`Surface::images`](crate::Surface::images).
    pub image: usize,
    /// Continuation beyond its edges: horizontal, vertical.
    pub wrap: [Wrap; 2],
    /// The set of texture coordinates and the transform applied to them when they are read.
    pub(crate) set: u64,
    pub(crate) transform: Affine2,
}

/// Continuation of a picture beyond its edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The picture repeats.
    Repeat,
    /// The picture repeats, mirrored every second time.
    Mirror,
    /// The pixels at the edge repeat.
    Clamp,
}

/// Reads the materials of a document, in the file's order, and the encoded images that they use.
pub(crate) fn read(document: &Document, data: &Data<'_>) -> (Vec<Material>, Vec<Arc<[u8]>>) {
    let file = document.json();
    let mut images = Images { document, data, known: HashMap::new(), all: Vec::new(), left: MOST_IMAGE_BYTES };
    let list = file.get("materials").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let materials = list.iter().map(|material| read_one(material, file, &mut images)).collect();
    (materials, images.all)
}

fn read_one(material: &Value, file: &Value, images: &mut Images<'_>) -> Material {
    let flag = |key: &str| material.get(key).and_then(Value::as_bool).unwrap_or(false);
    let (surface, factor, texture) = base(material);
    let part = |i: usize| number(surface?.get(factor)?.get(i)?);
    let alpha = match material.get("alphaMode").and_then(Value::as_str) {
        Some("MASK") => Alpha::Mask(material.get("alphaCutoff").and_then(number).unwrap_or(0.5)),
        Some("BLEND") => Alpha::Blend,
        _ => Alpha::Opaque,
    };
    Material {
        colour: core::array::from_fn(|i| part(i).unwrap_or(1.0).clamp(0.0, 1.0)),
        texture: surface.and_then(|surface| read_texture(surface.get(texture)?, file, images)),
        alpha,
        is_double_sided: flag("doubleSided"),
    }
}

/// Returns the object that holds the base colour and the names of its factor and texture: those of the specification,
/// or those of `KHR_materials_pbrSpecularGlossiness` if only that is present.
fn base(material: &Value) -> (Option<&Value>, &'static str, &'static str) {
    let old = material.get("extensions").and_then(|all| all.get("KHR_materials_pbrSpecularGlossiness"));
    match material.get("pbrMetallicRoughness") {
        None if old.is_some() => (old, "diffuseFactor", "diffuseTexture"),
        surface => (surface, "baseColorFactor", "baseColorTexture"),
    }
}

fn read_texture(info: &Value, file: &Value, images: &mut Images<'_>) -> Option<Texture> {
    let texture = element(file, "textures", info.get("index")?)?;
    let sampler = texture.get("sampler").and_then(|at| element(file, "samplers", at));
    let wrap = |key: &str| match sampler.and_then(|sampler| sampler.get(key)?.as_u64()) {
        Some(33071) => Wrap::Clamp,
        Some(33648) => Wrap::Mirror,
        _ => Wrap::Repeat,
    };
    let change = info.get("extensions").and_then(|all| all.get("KHR_texture_transform"));
    let number = |value: &Value| number(value).filter(|x| x.is_finite());
    let pair = |key: &str| {
        let pair = change?.get(key)?;
        Some(Vec2::new(number(pair.get(0)?)?, number(pair.get(1)?)?))
    };
    let turn = change.and_then(|change| number(change.get("rotation")?)).unwrap_or(0.0);
    let set = change.and_then(|change| change.get("texCoord")).or(info.get("texCoord"));
    Some(Texture {
        image: images.find(usize::try_from(texture.get("source")?.as_u64()?).ok()?)?,
        wrap: [wrap("wrapS"), wrap("wrapT")],
        set: set.and_then(Value::as_u64).unwrap_or(0),
        // The extension's rotation is counter-clockwise as seen, but v points down: negate the angle.
        transform: Affine2::from_scale_angle_translation(
            pair("scale").unwrap_or(Vec2::ONE),
            -turn,
            pair("offset").unwrap_or(Vec2::ZERO),
        ),
    })
}

fn element<'a>(file: &'a Value, list: &str, index: &Value) -> Option<&'a Value> {
    file.get(list)?.get(usize::try_from(index.as_u64()?).ok()?)
}

/// Images, read on first use.
struct Images<'a> {
    document: &'a Document,
    data: &'a Data<'a>,
    /// Index into `all` by the file's image index; `None` if the image cannot be read.
    known: HashMap<usize, Option<usize>>,
    all: Vec<Arc<[u8]>>,
    /// Bytes left of [`MOST_IMAGE_BYTES`].
    left: usize,
}

impl Images<'_> {
    fn find(&mut self, index: usize) -> Option<usize> {
        if let Some(known) = self.known.get(&index) {
            return *known;
        }
        let bytes = self.read(index);
        let at = bytes.map(|bytes| {
            self.left -= bytes.len();
            self.all.push(bytes);
            self.all.len() - 1
        });
        self.known.insert(index, at);
        at
    }

    fn read(&self, index: usize) -> Option<Arc<[u8]>> {
        let image = self.document.json().get("images")?.get(index)?;
        let fits = |bytes: &[u8]| !bytes.is_empty() && bytes.len() <= self.left;
        if let Some(view) = image.get("bufferView") {
            let view = self.data.bytes(usize::try_from(view.as_u64()?).ok()?, "images").ok()?;
            return Some(view).filter(|bytes| fits(bytes)).map(Arc::from);
        }
        let bytes = match uri::parse(image.get("uri")?.as_str()?, "images").ok()? {
            Uri::Data(bytes) => bytes,
            Uri::Relative(path) => {
                let path = self.document.folder.as_ref()?.join(path);
                let size = std::fs::metadata(&path).ok()?.len();
                usize::try_from(size).ok().filter(|size| *size <= self.left)?;
                uri::read_file(&path).ok()?
            }
        };
        Some(bytes).filter(|bytes| fits(bytes)).map(Arc::from)
    }
}
