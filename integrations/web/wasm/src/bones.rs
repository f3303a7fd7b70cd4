//! [`Bones`]: a skeleton received from an engine.

use aim::animation::{Bone, Skeleton, SkeletonError, Transform};
use aim::glam::{Affine3A, Mat4, Quat, Vec3};

/// Number of `f32`s in a local transform: translation (3), rotation (4), scale (3).
pub(crate) const LOCAL: usize = 10;

/// The bones of a character, added one by one. Parents may come after their children.
#[derive(Clone, Debug, Default)]
pub struct Bones {
    pub(crate) bones: Vec<Bone>,
    pub(crate) inverse_binds: Vec<Option<Affine3A>>,
    /// Index of each bone's node in the file from which it was loaded.
    pub(crate) nodes: Vec<Option<usize>>,
    pub(crate) trunk: Option<usize>,
}

impl Bones {
    /// Adds a bone: its name, the index of its parent among the bones (negative for none), and its rest transform, ten
    /// numbers: translation, rotation quaternion `x, y, z, w`, scale.
    pub fn add(&mut self, name: &str, parent: i32, rest: &[f32]) {
        let parent = usize::try_from(parent).ok();
        self.bones.push(Bone::new(name, parent).with_rest(transform(rest)));
        self.inverse_binds.push(None);
        self.nodes.push(None);
    }

    /// Sets the inverse bind matrix, column-major, of the bone added last. Ignored unless it has 16 numbers.
    pub fn bind(&mut self, matrix: &[f32]) {
        if let (Some(last), Some(matrix)) = (self.inverse_binds.last_mut(), affine(matrix)) {
            *last = Some(matrix);
        }
    }

    /// Sets the index of the node in its file for the bone added last.
    pub fn node(&mut self, node: usize) {
        if let Some(last) = self.nodes.last_mut() {
            *last = Some(node);
        }
    }

    /// Sets the bone, usually the hips, whose lean determines the character's up direction.
    pub fn trunk(&mut self, bone: usize) {
        self.trunk = Some(bone);
    }

    pub(crate) fn skeleton(&self) -> Result<Skeleton, String> {
        let name = |bone: usize| self.bones.get(bone).map_or("?", |bone| &bone.name);
        Skeleton::new(self.bones.iter().cloned()).map_err(|error| match error {
            SkeletonError::Parent { bone, parent } => format!(
                "bone {bone}, \"{}\", hangs on bone {parent}, which is not there: give the index of one of the {} bones, or -1",
                name(bone),
                self.bones.len()
            ),
            SkeletonError::Cycle(bone) => {
                format!("bone {bone}, \"{}\", hangs on itself by way of others: give one of them the parent -1", name(bone))
            }
            SkeletonError::Rest(bone) => format!(
                "the transform of bone {bone}, \"{}\", is not finite, or its rotation is no unit quaternion: attach a \
                 character that stands in a sound pose",
                name(bone)
            ),
            other => other.to_string(),
        })
    }
}

/// Returns the local transform of ten numbers, or the identity if there are not ten.
pub(crate) fn transform(numbers: &[f32]) -> Transform {
    let &[x, y, z, i, j, k, w, a, b, c] = numbers else { return Transform::IDENTITY };
    Transform { translation: Vec3::new(x, y, z), rotation: Quat::from_xyzw(i, j, k, w), scale: Vec3::new(a, b, c) }
}

/// Returns the affine part of a column-major 4×4 matrix; `None` unless there are 16 numbers.
pub(crate) fn affine(matrix: &[f32]) -> Option<Affine3A> {
    Some(Affine3A::from_mat4(Mat4::from_cols_array(matrix.try_into().ok()?)))
}
