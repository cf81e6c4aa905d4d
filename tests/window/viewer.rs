//! The panel of eye, camera and screen.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::model::{Model, Panel};
use nocturne::camera::Projection;
use nocturne::display::ColourSpace;
use nocturne::eye::glare::Glare;
use nocturne::eye::receptors::NightColour;
use nocturne::photo::Curve;
use nocturne::photo::colour::WhiteBalance;
use nocturne::photo::sensor::SensorKind;

use crate::controls::{choose, enter, press, set, switch, with_panel};

fn opened(uses_camera: bool) -> Harness<'static, App> {
    with_panel(Panel::Viewer, Model { uses_camera, ..Model::default() })
}

#[test]
fn eye_and_camera_take_turns() {
    let mut harness = opened(false);
    choose(&mut harness, "Seen by", "Camera");
    assert!(harness.state().model().uses_camera);
    choose(&mut harness, "Seen by", "Eye");
    assert!(!harness.state().model().uses_camera);
}

#[test]
fn the_eye_is_set() {
    let mut harness = opened(false);
    set(&mut harness, "Exposure", 2.0);
    choose(&mut harness, "Whose eye", "Jensen et al. 2001");
    switch(&mut harness, "Adapted to");
    switch(&mut harness, "Coming from");
    set(&mut harness, "Since", 5.0);
    choose(&mut harness, "Glare", "Spencer et al. 1995");
    choose(&mut harness, "Colour at night", "Colours of day");
    switch(&mut harness, "Loses detail in the dark");
    switch(&mut harness, "Takes the light for white");
    set(&mut harness, "Field factor", 1.4);
    set(&mut harness, "Age", 66.0);
    switch(&mut harness, "Grain of the dark");
    let eye = &harness.state().model().eye;
    assert!((eye.exposure_stops - 2.0).abs() < 1e-9);
    assert_eq!(eye.model, nocturne::eye::Model::Paper);
    assert!(eye.adaptation_cd_m2.is_some());
    assert_eq!((eye.coming_from_cd_m2, eye.since_s), (Some(100.0), 300.0));
    assert_eq!((eye.glare, eye.night_colour), (Glare::Spencer, NightColour::Day));
    assert!(!eye.acuity && !eye.chromatic_adaptation);
    assert_eq!((eye.field_factor, eye.optics.age_years, eye.grain), (1.4, 66.0, Some(0)));
}

#[test]
fn the_camera_is_set() {
    let mut harness = opened(true);
    choose(&mut harness, "Sensor", "APS-C");
    set(&mut harness, "Focal length", 50.0);
    set(&mut harness, "Aperture f/", 1.4);
    switch(&mut harness, "Shutter");
    set(&mut harness, "Shutter", 20.0);
    switch(&mut harness, "ISO");
    set(&mut harness, "ISO", 6400.0);
    set(&mut harness, "Compensation", -1.0);
    choose(&mut harness, "White balance", "Temperature");
    set(&mut harness, "White at", 3400.0);
    choose(&mut harness, "Tone curve", "Linear");
    set(&mut harness, "Seed of the noise", 7.0);
    switch(&mut harness, "Noise");
    switch(&mut harness, "Vignetting");
    set(&mut harness, "Blades for spikes", 1.0);
    let photo = harness.state().model().photo;
    assert_eq!(photo.body.sensor, SensorKind::ApsC);
    assert_eq!((photo.shutter_s, photo.iso), (Some(20.0), Some(6400.0)));
    assert_eq!((photo.lens.focal_mm, photo.lens.f_number), (50.0, 1.4));
    assert_eq!(photo.lens.widest_f_number, 1.4);
    assert_eq!(photo.white_balance, WhiteBalance::Kelvin(3400.0));
    assert_eq!((photo.curve, photo.seed, photo.compensation_stops), (Curve::Linear, 7, -1.0));
    assert!(!photo.noise && !photo.lens.vignetting);
    // One blade and two are none that could be.
    assert_eq!(photo.lens.blades, 3);
}

#[test]
fn lens_and_field_follow_each_other() {
    let mut harness = opened(true);
    set(&mut harness, "Focal length", 50.0);
    press(&mut harness, "Field from lens");
    let view = &harness.state().model().view;
    assert_eq!(view.projection, Projection::Perspective);
    // 36 mm at 50 mm.
    assert!((view.field_deg - 39.598).abs() < 1e-3, "{}", view.field_deg);
    harness.state_mut().model_mut().view.set_field(10.29);
    harness.run_steps(2);
    press(&mut harness, "Lens from field");
    let focal_mm = harness.state().model().photo.lens.focal_mm;
    assert!((focal_mm - 200.0).abs() < 0.1, "{focal_mm}");
}

#[test]
fn the_screen_is_set() {
    let mut harness = opened(false);
    set(&mut harness, "White of the screen", 250.0);
    choose(&mut harness, "Colours", "Display P3");
    switch(&mut harness, "Red light");
    switch(&mut harness, "Dithering");
    let display = harness.state().model().display;
    assert!((display.peak_cd_m2 - 250.0).abs() < 1e-9);
    assert_eq!(display.space, ColourSpace::DisplayP3);
    assert!(display.red && !display.dither);
}

#[test]
fn bad_settings_never_reach_the_model() {
    let mut harness = opened(true);
    switch(&mut harness, "ISO");
    // Below the base of the sensor.
    enter(&mut harness, "ISO", 10.0);
    assert_eq!(harness.state().model().photo.iso, Some(3200.0));
    assert!(harness.query_by_label_contains("base ISO").is_some());
    for (name, value) in [
        ("Focal length", f64::NAN),
        ("Aperture f/", 0.0),
        ("White of the screen", f64::INFINITY),
        ("White of the screen", -4.0),
    ] {
        enter(&mut harness, name, value);
        let scene = harness.state().model().scene([640, 360]);
        assert!(scene.setting().is_ok(), "{name} {value}");
    }
}
