//! Where a picture was taken: the crate `levenberg-marquardt` finds the pose, and `#[differentiate]` gives it the Jacobian.

use derivand::differentiate;
use derivand::glam::{DQuat, DVec2, DVec3};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{ArrayStorage, SMatrix, SVector, U6, U16, Vector6};

/// The way from where a corner was seen to where a camera of this pose shows it.
#[differentiate(wrt(turn, shift))]
fn off(turn: DVec3, shift: DVec3, corner: DVec3, seen: DVec2) -> DVec2 {
    let p = DQuat::from_scaled_axis(turn) * corner + shift;
    p.truncate() / p.z - seen
}

struct Picture {
    /// A rotation vector and a shift.
    pose: Vector6<f64>,
    /// The corners in the world, and in the picture.
    corners: [(DVec3, DVec2); 8],
}

impl Picture {
    /// What `each` gives of every corner.
    fn of_corners<T>(&self, each: impl Fn(DVec3, DVec3, DVec3, DVec2) -> T) -> [T; 8] {
        let [a, b, c, x, y, z] = self.pose.into();
        let (turn, shift) = (DVec3::new(a, b, c), DVec3::new(x, y, z));
        self.corners.map(|(corner, seen)| each(turn, shift, corner, seen))
    }
}

impl LeastSquaresProblem<f64, U16, U6> for Picture {
    type ResidualStorage = ArrayStorage<f64, 16, 1>;
    type JacobianStorage = ArrayStorage<f64, 16, 6>;
    type ParameterStorage = ArrayStorage<f64, 6, 1>;

    fn set_params(&mut self, pose: &Vector6<f64>) {
        self.pose = *pose;
    }

    fn params(&self) -> Vector6<f64> {
        self.pose
    }

    fn residuals(&self) -> Option<SVector<f64, 16>> {
        Some(SVector::from_iterator(self.of_corners(off).into_iter().flat_map(|r| r.to_array())))
    }

    fn jacobian(&self) -> Option<SMatrix<f64, 16, 6>> {
        // Of each corner six vectors, by the components of turn and shift.
        let columns = self.of_corners(|turn, shift, corner, seen| {
            let (_, (by_turn, by_shift)) = off_jacobian(turn, shift, corner, seen);
            [by_turn, by_shift].concat()
        });
        Some(SMatrix::from_fn(|row, column| columns[row / 2][column][row % 2]))
    }
}

fn main() {
    let (turn, shift) = (DVec3::new(0.4, -0.6, 0.2), DVec3::new(-0.3, -0.4, 4.0));
    let corners = [0, 1, 2, 3, 4, 5, 6, 7_u8].map(|i| {
        let corner = DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), 0.5 * f64::from(i >> 2));
        (corner, off(turn, shift, corner, DVec2::ZERO))
    });
    // It begins without any turn, where a rotation vector has no direction.
    let guess = Picture { pose: Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 5.0), corners };

    let (found, report) = LevenbergMarquardt::new().minimize(guess);

    println!("{:?} after {} evaluations: {:?}", report.termination, report.number_of_evaluations, found.pose);
    let there = Vector6::from_iterator([turn, shift].into_iter().flat_map(|v| v.to_array()));
    assert!(report.termination.was_successful() && (found.pose - there).norm() < 1e-9);
}
