//! [`State`]: what a character remembers from frame to frame, 64 bytes and 24 for each joint.

use core::f32::consts::{PI, TAU};

use glam::Vec3A;

use crate::math;

/// A character's state: the angles of its joints and the memory of its chain. The default of an array is rest.
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
    /// What is remembered of the chain as a whole.
    #[cfg_attr(feature = "serde", serde(default))]
    pub memory: Memory,
}

impl<J> State<J> {
    /// A state with these joints that has not seen a target yet.
    #[must_use]
    pub const fn new(joints: J) -> Self {
        Self { joints, memory: Memory::NONE }
    }
}

/// A [`State`] of any number of joints, in place.
#[derive(Debug)]
pub(crate) struct StateSlices<'a> {
    pub(crate) joints: &'a mut [Joint],
    pub(crate) memory: &'a mut Memory,
}

impl<J: AsMut<[Joint]>> State<J> {
    /// The state by slices, as the solvers move it.
    #[inline]
    pub(crate) fn slices(&mut self) -> StateSlices<'_> {
        StateSlices { joints: self.joints.as_mut(), memory: &mut self.memory }
    }
}

/// A joint's state: the two angles added to the animation, radians. The default is rest: both 0.
///
/// Always finite. Besides the angles a joint remembers its velocity, where it has inertia, and where it is bound for.
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
    // In the order that solvers and kernels take them.
    #[cfg_attr(feature = "serde", serde(with = "stored::angle"))]
    pub(crate) pitch: f32,
    #[cfg_attr(feature = "serde", serde(with = "stored::angle"))]
    pub(crate) heading: f32,
    /// Velocity of heading and pitch, rad/s; 0 for a joint without inertia. Of the innermost joint of several that a natural gaze
    /// turns together, the middle of the sums that their ranges allow, and in `destination` the shift of their budget, radians.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) velocity: [f32; 2],
    /// Heading and pitch that the joint goes to, NaN for none: while the joints turn round together, though the aim
    /// gets worse on the way, and for a supporting joint of a natural gaze.
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
    /// Both angles 0 and nothing remembered.
    pub const REST: Self = Self { heading: 0.0, pitch: 0.0, velocity: [0.0; 2], destination: ABSENT };

    /// A joint at these added angles, radians: a stored state put back.
    ///
    /// An angle that is not finite counts as 0, one beyond a full turn as what is left of it; one outside its range goes
    /// back to it at the joint's rate.
    #[must_use]
    pub fn from_angles(heading_rad: f32, pitch_rad: f32) -> Self {
        Self::REST.turned_to(within_a_turn(heading_rad), within_a_turn(pitch_rad))
    }

    /// The added heading, radians: positive turns forward towards left.
    #[must_use]
    pub const fn heading(&self) -> f32 {
        self.heading
    }

    /// The added pitch, radians: positive turns forward towards up.
    #[must_use]
    pub const fn pitch(&self) -> f32 {
        self.pitch
    }

    /// The joint at other angles.
    #[inline(always)]
    pub(crate) const fn turned_to(self, heading: f32, pitch: f32) -> Self {
        Self { heading, pitch, ..self }
    }

    /// Heading and pitch.
    pub(crate) const fn angles(&self) -> [f32; 2] {
        [self.heading, self.pitch]
    }

    /// Heading and pitch that the joint goes to.
    #[inline(always)]
    pub(crate) fn destination(&self) -> Option<[f32; 2]> {
        if self.destination[0].is_nan() { None } else { Some(self.destination) }
    }

    /// Whether the joint goes to no destination.
    #[inline(always)]
    pub(crate) const fn is_free(&self) -> bool {
        is_absent(self.destination)
    }

    #[inline(always)]
    pub(crate) fn set_destination(&mut self, destination: Option<[f32; 2]>) {
        self.destination = destination.unwrap_or(ABSENT);
    }

    /// True if both angles are 0.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.angles() == [0.0; 2]
    }

    /// Whether both angles are within `angle_rad` of another joint's.
    pub(crate) fn is_near(&self, other: &Self, angle_rad: f32) -> bool {
        (self.heading - other.heading).abs() <= angle_rad && (self.pitch - other.pitch).abs() <= angle_rad
    }
}

/// An angle as it counts where it comes from outside. No range goes beyond a full turn, and beyond a thousand radians no digits
/// are left for a turn.
fn within_a_turn(angle: f32) -> f32 {
    match angle.abs() {
        small if small <= TAU => angle,
        large if large < 1e3 => math::wrap_pi(angle),
        _ => 0.0,
    }
}

/// What is remembered of a chain from frame to frame: 64 bytes.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Memory {
    /// The dual point that the last frame ended at; how a natural gaze's head was led.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) lambda: [f32; 2],
    /// The rest of the strain of the last strained frame, 0…1.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) strain: f32,
    /// The target of the last strained frame, in the innermost joint's space.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) target: [f32; 3],
    /// Time for which that target has stood still, seconds.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    pub(crate) still_s: f32,
    /// Time for which the target has been out of reach, seconds.
    #[cfg_attr(feature = "serde", serde(with = "stored::time"))]
    pub(crate) blocked_s: f32,
    /// Time left until the supporting joints of a natural gaze set out, seconds.
    #[cfg_attr(feature = "serde", serde(with = "stored::time"))]
    pub(crate) wait_s: f32,
    /// Heading and pitch of the other eye, about axes parallel to joint 0's; NaN where the last pose had none.
    #[cfg_attr(feature = "serde", serde(with = "stored::optional"))]
    other_eye: [f32; 2],
    /// Heading and pitch of the eye midway between the two, which leads.
    #[cfg_attr(feature = "serde", serde(with = "stored::finite"))]
    leading_eye: [f32; 2],
    /// The target, in the innermost joint's space, when the joints were last started from everywhere: the upper halves
    /// of single-precision numbers.
    searched: [u16; 3],
    /// The number of blocked frames since then, or so; 0 where that has never been.
    pub(crate) turn: u16,
    /// The number of halvings that make a step a gain; what a natural gaze knows the last frame's weight and attention by.
    pub(crate) caution: u8,
    pub(crate) support: Support,
    pub(crate) side: Side,
    /// Whether the target was behind.
    pub(crate) behind: bool,
}

impl PartialEq for Memory {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |m: &Self| (m.lambda, m.strain, m.target, m.still_s, m.blocked_s, m.wait_s, m.eyes());
        let flags = |m: &Self| (m.searched, m.turn, m.caution, m.support, m.side, m.behind);
        numbers(self) == numbers(other) && flags(self) == flags(other)
    }
}

impl Default for Memory {
    fn default() -> Self {
        Self::NONE
    }
}

impl Memory {
    /// Nothing seen yet.
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

    /// The added heading and pitch of the other eye, radians, about axes parallel to joint 0's; `None` where the last
    /// pose had [no other eye](crate::Pose::with_other_eye).
    #[must_use]
    pub fn other_eye(&self) -> Option<[f32; 2]> {
        self.eyes().map(|[other, _]| other)
    }

    /// Heading and pitch of the other eye and of the leading one between the two.
    pub(crate) fn eyes(&self) -> Option<[[f32; 2]; 2]> {
        if self.other_eye[0].is_nan() { None } else { Some([self.other_eye, self.leading_eye]) }
    }

    pub(crate) fn set_eyes(&mut self, eyes: Option<[[f32; 2]; 2]>) {
        [self.other_eye, self.leading_eye] = eyes.unwrap_or([ABSENT, [0.0; 2]]);
    }

    /// Whether the last frame left nothing that the next has to heed: no target behind, no strain, no other eye, no natural
    /// gaze. Compares bits: half the instructions that comparing numbers takes.
    #[inline(always)]
    pub(crate) fn is_undisturbed(&self) -> bool {
        !(self.behind | (self.support != Support::None)) && self.strain.to_bits() == 0 && is_absent(self.other_eye)
    }

    /// The target when the joints were last started from everywhere, to 8 bits.
    pub(crate) fn searched(&self) -> Vec3A {
        Vec3A::from_array(self.searched.map(|bits| f32::from_bits(u32::from(bits) << 16)))
    }

    /// What a natural gaze remembers of the head's goal, in the place of what a search remembers of its target.
    pub(crate) fn led(&self) -> Led {
        let [goal_0, goal_1, speed_0] = self.target;
        let (tired, gains) = (self.strain.abs(), self.strain.is_sign_negative());
        Led { goal: [goal_0, goal_1], speed: [speed_0, self.still_s], change: self.lambda, tired, gains }
    }

    pub(crate) fn set_led(&mut self, Led { goal, speed, change, tired, gains }: Led) {
        self.strain = if gains { -tired } else { tired };
        (self.target, self.still_s, self.lambda) = ([goal[0], goal[1], speed[0]], speed[1], change);
    }

    /// Heading and elevation that the regions of a natural gaze make beyond their part, radians, in the place of what a search
    /// remembers of its start.
    pub(crate) fn more(&self) -> [f32; 2] {
        let [a, b, c] = self.searched.map(u32::from);
        // Whatever was stored.
        [a << 16 | b, c << 16 | u32::from(self.turn)]
            .map(f32::from_bits)
            .map(|more| if more.abs() < PI { more } else { 0.0 })
    }

    #[expect(clippy::cast_possible_truncation, reason = "halves are meant")]
    pub(crate) fn set_more(&mut self, more: [f32; 2]) {
        let [[a, b], [c, d]] = more.map(f32::to_bits).map(|bits| [(bits >> 16) as u16, bits as u16]);
        (self.searched, self.turn) = ([a, b, c], d);
    }

    /// The angle by which leaps of its target have left a head without eyes behind, radians: in the place of the time that it would
    /// leave to its eyes.
    pub(crate) fn leapt(&self) -> f32 {
        self.wait_s
    }

    pub(crate) fn set_leapt(&mut self, leapt: f32) {
        self.wait_s = leapt;
    }

    pub(crate) fn set_searched(&mut self, target: Vec3A) {
        let upper_half = |x: f32| (x.to_bits() >> 16) as u16;
        self.searched = target.to_array().map(upper_half);
    }
}

/// A pair of angles that is not there.
const ABSENT: [f32; 2] = [f32::NAN; 2];

/// Whether a pair is [`ABSENT`], by its bits: one instruction less than a comparison with NaN.
#[inline(always)]
const fn is_absent(angles: [f32; 2]) -> bool {
    angles[0].to_bits() == ABSENT[0].to_bits()
}

/// The goal of a head, as it was in the last frame of a natural gaze: the sums of its joints' headings and pitches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Led {
    /// Where it was, radians.
    pub(crate) goal: [f32; 2],
    /// The speed that the head has with it, rad/s.
    pub(crate) speed: [f32; 2],
    /// Its own speed in that frame, a leap's included, rad/s.
    pub(crate) change: [f32; 2],
    /// How tired it is of leaps to and fro and of being shaken, 0…1.5.
    pub(crate) tired: f32,
    /// True if its speed changed in that frame: its next change is no jerk.
    pub(crate) gains: bool,
}

/// The activity of the joints that support a natural gaze.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub(crate) enum Support {
    /// The last frame was not that of a natural gaze.
    None,
    /// They rest where they were bound for: the eye moves alone.
    Rests,
    /// They set out in [`Memory::wait_s`] seconds.
    Waits,
    /// They follow their share of the gaze shift.
    Shares,
}

/// The side that a target was last seen on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub(crate) enum Side {
    /// No target was seen yet.
    #[default]
    Unseen,
    Left,
    Right,
}

impl Side {
    /// The side of a coordinate along left.
    pub(crate) fn of_coordinate(left: f32) -> Self {
        if left < 0.0 { Self::Right } else { Self::Left }
    }

    /// 1 for left and for a target never seen, −1 for right.
    pub(crate) fn sign(self) -> f32 {
        if self == Self::Right { -1.0 } else { 1.0 }
    }
}

/// Fields as they are stored. What a solver relies on holds again when they are read, whatever was stored.
#[cfg(feature = "serde")]
mod stored {
    /// An angle of a joint, read as [`Joint::from_angles`](super::Joint::from_angles) takes it.
    pub(super) mod angle {
        use serde::{Deserializer, Serializer};

        pub(crate) fn serialize<S: Serializer>(value: &f32, serializer: S) -> Result<S::Ok, S::Error> {
            aim_model::stored::serialize(value, serializer)
        }

        pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
            aim_model::stored::deserialize(deserializer).map(super::super::within_a_turn)
        }
    }

    /// Numbers, read as 0 where they are not finite.
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

    /// Seconds, read as 0 where they are negative or NaN.
    pub(super) mod time {
        use serde::{Deserializer, Serializer};

        pub(crate) fn serialize<S: Serializer>(value: &f32, serializer: S) -> Result<S::Ok, S::Error> {
            aim_model::stored::serialize(value, serializer)
        }

        pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
            aim_model::stored::deserialize(deserializer).map(|seconds: f32| seconds.max(0.0))
        }
    }

    /// Two angles, NaN for none; read as none where they are out of all bounds.
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
    fn sizes() {
        assert_eq!((size_of::<Memory>(), size_of::<Joint>()), (64, 24));
        assert_eq!(size_of::<State<[Joint; 3]>>(), 64 + 24 * 3);
    }

    #[test]
    fn optional_angles() {
        let (mut joint, mut memory) = (Joint::REST, Memory::NONE);
        assert_eq!((joint.destination(), memory.eyes(), joint, memory), (None, None, Joint::REST, Memory::NONE));
        joint.set_destination(Some([0.5, -0.25]));
        memory.set_eyes(Some([[0.5, 0.0], [0.25, -1.0]]));
        assert_eq!((joint.destination(), memory.other_eye()), (Some([0.5, -0.25]), Some([0.5, 0.0])));
        assert!(joint != Joint::REST && memory != Memory::NONE);
        memory.set_searched(Vec3A::new(1.0, -0.3, 1e-20));
        assert!((memory.searched() - Vec3A::new(1.0, -0.3, 0.0)).length() < 2e-3);
    }
}
