//! Memory used by the characters of an interpreted rig, measured by the allocator. This is a separate test binary
//! because the allocator counts for the whole process.

use std::sync::Arc;

use aim_character::InterpretedRig;
use aim_codegen::declare::from_toml;
use aim_runtime::glam::{Affine3A, Vec3};
use aim_runtime::{DynAim, Joint, Memory, Pose, Settings, Solver, Target};
use peak_alloc::PeakAlloc;

#[global_allocator]
static COUNTED: PeakAlloc = PeakAlloc;

/// Characters share one rig in memory, and their calls allocate nothing.
#[test]
fn characters_share_their_rig_and_calls_allocate_nothing() {
    const CROWD: usize = 1000;
    let spec = from_toml("mannequin.toml", include_str!("../../rigs/mannequin.toml")).expect("a bundled rig");
    let joints = spec.joints.len();
    let rig = Arc::new(InterpretedRig::new(&spec));
    let mut crowd = Vec::with_capacity(CROWD);
    let before = COUNTED.current_usage();
    crowd.extend((0..CROWD).map(|_| DynAim::new(Arc::clone(&rig))));
    let on_heap = (COUNTED.current_usage() - before) / CROWD;
    // The state's angles, and the corrections of four numbers per joint.
    assert!(on_heap <= joints * (size_of::<Joint>() + 16), "{on_heap} bytes for a character");
    assert_eq!(size_of::<Memory>() + joints * size_of::<Joint>(), 64 + 24 * joints);

    let at = |k: usize| Affine3A::from_translation(Vec3::new(0.0, 1.7 - 0.15 * k as f32, 0.0));
    let pose = Pose::new((0..joints).map(at).collect::<Vec<_>>());
    for solver in [Solver::Exact, Solver::Natural, Solver::Ascent] {
        let settings = Settings::default().with_solver(solver);
        for (step, character) in crowd.iter_mut().enumerate() {
            let angle = 0.01 * step as f32;
            let target = Vec3::new(2.0 * angle.sin(), 1.8, 2.0 * angle.cos());
            let held = COUNTED.current_usage();
            COUNTED.reset_peak_usage();
            character.snap(&pose, target, &settings);
            // Nor for targets behind, at the effector, at extreme or invalid positions, or for several targets.
            let at_eye = pose.joints[0].translation.into();
            for point in [-target, -target, -target, at_eye, Vec3::splat(1e30), Vec3::NAN] {
                character.aim(&pose, point, 1.0 / 60.0, &settings);
            }
            character.aim(&pose, &[Target::new(target, 0.5), Target::new(-target, 0.2)], 1.0 / 60.0, &settings);
            character.reset();
            assert_eq!(COUNTED.peak_usage(), held, "{solver:?}, character {step}");
        }
    }
}
