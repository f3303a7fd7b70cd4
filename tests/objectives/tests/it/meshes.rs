//! Structs with slices among their fields.

#[aim::differentiate(check = true)]
mod functions {
    use aim::glam::DVec3;

    pub(super) struct Mesh<'a> {
        pub(super) vertices: &'a [DVec3],
        pub(super) faces: &'a [[usize; 3]],
        pub(super) scale: f64,
    }

    impl Mesh<'_> {
        fn corners(&self, face: [usize; 3]) -> [DVec3; 3] {
            face.map(|vertex| self.vertices[vertex] * self.scale)
        }

        fn count(&self) -> usize {
            self.faces.len()
        }
    }

    /// The mean area of a stretched mesh's faces.
    #[differentiate(wrt(stretch))]
    pub(super) fn mean_area(stretch: DVec3, mesh: &Mesh<'_>) -> f64 {
        let mut area = 0.0;
        for &face in mesh.faces {
            let [a, b, c] = mesh.corners(face).map(|corner| corner * stretch);
            area += 0.5 * (b - a).cross(c - a).length();
        }
        area / mesh.count() as f64
    }

    pub(super) struct Sum<'a> {
        pub(super) terms: &'a [f64],
        pub(super) total: f64,
    }

    impl Sum<'_> {
        fn add(&mut self, x: f64) {
            if x > 0.0 {
                self.total += self.terms[0] * x;
                self.terms = &self.terms[1..];
            }
        }
    }

    /// A slice that a branch shortens.
    #[differentiate(wrt(x, y))]
    pub(super) fn positive_terms(x: f64, y: f64, sum: Sum<'_>) -> f64 {
        let mut sum = sum;
        sum.add(x);
        sum.add(y);
        sum.add(x * y);
        let rest = if x > y { &sum.terms[1..] } else { sum.terms };
        sum.total + x * rest.iter().sum::<f64>()
    }

    pub(super) struct Fit<'a> {
        pub(super) seen: &'a [f64],
        pub(super) model: (f64, Mesh<'a>),
    }

    /// Two slices: one in a struct in a tuple, and one that is an argument.
    #[differentiate(wrt(shift))]
    pub(super) fn misfit(offsets: &[f64], shift: f64, fit: Fit<'_>) -> f64 {
        let (weight, model) = &fit.model;
        let of_seen: f64 = fit.seen.iter().zip(offsets).map(|(x, offset)| (x - offset * shift).powi(2)).sum();
        let of_model: f64 = model.vertices.iter().map(|v| (v.x + shift).sin()).sum();
        weight * of_seen + of_model * model.scale
    }
}

use crate::kept::{assert_near, difference};
use aim::glam::DVec3;
use functions::{Fit, Mesh, Sum};

const VERTICES: [DVec3; 5] = [
    DVec3::ZERO,
    DVec3::new(1.0, 0.2, 0.0),
    DVec3::new(0.3, 1.0, 0.5),
    DVec3::new(-0.4, 0.1, 1.3),
    DVec3::new(2.0, -1.0, 0.7),
];

#[test]
fn faces_of_a_mesh() {
    let faces = [[0, 1, 2], [1, 2, 3], [4, 0, 3], [2, 4, 1]];
    let stretch = DVec3::new(1.2, 0.7, 1.1);
    for count in [1, 2, 4] {
        let mesh = Mesh { vertices: &VERTICES, faces: &faces[..count], scale: 1.5 };
        let (value, (by_stretch,)) = functions::mean_area_gradient(stretch, &mesh);
        assert_near(value, functions::mean_area(stretch, &mesh));
        for axis in DVec3::AXES {
            let along = difference(|t| functions::mean_area(stretch + t * axis, &mesh), 0.0);
            assert_near(by_stretch.dot(axis), along);
        }
    }
}

#[test]
fn slices_of_several_structs() {
    let (seen, offsets) = ([0.5, -1.0, 2.0], [1.0, 0.3, -0.7, 9.0]);
    let fit = |count: usize| {
        let model = Mesh { vertices: &VERTICES[..count], faces: &[], scale: 0.8 };
        Fit { seen: &seen, model: (1.5, model) }
    };
    for count in [0, 2, 5] {
        let (value, (slope,)) = functions::misfit_gradient(&offsets, 0.4, fit(count));
        assert_near(value, functions::misfit(&offsets, 0.4, fit(count)));
        assert_near(slope, difference(|shift| functions::misfit(&offsets, shift, fit(count)), 0.4));
    }
}

#[test]
fn parts_that_branches_choose() {
    let terms = [0.5, -1.5, 2.0, 3.0, 4.5];
    let sum = || Sum { terms: &terms, total: 1.0 };
    for (x, y) in [(0.5, 2.0), (2.0, 0.7), (-1.0, 0.4), (-0.3, -0.8), (1.5, -2.0)] {
        let (value, (by_x, by_y)) = functions::positive_terms_gradient(x, y, sum());
        assert_near(value, functions::positive_terms(x, y, sum()));
        assert_near(by_x, difference(|x| functions::positive_terms(x, y, sum()), x));
        assert_near(by_y, difference(|y| functions::positive_terms(x, y, sum()), y));
    }
}
