//! How DE431 is packed for deep time: which channels, in which segments, how finely. For the maker of
//! `catalogs/de431.bin` alone; what reads it is the table.
//!
//! *Source.* JPL's ephemeris DE431 (Folkner, Williams, Boggs, Park & Kuchynka 2014, IPN Progress Report
//! 42-196), a numerical integration over thirty millennia, out of the files of Swiss Ephemeris, which
//! keep it within a few milliarcseconds.
//!
//! *What is kept.* Planets within 0.12", the Moon within 1" as the Earth sees them: the largest of 100,000
//! dates, which `pack` prints.
//! One depth: all bits lie in the first layer.
//!
//! *How the Moon is kept.* By [`super::resampled::Reference::DeepMoon`], a series, with nothing stored
//! beside it: the quantum is larger than what the series strays by.
//!
//! *What is left out.* Asteroids, and the planets beside the barycentres of their systems.

mod orbits;
mod samples;

use glam::DVec3;

use super::resampled::{ChannelSource, Folding, LAYERS, Orbit, Recipe, Reference, encode};
use crate::time::{JulianDate, Tdb};
pub use samples::Samples;

/// First Julian date of the table, 134 days before the Julian epoch -3000.0, and the days that it
/// holds: to the Julian epoch 3001.0.
const FIRST_JD: f64 = 625_160.5;
const DAYS: u32 = 2_192_000;

/// A channel and how it is cut.
struct Plan {
    id: &'static str,
    reference: Motion,
    segment_days: u32,
    degree: usize,
    /// Kilometres: along the radius, across it in the plane of the orbit, across the plane.
    quantum_km: [f64; 3],
    folding: Folding,
}

enum Motion {
    Unknown,
    Orbit(&'static Orbit),
    Moon,
}

const fn pieces(pieces: usize, degree: usize) -> Folding {
    Folding { pieces, degree }
}

const PLANS: [Plan; 11] = [
    Plan {
        id: "sun",
        reference: Motion::Unknown,
        segment_days: 500,
        degree: 7,
        quantum_km: [30.0; 3],
        folding: pieces(1, 7),
    },
    Plan {
        id: "moon",
        reference: Motion::Moon,
        segment_days: 8,
        degree: 1,
        quantum_km: [100.0; 3],
        folding: pieces(1, 11),
    },
    Plan {
        id: "earth-moon",
        reference: Motion::Orbit(&orbits::EARTH_MOON),
        segment_days: 160,
        degree: 9,
        quantum_km: [5.0, 3.0, 3.0],
        folding: pieces(4, 7),
    },
    Plan {
        id: "mercury",
        reference: Motion::Orbit(&orbits::MERCURY),
        segment_days: 80,
        degree: 11,
        quantum_km: [10.0, 6.0, 6.0],
        folding: pieces(4, 13),
    },
    Plan {
        id: "venus",
        reference: Motion::Orbit(&orbits::VENUS),
        segment_days: 160,
        degree: 10,
        quantum_km: [5.0, 3.0, 3.0],
        folding: pieces(4, 7),
    },
    Plan {
        id: "mars",
        reference: Motion::Orbit(&orbits::MARS),
        segment_days: 250,
        degree: 10,
        quantum_km: [8.0, 5.0, 5.0],
        folding: pieces(4, 7),
    },
    Plan {
        id: "jupiter",
        reference: Motion::Orbit(&orbits::JUPITER),
        segment_days: 1000,
        degree: 12,
        quantum_km: [100.0, 60.0, 60.0],
        folding: pieces(4, 5),
    },
    Plan {
        id: "saturn",
        reference: Motion::Orbit(&orbits::SATURN),
        segment_days: 1000,
        degree: 8,
        quantum_km: [200.0, 150.0, 150.0],
        folding: pieces(2, 5),
    },
    Plan {
        id: "uranus",
        reference: Motion::Orbit(&orbits::URANUS),
        segment_days: 2000,
        degree: 11,
        quantum_km: [400.0, 300.0, 300.0],
        folding: pieces(2, 5),
    },
    Plan {
        id: "neptune",
        reference: Motion::Orbit(&orbits::NEPTUNE),
        segment_days: 2000,
        degree: 8,
        quantum_km: [600.0, 500.0, 500.0],
        folding: pieces(2, 5),
    },
    Plan {
        id: "pluto",
        reference: Motion::Orbit(&orbits::PLUTO),
        segment_days: 2000,
        degree: 8,
        quantum_km: [600.0, 500.0, 500.0],
        folding: pieces(2, 5),
    },
];

/// The bytes of `de431.bin` out of the samples.
pub fn table(samples: &Samples) -> Result<Vec<u8>, String> {
    // Asked at both ends, samples of other bodies or years say so; no number stands for what is
    // missing between them.
    for plan in &PLANS {
        for days in [0.0, f64::from(DAYS)] {
            samples.position_km(plan.id, JulianDate::from_parts(FIRST_JD, days))?;
        }
    }
    let functions = PLANS.each_ref().map(|plan| {
        let missing = DVec3::splat(f64::NAN);
        move |tdb: JulianDate<Tdb>| samples.position_km(plan.id, tdb).unwrap_or(missing)
    });
    let sources: Vec<ChannelSource> = PLANS
        .iter()
        .zip(&functions)
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
            omitted_bits: [0; LAYERS - 1],
            reference: match self.reference {
                Motion::Unknown => Reference::None,
                Motion::Orbit(orbit) => Reference::Orbit(Box::new(orbit.clone())),
                Motion::Moon => Reference::DeepMoon,
            },
            folding: [self.folding; LAYERS],
        }
    }
}
