//! Who looks: an eye or a camera; and the screen that the picture is for.

use eframe::egui::Ui;

use crate::app::action::Action;
use crate::display::{ColourSpace, Display};
use crate::eye::glare::Glare;
use crate::eye::receptors::NightColour;
use crate::eye::{Eye, Model as EyeModel};
use crate::photo::colour::{COLDEST_K, HOTTEST_K, WhiteBalance};
use crate::photo::sensor::{Body, SensorKind};
use crate::photo::{Curve, Photo};
use crate::units::Angle;

use super::Desk;
use super::controls::{Scale, button, choice, number, optional, section, switch};

// Ranges as scenes have them.
const STOPS: Scale = Scale::even(-10.0, 10.0, " stops").within(-30.0, 30.0);
const LUMINANCE: Scale = Scale::factors(1e-6, 1e6, " cd/m²").within(1e-7, 1e10);
const MINUTES: Scale = Scale::factors(0.1, 60.0, " min").and_zero().within(0.0, 1e7);
const FIELD_FACTOR: Scale = Scale::even(1.0, 5.0, "").within(1.0, 10.0);
const AGE: Scale = Scale::even(0.0, 100.0, " years").whole();
const PIGMENT: Scale = Scale::even(0.0, 1.2, "");
const SEED: Scale = Scale::even(0.0, 999.0, "").whole().within(0.0, u32::MAX as f64);
const FOCAL: Scale = Scale::factors(4.0, 2000.0, " mm").within(0.1, 100_000.0);
const APERTURE: Scale = Scale::factors(0.7, 64.0, "").within(0.5, 1000.0);
const SHUTTER: Scale = Scale::factors(0.0001, 3600.0, " s").within(1e-6, 1e6);
const ISO: Scale = Scale::factors(100.0, 409_600.0, "").within(1.0, 1e7);
const KELVIN: Scale = Scale::factors(COLDEST_K, HOTTEST_K, " K");
const BLADES: Scale = Scale::even(0.0, 18.0, "").whole().within(0.0, 32.0);
const PEAK: Scale = Scale::factors(1.0, 10_000.0, " cd/m²");
const SURROUND: Scale = Scale::factors(0.1, 1000.0, " cd/m²").and_zero().within(0.0, 10_000.0);
const PIXEL: Scale = Scale::factors(0.1, 10.0, " arcmin").within(0.01, 120.0);

/// What an eye comes from that leaves a lit room, cd/m2.
const LIT_ROOM_CD_M2: f64 = 100.0;
/// What an eye is adapted to in a dark night, cd/m2.
const DARK_SKY_CD_M2: f64 = 2e-4;

const VIEWERS: [(bool, &str); 2] = [(false, "Eye"), (true, "Camera")];
const EYES: [(EyeModel, &str); 2] =
    [(EyeModel::Standard, "Standard"), (EyeModel::Paper, "Jensen et al. 2001")];
const GLARES: [(Glare, &str); 3] =
    [(Glare::Cie, "CIE 135/1"), (Glare::Spencer, "Spencer et al. 1995"), (Glare::None, "None")];
const NIGHT_COLOURS: [(NightColour, &str); 3] = [
    (NightColour::Jensen, "Bluish grey"),
    (NightColour::Intrusion, "Rods in the pathways of cones"),
    (NightColour::Day, "Colours of day"),
];
const SENSORS: [(SensorKind, &str); 5] = [
    (SensorKind::MediumFormat, "Medium format"),
    (SensorKind::FullFrame, "Full frame"),
    (SensorKind::ApsC, "APS-C"),
    (SensorKind::MicroFourThirds, "Micro Four Thirds"),
    (SensorKind::Phone, "Phone"),
];
const CURVES: [(Curve, &str); 2] = [(Curve::Film, "Film"), (Curve::Linear, "Linear")];
const SPACES: [(ColourSpace, &str); 3] = [
    (ColourSpace::Srgb, "sRGB"),
    (ColourSpace::DisplayP3, "Display P3"),
    (ColourSpace::Linear, "Linear"),
];

/// What is recorded as white.
#[derive(Debug, Clone, Copy, PartialEq)]
enum White {
    Daylight,
    Tungsten,
    Auto,
    Kelvin,
}

const WHITES: [(White, &str); 4] = [
    (White::Daylight, "Daylight"),
    (White::Tungsten, "Tungsten"),
    (White::Auto, "Auto"),
    (White::Kelvin, "Temperature"),
];
/// Temperature that a white begins with, kelvin.
const USUAL_K: f64 = 4000.0;

/// Controls of eye, camera and screen.
#[derive(Default)]
pub struct ViewerPanel {
    /// Why the last change was not taken.
    refusal: Option<String>,
}

impl ViewerPanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        if let Some(refusal) = &self.refusal {
            ui.colored_label(ui.visuals().warn_fg_color, refusal);
        }
        let mut uses_camera = desk.model.uses_camera;
        if choice(ui, "Seen by", &mut uses_camera, &VIEWERS) {
            desk.actions.push(Action::ToggleCamera);
        }
        match desk.model.uses_camera {
            false => section(ui, "Eye", |ui| eye(ui, &mut desk.model.eye)),
            true => section(ui, "Camera", |ui| self.camera(ui, desk)),
        }
        section(ui, "Screen", |ui| self.screen(ui, desk));
    }

    fn camera(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let mut photo = desk.model.photo;
        let mut sensor = photo.body.sensor;
        if choice(ui, "Sensor", &mut sensor, &SENSORS) {
            photo.body = Body { sensor, ..Body::default() };
        }
        let lens = &mut photo.lens;
        number(ui, "Focal length", &mut lens.focal_mm, &FOCAL);
        ui.horizontal_wrapped(|ui| {
            let sensor = photo.body.sensor();
            if button(ui, "Field from lens", "The field of view that the lens has") {
                let field = lens.field_of_view(&sensor);
                desk.actions.push(Action::SetProjection(crate::camera::Projection::Perspective));
                desk.actions.push(Action::SetField(field.deg()));
            }
            let field = Angle::from_deg(desk.model.view.field_deg);
            if button(ui, "Lens from field", "The focal length that spans the field of view")
                && let Some(spanning) = lens.spanning(field, &sensor)
            {
                *lens = spanning;
            }
        });
        if number(ui, "Aperture f/", &mut lens.f_number, &APERTURE) {
            // Who asks for a wider aperture has a lens that has it.
            lens.widest_f_number = lens.widest_f_number.min(lens.f_number);
        }
        optional(ui, "Shutter", &mut photo.shutter_s, 10.0, "by the meter", &SHUTTER);
        optional(ui, "ISO", &mut photo.iso, 3200.0, "by the meter", &ISO);
        number(ui, "Compensation", &mut photo.compensation_stops, &STOPS);
        white_balance(ui, &mut photo.white_balance);
        choice(ui, "Tone curve", &mut photo.curve, &CURVES);
        switch(ui, "Noise", &mut photo.noise);
        if photo.noise {
            let mut seed = f64::from(photo.seed);
            if number(ui, "Seed of the noise", &mut seed, &SEED) {
                photo.seed = seed as u32;
            }
        }
        switch(ui, "Vignetting", &mut photo.lens.vignetting);
        blades(ui, &mut photo);
        if photo != desk.model.photo && self.accept(photo.validate()) {
            desk.model.photo = photo;
        }
    }

    fn screen(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let mut display: Display = desk.model.display;
        number(ui, "White of the screen", &mut display.peak_cd_m2, &PEAK);
        number(ui, "Light of the room", &mut display.surround_cd_m2, &SURROUND);
        number(ui, "Pixel spans", &mut display.pixel_arcmin, &PIXEL);
        choice(ui, "Colours", &mut display.space, &SPACES);
        switch(ui, "Dithering", &mut display.dither);
        switch(ui, "Red light", &mut display.red);
        if display != desk.model.display && self.accept(display.validate()) {
            desk.model.display = display;
        }
    }

    /// Whether something may be taken; if not, why is told.
    fn accept<E: std::fmt::Display>(&mut self, checked: Result<(), E>) -> bool {
        self.refusal = checked.err().map(|error| error.to_string());
        self.refusal.is_none()
    }
}

fn eye(ui: &mut Ui, eye: &mut Eye) {
    number(ui, "Exposure", &mut eye.exposure_stops, &STOPS);
    choice(ui, "Whose eye", &mut eye.model, &EYES);
    let adapted = &mut eye.adaptation_cd_m2;
    optional(ui, "Adapted to", adapted, DARK_SKY_CD_M2, "what it sees", &LUMINANCE);
    let from = &mut eye.coming_from_cd_m2;
    optional(ui, "Coming from", from, LIT_ROOM_CD_M2, "nowhere else", &LUMINANCE);
    if eye.coming_from_cd_m2.is_some() {
        let mut minutes = eye.since_s / 60.0;
        if number(ui, "Since", &mut minutes, &MINUTES) {
            eye.since_s = minutes * 60.0;
        }
    }
    choice(ui, "Glare", &mut eye.glare, &GLARES);
    choice(ui, "Colour at night", &mut eye.night_colour, &NIGHT_COLOURS);
    switch(ui, "Loses detail in the dark", &mut eye.acuity);
    switch(ui, "Takes the light for white", &mut eye.chromatic_adaptation);
    number(ui, "Field factor", &mut eye.field_factor, &FIELD_FACTOR);
    number(ui, "Age", &mut eye.optics.age_years, &AGE);
    number(ui, "Iris, dark to light", &mut eye.optics.pigment, &PIGMENT);
    let mut grain = eye.grain.map(|seed| seed as f64);
    if optional(ui, "Grain of the dark", &mut grain, 0.0, "none", &SEED) {
        eye.grain = grain.map(|seed| seed as u64);
    }
}

fn white_balance(ui: &mut Ui, balance: &mut WhiteBalance) {
    let mut white = match balance {
        WhiteBalance::Daylight => White::Daylight,
        WhiteBalance::Tungsten => White::Tungsten,
        WhiteBalance::Auto => White::Auto,
        WhiteBalance::Kelvin(_) => White::Kelvin,
    };
    if choice(ui, "White balance", &mut white, &WHITES) {
        *balance = match white {
            White::Daylight => WhiteBalance::Daylight,
            White::Tungsten => WhiteBalance::Tungsten,
            White::Auto => WhiteBalance::Auto,
            White::Kelvin => WhiteBalance::Kelvin(USUAL_K),
        };
    }
    if let WhiteBalance::Kelvin(kelvin) = balance {
        number(ui, "White at", kelvin, &KELVIN);
    }
}

/// Straight blades: none, or three and more.
fn blades(ui: &mut Ui, photo: &mut Photo) {
    let before = photo.lens.blades;
    let mut blades = f64::from(before);
    if number(ui, "Blades for spikes", &mut blades, &BLADES) {
        photo.lens.blades = match blades as u32 {
            1 | 2 if before == 0 => 3,
            1 | 2 => 0,
            many => many,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::Model;

    #[test]
    fn ends_of_the_ranges_are_scenes() {
        for end in [0, 1] {
            let at = |scale: Scale| scale.range()[end];
            let mut model = Model { uses_camera: true, ..Model::default() };
            model.eye.exposure_stops = at(STOPS);
            model.eye.adaptation_cd_m2 = Some(at(LUMINANCE));
            model.eye.coming_from_cd_m2 = Some(at(LUMINANCE));
            model.eye.since_s = at(MINUTES) * 60.0;
            model.eye.field_factor = at(FIELD_FACTOR);
            model.eye.optics.age_years = at(AGE);
            model.eye.optics.pigment = at(PIGMENT);
            model.photo.lens.focal_mm = at(FOCAL);
            model.photo.lens.f_number = at(APERTURE);
            model.photo.lens.blades = at(BLADES) as u32;
            model.photo.shutter_s = Some(at(SHUTTER));
            model.photo.compensation_stops = at(STOPS);
            model.photo.white_balance = WhiteBalance::Kelvin(at(KELVIN));
            model.display.peak_cd_m2 = at(PEAK);
            model.display.surround_cd_m2 = at(SURROUND);
            model.display.pixel_arcmin = at(PIXEL);
            if let Err(error) = model.scene([640, 360]).setting() {
                panic!("{error}");
            }
        }
    }
}
