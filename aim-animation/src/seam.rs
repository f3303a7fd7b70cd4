//! [`Seam`]: difference between the end and the beginning of a looped clip, in value and velocity.

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{angle, length, product, unit};

use crate::clip::{Clip, Edit};
use crate::track::{Continuity, Track};

/// The seam of a looped clip: the largest differences between its end and its beginning, over all bones and scalars.
/// Step tracks are not included, because they are meant to jump.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seam {
    /// Difference in value.
    pub place: Gap,
    /// Difference in velocity, per second.
    pub speed: Gap,
}

/// Largest differences of translations, rotations, scales and scalars.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Difference of translations, in the units of the bones.
    pub translation: f32,
    /// Difference of rotations, radians.
    pub rotation_rad: f32,
    /// Difference of scales.
    pub scale: f32,
    /// Difference of scalars.
    pub scalar: f32,
}

impl Clip {
    /// Measures the difference between the clip's end and its beginning. It is zero for a seamless loop. Remove root
    /// motion [first](crate::Motion::removed_from).
    #[must_use]
    pub fn seam(&self) -> Seam {
        let mut seam = Seam::default();
        let length_s = self.length_s();
        let vector = |track: &Option<Track<Vec3>>, most: [&mut f32; 2]| {
            if let Some([start, end]) = track.as_ref().and_then(|track| track.ends(length_s)) {
                for ((most, start), end) in most.into_iter().zip(start).zip(end) {
                    *most = most.max(length((end - start).into()));
                }
            }
        };
        for tracks in self.tracks() {
            vector(&tracks.translation, [&mut seam.place.translation, &mut seam.speed.translation]);
            vector(&tracks.scale, [&mut seam.place.scale, &mut seam.speed.scale]);
            if let Some([start, end]) = tracks.rotation.as_ref().and_then(|track| track.ends(length_s)) {
                if let (Some(a), Some(b)) = (unit(start[0]), unit(end[0])) {
                    let turn = product(b, a.conjugate());
                    seam.place.rotation_rad = seam.place.rotation_rad.max(angle(turn));
                    let speed = turning(end) - turning(start);
                    seam.speed.rotation_rad = seam.speed.rotation_rad.max(length(speed.into()));
                }
            }
        }
        for (_, track) in self.scalars() {
            if let Some([start, end]) = track.ends(length_s) {
                seam.place.scalar = seam.place.scalar.max((end[0] - start[0]).abs());
                seam.speed.scalar = seam.speed.scalar.max((end[1] - start[1]).abs());
            }
        }
        seam
    }

    /// Returns the clip with its end made to match its beginning, in value or also in velocity.
    ///
    /// End and beginning are each corrected by half of the difference. The correction fades out within `window_s`
    /// seconds, at most half of the clip; the rest does not change. No value moves by more than half of the difference
    /// in value plus 2/27 of the difference in velocity × the window. A long window changes velocities less; a short
    /// one changes less of the clip.
    ///
    /// Tracks become cubic, except for step tracks, which do not change. If the window is not positive, nothing
    /// changes; tracks whose numbers would become too large do not change either.
    ///
    /// ```
    /// use aim_animation::{Clip, Continuity, Track};
    /// use aim_animation::glam::Vec3;
    ///
    /// let clip = Clip::new("sway").with_translation(0, Track::linear([0.0, 1.0], [Vec3::ZERO, Vec3::X * 0.1])?);
    /// assert_eq!(clip.seam().place.translation, 0.1);
    /// let mended = clip.mended(Continuity::Speed, 0.25);
    /// assert!(mended.seam().place.translation < 1e-6 && mended.seam().speed.translation < 1e-6);
    /// # Ok::<(), aim_animation::TrackError>(())
    /// ```
    #[must_use]
    pub fn mended(&self, continuity: Continuity, window_s: f32) -> Self {
        let length = self.length_s();
        self.edited(Edit {
            vector: &|track| track.mended(length, continuity, window_s).unwrap_or_else(|| track.clone()),
            rotation: &|track| {
                let mended = track.mended(length, continuity, window_s);
                mended.map_or_else(|| track.clone(), |mended| mended.with_unit_keys())
            },
            scalar: &|track| track.mended(length, continuity, window_s).unwrap_or_else(|| track.clone()),
        })
    }
}

/// Angular velocity in the parent's space, radians a second: 2·(q′ · q⁻¹), for q of any length.
fn turning([rotation, velocity]: [Quat; 2]) -> Vec3 {
    let square = aim_runtime::rotation::dot(rotation, rotation);
    let turn = product(velocity, rotation.conjugate());
    Vec3::new(turn.x, turn.y, turn.z) * (2.0 / square)
}
