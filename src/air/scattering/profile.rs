//! What the air is made of: densities that are piecewise linear in height, and cross-sections.
//!
//! Three species: molecules, ozone, aerosol. Densities are relative, so that the geometry of paths
//! (`columns`) holds for every wavelength and every amount of ozone and aerosol; the coefficients
//! per kilometre at density 1 carry the rest.
//!
//! Molecules: US Standard Atmosphere 1976. Ozone: a tent 10-25-40 km. Aerosol: exponential, sampled
//! each kilometre up to 30 km, normalised to its column. Between nodes, all are linear: the
//! reference this is measured against has exactly these layers.

use super::harmonics::MAX_DEGREE;
use super::lanes::{LANES, Lanes};
use super::phase;
use crate::air::Atmosphere;

/// Radius of the spherical Earth, kilometres (IUGG mean radius).
pub const EARTH_RADIUS_KM: f64 = 6371.0;
/// Where the air ends, kilometres above the ground.
pub const TOP_KM: f64 = 120.0;

/// How many kinds of matter there are, and where each stands.
pub(crate) const SPECIES: usize = 3;
const MOLECULES: usize = 0;
const OZONE: usize = 1;
const AEROSOL: usize = 2;

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

/// Molecules per square metre in a Dobson unit: 10 micrometres of gas at 273.15 K, 101 325 Pa.
const DOBSON_UNIT_PER_M2: f64 = 2.6867e20;
/// Foot, peak and head of the ozone tent, km (Bruneton 2017, "Precomputed atmospheric
/// scattering: a new implementation").
const OZONE_TENT_KM: [f64; 3] = [10.0, 25.0, 40.0];
/// Above this, there is no aerosol.
const AEROSOL_TOP_KM: f64 = 30.0;

/// Ozone absorption at 233 K from 360 to 830 nm in steps of 10 nm, 1e-25 m2 (Serdyuchenko et al.
/// 2014, *Atmos. Meas. Tech.* 7, 625; 10-nm means).
const OZONE_CROSS_SECTION: [f64; 48] = [
    0.0118, 0.002182, 0.002818, 0.006636, 0.01527, 0.02763, 0.0552, 0.08451, 0.1582, 0.2316,
    0.3669, 0.4924, 0.7752, 0.9016, 1.48, 1.602, 2.139, 2.755, 3.091, 3.5, 4.266, 4.672, 4.398,
    4.701, 5.019, 4.305, 3.74, 3.215, 2.662, 2.238, 1.852, 1.473, 1.209, 0.9423, 0.7455, 0.6566,
    0.5105, 0.415, 0.4228, 0.3237, 0.2451, 0.2801, 0.2534, 0.1624, 0.1465, 0.2078, 0.1383, 0.07105,
];
/// The wavelengths that [`ozone_cross_section_m2`] covers, nm.
pub(crate) const WAVELENGTH_RANGE_NM: std::ops::RangeInclusive<f64> = 360.0..=830.0;

/// Absorption of an ozone molecule, m2: linear between 10-nm means, held constant outside 360 to
/// 830 nm.
pub(crate) fn ozone_cross_section_m2(wavelength_nm: f64) -> f64 {
    let last = OZONE_CROSS_SECTION.len() - 1;
    let t = ((wavelength_nm - 360.0) / 10.0).clamp(0.0, last as f64);
    let i = (t as usize).min(last - 1);
    let (a, b) = (OZONE_CROSS_SECTION[i], OZONE_CROSS_SECTION[i + 1]);
    (a + (b - a) * (t - i as f64)) * 1e-25
}

/// Scattering by a molecule of air with 360 ppm of CO2, m2.
///
/// Bodhaine et al. 1999, *J. Atmos. Oceanic Technol.* 16, 1854, eq. 29; 250 to 850 nm.
pub(crate) fn rayleigh_cross_section_m2(wavelength_nm: f64) -> f64 {
    let um2 = (wavelength_nm * 1e-3).powi(2);
    let above = 1.045_599_6 - 341.290_61 / um2 - 0.902_308_50 * um2;
    let below = 1.0 + 0.002_705_988_9 / um2 - 85.968_563 * um2;
    1e-32 * above / below
}

/// Relative densities of the three species against height.
#[derive(Debug, Clone)]
pub(crate) struct Profile {
    /// From the ground to [`TOP_KM`], ascending.
    heights_km: Vec<f64>,
    /// Molecules: 1 at the ground. Ozone: 1 at its peak. Aerosol: per km, vertical column 1.
    densities: Vec<[f64; SPECIES]>,
}

impl Profile {
    pub fn new(aerosol_scale_height_km: f64) -> Profile {
        let heights_km: Vec<f64> = MOLECULE_DENSITY.iter().map(|&(h, _)| h).collect();
        let mut densities: Vec<[f64; SPECIES]> = MOLECULE_DENSITY
            .iter()
            .map(|&(h, n)| {
                let [foot, peak, head] = OZONE_TENT_KM;
                let ozone = ((h - foot) / (peak - foot)).min((head - h) / (head - peak)).max(0.0);
                let aerosol =
                    if h > AEROSOL_TOP_KM { 0.0 } else { (-h / aerosol_scale_height_km).exp() };
                [n / MOLECULE_DENSITY[0].1, ozone, aerosol]
            })
            .collect();
        let column: f64 = (1..heights_km.len())
            .map(|i| {
                0.5 * (densities[i][AEROSOL] + densities[i - 1][AEROSOL])
                    * (heights_km[i] - heights_km[i - 1])
            })
            .sum();
        for d in &mut densities {
            d[AEROSOL] /= column;
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
    /// What part of the extinction of molecules (all) and of aerosol is scattering.
    pub aerosol_albedo: f64,
    /// Mean cosine of the aerosol's phase function.
    pub asymmetry: f64,
    /// Legendre moments of molecules and of aerosol.
    pub moments: [[f32; 2]; MAX_DEGREE + 1],
    /// Lambert albedo of the ground.
    pub ground_albedo: f64,
    /// Without aerosol, the source function has no degree but 0 and 2.
    pub has_aerosol: bool,
}

impl Optics {
    /// For up to [`LANES`] wavelengths; the last is repeated to fill the lanes.
    pub fn new(air: &Atmosphere, wavelengths_nm: &[f64]) -> Optics {
        let nm: [f64; LANES] =
            std::array::from_fn(|i| wavelengths_nm[i.min(wavelengths_nm.len() - 1)]);
        let ozone_peak_m3 =
            air.ozone_du * DOBSON_UNIT_PER_M2 / (0.5e3 * (OZONE_TENT_KM[2] - OZONE_TENT_KM[0]));
        // Per metre to per kilometre.
        let molecules = nm.map(|nm| 1e3 * rayleigh_cross_section_m2(nm) * MOLECULE_DENSITY[0].1);
        let ozone = nm.map(|nm| 1e3 * ozone_cross_section_m2(nm) * ozone_peak_m3);
        let aerosol =
            nm.map(|nm| air.aerosol_optical_depth_550 * (nm / 550.0).powf(-air.angstrom_exponent));
        let extinction = [molecules, ozone, aerosol];
        let g = air.aerosol_asymmetry;
        Optics {
            extinction,
            extinction_lanes: extinction.map(|e| Lanes::from_fn(|i| e[i])),
            aerosol_albedo: air.aerosol_single_scattering_albedo,
            asymmetry: g,
            moments: std::array::from_fn(|l| {
                [phase::rayleigh_moment(l) as f32, phase::henyey_greenstein_moment(g, l) as f32]
            }),
            ground_albedo: air.ground_albedo,
            has_aerosol: extinction[AEROSOL].iter().any(|&e| e > 0.0),
        }
    }

    /// Optical depth of columns, each lane.
    #[inline(always)]
    pub fn optical_depth(&self, columns: [f32; SPECIES]) -> Lanes {
        let [a, b, c] = self.extinction_lanes;
        a * columns[MOLECULES] + b * columns[OZONE] + c * columns[AEROSOL]
    }

    /// Scattering by molecules and by aerosol, the mean over the lanes, km^-1.
    pub fn mean_scattering(&self, density: [f64; SPECIES]) -> (f64, f64) {
        let mean = |k: usize| self.extinction[k].iter().sum::<f64>() / LANES as f64 * density[k];
        (mean(MOLECULES), mean(AEROSOL) * self.aerosol_albedo)
    }

    /// Phase functions at a turn of cosine `nu`, per steradian: molecules, aerosol.
    pub fn phases(&self, nu: f64) -> (f32, f32) {
        let aerosol =
            if self.has_aerosol { phase::henyey_greenstein(self.asymmetry, nu) } else { 0.0 };
        (phase::rayleigh(nu) as f32, aerosol as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Optical depth of a vertical column of one species.
    fn vertical_depth(air: &Atmosphere, wavelength_nm: f64, species: usize) -> f64 {
        let profile = Profile::new(air.aerosol_scale_height_km);
        let optics = Optics::new(air, &[wavelength_nm]);
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
    fn densities_meet_their_nodes_and_stop_at_the_ends() {
        let profile = Profile::new(1.2);
        assert_eq!(profile.density(0.0)[0], 1.0);
        assert_eq!(profile.density(25.0)[1], 1.0);
        assert_eq!(profile.density(9.0)[1], 0.0);
        assert_eq!(profile.density(TOP_KM), *profile.densities().last().unwrap());
        let middle = profile.density(0.5)[2];
        let ends = profile.density(0.0)[2] + profile.density(1.0)[2];
        assert!((middle - 0.5 * ends).abs() < 1e-15);
    }
}
