//! A picture: a scene, its plan, the frame that the GPU draws, and what an eye sees of it.
//!
//! `cargo run --release --example 4_draw_a_picture [sky.png]`

use std::error::Error;
use std::path::PathBuf;

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::export::{OutputFile, png};
use nocturne::light::night::Night;
use nocturne::plan::lay::lay;
use nocturne::render::picture::Depth;
use nocturne::render::{Look, Made, Renderer, Viewer};
use nocturne::scene::Scene;
use nocturne::sky::SkyState;

const SCENE: &str = r#"
nocturne_scene = 2
utc = "2026-12-25T06:00:00Z"
place = { latitude_deg = 35.198, longitude_deg = -111.651, height_m = 2106.0 }
camera = { azimuth_deg = 165.0, altitude_deg = 40.0, field_of_view_deg = 90.0, projection = "stereographic", width_px = 1280, height_px = 720 }
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("sky.png"), PathBuf::from);
    let catalogs = Catalogs::locate(None)?;
    let scene = Scene::parse(SCENE)?;
    let setting = scene.setting()?;
    // Where everything stands, how bright it is, and where on the picture it falls.
    let ephemeris = Ephemeris::load(&catalogs, setting.tolerance)?;
    let sky = SkyState::at(&ephemeris, &setting.instant, &setting.place, setting.tolerance)?;
    let night = Night::of(sky, catalogs.stars()?, &scene.air);
    let (plan, _) = lay(&setting, &scene.layers, &night, &catalogs)?;
    // The frame is in cd/m2, from the dark between the stars to the disc of the Sun; an eye looks at it.
    let viewer = Viewer::Eye(&scene.eye);
    let look = Look { viewer, display: &scene.display, depth: Depth::Codes };
    let looked = Renderer::new()?.look(&plan, &look, false)?;
    let codes = looked.picture.into_codes(&scene.display);
    png::write_with(OutputFile::create(&path)?, &codes, scene.display.space, None)?;
    if let Made::Seen(seeing) = looked.made {
        println!("{}: an eye adapted to {:.2e} cd/m2", path.display(), seeing.adaptation_cd_m2);
    }
    Ok(())
}
