//! The pictures of an eye that the GPU makes: against their twin, and what must hold for any light.
//! Without an adapter every test here is reported as ignored.

#[path = "support/mod.rs"]
mod support;

use glam::DVec3;
use libtest_mimic::Failed;
use nocturne::camera::{Camera, Projection};
use nocturne::display::{ColourSpace, Display, srgb_curve};
use nocturne::eye::glare::{Glare, Halo, Optics, pyramid};
use nocturne::eye::{Eye, Model};
use nocturne::image::{HdrFrame, Image};
use nocturne::photo::Photo;
use nocturne::plan::Splat;
use nocturne::render::picture::{Depth, Picture};
use nocturne::render::{Look, Made, Renderer, Viewer};
use nocturne::units::{Angle, Xyzv};
use support::{GpuTest, check};

fn main() {
    support::run([
        GpuTest::new("smooth_skies_are_those_of_the_twin", smooth_skies_are_the_twins),
        GpuTest::new("the_moon_is_that_of_the_twin", the_moon_is_the_twins),
        GpuTest::new("glare_keeps_the_light_of_a_frame", glare_keeps_light),
        GpuTest::new("a_point_is_parted_without_loss", a_point_is_parted_without_loss),
        GpuTest::new("what_is_no_number_does_not_spread", what_is_no_number_does_not_spread),
        GpuTest::new("every_light_makes_a_picture", every_light_makes_a_picture),
        GpuTest::new("from_noon_to_night_every_step_is_darker", from_noon_to_night),
        GpuTest::new("a_dark_gradient_has_no_bands", a_dark_gradient_has_no_bands),
        GpuTest::new("the_same_light_makes_the_same_picture", the_same_twice),
        GpuTest::new("screens_show_the_same_colours", screens_show_the_same),
    ])
}

/// White of the sky at noon: X and Z over Y, and V over Y.
const DAY: [f64; 3] = [0.93, 1.25, 2.6];
/// White of the sky on a moonless night.
const NIGHT: [f64; 3] = [0.98, 0.85, 1.6];

fn camera(width_px: u32, height_px: u32, field_deg: f64) -> Camera {
    Camera {
        projection: Projection::Equidistant,
        field_of_view: Angle::from_deg(field_deg),
        azimuth: Angle::ZERO,
        altitude: Angle::from_deg(40.0),
        roll: Angle::ZERO,
        width_px,
        height_px,
    }
}

fn light(luminance: f64, [x, z, v]: [f64; 3]) -> [f32; 4] {
    [x, 1.0, z, v].map(|part| (part * luminance) as f32)
}

/// A frame of a light at each pixel.
fn frame_of(width: u32, height: u32, at: impl Fn(f64, f64) -> [f32; 4]) -> HdrFrame {
    let pixels = (0..width * height)
        .map(|n| at(f64::from(n % width) + 0.5, f64::from(n / width) + 0.5))
        .collect();
    Image::from_pixels(width, height, pixels).expect("as many pixels")
}

fn looked(
    renderer: &Renderer,
    frame: &HdrFrame,
    camera: &Camera,
    points: &[Splat],
    look: &Look,
) -> Result<Picture, Failed> {
    Ok(renderer.look_at(frame, camera, points, look)?.picture)
}

fn linear(
    renderer: &Renderer,
    frame: &HdrFrame,
    camera: &Camera,
    eye: &Eye,
    display: &Display,
) -> Result<Image<[f32; 3]>, Failed> {
    let look = Look { viewer: Viewer::Eye(eye), display, depth: Depth::Linear };
    match looked(renderer, frame, camera, &[], &look)? {
        Picture::Linear(light) => Ok(light),
        Picture::Codes(_) => Err("no light".into()),
    }
}

fn codes(
    renderer: &Renderer,
    frame: &HdrFrame,
    camera: &Camera,
    eye: &Eye,
    display: &Display,
) -> Result<Image<[u8; 3]>, Failed> {
    let look = Look { viewer: Viewer::Eye(eye), display, depth: Depth::Codes };
    match looked(renderer, frame, camera, &[], &look)? {
        Picture::Codes(codes) => Ok(codes),
        Picture::Linear(_) => Err("no codes".into()),
    }
}

/// The largest difference between the picture and its twin, in codes of 8 bits.
fn off_codes(
    renderer: &Renderer,
    frame: &HdrFrame,
    camera: &Camera,
    eye: &Eye,
) -> Result<f64, Failed> {
    let display = Display::default();
    let shown = linear(renderer, frame, camera, eye, &display)?;
    let meant = eye.see(frame, camera.pixel_angle(), &display).light;
    let code = |linear: f64| 255.0 * srgb_curve(linear.clamp(0.0, 1.0));
    let mut worst = 0.0f64;
    for (shown, meant) in shown.pixels().iter().zip(meant.pixels()) {
        for (shown, meant) in shown.iter().zip(meant) {
            let off = (code(f64::from(*shown)) - code(*meant)).abs();
            worst = if off.is_nan() { f64::INFINITY } else { worst.max(off) };
        }
    }
    Ok(worst)
}

/// An eye that resolves everything: what the twin does.
fn keen() -> Eye {
    Eye { acuity: false, ..Eye::default() }
}

const SIZES: [(u32, u32); 5] = [(333, 97), (961, 541), (7, 5), (1, 1), (2, 300)];

/// Four codes, five in the smallest pictures, as measured in colours that hardly fit a screen: the picture
/// leaves out glare of less than 0.4 % in a tile and of less than 1 % in the whole picture, holds its table
/// in halves, goes up from the second level at once, and smooth light is brought into the gamut before.
fn smooth_skies_are_the_twins(renderer: &Renderer) -> Result<(), Failed> {
    let colours = [[0.95, 1.09, 0.3], [1.3, 0.2, 0.7], DAY, NIGHT, [0.8, 1.9, 5.0]];
    for exponent in -6..=9 {
        for (n, colour) in colours.into_iter().enumerate() {
            let (width, height) = SIZES[(exponent + 6 + n as i32) as usize % SIZES.len()];
            // By a factor of 3 across and 1.5 down.
            let at = |x: f64, y: f64| {
                let factor = 3f64.powf(x / f64::from(width)) * 1.5f64.powf(y / f64::from(height));
                light(10f64.powi(exponent) * factor, colour)
            };
            let frame = frame_of(width, height, at);
            let off = off_codes(renderer, &frame, &camera(width, height, 60.0), &keen())?;
            let within = if width > 2 { 2.0 } else { 4.0 };
            check(off < within, || {
                format!("1e{exponent} {colour:?} {width}x{height}: {off} codes")
            })?;
        }
    }
    Ok(())
}

/// A full Moon of 30', and a lamp in the corner.
fn the_moon_is_the_twins(renderer: &Renderer) -> Result<(), Failed> {
    for (width, height) in [(333, 97), (961, 541), (601, 400)] {
        for field_deg in [4.0, 90.0] {
            let camera = camera(width, height, field_deg);
            let radius_px = 0.25 / camera.pixel_angle().deg();
            let centre = [0.4 * f64::from(width), 0.6 * f64::from(height)];
            let moon = |x: f64, y: f64| {
                let inside =
                    (radius_px - (x - centre[0]).hypot(y - centre[1]) + 0.5).clamp(0.0, 1.0);
                let sky = light(0.01, NIGHT);
                let disc = light(4000.0 * inside, [0.97, 0.95, 2.2]);
                [0, 1, 2, 3].map(|n| sky[n] + disc[n])
            };
            let off = off_codes(renderer, &frame_of(width, height, moon), &camera, &keen())?;
            let lamp = |x: f64, y: f64| match x < 1.0 && y < 1.0 {
                true => light(1e5, [1.1, 0.35, 1.4]),
                false => light(0.002, NIGHT),
            };
            let lamp = off_codes(renderer, &frame_of(width, height, lamp), &camera, &keen())?;
            eprintln!("{width}x{height} {field_deg}: Moon {off}, lamp {lamp}");
            check(off < 1.0 && lamp < 1.0, || {
                format!("{width}x{height}, {field_deg} degrees: Moon {off}, lamp {lamp} codes")
            })?;
        }
    }
    Ok(())
}

/// Wherever it stands, whatever the size: to 0.1 %.
fn glare_keeps_light(renderer: &Renderer) -> Result<(), Failed> {
    let sum = |frame: &HdrFrame| {
        frame.pixels().iter().fold([0.0; 4], |sum: [f64; 4], pixel| {
            [0, 1, 2, 3].map(|n| sum[n] + f64::from(pixel[n]))
        })
    };
    let (mut worst, mut bad) = (0.0f64, false);
    for (width, height) in
        [(333, 97), (961, 541), (640, 360), (7, 5), (1, 1), (2, 300), (1023, 767)]
    {
        let camera = camera(width, height, 60.0);
        let (right, bottom) = (width - 1, height - 1);
        let places = [
            [0, 0],
            [right, 0],
            [0, bottom],
            [right, bottom],
            [width / 2, 0],
            [right, height / 2],
            [width / 2, bottom],
            [width / 2, height / 2],
            [width / 3, height.saturating_sub(3)],
            [width.saturating_sub(4), height.saturating_sub(2)],
        ];
        for at in places {
            // Most of the light is in the point.
            let mut frame = frame_of(width, height, |_, _| light(1e-3, NIGHT));
            frame.pixels_mut()[(at[1] * width + at[0]) as usize] = light(1e6, NIGHT);
            for (optics, within) in [
                (Optics::default(), 1e-3),
                // Scatters most.
                (Optics { age_years: 75.0, pigment: 1.2 }, 1e-3),
            ] {
                let eye = Eye { optics, ..Eye::default() };
                let retina = renderer.retina(&frame, &camera, &eye)?;
                let stays = f64::from(retina.at(at[0], at[1])[1]);
                let most = if width > 64 { 0.995e6 } else { f64::INFINITY };
                check(stays < most, || format!("nothing is spread: {stays}"))?;
                for (before, after) in sum(&frame).into_iter().zip(sum(&retina)) {
                    let off = (after / before - 1.0).abs();
                    worst = worst.max(off);
                    bad |= off > within;
                }
            }
        }
    }
    check(!bad, || format!("light is off by {worst}"))?;
    eprintln!("light kept to {worst:.1e}");
    Ok(())
}

fn a_point_is_parted_without_loss(_: &Renderer) -> Result<(), Failed> {
    for glare in [Glare::Cie, Glare::Spencer] {
        for pupil_mm in [2.5, 4.0, 7.0] {
            for arcmin in [1.0, 2.8, 8.4, 15.0] {
                let spread = glare.spread(&Optics::default(), pupil_mm).ok_or("no spread")?;
                let pixel = Angle::from_arcmin(arcmin);
                let (width, height) = (961, 541);
                let shares = pyramid::shares(&spread, pixel, width, height);
                let halo = Halo::new(&spread, &shares, pixel, width, height);
                let parts = halo.parts(None);
                // The halo as it is drawn: summed over pixels around a point between them; the wide part
                // as it comes out of the pyramid.
                let reach = halo.reach_px.ceil() as i32 + 1;
                let at = |n: i32, off: f64| f64::from(n) - off;
                let line = |y: i32| -> f64 {
                    let row = (-reach..=reach).map(|x| halo.per_px(at(x, 0.3).hypot(at(y, 0.1))));
                    row.sum()
                };
                let near: f64 = (-reach..=reach).map(line).sum();
                let dark = Image::filled(width, height, [0.0f32; 4]);
                let point = pyramid::Point { place_px: [480.3, 270.1], light: [1.0; 4] };
                let joined = pyramid::scattered_with(&dark, &shares, halo.level, &[point]);
                let wide: f64 = joined.pixels().iter().map(|pixel| f64::from(pixel[1])).sum();
                let sum = parts.core + near + wide;
                check((sum - 1.0).abs() < 1e-3, || {
                    format!("{glare:?} {pupil_mm} mm, {arcmin}': {sum} of the light is drawn")
                })?;
            }
        }
    }
    Ok(())
}

/// One pixel that holds no light that could be: the rest of the picture is as it would be without it.
fn what_is_no_number_does_not_spread(renderer: &Renderer) -> Result<(), Failed> {
    let (width, height) = (333, 97);
    let camera = camera(width, height, 60.0);
    for luminance in [1e-4, 1.0, 3000.0] {
        let sky = frame_of(width, height, |x, _| light(luminance * (1.0 + x / 300.0), DAY));
        for model in [Model::Standard, Model::Paper] {
            let eye = Eye { model, ..Eye::default() };
            let display = Display::default();
            let meant = linear(renderer, &sky, &camera, &eye, &display)?;
            for at in [[0, 0], [100, 50], [332, 96]] {
                for strange in [f32::NAN, -f32::NAN, -1.0, -f32::INFINITY] {
                    let mut frame = sky.clone();
                    frame.pixels_mut()[at[1] * width as usize + at[0]] = [strange; 4];
                    let shown = linear(renderer, &frame, &camera, &eye, &display)?;
                    let mut worst = 0.0f64;
                    for (n, (shown, meant)) in shown.pixels().iter().zip(meant.pixels()).enumerate()
                    {
                        let away = [n % width as usize, n / width as usize];
                        let near = away.iter().zip(at).all(|(a, b)| a.abs_diff(b) < 12);
                        for (shown, meant) in shown.iter().zip(meant) {
                            check((0.0..=1.0).contains(shown), || {
                                format!("{model:?} {strange} {away:?}: {shown}")
                            })?;
                            if !near {
                                let off = f64::from((shown - meant).abs() / meant.max(1e-4));
                                worst = worst.max(off);
                            }
                        }
                    }
                    check(worst < 0.02, || {
                        format!("{model:?}, {strange} at {at:?}: the picture changes by {worst}")
                    })?;
                }
            }
        }
    }
    Ok(())
}

fn every_light_makes_a_picture(renderer: &Renderer) -> Result<(), Failed> {
    let strange =
        [0.0, 1e-42, 1e-30, 1e-10, 1e10, 3e38, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -1.0];
    let standard = Eye::default();
    let paper = Eye { model: Model::Paper, ..Eye::default() };
    let grainy = Eye { grain: Some(3), ..Eye::default() };
    let photo = Photo::default();
    let exposure = photo.exposed(
        &nocturne::photo::exposure::metered(&[Xyzv::new(1.0, 1.0, 1.0, 1.0)]),
        &camera(96, 40, 60.0),
    );
    let viewers = [
        Viewer::Eye(&standard),
        Viewer::Eye(&paper),
        Viewer::Eye(&grainy),
        Viewer::Photo(&photo),
        Viewer::Exposure(&exposure),
    ];
    let camera = camera(96, 40, 60.0);
    let star = Splat::star([40.0, 20.0], Xyzv::new(2.5e-6, 2.5e-6, 2.5e-6, 4e-6));
    for background in [0.0, 1e-42, 1e-30, 1e-6, 1.0, 1e10] {
        let even = frame_of(96, 40, |_, _| light(background, DAY));
        let mut all = vec![("even".to_owned(), even.clone())];
        for one in strange {
            let mut frame = even.clone();
            frame.pixels_mut()[20 * 96 + 40] = [one; 4];
            frame.pixels_mut()[0] = [one; 4];
            // One channel alone.
            frame.pixels_mut()[39 * 96 + 95][2] = one;
            all.push((format!("{one}"), frame));
        }
        // From nothing to more than there is.
        let decades = |x: f64, _: f64| light(10f64.powf(x / 96.0 * 55.0 - 45.0), DAY);
        all.push(("decades".to_owned(), frame_of(96, 40, decades)));
        for (name, frame) in all {
            for viewer in viewers {
                for depth in [Depth::Linear, Depth::Codes] {
                    let display = Display::default();
                    let look = Look { viewer, display: &display, depth };
                    let picture = renderer.look_at(&frame, &camera, &[star], &look)?;
                    if let Made::Seen(seeing) = &picture.made {
                        let is_light = |v: &f32| v.is_finite() && *v >= 0.0;
                        let tables = seeing.shown.iter().chain(&seeing.visible).flatten();
                        check(tables.into_iter().all(is_light), || {
                            format!("{name} on {background}: a table holds no light")
                        })?;
                    }
                    let Picture::Linear(light) = picture.picture else { continue };
                    let bad = light.pixels().iter().flatten().find(|v| !(0.0..=1.0).contains(*v));
                    check(bad.is_none(), || {
                        format!("{name} on {background}, {viewer:?}: {bad:?}")
                    })?;
                }
            }
        }
    }
    Ok(())
}

/// Mean luminance of a picture, share of white.
fn mean(picture: &Image<[f32; 3]>) -> f64 {
    let weights = ColourSpace::Srgb.xyz_from_rgb().row(1);
    let luminance = |rgb: &[f32; 3]| weights.dot(DVec3::from_array(rgb.map(f64::from)));
    picture.pixels().iter().map(luminance).sum::<f64>() / picture.pixels().len() as f64
}

/// Skies from 8000 to 2e-4 cd/m2 in steps of a magnitude: each is darker than the one before, nothing is
/// black or full, and what is brighter in a sky is not shown darker.
fn from_noon_to_night(renderer: &Renderer) -> Result<(), Failed> {
    let (width, height) = (320, 180);
    let camera = camera(width, height, 60.0);
    let (eye, display) = (Eye::default(), Display::default());
    let mut before = f64::INFINITY;
    for step in 0..=19 {
        let middle = 8000.0 * 10f64.powf(-0.4 * f64::from(step));
        let night = f64::from(step) / 19.0;
        let colour = [0, 1, 2].map(|n| DAY[n] + night * (NIGHT[n] - DAY[n]));
        let at = |x: f64, _: f64| light(middle * 3f64.powf(x / 320.0 - 0.5), colour);
        let frame = frame_of(width, height, at);
        let shown = linear(renderer, &frame, &camera, &eye, &display)?;
        let now = mean(&shown);
        check(now < 0.995 * before, || format!("{middle} cd/m2: {now} after {before}"))?;
        before = now;
        let coded = codes(renderer, &frame, &camera, &eye, &display)?;
        let ends = coded
            .pixels()
            .iter()
            .flatten()
            .fold([255, 0], |[low, high]: [u8; 2], code| [low.min(*code), high.max(*code)]);
        eprintln!("{middle:.2e} cd/m2: {now:.4}, codes {ends:?}");
        check(ends[0] > 0 && ends[1] < 255, || format!("{middle} cd/m2: codes {ends:?}"))?;
        for x in 1..width {
            // Columns in the mean: without rounding none is darker than the one before, with it by no more
            // than dithering leaves of 180 pixels.
            let column = |x: u32| -> [f64; 2] {
                let all = (0..height).map(|y| {
                    let code: f64 = coded.at(x, y).into_iter().map(f64::from).sum();
                    [f64::from(shown.at(x, y)[1]), code / 3.0]
                });
                all.fold([0.0; 2], |sum, at| [0, 1].map(|n| sum[n] + at[n] / f64::from(height)))
            };
            let [[dark, dark_code], [bright, bright_code]] = [column(x - 1), column(x)];
            check(bright >= dark * (1.0 - 1e-5) && bright_code > dark_code - 0.15, || {
                format!("{middle} cd/m2 at {x}: {dark} {bright}, {dark_code} {bright_code}")
            })?;
        }
    }
    eprintln!("night is shown at {before}");
    Ok(())
}

/// A gradient that is shown at 0.2 to 1 % of white over 1000 pixels, some 15 codes: means of 16 by 16 pixels
/// follow it, and any quarter of a code is seen as a step. Undithered, codes are bands.
fn a_dark_gradient_has_no_bands(renderer: &Renderer) -> Result<(), Failed> {
    let (width, height) = (1008, 64);
    let camera = camera(width, height, 60.0);
    let frame = frame_of(width, height, |x, _| light(1e-4 * 5f64.powf(x / 1008.0), NIGHT));
    let plain = Eye::default();
    let now = mean(&linear(renderer, &frame, &camera, &plain, &Display::default())?);
    let eye = Eye { exposure_stops: (0.005 / now).log2(), ..plain };
    let display = Display::default();
    let meant = linear(renderer, &frame, &camera, &eye, &display)?;
    let code = |x: u32, channel: usize| 255.0 * srgb_curve(f64::from(meant.at(x, 20)[channel]));
    let ends = [meant.at(0, 20)[1], meant.at(width - 1, 20)[1]];
    check(ends[0] < 0.0027 && ends[1] > 0.008, || format!("shown from {ends:?}"))?;
    for dither in [true, false] {
        let display = Display { dither, ..display };
        let coded = codes(renderer, &frame, &camera, &eye, &display)?;
        let mut worst = 0.0f64;
        let mut unseen = 0;
        for channel in 0..3 {
            let mean = |first: u32, last: u32, shown: bool| {
                let at = |x: u32, y: u32| match shown {
                    true => f64::from(coded.at(x, y)[channel]),
                    false => code(x, channel),
                };
                let sum: f64 = (first..last)
                    .flat_map(|x| (0..height).map(move |y| (x, y)))
                    .map(|(x, y)| at(x, y))
                    .sum();
                sum / f64::from((last - first) * height)
            };
            let block = |first: u32, top: u32| {
                let sum: f64 = (0..256)
                    .map(|n| f64::from(coded.at(first + n % 16, top + n / 16)[channel]))
                    .sum();
                sum / 256.0
            };
            for first in (0..width - 15).step_by(16) {
                let meant = mean(first, first + 16, false);
                for top in (0..height).step_by(16) {
                    worst = worst.max((block(first, top) - meant).abs());
                }
            }
            // Stretches over which the gradient rises by half a code.
            let mut first = 0;
            let mut last_mean: Option<[f64; 2]> = None;
            for x in 1..width {
                if code(x, channel) - code(first, channel) >= 0.5 {
                    let [shown, meant] = [true, false].map(|shown| mean(first, x, shown));
                    if let Some([shown_before, meant_before]) = last_mean {
                        let step = (shown - shown_before) / (meant - meant_before);
                        unseen += u32::from(!(0.5..1.5f64).contains(&step));
                    }
                    last_mean = Some([shown, meant]);
                    first = x;
                }
            }
        }
        eprintln!("dither {dither}: off by {worst} codes, {unseen} steps unseen");
        match dither {
            true => check(worst < 0.15 && unseen == 0, || {
                format!("blocks are off by {worst} codes, {unseen} steps are not seen")
            })?,
            // So that the test is one.
            false => check(worst > 0.3 && unseen > 5, || format!("no bands: {worst} {unseen}"))?,
        }
    }
    Ok(())
}

fn the_same_twice(renderer: &Renderer) -> Result<(), Failed> {
    let camera = camera(333, 97, 60.0);
    let frame = frame_of(333, 97, |x, y| light(1e-3 * (1.0 + x * y / 900.0), NIGHT));
    let points: Vec<Splat> = (0..200)
        .map(|n| {
            let illuminance = Xyzv::new(1e-6, 1e-6, 1e-6, 2e-6) * f64::from(n % 7);
            Splat::star([f64::from(n) * 1.63, f64::from(n * 31 % 97)], illuminance)
        })
        .collect();
    for eye in [Eye::default(), Eye { grain: Some(9), ..Eye::default() }] {
        for depth in [Depth::Codes, Depth::Linear] {
            let display = Display::default();
            let look = Look { viewer: Viewer::Eye(&eye), display: &display, depth };
            let first = looked(renderer, &frame, &camera, &points, &look)?;
            // Something else between, of another size.
            let other = Image::filled(64, 64, [1e4f32; 4]);
            looked(renderer, &other, &self::camera(64, 64, 10.0), &[], &look)?;
            let again = looked(renderer, &frame, &camera, &points, &look)?;
            check(first == again, || format!("{depth:?}: another picture"))?;
        }
    }
    let [one, two] = [1, 2].map(|seed| Eye { grain: Some(seed), ..Eye::default() });
    let display = Display::default();
    let one = codes(renderer, &frame, &camera, &one, &display)?;
    check(one != codes(renderer, &frame, &camera, &two, &display)?, || {
        "two seeds give one picture".to_owned()
    })
}

/// The same colours on every screen that can show them; red alone in red, as bright.
fn screens_show_the_same(renderer: &Renderer) -> Result<(), Failed> {
    let camera = camera(96, 40, 60.0);
    let eye = Eye::default();
    let frame = frame_of(96, 40, |x, y| {
        light(20.0 * (1.0 + x / 30.0), [0.95 + 0.002 * y, 1.09 - 0.006 * y, 2.4])
    });
    let star = Splat::star([40.0, 20.0], Xyzv::new(1e-2, 1e-2, 1e-2, 2e-2));
    let of = |space: ColourSpace, red: bool, depth: Depth| -> Result<Picture, Failed> {
        let display = Display { space, red, ..Display::default() };
        let look = Look { viewer: Viewer::Eye(&eye), display: &display, depth };
        looked(renderer, &frame, &camera, &[star], &look)
    };
    let xyz = |space: ColourSpace, rgb: [f32; 3]| {
        space.xyz_from_rgb() * DVec3::from_array(rgb.map(f64::from))
    };
    let Picture::Linear(meant) = of(ColourSpace::Srgb, false, Depth::Linear)? else {
        return Err("no light".into());
    };
    for space in [ColourSpace::Srgb, ColourSpace::DisplayP3, ColourSpace::Linear] {
        for red in [false, true] {
            let Picture::Linear(shown) = of(space, red, Depth::Linear)? else {
                return Err("no light".into());
            };
            let Picture::Codes(coded) = of(space, red, Depth::Codes)? else {
                return Err("no codes".into());
            };
            let display = Display { space, red, ..Display::default() };
            for n in 0..meant.pixels().len() {
                let rgb = shown.pixels()[n];
                // Where the star has more light than the screen, each cuts it in its own way.
                if rgb.iter().chain(&meant.pixels()[n]).any(|share| *share > 0.99) {
                    continue;
                }
                let wanted = xyz(ColourSpace::Srgb, meant.pixels()[n]);
                let off = match red {
                    true => f64::from(rgb[0]) - wanted.y,
                    false => (xyz(space, rgb) - wanted).abs().max_element(),
                };
                // Dithering of points is part of them.
                check(off.abs() < 1e-3, || {
                    format!("{space:?}, red {red}, pixel {n}: {rgb:?} is off by {off}")
                })?;
                check(!red || rgb[1] == 0.0 && rgb[2] == 0.0, || format!("{rgb:?} is not red"))?;
                let code = coded.pixels()[n];
                check(!red || code[1] == 0 && code[2] == 0, || format!("{code:?} is not red"))?;
                for (code, meant) in code.into_iter().zip(display.encoded(rgb.map(f64::from))) {
                    let off = (f64::from(code) - 255.0 * meant).abs();
                    check(off < 2.6, || {
                        format!(
                            "{space:?}, red {red}, pixel {n}: code {code}, not {}",
                            255.0 * meant
                        )
                    })?;
                }
            }
        }
    }
    Ok(())
}
