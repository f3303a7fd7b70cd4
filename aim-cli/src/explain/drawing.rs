//! The drawing of a bone's axes.

use aim_codegen::Frame;
use aim_runtime::glam::DVec3;

use super::document::{Arrow, Drawing, Ink, Label, Text};
use crate::projection::Projection;

const SIZE: [f64; 2] = [400.0, 300.0];
const CENTRE: [f64; 2] = [196.0, 178.0];
/// Units of the drawing per unit of space.
const SCALE: f64 = 104.0;

/// Angle of the viewer from the character's front towards its left, degrees.
const FROM_LEFT: f64 = 33.0;
/// Angle of the viewer above the horizontal, degrees.
const FROM_ABOVE: f64 = 24.0;

/// Returns the place in the drawing of a point given by its coordinates forward, left and up.
fn seen(point: [f64; 3]) -> [f64; 2] {
    let view = Projection::from_aside([DVec3::Z, DVec3::X, DVec3::Y], FROM_LEFT, FROM_ABOVE, CENTRE);
    let DVec3 { x, y, .. } = Projection { scale: SCALE, ..view }.project(point.into());
    [x, y]
}

fn along(direction: [f64; 3], length: f64) -> [f64; 2] {
    seen(direction.map(|c| c * length))
}

/// Draws a bone's own axes among the directions of the character, and arcs for the turns that the joint has: heading,
/// pitch.
pub(super) fn of_axes(frame: &Frame, turns: [bool; 2], told: String, caption: Text) -> Drawing {
    const DIRECTIONS: [(&str, [f64; 3]); 3] =
        [("forward", [1.0, 0.0, 0.0]), ("left", [0.0, 1.0, 0.0]), ("up", [0.0, 0.0, 1.0])];
    let origin = seen([0.0; 3]);
    let mut drawing = Drawing { size: SIZE, told, caption, arrows: Vec::new(), labels: Vec::new() };
    for (name, direction) in DIRECTIONS {
        let ink = Ink::Direction;
        drawing.arrows.push(Arrow { points: vec![origin, along(direction, 1.42)], ink });
        let [x, y] = along(direction, 1.6);
        drawing.labels.push(Label { at: [x, y], text: name.to_owned(), ink });
    }
    // Both turns begin at forward (axis 0): heading leads to left (1), pitch to up (2).
    for (has, ink, [name, letter], towards, aside) in [
        (turns[0], Ink::Heading, ["heading", "h"], 1, [6.0, 20.0]),
        (turns[1], Ink::Pitch, ["pitch", "p"], 2, [-50.0, -10.0]),
    ] {
        if !has {
            continue;
        }
        let at = |degrees: f64, radius: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut point = [radius * cos, 0.0, 0.0];
            point[towards] = radius * sin;
            seen(point)
        };
        let points = (0..=16_u8).map(|k| at(4.0 + f64::from(k) * 4.5, 1.22)).collect();
        drawing.arrows.push(Arrow { points, ink });
        let [x, y] = at(40.0, 1.22);
        drawing.labels.push(Label { at: [x + aside[0], y + aside[1]], text: format!("{name} {letter}"), ink });
    }
    for axis in 0..3 {
        let direction = [frame.forward[axis], frame.left[axis], frame.up[axis]];
        let ink = Ink::Axis(axis);
        let tip = along(direction, 1.0);
        drawing.arrows.push(Arrow { points: vec![origin, tip], ink });
        // The label is beside the arrow, to the right of its direction.
        let (dx, dy) = (tip[0] - origin[0], tip[1] - origin[1]);
        let length = dx.hypot(dy).max(1.0);
        let at = [origin[0] + 0.72 * dx - 19.0 * dy / length, origin[1] + 0.72 * dy + 15.0 * dx / length];
        drawing.labels.push(Label { at, text: format!("+{}", ["X", "Y", "Z"][axis]), ink });
    }
    drawing
}
