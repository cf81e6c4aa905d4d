//! Pictures for files, made beside the window through the same jobs as the command line's.

use std::path::{Path, PathBuf};

use eframe::egui::Context;

use crate::app::action::PictureFile;
use crate::catalog::Catalogs;
use crate::job::runner::Runner;
use crate::job::steps::Progress;
use crate::job::still::{self, Still};
use crate::job::{JobError, Written};
use crate::render::Renderer;
use crate::scene::Scene;
use crate::store::Store;
use crate::studio::Studio;

/// The job of the window: one at a time.
#[derive(Default)]
pub struct Exports {
    runner: Option<Runner>,
}

impl Exports {
    /// Begins to draw a scene into a new file of a folder.
    pub fn begin(
        &mut self,
        ctx: &Context,
        catalogs: &Catalogs,
        scene: Scene,
        file: PictureFile,
        folder: &Path,
    ) -> Result<(), JobError> {
        let runner = self.runner.get_or_insert_with(|| {
            let ctx = ctx.clone();
            Runner::new(move || ctx.request_repaint())
        });
        let path = free_name(folder, &scene.utc, file.extension());
        let catalogs = catalogs.clone();
        runner.start(move |steps| {
            // On a device of its own: that of the window has a picture to show.
            let renderer = Renderer::new()?;
            let mut studio = Studio::open(&catalogs, Store::of_user())?;
            still::run(&Still::new(scene, vec![path]), &mut studio, &renderer, steps)
        })
    }

    pub fn progress(&self) -> Option<Progress> {
        self.runner.as_ref().and_then(Runner::progress)
    }

    pub fn cancel(&self) {
        if let Some(runner) = &self.runner {
            runner.cancel();
        }
    }

    /// What came of it, in a sentence, told once.
    pub fn finished(&mut self) -> Option<String> {
        let result = self.runner.as_mut()?.finished()?;
        Some(match result {
            Ok(Written { paths, .. }) => {
                let paths: Vec<String> =
                    paths.iter().map(|path| path.display().to_string()).collect();
                format!("Wrote {}.", paths.join(" and "))
            }
            Err(error) => format!("No picture was written: {error}."),
        })
    }
}

/// Where pictures go: the user's folder for them, else the home folder, else where the program was
/// started.
pub fn pictures_folder() -> PathBuf {
    dirs::picture_dir()
        .filter(|folder| folder.is_dir())
        .or_else(dirs::home_dir)
        .unwrap_or_else(|| PathBuf::from("."))
}

/// A name that no file has yet: `nocturne-2026-08-13T043000Z.png`, then `…-2.png`.
fn free_name(folder: &Path, utc: &str, extension: &str) -> PathBuf {
    let stem: String = utc.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    let name = |number: u32| match number {
        1 => format!("nocturne-{stem}.{extension}"),
        number => format!("nocturne-{stem}-{number}.{extension}"),
    };
    let free = (1..).map(|number| folder.join(name(number))).find(|path| !path.exists());
    free.unwrap_or_else(|| folder.join(name(1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_free() {
        let folder = tempfile::tempdir().unwrap();
        let first = free_name(folder.path(), "2026-08-13T04:30:00Z", "png");
        assert!(first.ends_with("nocturne-2026-08-13T043000Z.png"), "{first:?}");
        std::fs::write(&first, "").unwrap();
        let second = free_name(folder.path(), "2026-08-13T04:30:00Z", "png");
        assert!(second.ends_with("nocturne-2026-08-13T043000Z-2.png"), "{second:?}");
    }
}
