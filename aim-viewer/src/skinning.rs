//! [`Skinning`]: the mesh of a character, the skin and morph targets that move its vertices, and the boxes of its
//! bones.

use aim_animation::glam::{Affine3A, Vec3A};
use aim_animation::{BoneBoxes, Clip, Cursor, Hit, Mesh, MeshError, MeshPose, OrientedBox, Ray, Skin, matrix_rows};
use aim_gltf::{Document, Surface};
use aim_runtime::glam::{DAffine3, Vec3};

use crate::picture::Figure;

/// Skinning data, created once for each character.
#[derive(Debug)]
pub(crate) struct Skinning {
    pub(crate) mesh: Mesh,
    skin: Skin,
    boxes: BoneBoxes,
    /// For each morph target, the index of the clips' scalar track that drives its weight, if any.
    scalars: Vec<Option<usize>>,
    /// Weights of the morph targets without a clip.
    at_rest: Vec<f32>,
}

/// Joint matrices and morph weights that pose the mesh in a frame.
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
    /// None in practice: the mesh and the skin come from the same surface.
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

    /// Returns the joint matrices for these world transforms of the nodes.
    pub(crate) fn matrices(&self, world: &[DAffine3]) -> Vec<Affine3A> {
        let model: Vec<Affine3A> = world.iter().map(DAffine3::as_affine3a).collect();
        let mut matrices = vec![Affine3A::IDENTITY; self.skin.len()];
        // Cannot fail: the slices match the skeleton and the skin.
        let _ = self.skin.matrices(&model, &mut matrices);
        matrices
    }

    /// Returns the weights of the morph targets at a time of a clip, seconds. `set` overrides the values of scalars by
    /// index.
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

    /// Returns the figure to draw, with an offset.
    pub(crate) fn figure(&self, posed: &Posed, shift: Vec3) -> Figure {
        let shifted = |matrix: &Affine3A| Affine3A { translation: matrix.translation + Vec3A::from(shift), ..*matrix };
        let bounds = self.boxes.whole(&posed.pose()).ok().flatten();
        Figure {
            rows: posed.matrices.iter().flat_map(|matrix| matrix_rows(&shifted(matrix))).collect(),
            morphs: posed.morphs.clone(),
            bounds: bounds.map_or([Vec3::NAN; 2], |aabb| [aabb.min + shift, aabb.max + shift]),
        }
    }

    /// Returns each bone that moves vertices, with its box.
    pub(crate) fn boxes(&self, posed: &Posed) -> impl Iterator<Item = (usize, OrientedBox)> {
        let joints = self.skin.bones().iter().enumerate();
        joints.filter_map(|(joint, bone)| Some((*bone, self.boxes.oriented(joint, &posed.pose())?)))
    }

    /// Returns the first hit of a ray.
    pub(crate) fn hit(&self, posed: &Posed, ray: &Ray) -> Option<Hit> {
        self.boxes.hit(&self.mesh, &posed.pose(), ray).ok().flatten()
    }

    /// Returns the corners of a triangle in the pose, without the figure's offset.
    pub(crate) fn triangle(&self, posed: &Posed, triangle: usize) -> Option<[Vec3; 3]> {
        let corners = self.mesh.triangles().get(triangle)?;
        let mut positions = vec![Vec3::ZERO; self.mesh.positions().len()];
        self.mesh.deform(&posed.pose(), &mut positions).ok()?;
        Some(corners.map(|corner| positions[corner as usize]))
    }
}
