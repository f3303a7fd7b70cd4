//! [`Bones`]: a skeleton as an engine hands it over.

use aim::animation::{Bone, Skeleton, SkeletonError, Transform};
use aim::glam::{Affine3A, Mat4, Quat, Vec3};

/// The numbers of a local transform: translation, rotation, scale.
pub(crate) const LOCAL: usize = 10;

/// The bones of a character, in any order, as they are handed over one by one.
#[derive(Clone, Debug, Default)]
pub struct Bones {
    pub(crate) bones: Vec<Bone>,
    pub(crate) inverse_binds: Vec<Option<Affine3A>>,
    /// The number of each bone's node in the file that it was loaded from.
    pub(crate) nodes: Vec<Option<usize>>,
    pub(crate) trunk: Option<usize>,
}

impl Bones {
    /// One more bone: its name, the number of the bone that it hangs on (none if negative), and its transform at rest.
    pub fn add(&mut self, name: &str, parent: i32, rest: &[f32]) {
        let parent = usize::try_from(parent).ok();
        self.bones.push(Bone::new(name, parent).with_rest(transform(rest)));
        self.inverse_binds.push(None);
        self.nodes.push(None);
    }

    /// The inverse bind matrix, column-major, of the bone that was added last.
    pub fn bind(&mut self, matrix: &[f32]) {
        if let (Some(last), Some(matrix)) = (self.inverse_binds.last_mut(), affine(matrix)) {
            *last = Some(matrix);
        }
    }

    /// The number in its file of the bone that was added last.
    pub fn node(&mut self, node: usize) {
        if let Some(last) = self.nodes.last_mut() {
            *last = Some(node);
        }
    }

    /// The bone that tells how the character stands.
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

/// A local transform of its ten numbers; the identity of fewer.
pub(crate) fn transform(numbers: &[f32]) -> Transform {
    let &[x, y, z, i, j, k, w, a, b, c] = numbers else { return Transform::IDENTITY };
    Transform { translation: Vec3::new(x, y, z), rotation: Quat::from_xyzw(i, j, k, w), scale: Vec3::new(a, b, c) }
}

/// The affine part of a matrix, column-major.
pub(crate) fn affine(matrix: &[f32]) -> Option<Affine3A> {
    Some(Affine3A::from_mat4(Mat4::from_cols_array(matrix.try_into().ok()?)))
}
