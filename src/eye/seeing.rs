//! What an eye makes of a picture, as numbers and tables for the passes that draw it.

use std::sync::OnceLock;

use glam::{DMat3, DVec3};

use crate::display::{Display, within_gamut};
use crate::image::HdrFrame;
use crate::units::{Angle, Xyzv};

use super::adaptation::{Adaptation, level_cd_m2};
use super::foveal::{Foveal, View};
use super::glare::{Flare, Glare, Halo, Spread, pyramid, shares};
use super::limiting_magnitude::{luminance_for_rods, threshold_lx};
use super::receptors::{Mix, NightColour, mix, seen_luminance_cd_m2};
use super::tone_curve::{Screen, ToneCurve};
use super::white::adapted_from_seen;
use super::{Eye, Model, acuity, light_table, paper, pupil, rods};

/// Solid angle over which the eye sees the colour of a point: some three minutes of arc across, what
/// remains of a point on the retina (CIE 135/1's second bell).
const POINT_SR: f64 = 7.6e-7;
/// Light of a point on the screen that is no farther from it than this is seen as one, pixels; as much as
/// 7 by 7 pixels.
const POINT_PX: f64 = 4.0;

/// What an eye spreads no farther than this is no glare but the fineness of its image.
const NEAR: Angle = Angle::from_arcmin(8.0);

/// No point fainter than this has a flare by the widest pupil, lux: a star of magnitude 0.
const FAINTEST_FLARE_LX: f64 = 2.5e-6;

/// What the eye makes of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Seeing {
    /// The luminance that the eye is adapted to, cd/m2.
    pub adaptation_cd_m2: f64,
    /// Diameter of the pupil.
    pub pupil_mm: f64,
    /// The picture half a degree at a time.
    pub foveal: Foveal,
    /// Share of the light that each level of the pyramid spreads, finest first; empty without glare.
    pub glare_shares: Vec<f64>,
    /// Around points of light; none without glare.
    pub halo: Option<Halo>,
    /// How the eye scatters; none where it does not.
    spread: Option<Spread>,
    pixel: Angle,
    /// Over the columns of [`light_table`]: the level of the pyramid that is as fine as the eye resolves;
    /// none where that does not matter.
    pub levels_resolved: Option<Vec<f32>>,
    /// Over light, in shares of the screen's peak: the luminance that cones give, and the X, Y and Z that
    /// rods give of a scotopic luminance as large as the photopic one.
    pub shown: Vec<[f32; 4]>,
    /// Over the light around: what is shown of a point, in shares of the screen's white times square
    /// pixels for a lux; the faintest point that is seen, lux.
    pub visible: Vec<[f32; 4]>,
    /// Linear RGB of the screen of X, Y and Z as they are seen, the white of the scene for white.
    pub rgb_from_seen: DMat3,
    /// What makes the colour of rods the same after [`Seeing::rgb_from_seen`]: theirs is no light that one
    /// could take for white.
    seen_from_adapted: DMat3,
    magnification: f64,
    night: NightColour,
}

/// What the receptors make of a light.
struct Mixed {
    /// The luminance that cones give, and the X, Y and Z that rods give of a scotopic luminance as
    /// large as the photopic one, cd/m2: so that all change little from row to row.
    parts: [f64; 4],
    /// What the tone curve maps, cd/m2.
    seen: f64,
    /// The faintest point that is seen against it with a field factor of 1, lux.
    faintest_lx: f64,
}

/// A point of light as it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenPoint {
    /// Linear shares of the screen's white, with a luminance of one.
    pub colour: [f64; 3],
    /// At the eye, lux.
    pub illuminance_lx: f64,
    /// How much more light it has than to the naked eye, for what the picture magnifies.
    pub gathered: f64,
}

impl Eye {
    /// Whether stars are seen as light of the frame like everything else.
    pub fn sees_stars_in_frame(&self) -> bool {
        self.model == Model::Paper
    }

    /// What it makes of a picture, given the light of its foveal level as the steps down leave it.
    pub fn seeing(&self, gathered: &HdrFrame, view: &View, display: &Display) -> Seeing {
        let level = view.foveal_level();
        let seen = |[_, photopic, _, scotopic]: [f64; 4]| match self.model {
            Model::Standard => seen_luminance_cd_m2(self.night_colour, photopic, scotopic),
            Model::Paper => photopic,
        };
        let samples = |foveal: &Foveal| -> Vec<(f64, f64)> {
            foveal.cells.iter().map(|cell| (seen(cell.light), 1.0)).collect()
        };
        // The pupil is as wide as what is there makes it; what it scatters is part of what is seen.
        let unveiled = Foveal::of(gathered, view, level, &[]);
        let settled = |foveal: &Foveal| self.settled_cd_m2(&samples(foveal));
        let pupil_mm = pupil::open_sky_mm(settled(&unveiled), self.optics.age_years);
        let glare = match self.model {
            Model::Standard => self.glare,
            Model::Paper => Glare::Spencer,
        };
        let spread = glare.spread(&self.optics, pupil_mm);
        let [width_px, height_px] = view.size_px;
        let mut glare_shares = spread
            .as_ref()
            .map_or(Vec::new(), |spread| shares(spread, view.pixel, width_px, height_px));
        stay_if_near(&mut glare_shares, view.pixel);
        let halo = spread
            .as_ref()
            .map(|spread| Halo::new(spread, &glare_shares, view.pixel, width_px, height_px));
        let foveal = match glare_shares.is_empty() {
            true => unveiled,
            false => Foveal::of(gathered, view, level, &glare_shares),
        };
        let adaptation = self.adaptation(settled(&foveal));
        let adaptation_cd_m2 = adaptation.level_cd_m2();
        let screen = Screen::with_peak(display.peak_cd_m2);
        let curve = match self.model {
            Model::Standard => ToneCurve::of(&samples(&foveal), adaptation_cd_m2, screen),
            Model::Paper => paper::curve(&samples(&foveal), screen),
        };
        let adapted_from_seen = match self.model {
            Model::Standard if self.chromatic_adaptation => {
                let light = foveal.cells.iter().map(|cell| cell.light);
                adapted_from_seen(light.map(|[x, y, z, _]| [x, y, z]))
            }
            _ => DMat3::IDENTITY,
        };
        // What is scattered farther is no part of the point for who looks at the screen.
        let in_place = halo.as_ref().map_or(1.0, |halo| halo.within_px(POINT_PX));
        let threshold_factor = adaptation.threshold_factor();
        let visible = self.visible(&curve, display, threshold_factor, in_place);
        let seen_from_adapted = adapted_from_seen.inverse();
        Seeing {
            seen_from_adapted,
            rgb_from_seen: display.rgb_from_xyz() * adapted_from_seen,
            adaptation_cd_m2,
            pupil_mm,
            foveal,
            glare_shares,
            halo,
            spread,
            pixel: view.pixel,
            levels_resolved: self.acuity.then(|| levels_resolved(view)),
            shown: self.shown(&curve, seen_from_adapted),
            visible,
            magnification: view.magnification,
            night: self.night_colour,
        }
    }

    /// What it is adapted to when it has long looked at this.
    fn settled_cd_m2(&self, samples: &[(f64, f64)]) -> f64 {
        self.adaptation_cd_m2.unwrap_or_else(|| level_cd_m2(samples))
    }

    fn adaptation(&self, to_cd_m2: f64) -> Adaptation {
        match self.coming_from_cd_m2 {
            Some(from) => Adaptation::settled(from).after(self.since_s, to_cd_m2),
            None => Adaptation::settled(to_cd_m2),
        }
    }

    fn shown(&self, curve: &ToneCurve, seen_from_adapted: DMat3) -> Vec<[f32; 4]> {
        let brighter = self.exposure_stops.exp2();
        let mixed = self.mixed().iter();
        mixed
            .map(|Mixed { parts, seen, .. }| {
                let gain = if *seen > 0.0 { curve.shown(seen * brighter) / seen } else { 0.0 };
                let [cones, rods @ ..] = *parts;
                let [x, y, z] = (seen_from_adapted * DVec3::from_array(rods)).to_array();
                [cones, x, y, z].map(|part| (part * gain) as f32)
            })
            .collect()
    }

    /// What its receptors make of the lights of the tables, reckoned once.
    fn mixed(&self) -> &'static [Mixed] {
        static MIXED: [OnceLock<Vec<Mixed>>; 4] = [const { OnceLock::new() }; 4];
        let kind = match (self.model, self.night_colour) {
            (Model::Paper, _) => 0,
            (Model::Standard, NightColour::Jensen) => 1,
            (Model::Standard, NightColour::Intrusion) => 2,
            (Model::Standard, NightColour::Day) => 3,
        };
        MIXED[kind].get_or_init(|| {
            light_table::table(|photopic, scotopic| {
                // The paper's curve is that of the light as it comes in.
                let (mix, seen) = match self.model {
                    Model::Standard => {
                        let seen = seen_luminance_cd_m2(self.night_colour, photopic, scotopic);
                        (mix(self.night_colour, photopic, scotopic), seen)
                    }
                    Model::Paper => (published_mix(photopic), photopic),
                };
                let [x, y, z] = mix.rods.map(|rods| rods * photopic);
                let parts = [mix.cones * photopic, x, y, z];
                Mixed {
                    parts,
                    seen,
                    faintest_lx: threshold_lx(luminance_for_rods(photopic, scotopic)),
                }
            })
        })
    }

    fn visible(
        &self,
        curve: &ToneCurve,
        display: &Display,
        threshold_factor: f64,
        in_place: f64,
    ) -> Vec<[f32; 4]> {
        let screen_pixel_sr = Angle::from_arcmin(display.pixel_arcmin).rad().powi(2);
        let visible = |mixed: &Mixed| {
            let share = curve.shown(mixed.seen);
            let faintest_lx = threshold_factor * mixed.faintest_lx;
            let on_screen_lx = threshold_lx(share * display.peak_cd_m2 + display.surround_cd_m2);
            let shown = self.exposure_stops.exp2() * on_screen_lx
                / (faintest_lx * screen_pixel_sr * display.peak_cd_m2 * in_place);
            [shown, faintest_lx * self.field_factor, 0.0, 0.0].map(|value| value as f32)
        };
        self.mixed().iter().map(visible).collect()
    }
}

/// Leaves what is spread no farther than [`NEAR`] where it is: the viewer's own eye does that to the picture.
fn stay_if_near(shares: &mut [f64], pixel: Angle) {
    for (level, share) in (1..).zip(shares) {
        if pyramid::level_sigma_px(level) * pixel.rad() < NEAR.rad() {
            *share = 0.0;
        }
    }
}

/// Jensen et al. 2000 at their own level.
fn published_mix(photopic_cd_m2: f64) -> Mix {
    let cones = rods::cone_share(photopic_cd_m2);
    Mix { cones, rods: rods::GREY_XYZ.map(|part| (1.0 - cones) * rods::GAIN * part) }
}

fn levels_resolved(view: &View) -> Vec<f32> {
    (0..light_table::COLUMNS)
        .map(|column| acuity::blur_level(light_table::photopic_cd_m2(column), view.pixel) as f32)
        .collect()
}

impl Seeing {
    /// The flare around points of light; none while the pupil is narrow, or if the brightest, in lux, is
    /// too faint to have one.
    pub fn flare(&self, brightest_lx: f64) -> Option<Flare> {
        let spread = self.spread.as_ref().filter(|_| brightest_lx >= FAINTEST_FLARE_LX)?;
        Flare::new(spread, self.pixel)
    }

    /// A point of light, from its illuminance in lux.
    pub fn point(&self, illuminance: Xyzv, display: &Display) -> SeenPoint {
        // A telescope gathers as much more light as it magnifies, through the whole pupil.
        let lx = illuminance * self.magnification.powi(2);
        let [photopic, scotopic] = [lx.y, lx.v].map(|lx| lx / POINT_SR);
        let mix = mix(self.night, photopic, scotopic);
        let rods = self.seen_from_adapted * DVec3::from_array(mix.rods) * lx.v;
        let seen = DVec3::new(lx.x, lx.y, lx.z) * mix.cones + rods;
        let colour = match seen.y > 0.0 {
            // In the gamut however faint it is shown.
            true => within_gamut(self.rgb_from_seen * (seen / seen.y * 1e-3), 1e-3) * 1e3,
            false => DVec3::ZERO,
        };
        SeenPoint {
            colour: (display.shown_from_rgb() * colour).to_array(),
            illuminance_lx: lx.y,
            gathered: self.magnification.powi(2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between its nodes the table says what the receptors themselves do, but near the luminance where cones
    /// begin to see, a kink between two rows.
    #[test]
    fn receptors_are_read_as_they_are() {
        for night_colour in [NightColour::Jensen, NightColour::Intrusion, NightColour::Day] {
            let eye = Eye { night_colour, ..Eye::default() };
            let mixed: Vec<[f32; 4]> =
                eye.mixed().iter().map(|mixed| mixed.parts.map(|part| part as f32)).collect();
            for step in 0..300 {
                let y = 1e-5 * 1.083f64.powi(step);
                // From the light of a red lamp to that of a blue star.
                for (ratio, within) in
                    [(0.3, 0.06), (0.6, 0.006), (1.19, 0.002), (2.38, 0.002), (4.9, 0.007)]
                {
                    let v = y * ratio;
                    let direct = mix(night_colour, y, v);
                    let [cones, rods @ ..] = light_table::at(&mixed, y, v);
                    let read = cones + rods[1] * light_table::ratio(y, v);
                    let off = read / (direct.cones * y + direct.rods[1] * v) - 1.0;
                    assert!(off.abs() < within, "{night_colour:?} {y} {ratio}: {off}");
                }
            }
        }
    }
}
