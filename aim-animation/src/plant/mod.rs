//! [`Plant`] and [`Stance`]: feet that stay where they are in the world. `ground.rs` is what they stand on, `stance.rs` the pelvis over
//! them.

mod ground;
mod stance;

use alloc::string::String;
use alloc::vec::Vec;

use aim_runtime::glam::{Quat, Vec3, Vec3A};
use aim_runtime::ik::{CcdJoint, TwoBone};
use aim_runtime::rotation::{cross, exp, inverse, length, log, nearest_orthogonal, product, square_root, turned, unit};

use crate::fade::Fade;
use crate::figure::Figure;
use crate::limb::{Limb, LimbError, TipGoal};
use crate::pose::PoseError;
use crate::skeleton::Skeleton;
use crate::transform::made_unit;

pub use ground::Ground;
pub use stance::{Stance, StanceLayer};

/// The part of a leg's length by which the ground under a swinging foot may jump from frame to frame before the foot takes its time:
/// the edge of a stair.
const STEP: f32 = 0.01;
/// The part of velocity × fade at which what comes to rest does so without turning back: 30·c·u²(1−u)² + 1 − 18u² + 32u³ − 15u⁴ ≥ 0.
const RUN_OUT: f32 = 0.4;

/// A foot that stays where it is in the world while it is down, and keeps its height over uneven ground while it swings.
///
/// One point of the foot, the *contact*, stands: usually the ball, over which the foot rolls. While planted it stays on the ground and
/// the foot does not turn about the vertical; its rolling stays as animated. While it swings it is raised by the height of the ground
/// below it over the figure's place. The sole is tilted with the ground's normal. From one to the other it goes within
/// [`fade_s`](Self::fade_s) seconds by its own momentum, without a jump in place or speed.
///
/// Feet are layers by a [`Stance`], which lowers the pelvis for them.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// The time in which it comes to rest, or leaves for the animated way again, seconds. Default 0.15.
    pub fade_s: f32,
    /// The largest tilt of the sole, radians. Default 0.6.
    pub most_tilt_rad: f32,
    /// The solver of a leg of two bones: a pole is in the space of the model, a hinge's axis in that of the middle bone.
    pub two_bone: TwoBone,
    limb: Limb,
    joints: Vec<CcdJoint>,
    /// In the space of the tip's bone.
    contact: Vec3,
    /// The names of the events at which it comes down and goes up.
    events: Option<[String; 2]>,
    is_down: bool,
    /// Where it is planted.
    anchor: Option<Anchor>,
    fade: Fade,
    before: Option<Before>,
    /// Where the tip goes in this frame, in the world, and its rotation vector there.
    goal: [Vec3; 2],
}

/// Where a foot is planted, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Anchor {
    point: Vec3,
    tilt: Vec3,
    /// How far the animation has turned the foot about the vertical since, radians.
    turned_rad: f32,
}

/// What a frame needs of the one before; contacts with rotation vectors, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Before {
    rotation: Quat,
    free: [Vec3; 2],
    shown: [Vec3; 2],
    ground: Ground,
    contact: Vec3,
}

impl Plant {
    /// A foot by its leg, from the hip to the ankle, and its contact: a point of the sole in the rest pose, in the space of the model.
    ///
    /// # Errors
    /// See [`LimbError`].
    pub fn new(skeleton: &Skeleton, leg: impl Into<Vec<usize>>, contact: Vec3) -> Result<Self, LimbError> {
        let (limb, joints) = Limb::at_rest(skeleton, leg.into())?;
        let contact = inverse(&skeleton.rest_in_model()[limb.tip_bone()]).map(|tip| tip.transform_point3(contact));
        let contact = contact.filter(|contact| contact.is_finite()).ok_or(LimbError::Length)?;
        Ok(Self {
            fade_s: 0.15,
            most_tilt_rad: 0.6,
            two_bone: TwoBone::new(),
            limb,
            joints,
            contact,
            events: None,
            is_down: false,
            anchor: None,
            fade: Fade::NONE,
            before: None,
            goal: [Vec3::ZERO; 2],
        })
    }

    /// With the names of the clip's events at which it comes down and goes up: see [`on_event`](Self::on_event).
    #[must_use]
    pub fn with_events(mut self, down: impl Into<String>, up: impl Into<String>) -> Self {
        self.events = Some([down.into(), up.into()]);
        self
    }

    /// With a time in which it comes to rest and leaves again, seconds.
    #[must_use]
    pub const fn with_fade(mut self, fade_s: f32) -> Self {
        self.fade_s = fade_s;
        self
    }

    /// With a solver of a leg of two bones.
    #[must_use]
    pub const fn with_two_bone(mut self, two_bone: TwoBone) -> Self {
        self.two_bone = two_bone;
        self
    }

    /// Plants the foot where it comes to rest from the next frame on.
    pub fn plant(&mut self) {
        self.is_down = true;
    }

    /// Leaves the foot to the animation from the next frame on.
    pub fn release(&mut self) {
        self.is_down = false;
    }

    /// [Plants](Self::plant) or [releases](Self::release) the foot if the event has one of its names.
    pub fn on_event(&mut self, name: &str) {
        if let Some([down, up]) = &self.events {
            self.is_down = down == name || self.is_down && up != name;
        }
    }

    /// Forgets where it stands and how it moved: after a jump of the character's place.
    pub fn reset(&mut self) {
        (self.is_down, self.anchor, self.fade, self.before) = (false, None, Fade::NONE, None);
    }

    /// The point of the world at which it is planted; `None` while it swings. While it comes to rest the contact is still on its way
    /// there.
    #[must_use]
    pub fn anchor(&self) -> Option<Vec3> {
        self.anchor.map(|anchor| anchor.point)
    }

    /// True if it is planted and has come to rest.
    #[must_use]
    pub fn is_planted(&self) -> bool {
        self.anchor.is_some() && self.fade.is_done()
    }

    /// The contact as it stands in the world in a figure's pose; `None` if the figure has too few bones.
    #[must_use]
    pub fn contact(&self, figure: &Figure) -> Option<Vec3> {
        Some(figure.world(self.limb.tip_bone())?.transform_point3(self.contact))
    }

    /// The distance of the contact from the point at which it is planted, in units of the world; 0 unless it [is](Self::is_planted).
    #[must_use]
    pub fn slip(&self, figure: &Figure) -> f32 {
        let places = self.contact(figure).zip(self.anchor()).filter(|_| self.is_planted());
        places.map_or(0.0, |(contact, anchor)| length((contact - anchor).into()))
    }

    /// Decides where the foot goes in this frame. `up` is that of the world.
    fn decide(&mut self, figure: &Figure, ground: &mut dyn FnMut(Vec3) -> Ground, up: Vec3, dt_s: f32) {
        let place = figure.place.to_affine();
        let tip = place * figure.model()[self.limb.tip_bone()];
        let contact = tip.transform_point3(self.contact);
        let rotation = nearest_orthogonal(tip.matrix3).and_then(|frame| unit(Quat::from_mat3a(&frame)));
        let Some(rotation) = rotation.filter(|_| contact.is_finite()) else {
            // Nothing to stand on, and nothing to go on from.
            self.reset();
            self.goal = [tip.translation.into(), Vec3::ZERO];
            return;
        };
        let below = self.ground_at(contact, ground, up);
        let height = (below.point - figure.place.translation).dot(up);
        let free = [contact + up * height, below.tilt(up, self.most_tilt_rad)];
        let before = self.before.unwrap_or(Before { rotation, free, shown: free, ground: below, contact });
        self.fade.advance(dt_s);
        let rate = if dt_s > 0.0 && dt_s.is_finite() && self.before.is_some() { 1.0 / dt_s } else { 0.0 };
        // The turn about the vertical since the frame before: the twist of q is 2·atan(q·up / w), here for small turns.
        let turned_rad = log(product(rotation, before.rotation.conjugate())).dot(up);
        if let Some(anchor) = &mut self.anchor {
            anchor.turned_rad += turned_rad;
        } else {
            self.absorb_step(&before, &below, contact, up);
        }
        let mut shown = sum(self.target(free, up), self.fade.left());
        if self.is_down != self.anchor.is_some() {
            let mut velocity = difference(shown, before.shown).map(|way| way * rate);
            let new_before = if self.is_down {
                // Where it runs out, level with the ground there.
                let level = velocity[0] - up * velocity[0].dot(up);
                let at = shown[0] + level * (RUN_OUT * self.fade_s.max(0.0));
                let at = self.ground_at(at, ground, up);
                // The ground stops what would fall through it.
                let (height, fall) = ((shown[0] - at.point).dot(up), velocity[0].dot(up));
                let most = height.abs() / (RUN_OUT * self.fade_s.max(0.0));
                velocity[0] = level + up * fall.max(-most).min(most);
                let tilt = at.tilt(up, self.most_tilt_rad);
                self.anchor = Some(Anchor { point: at.point, tilt, turned_rad: 0.0 });
                [at.point, tilt + up * turned_rad]
            } else {
                self.anchor = None;
                before.free
            };
            let new = self.target(free, up);
            let new_velocity = difference(new, new_before).map(|way| way * rate);
            self.fade = Fade::new(difference(shown, new), difference(velocity, new_velocity), self.fade_s);
            shown = sum(new, self.fade.left());
        }
        self.before = Some(Before { rotation, free, shown, ground: below, contact });
        // The contact is at its place, the tip where the turned foot has it.
        let to_tip = turned(exp(shown[1]), tip.translation - Vec3A::from(contact));
        self.goal = [shown[0] + Vec3::from(to_tip), shown[1]];
    }

    /// The contact, and the rotation vector of the foot, without what fades.
    fn target(&self, free: [Vec3; 2], up: Vec3) -> [Vec3; 2] {
        self.anchor.map_or(free, |anchor| [anchor.point, anchor.tilt - up * anchor.turned_rad])
    }

    /// The ground on the vertical through a point; the point itself, level, where the answer is not finite.
    fn ground_at(&self, at: Vec3, ground: &mut dyn FnMut(Vec3) -> Ground, up: Vec3) -> Ground {
        let Ground { point, normal } = ground(at);
        let point = at + up * (point - at).dot(up);
        if point.is_finite() { Ground { point, normal } } else { Ground::new(at, up) }
    }

    /// Has a foot that swings take its time where the ground jumps: what the ground rose by since the frame before, beyond what its
    /// slope there says, fades.
    fn absorb_step(&mut self, before: &Before, below: &Ground, contact: Vec3, up: Vec3) {
        let way = contact - before.contact;
        let (normal, rise) = (before.ground.normal, (below.point - before.ground.point).dot(up));
        let level = way - up * way.dot(up);
        let slope = -normal.dot(level) / normal.dot(up);
        let jump = rise - if slope.is_finite() { slope } else { 0.0 };
        if jump.abs() > STEP * self.limb.length() {
            let left = self.fade.left();
            self.fade = Fade::new([left[0] - up * jump, left[1]], self.fade.rate(), self.fade_s);
        }
    }

    /// How far the pelvis has to be lowered so that the leg reaches with this part of its length; below 0 where it has room.
    fn lack(&self, figure: &Figure, up: Vec3, stretch: f32) -> f32 {
        let hip = (figure.place.to_affine() * figure.model()[self.limb.chain()[0]]).translation;
        let way = Vec3::from(hip) - self.goal[0];
        let reach = stretch * self.limb.reach(figure.model());
        let (height, aside) = (way.dot(up), length(cross(way.into(), up.into())));
        // |way − lack·up| = reach.
        height - square_root(reach * reach - aside * aside)
    }

    /// True if the leg is too short for where its foot is planted.
    fn is_overstretched(&self, figure: &Figure) -> bool {
        let hip = (figure.place.to_affine() * figure.model()[self.limb.chain()[0]]).translation;
        length(hip - Vec3A::from(self.goal[0])) > self.limb.reach(figure.model())
    }

    /// Brings the foot to where it was decided.
    fn follow(&mut self, figure: &mut Figure) -> Result<f32, PoseError> {
        let [point, rotation] = self.goal;
        let Some(to_model) = inverse(&figure.place.to_affine()) else { return Ok(0.0) };
        let rotation = Vec3::from(turned(made_unit(figure.place.rotation).conjugate(), rotation.into()));
        let goal =
            TipGoal { point: to_model.transform_point3(point), turn: Some(exp(rotation)), two_bone: &self.two_bone };
        self.limb.follow(&goal, &mut self.joints, &mut figure.both())
    }
}

fn sum(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn difference(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
