//! Keys left out of a baked clip, with an eye on where it looks.

use aim_animation::Clip;
use aim_character::{Baked, ChainNodes, Measurement};
use aim_gltf::{Document, Error};
use aim_runtime::glam::{DAffine3, DVec3, Vec3};
use serde::Serialize;

use crate::deviation::Deviation;
use crate::effector::Effector;
use crate::reduction::{Kept, Millimetres, WrittenError, millimetre, reduced};
use crate::words::{fixed, grouped, weights_in_words};

/// How far away what is looked at counts, millimetres of a 1.7 m figure.
const LOOKED_AT_MM: f64 = 1000.0;

/// How far a clip as written is from its frames.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct BakedReduction {
    tolerance_mm: f64,
    /// Of what is furthest off.
    error_mm: f64,
    /// Of any morph weight, where there are some.
    #[serde(skip_serializing_if = "Option::is_none")]
    weights_error: Option<f64>,
    /// Between the effector's gaze and that of any frame at most.
    gaze_error_deg: f64,
    /// Bytes of the clip's keys, before and after.
    key_bytes: [usize; 2],
}

impl BakedReduction {
    pub(crate) fn in_words(&self) -> String {
        let Self { tolerance_mm, error_mm, weights_error, gaze_error_deg, key_bytes: [before, after] } = self;
        format!(
            "{} bytes of keys of {} at {tolerance_mm} mm: as written at most {} mm off, the gaze {}°{}",
            grouped(*after),
            grouped(*before),
            fixed(*error_mm, 3),
            fixed(*gaze_error_deg, 3),
            weights_in_words(*weights_error)
        )
    }
}

/// The gaze of a baked clip.
pub(crate) struct Gaze<'a> {
    pub(crate) document: &'a Document,
    pub(crate) measurement: &'a Measurement,
    pub(crate) effector: Effector,
    pub(crate) chain: &'a ChainNodes,
}

impl Gaze<'_> {
    /// The clip without the keys that a tolerance allows to leave out, also of what is looked at.
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

    /// How far the clip of the second model is from that of the first, which is the baked one; with its error as it was measured.
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

    /// A point of the effector's gaze, and one further on.
    fn ray(&self, world: &DAffine3) -> [DVec3; 2] {
        let ray = &self.effector.ray;
        let [origin, forward] = [ray.origin, ray.frame.forward].map(DVec3::from_array);
        [origin, origin + forward].map(|point| world.transform_point3(point))
    }
}
