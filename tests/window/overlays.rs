//! Lines and words over the sky: that they lie where they should, and never on each other.

use eframe::egui::{pos2, vec2};
use egui_kittest::Harness;
use nocturne::app::App;
use nocturne::app::clock::Clock;
use nocturne::app::model::{Model, Overlays};
use nocturne::app::overlays::axes::Axes;
use nocturne::app::overlays::curve::{Curve, Picture};
use nocturne::app::overlays::ink::{Ink, Pen};
use nocturne::camera::{Camera, Projection};
use nocturne::ephemeris::Body;
use nocturne::frame::{Apparent, Dir, Horizon};
use nocturne::sky::Target;
use nocturne::time;
use nocturne::units::Angle;

use crate::{settle, window};

const NOTHING: Overlays = Overlays {
    constellation_lines: false,
    constellation_boundaries: false,
    constellation_names: false,
    star_names: false,
    planet_names: false,
    deep_sky: false,
    moon_features: false,
    azimuthal_grid: false,
    equatorial_grid: false,
    j2000_grid: false,
    ecliptic_grid: false,
    galactic_grid: false,
    ecliptic: false,
    celestial_equator: false,
    meridian: false,
    horizon: false,
    cardinal_points: false,
    planet_trails: false,
};

const EVERYTHING: Overlays = Overlays {
    constellation_lines: true,
    constellation_boundaries: true,
    constellation_names: true,
    star_names: true,
    planet_names: true,
    deep_sky: true,
    moon_features: true,
    azimuthal_grid: true,
    equatorial_grid: true,
    j2000_grid: true,
    ecliptic_grid: true,
    galactic_grid: true,
    ecliptic: true,
    celestial_equator: true,
    meridian: true,
    horizon: true,
    cardinal_points: true,
    planet_trails: true,
};

/// A window on an evening in Greenwich.
fn evening(overlays: Overlays, utc: &str) -> Model {
    let instant = time::to_instant(&time::parse(utc).unwrap(), None).unwrap();
    Model { clock: Clock::at(instant), overlays, ..Model::default() }
}

fn look(model: &mut Model, azimuth_deg: f64, altitude_deg: f64, field_deg: f64) {
    let dir =
        Dir::from_azimuth_altitude(Angle::from_deg(azimuth_deg), Angle::from_deg(altitude_deg));
    let latitude = model.latitude();
    model.view.look(dir, latitude);
    model.view.set_field(field_deg);
}

fn texts(harness: &Harness<App>) -> Vec<String> {
    harness.state().overlays().labels().map(|(label, _)| label.text.clone()).collect()
}

#[test]
fn with_everything_off_nothing_is_drawn() {
    let harness = window(evening(NOTHING, "2026-08-13T22:30Z"));
    assert_eq!(harness.state().overlays().corners(), 0);
    assert_eq!(texts(&harness), Vec::<String>::new());
}

#[test]
fn a_still_sky_lays_nothing_anew_and_a_switch_does() {
    let mut harness = window(evening(Overlays::default(), "2026-08-13T22:30Z"));
    let before = harness.state().overlays().count();
    assert!(before > 0);
    harness.run_steps(10);
    assert_eq!(harness.state().overlays().count(), before);
    harness.state_mut().model_mut().overlays.ecliptic = true;
    harness.run_steps(3);
    assert_eq!(harness.state().overlays().count(), before + 1);
    assert!(texts(&harness).iter().any(|text| text == "Ecliptic"));
}

#[test]
fn labels_never_pile() {
    let mut harness = window(evening(EVERYTHING, "2026-08-13T22:30Z"));
    let mut most = 0;
    for (number, field_deg) in
        [235.0, 150.0, 100.0, 60.0, 60.0, 30.0, 12.0, 5.0, 1.0, 0.2, 0.03].into_iter().enumerate()
    {
        let model = harness.state_mut().model_mut();
        let projection =
            [Projection::Stereographic, Projection::Equidistant, Projection::EqualArea];
        model.view.set_projection(projection[number % 3]);
        model.layers.ground = number % 2 == 0;
        look(model, 70.0 * number as f64, 15.0 + 20.0 * (number % 4) as f64, field_deg);
        settle(&mut harness);
        let labels: Vec<_> = harness.state().overlays().labels().collect();
        most = most.max(labels.len());
        assert!(labels.len() <= 250, "{field_deg}: {}", labels.len());
        for (index, (label, rect)) in labels.iter().enumerate() {
            for (other, taken) in &labels[..index] {
                let (one, other) = (&label.text, &other.text);
                assert!(!taken.intersects(*rect), "{one} over {other} at {field_deg} degrees");
            }
        }
    }
    assert!(most > 60, "{most}");
}

#[test]
fn names_stand_by_their_stars() {
    let mut model = evening(Overlays::default(), "2026-08-13T22:30Z");
    look(&mut model, 0.0, 50.0, 40.0);
    let mut harness = window(model);
    let frame_of = |harness: &Harness<App>, hr: u16| {
        let shown = harness.state().shown().unwrap();
        let number = shown.night.stars.iter().position(|star| star.hr == hr).unwrap();
        shown.setting.camera.pixel_from_apparent(shown.night.star(number).apparent).unwrap()
    };
    let near = |harness: &Harness<App>, text: &str, [x, y]: [f64; 2]| {
        let overlays = harness.state().overlays();
        let (label, rect) = overlays.labels().find(|(label, _)| label.text == text).expect(text);
        let off = label.at.distance(pos2(x as f32, y as f32));
        assert!(off < 1.0, "{text} is meant {off} points away");
        let off = rect.distance_to_pos(pos2(x as f32, y as f32));
        assert!((2.0..16.0).contains(&off), "{text} stands {off} points away");
    };
    // The sky begins at the corner of the window, and a point is a pixel.
    near(&harness, "Polaris", frame_of(&harness, 424));
    near(&harness, "Kochab", frame_of(&harness, 5563));
    // What is selected is named, however faint the others are.
    let before = harness.state().overlays().count();
    harness.state_mut().model_mut().selected = Some(Target::Star { hr: 424 });
    harness.run_steps(2);
    assert_eq!(harness.state().overlays().count(), before + 1);
    near(&harness, "Polaris", frame_of(&harness, 424));
}

#[test]
fn the_ground_hides_what_is_below_it() {
    let mut model = evening(Overlays { equatorial_grid: true, ..NOTHING }, "2026-08-13T22:30Z");
    look(&mut model, 180.0, -60.0, 50.0);
    let mut harness = window(model);
    assert_eq!(harness.state().overlays().corners(), 0);
    harness.state_mut().model_mut().layers.ground = false;
    settle(&mut harness);
    assert!(harness.state().overlays().corners() > 0);
}

#[test]
fn trails_come_by_themselves_and_have_dates() {
    let mut model = evening(Overlays { planet_trails: true, ..NOTHING }, "2026-08-13T22:30Z");
    model.selected = Some(Target::Body(Body::Saturn));
    model.layers.ground = false;
    let mut harness = window(model);
    let towards = harness.state().shown().unwrap().night.body(Body::Saturn).unwrap().apparent;
    let model = harness.state_mut().model_mut();
    let latitude = model.latitude();
    model.view.look(towards, latitude);
    model.view.set_field(15.0);
    settle(&mut harness);
    harness.state().overlays().wait();
    harness.run_steps(3);
    let overlays = harness.state().overlays();
    assert!(overlays.corners() > 0);
    let dates = overlays.labels().filter(|(label, _)| label.text.ends_with("Aug")).count();
    assert!(dates >= 2, "{:?}", texts(&harness));
}

#[test]
fn axes_go_through_the_sun_and_the_milky_way() {
    let harness = window(evening(NOTHING, "2026-08-13T16:30Z"));
    let night = &harness.state().shown().unwrap().night;
    let sun = night.body(Body::Sun).unwrap();
    // The Sun keeps to the ecliptic of date within 1.2"; seen from a place, within 10".
    let (longitude, latitude) = Axes::ecliptic(night).of(sun.apparent);
    assert!(latitude.to_degrees().abs() * 3600.0 < 10.0, "{latitude}");
    assert!((longitude.to_degrees() - 140.6).rem_euclid(360.0) < 0.5, "{}", longitude.to_degrees());
    // Sagittarius A*, Reid & Brunthaler 2004: 17h45m40.04s, -29 deg 00' 28.1".
    let centre = Dir::from_spherical(Angle::from_deg(266.416_83), Angle::from_deg(-29.007_81));
    let dir: Dir<Horizon> = night.sky.horizon_from_icrs * centre;
    let seen = night.refraction.apparent_from_horizon(dir);
    let (longitude, latitude) = Axes::galactic(night).of(seen);
    assert!(longitude.abs().to_degrees() < 0.07 && latitude.abs().to_degrees() < 0.06);
    // Numbers and directions are inverse in all axes.
    let catalogue = Axes::j2000(night);
    for axes in [&Axes::equator(night), &Axes::ecliptic(night), &Axes::galactic(night), &catalogue]
    {
        for azimuth_deg in [10.0, 130.0, 290.0] {
            let dir: Dir<Apparent> =
                Dir::from_azimuth_altitude(Angle::from_deg(azimuth_deg), Angle::from_deg(25.0));
            let (longitude, latitude) = axes.of(dir);
            let off = axes.at(longitude, latitude).separation(dir).arcsec();
            assert!(off < 0.02, "{off}");
        }
    }
    // A star of the catalogue has its numbers, but for its own motion: Polaris moves 46 mas a year.
    let number = night.stars.iter().position(|star| star.hr == 5563).unwrap();
    let (longitude, latitude) = catalogue.of(night.star(number).apparent);
    let place = Dir::from_spherical(Angle::from_rad(longitude), Angle::from_rad(latitude));
    let off = night.stars[number].dir_j2000.separation(place).arcsec();
    assert!(off < 2.0, "{off}");
}

#[test]
fn pens_dash_around_corners_and_turn_red() {
    let pen = Pen::new([86, 180, 233], 0.5, 1.0, &[6.0, 4.0]);
    let corner = [pos2(0.0, 0.0), pos2(53.0, 0.0), pos2(53.0, 47.0)];
    // 100 points: ten dashes, one of them around the corner in two pieces, each of three times two.
    let mut ink = Ink::new(1.0, false);
    ink.line(&corner, &pen);
    assert_eq!(ink.mesh.vertices.len(), 11 * 6);
    let drawn: f32 =
        ink.mesh.vertices.chunks(2).map(|side| side[0].pos.distance(side[1].pos)).sum();
    assert!((drawn / 3.0 - 60.0).abs() < 1e-2, "{drawn}");
    assert!(ink.mesh.calc_bounds().expand(-1.01).width() <= 53.0);
    let mut red = Ink::new(1.0, true);
    red.line(&corner, &pen);
    red.line(&corner, &Pen { dashes: &[], ..pen });
    red.ellipse(pos2(10.0, 10.0), vec2(8.0, 4.0), 0.3, &pen);
    assert!(red.mesh.vertices.iter().all(|v| v.color.g() == 0 && v.color.b() == 0));
    assert!(red.mesh.vertices.iter().any(|v| v.color.r() > 60));
}

/// Against points along the curve ten times as dense as any eye can tell.
#[test]
fn curves_lie_where_dense_sampling_has_them() {
    let harness = window(evening(NOTHING, "2026-08-13T22:30Z"));
    let night = &harness.state().shown().unwrap().night;
    let fields = [235.0, 120.0, 60.0, 10.0, 0.5, 0.02, 1.0 / 3600.0];
    for (number, field_deg) in fields.into_iter().enumerate() {
        for projection in Projection::ALL {
            if field_deg >= projection.widest_deg() {
                continue;
            }
            let camera = Camera {
                projection,
                field_of_view: Angle::from_deg(field_deg),
                azimuth: Angle::from_deg(40.0 + 77.0 * number as f64),
                altitude: Angle::from_deg(8.0 + 7.0 * number as f64),
                roll: Angle::from_deg(10.0),
                width_px: 1280,
                height_px: 720,
            };
            let picture = Picture::new(camera, Some(night.horizon));
            for axes in [Axes::equator(night), Axes::galactic(night), Axes::Local] {
                let (lon, lat) = axes.of(picture.axis());
                let reach = picture.reach().rad();
                let at = |along: f64| axes.at(along, lat);
                let whole = Curve { at, from: lon - 3.1, to: lon + 3.1, rate_rad: lat.cos() };
                let lines = picture.trace(&whole);
                assert!(!lines.is_empty(), "{projection:?} {field_deg}");
                let span = (reach / lat.cos().max(0.01)).min(3.09);
                for step in 0..=4000 {
                    let along = lon - span + f64::from(step) / 2000.0 * span;
                    let Some(point) = picture.pixel(at(along)) else { continue };
                    let off = lines.iter().flat_map(|line| line.windows(2));
                    let off = off.map(|pair| distance(point, pair[0], pair[1]));
                    let off = off.fold(f64::INFINITY, f64::min);
                    assert!(off < 0.5, "{projection:?} {field_deg}: {off} px off at {point:?}");
                }
                // And no line runs where no curve is: every corner is on it.
                for corner in lines.iter().flatten() {
                    let Some(view) = camera.view_from_pixel(*corner) else { continue };
                    let seen = camera.view_from_apparent().inverse() * view;
                    let (_, latitude) = axes.of(seen);
                    let off_px = (latitude - lat).abs() / camera.pixel_angle().rad();
                    assert!(off_px < 1.0, "{projection:?} {field_deg}: {off_px} px beside");
                }
                assert!(lines.iter().map(Vec::len).sum::<usize>() < 2000);
            }
        }
    }
}

fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let length = d[0] * d[0] + d[1] * d[1];
    let t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / length.max(1e-30);
    let t = t.clamp(0.0, 1.0);
    (p[0] - a[0] - t * d[0]).hypot(p[1] - a[1] - t * d[1])
}

/// Prints what lines and words cost; run it with `--ignored --nocapture`.
#[test]
#[ignore = "prints costs"]
fn costs_of_overlays() {
    let mut model = evening(EVERYTHING, "2026-08-13T22:30Z");
    look(&mut model, 150.0, 35.0, 60.0);
    let mut harness = window(model);
    harness.state().overlays().wait();
    let alone = |name: &str, overlays: Overlays, harness: &mut Harness<App>| {
        let (mut laid, mut drawn) = (f64::INFINITY, f64::INFINITY);
        for number in 0..20 {
            let model = harness.state_mut().model_mut();
            model.overlays = overlays;
            model.display.red = number % 2 == 0;
            harness.run_steps(3);
            let cost = harness.state().overlays().cost();
            (laid, drawn) = (laid.min(cost.lay_ms), drawn.min(cost.draw_ms));
        }
        let overlays = harness.state().overlays();
        let (labels, corners) = (overlays.labels().count(), overlays.corners());
        println!(
            "{name:24} lay {laid:.3} ms, draw {drawn:.3} ms, {labels} labels, {corners} corners"
        );
    };
    alone("everything", EVERYTHING, &mut harness);
    alone("nothing", NOTHING, &mut harness);
    alone("azimuthal grid", Overlays { azimuthal_grid: true, ..NOTHING }, &mut harness);
    alone("equatorial grid", Overlays { equatorial_grid: true, ..NOTHING }, &mut harness);
    alone("J2000 grid", Overlays { j2000_grid: true, ..NOTHING }, &mut harness);
    alone("ecliptic grid", Overlays { ecliptic_grid: true, ..NOTHING }, &mut harness);
    alone("galactic grid", Overlays { galactic_grid: true, ..NOTHING }, &mut harness);
    alone("figures", Overlays { constellation_lines: true, ..NOTHING }, &mut harness);
    alone("boundaries", Overlays { constellation_boundaries: true, ..NOTHING }, &mut harness);
    alone("star names", Overlays { star_names: true, ..NOTHING }, &mut harness);
    alone("Messier", Overlays { deep_sky: true, ..NOTHING }, &mut harness);
    alone("trails", Overlays { planet_trails: true, ..NOTHING }, &mut harness);
}

/// Writes pictures of lines and words alone where `OVERLAY_PICTURES` says, to be looked at.
#[test]
#[ignore = "needs a graphics adapter"]
fn pictures_of_overlays() {
    let Some(folder) = std::env::var_os("OVERLAY_PICTURES") else { return };
    let folder = std::path::PathBuf::from(folder);
    let wanted = [
        ("wide", "2026-08-13T22:30Z", 180.0, 40.0, 120.0, Overlays { ..EVERYTHING }),
        (
            "summer",
            "2026-08-13T22:30Z",
            180.0,
            35.0,
            60.0,
            Overlays {
                azimuthal_grid: false,
                ecliptic_grid: false,
                j2000_grid: false,
                galactic_grid: false,
                ..EVERYTHING
            },
        ),
        (
            "figures",
            "2026-01-13T22:30Z",
            170.0,
            35.0,
            75.0,
            Overlays {
                constellation_lines: true,
                constellation_names: true,
                planet_trails: true,
                deep_sky: true,
                ..Overlays::default()
            },
        ),
    ];
    for (name, utc, azimuth_deg, altitude_deg, field_deg, overlays) in wanted {
        let mut model = evening(overlays, utc);
        look(&mut model, azimuth_deg, altitude_deg, field_deg);
        let mut harness = window(model);
        harness.state().overlays().wait();
        harness.run_steps(4);
        let picture = harness.render().expect("a picture");
        picture.save(folder.join(format!("{name}.png"))).expect("a file");
    }
    // The Moon, and Jupiter with its moons, from near.
    for (name, body, field_deg) in [("moon", Body::Moon, 0.8), ("jupiter", Body::Jupiter, 0.3)] {
        let mut model = evening(EVERYTHING, "2026-03-28T20:30Z");
        model.overlays.planet_trails = false;
        model.view.follow = Some(Target::Body(body));
        model.view.set_field(field_deg);
        let mut harness = window(model);
        settle(&mut harness);
        let picture = harness.render().expect("a picture");
        picture.save(folder.join(format!("{name}.png"))).expect("a file");
    }
}
