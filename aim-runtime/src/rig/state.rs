//! [`State`]: the data that a character keeps between frames: 64 bytes, plus 24 for each joint.

use core::f32::consts::{PI, TAU};

use glam::Vec3A;

use crate::math;

/// State of a character: the angles of its joints, and the memory of its chain. The default of an array of joints is
/// rest.
///
/// `J` holds one [`Joint`] for each joint of the rig: `[Joint; N]`, a `Vec`, a boxed or borrowed slice.
///
/// ```
/// use aim_runtime::{Joint, Memory, State};
///
/// let state = State::new([Joint::from_angles(0.2, 0.0), Joint::REST]);
/// assert_eq!(state, State { joints: state.joints, memory: Memory::NONE });
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State<J> {
    /// The joints' angles, from the effector inward.
    pub joints: J,
    /// Memory of the chain as a whole.
    #[cfg_attr(feature = "serde", serde(default))]
    pub memory: Memory,
}

impl<J> State<J> {
    /// Creates a state with these joints and an empty memory.
    #[must_use]
    pub const fn new(joints: J) -> Self {
        Self { joints, memory: Memory::NONE }
    }
}

/// A [`State`] with any number of joints, borrowed as slices.
#[derive(Debug)]
pub(crate) struct StateSlices<'a> {
    pub(crate) joints: &'a mut [Joint],
    pub(crate) memory: &'a mut Memory,
}

impl<J: AsMut<[Joint]>> State<J> {
    /// Returns the state as slices, in the form that the solvers modify.
    #[inline]
    pub(crate) fn slices(&mut self) -> StateSlices<'_> {
        StateSlices { joints: self.joints.as_mut(), memory: &mut self.memory }
    }
}

/// State of a joint: the two angles added to the animation, radians. The default is rest: both 0.
///
/// The angles are always finite. A joint also remembers its velocity, if it has inertia, and its destination.
///
/// ```
/// use aim_runtime::Joint;
///
/// let joint = Joint::from_angles(0.2, f32::NAN);
/// assert_eq!((joint.heading(), joint.pitch()), (0.2, 0.0));
/// ```
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Joint {
    // In the order in which solvers and kernels take them.
    #[cfg_attr(feature = "serde", serde(with = "stored::angle"))]
    pub(crate) pitch: f32,
    #[cfg_attr(feature = "serde", serde(with = "stored::angle"))]
    pub(crate) heading: f32,
    /// Velocity of heading and pitch, rad/s; 0 for a joint without inertia. In a natural gaze the outermost joint of a
    /// region stores the region's velocity, and the innermost joint of a region of several stores the shift of the
    /// region's range, radians.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) velocity: [f32; 2],
    /// Heading and pitch that the joint is moving to, radians, while joints turn round together although the aim gets
    /// worse on the way; NaN for none. In a natural gaze the eye stores its last goal, the outermost joint of a region
    /// the region's acceleration (rad/s²), and the innermost joint of a region of several the shift of the region's
    /// budget (radians).
    #[cfg_attr(feature = "serde", serde(with = "stored::optional"))]
    pub(crate) destination: [f32; 2],
}

impl PartialEq for Joint {
    fn eq(&self, other: &Self) -> bool {
        let all = |joint: &Self| (joint.heading, joint.pitch, joint.velocity, joint.destination());
        all(self) == all(other)
    }
}

impl Default for Joint {
    #[inline]
    fn default() -> Self {
        Self::REST
    }
}

impl Joint {
    /// A joint at rest: both angles 0, without velocity or destination.
    pub const REST: Self = Self { heading: 0.0, pitch: 0.0, velocity: [0.0; 2], destination: ABSENT };

    /// Creates a joint at these added angles, radians, for example to restore stored angles.
    ///
    /// An angle that is not finite counts as 0, and one beyond a full turn is wrapped. An angle outside its range
    /// returns to it at the joint's rate.
    #[must_use]
    pub fn from_angles(heading_rad: f32, pitch_rad: f32) -> Self {
        Self::REST.turned_to(within_a_turn(heading_rad), within_a_turn(pitch_rad))
    }

    /// Returns the added heading, radians: positive turns forward towards left.
    #[must_use]
    pub const fn heading(&self) -> f32 {
        self.heading
    }

    /// Returns the added pitch, radians: positive turns forward towards up.
    #[must_use]
    pub const fn pitch(&self) -> f32 {
        self.pitch
    }

    /// Returns the joint at other angles, with its memory kept.
    #[inline(always)]
    pub(crate) const fn turned_to(self, heading: f32, pitch: f32) -> Self {
        Self { heading, pitch, ..self }
    }

    /// Returns heading and pitch, radians.
    pub(crate) const fn angles(&self) -> [f32; 2] {
        [self.heading, self.pitch]
    }

    /// Returns the stored destination, if there is one.
    #[inline(always)]
    pub(crate) fn destination(&self) -> Option<[f32; 2]> {
        if self.destination[0].is_nan() { None } else { Some(self.destination) }
    }

    /// Returns `true` if the joint has no destination.
    #[inline(always)]
    pub(crate) const fn is_free(&self) -> bool {
        is_absent(self.destination)
    }

    #[inline(always)]
    pub(crate) fn set_destination(&mut self, destination: Option<[f32; 2]>) {
        self.destination = destination.unwrap_or(ABSENT);
    }

    /// Returns `true` if both angles are 0.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.angles() == [0.0; 2]
    }

    /// Returns `true` if both angles are within `angle_rad` of another joint's.
    pub(crate) fn is_near(&self, other: &Self, angle_rad: f32) -> bool {
        (self.heading - other.heading).abs() <= angle_rad && (self.pitch - other.pitch).abs() <= angle_rad
    }
}

/// Sanitises an angle that comes from outside. Ranges extend at most a full turn from 0, so larger angles are wrapped;
/// above 1000 rad an angle is too coarse to wrap and becomes 0.
fn within_a_turn(angle: f32) -> f32 {
    match angle.abs() {
        small if small <= TAU => angle,
        large if large < 1e3 => math::wrap_pi(angle),
        _ => 0.0,
    }
}

/// Data that is kept for a chain from frame to frame: 64 bytes. The fields of the exact solver's search are reused by
/// the natural solver.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Memory {
    /// Exact solver: the dual point at which the last frame ended. Natural solver: [`HeadGoal::velocity`].
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) lambda: [f32; 2],
    /// Exact solver: remaining strain of the last strained frame, 0…1. Natural solver: [`HeadGoal::slowdown`].
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) strain: f32,
    /// Exact solver: the target of the last strained frame, in the innermost joint's space. Natural solver:
    /// [`HeadGoal::angles`] and the heading of [`HeadGoal::feed_forward`].
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) target: [f32; 3],
    /// Exact solver: time for which that target has stood still, seconds. Natural solver: the pitch of
    /// [`HeadGoal::feed_forward`].
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) still_s: f32,
    /// Time for which the target has been out of reach, seconds.
    #[cfg_attr(feature = "serde", serde(with = "stored::time"))]
    pub(crate) blocked_s: f32,
    /// Time until the supporting joints of a natural gaze start to move, seconds. For a head without eyes:
    /// [`Memory::jump_lag`].
    #[cfg_attr(feature = "serde", serde(with = "stored::time"))]
    pub(crate) wait_s: f32,
    /// Heading and pitch of the other eye, radians, about axes parallel to joint 0's; NaN if the last pose had none.
    #[cfg_attr(feature = "serde", serde(with = "stored::optional"))]
    other_eye: [f32; 2],
    /// Heading and pitch of the virtual eye midway between the two, which leads, radians. For a head without eyes:
    /// [`Memory::swings`].
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    leading_eye: [f32; 2],
    /// Exact solver: the target, in the innermost joint's space, of the last search from all starting points, as the
    /// upper halves of single-precision numbers. Natural solver: part of [`Memory::extra_turn`].
    searched: [u16; 3],
    /// Exact solver: number of blocked frames since that search, at least 1; 0 if there was none. Natural solver: part
    /// of [`Memory::extra_turn`].
    pub(crate) turn: u16,
    /// Exact solver: number of halvings after which a step is a gain. Natural solver: a hash of the last frame's weight
    /// and attention, which detects that they change.
    pub(crate) caution: u8,
    /// Activity of the joints that support a natural gaze.
    pub(crate) support: Support,
    /// Side on which the target was last seen.
    pub(crate) side: Side,
    /// `true` if the target was behind the character.
    pub(crate) behind: bool,
}

impl PartialEq for Memory {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |m: &Self| (m.lambda, m.strain, m.target, m.still_s, m.blocked_s, m.wait_s);
        let eyes = |m: &Self| (m.other_eye(), m.leading_eye);
        let flags = |m: &Self| (m.searched, m.turn, m.caution, m.support, m.side, m.behind);
        numbers(self) == numbers(other) && eyes(self) == eyes(other) && flags(self) == flags(other)
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::NONE
    }
}

impl Memory {
    /// An empty memory: no target has been seen yet.
    pub const NONE: Self = Self {
        lambda: [0.0; 2],
        strain: 0.0,
        target: [0.0; 3],
        still_s: 0.0,
        blocked_s: 0.0,
        wait_s: 0.0,
        other_eye: ABSENT,
        leading_eye: [0.0; 2],
        searched: [0; 3],
        turn: 0,
        caution: 0,
        support: Support::None,
        side: Side::Unseen,
        behind: false,
    };

    /// Returns the added heading and pitch of the other eye, radians, about axes parallel to joint 0's; `None` if the
    /// last pose had [no other eye](crate::Pose::with_other_eye).
    #[must_use]
    pub fn other_eye(&self) -> Option<[f32; 2]> {
        self.eyes().map(|[other, _]| other)
    }

    /// Returns heading and pitch of the other eye and of the leading eye between the two.
    pub(crate) fn eyes(&self) -> Option<[[f32; 2]; 2]> {
        if self.other_eye[0].is_nan() { None } else { Some([self.other_eye, self.leading_eye]) }
    }

    pub(crate) fn set_eyes(&mut self, eyes: [[f32; 2]; 2]) {
        [self.other_eye, self.leading_eye] = eyes;
    }

    /// Forgets the other eye.
    pub(crate) fn forget_eyes(&mut self) {
        if self.eyes().is_some() {
            [self.other_eye, self.leading_eye] = [ABSENT, [0.0; 2]];
        }
    }

    /// Returns how the goal of a head without eyes swings, which is stored in the field for the leading eye.
    pub(crate) fn swings(&self) -> Swings {
        if self.eyes().is_some() {
            return Swings::default();
        }
        let [mean, braking] = self.leading_eye;
        let bits = mean.to_bits();
        // Stored data may be arbitrary.
        let mean_velocity = [bits & 0xffff_0000, bits << 16].map(f32::from_bits);
        let is_known = mean_velocity.iter().all(|velocity| velocity.is_finite());
        Swings { mean_velocity: if is_known { mean_velocity } else { [0.0; 2] }, braking }
    }

    pub(crate) fn set_swings(&mut self, swings: Swings) {
        if self.eyes().is_none() {
            let [heading, pitch] = swings.mean_velocity.map(f32::to_bits);
            self.leading_eye = [f32::from_bits(heading & 0xffff_0000 | pitch >> 16), swings.braking];
        }
    }

    /// Returns `true` if the last frame left nothing that the next frame must consider: no target behind, no strain, no
    /// other eye, no natural gaze. Compares bits, which takes half the instructions of comparing numbers.
    #[inline(always)]
    pub(crate) fn is_undisturbed(&self) -> bool {
        !(self.behind | (self.support != Support::None)) && self.strain.to_bits() == 0 && is_absent(self.other_eye)
    }

    /// Returns the target of the last search from all starting points, to 8 bits.
    pub(crate) fn searched_target(&self) -> Vec3A {
        Vec3A::from_array(self.searched.map(|bits| f32::from_bits(u32::from(bits) << 16)))
    }

    /// Returns a natural gaze's memory of the head's goal, which is stored in the fields of the exact solver's search.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn head_goal(&self) -> HeadGoal {
        let [heading, pitch, heading_rate] = self.target;
        HeadGoal {
            angles: [heading, pitch],
            feed_forward: [heading_rate, self.still_s],
            velocity: self.lambda,
            slowdown: self.strain,
        }
    }

    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn set_head_goal(&mut self, goal: HeadGoal) {
        let HeadGoal { angles, feed_forward, velocity, slowdown } = goal;
        self.strain = slowdown;
        self.target = [angles[0], angles[1], feed_forward[0]];
        (self.still_s, self.lambda) = (feed_forward[1], velocity);
    }

    /// Returns the heading and elevation that the regions of a natural gaze turn beyond their share, radians, which are
    /// stored in the fields of the exact solver's search.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn extra_turn(&self) -> [f32; 2] {
        let [a, b, c] = self.searched.map(u32::from);
        // Stored data may be arbitrary.
        [b << 16 | a, u32::from(self.turn) << 16 | c]
            .map(f32::from_bits)
            .map(|turn| if turn.abs() < PI { turn } else { 0.0 })
    }

    #[cfg_attr(not(aim_small), inline(always))]
    #[expect(clippy::cast_possible_truncation, reason = "halves are meant")]
    pub(crate) fn set_extra_turn(&mut self, turn: [f32; 2]) {
        let [[a, b], [c, d]] = turn.map(f32::to_bits).map(|bits| [bits as u16, (bits >> 16) as u16]);
        (self.searched, self.turn) = ([a, b, c], d);
    }

    /// Returns the angle by which jumps of the target have left a head without eyes behind, radians. Stored in the
    /// field for the delay of the supporting joints, which such a head does not use.
    pub(crate) fn jump_lag(&self) -> f32 {
        self.wait_s
    }

    pub(crate) fn set_jump_lag(&mut self, jump_lag: f32) {
        self.wait_s = jump_lag;
    }

    pub(crate) fn set_searched_target(&mut self, target: Vec3A) {
        let upper_half = |x: f32| (x.to_bits() >> 16) as u16;
        self.searched = target.to_array().map(upper_half);
    }
}

/// The representation of an absent pair of angles.
const ABSENT: [f32; 2] = [f32::NAN; 2];

/// Returns `true` if a pair is [`ABSENT`]. Compares bits, which takes one instruction less than a comparison with NaN.
#[inline(always)]
const fn is_absent(angles: [f32; 2]) -> bool {
    angles[0].to_bits() == ABSENT[0].to_bits()
}

/// Goal of a head in the last frame of a natural gaze; angles are sums over the head's joints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct HeadGoal {
    /// Heading and pitch of the goal, radians.
    pub(crate) angles: [f32; 2],
    /// Feed-forward velocity: the part of the goal's velocity that the head follows, rad/s.
    pub(crate) feed_forward: [f32; 2],
    /// Velocity of the goal itself in that frame, including jumps, rad/s.
    pub(crate) velocity: [f32; 2],
    /// Degree to which the head is slowed down because its goal jumps to and fro, 0…1.5.
    pub(crate) slowdown: f32,
}

/// Recent movement to and fro of the goal of a head without eyes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Swings {
    /// Mean velocity of the goal in heading and pitch over about a frame, rad/s, to 8 bits.
    pub(crate) mean_velocity: [f32; 2],
    /// Largest recent deceleration of the goal, rad/s².
    pub(crate) braking: f32,
}

/// Activity of the joints that support a natural gaze.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub(crate) enum Support {
    /// The last frame was not one of a natural gaze.
    None,
    /// They rest at their goal; the eye moves alone.
    Rests,
    /// They start to move in [`Memory::wait_s`] seconds.
    Waits,
    /// They follow their share of the gaze shift.
    Shares,
}

/// Side on which a target was last seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub(crate) enum Side {
    /// No target has been seen yet.
    #[default]
    Unseen,
    Left,
    Right,
}

impl Side {
    /// Returns the side of a coordinate along left.
    pub(crate) fn of_coordinate(left: f32) -> Self {
        if left < 0.0 { Self::Right } else { Self::Left }
    }

    /// Returns 1 for left and for a target never seen, −1 for right.
    pub(crate) fn sign(self) -> f32 {
        if self == Self::Right { -1.0 } else { 1.0 }
    }
}

/// Serialisation of fields. Deserialisation restores the solvers' invariants, whatever was stored.
#[cfg(feature = "serde")]
mod stored {
    /// A joint's angle; deserialised as by [`Joint::from_angles`](super::Joint::from_angles).
    pub(super) mod angle {
        use serde::{Deserializer, Serializer};

        pub(crate) fn serialize<S: Serializer>(value: &f32, serializer: S) -> Result<S::Ok, S::Error> {
            aim_model::stored::serialize(value, serializer)
        }

        pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
            aim_model::stored::deserialize(deserializer).map(super::super::within_a_turn)
        }
    }

    /// Numbers; deserialised as 0 if they are not finite.
    pub(super) mod finite {
        use aim_model::stored::Stored;
        use serde::{Deserializer, Serializer};

        pub(crate) fn serialize<T: Stored, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
            aim_model::stored::serialize(value, serializer)
        }

        pub(crate) fn deserialize<'de, T, D>(deserializer: D) -> Result<T, D::Error>
        where
            T: Stored + Numbers,
            D: Deserializer<'de>,
        {
            aim_model::stored::deserialize(deserializer).map(Numbers::finite)
        }

        pub(crate) trait Numbers {
            fn finite(self) -> Self;
        }

        impl Numbers for f32 {
            fn finite(self) -> Self {
                if self.is_finite() { self } else { 0.0 }
            }
        }

        impl<const N: usize> Numbers for [f32; N] {
            fn finite(self) -> Self {
                self.map(Numbers::finite)
            }
        }
    }

    /// Seconds; deserialised as 0 if negative or NaN.
    pub(super) mod time {
        use serde::{Deserializer, Serializer};

        pub(crate) fn serialize<S: Serializer>(value: &f32, serializer: S) -> Result<S::Ok, S::Error> {
            aim_model::stored::serialize(value, serializer)
        }

        pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
            aim_model::stored::deserialize(deserializer).map(|seconds: f32| seconds.max(0.0))
        }
    }

    /// Two angles, NaN for none; deserialised as none if they are not below 1000 rad.
    pub(super) mod optional {
        use serde::{Deserialize, Deserializer, Serialize, Serializer};

        pub(crate) fn serialize<S: Serializer>(angles: &[f32; 2], serializer: S) -> Result<S::Ok, S::Error> {
            let are_angles = angles.iter().all(|angle| angle.is_finite());
            are_angles.then_some(*angles).serialize(serializer)
        }

        pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f32; 2], D::Error> {
            let angles = Option::<[f32; 2]>::deserialize(deserializer)?;
            Ok(angles.filter(|angles| angles.iter().all(|angle| angle.abs() < 1e3)).unwrap_or([f32::NAN; 2]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_have_the_documented_sizes() {
        assert_eq!((size_of::<Memory>(), size_of::<Joint>()), (64, 24));
        assert_eq!(size_of::<State<[Joint; 3]>>(), 64 + 24 * 3);
    }

    #[test]
    fn optional_data_is_absent_or_stored() {
        let (mut joint, mut memory) = (Joint::REST, Memory::NONE);
        assert_eq!((joint.destination(), memory.eyes(), joint, memory), (None, None, Joint::REST, Memory::NONE));
        joint.set_destination(Some([0.5, -0.25]));
        memory.set_eyes([[0.5, 0.0], [0.25, -1.0]]);
        assert_eq!((joint.destination(), memory.other_eye()), (Some([0.5, -0.25]), Some([0.5, 0.0])));
        assert!(joint != Joint::REST && memory != Memory::NONE);
        assert_eq!(memory.swings().braking, 0.0);
        memory.forget_eyes();
        memory.set_swings(Swings { mean_velocity: [0.5, -0.25], braking: 3.0 });
        assert_eq!((memory.swings().mean_velocity, memory.swings().braking), ([0.5, -0.25], 3.0));
        memory.leading_eye[0] = f32::from_bits(0x3f80_7fc0);
        assert_eq!(memory.swings().mean_velocity, [0.0; 2]);
        memory.set_searched_target(Vec3A::new(1.0, -0.3, 1e-20));
        assert!((memory.searched_target() - Vec3A::new(1.0, -0.3, 0.0)).length() < 2e-3);
    }
}
