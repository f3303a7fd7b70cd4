//! Rods and balls, drawn as instances of one capsule; a ball is a rod of length 0.

use aim_runtime::glam::Vec3;
use three_d::{Blend, Context, CoreError, ElementBuffer, InstanceBuffer, Program, RenderStates, VertexBuffer};

use super::light::{self, Light};
use crate::picture::{Colour, Picture, Rod};

/// Vertices around the axis.
const SIDES: u32 = 24;
/// Rings of each hemisphere, from its rim to its pole.
const RINGS: u32 = 7;

pub(super) struct Marks {
    program: Program,
    /// For each vertex, its direction from an end of the axis, and the number of that end, 0 or 1.
    corners: VertexBuffer<[f32; 4]>,
    triangles: ElementBuffer<u32>,
    hidden: Instances,
    in_front: Instances,
}

/// Instance data of rods on the GPU.
struct Instances {
    from: InstanceBuffer<[f32; 3]>,
    to: InstanceBuffer<[f32; 3]>,
    /// The radius, and 1 if the rod is lit, else 0.
    kind: InstanceBuffer<[f32; 2]>,
    colour: InstanceBuffer<[f32; 4]>,
}

impl Marks {
    pub(super) fn new(context: &Context) -> Result<Self, CoreError> {
        let fragment = [light::GLSL, include_str!("shaders/mark.frag")].concat();
        let (corners, triangles) = capsule();
        Ok(Self {
            program: Program::from_source(context, include_str!("shaders/mark.vert"), &fragment)?,
            corners: VertexBuffer::new_with_data(context, &corners),
            triangles: ElementBuffer::new_with_data(context, &triangles),
            hidden: Instances::new(context),
            in_front: Instances::new(context),
        })
    }

    pub(super) fn fill(&mut self, picture: &Picture) {
        let (in_front, hidden): (Vec<Rod>, Vec<Rod>) = picture.rods.iter().partition(|rod| rod.in_front);
        self.hidden.fill(&hidden);
        self.in_front.fill(&in_front);
    }

    pub(super) fn draw(&self, light: &Light, in_front: bool) {
        let instances = if in_front { &self.in_front } else { &self.hidden };
        let count = instances.from.instance_count();
        if count == 0 {
            return;
        }
        let program = &self.program;
        light.send(program);
        program.use_vertex_attribute("corner", &self.corners);
        program.use_instance_attribute("from", &instances.from);
        program.use_instance_attribute("to", &instances.to);
        program.use_instance_attribute("kind", &instances.kind);
        program.use_instance_attribute("colour", &instances.colour);
        let states = RenderStates { blend: Blend::TRANSPARENCY, ..Default::default() };
        program.draw_elements_instanced(states, light.viewport, &self.triangles, count);
    }
}

impl Instances {
    fn new(context: &Context) -> Self {
        Self {
            from: InstanceBuffer::new(context),
            to: InstanceBuffer::new(context),
            kind: InstanceBuffer::new(context),
            colour: InstanceBuffer::new(context),
        }
    }

    fn fill(&mut self, rods: &[Rod]) {
        self.from.fill(&rods.iter().map(|rod| rod.from.to_array()).collect::<Vec<_>>());
        self.to.fill(&rods.iter().map(|rod| rod.to.to_array()).collect::<Vec<_>>());
        let kind = |rod: &Rod| [rod.radius, f32::from(u8::from(rod.is_lit))];
        self.kind.fill(&rods.iter().map(kind).collect::<Vec<_>>());
        self.colour.fill(&rods.iter().map(|rod| linear(rod.colour)).collect::<Vec<_>>());
    }
}

/// Returns the vertices and triangles of a rod along z: a hemisphere at each end, and a tube between their rims.
fn capsule() -> (Vec<[f32; 4]>, Vec<u32>) {
    #[expect(clippy::cast_precision_loss, reason = "a few sides")]
    let turn = |part: u32, whole: u32| std::f32::consts::TAU * part as f32 / whole as f32;
    let ring = |latitude: f32, end: f32| {
        let corner = move |side: u32| {
            let (sin, cos) = turn(side, SIDES).sin_cos();
            let direction = Vec3::new(latitude.cos() * cos, latitude.cos() * sin, latitude.sin());
            direction.extend(end).to_array()
        };
        (0..SIDES).map(corner)
    };
    let near = (0..=RINGS).flat_map(|k| ring(turn(k, 4 * RINGS) - turn(1, 4), 0.0));
    let far = (0..=RINGS).flat_map(|k| ring(turn(k, 4 * RINGS), 1.0));
    let quad = |k: u32| {
        move |side: u32| {
            let (a, b) = (k * SIDES + side, k * SIDES + (side + 1) % SIDES);
            [a, b, b + SIDES, a, b + SIDES, a + SIDES]
        }
    };
    let triangles = (0..=2 * RINGS).flat_map(|k| (0..SIDES).flat_map(quad(k)));
    (near.chain(far).collect(), triangles.collect())
}

/// Converts an sRGB colour to linear light; the opacity is only scaled to 0…1.
fn linear(colour: Colour) -> [f32; 4] {
    let [red, green, blue, opacity] = colour.map(|part| f32::from(part) / 255.0);
    let part = |x: f32| if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
    [part(red), part(green), part(blue), opacity]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rod_is_closed_and_seen_from_outside() {
        let (corners, triangles) = capsule();
        let place = |corner: u32| {
            let [x, y, z, end] = corners[corner as usize];
            Vec3::new(x, y, z + 3.0 * end)
        };
        assert!(triangles.iter().all(|corner| (*corner as usize) < corners.len()));
        let mut volume = 0.0;
        for corners in triangles.chunks_exact(3) {
            let [a, b, c] = [place(corners[0]), place(corners[1]), place(corners[2])];
            volume += a.dot(b.cross(c)) / 6.0;
        }
        // A unit ball and a tube of length 3, less the volume lost to the facets.
        let whole = std::f32::consts::PI * (4.0 / 3.0 + 3.0);
        assert!((0.97..1.0).contains(&(volume / whole)), "{volume} of {whole}");
    }

    #[test]
    fn colours_become_light() {
        assert_eq!(linear([0, 255, 0, 255]), [0.0, 1.0, 0.0, 1.0]);
        let grey = linear([188, 188, 188, 51]);
        assert!((grey[0] - 0.503).abs() < 1e-3 && (grey[3] - 0.2).abs() < 1e-6, "{grey:?}");
    }
}
