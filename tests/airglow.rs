//! Airglow against published brightnesses, and the whole zenith as the sum of its parts.

use nocturne::light::airglow::{AirglowConditions, GlowLayer, airglow, paper_airglow};
use nocturne::light::photometry::{Band, mag_per_arcsec2, s10_v, sqm_mag_per_arcsec2};
use nocturne::light::spectrum::Spectrum;
use nocturne::light::{sun, zodiacal};
use nocturne::units::Angle;

fn sum(layers: &[GlowLayer]) -> Spectrum {
    layers.iter().map(|layer| layer.zenith).sum()
}
fn mean(solar_flux_sfu: f64) -> Spectrum {
    sum(&airglow(&AirglowConditions::mean(solar_flux_sfu)))
}

/// Starlight and galactic light away from the Milky Way, by V in S10: sunlight somewhat reddened.
fn stars(s10: f64) -> Spectrum {
    let light = sun::irradiance_1au().weighted(|nm| (nm / 550.0).powf(0.5));
    light * (s10 / s10_v(&light))
}

/// The sky outside the air, without the Milky Way: airglow, zodiacal light, stars.
fn sky(flux: f64, longitude_deg: f64, latitude_deg: f64) -> [Spectrum; 3] {
    let zodiacal =
        zodiacal::radiance(Angle::from_deg(longitude_deg), Angle::from_deg(latitude_deg));
    [mean(flux), zodiacal, stars(30.0)]
}

#[test]
fn layers_have_their_lines() {
    let layers = airglow(&AirglowConditions::mean(100.0));
    let heights: Vec<f64> = layers.iter().map(|layer| layer.height_km).collect();
    assert_eq!(heights, [88.0, 97.0, 250.0]);
    // 162.7 R of 557.7 nm are 4.6e-8 W m-2 sr-1 and 3.2e-5 cd/m2.
    let green = layers[1].zenith;
    let power: f64 = green.values().iter().sum::<f64>() * 5.0;
    assert!((power - 4.6e-8).abs() < 1e-9, "{power:e}");
    assert!((green.xyzv().y - 3.2e-5).abs() < 1e-6, "{}", green.xyzv().y);
    let red: f64 = layers[2].zenith.values().iter().sum::<f64>() * 5.0;
    assert!((red / (163.7 * 2.5e-10) - 1.0).abs() < 0.02, "{red:e}");
}

#[test]
fn it_has_the_published_brightness_in_v() {
    // Roach & Gordon: 145 S10(V) at 80 sfu, 275 at 200, of the sky with all that changes with the Sun.
    for (flux, expected, within) in
        [(80.0, 145.0, 0.15), (130.0, 199.0, 0.25), (200.0, 275.0, 0.40)]
    {
        let got = s10_v(&mean(flux));
        println!("{flux} sfu: {got:.1} S10(V), law {expected}");
        assert!((got / expected - 1.0).abs() < within, "{flux}: {got}");
    }
}

#[test]
fn the_zenith_of_paranal_at_solar_maximum() {
    // Patat 2003, April 2000 to September 2001, some 180 sfu: V 21.61, B 22.64, R 20.87, which are
    // brightnesses of the whole sky at the zenith, far from the Milky Way and the ecliptic's cone.
    let parts = sky(180.0, 120.0, 25.0);
    let whole: Spectrum = parts.iter().copied().sum();
    println!("S10(V): {:?}", parts.map(|part| s10_v(&part).round()));
    for (band, expected, within) in
        [(Band::V, 21.61, 0.20), (Band::B, 22.64, 0.25), (Band::R, 20.87, 0.25)]
    {
        let got = mag_per_arcsec2(&whole, band);
        println!("{band:?} {got:.2}, measured {expected}");
        assert!((got - expected).abs() < within, "{band:?}: {got:.3}");
    }
}

#[test]
fn the_darkest_nights() {
    // Grauer et al. 2021: 22.0 to 22.13 at 70 sfu, high above the ecliptic.
    let parts = sky(70.0, 150.0, 60.0);
    let whole: Spectrum = parts.iter().copied().sum();
    let v = mag_per_arcsec2(&whole, Band::V);
    println!(
        "S10(V) {:?}: V {v:.2}, meter {:.2}",
        parts.map(|part| s10_v(&part).round()),
        sqm_mag_per_arcsec2(&whole)
    );
    assert!((21.9..22.15).contains(&v), "{v}");
    let s10 = parts.map(|part| s10_v(&part));
    assert!((100.0..160.0).contains(&s10[0]) && (50.0..100.0).contains(&s10[1]), "{s10:?}");
    // Crumey's luminance of a magnitude, 10^((12.58 - V) / 2.5), against that of the spectrum itself.
    let off = whole.xyzv().y / 10f64.powf((12.58 - v) / 2.5);
    println!("luminance over Crumey's {off:.3}, S/P {:.2}", whole.xyzv().v / whole.xyzv().y);
    assert!((0.95..1.2).contains(&off), "{off}");
    let ratio = whole.xyzv().v / whole.xyzv().y;
    assert!((1.3..2.3).contains(&ratio), "{ratio}");
}

#[test]
fn the_paper_has_three_peaks() {
    let layers = paper_airglow();
    assert_eq!((layers.len(), layers[0].height_km), (1, 80.0));
    let values = layers[0].zenith;
    let lit: Vec<usize> = (0..95).filter(|k| values.values()[*k] > 0.0).collect();
    assert_eq!(lit, [39, 40, 44, 45, 54]);
    let irradiance = values.values().iter().sum::<f64>() * 5.0 * std::f64::consts::PI;
    assert!((irradiance / 5.1e-8 - 1.0).abs() < 1e-9);
}

#[test]
fn hours_and_seasons_matter_as_published() {
    let at = |month: f64, local_time_h: f64| {
        airglow(&AirglowConditions {
            solar_flux_sfu: 120.0,
            month,
            local_time_h,
            latitude: Angle::from_deg(-24.6),
        })
    };
    let red = |month, hour| at(month, hour)[2].zenith.xyzv().y;
    // The red line decays through the night: in April six times and more from 20 h to 5 h.
    assert!(red(3.5, 20.0) > 3.0 * red(3.5, 28.5), "{} {}", red(3.5, 20.0), red(3.5, 28.5));
    let green = |month| at(month, 26.0)[1].zenith.xyzv().y;
    assert!(green(3.5) > 1.3 * green(0.5), "{} {}", green(3.5), green(0.5));
}
