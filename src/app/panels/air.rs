//! The air over the place, and how its nights glow.

use eframe::egui::Ui;

use crate::air::Atmosphere;
use crate::air::aerosol::{Aerosol, AerosolProfile};
use crate::air::classic::{ClassicModel, ClassicSky, perez, turbidity};
use crate::light::earth_shadow::Danjon;
use crate::light::lamps::Lamps;
use crate::light::moon::Reflectance;
use crate::light::night_lights::NightGlow;
use crate::light::scintillation::Scintillation;
use crate::light::town_glow::ZENITH_RANGE_MAG;
use crate::scene::SceneMoon;

use super::Desk;
use super::controls::{Scale, choice, choice_of, number, optional, section, switch};

const OPTICAL_DEPTH: Scale = Scale::factors(0.005, 3.0, "").and_zero();
const SCALE_HEIGHT: Scale = Scale::even(0.5, 10.0, " km");
const ANGSTROM: Scale = Scale::even(-1.0, 4.0, "");
const OZONE: Scale = Scale::even(0.0, 1000.0, " DU");
const PERCENT: Scale = Scale::even(0.0, 100.0, " %");
const PRESSURE: Scale = Scale::even(300.0, 1100.0, " mbar").within(0.001, 1100.0);
const TEMPERATURE: Scale = Scale::even(-60.0, 50.0, " °C").within(-90.0, 60.0);
const ALBEDO: Scale = Scale::even(0.0, 1.0, "");
const LAND: Scale = Scale::even(-430.0, 9000.0, " m");
const SOLAR_FLUX: Scale = Scale::even(60.0, 400.0, " sfu");
const BORTLE: Scale = Scale::even(1.0, 9.0, "").whole();
const ZENITH: Scale = Scale::even(16.0, 22.0, " mag/arcsec²")
    .within(*ZENITH_RANGE_MAG.start(), *ZENITH_RANGE_MAG.end());
const APERTURE: Scale = Scale::factors(1.0, 10_000.0, " mm").within(0.0, 50_000.0);
const EXPOSURE: Scale = Scale::factors(0.001, 100.0, " s").within(0.0, 100_000.0);
const DANJON: Scale = Scale::even(0.0, Danjon::BRIGHTEST, "");

/// Extinction by air molecules at the sea and 550 nm, per kilometre (recalled: scale height 8.4 km, optical
/// depth 0.097).
const MOLECULES_PER_KM: f64 = 0.0116;
/// Extinction over the way on which a dark thing keeps 2 % of its contrast (Koschmieder 1924).
const LOST_CONTRAST: f64 = 3.912;

const LAMPS: [(Lamps, &str); 5] = [
    (Lamps::Mixed, "Mixed"),
    (Lamps::Led3000, "LED 3000 K"),
    (Lamps::Led4000, "LED 4000 K"),
    (Lamps::Sodium, "High-pressure sodium"),
    (Lamps::LowPressureSodium, "Low-pressure sodium"),
];
const MOON_GROUND: [(Reflectance, &str); 2] =
    [(Reflectance::Hapke, "Hapke 2012"), (Reflectance::Jensen, "Jensen et al. 2001")];

/// How the glow of towns is told.
#[derive(Debug, Clone, Copy, PartialEq)]
enum TownsBy {
    None,
    Bortle,
    Zenith,
    Gazetteer,
}

const TOWNS: [(TownsBy, &str); 4] = [
    (TownsBy::None, "None"),
    (TownsBy::Bortle, "Bortle's class"),
    (TownsBy::Zenith, "Brightness overhead"),
    (TownsBy::Gazetteer, "Towns around"),
];

/// Controls of the air.
#[derive(Default)]
pub struct AirPanel {
    /// Airs that have a name, each with a line about it; read when the panel is first shown.
    named: Vec<(&'static str, &'static str, Atmosphere)>,
    /// Why the last change was not taken.
    refusal: Option<String>,
}

impl AirPanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        if let Some(refusal) = &self.refusal {
            ui.colored_label(ui.visuals().warn_fg_color, refusal);
        }
        section(ui, "Air", |ui| self.air(ui, desk));
        section(ui, "Daylight sky", |ui| self.sky(ui, desk));
        section(ui, "Night glow", |ui| self.night(ui, desk));
        section(ui, "Twinkling", |ui| self.twinkling(ui, desk));
        section(ui, "Moon", |ui| moon(ui, &mut desk.model.moon));
    }

    fn air(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let height_m = desk.model.place.height_m;
        let mut air = desk.model.air.clone();
        self.named_airs(ui, &mut air);
        number(ui, "Haze at 550 nm", &mut air.aerosol.optical_depth_550, &OPTICAL_DEPTH);
        ui.weak(format!(
            "Visibility {:.0} km, Linke's turbidity {:.1}",
            visibility_km(&air, height_m),
            turbidity::linke(&air, height_m)
        ));
        if let AerosolProfile::Exponential { scale_height_km } = &mut air.aerosol.profile {
            number(ui, "Haze thins in", scale_height_km, &SCALE_HEIGHT);
        }
        let exponent = &mut air.aerosol.angstrom_exponent;
        optional(ui, "Angstrom's exponent", exponent, 1.3, "by the kind of haze", &ANGSTROM);
        volcanic(ui, &mut air);
        number(ui, "Ozone", &mut air.ozone.column_du, &OZONE);
        let mut humidity_percent = air.observer.relative_humidity * 100.0;
        if number(ui, "Humidity", &mut humidity_percent, &PERCENT) {
            air.observer.relative_humidity = humidity_percent / 100.0;
        }
        let usual = Atmosphere::default();
        let weather = &mut air.observer;
        let (mbar, celsius) = (usual.pressure_mbar_at(height_m), usual.temperature_c_at(height_m));
        let left_out = format!("standard, {mbar:.0} mbar");
        optional(ui, "Pressure", &mut weather.pressure_mbar, mbar, &left_out, &PRESSURE);
        let left_out = format!("usual, {celsius:.0} °C");
        optional(ui, "Temperature", &mut weather.temperature_c, celsius, &left_out, &TEMPERATURE);
        number(ui, "Ground albedo", &mut air.ground.albedo, &ALBEDO);
        let land = &mut air.ground.height_m;
        optional(ui, "Land around", land, height_m, "as high as the place", &LAND);
        switch(ui, "Air bends light", &mut air.paths.refracted);
        switch(ui, "Sun and Moon light as discs", &mut air.paths.source_disc);
        if air != desk.model.air && self.accept(air.validate_at(height_m)) {
            desk.model.air = air;
        }
    }

    fn named_airs(&mut self, ui: &mut Ui, air: &mut Atmosphere) {
        if self.named.is_empty() {
            self.named = Atmosphere::names()
                .filter_map(|name| {
                    let about = Atmosphere::file_of(name).ok()?.lines().next().unwrap_or_default();
                    let about = about.trim_start_matches(['#', ' ']);
                    Some((name, about, Atmosphere::named(name).ok()?))
                })
                .collect();
        }
        let before = self.named.iter().position(|(_, _, known)| known == air);
        let (now, about) = before.map_or(("as set", ""), |n| (self.named[n].0, self.named[n].1));
        let mut chosen = before;
        choice_of(ui, "Atmosphere", now, &mut chosen, self.named.iter().map(|(name, ..)| *name));
        if !about.is_empty() {
            ui.weak(about);
        }
        if let Some(chosen) = chosen.filter(|_| chosen != before) {
            *air = self.named[chosen].2.clone();
        }
    }

    fn sky(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let mut sky = desk.model.sky;
        let models = ClassicModel::ALL.map(|model| (Some(model), model.name()));
        let all: Vec<_> = [(None, "Solved from the air")].into_iter().chain(models).collect();
        let mut model = sky.map(|sky| sky.model);
        if choice(ui, "Sky model", &mut model, &all) {
            sky = model.map(ClassicSky::new);
        }
        if let Some(sky) = &mut sky {
            ui.weak(sky.model.fails());
            let scale = |(low, high): (f64, f64)| Scale::even(low, high, "");
            if sky.model != ClassicModel::CieOvercast {
                let turbidities = scale(sky.model.turbidities());
                optional(ui, "Turbidity", &mut sky.turbidity, 3.0, "of the haze", &turbidities);
            }
            if sky.model == ClassicModel::Perez {
                let cloudless = "cloudless";
                let (clear, bright) = (scale(perez::CLEARNESSES), scale(perez::BRIGHTNESSES));
                optional(ui, "Clearness", &mut sky.clearness, 6.0, cloudless, &clear);
                optional(ui, "Brightness", &mut sky.brightness, 0.1, cloudless, &bright);
            }
        }
        let fits = sky.as_ref().map_or(Ok(()), ClassicSky::validate);
        if sky != desk.model.sky && self.accept(fits) {
            desk.model.sky = sky;
        }
    }

    fn night(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let layers = &mut desk.model.layers;
        switch(ui, "Airglow shines", &mut layers.airglow);
        let mut night = desk.model.night;
        let by_date = desk.shown.map(|shown| {
            let by_date = NightGlow { solar_flux_sfu: None, ..night };
            by_date.solar_flux_sfu(&shown.night.sky)
        });
        let left_out = match by_date {
            Some(sfu) => format!("of the date, {sfu:.0} sfu"),
            None => "of the date".to_owned(),
        };
        let usual = by_date.unwrap_or(130.0);
        optional(ui, "Solar flux", &mut night.solar_flux_sfu, usual, &left_out, &SOLAR_FLUX);
        switch(ui, "Airglow of three lines", &mut night.paper);
        switch(ui, "Towns glow", &mut desk.model.layers.town_glow);
        towns(ui, &mut night);
        if night != desk.model.night && self.accept(night.validate()) {
            desk.model.night = night;
        }
    }

    fn twinkling(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let mut twinkling = desk.model.scintillation;
        let mut is_on = twinkling.is_some();
        if switch(ui, "Stars twinkle", &mut is_on) {
            twinkling = is_on.then(Scintillation::default);
        }
        if let Some(twinkling) = &mut twinkling {
            let mut aperture_mm = twinkling.aperture_m * 1000.0;
            if number(ui, "Opening", &mut aperture_mm, &APERTURE) {
                twinkling.aperture_m = aperture_mm / 1000.0;
            }
            number(ui, "Gathered over", &mut twinkling.exposure_s, &EXPOSURE);
        }
        let fits = twinkling.map_or(Ok(()), |twinkling| twinkling.checked().map(|_| ()));
        if twinkling != desk.model.scintillation && self.accept(fits) {
            desk.model.scintillation = twinkling;
        }
    }

    /// Whether something may be taken; if not, why is told.
    fn accept<E: std::fmt::Display>(&mut self, checked: Result<(), E>) -> bool {
        self.refusal = checked.err().map(|error| error.to_string());
        self.refusal.is_none()
    }
}

fn volcanic(ui: &mut Ui, air: &mut Atmosphere) {
    let mut depth = air.stratospheric_aerosol.as_ref().map(|layer| layer.optical_depth_550);
    if optional(ui, "Volcanic haze", &mut depth, 0.1, "none", &OPTICAL_DEPTH) {
        let known = air.stratospheric_aerosol.take();
        let layer = || Atmosphere::named("volcanic").ok()?.stratospheric_aerosol;
        air.stratospheric_aerosol = depth.and_then(|optical_depth_550| {
            Some(Aerosol { optical_depth_550, ..known.or_else(layer)? })
        });
    }
}

fn towns(ui: &mut Ui, night: &mut NightGlow) {
    let mut by = match night {
        NightGlow { bortle: Some(_), .. } => TownsBy::Bortle,
        NightGlow { zenith_mag_per_arcsec2: Some(_), .. } => TownsBy::Zenith,
        NightGlow { towns: true, .. } => TownsBy::Gazetteer,
        _ => TownsBy::None,
    };
    if choice(ui, "Light of towns", &mut by, &TOWNS) {
        night.bortle = (by == TownsBy::Bortle).then_some(4);
        night.zenith_mag_per_arcsec2 = (by == TownsBy::Zenith).then_some(21.0);
        night.towns = by == TownsBy::Gazetteer;
    }
    if let Some(class) = &mut night.bortle {
        let mut number_of = f64::from(*class);
        if number(ui, "Class", &mut number_of, &BORTLE) {
            *class = number_of as u8;
        }
    }
    if let Some(magnitude) = &mut night.zenith_mag_per_arcsec2 {
        number(ui, "Overhead", magnitude, &ZENITH);
    }
    if by != TownsBy::None {
        choice(ui, "Lamps", &mut night.lamps, &LAMPS);
    }
}

fn moon(ui: &mut Ui, moon: &mut SceneMoon) {
    choice(ui, "Ground of the Moon", &mut moon.reflectance, &MOON_GROUND);
    let mut danjon = moon.danjon.number();
    if number(ui, "Danjon's number", &mut danjon, &DANJON)
        && let Ok(danjon) = Danjon::new(danjon)
    {
        moon.danjon = danjon;
    }
}

/// How far one sees over the ground, kilometres.
fn visibility_km(air: &Atmosphere, height_m: f64) -> f64 {
    let ground_km = air.ground_km(height_m);
    let haze = &air.aerosol;
    let by_haze = haze.optical_depth_550 * haze.density_per_km(ground_km, ground_km);
    LOST_CONTRAST / (by_haze + MOLECULES_PER_KM * (-ground_km / 8.4).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn haze_shortens_the_view() {
        // Air without haze: some 340 km at the sea.
        assert!((330.0..345.0).contains(&visibility_km(&Atmosphere::molecular(), 0.0)));
        let mut air = Atmosphere::default();
        let clear = visibility_km(&air, 0.0);
        assert!((35.0..50.0).contains(&clear), "{clear}");
        air.aerosol.optical_depth_550 = 1.0;
        assert!(visibility_km(&air, 0.0) < 6.0);
    }
}
