//! The aim over heading and pitch as a surface whose height is the aim. The view is chosen so that the surface rises
//! away from the viewer, towards the target.

use aim_runtime::glam::DVec3;
use maud::{Markup, html};

use super::bands::{Bands, off};
use super::contours::window;
use super::key;
use super::layout::{angle_ticks, finished, heading};
use super::picture::{PlotPicture, Size, c, path};
use super::subject::JointPlot;
use crate::axis::nice;
use crate::projection::Projection;
use crate::words::{shown, span};

/// Number of meshes along each side.
const MESHES: u16 = 46;
/// Angle between the horizontal view direction and the pitch axis, degrees.
const TURNED: f64 = 36.0;
/// Angle by which the view looks down, degrees.
const DOWN: f64 = 30.0;
/// Height of the box; the longer side of its base is 1.
const HEIGHT: f64 = 0.52;

/// The box that heading, pitch and aim are drawn in.
struct Room {
    /// Drawn intervals of heading, pitch and aim.
    ends: [[f64; 2]; 3],
    /// Lengths of the box's sides.
    sides: [f64; 3],
    /// Direction away from the viewer, along heading and pitch.
    away: [f64; 2],
    view: Projection,
}

impl Room {
    fn new(size: Size, ends: [[f64; 2]; 3], target_is: [f64; 2]) -> Self {
        let spans = [0, 1].map(|k| ends[k][1] - ends[k][0]);
        let longest = spans[0].max(spans[1]);
        let [wide, deep] = spans.map(|span| (span / longest).max(0.6));
        let sign = |angle: f64| if angle < 0.0 { -1.0 } else { 1.0 };
        let (sin, cos) = TURNED.to_radians().sin_cos();
        let away = [sin * sign(target_is[0]), cos * sign(target_is[1])];
        let (sin, cos) = DOWN.to_radians().sin_cos();
        let toward = DVec3::new(-cos * away[0], -cos * away[1], sin);
        let view = Projection::new(toward, DVec3::Z, DVec3::X, [0.0; 2]);
        let mut room = Self { ends, sides: [wide, deep, HEIGHT], away, view };
        let [width, height] = size.units();
        let (left, top, right, bottom) = (84.0, 84.0, width - 150.0, height - 126.0);
        let corners = (0..8).map(|k| room.at([0, 1, 2].map(|axis| room.ends[axis][(k >> axis) & 1])));
        let [(x0, x1), (y0, y1)] = [0, 1].map(|k| span(corners.clone().map(|at| at[k])));
        let scale = ((right - left) / (x1 - x0)).min((bottom - top) / (y1 - y0));
        room.view.middle = [0.5 * (left + right - scale * (x0 + x1)), 0.5 * (top + bottom - scale * (y0 + y1))];
        room.view.scale = scale;
        room
    }

    /// Returns the place of a heading, pitch and aim in the picture.
    fn at(&self, point: [f64; 3]) -> [f64; 2] {
        let in_box = [0, 1, 2].map(|k| {
            let [lo, hi] = self.ends[k];
            self.sides[k] * ((point[k] - lo) / (hi - lo) - 0.5)
        });
        let DVec3 { x, y, .. } = self.view.project(in_box.into());
        [x, y]
    }

    /// Returns the end of heading (axis 0) or pitch (axis 1) that is nearer to the viewer, or further away.
    fn end(&self, axis: usize, far: bool) -> f64 {
        self.ends[axis][usize::from((self.away[axis] > 0.0) == far)]
    }

    /// Returns `true` if no other part of the surface hides this point of it.
    fn sees(&self, subject: &JointPlot, [heading, pitch]: [f64; 2]) -> bool {
        const STEP: f64 = 0.01;
        let height = |aim: f64| HEIGHT * (aim - self.ends[2][0]) / (self.ends[2][1] - self.ends[2][0]);
        let start = height(subject.aim([heading, pitch]));
        let per_side = [0, 1].map(|k| (self.ends[k][1] - self.ends[k][0]) / self.sides[k]);
        // Walks from the point towards the viewer; the line of sight must stay above the surface.
        (2..=150_u8).map(|k| STEP * f64::from(k)).all(|far| {
            let at = [heading - far * self.away[0] * per_side[0], pitch - far * self.away[1] * per_side[1]];
            let is_outside = (0..2).any(|k| at[k] < self.ends[k][0] || at[k] > self.ends[k][1]);
            is_outside || height(subject.aim(at)) <= start + far * DOWN.to_radians().tan()
        })
    }
}

pub(super) fn picture(subject: &JointPlot, size: Size) -> PlotPicture {
    let [x, y] = window(subject, 1.3);
    let meshes = f64::from(MESHES);
    let places =
        |[lo, hi]: [f64; 2]| -> Vec<f64> { (0..=MESHES).map(|k| lo + (hi - lo) * f64::from(k) / meshes).collect() };
    let (headings, pitches) = (places(x), places(y));
    let aims: Vec<Vec<f64>> =
        pitches.iter().map(|pitch| headings.iter().map(|heading| subject.aim([*heading, *pitch])).collect()).collect();
    let (least, most) = span(aims.iter().flatten().copied());
    let ticks = nice(least, most.max(least + 1e-3), 5.0);
    let step = if ticks.len() > 1 { ticks[1] - ticks[0] } else { 0.1 };
    let floor = (least / step - 1e-9).floor() * step;
    let room = Room::new(
        size,
        [x, y, [floor, ((most / step - 1e-9).ceil() * step).max(floor + step)]],
        subject.courses[1].end(),
    );
    let bands = Bands::over(least, most);
    let order = |count: usize, axis: usize| -> Vec<usize> {
        if room.away[axis] > 0.0 { (0..count).rev().collect() } else { (0..count).collect() }
    };
    let on_surface = |angles: &[f64; 2]| room.at([angles[0], angles[1], subject.aim(*angles)]);
    let drawn = subject.courses.each_ref().map(|course| course.angles.iter().map(on_surface).collect());
    let marks = key::frames_a_mark(&drawn);
    let content = html! {
        (heading(subject))
        (walls(&room, &angle_ticks(x), &angle_ticks(y), &nice(room.ends[2][0], room.ends[2][1], 5.0)))
        g class="surface" stroke-width="0.5" stroke="#ffffff" stroke-opacity="0.35" stroke-linejoin="round" {
            @for j in order(pitches.len() - 1, 1) {
                @for i in order(headings.len() - 1, 0) {
                    @let corner = |i: usize, j: usize| room.at([headings[i], pitches[j], aims[j][i]]);
                    @let mean = 0.25 * (aims[j][i] + aims[j][i + 1] + aims[j + 1][i] + aims[j + 1][i + 1]);
                    @let fill = bands.colour(off(mean));
                    @let d = path(&[corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)], true);
                    path d=(d) fill=(fill) stroke=(fill) stroke-opacity="1" {}
                    path d=(d) fill="none" {}
                }
            }
        }
        @for line in subject.range_outlines(x) { (lying(subject, &room, &line, &key::range)) }
        @for course in &subject.courses {
            (lying(subject, &room, &course.angles, &|line| key::line(line, course.colour)))
        }
        (key::frames(subject, &drawn, marks, [3.2; 2], |angles| room.sees(subject, angles)))
        (key::scale(&bands, size, 110.0, size.units()[1] - 126.0))
        (key::legend(subject, size, marks, &key::range_patch()))
    };
    finished(subject, size, "a surface", &[("heading", x), ("pitch", y)], &content)
}

/// Draws a line on the surface; hidden parts are dashed.
fn lying(subject: &JointPlot, room: &Room, line: &[[f64; 2]], seen: &dyn Fn(&[[f64; 2]]) -> Markup) -> Markup {
    let mut fine: Vec<[f64; 2]> = line.first().copied().into_iter().collect();
    for pair in line.windows(2).filter(|pair| (pair[0][0] - pair[1][0]).abs() < 180.0) {
        fine.extend((1..=24_u8).map(|k| {
            let part = f64::from(k) / 24.0;
            [0, 1].map(|axis| pair[0][axis] + part * (pair[1][axis] - pair[0][axis]))
        }));
    }
    let drawn = |[heading, pitch]: [f64; 2]| room.at([heading, pitch, subject.aim([heading, pitch])]);
    let points: Vec<_> = fine.into_iter().map(|angles| (drawn(angles), room.sees(subject, angles))).collect();
    html! {
        @for piece in points.chunk_by(|a, b| a.1 == b.1) {
            @let line: Vec<[f64; 2]> = piece.iter().map(|(at, _)| *at).collect();
            @if piece[0].1 { (seen(&line)) } @else {
                path d=(path(&line, false)) fill="none" stroke="#000000" stroke-opacity="0.45" stroke-dasharray="2 4" {}
            }
        }
    }
}

/// Draws the floor, the back walls, and the axes along the nearer edges.
fn walls(room: &Room, headings: &[f64], pitches: &[f64], aims: &[f64]) -> Markup {
    let [near, far] = [false, true].map(|far| [room.end(0, far), room.end(1, far)]);
    let [floor, ceiling] = room.ends[2];
    let quad = |corners: [[f64; 3]; 4]| path(&corners.map(|corner| room.at(corner)), true);
    let line = |a: [f64; 3], b: [f64; 3]| path(&[room.at(a), room.at(b)], false);
    let beyond = |at: [f64; 3], axis: usize, by: f64| {
        // Extends the line from the far edge through the point at the near one by this much in the picture.
        let mut from = at;
        from[axis] = far[axis];
        let ([ax, ay], [bx, by_]) = (room.at(from), room.at(at));
        let length = (bx - ax).hypot(by_ - ay).max(1e-9);
        [bx + (bx - ax) / length * by, by_ + (by_ - ay) / length * by]
    };
    let anchor = |[x, _]: [f64; 2], [edge, _]: [f64; 2]| if x < edge - 1.0 { "end" } else { "start" };
    // The axis of aims is at the leftmost edge.
    let posts = [[near[0], far[1]], [far[0], near[1]]];
    let post = if room.at([posts[0][0], posts[0][1], floor])[0] < room.at([posts[1][0], posts[1][1], floor])[0] {
        posts[0]
    } else {
        posts[1]
    };
    let foot = room.at([post[0], post[1], floor]);
    let tick = |at: [f64; 3], axis: usize, text: String| {
        let (on, off) = (room.at(at), beyond(at, axis, 14.0));
        html! {
            path d=(path(&[on, beyond(at, axis, 6.0)], false)) stroke="#1b2127" {}
            // There is no room for two numbers at the foot of the axis of aims.
            @if key::distance(on, foot) > 22.0 { text x=(c(off[0])) y=(c(off[1] + 8.0)) text-anchor=(anchor(off, on)) { (text) } }
        }
    };
    let x_title = along(room, [near[0], near[1], floor], [far[0], near[1], floor], "heading, degrees to the left");
    let y_title = along(room, [near[0], near[1], floor], [near[0], far[1], floor], "pitch, degrees up");
    let on_post = |aim: f64| room.at([post[0], post[1], aim]);
    let z_title = on_post(0.5 * (floor + ceiling));
    html! {
        g fill="#f3f5f7" stroke="#c3cad1" stroke-width="0.8" {
            path d=(quad([[near[0], near[1], floor], [far[0], near[1], floor], [far[0], far[1], floor], [near[0], far[1], floor]])) {}
            path d=(quad([[near[0], far[1], floor], [far[0], far[1], floor], [far[0], far[1], ceiling], [near[0], far[1], ceiling]])) {}
            path d=(quad([[far[0], near[1], floor], [far[0], far[1], floor], [far[0], far[1], ceiling], [far[0], near[1], ceiling]])) {}
            @for h in headings {
                path fill="none" d=(line([*h, near[1], floor], [*h, far[1], floor])) {}
                path fill="none" d=(line([*h, far[1], floor], [*h, far[1], ceiling])) {}
            }
            @for p in pitches {
                path fill="none" d=(line([near[0], *p, floor], [far[0], *p, floor])) {}
                path fill="none" d=(line([far[0], *p, floor], [far[0], *p, ceiling])) {}
            }
            @for a in aims {
                path fill="none" d=(line([near[0], far[1], *a], [far[0], far[1], *a])) {}
                path fill="none" d=(line([far[0], near[1], *a], [far[0], far[1], *a])) {}
            }
        }
        g class="axes" fill="none" stroke="#1b2127" {
            path d=(line([near[0], near[1], floor], [far[0], near[1], floor])) {}
            path d=(line([near[0], near[1], floor], [near[0], far[1], floor])) {}
            path d=(line([post[0], post[1], floor], [post[0], post[1], ceiling])) {}
        }
        @for h in headings { (tick([*h, near[1], floor], 1, shown(*h, 3))) }
        @for p in pitches { (tick([near[0], *p, floor], 0, shown(*p, 3))) }
        @for a in aims {
            @let [x, y] = on_post(*a);
            line x1=(c(x - 6.0)) x2=(c(x)) y1=(c(y)) y2=(c(y)) stroke="#1b2127" {}
            text x=(c(x - 10.0)) y=(c(y + 4.5)) text-anchor="end" { (shown(*a, 3)) }
        }
        (x_title)
        (y_title)
        text x=(c(z_title[0] - 52.0)) y=(c(z_title[1])) text-anchor="middle"
            transform=(format!("rotate(-90 {} {})", c(z_title[0] - 52.0), c(z_title[1]))) { "aim" }
    }
}

/// Draws text below a lower edge of the box, along it.
fn along(room: &Room, from: [f64; 3], to: [f64; 3], text: &str) -> Markup {
    const BELOW: f64 = 52.0;
    let [a, b] = [from, to].map(|at| room.at(at));
    let [left, right] = if a[0] < b[0] { [a, b] } else { [b, a] };
    let (dx, dy) = (right[0] - left[0], right[1] - left[1]);
    let length = dx.hypot(dy).max(1e-9);
    let at = [0.5 * (a[0] + b[0]) - BELOW * dy / length, 0.5 * (a[1] + b[1]) + BELOW * dx / length];
    let turn = format!("rotate({} {} {})", c(dy.atan2(dx).to_degrees()), c(at[0]), c(at[1]));
    html! { text x=(c(at[0])) y=(c(at[1])) text-anchor="middle" transform=(turn) { (text) } }
}
