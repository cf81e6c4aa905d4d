//! Light that falls on the air from all of the sky: airglow, starlight, zodiacal light.
//!
//! Attenuated and scattered, all orders, over Lambert ground. Air and ground look the same in every
//! azimuth, so an order `cos(m phi)` of the sky about the local zenith makes the same order of the
//! field, and knows no angle of a source: for each `m` the moments of the field are a few numbers at
//! a few heights, the solution of a small linear system (`operator`). [`DiffuseTables`] holds these
//! systems; a sky becomes a [`DiffuseField`], which answers for any height and direction.
//!
//! Two ways to say what shines:
//!
//! - [`DiffuseTables::lit_from`] takes a function of height and zenith distance: any sky that is the
//!   same in every azimuth, without expansion. A glowing layer of the air (airglow, 87 to 97 km) is
//!   such a sky, as it is spherical itself: van Rhijn's law ([`glowing_layer`]) is its radiance along
//!   a line, at every height and place below it. Its light is taken as if it came from outside; the
//!   air above 87 km scatters under a millionth of it.
//! - [`DiffuseTables::lit_by`] takes a distant sky of any shape as harmonics ([`SkyHarmonics`]).
//!
//! Omitted: polarisation. For a distant sky, that the zenith elsewhere is another: the air at a
//! distance `s` along the view is taken to lie under the same sky as the observer, turned by `s / R`
//! (a degree in 110 km; what is scattered into a low view comes from some 100 km away). An even sky
//! and airglow know no such error.
//!
//! The phase functions of aerosols are cut at the degree of [`DiffuseQuality`].

use std::sync::Arc;

mod legendre;
mod operator;
mod path;
mod sky;

use self::operator::{MOLECULAR_DEGREE, Nodes, Operators, Rule, reflectance};
use self::path::{Air, Path};
pub use self::sky::SkyHarmonics;
use super::ScatteringError;
use super::field::altitude_grid_km;
use super::lanes::{LANES, Lanes};
use super::profile::{Optics, SCATTERERS, TOP_KM, WAVELENGTH_RANGE_NM};
use super::rays::{Geometry, RaySteps};
use crate::air::{Atmosphere, EARTH_RADIUS_KM, phase};
use crate::units::Angle;

/// Where aerosol scatters less than this part of what molecules do, their degrees suffice.
const NEGLIGIBLE_AEROSOL: f64 = 1e-3;
/// Van Rhijn's factor ends here: a layer seen edge on has a thickness.
const LONGEST_PATH: f64 = 10.0;

/// How good the answer is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiffuseQuality {
    /// Highest degree of the harmonics in air with aerosol, 2 to 40.
    pub degree: usize,
    /// Highest order in azimuth of the skies to come, to 8: 0 if they are alike in all azimuths.
    pub order: usize,
    /// Heights at which the field is known.
    pub altitudes: usize,
    /// Zenith distances in which a height looks, above and below the horizon; more than the degree,
    /// so that moments of an even light are exact.
    pub above: usize,
    pub below: usize,
    /// How rays between nodes are cut, and view rays.
    pub steps: RaySteps,
    pub view: RaySteps,
}

impl DiffuseQuality {
    /// For skies of any shape: 0.3 % in clear air, 1 % in thick haze.
    pub const RENDER: DiffuseQuality = DiffuseQuality {
        degree: 12,
        order: SkyHarmonics::DEGREE,
        altitudes: 40,
        above: 16,
        below: 13,
        steps: RaySteps { levels: 40, longest_km: 30.0, longest_in_aerosol_km: 10.0 },
        view: RaySteps { levels: 60, longest_km: 20.0, longest_in_aerosol_km: 3.0 },
    };
    /// For skies that are the same in every azimuth, in a hurry: 1 % in clear air, 3 % in thick haze.
    pub const AXIAL: DiffuseQuality = DiffuseQuality {
        degree: 10,
        order: 0,
        altitudes: 28,
        above: 12,
        below: 11,
        steps: RaySteps { levels: 24, longest_km: 40.0, longest_in_aerosol_km: 20.0 },
        view: RaySteps { levels: 40, longest_km: 30.0, longest_in_aerosol_km: 6.0 },
    };
}

impl DiffuseQuality {
    fn check(&self) -> Result<(), ScatteringError> {
        let refuse = |why| Err(ScatteringError::Resolution(why));
        if !(MOLECULAR_DEGREE..=40).contains(&self.degree) {
            return refuse("the degree of a field from above must lie between 2 and 40");
        }
        if self.order > SkyHarmonics::DEGREE {
            return refuse("the order of a sky must lie between 0 and 8");
        }
        if self.altitudes < 2 || self.above.min(self.below) <= self.degree {
            return refuse(
                "a field from above needs 2 altitudes, and more directions above and below the \
                 horizon than its degree",
            );
        }
        for s in [&self.steps, &self.view] {
            let is_length = |km: f64| km.is_finite() && km > 0.0;
            if s.levels == 0 || !is_length(s.longest_km) || !is_length(s.longest_in_aerosol_km) {
                return refuse("rays need at least one level and steps longer than 0 km");
            }
        }
        Ok(())
    }
}

/// Radiance of a thin glowing layer relative to that of its zenith, after van Rhijn 1921:
/// `(1 - (r sin z / (R + h))^2)^(-1/2)` seen from a height below it; 10 at most.
pub fn glowing_layer(layer_height_km: f64) -> impl Fn(f64, f64) -> f64 + Sync {
    move |height_km, cos_zenith| {
        let ratio = (EARTH_RADIUS_KM + height_km) / (EARTH_RADIUS_KM + layer_height_km);
        let sine2 = ratio * ratio * (1.0 - cos_zenith * cos_zenith);
        (1.0 - sine2).max(LONGEST_PATH.powi(-2)).powf(-0.5)
    }
}

/// Up to eight wavelengths that are solved together.
#[derive(Debug, Clone)]
struct Band {
    optics: Optics,
    operators: Operators,
}

/// What the air makes of light from above, at a set of wavelengths. Cheap to clone.
#[derive(Debug, Clone)]
pub struct DiffuseTables {
    solved: Arc<Solved>,
}

#[derive(Debug)]
struct Solved {
    wavelengths_nm: Vec<f64>,
    geometry: Geometry,
    view: RaySteps,
    bands: Vec<Band>,
}

impl DiffuseTables {
    /// For the air over an observer of a height in metres. Wavelengths in nm, 360 to 830, in any
    /// order; eight cost as much as one.
    pub fn solve(
        air: &Atmosphere,
        observer_height_m: f64,
        wavelengths_nm: &[f64],
        quality: DiffuseQuality,
    ) -> Result<DiffuseTables, ScatteringError> {
        air.validate()?;
        quality.check()?;
        if wavelengths_nm.is_empty() {
            return Err(ScatteringError::NoWavelengths);
        }
        if let Some(&bad) = wavelengths_nm.iter().find(|nm| !WAVELENGTH_RANGE_NM.contains(*nm)) {
            return Err(ScatteringError::Wavelength(bad));
        }
        let geometry = Geometry::of(air, observer_height_m);
        // As for light of the Sun: the field is solved along straight rays, and seen along bent ones.
        let straight = geometry.straight();
        let density_ratio = air.density_ratio_at(observer_height_m);
        let bands = wavelengths_nm
            .chunks(LANES)
            .map(|chunk| {
                let optics = Optics::new(air, density_ratio, chunk);
                let nodes = nodes(air, &geometry, &optics, chunk, &quality);
                let altitudes_km = nodes.altitudes_km.clone();
                let air = Air { geometry: &straight, optics: &optics, altitudes_km: &altitudes_km };
                let rule =
                    Rule { above: quality.above, below: quality.below, steps: quality.steps };
                let operators = Operators::new(&air, nodes, &rule, quality.order);
                Band { optics, operators }
            })
            .collect();
        let wavelengths_nm = wavelengths_nm.to_vec();
        let solved = Solved { wavelengths_nm, geometry, view: quality.view, bands };
        Ok(DiffuseTables { solved: Arc::new(solved) })
    }

    /// The wavelengths solved for, nm, in the order of all results.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.solved.wavelengths_nm
    }

    /// The field of a light that is the same in every azimuth, given by the radiance that comes from
    /// outside along a line, by a height (km) on it and the cosine of its zenith distance there.
    pub fn lit_from(&self, light: impl Fn(f64, f64) -> f64 + Sync) -> DiffuseField {
        let bands = self
            .solved
            .bands
            .iter()
            .map(|band| vec![OrderField { cos: band.operators.solve(0, &light), sin: None }]);
        DiffuseField { bands: bands.collect(), air: self.solved.clone() }
    }

    /// The field of a distant sky. What it holds above the order of [`DiffuseQuality`] is left out.
    pub fn lit_by(&self, sky: &SkyHarmonics) -> DiffuseField {
        use rayon::prelude::*;
        let bands = self.solved.bands.iter().map(|band| {
            let orders = band.operators.orders.len().min(sky.order() + 1);
            let field = |m: usize| {
                let legendre = legendre::Legendre::new(m, SkyHarmonics::DEGREE);
                let solve = |part: fn((f64, f64)) -> f64| {
                    band.operators.solve(m, |_, cos_zenith| {
                        let mut sum = 0.0;
                        legendre.each(cos_zenith, |l, p| sum += p * part(sky.coefficients(l, m)));
                        sum
                    })
                };
                OrderField { cos: solve(|c| c.0), sin: (m > 0).then(|| solve(|c| c.1)) }
            };
            (0..orders).into_par_iter().map(field).collect()
        });
        DiffuseField { bands: bands.collect(), air: self.solved.clone() }
    }

    /// The ray of a view, cut once for all skies: from a height, which is clamped to the air, in an
    /// apparent elevation.
    pub fn view(&self, height_km: f64, view_elevation: Angle) -> DiffuseView {
        let paths = self.solved.bands.iter().map(|band| {
            let height_km = height_km.clamp(self.solved.geometry.ground_km, TOP_KM);
            let rule = &self.solved.view;
            Path::cut(&self.solved.air(band), rule, height_km, view_elevation.sin())
        });
        DiffuseView { paths: paths.collect() }
    }
}

/// The ray of a view.
#[derive(Debug, Clone)]
pub struct DiffuseView {
    /// By band.
    paths: Vec<Path>,
}

impl DiffuseView {
    /// What part of the light outside arrives unscattered, each wavelength; 0 if the ground is in the
    /// way.
    pub fn transmittance(&self, out: &mut [f64]) {
        for (path, out) in self.paths.iter().zip(out.chunks_mut(LANES)) {
            out.iter_mut().zip(path.passed().0).for_each(|(out, t)| *out = f64::from(t));
        }
    }
}

impl Solved {
    fn air<'a>(&'a self, band: &'a Band) -> Air<'a> {
        let altitudes_km = &band.operators.nodes.altitudes_km;
        Air { geometry: &self.geometry, optics: &band.optics, altitudes_km }
    }
}

/// Heights of the field; high degrees only where aerosol scatters next to them.
fn nodes(
    air: &Atmosphere,
    geometry: &Geometry,
    optics: &Optics,
    wavelengths_nm: &[f64],
    quality: &DiffuseQuality,
) -> Nodes {
    let altitudes_km = altitude_grid_km(geometry.ground_km, quality.altitudes);
    let aerosols = air.aerosols();
    let is_hazy = |from_km: f64, to_km: f64| {
        let samples = ((to_km - from_km) / 0.5).ceil().max(1.0);
        (0..=samples as usize).any(|i| {
            let height_km = from_km + (to_km - from_km) * i as f64 / samples;
            let (molecules, aerosol) = optics.mean_scattering(geometry.profile.density(height_km));
            aerosol > NEGLIGIBLE_AEROSOL * molecules
        })
    };
    let last = altitudes_km.len() - 1;
    let degrees = (0..=last)
        .map(|i| {
            let (from, to) = (altitudes_km[i.saturating_sub(1)], altitudes_km[(i + 1).min(last)]);
            if is_hazy(from, to) { quality.degree } else { MOLECULAR_DEGREE }
        })
        .collect();
    let moment = |l: usize, k: usize, lane: usize| match k {
        0 => phase::rayleigh_moment(l),
        _ => {
            let nm = wavelengths_nm[lane.min(wavelengths_nm.len() - 1)];
            aerosols[k - 1].map_or(0.0, |aerosol| aerosol.moment(nm, l))
        }
    };
    let phases = (0..=quality.degree.max(SkyHarmonics::DEGREE)).map(|l| {
        let of = |k: usize| Lanes::from_fn(|lane| moment(l, k, lane));
        std::array::from_fn::<Lanes, SCATTERERS, _>(of)
    });
    Nodes { phases: phases.collect(), altitudes_km, degrees }
}

/// The moments of one order.
#[derive(Debug, Clone)]
struct OrderField {
    cos: Vec<Lanes>,
    sin: Option<Vec<Lanes>>,
}

/// The light of one sky, everywhere in the air.
#[derive(Debug, Clone)]
pub struct DiffuseField {
    air: Arc<Solved>,
    /// Of each band, by order.
    bands: Vec<Vec<OrderField>>,
}

impl DiffuseField {
    /// Radiance of the air and of the ground along a view, each wavelength, in the unit of the sky.
    /// What comes straight from the sky is not in it: that is the sky times
    /// [`DiffuseView::transmittance`]. The azimuth is that of the harmonics.
    pub fn radiance(&self, view: &DiffuseView, azimuth: Angle, out: &mut [f64]) {
        self.around(view).at(azimuth, out);
    }

    /// The same for all azimuths at once.
    pub fn around(&self, view: &DiffuseView) -> DiffuseRing {
        let bands = self.air.bands.iter().zip(&self.bands).zip(&view.paths);
        let orders = bands.map(|((band, orders), path)| {
            let nodes = &band.operators.nodes;
            let order = |(field, operator): (&OrderField, &operator::Operator)| {
                let mut waves = [Lanes::ZERO; 2];
                operator.layout.along(nodes, path, |place, weight| {
                    waves[0] += weight * field.cos[place];
                    if let Some(sin) = &field.sin {
                        waves[1] += weight * sin[place];
                    }
                });
                if let (true, Some(ground)) = (path.meets_ground, operator.layout.ground) {
                    waves[0] +=
                        path.transmittance * field.cos[ground] * reflectance(&self.air.air(band));
                }
                waves
            };
            orders.iter().zip(&band.operators.orders).map(order).collect()
        });
        DiffuseRing { bands: orders.collect() }
    }

    /// Irradiance of level ground, straight from the sky and by way of the air, each wavelength.
    pub fn ground_irradiance(&self) -> Vec<f64> {
        let ground = self.air.bands.iter().zip(&self.bands).flat_map(|(band, orders)| {
            let layout = &band.operators.orders[0].layout;
            let irradiance = layout.ground.map_or(Lanes::ZERO, |ground| orders[0].cos[ground]);
            irradiance.0.map(f64::from)
        });
        ground.take(self.air.wavelengths_nm.len()).collect()
    }
}

/// Radiance of the air and of the ground along views that differ in azimuth alone: a few waves around
/// the horizon.
#[derive(Debug, Clone)]
pub struct DiffuseRing {
    /// Of each band, by order: what goes with the cosine and with the sine.
    bands: Vec<Vec<[Lanes; 2]>>,
}

impl DiffuseRing {
    /// At an azimuth, each wavelength.
    pub fn at(&self, azimuth: Angle, out: &mut [f64]) {
        for (orders, out) in self.bands.iter().zip(out.chunks_mut(LANES)) {
            let mut sum = Lanes::ZERO;
            for (m, [cos, sin]) in orders.iter().enumerate() {
                let (sine, cosine) = (m as f64 * azimuth.rad()).sin_cos();
                sum += *cos * cosine as f32;
                sum += *sin * sine as f32;
            }
            out.iter_mut().zip(sum.0).for_each(|(out, value)| *out = f64::from(value));
        }
    }

    /// The waves, by order: what goes with the cosine and with the sine, each wavelength.
    pub fn waves(&self) -> Vec<[Vec<f64>; 2]> {
        let orders = self.bands.iter().map(Vec::len).max().unwrap_or(0);
        let wave = |order: usize, part: usize| {
            let lanes = self.bands.iter().flat_map(|orders| match orders.get(order) {
                Some(waves) => waves[part].0,
                None => Lanes::ZERO.0,
            });
            lanes.map(f64::from).collect()
        };
        (0..orders).map(|order| [wave(order, 0), wave(order, 1)]).collect()
    }
}
