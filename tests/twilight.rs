//! Twilight and moonlight in absolute units, against what was measured under real skies.

use nocturne::air::Atmosphere;
use nocturne::air::scattering::{Quality, SKY_NODES_NM, ScatteringTables, reconstruction_matrix};
use nocturne::light::moon::{self, MoonView};
use nocturne::light::photometry::luminance_cd_m2;
use nocturne::light::spectrum::{FIRST_NM, LEN, STEP_NM, Spectrum, wavelength_nm};
use nocturne::light::sun;
use nocturne::units::Angle;

/// A sky over an observer, lit by one lamp.
struct Sky {
    tables: ScatteringTables,
    height_km: f64,
}

impl Sky {
    fn over(height_m: f64) -> Sky {
        let mut air = Atmosphere::default();
        // Mountains that were observed from stand above the land around.
        air.ground.height_m = Some(0.0);
        Sky::of(air, height_m)
    }

    fn of(air: Atmosphere, height_m: f64) -> Sky {
        let tables = ScatteringTables::for_observer(&air, height_m, &SKY_NODES_NM, Quality::RENDER);
        Sky { tables: tables.unwrap(), height_km: height_m / 1000.0 }
    }

    fn luminance_cd_m2(&self, lamp: &Spectrum, lamp_deg: f64, view_deg: f64, from_deg: f64) -> f64 {
        let mut nodes = [0.0; 8];
        let cos_lamp = Angle::from_deg(lamp_deg).sin();
        let (elevation, azimuth) = (Angle::from_deg(view_deg), Angle::from_deg(from_deg));
        self.tables.radiance(self.height_km, cos_lamp, elevation, azimuth, &mut nodes);
        let all: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
        let shares = reconstruction_matrix(&SKY_NODES_NM, &all).spectrum(&nodes);
        lamp.weighted(|nm| shares[((nm - FIRST_NM) / STEP_NM).round() as usize]).xyzv().y
    }

    fn zenith_cd_m2(&self, sun_deg: f64) -> f64 {
        self.luminance_cd_m2(&sun::irradiance_1au(), sun_deg, 90.0, 0.0)
    }
}

fn magnitudes(ratio: f64) -> f64 {
    -2.5 * ratio.log10()
}

/// Zenith luminance in cd/m2 by altitude of the Sun: Koomen et al. 1952, *J. Opt. Soc. Am.* 42, 353, at
/// Sacramento Peak (2.8 km) and in Maryland (30 m), the light of the night in it.
const KOOMEN: [(f64, f64, f64); 5] = [
    (0.0, 86.0, 161.0),
    (-3.0, 10.8, 21.5),
    (-6.0, 0.237, 0.646),
    (-9.0, 0.0081, 0.0161),
    (-12.0, 8.2e-4, 1.29e-3),
];

/// Zenith of Paranal in V, magnitudes per square arcsecond, by zenith distance of the Sun, 95 to 105
/// degrees: Patat, Ugolnikov & Postylyakov 2006, *A&A* 455, 385, the light of the night in it.
fn patat_mag(zenith_distance_deg: f64) -> f64 {
    let past = zenith_distance_deg - 95.0;
    11.84 + 1.518 * past - 0.057 * past * past
}

#[test]
fn twilight_lies_between_the_sites_that_were_measured() {
    let night_cd_m2 = luminance_cd_m2(21.9);
    let (low, high) = (Sky::over(30.0), Sky::over(2800.0));
    for (sun_deg, peak, maryland) in KOOMEN {
        for (site, sky) in [("30 m", &low), ("2800 m", &high)] {
            let ours = sky.zenith_cd_m2(sun_deg) + night_cd_m2;
            let (from_peak, from_sea) = (magnitudes(ours / peak), magnitudes(ours / maryland));
            println!("{sun_deg:>4}, {site}: {ours:.3e} cd/m2, {from_peak:+.2} {from_sea:+.2} mag");
            // Between the two, or 0.3 magnitudes off the nearer one.
            assert!(from_peak < 0.3 && from_sea > -0.3, "{sun_deg}, {site}");
        }
    }
}

#[test]
fn twilight_falls_as_fast_as_over_paranal() {
    let sky = Sky::over(2635.0);
    let night_cd_m2 = luminance_cd_m2(21.6);
    let mag = |sun_deg: f64| 12.58 + magnitudes(sky.zenith_cd_m2(sun_deg) + night_cd_m2);
    for zenith_distance_deg in [95.0, 96.0, 98.0, 100.0, 102.0, 104.0] {
        let (ours, patat) = (mag(90.0 - zenith_distance_deg), patat_mag(zenith_distance_deg));
        println!("{zenith_distance_deg}: {ours:.2}, Patat {patat:.2}");
        assert!((ours - patat).abs() < 0.6, "{zenith_distance_deg}: {ours} {patat}");
    }
    // Koomen: 1.25 magnitudes a degree from -3 to -11; Patat: 1.14 from -5 to -10.
    let slope = (mag(-11.0) - mag(-3.0)) / 8.0;
    println!("{slope:.3} mag per degree");
    assert!((1.1..1.3).contains(&slope), "{slope}");
}

#[test]
fn moonlight_is_as_bright_as_the_sky_models_of_observatories() {
    // Full Moon 45 degrees high, 45 degrees from the field: 18.0 in V after the ESO sky model (Noll et
    // al. 2012, Jones et al. 2013), 18.3 after Krisciunas & Schaefer 1991.
    let night_cd_m2 = luminance_cd_m2(21.83);
    let moon = moon::irradiance(&MoonView::at_phase(Angle::from_deg(1.5)));
    // A clear night at the sea; and Paranal, with 0.05 of aerosol above it.
    let mut paranal = Atmosphere::default();
    paranal.aerosol.optical_depth_550 = 0.05;
    for (site, sky, faintest) in
        [("sea", Sky::over(30.0), 18.4), ("Paranal", Sky::of(paranal, 2635.0), 18.5)]
    {
        // The zenith is 45 degrees away.
        let ours = sky.luminance_cd_m2(&moon, 45.0, 90.0, 0.0) + night_cd_m2;
        let mag = 12.58 + magnitudes(ours);
        println!("{site}: {mag:.2} mag per square arcsecond");
        assert!((17.7..faintest).contains(&mag), "{site}: {mag}");
    }
}
