//! What the eye scatters: published functions at tabulated points, energy, and the pyramid against
//! the function that it stands for.

use nocturne::eye::glare::{Glare, Optics, cie, scattered_by, shares, spencer};
use nocturne::image::{HdrFrame, Image};
use nocturne::units::Angle;

/// A pixel of light in a picture of 1920 by 1080, at different places between the texels.
const PHASES: [[u32; 2]; 4] = [[900, 500], [905, 583], [938, 541], [1003, 566]];

/// Mean, least and greatest ratio of what pixels get to what they should, by the octave of the
/// distance in pixels, from 1.5 pixels to 40 degrees or 320 pixels.
fn ratios(arcmin: f64, pupil_mm: f64) -> Vec<[f64; 3]> {
    let pixel = Angle::from_arcmin(arcmin);
    let spread = Glare::Cie.spread(&Optics::default(), pupil_mm).expect("an eye that scatters");
    let (width, height) = (1920, 1080);
    let shares = shares(&spread, pixel, width, height);
    let farthest_px = (40.0 / pixel.deg()).min(320.0);
    let mut octaves = vec![(0.0, 0.0, [f64::INFINITY, 0.0]); 9];
    for at in PHASES {
        let mut frame: HdrFrame = Image::filled(width, height, [0.0; 4]);
        frame.pixels_mut()[(at[1] * width + at[0]) as usize] = [1.0; 4];
        let retina = scattered_by(&frame, &shares);
        for (n, light) in (0..).zip(retina.pixels()) {
            let away = [n % width, n / width].map(f64::from);
            let away = [away[0] - f64::from(at[0]), away[1] - f64::from(at[1])];
            let r_px = away[0].hypot(away[1]);
            if r_px < 1.5 || r_px > farthest_px || r_px > 50.0 && n % 17 != 0 {
                continue;
            }
            let parts = if r_px < 8.0 { 8 } else { 1 };
            let part = |n: i32| (f64::from(n) + 0.5) / f64::from(parts) - 0.5;
            let mut mean_sr = 0.0;
            for y in 0..parts {
                for x in 0..parts {
                    let r_px = (away[0] + part(x)).hypot(away[1] + part(y));
                    mean_sr += spread.per_sr(Angle::from_rad(r_px * pixel.rad()));
                }
            }
            let expected = mean_sr / f64::from(parts * parts) * pixel.rad().powi(2);
            let ratio = f64::from(light[1]) / expected;
            let (sum, count, [least, greatest]) = &mut octaves[r_px.log2() as usize];
            *sum += ratio;
            *count += 1.0;
            [*least, *greatest] = [least.min(ratio), greatest.max(ratio)];
        }
    }
    let seen = octaves.into_iter().filter(|(_, count, _)| *count > 0.0);
    seen.map(|(sum, count, [least, greatest])| [sum / count, least, greatest]).collect()
}

#[test]
fn the_pyramid_follows_the_function() {
    for arcmin in [0.3, 1.0, 2.8, 10.0] {
        for pupil_mm in [3.0, 7.0] {
            let ratios = ratios(arcmin, pupil_mm);
            println!("{arcmin}' {pupil_mm} mm: {ratios:.3?}");
            for (octave, [mean, ..]) in ratios.iter().enumerate() {
                // The two finest levels leave a dip between them, 2 to 4 pixels from the light.
                let tolerance = if octave == 0 { 0.16 } else { 0.05 };
                assert!(
                    (mean - 1.0).abs() < tolerance,
                    "{arcmin} {pupil_mm} {octave}: {ratios:.3?}"
                );
            }
        }
    }
}

/// Values reckoned apart from the program, from the printed equations.
#[test]
fn functions_are_the_published_ones() {
    let total = |t_deg, age, pigment| cie::total_glare_per_sr(Angle::from_deg(t_deg), age, pigment);
    for (value, expected) in [
        (total(0.0, 30.0, 0.5), 9.127105e+06),
        (total(0.01, 30.0, 0.5), 7.926429e+05),
        (total(0.1, 30.0, 0.5), 1.143237e+04),
        (total(1.0, 30.0, 0.5), 1.896294e+01),
        (total(3.0, 70.0, 0.0), 1.650380e+00),
        (total(10.0, 70.0, 1.2), 1.338754e-01),
        (total(30.0, 20.0, 0.5), 7.521860e-03),
        (total(90.0, 50.0, 1.0), 4.568963e-03),
        (cie::stiles_holladay_per_sr(Angle::from_deg(5.0), 35.0), 0.425),
        (spencer::core_per_sr(Angle::from_deg(0.01)), 2.032_670e6),
        (spencer::bloom_per_sr(Angle::from_deg(1.0)), 19.703_96),
        (spencer::corona_per_sr(Angle::from_deg(1.0)), 69.559_78),
        (spencer::halo_per_sr(Angle::from_deg(3.0), 500.0), 496.318_4 * 0.078_269_5),
    ] {
        assert!((value / expected - 1.0).abs() < 1e-3, "{value} {expected}");
    }
}

/// A Moon over a twilight with a bright edge: what the glare makes of it holds the same light.
#[test]
fn a_frame_keeps_its_energy() {
    let (width, height) = (641, 427);
    let pixels = (0..width * height)
        .map(|n| {
            let [x, y] = [n % width, n / width].map(|c| c as f32);
            let sky = 10f32.powf(y / 100.0 - 4.0);
            let moon = if (x - 600.0).hypot(y - 420.0) < 9.0 { 3000.0 } else { 0.0 };
            let light = sky + moon;
            [0.95 * light, light, 1.1 * light, 2.0 * light]
        })
        .collect();
    let frame: HdrFrame = Image::from_pixels(width, height, pixels).expect("as many as it has");
    let sum = |frame: &HdrFrame| frame.pixels().iter().map(|p| f64::from(p[1])).sum::<f64>();
    for arcmin in [0.5, 3.0, 15.0] {
        for glare in [Glare::Cie, Glare::Spencer] {
            for pupil_mm in [2.5, 7.0] {
                let spread = glare.spread(&Optics::default(), pupil_mm).expect("it scatters");
                let shares = shares(&spread, Angle::from_arcmin(arcmin), width, height);
                let ratio = sum(&scattered_by(&frame, &shares)) / sum(&frame);
                assert!((ratio - 1.0).abs() < 1e-5, "{arcmin} {glare:?} {pupil_mm}: {ratio}");
            }
        }
    }
}
