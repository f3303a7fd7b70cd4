//! [`Movers`]: joint influences and morph displacements of each vertex, in the layout of the vertex shader.

use aim_animation::Mesh;

/// Greatest number of texels in `shifts`: 1024 rows of 1024 texels. Every OpenGL 3.3 and WebGL 2 supports this size.
const MOST_SHIFTS: usize = 1024 * 1024;

pub(crate) struct Movers {
    /// The four joints of greatest weight for each vertex.
    pub(crate) joints: Vec<[u32; 4]>,
    /// The weights of these joints, which sum to 1.
    pub(crate) weights: Vec<[f32; 4]>,
    /// For each vertex, the index of its first morph displacement, and their number.
    pub(crate) shifted: Vec<[u32; 2]>,
    /// Two texels for each morph displacement: that of the position with the target's index, and that of the normal.
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
