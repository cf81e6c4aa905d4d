//! The light of the sky as tables, from the solved air and what shines into it.

use crate::air::Atmosphere;
use crate::air::scattering::{
    Matrix, Quality, SKY_NODES_NM, SUMS, ScatteringError, ScatteringTables, SkyRays, SkyShape,
    SpectralSums, horizon, reconstruction_matrix,
};
use crate::frame::{Dir, Horizon};
use crate::light::diffuse::NightSky;
use crate::light::night::Night;
use crate::light::spectrum::{LEN, Spectrum, wavelength_nm};
use crate::units::{Angle, Xyzv};

use super::{SKY_SHAPE, SkyPlan, SourceSky};

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

/// The nodes that are computed; cubics through them make [`SKY_SHAPE`].
pub const COMPUTED_SHAPE: SkyShape = SkyShape { above: 37, below: 13, azimuths: 25 };

/// The air solved once for an atmosphere around an observer, and the rays he looks along.
pub struct SolvedAir {
    air: Atmosphere,
    height_m: f64,
    tables: ScatteringTables,
    rays: SkyRays,
    spectrum_from_nodes: Matrix,
}

impl SolvedAir {
    /// For an observer of a height above sea level, metres.
    pub fn solve(air: &Atmosphere, height_m: f64) -> Result<SolvedAir, ScatteringError> {
        let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
        let tables = ScatteringTables::for_observer(air, height_m, &SKY_NODES_NM, Quality::RENDER)?;
        Ok(SolvedAir {
            rays: tables.sky_rays(air.eye_km(height_m), COMPUTED_SHAPE),
            air: air.clone(),
            height_m,
            tables,
            spectrum_from_nodes: reconstruction_matrix(&SKY_NODES_NM, &wavelengths),
        })
    }

    /// The air of `solved` if it is this air around this observer; else it is solved and kept there.
    pub fn kept<'s>(
        solved: &'s mut Option<SolvedAir>,
        air: &Atmosphere,
        height_m: f64,
    ) -> Result<&'s SolvedAir, ScatteringError> {
        match solved.take_if(|kept| kept.is_of(air, height_m)) {
            Some(kept) => Ok(solved.insert(kept)),
            None => Ok(solved.insert(SolvedAir::solve(air, height_m)?)),
        }
    }

    /// Whether this is the air around an observer of a height above sea level, metres.
    pub fn is_of(&self, air: &Atmosphere, height_m: f64) -> bool {
        self.air == *air && self.height_m == height_m
    }

    /// The solved field.
    pub fn tables(&self) -> &ScatteringTables {
        &self.tables
    }

    /// The sky and the ground that a source lights, given its spectral irradiance outside the air.
    pub fn sky(&self, source: Dir<Horizon>, irradiance: &Spectrum) -> SourceSky {
        let computed = self.tables.sky_view(&self.rays, source.altitude().sin());
        let seen = computed.seen_by(&self.sums(irradiance));
        SourceSky { azimuth: source.azimuth(), view: seen.refined(SKY_SHAPE) }
    }

    /// What X, Y, Z and V make of a spectrum of light from a source, given at the nodes.
    pub fn sums(&self, irradiance: &Spectrum) -> SpectralSums {
        let weights: Vec<[f64; SUMS]> = (0..LEN)
            .map(|node| {
                let line = irradiance.weighted(|nm| f64::from(nm == wavelength_nm(node)));
                let Xyzv { x, y, z, v } = line.xyzv();
                [x, y, z, v]
            })
            .collect();
        SpectralSums::new(&self.spectrum_from_nodes, &weights)
    }
}

/// The sky of a night. Solves the air only if something shines into it, and if it is not the air that
/// `solved` holds.
pub fn sky_plan(
    night: &Night,
    with_sun: bool,
    with_moon: bool,
    solved: &mut Option<SolvedAir>,
) -> Result<SkyPlan, ScatteringError> {
    let height_m = night.sky.place.height_m;
    let mut sky = SkyPlan::black(horizon(&night.air, height_m, night.air.eye_km(height_m)));
    for (shines, state, lit) in [
        (with_sun, &night.sky.sun, &mut sky.sun),
        (with_moon, &night.sky.moon.state, &mut sky.moon),
    ] {
        if shines {
            let air = SolvedAir::kept(solved, &night.air, height_m)?;
            *lit = Some(air.sky(state.dir, &night.irradiance(state)));
        }
    }
    sky.dark = dark_sky(night, sky.horizon)?;
    Ok(sky)
}

/// The sky without Sun and Moon, and the ground under it, by the rows of [`SKY_SHAPE`].
fn dark_sky(night: &Night, horizon: Angle) -> Result<Vec<Xyzv>, ScatteringError> {
    let dark = NightSky::default().through(&night.air, night.sky.place.height_m)?;
    let elevations: Vec<Angle> =
        (0..SKY_SHAPE.rows()).map(|row| SKY_SHAPE.elevation_beside(row, horizon)).collect();
    Ok(dark.luminances(night.air.eye_km(night.sky.place.height_m), &elevations))
}
