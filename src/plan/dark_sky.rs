//! The dark sky of a frame: what of it shines, its table, and what is kept between frames.

use std::sync::Arc;

use crate::air::Atmosphere;
use crate::air::scattering::ScatteringError;
use crate::frame::galactic_from_icrs;
use crate::light::dark_sky::{DarkSky, NightAir, NightLights};
use crate::light::lamps::Lamps;
use crate::light::night::Night;
use crate::light::night_lights::{NightGlow, helioecliptic_from_horizon};
use crate::light::starlight::{StarGlow, Starlight};
use crate::light::town_glow::{GlowTables, Town, TownGlow, TownLight};
use crate::place::Place;
use crate::scene::Layers;
use crate::sky::star_index::StarIndex;
use crate::units::{Angle, Xyzv};

use super::data::SkyData;
use super::kept_dark::KeptTables;
use super::lay::SWITCHED_OFF;
use super::ledger::Ledger;
use super::milky_way::MilkyWayPlan;
use super::{DARK_AZIMUTHS, PlanError, SKY_SHAPE, SkyPlan};

/// Above this altitude of the Sun the dark sky is nowhere over 1/10 000 of twilight.
pub const DARK_SKY_SUN_LIMIT: Angle = Angle::from_deg(-3.0);

const OUTSHONE: &str = "the Sun outshines it ten thousandfold";
const NO_TOWNS: &str = "none is asked for";
const NO_MAP: &str = "there is no map of it at hand";

/// What frames in a row share of the dark sky.
#[derive(Default)]
pub struct KeptDarkSky {
    air: Option<NightAir>,
    towns: Option<(Place, Vec<Town>)>,
    town_shapes: Option<(Atmosphere, f64, GlowTables)>,
    town_glow: Option<(TownLight, Lamps, TownGlow)>,
    /// How often the glow of towns has changed.
    town_changes: u64,
    starlight: Option<Starlight>,
    tables: KeptTables,
    /// Stars of a catalogue that are fainter than a magnitude.
    glows: Vec<(StarIndex, f64, Arc<StarGlow>)>,
}

impl KeptDarkSky {
    /// The air of a night.
    pub fn air(&mut self, night: &Night) -> Result<NightAir, ScatteringError> {
        let height_m = night.sky.place.height_m;
        if let Some(air) = self.air.as_ref().filter(|air| air.is_of(&night.air, height_m)) {
            return Ok(air.clone());
        }
        Ok(self.air.insert(NightAir::solve(&night.air, height_m)?).clone())
    }

    /// Forgets the tables of the frame before, not the air nor what shines.
    pub fn forget_tables(&mut self) {
        self.tables = KeptTables::default();
    }

    /// How many tables are kept, of the sky and of stars that glow.
    pub fn tables(&self) -> usize {
        self.tables.tables() + self.glows.len()
    }

    /// Lays the lights of a night, as in the frame before where they are the same.
    pub(super) fn lay(
        &mut self,
        night: &Night,
        lights: NightLights,
        plan: &mut SkyPlan,
    ) -> Result<Option<MilkyWayPlan>, ScatteringError> {
        let air = self.air(night)?;
        let (changes, axes) = (self.town_changes, night.sky.horizon_from_icrs);
        Ok(self.tables.lay(&air, lights, changes, axes, plan))
    }

    /// Where town glow is from: the towns of the gazetteer are looked up once for a place.
    fn town_light(
        &mut self,
        glow: &NightGlow,
        place: &Place,
        data: &dyn SkyData,
    ) -> Result<TownLight, PlanError> {
        if !glow.towns {
            return Ok(glow.town_light_all_round());
        }
        if let Some((known, towns)) = &self.towns
            && known == place
        {
            return Ok(TownLight::Towns(towns.clone()));
        }
        let towns = data.towns_around(place)?;
        self.towns = Some((place.clone(), towns.clone()));
        Ok(TownLight::Towns(towns))
    }

    /// The glow of towns, the same as before where nothing has changed.
    fn town_glow(
        &mut self,
        light: &TownLight,
        lamps: Lamps,
        night: &Night,
    ) -> Result<TownGlow, ScatteringError> {
        let height_m = night.sky.place.height_m;
        let of_air = self.town_shapes.take_if(|(air, height, _)| {
            *air == night.air && height.to_bits() == height_m.to_bits()
        });
        let (air, height_m, shapes) = match of_air {
            Some(of_air) => of_air,
            None => {
                self.town_glow = None;
                (night.air.clone(), height_m, GlowTables::solve(&night.air, height_m)?)
            }
        };
        let known = self.town_glow.take_if(|(known, of, _)| known == light && *of == lamps);
        if known.is_none() {
            self.town_changes += 1;
        }
        let known =
            known.unwrap_or_else(|| (light.clone(), lamps, TownGlow::new(light, lamps, &shapes)));
        self.town_shapes = Some((air, height_m, shapes));
        Ok(self.town_glow.insert(known).2.clone())
    }

    fn starlight(&mut self, data: &dyn SkyData) -> Result<Option<Starlight>, PlanError> {
        if self.starlight.is_none() {
            self.starlight = data.milky_way()?.map(Starlight::new);
        }
        Ok(self.starlight.clone())
    }

    /// The stars of a catalogue that are fainter than a magnitude, as a glow.
    fn glow(&mut self, stars: &StarIndex, fainter_than: f64) -> Arc<StarGlow> {
        /// All of a catalogue, and those beyond two limits.
        const MOST: usize = 3;
        let is_it = |(known, limit, _): &&(StarIndex, f64, Arc<StarGlow>)| {
            known.is_same(stars) && *limit == fainter_than
        };
        if let Some((.., glow)) = self.glows.iter().find(is_it) {
            return glow.clone();
        }
        let glow = Arc::new(glow_of(stars, fainter_than));
        self.glows.truncate(MOST - 1);
        self.glows.insert(0, (stars.clone(), fainter_than, glow.clone()));
        glow
    }
}

/// The stars of a catalogue that are fainter than a magnitude.
fn glow_of(stars: &StarIndex, fainter_than: f64) -> StarGlow {
    let axes = galactic_from_icrs();
    let faint = stars.iter().filter(|star| star.magnitude.0 > fainter_than);
    StarGlow::of(faint.map(|star| (axes * star.dir_j2000, star.magnitude.illuminance())))
}

/// What shines on a night, by the layers that are wanted; says in the ledger what does not and why.
pub fn lights(
    glow: &NightGlow,
    layers: &Layers,
    night: &Night,
    data: &dyn SkyData,
    kept: &mut KeptDarkSky,
    ledger: &mut Ledger,
) -> Result<NightLights, PlanError> {
    let outshone = night.sky.sun.dir.altitude() > DARK_SKY_SUN_LIMIT;
    let why_not = |wanted: bool| match (layers.skylight && wanted, outshone) {
        (false, _) => Some(SWITCHED_OFF),
        (true, true) => Some(OUTSHONE),
        (true, false) => None,
    };
    let mut note = |layer: &'static str, why_not: Option<&'static str>| {
        match why_not {
            Some(reason) => ledger.skip(layer, reason),
            None => ledger.draw(layer),
        }
        why_not.is_none()
    };
    let mut lights = NightLights::default();
    if note("airglow", why_not(layers.airglow)) {
        lights.airglow = glow.airglow(&night.sky);
    }
    if note("zodiacal light", why_not(layers.zodiacal_light)) {
        lights.helioecliptic_from_horizon = Some(helioecliptic_from_horizon(&night.sky));
    }
    let starlight = match why_not(layers.milky_way) {
        Some(reason) => Err(reason),
        None => kept.starlight(data)?.ok_or(NO_MAP),
    };
    note("Milky Way", starlight.as_ref().err().copied());
    if let Ok(starlight) = starlight {
        let axes = galactic_from_icrs() * night.sky.horizon_from_icrs.inverse();
        lights.starlight = Some((starlight, axes));
        lights.catalogue = Some(kept.glow(&night.stars, f64::NEG_INFINITY));
        let limit = layers.magnitude_limit.filter(|_| layers.stars);
        lights.undrawn = limit.map(|limit| kept.glow(&night.stars, limit));
    }
    let is_asked_for = glow.towns || glow.town_light_all_round() != TownLight::None;
    let no_towns = (layers.town_glow && !is_asked_for).then_some(NO_TOWNS);
    if note("town glow", no_towns.or(why_not(layers.town_glow))) {
        let towns = kept.town_light(glow, &night.sky.place, data)?;
        lights.towns = Some(kept.town_glow(&towns, glow.lamps, night)?);
    }
    Ok(lights)
}

/// The table of a dark sky for a plan, and the Milky Way in front of it.
pub fn lay(sky: &DarkSky, plan: &mut SkyPlan) -> Option<MilkyWayPlan> {
    let altitudes = lay_table(sky, plan);
    MilkyWayPlan::of(sky, plan.horizon, &altitudes[..SKY_SHAPE.above])
}

/// The table alone; the altitudes of its rows.
pub(super) fn lay_table(sky: &DarkSky, plan: &mut SkyPlan) -> Vec<Angle> {
    let altitudes: Vec<Angle> =
        (0..SKY_SHAPE.rows()).map(|row| SKY_SHAPE.elevation_beside(row, plan.horizon)).collect();
    let turn = Angle::from_deg(360.0);
    let azimuths: Vec<Angle> =
        (0..DARK_AZIMUTHS).map(|column| turn * (column as f64 / DARK_AZIMUTHS as f64)).collect();
    plan.dark = sky.luminances(&altitudes, &azimuths);
    altitudes
}

/// No dark sky at all.
pub fn no_light() -> Vec<Xyzv> {
    vec![Xyzv::BLACK; SKY_SHAPE.rows() * DARK_AZIMUTHS]
}
