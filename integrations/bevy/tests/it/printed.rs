//! The code that `aim rig mannequin.glb --format bevy` prints compiles and aims.

use bevy_aim::aim::glam::Vec3;
use bevy_aim::{AimStatus, AimTarget};
use bevy_transform::components::Transform;

use crate::mannequin::Mannequin;
use crate::stage::{self, error_deg, spawn, status};

#[test]
fn the_printed_character_looks() {
    let mut app = stage::app();
    let character = spawn(&mut app, Mannequin::character(), Transform::from_xyz(1.0, 0.0, 0.0), 0.01);
    let lamp = Vec3::new(1.8, 1.9, 1.6);
    app.world_mut().entity_mut(character).insert(AimTarget::point(lamp));
    let mut reached = 0;
    for _ in 0..180 {
        app.update();
        if status(&app, character) == AimStatus::Reached {
            reached += 1;
            for eye in ["left_eye", "right_eye"] {
                let error = error_deg(&app, character, eye, lamp.as_dvec3());
                assert!(error <= 0.1, "{eye}: {error} degrees off");
            }
        }
    }
    assert!(reached > 100, "{reached} of 180 frames");
    assert_eq!(stage::binding(&app, character).joints().count(), 7);
}

/// The README's first example equals `first.rs` of the package `examples`, which is compiled with all of Bevy.
#[test]
fn the_readmes_example_is_compiled() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let read = |file: &str| std::fs::read_to_string(format!("{folder}/{file}")).expect("a file");
    let example = read("examples/examples/first.rs");
    assert!(read("README.md").contains(&format!("```rust,ignore\n{example}```")), "copy it: {example}");
    let app = example.lines().filter(|line| line.contains("Aim")).count();
    assert!(app <= 10, "{app} lines make a loaded character an aimed one");
}
