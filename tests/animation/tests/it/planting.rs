//! Feet planted on uneven ground while the mannequin walks and runs: slip and added acceleration of its joints in the
//! world, by forward kinematics in f64.

use aim::animation::{
    Clip, ClipControl, Figure, Ground, Instance, Model, Motion, Plant, Root, RootPath, Skeleton, Stance, Transform,
};
use aim::glam::{DAffine3, DVec3, Vec3};
use aim_character::{Mannequin, PAPER_AXES};
use aim_gltf::Document;

use crate::glue::model;

const FPS: f32 = 60.0;
const LEGS: [[&str; 4]; 2] = [
    ["left_upper_leg", "left_lower_leg", "left_foot", "left_toes"],
    ["right_upper_leg", "right_lower_leg", "right_foot", "right_toes"],
];

/// Phases of the walk's cycle at which the ball of the left foot lands and lifts.
const WALK: [f32; 2] = [0.11, 0.62];
const RUN: [f32; 2] = [0.06, 0.34];

/// Returns the clip with events where feet land and lift.
fn with_steps(clip: &Clip, [down, up]: [f32; 2]) -> Clip {
    let at = |part: f32| (part % 1.0) * clip.length_s();
    let events = [("left down", down), ("left up", up), ("right down", down + 0.5), ("right up", up + 0.5)];
    events.into_iter().fold(clip.clone(), |clip, (name, part)| clip.with_event(at(part), name).unwrap())
}

fn hips(skeleton: &Skeleton) -> Root {
    Root::Shadow { bone: skeleton.find("hips").unwrap(), up: Vec3::Y }
}

/// A frame of a walk, in world space: knees and ankles of both legs, the contacts of both feet, which feet are planted,
/// and which of those are at rest.
#[derive(Clone, Copy, Debug)]
struct Frame {
    joints: [DVec3; 4],
    contacts: [DVec3; 2],
    is_down: [bool; 2],
    at_rest: [bool; 2],
}

/// The mannequin walking or running over a ground for some seconds. `pace` is the ratio of its actual root motion to
/// the clip's.
struct Walk<'a> {
    gait: (&'a str, [f32; 2]),
    pace: f32,
    ground: &'a dyn Fn(Vec3) -> Ground,
    /// Height of the character's place; it follows the ground except on stairs.
    way: &'a dyn Fn(Vec3) -> f32,
}

impl Walk<'_> {
    fn frames(&self, plants: bool) -> Vec<Frame> {
        let document = Document::from_bytes(&Mannequin::new().with_moves().glb(|_| PAPER_AXES).unwrap()).unwrap();
        let skeleton: &Skeleton = document.skeleton();
        let clip = with_steps(document.clip(self.gait.0).unwrap(), self.gait.1);
        let motion = Motion::linear(&RootPath::new(&clip, skeleton, hips(skeleton), 60.0).unwrap());
        let bone = |name: &str| skeleton.find(name).unwrap();
        let mut figure = Figure::new(skeleton.clone());
        let legs = LEGS.map(|leg| leg.map(bone));
        let rest = figure.model().to_vec();
        let balls = legs.map(|[.., toes]| Vec3::from(rest[toes].translation).with_y(0.0));
        let feet: Vec<Plant> = [("left down", "left up"), ("right down", "right up")]
            .into_iter()
            .zip(legs.iter().zip(balls))
            .map(|((down, up), (leg, ball))| Plant::new(skeleton, &leg[..3], ball).unwrap().with_events(down, up))
            .collect();
        let mut stance = Stance::new(skeleton, bone("hips"), feet).unwrap();
        let model_of = Model::new(skeleton.clone(), [clip]).with_motion(0, motion);
        let mut hero = Instance::new(&model_of);
        hero.play(ClipControl::new(0));
        let mut frames = Vec::new();
        for _ in 0..300 {
            let before = hero.place;
            hero.advance(&model_of, 1.0 / FPS);
            hero.place.translation = before.translation + (hero.place.translation - before.translation) * self.pace;
            hero.place.translation.y = (self.way)(hero.place.translation);
            hero.events(&model_of).for_each(|(_, event)| stance.on_event(&event.name));
            if plants {
                let mut feet = stance.on(self.ground);
                figure.run(1.0 / FPS, &mut [&mut hero.layer(&model_of), &mut feet]).unwrap();
            } else {
                figure.run(1.0 / FPS, &mut [&mut hero.layer(&model_of)]).unwrap();
            }
            let place = exact(&figure.place);
            let world: Vec<DAffine3> = model(skeleton, figure.local()).into_iter().map(|bone| place * bone).collect();
            let contact = |foot: usize| {
                let ankle = legs[foot][2];
                let in_foot =
                    model(skeleton, skeleton.rest())[ankle].inverse().transform_point3(balls[foot].as_dvec3());
                world[ankle].transform_point3(in_foot)
            };
            let at_rest = [0, 1].map(|foot: usize| plants && stance.feet()[foot].is_planted());
            let is_down = [0, 1].map(|foot: usize| plants && stance.feet()[foot].anchor().is_some());
            let joints = [legs[0][1], legs[0][2], legs[1][1], legs[1][2]].map(|bone| world[bone].translation);
            frames.push(Frame { joints, contacts: [0, 1].map(contact), is_down, at_rest });
        }
        frames
    }
}

fn exact(place: &Transform) -> DAffine3 {
    DAffine3::from_rotation_translation(place.rotation.as_dquat().normalize(), place.translation.as_dvec3())
}

/// Returns the largest distance of a contact from where its foot landed or came to rest.
fn slip(frames: &[Frame], stands: impl Fn(&Frame) -> [bool; 2]) -> f64 {
    let mut most = 0.0_f64;
    for foot in 0..2 {
        let mut from: Option<DVec3> = None;
        for frame in frames {
            from = stands(frame)[foot].then(|| from.unwrap_or(frame.contacts[foot]));
            most = most.max(from.map_or(0.0, |at| at.distance(frame.contacts[foot])));
        }
    }
    most
}

/// Returns the accelerations of a joint from second differences, m/s².
fn acceleration(frames: &[Frame], joint: usize) -> Vec<DVec3> {
    let rate = f64::from(FPS) * f64::from(FPS);
    let second = |w: &[Frame]| (w[2].joints[joint] - 2.0 * w[1].joints[joint] + w[0].joints[joint]) * rate;
    frames.windows(3).map(second).collect()
}

/// Returns, for knees and ankles, the largest acceleration as animated on level ground, and the largest that planting
/// adds.
fn accelerations(animated: &[Frame], planted: &[Frame]) -> [(f64, f64); 2] {
    [0, 1].map(|kind| {
        let (mut own, mut added) = (0.0_f64, 0.0_f64);
        for joint in [kind, kind + 2] {
            for (a, b) in acceleration(animated, joint).iter().zip(acceleration(planted, joint)).skip(5) {
                own = own.max(a.length());
                added = added.max((b - *a).length());
            }
        }
        (own, added)
    })
}

fn slope(rise: f32) -> impl Fn(Vec3) -> Ground {
    move |at| Ground::new(Vec3::new(at.x, rise * at.z, at.z), Vec3::new(0.0, 1.0, -rise))
}

fn bumps(at: Vec3) -> Ground {
    let height = 0.05 * (2.5 * at.z).sin() + 0.03 * (4.0 * at.x + 1.3 * at.z).sin();
    let [dx, dz] =
        [0.12 * (4.0 * at.x + 1.3 * at.z).cos(), 0.125 * (2.5 * at.z).cos() + 0.039 * (4.0 * at.x + 1.3 * at.z).cos()];
    Ground::new(at.with_y(height), Vec3::new(-dx, 1.0, -dz))
}

fn stairs(at: Vec3) -> Ground {
    Ground::new(at.with_y(0.12 * (at.z / 0.4).floor()), Vec3::Y)
}

/// Returns the slip of feet at rest, the slip since landing, and the largest accelerations of knee and ankle that
/// planting adds, relative to the clip's own.
fn measured(name: &str, walk: &Walk<'_>) -> [f64; 4] {
    let level = Walk { ground: &level, way: &|_| 0.0, ..*walk };
    let (animated, planted) = (level.frames(false), walk.frames(true));
    let at_rest = planted.iter().filter(|frame| frame.at_rest[0]).count();
    assert!(at_rest > 10, "{name}: at rest in {at_rest} frames");
    let [knee, ankle] = accelerations(&animated, &planted);
    let [rest, down] = [slip(&planted, |frame| frame.at_rest), slip(&planted, |frame| frame.is_down)];
    println!(
        "{:10} {name:6} pace {}: at rest {at_rest:3} of 300 frames, slip {:.4} mm, {:.2} mm since coming down; acceleration added: knee \
         {:.2} × {:.0}, ankle {:.2} × {:.0} m/s²",
        walk.gait.0,
        walk.pace,
        1e3 * rest,
        1e3 * down,
        knee.1 / knee.0,
        knee.0,
        ankle.1 / ankle.0,
        ankle.0
    );
    [rest, down, knee.1 / knee.0, ankle.1 / ankle.0]
}

fn level(at: Vec3) -> Ground {
    Ground::new(at.with_y(0.0), Vec3::Y)
}

/// Walking and running over slopes and bumps, at the clip's pace and 7 % slower, so that the animated feet slide.
#[test]
fn planted_feet_do_not_slip_and_move_smoothly() {
    let (up, down) = (slope(0.15), slope(-0.15));
    let grounds: [(&str, &dyn Fn(Vec3) -> Ground); 4] =
        [("level", &level), ("up", &up), ("down", &down), ("bumps", &bumps)];
    for gait in [("walk_ahead", WALK), ("run", RUN)] {
        for (name, ground) in grounds {
            for pace in [1.0, 0.93] {
                let walk = Walk { gait, pace, ground, way: &|at| ground(at).point.y };
                let [rest, down, knee, ankle] = measured(name, &walk);
                assert!(rest < 5e-5, "{gait:?} {name}: {rest} m");
                assert!(pace < 1.0 || down < 1e-3, "{gait:?} {name}: {down} m since it came down");
                assert!(knee < 2.0 && ankle < 1.0, "{gait:?} {name}: {knee}, {ankle} of the clip's acceleration");
            }
        }
    }
}

/// Over stairs whose edges pass below a swinging foot, with the character's place on a ramp.
#[test]
fn stairs_are_climbed_without_slip() {
    for gait in [("walk_ahead", WALK), ("run", RUN)] {
        for pace in [1.0, 0.93] {
            let walk = Walk { gait, pace, ground: &stairs, way: &|at| 0.3 * at.z - 0.06 };
            let [rest, _, knee, ankle] = measured("stairs", &walk);
            assert!(rest < 5e-5, "{gait:?}: {rest} m");
            assert!(knee < 3.5 && ankle < 1.0, "{gait:?}: {knee}, {ankle} of the clip's acceleration");
        }
    }
}

/// Without planting, a clip that moves too slowly slides by centimetres, which the tests above would detect.
#[test]
fn feet_that_are_not_planted_slide() {
    let walk = Walk { gait: ("walk_ahead", WALK), pace: 0.93, ground: &level, way: &|_| 0.0 };
    let (planted, animated) = (walk.frames(true), walk.frames(false));
    let frames: Vec<Frame> =
        animated.iter().zip(&planted).map(|(frame, planted)| Frame { at_rest: planted.at_rest, ..*frame }).collect();
    assert!(slip(&frames, |frame| frame.at_rest) > 0.01);
}
