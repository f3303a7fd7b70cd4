//! A model file: an accepted one can be measured, sampled and deformed, and is accepted again after writing.
#![no_main]

use aim_animation::MeshPose;
use aim_animation::glam::{Affine3A, Vec3};
use aim_character::Measurement;
use aim_gltf::{Document, LookAt};
use libfuzzer_sys::{Corpus, fuzz_target};

fuzz_target!(|input: &[u8]| -> Corpus {
    let document = match Document::from_bytes(&aim_fuzz::model_file(input)) {
        Ok(document) => document,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return Corpus::Keep;
        }
    };
    let measured = Measurement::of(&document);
    for axis in [measured.up, measured.forward] {
        assert!((axis.length() - 1.0).abs() < 1e-6, "the character's axis {axis:?}");
    }
    for bone in &measured.bones {
        assert!((0.0..=180.0).contains(&bone.deviation_deg), "{bone:?}");
    }
    if let Some(look_at) = LookAt::of(&document) {
        for degrees in [-200.0, -10.0, 0.0, 1e-300, 200.0] {
            for map in [look_at.horizontal_inner, look_at.horizontal_outer, look_at.vertical_down, look_at.vertical_up]
            {
                assert!(map.apply(degrees).is_finite(), "{look_at:?}");
            }
        }
    }
    for clip in document.clips() {
        let pose = document.skeleton().pose(clip, 0.3 * clip.length_s());
        assert_eq!(document.skeleton().world_f64(&pose).len(), document.skeleton().len());
    }
    let (surface, skeleton) = (document.surface(), document.skeleton());
    let (mesh, skin) = surface.mesh(skeleton);
    let (mut model, mut matrices) = (vec![Affine3A::IDENTITY; skeleton.len()], vec![Affine3A::IDENTITY; skin.len()]);
    skeleton.to_model(skeleton.rest(), &mut model).expect("of one length");
    skin.matrices(&model, &mut matrices).expect("of one length");
    let pose = MeshPose::new(&matrices).with_morph_weights(surface.morph_weights());
    let (mut positions, mut normals) = (mesh.positions().to_vec(), mesh.positions().to_vec());
    mesh.deform(&pose, &mut positions).expect("of one length");
    mesh.deform_normals(&pose, 4, &mut normals).expect("of one length");
    let counts = [normals.len(), surface.texture_coordinates().len(), surface.tints().len()];
    assert_eq!(counts, [positions.len(); 3], "one of each for each vertex");
    assert!(normals.iter().all(|normal| *normal == Vec3::ZERO || (normal.length() - 1.0).abs() < 1e-3));
    assert!(surface.texture_coordinates().iter().all(|at| !at.is_nan()));
    for triangle in surface.triangles() {
        assert!(triangle.vertices.iter().all(|vertex| *vertex < positions.len()), "{triangle:?}");
        assert!(triangle.material.is_none_or(|at| at < surface.materials().len()), "{triangle:?}");
    }
    for material in surface.materials() {
        assert!(material.texture.is_none_or(|texture| texture.image < surface.images().len()), "{material:?}");
        assert!(material.colour.iter().all(|part| (0.0..=1.0).contains(part)), "{material:?}");
    }
    let written = [document.with_clips(document.clips()), document.with_clips_compacted(document.clips())];
    for written in written.into_iter().flatten() {
        let again =
            Document::from_bytes(&written).unwrap_or_else(|error| panic!("what was written is refused: {error}"));
        // Each clip replaces the one with the same name.
        assert_eq!(again.clips().len(), document.clips().len());
    }
    Corpus::Keep
});
