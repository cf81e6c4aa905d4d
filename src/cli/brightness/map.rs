//! Maps of the brightness of the whole sky.

use std::path::PathBuf;

use rayon::prelude::*;

use crate::camera::{Camera, Projection};
use crate::catalog::Catalogs;
use crate::export::exr::Attribute;
use crate::export::{OutputFile, exr, png};
use crate::image::{HdrFrame, Image};
use crate::light::moon::Reflectance;
use crate::light::night::Night;
use crate::light::night_lights::NightGlow;
use crate::light::photometry::luminance_cd_m2;
use crate::plan::lay::{Kept, lay_in};
use crate::scene::{Layers, Setting};
use crate::units::Angle;

use super::CliError;

/// Colours of the map from the brightest to the darkest, sRGB: the anchors of matplotlib's "inferno".
const COLOURS: [[f64; 3]; 9] = [
    [252.0, 255.0, 164.0],
    [249.0, 201.0, 50.0],
    [249.0, 142.0, 9.0],
    [227.0, 89.0, 51.0],
    [188.0, 55.0, 84.0],
    [138.0, 34.0, 106.0],
    [87.0, 16.0, 110.0],
    [33.0, 12.0, 74.0],
    [0.0, 0.0, 4.0],
];
/// Colour of what is no sky.
const OUTSIDE: [u8; 3] = [40, 40, 40];

/// How a map is written.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Exr,
    Png,
}

/// Files of maps, opened before the work.
pub struct Maps(Vec<(Kind, OutputFile)>);

/// Opens the files that maps are asked for in.
pub fn open(paths: &[PathBuf]) -> Result<Maps, CliError> {
    let open = |path: &PathBuf| {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let kind = match ending.as_deref() {
            Some("exr") => Kind::Exr,
            Some("png") => Kind::Png,
            _ => {
                let message =
                    format!("--map {}: give a file that ends in .exr or .png", path.display());
                return Err(CliError::Usage(message));
            }
        };
        Ok((kind, OutputFile::create(path)?))
    };
    Ok(Maps(paths.iter().map(open).collect::<Result<_, CliError>>()?))
}

/// Writes them; says what the colours mean, if there are any.
pub fn write(
    maps: Maps,
    size_px: u32,
    night: &Night,
    glow: &NightGlow,
    catalogs: &Catalogs,
    kept: &mut Kept,
) -> Result<Option<String>, CliError> {
    if maps.0.is_empty() {
        return Ok(None);
    }
    let frame = luminances(size_px, night, glow, catalogs, kept)?;
    let mut scale = None;
    for (kind, file) in maps.0 {
        match kind {
            Kind::Exr => {
                let text = |text: &str| Attribute::Text(text.to_owned());
                let attributes = [
                    ("content", text("luminance of the sky, cd/m2")),
                    ("projection", text("equidistant from the zenith, north up, east left")),
                    ("utc", Attribute::Text(night.sky.instant.to_string())),
                    ("latitude_deg", Attribute::Number(night.sky.place.latitude.deg())),
                    ("longitude_deg", Attribute::Number(night.sky.place.longitude.deg())),
                ];
                exr::write(file, &frame, &attributes)?;
            }
            Kind::Png => {
                let (picture, said) = false_colours(&frame);
                png::write(file, &picture)?;
                scale = Some(said);
            }
        }
    }
    Ok(scale)
}

/// The sky as a fisheye sees it that looks up, without what is drawn one by one.
fn luminances(
    size_px: u32,
    night: &Night,
    glow: &NightGlow,
    catalogs: &Catalogs,
    kept: &mut Kept,
) -> Result<HdrFrame, CliError> {
    let camera = Camera {
        projection: Projection::Equidistant,
        field_of_view: Angle::from_deg(180.0),
        azimuth: Angle::from_deg(180.0),
        altitude: Angle::from_deg(90.0),
        roll: Angle::ZERO,
        width_px: size_px,
        height_px: size_px,
    };
    let setting = Setting {
        instant: night.sky.instant,
        place: night.sky.place.clone(),
        camera,
        tolerance: camera.pixel_angle(),
        sky: None,
        night: *glow,
        reflectance: Reflectance::default(),
        scintillation: None,
    };
    let layers =
        Layers { sun: false, moon: false, planets: false, stars: false, ..Layers::default() };
    let (plan, _) = lay_in(&setting, &layers, night, catalogs, kept)?;
    let apparent_from_view = camera.view_from_apparent().inverse();
    let pixels = (0..size_px * size_px).into_par_iter().map(|pixel| {
        let middle = [pixel % size_px, pixel / size_px].map(|px| f64::from(px) + 0.5);
        let view = camera.view_from_pixel(middle);
        let dir = view.map(|view| apparent_from_view * view);
        let Some(dir) = dir.filter(|dir| dir.altitude() >= plan.sky.horizon) else {
            return [0.0; 4];
        };
        let stars = plan.milky_way.as_ref().map(|milky_way| milky_way.luminance(dir));
        (plan.sky.luminance(dir) + stars.unwrap_or_default()).to_f32()
    });
    let frame = HdrFrame::from_pixels(size_px, size_px, pixels.collect());
    frame.ok_or_else(|| CliError::Failure("the map has no pixels".to_owned()))
}

/// The map in colours by magnitudes, and what they mean.
fn false_colours(frame: &HdrFrame) -> (Image<[u8; 3]>, String) {
    let mag = |pixel: [f32; 4]| (pixel[1] > 0.0).then(|| 12.58 - 2.5 * f64::from(pixel[1]).log10());
    let mags = || frame.pixels().iter().filter_map(|pixel| mag(*pixel));
    let brightest = mags().fold(f64::INFINITY, f64::min);
    let darkest = mags().fold(f64::NEG_INFINITY, f64::max);
    let colour = |pixel: [f32; 4]| {
        let Some(mag) = mag(pixel) else { return OUTSIDE };
        let share = (mag - brightest) / (darkest - brightest).max(1e-9);
        let place = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
        let before = (place as usize).min(COLOURS.len() - 2);
        let along = place - before as f64;
        std::array::from_fn(|channel| {
            let (a, b) = (COLOURS[before][channel], COLOURS[before + 1][channel]);
            (a + (b - a) * along).round() as u8
        })
    };
    let picture = frame.map(colour);
    let scale = match brightest.is_finite() {
        true => format!(
            "Map: from black, {darkest:.2} mag/arcsec2 ({:.2e} cd/m2), to pale yellow, \
             {brightest:.2} ({:.2e} cd/m2)",
            luminance_cd_m2(darkest),
            luminance_cd_m2(brightest)
        ),
        false => "Map: no light at all".to_owned(),
    };
    (picture, scale)
}
