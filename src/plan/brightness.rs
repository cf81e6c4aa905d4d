//! The sky as a measurement: how bright it is in a direction, and what makes it so.
//!
//! The same lights as in a picture, each with its whole spectrum: sunlight and moonlight that the air
//! scatters ([`super::skylight`]), and the dark sky ([`crate::light::dark_sky`]). What is drawn one by
//! one is not in it: the discs of Sun, Moon and planets, and the stars of the catalogue. An instrument
//! with a wide field sees those stars too: [`SkyBrightness::meter`]. In totality sunlight has the luminance
//! of a picture and the colour of the Sun.

use rayon::prelude::*;

use crate::air::scattering::SKY_NODES_NM;
use crate::ephemeris::Body;
use crate::eye::limiting_magnitude;
use crate::frame::{Apparent, Dir};
use crate::light::dark_sky::{Component, DarkSky, at_nodes};
use crate::light::night::Night;
use crate::light::night_lights::NightGlow;
use crate::light::photometry::{self, Band};
use crate::light::spectrum::Spectrum;
use crate::scene::Layers;
use crate::sky::BodyState;
use crate::units::{Angle, Magnitude, Xyzv};

use super::dark_sky;
use super::data::SkyData;
use super::lay::Kept;
use super::ledger::Ledger;
use super::skylight::{self, Shines};
use super::{PlanError, SkyPlan};

/// What lights the sky.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    Sun,
    Moon,
    Dark(Component),
}

impl Source {
    /// As it is written for programs.
    pub fn name(self) -> &'static str {
        match self {
            Source::Sun => "sun",
            Source::Moon => "moon",
            Source::Dark(component) => component.name(),
        }
    }
}

/// How bright the sky is in one direction.
#[derive(Debug, Clone)]
pub struct SkyBrightness {
    /// Spectral radiance by what it is from, W m-2 sr-1 nm-1; all sources, dark or not.
    pub sources: Vec<(Source, Spectrum)>,
    /// Spectral radiance of the wide field of a Sky Quality Meter with lens that points there, stars of
    /// the catalogue included.
    pub meter: Spectrum,
}

impl SkyBrightness {
    /// Spectral radiance of all together, W m-2 sr-1 nm-1.
    pub fn radiance(&self) -> Spectrum {
        self.sources.iter().map(|(_, light)| *light).sum()
    }

    /// Luminance, cd/m2.
    pub fn luminance(&self) -> Xyzv {
        self.radiance().xyzv()
    }

    /// Surface brightness in a band, magnitudes per square arcsecond; none without light.
    pub fn mag_per_arcsec2(&self, band: Band) -> Option<f64> {
        Some(photometry::mag_per_arcsec2(&self.radiance(), band)).filter(|mag| mag.is_finite())
    }

    /// What a Sky Quality Meter with lens reads, magnitudes per square arcsecond; none without light.
    pub fn sqm_mag_per_arcsec2(&self) -> Option<f64> {
        Some(photometry::sqm_mag_per_arcsec2(&self.meter)).filter(|mag| mag.is_finite())
    }

    /// The faintest star that a usual observer sees there, as bright as it arrives.
    pub fn limiting_magnitude(&self) -> Magnitude {
        let luminance = self.luminance().y;
        let factor = limiting_magnitude::TYPICAL_FIELD_FACTOR;
        Magnitude(limiting_magnitude::limiting_magnitude(luminance, factor))
    }
}

/// A sky that can be measured.
pub struct MeasuredSky<'n> {
    night: &'n Night,
    lit: Vec<(Source, &'n BodyState, Spectrum)>,
    /// What the Sun lights from outside the shadow of the Moon.
    totality: Option<SkyPlan>,
    dark: Option<DarkSky>,
    /// The same with all stars of the catalogue as an even glow.
    with_stars: Option<DarkSky>,
}

impl<'n> MeasuredSky<'n> {
    /// The sky of a night. What is not wanted in the layers does not shine.
    pub fn of(
        night: &'n Night,
        glow: &NightGlow,
        layers: &Layers,
        data: &dyn SkyData,
        kept: &mut Kept,
    ) -> Result<MeasuredSky<'n>, PlanError> {
        let mut lit = Vec::new();
        for (source, shines, state) in [
            (Source::Sun, skylight::sun_shines(night), &night.sky.sun),
            (Source::Moon, skylight::moon_shines(night), &night.sky.moon.state),
        ] {
            if shines == Shines::Yes && layers.skylight {
                lit.push((source, state, night.irradiance(state)));
            }
        }
        if !lit.is_empty() {
            kept.air.of(&night.air, night.sky.place.height_m)?;
        }
        let is_shadowed = layers.skylight && skylight::in_shadow_of_moon(night).is_some();
        let totality = match is_shadowed {
            true => Some(skylight::sky_plan(night, true, false, &mut kept.air)?.0),
            false => None,
        };
        let mut ledger = Ledger::default();
        let lights = dark_sky::lights(glow, layers, night, data, &mut kept.dark_sky, &mut ledger)?;
        let dark = match lights.are_out() {
            true => None,
            false => Some(DarkSky::new(&kept.dark_sky.air(night)?, lights)),
        };
        let with_stars = dark.as_ref().map(|dark| dark.with_undrawn(dark.catalogue()));
        Ok(MeasuredSky { night, lit, totality, dark, with_stars })
    }

    /// How bright it is in an apparent direction; below the horizon the ground.
    pub fn at(&self, dir: Dir<Apparent>, kept: &mut Kept) -> Result<SkyBrightness, PlanError> {
        let height_m = self.night.sky.place.height_m;
        let mut sources = vec![(Source::Sun, Spectrum::DARK), (Source::Moon, Spectrum::DARK)];
        let mut meter = Spectrum::DARK;
        if !self.lit.is_empty() {
            let (air, _) = kept.air.of(&self.night.air, height_m)?;
            let tables = air.tables();
            let eye_km = self.night.air.eye_km(height_m);
            let scattered = |state: &BodyState, irradiance: &Spectrum, dir: Dir<Apparent>| {
                if let (Body::Sun, Some(sky)) = (state.body, &self.totality) {
                    let whole = self.night.irradiance_without_eclipse(state);
                    return whole.scaled_to_photopic(sky.luminance(dir).y);
                }
                let mut nodes = [0.0; SKY_NODES_NM.len()];
                let from_source = dir.azimuth() - state.dir.azimuth();
                let cos_zenith = state.dir.altitude().sin();
                tables.radiance(eye_km, cos_zenith, dir.altitude(), from_source, &mut nodes);
                at_nodes(irradiance, &nodes)
            };
            for (source, state, irradiance) in &self.lit {
                let light = scattered(state, irradiance, dir);
                sources.iter_mut().filter(|(s, _)| s == source).for_each(|(_, sum)| *sum = light);
                meter += mean_in_meter(dir, |dir| scattered(state, irradiance, dir));
            }
        }
        if let (Some(dark), Some(with_stars)) = (&self.dark, &self.with_stars) {
            let lights = dark.radiance(dir).into_iter();
            sources.extend(lights.map(|(component, light)| (Source::Dark(component), light)));
            meter += mean_in_meter(dir, |dir| {
                with_stars.radiance(dir).into_iter().map(|(_, light)| light).sum()
            });
        } else {
            let dark = Component::ALL.map(|component| (Source::Dark(component), Spectrum::DARK));
            sources.extend(dark);
        }
        Ok(SkyBrightness { sources, meter })
    }
}

/// The mean over the field of a Sky Quality Meter with lens; what lies below the horizon counts too.
fn mean_in_meter(
    axis: Dir<Apparent>,
    light: impl Fn(Dir<Apparent>) -> Spectrum + Sync,
) -> Spectrum {
    /// Rings of the field and directions in the first of them; the next have twice, three times as many.
    const RINGS: usize = 6;
    const IN_FIRST: usize = 6;
    const WIDEST: Angle = Angle::from_deg(33.0);
    let across = axis.vector().any_orthonormal_vector();
    let beside = axis.vector().cross(across);
    let ring = |ring: usize| {
        let off = WIDEST * ((ring as f64 + 0.5) / RINGS as f64);
        let count = IN_FIRST * (2 * ring + 1);
        let weight = photometry::sqm_l_weight(off) * off.sin() / count as f64;
        (0..count).map(move |k| {
            let turn = Angle::from_deg(360.0) * ((k as f64 + 0.5) / count as f64);
            let side = across * turn.cos() + beside * turn.sin();
            let dir = axis.vector() * off.cos() + side * off.sin();
            (Dir::from_vector(dir), weight)
        })
    };
    let field: Vec<(Dir<Apparent>, f64)> = (0..RINGS).flat_map(ring).collect();
    let whole: f64 = field.iter().map(|(_, weight)| weight).sum();
    let lights: Vec<Spectrum> =
        field.par_iter().map(|(dir, weight)| light(*dir) * (weight / whole)).collect();
    lights.into_iter().sum()
}
