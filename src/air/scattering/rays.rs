//! A straight ray through the air, cut into steps with exact columns.
//!
//! A step is cut at height levels, at the closest point to the Earth and at a longest length. What
//! it contributes is the source function at its centre of density times
//! `sigma dN T (1 - exp(-dtau)) / dtau`, which is exact for a source function that follows the
//! extinction. These weights know neither azimuth nor source: a ray is cut once and used for all.

use super::columns::{self, SourceColumns, SourceRow};
use super::harmonics::{MAX_COEFFICIENTS, MAX_DEGREE, zonal_part};
use super::lanes::{LANES, Lanes};
use super::profile::{
    EARTH_RADIUS_KM, Optics, Profile, SCATTERERS, SPECIES, SPECIES_OF_SCATTERER, TOP_KM,
};

/// What does not depend on wavelength: layers and the way to the source.
#[derive(Debug, Clone)]
pub(crate) struct Geometry {
    pub profile: Profile,
    pub source: SourceColumns,
}

impl Geometry {
    pub fn new(profile: Profile) -> Geometry {
        let source = SourceColumns::new(&profile);
        Geometry { profile, source }
    }
}

/// How finely a ray is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RaySteps {
    /// Number of height levels, dense near the ground.
    pub levels: usize,
    /// No step is longer.
    pub longest_km: f64,
    /// No step is longer within the lowest 6 km, if there is aerosol.
    pub longest_in_aerosol_km: f64,
}

/// The layer where [`RaySteps::longest_in_aerosol_km`] holds, km.
const AEROSOL_LAYER_KM: f64 = 6.0;
/// Where aerosol scatters less than this part of what molecules do, only the moments that
/// molecules ask for are read.
const NEGLIGIBLE_AEROSOL: f64 = 1e-3;

/// A place between two nodes of a grid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bracket {
    pub index: usize,
    pub weight: f32,
}

impl Bracket {
    /// In ascending nodes; clamped to their ends.
    pub fn of(nodes: &[f64], value: f64) -> Bracket {
        let index = nodes.partition_point(|&n| n <= value).clamp(1, nodes.len() - 1) - 1;
        let (low, high) = (nodes[index], nodes[index + 1]);
        Bracket { index, weight: ((value - low) / (high - low)).clamp(0.0, 1.0) as f32 }
    }
}

/// One step of a ray, seen at its sample point.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    /// From the start of the ray to the sample point.
    pub distance_km: f64,
    /// From the centre of the Earth to the sample point.
    pub r_km: f64,
    /// Cosine between the ray and the vertical there.
    pub cos_view: f64,
    /// Its height, prepared for the columns to the source.
    pub row: SourceRow,
    /// Its height between those of the field.
    pub altitude: Bracket,
    /// Harmonics of the direction of the ray there, but for azimuth.
    pub zonal: [f32; MAX_COEFFICIENTS],
    /// Weight of light scattered by each scatterer, each lane.
    pub weights: [Lanes; SCATTERERS],
    /// By degree: the weights times the moments of the phase functions, summed.
    pub by_degree: [Lanes; MAX_DEGREE + 1],
    /// Whether aerosol counts here.
    pub is_hazy: bool,
}

/// A ray, cut.
#[derive(Debug, Clone)]
pub(crate) struct Ray {
    /// Radius at its start.
    pub r_km: f64,
    /// Cosine of its zenith distance at its start.
    pub cos_zenith: f64,
    pub steps: Vec<Step>,
    /// Transmittance to its end.
    pub transmittance: Lanes,
    /// Length, if it ends on the ground.
    pub ground_km: Option<f64>,
}

/// What a ray is cut in: layers, coefficients, the heights and the degree of the field.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Medium<'a> {
    pub geometry: &'a Geometry,
    pub optics: &'a Optics,
    pub altitudes_km: &'a [f64],
    pub degree: usize,
}

impl Ray {
    pub fn cut(medium: &Medium, rule: &RaySteps, height_km: f64, cos_zenith: f64) -> Ray {
        debug_assert!((0.0..=TOP_KM).contains(&height_km) && cos_zenith.abs() <= 1.0);
        let profile = &medium.geometry.profile;
        let optics = medium.optics;
        let r_km = EARTH_RADIUS_KM + height_km;
        // Distances are counted from the closest point, p from the centre.
        let start = r_km * cos_zenith;
        let p2 = r_km * r_km * (1.0 - cos_zenith * cos_zenith);
        let (cuts, hits_ground) = cuts(rule, optics.has_aerosol, start, p2, r_km);

        let mut depth = [0.0; LANES];
        let mut steps = Vec::with_capacity(cuts.len());
        for ends in cuts.windows(2) {
            let (a, b) = (ends[0], ends[1]);
            let (r_a, r_b) = ((p2 + a * a).sqrt(), (p2 + b * b).sqrt());
            let columns = columns::between(profile, p2, r_a.min(r_b), r_a.max(r_b));
            let at_end = |r: f64| optics.mean_scattering(profile.density(r - EARTH_RADIUS_KM));
            let ((mol_a, aer_a), (mol_b, aer_b)) = (at_end(r_a), at_end(r_b));
            let (rho_a, rho_b) = (mol_a + aer_a, mol_b + aer_b);
            let sample = a + (b - a) * (rho_a + 2.0 * rho_b) / (3.0 * (rho_a + rho_b));
            let r = (p2 + sample * sample).sqrt().max(EARTH_RADIUS_KM);

            let weights = scatter_weights(optics, &columns, &mut depth);
            let cos_view = (sample / r).clamp(-1.0, 1.0);
            steps.push(Step {
                distance_km: sample - start,
                r_km: r,
                cos_view,
                row: medium.geometry.source.row(r - EARTH_RADIUS_KM),
                altitude: Bracket::of(medium.altitudes_km, r - EARTH_RADIUS_KM),
                zonal: zonal_part(medium.degree, cos_view),
                weights,
                by_degree: optics
                    .moments
                    .map(|m| weights[0] * m[0] + weights[1] * m[1] + weights[2] * m[2]),
                is_hazy: aer_a.max(aer_b) > NEGLIGIBLE_AEROSOL * mol_a.min(mol_b),
            });
        }
        Ray {
            r_km,
            cos_zenith,
            steps,
            transmittance: Lanes::from_fn(|i| (-depth[i]).exp()),
            ground_km: hits_ground.then(|| cuts[cuts.len() - 1] - start),
        }
    }

    /// Cosine of the source's zenith distance, a distance along the ray.
    ///
    /// Given that cosine at the start and the cosine `nu` between ray and source.
    #[inline(always)]
    pub fn local_cos_source(&self, distance_km: f64, r_km: f64, cos_source: f64, nu: f64) -> f64 {
        ((self.r_km * cos_source + distance_km * nu) / r_km).clamp(-1.0, 1.0)
    }

    /// Cosine of the source's zenith distance where the ray meets the ground.
    pub fn cos_source_on_ground(&self, length_km: f64, cos_source: f64, nu: f64) -> f64 {
        self.local_cos_source(length_km, EARTH_RADIUS_KM, cos_source, nu)
    }
}

/// What one more step scatters towards the start of the ray; adds its optical depth.
fn scatter_weights(
    optics: &Optics,
    columns: &[f64; SPECIES],
    depth: &mut [f64; LANES],
) -> [Lanes; SCATTERERS] {
    let mut weights = [[0.0; LANES]; SCATTERERS];
    for i in 0..LANES {
        let parts: [f64; SPECIES] = std::array::from_fn(|k| optics.extinction[k][i] * columns[k]);
        let step_depth: f64 = parts.iter().sum();
        let mean = if step_depth > 1e-9 { -(-step_depth).exp_m1() / step_depth } else { 1.0 };
        let weight = (-depth[i]).exp() * mean;
        for k in 0..SCATTERERS {
            weights[k][i] = parts[SPECIES_OF_SCATTERER[k]] * weight * optics.albedo[k][i];
        }
        depth[i] += step_depth;
    }
    weights.map(|w| Lanes::from_fn(|i| w[i]))
}

/// Where a ray is cut, as distances from its closest point, ascending from `start`; and whether it
/// ends on the ground.
fn cuts(rule: &RaySteps, has_aerosol: bool, start: f64, p2: f64, r_km: f64) -> (Vec<f64>, bool) {
    let at_radius = |r: f64| (r * r - p2).max(0.0).sqrt();
    let levels: Vec<f64> = (0..=rule.levels)
        .map(|i| {
            let t = i as f64 / rule.levels as f64;
            EARTH_RADIUS_KM + TOP_KM * (0.06 * t + 0.94 * t.powf(2.2))
        })
        .collect();
    const SAME_KM: f64 = 1e-6;
    let hits_ground = start < 0.0 && p2 < EARTH_RADIUS_KM * EARTH_RADIUS_KM;
    let mut coarse = vec![start];
    if start < 0.0 {
        let lowest = if hits_ground { EARTH_RADIUS_KM } else { p2.sqrt() };
        let between = |r: &&f64| **r < r_km - SAME_KM && **r > lowest + SAME_KM;
        coarse.extend(levels.iter().rev().filter(between).map(|&r| -at_radius(r)));
        coarse.push(if hits_ground { -at_radius(EARTH_RADIUS_KM) } else { 0.0 });
    }
    if !hits_ground {
        let lowest = if start < 0.0 { p2.sqrt() } else { r_km };
        coarse.extend(levels.iter().filter(|r| **r > lowest + SAME_KM).map(|&r| at_radius(r)));
    }

    let mut cuts = vec![start];
    for ends in coarse.windows(2) {
        let (a, b) = (ends[0], ends[1]);
        if b - a < SAME_KM {
            continue;
        }
        let low_km = (p2 + a.abs().min(b.abs()).powi(2)).sqrt() - EARTH_RADIUS_KM;
        let longest = if has_aerosol && low_km < AEROSOL_LAYER_KM {
            rule.longest_in_aerosol_km
        } else {
            rule.longest_km
        };
        let parts = ((b - a) / longest).ceil().max(1.0);
        cuts.extend((1..=parts as usize).map(|k| a + (b - a) * k as f64 / parts));
    }
    // A ray that starts on the ground and points down has no length.
    (cuts, hits_ground)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::Atmosphere;

    const RULE: RaySteps = RaySteps { levels: 30, longest_km: 40.0, longest_in_aerosol_km: 5.0 };

    fn with_medium(air: &Atmosphere, test: impl Fn(&Medium)) {
        let geometry = Geometry::new(Profile::new(air));
        let optics = Optics::new(air, 1.0, &[450.0, 550.0]);
        let altitudes_km = [0.0, 10.0, 50.0, TOP_KM];
        test(&Medium {
            geometry: &geometry,
            optics: &optics,
            altitudes_km: &altitudes_km,
            degree: 2,
        });
    }

    #[test]
    fn what_is_not_transmitted_is_scattered_where_nothing_absorbs() {
        let mut air = Atmosphere::default();
        air.ozone.column_du = 0.0;
        air.aerosol.single_scattering_albedo = Some(1.0);
        with_medium(&air, |medium| {
            for (height, mu) in [(0.0, 1.0), (0.0, 0.0), (3.0, -0.5), (20.0, -0.06), (119.0, -0.1)]
            {
                let ray = Ray::cut(medium, &RULE, height, mu);
                let mut sum = ray.transmittance;
                for step in &ray.steps {
                    step.weights.iter().for_each(|&weight| sum += weight);
                }
                for value in sum.0 {
                    assert!((value - 1.0).abs() < 1e-5, "{height} km, {mu}: {value}");
                }
            }
        });
    }

    #[test]
    fn transmittance_is_that_of_the_columns() {
        with_medium(&Atmosphere::default(), |medium| {
            for (height, mu) in [(0.0, 0.3), (2.0, 0.0), (40.0, -0.08)] {
                let ray = Ray::cut(medium, &RULE, height, mu);
                let columns = columns::to_space(&medium.geometry.profile, height, mu).unwrap();
                let depth: f64 =
                    (0..SPECIES).map(|k| columns[k] * medium.optics.extinction[k][0]).sum();
                assert!((f64::from(ray.transmittance.0[0]) - (-depth).exp()).abs() < 1e-6);
                assert!(ray.ground_km.is_none());
            }
        });
    }

    #[test]
    fn rays_meet_the_ground_where_they_should() {
        with_medium(&Atmosphere::default(), |medium| {
            let down = Ray::cut(medium, &RULE, 10.0, -1.0);
            assert!((down.ground_km.unwrap() - 10.0).abs() < 1e-9);
            let at_once = Ray::cut(medium, &RULE, 0.0, -0.3);
            assert!(at_once.ground_km.unwrap().abs() < 1e-9 && at_once.steps.is_empty());
            // The horizon of 10 km lies 3.2 degrees below level.
            assert!(Ray::cut(medium, &RULE, 10.0, -0.055).ground_km.is_none());
            assert!(Ray::cut(medium, &RULE, 10.0, -0.057).ground_km.is_some());
        });
    }
}
