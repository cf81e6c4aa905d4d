//! The pictures of cameras that the GPU makes, against their twins. Without an adapter every test here
//! is reported as ignored.

#[path = "support/mod.rs"]
mod support;

use glam::{DMat3, DVec3};
use libtest_mimic::Failed;
use nocturne::camera::{Camera, Projection};
use nocturne::display::{ColourSpace, Display};
use nocturne::image::{HdrFrame, Image};
use nocturne::photo::exposure::{Exposure, metered};
use nocturne::photo::lens::{Falloff, Lens};
use nocturne::photo::sensor::SensorKind;
use nocturne::photo::{Curve, Photo};
use nocturne::plan::{FramePlan, SkyPlan, Splat};
use nocturne::render::Renderer;
use nocturne::render::picture::{Depth, Picture};
use nocturne::render::{Look, Viewer};
use nocturne::units::{Angle, Xyzv};
use support::{GpuTest, check, illuminance};

fn main() {
    support::run([
        GpuTest::new("the_screen_of_the_gpu_is_its_twin", the_screen_is_its_twin),
        GpuTest::new("the_camera_of_the_gpu_is_its_twin", the_camera_is_its_twin),
        GpuTest::new("no_light_makes_a_picture_that_is_no_number", every_light_is_a_number),
        GpuTest::new("spikes_keep_the_light_of_their_star", spikes_keep_light),
    ])
}

fn looked(
    renderer: &Renderer,
    frame: &HdrFrame,
    exposure: &Exposure,
    display: &Display,
    depth: Depth,
) -> Result<Picture, Failed> {
    let look = Look { viewer: Viewer::Exposure(exposure), display, depth };
    let camera = camera(frame.width_px(), frame.height_px());
    Ok(renderer.look_at(frame, &camera, &[], &look)?.picture)
}

/// The picture of a frame, 8 bits a channel.
fn coded(
    renderer: &Renderer,
    frame: &HdrFrame,
    exposure: &Exposure,
    display: &Display,
) -> Result<Image<[u8; 3]>, Failed> {
    match looked(renderer, frame, exposure, display, Depth::Codes)? {
        Picture::Codes(codes) => Ok(codes),
        Picture::Linear(_) => Err("no codes".into()),
    }
}

/// The same before it is rounded, 0 to 1.
fn deep(
    renderer: &Renderer,
    frame: &HdrFrame,
    exposure: &Exposure,
    display: &Display,
) -> Result<Image<[f32; 3]>, Failed> {
    match looked(renderer, frame, exposure, display, Depth::Linear)? {
        Picture::Linear(light) => {
            Ok(light.map(|rgb| display.encoded(rgb.map(f64::from)).map(|code| code as f32)))
        }
        Picture::Codes(_) => Err("no light".into()),
    }
}

fn camera(width_px: u32, height_px: u32) -> Camera {
    Camera {
        projection: Projection::Perspective,
        field_of_view: Angle::from_deg(60.0),
        azimuth: Angle::ZERO,
        altitude: Angle::from_deg(30.0),
        roll: Angle::ZERO,
        width_px,
        height_px,
    }
}

/// A camera that hands X, Y and Z from 0 to 1 through as they are.
fn window(size: u32) -> Exposure {
    let open = Photo { noise: false, curve: Curve::Linear, ..Photo::default() };
    let exposure = open.exposed(&metered(&[]), &camera(size, size));
    Exposure {
        raw_from_xyz: DMat3::IDENTITY,
        balance: DVec3::ONE,
        xyz_from_balanced: DMat3::IDENTITY,
        falloff: Falloff { natural: 0.0, mechanical: 0.0 },
        ..exposure
    }
}

/// Colours in and out of the gamut, dark and bright.
fn colours(size: u32) -> HdrFrame {
    let mut frame = Image::filled(size, size, [0.0f32; 4]);
    for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
        let (x, y) = (index as u32 % size, index as u32 / size);
        let level = (f64::from(x) / f64::from(size - 1)).powi(3);
        let angle = f64::from(y) * 0.7;
        let light = [0.95 + 0.4 * angle.sin(), 1.0, 1.09 + 0.9 * angle.cos()];
        *pixel = [light[0], light[1], light[2], 2.0].map(|v| (v * level) as f32);
    }
    frame
}

fn the_screen_is_its_twin(renderer: &Renderer) -> Result<(), Failed> {
    let (frame, exposure) = (colours(128), window(128));
    for space in [ColourSpace::Srgb, ColourSpace::DisplayP3, ColourSpace::Linear] {
        for red in [false, true] {
            let display = Display { space, red, ..Display::default() };
            let exact = deep(renderer, &frame, &exposure, &display)?;
            let rounded = coded(renderer, &frame, &exposure, &display)?;
            let (mut worst, mut differ) = (0.0f64, 0);
            for (y, x) in (0..128).flat_map(|y| (0..128).map(move |x| (y, x))) {
                let light = frame.xyzv(x, y);
                let xyz = [light.x, light.y, light.z].map(|v| v.min(1.0));
                for (shown, meant) in exact.at(x, y).into_iter().zip(display.encoded_xyz(xyz)) {
                    worst = worst.max((f64::from(shown) - meant).abs());
                }
                for (shown, meant) in rounded.at(x, y).iter().zip(display.code(xyz, x, y)) {
                    let off = shown.abs_diff(meant);
                    check(off <= 1, || format!("{space:?} {x} {y}: {shown}, not {meant}"))?;
                    differ += u32::from(off);
                }
            }
            check(worst < 2e-4, || format!("{space:?}, red {red}: off by {worst}"))?;
            // Where a code lies on the edge between two: the curve in 32 bits is off by up to 1.5e-4, 4 % of a
            // code.
            check(differ < 3 * 128 * 128 / 25, || {
                format!("{space:?}, red {red}: {differ} differ")
            })?;
        }
    }
    Ok(())
}

fn the_camera_is_its_twin(renderer: &Renderer) -> Result<(), Failed> {
    let size = 96;
    let frame = colours(size);
    for (noise, curve, kelvin) in
        [(false, Curve::Film, 6500.0), (true, Curve::Film, 3000.0), (true, Curve::Linear, 5000.0)]
    {
        let white_balance = nocturne::photo::colour::WhiteBalance::Kelvin(kelvin);
        let photo =
            Photo { noise, curve, white_balance, seed: 11, iso: Some(6400.0), ..Photo::default() };
        let exposure =
            photo.exposed(&metered(&[Xyzv::new(0.2, 0.2, 0.2, 0.4)]), &camera(size, size));
        let display = Display { dither: false, ..Display::default() };
        let shown = deep(renderer, &frame, &exposure, &display)?;
        for (y, x) in (0..size).flat_map(|y| (0..size).map(move |x| (y, x))) {
            let rgb = exposure.developed(exposure.raw(frame.xyzv(x, y), x, y), &display);
            let meant = display.encoded(rgb.clamp(DVec3::ZERO, DVec3::ONE).to_array());
            for (shown, meant) in shown.at(x, y).into_iter().zip(meant) {
                let off = (f64::from(shown) - meant).abs();
                check(off < 5e-4, || format!("{noise} {curve:?} {x} {y}: {shown}, not {meant}"))?;
            }
        }
        let codes = coded(renderer, &frame, &exposure, &display)?;
        check(codes == coded(renderer, &frame, &exposure, &display)?, || {
            "the same settings made another picture".to_owned()
        })?;
    }
    Ok(())
}

fn every_light_is_a_number(renderer: &Renderer) -> Result<(), Failed> {
    let mut frame = Image::filled(64, 16, [0.0f32; 4]);
    for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
        let luminance = match index % 64 {
            0 => 0.0,
            step => 10f64.powf(step as f64 / 63.0 * 50.0 - 40.0),
        };
        // White, the colour of sodium, and a light that has no colour at all.
        let light = [[0.95, 1.0, 1.09], [1.36, 1.0, 0.01], [0.0, 1.0, 0.0]][index / 64 % 3];
        *pixel = [light[0], light[1], light[2], 1.0].map(|v| (v * luminance) as f32);
    }
    for metered_at in [0.0, 1e-7, 1.0, 1e9] {
        let reading = metered(&[Xyzv::new(metered_at, metered_at, metered_at, metered_at)]);
        let exposure = Photo::default().exposed(&reading, &camera(64, 16));
        let shown = deep(renderer, &frame, &exposure, &Display::default())?;
        let fine = |v: &f32| (0.0..=1.0).contains(v);
        let bad = shown.pixels().iter().position(|pixel| !pixel.iter().all(fine));
        check(bad.is_none(), || format!("metered at {metered_at}: pixel {bad:?}"))?;
    }
    Ok(())
}

fn spikes_keep_light(renderer: &Renderer) -> Result<(), Failed> {
    let camera = Camera { field_of_view: Angle::from_deg(20.0), ..camera(800, 600) };
    let star = Xyzv::new(2.6e-6, 2.5e-6, 2.4e-6, 5e-6);
    let sensor = SensorKind::FullFrame.sensor();
    for blades in [4, 5, 9] {
        let lens = Lens { blades, blades_turn_deg: 13.0, f_number: 11.0, ..Lens::default() };
        let spikes = lens.spikes(&sensor, 800).ok_or("no spikes")?;
        let centre_px = [400.3, 299.8];
        let (left, lines) = spikes.of(centre_px, star, 0.0, 1e-13, 250.0);
        check(left.y < 0.995 * star.y, || format!("only {} is taken", 1.0 - left.y / star.y))?;
        let plan = FramePlan {
            camera,
            sky: SkyPlan::black(Angle::ZERO),
            milky_way: None,
            discs: Vec::new(),
            splats: vec![Splat::star(centre_px, left)],
        };
        let frame = renderer.frame_with_spikes(&plan, &lines)?.frame;
        let sum = illuminance(&frame, &camera);
        let off = (sum.y / star.y - 1.0).abs().max((sum.z / star.z - 1.0).abs());
        check(off < 1e-3, || format!("{blades} blades: light is off by {off}"))?;
        // Light where a spike is, none between them.
        let [dx, dy] = lines[0].direction;
        let at = |x: f64, y: f64| frame.xyzv(x as u32, y as u32).y;
        check(at(400.3 + 60.0 * dx, 299.8 + 60.0 * dy) > 0.0, || "no spike".to_owned())?;
    }
    Ok(())
}
