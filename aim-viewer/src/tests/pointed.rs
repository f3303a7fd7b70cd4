//! Tests of the hit under the mouse pointer, and of the lamp in the hand.

use aim_runtime::glam::{DVec3, Vec2};

use super::*;

/// Returns the screen position halfway between a bone and its first child.
fn middle(window: &Window, bone: &str) -> Pos2 {
    let stage = &window.viewer().stage;
    let skeleton = stage.character.skeleton();
    let node = skeleton.find(bone).expect("it has one");
    let child = skeleton.children(node).next().expect("it goes on");
    let world = &stage.first().expect("a frame").world;
    window.seen(world[node].translation.lerp(world[child].translation, 0.5).as_vec3())
}

#[test]
fn the_bone_under_the_pointer_is_found() {
    let mut window = Window::mannequin(USUAL);
    window.click("pause");
    window.press(Key::B);
    for bone in ["right_upper_arm", "left_forearm", "left_upper_leg"] {
        let Some(at) = window.viewer().stage.character.skeleton().find(bone).ok().map(|_| middle(&window, bone)) else {
            continue;
        };
        window.harness.event(egui::Event::PointerMoved(at));
        window.frames(2);
        let stage = &window.viewer().stage;
        let pointed = stage.pointed.expect("the figure is there");
        assert_eq!(stage.character.skeleton().names()[pointed.bone], bone);
        // The point lies under the pointer and in the plane of the triangle.
        assert!(window.seen(pointed.point).distance(at) < 0.5, "{:?} {at:?}", window.seen(pointed.point));
        let [a, b, c] = pointed.triangle;
        let normal = (b - a).cross(c - a).normalize();
        assert!((pointed.point - a).dot(normal).abs() < 1e-4, "{pointed:?}");
    }
    // Beside the figure there is no hit.
    window.harness.event(egui::Event::PointerMoved(window.scene.get().left_top() + egui::vec2(5.0, 300.0)));
    window.frames(2);
    assert_eq!(window.viewer().stage.pointed, None);
}

#[test]
fn every_vertex_of_a_bone_alone_lies_in_its_box() {
    let mut window = Window::mannequin(USUAL);
    window.press(Key::B);
    window.frames(20);
    let stage = &window.viewer().stage;
    let lines = |viewer: &Viewer| viewer.stage.picture(&viewer.camera, viewer.shown).rods.len();
    let with = lines(window.viewer());
    let bones = stage.character.skinning.boxes(&stage.actors[0].posed).count();
    window.press(Key::B);
    assert_eq!(with - lines(window.viewer()), 12 * bones, "twelve edges each");
}

#[test]
fn rays_go_where_points_are_seen() {
    let window = Window::mannequin(USUAL);
    let camera = window.viewer().camera;
    let size = Vec2::new(900.0, 500.0);
    for point in [Vec3::new(0.3, 1.2, 0.1), Vec3::new(-0.5, 0.2, 0.4)] {
        let ray = camera.ray(camera.project(point, size).expect("in front"), size);
        let off = ray.direction.normalize().cross((point - ray.origin).normalize()).length();
        assert!(off < 1e-5, "{off}");
    }
}

#[test]
fn the_lamp_stays_in_the_hand() {
    for scale in [[1.0; 3], [-1.2, 0.9, 1.1]] {
        let mut window = Window::new(tools::scaled(scale), USUAL);
        window.press(Key::G);
        let mut places = Vec::new();
        for _ in 0..6 {
            window.frames(7);
            let stage = &window.viewer().stage;
            let world = &stage.first().expect("a frame").world;
            let lamp = stage.lamp.expect("there is a hand").place(world).as_daffine3();
            // In double precision, the lamp keeps its position in the hand's space, like a child of the hand.
            let bind = &stage.character.measurement.bind_world;
            let hand = world[stage.character.hand.expect("it has one")];
            let of_hand = hand.inverse().transform_point3(lamp.transform_point3(DVec3::Z * 0.1));
            places.push(of_hand);
            assert!(hand.translation.distance(lamp.translation) < 0.15, "{}", hand.translation);
            assert_eq!(bind.len(), world.len());
        }
        let first = places[0];
        assert!(places.iter().all(|place| place.distance(first) < 1e-5), "{places:?}");
    }
}
