//! Measurements of real characters, in the folder that `AIM_RIGS` names. Run with
//! `AIM_RIGS=folder cargo test -p aim-character -- --ignored`.

use std::path::PathBuf;

use aim_character::{MeasuredPose, Measurement, Role};
use aim_gltf::Document;

/// Loads a file and measures it.
fn measured(file: &str) -> (Document, Measurement) {
    let document = Document::load(path(file)).unwrap();
    let measured = Measurement::of(&document);
    (document, measured)
}

fn path(file: &str) -> PathBuf {
    let folder = std::env::var_os("AIM_RIGS").expect("AIM_RIGS names a folder of real characters");
    let mut path = PathBuf::from(folder);
    if path.is_relative() {
        // Relative to the repository, where the command runs that sets it; tests run in the crate's folder.
        path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    }
    path.join(file)
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn bodies_are_recognised_without_names_and_roots() {
    use aim_runtime::glam::{DQuat, DVec3};
    use serde_json::json;
    for file in ["dude.glb", "rocketbox_female_adult_01.glb", "khronos_fox.glb", "pab_arnaud.glb"] {
        let file = path(file);
        let (json, bin) = crate::support::take_apart(&std::fs::read(&file).unwrap());
        let whole_document = Document::load(&file).unwrap();
        let whole = Measurement::of(&whole_document);
        // Compare indices in the file, because the skeleton's order changes with another root.
        let head = |measured: &Measurement, document: &Document| {
            measured.with_role(Role::Head).and_then(|bone| document.skeleton().nodes()[bone.node].index)
        };
        for (turn, mirror, named) in [
            (DQuat::IDENTITY, 1.0, false),
            (DQuat::from_rotation_x(90_f64.to_radians()), 1.0, false),
            (DQuat::from_rotation_y(2.0), 1.0, true),
            (DQuat::IDENTITY, -1.0, true),
        ] {
            let mut json = json.clone();
            let nodes = json["nodes"].as_array_mut().unwrap();
            if !named {
                nodes.iter_mut().for_each(|node| drop(node.as_object_mut().unwrap().remove("name")));
            }
            let roots = json["scenes"][0]["nodes"].take();
            let nodes = json["nodes"].as_array_mut().unwrap();
            nodes.push(json!({ "children": roots, "rotation": turn.to_array(), "scale": [mirror, 1.0, 1.0] }));
            json["scenes"][0]["nodes"] = json!([nodes.len() - 1]);
            let document = Document::from_bytes(&crate::support::put_together(&json, &bin)).unwrap();
            let measured = Measurement::of(&document);
            let forward = turn * (whole.forward * DVec3::new(mirror, 1.0, 1.0));
            let what = format!("{} {turn} {mirror} {named}: {:?}", file.display(), measured.evidence);
            assert!(measured.up.distance(turn * DVec3::Y) < 1e-6, "{what}");
            assert!(measured.forward.dot(forward) > 0.997, "{what}");
            assert_eq!(head(&measured, &document), head(&whole, &whole_document), "{what}");
        }
    }
}

/// Name of a bone, its axes, and the deviations of its up, forward and left from them, degrees.
type Expected = (&'static str, &'static str, [f64; 3]);

/// Axes and deviations of bones in the rest pose, as measured by an independent script from the same nodes, to a tenth
/// of a degree.
const REST: &[(&str, &[Expected])] = &[
    (
        "dude.glb",
        &[
            ("Pelvis", "+X +Y +Z", [2.5, 7.4, 7.7]),
            ("Spine", "+X +Y +Z", [5.1, 8.8, 7.7]),
            ("Spine1", "+X +Y +Z", [11.1, 12.2, 5.5]),
            ("Spine2", "+X +Y +Z", [7.9, 7.3, 4.6]),
            ("Spine3", "+X +Y +Z", [8.0, 4.9, 6.4]),
            ("Neck", "+X +Y +Z", [24.7, 25.3, 8.0]),
            ("Head", "+X +Y +Z", [9.2, 11.1, 6.2]),
            ("L_eye_joint1", "-Z +Y +X", [20.0, 20.3, 3.6]),
            ("R_eye_joint", "-Z +Y +X", [20.0, 20.3, 3.6]),
            ("L_eyeBall_joint2", "+X +Y +Z", [15.3, 15.9, 4.3]),
            ("R_eyeBall_joint", "+X +Y +Z", [15.3, 15.9, 4.3]),
        ],
    ),
    (
        "rocketbox_female_adult_01.glb",
        &[
            ("Bip01 Pelvis", "+X +Y +Z", [0.0, 0.0, 0.0]),
            ("Bip01 Spine", "+X +Y +Z", [1.2, 1.2, 0.0]),
            ("Bip01 Spine1", "+X +Y +Z", [6.2, 6.2, 0.0]),
            ("Bip01 Spine2", "+X +Y +Z", [9.2, 9.2, 0.0]),
            ("Bip01 Neck", "+X +Y +Z", [12.8, 12.8, 0.0]),
            ("Bip01 Head", "+X +Y +Z", [9.1, 9.1, 0.0]),
            ("Bip01 LEye", "-Y +X +Z", [0.6, 0.6, 0.0]),
            ("Bip01 REye", "-Y +X +Z", [0.6, 0.6, 0.0]),
        ],
    ),
    (
        "khronos_fox.glb",
        &[
            ("b_Hip_01", "+X -Y -Z", [20.8, 20.8, 0.0]),
            ("b_Spine01_02", "+Y +X -Z", [3.2, 3.2, 0.0]),
            ("b_Spine02_03", "+Y +X -Z", [1.2, 1.2, 0.0]),
            ("b_Neck_04", "+Y +X -Z", [34.1, 34.1, 0.0]),
            ("b_Head_05", "+Y +X -Z", [13.1, 13.1, 0.0]),
        ],
    ),
    (
        "quaternius_robot.glb",
        &[
            ("Head", "+Y +Z +X", [1.1, 1.1, 0.2]),
            ("Neck", "+Y +Z +X", [1.3, 1.3, 0.0]),
            ("Torso", "+Y +Z +X", [6.2, 6.2, 0.0]),
            ("Abdomen", "+Y +Z +X", [0.4, 0.4, 0.0]),
            ("Hips", "+Y +Z +X", [13.7, 13.7, 0.0]),
        ],
    ),
    (
        "pab_arnaud.glb",
        &[
            ("Pelvis", "+X +Y +Z", [0.0, 0.0, 0.0]),
            ("Spine3", "+X +Y +Z", [0.0, 0.0, 0.0]),
            ("Neck", "+X +Y +Z", [1.8, 1.8, 0.0]),
            ("Head", "+X +Y +Z", [4.3, 4.3, 0.0]),
        ],
    ),
    (
        "quaternius_horse.glb",
        &[
            ("Hips", "+Z +Y -X", [2.0, 2.0, 0.0]),
            ("Torso", "+Z +Y -X", [4.1, 4.4, 1.6]),
            ("Neck", "+Y -Z -X", [42.6, 42.6, 0.0]),
            ("Head", "+Z +Y -X", [43.6, 33.2, 30.0]),
        ],
    ),
    (
        "cesium_man.gltf",
        &[
            ("node11", "+Y +Z +X", [3.5, 3.5, 0.0]),
            ("node12", "+Z -Y +X", [9.5, 9.5, 0.0]),
            ("node19", "+Y +Z +X", [2.2, 2.2, 0.0]),
            ("node20", "+Y -Z -X", [0.6, 0.6, 0.0]),
        ],
    ),
];

#[test]
#[ignore = "needs AIM_RIGS"]
fn the_rest_pose_is_measured_as_an_independent_script_measures_it() {
    for (file, bones) in REST {
        let (document, _) = measured(file);
        let rest = Measurement::in_pose(&document, MeasuredPose::Rest);
        for (name, axes, deviations) in *bones {
            let bone = rest.bone(document.skeleton().find(name).unwrap()).unwrap();
            assert_eq!(format!("{} {} {}", bone.up, bone.forward, bone.left), *axes, "{file}: {name}");
            for (found, expected) in bone.deviations_deg.iter().zip(deviations) {
                assert!((found - expected).abs() < 0.11, "{file}: {name}: {found} instead of {expected}");
            }
        }
    }
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn facing_and_roles_of_real_rigs_are_measured() {
    use aim_runtime::glam::DVec3;
    type Column<'a> = (&'a str, &'a [&'a str], &'a [&'a str], &'a str);
    let files: [(&str, DVec3, Column<'_>); 7] = [
        ("dude.glb", DVec3::NEG_Z, ("Pelvis", &["Spine", "Spine1", "Spine2", "Spine3"], &["Neck"], "Head")),
        (
            "rocketbox_female_adult_01.glb",
            DVec3::Z,
            ("Bip01 Pelvis", &["Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2"], &["Bip01 Neck"], "Bip01 Head"),
        ),
        ("khronos_fox.glb", DVec3::Z, ("b_Hip_01", &["b_Spine01_02", "b_Spine02_03"], &["b_Neck_04"], "b_Head_05")),
        ("quaternius_robot.glb", DVec3::Z, ("Hips", &["Abdomen", "Torso"], &["Neck"], "Head")),
        ("pab_arnaud.glb", DVec3::Z, ("Pelvis", &["Spine", "Spine1", "Spine2", "Spine3"], &["Neck"], "Head")),
        ("quaternius_horse.glb", DVec3::Z, ("Hips", &["Torso"], &["Neck"], "Head")),
        ("cesium_man.gltf", DVec3::X, ("node2", &["node11", "node12"], &["node19"], "node20")),
    ];
    for (file, forward, (hips, spine, neck, head)) in files {
        let (_, measured) = measured(file);
        assert_eq!(measured.up, DVec3::Y, "{file}");
        // The thug's chest is turned by 4° relative to its hips.
        assert!(measured.forward.dot(forward) > 0.997, "{file}: {} by {:?}", measured.forward, measured.evidence);
        let of = |role: Role| {
            let mut names: Vec<&str> =
                measured.bones.iter().filter(|b| b.role == Some(role)).map(|b| b.name.as_str()).collect();
            names.sort_unstable();
            names
        };
        assert_eq!((of(Role::Hips), of(Role::Head)), (vec![hips], vec![head]), "{file}");
        assert_eq!((of(Role::Spine), of(Role::Neck)), (spine.to_vec(), neck.to_vec()), "{file}");
    }
}

#[track_caller]
fn expect(file: &(Document, Measurement), bone: &str, axes: &str, deviation_deg: f64) {
    let bone = file.1.bone(file.0.skeleton().find(bone).unwrap()).unwrap();
    assert_eq!(format!("{} {} {}", bone.up, bone.forward, bone.left), axes, "{}", bone.name);
    // The numbers compared here are this project's own measurements of the bind pose.
    assert!(
        (bone.deviation_deg - deviation_deg).abs() < 1.0,
        "{}: {} instead of {deviation_deg}",
        bone.name,
        bone.deviation_deg
    );
}

#[track_caller]
fn expect_role(file: &(Document, Measurement), role: Role, name: &str) {
    assert_eq!(file.1.with_role(role).unwrap().name, name);
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn dude_has_the_papers_axes_and_faces_minus_z() {
    let file = measured("dude.glb");
    assert!(file.1.forward.z < -0.99 && file.1.left.x < -0.99, "{}", file.1.forward);
    for (bone, deviation) in
        [("Spine", 6.7), ("Spine1", 12.0), ("Spine2", 7.3), ("Spine3", 4.7), ("Neck", 20.8), ("Head", 9.7)]
    {
        expect(&file, bone, "+X +Y +Z", deviation);
    }
    expect(&file, "L_eyeBall_joint2", "+X +Y +Z", 9.5);
    expect(&file, "R_eyeBall_joint", "+X +Y +Z", 10.5);
    expect(&file, "L_eye_joint1", "-Z +Y +X", 9.5);
    expect_role(&file, Role::LeftEye, "L_eyeBall_joint2");
    expect_role(&file, Role::RightEye, "R_eyeBall_joint");
    expect_role(&file, Role::Head, "Head");
    expect_role(&file, Role::Hips, "Pelvis");
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn rocketbox_eyes_have_other_axes_than_their_head() {
    let file = measured("rocketbox_female_adult_01.glb");
    expect(&file, "Bip01 LEye", "-Y +X +Z", 0.6);
    expect(&file, "Bip01 REye", "-Y +X +Z", 0.6);
    expect(&file, "Bip01 Head", "+X +Y +Z", 9.1);
    expect(&file, "Bip01 Neck", "+X +Y +Z", 12.8);
    expect_role(&file, Role::LeftEye, "Bip01 LEye");
    expect_role(&file, Role::RightEye, "Bip01 REye");
    assert_eq!(file.1.bones.iter().filter(|b| b.role == Some(Role::Spine)).count(), 3);
    assert!((file.1.height - 1.74).abs() < 0.03, "{}", file.1.height);
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn fox_robot_and_arnaud() {
    let file = measured("khronos_fox.glb");
    expect(&file, "b_Hip_01", "+X -Y -Z", 20.8);
    expect(&file, "b_Spine02_03", "+Y +X -Z", 1.2);
    expect(&file, "b_Neck_04", "+Y +X -Z", 34.1);
    expect(&file, "b_Head_05", "+Y +X -Z", 13.1);
    let file = measured("quaternius_robot.glb");
    for (bone, deviation) in [("Abdomen", 0.4), ("Torso", 6.2), ("Neck", 1.3), ("Head", 1.1), ("Hips", 13.7)] {
        expect(&file, bone, "+Y +Z +X", deviation);
    }
    let file = measured("pab_arnaud.glb");
    for (bone, deviation) in [("Pelvis", 0.0), ("Spine", 0.0), ("Spine3", 0.0), ("Neck", 1.8), ("Head", 4.3)] {
        expect(&file, bone, "+X +Y +Z", deviation);
    }
    expect(&file, "Hips", "+Z +X +Y", 0.0);
    expect_role(&file, Role::Hips, "Pelvis");
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn the_horse_and_the_nameless_walker_are_measured() {
    let file = measured("quaternius_horse.glb");
    expect(&file, "Hips", "+Z +Y -X", 2.0);
    expect(&file, "Neck", "+Y -Z -X", 42.6);
    expect(&file, "Head", "+Z +Y -X", 43.6);
    let file = measured("cesium_man.gltf");
    assert!(file.1.forward.x > 0.999, "{}", file.1.forward);
    expect(&file, "node12", "+Z -Y +X", 9.5);
    expect(&file, "node19", "+Y +Z +X", 2.2);
    expect(&file, "node20", "+Y -Z -X", 0.6);
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn every_rig_is_written_with_one_more_clip() {
    for file in ["dude.glb", "quaternius_robot.glb", "cesium_man.gltf", "pab_arnaud.glb"] {
        let (document, _) = measured(file);
        let clip = document.clips()[0].repeated(4.0).with_name("longer");
        let written = Document::from_bytes(&document.with_clips(&[clip]).unwrap()).unwrap();
        assert_eq!(written.clips().len(), document.clips().len() + 1);
        let skeleton = document.skeleton();
        for t in [0.1, 0.9, 1.9] {
            let period = document.clips()[0].length_s();
            let (a, b) = (
                skeleton.pose(&document.clips()[0], t % period),
                written.skeleton().pose(written.clip("longer").unwrap(), t),
            );
            for (a, b) in skeleton.world_f64(&a).iter().zip(skeleton.world_f64(&b)) {
                assert!(
                    (a.translation - b.translation).length() < 1e-3 * (1.0 + a.translation.length()),
                    "{file} at {t}"
                );
            }
        }
    }
}
