//! Checks declared axes: unit length, orthogonal, free of contradictions, at least two, of the right handedness.

use super::frame::{self, SQUARE_SIN, Vector};
use super::keys::AXES_KEYS;
use super::read;
use super::settings::{Level, Setting, Settings};
use crate::Frame;
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Owner};
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Kind, Notation};

/// Largest accepted deviation of a vector's length from 1.
const UNIT_TOLERANCE: f64 = 1e-3;

/// A declared direction.
struct Direction<'t> {
    /// Key as written, such as `down`.
    key: &'static str,
    /// Direction of the key as written, unit length.
    vector: Vector,
    place: &'t SourcePlace,
}

impl Direction<'_> {
    fn is_opposite(&self) -> bool {
        matches!(self.key, "down" | "back" | "right")
    }

    /// Returns the vector of `up`, `forward` or `left`, negated if the opposite was declared.
    fn positive(&self) -> Vector {
        if self.is_opposite() { frame::scale(-1.0, self.vector) } else { self.vector }
    }
}

/// Declared axes: two or three, unit and orthogonal, of either handedness.
pub(super) struct Axes<'t> {
    /// Up, forward and left, each declared by either of its two names.
    directions: [Option<Direction<'t>>; 3],
    /// Place of the declaration.
    pub(super) place: &'t SourcePlace,
}

impl Axes<'_> {
    fn vectors(&self) -> [Option<Vector>; 3] {
        self.directions.each_ref().map(|direction| direction.as_ref().map(Direction::positive))
    }

    /// Returns `true` if all three axes are declared, so that handedness does not determine one of them.
    pub(super) fn is_triple(&self) -> bool {
        self.directions.iter().all(Option::is_some)
    }

    /// Returns the frame of handedness `hand`; reports the axes if they have the opposite one.
    pub(super) fn frame(&self, report: &mut Report, owner: Owner, hand: f64) -> Option<Frame> {
        let [up, forward, left] = self.vectors();
        let frame = frame::complete(up, forward, left, hand)?;
        self.check_hand(report, owner, hand).then_some(frame)
    }

    fn check_hand(&self, report: &mut Report, owner: Owner, hand: f64) -> bool {
        let ([Some(up), Some(forward), Some(left)], Some(last)) = (self.vectors(), &self.directions[2]) else {
            return true;
        };
        if frame::dot(frame::cross(up, forward), left) * hand > 0.0 {
            return true;
        }
        let flip = format!("{} = {}", last.key, show(frame::scale(-1.0, last.vector), report.notation));
        let rig_is_right = (hand > 0.0) == (owner != Owner::MirroredJoint);
        report.error(last.place, messages::wrong_hand(owner, rig_is_right, &flip, report.notation));
        false
    }
}

/// Reads `axes`. The handedness of a skewed triple is checked here, because no frame will be built from it.
pub(super) fn read<'t>(report: &mut Report, owner: Owner, hand: f64, declared: Setting<'t>) -> Option<Axes<'t>> {
    let Kind::Table(entries) = &declared.value.kind else { return read::mismatch(report, declared) };
    let settings = Settings::read(entries, &AXES_KEYS, Level::Table, report);
    let mut complete = true;
    let mut axes = Axes { directions: [None, None, None], place: declared.place() };
    for (pair, slot) in AXES_KEYS.chunks_exact(2).zip(&mut axes.directions) {
        let [(first, _), (second, _)] = [pair[0], pair[1]];
        if let (Some(one), Some(other)) = (settings.get(first), settings.get(second)) {
            let note = messages::declared_here(first);
            report.error_with_note(other.place(), messages::contradictory(first, second), note, one.place());
            complete = false;
        }
        for key in [first, second].into_iter().filter(|key| settings.has(key)) {
            match settings.get(key).and_then(|setting| Some((direction(report, setting)?, setting.place()))) {
                Some((vector, place)) => *slot = Some(Direction { key, vector, place }),
                None => complete = false,
            }
        }
    }
    let found: Vec<&Direction<'_>> = axes.directions.iter().flatten().collect();
    match found.as_slice() {
        [] if complete => report.error(declared.place(), messages::empty_axes(report.notation)),
        [only] if complete => report.error(only.place, messages::one_axis(only.key)),
        _ => complete &= are_square(report, &axes, owner, hand),
    }
    (complete && found.len() >= 2).then_some(axes)
}

/// Returns `true` if the axes are orthogonal; reports parallel and skewed pairs.
fn are_square(report: &mut Report, axes: &Axes<'_>, owner: Owner, hand: f64) -> bool {
    let mut parallel = false;
    let mut worst: Option<(f64, &Direction<'_>, &Direction<'_>)> = None;
    for (first, second) in [(0, 1), (0, 2), (1, 2)] {
        let (Some(first), Some(second)) = (&axes.directions[first], &axes.directions[second]) else { continue };
        let cosine = frame::dot(first.vector, second.vector);
        if frame::length(frame::cross(first.vector, second.vector)) < SQUARE_SIN {
            let note = messages::declared_here(first.key);
            report.error_with_note(second.place, messages::parallel(first.key, second.key), note, first.place);
            parallel = true;
        } else if cosine.abs() > SQUARE_SIN + 1e-9 && worst.is_none_or(|(most, ..)| cosine.abs() > most.abs()) {
            worst = Some((cosine, first, second));
        }
    }
    let (false, Some((cosine, first, second))) = (parallel, worst) else { return !parallel };
    let [up, forward, left] = axes.vectors();
    if let Some(nearest) = frame::nearest(up, forward, left, hand) {
        let positive = [nearest.up, nearest.forward, nearest.left];
        let [up, forward, left] = positive.map(|axis| show(axis, report.notation));
        let shown = format!("up = {up}, forward = {forward}, left = {left}");
        let degrees = cosine.clamp(-1.0, 1.0).acos().to_degrees();
        let text = messages::not_square(first.key, second.key, degrees, &shown);
        report.error(second.place, text);
    }
    axes.check_hand(report, owner, hand);
    false
}

/// Reads a direction: a signed axis or a unit vector.
pub(super) fn direction(report: &mut Report, setting: Setting<'_>) -> Option<Vector> {
    let notation = report.notation;
    let text = match &setting.value.kind {
        Kind::Axis { negative, letter } => {
            if let Some(axis) = frame::axis(letter, *negative) {
                return Some(axis);
            }
            messages::axis_unknown(if *negative { '-' } else { '+' }, letter, notation)
        }
        Kind::Word(word) if matches!(word.as_str(), "X" | "Y" | "Z" | "x" | "y" | "z") => {
            messages::axis_without_sign(word, notation)
        }
        _ => {
            let vector = read::vector(report, setting)?;
            let length = frame::length(vector);
            if (length - 1.0).abs() <= UNIT_TOLERANCE {
                return Some(frame::unit(vector));
            }
            // Divide by the largest component first: the squared length may overflow or underflow.
            let largest = vector.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            if largest > 0.0 {
                let unit = frame::unit(vector.map(|x| x / largest));
                messages::not_unit(setting.key, length, &show(unit, notation))
            } else {
                messages::zero_vector(setting.key)
            }
        }
    };
    report.refuse(setting.place(), text)
}

/// Formats a direction as a declaration would, with at most four decimals. The result passes the checks.
fn show(vector: Vector, notation: Notation) -> String {
    if let Some(name) = frame::cardinal(vector) {
        return notation.pick(name.clone(), format!("\"{name}\""));
    }
    let parts = vector.map(|x| format!("{:?}", (x * 1e4).round() / 1e4 + 0.0)).join(", ");
    notation.pick(format!("({parts})"), format!("[{parts}]"))
}
