//! The air around one observer, made ready to be looked through: how it bends light, what it lets
//! through, what it makes of starlight.
//!
//! Takes some milliseconds to make and depends on nothing but the air and the height, so that the nights
//! of a row share it.

use std::sync::{Arc, Mutex, OnceLock};

use crate::air::Atmosphere;
use crate::air::extinction::SightLines;
use crate::air::refraction::Refraction;
use crate::light::earth_shadow::{Danjon, EarthLimb, EarthShadow, ShadowDistances};
use crate::light::star_light::StarLight;
use crate::units::Angle;

/// A shadow of the Earth whose distances differ by less than this share is the same: its edge is out by
/// less than 0.1", which the limb of the Moon crosses in a third of a second.
const SAME_DISTANCE: f64 = 2e-5;

/// The limb of the Earth, and its shadow at the distances that were asked for last.
struct KeptShadow {
    danjon: Danjon,
    limb: EarthLimb,
    shadow: Option<Arc<EarthShadow>>,
}

/// Air that an observer looks through. Clones share its tables.
#[derive(Clone)]
pub struct ClearView(Arc<Inner>);

struct Inner {
    air: Atmosphere,
    height_m: f64,
    refraction: Refraction,
    sight: SightLines,
    starlight: Arc<OnceLock<StarLight>>,
    shadow: Mutex<Option<KeptShadow>>,
}

impl ClearView {
    /// For an observer of a height above sea level, metres.
    pub fn new(air: &Atmosphere, height_m: f64) -> ClearView {
        ClearView(Arc::new(Inner {
            air: air.clone(),
            height_m,
            refraction: air.refraction_at(height_m),
            sight: SightLines::over(air, height_m),
            starlight: Arc::default(),
            shadow: Mutex::default(),
        }))
    }

    /// Whether this is the air around an observer of a height above sea level, metres.
    pub fn is_of(&self, air: &Atmosphere, height_m: f64) -> bool {
        self.0.height_m.to_bits() == height_m.to_bits() && self.0.air == *air
    }

    pub fn air(&self) -> &Atmosphere {
        &self.0.air
    }

    /// Height of the observer above sea level, metres.
    pub fn height_m(&self) -> f64 {
        self.0.height_m
    }

    /// How it bends light.
    pub fn refraction(&self) -> &Refraction {
        &self.0.refraction
    }

    /// What it lets through.
    pub fn sight(&self) -> &SightLines {
        &self.0.sight
    }

    /// Apparent altitude of the horizon of the ground around.
    pub fn horizon(&self) -> Angle {
        self.0.sight.horizon()
    }

    /// What arrives of the light of stars, made when the first is lit.
    pub(super) fn starlight(&self) -> Arc<OnceLock<StarLight>> {
        self.0.starlight.clone()
    }

    /// The shadow of the Earth on the Moon, that of the night before where they are as far apart; none if
    /// the air cannot be.
    pub(super) fn earth_shadow(
        &self,
        danjon: Danjon,
        distances: ShadowDistances,
    ) -> Option<Arc<EarthShadow>> {
        // Whoever failed while it was locked left it whole.
        let kept = || self.0.shadow.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        // Not locked while it is made, which other threads may help with.
        let known = kept().take();
        let mut known = match known.filter(|known| known.danjon == danjon) {
            Some(known) => known,
            None => {
                KeptShadow { danjon, limb: EarthLimb::new(&self.0.air, danjon).ok()?, shadow: None }
            }
        };
        let is_near = |a: f64, b: f64| (a - b).abs() <= SAME_DISTANCE * b;
        let near = known.shadow.take().filter(|shadow| {
            let of = shadow.distances();
            is_near(of.sun_km, distances.sun_km) && is_near(of.earth_km, distances.earth_km)
        });
        let shadow = near.unwrap_or_else(|| Arc::new(EarthShadow::of_limb(&known.limb, distances)));
        known.shadow = Some(shadow.clone());
        *kept() = Some(known);
        Some(shadow)
    }
}
