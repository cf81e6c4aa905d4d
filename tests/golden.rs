//! Golden pictures: a few small nights, compared as light (X, Y, Z, V) within tolerances.
//!
//! Each `golden/NAME.toml` is a scene, `golden/NAME.exr` the frame that it gave, and
//! `golden/NAME.png` what the eye made of it, for people to look at. `make goldens` draws them
//! again. Without an adapter every test here is reported as ignored.

#[path = "support/mod.rs"]
mod support;

use std::path::{Path, PathBuf};

use libtest_mimic::Failed;
use nocturne::export::{OutputFile, exr, png};
use nocturne::image::HdrFrame;
use nocturne::overlay;
use nocturne::render::picture::Depth;
use nocturne::render::{Look, Renderer, Viewer};
use nocturne::scene::Scene;
use support::{GpuTest, check, drawn, laid};

/// Set to `write` to draw the goldens again.
const WRITE_VARIABLE: &str = "NOCTURNE_GOLDENS";
/// A channel may differ by this share of its value, and of the frame's faintest light, anywhere.
const CLOSE: f64 = 0.02;
/// Share of the channels that may not be close: edges of discs move by a fraction of a texel from
/// driver to driver.
const STRAYS: f64 = 0.003;
/// The light of the whole picture may differ by this share.
const WHOLE: f64 = 0.005;

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(&folder)
        .expect("the folder of the goldens")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    scenes.sort();
    assert!(!scenes.is_empty(), "no scene in {}", folder.display());
    support::run(scenes.into_iter().map(|path| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        GpuTest::new(name, move |renderer| golden(renderer, &path))
    }))
}

fn golden(renderer: &Renderer, path: &Path) -> Result<(), Failed> {
    let scene = Scene::parse(&std::fs::read_to_string(path)?)?;
    if std::env::var(WRITE_VARIABLE).is_ok_and(|value| value == "write") {
        return write(renderer, &scene, path);
    }
    let (frame, _, _) = drawn(renderer, &scene)?;
    let (golden, _) = exr::read(&path.with_extension("exr"))?;
    compare(&frame, &golden)
}

fn write(renderer: &Renderer, scene: &Scene, path: &Path) -> Result<(), Failed> {
    let (plan, _, setting, night) = laid(scene)?;
    let viewer = scene.photo.as_ref().map_or(Viewer::Eye(&scene.eye), Viewer::Photo);
    let look = Look { viewer, display: &scene.display, depth: Depth::Codes };
    let looked = renderer.look(&plan, &look, true)?;
    let frame = looked.frame.ok_or("no frame came with the picture")?;
    exr::write(OutputFile::create(&path.with_extension("exr"))?, &frame, &[])?;
    let mut codes = looked.picture.into_codes(&scene.display);
    overlay::draw(scene.marks, &mut codes, &setting.camera, night.horizon, &scene.display);
    let file = OutputFile::create(&path.with_extension("png"))?;
    Ok(png::write_with(file, &codes, scene.display.space, None)?)
}

fn compare(frame: &HdrFrame, golden: &HdrFrame) -> Result<(), Failed> {
    let sizes = [frame, golden].map(|f| (f.width_px(), f.height_px()));
    check(sizes[0] == sizes[1], || format!("the size is {:?}, not {:?}", sizes[0], sizes[1]))?;
    let channels = |f: &HdrFrame| -> Vec<f64> {
        f.pixels().as_flattened().iter().map(|&value| f64::from(value)).collect()
    };
    let (new, old) = (channels(frame), channels(golden));
    let faintest = old.iter().copied().filter(|&v| v > 0.0).fold(f64::MAX, f64::min);
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > CLOSE * (b + faintest);
    let strays = new.iter().zip(&old).filter(|&pair| far(pair)).count();
    let share = strays as f64 / old.len() as f64;
    check(share <= STRAYS, || format!("{strays} of {} channels differ by over 2 %", old.len()))?;
    // Without the brightest pixels, so that the disc of the Sun does not outweigh the sky.
    let mut order: Vec<usize> = (0..old.len()).collect();
    order.sort_by(|&a, &b| old[a].total_cmp(&old[b]));
    order.truncate(old.len() * 99 / 100);
    let sum = |values: &[f64]| order.iter().map(|&i| values[i]).sum::<f64>();
    let error = sum(&new) / sum(&old) - 1.0;
    check(error.abs() <= WHOLE, || format!("the whole picture's light differs by {error:.4}"))
}
