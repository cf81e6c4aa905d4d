//! The camera against rules that photographers know, and against the statistics of counting.

use glam::DVec3;
use nocturne::camera::{Camera, Projection};
use nocturne::display::Display;
use nocturne::image::Image;
use nocturne::photo::exposure::{HIGHEST_ISO, LONGEST_S, Metered, metered, noise};
use nocturne::photo::lens::Lens;
use nocturne::photo::sensor::{Body, PHOTONS_PER_LM_S, SensorKind};
use nocturne::photo::{Curve, Photo, PhotoError};
use nocturne::units::{Angle, Xyzv};

/// D65 of a luminance.
fn white(luminance_cd_m2: f64) -> Xyzv {
    Xyzv::new(0.950_456, 1.0, 1.089_058, 2.5) * luminance_cd_m2
}

fn camera(width_px: u32, height_px: u32) -> Camera {
    Camera {
        projection: Projection::Perspective,
        field_of_view: Angle::from_deg(73.74),
        azimuth: Angle::ZERO,
        altitude: Angle::from_deg(30.0),
        roll: Angle::ZERO,
        width_px,
        height_px,
    }
}

/// A full frame at given settings.
fn set(f_number: f64, shutter_s: f64, iso: f64) -> Photo {
    let lens = Lens { f_number, vignetting: false, ..Lens::default() };
    Photo { shutter_s: Some(shutter_s), iso: Some(iso), noise: false, lens, ..Photo::default() }
}

/// The share of saturation that white of a luminance comes to in green, on the axis.
fn saturation(photo: &Photo, luminance_cd_m2: f64) -> f64 {
    let light = white(luminance_cd_m2);
    let exposure = photo.exposed(&metered(&[light]), &camera(1920, 1080));
    exposure.mean_raw(light, 960, 540).y
}

#[test]
fn sunny_sixteen_shows_a_grey_card_in_sunlight_in_the_middle() {
    // 8e4 lux, a high Sun on level ground, on a card of 18 %; f/16, 1/100 s at ISO 100 (EV 15).
    let card = 0.18 * 8e4 / std::f64::consts::PI;
    for iso in [100.0, 400.0] {
        let share = saturation(&set(16.0, 1.0 / iso, iso), card);
        // A meter lays it at 10/78, 0.128.
        assert!((0.128 / 1.5..0.128 * 1.5).contains(&share), "{share}");
    }
    // White in the same light does not saturate.
    assert!(saturation(&set(16.0, 0.01, 100.0), card / 0.18) < 1.0);
}

#[test]
fn looney_eleven_shows_the_full_moon() {
    // The mean of its disc, high in clear air: some 4000 cd/m2 outside, less 15 %.
    let share = saturation(&set(11.0, 1.0 / 100.0, 100.0), 3400.0);
    // Between a grey card and white.
    assert!((0.1..0.5).contains(&share), "{share}");
}

#[test]
fn twenty_seconds_show_the_milky_way() {
    // 20 s, f/2.8, ISO 3200, a sky of 21.5 to 22 mag/arcsec2: 10.8e4 10^(-0.4 mu) cd/m2. A hundredth or two of
    // saturation, as those find who look at raw files, and a sixth of the way from black to white in the
    // codes of the picture.
    for mu in [21.5, 22.0] {
        let photo = set(2.8, 20.0, 3200.0);
        let share = saturation(&photo, 10.8e4 * 10f64.powf(-0.4 * mu));
        assert!((0.01..0.025).contains(&share), "{mu}: {share}");
        let [code, ..] = Display::default().encoded([photo.curve.shown(share); 3]);
        assert!((0.12..0.21).contains(&code), "{mu}: {code}");
    }
}

#[test]
fn the_meter_lays_grey_in_the_middle_and_stays_within_its_limits() {
    for exponent in -70..=90 {
        let luminance = 10f64.powf(f64::from(exponent) / 10.0);
        let photo = Photo { noise: false, ..Photo::default() };
        let exposure = photo.exposed(&metered(&[white(luminance)]), &camera(1920, 1080));
        let (t, iso) = (exposure.shutter_s, exposure.iso);
        assert!((1.0 / 8000.0..=LONGEST_S * 1.000_001).contains(&t), "{luminance}: {t} s");
        assert!((100.0..=HIGHEST_ISO * 1.000_001).contains(&iso), "{luminance}: ISO {iso}");
        let share = exposure.mean_raw(white(luminance), 960, 540).y;
        // From a moonlit landscape to snow in the Sun.
        if (1e-2..1e4).contains(&luminance) {
            assert!((share / (10.0 / 78.0) - 1.0).abs() < 1e-3, "{luminance}: {share}");
        }
        let brighter = Photo { compensation_stops: 1.0, ..photo };
        let brighter = brighter.exposed(&metered(&[white(1.0)]), &camera(1920, 1080));
        let share = brighter.mean_raw(white(1.0), 960, 540).y;
        assert!((share / (20.0 / 78.0) - 1.0).abs() < 1e-3, "{share}");
    }
    // A Moon in the corner does not count; one that fills a tenth is not burnt out.
    let mut samples = vec![white(1e-3); 1000];
    samples[..10].fill(white(4000.0));
    assert!((metered(&samples).luminance_cd_m2 / 1e-3 - 1.0).abs() < 1e-9);
    samples[..100].fill(white(4000.0));
    let reading = metered(&samples);
    let photo = Photo { noise: false, ..Photo::default() };
    let exposure = photo.exposed(&reading, &camera(1920, 1080));
    let share = exposure.mean_raw(white(4000.0), 960, 540).y;
    assert!((0.5..1.0).contains(&share), "{share}");
    // Nothing at all, and no numbers.
    let none = metered(&[]);
    assert_eq!(none, Metered { luminance_cd_m2: 0.0, mean: Xyzv::BLACK });
    assert!(photo.exposed(&none, &camera(16, 9)).shutter_s.is_finite());
    let odd = metered(&[white(f64::NAN), white(f64::INFINITY), white(2.0)]);
    assert_eq!(odd.luminance_cd_m2, 2.0);
}

#[test]
fn signal_to_noise_is_that_of_counting() {
    // A patch of 400 x 400 pixels at several levels: mean within 0.5 %, signal to noise within 2 %.
    let camera = camera(400, 400);
    for (luminance, iso) in [(2e-4, 6400.0), (2e-3, 3200.0), (0.05, 200.0)] {
        let photo = Photo { noise: true, seed: 7, ..set(2.8, 20.0, iso) };
        let light = white(luminance);
        let exposure = photo.exposed(&metered(&[light]), &camera);
        let mean = exposure.mean_raw(light, 200, 200);
        assert!(mean.max_element() < 0.7, "{mean}");
        let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
        for y in 0..400 {
            for x in 0..400 {
                let raw = exposure.raw(light, x, y);
                sum += raw;
                squares += (raw - mean) * (raw - mean);
            }
        }
        // From the settings by hand: electrons of each channel, and read noise of the photosites in a pixel.
        let pixel_um = 36_000.0 / 400.0;
        let sites = (pixel_um / 5.95f64).powi(2);
        let lx_s = std::f64::consts::PI / 4.0 * luminance * 0.9 / (2.8 * 2.8) * 20.0;
        let green = lx_s * (pixel_um * 1e-6f64).powi(2) * PHOTONS_PER_LM_S * 0.5;
        for channel in 0..3 {
            let electrons = green * mean[channel] / mean.y;
            let expected = electrons / (electrons + sites * 9.0).sqrt();
            let found_mean = sum[channel] / 160_000.0;
            let found = found_mean / (squares[channel] / 160_000.0).sqrt();
            let off = found_mean / mean[channel] - 1.0;
            assert!(off.abs() < 5e-3, "{luminance} channel {channel}: mean off by {off}");
            assert!(
                (found / expected - 1.0).abs() < 0.02,
                "{luminance} channel {channel}: {found}, not {expected}"
            );
        }
    }
}

#[test]
fn a_dark_frame_has_a_mean_of_zero() {
    let exposure = Photo { noise: true, ..set(2.8, 1.0, 6400.0) }
        .exposed(&metered(&[Xyzv::BLACK]), &camera(400, 400));
    let mut sum = DVec3::ZERO;
    for (x, y) in (0..400).flat_map(|y| (0..400).map(move |x| (x, y))) {
        sum += exposure.raw(Xyzv::BLACK, x, y);
    }
    // The mean of 160 000 pixels is known to a four-hundredth of their deviation.
    let mean = sum / 160_000.0 / exposure.read.sqrt();
    assert!(mean.abs().max_element() < 4.0 / 400.0, "{mean}");
}

#[test]
fn noise_is_nearly_normal_and_of_its_seed() {
    assert_eq!(noise(3, 4, 5), noise(3, 4, 5));
    assert_ne!(noise(3, 4, 5), noise(3, 4, 6));
    let values: Vec<[f64; 3]> =
        (0..500).flat_map(|y| (0..500).map(move |x| noise(x, y, 1))).collect();
    let n = values.len() as f64;
    let moment = |f: &dyn Fn(&[f64; 3]) -> f64| values.iter().map(f).sum::<f64>() / n;
    for channel in 0..3 {
        assert!(moment(&|v| v[channel]).abs() < 0.01);
        assert!((moment(&|v| v[channel].powi(2)) - 1.0).abs() < 0.01);
        assert!((moment(&|v| v[channel].powi(4)) - 2.7).abs() < 0.05);
        let other = (channel + 1) % 3;
        assert!(moment(&|v| v[channel] * v[other]).abs() < 0.01);
    }
    // Neighbours know nothing of each other.
    let beside = values.windows(2).map(|pair| pair[0][0] * pair[1][0]).sum::<f64>() / n;
    assert!(beside.abs() < 0.01, "{beside}");
}

#[test]
fn the_same_settings_make_the_same_picture_of_true_colours() {
    // An orange star and a blue one, side by side, at half of saturation.
    let [orange, blue] =
        [Xyzv::new(1.2, 1.0, 0.5, 1.4), Xyzv::new(0.9, 1.0, 1.4, 3.0)].map(|l| l * 0.01);
    let pixels = [orange.to_f32(), blue.to_f32()];
    let frame = Image::from_pixels(2, 1, pixels.to_vec()).unwrap();
    let photo = Photo { curve: Curve::Linear, ..set(2.8, 20.0, 100.0) };
    let exposure = photo.exposed(&metered(&[orange, blue]), &camera(2, 1));
    let display = Display { dither: false, ..Display::default() };
    let rgb = [orange, blue].map(|l| exposure.developed(exposure.raw(l, 0, 0), &display));
    for (shown, light) in rgb.iter().zip([orange, blue]) {
        let meant = display.rgb_from_xyz() * DVec3::new(light.x, light.y, light.z);
        let off = (*shown / shown.y - meant / meant.y).abs().max_element();
        assert!(off < 1e-6, "{shown} {meant}");
    }
    let noisy = Photo { noise: true, ..photo }.exposed(&metered(&[orange]), &camera(2, 1));
    assert_eq!(noisy.picture(&frame, &display), noisy.picture(&frame, &display));
}

#[test]
fn what_saturates_is_white() {
    for balance in ["\"daylight\"", "\"tungsten\"", "\"auto\"", "{ kelvin = 3400.0 }"] {
        let photo: Photo = toml::from_str(&format!("white_balance = {balance}")).unwrap();
        assert!(photo.validate().is_ok());
        let light = Xyzv::new(1.4, 1.0, 0.2, 1.0) * 1e9;
        let exposure = photo.exposed(&metered(&[white(0.01)]), &camera(160, 90));
        let display = Display { dither: false, ..Display::default() };
        let rgb = exposure.developed(exposure.raw(light, 80, 45), &display);
        assert_eq!(display.code_of_rgb(rgb, 80, 45), [255; 3], "{balance}");
        for luminance in [0.0, 1e-9, 1e10] {
            let rgb = exposure.developed(exposure.raw(white(luminance), 80, 45), &display);
            assert!(rgb.is_finite(), "{luminance}: {rgb}");
        }
    }
}

#[test]
fn settings_survive_their_file_and_bad_ones_are_refused() {
    let photo = Photo {
        shutter_s: Some(20.0),
        iso: Some(3200.0),
        body: Body { sensor: SensorKind::ApsC, read_noise_e: Some(1.5), ..Body::default() },
        ..Photo::default()
    };
    let text = toml::to_string(&photo).unwrap();
    assert_eq!(toml::from_str::<Photo>(&text).unwrap(), photo, "{text}");
    assert!(toml::from_str::<Photo>("shuter_s = 1.0").is_err());
    let wrong = |photo: Photo| photo.validate().unwrap_err();
    assert!(matches!(wrong(Photo { iso: Some(50.0), ..photo }), PhotoError::BelowBase { .. }));
    assert!(wrong(Photo { shutter_s: Some(0.0), ..photo }).to_string().contains("shutter_s"));
    let lens = Lens { blades: 2, ..Lens::default() };
    assert!(matches!(wrong(Photo { lens, ..photo }), PhotoError::Blades(2)));
    let lens = Lens { f_number: f64::NAN, ..Lens::default() };
    assert!(wrong(Photo { lens, ..photo }).to_string().contains("f_number"));
}
