//! The bar below the sky, and the windows over it.

pub mod bar;
pub mod info;
pub mod place;
pub mod search;
pub mod time;
pub mod typed;

use eframe::egui::{self, Align2, Context, Id, Pos2, Rect, Ui, Vec2, pos2, vec2};

use super::action::Action;
use super::data::Data;
use super::errands::Errands;
use super::keys::Group;
use super::model::{Model, Panel};
use super::sky::Shown;

pub use theme::theme;

pub mod theme;

mod air;
mod controls;
mod export;
mod help;
mod inspector;
mod layers;
mod viewer;

use air::AirPanel;
use export::ExportPanel;
use help::HelpPanel;
use info::InfoPanel;
use inspector::InspectorPanel;
use layers::LayersPanel;
use search::SearchPanel;
use theme::Dress;
use viewer::ViewerPanel;

/// Panels keep so far from the edges of the window, points.
const MARGIN: f32 = 8.0;
/// A panel covers no more of the width of the window at first, so that the middle stays free.
const WIDEST_SHARE: f32 = 0.46;

/// What a panel works with.
pub struct Desk<'a> {
    pub model: &'a mut Model,
    /// The picture that is seen.
    pub shown: Option<&'a Shown>,
    pub data: &'a Data,
    pub keys: &'a [Group],
    pub errands: &'a Errands,
    /// Why there is no picture of what is wished for.
    pub failure: Option<&'a str>,
    /// What is to be done after the frame.
    pub actions: &'a mut Vec<Action>,
}

/// All panels, each with what is typed into it.
#[derive(Default)]
pub struct Panels {
    /// What the user should know once.
    pub notice: Option<String>,
    pub info: InfoPanel,
    search: SearchPanel,
    bar: bar::Bar,
    time: time::TimePanel,
    place: place::PlacePanel,
    pub inspector: InspectorPanel,
    layers: LayersPanel,
    air: AirPanel,
    viewer: ViewerPanel,
    export: ExportPanel,
    help: HelpPanel,
    /// What the theme was last made for.
    dress: Option<Dress>,
}

impl Panels {
    /// The bar: time, place, and buttons for the panels.
    pub fn bar(&mut self, ui: &mut Ui, desk: &mut Desk) {
        self.bar.show(ui, desk, &mut self.notice);
    }

    /// Gives the window its colours, at the end of a frame: all that was drawn is red where it is to be.
    pub fn dress(&mut self, ctx: &Context, model: &Model) {
        if model.display.red {
            theme::redden(ctx);
        }
        let dress = Dress::of(model);
        if self.dress != Some(dress) {
            self.dress = Some(dress);
            theme(ctx, model);
            ctx.request_repaint();
        }
    }

    /// The panels that are open, over the room of the sky.
    pub fn windows(&mut self, ui: &mut Ui, room: Rect, desk: &mut Desk) {
        let ctx = ui.ctx().clone();
        self.info.show(ui, desk);
        if !desk.model.panels.is_open(Panel::Search) {
            self.search.closed();
        }
        for panel in Panel::ALL {
            if !desk.model.panels.is_open(panel) {
                continue;
            }
            let mut is_open = true;
            let (pivot, corner, size) = first_place(panel, room);
            egui::Window::new(panel.title())
                .id(Id::unique(("panel", panel)))
                .open(&mut is_open)
                .pivot(pivot)
                .default_pos(corner)
                .default_size(size)
                .constrain_to(room)
                .scroll(true)
                .show(&ctx, |ui| self.show(panel, ui, desk));
            if !is_open {
                desk.model.panels.set(panel, false);
            }
        }
    }

    fn show(&mut self, panel: Panel, ui: &mut Ui, desk: &mut Desk) {
        match panel {
            Panel::Time => self.time.show(ui, desk),
            Panel::Place => self.place.show(ui, desk),
            Panel::Search => self.search.show(ui, desk),
            Panel::Layers => self.layers.show(ui, desk),
            Panel::Air => self.air.show(ui, desk),
            Panel::Viewer => self.viewer.show(ui, desk),
            Panel::Export => self.export.show(ui, desk),
            Panel::Inspector => self.inspector.show(ui, desk),
            Panel::Help => self.help.show(ui, desk),
        }
    }
}

/// Where a panel opens for the first time: which of its corners lies where, and its size.
fn first_place(panel: Panel, room: Rect) -> (Align2, Pos2, Vec2) {
    let room = room.shrink(MARGIN);
    let (left, right, top, bottom) = (room.left(), room.right(), room.top(), room.bottom());
    let (pivot, corner, size) = match panel {
        // Beside what is known of what is found.
        Panel::Search => (Align2::CENTER_TOP, pos2(room.center().x, top), vec2(360.0, 420.0)),
        Panel::Place => (Align2::LEFT_BOTTOM, pos2(left, bottom), vec2(560.0, 520.0)),
        Panel::Time => (Align2::RIGHT_BOTTOM, pos2(right, bottom), vec2(580.0, 640.0)),
        Panel::Layers | Panel::Air => (Align2::LEFT_TOP, pos2(left, top), vec2(380.0, 640.0)),
        Panel::Viewer => (Align2::RIGHT_TOP, pos2(right, top), vec2(400.0, 640.0)),
        Panel::Inspector => (Align2::RIGHT_TOP, pos2(right, top), vec2(340.0, 640.0)),
        Panel::Export => (Align2::RIGHT_TOP, pos2(right, top), vec2(360.0, 260.0)),
        Panel::Help => (Align2::LEFT_TOP, pos2(left, top), vec2(580.0, 640.0)),
    };
    let widest = match panel {
        // Of two columns, both of which are wanted.
        Panel::Time | Panel::Place | Panel::Help => 1.0,
        _ => WIDEST_SHARE,
    };
    let largest = vec2(room.width() * widest, room.height());
    // Where the window is small, panels are readable rather than beside the middle.
    let largest = largest.max(vec2(300.0, 120.0)).min(room.size().max(Vec2::splat(1.0)));
    (pivot, corner, size.min(largest))
}
