//! The light of the sky as tables, from the solved air and what shines into it.

use glam::DVec3;

use crate::air::Atmosphere;
use crate::air::scattering::shaded::Shares;
use crate::air::scattering::{
    Matrix, Quality, SKY_NODES_NM, SUMS, ScatteringError, ScatteringTables, SkyRays, SkyShape,
    SpectralSums, horizon, reconstruction_matrix,
};
use crate::background::{Background, Interrupt};
use crate::frame::{Dir, Horizon};
use crate::light::moon_shadow::MoonShadow;
use crate::light::night::Night;
use crate::light::solar_eclipse::CoveredSun;
use crate::light::spectrum::{LEN, Spectrum, wavelength_nm};
use crate::store::Store;
use crate::units::{Angle, Xyzv};

use super::kept_source::KeptSource;
use super::{SKY_SHAPE, SkyPlan, SourceSky};

/// Below this altitude of the Sun its light is nowhere over 2 % of the dark sky. At 18 degrees of
/// twilight, where the zenith is dark, it is still a third of it above the Sun.
pub const SUN_SKY_FLOOR: Angle = Angle::from_deg(-22.0);
/// Below this altitude of the Moon its light is nowhere over 2 % of the dark sky.
pub const MOON_SKY_FLOOR: Angle = Angle::from_deg(-10.0);
/// Above this altitude of the Sun the light of the Moon is nowhere over 0.2 % of the Sun's.
pub const MOON_SKY_SUN_LIMIT: Angle = Angle::from_deg(-1.0);

/// While more than this share of the Sun is left, at 550 nm, its light is as faint in all of the air; when
/// less than the second is left, each part of the air has its own; between them one turns into the other.
const SHADOWED: [f64; 2] = [0.30, 0.20];

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

/// The Sun, if so much of it is covered that each part of the air has its own light.
pub fn in_shadow_of_moon(night: &Night) -> Option<CoveredSun> {
    night.eclipse.sun.filter(|sun| sun.visible().at_nm(550.0) < SHADOWED[0])
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

/// Air that is solved in the background: [`SolvedAir::in_background`].
pub type SolvingAir = Background<(Atmosphere, f64), Result<SolvedAir, ScatteringError>>;

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
        let solved = SolvedAir::stored(air, height_m, &Store::NONE, &Interrupt::default())?;
        solved.ok_or(ScatteringError::Interrupted)
    }

    /// The same, taken from the store if it is there and kept there if not; none if it was interrupted.
    pub fn stored(
        air: &Atmosphere,
        height_m: f64,
        store: &Store,
        interrupt: &Interrupt,
    ) -> Result<Option<SolvedAir>, ScatteringError> {
        let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
        let (nodes, quality) = (&SKY_NODES_NM, Quality::RENDER);
        let tables = ScatteringTables::stored(air, height_m, nodes, quality, store, interrupt)?;
        Ok(tables.map(|tables| SolvedAir {
            rays: tables.sky_rays(air.eye_km(height_m), COMPUTED_SHAPE),
            air: air.clone(),
            height_m,
            tables,
            spectrum_from_nodes: reconstruction_matrix(nodes, &wavelengths),
        }))
    }

    /// Solves beside what is seen: the old air stays until the new one is ready, and air that was asked
    /// for and is not wanted any more is left half-way. Air and height above sea level, metres.
    pub fn in_background(store: Store) -> SolvingAir {
        Background::new(move |(air, height_m): &(Atmosphere, f64), interrupt| {
            SolvedAir::stored(air, *height_m, &store, interrupt).transpose()
        })
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

    /// The same of what is kept of the frame before; the first is that of [`SolvedAir::sky`].
    fn sky_in(
        &self,
        source: Dir<Horizon>,
        irradiance: &Spectrum,
        kept: &mut KeptSource,
    ) -> SourceSky {
        let make = |altitude: Angle| {
            let computed = self.tables.sky_view(&self.rays, altitude.sin());
            computed.seen_by(&self.sums(irradiance)).refined(SKY_SHAPE)
        };
        let seen_at = |altitude: Angle| self.tables.source_elevation(&self.rays, altitude.sin());
        let view = kept.view(source.altitude(), irradiance, make, seen_at);
        SourceSky { azimuth: source.azimuth(), view }
    }

    /// The same for a Sun that the Moon covers: the two sides of the sky, clockwise from the Sun and the
    /// other way. Given the irradiance of the whole Sun.
    pub fn eclipsed_sky(
        &self,
        night: &Night,
        covered: &CoveredSun,
        whole: &Spectrum,
    ) -> Option<[SourceSky; 2]> {
        let sun = night.sky.sun.dir;
        let left_here = covered.visible();
        let [begins, full] = SHADOWED;
        let alike = ((left_here.at_nm(550.0) - full) / (begins - full)).clamp(0.0, 1.0);
        let shadow = MoonShadow::of(&night.sky, SKY_NODES_NM);
        let (sin, cos) = sun.azimuth().sin_cos();
        let (ahead, clockwise) = (DVec3::new(sin, cos, 0.0), DVec3::new(cos, -sin, 0.0));
        let eye = DVec3::Z * (self.height_m / 1000.0);
        let left_at =
            |at: DVec3| shadow.left_at(ahead * at.x + clockwise * at.y + DVec3::Z * at.z - eye);
        let cos_zenith = sun.altitude().sin();
        let view = self.tables.sky_view(&self.rays, cos_zenith);
        let eye_km = self.air.eye_km(self.height_m);
        let mut shading = self.tables.shading(&view, eye_km, cos_zenith, &left_at)?;
        let even: Shares = SKY_NODES_NM.map(|nm| left_here.at_nm(nm));
        shading.towards(&even, alike * alike * (3.0 - 2.0 * alike));
        let sums = self.sums(whole);
        Some([0, 1].map(|side| SourceSky {
            azimuth: sun.azimuth(),
            view: shading.of(&view, side).seen_by(&sums).refined(SKY_SHAPE),
        }))
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

/// The air of the frame before, and the store on disk that other air is taken from.
pub struct KeptAir {
    solved: Option<SolvedAir>,
    store: Store,
    /// The horizon in some air of an observer of a height above sea level, metres.
    horizon: Option<(Atmosphere, f64, Angle)>,
    /// The skies of the frame before in the solved air.
    sun: KeptSource,
    moon: KeptSource,
}

impl KeptAir {
    /// None yet.
    pub fn new(store: Store) -> KeptAir {
        KeptAir {
            solved: None,
            store,
            horizon: None,
            sun: KeptSource::default(),
            moon: KeptSource::default(),
        }
    }

    /// Forgets the skies of the frame before, not the air.
    pub fn forget_skies(&mut self) {
        (self.sun, self.moon) = (KeptSource::default(), KeptSource::default());
    }

    /// How many tables of skies are kept.
    pub fn skies(&self) -> usize {
        self.sun.tables() + self.moon.tables()
    }

    /// The apparent altitude of the horizon, in any air.
    fn horizon(&mut self, air: &Atmosphere, height_m: f64) -> Angle {
        let known =
            self.horizon.take_if(|(known, height, _)| *known == *air && *height == height_m);
        let known = known.unwrap_or_else(|| {
            (air.clone(), height_m, horizon(air, height_m, air.eye_km(height_m)))
        });
        self.horizon.insert(known).2
    }

    /// This air around an observer of a height above sea level, metres, and where it is from.
    pub fn of(
        &mut self,
        air: &Atmosphere,
        height_m: f64,
    ) -> Result<(&SolvedAir, Origin), ScatteringError> {
        if let Some(kept) = self.solved.take_if(|kept| kept.is_of(air, height_m)) {
            return Ok((self.solved.insert(kept), Origin::FrameBefore));
        }
        let never = Interrupt::default();
        self.forget_skies();
        let solved = SolvedAir::stored(air, height_m, &self.store, &never)?;
        let solved = self.solved.insert(solved.ok_or(ScatteringError::Interrupted)?);
        let origin = if solved.tables.is_from_store() { Origin::Store } else { Origin::SolvedNow };
        Ok((solved, origin))
    }
}

/// Where the solved air of a frame is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    FrameBefore,
    Store,
    SolvedNow,
}

/// The sky of a night, and where its solved air is from. The air is asked for only if something shines
/// into it.
pub fn sky_plan(
    night: &Night,
    with_sun: bool,
    with_moon: bool,
    kept: &mut KeptAir,
) -> Result<(SkyPlan, Option<Origin>), ScatteringError> {
    let mut origin = None;
    let height_m = night.sky.place.height_m;
    let mut sky = SkyPlan::black(kept.horizon(&night.air, height_m));
    if with_sun || with_moon {
        let (_, from) = kept.of(&night.air, height_m)?;
        origin = Some(from);
        let KeptAir { solved, sun, moon, .. } = kept;
        for (shines, state, of_source, lit) in [
            (with_sun, &night.sky.sun, sun, &mut sky.sun),
            (with_moon, &night.sky.moon.state, moon, &mut sky.moon),
        ] {
            if let (true, Some(air)) = (shines, &solved) {
                *lit = Some(air.sky_in(state.dir, &night.irradiance(state), of_source));
            }
        }
    }
    if let (true, Some(covered)) = (with_sun, in_shadow_of_moon(night)) {
        let (air, _) = kept.of(&night.air, height_m)?;
        let whole = night.irradiance_without_eclipse(&night.sky.sun);
        if let Some([clockwise, other]) = air.eclipsed_sky(night, &covered, &whole) {
            (sky.sun, sky.sun_left) = (Some(clockwise), Some(other));
        }
    }
    Ok((sky, origin))
}
