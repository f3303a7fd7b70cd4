//! A hash that tells meshes apart.

use super::{Mesh, Morph};

impl Mesh {
    /// Hash of the positions, triangles, influences and morph targets, but not of the normals, computed when the mesh
    /// was made. Different meshes have the same hash with a probability of 2⁻⁶⁴.
    pub(crate) fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Computes an FNV-1a style hash, word by word.
    pub(super) fn computed_fingerprint(&self) -> u64 {
        // Adding 0 makes −0 the same as 0.
        let bits = |number: f32| (number + 0.0).to_bits();
        let positions = self.positions.iter().flat_map(|at| at.to_array()).map(bits);
        let influences = self.influences.iter().flat_map(|influence| [influence.joint, bits(influence.weight)]);
        let of_morph = |morph: &Morph| {
            let [x, y, z] = morph.position.to_array().map(bits);
            [morph.vertex, morph.target, x, y, z]
        };
        let words = positions
            .chain(self.triangles.as_flattened().iter().copied())
            .chain(influences)
            .chain(self.influence_ends.iter().copied())
            .chain(self.morphs.iter().flat_map(of_morph));
        words.fold(0, |hash: u64, word| (hash ^ (u64::from(word) + 1)).wrapping_mul(0x0000_0100_0000_01b3))
    }
}
