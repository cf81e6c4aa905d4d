//! Sun and Moon at the horizon: how flat they are, how bright, in how many colours, and where the
//! horizon lies. Needs no GPU; that they are drawn so is tested in `tests/pictures.rs`.

use nocturne::air::extinction::{horizon_altitude, transmittance};
use nocturne::air::refraction::{Rays, Refraction};
use nocturne::air::{Atmosphere, SEEN_NM};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::frame::{Dir, Horizon};
use nocturne::light::night::Night;
use nocturne::light::sun::LimbDarkening;
use nocturne::plan::FramePlan;
use nocturne::plan::lay::lay;
use nocturne::plan::ledger::Ledger;
use nocturne::scene::Scene;
use nocturne::sky::SkyState;
use nocturne::units::{Angle, Xyzv};

/// An equinox on the equator: the Sun sets upright in the west, a quarter of a degree a minute.
const SUNSET: &str = r#"
nocturne_scene = 2
utc = "2026-03-20T18:09:00Z"
[place]
latitude_deg = 0.0
longitude_deg = 0.0
[camera]
azimuth_deg = 270.0
altitude_deg = 0.3
field_of_view_deg = 0.6
projection = "perspective"
width_px = 1080
height_px = 1080
[layers]
stars = false
skylight = false
[air.observer]
temperature_c = 15.0
"#;

fn sunset(utc: &str) -> Scene {
    let mut scene = Scene::parse(SUNSET).unwrap();
    scene.utc = utc.to_owned();
    scene
}

fn night(scene: &Scene) -> Night {
    let setting = scene.setting().unwrap();
    let sky =
        SkyState::at(&Ephemeris::analytic(), &setting.instant, &setting.place, setting.tolerance)
            .unwrap();
    Night::of(sky, Vec::new(), &scene.air)
}

fn laid(scene: &Scene) -> (FramePlan, Ledger, Night) {
    let night = night(scene);
    let catalogs = Catalogs::locate(None).unwrap();
    let (plan, ledger) = lay(&scene.setting().unwrap(), &scene.layers, &night, &catalogs).unwrap();
    (plan, ledger, night)
}

/// The night of the first second after an instant at which the Sun's centre stands at or below a true
/// altitude.
fn with_sun_at(altitude_deg: f64, scene: &mut Scene) -> Night {
    let setting = scene.setting().unwrap();
    let (mut early, mut late) = (0.0, 40.0 * 60.0);
    for _ in 0..14 {
        let middle = 0.5 * (early + late);
        scene.utc = setting.instant.plus_seconds(middle).unwrap().to_string();
        match night(scene).sky.sun.dir.altitude().deg() > altitude_deg {
            true => early = middle,
            false => late = middle,
        }
    }
    night(scene)
}

fn total(band: &nocturne::plan::disc::DiscBand, node: usize) -> Xyzv {
    let terms = band.limb_darkening.iter().enumerate();
    let mean: f64 = terms.map(|(power, a)| 2.0 * a / (power as f64 + 2.0)).sum();
    band.nodes[node].luminance * mean
}

#[test]
fn the_sun_on_the_horizon_of_the_sea_is_flattened_by_a_sixth() {
    let night = night(&sunset("2026-03-20T18:09:00Z"));
    // Right at the horizon 0.82 (traced through the standard atmosphere), in the zenith 1.0003.
    let at = |deg: f64| night.refraction.divergence(Angle::from_deg(deg));
    assert!((at(0.0) - 0.82).abs() < 0.012, "{}", at(0.0));
    assert!((at(90.0) - 1.0).abs() < 1e-3 && (at(89.999_999) - at(90.0)).abs() < 1e-6);
    assert!((at(5.0) - 0.97).abs() < 0.01, "{}", at(5.0));
    // The disc whose lower limb touches it, from limb to limb: it is less flat above.
    let radius = night.sky.sun.angular_radius;
    let low = night.refraction.true_from_apparent(Angle::ZERO);
    let high = night.refraction.apparent_from_true(low + radius * 2.0);
    let flat = high.rad() / (2.0 * radius.rad());
    assert!((0.835..0.865).contains(&flat), "{flat}");
    assert_eq!(Refraction::NONE.divergence(Angle::from_deg(1.0)), 1.0);
}

#[test]
fn the_light_of_a_setting_disc_is_that_of_its_visible_points() {
    for (start, body) in [("2026-03-20T17:55:00Z", Body::Sun), ("2026-03-20T17:55:00Z", Body::Sun)]
    {
        for altitude_deg in [4.0, 0.2, -0.4, -0.6, -0.75] {
            let night = with_sun_at(altitude_deg, &mut sunset(start));
            let state = *night.sky.body(body).unwrap();
            let refraction = &night.refraction;
            let irradiance = night.irradiance(&state);
            // Points spread over the disc as it is: rings, each of as many points as it has area.
            let centre = state.dir.vector();
            let side = centre.any_orthonormal_vector();
            let across = centre.cross(side);
            const RINGS: usize = 40;
            let mut sum = Xyzv::BLACK;
            for ring in 0..RINGS {
                let radius = (ring as f64 + 0.5) / RINGS as f64;
                let cos_emission = (1.0 - radius * radius).sqrt();
                let points = 6 * ring + 3;
                for point in 0..points {
                    let turn = (point as f64 + 0.5) / points as f64 * std::f64::consts::TAU;
                    let off = (side * turn.cos() + across * turn.sin())
                        * (radius * state.angular_radius.sin());
                    let dir: Dir<Horizon> = Dir::from_vector(centre + off);
                    let apparent = refraction.apparent_from_horizon(dir).altitude();
                    if apparent < night.horizon {
                        continue;
                    }
                    let through = transmittance(&night.air, 0.0, apparent);
                    let light = (irradiance * through).weighted(|nm| {
                        let law = LimbDarkening::at_nm(nm);
                        law.relative_to_centre(cos_emission) / law.disc_mean()
                    });
                    sum += light.xyzv()
                        * (refraction.divergence(apparent) / (3 * RINGS * RINGS) as f64);
                }
            }
            let got = night.body(body).unwrap().ground;
            assert!(sum.y > 0.0, "{altitude_deg}°: nothing is left");
            for (got, sum) in [(got.x, sum.x), (got.y, sum.y), (got.z, sum.z), (got.v, sum.v)] {
                // The rings tell half a per cent of a sliver.
                let within = if altitude_deg < -0.7 { 0.03 } else { 0.004 };
                assert!((got / sum - 1.0).abs() < within, "{altitude_deg}°: {got} {sum}");
            }
        }
    }
}

#[test]
fn the_last_light_goes_with_the_upper_limb() {
    let mut scene = sunset("2026-03-20T17:55:00Z");
    let first = night(&scene);
    let sets = first.refraction.true_from_apparent(first.horizon) - first.sky.sun.angular_radius;
    let before = with_sun_at(sets.deg() + 0.01, &mut scene);
    scene.utc = "2026-03-20T17:55:00Z".to_owned();
    let after = with_sun_at(sets.deg() - 0.01, &mut scene);
    let light = |night: &Night| night.body(Body::Sun).unwrap().ground.y;
    assert!(light(&before) > 0.0 && light(&before) < 1.0, "{} lx", light(&before));
    assert_eq!(light(&after), 0.0);
    // As a point it goes at once, with its centre.
    let mut air = scene.air.clone();
    air.paths.source_disc = false;
    assert_eq!(
        Night::of(before.sky.clone(), Vec::new(), &air).body(Body::Sun).unwrap().ground.y,
        0.0
    );
}

#[test]
fn bands_of_colour_share_the_light_out() {
    let mut scene = sunset("2026-03-20T17:55:00Z");
    with_sun_at(-0.25, &mut scene);
    let (plan, ledger, night) = laid(&scene);
    let disc = &plan.discs[0];
    assert!(disc.bands.len() >= 8, "{} bands", disc.bands.len());
    let told = format!("Sun: {} bands", disc.bands.len());
    assert_eq!(ledger.of("Sun").unwrap().how, [told]);
    let irradiance = night.irradiance(&night.sky.sun);
    for node in [0, 5, disc.bands[0].nodes.len() - 1] {
        let altitude = disc.lowest.altitude() + disc.step * node as f64;
        let whole = (irradiance * transmittance(&night.air, 0.0, altitude)).xyzv()
            * (1.0 / disc.shape.solid_angle_sr());
        let sum = disc.bands.iter().fold(Xyzv::BLACK, |sum, band| sum + total(band, node));
        for (sum, whole) in [(sum.x, whole.x), (sum.y, whole.y), (sum.z, whole.z), (sum.v, whole.v)]
        {
            assert!((sum / whole - 1.0).abs() < 1e-9, "node {node}: {sum} {whole}");
        }
    }
    // Blue stands higher than red: what is seen at one altitude stands truly lower in blue.
    let (red, blue) = (&disc.bands[0].nodes[9], &disc.bands.last().unwrap().nodes[9]);
    let apart = (red.above_centre - blue.above_centre).arcsec();
    assert!((20.0..60.0).contains(&apart), "{apart}\"");
}

#[test]
fn colours_cost_nothing_where_they_do_not_show() {
    // A wide field, and a narrow one of the Sun high up.
    let mut low = sunset("2026-03-20T17:55:00Z");
    with_sun_at(-0.25, &mut low);
    low.camera.field_of_view_deg = 60.0;
    let mut high = sunset("2026-03-20T15:00:00Z");
    let sun = night(&high).sky.sun.dir;
    (high.camera.azimuth_deg, high.camera.altitude_deg) =
        (sun.azimuth().deg(), sun.altitude().deg());
    high.camera.field_of_view_deg = 3.0;
    for scene in [low, high] {
        let (plan, ledger, _) = laid(&scene);
        assert_eq!(plan.discs[0].bands.len(), 1);
        assert_eq!(ledger.of("Sun").unwrap().how, ["Sun: 1 band"]);
    }
}

#[test]
fn the_horizon_is_that_of_the_ground_around() {
    let mut scene = sunset("2026-03-20T18:12:00Z");
    scene.place.height_m = 3000.0;
    scene.camera.field_of_view_deg = 5.0;
    // Of an eye 2 m above the plateau.
    assert!((night(&scene).horizon.arcmin() + 2.5).abs() < 0.1);
    let level = laid(&scene).1;
    scene.air.ground.height_m = Some(0.0);
    let high = night(&scene);
    // 1.76' times the root of the height; this air bends light less there.
    let dip = high.horizon.arcmin();
    assert!((-103.0..-93.0).contains(&dip), "{dip}'");
    assert_eq!(high.horizon, horizon_altitude(&scene.air, 3000.0));
    let Refraction::Traced(traced) = &high.refraction else { panic!("not traced") };
    assert_eq!(traced.horizon(), high.horizon);
    let observer = scene.air.observer_air(3000.0, SEEN_NM);
    assert_eq!(Rays::over_ground(&observer, 0.0).unwrap().horizon(), high.horizon);
    // The Sun, gone from the plateau, shines on the summit by the sea.
    assert_eq!(level.of("Sun").unwrap().drawn, 0);
    assert_eq!(laid(&scene).1.of("Sun").unwrap().drawn, 1);
    assert!(high.body(Body::Sun).unwrap().ground.y > 0.0);
}

#[test]
fn straight_paths_leave_things_where_they_stand() {
    let mut scene = sunset("2026-03-20T17:55:00Z");
    scene.air = scene.air.straight();
    let night = night(&scene);
    let sun = night.body(Body::Sun).unwrap();
    assert!((sun.apparent.altitude() - sun.dir.altitude()).arcsec().abs() < 1e-6);
}

#[test]
fn air_far_denser_than_any_is_refused() {
    let mut scene = sunset("2026-03-20T17:55:00Z");
    scene.place.height_m = 9000.0;
    scene.air.observer.pressure_mbar = Some(1100.0);
    let message = scene.setting().unwrap_err().to_string();
    assert!(message.contains("3 times the 308.0"), "{message}");
    scene.air = Atmosphere::default();
    assert!(scene.setting().is_ok());
}
