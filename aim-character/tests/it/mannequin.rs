//! The mannequin looks the same in the world, whatever axes its bones have.

use aim_character::{Handedness, Measurement, PAPER_AXES, Role, mannequin};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3, EulerRot, Quat, Vec3};

fn built(axes: [[f32; 3]; 3]) -> Document {
    Document::from_bytes(&mannequin(|_| axes).unwrap()).unwrap()
}

/// Returns the skinning matrices (world ← mesh) of all joints, which determine the position of every vertex.
fn skinning(document: &Document, seconds: f32) -> Vec<DAffine3> {
    let skeleton = document.skeleton();
    let world = skeleton.world_f64(&skeleton.pose(&document.clips()[0], seconds));
    let (joints, binds) = skeleton.skin(0);
    joints.iter().zip(binds).map(|(joint, bind)| world[*joint] * bind.expect("all have one")).collect()
}

#[test]
fn every_convention_gives_the_same_world() {
    let reference = built(PAPER_AXES);
    let (_, vertices) = crate::support::take_apart(&mannequin(|_| PAPER_AXES).unwrap());
    let conventions = crate::conventions();
    assert_eq!(conventions.len(), 48);
    for axes in conventions {
        let document = built(axes);
        for seconds in [0.0, 0.217, 0.6, 1.0333, 1.2] {
            let same = skinning(&reference, seconds).into_iter().zip(skinning(&document, seconds));
            for (a, b) in same {
                assert!(a.abs_diff_eq(b, 2e-6), "{axes:?} at {seconds}: {a:?} {b:?}");
            }
        }
        // The vertices come first in the file and do not depend on the bones.
        let (_, other) = crate::support::take_apart(&mannequin(|_| axes).unwrap());
        assert_eq!(vertices[..600_000], other[..600_000], "{axes:?}");
    }
}

#[test]
fn every_convention_is_measured_exactly() {
    for axes in crate::conventions() {
        let measured = Measurement::of(&built(axes));
        assert_eq!((measured.up, measured.forward, measured.left), (DVec3::Y, DVec3::Z, DVec3::X), "{axes:?}");
        let [up, forward, left] = axes.map(|v| Vec3::from_array(v).as_dvec3());
        let mirrored = left.cross(up).dot(forward) < 0.0;
        assert_eq!(measured.bones.len(), 25);
        for bone in &measured.bones {
            assert_eq!((bone.up.vector(), bone.forward.vector(), bone.left.vector()), (up, forward, left), "{axes:?}");
            assert!(bone.deviation_deg < 1e-4, "{axes:?} {} {}", bone.name, bone.deviation_deg);
            assert_eq!(bone.handedness == Handedness::Left, mirrored, "{axes:?}");
        }
    }
}

#[test]
fn conventions_may_differ_from_bone_to_bone() {
    let conventions = crate::conventions();
    let mixed = |name: &str| conventions[name.bytes().map(usize::from).sum::<usize>() * 7 % 48];
    let document = Document::from_bytes(&mannequin(mixed).unwrap()).unwrap();
    let reference = built(PAPER_AXES);
    for (a, b) in skinning(&reference, 0.45).into_iter().zip(skinning(&document, 0.45)) {
        assert!(a.abs_diff_eq(b, 2e-6));
    }
    for bone in Measurement::of(&document).bones {
        assert_eq!(bone.up.vector(), Vec3::from_array(mixed(&bone.name)[0]).as_dvec3(), "{}", bone.name);
    }
}

#[test]
fn a_general_frame_is_measured_to_a_hundredth_of_a_degree() {
    let turn = Quat::from_euler(EulerRot::XYZ, 0.35, -0.2, 0.15);
    let axes = PAPER_AXES.map(|v| (turn * Vec3::from_array(v)).to_array());
    let measured = Measurement::of(&built(axes));
    let head = measured.with_role(Role::Head).unwrap();
    for (found, given) in [head.frame.up, head.frame.forward, head.frame.left].into_iter().zip(axes) {
        assert!(found.angle_between(Vec3::from_array(given).as_dvec3()) < 1e-5, "{found} {given:?}");
    }
    assert!((head.deviation_deg - 23.0).abs() < 4.0, "{}", head.deviation_deg);
}

#[test]
fn the_mannequin_has_the_papers_proportions_and_all_roles() {
    let document = built(PAPER_AXES);
    let measured = Measurement::of(&document);
    let at = |name: &str| measured.bind_world[document.skeleton().find(name).unwrap()].translation;
    let head = at("head");
    assert!((at("spine3").y - 1.37).abs() < 1e-6);
    assert!((head - DVec3::new(0.0, 1.60, 0.0)).length() < 1e-6);
    assert!((at("left_eye") - head - DVec3::new(0.03, 0.06, 0.09)).length() < 1e-6);
    assert!((at("right_eye") - head - DVec3::new(-0.03, 0.06, 0.09)).length() < 1e-6);
    assert!((1.7..1.8).contains(&measured.height), "{}", measured.height);
    let roles: Vec<_> = measured.bones.iter().filter_map(|b| Some((b.name.as_str(), b.role?.as_str()))).collect();
    let expected = [
        ("hips", "hips"),
        ("spine", "spine"),
        ("spine1", "spine"),
        ("spine2", "spine"),
        ("spine3", "spine"),
        ("neck", "neck"),
        ("head", "head"),
        ("left_eye", "left_eye"),
        ("right_eye", "right_eye"),
    ];
    assert_eq!(roles, expected);
}

#[test]
fn the_walk_is_a_seamless_loop() {
    let document = built(PAPER_AXES);
    let walk = document.clip("walk").unwrap();
    assert!((walk.length_s() - 1.2).abs() < 1e-6);
    for (a, b) in skinning(&document, 0.0).into_iter().zip(skinning(&document, 1.2)) {
        assert!(a.abs_diff_eq(b, 1e-12));
    }
}

#[test]
fn invalid_axes_are_refused() {
    for bad in
        [[[1.0, 0.0, 0.0]; 3], [[0.0; 3]; 3], [[f32::NAN; 3]; 3], [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]]
    {
        let error = mannequin(|name| if name == "neck" { bad } else { PAPER_AXES }).unwrap_err();
        assert!(error.to_string().contains("neck"), "{error}");
    }
}
