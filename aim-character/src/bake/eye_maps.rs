//! Eyes that turn by the range maps of a VRM file. The solver aims the gaze at the target, and [`EyeMaps`] then turns
//! the bones by as much as the maps give for that gaze.

use aim_animation::Transform;
use aim_gltf::{Document, LookAt, LookAtKind, RangeMap};
use aim_runtime::glam::{DQuat, DVec3, Quat};

use crate::bake::chain::ChainNodes;
use crate::measure::roles::Role;
use crate::measure::{BoneAxes, BoneFrame, Measurement};

/// Returns the range maps of an eye: headings to the right and to the left, pitches down and up.
///
/// For an eye that looks by morph targets, the maps give weights; for an eye bone of a VRM file, angles. `None` for a
/// bone that turns by the full angle of its gaze.
#[must_use]
pub fn range_maps(document: &Document, bone: &BoneAxes) -> Option<[RangeMap; 4]> {
    if let Some(eye) = document.skeleton().morph_eyes().iter().find(|eye| eye.node == bone.node) {
        return Some(eye.ways.each_ref().map(|way| way.map));
    }
    let look = LookAt::of(document).filter(|look| look.kind == LookAtKind::Bone)?;
    match bone.role? {
        Role::LeftEye => Some(look.left_eye()),
        Role::RightEye => Some(look.right_eye()),
        _ => None,
    }
}

/// The eyes of a chain that turn by the file's range maps.
#[derive(Debug, Clone)]
pub(crate) struct EyeMaps(Vec<MappedEye>);

#[derive(Debug, Clone)]
struct MappedEye {
    node: usize,
    frame: BoneFrame,
    /// Range maps to the right, to the left, down and up.
    maps: [RangeMap; 4],
}

impl EyeMaps {
    /// Finds the mapped eyes among the chain's nodes; none unless the file is a VRM file whose eyes look by bones.
    pub(crate) fn find(document: &Document, measurement: &Measurement, chain: &ChainNodes) -> Self {
        let eye = |node: usize| {
            let bone = measurement.bone(node).filter(|bone| document.skeleton().is_in_file(bone.node))?;
            Some(MappedEye { node, frame: bone.frame, maps: range_maps(document, bone)? })
        };
        Self(chain.joints.first().copied().into_iter().chain(chain.other_eye).filter_map(eye).collect())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the eyes' local rotations.
    pub(crate) fn rotations(&self, pose: &[Transform]) -> Vec<Quat> {
        self.0.iter().map(|eye| pose[eye.node].rotation).collect()
    }

    /// Replaces each eye's rotation since `before`, which points it at the target, by the output of its range maps for
    /// that rotation.
    pub(crate) fn apply(&self, before: &[Quat], pose: &mut [Transform]) {
        for (eye, before) in self.0.iter().zip(before) {
            let trs = &mut pose[eye.node];
            let before = before.as_dquat();
            // The rotation is applied after the node's own scale, so negative scales flip the axes.
            let sign = trs.scale.signum().as_dvec3();
            let [up, forward, left] = [eye.frame.up, eye.frame.forward, eye.frame.left].map(|axis| axis * sign);
            let frame = BoneFrame { up, forward, left };
            let [right, to_left, down, upward] = &eye.maps;
            let mapped = |angle: f64, negative: &RangeMap, positive: &RangeMap| {
                let map = if angle < 0.0 { negative } else { positive };
                map.apply(angle.abs().to_degrees()).to_radians().copysign(angle)
            };
            let [heading, pitch] = frame.angles(before.inverse() * trs.rotation.as_dquat());
            let turned = before * frame.turn([mapped(heading, right, to_left), mapped(pitch, down, upward)]);
            if turned.is_finite() {
                trs.rotation = turned.normalize().as_quat();
            }
        }
    }
}

impl BoneFrame {
    /// Returns heading and pitch, radians, of the forward direction after `turn`, a rotation in the bone's space.
    pub(crate) fn angles(&self, turn: DQuat) -> [f64; 2] {
        let gaze = turn * self.forward;
        [gaze.dot(self.left).atan2(gaze.dot(self.forward)), gaze.dot(self.up).clamp(-1.0, 1.0).asin()]
    }

    /// Returns the rotation by a pitch, then by a heading, both in radians.
    pub(crate) fn turn(&self, [heading, pitch]: [f64; 2]) -> DQuat {
        let turn = |to: DVec3, angle: f64| DQuat::from_axis_angle(self.forward.cross(to).normalize(), angle);
        turn(self.left, heading) * turn(self.up, pitch)
    }
}
