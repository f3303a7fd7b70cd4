//! The viewer as a web page: what `index.html` starts. On any other target than `wasm32` there is nothing here.

#![cfg(target_arch = "wasm32")]

use wasm_bindgen::prelude::*;

/// Starts the viewer on the canvas with this id; it tells of each frame in the canvas' attribute `data-state`.
///
/// # Errors
/// No such canvas, or no WebGL 2.
#[wasm_bindgen]
pub async fn start(canvas: String) -> Result<(), JsValue> {
    aim_viewer::start(&canvas).await.map_err(JsValue::from)
}
