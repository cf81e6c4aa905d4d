//! The planets by the mean elements and periodic terms of Simon et al. 1994, A&A 282, 663.
//!
//! *Accuracy.* Heliocentric, in 1800-2050 (ERFA's comparison of the same theory with DE200): 9" for
//! Mercury, Venus and the Earth, 26" for Mars, 90" for Jupiter, Saturn and Uranus, 11" for Neptune.
//! The paper states 1000-3000 as its range; we measured it beyond, to half a degree for Saturn at
//! -4000 (see the table in [`crate::ephemeris`]).

mod terms;

use glam::DVec3;
use terms::{ARGUMENT_RATE, Elements};

use crate::ephemeris::body::Body;
use crate::ephemeris::galilean::jupiter_pole;
use crate::ephemeris::polynomial::polynomial;
use crate::frame::{Dir, Icrs, Pos, turn_axes_x};
use crate::time::{JulianDate, Tdb};
use crate::units::{AU_KM, Angle};

/// Obliquity of the ecliptic J2000.0 that the theory was written with (IAU 1976), arcseconds.
const OBLIQUITY_J2000_ARCSEC: f64 = 84_381.448;

const DAYS_PER_MILLENNIUM: f64 = 365_250.0;

/// An osculating or mean ellipse at one moment, ecliptic J2000.0.
pub(super) struct Ellipse {
    pub axis_au: f64,
    pub eccentricity: f64,
    pub mean_anomaly: Angle,
    pub perihelion: Angle,
    pub node: Angle,
    pub inclination: Angle,
}

impl Ellipse {
    /// Heliocentric position. The J2000.0 mean axes are taken for ICRS axes: 0.02" at most.
    pub fn position(&self) -> Pos<Icrs> {
        let anomaly = eccentric_anomaly(self.mean_anomaly, self.eccentricity);
        let (sin, cos) = anomaly.sin_cos();
        let x = self.axis_au * (cos - self.eccentricity);
        let y = self.axis_au * (1.0 - self.eccentricity * self.eccentricity).sqrt() * sin;
        let (sin_peri, cos_peri) = (self.perihelion - self.node).sin_cos();
        let (sin_node, cos_node) = self.node.sin_cos();
        let (sin_inc, cos_inc) = self.inclination.sin_cos();
        // In the plane of the orbit, from the ascending node.
        let along = x * cos_peri - y * sin_peri;
        let across = x * sin_peri + y * cos_peri;
        let ecliptic = DVec3::new(
            along * cos_node - across * sin_node * cos_inc,
            along * sin_node + across * cos_node * cos_inc,
            across * sin_inc,
        );
        let obliquity = Angle::from_arcsec(OBLIQUITY_J2000_ARCSEC);
        Pos::from_km(turn_axes_x(-obliquity) * ecliptic * AU_KM)
    }
}

/// Kepler's equation by Newton's method, to 1e-13 rad; for eccentricities of planets.
fn eccentric_anomaly(mean_anomaly: Angle, eccentricity: f64) -> Angle {
    debug_assert!((0.0..0.9).contains(&eccentricity), "not a planet: e = {eccentricity}");
    let mean = mean_anomaly.signed().rad();
    let mut anomaly = mean + eccentricity * mean.sin();
    for _ in 0..20 {
        let (sin, cos) = anomaly.sin_cos();
        let step = (mean - anomaly + eccentricity * sin) / (1.0 - eccentricity * cos);
        anomaly += step;
        if step.abs() < 1e-13 {
            break;
        }
    }
    Angle::from_rad(anomaly)
}

fn heliocentric(elements: &Elements, tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let t = tdb.days_since_j2000() / DAYS_PER_MILLENNIUM;
    let mu = ARGUMENT_RATE * t;
    // All terms, the last `with_time` of them multiplied by time.
    let sum = |terms: &[(f64, f64, f64)], with_time: usize| -> f64 {
        let first_with_time = terms.len() - with_time;
        terms
            .iter()
            .enumerate()
            .map(|(i, &(multiple, cosine, sine))| {
                let (sin, cos) = (multiple * mu).sin_cos();
                (cosine * cos + sine * sin) * if i < first_with_time { 1.0 } else { t }
            })
            .sum::<f64>()
            * 1e-7
    };
    // Degrees, then arcseconds per power of time.
    let angle = |c: &[f64; 3]| {
        Angle::from_deg(c[0]) + Angle::from_arcsec(polynomial(&[0.0, c[1], c[2]], t) % 1_296_000.0)
    };
    let longitude = angle(&elements.longitude) + Angle::from_rad(sum(&elements.longitude_terms, 2));
    let perihelion = angle(&elements.perihelion);
    Ellipse {
        axis_au: polynomial(&elements.axis_au, t) + sum(&elements.axis_terms, 1),
        eccentricity: polynomial(&elements.eccentricity, t),
        mean_anomaly: longitude - perihelion,
        perihelion,
        node: angle(&elements.node),
        inclination: angle(&elements.inclination),
    }
    .position()
}

/// Heliocentric geometric position of Mercury.
pub fn mercury(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::MERCURY, tdb)
}
/// Heliocentric geometric position of Venus.
pub fn venus(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::VENUS, tdb)
}
/// Heliocentric geometric position of the barycentre of Earth and Moon.
pub fn earth_moon_barycentre(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::EARTH_MOON_BARYCENTRE, tdb)
}
/// Heliocentric geometric position of Mars.
pub fn mars(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::MARS, tdb)
}
/// Heliocentric geometric position of Jupiter (the barycentre of its system).
pub fn jupiter(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::JUPITER, tdb)
}
/// Heliocentric geometric position of Saturn (the barycentre of its system).
pub fn saturn(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::SATURN, tdb)
}
/// Heliocentric geometric position of Uranus (the barycentre of its system).
pub fn uranus(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::URANUS, tdb)
}
/// Heliocentric geometric position of Neptune (the barycentre of its system).
pub fn neptune(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    heliocentric(&terms::NEPTUNE, tdb)
}

/// Heliocentric geometric position of Pluto (the barycentre of its system).
///
/// Keplerian elements for 3000 BC to 3000 AD: Standish, "Keplerian elements for approximate
/// positions of the major planets", JPL Solar System Dynamics, tables 2a and 2b.
pub fn pluto(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let t = tdb.centuries_since_j2000();
    let longitude = Angle::from_deg(238.965_350_11 + 145.180_429_03 * t);
    let perihelion = Angle::from_deg(224.097_025_98 - 0.009_688_27 * t);
    Ellipse {
        axis_au: 39.486_860_35 + 0.004_497_51 * t,
        eccentricity: 0.248_852_38 + 0.000_060_16 * t,
        // The last term is the only one of table 2b.
        mean_anomaly: longitude - perihelion + Angle::from_deg(-0.012_627_24 * t * t),
        perihelion,
        node: Angle::from_deg(110.301_679_86 - 0.008_099_81 * t),
        inclination: Angle::from_deg(17.141_042_60 + 0.000_005_01 * t),
    }
    .position()
}

/// North pole of a planet that is flattened; none of the others.
///
/// Archinal et al. 2018 as for [`saturn_pole`]; Mars as in their report of 2009 (*Celest. Mech. Dyn.
/// Astron.* 109, 101), which has no long terms. Mars, Uranus and Neptune are recalled, not compared
/// with the publication.
pub fn north_pole(body: Body, tdb: JulianDate<Tdb>) -> Option<Dir<Icrs>> {
    let t = tdb.centuries_since_j2000();
    let [ascension_deg, declination_deg] = match body {
        Body::Jupiter => return Some(jupiter_pole(tdb)),
        Body::Saturn => return Some(saturn_pole(tdb)),
        Body::Mars => [317.681_43 - 0.1061 * t, 52.886_50 - 0.0609 * t],
        Body::Uranus => [257.311, -15.175],
        Body::Neptune => {
            let (sin, cos) = Angle::from_deg(357.85 + 52.316 * t).sin_cos();
            [299.36 + 0.70 * sin, 43.46 - 0.51 * cos]
        }
        _ => return None,
    };
    Some(Dir::from_spherical(Angle::from_deg(ascension_deg), Angle::from_deg(declination_deg)))
}

/// North pole of Saturn and of its rings.
///
/// Archinal et al. 2018, *Celest. Mech. Dyn. Astron.* 130, 22, table 1 (WGCCRE 2015), in ICRS axes:
/// right ascension 40.589 - 0.036 T, declination 83.537 - 0.004 T degrees, T in Julian centuries.
pub fn saturn_pole(tdb: JulianDate<Tdb>) -> Dir<Icrs> {
    let t = tdb.centuries_since_j2000();
    Dir::from_spherical(Angle::from_deg(40.589 - 0.036 * t), Angle::from_deg(83.537 - 0.004 * t))
}
