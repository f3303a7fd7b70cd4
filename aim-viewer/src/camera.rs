//! The camera: orbits a point, and projects between world and screen.

use aim_animation::Ray;
use aim_runtime::glam::{Vec2, Vec3};

use crate::picture::Perspective;

/// Largest pitch of the camera, up or down, radians.
const STEEPEST: f32 = 1.5;

/// A camera that orbits a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Camera {
    /// The point that the camera orbits, world space.
    pub(crate) focus: Vec3,
    /// Angle about up, from the character's front towards its left, radians.
    pub(crate) yaw: f32,
    /// Angle above the horizon, radians.
    pub(crate) pitch: f32,
    /// Distance from the focus, in world units.
    pub(crate) distance: f32,
    /// Up, forward and left of the character: unit vectors, world space.
    pub(crate) directions: [Vec3; 3],
}

impl Camera {
    /// Vertical field of view, radians.
    pub(crate) const FIELD: f32 = 0.6;

    /// Turns the camera about the focus, by angles in radians.
    pub(crate) fn orbit(&mut self, yaw: f32, pitch: f32) {
        self.yaw = (self.yaw + yaw) % std::f32::consts::TAU;
        self.pitch = (self.pitch + pitch).clamp(-STEEPEST, STEEPEST);
    }

    /// Multiplies the distance by a factor, clamped to 0.15…60 times `metre`.
    pub(crate) fn zoom(&mut self, factor: f32, metre: f32) {
        self.distance = (self.distance * factor).clamp(0.15 * metre, 60.0 * metre);
    }

    /// Moves the camera so that all points are visible, with a margin, in a viewport of this size. The distance is
    /// never reduced.
    pub(crate) fn fit(&mut self, points: &[Vec3], scene: Vec2) {
        /// Fraction of the viewport that the points may fill.
        const FILLED: f32 = 0.8;
        let axes = self.axes();
        let along = |at: &Vec3| Vec3::from_array(axes.map(|axis| at.dot(axis)));
        let Some(first) = points.first().map(along) else { return };
        let (low, high) = points.iter().map(along).fold((first, first), |(lo, hi), at| (lo.min(at), hi.max(at)));
        let middle = (low + high) / 2.0;
        let tall = FILLED * (Self::FIELD / 2.0).tan();
        let wide = tall * if scene.y > 0.0 { (scene.x / scene.y).max(0.1) } else { 1.0 };
        let away = |at: &Vec3| {
            let from = along(at) - middle;
            from.z + (from.x.abs() / wide).max(from.y.abs() / tall)
        };
        let [right, up, out] = axes;
        self.focus = right * middle.x + up * middle.y + out * middle.z;
        self.distance = points.iter().map(away).fold(self.distance, f32::max);
    }

    /// Returns the unit vector from the focus to the camera.
    fn out(&self) -> Vec3 {
        let [up, forward, left] = self.directions;
        let ((sin, cos), (up_part, along)) = (self.yaw.sin_cos(), self.pitch.sin_cos());
        (forward * cos + left * sin) * along + up * up_part
    }

    /// Returns the camera's axes: right, up and towards the viewer, unit vectors.
    pub(crate) fn axes(&self) -> [Vec3; 3] {
        let out = self.out();
        let right = self.directions[0].cross(out).normalize_or_zero();
        [right, out.cross(right), out]
    }

    pub(crate) fn view(&self, metre: f32) -> Perspective {
        Perspective {
            from: self.focus + self.out() * self.distance,
            at: self.focus,
            up: self.directions[0],
            field_rad: Self::FIELD,
            depth: [0.02 * self.distance.min(metre), 4.0 * self.distance + 60.0 * metre],
        }
    }

    /// Projects a point to a screen of this size, relative to its upper left corner; `None` if it is behind the camera.
    pub(crate) fn project(&self, point: Vec3, size: Vec2) -> Option<Vec2> {
        let [right, up, out] = self.axes();
        let from = point - (self.focus + out * self.distance);
        let depth = -from.dot(out);
        let at = Vec2::new(from.dot(right), -from.dot(up)) / (depth * (Self::FIELD / 2.0).tan());
        (depth > 0.0).then(|| size / 2.0 + at * (size.y / 2.0))
    }

    /// Returns the ray from the camera through a screen point, given relative to the upper left corner: the inverse of
    /// [`project`](Self::project).
    pub(crate) fn ray(&self, at: Vec2, size: Vec2) -> Ray {
        let [right, up, out] = self.axes();
        let at = (at - size / 2.0) / (size.y / 2.0) * (Self::FIELD / 2.0).tan();
        Ray::new(self.focus + out * self.distance, right * at.x - up * at.y - out)
    }

    /// Returns the world-space displacement, parallel to the screen, of a point that follows the pointer by `by` on a
    /// screen of this height.
    pub(crate) fn drag(&self, point: Vec3, by: Vec2, height: f32) -> Vec3 {
        let [right, up, out] = self.axes();
        let depth = (self.focus + out * self.distance - point).dot(out).max(0.0);
        let scale = 2.0 * depth * (Self::FIELD / 2.0).tan() / height;
        (right * by.x - up * by.y) * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera { focus: Vec3::Y, yaw: 0.4, pitch: 0.3, distance: 3.0, directions: [Vec3::Y, Vec3::Z, Vec3::X] }
    }

    #[test]
    fn from_in_front_the_character_s_left_is_on_the_right() {
        let camera = Camera { yaw: 0.0, pitch: 0.0, ..camera() };
        let [right, up, out] = camera.axes();
        assert!(right.distance(Vec3::X) < 1e-6 && up.distance(Vec3::Y) < 1e-6 && out.distance(Vec3::Z) < 1e-6);
        let size = Vec2::new(800.0, 600.0);
        let seen = camera.project(Vec3::new(0.5, 1.2, 0.0), size).expect("it is in front");
        assert!(seen.x > 400.0 && seen.y < 300.0, "{seen}");
        assert_eq!(camera.project(Vec3::Z * 10.0, size), None);
    }

    #[test]
    fn what_is_fitted_is_in_sight() {
        let points = [Vec3::ZERO, Vec3::new(3.0, 1.0, 0.5), Vec3::new(-1.0, 2.0, -2.0), Vec3::new(0.5, 0.2, 3.0)];
        for size in [Vec2::new(800.0, 300.0), Vec2::new(300.0, 800.0), Vec2::new(500.0, 500.0)] {
            let mut camera = camera();
            camera.fit(&points, size);
            for point in points {
                let seen = camera.project(point, size).expect("it is in front") / size;
                assert!(seen.min_element() > 0.05 && seen.max_element() < 0.95, "{point} at {seen} of {size}");
            }
        }
    }

    #[test]
    fn what_is_dragged_stays_under_the_pointer() {
        let (camera, size) = (camera(), Vec2::new(800.0, 600.0));
        let point = Vec3::new(0.4, 1.3, 0.7);
        let by = Vec2::new(37.0, -21.0);
        let [before, after] =
            [point, point + camera.drag(point, by, size.y)].map(|at| camera.project(at, size).expect("it is in front"));
        assert!((after - before).distance(by) < 1e-2, "{}", after - before);
    }
}
