//! Town glow: the light of lamps that the air scatters back.
//!
//! Two ways to say how much: by the sky overhead ([`TownLight::Zenith`], [`TownLight::Bortle`]), the
//! same all round; by the towns around ([`TownLight::Towns`]), a dome over each.
//!
//! *Theory.* Garstang 1986, *PASP* 98, 364, and 1989, *PASP* 101, 306: a town of `P` people sends up
//! light with the intensity `L P / (2 pi) (2 G (1 - F) cos z + 0.554 F z^4)` at the zenith distance `z`,
//! `L` lumens a head, of which a part `F` = 0.15 goes up from the lamps, mostly low, and a part `G` =
//! 0.15 of the rest comes back from the ground; how the air scatters it is told in
//! [`crate::air::scattering::below`]. His `L` is 1000 lm in his air; here it is what gives Walker's law. A town is an even disc whose area grows as `P^(3/4)`
//! (Stewart & Warntz 1958, recalled).
//!
//! *A sky that is the same all round.* Land settled evenly to 100 km, and the observer in a gap in
//! it: the darker the zenith, the wider the gap. Beyond the widest gap and without any the whole is
//! scaled. Ten degrees high it is nine times as bright as overhead over the widest gap, twelve times
//! over none.
//! Artificial is what exceeds [`NATURAL_ZENITH_MAG`], in luminance, as Crumey 2014 relates it to V.
//!
//! *Not here.* Hills, clouds, snow, hours after midnight; that one country lights its streets three
//! times as brightly as another: single towns err by a factor of two. The gazetteer counts the people of a
//! municipality, of some towns those of a district as well.
//!
//! *Accuracy.* Walker's law (1977, *PASP* 89, 405), `0.01 P d^-2.5` of the natural sky at 45 degrees
//! towards a town at `d` km: within a factor of 1.5 from 20 to 80 km in the air of
//! [`Atmosphere::default`](crate::air::Atmosphere) (`tests/town_glow.rs`).

mod dome;
mod settlement;

use std::sync::{Arc, LazyLock};

use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::scattering::below::{ALTITUDES_DEG, GroundLight, NodeLight};
use crate::air::scattering::{
    Matrix, SKY_NODES_NM, ScatteringError, SpectralSums, reconstruction_matrix,
};
use crate::light::lamps::Lamps;
use crate::light::photometry::luminance_cd_m2;
use crate::light::spectrum::{LEN, Spectrum, wavelength_nm};
use crate::place::Place;
use crate::place::gazetteer::City;
use crate::units::{Angle, Xyzv};
use dome::Dome;

/// Zenith of a dark sky without artificial light, magnitudes per square arcsecond in V.
pub const NATURAL_ZENITH_MAG: f64 = 22.0;
/// Zenith values that [`TownLight::validate`] lets pass.
pub const ZENITH_RANGE_MAG: std::ops::RangeInclusive<f64> = 14.0..=23.0;
/// Farther towns are left out, kilometres.
pub const FARTHEST_TOWN_KM: f64 = 250.0;
/// No more towns are drawn.
pub const MOST_TOWNS: usize = 100;

/// A town that lights the sky.
#[derive(Debug, Clone, PartialEq)]
pub struct Town {
    pub name: String,
    /// People who live there.
    pub population: f64,
    /// The azimuth in which its middle lies, north through east.
    pub bearing: Angle,
    /// Of its middle, along the ground; 0 for an observer there.
    pub distance_km: f64,
}

/// Where artificial light is from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum TownLight {
    #[default]
    None,
    /// From all around, so much that the zenith of a moonless night has this surface brightness in V.
    Zenith { mag_per_arcsec2: f64 },
    /// The same by the class of Bortle's scale, 1 to 9.
    Bortle(u8),
    /// From towns.
    Towns(Vec<Town>),
}

/// What can be wrong with a [`TownLight`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TownLightError {
    #[error("town light: there is no Bortle class {0}; give one from 1 (dark) to 9 (inner city)")]
    Bortle(u8),
    #[error(
        "town light: a zenith of {0} mag/arcsec2 is outside {low} to {high}; 22 is a dark sky, 18 a city",
        low = ZENITH_RANGE_MAG.start(),
        high = ZENITH_RANGE_MAG.end()
    )]
    Zenith(f64),
    #[error("town light: {name} has {what} {value}; give a finite number, not negative")]
    Town { name: String, what: &'static str, value: f64 },
}

/// Surface brightness of the zenith in V that stands for a class of Bortle's scale, magnitudes per
/// square arcsecond; `None` outside 1 to 9.
///
/// Inside the ranges that are commonly given for the classes (recalled: 2 to 21.89, 3 to 21.69, 4 to
/// 20.49, 5 to 19.50, 6 to 18.94, 7 to 18.38 and brighter beyond). Bortle 2001 himself gives none.
pub fn bortle_zenith_mag(class: u8) -> Option<f64> {
    const ZENITH_MAG: [f64; 9] = [22.0, 21.93, 21.79, 21.1, 20.0, 19.2, 18.66, 18.0, 17.3];
    ZENITH_MAG.get(usize::from(class).checked_sub(1)?).copied()
}

impl TownLight {
    /// Whether all numbers are such as can be.
    pub fn validate(&self) -> Result<(), TownLightError> {
        match self {
            TownLight::None => Ok(()),
            TownLight::Zenith { mag_per_arcsec2: mag } if ZENITH_RANGE_MAG.contains(mag) => Ok(()),
            TownLight::Zenith { mag_per_arcsec2 } => Err(TownLightError::Zenith(*mag_per_arcsec2)),
            TownLight::Bortle(class) => match bortle_zenith_mag(*class) {
                Some(_) => Ok(()),
                None => Err(TownLightError::Bortle(*class)),
            },
            TownLight::Towns(towns) => towns.iter().try_for_each(|town| {
                let numbers = [
                    ("a population of", town.population),
                    ("a distance in km of", town.distance_km),
                ];
                match numbers.into_iter().find(|(_, v)| !(v.is_finite() && *v >= 0.0)) {
                    None => Ok(()),
                    Some((what, value)) => {
                        Err(TownLightError::Town { name: town.name.clone(), what, value })
                    }
                }
            }),
        }
    }

    /// Artificial luminance of the zenith that is asked for, cd/m2, if it is.
    fn zenith_cd_m2(&self) -> Option<f64> {
        let mag = match self {
            TownLight::Zenith { mag_per_arcsec2 } => *mag_per_arcsec2,
            TownLight::Bortle(class) => bortle_zenith_mag(*class)?,
            TownLight::None | TownLight::Towns(_) => return None,
        };
        // Written so that NaN is dark.
        let excess = luminance_cd_m2(mag) - luminance_cd_m2(NATURAL_ZENITH_MAG);
        (excess > 0.0 && excess.is_finite()).then_some(excess)
    }
}

/// The towns of a list whose glow can be seen from a place, brightest first, at most [`MOST_TOWNS`]:
/// those that Walker's law gives a two-thousandth of the natural sky, within [`FARTHEST_TOWN_KM`].
pub fn towns_around<'a>(place: &Place, cities: impl IntoIterator<Item = &'a City>) -> Vec<Town> {
    /// In units of the natural sky.
    const FAINTEST: f64 = 5e-4;
    let mut towns: Vec<(f64, Town)> = cities
        .into_iter()
        .filter(|city| city.population > 0)
        .filter_map(|city| {
            let seen = city.seen_from(place);
            let population = city.population as f64;
            let town = || Town {
                name: city.name.clone(),
                population,
                bearing: seen.bearing,
                distance_km: seen.distance_km,
            };
            let glow = settlement::walker(population, seen.distance_km);
            (seen.distance_km <= FARTHEST_TOWN_KM && glow >= FAINTEST).then(|| (glow, town()))
        })
        .collect();
    towns.sort_by(|a, b| b.0.total_cmp(&a.0));
    towns.truncate(MOST_TOWNS);
    towns.into_iter().map(|(_, town)| town).collect()
}

/// Lumens of all lamps of a town, a head: within a factor of 1.4 of Walker's law from 20 to 80 km.
const LUMENS_A_HEAD: f64 = 640.0;
/// What part of them goes up from the lamps, and what part of the rest the ground sends up.
const UPWARD_SHARE: f64 = 0.15;
const REFLECTED_SHARE: f64 = 0.15;

/// Garstang's emission function for light of unit amount, sr^-1.
fn emission(cos_zenith: f64) -> f64 {
    let zenith_distance = cos_zenith.clamp(0.0, 1.0).acos();
    let ground = 2.0 * REFLECTED_SHARE * (1.0 - UPWARD_SHARE) * cos_zenith;
    (ground + 0.554 * UPWARD_SHARE * zenith_distance.powi(4)) / (2.0 * std::f64::consts::PI)
}

/// What an air makes of light from the ground over an observer. Cheap to clone.
#[derive(Debug, Clone)]
pub struct GlowTables {
    light: GroundLight,
}

impl GlowTables {
    /// For an air and a height of the observer above sea level, metres. Some 100 ms.
    pub fn solve(air: &Atmosphere, height_m: f64) -> Result<GlowTables, ScatteringError> {
        Ok(GlowTables { light: GroundLight::solve(air, height_m, emission)? })
    }
}

/// From the wavelengths that are solved for to all.
static SPECTRUM_FROM_NODES: LazyLock<Matrix> = LazyLock::new(|| {
    let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
    reconstruction_matrix(&SKY_NODES_NM, &wavelengths)
});

/// From light at the nodes, per unit of lamp light, to X, Y, Z and V.
#[derive(Debug)]
struct Eyes(SpectralSums);

impl Eyes {
    fn of(lamps: Lamps) -> Eyes {
        let lamp = lamps.spectrum();
        let weight = |node: usize| {
            let at = wavelength_nm(node);
            let light = lamp.weighted(|nm| if nm == at { 1.0 } else { 0.0 }).xyzv();
            [light.x, light.y, light.z, light.v]
        };
        let weights: Vec<_> = (0..LEN).map(weight).collect();
        Eyes(SpectralSums::new(&SPECTRUM_FROM_NODES, &weights))
    }

    fn see(&self, nodes: &NodeLight) -> Xyzv {
        /// Keeps faint light within single precision.
        const SCALE: f64 = 1e12;
        let [x, y, z, v] = self.0.apply(&nodes.map(|value| (value * SCALE) as f32));
        Xyzv::new(x.into(), y.into(), z.into(), v.into()) * (1.0 / SCALE)
    }
}

/// The artificial sky over one observer. Cheap to clone.
#[derive(Debug, Clone)]
pub struct TownGlow {
    lamps: Spectrum,
    /// Nothing if there is no light.
    sky: Option<Arc<Sky>>,
}

#[derive(Debug)]
struct Sky {
    dome: Dome,
    seen: Vec<Xyzv>,
}

impl TownGlow {
    /// No artificial light.
    pub const NONE: TownGlow = TownGlow { lamps: Spectrum::DARK, sky: None };

    /// The glow of some light through an air. Numbers that [`TownLight::validate`] refuses are no
    /// light.
    pub fn new(light: &TownLight, lamps: Lamps, tables: &GlowTables) -> TownGlow {
        let eyes = Eyes::of(lamps);
        let dome = match light {
            _ if light.validate().is_err() => None,
            TownLight::Towns(towns) => settlement::of_towns(towns, &tables.light),
            _ => light.zenith_cd_m2().map(|wanted| {
                settlement::all_round(&tables.light, wanted, |nodes| eyes.see(nodes).y)
            }),
        };
        let sky = dome.map(|dome| {
            let seen = dome.nodes().par_iter().map(|nodes| eyes.see(nodes)).collect();
            Arc::new(Sky { dome, seen })
        });
        TownGlow { lamps: lamps.spectrum(), sky }
    }

    /// Spectral radiance, W m-2 sr-1 nm-1, at an apparent altitude, that of the horizon below it, and
    /// an azimuth, north through east.
    pub fn radiance(&self, apparent_altitude: Angle, azimuth: Angle) -> Spectrum {
        let Some(sky) = &self.sky else { return Spectrum::DARK };
        let mut nodes = [0.0; SKY_NODES_NM.len()];
        for (node, weight) in sky.dome.around(apparent_altitude, azimuth) {
            for (sum, value) in nodes.iter_mut().zip(&sky.dome.nodes()[node]) {
                *sum += weight * value;
            }
        }
        let factors = SPECTRUM_FROM_NODES.spectrum(&nodes);
        let step = wavelength_nm(1) - wavelength_nm(0);
        self.lamps.weighted(|nm| factors[((nm - wavelength_nm(0)) / step).round() as usize])
    }

    /// What eyes make of it, cd/m2.
    pub fn luminance(&self, apparent_altitude: Angle, azimuth: Angle) -> Xyzv {
        let Some(sky) = &self.sky else { return Xyzv::BLACK };
        sky.dome.around(apparent_altitude, azimuth).map(|(node, w)| sky.seen[node] * w).sum()
    }

    /// The same on a grid, cd/m2: a row for each apparent altitude, a column for each azimuth.
    pub fn luminances(&self, altitudes: &[Angle], azimuths: &[Angle]) -> Vec<Xyzv> {
        if self.sky.is_none() {
            return vec![Xyzv::BLACK; altitudes.len() * azimuths.len()];
        }
        altitudes
            .par_iter()
            .flat_map_iter(|&altitude| {
                azimuths.iter().map(move |&azimuth| self.luminance(altitude, azimuth))
            })
            .collect()
    }

    /// Illuminance of level ground by the artificial sky, without that of lamps themselves, lux.
    pub fn ground_illuminance(&self) -> Xyzv {
        let Some(sky) = &self.sky else { return Xyzv::BLACK };
        sky.dome
            .projected_solid_angles()
            .zip(&sky.seen)
            .map(|(weight, light)| *light * weight)
            .sum()
    }
}
