//! Tests of feet on a sloped floor.

use aim_animation::Plant;
use aim_runtime::glam::DVec3;

use super::*;

/// Returns, for each foot, the height of its ball above the slope along up, and the distance from its planted position
/// if planted. Computed from the world transforms of the nodes.
fn feet(window: &Window) -> Vec<(f64, Option<f64>)> {
    let stage = &window.viewer().stage;
    let (actor, frame) = (&stage.actors[0], stage.first().expect("a frame"));
    let feet = actor.feet.as_ref().expect("feet are found");
    let [up, ..] = stage.character.directions();
    let (up, normal) = (up.as_dvec3(), stage.slope.normal.as_dvec3());
    let one = |((bone, ball), plant): ((usize, Vec3), &Plant)| {
        let ball: DVec3 = frame.world[bone].transform_point3(ball.as_dvec3());
        let height = (ball - stage.character.floor.as_dvec3()).dot(normal) / up.dot(normal);
        let off = plant.anchor().filter(|_| plant.is_planted()).map(|anchor| anchor.as_dvec3().distance(ball));
        (height, off)
    };
    feet.balls().zip(feet.plants()).map(one).collect()
}

#[test]
fn feet_at_rest_stand_on_the_slope() {
    for scale in [[1.0; 3], [-1.0, 1.0, 1.0]] {
        let mut window = Window::new(tools::scaled(scale), USUAL);
        window.harness.state_mut().stage.clock.play.clip = None;
        window.press(Key::F);
        window.frames(60);
        let found = feet(&window);
        assert_eq!(found.len(), 2);
        for (height, off) in found {
            assert!(height.abs() < 2e-3, "{height} m over the slope");
            assert!(off.expect("it is planted") < 1e-3, "{off:?} m from where it is planted");
        }
        let ground = window.viewer().stage.picture(&window.viewer().camera, window.viewer().shown).ground;
        assert_eq!(ground.up, window.viewer().stage.slope.normal);
        assert!(window.viewer().stage.first().expect("a frame").error_deg < 0.1, "it still looks at the target");
    }
}

#[test]
fn a_planted_foot_does_not_slip_as_the_character_walks_on() {
    let mut window = Window::mannequin(TALL);
    window.click("clip");
    window.click("clip: walk_ahead");
    window.press(Key::F);
    let mut planted = 0;
    for _ in 0..150 {
        window.frames(1);
        for (height, off) in feet(&window) {
            assert!(height > -5e-3, "{height} m into the slope");
            if let Some(off) = off {
                assert!(off < 1e-3, "it slips by {off} m");
                planted += 1;
            }
        }
    }
    assert!(planted > 40, "feet are planted: {planted} times in 150 frames");
}
