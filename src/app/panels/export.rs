//! Pictures and scenes for files, while the window goes on.

use eframe::egui::{ProgressBar, Ui};

use crate::app::action::{Action, Export, PictureFile};

use super::Desk;
use super::controls::{Scale, button, choice, key_of, number};

const FILES: [(PictureFile, &str); 2] =
    [(PictureFile::Png, "PNG, as it is seen"), (PictureFile::Exr, "OpenEXR, light in cd/m²")];
const SIZES: [(Size, &str); 5] = [
    (Size::Window, "As the window"),
    (Size::Pixels([1920, 1080]), "1920 × 1080"),
    (Size::Pixels([3840, 2160]), "4K, 3840 × 2160"),
    (Size::Pixels([7680, 4320]), "8K, 7680 × 4320"),
    (Size::Own, "Own size"),
];
const EDGE: Scale = Scale::factors(16.0, crate::camera::LARGEST_EDGE_PX as f64, " px").whole();

/// How large a picture is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Size {
    Window,
    Pixels([u32; 2]),
    Own,
}

/// What is to be written.
pub struct ExportPanel {
    file: PictureFile,
    size: Size,
    own_px: [f64; 2],
}

impl Default for ExportPanel {
    fn default() -> ExportPanel {
        ExportPanel {
            file: PictureFile::Png,
            size: Size::Pixels([7680, 4320]),
            own_px: [2560.0, 1440.0],
        }
    }
}

impl ExportPanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal_wrapped(|ui| {
            for (words, hint, action) in [
                ("Save what is seen", "A picture of the window", Action::Screenshot),
                ("Copy the scene", "The scene as text, for `nocturne render`", Action::CopyScene),
            ] {
                let key = key_of(ui.ctx(), desk.keys, &action);
                if button(ui, words, &format!("{hint} ({key})")) {
                    desk.actions.push(action);
                }
            }
        });
        ui.separator();
        choice(ui, "File", &mut self.file, &FILES);
        choice(ui, "Size", &mut self.size, &SIZES);
        if self.size == Size::Own {
            number(ui, "Width", &mut self.own_px[0], &EDGE);
            number(ui, "Height", &mut self.own_px[1], &EDGE);
        }
        match desk.errands.progress() {
            None => {
                if button(ui, "Render", "Draws the picture while the window goes on") {
                    desk.actions.push(Action::Export(self.export()));
                }
            }
            Some((what, share)) => {
                let percent = share.clamp(0.0, 1.0) * 100.0;
                ui.add(ProgressBar::new(share).text(format!("{what}, {percent:.0} %")));
                if button(ui, "Cancel", "Stops; nothing is written") {
                    desk.actions.push(Action::CancelExport);
                }
            }
        }
        if let Some(said) = &desk.errands.said {
            ui.label(said);
        }
    }

    fn export(&self) -> Export {
        let size_px = match self.size {
            Size::Window => None,
            Size::Pixels(size_px) => Some(size_px),
            Size::Own => Some(self.own_px.map(|edge| edge as u32)),
        };
        Export { size_px, file: self.file }
    }
}
