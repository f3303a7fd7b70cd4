//! WebAssembly module of the npm package `aim-gaze`. It receives a character's bones, fits a rig to them, and aims
//! frame by frame through a block of numbers in memory that JavaScript reads and writes directly.

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
