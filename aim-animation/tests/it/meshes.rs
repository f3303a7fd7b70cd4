//! Joint matrices, positions and normals of meshes against their definitions in f64: under scale, mirroring and skew.

use aim_animation::glam::{Affine3A, DAffine3, DMat3, DVec3, Mat3, Vec3, Vec3A};
use aim_animation::{
    Bone, Influence, Mesh, MeshError, MeshPose, Morph, Skeleton, Skin, SkinError, Transform, matrix_rows, normal_matrix,
};

use crate::common::{Rng, apart, exact};

/// Tolerance for a figure whose bones are about 2 m around the origin: 1e-5 of its size.
const NEAR: f64 = 4e-5;

/// Returns a chain of bones with branches. Scales differ along the axes and some are negative, so children are skewed.
pub(crate) fn skeleton(rng: &mut Rng, count: usize) -> Skeleton {
    let bone = |bone: usize, rng: &mut Rng| {
        let parent = (bone > 0).then(|| bone - 1 - rng.below(bone.min(2)));
        Bone::new("bone", parent).with_rest(transform(rng))
    };
    let bones: Vec<Bone> = (0..count).map(|at| bone(at, rng)).collect();
    Skeleton::new(bones).unwrap()
}

fn transform(rng: &mut Rng) -> Transform {
    let size = [0; 3].map(|_| rng.between(0.8, 1.25) * if rng.below(5) == 0 { -1.0 } else { 1.0 });
    Transform { translation: rng.vector(0.3), scale: Vec3::from_array(size), ..rng.transform() }
}

pub(crate) fn pose(rng: &mut Rng, skeleton: &Skeleton) -> Vec<Transform> {
    (0..skeleton.len()).map(|_| transform(rng)).collect()
}

/// Returns a mesh of random vertices with 1 to 7 joints each, and random triangles between them.
pub(crate) fn mesh(rng: &mut Rng, joints: u32, vertices: u32) -> Mesh {
    let count = vertices as usize;
    let positions: Vec<Vec3> = (0..count).map(|_| rng.vector(1.0)).collect();
    let normals: Vec<Vec3> = (0..count).map(|_| rng.vector(1.0)).collect();
    let joint = |rng: &mut Rng| u32::try_from(rng.below(joints as usize)).unwrap();
    let influences: Vec<Vec<Influence>> = (0..count)
        .map(|_| (0..=rng.below(7)).map(|_| Influence::new(joint(rng), rng.between(0.1, 3.0))).collect())
        .collect();
    let triangles: Vec<[u32; 3]> =
        (0..2 * count).map(|_| [0; 3].map(|_| u32::try_from(rng.below(count)).unwrap())).collect();
    let morphs: Vec<Morph> = (0..count)
        .map(|_| Morph {
            target: u32::try_from(rng.below(3)).unwrap(),
            vertex: u32::try_from(rng.below(count)).unwrap(),
            position: rng.vector(0.2),
            normal: rng.vector(0.5),
        })
        .collect();
    let mesh = Mesh::new(positions, triangles, &influences).unwrap();
    mesh.with_normals(normals).unwrap().with_morphs(morphs).unwrap()
}

/// Forward kinematics: returns each bone's transform in model space.
fn model_f64(skeleton: &Skeleton, local: &[Transform]) -> Vec<DAffine3> {
    let mut model: Vec<DAffine3> = Vec::new();
    for (local, parent) in local.iter().zip(skeleton.parents()) {
        let local = exact(local);
        model.push(parent.map_or(local, |parent| model[parent] * local));
    }
    model
}

pub(crate) fn matrices(skeleton: &Skeleton, skin: &Skin, local: &[Transform]) -> Vec<Affine3A> {
    let mut model = vec![Affine3A::IDENTITY; skeleton.len()];
    skeleton.to_model(local, &mut model).unwrap();
    let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
    skin.matrices(&model, &mut matrices).unwrap();
    matrices
}

/// Returns Σ w · M over the heaviest joints of a vertex.
fn blended(mesh: &Mesh, vertex: usize, most: usize, exact: &[DAffine3]) -> DAffine3 {
    let heaviest = || mesh.influences(vertex).iter().take(most);
    let total: f64 = heaviest().map(|influence| f64::from(influence.weight)).sum();
    let mut sum = DAffine3::from_mat3_translation(DMat3::ZERO, DVec3::ZERO);
    for influence in heaviest() {
        let (matrix, weight) = (exact[influence.joint as usize], f64::from(influence.weight) / total);
        sum.matrix3 += matrix.matrix3 * weight;
        sum.translation += matrix.translation * weight;
    }
    sum
}

#[test]
fn matrices_positions_and_normals_agree_with_their_definitions() {
    let mut rng = Rng(1);
    let weights = [0.7, -0.4, 1.3];
    let (mut worst, mut worst_normal, mut judged) = ([0.0_f64; 2], 0.0_f64, 0);
    for _ in 0..40 {
        let skeleton = skeleton(&mut rng, 7);
        let bones: Vec<usize> = vec![6, 2, 0, 3, 5, 1];
        let skin = Skin::new(&skeleton, bones.clone()).unwrap();
        let mesh = mesh(&mut rng, 6, 60);
        let local = pose(&mut rng, &skeleton);
        let found = matrices(&skeleton, &skin, &local);
        let (rest, posed) = (model_f64(&skeleton, skeleton.rest()), model_f64(&skeleton, &local));
        let exact: Vec<DAffine3> = bones.iter().map(|bone| posed[*bone] * rest[*bone].inverse()).collect();
        for (found, exact) in found.iter().zip(&exact) {
            worst[0] = worst[0].max(apart(found, exact) / size(exact));
        }
        let pose = MeshPose::new(&found).with_morph_weights(&weights);
        let mut positions = vec![Vec3::ZERO; 60];
        mesh.deform(&pose, &mut positions).unwrap();
        let morphed = |vertex: usize, rest: Vec3, way: fn(&Morph) -> Vec3| {
            let ways = mesh.morphs(vertex).iter();
            let ways = ways.map(|morph| way(morph).as_dvec3() * f64::from(weights[morph.target as usize]));
            rest.as_dvec3() + ways.sum::<DVec3>()
        };
        for (vertex, position) in positions.iter().enumerate() {
            let matrix = blended(&mesh, vertex, usize::MAX, &exact);
            let moved = matrix.transform_point3(morphed(vertex, mesh.positions()[vertex], |morph| morph.position));
            let size = exact.iter().map(size).fold(1.0, f64::max);
            worst[1] = worst[1].max(position.as_dvec3().distance(moved) / size);
        }
        for most in [1, 2, usize::MAX] {
            let mut normals = vec![Vec3::ZERO; 60];
            mesh.deform_normals(&pose, most, &mut normals).unwrap();
            for (vertex, normal) in normals.iter().enumerate() {
                let matrix = blended(&mesh, vertex, most, &exact).matrix3;
                // If joints of opposite mirroring blend to a nearly flat matrix, rounding decides: skip ill-conditioned
                // ones.
                let condition = matrix.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt().powi(3)
                    / matrix.determinant().abs();
                let moved = matrix.inverse().transpose()
                    * morphed(vertex, mesh.normals()[vertex], |morph| morph.normal).normalize();
                if condition < 100.0 {
                    judged += 1;
                    worst_normal = worst_normal.max(normal.as_dvec3().distance(moved.normalize()));
                }
            }
        }
    }
    println!("matrices {:.1e}, positions {:.1e}, normals {worst_normal:.1e}", worst[0], worst[1]);
    assert!(worst[0] < 1e-5 && worst[1] < 1e-5, "{worst:?}");
    assert!(worst_normal < NEAR && judged > 4000, "{worst_normal} of {judged}");
}

/// Returns the largest magnitude in a matrix, at least 1.
fn size(matrix: &DAffine3) -> f64 {
    matrix.to_cols_array().iter().fold(1.0, |most, number| most.max(number.abs()))
}

#[test]
fn the_rest_pose_leaves_vertices_in_place() {
    let mut rng = Rng(2);
    let skeleton = skeleton(&mut rng, 5);
    let skin = Skin::new(&skeleton, [0, 1, 2, 3, 4]).unwrap();
    for matrix in matrices(&skeleton, &skin, skeleton.rest()) {
        assert!(matrix.abs_diff_eq(Affine3A::IDENTITY, 1e-5), "{matrix}");
    }
}

#[test]
fn weights_are_made_to_sum_to_one_heaviest_first() {
    let given = [(3, 1.0), (1, 0.0), (0, 2.0), (3, 4.0), (2, 2.0)].map(|(joint, weight)| Influence::new(joint, weight));
    let mesh = Mesh::new([Vec3::ZERO], [], &[given]).unwrap();
    let shares = [(3, 5.0 / 9.0), (0, 2.0 / 9.0), (2, 2.0 / 9.0)].map(|(joint, weight)| Influence::new(joint, weight));
    assert_eq!(mesh.influences(0), shares);
    assert_eq!(mesh.joints(), 4);
    let [first, second] = mesh.heaviest::<2>(0);
    assert!((first.weight - 5.0 / 7.0).abs() < 1e-6 && (second.weight - 2.0 / 7.0).abs() < 1e-6);
    assert_eq!(mesh.heaviest::<4>(0)[3], Influence::default());
    assert_eq!((mesh.influences(1), mesh.morphs(7)), (&[][..], &[][..]), "there is no such vertex");
    let huge = [Influence::new(0, f32::MAX), Influence::new(1, f32::MAX)];
    assert_eq!(Mesh::new([Vec3::ZERO], [], &[huge]).unwrap().influences(0)[1], Influence::new(1, 0.5));
}

#[test]
fn few_influences_of_normals_are_the_heaviest() {
    let mut rng = Rng(3);
    let matrices = [0; 2].map(|_| rng.rigid().to_affine());
    let both = [[Influence::new(0, 0.4), Influence::new(1, 0.6)]];
    let mesh = Mesh::new([Vec3::ZERO], [], &both).unwrap().with_normals([Vec3::Z]).unwrap();
    let normal = |most| {
        let mut normals = [Vec3::ZERO];
        mesh.deform_normals(&MeshPose::new(&matrices), most, &mut normals).unwrap();
        normals[0]
    };
    assert!(normal(1).abs_diff_eq(matrices[1].transform_vector3(Vec3::Z), 1e-6));
    assert_eq!(normal(0), normal(1), "one at least");
    assert_eq!(normal(2), normal(usize::MAX));
    assert!(!normal(2).abs_diff_eq(normal(1), 1e-2));
}

#[test]
fn normals_of_any_scale_and_of_flat_matrices() {
    let normal = Vec3::new(1.0, -1.0, 0.5).normalize();
    let of = |matrix: Affine3A| {
        let mesh = Mesh::new([Vec3::ZERO], [], &[[Influence::new(0, 1.0)]]).unwrap().with_normals([normal]).unwrap();
        let mut normals = [Vec3::X];
        mesh.deform_normals(&MeshPose::new(&[matrix]), 1, &mut normals).unwrap();
        normals[0]
    };
    for scale in [1e-18, 1e-6, 1.0, 1e18] {
        assert!(of(Affine3A::from_scale(Vec3::splat(scale))).abs_diff_eq(normal, 1e-6), "{scale}");
        assert!(of(Affine3A::from_scale(Vec3::splat(-scale))).abs_diff_eq(-normal, 1e-6), "{scale}, mirrored");
    }
    // Flattened along z, everything left faces along z.
    assert!(of(Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0))).abs_diff_eq(Vec3::Z, 1e-6));
    assert_eq!(of(Affine3A::from_scale(Vec3::X)), Vec3::ZERO, "a line has none");
    assert_eq!(of(Affine3A::from_scale(Vec3::splat(f32::NAN))), Vec3::ZERO);
    assert_eq!(normal_matrix(&Affine3A::from_scale(Vec3::splat(f32::INFINITY))), aim_animation::glam::Mat3A::ZERO);
}

#[test]
fn normals_stay_exact_under_uneven_scales() {
    let mut rng = Rng(5);
    // Errors by normal matrix and by deformation: for random normals, and for the normal that the matrix shortens most.
    let mut worst = [[0.0_f64; 2]; 2];
    for round in 0..6000 {
        let ratio = [3.0, 30.0, 300.0, 1000.0][round % 4];
        let scale = Vec3::new(1.0, 1.0 / ratio, -1.0 / ratio);
        let matrix = Affine3A::from_quat(rng.rotation()) * Affine3A::from_scale(scale);
        let matrix = matrix * Affine3A::from_quat(rng.rotation());
        let shortened = matrix.matrix3.transpose() * Vec3A::from(rng.vector(1.0)).normalize();
        for (of_normal, normal) in worst.iter_mut().zip([rng.vector(1.0), shortened.into()]) {
            let exact = Mat3::from(matrix.matrix3).as_dmat3().inverse().transpose() * normal.as_dvec3();
            let by_matrix = Mat3::from(normal_matrix(&matrix)).as_dmat3() * normal.as_dvec3();
            let mesh = Mesh::new([Vec3::ZERO], [], &[[Influence::new(0, 1.0)]]).unwrap();
            let mesh = mesh.with_normals([normal]).unwrap();
            let mut deformed = [Vec3::ZERO];
            mesh.deform_normals(&MeshPose::new(&[matrix]), 1, &mut deformed).unwrap();
            for (worst, found) in of_normal.iter_mut().zip([by_matrix.normalize(), deformed[0].as_dvec3()]) {
                *worst = worst.max(found.distance(exact.normalize()));
            }
        }
    }
    println!("normal matrices and deformed: any {:?}, shortened {:?}", worst[0], worst[1]);
    let [any, shortened] = worst;
    assert!(any[0] < 1e-5 && shortened[0] < 1e-4 && any[1].max(shortened[1]) < 1e-6, "{worst:?}");
}

#[test]
fn rows_move_points_as_matrices_do() {
    let mut rng = Rng(4);
    let (matrix, point) = (rng.transform().to_affine(), rng.vector(2.0));
    let moved = matrix_rows(&matrix).map(|[x, y, z, t]| x * point.x + y * point.y + z * point.z + t);
    assert!(Vec3::from_array(moved).abs_diff_eq(matrix.transform_point3(point), 1e-6));
}

#[test]
fn invalid_meshes_are_refused() {
    let one = [[Influence::new(0, 1.0)]];
    let at = |positions: &[Vec3], triangles: &[[u32; 3]], influences: &[&[Influence]]| {
        Mesh::new(positions, triangles, influences).unwrap_err()
    };
    let whole: &[Influence] = &one[0];
    assert_eq!(at(&[Vec3::X], &[], &[]), MeshError::Length { vertices: 1, found: 0 });
    assert_eq!(at(&[Vec3::X, Vec3::NAN], &[], &[whole, whole]), MeshError::Vertex(1));
    assert_eq!(at(&[Vec3::X], &[[0, 0, 0], [0, 1, 0]], &[whole]), MeshError::Triangle(1));
    assert_eq!(at(&[Vec3::X], &[], &[&[Influence::new(0, 1.0), Influence::new(0, -0.1)]]), MeshError::Weight(0));
    assert_eq!(at(&[Vec3::X], &[], &[&[Influence::new(0, f32::NAN)]]), MeshError::Weight(0));
    assert_eq!(at(&[Vec3::X; 2], &[], &[whole, &[Influence::new(0, 0.0)]]), MeshError::Unmoved(1));
    assert_eq!(at(&[Vec3::X], &[], &[&[Influence::new(u32::MAX, 1.0)]]), MeshError::Size);
    let mesh = Mesh::new([Vec3::X], [], &[[Influence::new(2, 1.0)]]).unwrap();
    assert_eq!(mesh.clone().with_normals([]).unwrap_err(), MeshError::Length { vertices: 1, found: 0 });
    assert_eq!(mesh.clone().with_normals([Vec3::NAN]).unwrap_err(), MeshError::Vertex(0));
    let beyond = Morph { vertex: 1, ..Morph::default() };
    assert_eq!(mesh.clone().with_morphs([Morph::default(), beyond]).unwrap_err(), MeshError::Morph(1));
    let nowhere = [
        Morph { position: Vec3::NAN, ..Morph::default() },
        Morph { normal: Vec3::INFINITY, ..Morph::default() },
        Morph { target: u32::MAX, ..Morph::default() },
    ];
    for morph in nowhere {
        assert_eq!(mesh.clone().with_morphs([morph]).unwrap_err(), MeshError::Morph(0));
    }
    let matrices = [Affine3A::IDENTITY; 3];
    let mut out = [Vec3::ONE];
    let few = MeshError::Joints { needed: 3, found: 2 };
    assert_eq!(mesh.deform(&MeshPose::new(&matrices[..2]), &mut out), Err(few));
    assert_eq!(mesh.deform(&MeshPose::new(&matrices), &mut []), Err(MeshError::Length { vertices: 1, found: 0 }));
    assert_eq!(mesh.deform_normals(&MeshPose::new(&matrices), 1, &mut out), Err(MeshError::NoNormals));
    assert_eq!(out, [Vec3::ONE], "nothing is written");

    let flat = Transform { scale: Vec3::new(1.0, 0.0, 1.0), ..Transform::IDENTITY };
    let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", Some(0)).with_rest(flat)]).unwrap();
    assert_eq!(Skin::new(&skeleton, [0, 2]).unwrap_err(), SkinError::Bone { joint: 1, bone: 2 });
    assert_eq!(Skin::new(&skeleton, [0, 1]).unwrap_err(), SkinError::Rest(1));
    let given = |bones: &[usize], inverse: &[Affine3A]| Skin::with_inverse_rest(&skeleton, bones, inverse);
    assert_eq!(given(&[0], &[]).unwrap_err(), SkinError::Length { expected: 1, found: 0 });
    assert_eq!(given(&[3], &[Affine3A::IDENTITY]).unwrap_err(), SkinError::Bone { joint: 0, bone: 3 });
    assert_eq!(given(&[0], &[Affine3A::NAN]).unwrap_err(), SkinError::Rest(0));
    let skin = given(&[1, 1], &[Affine3A::IDENTITY; 2]).unwrap();
    let mut out = [Affine3A::IDENTITY; 2];
    assert_eq!(skin.matrices(&matrices, &mut out), Err(SkinError::Length { expected: 2, found: 3 }));
    assert_eq!(skin.matrices(&matrices[..2], &mut out[..1]), Err(SkinError::Length { expected: 2, found: 1 }));
    for (error, words) in [
        (few.to_string(), "2 joints for a mesh that hangs on 3"),
        (MeshError::Unmoved(1).to_string(), "give it weight 1 of the joint"),
        (SkinError::Rest(1).to_string(), "its scale may not be zero"),
    ] {
        assert!(error.contains(words), "{error}");
    }
}

/// The number of morph targets follows from the highest target index, even if that target moves only normals or
/// nothing.
#[test]
fn targets_are_counted_and_may_move_normals_alone() {
    let mesh = Mesh::new([Vec3::X], [], &[[Influence::new(0, 1.0)]]).unwrap().with_normals([Vec3::X]).unwrap();
    assert_eq!(mesh.morph_targets(), 0);
    let tilt = Morph { target: 3, vertex: 0, position: Vec3::ZERO, normal: Vec3::Y };
    let mesh = mesh.with_morphs([tilt, Morph { target: 5, ..Morph::default() }]).unwrap();
    assert_eq!(mesh.morph_targets(), 6);
    let matrices = [Affine3A::IDENTITY];
    let pose = MeshPose::new(&matrices).with_morph_weights(&[0.0, 0.0, 0.0, 1.0]);
    let mut normals = [Vec3::ZERO];
    mesh.deform_normals(&pose, 1, &mut normals).unwrap();
    assert!(normals[0].distance(Vec3::new(1.0, 1.0, 0.0).normalize()) < 1e-6, "{normals:?}");
}

/// Joints whose share rounds to 0 in f32 need no matrix.
#[test]
fn shares_that_round_to_zero_are_dropped() {
    let influences = [[Influence::new(0, 1e30), Influence::new(7, 1e-30)]];
    assert_eq!(Mesh::new([Vec3::X], [], &influences).unwrap().joints(), 1);
}

/// The cofactors of very large and very small scales exceed the range of f32; the directions of normals do not.
#[test]
fn normals_have_matrices_at_any_scale() {
    for scale in [1e15, 1e-15] {
        let matrix = normal_matrix(&Affine3A::from_scale(Vec3::new(scale, 2.0 * scale, scale)));
        let normal = (matrix * Vec3A::new(1.0, 1.0, 0.0)).normalize();
        assert!(normal.abs_diff_eq(Vec3A::new(2.0, 1.0, 0.0).normalize(), 1e-6), "{scale}: {matrix:?}");
    }
}

#[test]
fn a_skin_without_joints_is_empty() {
    let skeleton = Skeleton::new([Bone::new("a", None)]).unwrap();
    assert!(Skin::new(&skeleton, []).unwrap().is_empty() && !Skin::new(&skeleton, [0]).unwrap().is_empty());
}
