//! Eclipses as light, against contact times and published brightness.

use std::sync::LazyLock;

use nocturne::air::Atmosphere;
use nocturne::almanac::eclipse::{LunarEclipse, lunar_eclipses, solar_eclipses};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::light::earth_shadow::{
    Danjon, EarthShadow, ShadowDistances, ShadowRow, ShadowedMoon,
};
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
fn the_middle_is_red_and_the_rim_is_blue() {
    let light = |arcmin: f64| USUAL.light_at(Angle::from_arcmin(arcmin));
    // Magnitudes by which blue (440 nm) loses more than green (550 nm): B - V grows.
    let growth = |arcmin: f64| magnitudes(light(arcmin).at_nm(440.0) / light(arcmin).at_nm(550.0));
    println!("B - V grows by {:.2} in the middle, {:.2} at 30'", growth(0.0), growth(30.0));
    assert!((1.0..5.0).contains(&growth(0.0)), "{}", growth(0.0));
    assert!(growth(0.0) > growth(30.0) && growth(30.0) > growth(40.0));
    // Through the ozone: blue passes, orange (600 nm, the Chappuis bands) does not.
    let rim = light(40.0).at_nm(450.0) / light(40.0).at_nm(600.0);
    let without = Atmosphere {
        ozone: nocturne::air::Ozone { column_du: 0.0, ..Default::default() },
        ..Atmosphere::default()
    };
    let bare = EarthShadow::new(&without, Danjon::default(), ShadowDistances::MEAN).unwrap();
    let bare = bare.light_at(Angle::from_arcmin(40.0));
    println!(
        "450/600 nm at 40': {rim:.2}, without ozone {:.2}",
        bare.at_nm(450.0) / bare.at_nm(600.0)
    );
    assert!((1.15..3.0).contains(&rim), "{rim}");
    assert!(bare.at_nm(450.0) < bare.at_nm(600.0));
    let inside = light(20.0);
    assert!(inside.at_nm(450.0) < 0.2 * inside.at_nm(600.0));
}

#[test]
fn the_penumbra_is_the_part_of_the_sun_beside_the_earth() {
    let distances = ShadowDistances::MEAN;
    // Without air but 36 km of it that are opaque, by the two circles of an eclipse of the Sun.
    let earth = Angle::from_rad(((6371.0 + 36.0) / distances.earth_km).asin());
    let mut worst = 0.0f64;
    for step in 0..57 {
        let separation = Angle::from_arcmin(45.0 + 0.5 * f64::from(step));
        let sun_radius = distances.sun_radius();
        let circles = CoveredSun { sun_radius, moon_radius: earth, separation };
        let (got, wanted) = (USUAL.light_at(separation), circles.visible());
        for nm in [450.0, 550.0, 650.0] {
            worst = worst.max((got.at_nm(nm) - wanted.at_nm(nm)).abs());
        }
    }
    println!("penumbra: within {worst:.4} of circles");
    assert!(worst < 0.008, "{worst}");
    // Half of the Sun: its middle on the limb, less a little because the limb is round.
    let half = photopic(USUAL.light_at(earth));
    assert!((0.51..0.55).contains(&half), "{half}");
}

#[test]
fn light_grows_outwards_to_all_of_it() {
    let rim = ShadowDistances::MEAN.outer_rim();
    assert_eq!(USUAL.light_at(rim), Transmittance::CLEAR);
    assert!(photopic(USUAL.light_at(rim - Angle::from_arcmin(0.3))) > 0.999);
    let mut before = 0.0;
    for step in 0..=740 {
        let here = photopic(USUAL.light_at(Angle::from_arcmin(0.1 * f64::from(step))));
        assert!(here >= before, "{step}: {here} {before}");
        before = here;
    }
    // The mean over a disc: of a small one its middle, outside the shadow all.
    let at = Angle::from_arcmin(55.0);
    let (point, small) = (USUAL.light_at(at), USUAL.over_disc(at, Angle::from_arcmin(0.5)));
    assert!((photopic(small) / photopic(point) - 1.0).abs() < 2e-3);
    assert_eq!(photopic(USUAL.over_disc(rim + at, at)), 1.0);
    // The table that a renderer gets.
    let rows = USUAL.rows(&sun::irradiance_1au());
    assert_eq!(rows[0].offset, Angle::ZERO);
    assert!((rows.last().unwrap().light.y / 133_500.0 - 1.0).abs() < 1e-3);
    let row = &rows[100];
    assert!((row.bands[2] / USUAL.light_at(row.offset).at_nm(600.0) - 1.0).abs() < 1e-9);
}

#[test]
fn the_table_is_read_within_two_per_cent() {
    // Other distances shift the nodes; a shadow seen from slightly farther has the light of the same
    // place in it.
    let shifted = ShadowDistances { earth_km: 384_400.0 * 1.0026, ..ShadowDistances::MEAN };
    let shifted = EarthShadow::new(&Atmosphere::default(), Danjon::default(), shifted).unwrap();
    for arcmin in [3.3, 21.7, 35.2, 47.9, 60.3] {
        let here = photopic(USUAL.light_at(Angle::from_arcmin(arcmin)));
        let there = photopic(shifted.light_at(Angle::from_arcmin(arcmin)));
        assert!((there / here - 1.0).abs() < 0.06, "{arcmin}': {here:e} {there:e}");
    }
    // Within one step logarithms are nearly straight: three nodes against the middle one.
    let rows = USUAL.rows(&sun::irradiance_1au());
    let ln = |offset: Angle| photopic(USUAL.light_at(offset)).ln();
    for nodes in rows.windows(3).take_while(|nodes| nodes[1].offset.arcmin() < 55.0) {
        let [a, b, c] = [0, 1, 2].map(|k: usize| nodes[k].offset.rad());
        let [la, lb, lc] = [0, 1, 2].map(|k: usize| ln(nodes[k].offset));
        let bend = lb - (la * (c - b) + lc * (b - a)) / (c - a);
        // What is left out between nodes is an eighth of the second difference, a quarter of this.
        assert!(0.25 * bend.abs() < 0.02, "{:.1}': {bend}", nodes[1].offset.arcmin());
    }
}

#[test]
fn light_fails_at_the_contacts() {
    let place = Place::new(35.2, -111.65, 2100.0).unwrap();
    for (from, to) in [
        ("2025-03-01T00:00Z", "2025-03-20T00:00Z"),
        ("2026-02-25T00:00Z", "2026-03-10T00:00Z"),
        ("2028-12-25T00:00Z", "2029-01-05T00:00Z"),
    ] {
        let eclipse = lunar_eclipse(from, to);
        let at = |moment: &Instant, minutes: f64| {
            ShadowedMoon::of(&sky(&moment.plus_seconds(60.0 * minutes).unwrap(), &place))
        };
        let limb = |moon: &ShadowedMoon, side: f64| {
            let shadow =
                EarthShadow::new(&Atmosphere::default(), Danjon::default(), moon.distances);
            photopic(shadow.unwrap().light_at(moon.offset + moon.disc_radius() * side))
        };
        let contacts = &eclipse.contacts;
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            // P1, P4: the nearest limb is still lit, and soon no more.
            let p = &contacts.penumbral[k];
            let (touch, later) = (limb(&at(p, 0.0), -1.0), limb(&at(p, 5.0 * sign), -1.0));
            assert!(touch > 0.995 && later < 0.99 && later > 0.9, "P: {touch} {later}");
            assert!(limb(&at(p, -3.0 * sign), -1.0) > 0.9999);
            // U1: the nearest limb fails by a factor of ten within some minutes.
            let u = &contacts.partial.expect("it is total")[k];
            let (before, after) = (limb(&at(u, -5.0 * sign), -1.0), limb(&at(u, 5.0 * sign), -1.0));
            assert!(before > 5e-3 && after < 1e-3, "U1: {before:e} {after:e}");
            // U2: so does the farthest.
            let u = &contacts.total.expect("it is total")[k];
            let (before, after) = (limb(&at(u, -5.0 * sign), 1.0), limb(&at(u, 5.0 * sign), 1.0));
            assert!(before > 5e-3 && after < 1e-3, "U2: {before:e} {after:e}");
            // The steepest place of the logarithm is where Danjon has the umbra, within 10 s.
            let [partial, total] = [contacts.partial, contacts.total].map(|c| c.expect("total")[k]);
            for (name, u, side) in [("U1 or U4", partial, -1.0), ("U2 or U3", total, 1.0)] {
                let moon = at(&u, 0.0);
                let shadow =
                    EarthShadow::new(&Atmosphere::default(), Danjon::default(), moon.distances)
                        .unwrap();
                // Of the steps of the table, 4" there, the steepest.
                let rows = shadow.rows(&sun::irradiance_1au());
                let slope = |a: &ShadowRow, b: &ShadowRow| {
                    (b.light.y / a.light.y).ln() / (b.offset - a.offset).arcsec()
                };
                let steepest = rows
                    .windows(2)
                    .max_by(|a, b| slope(&a[0], &a[1]).total_cmp(&slope(&b[0], &b[1])))
                    .map(|step| 0.5 * (step[0].offset + step[1].offset).arcsec())
                    .expect("some");
                let umbra = (moon.offset + moon.disc_radius() * side).arcsec();
                // How fast the limb crosses the edge.
                let next = at(&u, 1.0);
                let per_s = (next.offset - moon.offset).arcsec().abs() / 60.0;
                let off_s = (steepest - umbra) / per_s;
                println!(
                    "{from} {name}: steepest {steepest:.1}\", contact {umbra:.1}\": {off_s:+.1} s"
                );
                assert!(off_s.abs() < 10.0, "{from} {name}: {off_s} s");
            }
        }
        let middle = at(&eclipse.greatest, 0.0);
        assert!(limb(&middle, 1.0) < 1.5e-3);
    }
}

#[test]
fn the_night_of_an_eclipse_is_dark() {
    let place = Place::new(35.2, -111.65, 2100.0).unwrap();
    let eclipse = lunar_eclipse("2025-03-01T00:00Z", "2025-03-20T00:00Z");
    let night = |number: f64, hours: f64| {
        let moment = eclipse.greatest.plus_seconds(3600.0 * hours).unwrap();
        let danjon = Danjon::new(number).unwrap();
        Night::with_danjon(sky(&moment, &place), Vec::new(), &Atmosphere::default(), danjon)
    };
    let magnitude = |night: &Night| night.body(Body::Moon).unwrap().magnitude.0;
    let full = night(2.0, -6.0);
    assert!(full.eclipse.moon.is_none());
    assert!((-12.95..-12.3).contains(&magnitude(&full)), "{}", magnitude(&full));
    let mut before = f64::MAX;
    for number in [0.0, 1.0, 2.0, 3.0, 4.0] {
        let dark = night(number, 0.0);
        let here = magnitude(&dark);
        println!("2025-03-14, L {number}: magnitude {here:.2}");
        // What observers report: +4 in the darkest, -3.5 in the brightest (recalled).
        assert!((-5.0..3.0).contains(&here), "L {number}: {here}");
        assert!(here < before);
        before = here;
    }
    // Without it the same Moon is as bright as ever.
    let dark = night(2.0, 0.0);
    let state = &dark.sky.moon.state;
    let (left, all) = (dark.irradiance(state), dark.irradiance_without_eclipse(state));
    let share = left.xyzv().y / all.xyzv().y;
    assert!((1e-6..1e-3).contains(&share), "{share:e}");
    assert!(left.at_nm(650.0) / left.at_nm(450.0) > 5.0 * all.at_nm(650.0) / all.at_nm(450.0));
}

#[test]
fn the_crescent_of_the_sun_is_that_of_the_almanac() {
    // Published maxima: magnitude and obscuration (recalled from the maps of the day).
    let los_angeles = (34.05, -118.24, 0.69, 0.62);
    let new_york = (40.71, -74.01, 0.911, 0.897);
    for (from, to, (latitude, longitude, magnitude, obscuration)) in [
        ("2017-08-15T00:00Z", "2017-08-30T00:00Z", los_angeles),
        ("2024-04-01T00:00Z", "2024-04-20T00:00Z", new_york),
    ] {
        let place = Place::new(latitude, longitude, 50.0).unwrap();
        let mut found = solar_eclipses(&EPHEMERIS, instant(from), instant(to), BEST);
        let local = found.next().unwrap().unwrap().at(&place).unwrap().expect("it is seen");
        let seen = local.maximum;
        let sun = CoveredSun::of(&sky(&seen.moment.instant, &place));
        println!(
            "{from}: magnitude {:.4} {:.4}, obscuration {:.4} {:.4}",
            sun.magnitude(),
            seen.magnitude,
            sun.obscuration(),
            seen.obscuration
        );
        // The radii differ by 0.0004 of the Sun and 0.0004 of the Moon.
        assert!((sun.magnitude() - seen.magnitude).abs() < 1.5e-3);
        assert!((sun.obscuration() - seen.obscuration).abs() < 1.5e-3);
        assert!((sun.magnitude() - magnitude).abs() < 0.01);
        assert!((sun.obscuration() - obscuration).abs() < 0.01);
        // The rest is nearer to the limb than the disc is: fainter than its area, and redder.
        let left = sun.visible();
        let area = 1.0 - sun.obscuration();
        assert!(left.at_nm(550.0) < area && left.at_nm(550.0) > 0.6 * area);
        assert!(left.at_nm(650.0) > 1.02 * left.at_nm(450.0));
        let night =
            Night::of(sky(&seen.moment.instant, &place), Vec::new(), &Atmosphere::default());
        let lx = night.body(Body::Sun).unwrap().outside.lx();
        assert!((lx / 133_500.0 / photopic(left) - 1.0).abs() < 0.04, "{lx}");
    }
}

#[test]
fn the_sun_goes_out_step_by_step() {
    let (sun_radius, moon_radius) = (Angle::from_arcmin(16.0), Angle::from_arcmin(16.6));
    let at = |arcmin: f64| CoveredSun {
        sun_radius,
        moon_radius,
        separation: Angle::from_arcmin(arcmin),
    };
    assert_eq!(at(33.0).visible(), Transmittance::CLEAR);
    let mut before = 1.0 + 1e-9;
    for step in 0..=65 {
        let here = photopic(at(32.6 - 0.5 * f64::from(step)).visible());
        assert!(here < before || here == 0.0, "{step}: {here}");
        before = here;
    }
    assert_eq!(photopic(at(0.0).visible()), 0.0);
    assert!(at(0.5).is_total() && !at(0.7).is_total());
    // The area against the closed form of two circles.
    for arcmin in [5.0, 12.0, 20.0, 30.0] {
        let (r, m, d) = (16.0f64, 16.6f64, arcmin);
        let (p, q): (f64, f64) =
            ((d * d + r * r - m * m) / (2.0 * d * r), (d * d + m * m - r * r) / (2.0 * d * m));
        let kite = ((-d + r + m) * (d + r - m) * (d - r + m) * (d + r + m)).sqrt() / 2.0;
        let area = r * r * p.acos() + m * m * q.acos() - kite;
        let wanted = area / (std::f64::consts::PI * r * r);
        assert!((at(arcmin).obscuration() - wanted).abs() < 2e-4, "{arcmin}'");
    }
    // In totality half a millionth or so is left, of the colour of the Sun: the light of a full Moon.
    let corona = at(0.0).irradiance(AU_KM).xyzv().y;
    assert!((0.05..0.14).contains(&corona), "{corona} lx");
    // An annular eclipse leaves a ring.
    let ring = CoveredSun { moon_radius: Angle::from_arcmin(15.0), ..at(0.0) };
    assert!((ring.obscuration() - (15.0f64 / 16.0).powi(2)).abs() < 2e-4);
    let left = photopic(ring.visible());
    assert!(left > 0.05 && left < 1.0 - ring.obscuration());
}

#[test]
fn totality_has_the_light_of_the_corona() {
    let mut found = solar_eclipses(
        &EPHEMERIS,
        instant("2024-04-01T00:00Z"),
        instant("2024-04-20T00:00Z"),
        BEST,
    );
    let eclipse = found.next().unwrap().unwrap();
    let place =
        Place::new(eclipse.place.latitude.deg(), eclipse.place.longitude.deg(), 0.0).unwrap();
    let night = Night::of(sky(&eclipse.greatest, &place), Vec::new(), &Atmosphere::default());
    let sun = night.body(Body::Sun).unwrap();
    assert!(night.eclipse.sun.unwrap().is_total());
    println!("2024-04-08 in totality: magnitude {:.2}", sun.magnitude.0);
    // About as bright as the full Moon.
    assert!((-13.0..-10.5).contains(&sun.magnitude.0), "{:?}", sun.magnitude);
    let whole = night.irradiance_without_eclipse(&night.sky.sun).xyzv().y;
    assert!((whole / 133_500.0 - 1.0).abs() < 0.035);
}
