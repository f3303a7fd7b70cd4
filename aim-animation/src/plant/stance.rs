//! [`Stance`]: foot planting with a pelvis that is lowered.

use alloc::vec::Vec;

use aim_runtime::glam::{Quat, Vec3, Vec3A};
use aim_runtime::rotation::{length, turned, unit};

use super::{Ground, Plant};
use crate::figure::{Figure, Layer};
use crate::limb::LimbError;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::made_unit;

/// Fraction of a leg's length to which it is stretched before the pelvis is lowered.
const STRETCH: f32 = 0.998;
/// Width of the smooth onset of the lowering, as a fraction of a leg's length.
const SOFT: f32 = 0.02;

/// The feet of a character and its pelvis. The pelvis is lowered as far as needed for every foot to reach its goal. A
/// planted foot that cannot reach its anchor even then is released.
///
/// [`on`](Self::on) returns the layer for a frame. The figure's place must be on the ground, where a game puts it; feet
/// keep the animated height above the ground.
///
/// ```
/// use aim_animation::glam::Vec3;
/// use aim_animation::{Bone, Figure, Ground, Plant, Skeleton, Stance, Transform};
///
/// let at = |x, y, z| Transform::from_translation(Vec3::new(x, y, z));
/// let [hip, knee, ankle] = [at(0.0, -0.1, 0.0), at(0.0, -0.42, 0.03), at(0.0, -0.4, -0.03)];
/// let skeleton = Skeleton::new([
///     Bone::new("pelvis", None).with_rest(at(0.0, 1.0, 0.0)),
///     Bone::new("hip", Some(0)).with_rest(hip),
///     Bone::new("knee", Some(1)).with_rest(knee),
///     Bone::new("ankle", Some(2)).with_rest(ankle),
/// ])?;
/// let ball = Vec3::new(0.0, 0.0, 0.1);
/// let foot = Plant::new(&skeleton, [1, 2, 3], ball)?.with_events("down", "up");
/// let mut stance = Stance::new(&skeleton, 0, [foot])?;
/// let mut figure = Figure::new(skeleton);
/// // Each frame, with the events that the clips have passed:
/// stance.on_event("down");
/// let hole = |at: Vec3| Ground::new(Vec3::new(at.x, -0.1, at.z), Vec3::Y);
/// figure.run(1.0 / 60.0, &mut [&mut stance.on(hole)])?;
/// assert!(stance.feet()[0].contact(&figure).unwrap().distance(Vec3::new(0.0, -0.1, 0.1)) < 1e-5);
/// assert!(figure.model()[0].translation.y < 0.91, "the pelvis is lowered");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Stance {
    /// Up direction in model space, of any length. Default +Y.
    pub up: Vec3,
    /// Largest distance by which the pelvis is lowered, in model units. Default: a quarter of the longest leg.
    pub most_drop: f32,
    pelvis: usize,
    feet: Vec<Plant>,
    drop: f32,
}

impl Stance {
    /// A stance of feet whose legs descend from a pelvis.
    ///
    /// # Errors
    /// The skeleton has no bone `pelvis`, or the leg of a foot does not descend from it.
    pub fn new(skeleton: &Skeleton, pelvis: usize, feet: impl Into<Vec<Plant>>) -> Result<Self, LimbError> {
        let feet = feet.into();
        let below = skeleton.subtree(pelvis);
        let hangs = |foot: &Plant| foot.limb.bones() == skeleton.len() && below.contains(&foot.limb.chain()[0]);
        if let Some(foot) = feet.iter().position(|foot| !hangs(foot)) {
            return Err(LimbError::Pelvis { foot });
        }
        if below.is_empty() {
            return Err(LimbError::Pelvis { foot: 0 });
        }
        let most_drop = 0.25 * feet.iter().map(|foot| foot.limb.length()).fold(0.0, f32::max);
        Ok(Self { up: Vec3::Y, most_drop, pelvis, feet, drop: 0.0 })
    }

    /// The feet.
    #[must_use]
    pub fn feet(&self) -> &[Plant] {
        &self.feet
    }

    /// The feet, mutable: to plant and release them.
    pub fn feet_mut(&mut self) -> &mut [Plant] {
        &mut self.feet
    }

    /// Passes an event to all feet; see [`Plant::on_event`].
    pub fn on_event(&mut self, name: &str) {
        self.feet.iter_mut().for_each(|foot| foot.on_event(name));
    }

    /// Distance by which the pelvis was lowered in the last frame, in model units.
    #[must_use]
    pub fn drop(&self) -> f32 {
        self.drop
    }

    /// Returns the layer for a frame. `ground` returns the ground at a point in the world.
    pub fn on<G: FnMut(Vec3) -> Ground>(&mut self, ground: G) -> StanceLayer<'_, G> {
        StanceLayer { stance: self, ground }
    }

    fn apply(
        &mut self,
        figure: &mut Figure,
        ground: &mut dyn FnMut(Vec3) -> Ground,
        dt_s: f32,
    ) -> Result<(), PoseError> {
        let bones = figure.skeleton().len();
        self.feet.iter().try_for_each(|foot| check_length(foot.limb.bones(), bones))?;
        // `up` may have any length.
        let up =
            unit(Quat::from_xyzw(self.up.x, self.up.y, self.up.z, 0.0)).unwrap_or(Quat::from_xyzw(0.0, 1.0, 0.0, 0.0));
        let up = Vec3::new(up.x, up.y, up.z);
        let up_ws = Vec3::from(turned(made_unit(figure.place.rotation), up.into()));
        let mut drop = 0.0;
        for foot in &mut self.feet {
            foot.update_goal(figure, ground, up_ws, dt_s);
            drop = soft_maximum(drop, foot.needed_drop(figure, up_ws, STRETCH), SOFT * foot.limb.length());
        }
        self.drop = drop.min(self.most_drop).max(0.0);
        figure.shift(self.pelvis, up * -self.drop);
        for foot in &mut self.feet {
            foot.follow(figure)?;
        }
        Ok(())
    }
}

/// Layer for a frame, made by [`Stance::on`].
#[derive(Debug)]
pub struct StanceLayer<'a, G> {
    stance: &'a mut Stance,
    ground: G,
}

impl<G: FnMut(Vec3) -> Ground> Layer for StanceLayer<'_, G> {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        self.stance.apply(figure, &mut self.ground, dt_s)
    }
}

/// Smooth maximum of two numbers, rounded where they differ by less than about `soft`: (a + b + √((a − b)² + s²)) / 2.
fn soft_maximum(a: f32, b: f32, soft: f32) -> f32 {
    0.5 * (a + b + length(Vec3A::new(a - b, soft, 0.0)))
}
