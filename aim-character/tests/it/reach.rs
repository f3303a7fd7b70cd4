//! A hand is led in the same way in the world, whatever axes the bones have.

use aim_character::{Goal, LimbNodes, PAPER_AXES, ReachPlan, mannequin, reach};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};

const GOALS: [Goal; 2] =
    [Goal { at: 0.31, target: DVec3::new(-0.35, 1.2, 0.25) }, Goal { at: 0.9, target: DVec3::new(-0.3, 1.05, 0.25) }];

/// Returns the skinning matrices (world ← mesh) of all joints in some frames of the resulting clip.
fn skinning(axes: impl Fn(&str) -> [[f32; 3]; 3]) -> Vec<DAffine3> {
    let document = Document::from_bytes(&mannequin(axes).unwrap()).unwrap();
    let skeleton = document.skeleton();
    let limb = LimbNodes::find(skeleton, "right_hand").unwrap();
    let plan = ReachPlan { document: &document, clip: &document.clips()[0], limb, goals: &GOALS, fps: 60.0 };
    let reached = reach(&plan).unwrap();
    let at = |seconds: f32| skeleton.world_f64(&skeleton.pose(&reached.clip, seconds));
    for goal in GOALS {
        assert!(at(goal.at)[limb.tip].translation.distance(goal.target) < 1e-4 * reached.length);
    }
    let frames = [0.0, 0.1, 0.31, 0.5, 0.9, 1.2].map(at);
    let (joints, binds) = skeleton.skin(0);
    let of_frame = |world: &Vec<DAffine3>| -> Vec<DAffine3> {
        joints.iter().zip(binds).map(|(joint, bind)| world[*joint] * bind.expect("all have one")).collect()
    };
    frames.iter().flat_map(of_frame).collect()
}

#[test]
fn every_convention_reaches_the_same_way() {
    let reference = skinning(|_| PAPER_AXES);
    let conventions = crate::conventions();
    let mixed = |name: &str| conventions[name.bytes().map(usize::from).sum::<usize>() * 7 % 48];
    let uniform = conventions.iter().map(|&axes| skinning(|_| axes));
    for other in uniform.chain([skinning(mixed)]) {
        let far = reference.iter().zip(&other).map(|(a, b)| {
            let pairs = a.to_cols_array().into_iter().zip(b.to_cols_array());
            pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
        });
        let far = far.fold(0.0, f64::max);
        assert!(far < 1e-4, "{far}");
    }
}
