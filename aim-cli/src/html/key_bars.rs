//! Charts of a clip's keys by bone, before and after: their bytes as bars, and their times as ticks.

use std::collections::BTreeSet;

use aim_animation::Clip;
use aim_gltf::Document;
use maud::{Markup, html};

use super::clips::ClipTakes;
use crate::axis::{Axis, nice};
use crate::clip_report::{BoneBytes, ClipCost, Kinds, rounded};
use crate::deviation::bone_times;
use crate::words::{self, grouped, n, shown};

/// Number of bones with a row of their own; the others share one.
const ROWS: usize = 12;
const WIDTH: f64 = 520.0;
const TOP: f64 = 18.0;
const ROW: f64 = 24.0;
/// Height of a bar; each row has two.
const BAR: f64 = 8.0;
/// Width of the column of names.
const LEFT: f64 = 132.0;
/// Width of the column of numbers.
const RIGHT: f64 = 112.0;
const KINDS: [&str; 4] = ["translation", "rotation", "scale", "weights"];
/// Maximum number of characters shown of a name.
const LETTERS: usize = 21;

/// A row: one bone, or all bones without a row of their own.
struct Row {
    name: String,
    bones: Vec<usize>,
    sides: [[f64; 4]; 2],
}

fn rows(cost: &ClipCost) -> Vec<Row> {
    let named = if cost.bones.len() > ROWS + 1 { ROWS } else { cost.bones.len() };
    let (first, others) = cost.bones.split_at(named);
    let row = |bone: &BoneBytes| Row {
        name: bone.bone.clone(),
        bones: vec![bone.number],
        sides: [bone.before.all(), bone.after.all()],
    };
    let mut rows: Vec<Row> = first.iter().map(row).collect();
    if !others.is_empty() {
        let sum = |side: fn(&BoneBytes) -> Kinds| {
            let zero = [0.0; 4];
            others
                .iter()
                .map(|bone| side(bone).all())
                .fold(zero, |sum, of| [0, 1, 2, 3].map(|kind| sum[kind] + of[kind]))
        };
        rows.push(Row {
            name: format!("{} other bones", others.len()),
            bones: others.iter().map(|bone| bone.number).collect(),
            sides: [sum(|bone| bone.before), sum(|bone| bone.after)],
        });
    }
    rows
}

/// Returns both charts.
pub(super) fn charts(document: &Document, cost: &ClipCost, take: &ClipTakes<'_>) -> Markup {
    let rows = rows(cost);
    let height = TOP + ROW * words::count(rows.len()) + 30.0;
    html! {
        (bars(&rows, cost, height))
        (ticks(&rows, document, take, height))
    }
}

fn name(row: &Row, y: f64) -> Markup {
    let short: String = match row.name.chars().count() > LETTERS {
        true => row.name.chars().take(LETTERS - 1).chain(['…']).collect(),
        false => row.name.clone(),
    };
    html! {
        text.row-name x=(n(LEFT - 8.0)) y=(n(y + BAR + 4.0)) text-anchor="end" {
            title { (row.name) }
            (short)
        }
    }
}

fn bars(rows: &[Row], cost: &ClipCost, height: f64) -> Markup {
    let sum = |side: &[f64; 4]| side.iter().sum::<f64>();
    // The shared row has only numbers: its bar would make all others short.
    let own = rows.iter().filter(|row| row.bones.len() == 1).flat_map(|row| &row.sides).map(sum);
    let most = own.fold(1.0, f64::max);
    let axis = Axis { values: [0.0, most], places: [0.0, WIDTH - LEFT - RIGHT] };
    let label = format!("Bytes of the keys of {} by bone, before and after.", cost.clip);
    let used = |kind: &usize| rows.iter().any(|row| row.sides.iter().any(|side| side[*kind] > 0.0));
    html! {
        figure.chart.bars {
            figcaption {
                span.title { "Bytes by bone" }
                @for kind in (0..4).filter(used) {
                    span.key {
                        svg.line viewBox="0 0 22 10" aria-hidden="true" { rect class=(KINDS[kind]) y="1" width="22" height="8" {} }
                        (KINDS[kind])
                    }
                }
            }
            svg viewBox={ "0 0 " (n(WIDTH)) " " (n(height)) } role="img" aria-label=(label) {
                text.unit x="4" y="9" { "bytes; upper bar before, lower bar after" }
                @for (k, row) in rows.iter().enumerate() {
                    @let y = TOP + ROW * words::count(k);
                    (name(row, y))
                    @for (side, (bytes, class)) in row.sides.iter().zip(["before", "after"]).enumerate().filter(|_| row.bones.len() == 1) {
                        @let y = y + 2.0 + (BAR + 1.0) * words::count(side);
                        @for (kind, from, width) in stacked(bytes) {
                            rect class={ "bar " (KINDS[kind]) " " (class) } x=(n(LEFT + axis.at(from))) y=(n(y)) width=(n(axis.at(width))) height=(n(BAR)) {}
                        }
                    }
                    text.tick x=(n(WIDTH - RIGHT + 6.0)) y=(n(y + BAR + 4.0)) {
                        (grouped(rounded(sum(&row.sides[0])))) " → " (grouped(rounded(sum(&row.sides[1]))))
                    }
                }
            }
        }
    }
}

/// Returns the parts of a bar: kind, start and length of each.
fn stacked(bytes: &[f64; 4]) -> Vec<(usize, f64, f64)> {
    let mut end = 0.0;
    let part = |(kind, bytes): (usize, &f64)| {
        end += bytes;
        (kind, end - bytes, *bytes)
    };
    bytes.iter().enumerate().map(part).filter(|(_, _, width)| *width > 0.0).collect()
}

fn ticks(rows: &[Row], document: &Document, take: &ClipTakes<'_>, height: f64) -> Markup {
    let end = f64::from(take.before.length_s());
    let span = if end > 0.0 { end } else { 1.0 };
    let axis = Axis { values: [0.0, span], places: [LEFT, WIDTH - 16.0] };
    let bottom = height - 30.0;
    let label = format!("Times of the keys of {} by bone, before and after.", take.before.name());
    html! {
        figure.chart.bars {
            figcaption {
                span.title { "Keys over time" }
                @for (class, meaning) in [("before", "before"), ("after", "after")] {
                    span.key {
                        svg.line viewBox="0 0 22 10" aria-hidden="true" { path class={ "ticks " (class) } d="M3 1v8M8 1v8M13 1v8M18 1v8" {} }
                        (meaning)
                    }
                }
            }
            svg viewBox={ "0 0 " (n(WIDTH)) " " (n(height)) } role="img" aria-label=(label) {
                text.unit x="4" y="9" { "one tick for each time at which a bone has keys" }
                @for t in nice(0.0, span, 6.0) {
                    line.grid x1=(n(axis.at(t))) x2=(n(axis.at(t))) y1=(n(TOP)) y2=(n(bottom)) {}
                    text.tick x=(n(axis.at(t))) y=(n(bottom + 13.0)) text-anchor="middle" { (shown(t, 3)) }
                }
                text.unit x=(n(WIDTH - 16.0)) y=(n(bottom + 26.0)) text-anchor="end" { "time, s" }
                @for (k, row) in rows.iter().enumerate() {
                    @let y = TOP + ROW * words::count(k);
                    (name(row, y))
                    @for (side, (clip, class)) in [(take.before, "before"), (take.after, "after")].into_iter().enumerate() {
                        @let top = y + 2.0 + (BAR + 1.0) * words::count(side);
                        path class={ "ticks " (class) } d=(path(document, clip, &row.bones, |t| axis.at(t), top)) {}
                    }
                }
            }
        }
    }
}

/// Returns the path of a tick for each key time. Ticks at the same half pixel are merged.
fn path(document: &Document, clip: &Clip, bones: &[usize], x: impl Fn(f64) -> f64, top: f64) -> String {
    let mut places = BTreeSet::new();
    let mut add = |t: f32| places.insert(half_pixels(x(t.into())));
    for bone in bones {
        clip.bone(*bone).into_iter().flat_map(bone_times).for_each(|t| _ = add(t));
        let weights = document.morph_scalars(*bone);
        let weights = clip.scalars().iter().filter(|(scalar, _)| weights.contains(scalar));
        weights.flat_map(|(_, track)| track.times()).for_each(|t| _ = add(*t));
    }
    places.into_iter().map(|x| format!("M{} {}v{BAR}", n(f64::from(x) / 2.0), n(top))).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "places on a drawing")]
fn half_pixels(x: f64) -> i32 {
    (2.0 * x).round() as i32
}
