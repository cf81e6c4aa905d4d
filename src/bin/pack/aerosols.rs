//! The shipped kinds of aerosol: mixtures of spheres of all sizes, by wavelength and angle.
//!
//! Theory: each component has a log-normal distribution of radii,
//! `dN/d ln r = N / (sqrt(2 pi) ln s) exp(-(ln(r/r0))^2 / (2 ln^2 s))`, and a refractive index by
//! wavelength; cross-sections of the spheres of [`super::mie`] are summed over radii and components.
//!
//! Sources: components and mixtures of OPAC (Hess, Koepke & Schult 1998, *Bull. Am. Meteorol. Soc.*
//! 79, 831, tables 1c, 3 and 4); droplets of volcanoes: sizes after SAGE over Mount St. Helens
//! ("SAGE satellite observations of stratospheric aerosols from Mount St. Helens eruption: a
//! two-wavelength analysis", 1984: radius 0.20 micrometres, effective variance 0.25), sulphuric acid
//! of 75 % as the component SUSO of OPAC. Radii swollen by humidity follow from the published indices
//! of the mixtures with water; they are those of OPAC's tables as remembered.
//!
//! Omitted: particles that are no spheres. Dust of spheres scatters too much straight back (by a
//! factor of 2 at 180 degrees) and a little too little at 100 to 140.
//!
//! Accuracy: the component SUSO at 99 % humidity as OPAC's own file has it (tests below) within
//! 0.3 % in extinction and 1 % in its phase function; sums over radii within 0.05 %.

use std::f64::consts::PI;
use std::fmt::Write;

use nocturne::catalog::pack::Packed;

use super::mie::{Complex, Sphere};

/// Wavelengths of the tables, nm.
const WAVELENGTHS_NM: [f64; 10] =
    [360.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 760.0, 830.0];
/// Where the extinction of a table is 1.
const REFERENCE_NM: f64 = 550.0;
/// Radii in the sum over a distribution.
const RADII: usize = 600;
/// Angles of the tables.
const ANGLES: usize = 241;

/// Wavelengths of the indices of OPAC, micrometres.
const INDEX_UM: [f64; 11] = [0.35, 0.40, 0.45, 0.50, 0.55, 0.60, 0.65, 0.70, 0.75, 0.80, 0.90];

/// Real and imaginary part of an index at [`INDEX_UM`].
struct Index {
    real: [f64; 11],
    imaginary: [f64; 11],
}

/// Particles of one substance.
struct Component {
    /// Median of the radii, micrometres.
    radius_um: f64,
    /// Geometric standard deviation of the radii.
    spread: f64,
    /// Smallest and largest radius, micrometres.
    range_um: (f64, f64),
    index: &'static Index,
}

/// Water-soluble: sulphates, nitrates, organic matter; at 80 % humidity (0.0212 when dry).
const WATER_SOLUBLE_80: Component = Component {
    radius_um: 0.0306,
    spread: 2.24,
    range_um: (0.005, 20.0),
    index: &Index {
        real: [1.405, 1.403, 1.401, 1.400, 1.399, 1.398, 1.397, 1.397, 1.397, 1.393, 1.392],
        imaginary: [
            1.663e-3, 1.663e-3, 1.663e-3, 1.663e-3, 1.995e-3, 1.995e-3, 2.328e-3, 2.328e-3,
            2.827e-3, 3.325e-3, 4.323e-3,
        ],
    },
};
/// The same at 50 % humidity.
const WATER_SOLUBLE_50: Component = Component {
    radius_um: 0.0262,
    spread: 2.24,
    range_um: (0.005, 20.0),
    index: &Index {
        real: [1.442, 1.440, 1.439, 1.438, 1.437, 1.437, 1.436, 1.436, 1.436, 1.430, 1.430],
        imaginary: [
            2.649e-3, 2.649e-3, 2.649e-3, 2.649e-3, 3.179e-3, 3.179e-3, 3.709e-3, 3.709e-3,
            4.503e-3, 5.298e-3, 6.887e-3,
        ],
    },
};
/// Insoluble: soil and plant debris.
const INSOLUBLE: Component = Component {
    radius_um: 0.471,
    spread: 2.51,
    range_um: (0.005, 20.0),
    index: &Index {
        real: [1.53, 1.53, 1.53, 1.53, 1.53, 1.53, 1.53, 1.53, 1.53, 1.52, 1.52],
        imaginary: [8e-3; 11],
    },
};
/// Soot.
const SOOT: Component = Component {
    radius_um: 0.0118,
    spread: 2.00,
    range_um: (0.005, 20.0),
    index: &Index {
        real: [1.75; 11],
        imaginary: [0.465, 0.460, 0.455, 0.450, 0.440, 0.435, 0.435, 0.430, 0.430, 0.430, 0.435],
    },
};
const SEA_SALT_INDEX_80: Index = Index {
    real: [1.364, 1.359, 1.358, 1.356, 1.354, 1.352, 1.351, 1.351, 1.350, 1.348, 1.347],
    imaginary: [
        4.676e-8, 5.428e-9, 3.972e-9, 2.839e-9, 2.980e-9, 1.155e-8, 1.970e-8, 5.461e-8, 2.732e-7,
        3.564e-7, 5.801e-6,
    ],
};
/// Sea salt, accumulation mode, at 80 % humidity (0.209 when dry).
const SEA_SALT_FINE_80: Component = Component {
    radius_um: 0.416,
    spread: 2.03,
    range_um: (0.005, 20.0),
    index: &SEA_SALT_INDEX_80,
};
/// Sea salt, coarse mode, at 80 % humidity (1.75 when dry).
const SEA_SALT_COARSE_80: Component =
    Component { radius_um: 3.49, spread: 2.03, range_um: (0.005, 60.0), index: &SEA_SALT_INDEX_80 };
const MINERAL_INDEX: Index = Index {
    real: [1.53; 11],
    imaginary: [
        1.7e-2, 1.3e-2, 8.5e-3, 7.8e-3, 5.5e-3, 4.5e-3, 4.5e-3, 4.0e-3, 4.0e-3, 4.0e-3, 4.0e-3,
    ],
};
/// Mineral dust, nucleation mode.
const FINE_DUST: Component =
    Component { radius_um: 0.07, spread: 1.95, range_um: (0.005, 20.0), index: &MINERAL_INDEX };
/// Mineral dust, accumulation mode.
const MIDDLE_DUST: Component =
    Component { radius_um: 0.39, spread: 2.00, range_um: (0.005, 20.0), index: &MINERAL_INDEX };
/// Mineral dust, coarse mode.
const COARSE_DUST: Component =
    Component { radius_um: 1.90, spread: 2.15, range_um: (0.005, 60.0), index: &MINERAL_INDEX };
/// Droplets of 75 % sulphuric acid, some months after a great eruption. The spread is
/// `exp(sqrt(ln 1.25))`, that of an effective variance of 0.25.
const ACID_DROPLETS: Component = Component {
    radius_um: 0.20,
    spread: 1.604,
    range_um: (0.005, 20.0),
    index: &Index {
        real: [1.452, 1.440, 1.432, 1.431, 1.430, 1.429, 1.429, 1.428, 1.427, 1.426, 1.425],
        imaginary: [
            1e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1.47e-8, 1.67e-8, 2.05e-8, 7.17e-8, 8.63e-8, 2.55e-7,
        ],
    },
};

/// A mixture: its file and what it is, and particles of each component per cubic centimetre.
struct Kind {
    file: &'static str,
    what: &'static str,
    parts: &'static [(&'static Component, f64)],
}

const KINDS: [Kind; 5] = [
    Kind {
        file: "air/mie_clear.csv",
        what: "OPAC continental clean, 80 % humidity",
        parts: &[(&WATER_SOLUBLE_80, 2600.0), (&INSOLUBLE, 0.15)],
    },
    Kind {
        file: "air/mie_continental.csv",
        what: "OPAC continental average, 80 % humidity",
        parts: &[(&WATER_SOLUBLE_80, 7000.0), (&INSOLUBLE, 0.4), (&SOOT, 8300.0)],
    },
    Kind {
        file: "air/mie_maritime.csv",
        what: "OPAC maritime clean, 80 % humidity",
        parts: &[
            (&WATER_SOLUBLE_80, 1500.0),
            (&SEA_SALT_FINE_80, 20.0),
            (&SEA_SALT_COARSE_80, 3.2e-3),
        ],
    },
    Kind {
        file: "air/mie_desert.csv",
        what: "OPAC desert, 50 % humidity, spheres",
        parts: &[
            (&WATER_SOLUBLE_50, 2000.0),
            (&FINE_DUST, 269.5),
            (&MIDDLE_DUST, 30.5),
            (&COARSE_DUST, 0.142),
        ],
    },
    Kind {
        file: "air/mie_volcanic.csv",
        what: "droplets of 75 % sulphuric acid, effective radius 0.35 micrometres",
        parts: &[(&ACID_DROPLETS, 1.0)],
    },
];

/// Optical properties of a volume of air at one wavelength.
struct Optics {
    /// Per kilometre, for particles per cubic centimetre.
    extinction: f64,
    scattering: f64,
    /// Scattering per kilometre and steradian at each angle.
    phase: Vec<f64>,
}

impl Component {
    fn index_at(&self, um: f64) -> Complex {
        let i = INDEX_UM.partition_point(|&node| node <= um).clamp(1, INDEX_UM.len() - 1);
        let t = (um - INDEX_UM[i - 1]) / (INDEX_UM[i] - INDEX_UM[i - 1]);
        let at = |values: &[f64; 11]| values[i - 1] + (values[i] - values[i - 1]) * t;
        Complex::new(at(&self.index.real), at(&self.index.imaginary))
    }

    /// For one particle per cubic centimetre.
    fn optics(&self, wavelength_nm: f64, cosines: &[f64]) -> Optics {
        let um = wavelength_nm / 1000.0;
        let wave_number = 2.0 * PI / um;
        let index = self.index_at(um);
        let (low, high) = (self.range_um.0.ln(), self.range_um.1.ln());
        let step = (high - low) / (RADII - 1) as f64;
        let mut sum = Optics { extinction: 0.0, scattering: 0.0, phase: vec![0.0; cosines.len()] };
        for i in 0..RADII {
            let radius = (low + step * i as f64).exp();
            let deviation = (radius / self.radius_um).ln() / self.spread.ln();
            let particles =
                (-0.5 * deviation * deviation).exp() / ((2.0 * PI).sqrt() * self.spread.ln());
            // Spheres that no sum would notice.
            let weight = particles * step * PI * radius * radius;
            if weight < 1e-14 {
                continue;
            }
            let sphere = Sphere::new(index, wave_number * radius);
            let (extinction, scattering) = sphere.efficiencies();
            sum.extinction += weight * extinction;
            sum.scattering += weight * scattering;
            let per_intensity = particles * step / (wave_number * wave_number);
            for (sum, intensity) in sum.phase.iter_mut().zip(sphere.intensities(cosines)) {
                *sum += per_intensity * intensity;
            }
        }
        // Square micrometres per cubic centimetre are 1e-3 per kilometre.
        sum.scaled(1e-3)
    }
}

impl Optics {
    fn scaled(mut self, factor: f64) -> Optics {
        self.extinction *= factor;
        self.scattering *= factor;
        self.phase.iter_mut().for_each(|p| *p *= factor);
        self
    }
}

impl Kind {
    fn optics(&self, wavelength_nm: f64, cosines: &[f64]) -> Optics {
        let none = Optics { extinction: 0.0, scattering: 0.0, phase: vec![0.0; cosines.len()] };
        self.parts.iter().fold(none, |mut sum, (component, particles)| {
            let part = component.optics(wavelength_nm, cosines).scaled(*particles);
            sum.extinction += part.extinction;
            sum.scattering += part.scattering;
            sum.phase.iter_mut().zip(part.phase).for_each(|(sum, part)| *sum += part);
            sum
        })
    }

    fn pack(&self) -> Packed {
        let degrees = angles_deg();
        let cosines: Vec<f64> = degrees.iter().map(|d| d.to_radians().cos()).collect();
        let optics = WAVELENGTHS_NM.map(|nm| self.optics(nm, &cosines));
        let reference = self.optics(REFERENCE_NM, &[]).extinction;
        let mut text = String::new();
        let mut row = |name: &str, values: &dyn Fn(&Optics) -> f64| {
            let cells: String = optics
                .iter()
                .fold(String::new(), |cells, o| cells + &format!(",{:.4e}", values(o)));
            // Writing to a string does not fail.
            let _ = writeln!(text, "{name}{cells}");
        };
        row("extinction", &|o| o.extinction / reference);
        row("albedo", &|o| o.scattering / o.extinction);
        for (i, degrees) in degrees.iter().enumerate() {
            row(&format!("{degrees}"), &|o| o.phase[i] / o.scattering);
        }
        let wavelengths: String = WAVELENGTHS_NM.iter().map(|nm| format!(",{nm}")).collect();
        let text = format!("wavelength_nm{wavelengths}\n{text}");
        let at_550 = &optics[4];
        let albedo = at_550.scattering / at_550.extinction;
        let summary = format!("{}; albedo {albedo:.3} at 550 nm", self.what);
        Packed { file: self.file, bytes: text.into_bytes(), summary }
    }
}

/// From 0 to 180 degrees, in steps of 0.03 degrees at the beginning and of 1.8 at the end, each a
/// multiple of 1/100.
fn angles_deg() -> Vec<f64> {
    (0..ANGLES)
        .map(|i| {
            let t = i as f64 / (ANGLES - 1) as f64;
            let degrees = 180.0 * t * (0.04 + t * (0.56 + t * 0.4));
            (degrees * 100.0).round() / 100.0
        })
        .collect()
}

/// The tables of all kinds.
pub fn tables() -> Vec<Packed> {
    KINDS.iter().map(Kind::pack).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The component SUSO at 99 % humidity as the file `suso99` of OPAC has it.
    const TRUTH: &str = include_str!("../../../tests/truth/opac_suso99.csv");

    #[test]
    fn a_component_is_what_opac_makes_of_it() {
        let numbers = |line: &str| -> Option<Vec<f64>> {
            line.split(',').map(|cell| cell.parse().ok()).collect()
        };
        let rows: Vec<Vec<f64>> = TRUTH.lines().filter_map(numbers).collect();
        assert!(rows.len() >= 5);
        for row in rows {
            let [um, extinction, albedo, _, real, imaginary] = row[..6] else { panic!("{row:?}") };
            let index = Box::leak(Box::new(Index { real: [real; 11], imaginary: [imaginary; 11] }));
            let component =
                Component { radius_um: 0.231, spread: 2.03, range_um: (0.0103, 81.8), index };
            let cosines = [0.0f64, 1.0].map(|d| d.to_radians().cos());
            let got = component.optics(um * 1000.0, &cosines);
            assert!((got.extinction / extinction - 1.0).abs() < 3e-3, "{um}: {}", got.extinction);
            assert!((got.scattering / got.extinction / albedo - 1.0).abs() < 1e-3, "{um}");
            for (got, want) in got.phase.iter().zip(&row[6..]) {
                assert!((got / want - 1.0).abs() < 1e-2, "{um}: {got}, not {want}");
            }
        }
    }

    #[test]
    fn mixtures_are_those_of_the_paper() {
        // Extinction (km^-1) and albedo at 550 nm and 80 % humidity, table 4 of the paper, from
        // memory: the last digit is not to be trusted.
        let all_wet = Kind {
            file: "",
            what: "",
            parts: &[
                (&WATER_SOLUBLE_80, 2000.0),
                (&FINE_DUST, 269.5),
                (&MIDDLE_DUST, 30.5),
                (&COARSE_DUST, 0.142),
            ],
        };
        for (kind, extinction, albedo) in [
            (&KINDS[0], 0.026, 0.972),
            (&KINDS[1], 0.075, 0.925),
            (&KINDS[2], 0.090, 0.997),
            (&all_wet, 0.145, 0.888),
        ] {
            let got = kind.optics(550.0, &[]);
            let (e, a) = (got.extinction, got.scattering / got.extinction);
            assert!((e / extinction - 1.0).abs() < 0.03, "{}: {e}", kind.what);
            assert!((a - albedo).abs() < 0.004, "{}: {a}", kind.what);
        }
    }

    #[test]
    fn angles_ascend_from_end_to_end() {
        let angles = angles_deg();
        assert_eq!((angles[0], angles[ANGLES - 1]), (0.0, 180.0));
        assert!(angles.windows(2).all(|pair| pair[1] - pair[0] > 0.01));
    }
}
