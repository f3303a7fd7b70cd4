//! Gaze shifts compared with measurements of people; `docs/natural-gaze.md` names the sources.

use aim::glam::{Affine3A, Quat, Vec3};
use aim::rigs::Thug;
use aim::{Aim, Pose, Settings, Status};

use super::super::row::Row;

/// Frame rate of the simulation, frames a second.
pub const HZ: f32 = 600.0;
/// Number of frames of a shift: one second.
const FRAMES: u16 = 600;
/// Animated position of the eye, metres; +Y is up, the character faces +Z.
const EYE: Vec3 = Vec3::new(0.0, 1.66, 0.09);
/// Sizes of the measured shifts, degrees.
pub const SHIFTS_DEG: [f32; 3] = [10.0, 30.0, 60.0];

/// Headings of gaze, head and chest in the world and of the eye in the head, degrees, positive to the left.
#[derive(Clone, Copy, Debug, Default)]
pub struct Headings {
    /// Heading of the eye in the world.
    pub gaze: f32,
    /// Heading of the head in the world.
    pub head: f32,
    /// Heading of the chest in the world.
    pub chest: f32,
    /// Heading of the eye relative to the head.
    pub eye: f32,
}

/// Returns the frames of a person who looks straight ahead until a target appears this far to the left. The target is
/// 100 m away, so that its heading stays the same while the head carries the eye along.
///
/// # Panics
/// Panics if the gaze is off its target after 0.4 s.
pub fn shift(degrees: f32) -> Vec<Headings> {
    let standing = Quat::from_xyzw(0.5, 0.5, 0.5, 0.5);
    let joints = [EYE, Vec3::new(0.0, 1.51, 0.0), Vec3::new(0.0, 1.37, 0.0)]
        .map(|place| Affine3A::from_rotation_translation(standing, place));
    let (pose, target) = (Pose::new(joints), EYE + Quat::from_rotation_y(degrees.to_radians()) * (100.0 * Vec3::Z));
    let mut person = Aim::<Thug>::new();
    let mut frames = vec![Headings::default()];
    for frame in 1..=FRAMES {
        let aimed = person.aim(&pose, target, 1.0 / HZ, &Settings::default());
        // Forward kinematics from the root outward, with the links taken from the joints' transforms.
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

/// Returns the time after which a condition holds until the end, milliseconds; infinite if it does not hold in the last
/// frame.
fn since_ms(frames: &[Headings], holds: impl Fn(&Headings) -> bool) -> f32 {
    let first = frames.iter().rposition(|frame| !holds(frame)).map_or(0, |frame| frame + 1);
    if first < frames.len() { first as f32 / HZ * 1e3 } else { f32::INFINITY }
}

/// Returns the largest speed of a heading, degrees a second, and the heading at the end of that frame.
fn peak(frames: &[Headings], heading: impl Fn(&Headings) -> f32) -> (f32, f32) {
    let speeds = frames.windows(2).map(|pair| ((heading(&pair[1]) - heading(&pair[0])) * HZ, heading(&pair[1])));
    speeds.fold((0.0, 0.0), |most, now| if now.0 > most.0 { now } else { most })
}

/// Time, speed and extent of the movements of gaze, head and chest, each within the range measured of people.
pub fn people() -> Vec<Row> {
    let mut rows = Vec::new();
    for degrees in SHIFTS_DEG {
        let frames = shift(degrees);
        let end = frames[frames.len() - 1];
        let ((gaze_speed, _), (head_speed, head_then)) = (peak(&frames, |f| f.gaze), peak(&frames, |f| f.head));
        let gaze_ms = since_ms(&frames, |frame| (frame.gaze - degrees).abs() < 0.5);
        let head_ms = since_ms(&frames, |frame| frame.head >= 0.95 * end.head);
        let moves_ms = since_ms(&frames, |frame| frame.head >= 1.0);
        for (what, unit, found) in [
            ("peak speed of the gaze", "°/s", gaze_speed),
            ("the gaze is there after", " ms", gaze_ms),
            ("the eye in the end", "°", end.eye),
            ("the head in the end", "°", end.head),
            ("of that the chest", "°", end.chest),
            ("peak speed of the head", "°/s", head_speed),
            ("the head is turned by 1° after", " ms", moves_ms),
            ("the head is there after", " ms", head_ms),
        ] {
            rows.push(Row::shown(format!("{degrees}°: {what}"), unit, found.into()));
        }
        let mut row = |what: &str, unit: &str, bounds: [f64; 2], found: f32| {
            rows.push(Row::between(format!("{degrees}°: {what}"), bounds, unit, found.into()));
        };
        // Allow one frame either way.
        let ms = |least: f32, most: f32| [(least - 1e3 / HZ).max(0.0), most + 1e3 / HZ].map(f64::from);
        match degrees {
            10.0 => {
                row("peak speed of the gaze", "°/s", [280.0, 380.0], gaze_speed);
                row("the gaze is there after", " ms", ms(45.0, 60.0), gaze_ms);
                let head = frames.iter().map(|frame| frame.head.abs()).fold(0.0, f32::max);
                row("the head at most", "°", [0.0, 1.0], head);
            }
            30.0 => {
                row("the gaze is there after", " ms", ms(0.0, 135.0), gaze_ms);
                row("the head's part", " %", [34.0, 45.0], 100.0 * end.head / degrees);
            }
            _ => {
                row("the gaze is there after", " ms", ms(0.0, 330.0), gaze_ms);
                row("peak speed of the head", "°/s", [100.0, 200.0], head_speed);
                row("part of the head's way where it is fastest", " %", [30.0, 50.0], 100.0 * head_then / end.head);
                row("the head is there after", " ms", ms(420.0, 650.0), head_ms);
                row("the eye in the end", "°", [18.0, 26.0], end.eye);
            }
        }
    }
    rows
}
