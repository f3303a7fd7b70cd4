//! Bounding boxes contain every vertex, and ray hits agree with a search over all triangles by Cramer's rule in f64.

use aim_animation::glam::{Affine3A, DMat3, DVec3, Mat3, Vec3};
use aim_animation::{Aabb, Bone, BoneBoxes, Hit, Influence, Mesh, MeshError, MeshPose, Morph, Ray, Skeleton, Skin};

use crate::common::Rng;
use crate::meshes::{matrices, mesh, pose, skeleton};

const WEIGHTS: [f32; 3] = [0.7, -0.4, 1.3];

#[test]
fn no_vertex_is_outside_its_boxes() {
    let mut rng = Rng(1);
    for round in 0..200 {
        let skeleton = skeleton(&mut rng, 6);
        let skin = Skin::new(&skeleton, [0, 1, 2, 3, 4, 5]).unwrap();
        let mesh = mesh(&mut rng, 6, 30);
        let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
        let matrices = matrices(&skeleton, &skin, &pose(&mut rng, &skeleton));
        // Far from the origin, rounding errors matter.
        let away = Affine3A::from_translation(rng.vector([0.0, 1e3][round % 2]));
        let matrices: Vec<Affine3A> = matrices.iter().map(|matrix| away * *matrix).collect();
        let pose = MeshPose::new(&matrices).with_morph_weights(&WEIGHTS);
        let mut placed = vec![Vec3::ZERO; 30];
        mesh.deform(&pose, &mut placed).unwrap();
        let whole = boxes.whole(&pose).unwrap().unwrap();
        assert!(placed.iter().all(|vertex| whole.contains(*vertex)), "{whole:?}");
        let mut carried = 0;
        for joint in 0..6 {
            let aabb = boxes.carried(joint, &pose).unwrap();
            carried += boxes.triangles(joint).len();
            for corner in boxes.triangles(joint).iter().flat_map(|triangle| mesh.triangles()[*triangle as usize]) {
                assert!(aabb.unwrap().contains(placed[corner as usize]), "{aabb:?} of joint {joint}");
            }
        }
        assert_eq!(carried, mesh.triangles().len(), "each hangs on one joint");
    }
}

#[test]
fn oriented_boxes_are_the_extents_of_vertices_and_morphs() {
    let mut rng = Rng(5);
    for _ in 0..50 {
        let skeleton = skeleton(&mut rng, 3);
        let mesh = mesh(&mut rng, 3, 20);
        let boxes = BoneBoxes::new(&mesh, &Skin::new(&skeleton, [0, 1, 2]).unwrap()).unwrap();
        let matrices = [Affine3A::IDENTITY; 3];
        let pose = MeshPose::new(&matrices).with_morph_weights(&WEIGHTS);
        for joint in 0..3 {
            let moves = |vertex: &usize| mesh.influences(*vertex).iter().any(|i| i.joint as usize == joint);
            let Some(found) = boxes.oriented(joint, &pose) else { panic!("joint {joint} moves vertices") };
            let along = |v: Vec3| found.place.matrix3.transpose().as_dmat3() * v.as_dvec3();
            let (mut least, mut most) = (DVec3::MAX, DVec3::MIN);
            let mut ways = [[DVec3::ZERO; 2]; 3];
            for vertex in (0..20).filter(moves) {
                let rest = along(mesh.positions()[vertex]);
                (least, most) = (least.min(rest), most.max(rest));
                for (target, [low, high]) in ways.iter_mut().enumerate() {
                    let of_target = mesh.morphs(vertex).iter().filter(|morph| morph.target as usize == target);
                    let way = along(of_target.map(|morph| morph.position).sum()) * f64::from(WEIGHTS[target]);
                    (*low, *high) = (low.min(way), high.max(way));
                }
            }
            let [low, high] = [0, 1].map(|side| ways.iter().map(|way| way[side]).sum::<DVec3>());
            let (least, most) = (least + low, most + high);
            let (min, max) = (found.aabb.min.as_dvec3(), found.aabb.max.as_dvec3());
            assert!(min.abs_diff_eq(least, 1e-5) && max.abs_diff_eq(most, 1e-5), "{found:?}: {least} {most}");
        }
    }
}

#[test]
fn displacements_of_one_vertex_and_target_are_added() {
    let skeleton = Skeleton::new([Bone::new("a", None)]).unwrap();
    let skin = Skin::new(&skeleton, [0]).unwrap();
    let way = Morph { position: Vec3::X, ..Morph::default() };
    let mesh = Mesh::new([Vec3::ZERO], [], &[[Influence::new(0, 1.0)]]).unwrap().with_morphs([way; 3]).unwrap();
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let matrices = [Affine3A::IDENTITY];
    let pose = MeshPose::new(&matrices).with_morph_weights(&[1.0]);
    let mut placed = [Vec3::ZERO];
    mesh.deform(&pose, &mut placed).unwrap();
    assert_eq!(placed[0], Vec3::X * 3.0);
    assert!(boxes.whole(&pose).unwrap().unwrap().contains(placed[0]));
}

#[test]
fn triangles_hang_on_the_joint_that_moves_their_corners_most() {
    let mut rng = Rng(6);
    let skeleton = skeleton(&mut rng, 6);
    let mesh = mesh(&mut rng, 6, 60);
    let boxes = BoneBoxes::new(&mesh, &Skin::new(&skeleton, [0, 1, 2, 3, 4, 5]).unwrap()).unwrap();
    for joint in 0..6 {
        assert!(!boxes.triangles(joint).is_empty());
        for triangle in boxes.triangles(joint) {
            let mut weights = [0.0; 6];
            for corner in mesh.triangles()[*triangle as usize] {
                let of_corner = mesh.influences(corner as usize);
                of_corner.iter().for_each(|i| weights[i.joint as usize] += f64::from(i.weight));
            }
            let most = weights.into_iter().fold(0.0, f64::max);
            assert!(weights[joint] > most - 1e-6, "{triangle} on {joint}: {weights:?}");
        }
    }
    assert_eq!(boxes.triangles(6), [0; 0]);
}

#[test]
fn no_vertex_of_one_joint_or_of_a_thousand_is_outside() {
    let mut rng = Rng(7);
    // All joints move alike, so the box is that of a single point.
    for count in [1, 1000] {
        let bone = Bone::new("a", None).with_rest(rng.rigid());
        let skeleton = Skeleton::new(vec![bone; count]).unwrap();
        let skin = Skin::new(&skeleton, (0..count).collect::<Vec<_>>()).unwrap();
        let influences: Vec<Influence> = (0..).take(count).map(|joint| Influence::new(joint, 1.0)).collect();
        let mesh = Mesh::new([rng.vector(1.0)], [], &[influences]).unwrap();
        let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
        for _ in 0..100 {
            let away = Affine3A::from_translation(rng.vector(10.0));
            let matrices = vec![away * rng.transform().to_affine(); count];
            let pose = MeshPose::new(&matrices);
            let mut placed = [Vec3::ZERO];
            mesh.deform(&pose, &mut placed).unwrap();
            let whole = boxes.whole(&pose).unwrap().unwrap();
            assert!(whole.contains(placed[0]), "{} of {count} joints is outside {whole:?}", placed[0]);
        }
    }
}

#[test]
fn boxes_of_one_joint_are_tight_and_lie_along_the_bone() {
    let mut rng = Rng(2);
    let rest = rng.rigid();
    let skeleton = Skeleton::new([Bone::new("arm", None).with_rest(rest)]).unwrap();
    let skin = Skin::new(&skeleton, [0]).unwrap();
    // Corners of a box along the bone.
    let sides = Aabb { min: Vec3::new(-0.1, 0.0, -0.05), max: Vec3::new(0.1, 0.6, 0.05) };
    let corners = sides.corners().map(|corner| rest.to_affine().transform_point3(corner));
    let mesh = Mesh::new(corners, [], &[[Influence::new(0, 1.0)]; 8]).unwrap();
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let posed = rng.transform();
    let matrices = matrices(&skeleton, &skin, &[posed]);
    let pose = MeshPose::new(&matrices);
    let found = boxes.oriented(0, &pose).unwrap();
    for corner in sides.corners().map(|corner| posed.to_affine().transform_point3(corner)) {
        let distance = found.corners().map(|other| other.distance(corner)).into_iter().fold(f32::MAX, f32::min);
        assert!(distance < 1e-5, "{corner} is none of {found:?}");
    }
    let whole = boxes.whole(&pose).unwrap().unwrap();
    let around = found.corners().into_iter().fold(None, |aabb: Option<Aabb>, corner| {
        let point = Aabb { min: corner, max: corner };
        Some(aabb.map_or(point, |aabb| aabb.union(&point)))
    });
    assert!(whole.min.abs_diff_eq(around.unwrap().min, 1e-4) && whole.max.abs_diff_eq(around.unwrap().max, 1e-4));
    assert_eq!((boxes.oriented(1, &pose), boxes.oriented(0, &MeshPose::default())), (None, None));
}

/// Intersects a ray with a triangle by Cramer's rule: origin + t·d = a + u·(b − a) + v·(c − a). Returns `t` and the
/// barycentric coordinates of the corners.
fn by_cramer(corners: [DVec3; 3], ray: &Ray) -> Option<(f64, [f64; 3])> {
    let [a, b, c] = corners;
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let (columns, right) = ([-direction, b - a, c - a], origin - a);
    let determinant = |columns: [DVec3; 3]| DMat3::from_cols(columns[0], columns[1], columns[2]).determinant();
    let all = determinant(columns);
    let solved = [0, 1, 2].map(|column| {
        let mut replaced = columns;
        replaced[column] = right;
        determinant(replaced) / all
    });
    let [part, u, v] = solved;
    part.is_finite().then_some((part, [1.0 - u - v, u, v]))
}

#[test]
fn hits_are_those_of_all_triangles() {
    let mut rng = Rng(3);
    let (mut met, mut missed) = (0, 0);
    for round in 0..40 {
        let skeleton = skeleton(&mut rng, 6);
        // In half of the rounds several joints share a bone.
        let skin = Skin::new(&skeleton, [[5, 4, 3, 2, 1, 0], [2, 4, 2, 2, 1, 4]][round % 2]).unwrap();
        let mesh = mesh(&mut rng, 6, 12);
        let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
        let matrices = matrices(&skeleton, &skin, &pose(&mut rng, &skeleton));
        let pose = MeshPose::new(&matrices).with_morph_weights(&WEIGHTS);
        let mut placed = vec![Vec3::ZERO; 12];
        mesh.deform(&pose, &mut placed).unwrap();
        for _ in 0..500 {
            // Aimed near a vertex, so that about half of the rays hit something.
            let (from, to) = (rng.vector(3.0), placed[rng.below(12)] + rng.vector(0.5));
            let ray = match rng.below(2) {
                0 => Ray::new(from, (to - from) * rng.between(0.1, 3.0)),
                _ => Ray::segment(from, to),
            };
            let hit = boxes.hit(&mesh, &pose, &ray).unwrap();
            // Nearest clear hit, and whether any triangle is hit or missed too narrowly to tell.
            let (mut nearest, mut is_close_call) = (f64::MAX, false);
            for corners in mesh.triangles() {
                let corners = corners.map(|corner| placed[corner as usize].as_dvec3());
                let Some((part, shares)) = by_cramer(corners, &ray) else { continue };
                let inside = shares.into_iter().fold(f64::MAX, f64::min);
                let within = inside.min(part).min(f64::from(ray.end) - part);
                if within > 1e-6 {
                    nearest = nearest.min(part);
                }
                is_close_call |= within.abs() <= 1e-6;
            }
            match hit {
                _ if is_close_call => {}
                None => assert!(nearest == f64::MAX, "{ray:?} meets a triangle at {nearest}"),
                Some(hit) => {
                    assert!((f64::from(hit.part) - nearest).abs() < 1e-5 * nearest.max(1.0), "{hit:?}, at {nearest}");
                    judge((&mesh, &skin, &matrices), &placed, (&ray, &hit));
                }
            }
            *(if hit.is_some() { &mut met } else { &mut missed }) += 1;
        }
    }
    assert!(met > 5000 && missed > 2000, "{met} {missed}");
}

/// Checks the fields of a hit against one another and against the blended joint matrices.
fn judge((mesh, skin, matrices): (&Mesh, &Skin, &[Affine3A]), placed: &[Vec3], (ray, hit): (&Ray, &Hit)) {
    let indices = mesh.triangles()[hit.triangle];
    let [a, b, c] = indices.map(|corner| placed[corner as usize]);
    let size = a.abs().max(b.abs()).max(c.abs()).max_element();
    let [u, v, w] = hit.barycentric;
    assert!((u + v + w - 1.0).abs() < 1e-6 && hit.barycentric.iter().all(|share| (0.0..=1.0).contains(share)));
    assert!((a * u + b * v + c * w).abs_diff_eq(hit.point, 1e-6 * size), "{hit:?}");
    let reach = size + ray.origin.length();
    assert!(ray.at(hit.part).abs_diff_eq(hit.point, 1e-5 * reach), "{hit:?} of {ray:?}");
    // Weight of each joint at the hit point, and the linear map that the joints blend to.
    let mut weights = vec![0.0_f64; skin.len()];
    for (corner, share) in indices.iter().zip(hit.barycentric) {
        for influence in mesh.influences(*corner as usize) {
            weights[influence.joint as usize] += f64::from(influence.weight * share);
        }
    }
    let blended =
        matrices.iter().zip(&weights).fold(DMat3::ZERO, |sum, (m, w)| sum + Mat3::from(m.matrix3).as_dmat3() * *w);
    let square = (b - a).as_dvec3().normalize().cross((c - a).as_dvec3().normalize());
    if square.length() > 1e-3 && blended.determinant().abs() > 1e-5 {
        let outside = square.normalize() * blended.determinant().signum();
        assert!(hit.normal.as_dvec3().distance(outside) < 1e-3, "{hit:?}");
    }
    let of_bone = |bone: usize| {
        let joints = weights.iter().zip(skin.bones()).filter(move |(_, other)| **other == bone);
        joints.map(|(weight, _)| *weight)
    };
    let most = skin.bones().iter().map(|bone| of_bone(*bone).sum()).fold(0.0, f64::max);
    assert!(of_bone(hit.bone).sum::<f64>() > most - 1e-6, "{hit:?}: {weights:?}");
    assert_eq!(skin.bones()[hit.joint], hit.bone);
    assert!(weights[hit.joint] > of_bone(hit.bone).fold(0.0, f64::max) - 1e-6, "{hit:?}: {weights:?}");
}

#[test]
fn no_ray_slips_through_a_closed_surface() {
    // A sheet of many triangles with random heights, so that deformed positions are rounded.
    let mut rng = Rng(4);
    let count = 12_u32;
    let mut positions = Vec::new();
    for row in 0..=count {
        for column in 0..=count {
            let height = rng.between(-0.05, 0.05);
            positions.push(Vec3::new(row as f32 / count as f32, column as f32 / count as f32, height));
        }
    }
    let mut triangles = Vec::new();
    for row in 0..count {
        for column in 0..count {
            let a = row * (count + 1) + column;
            triangles.extend([[a, a + count + 1, a + 1], [a + 1, a + count + 1, a + count + 2]]);
        }
    }
    let influences: Vec<[Influence; 2]> =
        positions.iter().map(|at| [Influence::new(0, 1.0 - at.x), Influence::new(1, at.x)]).collect();
    let mesh = Mesh::new(positions, triangles, &influences).unwrap();
    let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", None)]).unwrap();
    let skin = Skin::new(&skeleton, [0, 1]).unwrap();
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let matrices = [Affine3A::IDENTITY, Affine3A::from_translation(Vec3::new(0.1, 0.2, 0.1))];
    let pose = MeshPose::new(&matrices);
    let mut placed = vec![Vec3::ZERO; mesh.positions().len()];
    mesh.deform(&pose, &mut placed).unwrap();
    // Aim at vertices and at points on edges, as exactly as f32 can represent them.
    for row in 1..count {
        for column in 1..count {
            let at = (row * (count + 1) + column) as usize;
            for (other, share) in [(at, 0.0), (at + 1, 0.5), (at + 1, 0.3), (at + count as usize, 0.7)] {
                let target = placed[at].lerp(placed[other], share);
                for _ in 0..5 {
                    let from = target + Vec3::new(rng.between(-1.0, 1.0), rng.between(-1.0, 1.0), 3.0);
                    let ray = Ray::new(from, target - from);
                    assert!(boxes.hit(&mesh, &pose, &ray).unwrap().is_some(), "{ray:?} slips through");
                }
            }
        }
    }
}

#[test]
fn invalid_rays_hit_nothing() {
    let mesh = Mesh::new([Vec3::ZERO, Vec3::X, Vec3::Y], [[0, 1, 2]], &[[Influence::new(0, 1.0)]; 3]).unwrap();
    let skeleton = Skeleton::new([Bone::new("a", None)]).unwrap();
    let skin = Skin::new(&skeleton, [0]).unwrap();
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let matrices = [Affine3A::IDENTITY];
    let (pose, from) = (MeshPose::new(&matrices), Vec3::new(0.2, 0.2, 1.0));
    let hit = |ray: Ray| boxes.hit(&mesh, &pose, &ray).unwrap();
    assert_eq!(hit(Ray::new(from, -Vec3::Z)).unwrap().part, 1.0);
    assert_eq!(hit(Ray::new(from - Vec3::Z * 2.0, Vec3::Z * 4.0)).unwrap().part, 0.25, "from behind");
    assert_eq!(hit(Ray::new(from, -Vec3::Z * 1e-30)).unwrap().part, 1e30, "a short direction");
    for ray in [
        Ray::new(from, Vec3::ZERO),
        Ray::new(Vec3::NAN, -Vec3::Z),
        Ray::new(from, Vec3::new(0.0, f32::NAN, -1.0)),
        Ray::new(from, Vec3::NEG_INFINITY),
        Ray { end: f32::NAN, ..Ray::new(from, -Vec3::Z) },
        Ray { end: -1.0, ..Ray::new(from, -Vec3::Z) },
        Ray { end: 0.5, ..Ray::new(from, -Vec3::Z) },
        Ray::new(from, Vec3::Z),
        Ray::new(from, Vec3::X),
    ] {
        assert_eq!(hit(ray), None, "{ray:?}");
    }
    let ray = Ray::new(from, -Vec3::Z);
    for broken in [Affine3A::NAN, Affine3A::from_scale(Vec3::splat(f32::INFINITY)), Affine3A::ZERO] {
        let matrices = [broken];
        let pose = MeshPose::new(&matrices);
        assert_eq!(boxes.hit(&mesh, &pose, &ray).unwrap(), None, "{broken}");
    }
    assert_eq!(boxes.whole(&MeshPose::new(&[Affine3A::NAN])), Ok(Some(Aabb::INFINITE)));
    let few = Err(MeshError::Joints { needed: 1, found: 0 });
    assert_eq!(boxes.hit(&mesh, &MeshPose::default(), &ray), few);
    assert_eq!(boxes.whole(&MeshPose::default()), Err(MeshError::Joints { needed: 1, found: 0 }));
    let other = Mesh::new([Vec3::ZERO], [], &[[Influence::new(0, 1.0)]]).unwrap();
    assert_eq!(boxes.hit(&other, &pose, &ray), Err(MeshError::OtherMesh));
    assert!(BoneBoxes::new(&mesh, &Skin::default()).is_err());
    let nothing = BoneBoxes::new(&Mesh::default(), &skin).unwrap();
    assert_eq!(nothing.hit(&Mesh::default(), &pose, &ray), Ok(None));
    assert_eq!(nothing.whole(&pose), Ok(None));
}

#[test]
fn directions_may_be_short_but_not_shorter_than_parts_count() {
    let mesh = Mesh::new([Vec3::ZERO, Vec3::X, Vec3::Y], [[0, 1, 2]], &[[Influence::new(0, 1.0)]; 3]).unwrap();
    let skeleton = Skeleton::new([Bone::new("a", None)]).unwrap();
    let boxes = BoneBoxes::new(&mesh, &Skin::new(&skeleton, [0]).unwrap()).unwrap();
    let part = |height: f32, end: f32| {
        let ray = Ray { end, ..Ray::new(Vec3::new(0.2, 0.2, height), -Vec3::Z * 1e-39) };
        boxes.hit(&mesh, &MeshPose::new(&[Affine3A::IDENTITY]), &ray).unwrap().map(|hit| hit.part)
    };
    assert_eq!(part(1.0, f32::INFINITY), None, "1e39 of its lengths");
    let near = part(0.1, f32::INFINITY).unwrap();
    assert!((near / 1e38 - 1.0).abs() < 1e-5, "{near}");
    assert_eq!((part(0.1, 1e37), part(0.1, f32::MAX)), (None, Some(near)));
}

#[test]
fn another_mesh_than_that_of_the_boxes_is_refused() {
    let skeleton = Skeleton::new(["a", "b"].map(|name| Bone::new(name, None))).unwrap();
    let skin = Skin::new(&skeleton, [0, 1]).unwrap();
    let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let of = |joint: u32, weight: f32| [Influence::new(joint, weight), Influence::new(1, 1.0)];
    let of = |positions: [Vec3; 3], triangle: [u32; 3], joint: u32, weight: f32| {
        Mesh::new(positions, [triangle], &[of(joint, weight); 3]).unwrap()
    };
    let mesh = of(positions, [0, 1, 2], 0, 1.0);
    let morph = |x: f32| [Morph { position: Vec3::X * x, ..Morph::default() }];
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let ray = Ray::new(Vec3::new(0.2, 0.2, 1.0), -Vec3::Z);
    let hit = |boxes: &BoneBoxes, mesh: &Mesh| boxes.hit(mesh, &MeshPose::new(&[Affine3A::IDENTITY; 6]), &ray);
    for other in [
        of(positions, [0, 1, 2], 5, 1.0),
        of(positions, [0, 1, 2], 0, 1.5),
        of(positions, [1, 2, 0], 0, 1.0),
        of([Vec3::ZERO, Vec3::X * 2.0, Vec3::Y], [0, 1, 2], 0, 1.0),
        mesh.clone().with_morphs(morph(1.0)).unwrap(),
    ] {
        assert_eq!(hit(&boxes, &other), Err(MeshError::OtherMesh), "{other:?}");
    }
    let same = of([-Vec3::ZERO, Vec3::X, Vec3::Y], [0, 1, 2], 0, 1.0).with_normals([Vec3::Z; 3]).unwrap();
    assert!(hit(&boxes, &same).unwrap().is_some(), "normals are not measured");
    let [morphed, other] = [1.0, 2.0].map(|x| mesh.clone().with_morphs(morph(x)).unwrap());
    let boxes = BoneBoxes::new(&morphed, &skin).unwrap();
    assert_eq!(hit(&boxes, &other), Err(MeshError::OtherMesh));
    assert!(hit(&boxes, &other.with_morphs(morph(1.0)).unwrap()).unwrap().is_some());
}

#[test]
fn normals_of_hits_are_those_of_the_deformed_surface() {
    let mut rng = Rng(8);
    let skeleton = Skeleton::new([Bone::new("a", None)]).unwrap();
    let skin = Skin::new(&skeleton, [0]).unwrap();
    let (mut mirrored, mut worst) = (0, 0.0_f64);
    for round in 0..300 {
        // Every third triangle is a needle.
        let (to, aside) = (rng.vector(1.0), rng.vector([1.0, 1.0, 0.01][round % 3]));
        let at = rng.vector(1.0);
        let corners = [at, at + to, at + to * rng.between(0.5, 1.5) + aside];
        let normal = (corners[1] - at).as_dvec3().cross((corners[2] - at).as_dvec3()).normalize().as_vec3();
        let mesh = Mesh::new(corners, [[0, 1, 2]], &[[Influence::new(0, 1.0)]; 3]).unwrap();
        let mesh = mesh.with_normals([normal; 3]).unwrap();
        let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
        // Any size: which side a mirrored triangle shows does not depend on its scale.
        let size = [1.0, 1e-15, 1e15][round / 3 % 3];
        let scale = [0; 3].map(|_| size * rng.between(0.5, 2.0) * if rng.below(2) == 0 { -1.0 } else { 1.0 });
        let matrix = Affine3A::from_quat(rng.rotation()) * Affine3A::from_scale(Vec3::from_array(scale));
        let pose = [matrix];
        let pose = MeshPose::new(&pose);
        let (mut placed, mut normals) = ([Vec3::ZERO; 3], [Vec3::ZERO; 3]);
        mesh.deform(&pose, &mut placed).unwrap();
        mesh.deform_normals(&pose, 1, &mut normals).unwrap();
        let middle = placed.iter().sum::<Vec3>() / 3.0;
        let [a, b, c] = placed.map(Vec3::as_dvec3);
        let square = (b - a).cross(c - a).normalize();
        let ray = Ray::new(middle + square.as_vec3() * size, -square.as_vec3());
        let hit = boxes.hit(&mesh, &pose, &ray).unwrap().expect("its middle is met");
        let side = Mat3::from(matrix.matrix3).as_dmat3().determinant().signum();
        mirrored += usize::from(side < 0.0);
        worst = worst.max(hit.normal.as_dvec3().distance(square * side));
        assert!(hit.normal.dot(normals[0]) > 0.99, "{hit:?}, {normals:?}");
    }
    println!("normals of hits {worst:.1e}");
    assert!(worst < 5e-7 && mirrored > 100, "{worst} {mirrored}");
}

/// If several bones move a point equally, the hit reports the lowest bone, whichever corner it belongs to.
#[test]
fn of_equal_weights_the_lowest_bone_is_reported() {
    let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", None)]).unwrap();
    let skin = Skin::new(&skeleton, [0, 1]).unwrap();
    let corners = [Vec3::ZERO, Vec3::X * 4.0, Vec3::Y * 4.0];
    for [first, second] in [[0, 1], [1, 0]] {
        let both = vec![Influence::new(0, 0.5), Influence::new(1, 0.5)];
        let influences = [vec![Influence::new(first, 1.0)], vec![Influence::new(second, 1.0)], both];
        let mesh = Mesh::new(corners, [[0, 1, 2]], &influences).unwrap();
        let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
        let matrices = [Affine3A::IDENTITY; 2];
        // Barycentric coordinates: a quarter of each of the first two corners, half of the third.
        let ray = Ray::new(Vec3::new(1.0, 2.0, 4.0), Vec3::NEG_Z);
        let hit = boxes.hit(&mesh, &MeshPose::new(&matrices), &ray).unwrap().unwrap();
        assert_eq!((hit.barycentric, hit.bone, hit.joint), ([0.25, 0.25, 0.5], 0, 0));
    }
}

#[test]
fn boxes_have_their_corners_and_are_met_where_they_are() {
    let aabb = Aabb { min: Vec3::new(-1.0, 2.0, 0.0), max: Vec3::new(1.0, 3.0, 4.0) };
    let expected: Vec<Vec3> = [0.0, 4.0]
        .into_iter()
        .flat_map(|z| [2.0, 3.0].map(move |y| [-1.0, 1.0].map(|x| Vec3::new(x, y, z))))
        .flatten()
        .collect();
    assert_eq!(aabb.corners().to_vec(), expected);
    assert!(expected.iter().all(|corner| aabb.contains(*corner)) && aabb.contains(Vec3::new(0.5, 2.5, 3.0)));
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for side in [-1.0, 1.0] {
            let outside = Vec3::new(0.0, 2.5, 2.0) + axis * side * 5.0;
            assert!(!aabb.contains(outside));
            assert!(aabb.is_met(&Ray::new(outside, axis * -side)), "towards it");
            assert!(!aabb.is_met(&Ray::new(outside, axis * side)), "away from it");
            let beside = Ray::new(outside, Vec3::new(axis.y, axis.z, axis.x));
            assert!(!aabb.is_met(&beside), "past it, {beside:?}");
            assert!(!aabb.is_met(&Ray { end: 1.0, ..Ray::new(outside, axis * -side) }), "it ends before");
        }
    }
    assert!(!aabb.is_met(&Ray::new(Vec3::new(0.0, 2.5, 2.0), Vec3::ZERO)), "no ray");
    assert!(aabb.is_met(&Ray::new(Vec3::new(1.0, 2.5, 2.0), Vec3::Y)), "along its side");
}
