//! Reduction of the keys of a baked clip, within a tolerance that also applies to the point looked at.

use aim_animation::Clip;
use aim_character::{Baked, ChainNodes, Measurement};
use aim_gltf::{Document, Error};
use aim_runtime::glam::{DAffine3, DVec3, Vec3};
use serde::Serialize;

use crate::deviation::Deviation;
use crate::effector::Effector;
use crate::reduction::{Kept, Millimetres, WrittenError, millimetre, reduced};
use crate::words::{fixed, grouped, weights_in_words};

/// Distance of the point looked at, millimetres of a 1.7 m figure.
const LOOKED_AT_MM: f64 = 1000.0;

/// Errors of a reduced clip as written, compared with the clip with all of its keys.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct BakedReduction {
    /// Tolerance, millimetres of a 1.7 m figure.
    tolerance_mm: f64,
    /// Largest error of any bone, millimetres of a 1.7 m figure.
    error_mm: f64,
    /// Largest error of any morph weight; `None` if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    weights_error: Option<f64>,
    /// Largest angle between the effector's gazes in the two clips at any frame, degrees.
    gaze_error_deg: f64,
    /// Bytes of the clip's keys, before and after.
    key_bytes: [usize; 2],
}

impl BakedReduction {
    pub(crate) fn in_words(&self) -> String {
        let Self { tolerance_mm, error_mm, weights_error, gaze_error_deg, key_bytes: [before, after] } = self;
        format!(
            "keys reduced from {} to {} bytes at {tolerance_mm} mm: error at most {} mm, gaze error at most {}°{}",
            grouped(*before),
            grouped(*after),
            fixed(*error_mm, 3),
            fixed(*gaze_error_deg, 3),
            weights_in_words(*weights_error)
        )
    }
}

/// The effector whose gaze a reduction preserves, with its model.
pub(crate) struct Gaze<'a> {
    pub(crate) document: &'a Document,
    pub(crate) measurement: &'a Measurement,
    pub(crate) effector: Effector,
    pub(crate) chain: &'a ChainNodes,
}

impl Gaze<'_> {
    /// Returns the clip without the keys that the tolerance allows to be left out. The tolerance also applies to the
    /// points at which the effector and the other eye look, [`LOOKED_AT_MM`] away.
    pub(crate) fn reduced(&self, clip: &Clip, tolerance: Millimetres) -> Result<Clip, String> {
        let unit = millimetre(self.measurement);
        let skeleton = self.document.skeleton();
        let world = skeleton.world_f64(skeleton.rest());
        let node = self.chain.joints[self.effector.joint];
        let [from, to] = self.ray(&world[node]);
        let looked_at = from + (to - from).normalize_or_zero() * LOOKED_AT_MM * unit;
        let eyes = std::iter::once(node).chain(self.chain.other_eye);
        let points: Vec<(usize, Vec3)> =
            eyes.map(|eye| (eye, world[eye].inverse().transform_point3(looked_at).as_vec3())).collect();
        reduced(clip, self.document, &Kept { tolerance: tolerance.0 * unit, pins: &[], points: &points })
    }

    /// Compares the clip of the second model, which is reduced, with that of the first, which is the baked one. Returns
    /// the block of the report, and the error to [check](WrittenError::check).
    pub(crate) fn told(
        &self,
        baked: &Baked,
        tolerance: Millimetres,
        models: [&[u8]; 2],
    ) -> Result<(BakedReduction, WrittenError), Error> {
        let name = baked.clip.name();
        let [before, after] = [Document::from_bytes(models[0])?, Document::from_bytes(models[1])?];
        let [was, is] = [before.clip(name)?, after.clip(name)?];
        let skeleton = self.document.skeleton();
        let node = self.chain.joints[self.effector.joint];
        let direction = |clip: &Clip, t: f32| {
            let [from, to] = self.ray(&skeleton.world_f64(&skeleton.pose(clip, t))[node]);
            to - from
        };
        let off = |t: f32| direction(was, t).angle_between(direction(is, t)).to_degrees();
        let bytes = |document: &Document| {
            let at = document.clips().iter().position(|clip| clip.name() == name);
            at.and_then(|at| document.clip_sizes().get(at).map(|size| size.keys)).unwrap_or_default()
        };
        let deviation = Deviation::measure(self.document, [was, is]);
        let error = deviation.written_error(self.document, millimetre(self.measurement));
        let reduction = BakedReduction {
            tolerance_mm: tolerance.0,
            error_mm: error.mm,
            weights_error: error.weights,
            gaze_error_deg: baked.frames.iter().map(|frame| off(frame.t)).fold(0.0, f64::max),
            key_bytes: [bytes(&before), bytes(&after)],
        };
        Ok((reduction, error))
    }

    /// Returns the effector's origin and a point one unit ahead of it along the gaze, with its bone at `world`.
    fn ray(&self, world: &DAffine3) -> [DVec3; 2] {
        let ray = &self.effector.ray;
        let [origin, forward] = [ray.origin, ray.frame.forward].map(DVec3::from_array);
        [origin, origin + forward].map(|point| world.transform_point3(point))
    }
}
