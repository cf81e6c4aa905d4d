//! Where the description of a picture says that things stand, against an independent engine: ten
//! instants and places from 1700 to 2150, both hemispheres, a polar night and a pole, the equator
//! at equinox. See `truth/pixel_truth.py`.

use std::collections::BTreeMap;

use nocturne::air::Atmosphere;
use nocturne::camera::Projection;
use nocturne::catalog::Catalogs;
use nocturne::display::Display;
use nocturne::ephemeris::Ephemeris;
use nocturne::export::describe::{DescribedObject, Description};
use nocturne::eye::Eye;
use nocturne::frame::{Dir, Horizon};
use nocturne::light::night::Night;
use nocturne::light::night_lights::NightGlow;
use nocturne::scene::{FORMAT, Layers, Marks, Scene, SceneCamera, SceneMoon, ScenePlace};
use nocturne::sky::SkyState;
use nocturne::units::Angle;

const TRUTH: &str = include_str!("truth/pixel_truth.csv");

/// A second of error in the rotation of the Earth moves the sky by 15 arcseconds. Where the two
/// engines take UT1 from tables of different dates they differ by a few hundredths of a second: by
/// 0.2 s in the months that were still to come when the older one was made.
const CLOCK_ARCSEC: f64 = 3.0;

fn described(scene: &Scene, stars: &Catalogs) -> Description {
    let setting = scene.setting().unwrap();
    let ephemeris = Ephemeris::load(stars, setting.tolerance).unwrap();
    let sky =
        SkyState::at(&ephemeris, &setting.instant, &setting.place, setting.tolerance).unwrap();
    Description::of(&setting, &Night::of(sky, stars.stars().unwrap(), &scene.air))
}

fn scene(time: &str, place: &[f64]) -> Scene {
    Scene {
        nocturne_scene: FORMAT,
        utc: time.to_owned(),
        tolerance_arcsec: Some(1.0),
        place: ScenePlace {
            name: None,
            latitude_deg: place[0],
            longitude_deg: place[1],
            height_m: place[2],
            time_zone: None,
        },
        camera: SceneCamera {
            azimuth_deg: 0.0,
            altitude_deg: 90.0,
            roll_deg: 0.0,
            field_of_view_deg: 180.0,
            projection: Projection::Equidistant,
            width_px: 512,
            height_px: 512,
        },
        layers: Layers::default(),
        sky: None,
        scintillation: None,
        night: NightGlow::default(),
        moon: SceneMoon::default(),
        air: Atmosphere::default(),
        eye: Eye::default(),
        photo: None,
        display: Display::default(),
        marks: Marks::default(),
    }
}

fn direction(azimuth_deg: f64, altitude_deg: f64) -> Dir<Horizon> {
    Dir::from_azimuth_altitude(Angle::from_deg(azimuth_deg), Angle::from_deg(altitude_deg))
}

#[test]
fn azimuths_and_altitudes_agree_with_skyfield_within_the_stated_bounds() {
    let catalogs = Catalogs::locate(None).unwrap();
    let mut pictures: BTreeMap<String, Description> = BTreeMap::new();
    let mut worst: BTreeMap<&str, f64> = BTreeMap::new();
    let mut compared = 0;
    let lines = TRUTH.lines().filter(|line| !line.starts_with('#')).skip(1);
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let [place, time, lat, lon, height, name, azimuth, altitude] = cells[..] else {
            panic!("{line}");
        };
        let number = |text: &str| text.parse::<f64>().unwrap();
        let picture = pictures.entry(format!("{place} {time}")).or_insert_with(|| {
            described(&scene(time, &[number(lat), number(lon), number(height)]), &catalogs)
        });
        let is_it = |object: &&DescribedObject| {
            object.name == name || object.catalogue.as_deref() == Some(name)
        };
        let object = picture.objects.iter().find(is_it).unwrap_or_else(|| panic!("no {name}"));
        let off = direction(object.azimuth_deg, object.altitude_deg)
            .separation(direction(number(azimuth), number(altitude)))
            .arcsec();
        let bound = object.error_bound_arcsec + CLOCK_ARCSEC;
        assert!(off <= bound, "{place} {time} {name}: off by {off:.2}\", stated {bound:.2}\"");
        let class = if name.starts_with("HR") { "stars" } else { name };
        let most = worst.entry(class).or_default();
        *most = most.max(off);
        compared += 1;
    }
    assert_eq!((pictures.len(), compared), (10, 300));
    println!("largest differences, arcseconds: {worst:.2?}");
}
