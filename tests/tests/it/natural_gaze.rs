//! The natural gaze beside what is measured of people, and the figure of `docs/natural-gaze.md`.
//!
//! `AIM_BLESS=1 cargo test -p aim-tests --test it natural_gaze` rewrites the figure. The test prints the numbers that
//! the page quotes; `-- --nocapture` shows them.

use std::fmt::Write;
use std::ops::RangeInclusive;

use aim::Aim;
use aim::glam::{Affine3A, Quat, Vec3};
use aim::rigs::Thug;
use aim::{Pose, Settings, Status};

const HZ: f32 = 600.0;
/// A second.
const FRAMES: u16 = 600;
/// The eye's animated place, +Y up, in metres; the character faces +Z.
const EYE: Vec3 = Vec3::new(0.0, 1.66, 0.09);
const SHIFTS_DEG: [f32; 3] = [10.0, 30.0, 60.0];

/// Headings in the world, positive to the left, degrees; that of the eye is in the head.
#[derive(Clone, Copy, Default)]
struct Headings {
    gaze: f32,
    head: f32,
    chest: f32,
    eye: f32,
}

/// A person who looks straight ahead until a target appears this far to the left, frame by frame from then on. The target
/// is 100 m away, so that its heading stays the same while the head carries the eye along.
fn shift(degrees: f32) -> Vec<Headings> {
    let standing = Quat::from_xyzw(0.5, 0.5, 0.5, 0.5);
    let joints = [EYE, Vec3::new(0.0, 1.51, 0.0), Vec3::new(0.0, 1.37, 0.0)]
        .map(|place| Affine3A::from_rotation_translation(standing, place));
    let (pose, target) = (Pose::new(joints), EYE + Quat::from_rotation_y(degrees.to_radians()) * (100.0 * Vec3::Z));
    let mut person = Aim::<Thug>::new();
    let mut frames = vec![Headings::default()];
    for frame in 1..=FRAMES {
        let aimed = person.aim(&pose, target, 1.0 / HZ, &Settings::default());
        // Forward kinematics from the root outward, by the links between the joints' transforms.
        let mut carried = Affine3A::IDENTITY;
        let mut parent = Affine3A::IDENTITY;
        let mut headings = [0.0; 3];
        for (index, joint) in joints.iter().enumerate().rev() {
            carried = carried * parent.inverse() * *joint * Affine3A::from_quat(aimed.corrections[index]);
            parent = *joint;
            let forward = carried.transform_vector3(Vec3::Y);
            headings[index] = forward.x.atan2(forward.z).to_degrees();
        }
        let [gaze, head, chest] = headings;
        frames.push(Headings { gaze, head, chest, eye: gaze - head });
        let is_there = aimed.outcome.status == Status::Reached;
        assert!(is_there || f32::from(frame) < 0.4 * HZ, "{degrees}°: the gaze is off its target in frame {frame}");
    }
    frames
}

/// The time from which on a condition holds, milliseconds; infinite where it does not hold in the end.
fn since_ms(frames: &[Headings], holds: impl Fn(&Headings) -> bool) -> f32 {
    let first = frames.iter().rposition(|frame| !holds(frame)).map_or(0, |frame| frame + 1);
    if first < frames.len() { first as f32 / HZ * 1e3 } else { f32::INFINITY }
}

/// The largest speed of a heading in a frame, degrees a second, and the heading at the end of that frame.
fn peak(frames: &[Headings], heading: impl Fn(&Headings) -> f32) -> (f32, f32) {
    let speeds = frames.windows(2).map(|pair| ((heading(&pair[1]) - heading(&pair[0])) * HZ, heading(&pair[1])));
    speeds.fold((0.0, 0.0), |most, now| if now.0 > most.0 { now } else { most })
}

#[test]
fn a_gaze_shift_is_of_the_size_that_is_measured_of_people() {
    let assert = |what: &str, found: f32, bounds: RangeInclusive<f32>| {
        println!("{what}: {found:.1}");
        assert!(bounds.contains(&found), "{what}: {found} is not in {bounds:?}");
    };
    // A frame more or less.
    let ms = |least: f32, most: f32| least - 1e3 / HZ..=most + 1e3 / HZ;
    for degrees in SHIFTS_DEG {
        let frames = shift(degrees);
        let end = frames[frames.len() - 1];
        let ((gaze_speed, _), (head_speed, head_then)) = (peak(&frames, |f| f.gaze), peak(&frames, |f| f.head));
        let gaze_ms = since_ms(&frames, |frame| (frame.gaze - degrees).abs() < 0.5);
        let head_ms = since_ms(&frames, |frame| frame.head >= 0.95 * end.head);
        let moves_ms = since_ms(&frames, |frame| frame.head >= 1.0);
        println!(
            "{degrees}°: gaze at most {gaze_speed:.0}°/s, there after {gaze_ms:.0} ms, eye in the end {:.1}°",
            end.eye
        );
        println!("  head {:.1}°, of that chest {:.1}°, at most {head_speed:.0}°/s", end.head, end.chest);
        println!("  head turned by 1° after {moves_ms:.0} ms, by 95 % after {head_ms:.0} ms");
        match degrees {
            10.0 => {
                assert("10°: peak speed of the gaze, °/s", gaze_speed, 280.0..=380.0);
                assert("10°: the gaze is there, ms", gaze_ms, ms(45.0, 60.0));
                let head = frames.iter().map(|frame| frame.head.abs()).fold(0.0, f32::max);
                assert("10°: the head at most, °", head, 0.0..=1.0);
            }
            30.0 => {
                assert("30°: the gaze is there, ms", gaze_ms, ms(0.0, 135.0));
                assert("30°: the head's part, %", 100.0 * end.head / degrees, 34.0..=45.0);
            }
            _ => {
                assert("60°: the gaze is there, ms", gaze_ms, ms(0.0, 330.0));
                assert("60°: peak speed of the head, °/s", head_speed, 100.0..=200.0);
                assert("60°: where the head is fastest, %", 100.0 * head_then / end.head, 30.0..=50.0);
                assert("60°: the head is there, ms", head_ms, ms(420.0, 650.0));
                assert("60°: the eye in the end, °", end.eye, 18.0..=26.0);
            }
        }
    }
}

/// A curve of the figure: its name, its colour, which reads on white and on black, and its dashes.
type Curve = (&'static str, &'static str, &'static str, fn(&Headings) -> f32);

const CURVES: [Curve; 4] = [
    ("gaze", "#2f86c8", "none", |frame| frame.gaze),
    ("head in space", "#d55e00", "none", |frame| frame.head),
    ("chest", "#009e73", "2 3", |frame| frame.chest),
    ("eye in head", "#c264a0", "7 3", |frame| frame.eye),
];
const GREY: &str = "#808080";

/// The curves of all shifts, beside each other: headings over time.
fn figure() -> String {
    const SIZE: [f32; 2] = [220.0, 200.0];
    const TOP: f32 = 58.0;
    let mut svg = String::new();
    let text = |svg: &mut String, x: f32, y: f32, anchor: &str, fill: &str, words: &str| {
        writeln!(svg, r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}" fill="{fill}">{words}</text>"#)
            .expect("a string is written to");
    };
    let line = |svg: &mut String, stroke: &str, width: f32, dashes: &str, points: &[[f32; 2]]| {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let points = points.join(" ");
        writeln!(
            svg,
            r#"<polyline stroke="{stroke}" stroke-width="{width:.1}" stroke-dasharray="{dashes}" points="{points}"/>"#
        )
        .expect("a string is written to");
    };
    svg.push_str("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 820 300\" font-family=\"sans-serif\" ");
    svg.push_str("font-size=\"12\" fill=\"none\">\n");
    for (number, (name, colour, dashes, _)) in CURVES.into_iter().enumerate() {
        let x = 48.0 + 130.0 * number as f32;
        line(&mut svg, colour, 2.0, dashes, &[[x, 16.0], [x + 24.0, 16.0]]);
        text(&mut svg, x + 30.0, 20.0, "start", GREY, name);
    }
    for (panel, degrees) in SHIFTS_DEG.into_iter().enumerate() {
        let left = 48.0 + 264.0 * panel as f32;
        let at = |t: f32, heading: f32| [left + SIZE[0] * t, TOP + SIZE[1] * (1.0 - heading / (1.05 * degrees))];
        text(&mut svg, left, TOP - 12.0, "start", GREY, &format!("a target {degrees}° to the side"));
        let steps = if degrees < 20.0 { 2_u8 } else { 3 };
        for tick in 0..=steps {
            let heading = degrees * f32::from(tick) / f32::from(steps);
            let [x, y] = at(0.0, heading);
            line(&mut svg, GREY, if tick == 0 { 1.0 } else { 0.3 }, "none", &[[x, y], at(1.0, heading)]);
            text(&mut svg, x - 6.0, y + 4.0, "end", GREY, &format!("{heading}°"));
        }
        for (t, words) in [(0.0, "0"), (0.5, "0.5"), (1.0, "1 s")] {
            let [x, y] = at(t, 0.0);
            line(&mut svg, GREY, 1.0, "none", &[[x, y], [x, y + 4.0]]);
            text(&mut svg, x, y + 18.0, "middle", GREY, words);
        }
        let frames = shift(degrees);
        for (_, colour, dashes, heading) in CURVES {
            let place = |(frame, headings)| at(frame as f32 / HZ, heading(headings));
            let points: Vec<[f32; 2]> = frames.iter().enumerate().step_by(4).map(place).collect();
            line(&mut svg, colour, 2.0, dashes, &points);
        }
    }
    svg.push_str("</svg>\n");
    svg
}

#[test]
fn the_figure_shows_what_the_solver_does() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/natural-gaze.svg");
    let svg = figure();
    if std::env::var_os("AIM_BLESS").is_some_and(|update| update == "1") {
        std::fs::write(path, &svg).expect("the figure is written");
    }
    let stored = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        stored == svg,
        "docs/natural-gaze.svg is not what the solver does.\n\
         If it is meant to be so: AIM_BLESS=1 cargo test -p aim-tests --test it natural_gaze"
    );
}
