//! Camera and light of a picture, as shader uniforms.

use aim_runtime::glam::Vec3;
use three_d::{Camera, Mat4, Program, Viewer as _, Viewport, radians};

use crate::picture::Picture;

/// GLSL function that lights a surface: `lit(base, place, normal)`. [`Light::send`] sets its uniforms.
pub(super) const GLSL: &str = include_str!("shaders/light.glsl");

/// Camera and light: a key and a fill light that move with the eye, so that shapes are legible from all sides, and a
/// sky light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light {
    pub(super) viewport: Viewport,
    pub(super) eye: Vec3,
    pub(super) is_dark: bool,
    /// View-projection matrix, clip ← world.
    view_projection: Mat4,
    /// Unit vector towards the key light.
    key: Vec3,
    /// Unit vector towards the fill light.
    fill: Vec3,
    /// Unit vector towards the sky.
    sky: Vec3,
    /// Size of a pixel at distance 1, in world units.
    pixel: f32,
}

impl Light {
    pub(super) fn new(picture: &Picture, viewport: Viewport) -> Self {
        let view = &picture.view;
        let back = (view.from - view.at).try_normalize().unwrap_or(Vec3::Z);
        let right = view.up.cross(back).try_normalize().unwrap_or(Vec3::X);
        let up = back.cross(right);
        let vector = |vector: Vec3| three_d::Vec3::from(vector.to_array());
        let [near, far] = view.depth;
        let camera = Camera::new_perspective(
            viewport,
            vector(view.from),
            vector(view.from - back),
            vector(up),
            radians(view.field_rad),
            near,
            far,
        );
        #[expect(clippy::cast_precision_loss, reason = "pixels")]
        let height = viewport.height.max(1) as f32;
        Self {
            viewport,
            eye: view.from,
            is_dark: picture.dark,
            view_projection: camera.projection() * camera.view(),
            key: (0.8 * back - 0.65 * right + 0.75 * up).normalize(),
            fill: (0.45 * back + 0.9 * right + 0.1 * up).normalize(),
            sky: picture.ground.up,
            pixel: 2.0 * (0.5 * view.field_rad).tan() / height,
        }
    }

    /// Sets those uniforms that the program declares.
    pub(super) fn send(&self, program: &Program) {
        let send = |name: &str, vector: Vec3| {
            program.use_uniform_if_required(name, three_d::Vec3::from(vector.to_array()));
        };
        send("eye", self.eye);
        send("key", self.key);
        send("fill", self.fill);
        send("sky", self.sky);
        program.use_uniform_if_required("viewProjection", self.view_projection);
        program.use_uniform_if_required("pixel", self.pixel);
        program.use_uniform_if_required("isDark", if self.is_dark { 1.0_f32 } else { 0.0 });
    }
}
