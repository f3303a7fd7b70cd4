//! Rasteriser for triangles: depth-buffered and smoothly lit, on a transparent background, encoded as a PNG in a
//! `data:` URI. The same triangles give the same bytes.
//!
//! A shaded figure as SVG triangles would be ten times as large and show its seams; only the lines over it are vectors.

use aim_animation::{Mesh, MeshPose, Skin};
use aim_gltf::{Document, Surface, Triangle};
use aim_runtime::glam::{Affine3A, DAffine3, DVec3, Vec3};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::projection::Projection;
use crate::words::count;

/// Samples per pixel in each direction.
const SAMPLES: usize = 2;
/// Direction to the key light in camera space: x right, y up, z to the viewer.
const LIGHT: DVec3 = DVec3::new(-0.40, 0.62, 0.67);
/// Share of ambient light.
const AMBIENT: f64 = 0.44;
/// Share of light from above.
const SKY: f64 = 0.16;
/// Share of the key light.
const KEY: f64 = 0.52;
/// Share of the picture's height at its lower edge over which a figure that is cut off there fades out.
pub(super) const FADE: f64 = 0.12;

/// Colour of a face.
#[derive(Clone, Copy, Debug)]
pub(super) enum Paint {
    /// One colour, sRGB in 0…1.
    Plain([f64; 3]),
    /// An eyeball about `centre` that looks along the unit vector `gaze`: white, iris and pupil.
    Eye { centre: DVec3, gaze: DVec3 },
}

/// A corner of a face.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Position in pixels, right and down, and nearness to the viewer.
    screen: DVec3,
    /// Unit normal in camera space.
    normal: DVec3,
    /// Position in the world, for [`Paint::Eye`].
    world: DVec3,
}

/// A triangle ready to be drawn.
#[derive(Clone, Copy, Debug)]
struct Face {
    corners: [Corner; 3],
    paint: Paint,
}

/// A picture to draw triangles into.
#[derive(Debug)]
pub(super) struct Raster {
    width: usize,
    height: usize,
    fade: f64,
    /// Faces of which a sample was visible when they were drawn.
    faces: Vec<Face>,
    /// Nearness of the nearest face at each sample.
    depth: Vec<f32>,
    /// Point of the nearest face at each sample.
    nearest: Vec<Hit>,
}

/// A point of a face, in barycentric coordinates. Small, because a picture has a million samples.
#[derive(Clone, Copy, Debug, Default)]
struct Hit {
    /// Index of the face in [`Raster::faces`].
    face: u32,
    /// Coordinate of the first corner.
    u: f32,
    /// Coordinate of the second corner; that of the third is `1 − u − v`.
    v: f32,
}

/// A surface with its skin, prepared for drawing in any number of poses.
pub(super) struct SkinnedSurface {
    pub(super) surface: Surface,
    mesh: Mesh,
    skin: Skin,
}

impl SkinnedSurface {
    pub(super) fn new(document: &Document) -> Self {
        let surface = document.surface();
        let (mesh, skin) = surface.mesh(document.skeleton());
        Self { surface, mesh, skin }
    }
}

impl Raster {
    /// Creates an empty picture of that many pixels. The drawing fades out over the share `fade` of the height at its
    /// lower edge.
    pub(super) fn new(width: usize, height: usize, fade: f64) -> Self {
        let samples = width * height * SAMPLES * SAMPLES;
        let (depth, nearest) = (vec![f32::NEG_INFINITY; samples], vec![Hit::default(); samples]);
        Self { width, height, fade, faces: Vec::new(), depth, nearest }
    }

    /// Draws a surface posed by the nodes at `world`, in a view whose unit is that many `pixels`.
    pub(super) fn draw_surface(
        &mut self,
        skinned: &SkinnedSurface,
        world: &[DAffine3],
        (view, pixels): (&Projection, f64),
        paint: impl Fn(&Triangle) -> Paint,
    ) {
        let SkinnedSurface { surface, mesh, skin } = skinned;
        let model: Vec<Affine3A> = world.iter().map(DAffine3::as_affine3a).collect();
        let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
        let (mut positions, mut normals) = (vec![Vec3::ZERO; surface.points().len()], Vec::new());
        normals.clone_from(&positions);
        // Cannot fail: all slices have the expected lengths.
        let _ = skin.matrices(&model, &mut matrices);
        let pose = MeshPose::new(&matrices).with_morph_weights(surface.morph_weights());
        let _ = mesh.deform(&pose, &mut positions);
        let _ = mesh.deform_normals(&pose, usize::MAX, &mut normals);
        for triangle in surface.triangles() {
            let corners = triangle.vertices.map(|vertex| {
                let world = positions[vertex].as_dvec3();
                let DVec3 { x, y, z } = view.project(world);
                let normal = view.turn(normals[vertex].as_dvec3());
                Corner { screen: DVec3::new(x * pixels, y * pixels, z), normal, world }
            });
            self.draw(Face { corners, paint: paint(triangle) });
        }
    }

    /// Draws one face into the samples where it is the nearest.
    ///
    /// The loops use plain numbers and slices instead of iterators and vectors, because a figure has millions of samples
    /// and test builds are barely optimised.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a picture has fewer than 2^32 faces, and f32 is finer than a pixel"
    )]
    fn draw(&mut self, face: Face) {
        let [a, b, c] = face.corners.map(|corner| corner.screen);
        let area = cross(b - a, c - a);
        if !(a.is_finite() && b.is_finite() && c.is_finite()) || area.abs() < 1e-9 {
            return;
        }
        let samples = count(SAMPLES);
        let span = |low: f64, high: f64, size: usize| {
            let end = count(size * SAMPLES);
            whole((low * samples - 0.5).ceil().clamp(0.0, end))..whole((high * samples + 0.5).floor().clamp(0.0, end))
        };
        let rows = span(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), self.height);
        let columns = span(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), self.width);
        // Barycentric coordinates are linear: u is 0 on the side bc and 1 at a; v is 0 on the side ca and 1 at b.
        let (bc_x, bc_y) = ((c.x - b.x) / area, (c.y - b.y) / area);
        let (ca_x, ca_y) = ((a.x - c.x) / area, (a.y - c.y) / area);
        let (first_x, step) = ((count(columns.start) + 0.5) / samples, 1.0 / samples);
        let (depths, nearest) = (self.depth.as_mut_slice(), self.nearest.as_mut_slice());
        let (index, mut is_seen) = (self.faces.len() as u32, false);
        for row in rows {
            let y = (count(row) + 0.5) / samples;
            let (u_of_row, v_of_row) = (bc_x * (y - b.y), ca_x * (y - c.y));
            let (mut at, mut x) = (row * self.width * SAMPLES + columns.start, first_x);
            let end = at + columns.len();
            while at < end {
                let u = u_of_row - bc_y * (x - b.x);
                let v = v_of_row - ca_y * (x - c.x);
                let w = 1.0 - u - v;
                if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                    let depth = (a.z * u + b.z * v + c.z * w) as f32;
                    if depth > depths[at] {
                        is_seen = true;
                        depths[at] = depth;
                        nearest[at] = Hit { face: index, u: u as f32, v: v as f32 };
                    }
                }
                at += 1;
                x += step;
            }
        }
        if is_seen {
            self.faces.push(face);
        }
    }

    /// Returns the picture as a `data:` URI; `None` if nothing was drawn.
    pub(super) fn data_uri(&self) -> Option<String> {
        if self.depth.iter().all(|depth| *depth == f32::NEG_INFINITY) {
            return None;
        }
        let mut bytes = Vec::new();
        let (width, height) = (u32::try_from(self.width).ok()?, u32::try_from(self.height).ok()?);
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        // One filter for all rows: quicker than the best of each row, and these pictures get no larger.
        encoder.set_filter(png::Filter::Up);
        let mut writer = encoder.write_header().ok()?;
        writer.write_image_data(&self.pixels()).ok()?;
        writer.finish().ok()?;
        Some(format!("data:image/png;base64,{}", STANDARD.encode(bytes)))
    }

    /// Returns red, green, blue and opacity of each pixel, as the mean of its samples.
    fn pixels(&self) -> Vec<u8> {
        let mut out = vec![0; self.width * self.height * 4];
        let light = LIGHT.normalize();
        let (depths, nearest, faces) = (self.depth.as_slice(), self.nearest.as_slice(), self.faces.as_slice());
        for y in 0..self.height {
            let fade = ((1.0 - (count(y) + 0.5) / count(self.height)) / self.fade).min(1.0);
            for x in 0..self.width {
                let (mut sum, mut hits, mut k) = (DVec3::ZERO, 0_usize, 0);
                let mut last: Option<(u32, DVec3)> = None;
                while k < SAMPLES * SAMPLES {
                    let at = (y * SAMPLES + k / SAMPLES) * self.width * SAMPLES + x * SAMPLES + k % SAMPLES;
                    if depths[at] > f32::NEG_INFINITY {
                        hits += 1;
                        let Hit { face, u, v } = nearest[at];
                        let painted = &faces[face as usize];
                        // Within a pixel, a face of one colour is lit once.
                        let colour = match last {
                            Some((of, colour)) if of == face && matches!(painted.paint, Paint::Plain(_)) => colour,
                            _ => {
                                let (u, v) = (f64::from(u), f64::from(v));
                                shade(painted, [u, v, 1.0 - u - v], light)
                            }
                        };
                        last = Some((face, colour));
                        sum += colour;
                    }
                    k += 1;
                }
                // An empty pixel stays transparent.
                if hits == 0 {
                    continue;
                }
                // Colours are rounded to steps of 4, which is invisible and halves the file.
                let part = |value: f64| byte(f64::from(byte(value / count(hits) * 63.0)) * (255.0 / 63.0));
                let opacity = byte(count(hits) / count(SAMPLES * SAMPLES) * fade * 255.0);
                let pixel = 4 * (y * self.width + x);
                out[pixel..pixel + 4].copy_from_slice(&[part(sum.x), part(sum.y), part(sum.z), opacity]);
            }
        }
        out
    }
}

/// Returns the colour of a face at these barycentric coordinates, lit from the direction `light`.
fn shade(face: &Face, [u, v, w]: [f64; 3], light: DVec3) -> DVec3 {
    let [a, b, c] = &face.corners;
    let normal = (a.normal * u + b.normal * v + c.normal * w).normalize_or(DVec3::Z);
    // Cloth and hair are single sheets: the side that faces the viewer is lit.
    let normal = if normal.z < 0.0 { -normal } else { normal };
    let base = match face.paint {
        Paint::Plain(colour) => colour,
        Paint::Eye { centre, gaze } => {
            let point = a.world * u + b.world * v + c.world * w;
            eye((point - centre).normalize_or(DVec3::ZERO).dot(gaze))
        }
    };
    let lit = AMBIENT + SKY * normal.y + KEY * normal.dot(light).max(0.0);
    // A darker rim separates the figure from any background.
    let rim = 0.62 + 0.38 * (normal.z / 0.45).min(1.0);
    let part = |part: f64| (part * lit * rim * 1.16).clamp(0.0, 1.0);
    DVec3::new(part(base[0]), part(base[1]), part(base[2]))
}

/// Returns the colour of an eyeball by the cosine of the angle from its axis; a human iris spans ±29°.
fn eye(along: f64) -> [f64; 3] {
    match along {
        x if x > 0.971 => [0.03, 0.03, 0.04],
        x if x > 0.878 => [0.20, 0.38, 0.52],
        x if x > 0.850 => [0.10, 0.18, 0.25],
        _ => [0.97, 0.96, 0.94],
    }
}

fn cross(a: DVec3, b: DVec3) -> f64 {
    a.x * b.y - a.y * b.x
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the picture by the caller")]
fn whole(value: f64) -> usize {
    value as usize
}

/// Returns the nearest byte.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "casts stop at the ends of the range")]
fn byte(value: f64) -> u8 {
    (value + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(depth: f64, colour: [f64; 3], corners: [[f64; 2]; 3]) -> Face {
        let corner =
            |[x, y]: [f64; 2]| Corner { screen: DVec3::new(x, y, depth), normal: DVec3::Z, world: DVec3::ZERO };
        Face { corners: corners.map(corner), paint: Paint::Plain(colour) }
    }

    #[test]
    fn the_nearest_face_is_seen_whatever_the_order() {
        let far = face(0.0, [1.0, 0.0, 0.0], [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]]);
        let near = face(1.0, [0.0, 1.0, 0.0], [[0.0, 8.0], [8.0, 0.0], [0.0, 0.0]]);
        for order in [[&far, &near], [&near, &far]] {
            let mut picture = Raster::new(8, 8, FADE);
            order.into_iter().for_each(|face| picture.draw(*face));
            let pixels = picture.pixels();
            let [red, green, _, alpha] = [pixels[0], pixels[1], pixels[2], pixels[3]];
            assert!(red == 0 && green > 100 && alpha == 255, "{red} {green} {alpha}");
            assert_eq!(pixels[pixels.len() - 1], 0, "the lower right corner is empty");
        }
    }

    #[test]
    fn nothing_is_no_picture_and_wild_numbers_are_nothing() {
        let mut picture = Raster::new(4, 4, FADE);
        assert_eq!(picture.data_uri(), None);
        picture.draw(face(0.0, [1.0; 3], [[f64::NAN, 0.0], [1.0, 0.0], [0.0, 1.0]]));
        picture.draw(face(0.0, [1.0; 3], [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0]]));
        assert_eq!(picture.data_uri(), None);
        picture.draw(face(0.0, [1.0; 3], [[-1e9, -1e9], [3e9, 0.0], [0.0, 3e9]]));
        assert!(picture.data_uri().is_some_and(|uri| uri.starts_with("data:image/png;base64,")));
    }
}
