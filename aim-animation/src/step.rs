//! [`Step`]: the way of one frame through a clip.

use crate::float::{floor, narrow};

/// The most ends of a clip that one step passes.
const MOST_ENDS: f64 = 65_536.0;

/// What becomes of a clip that is at its end.
///
/// ```
/// use aim_animation::{Control, Looping};
///
/// let mut wave = Control::new().with_looping(Looping::Once);
/// wave.advance(2.0, 1.5);
/// assert!(wave.is_done(1.5) && wave.time_s() == 1.5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Looping {
    /// It stops there, or at its beginning when it is played backwards.
    Once,
    /// It begins again.
    #[default]
    Repeat,
    /// It goes back, and at the beginning forward again.
    PingPong,
}

/// The way through a clip's local time that a control took in one frame: over its ends any number of times, in either
/// direction. Tells which [events](crate::Clip::events_passed) are passed and how far the root moves.
///
/// ```
/// use aim_animation::Control;
///
/// let mut control = Control::new().at(0.75);
/// let step = control.advance(0.5, 1.0);
/// assert_eq!((step.from_s(), step.to_s(), step.ends_passed()), (0.75, 0.25, 1));
/// assert_eq!(step.pieces().map(|piece| piece.to_s - piece.from_s).collect::<Vec<_>>(), [0.25, 0.25]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    pub(crate) from_s: f64,
    pub(crate) to_s: f64,
    pub(crate) length_s: f64,
    /// The number of times that an end of the clip is passed.
    pub(crate) ends: u32,
    pub(crate) is_forward: bool,
    pub(crate) bounces: bool,
    /// Whether what happens where the step begins belongs to it.
    pub(crate) includes_from: bool,
}

/// A piece of a step between the ends of the clip; `to_s` is less than `from_s` if it goes backward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The local time at which it begins, seconds.
    pub from_s: f64,
    /// The local time at which it ends, seconds; included.
    pub to_s: f64,
    /// Whether what happens at `from_s` belongs to it.
    pub includes_from: bool,
}

impl Step {
    /// The step of a control that is not moved.
    pub(crate) fn none(at_s: f64, length_s: f64) -> Self {
        Self { from_s: at_s, to_s: at_s, length_s, ends: 0, is_forward: true, bounces: false, includes_from: false }
    }

    /// The local time at which the step begins, seconds.
    #[must_use]
    pub fn from_s(&self) -> f32 {
        narrow(self.from_s)
    }

    /// The local time at which the step ends, seconds.
    #[must_use]
    pub fn to_s(&self) -> f32 {
        narrow(self.to_s)
    }

    /// How often an end of the clip was passed.
    #[must_use]
    pub fn ends_passed(&self) -> u32 {
        self.ends
    }

    /// The pieces between the ends of the clip, in order.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> + use<> {
        let step = *self;
        (0..=step.ends).map(move |index| step.piece(index))
    }

    /// Piece `index` of those that [`pieces`](Self::pieces) tells.
    pub(crate) fn piece(&self, index: u32) -> Piece {
        let end = |is_high: bool| if is_high { self.length_s } else { 0.0 };
        // A step that bounces changes its direction at each end.
        let is_forward = self.is_forward != (self.bounces && index % 2 == 1);
        Piece {
            from_s: if index == 0 { self.from_s } else { end(!is_forward) },
            to_s: if index == self.ends { self.to_s } else { end(is_forward) },
            // The turning point of a step that bounces was told on arriving.
            includes_from: if index == 0 { self.includes_from } else { !self.bounces },
        }
    }
}

/// The number of ends on the way from one round to another. Keeps it even or odd where there are too many.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
pub(crate) fn count(rounds: f64) -> u32 {
    let rounds = rounds.abs();
    let odd = rounds - floor(rounds / 2.0) * 2.0;
    if rounds > MOST_ENDS { (MOST_ENDS - 2.0 + odd) as u32 } else { rounds as u32 }
}
