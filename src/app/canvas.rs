//! The sky itself: the picture, what lies over it, and the hand that turns it.

use std::sync::Arc;

use eframe::egui::{self, Color32, Mesh, Pos2, Rect, Sense, Shape, Ui, Vec2, pos2};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState};
use eframe::wgpu;

use crate::camera::Camera;
use crate::render::Renderer;
use crate::render::window::{LineCorner, LinePass, Lines, OnWindow, WindowPass};

use super::action::Action;
use super::overlays::Overlays;
use super::panels::Desk;
use super::pointing;
use super::sky::Shown;

/// Powers of e of the field for a point that the wheel scrolls.
const ZOOM_PER_POINT: f64 = 0.004;
/// Nearest that a click must come to what it selects, points.
const CLICK_POINTS: f64 = 14.0;
/// A sky that is narrower or lower has no room for lines, words or a hand, points.
const LEAST_POINTS: f32 = 4.0;

/// The place of the sky in the window.
#[derive(Default)]
pub struct Canvas {
    pass: Option<WindowPass>,
    lines: Option<LinePass>,
    picture: Option<Laid>,
    size_px: [u32; 2],
    overlays: Overlays,
}

/// A picture on the window.
struct Laid {
    codes: wgpu::TextureView,
    size_px: [u32; 2],
    /// Without lines.
    bare: Arc<OnWindow>,
    /// With these lines.
    lined: Option<(Arc<Mesh>, Arc<OnWindow>)>,
}

/// Lays the picture under all else.
struct Underlay(Arc<OnWindow>);

impl CallbackTrait for Underlay {
    fn paint(
        &self,
        _: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _: &CallbackResources,
    ) {
        self.0.draw(pass);
    }
}

/// How the pixels of a picture lie in the window.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub camera: Camera,
    pub rect: Rect,
}

impl Frame {
    /// Where a pixel of the picture lies, points.
    pub fn point(&self, [x, y]: [f64; 2]) -> Pos2 {
        let scale = self.points_per_px();
        pos2(self.rect.min.x + x as f32 * scale.x, self.rect.min.y + y as f32 * scale.y)
    }

    /// The pixel under a point of the window.
    pub fn pixel(&self, point: Pos2) -> [f64; 2] {
        let scale = self.points_per_px();
        let from = point - self.rect.min;
        [f64::from(from.x / scale.x), f64::from(from.y / scale.y)]
    }

    fn points_per_px(&self) -> Vec2 {
        let Camera { width_px, height_px, .. } = self.camera;
        self.rect.size() / egui::vec2(width_px as f32, height_px as f32)
    }
}

impl Canvas {
    /// The size of the picture that fits, pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// What lies over it.
    pub fn overlays(&self) -> &Overlays {
        &self.overlays
    }

    /// Takes a picture over for the screen.
    pub fn take(
        &mut self,
        shown: &Shown,
        renderer: Option<&Renderer>,
        window: Option<&RenderState>,
    ) {
        let (Some(codes), Some(renderer), Some(window)) = (&shown.codes, renderer, window) else {
            return;
        };
        let gpu = renderer.gpu();
        let pass = self.pass.get_or_insert_with(|| WindowPass::new(gpu, window.target_format));
        let Camera { width_px, height_px, .. } = shown.setting.camera;
        let size_px = [width_px, height_px];
        let bare = Arc::new(pass.picture(gpu, codes, self.size_px == size_px));
        self.picture = Some(Laid { codes: codes.clone(), size_px, bare, lined: None });
    }

    /// The picture with the lines that are laid; none if there are none, or no device.
    fn lined(&mut self, renderer: Option<&Renderer>, rect: Rect) -> Option<Arc<OnWindow>> {
        let (renderer, mesh) = (renderer?, self.overlays.lines()?);
        let (pass, laid) = (self.pass.as_ref()?, self.picture.as_mut()?);
        if let Some((known, lined)) = &laid.lined
            && Arc::ptr_eq(known, mesh)
        {
            return Some(Arc::clone(lined));
        }
        let gpu = renderer.gpu();
        let corners: Vec<LineCorner> = mesh
            .vertices
            .iter()
            .map(|vertex| LineCorner {
                point: vertex.pos.into(),
                texture: [0.0; 2],
                colour: vertex.color.to_array(),
            })
            .collect();
        let place = [rect.min.x, rect.min.y, rect.width(), rect.height()];
        let lines = Lines { corners: &corners, indices: &mesh.indices, place };
        let line_pass = self.lines.get_or_insert_with(|| LinePass::new(gpu));
        let codes = line_pass.picture(gpu, &laid.codes, laid.size_px, &lines);
        let lined = Arc::new(pass.picture(gpu, &codes, self.size_px == laid.size_px));
        laid.lined = Some((Arc::clone(mesh), Arc::clone(&lined)));
        Some(lined)
    }

    /// Shows it where there is room, and gives back how large a picture should be.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk, renderer: Option<&Renderer>) -> [u32; 2] {
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        let scale = ui.ctx().pixels_per_point();
        self.size_px = [rect.width(), rect.height()]
            .map(|points| (points * scale).round().clamp(0.0, 16_384.0) as u32);
        let painter = ui.painter_at(rect);
        let ground = painter.add(Shape::rect_filled(rect, 0.0, Color32::BLACK));
        let underlay = |picture: Arc<OnWindow>| {
            painter.set(ground, Callback::new_paint_callback(rect, Underlay(picture)));
        };
        if let Some(laid) = &self.picture {
            underlay(Arc::clone(&laid.bare));
        }
        let is_seen = rect.width() > LEAST_POINTS && rect.height() > LEAST_POINTS;
        if let Some(shown) = desk.shown.filter(|_| is_seen) {
            let frame = Frame { camera: shown.setting.camera, rect };
            self.overlays.draw(&painter, &frame, shown, desk, self.picture.is_none());
            if let Some(lined) = self.lined(renderer, rect) {
                underlay(lined);
            }
            self.follow_hand(ui, &response, &frame, shown, desk);
        }
        self.size_px
    }

    fn follow_hand(
        &self,
        ui: &Ui,
        response: &egui::Response,
        frame: &Frame,
        shown: &Shown,
        desk: &mut Desk,
    ) {
        let view = &mut desk.model.view;
        let per_point = view.field_deg / f64::from(frame.rect.width().max(1.0));
        if response.drag_started() {
            view.stop();
        }
        if response.dragged() {
            let moved = response.drag_delta();
            view.turn(-f64::from(moved.x) * per_point, f64::from(moved.y) * per_point);
        }
        if response.drag_stopped() {
            let speed = ui.input(|input| input.pointer.velocity());
            if speed.length() > 60.0 {
                view.push(-f64::from(speed.x) * per_point, f64::from(speed.y) * per_point);
            }
        }
        if response.hovered() {
            let (scrolled, pinched) =
                ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            if scrolled != 0.0 {
                desk.actions.push(Action::Zoom(-f64::from(scrolled) * ZOOM_PER_POINT));
            }
            if pinched != 1.0 && pinched > 0.0 {
                desk.actions.push(Action::Zoom(-f64::from(pinched).ln()));
            }
        }
        if response.clicked()
            && let Some(point) = response.interact_pointer_pos()
        {
            let reach_px = CLICK_POINTS * f64::from(ui.ctx().pixels_per_point());
            let pixel = frame.pixel(point);
            let target = pointing::under(pixel, reach_px, shown, desk.model);
            let measured = pointing::direction(pixel, shown).filter(|_| target.is_none());
            desk.actions.push(Action::Select(target));
            desk.actions.extend(measured.map(Action::Measure));
        }
        if response.double_clicked() {
            desk.actions.push(Action::FollowSelected);
        }
    }
}
