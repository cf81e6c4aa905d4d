//! How DE440 is packed: which channels, in which segments, how finely. For the maker of
//! `catalogs/de440.bin` alone; what reads it is the table.
//!
//! *Source.* JPL's ephemeris DE440 (Park, Folkner, Williams & Boggs 2021, AJ 161, 105), a numerical
//! integration fitted to all that has been measured, 1549-12-31 to 2650-01-25.
//!
//! *What is kept.* Sun and planets as they are seen from the Earth within 0.0006", 0.006" and 0.06"
//! at the three depths, the Moon's distance within 0.7 m at the last; `pack --kernel` prints what it
//! measures. So Venus and the Earth-Moon barycentre, which come as close as 0.27 au, are kept within
//! 0.1 km, and Neptune within 10 km. What strays along the radius may be twice as coarse as what
//! strays across it: it is seen from the Sun's side.
//!
//! *What is left out.* Asteroids, and the planets beside the barycentres of their systems.

mod errors;
mod orbits;

use glam::DVec3;

use super::kernel::Kernel;
use super::resampled::{ChannelSource, Folding, Orbit, Recipe, Reference, encode};
use crate::time::{JulianDate, Tdb};
pub use errors::{BodyErrors, errors};

/// First Julian date of DE440, and the days that it holds.
const FIRST_JD: f64 = 2_287_184.5;
const DAYS: u32 = 401_792;

/// A channel by the body, its origin in the numbers of NAIF, and how it is cut.
struct Plan {
    id: &'static str,
    body: Place,
    orbit: Option<&'static Orbit>,
    segment_days: u32,
    degree: usize,
    /// Kilometres: along the radius, across it in the plane of the orbit, across the plane.
    quantum_km: [f64; 3],
    /// What the first and the second depth do without.
    omitted_bits: [u32; 2],
    /// Pieces of a segment, and their degrees from the first depth to the last.
    pieces: usize,
    piece_degrees: [usize; 3],
}

/// Where a position is told from.
enum Place {
    /// The barycentre of the solar system.
    FromBarycentre(i32),
    FromSun(i32),
    MoonFromEarth,
}

const SUN: i32 = 10;
const EARTH_MOON: i32 = 3;
const EARTH: i32 = 399;
const MOON: i32 = 301;
const BARYCENTRE: i32 = 0;

const PLANS: [Plan; 11] = [
    Plan {
        id: "sun",
        body: Place::FromBarycentre(SUN),
        orbit: None,
        segment_days: 128,
        degree: 16,
        quantum_km: [0.02, 0.02, 0.02],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [5, 7, 9],
    },
    Plan {
        id: "moon",
        body: Place::MoonFromEarth,
        orbit: Some(&orbits::MOON),
        segment_days: 32,
        degree: 33,
        quantum_km: [1e-4, 1.4e-4, 1.4e-4],
        omitted_bits: [6, 3],
        pieces: 4,
        piece_degrees: [11, 13, 15],
    },
    Plan {
        id: "earth-moon",
        body: Place::FromSun(EARTH_MOON),
        orbit: Some(&orbits::EARTH_MOON),
        segment_days: 128,
        degree: 28,
        quantum_km: [0.02, 0.01, 0.01],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [7, 9, 11],
    },
    Plan {
        id: "mercury",
        body: Place::FromSun(1),
        orbit: Some(&orbits::MERCURY),
        segment_days: 64,
        degree: 20,
        quantum_km: [0.05, 0.027, 0.027],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [11, 13, 15],
    },
    Plan {
        id: "venus",
        body: Place::FromSun(2),
        orbit: Some(&orbits::VENUS),
        segment_days: 128,
        degree: 21,
        quantum_km: [0.02, 0.01, 0.01],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [7, 9, 9],
    },
    Plan {
        id: "mars",
        body: Place::FromSun(4),
        orbit: Some(&orbits::MARS),
        segment_days: 128,
        degree: 17,
        quantum_km: [0.04, 0.02, 0.02],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [7, 7, 9],
    },
    Plan {
        id: "jupiter",
        body: Place::FromBarycentre(5),
        orbit: Some(&orbits::JUPITER),
        segment_days: 584,
        degree: 11,
        quantum_km: [0.5, 0.3, 0.3],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [5, 7, 7],
    },
    Plan {
        id: "saturn",
        body: Place::FromBarycentre(6),
        orbit: Some(&orbits::SATURN),
        segment_days: 1168,
        degree: 12,
        quantum_km: [0.8, 0.6, 0.6],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [5, 7, 7],
    },
    Plan {
        id: "uranus",
        body: Place::FromBarycentre(7),
        orbit: Some(&orbits::URANUS),
        segment_days: 2336,
        degree: 10,
        quantum_km: [1.5, 1.2, 1.2],
        omitted_bits: [7, 3],
        pieces: 4,
        piece_degrees: [5, 5, 7],
    },
    Plan {
        id: "neptune",
        body: Place::FromBarycentre(8),
        orbit: Some(&orbits::NEPTUNE),
        segment_days: 2336,
        degree: 8,
        quantum_km: [1.5, 1.5, 1.5],
        omitted_bits: [7, 3],
        pieces: 2,
        piece_degrees: [5, 5, 7],
    },
    Plan {
        id: "pluto",
        body: Place::FromBarycentre(9),
        orbit: Some(&orbits::PLUTO),
        segment_days: 2336,
        degree: 8,
        quantum_km: [1.5, 1.5, 1.5],
        omitted_bits: [7, 3],
        pieces: 2,
        piece_degrees: [5, 5, 7],
    },
];

/// The bytes of `de440.bin` out of the kernel `de440.bsp`.
pub fn table(kernel: &Kernel) -> Result<Vec<u8>, String> {
    let samples: Vec<_> = PLANS
        .iter()
        .map(|plan| {
            // Asked at both ends, a kernel that has other bodies or years says so; no number stands
            // for what is missing between them.
            for days in [0.0, f64::from(DAYS)] {
                plan.body.km(kernel, JulianDate::from_parts(FIRST_JD, days))?;
            }
            let missing = DVec3::splat(f64::NAN);
            Ok(move |tdb: JulianDate<Tdb>| plan.body.km(kernel, tdb).unwrap_or(missing))
        })
        .collect::<Result<_, String>>()?;
    let sources: Vec<ChannelSource> = PLANS
        .iter()
        .zip(&samples)
        .map(|(plan, sample)| ChannelSource { recipe: plan.recipe(), sample })
        .collect();
    encode(&sources)
}

impl Plan {
    fn recipe(&self) -> Recipe {
        Recipe {
            id: self.id.into(),
            start_jd: FIRST_JD,
            segment_days: f64::from(self.segment_days),
            segments: DAYS / self.segment_days,
            components: 3,
            degree: self.degree,
            quantum: self.quantum_km,
            omitted_bits: self.omitted_bits,
            reference: match self.orbit {
                Some(orbit) => Reference::Orbit(Box::new(orbit.clone())),
                None => Reference::None,
            },
            folding: self.piece_degrees.map(|degree| Folding { pieces: self.pieces, degree }),
        }
    }
}

impl Place {
    fn km(&self, kernel: &Kernel, tdb: JulianDate<Tdb>) -> Result<DVec3, String> {
        let from = |target, center| kernel.position_km(target, center, tdb);
        match *self {
            Place::FromBarycentre(body) => from(body, BARYCENTRE),
            Place::FromSun(body) => Ok(from(body, BARYCENTRE)? - from(SUN, BARYCENTRE)?),
            Place::MoonFromEarth => Ok(from(MOON, EARTH_MOON)? - from(EARTH, EARTH_MOON)?),
        }
    }
}
