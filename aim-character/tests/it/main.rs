//! Tests of measurement, proposed declarations, interpreted rigs, and limbs led through points.

mod bodies;
mod declaration;
mod facing;
mod ik;
mod mannequin;
mod mixed_rigs;
mod moves;
mod names;
mod reach;
mod rigs;
mod seams;
mod storage;
#[path = "../../../aim-gltf/tests/it/support/mod.rs"]
mod support;
mod traditions;

/// The bundled rigs, as files that users may copy.
const RIGS: [(&str, &str); 8] = [
    ("mannequin", include_str!("../../../rigs/mannequin.toml")),
    ("mixamo", include_str!("../../../rigs/mixamo.toml")),
    ("rigify", include_str!("../../../rigs/rigify.toml")),
    ("rocketbox", include_str!("../../../rigs/rocketbox.toml")),
    ("thug", include_str!("../../../rigs/thug.toml")),
    ("turret", include_str!("../../../rigs/turret.toml")),
    ("unreal", include_str!("../../../rigs/unreal.toml")),
    ("vrm", include_str!("../../../rigs/vrm.toml")),
];

/// Returns `true` if tests with many cases run all of them, rather than the part that plain `cargo test` runs.
fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// Returns all 48 (up, forward, left) triples of signed axes, 24 of each handedness.
fn conventions() -> Vec<[[f32; 3]; 3]> {
    let mut out = Vec::new();
    for (u, f, l) in [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)] {
        for signs in 0..8_u8 {
            let axis = |index: usize, bit: u8| {
                let mut v = [0.0; 3];
                v[index] = if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
                v
            };
            out.push([axis(u, 0), axis(f, 1), axis(l, 2)]);
        }
    }
    out
}
