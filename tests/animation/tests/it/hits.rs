//! Hits on characters in motion, compared with the crate `bvh` in f64, which has its own hierarchy of boxes around the
//! triangles and the Möller–Trumbore test.

use std::path::Path;

use aim::animation::{Aabb, BoneBoxes, Mesh, MeshPose, Ray};
use aim::glam::{Affine3A, DVec3, Vec3};
use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::Document;
use bvh::aabb::Bounded;
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use nalgebra::{Point3, Vector3};

/// A small generator of random numbers in [0, 1).
struct Rng(u64);

impl Rng {
    fn part(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        f32::from(u16::try_from(mixed >> 48).unwrap()) / 65536.0
    }

    fn within(&mut self, aabb: &Aabb) -> Vec3 {
        let parts = Vec3::from_array([0; 3].map(|_| self.part()));
        aabb.min + (aabb.max - aabb.min) * parts
    }
}

/// A triangle in `bvh`'s hierarchy.
struct Leaf {
    corners: [Point3<f64>; 3],
    node: usize,
}

impl Bounded<f64, 3> for Leaf {
    fn aabb(&self) -> bvh::aabb::Aabb<f64, 3> {
        let [a, b, c] = &self.corners;
        // Triangles perpendicular to an axis have flat boxes, which `bvh` does not handle.
        let slack = Vector3::repeat(1e-9);
        bvh::aabb::Aabb::with_bounds(a.inf(b).inf(c) - slack, a.sup(b).sup(c) + slack)
    }
}

impl BHShape<f64, 3> for Leaf {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

/// Returns the ray parameter of the nearest triangle, hit from either side.
fn by_the_other(bvh: &Bvh<f64, 3>, leaves: &[Leaf], ray: &Ray) -> Option<f64> {
    let [origin, direction] = [ray.origin, ray.direction].map(Vec3::as_dvec3);
    let length = direction.length();
    let cast = bvh::ray::Ray::new(Point3::from(origin.to_array()), Vector3::from(direction.to_array()));
    let met = bvh.traverse(&cast, leaves).into_iter().map(|leaf| {
        let [a, b, c] = &leaf.corners;
        // `bvh` only hits front faces, so test both windings.
        let sides = [cast.intersects_triangle(a, b, c), cast.intersects_triangle(a, c, b)];
        sides[0].distance.min(sides[1].distance) / length
    });
    met.min_by(f64::total_cmp).filter(|part| part.is_finite() && *part <= f64::from(ray.end))
}

/// Returns the least distance between the ray's line and the mesh's edges, and between its ends and the triangles'
/// planes. The two libraries may differ where it is small.
fn closeness(mesh: &Mesh, placed: &[Vec3], ray: &Ray) -> f64 {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize());
    let ends = [0.0, ray.end].map(|part| ray.at(part).as_dvec3());
    let mut least = f64::MAX;
    for corners in mesh.triangles() {
        let [a, b, c] = corners.map(|corner| placed[corner as usize].as_dvec3());
        for (from, to) in [(a, b), (b, c), (c, a)] {
            least = least.min(to_edge(origin, direction, from, to));
        }
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for end in ends.into_iter().filter(|end| end.is_finite()) {
            least =
                least.min((end - a).dot(normal).abs().max((end - a).length() - (b - a).length() - (c - a).length()));
        }
    }
    least
}

/// Returns the distance between a line and an edge, by ternary search, since it is convex along the edge.
fn to_edge(origin: DVec3, direction: DVec3, from: DVec3, to: DVec3) -> f64 {
    let distance = |part: f64| (from.lerp(to, part) - origin).reject_from_normalized(direction).length();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if distance(a) < distance(b) { high = b } else { low = a }
    }
    distance(0.5 * (low + high))
}

/// Casts rays at a document in a pose. Returns the number of rays; the number that hit; the sum over rays of the share
/// of triangles on bones whose boxes are met, an upper bound of those tested; and the number of rays that differ from
/// the other library.
fn cast(document: &Document, seconds: f32, rays: usize, rng: &mut Rng) -> [f64; 4] {
    let (skeleton, surface) = (document.skeleton(), document.surface());
    let (mesh, skin) = surface.mesh(skeleton);
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let clip = document.clips().first();
    let local = clip.map_or_else(|| skeleton.rest().to_vec(), |clip| skeleton.pose(clip, seconds));
    let mut model = vec![Affine3A::IDENTITY; skeleton.len()];
    skeleton.to_model(&local, &mut model).unwrap();
    let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
    skin.matrices(&model, &mut matrices).unwrap();
    let pose = MeshPose::new(&matrices).with_morph_weights(surface.morph_weights());
    let mut placed = vec![Vec3::ZERO; mesh.positions().len()];
    mesh.deform(&pose, &mut placed).unwrap();

    let point = |corner: u32| Point3::from(placed[corner as usize].as_dvec3().to_array());
    let leaf = |corners: &[u32; 3]| Leaf { corners: corners.map(point), node: 0 };
    let mut leaves: Vec<Leaf> = mesh.triangles().iter().map(leaf).collect();
    let bvh = Bvh::build(&mut leaves);
    let carried: Vec<(Option<Aabb>, usize)> =
        (0..skin.len()).map(|joint| (boxes.carried(joint, &pose).unwrap(), boxes.triangles(joint).len())).collect();
    let whole = boxes.whole(&pose).unwrap().unwrap();
    let size = (whole.max - whole.min).length();
    let around = Aabb { min: whole.min - size, max: whole.max + size };
    let [mut hits, mut tested, mut differ] = [0.0; 3];
    for number in 0..rays {
        let (from, to) = (rng.within(&around), rng.within(&whole));
        let ray = if number % 2 == 0 { Ray::new(from, to - from) } else { Ray::segment(from, to) };
        let hit = boxes.hit(&mesh, &pose, &ray).unwrap();
        let other = by_the_other(&bvh, &leaves, &ray);
        hits += f64::from(u8::from(hit.is_some()));
        let is_same = match (&hit, other) {
            (None, None) => true,
            // If triangles coincide, either may be hit.
            (Some(hit), Some(part)) => (f64::from(hit.part) - part).abs() < 1e-6 * part.max(1.0),
            _ => false,
        };
        if !is_same {
            differ += 1.0;
            let close = closeness(&mesh, &placed, &ray);
            assert!(close < 1e-5 * f64::from(size), "{hit:?}, {other:?} by the other, {close} m from an edge: {ray:?}");
        }
        let met = carried.iter().filter(|(aabb, _)| aabb.is_some_and(|aabb| aabb.is_met(&ray)));
        tested += met.map(|(_, count)| *count as f64).sum::<f64>();
    }
    [rays as f64, hits, tested / mesh.triangles().len() as f64, differ]
}

/// Returns the number of rays, and per ray on average: hits, the share of the triangles tested, and differences near an
/// edge.
fn shares(casts: impl Iterator<Item = [f64; 4]>) -> (f64, [f64; 3]) {
    let [rays, hits, tested, differ] = casts.fold([0.0; 4], |sum, cast| [0, 1, 2, 3].map(|k| sum[k] + cast[k]));
    (rays, [hits, tested, differ].map(|count| count / rays))
}

#[test]
fn hits_on_the_mannequin_are_those_of_another_library() {
    let document = Document::from_bytes(&mannequin(|_| PAPER_AXES).unwrap()).unwrap();
    let mut rng = Rng(1);
    let casts = (0..5_u8).map(|time| cast(&document, f32::from(time) * 0.53, 20_000, &mut rng));
    let (rays, [hits, tested, differ]) = shares(casts);
    println!("{rays} rays, {hits:.3} hit, {tested:.4} of the triangles tested, {differ:.5} differ at edges");
    assert!(rays >= 1e5 && hits > 0.1);
    assert!(tested < 0.15, "{tested} of the triangles are tested for a ray");
    assert!(differ < 1e-3, "{differ}");
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn hits_on_characters_are_those_of_another_library() {
    let folder = std::env::var_os("AIM_RIGS").expect("AIM_RIGS names a folder of real characters");
    let mut folder = Path::new(&folder).to_path_buf();
    if folder.is_relative() {
        folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    }
    let mut rng = Rng(2);
    let mut judged = 0;
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let Some(document) = Document::load(&path).ok().filter(|document| !document.surface().triangles().is_empty())
        else {
            continue;
        };
        let casts = (0..4_u8).map(|time| cast(&document, f32::from(time) * 0.31, 2500, &mut rng));
        let (_, [hits, tested, differ]) = shares(casts);
        println!("{}: {hits:.3} hit, {tested:.4} tested, {differ:.5} differ", path.display());
        assert!(tested < 0.4 && differ < 2e-3, "{tested} {differ}");
        judged += 1;
    }
    assert!(judged > 0);
}
