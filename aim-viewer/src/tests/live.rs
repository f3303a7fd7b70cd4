//! Tests of changes while the viewer runs.

use aim_runtime::Solver;
use aim_runtime::glam::Vec3;

use super::*;
use crate::stage::Stage;
use crate::tuning::Lineup;

/// Returns the added angles of all actors' joints, radians.
fn angles(stage: &Stage) -> Vec<[f32; 2]> {
    let joints = stage.actors.iter().filter_map(|actor| actor.frame.as_ref()).flat_map(|frame| &frame.joints);
    joints.map(|joint| [joint.heading, joint.pitch]).collect()
}

/// Returns the whole moving state as text, for comparisons.
fn moving(window: &Window) -> String {
    let Stage { clock, target, memory, actors, crowd, .. } = &window.viewer().stage;
    let worlds: Vec<_> = actors.iter().map(|a| &a.frame).chain(crowd.iter().map(|m| &m.frame)).collect();
    format!("{clock:?} {target:?} {} {worlds:?}", memory.len())
}

#[test]
fn a_pause_holds_everything_still() {
    let mut window = Window::mannequin(USUAL);
    window.click("path: noise");
    window.harness.state_mut().stage.tuning.crowd = 5;
    window.frames(20);
    window.press(Key::Space);
    window.frames(1);
    let before = moving(&window);
    window.frames(30);
    assert_eq!(moving(&window), before);
    window.press(Key::Space);
    window.frames(1);
    assert_ne!(moving(&window), before);
}

#[test]
fn a_single_step_is_a_sixtieth_of_a_second_of_everything() {
    let mut window = Window::mannequin(USUAL);
    window.click("path: orbit");
    window.press(Key::Space);
    window.frames(2);
    for _ in 0..3 {
        let before = &window.viewer().stage;
        let [time, path] = [before.clock.time, before.target.time];
        let (frames, remembered) = (before.memory.len(), before.memory.back().expect("some").t);
        window.press(Key::Period);
        window.frames(4);
        let after = &window.viewer().stage;
        for passed in [after.clock.time - time, after.target.time - path] {
            assert!((passed - SIXTIETH).abs() < 1e-6, "{passed}");
        }
        assert_eq!(after.memory.len(), frames + 1);
        assert!((after.memory.back().expect("some").t - remembered - f64::from(SIXTIETH)).abs() < 1e-9);
    }
}

#[test]
fn speed_is_that_of_clip_and_path() {
    let mut window = Window::mannequin(USUAL);
    window.click("path: orbit");
    window.harness.state_mut().stage.clock.speed = 0.5;
    let before = [window.viewer().stage.clock.time, window.viewer().stage.target.time];
    window.frames(60);
    let after = [window.viewer().stage.clock.time, window.viewer().stage.target.time];
    for (before, after) in before.into_iter().zip(after) {
        assert!((after - before - 0.5).abs() < 1e-3, "{before} {after}");
    }
}

/// A name, and a change that is made while the stage is paused.
type Switch = (&'static str, fn(&mut Stage));

#[test]
fn switching_leaves_the_joints_where_they_were() {
    let mut window = Window::mannequin(TALL);
    let place = window.viewer().stage.room().point(1.5, 0.3, 0.6);
    window.harness.state_mut().stage.target.place = place;
    window.frames(90);
    window.press(Key::Space);
    window.frames(1);
    let held = angles(&window.viewer().stage);
    assert!(held[1][0].abs() > 0.2, "the neck is turned: {held:?}");
    let switches: [Switch; 9] = [
        ("side by side", |stage| stage.tuning.lineup = Lineup::All),
        ("another solver", |stage| stage.tuning.lineup = Lineup::One(Solver::Exact)),
        ("the neck", Stage::switch_effector),
        ("the eyes", Stage::switch_effector),
        ("a crowd", |stage| stage.tuning.crowd = 7),
        ("a larger crowd", |stage| stage.tuning.crowd = 30),
        ("no crowd", |stage| stage.tuning.crowd = 1),
        ("one eye", |stage| stage.tuning.both_eyes = false),
        ("both eyes", |stage| stage.tuning.both_eyes = true),
    ];
    for (what, switch) in switches {
        switch(&mut window.harness.state_mut().stage);
        window.frames(2);
        for joints in angles(&window.viewer().stage).chunks(held.len()) {
            for (now, before) in joints.iter().zip(&held) {
                let off = (now[0] - before[0]).abs().max((now[1] - before[1]).abs());
                assert!(off < 1e-5, "{what}: {now:?} instead of {before:?}");
            }
        }
    }
}

#[test]
fn a_crowd_is_as_its_first_where_it_stands_alike() {
    let mut window = Window::mannequin(USUAL);
    window.harness.state_mut().stage.tuning.crowd = 20;
    window.frames(120);
    let places =
        |window: &Window| -> Vec<Vec3> { window.viewer().stage.crowd.iter().map(|member| member.shift).collect() };
    let mut all = places(&window);
    all.push(Vec3::ZERO);
    for (at, a) in all.iter().enumerate() {
        assert!(all[..at].iter().all(|b| a.distance(*b) > 0.5), "two stand in one place: {a}");
    }
    let errors = |window: &Window| -> Vec<f64> {
        let frames = window.viewer().stage.crowd.iter().filter_map(|member| member.frame.as_ref());
        frames.map(|frame| frame.error_deg).collect()
    };
    assert_eq!(errors(&window).len(), 19);
    // Changed ranges apply to the whole crowd.
    let reached = errors(&window).iter().filter(|error| **error < 0.2).count();
    assert!(reached > 10, "{:?}", errors(&window));
    for joint in &mut window.harness.state_mut().stage.tuning.spec.joints {
        joint.heading = Some(aim_codegen::AngleRange::Between(-0.01, 0.01));
        joint.pitch = Some(aim_codegen::AngleRange::Between(-0.01, 0.01));
    }
    window.frames(240);
    for member in &window.viewer().stage.crowd {
        let frame = member.frame.as_ref().expect("a frame");
        assert!(frame.joints.iter().all(|joint| joint.heading.abs() < 0.0101 && joint.pitch.abs() < 0.0101));
    }
}

#[test]
fn ranges_rates_and_weight_are_held_live() {
    let mut window = Window::mannequin(USUAL);
    window.click("path: noise");
    window.frames(60);
    window.harness.state_mut().stage.tuning.spec.joints[1].rate = 0.2;
    let mut before = angles(&window.viewer().stage)[1];
    for _ in 0..60 {
        window.frames(1);
        let now = angles(&window.viewer().stage)[1];
        assert!((now[0] - before[0]).abs() <= 0.2 * SIXTIETH + 1e-5, "{before:?} {now:?}");
        before = now;
    }
    window.harness.state_mut().stage.tuning.settings.weight = 0.0;
    window.frames(600);
    assert!(angles(&window.viewer().stage).iter().flatten().all(|angle| *angle == 0.0), "the animation alone");
}

/// Checks that everything drawn or plotted is finite.
fn assert_finite(window: &Window) {
    let Viewer { stage, camera, shown, .. } = window.viewer();
    let picture = stage.picture(camera, *shown);
    let mut points = vec![picture.view.from, picture.view.at];
    points.extend(picture.figures.iter().flat_map(|figure| figure.bounds));
    assert!(picture.figures.iter().flat_map(|figure| &figure.rows).flatten().all(|number| number.is_finite()));
    points.extend(picture.rods.iter().flat_map(|rod| [rod.from, rod.to]));
    points.extend(picture.fans.iter().flat_map(|fan| fan.rim.iter().chain([&fan.apex])));
    assert!(points.iter().all(|point| point.is_finite()));
    let remembered = stage
        .memory
        .iter()
        .flat_map(|memory| memory.error_deg.iter().copied().chain(memory.angles_deg.iter().flatten().copied()));
    assert!(remembered.chain([stage.clock.time.into(), f64::from(camera.distance)]).all(f64::is_finite));
}

#[test]
fn nothing_but_numbers_comes_of_random_input() {
    let mut random = fastrand::Rng::with_seed(3);
    let mut window = Window::mannequin(USUAL);
    window.click("show limits");
    window.click("show reference frames");
    window.click("show boxes");
    window.click("show lamp");
    window.click("show slope");
    let keys = [
        Key::I,
        Key::J,
        Key::K,
        Key::L,
        Key::M,
        Key::N,
        Key::Z,
        Key::X,
        Key::Q,
        Key::A,
        Key::B,
        Key::E,
        Key::F,
        Key::G,
        Key::T,
        Key::H,
        Key::Space,
        Key::Period,
        Key::ArrowLeft,
        Key::ArrowRight,
        Key::ArrowUp,
        Key::ArrowDown,
        Key::Tab,
        Key::Enter,
        Key::Escape,
    ];
    let button = [egui::PointerButton::Primary, egui::PointerButton::Secondary, egui::PointerButton::Middle];
    for _ in 0..1000 {
        let pos = egui::pos2(random.f32() * 1300.0 - 10.0, random.f32() * 820.0 - 10.0);
        let event = match random.u8(..6) {
            0 | 1 => egui::Event::Key {
                key: keys[random.usize(..keys.len())],
                physical_key: None,
                pressed: random.bool(),
                repeat: false,
                modifiers: Default::default(),
            },
            2 => egui::Event::PointerButton {
                pos,
                button: button[random.usize(..3)],
                pressed: random.bool(),
                modifiers: Default::default(),
            },
            3 => egui::Event::MouseWheel {
                unit: egui::MouseWheelUnit::Line,
                delta: egui::vec2(0.0, random.f32() * 40.0 - 20.0),
                phase: egui::TouchPhase::Move,
                modifiers: Default::default(),
            },
            4 => egui::Event::Text("7e30".into()),
            _ => egui::Event::PointerMoved(pos),
        };
        window.harness.event(event);
        window.harness.step();
        if random.u8(..50) == 0 {
            assert_finite(&window);
        }
    }
    assert_finite(&window);
    let viewer = window.viewer();
    let written = aim_character::declaration::toml(
        &aim_character::Proposal { spec: viewer.stage.tuning.spec.clone(), reasons: Vec::new() },
        "",
    );
    aim_codegen::declare::from_toml("it", &written).unwrap_or_else(|errors| panic!("{}", errors.render()));
}

#[test]
fn a_long_frame_and_none_are_no_jump() {
    let mut viewer = Viewer::new(Character::mannequin().expect("the mannequin")).expect("its rig is a chain");
    let context = egui::Context::default();
    let frame = |viewer: &mut Viewer, seconds: f32, key: Option<Key>| {
        let events = key.map(|key| egui::Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Default::default(),
        });
        let input = egui::RawInput { events: events.into_iter().collect(), ..Default::default() };
        let _ = context.run_ui(input, |ui| viewer.ui(ui, seconds, |_, _, _| ()));
    };
    frame(&mut viewer, 0.0, None);
    assert_eq!(viewer.stage.clock.time, 0.0);
    let before = viewer.stage.target_now();
    frame(&mut viewer, 5.0, Some(Key::I));
    let moved = viewer.stage.target_now().distance(before) / viewer.stage.room().metre;
    assert!(moved < 0.2 && viewer.stage.clock.time < 0.11, "{moved} {}", viewer.stage.clock.time);
    for seconds in [f32::NAN, f32::INFINITY, -1.0] {
        frame(&mut viewer, seconds, None);
        assert!((0.0..0.5).contains(&viewer.stage.clock.time), "{seconds}: {}", viewer.stage.clock.time);
        assert!(viewer.age.is_finite() && viewer.stage.timing.between.is_finite(), "{seconds}");
    }
}
