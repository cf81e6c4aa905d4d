//! The light of the sky as tables, from the solved air and what shines into it.

use crate::air::Atmosphere;
use crate::air::scattering::{
    Quality, SKY_NODES_NM, ScatteringError, ScatteringTables, SkyView, reconstruction_matrix,
};
use crate::light::diffuse::NightSky;
use crate::light::night::Night;
use crate::light::spectrum::{FIRST_NM, LEN, STEP_NM, Spectrum, wavelength_nm};
use crate::sky::BodyState;
use crate::units::{Angle, Xyzv};

use super::{SKY_ALTITUDES, SKY_AZIMUTHS, SkyPlan, SourceSky, sky_table_altitude};

/// Below this altitude of the Sun its light is nowhere over 2 % of the dark sky. At 18 degrees of
/// twilight, where the zenith is dark, it is still a third of it above the Sun.
pub const SUN_SKY_FLOOR: Angle = Angle::from_deg(-22.0);
/// Below this altitude of the Moon its light is nowhere over 2 % of the dark sky.
pub const MOON_SKY_FLOOR: Angle = Angle::from_deg(-10.0);
/// Above this altitude of the Sun the light of the Moon is nowhere over 0.2 % of the Sun's.
pub const MOON_SKY_SUN_LIMIT: Angle = Angle::from_deg(-1.0);

/// Whether a source lights the sky, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shines {
    Yes,
    No(&'static str),
}

/// Whether sunlight is scattered into this sky.
pub fn sun_shines(night: &Night) -> Shines {
    match night.sky.sun.dir.altitude() < SUN_SKY_FLOOR {
        true => Shines::No("the Sun is more than 22° below the horizon"),
        false => Shines::Yes,
    }
}

/// Whether moonlight is scattered into this sky.
pub fn moon_shines(night: &Night) -> Shines {
    if night.sky.moon.state.dir.altitude() < MOON_SKY_FLOOR {
        Shines::No("the Moon is more than 10° below the horizon")
    } else if night.sky.sun.dir.altitude() > MOON_SKY_SUN_LIMIT {
        Shines::No("sunlight outshines moonlight five hundredfold")
    } else {
        Shines::Yes
    }
}

/// The air solved once for an atmosphere, and how its few wavelengths become spectra.
pub struct SolvedAir {
    tables: ScatteringTables,
    spectrum_from_nodes: crate::air::scattering::Matrix,
}

impl SolvedAir {
    pub fn solve(air: &Atmosphere) -> Result<SolvedAir, ScatteringError> {
        let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
        Ok(SolvedAir {
            tables: ScatteringTables::solve(air, &SKY_NODES_NM, Quality::RENDER)?,
            spectrum_from_nodes: reconstruction_matrix(&SKY_NODES_NM, &wavelengths),
        })
    }

    /// A source's spectrum weighed by what the air makes of each wavelength.
    fn weighed(&self, nodes: &[f64], source: &Spectrum) -> Spectrum {
        let shares = self.spectrum_from_nodes.spectrum(nodes);
        source.weighted(|nm| shares[((nm - FIRST_NM) / STEP_NM).round() as usize])
    }

    /// The sky that a source lights, given its spectral irradiance outside the air.
    fn sky(&self, state: &BodyState, irradiance: &Spectrum, height_km: f64) -> SourceSky {
        let view = self.tables.sky_view(
            height_km,
            state.dir.altitude().sin(),
            SKY_AZIMUTHS,
            SKY_ALTITUDES,
        );
        SourceSky { azimuth: state.dir.azimuth(), luminance: self.luminance(&view, irradiance) }
    }

    fn luminance(&self, view: &SkyView, irradiance: &Spectrum) -> Vec<Xyzv> {
        use rayon::prelude::*;
        view.radiance
            .par_chunks_exact(view.n_wavelengths)
            .map(|nodes| {
                let nodes: Vec<f64> = nodes.iter().map(|&value| f64::from(value)).collect();
                self.weighed(&nodes, irradiance).xyzv()
            })
            .collect()
    }

    /// Illuminance of level ground by a source, direct and by way of the sky, lux.
    fn ground(&self, state: &BodyState, irradiance: &Spectrum) -> Xyzv {
        let (diffuse, direct) = self.tables.ground_irradiance(state.dir.altitude().sin());
        self.weighed(&diffuse, irradiance).xyzv() + self.weighed(&direct, irradiance).xyzv()
    }
}

/// The sky of a night. Solves the air only if something shines into it.
pub fn sky_plan(
    night: &Night,
    with_sun: bool,
    with_moon: bool,
) -> Result<SkyPlan, ScatteringError> {
    let height_km = night.sky.place.height_m.max(0.0) / 1000.0;
    let natural = NightSky::default();
    let dark: Vec<Xyzv> = (0..SKY_ALTITUDES)
        .map(|row| natural.luminance(&night.air, night.sky.place.height_m, sky_table_altitude(row)))
        .collect();
    // Level ground under an even sky: pi times its luminance, here that of its middle heights.
    let mut ground = dark[SKY_ALTITUDES * 2 / 3] * std::f64::consts::PI;
    let (mut sun, mut moon) = (None, None);
    let lights =
        [(with_sun, &night.sky.sun, &mut sun), (with_moon, &night.sky.moon.state, &mut moon)];
    let mut solved = None;
    for (shines, state, sky) in lights {
        if shines {
            let irradiance = night.irradiance(state);
            let air = match &solved {
                Some(air) => air,
                None => solved.insert(SolvedAir::solve(&night.air)?),
            };
            *sky = Some(air.sky(state, &irradiance, height_km));
            ground += air.ground(state, &irradiance);
        }
    }
    let ground = ground * (night.air.ground.albedo / std::f64::consts::PI);
    Ok(SkyPlan { sun, moon, dark, ground })
}
