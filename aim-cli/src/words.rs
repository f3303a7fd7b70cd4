//! Formatting of numbers and statuses for readers. The same number always gives the same text.

use aim_runtime::glam::DVec3;
use maud::{Markup, html};

/// Words for a status: its name in JSON, its name for readers, the words that follow a number of frames, and its
/// meaning.
pub(crate) type StatusWords = (&'static str, &'static str, &'static str, &'static str);

/// Words for all statuses, in the order of listings.
const STATUSES: [StatusWords; 5] = [
    ("reached", "on target", "on target", "within the tolerance of the target"),
    ("rate_limited", "on the way", "on the way", "within reach, but the rates do not allow it yet"),
    ("at_limit", "out of reach", "out of reach", "outside the ranges of motion"),
    ("behind", "behind", "with the target behind the character", "the target is behind the character"),
    ("degenerate", "no direction", "without a direction", "the target or the pose gives no direction to aim in"),
];

/// Words for `reached` if the weight is below 1.
const OF_THE_GOAL: StatusWords = (
    "reached",
    "on the goal",
    "on the weighted goal",
    "within the tolerance of the weighted goal, which lies between the animated gaze and the target",
);

/// Direction that statuses and errors refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Wanted {
    /// Direction to the target.
    Target,
    /// Direction between the animated gaze and the target, as far as a weight below 1 asks for.
    Goal,
}

impl Wanted {
    /// Returns what an aim of this weight wants.
    pub(crate) fn at_weight(weight: f32) -> Self {
        if weight < 1.0 { Self::Goal } else { Self::Target }
    }

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands out references")]
    pub(crate) fn is_target(&self) -> bool {
        *self == Self::Target
    }

    /// Returns the name of the direction, as a noun.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Self::Target => "target",
            Self::Goal => "weighted goal",
        }
    }

    /// Returns the words for all statuses, in the order of listings.
    pub(crate) fn statuses(self) -> impl Iterator<Item = StatusWords> {
        STATUSES
            .into_iter()
            .map(move |words| if self == Self::Goal && words.0 == OF_THE_GOAL.0 { OF_THE_GOAL } else { words })
    }

    /// Returns a status's name for readers; an unknown status is returned unchanged.
    pub(crate) fn status(self, word: &str) -> &str {
        self.statuses().find(|(own, ..)| *own == word).map_or(word, |(_, ours, ..)| ours)
    }
}

/// Returns a small patch in the colour of a status.
pub(crate) fn chip(status: &str) -> Markup {
    html! { svg.patch viewBox="0 0 10 10" aria-hidden="true" { rect class={ "status " (status) } width="10" height="10" rx="2" {} } }
}

/// Formats a coordinate of a drawing with at most one decimal.
pub(crate) fn n(value: f64) -> String {
    trimmed(value, 1)
}

/// Returns a line of a drawing with that class; empty if one of its ends is not finite.
pub(crate) fn segment(class: &str, from: DVec3, to: DVec3) -> Markup {
    html! {
        @if from.is_finite() && to.is_finite() {
            line class=(class) x1=(n(from.x)) y1=(n(from.y)) x2=(n(to.x)) y2=(n(to.y)) {}
        }
    }
}

/// Returns the SVG attribute `points` for these points.
pub(crate) fn points(points: impl IntoIterator<Item = DVec3>) -> String {
    points.into_iter().map(|p| format!("{},{}", n(p.x), n(p.y))).collect::<Vec<_>>().join(" ")
}

/// Formats a number with at most that many decimals, without trailing zeros.
pub(crate) fn trimmed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Returns the error of morph weights as a clause that continues a sentence; empty if there are none.
pub(crate) fn weights_in_words(error: Option<f64>) -> String {
    error.map_or_else(String::new, |error| format!(", morph weight error at most {}", fixed(error, 4)))
}

/// Formats a number with exactly that many decimals; zero has no sign.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text[1..].to_owned() } else { text }
}

/// Formats a number like [`trimmed`], with a typographic minus sign.
pub(crate) fn shown(value: f64, decimals: usize) -> String {
    trimmed(value, decimals).replace('-', "−")
}

/// Formats an angle in degrees, with more decimals if it is small.
pub(crate) fn degrees(value: f64) -> String {
    let decimals = match value.abs() {
        x if x < 1.0 => 3,
        x if x < 10.0 => 2,
        _ => 1,
    };
    format!("{}°", fixed(value, decimals))
}

/// Formats an error that should be 0: below 0.001 with two digits, such as `4.9 × 10⁻⁵°/s`.
pub(crate) fn tiny(value: f64, unit: &str) -> String {
    if value >= 1e-3 || value <= 0.0 {
        return format!("{}{unit}", trimmed(value, 3));
    }
    let gap = if unit.is_empty() { "" } else { "\u{202f}" };
    format!("{}{gap}{unit}", scientific(value))
}

/// Formats a number with two digits, such as `1.3 × 10⁻¹²`.
pub(crate) fn scientific(value: f64) -> String {
    let text = format!("{value:.1e}");
    match text.split_once('e') {
        None | Some((_, "0")) => text.trim_end_matches("e0").to_owned(),
        Some((digits, power)) => format!("{} × 10{}", digits.trim_end_matches(".0"), raised(power)),
    }
}

fn raised(power: &str) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    power.chars().map(raised).collect()
}

/// Formats a power of ten on an axis; below 0.001 as a power, such as `10⁻⁵`.
pub(crate) fn power_of_ten(value: f64) -> String {
    if value >= 0.99e-3 { shown(value, 3) } else { format!("10{}", raised(&fixed(value.log10(), 0))) }
}

/// Formats a unit vector: as `+X` if it is a signed axis, otherwise by its components.
pub(crate) fn axis(v: [f64; 3]) -> String {
    let along = ["X", "Y", "Z"].into_iter().zip(v).find(|(_, component)| component.abs() > 1.0 - 1e-9);
    match along {
        Some((name, component)) => format!("{}{name}", if component < 0.0 { '-' } else { '+' }),
        None => format!("({})", v.map(|x| fixed(x, 3)).join(", ")),
    }
}

/// Returns the smallest and the largest of some numbers; if there are none, `(f64::MAX, f64::MIN)`.
pub(crate) fn span(numbers: impl IntoIterator<Item = f64>) -> (f64, f64) {
    numbers.into_iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)))
}

/// Converts a count to a float; exact below 2^52.
#[expect(clippy::cast_precision_loss, reason = "frames, letters and pixels are far fewer")]
pub(crate) fn count(value: usize) -> f64 {
    value as f64
}

/// Formats a whole number with commas between thousands: `1,234,567`.
pub(crate) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    groups.collect::<Vec<_>>().join(",")
}

/// Returns a count with its noun: `1 frame`, `2 frames`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// Joins names: `a`, `a and b`, `a, b and c`.
pub(crate) fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [front @ .., last] => format!("{} and {last}", front.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!([n(-0.04), n(12.0), n(-3.25), n(0.06)], ["0", "12", "-3.2", "0.1"]);
        assert_eq!([degrees(0.06392), degrees(3.2149), degrees(179.96)], ["0.064°", "3.21°", "180.0°"]);
        assert_eq!([shown(-2.50, 2), shown(-0.001, 2)], ["−2.5", "0"]);
        assert_eq!(
            [grouped(0), grouped(999), grouped(1_000), grouped(12_345_678)],
            ["0", "999", "1,000", "12,345,678"]
        );
        assert_eq!([power_of_ten(100.0), power_of_ten(1e-3), power_of_ten(1e-8)], ["100", "0.001", "10⁻⁸"]);
        assert_eq!([tiny(0.0, "°"), tiny(4.9e-5, "°/s"), tiny(2.5, "°")], ["0°", "4.9 × 10⁻⁵\u{202f}°/s", "2.5°"]);
    }

    #[test]
    fn the_help_of_bake_explains_the_statuses_of_the_report() {
        let help = include_str!("help/bake.txt");
        for (word, _, words, _) in STATUSES {
            assert!(help.contains(&format!("\n  {word:<12}  {words}\n")), "{word}");
        }
    }

    #[test]
    fn lists_read_as_sentences() {
        assert_eq!([listed(&["a"]), listed(&["a", "b"]), listed(&["a", "b", "c"])], ["a", "a and b", "a, b and c"]);
        assert_eq!([counted(1, "frame"), counted(0, "frame")], ["1 frame", "0 frames"]);
    }
}
