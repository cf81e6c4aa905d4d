//! The Moon by the truncation of ELP-2000/82 in Meeus 1998, *Astronomical Algorithms*, 2nd ed.,
//! chapter 47.
//!
//! *How we differ.* The mean longitude is that of Simon et al. 1994 without the constant for light
//! time (Meeus subtracts 0.7 arcseconds), because light time is taken into account elsewhere. The
//! frame is the ecliptic of date of the long-term precession.
//!
//! *Accuracy.* 20" at most in 1550-2650 against DE440 and DE431, growing to 5 arcminutes at -4000;
//! the tidal acceleration within the mean elements suits modern ephemerides without correction.

mod terms;

use terms::{LATITUDE, LONGITUDE_AND_DISTANCE, Multiples};

use crate::ephemeris::orientation;
use crate::ephemeris::polynomial::polynomial;
use crate::frame::{Dir, EclipticOfDate, Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Mass of the Earth over mass of the Moon (DE440: Park et al. 2021, AJ 161, 105).
pub const EARTH_MOON_MASS_RATIO: f64 = 81.300_568_22;

/// Mean distance in the theory, metres.
const MEAN_DISTANCE_M: f64 = 385_000_560.0;

/// Mean arguments of the Moon of date (Meeus 1998, eq. 47.1 to 47.6).
#[derive(Debug, Clone, Copy)]
pub(super) struct Arguments {
    /// Mean longitude of the Moon, mean equinox of date (L').
    pub longitude: Angle,
    /// Mean elongation from the Sun (D).
    pub elongation: Angle,
    /// Mean anomaly of the Sun (M).
    pub sun_anomaly: Angle,
    /// Mean anomaly of the Moon (M').
    pub anomaly: Angle,
    /// Mean distance from the ascending node (F).
    pub latitude: Angle,
    /// Eccentricity of the Earth's orbit over that of J2000.0 (E).
    pub eccentricity: f64,
}

impl Arguments {
    pub fn at(tdb: JulianDate<Tdb>) -> Arguments {
        let t = tdb.centuries_since_j2000();
        let angle = |deg: &[f64]| Angle::from_deg(polynomial(deg, t) % 360.0);
        Arguments {
            longitude: angle(&[
                218.316_654_36,
                481_267.881_234_21,
                -0.001_578_6,
                1.0 / 538_841.0,
                -1.0 / 65_194_000.0,
            ]),
            elongation: angle(&[
                297.850_192_1,
                445_267.111_403_4,
                -0.001_881_9,
                1.0 / 545_868.0,
                -1.0 / 113_065_000.0,
            ]),
            sun_anomaly: angle(&[
                357.529_109_2,
                35_999.050_290_9,
                -0.000_153_6,
                1.0 / 24_490_000.0,
            ]),
            anomaly: angle(&[
                134.963_396_4,
                477_198.867_505_5,
                0.008_741_4,
                1.0 / 69_699.0,
                -1.0 / 14_712_000.0,
            ]),
            latitude: angle(&[
                93.272_095_0,
                483_202.017_523_3,
                -0.003_653_9,
                -1.0 / 3_526_000.0,
                1.0 / 863_310_000.0,
            ]),
            eccentricity: polynomial(&[1.0, -0.002_516, -0.000_007_4], t),
        }
    }

    /// The argument of one term and the factor that its solar anomaly asks for.
    fn term(&self, multiples: &Multiples) -> (f64, f64) {
        let [d, m, mp, f] = multiples.map(f64::from);
        let argument = d * self.elongation.rad()
            + m * self.sun_anomaly.rad()
            + mp * self.anomaly.rad()
            + f * self.latitude.rad();
        (argument, self.eccentricity.powi(i32::from(multiples[1].abs())))
    }
}

/// Geocentric geometric position of the Moon.
pub fn moon(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let arguments = Arguments::at(tdb);
    let t = tdb.centuries_since_j2000();
    let l = arguments.longitude;
    let (mp, f) = (arguments.anomaly, arguments.latitude);
    // Venus, Jupiter, and the flattening of the Earth.
    let a1 = Angle::from_deg(119.75 + 131.849 * t);
    let a2 = Angle::from_deg(53.09 + 479_264.290 * t);
    let a3 = Angle::from_deg(313.45 + 481_266.484 * t);

    let mut longitude = 3_958.0 * a1.sin() + 1_962.0 * (l - f).sin() + 318.0 * a2.sin();
    let mut distance_m = MEAN_DISTANCE_M;
    for (multiples, sine, cosine) in LONGITUDE_AND_DISTANCE.iter().rev() {
        let (argument, factor) = arguments.term(multiples);
        let (sin, cos) = argument.sin_cos();
        longitude += sine * factor * sin;
        distance_m += cosine * factor * cos;
    }
    let mut latitude = -2_235.0 * l.sin()
        + 382.0 * a3.sin()
        + 175.0 * ((a1 - f).sin() + (a1 + f).sin())
        + 127.0 * (l - mp).sin()
        - 115.0 * (l + mp).sin();
    for (multiples, sine) in LATITUDE.iter().rev() {
        let (argument, factor) = arguments.term(multiples);
        latitude += sine * factor * argument.sin();
    }

    let dir: Dir<EclipticOfDate> = Dir::from_spherical(
        l + Angle::from_deg(longitude * 1e-6),
        Angle::from_deg(latitude * 1e-6),
    );
    // TDB and TT differ by 2 ms at most: 1e-8 arcsecond of precession.
    orientation::ecliptic_from_icrs(tdb.read_on(0.0)).inverse() * dir.at_km(distance_m / 1000.0)
}

/// Position of the Earth with respect to the barycentre of Earth and Moon.
pub fn earth_from_barycentre(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    moon(tdb) * (-1.0 / (1.0 + EARTH_MOON_MASS_RATIO))
}
