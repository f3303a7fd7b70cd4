//! [`Movers`]: joints and morph targets of each vertex, as the vertex shader takes them.

use aim_animation::Mesh;

/// Texels of shifts at most: as many rows of a texture as each OpenGL 3.3 and WebGL 2 takes.
const MOST_SHIFTS: usize = 1024 * 1024;

pub(crate) struct Movers {
    /// The four heaviest joints of each vertex, and their weights, together 1.
    pub(crate) joints: Vec<[u32; 4]>,
    pub(crate) weights: Vec<[f32; 4]>,
    /// For each vertex the first of its shifts, and their number.
    pub(crate) shifted: Vec<[u32; 2]>,
    /// Two texels for each: the way of the place with the target's index, and of the normal.
    pub(crate) shifts: Vec<[f32; 4]>,
}

impl Movers {
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let count = mesh.positions().len();
        let mut movers = Self { joints: Vec::new(), weights: Vec::new(), shifted: Vec::new(), shifts: Vec::new() };
        for vertex in 0..count {
            let heaviest = mesh.heaviest::<4>(vertex);
            movers.joints.push(heaviest.map(|influence| influence.joint));
            movers.weights.push(heaviest.map(|influence| influence.weight));
            let room = (MOST_SHIFTS - movers.shifts.len()) / 2;
            let morphs = mesh.morphs(vertex);
            let morphs = &morphs[..morphs.len().min(room)];
            let first = movers.shifts.len() / 2;
            for morph in morphs {
                #[expect(clippy::cast_precision_loss, reason = "a file has far fewer targets than 2²⁴")]
                let target = morph.target as f32;
                movers.shifts.extend([morph.position.extend(target).to_array(), morph.normal.extend(0.0).to_array()]);
            }
            movers.shifted.push([first, morphs.len()].map(|number| u32::try_from(number).unwrap_or(0)));
        }
        movers
    }
}
