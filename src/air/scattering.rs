//! The clear sky: light of the Sun or the Moon, scattered by molecules and aerosol.
//!
//! Spherical air, spectral, all orders of scattering, from a source overhead to one 18 degrees below
//! the horizon. Along each view ray the first order is exact; the higher ones come from moments of
//! the diffuse field, solved once for an atmosphere and a set of wavelengths ([`ScatteringTables`]).
//! Sun and Moon use the same tables with other angles and spectra; light that comes from all of the sky
//! (airglow, starlight) goes through the same operator in [`above`].
//!
//! Theory: successive orders in spherical harmonics (Evans 1998, *J. Atmos. Sci.* 55, 429, for the
//! idea of keeping harmonics of the field; Lenoble 1985 for the moments), here about the local
//! vertical and the azimuth of the source, in logarithms. Rays of the source are bent, its beam is spread
//! by the bending, and it is a disc with a darkened limb that sets bit by bit; view rays are bent. The
//! light that aerosols scatter once is kept apart from the rest, over its phase function, so that the
//! aureole is as sharp as the phase function is.
//!
//! Omitted: polarisation (up to 7 % at 450 nm), bending between two orders of scattering, dispersion of
//! the light that is scattered, absorption by oxygen and water, wavelengths under 360 nm.
//!
//! Accuracy of the render tier, against backward Monte Carlo of straight rays, its noise included, median
//! and most (`cargo bench --bench air` prints it beside the cost): without aerosol 0.15 % and 0.3 % by
//! day, 0.4 % and 1.5 % to 6 degrees below the horizon, 0.8 % and 2.4 % to 12; with aerosol 0.5 % and
//! 1.6 %, 0.9 % and 2.3 %, 1.6 % and 10 %. Below 14 degrees only its own convergence is known: some per
//! cent. X, Y, Z and V out of eight wavelengths: within 1 % of a spectrum in steps of 5 nm
//! (`tests/sky_colours.rs`). Refracted twilight has no reference here but measured skies
//! (`tests/twilight.rs`) and a second integration of the source term (`source/tests.rs`).

pub mod above;
pub mod below;
pub(super) mod columns;
mod field;
mod ground;
mod harmonics;
pub(super) mod lanes;
mod path;
pub(in crate::air) mod profile;
mod rays;
mod reconstruction;
pub mod shaded;
mod sky_view;
mod solve;
mod source;
mod view;

use rayon::prelude::*;

use crate::air::{AirError, Atmosphere};
use crate::background::Interrupt;
use crate::store::{Key, Store};
use crate::units::Angle;
use field::Field;
use ground::DirectOnGround;
use lanes::{LANES, Lanes};
pub use profile::{EARTH_RADIUS_KM, TOP_KM};
use profile::{Optics, WAVELENGTH_RANGE_NM};
pub use rays::RaySteps;
use rays::{Geometry, Medium, Ray, Source};
pub use reconstruction::{Matrix, SKY_NODES_NM, SUMS, SpectralSums, reconstruction_matrix};
pub use sky_view::{PHASE_VALUES, Phase, SkyRays, SkyShape, SkyView, turn};
pub use solve::Directions;
use source::{Beams, SourceTable};
use view::{FirstOrder, add_higher_orders, first_order};

/// Apparent elevation of the horizon that an eye sees, without solving for any light: the eye and the
/// observer, at whom the pressure of the air is given, by height above sea level.
pub fn horizon(air: &Atmosphere, height_m: f64, eye_km: f64) -> Angle {
    let geometry = Geometry::of(air, height_m);
    geometry.horizon(eye_km.clamp(geometry.ground_km, TOP_KM))
}

/// Why no tables could be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScatteringError {
    #[error(transparent)]
    Air(#[from] AirError),
    #[error("air: wavelength {0} nm has no cross-sections here, give one from 360 to 830 nm")]
    Wavelength(f64),
    #[error("air: no wavelengths given, give at least one")]
    NoWavelengths,
    #[error("air: {0}")]
    Resolution(&'static str),
    #[error("air: the work was interrupted; ask again")]
    Interrupted,
}

impl ScatteringError {
    /// That there are wavelengths, and that all of them have cross-sections.
    pub(super) fn check_wavelengths(wavelengths_nm: &[f64]) -> Result<(), ScatteringError> {
        if wavelengths_nm.is_empty() {
            return Err(ScatteringError::NoWavelengths);
        }
        match wavelengths_nm.iter().find(|nm| !WAVELENGTH_RANGE_NM.contains(*nm)) {
            Some(&bad) => Err(ScatteringError::Wavelength(bad)),
            None => Ok(()),
        }
    }
}

/// Sizes of the tables of one kind of air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Highest degree of the harmonics, 2 to 8.
    pub degree: usize,
    /// Heights at which the field is known.
    pub altitudes: usize,
    /// Directions in which a node sees the first order.
    pub first_order: Directions,
    /// Directions in which a node sees the field, each iteration.
    pub higher_orders: Directions,
    /// The iteration ends when no mean radiance changes by more than this part.
    pub tolerance: f32,
    /// How view rays are cut for light of the source, and for light of the field.
    pub view: RaySteps,
    pub view_field: RaySteps,
}

/// How good tables are to be: one size for air with aerosol, one for air without.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    pub with_aerosol: Resolution,
    pub molecular: Resolution,
}

impl Quality {
    /// For pictures: degree 8 with aerosol, 2 without, which is all that molecules ask for.
    pub const RENDER: Quality = Quality {
        with_aerosol: Resolution {
            degree: 8,
            altitudes: 28,
            first_order: Directions {
                above: 16,
                below: 8,
                azimuths: 9,
                steps: steps(60, 20.0, 20.0),
            },
            higher_orders: Directions {
                above: 10,
                below: 5,
                azimuths: 6,
                steps: steps(14, 50.0, 50.0),
            },
            tolerance: 5e-3,
            view: steps(80, 20.0, 3.0),
            view_field: steps(40, 40.0, 10.0),
        },
        molecular: Resolution {
            degree: 2,
            altitudes: 28,
            first_order: Directions {
                above: 12,
                below: 6,
                azimuths: 8,
                steps: steps(60, 20.0, 20.0),
            },
            higher_orders: Directions {
                above: 6,
                below: 3,
                azimuths: 4,
                steps: steps(14, 50.0, 50.0),
            },
            tolerance: 5e-3,
            view: steps(80, 20.0, 20.0),
            view_field: steps(40, 40.0, 40.0),
        },
    };
    /// For a quick look: degree 4 with aerosol, some per cent by day, 10 % or more in deep twilight.
    pub const PREVIEW: Quality = Quality {
        with_aerosol: Resolution {
            degree: 4,
            altitudes: 18,
            first_order: Directions {
                above: 12,
                below: 6,
                azimuths: 6,
                steps: steps(30, 40.0, 40.0),
            },
            higher_orders: Directions {
                above: 6,
                below: 3,
                azimuths: 4,
                steps: steps(12, 60.0, 60.0),
            },
            tolerance: 1e-2,
            view: steps(32, 50.0, 6.0),
            view_field: steps(20, 60.0, 20.0),
        },
        molecular: Resolution {
            degree: 2,
            altitudes: 16,
            first_order: Directions {
                above: 8,
                below: 4,
                azimuths: 4,
                steps: steps(30, 40.0, 40.0),
            },
            higher_orders: Directions {
                above: 6,
                below: 3,
                azimuths: 4,
                steps: steps(12, 60.0, 60.0),
            },
            tolerance: 1e-2,
            view: steps(32, 50.0, 50.0),
            view_field: steps(20, 60.0, 60.0),
        },
    };

    fn of(&self, air: &Atmosphere) -> Resolution {
        if air.aerosols().iter().any(Option::is_some) { self.with_aerosol } else { self.molecular }
    }
}

const fn steps(levels: usize, longest_km: f64, longest_in_aerosol_km: f64) -> RaySteps {
    RaySteps { levels, longest_km, longest_in_aerosol_km }
}

impl Resolution {
    fn check(&self) -> Result<(), ScatteringError> {
        let refuse = |why| Err(ScatteringError::Resolution(why));
        if !(2..=harmonics::MAX_DEGREE).contains(&self.degree) {
            return refuse("the degree of the harmonics must lie between 2 and 8");
        }
        if self.altitudes < 2 {
            return refuse("the field needs at least 2 altitudes");
        }
        if self.tolerance.is_nan() || self.tolerance <= 0.0 {
            return refuse("the tolerance of the iteration must be above 0");
        }
        for d in [&self.first_order, &self.higher_orders] {
            if d.above == 0 || d.below == 0 || d.azimuths < 3 {
                return refuse(
                    "a node needs directions above and below the horizon, and 3 azimuths",
                );
            }
        }
        for s in [&self.first_order.steps, &self.higher_orders.steps, &self.view, &self.view_field]
        {
            let is_length = |km: f64| km.is_finite() && km > 0.0;
            if s.levels == 0 || !is_length(s.longest_km) || !is_length(s.longest_in_aerosol_km) {
                return refuse("rays need at least one level and steps longer than 0 km");
            }
        }
        Ok(())
    }
}

/// Up to eight wavelengths that are solved together.
#[derive(Debug, Clone)]
struct Band {
    optics: Optics,
    source: SourceTable,
    on_ground: DirectOnGround,
    field: Field,
}

/// Changes whenever the same air is solved to other numbers: what is stored is then left alone.
const VERSION: &str = "diffuse field 1";
/// Angular radius of the Sun at its mean distance, and near enough of the Moon, if a source is a disc.
const DISC_RADIUS: Angle = Angle::from_deg(0.2666);
/// Refractivity of air at sea level in the US Standard Atmosphere, at 550 nm (Edlen 1966).
const SEA_LEVEL_REFRACTIVITY: f64 = 2.777e-4;

/// The solved diffuse field of an atmosphere at a set of wavelengths.
#[derive(Debug, Clone)]
pub struct ScatteringTables {
    wavelengths_nm: Vec<f64>,
    resolution: Resolution,
    geometry: Geometry,
    beams: Beams,
    bands: Vec<Band>,
    /// What sky views divide the light of haze by.
    phase: Option<Phase>,
    is_from_store: bool,
}

/// The rays of one observer, cut once for all sources.
#[derive(Debug, Clone)]
pub struct ViewRays {
    height_km: f64,
    /// By elevation, then by band.
    rays: Vec<Vec<Ray>>,
}

/// Radiance per unit irradiance of the source, a band of wavelengths.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ViewLight {
    /// All but the light that aerosols scatter once.
    pub smooth: Lanes,
    /// What aerosols scatter once: the aureole.
    pub haze: Lanes,
}

impl ScatteringTables {
    /// Solves for the field over ground at sea level, or at the height that the air names.
    ///
    /// Wavelengths in nm, 360 to 830, in any order; eight cost as much as one.
    pub fn solve(
        air: &Atmosphere,
        wavelengths_nm: &[f64],
        quality: Quality,
    ) -> Result<ScatteringTables, ScatteringError> {
        let height_m = air.ground.height_m.unwrap_or(0.0);
        ScatteringTables::for_observer(air, height_m, wavelengths_nm, quality)
    }

    /// Solves for the field around an observer of a height above sea level, metres: the pressure of the
    /// air is given for there, and the ground may lie as high.
    pub fn for_observer(
        air: &Atmosphere,
        height_m: f64,
        wavelengths_nm: &[f64],
        quality: Quality,
    ) -> Result<ScatteringTables, ScatteringError> {
        let never = Interrupt::default();
        let tables =
            ScatteringTables::stored(air, height_m, wavelengths_nm, quality, &Store::NONE, &never)?;
        tables.ok_or(ScatteringError::Interrupted)
    }

    /// The same, taken from the store if it has been solved before and kept there if not; none if it
    /// was interrupted.
    pub fn stored(
        air: &Atmosphere,
        height_m: f64,
        wavelengths_nm: &[f64],
        quality: Quality,
        store: &Store,
        interrupt: &Interrupt,
    ) -> Result<Option<ScatteringTables>, ScatteringError> {
        air.validate()?;
        let resolution = quality.of(air);
        resolution.check()?;
        ScatteringError::check_wavelengths(wavelengths_nm)?;
        let density_ratio = air.density_ratio_at(height_m);
        let geometry = Geometry::of(air, height_m);
        let Geometry { ground_km, refractivity, .. } = geometry;
        let disc_radius = if air.paths.source_disc { DISC_RADIUS } else { Angle::ZERO };
        let beams = Beams::new(&geometry.profile, ground_km, refractivity, disc_radius);
        let straight = geometry.straight();
        let mut bands = Vec::with_capacity(wavelengths_nm.len().div_ceil(LANES));
        let mut is_from_store = true;
        for chunk in wavelengths_nm.chunks(LANES) {
            let optics = Optics::new(air, density_ratio, chunk);
            let source = SourceTable::new(&beams, &optics);
            let on_ground = DirectOnGround::new(&beams, &source, ground_km);
            let mut field = Field::new(resolution.degree, ground_km, resolution.altitudes);
            let key = Key::of(&[
                VERSION.as_bytes(),
                // All that the field depends on, in words: numbers as they are written are exact.
                format!("{:?} {:?}", air.aerosols(), air.ozone).as_bytes(),
                format!("{ground_km} {} {:?}", air.ground.albedo, air.paths).as_bytes(),
                format!("{density_ratio} {chunk:?} {resolution:?}").as_bytes(),
            ]);
            let kept = store.get(&key).filter(|block| block.len() == 4 * field.solved_len());
            if let Some(block) = kept {
                let numbers = block.as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b));
                field.restore(numbers);
            } else {
                let altitudes_km = field.altitudes_km.clone();
                let medium = Medium {
                    geometry: &straight,
                    optics: &optics,
                    source: &source,
                    on_ground: &on_ground,
                    altitudes_km: &altitudes_km,
                    degree: resolution.degree,
                };
                let Some(solved) = solve::solve(&medium, field, &resolution, interrupt) else {
                    return Ok(None);
                };
                field = solved;
                is_from_store = false;
                let block: Vec<u8> = field.solved().flat_map(f32::to_le_bytes).collect();
                store.put(&key, &block);
            }
            bands.push(Band { optics, source, on_ground, field });
        }
        Ok(Some(ScatteringTables {
            wavelengths_nm: wavelengths_nm.to_vec(),
            resolution,
            geometry,
            beams,
            bands,
            phase: Phase::of(air),
            is_from_store,
        }))
    }

    /// Whether nothing had to be solved: all of the field was in the store.
    pub fn is_from_store(&self) -> bool {
        self.is_from_store
    }

    /// The wavelengths solved for, nm, in the order of all results.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// Height of the ground above sea level, kilometres.
    pub fn ground_km(&self) -> f64 {
        self.geometry.ground_km
    }

    /// Apparent elevation of the horizon from a height, kilometres above sea level.
    pub fn horizon(&self, height_km: f64) -> Angle {
        let height_km = height_km.clamp(self.geometry.ground_km, TOP_KM);
        self.geometry.horizon(height_km)
    }

    fn medium<'a>(&'a self, band: &'a Band) -> Medium<'a> {
        Medium {
            geometry: &self.geometry,
            optics: &band.optics,
            source: &band.source,
            on_ground: &band.on_ground,
            altitudes_km: &band.field.altitudes_km,
            degree: band.field.degree,
        }
    }

    /// Cuts the rays of an observer, by apparent elevation; his height is clamped to the air.
    pub fn view_rays(&self, observer_height_km: f64, elevations: &[Angle]) -> ViewRays {
        let height_km = observer_height_km.clamp(self.geometry.ground_km, TOP_KM);
        let rays = elevations
            .par_iter()
            .map(|elevation| {
                let Resolution { view, view_field, .. } = &self.resolution;
                let cut = |band| {
                    Ray::cut(&self.medium(band), view, view_field, height_km, elevation.sin())
                };
                self.bands.iter().map(cut).collect()
            })
            .collect();
        ViewRays { height_km, rays }
    }

    /// Light along the rays of one elevation, for each azimuth, given by its cosine, of one band.
    pub(crate) fn along(
        &self,
        rays: &ViewRays,
        row: usize,
        band: usize,
        cos_sun_zenith: f64,
        cos_azimuths: &[f64],
    ) -> Vec<ViewLight> {
        let ray = &rays.rays[row][band];
        let band = &self.bands[band];
        let medium = self.medium(band);
        let cos_sun = cos_sun_zenith.clamp(-1.0, 1.0);
        let raised = self.beams.refraction(rays.height_km, cos_sun);
        let sources: Vec<Source> = cos_azimuths
            .iter()
            .map(|&a| Source::new(cos_sun, ray.cos_zenith, a).raised(raised, ray.cos_zenith, a))
            .collect();
        let first = first_order(&medium, ray, &sources);
        let mut smooth: Vec<Lanes> = first.iter().map(|light| light.smooth).collect();
        let mut scratch = band.field.step_field();
        add_higher_orders(&medium, &band.field, ray, &sources, &mut scratch, &mut smooth);
        let join = |(smooth, first): (Lanes, &FirstOrder)| ViewLight { smooth, haze: first.haze };
        smooth.into_iter().zip(&first).map(join).collect()
    }

    /// Diffuse radiance per unit irradiance of the source outside the air, sr^-1, each wavelength.
    ///
    /// The source itself is not in it; the ground is, below the horizon. The zenith distance of the
    /// source is the true one, the elevation of the view the apparent one. The observer's height is
    /// clamped to the air; `azimuth_from_sun` counts from the source, either way round.
    pub fn radiance(
        &self,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        view_elevation: Angle,
        azimuth_from_sun: Angle,
        out: &mut [f64],
    ) {
        let rays = self.view_rays(observer_height_km, &[view_elevation]);
        let azimuths = [azimuth_from_sun.cos()];
        for (band, out) in out.chunks_mut(LANES).enumerate().take(self.bands.len()) {
            let light = self.along(&rays, 0, band, cos_sun_zenith, &azimuths)[0];
            for (out, value) in out.iter_mut().zip((light.smooth + light.haze).0) {
                *out = f64::from(value);
            }
        }
    }

    /// Light of the source itself that arrives at a height, per unit irradiance outside the air, each
    /// wavelength, on a plane that faces it: less than what the air lets through where it spreads the
    /// beam, and what is left of the disc when it sets.
    pub fn direct_irradiance(&self, height_km: f64, cos_zenith: f64, out: &mut [f64]) {
        for (band, out) in self.bands.iter().zip(out.chunks_mut(LANES)) {
            let row = band.source.row(height_km.clamp(self.geometry.ground_km, TOP_KM));
            let arriving = band.source.irradiance(&row, cos_zenith.clamp(-1.0, 1.0));
            for (out, value) in out.iter_mut().zip(arriving.0) {
                *out = f64::from(value);
            }
        }
    }

    /// Irradiance of level ground per unit irradiance of the source outside the air, each
    /// wavelength: that of the sky, and that of the source itself.
    pub fn ground_irradiance(&self, cos_sun_zenith: f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.wavelengths_nm.len();
        let cosine = cos_sun_zenith.clamp(-1.0, 1.0);
        let all = |of_band: &dyn Fn(&Band) -> Lanes| -> Vec<f64> {
            let lanes = self.bands.iter().flat_map(|band| of_band(band).0);
            lanes.map(f64::from).take(n).collect()
        };
        let diffuse = all(&|band| band.field.ground_irradiance(cosine));
        let direct = all(&|band| band.on_ground.at(cosine));
        (diffuse, direct)
    }
}
