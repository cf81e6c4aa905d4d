//! The clear sky: light of the Sun or the Moon, scattered by molecules and aerosol.
//!
//! Spherical air, spectral, all orders of scattering, from a source overhead to one 18 degrees below
//! the horizon. Along each view ray the first order is exact; the higher ones come from moments of
//! the diffuse field, solved once for an atmosphere and a set of wavelengths ([`ScatteringTables`]).
//! The source is a parallel beam: Sun and Moon use the same tables with other angles and spectra.
//!
//! Theory: successive orders in spherical harmonics (Evans 1998, *J. Atmos. Sci.* 55, 429, for the
//! idea of keeping harmonics of the field; Lenoble 1985 for the moments), here about the local
//! vertical and the azimuth of the source, in logarithms.
//!
//! Omitted: polarisation (up to 7 % at 450 nm), refraction of either ray, absorption by oxygen and
//! water, wavelengths under 360 nm.
//!
//! Accuracy, against backward Monte Carlo (`tests/sky_radiance.rs`), median and most: without aerosol
//! 0.15 % and 0.6 % by day, 0.4 % and 1.6 % to 6 degrees below the horizon, 0.9 % and 2.4 % to 12; with
//! aerosol 0.5 % and 1.8 %, 0.8 % and 2.3 %, 2 % and 12 %, the noise of the reference (to 8.5 %)
//! included. Below 14 degrees only its own convergence is known: some per cent.

pub mod above;
mod columns;
mod field;
mod harmonics;
mod lanes;
pub mod phase;
mod profile;
mod rays;
mod reconstruction;
mod solve;
mod view;

use rayon::prelude::*;

use crate::air::{AirError, Atmosphere};
use crate::units::Angle;
use field::Field;
use lanes::{LANES, Lanes};
pub use profile::{EARTH_RADIUS_KM, TOP_KM};
use profile::{Optics, Profile, WAVELENGTH_RANGE_NM};
pub use rays::RaySteps;
use rays::{Geometry, Medium, Ray};
pub use reconstruction::{Matrix, SKY_NODES_NM, reconstruction_matrix};
pub use solve::Directions;
use view::{Source, add_higher_orders, first_order};

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
    /// How view rays are cut.
    pub view: RaySteps,
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
        for s in [&self.first_order.steps, &self.higher_orders.steps, &self.view] {
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
    field: Field,
}

/// The solved diffuse field of an atmosphere at a set of wavelengths.
#[derive(Debug, Clone)]
pub struct ScatteringTables {
    wavelengths_nm: Vec<f64>,
    view: RaySteps,
    geometry: Geometry,
    bands: Vec<Band>,
}

impl ScatteringTables {
    /// Solves for the field. Wavelengths in nm, 360 to 830, in any order; eight cost as much as one.
    pub fn solve(
        air: &Atmosphere,
        wavelengths_nm: &[f64],
        quality: Quality,
    ) -> Result<ScatteringTables, ScatteringError> {
        air.validate()?;
        let resolution = quality.of(air);
        resolution.check()?;
        if wavelengths_nm.is_empty() {
            return Err(ScatteringError::NoWavelengths);
        }
        if let Some(&bad) = wavelengths_nm.iter().find(|nm| !WAVELENGTH_RANGE_NM.contains(*nm)) {
            return Err(ScatteringError::Wavelength(bad));
        }
        let geometry = Geometry::new(Profile::new(air));
        let bands = wavelengths_nm
            .chunks(LANES)
            .map(|chunk| {
                let optics = Optics::new(air, 1.0, chunk);
                let field = solve::solve(&geometry, &optics, &resolution);
                Band { optics, field }
            })
            .collect();
        Ok(ScatteringTables {
            wavelengths_nm: wavelengths_nm.to_vec(),
            view: resolution.view,
            geometry,
            bands,
        })
    }

    /// The wavelengths solved for, nm, in the order of all results.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    fn medium<'a>(&'a self, band: &'a Band) -> Medium<'a> {
        Medium {
            geometry: &self.geometry,
            optics: &band.optics,
            altitudes_km: &band.field.altitudes_km,
            degree: band.field.degree,
        }
    }

    /// Diffuse radiance per unit irradiance of the source outside the air, sr^-1, each wavelength.
    ///
    /// The source itself is not in it; the ground is, below the horizon. The observer's height is
    /// clamped to 0 to [`TOP_KM`]; `azimuth_from_sun` counts from the source, either way round.
    pub fn radiance(
        &self,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        view_elevation: Angle,
        azimuth_from_sun: Angle,
        out: &mut [f64],
    ) {
        let azimuths = [azimuth_from_sun.cos()];
        for (band, out) in self.bands.iter().zip(out.chunks_mut(LANES)) {
            let ray =
                self.along(band, observer_height_km, cos_sun_zenith, view_elevation, &azimuths);
            for (out, value) in out.iter_mut().zip(ray[0].0) {
                *out = f64::from(value);
            }
        }
    }

    /// Radiance in one elevation, for each azimuth, given by its cosine.
    fn along(
        &self,
        band: &Band,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        view_elevation: Angle,
        cos_azimuths: &[f64],
    ) -> Vec<Lanes> {
        let medium = self.medium(band);
        let height_km = observer_height_km.clamp(0.0, TOP_KM);
        let cos_view = view_elevation.sin();
        let ray = Ray::cut(&medium, &self.view, height_km, cos_view);
        let cos_sun_zenith = cos_sun_zenith.clamp(-1.0, 1.0);
        let sources: Vec<Source> =
            cos_azimuths.iter().map(|&a| Source::new(cos_sun_zenith, cos_view, a)).collect();
        let mut out: Vec<Lanes> = sources.iter().map(|&s| first_order(&medium, &ray, s)).collect();
        let mut row = vec![Lanes::ZERO; band.field.row_len()];
        add_higher_orders(&medium, &band.field, &ray, &sources, &mut row, &mut out);
        out
    }

    /// Transmittance of the direct beam from a height to space, each wavelength; 0 if the ground is
    /// in the way. Exact for the layers of the profile; straight rays.
    pub fn transmittance(&self, height_km: f64, cos_zenith: f64, out: &mut [f64]) {
        let columns = columns::to_space(
            &self.geometry.profile,
            height_km.clamp(0.0, TOP_KM),
            cos_zenith.clamp(-1.0, 1.0),
        );
        for (i, out) in out.iter_mut().enumerate().take(self.wavelengths_nm.len()) {
            let extinction = &self.bands[i / LANES].optics.extinction;
            *out = columns.map_or(0.0, |columns| {
                let depth: f64 =
                    columns.iter().zip(extinction).map(|(n, e)| n * e[i % LANES]).sum();
                (-depth).exp()
            });
        }
    }

    /// Irradiance of level ground per unit irradiance of the source outside the air, each
    /// wavelength: that of the sky, and that of the source itself.
    pub fn ground_irradiance(&self, cos_sun_zenith: f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.wavelengths_nm.len();
        let diffuse = self
            .bands
            .iter()
            .flat_map(|band| band.field.ground_irradiance(cos_sun_zenith).0)
            .map(f64::from)
            .take(n)
            .collect();
        let mut direct = vec![0.0; n];
        if cos_sun_zenith > 0.0 {
            self.transmittance(0.0, cos_sun_zenith, &mut direct);
            direct.iter_mut().for_each(|d| *d *= cos_sun_zenith);
        }
        (diffuse, direct)
    }

    /// The sky above the horizontal as a table; `n_az` and `n_el` at least 2.
    pub fn sky_view(
        &self,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        n_az: usize,
        n_el: usize,
    ) -> SkyView {
        let (n_az, n_el) = (n_az.max(2), n_el.max(2));
        let n = self.wavelengths_nm.len();
        let cos_azimuths: Vec<f64> = (0..n_az)
            .map(|i| (std::f64::consts::PI * i as f64 / (n_az - 1) as f64).cos())
            .collect();
        let rows: Vec<Vec<f32>> = (0..n_el)
            .into_par_iter()
            .map(|i| {
                let elevation = SkyView::elevation_of(i as f64 / (n_el - 1) as f64);
                let mut row = vec![0.0; n_az * n];
                for (b, band) in self.bands.iter().enumerate() {
                    let along = self.along(
                        band,
                        observer_height_km,
                        cos_sun_zenith,
                        elevation,
                        &cos_azimuths,
                    );
                    for (out, value) in row.chunks_exact_mut(n).zip(along) {
                        for (out, value) in out[b * LANES..].iter_mut().zip(value.0) {
                            *out = value;
                        }
                    }
                }
                row
            })
            .collect();
        SkyView { n_az, n_el, n_wavelengths: n, radiance: rows.concat() }
    }
}

/// The diffuse sky of one observer and one source: radiance per unit irradiance, sr^-1.
///
/// Rows of elevation `90 t^2` degrees for equal steps of `t`, from the horizontal to the zenith;
/// columns of azimuth from the source, 0 to 180 degrees in equal steps; wavelengths innermost.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyView {
    pub n_az: usize,
    pub n_el: usize,
    pub n_wavelengths: usize,
    pub radiance: Vec<f32>,
}

impl SkyView {
    /// Elevation of a row, `t` from 0 to 1 through the table.
    pub fn elevation_of(t: f64) -> Angle {
        Angle::from_deg(90.0 * t * t)
    }
    /// The inverse of [`SkyView::elevation_of`]; 0 below the horizontal.
    pub fn row_of(elevation: Angle) -> f64 {
        (elevation.deg() / 90.0).clamp(0.0, 1.0).sqrt()
    }

    /// All wavelengths of a node.
    pub fn node(&self, i_el: usize, i_az: usize) -> &[f32] {
        &self.radiance[(i_el * self.n_az + i_az) * self.n_wavelengths..][..self.n_wavelengths]
    }

    /// Bilinear between nodes; the horizontal stands for all below it.
    pub fn sample(&self, elevation: Angle, azimuth_from_sun: Angle, out: &mut [f64]) {
        let place = |t: f64, n: usize| {
            let t = t * (n - 1) as f64;
            let i = (t as usize).min(n - 2);
            (i, (t - i as f64) as f32)
        };
        let (e, te) = place(SkyView::row_of(elevation), self.n_el);
        let (a, ta) = place(azimuth_from_sun.signed().abs().deg() / 180.0, self.n_az);
        let corners =
            [self.node(e, a), self.node(e, a + 1), self.node(e + 1, a), self.node(e + 1, a + 1)];
        for (i, out) in out.iter_mut().enumerate().take(self.n_wavelengths) {
            let low = corners[0][i] + (corners[1][i] - corners[0][i]) * ta;
            let high = corners[2][i] + (corners[3][i] - corners[2][i]) * ta;
            *out = f64::from(low + (high - low) * te);
        }
    }
}
