use aim_animation::glam::{DQuat, DVec3, Quat, Vec3};
use aim_animation::{Bone, Inertia, PoseError, Skeleton, Transform, Transition};

use crate::common::{Rng, angle_between};

/// Smooth random animation of one bone, made of sine waves.
struct Waves {
    place: [Vec3; 3],
    turn: [Vec3; 3],
}

impl Waves {
    fn random(rng: &mut Rng) -> Self {
        let waves = |rng: &mut Rng, most: f32| [0; 3].map(|_| rng.vector(most));
        Self { place: waves(rng, 1.0), turn: waves(rng, 0.8) }
    }

    fn at(&self, time: f64) -> [Transform; 1] {
        let wave = |of: &[Vec3; 3]| {
            let [a, b, c] = of.map(|wave| wave.as_dvec3());
            a + b * (2.0 * time).sin() + c * (3.0 * time + 1.0).cos()
        };
        let turn = DQuat::from_scaled_axis(wave(&self.turn));
        let place = wave(&self.place).as_vec3();
        [Transform { translation: place, rotation: turn.as_quat(), scale: Vec3::ONE + 0.2 * place }]
    }
}

fn skeleton() -> Skeleton {
    Skeleton::new([Bone::new("b", None)]).unwrap()
}

/// Returns the velocities between two poses: of translation, rotation and scale.
fn speeds(a: &Transform, b: &Transform, dt: f64) -> [DVec3; 3] {
    let turn = b.rotation.as_dquat().normalize() * a.rotation.as_dquat().normalize().conjugate();
    let turn = if turn.w < 0.0 { -turn } else { turn };
    [(b.translation - a.translation).as_dvec3(), turn.to_scaled_axis(), (b.scale - a.scale).as_dvec3()].map(|v| v / dt)
}

/// Positions and velocities have no jump during a transition, one that interrupts it, and the end of that. Before, the
/// pose is that of the old animation; after, that of the new one.
#[test]
fn positions_and_velocities_are_continuous() {
    let mut rng = Rng(1);
    for case in 0..100 {
        let animations = [0; 3].map(|_| Waves::random(&mut rng));
        let (dt, skeleton) = (1.0 / 1000.0, skeleton());
        let (mut inertia, mut current) = (Inertia::new(&skeleton), 0);
        let mut shown: Vec<[Transform; 1]> = Vec::new();
        let begins = [300, 450];
        for frame in 0..1000_u32 {
            let time = |frames: i64| (i64::from(frame) + frames) as f64 * f64::from(dt);
            if begins.contains(&frame) {
                current += 1;
                let next = [-2, -1].map(|frames| animations[current].at(time(frames)));
                let last = [&shown[shown.len() - 2][..], &shown[shown.len() - 1][..]];
                let transition = Transition { shown: last, next: [&next[0], &next[1]], dt_s: dt, length_s: 0.3 };
                inertia.begin(&transition).unwrap();
            }
            inertia.advance(dt);
            let mut pose = animations[current].at(time(0));
            inertia.apply(&mut pose).unwrap();
            shown.push(pose);
        }
        let dt = f64::from(dt);
        for (frame, three) in shown.windows(3).enumerate() {
            let [before, after] = [0, 1].map(|k| speeds(&three[k][0], &three[k + 1][0], dt));
            for (a, b) in before.iter().zip(after) {
                // Speeds are a few units per second, with rounding errors of 3e-4; accelerations go up to 500.
                assert!(a.distance(b) < 0.7, "case {case} frame {frame}: {a} {b}");
            }
        }
        for (frame, pose) in shown.iter().enumerate().filter(|(frame, _)| !(300..751).contains(frame)) {
            let truth = animations[if frame < 300 { 0 } else { 2 }].at(frame as f64 * f64::from(1.0_f32 / 1000.0));
            assert_eq!(*pose, truth, "case {case} frame {frame}");
        }
    }
}

/// The offset follows its definition: from a value and velocity without acceleration to rest at 0.
#[test]
fn the_offset_agrees_with_its_definition() {
    let (mut rng, skeleton) = (Rng(2), skeleton());
    for _ in 0..300 {
        let [before, now] = [0; 2].map(|_| rng.vector(1.0));
        let step = Quat::from_scaled_axis(rng.vector(0.05));
        let start = rng.rotation();
        let shown = [(before, start), (now, step * start)].map(|(at, turn)| [Transform::new(at, turn)]);
        let next = [Transform::IDENTITY];
        let (dt_s, length_s) = (rng.between(0.01, 0.1), rng.between(0.2, 1.0));
        let mut inertia = Inertia::new(&skeleton);
        let transition = Transition { shown: [&shown[0], &shown[1]], next: [&next, &next], dt_s, length_s };
        inertia.begin(&transition).unwrap();
        let elapsed = rng.between(0.0, length_s);
        inertia.advance(elapsed);
        let mut pose = next;
        inertia.apply(&mut pose).unwrap();
        // x(t) = x₀ + v₀t + c₃t³ + c₄t⁴ + c₅t⁵, whose value, velocity and acceleration are 0 at the end; solved here by
        // elimination.
        let (t, end) = (f64::from(elapsed), f64::from(length_s));
        let left = |value: DVec3, velocity: DVec3| {
            let (a, b, c) = (-(value + velocity * end), -velocity * end, DVec3::ZERO);
            // c₃ + c₄ + c₅ = a, 3c₃ + 4c₄ + 5c₅ = b, 6c₃ + 12c₄ + 20c₅ = c, with time in units of the duration.
            let c5 = (c - a * 6.0 - (b - a * 3.0) * 6.0) / 2.0;
            let c4 = b - a * 3.0 - c5 * 2.0;
            let c3 = a - c4 - c5;
            let u = t / end;
            value + velocity * t + c3 * u.powi(3) + c4 * u.powi(4) + c5 * u.powi(5)
        };
        let truth = left(now.as_dvec3(), (now - before).as_dvec3() / f64::from(dt_s));
        assert!(pose[0].translation.as_dvec3().distance(truth) < 2e-5, "{pose:?} {truth}");
        let vector = |q: Quat| {
            let q = q.as_dquat().normalize();
            if q.w < 0.0 { (-q).to_scaled_axis() } else { q.to_scaled_axis() }
        };
        let [before, now] = [start, step * start].map(vector);
        if now.length() < 2.9 {
            let truth = left(now, (now - before) / f64::from(dt_s));
            assert!(angle_between(pose[0].rotation, DQuat::from_scaled_axis(truth)) < 1e-4, "{pose:?} {truth}");
        }
        inertia.advance(length_s);
        let mut pose = next;
        inertia.apply(&mut pose).unwrap();
        assert!(inertia.is_done() && pose == next);
    }
}

/// An offset that passes half a turn, where its rotation vector changes sides, keeps its direction.
#[test]
fn an_offset_past_half_a_turn_keeps_its_direction() {
    let skeleton = skeleton();
    let shown = [3.1_f32, 3.2].map(|angle| [Transform::from_rotation(Quat::from_rotation_x(angle))]);
    let next = [Transform::IDENTITY];
    let mut inertia = Inertia::new(&skeleton);
    let transition = Transition { shown: [&shown[0], &shown[1]], next: [&next, &next], dt_s: 0.1, length_s: 1.0 };
    inertia.begin(&transition).unwrap();
    inertia.advance(0.01);
    let mut pose = next;
    inertia.apply(&mut pose).unwrap();
    assert!(angle_between(pose[0].rotation, DQuat::from_rotation_x(3.21)) < 1e-3, "{pose:?}");
}

#[test]
fn invalid_transitions_are_cuts_or_errors() {
    let (skeleton, pose) = (skeleton(), [Transform::from_translation(Vec3::X)]);
    let mut inertia = Inertia::new(&skeleton);
    let two = [&pose[..], &pose[..]];
    let next = [Transform::IDENTITY];
    let begin = |inertia: &mut Inertia, dt_s, length_s| {
        let transition = Transition { shown: two, next: [&next, &next], dt_s, length_s };
        inertia.begin(&transition).unwrap();
    };
    for length in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        begin(&mut inertia, 0.1, length);
        let mut found = next;
        inertia.apply(&mut found).unwrap();
        assert!(inertia.is_done() && found == next);
    }
    for dt in [0.0, -1.0, f32::NAN] {
        // In motion, too: without a time step there is no velocity.
        let shown = [&next[..], &pose[..]];
        inertia.begin(&Transition { shown, next: [&next, &next], dt_s: dt, length_s: 1.0 }).unwrap();
        inertia.advance(0.25);
        let mut moving = next;
        inertia.apply(&mut moving).unwrap();
        begin(&mut inertia, dt, 1.0);
        inertia.advance(0.25);
        let mut still = next;
        inertia.apply(&mut still).unwrap();
        assert_eq!(moving, still);
        begin(&mut inertia, dt, 1.0);
        inertia.advance(dt);
        let mut found = next;
        inertia.apply(&mut found).unwrap();
        assert_eq!(found, pose, "all of the difference, without a velocity");
    }
    let length = PoseError::Length { bones: 1, found: 0 };
    assert_eq!(inertia.apply(&mut []), Err(length));
    let transition = Transition { shown: [&pose, &[]], next: [&next, &next], dt_s: 0.1, length_s: 1.0 };
    assert_eq!(inertia.begin(&transition), Err(length));
}

/// Returns the pose at a time of a transition between animations at rest, from the scales shown to the next one.
fn scale_at(shown: [Vec3; 2], next: Vec3, dt_s: f32, length_s: f32, time_s: f32) -> Transform {
    let scaled = |scale| [Transform { scale, ..Transform::IDENTITY }];
    let (shown, next) = (shown.map(scaled), scaled(next));
    let mut inertia = Inertia::new(&skeleton());
    inertia.begin(&Transition { shown: [&shown[0], &shown[1]], next: [&next, &next], dt_s, length_s }).unwrap();
    inertia.advance(time_s);
    let mut pose = next;
    inertia.apply(&mut pose).unwrap();
    pose[0]
}

/// Momentum mirrors no bone: if both animations have a scale of the same sign, it keeps that sign, without a jump in
/// value or speed.
#[test]
fn a_scale_keeps_its_sign() {
    for sign in [1.0, -1.0] {
        let vector = |x: f32| Vec3::new(sign * x, sign, sign * 2.0 * x);
        let at = |time: f32| scale_at([vector(1.0), vector(0.5)], vector(0.01), 0.1, 1.0, time).scale * sign;
        assert!(at(0.0).distance(vector(0.5) * sign) < 1e-6 && at(1.0).distance(vector(0.01) * sign) < 1e-6);
        let h = 1e-4;
        let scales: Vec<Vec3> = (0..=10_000_u16).map(|step| at(f32::from(step) * h)).collect();
        assert!(scales.iter().all(|scale| scale.min_element() > 0.0), "{:?}", scales[2000]);
        let speeds: Vec<Vec3> = scales.windows(2).map(|pair| (pair[1] - pair[0]) / h).collect();
        assert!((speeds[0].x + 5.0).abs() < 0.1 && speeds[9999].length() < 0.05, "{} {}", speeds[0], speeds[9999]);
        // Accelerations reach some thousands when a scale turns back before 0; stopping at 0 would change its speed by
        // 4 at once.
        let jump = speeds.windows(2).map(|pair| pair[0].distance(pair[1])).fold(0.0_f32, f32::max);
        assert!(jump < 1.0, "the speed jumps by {jump}");
    }
    // A bone that is to be mirrored passes 0.
    let mirrored = [0.0, 1.0].map(|time| scale_at([Vec3::ONE; 2], -Vec3::ONE, 0.1, 1.0, time).scale);
    assert_eq!(mirrored, [Vec3::ONE, -Vec3::ONE]);
}

/// However long the transition and however fast the shown movement, the pose stays finite.
#[test]
fn a_long_transition_is_finite() {
    let skeleton = skeleton();
    let pose = |place: f32| {
        let rotation = Quat::from_rotation_x(place.clamp(-1.0, 1.0));
        [Transform { translation: Vec3::splat(place), rotation, scale: Vec3::splat(1.0 + place) }]
    };
    for (shown, next) in [([0.0, 20.0], 1.0), ([1e30, 2e30], 0.0), ([0.0, 3e38], 3e38), ([-2e38, -1e38], 2e38)] {
        let (shown, next) = (shown.map(pose), pose(next));
        for dt_s in [1e-38, 1e-3, 0.1] {
            for length_s in [1e10, 1e30, 3e38] {
                let mut inertia = Inertia::new(&skeleton);
                let transition = Transition { shown: [&shown[0], &shown[1]], next: [&next, &next], dt_s, length_s };
                inertia.begin(&transition).unwrap();
                for _ in 0..8 {
                    let mut found = next;
                    inertia.apply(&mut found).unwrap();
                    let finite = found[0].translation.is_finite() && found[0].scale.is_finite();
                    assert!(finite, "{shown:?} {dt_s} {length_s}: {found:?}");
                    assert!((found[0].rotation.length() - 1.0).abs() < 1e-3, "{found:?}");
                    inertia.advance(0.15 * length_s);
                }
            }
        }
    }
}
