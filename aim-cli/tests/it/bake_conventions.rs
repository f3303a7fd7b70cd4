//! A baked file does what its report says for all axis conventions of bones: each of the 48 signed ones, mixtures of
//! them, mirrored bones and general frames. Checked by the tests' own forward kinematics.

use crate::common::forward::{Bake, list, number};
use crate::common::rig::{Axes, conventions, for_mannequin, joints};
use crate::common::{Place, in_full};
use aim_runtime::glam::{EulerRot, Quat, Vec3};
use serde_json::Value;

/// Bakes the mannequin with bones in these axes and checks everything; returns the report.
#[track_caller]
fn bake(axes_of: impl Fn(&str) -> Axes, more: &str) -> Value {
    let place = Place::new();
    let source = aim_character::mannequin(&axes_of).expect("the axes are orthonormal");
    let rig = for_mannequin(&axes_of);
    place.write("m.glb", &source);
    place.write("m.toml", &rig);
    place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {more}"));
    let report = place.json("r.json");
    Bake { source: &source, output: &place.read("out.glb"), report: &report, joints: Some(&joints(&rig)) }.check();
    report
}

/// Returns the largest difference of the joints' angles between two reports, degrees.
fn difference(a: &Value, b: &Value) -> f64 {
    let angles = |report: &Value| -> Vec<f64> {
        let joints = list(&report["frames"]).iter().flat_map(|frame| list(&frame["joints"]));
        joints.flat_map(|joint| [number(&joint["heading_deg"]), number(&joint["pitch_deg"])]).collect()
    };
    let (a, b) = (angles(a), angles(b));
    assert_eq!(a.len(), b.len(), "the same frames");
    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

const SLOW_ORBIT: &str = "--target orbit:2,0.3,12 --seconds 1.2 --fps 30 --settle animation";

#[test]
fn every_convention_for_all_bones() {
    let expected = bake(|_| aim_character::PAPER_AXES, SLOW_ORBIT);
    for axes in conventions().into_iter().step_by(if in_full() { 1 } else { 6 }) {
        let off = difference(&expected, &bake(|_| axes, SLOW_ORBIT));
        assert!(off < 0.05, "{axes:?}: the angles are {off}° from those of the paper's axes");
    }
}

#[test]
fn every_bone_in_axes_of_its_own() {
    let all = conventions();
    for start in [0, 7, 19, 30] {
        let axes_of = |bone: &str| {
            let number: usize = bone.bytes().map(usize::from).sum();
            all[(start + 5 * number) % all.len()]
        };
        bake(axes_of, "--target orbit:2,-0.2,6 --seconds 3");
    }
}

#[test]
fn only_the_chain_or_only_the_eyes_mirrored() {
    let plain = aim_character::PAPER_AXES;
    let [u, f, l] = plain;
    let mirrored = [u, f, l.map(|c| -c)];
    for bones in [&["left_eye"][..], &["right_eye"], &["neck"], &["spine3", "left_eye"], &["hips"], &["head", "spine1"]]
    {
        bake(|bone| if bones.contains(&bone) { mirrored } else { plain }, "--target orbit:1.5,0.2,5 --seconds 2.4");
    }
}

#[test]
fn axes_along_no_axis() {
    let tilted = |angle: f32| {
        let turn = Quat::from_euler(EulerRot::YXZ, angle, 0.6 * angle, -0.8 * angle);
        aim_character::PAPER_AXES.map(|axis| (turn * Vec3::from(axis)).to_array())
    };
    bake(|_| tilted(0.7), SLOW_ORBIT);
    bake(|bone| tilted(if bone.ends_with("eye") { 2.0 } else { -0.4 }), "--target orbit:1,0,4 --loop");
}
