//! The viewer on a web page.

use eframe::wasm_bindgen::JsCast;
use eframe::web_sys::{HtmlCanvasElement, window};

use crate::app::App;
use crate::character::Character;
use crate::viewer::Viewer;

/// Attribute of the canvas that describes the scene, for programs that drive the page.
const STATE: &str = "data-state";

/// Starts the viewer on the canvas with this id and returns; from then on, the page's events drive it. After each
/// frame, the canvas' attribute `data-state` holds the position of the target and the error of each gaze as JSON.
///
/// # Errors
/// A message, if there is no such canvas or no WebGL 2.
pub async fn start(canvas: &str) -> Result<(), String> {
    let document = window().and_then(|window| window.document()).ok_or("there is no page to draw on")?;
    let element = document.get_element_by_id(canvas).ok_or_else(|| format!("the page has no element {canvas:?}"))?;
    let element: HtmlCanvasElement = element.dyn_into().map_err(|_| format!("the element {canvas:?} is no canvas"))?;
    let viewer = Viewer::new(Character::mannequin()?)?;
    let told = element.clone();
    let after = Box::new(move |_: &eframe::egui::Context, viewer: &Viewer| {
        // A failure is ignored: the viewer itself does not use the attribute.
        let _ = told.set_attribute(STATE, &viewer.state());
    });
    let app = App { viewer, frames: None, after };
    eframe::WebRunner::new()
        .start(element, eframe::WebOptions::default(), Box::new(|_| Ok(Box::new(app))))
        .await
        .map_err(|error| error.as_string().unwrap_or_else(|| "this browser has no WebGL 2".into()))
}
