//! The light of the Earth on the Moon, against what was measured of it.

use std::f64::consts::PI;

use nocturne::light::earthshine::{self, EarthView};
use nocturne::light::moon::{self, MoonView};
use nocturne::light::spectrum::Spectrum;
use nocturne::light::sun;
use nocturne::units::{AU_KM, Angle};

/// At mean distances; of the Earth as seen from the Moon.
fn earth(phase_deg: f64) -> EarthView {
    let phase = Angle::from_deg(phase_deg);
    EarthView { phase, moon_distance_km: 384_400.0, sun_distance_km: AU_KM }
}

fn magnitudes(ratio: f64) -> f64 {
    -2.5 * ratio.log10()
}

/// The Earth's light over that of a white flat disc of its size that faces the Sun, in photopic light.
fn reflectance(phase_deg: f64) -> f64 {
    let disc_sr = PI * (6371.0f64 / 384_400.0).powi(2);
    let light = earthshine::irradiance(&earth(phase_deg)).xyzv().y;
    light * PI / (sun::irradiance_1au().xyzv().y * disc_sr)
}

/// Lambert's sphere of albedo 1, relative to what it sends at full phase.
fn lambert(phase_deg: f64) -> f64 {
    let phase = phase_deg.to_radians();
    ((PI - phase) * phase.cos() + phase.sin()) / PI
}

#[test]
fn the_earth_is_as_bright_as_measured() {
    // Robinson 2025: geometric albedo 0.242 (+0.005, -0.004) at 400 to 700 nm.
    let geometric = reflectance(0.0);
    assert!((geometric / 0.242 - 1.0).abs() < 0.02, "{geometric}");
    // The same: spherical albedo 0.294; it is twice the integral of the phase curve over the sine.
    let steps = 1800;
    let spherical: f64 = (0..steps)
        .map(|step| {
            let phase_deg = 180.0 * (f64::from(step) + 0.5) / f64::from(steps);
            2.0 * reflectance(phase_deg) * phase_deg.to_radians().sin() * PI / f64::from(steps)
        })
        .sum();
    println!("geometric albedo {geometric:.4}, spherical {spherical:.4}");
    assert!((spherical / 0.294 - 1.0).abs() < 0.10, "{spherical}");
    // Earthshine: the albedo of the sphere of Lambert that would be as bright is 0.297 on the mean
    // (Qiu et al. 2003, Pallé et al. 2003) over the phases at which it is measured, with 10 % of weather.
    let phases_deg = [30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0];
    let apparent = phases_deg.map(|deg| reflectance(deg) / (2.0 / 3.0 * lambert(deg)));
    let mean = apparent.iter().sum::<f64>() / apparent.len() as f64;
    println!("apparent albedos {apparent:.3?}, mean {mean:.3}");
    assert!((mean / 0.297 - 1.0).abs() < 0.05, "{mean}");
    assert!(apparent.iter().all(|albedo| (0.24..0.37).contains(albedo)), "{apparent:?}");
    let (light, magnitude) = earthshine::illuminance(&earth(0.0));
    println!("full Earth: {:.2} lx, magnitude {:.2}", light.lx(), magnitude.0);
    assert!((8.4..9.2).contains(&light.lx()), "{light:?}");
    assert_eq!(earthshine::irradiance(&earth(180.0)).xyzv().y, 0.0);
}

/// B - V of one spectrum less that of another, by the light at the middle of the bands.
fn redder(one: &Spectrum, other: &Spectrum) -> f64 {
    let colour = |of: &Spectrum| magnitudes(of.at_nm(440.0) / of.at_nm(550.0));
    colour(one) - colour(other)
}

#[test]
fn earthlight_is_bluer_than_sunlight() {
    // Thejll et al. 2014, A&A 563, A38: B - V of 0.44 +- 0.02; of the Sun 0.65.
    let bluer = -redder(&earthshine::irradiance(&earth(40.0)), &sun::irradiance_1au());
    println!("earthlight is bluer than sunlight by {bluer:.3} in B - V");
    assert!((0.15..0.25).contains(&bluer), "{bluer}");
}

#[test]
fn the_dark_side_shows_in_the_arms_of_the_crescent_and_drowns_by_half_moon() {
    let disc_sr = 6.4177e-5;
    let mut before = 0.0;
    println!("phase   dark side, cd/m2 and mag/arcsec2; apart, mag; B - V");
    for (phase_deg, apart_least, apart_most) in [
        (160.0f64, 6.0, 8.0),
        (150.0, 6.5, 8.5),
        (120.0, 7.5, 9.5),
        (90.0, 9.0, 11.0),
        (60.0, 11.0, 13.0),
    ] {
        let moon = MoonView::at_phase(Angle::from_deg(phase_deg));
        let earthlit = earthshine::disc_irradiance(&moon, &earth(180.0 - phase_deg));
        let sunlit = moon::irradiance(&moon);
        let dark = earthlit.xyzv().y / disc_sr;
        let lit = 0.5 * (1.0 + phase_deg.to_radians().cos());
        let apart = magnitudes(dark / (sunlit.xyzv().y / disc_sr / lit));
        let surface = 12.58 - 2.5 * dark.log10();
        let colour = redder(&earthlit, &sunlit);
        println!("{phase_deg:5} {dark:8.4} {surface:6.2} {apart:6.2} {colour:+.3}");
        assert!(
            (apart_least..apart_most).contains(&apart) && apart > before - 0.3,
            "{phase_deg}: {apart}"
        );
        // Montañés-Rodríguez et al. 2007, AJ 134, 1145: 12 to 17 magnitudes in a square arcsecond.
        assert!((12.0..17.0).contains(&surface), "{phase_deg}: {surface}");
        // Thejll et al. 2014 saw -0.150 in one night; by ROLO crescents are redder than the full Moon.
        assert!((-0.30..-0.12).contains(&colour), "{phase_deg}: {colour}");
        before = apart;
    }
}
