//! Twelve skies, each three ways: as an eye sees it, as the eye of Jensen et al. 2001, as a camera.
//!
//! `cargo run --release --example 8_eye_and_camera [folder]` reads the scenes of a folder (`NAME.toml`, each
//! with a table `[photo]`), writes the three pictures of each side by side (`NAME.png`), and says what eye
//! and camera were set to. Names of scenes after the folder draw those alone.
//!
//! While the shutter is open, points of light move with the sky: the splats of many instants are
//! merged, each with its share of the time and no more than half a pixel from the next. The sky, the Milky Way
//! and discs stand as they are in the middle of that time, when the eyes look.

use std::error::Error;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::export::{OutputFile, png};
use nocturne::eye::{Eye, Model};
use nocturne::image::Image;
use nocturne::light::night::Night;
use nocturne::photo::Photo;
use nocturne::plan::FramePlan;
use nocturne::plan::lay::{Kept, lay_in};
use nocturne::render::picture::{Depth, Picture};
use nocturne::render::{Look, Made, Renderer, Viewer};
use nocturne::scene::{Layers, Scene, Setting};
use nocturne::sky::SkyState;
use nocturne::store::Store;
use nocturne::units::Angle;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Between two panels, pixels.
const GAP_PX: u32 = 8;
/// How far the sky turns in a second of time, arcseconds.
const TURN_ARCSEC_PER_S: f64 = 15.041;
/// How far a star moves from one splat to the next, pixels, at most.
const STEP_PX: f64 = 0.5;

/// What draws.
struct Studio {
    catalogs: Catalogs,
    renderer: Renderer,
}

fn main() -> Outcome<()> {
    let mut arguments = std::env::args_os().skip(1);
    let folder =
        arguments.next().map_or_else(|| PathBuf::from("docs/eye_and_camera"), PathBuf::from);
    let wanted: Vec<OsString> = arguments.collect();
    let studio = Studio { catalogs: Catalogs::locate(None)?, renderer: Renderer::new()? };
    for path in scenes(&folder, &wanted)? {
        let scene = Scene::parse(&std::fs::read_to_string(&path)?)?;
        let picture = studio.three_ways(&scene)?;
        let path = path.with_extension("png");
        png::write(OutputFile::create(&path)?, &picture)?;
        println!("{}", path.display());
    }
    Ok(())
}

/// The scene files of a folder, by name; those that are wanted, or all.
fn scenes(folder: &Path, wanted: &[OsString]) -> Outcome<Vec<PathBuf>> {
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let is_scene = path.extension().is_some_and(|extension| extension == "toml");
        let name = path.file_stem().unwrap_or_default();
        if is_scene && (wanted.is_empty() || wanted.iter().any(|wanted| wanted == name)) {
            paths.push(path);
        }
    }
    paths.sort();
    match paths.is_empty() {
        true => Err(format!("no such scene in {}; give a folder of them", folder.display()).into()),
        false => Ok(paths),
    }
}

impl Studio {
    fn three_ways(&self, scene: &Scene) -> Outcome<Image<[u8; 3]>> {
        let setting = scene.setting()?;
        let photo = scene.photo.ok_or("the scene has no [photo]; add that table")?;
        let field = Angle::from_deg(scene.camera.field_of_view_deg);
        let lens = photo.lens.spanning(field, &photo.body.sensor()).unwrap_or(photo.lens);
        let photo = Photo { lens, ..photo };
        let paper = Eye { model: Model::Paper, ..scene.eye.clone() };

        let mut kept = Kept::new(Store::of_user());
        let plan = self.plan(&setting, scene, &scene.layers, &mut kept)?;
        let exposed = self.exposed(&plan, &setting, scene, &photo)?;
        let mut panels = Vec::new();
        for (plan, viewer) in [
            (&plan, Viewer::Eye(&scene.eye)),
            (&plan, Viewer::Eye(&paper)),
            (&exposed, Viewer::Photo(&photo)),
        ] {
            let look = Look { viewer, display: &scene.display, depth: Depth::Codes };
            let looked = self.renderer.look(plan, &look, false)?;
            match looked.made {
                Made::Seen(seeing) => println!(
                    "  adapted to {:.2e} cd/m2, pupil {:.1} mm",
                    seeing.adaptation_cd_m2, seeing.pupil_mm
                ),
                Made::Exposed(exposure) => println!("  {exposure}"),
            }
            match looked.picture {
                Picture::Codes(codes) => panels.push(codes),
                Picture::Linear(_) => return Err("no codes were asked for".into()),
            }
        }
        Ok(beside(&panels))
    }

    fn plan(
        &self,
        setting: &Setting,
        scene: &Scene,
        layers: &Layers,
        kept: &mut Kept,
    ) -> Outcome<FramePlan> {
        let Setting { instant, place, tolerance, .. } = setting;
        let ephemeris = Ephemeris::load(&self.catalogs, *tolerance)?;
        let sky = SkyState::at(&ephemeris, instant, place, *tolerance)?;
        let stars = self.catalogs.stars()?;
        let night = Night::with_danjon(sky, stars, &scene.air, scene.moon.danjon);
        Ok(lay_in(setting, layers, &night, &self.catalogs, kept)?.0)
    }

    /// The plan with its points of light drawn out by the turning of the sky.
    fn exposed(
        &self,
        plan: &FramePlan,
        setting: &Setting,
        scene: &Scene,
        photo: &Photo,
    ) -> Outcome<FramePlan> {
        let open_s = photo.shutter_s.unwrap_or(0.0);
        let pixel_arcsec = plan.camera.pixel_angle().arcsec();
        let steps =
            (open_s * TURN_ARCSEC_PER_S / (STEP_PX * pixel_arcsec)).ceil().max(1.0) as usize;
        if steps == 1 {
            return Ok(plan.clone());
        }
        // The points alone.
        let layers = Layers { skylight: false, ground: false, ..scene.layers.clone() };
        let mut kept = Kept::new(Store::NONE);
        let mut splats = Vec::new();
        for step in 0..steps {
            let from_middle = (step as f64 + 0.5) / steps as f64 - 0.5;
            let instant = setting.instant.plus_seconds(from_middle * open_s)?;
            let setting = Setting { instant, ..setting.clone() };
            let mut then = self.plan(&setting, scene, &layers, &mut kept)?.splats;
            for splat in &mut then {
                splat.illuminance = splat.illuminance * (1.0 / steps as f64);
            }
            splats.append(&mut then);
        }
        println!("  {steps} instants, {} points of light", splats.len());
        Ok(FramePlan { splats, ..plan.clone() })
    }
}

/// Panels of one size side by side.
fn beside(panels: &[Image<[u8; 3]>]) -> Image<[u8; 3]> {
    let Some(first) = panels.first() else { return Image::filled(0, 0, [0; 3]) };
    let (width, height) = (first.width_px(), first.height_px());
    let columns = panels.len() as u32;
    let mut sheet = Image::filled(columns * width + (columns - 1) * GAP_PX, height, [255; 3]);
    let sheet_width = sheet.width_px() as usize;
    for (column, panel) in panels.iter().enumerate() {
        let left = column * (width + GAP_PX) as usize;
        for (y, row) in panel.pixels().chunks(width as usize).enumerate() {
            sheet.pixels_mut()[y * sheet_width + left..][..row.len()].copy_from_slice(row);
        }
    }
    sheet
}
