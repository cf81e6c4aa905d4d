//! The dark sky against what photometers measure: brightness overhead, how it changes towards the
//! horizon, what it is made of, moonlit skies; and that no light is counted twice.

use nocturne::air::Atmosphere;
use nocturne::camera::{Camera, Projection};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::frame::{Apparent, Dir};
use nocturne::light::dark_sky::Component;
use nocturne::light::moon::Reflectance;
use nocturne::light::night::Night;
use nocturne::light::night_lights::{NightGlow, helioecliptic_from_horizon};
use nocturne::light::photometry::{Band, luminance_cd_m2};
use nocturne::light::starlight::S10_CD_M2;
use nocturne::place::Place;
use nocturne::plan::FramePlan;
use nocturne::plan::brightness::{MeasuredSky, SkyBrightness, Source};
use nocturne::plan::lay::{Kept, lay_in};
use nocturne::scene::{Layers, Setting};
use nocturne::sky::SkyState;
use nocturne::store::Store;
use nocturne::time;
use nocturne::units::Angle;

const PARANAL: (f64, f64, f64) = (-24.627, -70.404, 2635.0);
/// A dark place at a middle latitude.
const FLAGSTAFF: (f64, f64, f64) = (35.2, -111.65, 2106.0);

fn deg(deg: f64) -> Angle {
    Angle::from_deg(deg)
}

fn towards(azimuth_deg: f64, altitude_deg: f64) -> Dir<Apparent> {
    Dir::from_azimuth_altitude(deg(azimuth_deg), deg(altitude_deg))
}

fn night((latitude, longitude, height_m): (f64, f64, f64), at: &str) -> Night {
    let place = Place::new(latitude, longitude, height_m).unwrap();
    let instant = time::to_instant(&time::parse(at).unwrap(), None).unwrap();
    let sky = SkyState::at(&Ephemeris::analytic(), &instant, &place, deg(0.01)).unwrap();
    let stars = Catalogs::locate(None).unwrap().stars().unwrap();
    Night::of(sky, stars, &Atmosphere::clear_over(height_m))
}

fn with_flux(solar_flux_sfu: f64) -> NightGlow {
    NightGlow { solar_flux_sfu: Some(solar_flux_sfu), ..NightGlow::default() }
}

/// The sky of a night in some directions, the Moon left out.
fn moonless(
    night: &Night,
    glow: &NightGlow,
    kept: &mut Kept,
    dirs: &[Dir<Apparent>],
) -> Vec<SkyBrightness> {
    let catalogs = Catalogs::locate(None).unwrap();
    let sky = MeasuredSky::of(night, glow, &Layers::default(), &catalogs, kept).unwrap();
    let mut seen: Vec<SkyBrightness> = dirs.iter().map(|dir| sky.at(*dir, kept).unwrap()).collect();
    for sky in &mut seen {
        sky.sources.retain(|(source, _)| matches!(source, Source::Dark(_)));
    }
    seen
}

fn unkept() -> Kept {
    Kept::new(Store::NONE)
}

fn s10(sky: &SkyBrightness, wanted: &[Component]) -> f64 {
    let is_wanted = |source: &Source| matches!(source, Source::Dark(c) if wanted.contains(c));
    let parts = sky.sources.iter().filter(|(source, _)| is_wanted(source));
    parts.map(|(_, light)| light.xyzv().y).sum::<f64>() / S10_CD_M2
}

/// Moments of dark nights, one for each two months, at which something else stands overhead.
const MOMENTS: [&str; 6] = [
    "2026-01-18T06:00Z",
    "2026-03-19T06:00Z",
    "2026-05-16T06:00Z",
    "2026-07-14T06:00Z",
    "2026-09-11T06:00Z",
    "2026-11-09T06:00Z",
];

/// Galactic and ecliptic latitude of the zenith, degrees, both without sign.
fn latitudes(night: &Night) -> [f64; 2] {
    let up = Dir::from_azimuth_altitude(Angle::ZERO, deg(90.0));
    let galactic =
        nocturne::frame::galactic_from_icrs() * (night.sky.horizon_from_icrs.inverse() * up);
    let ecliptic = helioecliptic_from_horizon(&night.sky) * up;
    [galactic.latitude().deg().abs(), ecliptic.latitude().deg().abs()]
}

#[test]
fn the_zenith_of_a_dark_place_adds_up() {
    let mut kept = unkept();
    let mut seen = 0;
    for at in MOMENTS {
        let night = night(FLAGSTAFF, at);
        let [galactic, ecliptic] = latitudes(&night);
        // The budget is that of a sky away from the Milky Way.
        if galactic < 30.0 {
            continue;
        }
        seen += 1;
        for (flux, airglow_s10) in [(70.0, 90.0..180.0), (180.0, 130.0..280.0)] {
            let sky = &moonless(&night, &with_flux(flux), &mut kept, &[towards(0.0, 90.0)])[0];
            let v = sky.mag_per_arcsec2(Band::V).unwrap();
            let airglow = s10(sky, &[Component::Airglow]);
            let zodiacal = s10(sky, &[Component::Zodiacal]);
            let stars = s10(sky, &[Component::Starlight, Component::Galactic]);
            println!(
                "{at} b {galactic:.0} beta {ecliptic:.0} {flux} sfu: V {v:.2}, airglow {airglow:.0}, \
                 zodiacal {zodiacal:.0}, stars {stars:.0} S10"
            );
            assert!((21.5..22.1).contains(&v), "{at} {flux}: {v}");
            assert!(airglow_s10.contains(&airglow), "{at} {flux}: {airglow}");
            // 140 - 90 sin b, and what the scatter of the table's nights adds.
            let expected = 140.0 - 90.0 * ecliptic.to_radians().sin();
            assert!((zodiacal / expected - 1.0).abs() < 0.45, "{at}: {zodiacal} {expected}");
            assert!((15.0..75.0).contains(&stars), "{at}: {stars}");
        }
    }
    assert!(seen >= 2, "{seen}");
}

#[test]
fn paranal_at_solar_maximum_is_as_patat_measured() {
    // Patat 2003, A&A 400, 1183: B 22.64, V 21.61, R 20.87, brought to the zenith and dark time, April
    // 2000 to September 2001; fields away from the Milky Way.
    let mut kept = unkept();
    let mut sums = [0.0; 3];
    let mut seen = 0.0;
    for at in MOMENTS {
        let night = night(PARANAL, &at.replace("06:00", "04:30"));
        let dirs = [[0.0, 90.0], [0.0, 75.0], [120.0, 75.0], [240.0, 75.0]];
        let dirs = dirs.map(|[azimuth, altitude]| towards(azimuth, altitude));
        for (dir, sky) in dirs.iter().zip(moonless(&night, &with_flux(180.0), &mut kept, &dirs)) {
            let horizon = night.refraction.horizon_from_apparent(*dir);
            let icrs = night.sky.horizon_from_icrs.inverse() * horizon;
            if (nocturne::frame::galactic_from_icrs() * icrs).latitude().deg().abs() < 20.0 {
                continue;
            }
            seen += 1.0;
            for (sum, band) in sums.iter_mut().zip(Band::ALL) {
                *sum += sky.mag_per_arcsec2(band).unwrap();
            }
        }
    }
    let [b, v, r] = sums.map(|sum| sum / seen);
    println!("B {b:.2} V {v:.2} R {r:.2} in {seen} fields");
    assert!(seen >= 10.0 && (v - 21.61).abs() < 0.3, "{v}");
    assert!((b - 22.64).abs() < 0.4 && (r - 20.87).abs() < 0.4, "{b} {r}");
}

#[test]
fn the_sky_brightens_towards_the_horizon_as_published() {
    // Patat 2003, appendix C, after Garstang 1989: airglow is 0.6 of the zenith, and goes with the
    // path through its layer, 0.13 mag for the air of Paranal.
    let published = |zenith_distance_deg: f64| {
        let x = (1.0 - 0.96 * deg(zenith_distance_deg).sin().powi(2)).powf(-0.5);
        -2.5 * (0.4 + 0.6 * x).log10() + 0.13 * (x - 1.0)
    };
    let mut kept = unkept();
    let distances = [0.0, 30.0, 45.0, 60.0, 70.0];
    let mut means = distances.map(|_| 0.0);
    for at in MOMENTS {
        let night = night(PARANAL, &at.replace("06:00", "04:30"));
        let mut dirs = Vec::new();
        for distance in distances {
            dirs.extend((0..12).map(|k| towards(30.0 * f64::from(k), 90.0 - distance)));
        }
        // Twilight and the Milky Way are no part of the published curve.
        let layers = Layers { milky_way: false, ..Layers::default() };
        let catalogs = Catalogs::locate(None).unwrap();
        let glow = with_flux(130.0);
        let sky = MeasuredSky::of(&night, &glow, &layers, &catalogs, &mut kept).unwrap();
        for (place, dir) in dirs.iter().enumerate() {
            let seen = sky.at(*dir, &mut kept).unwrap();
            let dark = seen.sources.iter().filter(|(source, _)| matches!(source, Source::Dark(_)));
            means[place / 12] += dark.map(|(_, light)| light.xyzv().y).sum::<f64>();
        }
    }
    for (distance, mean) in distances.into_iter().zip(means) {
        let got = -2.5 * (mean / means[0]).log10();
        let expected = published(distance);
        println!("{distance}: {got:.3}, published {expected:.3}");
        assert!((got - expected).abs() < 0.2, "{distance}: {got} {expected}");
    }
}

/// A plan of the whole sky.
fn whole_sky(night: &Night, limit: Option<f64>, kept: &mut Kept) -> FramePlan {
    let camera = Camera {
        projection: Projection::EqualArea,
        field_of_view: deg(180.0),
        azimuth: Angle::ZERO,
        altitude: deg(90.0),
        roll: Angle::ZERO,
        width_px: 400,
        height_px: 400,
    };
    let setting = Setting {
        instant: night.sky.instant,
        place: night.sky.place.clone(),
        camera,
        tolerance: deg(0.01),
        sky: None,
        night: with_flux(70.0),
        reflectance: Reflectance::default(),
        scintillation: None,
    };
    let layers =
        Layers { magnitude_limit: limit, planets: false, moon: false, ..Layers::default() };
    let catalogs = Catalogs::locate(None).unwrap();
    lay_in(&setting, &layers, night, &catalogs, kept).unwrap().0
}

/// Illuminance by the whole sky on planes that face it, lux: diffuse, and that of points.
fn light_of(plan: &FramePlan) -> [f64; 2] {
    // Cells of equal solid angle.
    let (rows, columns) = (120, 360);
    let cell_sr = 2.0 * std::f64::consts::PI / f64::from(rows * columns);
    let mut diffuse = 0.0;
    for row in 0..rows {
        let altitude = Angle::from_rad(((f64::from(row) + 0.5) / f64::from(rows)).asin());
        for column in 0..columns {
            let azimuth = deg(360.0 * (f64::from(column) + 0.5) / f64::from(columns));
            let dir = Dir::from_azimuth_altitude(azimuth, altitude);
            let stars = plan.milky_way.as_ref().map(|milky_way| milky_way.luminance(dir).y);
            diffuse += (plan.sky.luminance(dir).y + stars.unwrap()) * cell_sr;
        }
    }
    [diffuse, plan.splats.iter().map(|splat| splat.illuminance.y).sum()]
}

#[test]
fn no_light_is_counted_twice_and_none_is_lost() {
    for (place, at) in [(PARANAL, "2026-07-14T04:30Z"), (FLAGSTAFF, "2026-01-18T06:00Z")] {
        let night = night(place, at);
        let mut kept = unkept();
        let lights = [Some(2.0), Some(4.0), Some(5.0), Some(6.5), None].map(|limit| {
            let [diffuse, points] = light_of(&whole_sky(&night, limit, &mut kept));
            println!("{at} {limit:?}: {diffuse:.5e} + {points:.5e} = {:.5e} lx", diffuse + points);
            diffuse + points
        });
        for light in lights {
            assert!((light / lights[4] - 1.0).abs() < 0.01, "{light} {}", lights[4]);
        }
    }
}

#[test]
fn the_table_of_a_picture_is_the_sky_that_is_measured() {
    let night = night(PARANAL, "2026-07-14T04:30Z");
    let mut kept = unkept();
    let plan = whole_sky(&night, None, &mut kept);
    let low_and_high = [(10.0, 0.1), (100.0, 0.4), (190.0, 1.1), (280.0, 89.2), (10.0, 89.99)];
    let spread = (0..60).map(|k| (37.0 * f64::from(k), 2.0 + 1.45 * f64::from(k)));
    let all = low_and_high.into_iter().chain(spread);
    let dirs: Vec<Dir<Apparent>> =
        all.map(|(azimuth, altitude)| towards(azimuth, altitude)).collect();
    let mut worst: f64 = 0.0;
    for (dir, sky) in dirs.iter().zip(moonless(&night, &with_flux(70.0), &mut kept, &dirs)) {
        let picture = plan.sky.luminance(*dir) + plan.milky_way.as_ref().unwrap().luminance(*dir);
        let measured = sky.luminance();
        for (a, b) in [(picture.y, measured.y), (picture.v, measured.v), (picture.z, measured.z)] {
            worst = worst.max((a / b - 1.0).abs());
        }
    }
    println!("{worst}");
    assert!(worst < 0.01, "{worst}");
}

/// Krisciunas & Schaefer 1991, PASP 103, 1033, eqs. 3, 15, 20, 21: luminance of moonlight in the air, cd/m2.
fn krisciunas_schaefer(phase_deg: f64, apart_deg: f64, moon_z: Angle, z: Angle) -> f64 {
    const K: f64 = 0.172;
    const NANOLAMBERT_CD_M2: f64 = 3.183e-6;
    let i = 10f64.powf(-0.4 * (3.84 + 0.026 * phase_deg + 4e-9 * phase_deg.powi(4)));
    let f = 10f64.powf(5.36) * (1.06 + deg(apart_deg).cos().powi(2))
        + 10f64.powf(6.15 - apart_deg / 40.0);
    let x = |z: Angle| (1.0 - 0.96 * z.sin().powi(2)).powf(-0.5);
    let through = 10f64.powf(-0.4 * K * x(moon_z)) * (1.0 - 10f64.powf(-0.4 * K * x(z)));
    f * i * through * NANOLAMBERT_CD_M2
}

#[test]
fn moonlit_skies_are_those_of_krisciunas_and_schaefer() {
    let catalogs = Catalogs::locate(None).unwrap();
    let mut kept = unkept();
    let (mut worst, mut seen) = (0.0f64, 0);
    // A nearly full Moon and one at quarter, at two heights each.
    for at in ["2026-07-30T03:00Z", "2026-07-30T06:00Z", "2026-08-20T23:59Z", "2026-07-21T23:30Z"] {
        let night = night(PARANAL, at);
        let moon = &night.sky.moon.state;
        let sun = night.sky.sun.dir.altitude().deg();
        let (phase, altitude) = (moon.phase_angle.deg(), moon.dir.altitude().deg());
        println!("{at}: Moon {altitude:.0} high, phase {phase:.0}, Sun {sun:.0}");
        let sky =
            MeasuredSky::of(&night, &with_flux(130.0), &Layers::default(), &catalogs, &mut kept);
        let sky = sky.unwrap();
        for apart in [30.0, 60.0, 90.0] {
            for (azimuth, altitude) in (0..36).flat_map(|k| {
                [40.0, 50.0, 60.0, 75.0, 88.0].map(|altitude| (10.0 * f64::from(k), altitude))
            }) {
                let dir = towards(azimuth, altitude);
                let horizon = night.refraction.horizon_from_apparent(dir);
                if (horizon.separation(moon.dir).deg() - apart).abs() > 1.0 {
                    continue;
                }
                let seen_there = sky.at(dir, &mut kept).unwrap();
                let of = |wanted: fn(&Source) -> bool| -> f64 {
                    let parts = seen_there.sources.iter().filter(|(source, _)| wanted(source));
                    parts.map(|(_, light)| light.xyzv().y).sum()
                };
                let ours = of(|source| matches!(source, Source::Moon));
                let dark = of(|source| matches!(source, Source::Dark(_)));
                let zenith = |altitude: f64| deg(90.0 - altitude);
                let theirs = krisciunas_schaefer(
                    phase,
                    horizon.separation(moon.dir).deg(),
                    zenith(moon.dir.altitude().deg()),
                    zenith(altitude),
                );
                let apart_mag = -2.5 * ((ours + dark) / (theirs + dark)).log10();
                println!("  {apart} at {altitude}: {ours:.2e} {theirs:.2e} {apart_mag:+.2} mag");
                seen += 1;
                worst = worst.max(apart_mag.abs());
            }
        }
    }
    assert!(seen > 20 && worst < 0.3, "{seen} {worst}");
}

#[test]
fn starlight_and_airglow_light_the_ground() {
    // Starlight and airglow 6e-4 to 1e-3 lx (Seidelmann).
    let night = night(FLAGSTAFF, "2026-01-18T06:00Z");
    let plan = whole_sky(&night, None, &mut unkept());
    let ground = plan.sky.luminance(towards(0.0, -60.0)).y;
    let illuminance = ground * std::f64::consts::PI / 0.1;
    println!("{illuminance:.2e} lx");
    assert!((4e-4..1.5e-3).contains(&illuminance), "{illuminance}");
}

#[test]
fn town_glow_is_what_is_asked_for() {
    let night = night(FLAGSTAFF, "2026-01-18T06:00Z");
    let mut kept = unkept();
    let glow = NightGlow { zenith_mag_per_arcsec2: Some(18.5), ..with_flux(70.0) };
    let sky = &moonless(&night, &glow, &mut kept, &[towards(0.0, 90.0)])[0];
    let town = s10(sky, &[Component::Town]) * S10_CD_M2;
    let expected = luminance_cd_m2(18.5) - luminance_cd_m2(22.0);
    assert!((town / expected - 1.0).abs() < 0.02, "{town} {expected}");
    // Lamps are redder than the night, and stars drown.
    let dark = &moonless(&night, &with_flux(70.0), &mut kept, &[towards(0.0, 90.0)])[0];
    let ratio = |sky: &SkyBrightness| sky.luminance().v / sky.luminance().y;
    println!(
        "S/P {:.2}, {:.2} without; {:.2} mag",
        ratio(sky),
        ratio(dark),
        sky.limiting_magnitude().0
    );
    assert!(ratio(sky) < ratio(dark) - 0.2);
    assert!(sky.limiting_magnitude().0 < dark.limiting_magnitude().0 - 0.8);
}
