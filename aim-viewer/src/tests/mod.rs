//! Tests that drive the viewer as a user does, by keys, the mouse and files. Nothing is drawn.

mod feet;
mod files;
mod keys;
mod live;
mod mouse;
mod playing;
mod pointed;
mod skinning;
mod tools;
mod widgets;

use aim_runtime::glam::Vec3;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::rc::Rc;

use eframe::egui::{self, Key, Pos2, Rect, accesskit};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use crate::character::Character;
use crate::overlay::on_screen;
use crate::stage::SIXTIETH;
use crate::viewer::Viewer;

/// Size of a window that shows the whole panel without scrolling, points.
const TALL: [f32; 2] = [1280.0, 2600.0];
/// Size of an ordinary window, points.
const USUAL: [f32; 2] = [1280.0, 800.0];

/// A viewer in a simulated window.
struct Window {
    harness: Harness<'static, Viewer>,
    /// Rectangle of the scene in the window, points.
    scene: Rc<Cell<Rect>>,
}

impl Window {
    fn new(character: Character, size: [f32; 2]) -> Self {
        let scene = Rc::new(Cell::new(Rect::NOTHING));
        let seen = scene.clone();
        let frame = move |ui: &mut egui::Ui, viewer: &mut Viewer| {
            viewer.ui(ui, SIXTIETH, |_, rect, _| seen.set(rect));
        };
        let builder = Harness::builder().with_size(size).with_step_dt(SIXTIETH).with_max_steps(1);
        let viewer = Viewer::new(character).expect("its rig is a chain");
        let mut window = Self { harness: builder.build_ui_state(frame, viewer), scene };
        // The layout needs two frames.
        window.frames(2);
        window
    }

    fn mannequin(size: [f32; 2]) -> Self {
        Self::new(Character::mannequin().expect("the mannequin"), size)
    }

    fn viewer(&self) -> &Viewer {
        self.harness.state()
    }

    fn frames(&mut self, count: usize) {
        self.harness.run_steps(count);
    }

    /// Returns the screen position of a world point. Panics if it is behind the camera.
    fn seen(&self, point: Vec3) -> Pos2 {
        on_screen(self.viewer(), self.scene.get(), point).expect("it is in front of the camera")
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.harness.step();
    }

    /// Holds a key for this number of frames, at least one.
    fn hold(&mut self, key: Key, frames: usize) {
        self.harness.key_down(key);
        self.harness.step();
        self.frames(frames - 1);
        self.harness.key_up(key);
        self.harness.step();
    }

    /// Presses a mouse button at `from`, moves the pointer, and releases the button at `to`.
    fn drag(&mut self, button: egui::PointerButton, from: Pos2, to: Pos2) {
        let pressed = |pos, pressed| egui::Event::PointerButton { pos, button, pressed, modifiers: Default::default() };
        self.harness.event(egui::Event::PointerMoved(from));
        self.harness.event(pressed(from, true));
        for share in [0.25, 0.5, 0.75, 1.0] {
            self.harness.event(egui::Event::PointerMoved(from.lerp(to, share)));
        }
        self.harness.event(pressed(to, false));
        self.harness.step();
        self.harness.step();
    }

    fn wheel(&mut self, at: Pos2, by: f32) {
        self.harness.event(egui::Event::PointerMoved(at));
        self.harness.event(egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: egui::vec2(0.0, by),
            phase: egui::TouchPhase::Move,
            modifiers: Default::default(),
        });
        self.harness.step();
        // egui smooths the wheel over several frames.
        self.frames(20);
    }

    fn drop_file(&mut self, file: egui::DroppedFile) {
        self.harness.input_mut().dropped_files.push(file);
        self.harness.step();
        self.harness.step();
    }

    fn drop_bytes(&mut self, name: &str, bytes: &[u8]) {
        let file = egui::DroppedFile { name: name.into(), bytes: Some(bytes.into()), ..Default::default() };
        self.drop_file(file);
    }

    fn rect(&self, name: &str) -> Rect {
        self.harness.get(by(name)).rect()
    }

    fn is_shown(&self, name: &str) -> bool {
        self.harness.query(by(name)).is_some()
    }

    fn click(&mut self, name: &str) {
        self.harness.get(by(name)).click();
        self.harness.step();
        // A change is shown in the next frame.
        self.harness.step();
    }

    /// Returns the names of all controls that can be clicked, dragged or typed into.
    fn controls(&self) -> BTreeSet<String> {
        let mut found = BTreeSet::new();
        let mut open = vec![self.harness.root()];
        while let Some(node) = open.pop() {
            let accessible = node.accesskit_node();
            if is_control(&accessible) {
                found.insert(accessible.label().unwrap_or_else(|| {
                    format!("a nameless {:?} at {:?}", accessible.role(), accessible.bounding_box())
                }));
            }
            open.extend(node.children());
        }
        found
    }

    /// Returns all texts on the screen.
    fn texts(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut open = vec![self.harness.root()];
        while let Some(node) = open.pop() {
            found.extend(node.accesskit_node().value());
            open.extend(node.children());
        }
        found
    }
}

fn is_control(node: &egui_kittest::kittest::AccessKitNode<'_>) -> bool {
    use accesskit::Role;
    let passive = [Role::Window, Role::GenericContainer, Role::Label, Role::TextRun];
    // Nodes without a role and a name are areas, axes of plots, or edges of panels.
    let is_unknown = node.role() == Role::Unknown && node.label().is_none();
    !passive.contains(&node.role()) && !is_unknown
}

fn by(name: &str) -> egui_kittest::kittest::By<'_> {
    egui_kittest::kittest::by().predicate(move |node| is_control(node) && node.label().as_deref() == Some(name))
}
