//! A ray through the air, cut into steps with exact columns.
//!
//! A step is cut at height levels, at the closest point to the Earth and at a longest length. What
//! it contributes is the source function at its centre of density times
//! `sigma dN T (1 - exp(-dtau)) / dtau`, which is exact for a source function that follows the
//! extinction. These weights know neither azimuth nor source: a ray is cut once and used for all.
//!
//! The rays that an observer sees are bent where the air is to bend light; those along which the
//! field is solved are straight, which changes where its light comes from by less than a step.

use super::ground::DirectOnGround;
use super::harmonics::{MAX_COEFFICIENTS, MAX_DEGREE, zonal_part};
use super::lanes::{LANES, Lanes};
use super::path::Path;
use super::profile::{Optics, Profile, SCATTERERS, SPECIES, SPECIES_OF_SCATTERER, TOP_KM};
use super::source::{SourceRow, SourceTable};
use crate::air::Atmosphere;
use crate::air::EARTH_RADIUS_KM;
use crate::units::Angle;

/// The air as rays meet it.
#[derive(Debug, Clone)]
pub(crate) struct Geometry {
    pub profile: Profile,
    /// Height of the ground above sea level.
    pub ground_km: f64,
    /// Refractivity of the air at sea level; 0 if rays are straight.
    pub refractivity: f64,
}

impl Geometry {
    pub fn ground_radius_km(&self) -> f64 {
        EARTH_RADIUS_KM + self.ground_km
    }
    /// Of the air around an observer of a height above sea level, metres.
    pub fn of(air: &Atmosphere, height_m: f64) -> Geometry {
        let by_density = if air.paths.refracted { super::SEA_LEVEL_REFRACTIVITY } else { 0.0 };
        Geometry {
            profile: Profile::new(air, air.ground_km(height_m)),
            ground_km: air.ground_km(height_m),
            refractivity: by_density * air.density_ratio_at(height_m),
        }
    }
    /// Apparent elevation of the horizon from a height.
    pub fn horizon(&self, height_km: f64) -> Angle {
        let path = |height_km: f64| Path::new(&self.profile, self.refractivity, height_km, 1.0);
        let (here, ground) = (path(height_km).start().u_km, path(self.ground_km).start().u_km);
        let u_km = ((here - ground) * (here + ground)).max(0.0).sqrt();
        Angle::from_rad(-u_km.atan2(ground))
    }
    /// Cosine of the zenith distance of the horizon from a height, for straight rays.
    pub fn cos_horizon(&self, height_km: f64) -> f64 {
        let ratio = self.ground_radius_km() / (EARTH_RADIUS_KM + height_km);
        -(1.0 - ratio * ratio).max(0.0).sqrt()
    }
    /// The same air with straight rays.
    pub fn straight(&self) -> Geometry {
        Geometry { refractivity: 0.0, ..self.clone() }
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

/// Where a ray is, as its sources see it: by how much the vertical has turned since its start, sine and
/// cosine.
pub(crate) type Turn = (f64, f64);

/// One step of a ray, as light is scattered there that comes straight from the source.
#[derive(Debug, Clone)]
pub(crate) struct BeamStep {
    pub turn: Turn,
    /// Its height, prepared for the light of the source.
    pub row: SourceRow,
    /// Weight of light scattered by each scatterer, each lane.
    pub weights: [Lanes; SCATTERERS],
    /// Whether aerosol counts here.
    pub is_hazy: bool,
}

/// One step of a ray, as light of the field is scattered there.
#[derive(Debug, Clone)]
pub(crate) struct FieldStep {
    pub turn: Turn,
    /// Sine of the angle between the ray and the vertical there.
    pub sin_view: f64,
    /// Its height between those of the field.
    pub altitude: Bracket,
    /// Harmonics of the direction of the ray there, but for azimuth.
    pub zonal: [f32; MAX_COEFFICIENTS],
    /// By degree: the weights times the moments of the phase functions, summed over the scatterers.
    pub by_degree: [Lanes; MAX_DEGREE + 1],
    /// Whether aerosol counts here.
    pub is_hazy: bool,
}

/// How a ray ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct End {
    pub transmittance: Lanes,
    /// Where it meets the ground, if it does.
    pub ground: Option<Turn>,
}

/// A ray, cut.
#[derive(Debug, Clone)]
pub(crate) struct Ray {
    /// Cosine of its zenith distance at its start.
    pub cos_zenith: f64,
    pub beam: Vec<BeamStep>,
    pub field: Vec<FieldStep>,
    pub end: End,
}

/// What a ray is cut in: layers, coefficients, the source, the heights and the degree of the field.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Medium<'a> {
    pub geometry: &'a Geometry,
    pub optics: &'a Optics,
    pub source: &'a SourceTable,
    pub on_ground: &'a DirectOnGround,
    pub altitudes_km: &'a [f64],
    pub degree: usize,
}

/// A distant source, seen from the start of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Source {
    pub cos_zenith: f64,
    /// Its part along the horizontal direction that the ray runs in.
    pub level: f64,
    /// Cosine of the angle by which light turns from the source into the ray.
    pub nu: f64,
}

impl Source {
    /// Zenith distances by cosine, and the azimuth between ray and source by its cosine.
    pub fn new(cos_zenith: f64, cos_view: f64, cos_azimuth: f64) -> Source {
        let sine = |cosine: f64| (1.0 - cosine * cosine).max(0.0).sqrt();
        let level = sine(cos_zenith) * cos_azimuth;
        let nu = (cos_zenith * cos_view + level * sine(cos_view)).clamp(-1.0, 1.0);
        Source { cos_zenith, level, nu }
    }

    /// The same source, which is seen higher than it stands: light turns from where it is seen.
    pub fn raised(self, by: Angle, cos_view: f64, cos_azimuth: f64) -> Source {
        if by == Angle::ZERO {
            return self;
        }
        let sine = (1.0 - self.cos_zenith * self.cos_zenith).max(0.0).sqrt();
        let raised = (self.cos_zenith * by.cos() + sine * by.sin()).clamp(-1.0, 1.0);
        Source { nu: Source::new(raised, cos_view, cos_azimuth).nu, ..self }
    }

    /// Cosine of the source's zenith distance where the vertical has turned.
    #[inline(always)]
    pub fn local_cosine(&self, (sin_turn, cos_turn): Turn) -> f64 {
        (cos_turn * self.cos_zenith + sin_turn * self.level).clamp(-1.0, 1.0)
    }

    /// Its part along the local horizontal there.
    #[inline(always)]
    pub fn local_level(&self, (sin_turn, cos_turn): Turn) -> f64 {
        cos_turn * self.level - sin_turn * self.cos_zenith
    }
}

/// A step, before it is known what for.
pub(crate) struct Step {
    pub height_km: f64,
    /// Cosine between the ray and the vertical there.
    pub cos_view: f64,
    pub turn: Turn,
    /// Weight of light scattered by each scatterer.
    pub weights: [Lanes; SCATTERERS],
    /// Whether aerosol counts here.
    pub is_hazy: bool,
}

impl Ray {
    /// Cut for light of the source by one rule, for light of the field by another, coarser one.
    pub fn cut(
        medium: &Medium,
        beam_rule: &RaySteps,
        field_rule: &RaySteps,
        height_km: f64,
        cos_zenith: f64,
    ) -> Ray {
        let beam = Ray::for_beam(medium, beam_rule, height_km, cos_zenith);
        Ray { field: Ray::for_field(medium, field_rule, height_km, cos_zenith).field, ..beam }
    }

    /// Cut for light of the source alone.
    pub fn for_beam(medium: &Medium, rule: &RaySteps, height_km: f64, cos_zenith: f64) -> Ray {
        let mut beam = Vec::new();
        let end = walk(medium.geometry, medium.optics, rule, (height_km, cos_zenith), |step| {
            beam.push(BeamStep {
                turn: step.turn,
                row: medium.source.row(step.height_km),
                weights: step.weights,
                is_hazy: step.is_hazy,
            });
        });
        Ray { cos_zenith, beam, field: Vec::new(), end }
    }

    /// Cut for light of the field alone.
    pub fn for_field(medium: &Medium, rule: &RaySteps, height_km: f64, cos_zenith: f64) -> Ray {
        let mut field = Vec::new();
        let end = walk(medium.geometry, medium.optics, rule, (height_km, cos_zenith), |step| {
            let [a, b, c] = step.weights;
            field.push(FieldStep {
                turn: step.turn,
                sin_view: (1.0 - step.cos_view * step.cos_view).max(0.0).sqrt(),
                altitude: Bracket::of(medium.altitudes_km, step.height_km),
                zonal: zonal_part(medium.degree, step.cos_view),
                by_degree: medium.optics.moments.map(|m| a * m[0] + b * m[1] + c * m[2]),
                is_hazy: step.is_hazy,
            });
        });
        Ray { cos_zenith, beam: Vec::new(), field, end }
    }
}

/// Follows a ray in steps from its start.
pub(crate) fn walk(
    geometry: &Geometry,
    optics: &Optics,
    rule: &RaySteps,
    (height_km, cos_zenith): (f64, f64),
    mut visit: impl FnMut(Step),
) -> End {
    let Geometry { profile, ground_km, refractivity } = geometry;
    let path = Path::new(profile, *refractivity, height_km, cos_zenith);
    let (cuts, hits_ground) = cuts(rule, optics.has_aerosol, &path, *ground_km);
    let end_of = |u_km: f64| {
        let point = path.point(u_km);
        (point, optics.mean_scattering(profile.density(point.height_km)))
    };

    let mut depth = [0.0; LANES];
    let mut turn_rad = 0.0;
    let mut to = end_of(cuts[0]);
    for &cut in &cuts[1..] {
        let from = std::mem::replace(&mut to, end_of(cut));
        let (columns, turned_rad) = path.between(&from.0, &to.0);
        let ((mol_a, aer_a), (mol_b, aer_b)) = (from.1, to.1);
        let (rho_a, rho_b) = (mol_a + aer_a, mol_b + aer_b);
        let share = (rho_a + 2.0 * rho_b) / (3.0 * (rho_a + rho_b));
        let sample = path.point(from.0.u_km + (to.0.u_km - from.0.u_km) * share);
        visit(Step {
            height_km: sample.height_km.clamp(*ground_km, TOP_KM),
            cos_view: path.cosine_at(&sample),
            turn: (turn_rad + turned_rad * share).sin_cos(),
            weights: scatter_weights(optics, &columns, &mut depth),
            is_hazy: aer_a.max(aer_b) > NEGLIGIBLE_AEROSOL * mol_a.min(mol_b),
        });
        turn_rad += turned_rad;
    }
    End {
        transmittance: Lanes::from_fn(|i| (-depth[i]).exp()),
        ground: hits_ground.then(|| turn_rad.sin_cos()),
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

/// Where a ray is cut, as distances from its closest point, ascending from its start; and whether it
/// ends on the ground.
fn cuts(rule: &RaySteps, has_aerosol: bool, path: &Path, ground_km: f64) -> (Vec<f64>, bool) {
    let levels: Vec<f64> = (0..=rule.levels)
        .map(|i| {
            let t = i as f64 / rule.levels as f64;
            ground_km + (TOP_KM - ground_km) * (0.06 * t + 0.94 * t.powf(2.2))
        })
        .collect();
    const SAME_KM: f64 = 1e-6;
    let start = path.start().u_km;
    let start_km = path.start().height_km;
    let lowest_km = path.lowest_km();
    let hits_ground = start < 0.0 && lowest_km < ground_km;
    let mut coarse = vec![start];
    if start < 0.0 {
        let lowest = lowest_km.max(ground_km);
        let between = |h: &&f64| **h < start_km - SAME_KM && **h > lowest + SAME_KM;
        coarse.extend(levels.iter().rev().filter(between).map(|&h| -path.u_at(h)));
        coarse.push(if hits_ground { -path.u_at(ground_km) } else { 0.0 });
    }
    if !hits_ground {
        let lowest = if start < 0.0 { lowest_km } else { start_km };
        coarse.extend(levels.iter().filter(|h| **h > lowest + SAME_KM).map(|&h| path.u_at(h)));
    }

    let mut cuts = vec![start];
    for ends in coarse.windows(2) {
        let (a, b) = (ends[0], ends[1]);
        if b - a < SAME_KM {
            continue;
        }
        let low_km = path.point(if a.abs() < b.abs() { a } else { b }).height_km;
        let longest = if has_aerosol && low_km - ground_km < AEROSOL_LAYER_KM {
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
    use crate::air::scattering::columns;
    use crate::air::scattering::source::Beams;

    const RULE: RaySteps = RaySteps { levels: 30, longest_km: 40.0, longest_in_aerosol_km: 5.0 };

    fn with_medium(air: &Atmosphere, refractivity: f64, test: impl Fn(&Medium)) {
        let geometry = Geometry { profile: Profile::new(air, 0.0), ground_km: 0.0, refractivity };
        let optics = Optics::new(air, 1.0, &[450.0, 550.0]);
        let beams = Beams::new(&geometry.profile, 0.0, refractivity, Angle::ZERO);
        let source = SourceTable::new(&beams, &optics);
        let on_ground = DirectOnGround::new(&beams, &source, 0.0);
        let altitudes_km = [0.0, 10.0, 50.0, TOP_KM];
        test(&Medium {
            geometry: &geometry,
            optics: &optics,
            source: &source,
            on_ground: &on_ground,
            altitudes_km: &altitudes_km,
            degree: 2,
        });
    }

    #[test]
    fn what_is_not_transmitted_is_scattered_where_nothing_absorbs() {
        let mut air = Atmosphere::default();
        air.ozone.column_du = 0.0;
        air.aerosol.single_scattering_albedo = Some(1.0);
        for refractivity in [0.0, 2.8e-4] {
            with_medium(&air, refractivity, |medium| {
                for (height, mu) in
                    [(0.0, 1.0), (0.0, 0.0), (3.0, -0.5), (20.0, -0.06), (119.0, -0.1)]
                {
                    let ray = Ray::for_beam(medium, &RULE, height, mu);
                    let mut sum = ray.end.transmittance;
                    for step in &ray.beam {
                        step.weights.iter().for_each(|&weight| sum += weight);
                    }
                    for value in sum.0 {
                        assert!((value - 1.0).abs() < 1e-5, "{height} km, {mu}: {value}");
                    }
                }
            });
        }
    }

    #[test]
    fn transmittance_is_that_of_the_columns() {
        with_medium(&Atmosphere::default(), 0.0, |medium| {
            for (height, mu) in [(0.0, 0.3), (2.0, 0.0), (40.0, -0.08)] {
                let ray = Ray::for_beam(medium, &RULE, height, mu);
                let columns = columns::to_space(&medium.geometry.profile, height, mu).unwrap();
                let depth: f64 =
                    (0..SPECIES).map(|k| columns[k] * medium.optics.extinction[k][0]).sum();
                assert!((f64::from(ray.end.transmittance.0[0]) - (-depth).exp()).abs() < 1e-6);
                assert!(ray.end.ground.is_none());
            }
        });
    }

    #[test]
    fn rays_meet_the_ground_where_they_should() {
        with_medium(&Atmosphere::default(), 0.0, |medium| {
            let down = Ray::for_beam(medium, &RULE, 10.0, -1.0);
            assert!(down.end.ground.unwrap().0.abs() < 1e-12);
            let aslant = Ray::for_beam(medium, &RULE, 10.0, -0.1);
            // Law of sines: the ray meets the ground at a steeper angle.
            let sin_ground = (1.0f64 - 0.01).sqrt() * 6381.0 / 6371.0;
            let turn = sin_ground.acos() - 0.1f64.asin();
            assert!((aslant.end.ground.unwrap().0 + turn.sin()).abs() < 1e-9, "{turn}");
            let at_once = Ray::for_beam(medium, &RULE, 0.0, -0.3);
            assert!(at_once.end.ground.is_some() && at_once.beam.is_empty());
            // The horizon of 10 km lies 3.2 degrees below level.
            assert!(Ray::for_beam(medium, &RULE, 10.0, -0.055).end.ground.is_none());
            assert!(Ray::for_beam(medium, &RULE, 10.0, -0.057).end.ground.is_some());
            assert!((medium.geometry.horizon(10.0).deg() + 3.2087).abs() < 1e-3);
        });
        with_medium(&Atmosphere::default(), 2.777e-4, |medium| {
            // Bent light comes from further: the horizon is higher.
            assert!(Ray::for_beam(medium, &RULE, 10.0, -0.0535).end.ground.is_some());
            let horizon = medium.geometry.horizon(10.0);
            assert!(Ray::for_beam(medium, &RULE, 10.0, horizon.sin() - 1e-6).end.ground.is_some());
            assert!(Ray::for_beam(medium, &RULE, 10.0, horizon.sin() + 1e-6).end.ground.is_none());
        });
    }

    #[test]
    fn the_source_turns_with_the_vertical() {
        // Half-way round: what was overhead is underfoot.
        let source = Source::new(0.6, 0.0, 1.0);
        let half = (0.0, -1.0);
        assert!((source.local_cosine(half) + 0.6).abs() < 1e-12);
        assert!((source.local_level(half) + 0.8).abs() < 1e-12);
        // Moving towards the source raises it.
        let step = 0.1f64.sin_cos();
        assert!(source.local_cosine(step) > 0.6);
    }
}
