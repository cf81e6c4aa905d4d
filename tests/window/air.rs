//! The panel of the air: what it changes, and what it refuses.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::air::Atmosphere;
use nocturne::air::classic::ClassicModel;
use nocturne::app::App;
use nocturne::app::model::{Model, Panel};
use nocturne::light::lamps::Lamps;
use nocturne::light::moon::Reflectance;

use crate::controls::{choose, enter, set, switch, with_panel};

fn opened() -> Harness<'static, App> {
    with_panel(Panel::Air, Model::default())
}

#[test]
fn airs_have_names() {
    let mut harness = opened();
    choose(&mut harness, "Atmosphere", "desert");
    assert_eq!(harness.state().model().air, Atmosphere::named("desert").unwrap());
    choose(&mut harness, "Atmosphere", "volcanic");
    assert!(harness.state().model().air.stratospheric_aerosol.is_some());
    switch(&mut harness, "Volcanic haze");
    assert!(harness.state().model().air.stratospheric_aerosol.is_none());
    switch(&mut harness, "Volcanic haze");
    set(&mut harness, "Volcanic haze", 0.25);
    let air = &harness.state().model().air;
    let layer = air.stratospheric_aerosol.as_ref().expect("a layer");
    assert!((layer.optical_depth_550 - 0.25).abs() < 1e-9);
}

#[test]
fn numbers_of_the_air_change_it() {
    let mut harness = opened();
    for (name, value) in [
        ("Haze at 550 nm", 0.4),
        ("Haze thins in", 2.0),
        ("Ozone", 420.0),
        ("Humidity", 60.0),
        ("Ground albedo", 0.7),
        ("Angstrom's exponent", 0.8),
    ] {
        set(&mut harness, name, value);
    }
    switch(&mut harness, "Pressure");
    switch(&mut harness, "Temperature");
    set(&mut harness, "Pressure", 990.0);
    set(&mut harness, "Temperature", -12.0);
    switch(&mut harness, "Air bends light");
    let air = &harness.state().model().air;
    assert!((air.aerosol.optical_depth_550 - 0.4).abs() < 1e-9);
    assert!((air.ozone.column_du - 420.0).abs() < 1e-9);
    assert!((air.observer.relative_humidity - 0.6).abs() < 1e-9);
    assert!((air.ground.albedo - 0.7).abs() < 1e-9);
    assert_eq!(air.aerosol.angstrom_exponent, Some(0.8));
    assert_eq!(air.observer.pressure_mbar, Some(990.0));
    assert_eq!(air.observer.temperature_c, Some(-12.0));
    assert!(!air.paths.refracted);
}

#[test]
fn bad_air_never_reaches_the_model() {
    let mut harness = opened();
    for (name, value) in [
        ("Ozone", f64::NAN),
        ("Ozone", -1e300),
        ("Ground albedo", f64::INFINITY),
        ("Humidity", 1e9),
    ] {
        enter(&mut harness, name, value);
        set(&mut harness, name, value);
        let model = harness.state().model();
        assert!(model.air.validate_at(model.place.height_m).is_ok(), "{name} {value}");
    }
    // Sea-level pressure on a high mountain is air that cannot be.
    let mut model = Model::default();
    model.place.height_m = 8800.0;
    let mut harness = with_panel(Panel::Air, model);
    switch(&mut harness, "Pressure");
    enter(&mut harness, "Pressure", 1090.0);
    let air = &harness.state().model().air;
    assert!(air.observer.pressure_mbar.is_some_and(|mbar| mbar < 400.0), "{:?}", air.observer);
    assert!(harness.query_by_label_contains("standard atmosphere there").is_some());
}

#[test]
fn classic_skies_are_chosen() {
    let mut harness = opened();
    choose(&mut harness, "Sky model", ClassicModel::Perez.name());
    switch(&mut harness, "Turbidity");
    set(&mut harness, "Turbidity", 5.0);
    switch(&mut harness, "Clearness");
    let sky = harness.state().model().sky.expect("a classic sky");
    assert_eq!(
        (sky.model, sky.turbidity, sky.clearness),
        (ClassicModel::Perez, Some(5.0), Some(6.0))
    );
    choose(&mut harness, "Sky model", "Solved from the air");
    assert_eq!(harness.state().model().sky, None);
}

#[test]
fn nights_glow() {
    let mut harness = opened();
    switch(&mut harness, "Solar flux");
    set(&mut harness, "Solar flux", 210.0);
    choose(&mut harness, "Light of towns", "Bortle's class");
    set(&mut harness, "Class", 7.0);
    choose(&mut harness, "Lamps", "LED 4000 K");
    let night = harness.state().model().night;
    assert_eq!((night.solar_flux_sfu, night.bortle), (Some(210.0), Some(7)));
    assert_eq!(night.lamps, Lamps::Led4000);
    choose(&mut harness, "Light of towns", "Brightness overhead");
    let night = harness.state().model().night;
    assert_eq!((night.bortle, night.zenith_mag_per_arcsec2), (None, Some(21.0)));
    choose(&mut harness, "Light of towns", "Towns around");
    assert!(harness.state().model().night.towns && night.validate().is_ok());
    for name in ["Airglow shines", "Towns glow", "Airglow of three lines"] {
        switch(&mut harness, name);
    }
    let model = harness.state().model();
    assert!(!model.layers.airglow && !model.layers.town_glow && model.night.paper);
}

#[test]
fn stars_twinkle_and_the_moon_is_dark_in_eclipse() {
    let mut harness = opened();
    switch(&mut harness, "Stars twinkle");
    set(&mut harness, "Opening", 200.0);
    let twinkling = harness.state().model().scintillation.expect("twinkling");
    assert!((twinkling.aperture_m - 0.2).abs() < 1e-9);
    switch(&mut harness, "Stars twinkle");
    assert_eq!(harness.state().model().scintillation, None);
    set(&mut harness, "Danjon's number", 0.5);
    choose(&mut harness, "Ground of the Moon", "Jensen et al. 2001");
    let moon = harness.state().model().moon;
    assert!((moon.danjon.number() - 0.5).abs() < 1e-9);
    assert_eq!(moon.reflectance, Reflectance::Jensen);
}
