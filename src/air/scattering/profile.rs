//! What the air is made of: densities that are piecewise linear in height, and cross-sections.
//!
//! Four species: molecules, ozone, haze, stratospheric aerosol. Densities are relative, so that the geometry of paths
//! (`columns`) holds for every wavelength and every amount of ozone and aerosol; the coefficients
//! per kilometre at density 1 carry the rest.
//!
//! Molecules: US Standard Atmosphere 1976. Ozone: a tent. Aerosols: sampled each kilometre up to 30 km,
//! each two up to 60, normalised to their columns. Between nodes, all are linear: the
//! reference this is measured against has exactly these layers.

use std::f64::consts::PI;

use super::harmonics::MAX_DEGREE;
use super::lanes::{LANES, Lanes};
use crate::air::Atmosphere;
use crate::air::aerosol::Aerosol;
use crate::air::cross_section::{
    DOBSON_UNIT_PER_M2, ozone_cross_section_m2, rayleigh_cross_section_m2,
};
use crate::air::phase;
pub use crate::air::{AIR_TOP_KM as TOP_KM, EARTH_RADIUS_KM};

/// How many kinds of matter there are, and where each stands.
pub(crate) const SPECIES: usize = 4;
const MOLECULES: usize = 0;
/// The first of the aerosols: haze, then the stratosphere's.
const AEROSOL: usize = 2;
/// How many kinds of matter scatter: molecules and the aerosols.
pub(crate) const SCATTERERS: usize = 3;

/// Height (km), number density of molecules (m^-3). US Standard Atmosphere 1976; its formulas to
/// 86 km, its table above.
const MOLECULE_DENSITY: [(f64, f64); 58] = [
    (0.0, 2.546966e25),
    (1.0, 2.311314e25),
    (2.0, 2.092783e25),
    (3.0, 1.890482e25),
    (4.0, 1.70355e25),
    (5.0, 1.531151e25),
    (6.0, 1.372475e25),
    (7.0, 1.226741e25),
    (8.0, 1.093192e25),
    (9.0, 9.710976e24),
    (10.0, 8.597533e24),
    (11.0, 7.584799e24),
    (12.0, 6.485686e24),
    (13.0, 5.542953e24),
    (14.0, 4.737486e24),
    (15.0, 4.049264e24),
    (16.0, 3.461192e24),
    (17.0, 2.958671e24),
    (18.0, 2.529233e24),
    (19.0, 2.162233e24),
    (20.0, 1.848577e24),
    (21.0, 1.574231e24),
    (22.0, 1.341261e24),
    (23.0, 1.143655e24),
    (24.0, 9.759123e23),
    (25.0, 8.334072e23),
    (26.0, 7.122482e23),
    (27.0, 6.091584e23),
    (28.0, 5.213756e23),
    (29.0, 4.465705e23),
    (30.0, 3.827765e23),
    (32.0, 2.81833e23),
    (34.0, 2.055747e23),
    (36.0, 1.509036e23),
    (38.0, 1.115792e23),
    (40.0, 8.307645e22),
    (42.0, 6.226587e22),
    (44.0, 4.696507e22),
    (46.0, 3.563984e22),
    (48.0, 2.737627e22),
    (50.0, 2.135041e22),
    (52.0, 1.675003e22),
    (54.0, 1.32859e22),
    (56.0, 1.048832e22),
    (58.0, 8.238961e21),
    (60.0, 6.43869e21),
    (65.0, 3.393391e21),
    (70.0, 1.722138e21),
    (75.0, 8.30022e20),
    (80.0, 3.837716e20),
    (85.0, 1.708964e20),
    (90.0, 7.116e19),
    (95.0, 2.92e19),
    (100.0, 1.189e19),
    (105.0, 5.021e18),
    (110.0, 2.144e18),
    (115.0, 9.681e17),
    (120.0, 5.107e17),
];

/// The wavelengths that have cross-sections, nm.
pub(crate) const WAVELENGTH_RANGE_NM: std::ops::RangeInclusive<f64> = 360.0..=830.0;

/// Relative densities of the species against height.
#[derive(Debug, Clone)]
pub(crate) struct Profile {
    /// From the ground to [`TOP_KM`], ascending.
    heights_km: Vec<f64>,
    /// Molecules: 1 at sea level. Ozone: 1 at its peak. Aerosols: per km, vertical column 1.
    densities: Vec<[f64; SPECIES]>,
}

impl Profile {
    pub fn new(air: &Atmosphere, ground_km: f64) -> Profile {
        let [foot, peak, head] = air.ozone.tent_km;
        let heights_km: Vec<f64> = MOLECULE_DENSITY.iter().map(|&(h, _)| h).collect();
        let mut densities: Vec<[f64; SPECIES]> = MOLECULE_DENSITY
            .iter()
            .map(|&(h, n)| {
                let ozone = ((h - foot) / (peak - foot)).min((head - h) / (head - peak)).max(0.0);
                let [haze, stratosphere] =
                    air.aerosols().map(|a| a.map_or(0.0, |a| a.density_per_km(h, ground_km)));
                [n / MOLECULE_DENSITY[0].1, ozone, haze, stratosphere]
            })
            .collect();
        for k in AEROSOL..SPECIES {
            let column: f64 = (1..heights_km.len())
                .filter(|&i| heights_km[i] > ground_km)
                .map(|i| {
                    // Of the layer that holds the ground, what lies above it.
                    let thickness_km = heights_km[i] - heights_km[i - 1];
                    let cut = ((ground_km - heights_km[i - 1]) / thickness_km).max(0.0);
                    let low = densities[i - 1][k] * (1.0 - cut) + densities[i][k] * cut;
                    0.5 * (densities[i][k] + low) * thickness_km * (1.0 - cut)
                })
                .sum();
            if column > 0.0 {
                densities.iter_mut().for_each(|d| d[k] /= column);
            }
        }
        Profile { heights_km, densities }
    }

    /// Densities that are linear between the given heights: for tests with closed forms.
    #[cfg(test)]
    pub fn from_nodes(heights_km: Vec<f64>, densities: Vec<[f64; SPECIES]>) -> Profile {
        Profile { heights_km, densities }
    }

    pub fn heights_km(&self) -> &[f64] {
        &self.heights_km
    }
    pub fn densities(&self) -> &[[f64; SPECIES]] {
        &self.densities
    }
    /// The layer that holds a height: its lower node.
    pub fn layer(&self, height_km: f64) -> usize {
        self.heights_km.partition_point(|&h| h <= height_km).clamp(1, self.heights_km.len() - 1) - 1
    }
    /// Densities at a height; those of the ends outside.
    pub fn density(&self, height_km: f64) -> [f64; SPECIES] {
        let i = self.layer(height_km);
        let (low, high) = (self.heights_km[i], self.heights_km[i + 1]);
        let t = ((height_km - low) / (high - low)).clamp(0.0, 1.0);
        std::array::from_fn(|k| {
            self.densities[i][k] + (self.densities[i + 1][k] - self.densities[i][k]) * t
        })
    }
}

/// Coefficients per kilometre at density 1, and phase moments, for one band of wavelengths.
#[derive(Debug, Clone)]
pub(crate) struct Optics {
    /// Extinction of each species and wavelength, km^-1.
    pub extinction: [[f64; LANES]; SPECIES],
    /// The same, as lanes.
    pub extinction_lanes: [Lanes; SPECIES],
    /// What part of the extinction of each scatterer is scattering.
    pub albedo: [[f64; LANES]; SCATTERERS],
    /// Legendre moments of the phase functions of the scatterers.
    pub moments: [[Lanes; SCATTERERS]; MAX_DEGREE + 1],
    /// Lambert albedo of the ground.
    pub ground_albedo: f64,
    /// Without aerosol, the source function has no degree but 0 and 2.
    pub has_aerosol: bool,
    aerosols: [Option<AerosolPhase>; 2],
    wavelengths_nm: [f64; LANES],
}

/// How a phase function is evaluated.
#[derive(Debug, Clone)]
enum AerosolPhase {
    /// By its formula.
    Law(Box<Aerosol>),
    /// Where the law itself is a table: at angles of turn `180 t^2` degrees for equal steps of `t`,
    /// linear between, within 0.2 %.
    Resampled(Vec<Lanes>),
}

/// Intervals of [`AerosolPhase::Resampled`].
const PHASE_INTERVALS: usize = 1024;

impl AerosolPhase {
    fn new(aerosol: &Aerosol, wavelengths_nm: &[f64; LANES]) -> AerosolPhase {
        if !aerosol.phase.is_tabulated() {
            return AerosolPhase::Law(Box::new(aerosol.clone()));
        }
        let node = |i: usize| {
            let t = i as f64 / PHASE_INTERVALS as f64;
            let cosine = (PI * t * t).cos();
            Lanes::from_fn(|lane| aerosol.phase(wavelengths_nm[lane], cosine))
        };
        AerosolPhase::Resampled((0..=PHASE_INTERVALS).map(node).collect())
    }
}

/// The phase function at a turn of cosine `nu`.
fn look_up(nodes: &[Lanes], nu: f64) -> Lanes {
    let place = (nu.clamp(-1.0, 1.0).acos() / PI).sqrt() * PHASE_INTERVALS as f64;
    let i = (place as usize).min(PHASE_INTERVALS - 1);
    let t = (place - i as f64) as f32;
    nodes[i] * (1.0 - t) + nodes[i + 1] * t
}

/// Where a scatterer stands among the species.
pub(crate) const SPECIES_OF_SCATTERER: [usize; SCATTERERS] = [MOLECULES, AEROSOL, AEROSOL + 1];

impl Optics {
    /// For up to [`LANES`] wavelengths; the last is repeated to fill the lanes. The density of the
    /// molecules is relative to that of the standard atmosphere.
    pub fn new(air: &Atmosphere, density_ratio: f64, wavelengths_nm: &[f64]) -> Optics {
        let nm: [f64; LANES] =
            std::array::from_fn(|i| wavelengths_nm[i.min(wavelengths_nm.len() - 1)]);
        let [foot, _, head] = air.ozone.tent_km;
        let ozone_peak_m3 = air.ozone.column_du * DOBSON_UNIT_PER_M2 / (0.5e3 * (head - foot));
        // Per metre to per kilometre.
        let air_m3 = density_ratio * MOLECULE_DENSITY[0].1;
        let molecules = nm.map(|nm| 1e3 * rayleigh_cross_section_m2(nm) * air_m3);
        let ozone = nm.map(|nm| 1e3 * ozone_cross_section_m2(nm) * ozone_peak_m3);
        let aerosols = air.aerosols();
        let [haze, stratosphere] =
            aerosols.map(|a| nm.map(|nm| a.map_or(0.0, |a| a.optical_depth(nm))));
        let [haze_albedo, stratosphere_albedo] =
            aerosols.map(|a| nm.map(|nm| a.map_or(0.0, |a| a.albedo(nm))));
        let extinction = [molecules, ozone, haze, stratosphere];
        let moment = |l: usize, k: usize, i: usize| match k {
            MOLECULES => phase::rayleigh_moment(l),
            _ => aerosols[k - 1].map_or(0.0, |a| a.moment(nm[i], l)),
        };
        Optics {
            extinction,
            extinction_lanes: extinction.map(|e| Lanes::from_fn(|i| e[i])),
            albedo: [[1.0; LANES], haze_albedo, stratosphere_albedo],
            moments: std::array::from_fn(|l| {
                std::array::from_fn(|k| Lanes::from_fn(|i| moment(l, k, i)))
            }),
            ground_albedo: air.ground.albedo,
            has_aerosol: aerosols.iter().any(Option::is_some),
            aerosols: aerosols.map(|a| a.map(|a| AerosolPhase::new(a, &nm))),
            wavelengths_nm: nm,
        }
    }

    /// Optical depth of columns, each lane.
    #[inline(always)]
    pub fn optical_depth(&self, columns: [f32; SPECIES]) -> Lanes {
        let [a, b, c, d] = self.extinction_lanes;
        a * columns[0] + b * columns[1] + c * columns[2] + d * columns[3]
    }

    /// Scattering by molecules and by aerosols, the mean over the lanes, km^-1.
    pub fn mean_scattering(&self, density: [f64; SPECIES]) -> (f64, f64) {
        let of = |k: usize| {
            let species = SPECIES_OF_SCATTERER[k];
            let lanes = self.extinction[species].iter().zip(&self.albedo[k]);
            lanes.map(|(e, a)| e * a).sum::<f64>() / LANES as f64 * density[species]
        };
        (of(0), of(1) + of(2))
    }

    /// Phase functions at a turn of cosine `nu`, per steradian, of the scatterers.
    pub fn phases(&self, nu: f64) -> [Lanes; SCATTERERS] {
        let [haze, stratosphere] = [0, 1].map(|k| match &self.aerosols[k] {
            Some(AerosolPhase::Law(a)) => Lanes::from_fn(|i| a.phase(self.wavelengths_nm[i], nu)),
            Some(AerosolPhase::Resampled(nodes)) => look_up(nodes, nu),
            None => Lanes::ZERO,
        });
        [Lanes::splat(phase::rayleigh(nu) as f32), haze, stratosphere]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::aerosol::MieKind;

    /// Optical depth of a vertical column of one species.
    fn vertical_depth(air: &Atmosphere, wavelength_nm: f64, species: usize) -> f64 {
        let profile = Profile::new(air, 0.0);
        let optics = Optics::new(air, 1.0, &[wavelength_nm]);
        let (h, d) = (profile.heights_km(), profile.densities());
        (1..h.len())
            .map(|i| 0.5 * (d[i][species] + d[i - 1][species]) * (h[i] - h[i - 1]))
            .sum::<f64>()
            * optics.extinction[species][0]
    }

    #[test]
    fn vertical_optical_depths_are_those_of_the_reference_air() {
        let air = Atmosphere::default();
        // Sums over the layers of the reference atmosphere.
        for (nm, molecules, ozone, aerosol) in [
            (400.0, 0.360_814, 0.000_123_1, 0.151_284),
            (450.0, 0.221_474, 0.001_867, 0.129_806),
            (550.0, 0.097_227, 0.028_214, 0.1),
            (650.0, 0.049_265, 0.018_041, 0.080_479),
        ] {
            let want = [molecules, ozone, aerosol];
            for (k, want) in want.into_iter().enumerate() {
                let got = vertical_depth(&air, nm, k);
                assert!((got / want - 1.0).abs() < 5e-4, "{nm} nm, species {k}: {got}, not {want}");
            }
        }
    }

    #[test]
    fn shipped_kinds_keep_their_phase_functions() {
        for kind in MieKind::ALL {
            let air = Atmosphere { aerosol: Aerosol::mie(kind, 0.1), ..Atmosphere::default() };
            let optics = Optics::new(&air, 1.0, &[430.0, 550.0, 650.0]);
            for i in 0..=1800 {
                let nu = f64::from(i).mul_add(0.1, 0.03).to_radians().cos();
                let [_, haze, _] = optics.phases(nu);
                for (lane, nm) in [430.0, 550.0, 650.0].into_iter().enumerate() {
                    let want = air.aerosol.phase(nm, nu);
                    let got = f64::from(haze.0[lane]);
                    assert!((got / want - 1.0).abs() < 2e-3, "{kind:?} {i}: {got}, not {want}");
                }
            }
        }
    }

    #[test]
    fn densities_meet_their_nodes_and_stop_at_the_ends() {
        let profile = Profile::new(&Atmosphere::default(), 0.0);
        assert_eq!(profile.density(0.0)[0], 1.0);
        assert_eq!(profile.density(25.0)[1], 1.0);
        assert_eq!(profile.density(9.0)[1], 0.0);
        assert_eq!(profile.density(TOP_KM), *profile.densities().last().unwrap());
        let middle = profile.density(0.5)[2];
        let ends = profile.density(0.0)[2] + profile.density(1.0)[2];
        assert!((middle - 0.5 * ends).abs() < 1e-15);
    }
}
