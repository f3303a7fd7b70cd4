//! Computes normals for meshes without any: smooth across shallow edges, hard at creases.

use std::collections::HashMap;

use aim_animation::glam::Vec3;

/// Cosine of the crease angle, 60°: a face that deviates more from a vertex's own normal is not averaged into it.
const CREASE: f32 = 0.5;
/// Maximum number of faces averaged at one position, which bounds the cost. Where more meet, only faces that share a
/// vertex are averaged.
const MOST_AT_ONE_PLACE: usize = 64;

/// Returns a unit normal for each position: the sum of the faces at that position that deviate by less than 60° from
/// the vertex's own faces, weighted by area. Zero for a vertex without faces.
pub(crate) fn normals(positions: &[Vec3], triangles: &[[usize; 3]]) -> Vec<Vec3> {
    let faces: Vec<Vec3> = triangles.iter().map(|t| face(t.map(|vertex| positions[vertex]))).collect();
    let mut own = vec![Vec3::ZERO; positions.len()];
    let mut at_place: HashMap<[u32; 3], Vec<usize>> = HashMap::new();
    for (index, triangle) in triangles.iter().enumerate() {
        for vertex in triangle {
            own[*vertex] += faces[index];
            at_place.entry(key(positions[*vertex])).or_default().push(index);
        }
    }
    let smooth = |(position, own): (&Vec3, &Vec3)| {
        let direction = own.normalize_or_zero();
        let near = at_place.get(&key(*position)).filter(|near| near.len() <= MOST_AT_ONE_PLACE);
        let flat_enough = |face: &Vec3| face.dot(direction) > CREASE * face.length();
        let sum: Vec3 = near.into_iter().flatten().map(|index| faces[*index]).filter(flat_enough).sum();
        let smoothed = sum.normalize_or_zero();
        if smoothed == Vec3::ZERO { direction } else { smoothed }
    };
    positions.iter().zip(&own).map(smooth).collect()
}

/// Returns the normal of a triangle, with twice its area as length; zero if that is not finite.
fn face([a, b, c]: [Vec3; 3]) -> Vec3 {
    let normal = (b - a).cross(c - a);
    if normal.is_finite() { normal } else { Vec3::ZERO }
}

fn key(position: Vec3) -> [u32; 3] {
    // Adding 0 turns −0 into 0.
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

#[cfg(test)]
mod tests {
    use aim_animation::glam::Quat;

    use super::*;

    /// Two triangles that share an edge as separate vertices, the second turned about it.
    fn folded(by_deg: f32) -> Vec<Vec3> {
        let turned = Quat::from_rotation_y(-by_deg.to_radians()) * Vec3::X;
        let positions = [Vec3::ZERO, Vec3::Y, -Vec3::X, Vec3::Y, Vec3::ZERO, turned];
        normals(&positions, &[[0, 1, 2], [3, 4, 5]])
    }

    #[test]
    fn smooth_below_sixty_degrees_and_sharp_above() {
        let bent = folded(50.0);
        assert!(bent[0].abs_diff_eq(bent[4], 1e-6), "{bent:?}");
        assert!((bent[0].angle_between(Vec3::Z).to_degrees() - 25.0).abs() < 1e-3, "half of the turn: {bent:?}");
        assert!(bent[2].abs_diff_eq(Vec3::Z, 1e-6), "the corner off the edge keeps its face's");
        let sharp = folded(70.0);
        assert!(sharp[0].abs_diff_eq(Vec3::Z, 1e-6), "{sharp:?}");
        assert!((sharp[4].angle_between(Vec3::Z).to_degrees() - 70.0).abs() < 1e-3, "{sharp:?}");
    }

    #[test]
    fn triangles_without_area_have_no_normal() {
        let line = normals(&[Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::Y], &[[0, 1, 2]]);
        assert_eq!(line, [Vec3::ZERO; 4]);
        let far = normals(&[Vec3::ZERO, Vec3::X * f32::MAX, Vec3::Y * f32::MAX], &[[0, 1, 2]]);
        assert_eq!(far, [Vec3::ZERO; 3]);
    }

    #[test]
    fn a_million_faces_at_one_point_take_linear_time() {
        let positions = vec![Vec3::ZERO; 300_000];
        let triangles: Vec<[usize; 3]> = (0..100_000).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        assert_eq!(normals(&positions, &triangles).len(), positions.len());
    }
}
