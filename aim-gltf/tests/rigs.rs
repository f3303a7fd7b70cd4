//! Characters that nobody here made, measured; needs the folder that `AIM_RIGS` names.

use std::path::PathBuf;

use aim_gltf::{Document, Measurement, Role};

/// The measured file, or nothing (said plainly) where the rigs are not at hand.
fn measured(file: &str) -> Option<(Document, Measurement)> {
    let Some(folder) = std::env::var_os("AIM_RIGS") else {
        eprintln!("skipped: set AIM_RIGS to the folder with {file} to run this test");
        return None;
    };
    let mut path = PathBuf::from(folder);
    if path.is_relative() {
        // Relative to the repository, as the command that sets it sees it; tests run in the crate's folder.
        path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    }
    let document = Document::load(path.join(file)).unwrap();
    let measured = Measurement::of(&document);
    Some((document, measured))
}

#[track_caller]
fn expect(file: &(Document, Measurement), bone: &str, axes: &str, deviation_deg: f64) {
    let bone = file.1.bone(file.0.skeleton().find(bone).unwrap()).unwrap();
    assert_eq!(format!("{} {} {}", bone.up, bone.forward, bone.left), axes, "{}", bone.name);
    assert!(
        (bone.deviation_deg - deviation_deg).abs() < 2.5,
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
fn dude_has_the_papers_axes_and_faces_minus_z() {
    let Some(file) = measured("dude.glb") else {
        return;
    };
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
fn rocketbox_eyes_have_other_axes_than_their_head() {
    let Some(file) = measured("rocketbox_female_adult_01.glb") else {
        return;
    };
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
fn fox_robot_and_arnaud() {
    if let Some(file) = measured("khronos_fox.glb") {
        expect(&file, "b_Hip_01", "+X -Y -Z", 20.8);
        expect(&file, "b_Spine02_03", "+Y +X -Z", 1.2);
        expect(&file, "b_Neck_04", "+Y +X -Z", 34.1);
        expect(&file, "b_Head_05", "+Y +X -Z", 13.1);
    }
    if let Some(file) = measured("quaternius_robot.glb") {
        for (bone, deviation) in [("Abdomen", 0.4), ("Torso", 6.2), ("Neck", 1.3), ("Head", 1.1), ("Hips", 13.7)] {
            expect(&file, bone, "+Y +Z +X", deviation);
        }
    }
    if let Some(file) = measured("pab_arnaud.glb") {
        for bone in ["Pelvis", "Spine", "Spine3", "Neck", "Head"] {
            expect(&file, bone, "+X +Y +Z", 2.0);
        }
        expect(&file, "Hips", "+Z +X +Y", 0.0);
        expect_role(&file, Role::Hips, "Pelvis");
    }
}

#[test]
fn awkward_ones_horse_and_the_nameless_walker() {
    if let Some(file) = measured("quaternius_horse.glb") {
        expect(&file, "Hips", "+Z +Y -X", 2.0);
        expect(&file, "Neck", "+Y -Z -X", 42.6);
        expect(&file, "Head", "+Z +Y -X", 43.6);
    }
    if let Some(file) = measured("cesium_man.gltf") {
        assert!(file.1.forward.x > 0.999, "{}", file.1.forward);
        expect(&file, "node12", "+Z -Y +X", 9.5);
        expect(&file, "node19", "+Y +Z +X", 2.2);
        expect(&file, "node20", "+Y -Z -X", 0.6);
    }
}

#[test]
fn every_rig_is_written_with_one_more_clip() {
    for file in ["dude.glb", "quaternius_robot.glb", "cesium_man.gltf", "pab_arnaud.glb"] {
        let Some((document, _)) = measured(file) else {
            return;
        };
        let mut clip = document.clips()[0].repeated(4.0);
        clip.name = "longer".into();
        let written = Document::from_bytes(&document.with_clips(&[clip]).unwrap()).unwrap();
        assert_eq!(written.clips().len(), document.clips().len() + 1);
        let skeleton = document.skeleton();
        for t in [0.1, 0.9, 1.9] {
            let period = document.clips()[0].seconds();
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
