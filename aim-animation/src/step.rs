//! [`Step`]: the movement of one frame through a clip's local time.

use crate::float::{floor, narrow};

/// Maximum number of ends of a clip that one step passes.
const MOST_ENDS: f64 = 65_536.0;

/// Behaviour of a clip at its end.
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
    /// Stops at the end; or at the beginning, if played backwards.
    Once,
    /// Starts again from the beginning.
    #[default]
    Repeat,
    /// Reverses at the end, and again at the beginning.
    PingPong,
}

/// The movement of a control through a clip's local time in one frame, past any number of ends and in either direction.
/// Determines which [events](crate::Clip::events_passed) are passed and how far the root moves.
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
    /// Number of times that an end of the clip is passed.
    pub(crate) ends: u32,
    pub(crate) is_forward: bool,
    pub(crate) bounces: bool,
    /// `true` if events exactly at the start of the step belong to it.
    pub(crate) includes_from: bool,
}

/// Part of a step between ends of the clip. It runs backwards if `to_s` is less than `from_s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Local time at its start, seconds.
    pub from_s: f64,
    /// Local time at its end, inclusive, seconds.
    pub to_s: f64,
    /// `true` if events exactly at `from_s` belong to it.
    pub includes_from: bool,
}

impl Step {
    /// Empty step of a control that does not move.
    pub(crate) fn none(at_s: f64, length_s: f64) -> Self {
        Self { from_s: at_s, to_s: at_s, length_s, ends: 0, is_forward: true, bounces: false, includes_from: false }
    }

    /// Local time at the start of the step, seconds.
    #[must_use]
    pub fn from_s(&self) -> f32 {
        narrow(self.from_s)
    }

    /// Local time at the end of the step, seconds.
    #[must_use]
    pub fn to_s(&self) -> f32 {
        narrow(self.to_s)
    }

    /// Number of times that an end of the clip was passed.
    #[must_use]
    pub fn ends_passed(&self) -> u32 {
        self.ends
    }

    /// Splits the step at the ends of the clip; returns the pieces in order.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> + use<> {
        let step = *self;
        (0..=step.ends).map(move |index| step.piece(index))
    }

    /// Piece `index` of [`pieces`](Self::pieces).
    pub(crate) fn piece(&self, index: u32) -> Piece {
        let end = |is_high: bool| if is_high { self.length_s } else { 0.0 };
        // A bouncing step reverses at each end.
        let is_forward = self.is_forward != (self.bounces && index % 2 == 1);
        Piece {
            from_s: if index == 0 { self.from_s } else { end(!is_forward) },
            to_s: if index == self.ends { self.to_s } else { end(is_forward) },
            // The turning point of a bouncing step already belongs to the piece that arrives there.
            includes_from: if index == 0 { self.includes_from } else { !self.bounces },
        }
    }
}

/// Number of ends that so many cycles pass, limited to about `MOST_ENDS`. The limit preserves parity, which the
/// direction after bouncing depends on.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
pub(crate) fn count(cycles: f64) -> u32 {
    let cycles = cycles.abs();
    let odd = cycles - floor(cycles / 2.0) * 2.0;
    if cycles > MOST_ENDS { (MOST_ENDS - 2.0 + odd) as u32 } else { cycles as u32 }
}
