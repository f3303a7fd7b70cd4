//! The viewer as a web page: the WebAssembly module that `index.html` loads. Empty on targets other than `wasm32`.

#![cfg(target_arch = "wasm32")]

use wasm_bindgen::prelude::*;

/// Starts the viewer on the canvas with this id. After each frame, the canvas' attribute `data-state` describes the
/// scene as JSON.
///
/// # Errors
/// If there is no such canvas or no WebGL 2.
#[wasm_bindgen]
pub async fn start(canvas: String) -> Result<(), JsValue> {
    aim_viewer::start(&canvas).await.map_err(JsValue::from)
}
