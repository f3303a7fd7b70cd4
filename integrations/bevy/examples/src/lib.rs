//! The stage of the examples: a camera, a light, a floor, and mannequins. With the feature `window` they are drawn.
//! Without it, the same components spawn only the bones of mannequins, for tests.

use bevy::prelude::*;

#[cfg(not(feature = "window"))]
mod headless;
#[cfg(feature = "window")]
mod window;

/// A mannequin, 1.75 m tall, that faces +Z. Your own app uses a scene instead:
/// `WorldAssetRoot(assets.load("hero.glb#Scene0"))`.
#[derive(Component, Clone, Copy, Debug, Default)]
#[require(Transform)]
pub struct Body;

/// A ball with this radius, metres.
#[derive(Component, Clone, Copy, Debug)]
#[require(Transform)]
pub struct Ball(pub f32);

/// A box in the space of its entity.
#[derive(Component, Clone, Copy, Debug)]
#[require(Transform)]
pub struct Block {
    /// Width, height and depth, metres.
    pub size: Vec3,
    /// Centre of the box, metres.
    pub middle: Vec3,
}

/// The ray of the pointer from the camera into the scene; `None` while the pointer is outside the window.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Pointer(pub Option<Ray3d>);

/// The stage, and the camera that shows it.
///
/// If the environment variable `AIM_SCREENSHOT` is set, the window saves a screenshot to that path and closes.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// Position of the camera.
    pub camera: Vec3,
    /// Point at which the camera looks.
    pub middle: Vec3,
}

impl Plugin for Stage {
    fn build(&self, app: &mut App) {
        app.init_resource::<Pointer>();
        #[cfg(feature = "window")]
        window::build(*self, app);
        #[cfg(not(feature = "window"))]
        headless::build(app);
    }
}
