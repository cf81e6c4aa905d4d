//! Eclipses and earthshine as light, against contact times and published brightness.

use std::sync::LazyLock;

use nocturne::air::Atmosphere;
use nocturne::almanac::eclipse::{LunarEclipse, lunar_eclipses, solar_eclipses};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::light::earth_shadow::{Danjon, EarthShadow, ShadowDistances, ShadowedMoon};
use nocturne::light::earthshine::{self, EarthView};
use nocturne::light::moon::{self, MoonView};
use nocturne::light::night::Night;
use nocturne::light::solar_eclipse::CoveredSun;
use nocturne::light::spectrum::Transmittance;
use nocturne::light::sun;
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time::{self, Instant};
use nocturne::units::{AU_KM, Angle};

const BEST: Angle = Angle::from_arcsec(0.01);

static EPHEMERIS: LazyLock<Ephemeris> = LazyLock::new(|| {
    let catalogs = Catalogs::locate(None).expect("the catalogues of this repository");
    Ephemeris::load(&catalogs, BEST).expect("tables that are whole")
});

fn shadow(number: f64) -> EarthShadow {
    let danjon = Danjon::new(number).expect("a number of the scale");
    EarthShadow::new(&Atmosphere::default(), danjon, ShadowDistances::MEAN).expect("usual air")
}

static USUAL: LazyLock<EarthShadow> = LazyLock::new(|| shadow(2.5));

fn instant(text: &str) -> Instant {
    time::to_instant(&time::parse(text).expect("a time"), None).expect("within range")
}

fn sky(instant: &Instant, place: &Place) -> SkyState {
    SkyState::at(&EPHEMERIS, instant, place, BEST).expect("served")
}

/// Photopic light of the Sun through a share, over that of the Sun.
fn photopic(share: Transmittance) -> f64 {
    (sun::irradiance_1au() * share).xyzv().y / sun::irradiance_1au().xyzv().y
}

fn magnitudes(share: f64) -> f64 {
    -2.5 * share.log10()
}

fn lunar_eclipse(from: &str, to: &str) -> LunarEclipse {
    let mut found = lunar_eclipses(&EPHEMERIS, instant(from), instant(to), BEST);
    found.next().expect("there is one").expect("served")
}

#[test]
fn the_umbra_is_as_dark_as_danjon_says() {
    let mut before = 0.0;
    for (number, least, most) in [
        (0.0, 5e-7, 3e-6),
        (1.0, 1e-6, 1e-5),
        (2.0, 4e-6, 3e-5),
        (3.0, 1e-5, 8e-5),
        (4.0, 2e-5, 2e-4),
    ] {
        let shadow = shadow(number);
        let middle = photopic(shadow.light_at(Angle::ZERO));
        let blue_red = |deg: f64| {
            let light = shadow.light_at(Angle::from_deg(deg));
            light.at_nm(440.0) / light.at_nm(670.0)
        };
        println!(
            "L {number}: middle {middle:.2e} ({:.1} mag), at 20' {:.2e}, 30' {:.2e}, 36' {:.2e}, 40' {:.2e}; 440/670 nm {:.1e} {:.2} {:.2} {:.2}",
            magnitudes(middle),
            photopic(shadow.light_at(Angle::from_arcmin(20.0))),
            photopic(shadow.light_at(Angle::from_arcmin(30.0))),
            photopic(shadow.light_at(Angle::from_arcmin(36.0))),
            photopic(shadow.light_at(Angle::from_arcmin(40.0))),
            blue_red(0.0),
            blue_red(0.5),
            blue_red(0.6),
            blue_red(0.65),
        );
        assert!((least..most).contains(&middle), "L {number}: {middle:e}");
        assert!(middle > before, "L {number}");
        before = middle;
    }
}

#[test]
fn dump() {
    let s = &*USUAL;
    for step in 0..80 {
        let a = Angle::from_arcmin(f64::from(step));
        let l = s.light_at(a);
        println!(
            "{step}' {:.3e}  {:.3e} {:.3e} {:.3e} {:.3e}",
            photopic(l),
            l.at_nm(450.0),
            l.at_nm(530.0),
            l.at_nm(600.0),
            l.at_nm(670.0)
        );
    }
}
