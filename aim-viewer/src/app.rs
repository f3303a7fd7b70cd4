//! The window's frame: input to the state, the state to a picture, the picture onto the screen.

use std::cell::RefCell;
use std::sync::Arc;

use aim_gltf::{Document, PAPER_AXES, Surface, mannequin};
use eframe::{egui, egui_glow};
use glam::Vec3;

use crate::draw::{Canvas, Place};
use crate::native::Shot;
use crate::picture::{Figure, Ground, Picture, View};

thread_local! {
    // What paints belongs to the thread that the window is on; a paint callback may hold nothing of it.
    static CANVAS: RefCell<Option<Canvas>> = const { RefCell::new(None) };
}

pub(crate) struct App {
    shot: Option<Shot>,
    frame: u32,
    document: Document,
    surface: Arc<Surface>,
}

impl App {
    pub(crate) fn new(shot: Option<Shot>) -> Self {
        let document = Document::from_bytes(&mannequin(|_| PAPER_AXES).unwrap()).unwrap();
        let surface = Arc::new(document.surface());
        Self { shot, frame: 0, document, surface }
    }

    fn picture(&self) -> Picture {
        let skeleton = self.document.skeleton();
        let world = skeleton.world_f64(&skeleton.rest_pose());
        let positions: Vec<Vec3> = self.surface.positions(skeleton, &world).iter().map(|p| p.as_vec3()).collect();
        let normals = vec![Vec3::Y; positions.len()];
        Picture {
            view: View {
                from: Vec3::new(0.8, 1.6, 2.6),
                at: Vec3::new(0.0, 1.0, 0.0),
                up: Vec3::Y,
                field_rad: 0.7,
                depth: [0.05, 50.0],
            },
            surface: self.surface.clone(),
            figures: vec![Figure { positions, normals, tint: [255; 4] }],
            rods: Vec::new(),
            balls: Vec::new(),
            fans: Vec::new(),
            ground: Ground { centre: Vec3::ZERO, up: Vec3::Y, radius: 4.0, step: 0.5 },
            dark: true,
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let picture = Arc::new(self.picture());
        egui::CentralPanel::default().frame(egui::Frame::NONE).show_inside(ui, |ui| {
            let (rect, _) = ui.allocate_exact_size(ui.available_size(), egui::Sense::click_and_drag());
            paint(ui, rect, picture);
        });
        self.frame += 1;
        if let Some(shot) = &self.shot {
            let taken = ui.ctx().input(|input| {
                input.raw.events.iter().find_map(|event| match event {
                    egui::Event::Screenshot { image, .. } => Some(image.clone()),
                    _ => None,
                })
            });
            if let Some(image) = taken {
                let [width, height] = image.size.map(|side| u32::try_from(side).unwrap());
                image::save_buffer(&shot.out, image.as_raw(), width, height, image::ColorType::Rgba8).unwrap();
                ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
            } else if self.frame == shot.frames {
                ui.ctx().send_viewport_cmd(egui::ViewportCommand::Screenshot(egui::UserData::default()));
            }
        }
        ui.ctx().request_repaint();
    }
}

/// Has the picture painted into `rect` when the time comes.
fn paint(ui: &egui::Ui, rect: egui::Rect, picture: Arc<Picture>) {
    let callback = egui_glow::CallbackFn::new(move |info, painter| {
        let at = info.viewport_in_pixels();
        #[expect(clippy::cast_sign_loss, reason = "sizes are not negative")]
        let place = Place {
            x: at.left_px,
            y: at.from_bottom_px,
            width: at.width_px.max(1) as u32,
            height: at.height_px.max(1) as u32,
            screen: info.screen_size_px,
        };
        CANVAS.with_borrow_mut(|canvas| {
            if canvas.is_none() {
                *canvas = Canvas::new(painter.gl().clone()).ok();
            }
            if let Some(canvas) = canvas {
                canvas.draw(&picture, place);
            }
        });
    });
    ui.painter().add(egui::PaintCallback { rect, callback: Arc::new(callback) });
}
