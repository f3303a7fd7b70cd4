//! The stage of the examples: a camera, a light, a floor, and mannequins. With the feature `window` they are drawn; without it they are the
//! same entities, for tests.

use bevy::prelude::*;

#[cfg(not(feature = "window"))]
mod headless;
#[cfg(feature = "window")]
mod window;

/// A mannequin of 1.75 m that faces +Z, in the place of a scene of your own: `WorldAssetRoot(assets.load("hero.glb#Scene0"))`.
#[derive(Component, Clone, Copy, Debug, Default)]
#[require(Transform)]
pub struct Body;

/// A ball of this radius, metres.
#[derive(Component, Clone, Copy, Debug)]
#[require(Transform)]
pub struct Ball(pub f32);

/// A box of this size, metres, about its entity's origin, but for this offset.
#[derive(Component, Clone, Copy, Debug)]
#[require(Transform)]
pub struct Block {
    /// Width, height and depth.
    pub size: Vec3,
    /// Its middle.
    pub middle: Vec3,
}

/// The ray of the pointer: from the camera into the scene; `None` while it is not in the window.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Pointer(pub Option<Ray3d>);

/// The stage, seen by a camera.
///
/// With the variable `AIM_SCREENSHOT` the window leaves a picture there and closes.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// The camera's place.
    pub camera: Vec3,
    /// The point that it looks at.
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
