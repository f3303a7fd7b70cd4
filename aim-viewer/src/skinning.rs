//! [`Skinning`]: the mesh of a character, what moves its vertices, and the boxes of its bones.

use aim_animation::glam::{Affine3A, Vec3A};
use aim_animation::{BoneBoxes, Clip, Cursor, Hit, Mesh, MeshError, MeshPose, OrientedBox, Ray, Skin, matrix_rows};
use aim_gltf::{Document, Surface};
use aim_runtime::glam::{DAffine3, Vec3};

use crate::picture::Figure;

/// Made once for each character.
#[derive(Debug)]
pub(crate) struct Skinning {
    pub(crate) mesh: Mesh,
    skin: Skin,
    boxes: BoneBoxes,
    /// The scalar of the document's clips that is each morph target's weight.
    scalars: Vec<Option<usize>>,
    /// The weights of the morph targets where no clip has any.
    at_rest: Vec<f32>,
}

/// What moves the mesh in a frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Posed {
    pub(crate) matrices: Vec<Affine3A>,
    pub(crate) morphs: Vec<f32>,
}

impl Posed {
    fn pose(&self) -> MeshPose<'_> {
        MeshPose::new(&self.matrices).with_morph_weights(&self.morphs)
    }
}

impl Skinning {
    /// # Errors
    /// None that can be met: the surface's mesh hangs on the surface's skin.
    pub(crate) fn new(document: &Document, surface: &Surface) -> Result<Self, MeshError> {
        let (mesh, skin) = surface.mesh(document.skeleton());
        let boxes = BoneBoxes::new(&mesh, &skin)?;
        let mut scalars = vec![None; surface.morph_weights().len()];
        for node in 0..document.skeleton().len() {
            let targets = surface.morph_targets(node);
            targets.zip(document.morph_scalars(node)).for_each(|(target, scalar)| scalars[target] = Some(scalar));
        }
        Ok(Self { mesh, skin, boxes, scalars, at_rest: surface.morph_weights().to_vec() })
    }

    /// The joint matrices for the nodes in the world.
    pub(crate) fn matrices(&self, world: &[DAffine3]) -> Vec<Affine3A> {
        let model: Vec<Affine3A> = world.iter().map(DAffine3::as_affine3a).collect();
        let mut matrices = vec![Affine3A::IDENTITY; self.skin.len()];
        // Of equal lengths.
        let _ = self.skin.matrices(&model, &mut matrices);
        matrices
    }

    /// The weights of the morph targets at a time of a clip; `set` are scalars that have another value.
    pub(crate) fn morphs(&self, clip: Option<(&Clip, f32)>, set: impl IntoIterator<Item = (usize, f32)>) -> Vec<f32> {
        let mut weights = self.at_rest.clone();
        let Some(last) = self.scalars.iter().flatten().max() else { return weights };
        let mut values = vec![0.0; last + 1];
        for (scalar, weight) in self.scalars.iter().zip(&weights) {
            if let Some(scalar) = scalar {
                values[*scalar] = *weight;
            }
        }
        if let Some((clip, seconds)) = clip {
            clip.sample_scalars(seconds, &mut Cursor::default(), &mut values);
        }
        for (scalar, weight) in set {
            if let Some(value) = values.get_mut(scalar) {
                *value = weight;
            }
        }
        for (scalar, weight) in self.scalars.iter().zip(&mut weights) {
            if let Some(scalar) = scalar {
                *weight = values[*scalar];
            }
        }
        weights
    }

    /// The figure as it is drawn, so far aside.
    pub(crate) fn figure(&self, posed: &Posed, shift: Vec3) -> Figure {
        let shifted = |matrix: &Affine3A| Affine3A { translation: matrix.translation + Vec3A::from(shift), ..*matrix };
        let bounds = self.boxes.whole(&posed.pose()).ok().flatten();
        Figure {
            rows: posed.matrices.iter().flat_map(|matrix| matrix_rows(&shifted(matrix))).collect(),
            morphs: posed.morphs.clone(),
            bounds: bounds.map_or([Vec3::NAN; 2], |aabb| [aabb.min + shift, aabb.max + shift]),
        }
    }

    /// The box of each bone that moves something, with the bone.
    pub(crate) fn boxes(&self, posed: &Posed) -> impl Iterator<Item = (usize, OrientedBox)> {
        let joints = self.skin.bones().iter().enumerate();
        joints.filter_map(|(joint, bone)| Some((*bone, self.boxes.oriented(joint, &posed.pose())?)))
    }

    /// What a ray meets first.
    pub(crate) fn hit(&self, posed: &Posed, ray: &Ray) -> Option<Hit> {
        self.boxes.hit(&self.mesh, &posed.pose(), ray).ok().flatten()
    }

    /// The corners of a triangle in the world.
    pub(crate) fn triangle(&self, posed: &Posed, triangle: usize) -> Option<[Vec3; 3]> {
        let corners = self.mesh.triangles().get(triangle)?;
        let mut positions = vec![Vec3::ZERO; self.mesh.positions().len()];
        self.mesh.deform(&posed.pose(), &mut positions).ok()?;
        Some(corners.map(|corner| positions[corner as usize]))
    }
}
