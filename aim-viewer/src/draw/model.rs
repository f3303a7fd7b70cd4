//! Geometry that figures share: triangles by material, texture coordinates and textures.

use std::collections::{BTreeMap, HashMap};
use std::io::Cursor;
use std::sync::Arc;

use aim_animation::Mesh;
use aim_gltf::{Alpha, Material, Surface, Wrap};
use aim_runtime::glam::Vec3;
use image::ImageReader;
use three_d::{
    Context, CpuTexture, ElementBuffer, Interpolation, Mipmap, Texture2D, TextureData, VertexBuffer, Wrapping,
};

use super::movers::Movers;
use super::numbers;

/// Largest texture side that every OpenGL 3.3 and WebGL 2 supports, pixels. Larger images are scaled down.
const MOST_PIXELS: u32 = 2048;

/// A surface in its rest pose on the GPU, with joint weights and morph targets.
pub(super) struct Model {
    surface: Arc<Surface>,
    pub(super) positions: VertexBuffer<[f32; 3]>,
    pub(super) normals: VertexBuffer<[f32; 3]>,
    pub(super) joints: VertexBuffer<[u32; 4]>,
    pub(super) weights: VertexBuffer<[f32; 4]>,
    /// For each vertex, the index of its first morph displacement in `shifts`, and their number.
    pub(super) shifted: VertexBuffer<[u32; 2]>,
    pub(super) shifts: Texture2D,
    pub(super) texture_coordinates: VertexBuffer<[f32; 2]>,
    pub(super) tints: VertexBuffer<[f32; 4]>,
    pub(super) parts: Vec<Part>,
}

/// The triangles of one material.
pub(super) struct Part {
    pub(super) material: Material,
    pub(super) triangles: ElementBuffer<u32>,
    pub(super) texture: Arc<Texture2D>,
}

impl Model {
    pub(super) fn new(context: &Context, surface: &Arc<Surface>, mesh: &Mesh) -> Self {
        let flipped: Vec<[f32; 2]> = surface.texture_coordinates().iter().map(|at| [at.x, 1.0 - at.y]).collect();
        let movers = Movers::new(mesh);
        let white = Arc::new(Texture2D::new(context, &texture([1, 1], vec![[255; 4]], [Wrap::Clamp; 2])));
        let mut known = HashMap::new();
        let mut find = |material: &Material| {
            let wanted = material.texture.map(|texture| (texture.image, texture.wrap))?;
            let make = || {
                let (size, pixels) = decode(surface.images().get(wanted.0)?)?;
                Some(Arc::new(Texture2D::new(context, &texture(size, pixels, wanted.1))))
            };
            known.entry(wanted).or_insert_with(make).clone()
        };
        let part = |(material, corners): (Option<usize>, Vec<u32>)| {
            let material = material.map_or_else(Material::default, |at| surface.materials()[at].clone());
            let triangles = ElementBuffer::new_with_data(context, &corners);
            Part { triangles, texture: find(&material).unwrap_or_else(|| white.clone()), material }
        };
        Self {
            surface: surface.clone(),
            positions: VertexBuffer::new_with_data(context, &vectors(mesh.positions())),
            normals: VertexBuffer::new_with_data(context, &vectors(mesh.normals())),
            joints: VertexBuffer::new_with_data(context, &movers.joints),
            weights: VertexBuffer::new_with_data(context, &movers.weights),
            shifted: VertexBuffer::new_with_data(context, &movers.shifted),
            shifts: numbers::texture(context, &movers.shifts),
            texture_coordinates: VertexBuffer::new_with_data(context, &flipped),
            tints: VertexBuffer::new_with_data(context, surface.tints()),
            parts: by_material(surface).into_iter().map(part).collect(),
        }
    }

    pub(super) fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }
}

impl Part {
    /// Returns `true` if the part is alpha-blended.
    pub(super) fn is_translucent(&self) -> bool {
        self.material.alpha == Alpha::Blend
    }
}

fn vectors(vectors: &[Vec3]) -> Vec<[f32; 3]> {
    vectors.iter().map(Vec3::to_array).collect()
}

/// Returns the vertex indices of each material's triangles, in the order of the materials; those without a material
/// come first.
fn by_material(surface: &Surface) -> Vec<(Option<usize>, Vec<u32>)> {
    let mut parts = BTreeMap::<_, Vec<u32>>::new();
    for triangle in surface.triangles() {
        let corners = triangle.vertices.map(|vertex| u32::try_from(vertex).unwrap_or(0));
        parts.entry(triangle.material).or_default().extend(corners);
    }
    parts.into_iter().collect()
}

/// Decodes an image to its size and RGBA pixels, scaled down to [`MOST_PIXELS`] if larger; `None` if it cannot be
/// decoded.
fn decode(encoded: &[u8]) -> Option<([u32; 2], Vec<[u8; 4]>)> {
    let image = ImageReader::new(Cursor::new(encoded)).with_guessed_format().ok()?.decode().ok()?;
    let fits = image.width() <= MOST_PIXELS && image.height() <= MOST_PIXELS;
    let image = if fits { image } else { image.thumbnail(MOST_PIXELS, MOST_PIXELS) }.into_rgba8();
    Some((image.dimensions().into(), image.pixels().map(|pixel| pixel.0).collect()))
}

fn texture([width, height]: [u32; 2], pixels: Vec<[u8; 4]>, wrap: [Wrap; 2]) -> CpuTexture {
    let [wrap_s, wrap_t] = wrap.map(|wrap| match wrap {
        Wrap::Repeat => Wrapping::Repeat,
        Wrap::Mirror => Wrapping::MirroredRepeat,
        Wrap::Clamp => Wrapping::ClampToEdge,
    });
    CpuTexture {
        name: String::new(),
        data: TextureData::RgbaU8(pixels),
        width,
        height,
        min_filter: Interpolation::Linear,
        mag_filter: Interpolation::Linear,
        mipmap: Some(Mipmap::default()),
        wrap_s,
        wrap_t,
    }
}

#[cfg(test)]
mod tests {
    use aim_character::{PAPER_AXES, mannequin};
    use aim_gltf::Document;
    use image::{ImageFormat, RgbaImage};

    use super::*;

    #[test]
    fn each_triangle_is_in_the_part_of_its_material() {
        let document = Document::from_bytes(&mannequin(|_| PAPER_AXES).unwrap()).unwrap();
        let surface = document.surface();
        let parts = by_material(&surface);
        assert_eq!(parts.len(), surface.materials().len(), "one for each");
        let corners: usize = parts.iter().map(|(_, corners)| corners.len()).sum();
        assert_eq!(corners, 3 * surface.triangles().len());
        for (material, corners) in &parts {
            let of_it = surface.triangles().iter().filter(|triangle| triangle.material == *material);
            let expected: Vec<usize> = of_it.flat_map(|triangle| triangle.vertices).collect();
            assert!(corners.iter().map(|corner| *corner as usize).eq(expected), "{material:?}");
        }
    }

    #[test]
    fn pictures_are_made_small_enough_and_broken_ones_are_none() {
        let encoded = |width, height| {
            let mut bytes = Cursor::new(Vec::new());
            RgbaImage::from_pixel(width, height, image::Rgba([9, 8, 7, 6]))
                .write_to(&mut bytes, ImageFormat::Png)
                .unwrap();
            bytes.into_inner()
        };
        assert_eq!(decode(&encoded(3, 1)), Some(([3, 1], vec![[9, 8, 7, 6]; 3])));
        let (size, pixels) = decode(&encoded(5000, 20)).unwrap();
        assert_eq!(size, [2048, 8]);
        assert_eq!(pixels.len(), 2048 * 8);
        assert_eq!(decode(b"no picture"), None);
        assert_eq!(decode(&encoded(30, 30)[..60]), None, "cut off");
    }
}
