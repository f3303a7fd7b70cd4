//! Documents built from bones alone, without a file.

use aim_animation::glam::{Affine3A, DAffine3, Quat, Vec3};
use aim_animation::{Bone, Skeleton, Transform};
use aim_character::{Measurement, PAPER_AXES, Role, mannequin, propose};
use aim_gltf::{Document, Error};

/// Returns an engine's knowledge of a character: its bones, with the head turned aside at rest, and their transforms
/// when its mesh was bound.
fn known_of(document: &Document) -> (Skeleton, Vec<Option<Affine3A>>) {
    let of_file = document.skeleton();
    let neck = of_file.find("neck").unwrap();
    let bones = of_file.names().iter().zip(of_file.parents()).zip(of_file.rest()).enumerate();
    let skeleton = Skeleton::new(bones.map(|(bone, ((name, parent), &rest))| {
        let turn = if bone == neck { Quat::from_rotation_x(0.7) } else { Quat::IDENTITY };
        Bone::new(&**name, *parent).with_rest(Transform { rotation: rest.rotation * turn, ..rest })
    }));
    let single =
        |bind: DAffine3| Affine3A { matrix3: bind.matrix3.as_mat3().into(), translation: bind.translation.as_vec3a() };
    (skeleton.unwrap(), of_file.nodes().iter().map(|node| node.inverse_bind.map(single)).collect())
}

#[test]
fn bones_give_the_same_axes_and_rig_as_the_file() {
    const UPRIGHT: [[f32; 3]; 3] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    for other in [PAPER_AXES, UPRIGHT] {
        let axes = |bone: &str| if bone.len() % 2 == 0 { PAPER_AXES } else { other };
        let file = Document::from_bytes(&mannequin(axes).unwrap()).unwrap();
        let (skeleton, binds) = known_of(&file);
        let document = Document::of_bones(&skeleton, &binds).unwrap();
        assert_eq!(document.skeleton().names(), skeleton.names());
        assert_eq!(document.skeleton().parents(), skeleton.parents());
        let (of_bones, of_file) = (Measurement::of(&document), Measurement::of(&file));
        assert_eq!(of_bones.bones.len(), of_file.bones.len());
        for (own, other) in of_bones.bones.iter().zip(&of_file.bones) {
            assert_eq!((&own.name, own.role), (&other.name, other.role));
            assert_eq!((own.up, own.forward, own.left), (other.up, other.forward, other.left), "{}", own.name);
            assert!(own.frame.forward.distance(other.frame.forward) < 1e-6, "{}", own.name);
        }
        let [own, other] = [(&document, &of_bones), (&file, &of_file)]
            .map(|(document, measured)| propose(document, measured, None).unwrap().spec);
        assert_eq!(own.joints, other.joints);
    }
}

/// Bones without a bound mesh are measured in their rest pose, and clips are written for them.
#[test]
fn bones_need_no_binds_and_no_order() {
    let at = |y| Transform::from_translation(Vec3::Y * y);
    let bones = [
        Bone::new("Head", Some(2)).with_rest(at(0.2)),
        Bone::new("Hips", None).with_rest(at(1.0)),
        Bone::new("Spine", Some(1)).with_rest(at(0.4)),
        Bone::new("LeftUpLeg", Some(1)).with_rest(Transform::from_translation(Vec3::new(0.1, -0.1, 0.0))),
        Bone::new("RightUpLeg", Some(1)).with_rest(Transform::from_translation(Vec3::new(-0.1, -0.1, 0.0))),
    ];
    let skeleton = Skeleton::new(bones).unwrap();
    let document = Document::of_bones(&skeleton, &[None; 5]).unwrap();
    assert_eq!(document.skeleton().names(), skeleton.names());
    let measured = Measurement::of(&document);
    assert_eq!(measured.forward.round().to_array(), [0.0, 0.0, 1.0]);
    assert_eq!(measured.with_role(Role::Head).unwrap().name, "Head");
    let turned = aim_animation::Track::constant(Quat::from_rotation_y(0.5)).unwrap();
    let head = document.skeleton().find("Head").unwrap();
    let written = document.with_clips(&[aim_animation::Clip::new("aside").with_rotation(head, turned)]).unwrap();
    assert_eq!(Document::from_bytes(&written).unwrap().clips().len(), 1);
}

#[test]
fn invalid_binds_are_reported() {
    let skeleton = Skeleton::new([Bone::new("Hips", None), Bone::new("Head", Some(0))]).unwrap();
    let message = |binds: &[Option<Affine3A>]| match Document::of_bones(&skeleton, binds) {
        Err(error @ Error::Bones(_)) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(message(&[None]).contains("1 inverse binds for 2 bones, expected one each"));
    let nan = Affine3A::from_translation(Vec3::NAN);
    assert!(message(&[None, Some(nan)]).contains("bone 1, \"Head\", is not finite"));
    assert!(Document::of_bones(&Skeleton::new([]).unwrap(), &[]).unwrap().skeleton().is_empty());
}
