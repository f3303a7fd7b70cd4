//! [`Plant`] and [`Stance`]: foot planting. `ground.rs` describes the ground under a foot, `stance.rs` lowers the
//! pelvis.

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

/// Largest jump between frames of the ground under a swinging foot that the foot follows at once, as a fraction of the
/// leg's length. Larger jumps, such as the edge of a stair, are faded in.
const STEP: f32 = 0.01;
/// Largest turn between frames of the ground's normal that a swinging foot follows at once, radians. Larger ones, at a
/// crease, are faded in.
const CREASE_RAD: f32 = 0.1;
/// Distance from a moving foot to its anchor, as a fraction c of velocity × fade time. With it, the foot comes to rest
/// without turning back: 30·c·u²(1−u)² + 1 − 18u² + 32u³ − 15u⁴ ≥ 0.
const RUN_OUT: f32 = 0.4;
/// Largest distance of a foot from its anchor at which it still counts as standing there, as a fraction of the leg's
/// length. The first is for legs of two bones without a hinge; the second for all others, whose solver converges slowly
/// when they are nearly straight.
const REACHED: [f32; 2] = [1e-4, 1e-2];

/// A foot that stays in place in the world while it is down, and keeps its height above uneven ground while it swings.
///
/// One point of the foot, the *contact*, is pinned: usually the ball, over which the foot rolls. While planted, the
/// contact stays on the ground and the foot does not turn about the vertical; rolling stays as animated. While the foot
/// swings, it is raised by the height of the ground below it, relative to the figure's place. The sole is tilted to the
/// ground's normal. Transitions take [`fade_s`](Self::fade_s) seconds and start from the current velocity, without a
/// jump in position or speed.
///
/// A [`Stance`] applies the feet as a layer and lowers the pelvis for them.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// Time in which the foot comes to rest, or returns to the animation, seconds. Default 0.15.
    pub fade_s: f32,
    /// Largest tilt of the sole, radians. Default 0.6.
    pub most_tilt_rad: f32,
    /// Solver for a leg of two bones. Its pole is in model space, a hinge's axis in the space of the middle bone.
    pub two_bone: TwoBone,
    limb: Limb,
    joints: Vec<CcdJoint>,
    /// Contact point in the space of the tip bone.
    contact: Vec3,
    /// Names of the events at which the foot comes down and goes up.
    events: Option<[String; 2]>,
    is_down: bool,
    /// Point and orientation at which the foot is planted; `None` while it swings.
    anchor: Option<Anchor>,
    fade: Fade,
    last_frame: Option<LastFrame>,
    /// Position of the tip in this frame and the rotation applied to it, in the world.
    goal: (Vec3, Quat),
}

/// Point and orientation at which a foot is planted, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Anchor {
    point: Vec3,
    tilt: Vec3,
    /// Angle by which the animation has turned the foot about the vertical since it was planted, radians.
    turned_rad: f32,
}

/// State of a frame that the next one needs, in the world. Each pair is a contact point and a rotation vector of the
/// foot. The component of the vector along up is applied first; the rest then tilts the foot.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LastFrame {
    rotation: Quat,
    free: [Vec3; 2],
    shown: [Vec3; 2],
    ground: Ground,
    contact: Vec3,
    /// `shown − free` one frame earlier, and the inverse of the time since, 1 / s. The rate is 0 if there was no such
    /// frame.
    offset_before: [Vec3; 2],
    rate: f32,
}

impl Plant {
    /// A foot, given by its leg from the hip to the ankle and its contact: a point of the sole at rest, in model space.
    ///
    /// # Errors
    /// See [`LimbError`] for the conditions.
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
            last_frame: None,
            goal: (Vec3::ZERO, Quat::IDENTITY),
        })
    }

    /// Sets the names of the clip's events at which the foot comes down and goes up; see [`on_event`](Self::on_event).
    #[must_use]
    pub fn with_events(mut self, down: impl Into<String>, up: impl Into<String>) -> Self {
        self.events = Some([down.into(), up.into()]);
        self
    }

    /// Sets the time in which the foot comes to rest or returns to the animation, seconds.
    #[must_use]
    pub const fn with_fade(mut self, fade_s: f32) -> Self {
        self.fade_s = fade_s;
        self
    }

    /// Sets the solver for a leg of two bones.
    #[must_use]
    pub const fn with_two_bone(mut self, two_bone: TwoBone) -> Self {
        self.two_bone = two_bone;
        self
    }

    /// Plants the foot at the point where it comes to rest, starting with the next frame of positive duration.
    pub fn plant(&mut self) {
        self.is_down = true;
    }

    /// Returns the foot to the animation, starting with the next frame of positive duration.
    pub fn release(&mut self) {
        self.is_down = false;
    }

    /// [Plants](Self::plant) or [releases](Self::release) the foot if the event has one of the names given to
    /// [`with_events`](Self::with_events).
    pub fn on_event(&mut self, name: &str) {
        if let Some([down, up]) = &self.events {
            self.is_down = down == name || self.is_down && up != name;
        }
    }

    /// Discards the anchor and the velocity of the foot. Call it after the character's place has jumped.
    pub fn reset(&mut self) {
        (self.is_down, self.anchor, self.fade, self.last_frame) = (false, None, Fade::NONE, None);
    }

    /// Point in the world at which the foot is planted; `None` while it swings, and as soon as the leg cannot reach the
    /// point. While the foot comes to rest, its contact is still moving towards this point.
    #[must_use]
    pub fn anchor(&self) -> Option<Vec3> {
        self.anchor.map(|anchor| anchor.point)
    }

    /// Returns `true` if the foot is planted and has come to rest.
    #[must_use]
    pub fn is_planted(&self) -> bool {
        self.anchor.is_some() && self.fade.is_done()
    }

    /// Position of the contact in the world for a figure's pose; `None` if the figure has too few bones.
    #[must_use]
    pub fn contact(&self, figure: &Figure) -> Option<Vec3> {
        Some(figure.world(self.limb.tip_bone())?.transform_point3(self.contact))
    }

    /// Distance of the contact from the point at which it is planted, in world units; 0 unless it [is
    /// planted](Self::is_planted). It is at most 1e-4 of the leg's length, or 1e-2 if the leg has a hinge or more than
    /// two bones.
    #[must_use]
    pub fn slip(&self, figure: &Figure) -> f32 {
        let places = self.contact(figure).zip(self.anchor()).filter(|_| self.is_planted());
        places.map_or(0.0, |(contact, anchor)| length((contact - anchor).into()))
    }

    /// Computes the goal of the foot in this frame. `up` is the unit up direction in the world.
    fn update_goal(&mut self, figure: &Figure, ground: &mut dyn FnMut(Vec3) -> Ground, up: Vec3, dt_s: f32) {
        let place = figure.place.to_affine();
        let tip = place * figure.model()[self.limb.tip_bone()];
        let contact = tip.transform_point3(self.contact);
        let rotation = nearest_orthogonal(tip.matrix3).and_then(|frame| unit(Quat::from_mat3a(&frame)));
        let Some(rotation) = rotation.filter(|_| contact.is_finite()) else {
            // A foot that is not finite cannot be planted, and its history is meaningless.
            self.reset();
            self.goal = (tip.translation.into(), Quat::IDENTITY);
            return;
        };
        let below = ground(contact).below(contact, up);
        let height = (below.point - figure.place.translation).dot(up);
        let free = [contact + up * height, below.tilt(up, self.most_tilt_rad)];
        let first = LastFrame {
            rotation,
            free,
            shown: free,
            ground: below,
            contact,
            offset_before: [Vec3::ZERO; 2],
            rate: 0.0,
        };
        let last_frame = self.last_frame.unwrap_or(first);
        self.fade.advance(dt_s);
        let rate = 1.0 / dt_s;
        let rate = if self.last_frame.is_some() && rate > 0.0 && rate.is_finite() { rate } else { 0.0 };
        // Angle turned about the vertical since the last frame. The twist of q is 2·atan(q·up / w); for small turns,
        // log(q)·up.
        let turned_rad = log(product(rotation, last_frame.rotation.conjugate())).dot(up);
        if let Some(anchor) = &mut self.anchor {
            anchor.turned_rad += turned_rad;
        } else {
            self.absorb_step(&last_frame, &first, up);
        }
        let mut shown = sum(self.target(free, up), self.fade.offset());
        let offset_before = difference(last_frame.shown, last_frame.free);
        // Without a time step the velocity is unknown: wait for the next frame. In the first frame the foot is assumed
        // at rest.
        if self.is_down != self.anchor.is_some() && (rate > 0.0 || self.last_frame.is_none()) {
            if self.is_down {
                let mut velocity = difference(shown, last_frame.shown).map(|way| way * rate);
                // Extrapolate the horizontal movement to where it runs out, and query the ground there.
                let level = velocity[0] - up * velocity[0].dot(up);
                let at = shown[0] + level * (RUN_OUT * self.fade_s.max(0.0));
                let at = if at.is_finite() { at } else { contact };
                let at = ground(at).below(at, up);
                // Limit the vertical speed so that the foot does not pass through the ground.
                let (height, fall) = ((shown[0] - at.point).dot(up), velocity[0].dot(up));
                let most = height.abs() / (RUN_OUT * self.fade_s.max(0.0));
                velocity[0] = level + up * fall.max(-most).min(most);
                // A planted foot does not turn with the animation: account for its present turning speed.
                velocity[1] += up * (turned_rad * rate);
                let tilt = at.tilt(up, self.most_tilt_rad);
                self.anchor = Some(Anchor { point: at.point, tilt, turned_rad: 0.0 });
                self.fade = Fade::new(difference(shown, [at.point, tilt]), velocity, self.fade_s);
            } else {
                self.release_with_fade(difference(shown, free), offset_before, rate);
            }
            shown = sum(self.target(free, up), self.fade.offset());
        }
        self.last_frame = Some(LastFrame { rotation, free, shown, ground: below, contact, offset_before, rate });
        // Put the contact at its position; the tip follows from the foot's rotation about the contact.
        let about = up * shown[1].dot(up);
        let turn = product(exp(shown[1] - about), exp(about));
        self.goal = (shown[0] + Vec3::from(turned(turn, tip.translation - Vec3A::from(contact))), turn);
    }

    /// Releases the anchor and fades to the animation, from an offset and its rate of change.
    fn release_with_fade(&mut self, offset: [Vec3; 2], offset_before: [Vec3; 2], rate: f32) {
        (self.is_down, self.anchor) = (false, None);
        self.fade = Fade::new(offset, difference(offset, offset_before).map(|way| way * rate), self.fade_s);
    }

    /// Contact and rotation vector of the foot before the fade is added.
    fn target(&self, free: [Vec3; 2], up: Vec3) -> [Vec3; 2] {
        self.anchor.map_or(free, |anchor| [anchor.point, anchor.tilt - up * anchor.turned_rad])
    }

    /// Fades in a jump of the ground under a swinging foot. The jump is the rise since the last frame beyond what the
    /// slopes of both grounds explain, and the change of the normal.
    fn absorb_step(&mut self, last_frame: &LastFrame, now: &LastFrame, up: Vec3) {
        let rise = (now.ground.point - last_frame.ground.point).dot(up);
        let way = now.contact - last_frame.contact;
        let slopes = [last_frame, now].map(|frame| frame.ground.rise(way, up) * rise.signum());
        let jump = (rise.abs() - slopes[0].min(slopes[1]).max(0.0)).max(0.0);
        let turn = now.free[1] - last_frame.free[1];
        if jump > STEP * self.limb.length() || length(turn.into()) > CREASE_RAD {
            let step = [up * jump.copysign(rise), turn];
            self.fade = Fade::new(difference(self.fade.offset(), step), self.fade.rate(), self.fade_s);
        }
    }

    /// Distance by which the pelvis must be lowered for the leg to reach its goal with `stretch` times its length;
    /// negative if there is room.
    fn needed_drop(&self, figure: &Figure, up: Vec3, stretch: f32) -> f32 {
        let hip = (figure.place.to_affine() * figure.model()[self.limb.chain()[0]]).translation;
        let way = Vec3::from(hip) - self.goal.0;
        let reach = stretch * self.limb.reach(figure.model());
        let (height, aside) = (way.dot(up), length(cross(way.into(), up.into())));
        // Solve |way − lack·up| = reach.
        height - square_root(reach * reach - aside * aside)
    }

    /// Moves the foot to its goal. A planted foot that cannot reach its anchor is released from where it is.
    fn follow(&mut self, figure: &mut Figure) -> Result<(), PoseError> {
        let (point, turn) = self.goal;
        let Some(to_model) = inverse(&figure.place.to_affine()) else { return Ok(()) };
        let place = made_unit(figure.place.rotation);
        let turn = Some(product(product(place.conjugate(), turn), place));
        let goal = TipGoal { point: to_model.transform_point3(point), turn, two_bone: &self.two_bone };
        let error = self.limb.follow(&goal, &mut self.joints, &mut figure.pose_pair())?;
        let is_exact = self.joints.len() == 2 && self.two_bone.hinge.is_none();
        let is_missed = self.anchor.is_some() && error > REACHED[usize::from(!is_exact)] * self.limb.length();
        let contact = self.contact(figure).filter(|_| is_missed);
        if let Some((contact, last_frame)) = contact.zip(self.last_frame.as_mut()) {
            last_frame.shown[0] = contact;
            let LastFrame { free, shown, offset_before, rate, .. } = *last_frame;
            self.release_with_fade(difference(shown, free), offset_before, rate);
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
