//! Sheets of skies to look at: an evening from the Sun 30 degrees high to 18 degrees below the horizon, a
//! night under the full Moon, and the shadow of the Earth opposite the sunset.
//!
//! `cargo run --release --example 6_twilight_sheets [folder]` writes `evening.png` (rows: a camera with one
//! exposure for all, an eye that adapts to each), `moonlit.png` and `earth_shadow.png`.

use std::error::Error;
use std::path::{Path, PathBuf};

use nocturne::air::Atmosphere;
use nocturne::camera::Projection;
use nocturne::catalog::Catalogs;
use nocturne::display::Display;
use nocturne::ephemeris::Ephemeris;
use nocturne::export::{OutputFile, png};
use nocturne::eye::Eye;
use nocturne::image::Image;
use nocturne::light::night::Night;
use nocturne::light::night_lights::NightGlow;
use nocturne::photo::Photo;
use nocturne::plan::lay::lay;
use nocturne::render::picture::{Depth, Picture};
use nocturne::render::{Look, Renderer, Viewer};
use nocturne::scene::{FORMAT, Layers, Marks, Scene, SceneCamera, SceneMoon, ScenePlace};
use nocturne::sky::{BodyState, SkyState};
use nocturne::units::Angle;

type Outcome<T> = Result<T, Box<dyn Error>>;

const SUNS_DEG: [f64; 10] = [30.0, 5.0, 0.0, -2.0, -4.0, -6.0, -9.0, -12.0, -15.0, -18.0];
/// How long the camera of the upper row is open, seconds: right at f/2.8 and ISO 100 for the sky soon after
/// sunset, 20 cd/m2.
const OPEN_S: f64 = 0.05;
const SIDE_PX: u32 = 200;

/// What draws, and where.
struct Studio {
    catalogs: Catalogs,
    ephemeris: Ephemeris,
    renderer: Renderer,
    air: Atmosphere,
}

fn main() -> Outcome<()> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("."), PathBuf::from);
    let air = match std::env::args().nth(2) {
        Some(name) => Atmosphere::named(&name)?,
        None => Atmosphere::default(),
    };
    let catalogs = Catalogs::locate(None)?;
    let ephemeris = Ephemeris::load(&catalogs, Angle::from_arcsec(1.0))?;
    let studio = Studio { catalogs, ephemeris, renderer: Renderer::new()?, air };

    // An evening at new Moon: minutes after 2026-08-12 20:00 UTC.
    let evening = |minute: f64| utc(2026, 8, 12, 20.0 * 60.0 + minute);
    let (mut fixed, mut adapted) = (Vec::new(), Vec::new());
    let mut camera =
        Photo { shutter_s: Some(OPEN_S), iso: Some(100.0), noise: false, ..Photo::default() };
    camera.lens.vignetting = false;
    let (camera, eye) = (Viewer::Photo(&camera), Eye::default());
    for sun_deg in SUNS_DEG {
        let minute = studio.when(evening, 0.0, 620.0, sun_deg, |sky| &sky.sun)?;
        let scene = studio.all_sky(evening(minute));
        fixed.push(studio.draw(&scene, camera)?);
        adapted.push(studio.draw(&scene, Viewer::Eye(&eye))?);
        println!("Sun {sun_deg:>4}°: {}", scene.utc);
    }
    write(&folder.join("evening.png"), &sheet(&[fixed, adapted]))?;

    // A night of full Moon: 2026-08-28, when it rises to 45 degrees.
    let night = |minute: f64| utc(2026, 8, 28, 2.0 * 60.0 + minute);
    let minute = studio.when(night, 300.0, 60.0, 40.0, |sky| &sky.moon.state)?;
    let scene = studio.all_sky(night(minute));
    println!("Moon: {}", scene.utc);
    let keen = Eye { adaptation_cd_m2: Some(0.02), ..Eye::default() };
    let panels = [&keen, &eye].map(|eye| studio.draw(&scene, Viewer::Eye(eye)));
    let panels = panels.into_iter().collect::<Outcome<Vec<_>>>()?;
    write(&folder.join("moonlit.png"), &sheet(&[panels]))?;

    // Opposite the sunset, three degrees after it.
    let minute = studio.when(evening, 0.0, 620.0, -3.0, |sky| &sky.sun)?;
    let mut scene = studio.all_sky(evening(minute));
    scene.camera = SceneCamera {
        azimuth_deg: 110.0,
        altitude_deg: 0.0,
        roll_deg: 0.0,
        field_of_view_deg: 150.0,
        projection: Projection::Equirectangular,
        width_px: 1500,
        height_px: 450,
    };
    write(&folder.join("earth_shadow.png"), &studio.draw(&scene, Viewer::Eye(&eye))?)
}

impl Studio {
    /// When a body stands at an altitude, minutes; it is higher at `high` than at `low`.
    fn when(
        &self,
        clock: impl Fn(f64) -> String,
        mut high: f64,
        mut low: f64,
        altitude_deg: f64,
        body: impl Fn(&SkyState) -> &BodyState,
    ) -> Outcome<f64> {
        for _ in 0..24 {
            let middle = 0.5 * (high + low);
            let setting = self.all_sky(clock(middle)).setting()?;
            let tolerance = Angle::from_arcsec(10.0);
            let sky = SkyState::at(&self.ephemeris, &setting.instant, &setting.place, tolerance)?;
            match body(&sky).dir.altitude().deg() > altitude_deg {
                true => high = middle,
                false => low = middle,
            }
        }
        Ok(0.5 * (high + low))
    }

    /// The whole sky over a clear place at sea level.
    fn all_sky(&self, utc: String) -> Scene {
        Scene {
            nocturne_scene: FORMAT,
            utc,
            tolerance_arcsec: None,
            place: ScenePlace {
                name: None,
                latitude_deg: 35.2,
                longitude_deg: -111.65,
                height_m: 0.0,
                time_zone: None,
            },
            camera: SceneCamera {
                azimuth_deg: 180.0,
                altitude_deg: 90.0,
                roll_deg: 0.0,
                field_of_view_deg: 184.0,
                projection: Projection::Equidistant,
                width_px: SIDE_PX,
                height_px: SIDE_PX,
            },
            layers: Layers::default(),
            air: self.air.clone(),
            sky: None,
            scintillation: None,
            night: NightGlow::default(),
            moon: SceneMoon::default(),
            eye: Eye::default(),
            photo: None,
            display: Display::default(),
            marks: Marks { horizon: false, cardinal_points: false },
        }
    }

    fn draw(&self, scene: &Scene, viewer: Viewer) -> Outcome<Image<[u8; 3]>> {
        let setting = scene.setting()?;
        let sky =
            SkyState::at(&self.ephemeris, &setting.instant, &setting.place, setting.tolerance)?;
        let night = Night::of(sky, self.catalogs.stars()?, &scene.air);
        let (plan, _) = lay(&setting, &scene.layers, &night, &self.catalogs)?;
        let look = Look { viewer, display: &scene.display, depth: Depth::Codes };
        match self.renderer.look(&plan, &look, false)?.picture {
            Picture::Codes(picture) => Ok(picture),
            Picture::Linear(_) => Err("no codes were asked for".into()),
        }
    }
}

/// An instant from a date and minutes after its beginning.
fn utc(year: i32, month: u32, day: u32, minute: f64) -> String {
    let (days, minute) = ((minute / 1440.0).floor(), minute.rem_euclid(1440.0));
    let day = day + days as u32;
    let seconds = (minute * 60.0).round() as u32;
    let (hour, minute, second) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    format!("{year}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Panels side by side, row below row.
fn sheet(rows: &[Vec<Image<[u8; 3]>>]) -> Image<[u8; 3]> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0) as u32;
    let mut sheet = Image::filled(columns * SIDE_PX, rows.len() as u32 * SIDE_PX, [0; 3]);
    let width_px = sheet.width_px();
    for (row, panels) in rows.iter().enumerate() {
        for (column, panel) in panels.iter().enumerate() {
            for y in 0..panel.height_px() {
                for x in 0..panel.width_px() {
                    let to = (row as u32 * SIDE_PX + y) * width_px + column as u32 * SIDE_PX + x;
                    sheet.pixels_mut()[to as usize] = panel.at(x, y);
                }
            }
        }
    }
    sheet
}

fn write(path: &Path, picture: &Image<[u8; 3]>) -> Outcome<()> {
    png::write(OutputFile::create(path)?, picture)?;
    println!("{}", path.display());
    Ok(())
}
