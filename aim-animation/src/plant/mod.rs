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
/// The angle by which that ground may turn from frame to frame before the foot takes its time, radians: a crease.
const CREASE_RAD: f32 = 0.1;
/// The part of velocity × fade at which what comes to rest does so without turning back: 30·c·u²(1−u)² + 1 − 18u² + 32u³ − 15u⁴ ≥ 0.
const RUN_OUT: f32 = 0.4;
/// The part of a leg's length by which a foot may miss its anchor and still count as standing there: a leg of two free bones, and one
/// with a hinge, or of more bones, whose solver is slow where it is nearly straight.
const REACHED: [f32; 2] = [1e-4, 1e-2];

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
    /// The place of the tip in this frame and the rotation that turns it there, in the world.
    goal: (Vec3, Quat),
}

/// Where a foot is planted, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Anchor {
    point: Vec3,
    tilt: Vec3,
    /// How far the animation has turned the foot about the vertical since, radians.
    turned_rad: f32,
}

/// The state of a frame that the next one needs, in the world. Contacts come with a rotation vector each, whose part along up turns the foot
/// before the rest tilts it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Before {
    rotation: Quat,
    free: [Vec3; 2],
    shown: [Vec3; 2],
    ground: Ground,
    contact: Vec3,
    /// From the free to the shown in the frame before that, and the inverse of the time since, 1 / s; 0 if there was none.
    offset_before: [Vec3; 2],
    rate: f32,
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
            goal: (Vec3::ZERO, Quat::IDENTITY),
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

    /// Plants the foot where it comes to rest, from the next frame on that has time.
    pub fn plant(&mut self) {
        self.is_down = true;
    }

    /// Leaves the foot to the animation, from the next frame on that has time.
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

    /// The point of the world at which it is planted; `None` while it swings, and from the frame on in which the leg does not reach
    /// there. While it comes to rest the contact is still on its way there.
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
    /// It is a ten-thousandth of the leg's length at most; a hundredth where a hinge limits the leg, or one of more than two bones is
    /// nearly straight.
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
            self.goal = (tip.translation.into(), Quat::IDENTITY);
            return;
        };
        let below = ground(contact).below(contact, up);
        let height = (below.point - figure.place.translation).dot(up);
        let free = [contact + up * height, below.tilt(up, self.most_tilt_rad)];
        let first =
            Before { rotation, free, shown: free, ground: below, contact, offset_before: [Vec3::ZERO; 2], rate: 0.0 };
        let before = self.before.unwrap_or(first);
        self.fade.advance(dt_s);
        let rate = 1.0 / dt_s;
        let rate = if self.before.is_some() && rate > 0.0 && rate.is_finite() { rate } else { 0.0 };
        // The turn about the vertical since the frame before: the twist of q is 2·atan(q·up / w), here for small turns.
        let turned_rad = log(product(rotation, before.rotation.conjugate())).dot(up);
        if let Some(anchor) = &mut self.anchor {
            anchor.turned_rad += turned_rad;
        } else {
            self.absorb_step(&before, &first, up);
        }
        let mut shown = sum(self.target(free, up), self.fade.left());
        let offset_before = difference(before.shown, before.free);
        // Without time its velocity is not known; in its first frame it rests.
        if self.is_down != self.anchor.is_some() && (rate > 0.0 || self.before.is_none()) {
            if self.is_down {
                let mut velocity = difference(shown, before.shown).map(|way| way * rate);
                // Where it runs out, level with the ground there.
                let level = velocity[0] - up * velocity[0].dot(up);
                let at = shown[0] + level * (RUN_OUT * self.fade_s.max(0.0));
                let at = if at.is_finite() { at } else { contact };
                let at = ground(at).below(at, up);
                // The ground stops what would fall through it.
                let (height, fall) = ((shown[0] - at.point).dot(up), velocity[0].dot(up));
                let most = height.abs() / (RUN_OUT * self.fade_s.max(0.0));
                velocity[0] = level + up * fall.max(-most).min(most);
                // From now on it is turned against the animation.
                velocity[1] += up * (turned_rad * rate);
                let tilt = at.tilt(up, self.most_tilt_rad);
                self.anchor = Some(Anchor { point: at.point, tilt, turned_rad: 0.0 });
                self.fade = Fade::new(difference(shown, [at.point, tilt]), velocity, self.fade_s);
            } else {
                self.leave(difference(shown, free), offset_before, rate);
            }
            shown = sum(self.target(free, up), self.fade.left());
        }
        self.before = Some(Before { rotation, free, shown, ground: below, contact, offset_before, rate });
        // The contact is at its place, the tip where the turned foot has it.
        let about = up * shown[1].dot(up);
        let turn = product(exp(shown[1] - about), exp(about));
        self.goal = (shown[0] + Vec3::from(turned(turn, tip.translation - Vec3A::from(contact))), turn);
    }

    /// Leaves the anchor for the animated way, from an offset that changed at a rate.
    fn leave(&mut self, offset: [Vec3; 2], offset_before: [Vec3; 2], rate: f32) {
        (self.is_down, self.anchor) = (false, None);
        self.fade = Fade::new(offset, difference(offset, offset_before).map(|way| way * rate), self.fade_s);
    }

    /// The contact, and the rotation vector of the foot, without what fades.
    fn target(&self, free: [Vec3; 2], up: Vec3) -> [Vec3; 2] {
        self.anchor.map_or(free, |anchor| [anchor.point, anchor.tilt - up * anchor.turned_rad])
    }

    /// Has a foot that swings take its time where the ground jumps: what the ground rose by since the frame before, beyond what its
    /// slope both there and here says, and what it turned by fade.
    fn absorb_step(&mut self, before: &Before, now: &Before, up: Vec3) {
        let rise = (now.ground.point - before.ground.point).dot(up);
        let way = now.contact - before.contact;
        let slopes = [before, now].map(|frame| frame.ground.rise(way, up) * rise.signum());
        let jump = (rise.abs() - slopes[0].min(slopes[1]).max(0.0)).max(0.0);
        let turn = now.free[1] - before.free[1];
        if jump > STEP * self.limb.length() || length(turn.into()) > CREASE_RAD {
            let step = [up * jump.copysign(rise), turn];
            self.fade = Fade::new(difference(self.fade.left(), step), self.fade.rate(), self.fade_s);
        }
    }

    /// How far the pelvis has to be lowered so that the leg reaches with this part of its length; below 0 where it has room.
    fn lack(&self, figure: &Figure, up: Vec3, stretch: f32) -> f32 {
        let hip = (figure.place.to_affine() * figure.model()[self.limb.chain()[0]]).translation;
        let way = Vec3::from(hip) - self.goal.0;
        let reach = stretch * self.limb.reach(figure.model());
        let (height, aside) = (way.dot(up), length(cross(way.into(), up.into())));
        // |way − lack·up| = reach.
        height - square_root(reach * reach - aside * aside)
    }

    /// Brings the foot to where it was decided. A planted one that does not reach its anchor leaves it, from where it is.
    fn follow(&mut self, figure: &mut Figure) -> Result<(), PoseError> {
        let (point, turn) = self.goal;
        let Some(to_model) = inverse(&figure.place.to_affine()) else { return Ok(()) };
        let place = made_unit(figure.place.rotation);
        let turn = Some(product(product(place.conjugate(), turn), place));
        let goal = TipGoal { point: to_model.transform_point3(point), turn, two_bone: &self.two_bone };
        let error = self.limb.follow(&goal, &mut self.joints, &mut figure.both())?;
        let is_exact = self.joints.len() == 2 && self.two_bone.hinge.is_none();
        let is_missed = self.anchor.is_some() && error > REACHED[usize::from(!is_exact)] * self.limb.length();
        let contact = self.contact(figure).filter(|_| is_missed);
        if let Some((contact, before)) = contact.zip(self.before.as_mut()) {
            before.shown[0] = contact;
            let Before { free, shown, offset_before, rate, .. } = *before;
            self.leave(difference(shown, free), offset_before, rate);
        }
        Ok(())
    }
}

fn sum(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn difference(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
