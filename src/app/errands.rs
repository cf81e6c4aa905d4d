//! What takes longer than a frame: jumps to events, pictures for files. The window goes on meanwhile.

pub mod export;
pub mod jump;

use eframe::egui::Context;

use crate::frame::Dir;
use crate::scene::Marks;
use crate::units::Angle;

use super::action::{Errand, Export, PictureFile};
use super::data::Data;
use super::model::Model;
use super::sky::Shown;
use export::Exports;
use jump::{Jumps, Search};

/// What is at the horizon is shown with so much of the field above it.
const RAISED_FIELDS: f64 = 0.15;
const HIGHEST_RAISED_DEG: f64 = 20.0;

/// What is under way, and what came of it.
#[derive(Default)]
pub struct Errands {
    /// What was done last, or why not, for the bar.
    pub said: Option<String>,
    jumps: Jumps,
    exports: Exports,
}

impl Errands {
    /// What is being made for a file, and how much of it is done, 0 to 1.
    pub fn progress(&self) -> Option<(String, f32)> {
        self.exports.progress().map(|progress| (progress.what, progress.done as f32))
    }

    /// Starts an errand.
    pub fn begin(
        &mut self,
        ctx: &Context,
        errand: Errand,
        model: &Model,
        data: &Data,
        size_px: [u32; 2],
    ) {
        match errand {
            Errand::CopyScene => {
                ctx.copy_text(model.scene(size_px).to_toml());
                self.said = Some("The scene is on the clipboard.".to_owned());
            }
            Errand::Dismiss => self.said = None,
            Errand::Jump(jump, direction) => {
                let place = match model.scene(size_px.map(|edge| edge.max(1))).setting() {
                    Ok(setting) => setting.place,
                    Err(error) => {
                        self.said = Some(error.to_string());
                        return;
                    }
                };
                let search = Search {
                    jump,
                    is_back: direction < 0,
                    from: model.clock.instant,
                    place,
                    selected: model.selected.clone(),
                };
                let wake = ctx.clone();
                self.said = Some(format!("Looking for the {} …", jump.name()));
                self.jumps.begin(search, data.catalogs.clone(), move || wake.request_repaint());
            }
            Errand::Screenshot => {
                let export = Export { size_px: None, file: PictureFile::Png };
                self.export(ctx, export, model, data, size_px);
            }
            Errand::Export(export) => self.export(ctx, export, model, data, size_px),
            Errand::CancelExport => self.exports.cancel(),
            // Of the window itself.
            Errand::ToggleFullScreen | Errand::Quit | Errand::Measure(_) => {}
        }
    }

    fn export(
        &mut self,
        ctx: &Context,
        export: Export,
        model: &Model,
        data: &Data,
        size_px: [u32; 2],
    ) {
        let mut scene = model.scene(export.size_px.unwrap_or(size_px));
        // The picture alone: names and grids stay in the window.
        scene.marks = Marks { horizon: false, cardinal_points: false };
        let folder = export::pictures_folder();
        self.said = match self.exports.begin(ctx, &data.catalogs, scene, export.file, &folder) {
            Ok(()) => Some("Drawing the picture …".to_owned()),
            Err(error) => Some(error.to_string()),
        };
    }

    /// Whether a jump is being looked for.
    pub fn is_jumping(&self) -> bool {
        self.jumps.is_under_way()
    }

    fn end_jump(&mut self, model: &mut Model) {
        let Some(found) = self.jumps.take() else { return };
        match found {
            Ok(found) => {
                model.change_clock(|clock| clock.set(found.instant));
                if let Some(dir) = found.towards {
                    let lowest_deg = (model.view.field_deg * RAISED_FIELDS).min(HIGHEST_RAISED_DEG);
                    let altitude = Angle::from_deg(dir.altitude().deg().max(lowest_deg));
                    let latitude = model.latitude();
                    model.view.look(Dir::from_azimuth_altitude(dir.azimuth(), altitude), latitude);
                }
                self.said = Some(found.words);
            }
            Err(words) => self.said = Some(words),
        }
    }

    /// Takes what has become ready.
    pub fn go_on(
        &mut self,
        _ctx: &Context,
        model: &mut Model,
        _data: &Data,
        _shown: Option<&Shown>,
    ) {
        self.end_jump(model);
        if let Some(words) = self.exports.finished() {
            self.said = Some(words);
        }
    }
}
