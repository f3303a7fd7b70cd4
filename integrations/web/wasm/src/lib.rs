//! WebAssembly of the npm package `aim-gaze`: a character's bones, a rig for them, and one aimed frame after the other through a
//! block of numbers that JavaScript shares.

mod bones;
mod character;
#[cfg(feature = "declare")]
mod declare;
#[cfg(target_arch = "wasm32")]
pub mod export;
mod find;
#[cfg(feature = "measure")]
mod measure;
#[cfg(feature = "presets")]
mod presets;

pub use bones::Bones;
pub use character::{Character, layout};
#[cfg(feature = "declare")]
pub use declare::declared;
pub use find::Found;
#[cfg(feature = "measure")]
pub use measure::{measured, of_file};
#[cfg(feature = "presets")]
pub use presets::preset;
