//! A generated walking figure that looks the same in the world whatever axes its bones are given.
//!
//! It faces +Z, with up +Y and left +X, in metres. Conventions differ only internally: in each joint's frame, and
//! therefore in the numbers of its transforms, inverse bind matrices and animation.

mod blend;
mod body;
mod joints;
mod moves;
mod pack;
mod shape;
mod vrm;
mod walk;

use aim_runtime::glam::{DMat3, DVec3};

use crate::error::Error;
use joints::Bone;
use pack::Contents;
pub use vrm::Vrm;

/// The paper's bone convention: +X is up, +Y forward, +Z left.
pub const PAPER_AXES: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Builds the mannequin as a GLB: 25 joints (`hips`, `spine`, `spine1`, `spine2`, `spine3`, `neck`, `head`, and `left_`
/// and `right_` each of `eye`, `clavicle`, `upper_arm`, `lower_arm`, `hand`, `upper_leg`, `lower_leg`, `foot`, `toes`),
/// a skinned body, and a looping clip `walk` of 1.2 s.
///
/// `axes_of` returns, for a joint's name, the character's up, forward and left in that bone's local space: any three
/// orthonormal vectors. If `left × up` is the opposite of `forward`, the bone is mirrored (negative determinant in the
/// world), and its children compensate for that.
///
/// # Errors
/// [`Error::Axes`] for a joint whose three vectors are not orthonormal to within 1e-3.
pub fn mannequin(axes_of: impl Fn(&str) -> [[f32; 3]; 3]) -> Result<Vec<u8>, Error> {
    Mannequin::new().glb(axes_of)
}

/// Options for the mannequin beyond those of [`mannequin`].
///
/// ```
/// use aim_character::{Mannequin, PAPER_AXES, Vrm};
/// use aim_gltf::Document;
///
/// let file = Mannequin::new().with_moves().with_vrm(Vrm::V1).glb(|_| PAPER_AXES)?;
/// let document = Document::from_bytes(&file)?;
/// assert!(document.clip("run").is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mannequin {
    moves: bool,
    walks_to_run: bool,
    vrm: Option<Vrm>,
}

impl Mannequin {
    /// Creates the figure with its walk only.
    #[must_use]
    pub const fn new() -> Self {
        Self { moves: false, walks_to_run: false, vrm: None }
    }

    /// Adds clips after `walk`: `walk_ahead` (1.2 m in 1.1 s), `walk_circle` (once round to the left, 9.6 m), `run`
    /// (2 m in 0.7 s), `jump`, `turn` (a quarter to the left, in two steps) and `wave`.
    ///
    /// The hips carry the movement; apart from it, all clips are loops. Feet do not slide.
    #[must_use]
    pub const fn with_moves(mut self) -> Self {
        self.moves = true;
        self
    }

    /// Adds the clip `walk_to_run` before all others: a loop of 10 s in which the figure walks, runs and walks again on
    /// the spot. It blends the two gaits of [`with_moves`](Self::with_moves) in step.
    #[must_use]
    pub const fn with_walk_to_run(mut self) -> Self {
        self.walks_to_run = true;
        self
    }

    /// Makes the file a VRM file, with VRM's bones, level arms in the rest pose, and eyes that look by bones. In version
    /// 0 the figure faces −Z.
    #[must_use]
    pub const fn with_vrm(mut self, version: Vrm) -> Self {
        self.vrm = Some(version);
        self
    }

    /// Returns the file as a GLB, like [`mannequin`].
    ///
    /// # Errors
    /// [`Error::Axes`] for a joint whose three vectors are not orthonormal to within 1e-3.
    pub fn glb(&self, axes_of: impl Fn(&str) -> [[f32; 3]; 3]) -> Result<Vec<u8>, Error> {
        let joints = joints::joints();
        let frames =
            joints.iter().map(|joint| frame(&joint.name, axes_of(&joint.name))).collect::<Result<Vec<_>, _>>()?;
        let scene = self.vrm.map_or(DMat3::IDENTITY, Vrm::scene);
        let bone = |(joint, &frame): (&joints::Joint, &DMat3)| {
            let parent = joint.parent.map(|parent| (frames[parent], joints[parent].position));
            let (parent_frame, parent_position) = parent.unwrap_or((scene.transpose(), DVec3::ZERO));
            let mirrors = parent_frame.determinant() * frame.determinant() < 0.0;
            Bone {
                frame,
                // Frames are orthonormal, so the transpose is the inverse, whether mirrored or not.
                to_parent: parent_frame.transpose(),
                offset: joint.position - parent_position,
                mirror: if mirrors { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE },
            }
        };
        let rig: Vec<Bone> = joints.iter().zip(&frames).map(bone).collect();
        let moves = if self.moves { &moves::MOVES[..] } else { &[] };
        pack::pack(&Contents { moves, walks_to_run: self.walks_to_run, vrm: self.vrm }, &joints, &rig)
    }
}

/// Returns character ← bone for three vectors in the bone's space.
fn frame(bone: &str, [up, forward, left]: [[f32; 3]; 3]) -> Result<DMat3, Error> {
    let [left, up, forward] = [left, up, forward].map(|v| DVec3::from_array(v.map(f64::from)));
    // Bone ← character: its columns are the character's axes in the bone's space.
    let (given, near) = (DMat3::from_cols(left, up, forward), 1e-3);
    let gram = given.transpose() * given;
    let off = (gram - DMat3::IDENTITY).to_cols_array().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    if !given.is_finite() || off > near {
        return Err(Error::Axes(bone.into()));
    }
    Ok(crate::measure::frame::orthonormal(&given).0.transpose())
}
