//! Exports to JavaScript.

use peak_alloc::PeakAlloc;
use wasm_bindgen::prelude::*;

use crate::{Bones, Character, Found, layout};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Returns the number of bytes currently allocated.
#[wasm_bindgen(js_name = liveBytes)]
pub fn live_bytes() -> usize {
    MEMORY.current_usage()
}

/// Returns the layout of a character's block: the offsets of place, settings, outcome and targets, the greatest number
/// of targets, and the offset of the bones.
#[wasm_bindgen]
pub fn layout() -> Vec<u32> {
    [layout::PLACE, layout::SETTINGS, layout::OUTCOME, layout::TARGETS, layout::MOST_TARGETS, layout::BONES]
        .map(number)
        .to_vec()
}

/// The bones of a character, added one by one.
#[wasm_bindgen(js_name = Bones)]
#[derive(Debug, Default)]
pub struct JsBones(Bones);

#[wasm_bindgen(js_class = Bones)]
impl JsBones {
    /// Creates an empty list of bones.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// See [`Bones::add`].
    pub fn add(&mut self, name: &str, parent: i32, rest: &[f32]) {
        self.0.add(name, parent, rest);
    }

    /// See [`Bones::bind`].
    pub fn bind(&mut self, matrix: &[f32]) {
        self.0.bind(matrix);
    }

    /// See [`Bones::node`].
    pub fn node(&mut self, node: u32) {
        self.0.node(node as usize);
    }

    /// See [`Bones::trunk`].
    pub fn trunk(&mut self, bone: u32) {
        self.0.trunk(bone as usize);
    }
}

/// A character, aimed frame by frame.
#[wasm_bindgen(js_name = Character)]
#[derive(Debug)]
pub struct JsCharacter(Character);

#[wasm_bindgen(js_class = Character)]
impl JsCharacter {
    /// Creates a character with a bundled rig: see [`preset`](crate::preset()).
    #[cfg(feature = "presets")]
    pub fn preset(bones: &JsBones, name: &str, both_eyes: bool) -> Result<Self, JsError> {
        made(crate::preset(&bones.0, name, both_eyes))
    }

    /// Creates a character with a rig declared in TOML.
    #[cfg(feature = "declare")]
    pub fn declared(bones: &JsBones, file: &str, text: &str, both_eyes: bool) -> Result<Self, JsError> {
        made(crate::declared(&bones.0, file, text, both_eyes))
    }

    /// Creates a character with a rig measured from the bones.
    #[cfg(feature = "measure")]
    pub fn measured(bones: &JsBones, both_eyes: bool) -> Result<Self, JsError> {
        made(crate::measured(&bones.0, both_eyes))
    }

    /// Creates a character with a rig measured from the character's file.
    #[cfg(feature = "measure")]
    #[wasm_bindgen(js_name = ofFile)]
    pub fn of_file(bones: &JsBones, bytes: &[u8], both_eyes: bool) -> Result<Self, JsError> {
        made(crate::of_file(&bones.0, bytes, both_eyes))
    }

    /// Returns the address of the block of numbers, which stays the same for the character's lifetime.
    pub fn block(&mut self) -> *const f32 {
        self.0.block().as_ptr()
    }

    /// Returns the length of the block, in `f32`s.
    #[wasm_bindgen(js_name = blockLength)]
    pub fn block_length(&mut self) -> usize {
        self.0.block().len()
    }

    /// See [`Character::bones`].
    pub fn bones(&self) -> Vec<u32> {
        self.0.bones().iter().copied().map(number).collect()
    }

    /// See [`Character::written`].
    pub fn written(&self) -> Vec<u32> {
        self.0.written().iter().copied().map(number).collect()
    }

    /// See [`Character::joints`].
    pub fn joints(&self) -> Vec<u32> {
        self.0.joints().iter().copied().map(number).collect()
    }

    /// See [`Character::joint_name`].
    #[wasm_bindgen(js_name = jointName)]
    pub fn joint_name(&self, joint: usize) -> String {
        self.0.joint_name(joint).to_owned()
    }

    /// See [`Character::update`].
    pub fn update(&mut self, dt: f32, targets: usize, snap: bool) {
        self.0.update(dt, targets, snap);
    }

    /// See [`Character::restore`].
    pub fn restore(&mut self) {
        self.0.restore();
    }
}

fn made(found: Result<Found, String>) -> Result<JsCharacter, JsError> {
    found.map(|found| JsCharacter(Character::new(&found))).map_err(|told| JsError::new(&told))
}

/// Converts to `u32`, which wasm-bindgen passes as a JavaScript number. Sizes here are far below its limit.
fn number(size: usize) -> u32 {
    u32::try_from(size).unwrap_or(u32::MAX)
}
