//! Chains proposed for bodies with an unusual root, neck or naming.

use aim_character::{Clue, Measurement, propose};
use aim_codegen::{Budgets, Role};
use aim_gltf::Document;
use serde_json::{Value, json};

/// A bone: its name, its parent's name, and its position in world space, in which the body faces +Z.
type Bone<'a> = (&'a str, &'a str, [f64; 3]);

fn document(bones: &[Bone<'_>]) -> Document {
    let at = |name: &str| bones.iter().position(|bone| bone.0 == name);
    let mut nodes: Vec<Value> = Vec::new();
    for (index, (name, parent, place)) in bones.iter().enumerate() {
        let from = at(parent).map_or([0.0; 3], |parent| bones[parent].2);
        let step: Vec<f64> = (0..3).map(|axis| place[axis] - from[axis]).collect();
        let children: Vec<usize> = (0..bones.len()).filter(|child| at(bones[*child].1) == Some(index)).collect();
        let mut node = json!({ "name": name, "translation": step });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        nodes.push(node);
    }
    let joints: Vec<usize> = (0..bones.len()).collect();
    let json = json!({
        "asset": { "version": "2.0" }, "nodes": nodes, "skins": [{ "joints": joints }],
        "scene": 0, "scenes": [{ "nodes": [0] }],
    });
    Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap()
}

/// A document with pairs of limbs. Each limb bone is given with `*` for the side in its name and its parent's, and its
/// position on the left.
fn with_limbs<'a>(column: &[Bone<'a>], limbs: &[Bone<'a>]) -> Document {
    let bones = both_sides(column, limbs);
    document(&bones.iter().map(|(name, parent, place)| (&name[..], &parent[..], *place)).collect::<Vec<_>>())
}

fn both_sides(column: &[Bone<'_>], limbs: &[Bone<'_>]) -> Vec<(String, String, [f64; 3])> {
    let limbs = limbs.iter().flat_map(|(name, parent, [x, y, z])| {
        let side = |side: &str, x: f64| (name.replace('*', side), parent.replace('*', side), [x, *y, *z]);
        [side("L", *x), side("R", -x)]
    });
    column.iter().map(|(name, parent, place)| ((*name).to_owned(), (*parent).to_owned(), *place)).chain(limbs).collect()
}

/// Proposes a chain after replacing all names by numbers; returns the original names with the roles, or `None` without
/// a chain.
fn proposed_without_names(column: &[Bone<'_>], limbs: &[Bone<'_>]) -> Option<Vec<(String, Role)>> {
    let bones = both_sides(column, limbs);
    let number = |name: &str| bones.iter().position(|bone| bone.0 == name).map_or(String::new(), |at| at.to_string());
    let numbered: Vec<_> = bones.iter().map(|(name, parent, place)| (number(name), number(parent), *place)).collect();
    let numbered: Vec<_> = numbered.iter().map(|(name, parent, place)| (&name[..], &parent[..], *place)).collect();
    let document = document(&numbered);
    let spec = propose(&document, &Measurement::of(&document), None).ok()?.spec;
    let name = |number: &String| bones[number.parse::<usize>().unwrap()].0.clone();
    Some(spec.joints.iter().map(|joint| (name(&joint.bones[0]), joint.role)).collect())
}

fn proposed(document: &Document) -> (Vec<String>, Option<Budgets>) {
    let spec = propose(document, &Measurement::of(document), None).unwrap().spec;
    (spec.joints.iter().map(|joint| joint.bones[0].clone()).collect(), spec.region)
}

/// The model of a dog in `MuJoCo`'s suite: its root is the chest, its bones have anatomical names, and its tail is
/// longer than its neck.
#[test]
fn a_dog_whose_root_is_its_chest_looks_with_its_skull() {
    let mut column = vec![
        ("torso", "", [0.0, 0.6, 0.1]),
        ("L_1", "torso", [0.0, 0.62, -0.1]),
        ("L_2", "L_1", [0.0, 0.62, -0.2]),
        ("pelvis", "L_2", [0.0, 0.6, -0.3]),
        ("C_2", "torso", [0.0, 0.66, 0.25]),
        ("C_1", "C_2", [0.0, 0.72, 0.32]),
        ("skull", "C_1", [0.0, 0.78, 0.38]),
        ("jaw", "skull", [0.0, 0.74, 0.42]),
    ];
    let names: Vec<String> = (1..=9).map(|number| format!("Ca_{number}")).collect();
    for (index, name) in names.iter().enumerate() {
        let parent = if index == 0 { "pelvis" } else { &names[index - 1] };
        column.push((name, parent, [0.0, 0.6 - 0.02 * index as f64, -0.35 - 0.04 * index as f64]));
    }
    let dog = with_limbs(
        &column,
        &[
            ("scapula_*", "torso", [0.05, 0.62, 0.2]),
            ("upper_arm_*", "scapula_*", [0.06, 0.45, 0.25]),
            ("lower_arm_*", "upper_arm_*", [0.06, 0.25, 0.18]),
            ("hand_*", "lower_arm_*", [0.06, 0.02, 0.2]),
            ("upper_leg_*", "pelvis", [0.06, 0.55, -0.3]),
            ("lower_leg_*", "upper_leg_*", [0.06, 0.3, -0.25]),
            ("foot_*", "lower_leg_*", [0.06, 0.05, -0.35]),
            ("toe_*", "foot_*", [0.06, 0.01, -0.3]),
        ],
    );
    let (chain, region) = proposed(&dog);
    assert_eq!(chain, ["skull", "C_1", "C_2"]);
    assert_eq!(region, Some(Budgets::QUADRUPED));
    assert_eq!(Measurement::of(&dog).forward.round().to_array(), [0.0, 0.0, 1.0]);
}

/// A neck in which only some bones have recognisable names; and a single bone for neck and head on four legs.
#[test]
fn bones_between_neck_and_head_are_neck_bones() {
    let legs = [
        ("ForeLeg_*_01", "Chest", [0.1, 0.8, 0.3]),
        ("ForeLeg_*_02", "ForeLeg_*_01", [0.1, 0.4, 0.3]),
        ("ForeLeg_*_03", "ForeLeg_*_02", [0.1, 0.0, 0.35]),
        ("HindLeg_*_01", "Pelvis", [0.1, 0.8, -0.5]),
        ("HindLeg_*_02", "HindLeg_*_01", [0.1, 0.4, -0.5]),
        ("HindLeg_*_03", "HindLeg_*_02", [0.1, 0.0, -0.45]),
    ];
    let trunk = [("Pelvis", "", [0.0, 0.9, -0.5]), ("Chest", "Pelvis", [0.0, 0.95, 0.2])];
    let neck = [
        ("vertebra_cervical_1", "Chest", [0.0, 1.0, 0.4]),
        ("vertebra_axis", "vertebra_cervical_1", [0.0, 1.05, 0.5]),
        ("skull", "vertebra_axis", [0.0, 1.05, 0.6]),
    ];
    let (chain, region) = proposed(&with_limbs(&[&trunk[..], &neck].concat(), &legs));
    assert_eq!(chain, ["skull", "vertebra_axis", "vertebra_cervical_1"]);
    assert_eq!(region, Some(Budgets::QUADRUPED));
    let (chain, region) = proposed(&with_limbs(&[&trunk[..], &[("Neck", "Chest", [0.0, 0.9, 0.6])]].concat(), &legs));
    assert_eq!(chain, ["Neck"]);
    assert_eq!(region, Some(Budgets::QUADRUPED));
}

/// In a body without a neck, the bone that carries the legs is not part of the gaze chain.
#[test]
fn a_character_of_blocks_turns_only_its_head() {
    let blocks = with_limbs(
        &[("Player", "", [0.0; 3]), ("Body", "Player", [0.0, 0.7, 0.0]), ("Head", "Body", [0.0, 1.4, 0.0])],
        &[("Arm_*", "Body", [0.3, 1.3, 0.0]), ("Leg_*", "Body", [0.1, 0.7, 0.0])],
    );
    assert_eq!(proposed(&blocks).0, ["Head"]);
}

/// In a rig whose control bones are its bones, the skin is bound to the controls.
#[test]
fn control_bones_count_if_no_bone_is_the_head() {
    let column = |head| {
        [("CTRL_Pelvis", "", [0.0, 0.8, 0.0]), ("CTRL_RibCage", "CTRL_Pelvis", [0.0, 1.0, 0.0])]
            .into_iter()
            .chain([(head, "CTRL_RibCage", [0.0, 1.4, 0.0])])
            .collect::<Vec<_>>()
    };
    assert_eq!(proposed(&document(&column("CTRL_Head"))).0, ["CTRL_Head", "CTRL_RibCage"]);
    assert_eq!(proposed(&document(&column("Head"))).0[0], "Head");
}

/// A human column with collarbones that begin near the middle and are longer than the neck, and with pouches below the
/// arms.
#[test]
fn collarbones_near_the_middle_are_no_neck_and_pouches_are_no_arms() {
    let column = [
        ("hips", "", [0.0, 1.0, 0.0]),
        ("spine", "hips", [0.0, 1.15, 0.0]),
        ("chest", "spine", [0.0, 1.3, 0.0]),
        ("neck", "chest", [0.0, 1.6, 0.0]),
        ("head", "neck", [0.0, 1.7, 0.0]),
    ];
    for middle in [0.01, 0.0] {
        let limbs = [
            ("collar*", "chest", [middle, 1.55, 0.05]),
            ("upper_arm*", "collar*", [0.2, 1.55, 0.0]),
            ("forearm*", "upper_arm*", [0.45, 1.4, 0.0]),
            ("hand*", "forearm*", [0.65, 1.3, 0.0]),
            ("pouch*", "spine", [0.2, 1.1, 0.0]),
            ("strap*", "pouch*", [0.2, 1.2, 0.0]),
            ("thigh*", "hips", [10.0 * middle, 0.95, 0.0]),
            ("shin*", "thigh*", [0.1, 0.5, 0.0]),
            ("foot*", "shin*", [0.1, 0.1, -0.03]),
            ("toe*", "foot*", [0.1, 0.02, 0.08]),
        ];
        let chain = proposed_without_names(&column, &limbs).unwrap();
        let expected = ["head", "neck", "chest", "spine"].map(str::to_owned);
        let roles = [Role::Head, Role::Neck, Role::Chest, Role::Chest];
        assert_eq!(chain, expected.into_iter().zip(roles).collect::<Vec<_>>(), "{middle} m beside the middle");
    }
}

/// If limbs descend from the root in two directions, the root may be a chest, and its legs may be arms or ears.
#[test]
fn a_nameless_body_that_may_look_either_way_has_no_plan() {
    let column = [
        ("chest", "", [0.0, 1.05, 0.2]),
        ("back", "chest", [0.0, 1.05, -0.2]),
        ("hips", "back", [0.0, 1.0, -0.6]),
        ("neck", "chest", [0.0, 1.1, 0.5]),
        ("head", "neck", [0.0, 1.1, 0.8]),
        ("snout", "head", [0.0, 0.9, 1.1]),
    ];
    let limbs = [
        ("foreleg*", "chest", [0.3, 0.9, 0.2]),
        ("paw*", "foreleg*", [0.3, 0.05, 0.2]),
        ("thigh*", "hips", [0.2, 0.9, -0.6]),
        ("foot*", "thigh*", [0.2, 0.05, -0.6]),
        ("ear*", "head", [0.1, 1.2, 0.8]),
        ("lobe*", "ear*", [0.4, 1.6, 0.8]),
    ];
    assert_eq!(proposed_without_names(&column, &limbs), None);
}

/// Animals of Rigify: the column is numbered from the tip of the tail, and its last bone is the head.
#[test]
fn a_numbered_column_ends_in_the_head_and_forelegs_hang_on_its_trunk() {
    let wolf = [
        ("spine.002", "", [0.0, 0.8, -0.4]),
        ("spine.001", "spine.002", [0.0, 0.75, -0.5]),
        ("spine", "spine.001", [0.0, 0.7, -0.8]),
        ("spine.003", "spine.002", [0.0, 0.8, -0.3]),
        ("spine.004", "spine.003", [0.0, 0.8, -0.1]),
        ("spine.005", "spine.004", [0.0, 0.8, 0.1]),
        ("spine.006", "spine.005", [0.0, 0.85, 0.3]),
        ("spine.007", "spine.006", [0.0, 0.9, 0.5]),
        ("spine.008", "spine.007", [0.0, 0.9, 0.6]),
    ];
    let legs = [
        ("shoulder.*", "spine.004", [0.06, 0.85, 0.2]),
        ("front_shin.*", "shoulder.*", [0.12, 0.4, 0.2]),
        ("front_foot.*", "front_shin.*", [0.12, 0.02, 0.2]),
        ("thigh.*", "spine.003", [0.12, 0.7, -0.4]),
        ("shin.*", "thigh.*", [0.12, 0.4, -0.4]),
        ("foot.*", "shin.*", [0.12, 0.02, -0.4]),
    ];
    let wolf = with_limbs(&wolf, &legs);
    let expected = ["spine.008", "spine.007", "spine.006", "spine.005"].map(str::to_owned).to_vec();
    assert_eq!(proposed(&wolf), (expected, Some(Budgets::QUADRUPED)));
    let spec = propose(&wolf, &Measurement::of(&wolf), None).unwrap().spec;
    assert_eq!(spec.joints.last().unwrap().role, Role::Neck);
    // In a shark, the bone with the highest number is in the middle, and the jaws are not arms.
    let shark = [
        ("spine.002", "", [0.0, 0.4, -0.3]),
        ("spine.001", "spine.002", [0.0, 0.4, -0.7]),
        ("spine", "spine.001", [0.0, 0.4, -1.0]),
        ("spine.007", "spine.002", [0.0, 0.4, 0.0]),
        ("spine.003", "spine.007", [0.0, 0.4, 0.3]),
        ("spine.004", "spine.003", [0.0, 0.4, 0.6]),
        ("spine.005", "spine.004", [0.0, 0.4, 1.2]),
        ("spine.006", "spine.005", [0.0, 0.4, 1.5]),
        ("jaw", "spine.006", [0.0, 0.3, 1.6]),
        ("chin", "jaw", [0.0, 0.3, 1.7]),
    ];
    let fins = [
        ("shoulder.*", "spine.004", [0.07, 0.4, 1.0]),
        ("side_fin.*", "shoulder.*", [0.5, 0.3, 0.9]),
        ("jaw.001.*", "jaw", [0.1, 0.3, 1.6]),
        ("jaw.002.*", "jaw.001.*", [0.1, 0.3, 1.7]),
    ];
    let shark = with_limbs(&shark, &fins);
    assert_eq!(proposed(&shark).0, ["spine.006", "spine.005"]);
    let spec = propose(&shark, &Measurement::of(&shark), None).unwrap().spec;
    assert!(spec.joints.iter().all(|joint| joint.hold.is_none()), "{:?}", spec.joints);
}

/// A giraffe whose hips have no recognisable name, and whose head is above them rather than ahead; and a coat that
/// reaches the ground.
#[test]
fn limbs_standing_ahead_of_each_other_make_a_quadruped() {
    let giraffe = [
        ("root", "", [0.0, 1.5, -0.5]),
        ("spine", "root", [0.0, 1.5, -0.2]),
        ("spine_neck", "spine", [0.0, 1.7, 0.1]),
        ("neck", "spine_neck", [0.0, 1.8, 0.4]),
        ("head", "neck", [0.0, 3.0, 0.6]),
    ];
    let limbs = [
        ("shoulder_*", "spine_neck", [0.0, 1.8, 0.4]),
        ("upperarm_*", "shoulder_*", [0.2, 1.5, 0.4]),
        ("hand_*", "upperarm_*", [0.2, 0.1, 0.4]),
        ("thigh_*", "root", [0.2, 1.5, -0.5]),
        ("foot_*", "thigh_*", [0.2, 0.1, -0.5]),
    ];
    let expected = ["head", "neck"].map(str::to_owned).to_vec();
    assert_eq!(proposed(&with_limbs(&giraffe, &limbs)), (expected, Some(Budgets::QUADRUPED)));
    let column =
        [("root", "", [0.0, 1.0, 0.0]), ("spine", "root", [0.0, 1.2, 0.0]), ("head", "spine", [0.0, 1.6, 0.0])];
    let legs_and_coat = [
        ("thigh_*", "root", [0.1, 0.9, 0.0]),
        ("foot_*", "thigh_*", [0.1, 0.1, 0.0]),
        ("coat_*", "root", [0.1, 1.0, -0.15]),
        ("hem_*", "coat_*", [0.2, 0.1, -0.5]),
    ];
    let expected = ["head", "spine"].map(str::to_owned).to_vec();
    assert_eq!(proposed(&with_limbs(&column, &legs_and_coat)), (expected, Some(Budgets::HUMAN)));
}

/// A hen by her bones' names; a gull by its span, with wings attached to the body; and an angel, who also has arms.
#[test]
fn wings_instead_of_arms_make_a_bird() {
    let upright = [("Body", "", [0.0, 0.6, 0.0]), ("Neck", "Body", [0.0, 0.9, 0.3]), ("Head", "Neck", [0.0, 1.3, 0.4])];
    let legs = [("Leg_*", "Body", [0.1, 0.5, 0.0]), ("Foot_*", "Leg_*", [0.1, 0.0, 0.0])];
    let wings = [("Wing_*", "Body", [0.2, 0.9, 0.2]), ("WingTip_*", "Wing_*", [0.3, 0.7, 0.0])];
    let arms = [("Arm_*", "Body", [0.2, 0.9, 0.2]), ("Hand_*", "Arm_*", [0.3, 0.5, 0.2])];
    let hen = proposed(&with_limbs(&upright, &[legs, wings].concat()));
    assert_eq!((&hen.0[..], hen.1), (&["Head", "Neck"].map(str::to_owned)[..], Some(Budgets::BIRD)));
    assert_eq!(proposed(&with_limbs(&upright, &[legs, wings, arms].concat())).1, Some(Budgets::HUMAN));
    let gull = with_limbs(
        &[
            ("Armature", "", [0.0; 3]),
            ("Body", "Armature", [0.0, 0.1, 0.0]),
            ("Head", "Body", [0.0, 0.1, 1.0]),
            ("Tail", "Body", [0.0, 0.1, -0.1]),
        ],
        &[
            ("Humerus_*", "Body", [0.3, 0.1, 0.6]),
            ("Ulna_*", "Humerus_*", [1.3, 0.2, 0.4]),
            ("Digit_*", "Ulna_*", [2.6, 0.25, 0.7]),
        ],
    );
    assert_eq!(proposed(&gull), (vec!["Head".to_owned()], Some(Budgets::BIRD)));
}

/// A crocodile whose root is its chest, and a shark with all bones at one height.
#[test]
fn a_tail_is_no_head_and_lies_behind_it() {
    let crocodile = with_limbs(
        &[
            ("Spine1", "", [0.0, 1.2, 1.7]),
            ("Neck", "Spine1", [0.0, 1.2, 1.8]),
            ("TopJaw", "Neck", [0.0, 1.5, 2.7]),
            ("Spine2", "Spine1", [0.0, 1.2, -0.2]),
            ("Tail1", "Spine2", [0.0, 1.2, -1.5]),
            ("Tail2", "Tail1", [0.0, 1.1, -3.2]),
        ],
        &[
            ("Front*Knee", "Spine1", [0.7, 1.0, 1.5]),
            ("Front*Foot", "Front*Knee", [0.9, 0.0, 1.5]),
            ("Back*Knee", "Spine2", [0.8, 1.0, -1.3]),
            ("Back*Foot", "Back*Knee", [0.9, 0.0, -1.5]),
        ],
    );
    assert_eq!(proposed(&crocodile), (vec!["Neck".to_owned()], Some(Budgets::QUADRUPED)));
    let shark = document(&[
        ("Armature", "", [0.0; 3]),
        ("Head", "Armature", [0.0, -0.2, 2.3]),
        ("Front", "Armature", [0.0, -0.2, 2.2]),
        ("Middle", "Front", [0.0, -0.2, 0.8]),
        ("Back", "Middle", [0.0, -0.2, -1.7]),
        ("Tail", "Back", [0.0, -0.2, -2.9]),
        ("LeftFin", "Front", [0.0, -0.2, 0.8]),
        ("RightFin", "Front", [0.0, -0.2, 0.8]),
    ]);
    assert_eq!(proposed(&shark).0, ["Head"]);
    let measured = Measurement::of(&shark);
    assert_eq!(measured.forward.to_array(), [0.0, 0.0, 1.0], "{:?}", measured.evidence);
    assert!(measured.evidence.iter().all(|said| said.clue != Clue::Feet), "{:?}", measured.evidence);
}
