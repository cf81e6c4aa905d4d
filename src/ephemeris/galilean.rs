//! The four great moons of Jupiter, by the theory E5.
//!
//! *Theory.* Lieske 1998, "Galilean satellite ephemerides E5", *Astron. Astrophys. Suppl.* 129, 205, in
//! the form of Meeus 1998, *Astronomical Algorithms*, 2nd ed., chapter 44: longitude, latitude and
//! radius in periodic terms (`galilean/terms.rs`), on the equator of Jupiter. Arguments, mean distances
//! and the planes of B1950 are those of Lieske 1998. From B1950 to the ICRS: the matrix of Murray 1989,
//! *Astron. Astrophys.* 218, 325 (recalled; its columns are tested to be orthonormal).
//!
//! *Omitted.* Terms below 0.0001 degrees; the way of Jupiter about the barycentre of its system, which
//! the planets' theories give as Jupiter (230 km, 0.07"); the motion of Jupiter while light crosses the
//! system (0.02").
//!
//! *Accuracy.* Against the integrated JUP310 of JPL: 450 km (0.14") on 2 March 2015 and 1810 km
//! (0.6" at opposition) on 9 October 2053 (`tests/galilean.rs`); against the series of the Bureau des
//! Longitudes in libastro, in the plane of the sky, 2004 to 2034: 1.5". [`Galilean::bound`] is what
//! is stated; beyond this century it is an estimate.

mod terms;

use std::fmt;

use glam::{DMat3, DVec3};

use crate::frame::{Dir, Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::{AU_KM, Angle};

/// Radius of Jupiter at its equator, kilometres (Archinal et al. 2018, table 4).
pub const JUPITER_EQUATORIAL_RADIUS_KM: f64 = 71_492.0;
/// Radius of Jupiter at its poles, kilometres (same).
pub const JUPITER_POLAR_RADIUS_KM: f64 = 66_854.0;

/// A great moon of Jupiter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Galilean {
    Io,
    Europa,
    Ganymede,
    Callisto,
}

impl Galilean {
    /// Outwards.
    pub const ALL: [Galilean; 4] =
        [Galilean::Io, Galilean::Europa, Galilean::Ganymede, Galilean::Callisto];

    /// The English name.
    pub const fn name(self) -> &'static str {
        match self {
            Galilean::Io => "Io",
            Galilean::Europa => "Europa",
            Galilean::Ganymede => "Ganymede",
            Galilean::Callisto => "Callisto",
        }
    }

    /// Mean radius, kilometres (Archinal et al. 2018, table 5).
    pub const fn radius_km(self) -> f64 {
        match self {
            Galilean::Io => 1821.49,
            Galilean::Europa => 1560.8,
            Galilean::Ganymede => 2631.2,
            Galilean::Callisto => 2410.3,
        }
    }

    /// Bound of the error of the direction from Jupiter, as seen from the Earth: 0.4" in 2000 and
    /// 0.01" more for each year before or after. Measured to 2053; an estimate farther off.
    pub fn bound(tdb: JulianDate<Tdb>) -> Angle {
        Angle::from_arcsec(0.4 + tdb.centuries_since_j2000().abs())
    }

    /// Where the moon is at that moment, from the centre of Jupiter. No light time, no aberration.
    pub fn from_jupiter(self, tdb: JulianDate<Tdb>) -> Pos<Icrs> {
        let moon = self as usize;
        let mut arguments = Arguments::at(tdb);
        let above_mean_deg = arguments.sum(terms::LONGITUDE[moon], f64::sin);
        arguments.set(Argument::S, above_mean_deg);
        let longitude_deg = arguments.deg[moon] + above_mean_deg;
        arguments.set(Argument::L, longitude_deg);
        let latitude = arguments.sum(terms::LATITUDE[moon], f64::sin).atan();
        let share = arguments.sum(terms::RADIUS[moon], f64::cos);
        let radius_km = MEAN_DISTANCE_AU[moon] * AU_KM * (1.0 + share);
        let node_deg = arguments.deg[Argument::Psi as usize];
        let (sin, cos) = Angle::from_deg(longitude_deg - node_deg).sin_cos();
        let on_equator =
            DVec3::new(cos * latitude.cos(), sin * latitude.cos(), latitude.sin()) * radius_km;
        Pos::from_km(icrs_from_equator(node_deg) * on_equator)
    }
}

impl fmt::Display for Galilean {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(self.name())
    }
}

/// North pole of Jupiter.
///
/// Archinal et al. 2018, *Celest. Mech. Dyn. Astron.* 130, 22, table 1 (WGCCRE 2015), in ICRS axes:
/// right ascension 268.056595 - 0.006499 T, declination 64.495303 + 0.002413 T degrees, T in Julian
/// centuries. Nutations of 0.002 degrees are left out.
pub fn jupiter_pole(tdb: JulianDate<Tdb>) -> Dir<Icrs> {
    let t = tdb.centuries_since_j2000();
    Dir::from_spherical(
        Angle::from_deg(268.056_595 - 0.006_499 * t),
        Angle::from_deg(64.495_303 + 0.002_413 * t),
    )
}

/// Mean distances of E5, astronomical units.
const MEAN_DISTANCE_AU: [f64; 4] = [2.819_353e-3, 4.485_883e-3, 7.155_366e-3, 12.585_464e-3];

/// Epoch of E5, Julian date.
const EPOCH_JD: f64 = 2_443_000.5;

/// What the periodic terms depend on; names as in Meeus.
#[derive(Debug, Clone, Copy)]
enum Argument {
    L1,
    L2,
    L3,
    L4,
    P1,
    P2,
    P3,
    P4,
    W1,
    W2,
    W3,
    W4,
    Psi,
    Phi,
    G,
    Gs,
    Pi,
    L,
    S,
}

/// One periodic term.
struct Term {
    amplitude: f64,
    phase_deg: f64,
    /// Arguments and how often each is taken.
    of: &'static [(Argument, f64)],
}

/// The arguments at one moment, degrees, by [`Argument`].
struct Arguments {
    deg: [f64; 19],
}

/// Value at the epoch, degrees, and change in a day, of `L1` to `Gs`.
#[rustfmt::skip]
const LINEAR: [(f64, f64); 16] = [
    (106.077_187, 203.488_955_790_33), (175.731_615, 101.374_724_734_79),
    (120.558_829, 50.317_609_207_02), (84.444_587, 21.571_071_176_68),
    (97.088_086, 0.161_385_861_44), (154.866_335, 0.047_263_066_09),
    (188.184_037, 0.007_127_339_49), (335.286_807, 0.001_839_996_37),
    (312.334_566, -0.132_793_859_40), (100.441_116, -0.032_630_637_31),
    (119.194_241, -0.007_177_031_55), (322.618_633, -0.001_759_338_80),
    (316.518_203, -2.083_62e-6), (199.676_608, 0.173_791_904_61),
    (30.237_557, 0.083_092_570_10), (31.978_528, 0.033_459_733_90),
];
/// Longitude of the perihelion of Jupiter, degrees.
const PERIHELION_DEG: f64 = 13.469_942;

impl Arguments {
    fn at(tdb: JulianDate<Tdb>) -> Arguments {
        let days = tdb.jd() - EPOCH_JD;
        let mut deg = [0.0; 19];
        for (value, (start, rate)) in deg.iter_mut().zip(LINEAR) {
            *value = start + rate * days;
        }
        // The great inequality of Jupiter.
        deg[Argument::G as usize] += 0.330_33 * Angle::from_deg(163.679 + 0.001_051_2 * days).sin()
            + 0.034_39 * Angle::from_deg(34.486 - 0.016_173_1 * days).sin();
        deg[Argument::Pi as usize] = PERIHELION_DEG;
        Arguments { deg }
    }

    fn set(&mut self, argument: Argument, deg: f64) {
        self.deg[argument as usize] = deg;
    }

    fn sum(&self, terms: &[Term], wave: fn(f64) -> f64) -> f64 {
        let value = |term: &Term| {
            let parts =
                term.of.iter().map(|&(argument, times)| times * self.deg[argument as usize]);
            term.amplitude * wave((term.phase_deg + parts.sum::<f64>()).to_radians())
        };
        terms.iter().map(value).sum()
    }
}

/// From the equator of Jupiter, its node first, to the ICRS; the planes are those of Lieske 1998.
fn icrs_from_equator(node_deg: f64) -> DMat3 {
    const EQUATOR_ON_ORBIT: Angle = Angle::from_deg(3.104_01);
    const ORBIT_ON_ECLIPTIC: Angle = Angle::from_deg(1.306_91);
    const NODE_OF_ORBIT_DEG: f64 = 99.953_26;
    const OBLIQUITY_1950: Angle = Angle::from_deg(23.445_788_9);
    let about_x = |angle: Angle| DMat3::from_rotation_x(angle.rad());
    let about_z = |deg: f64| DMat3::from_rotation_z(deg.to_radians());
    J2000_FROM_B1950
        * about_x(OBLIQUITY_1950)
        * about_z(NODE_OF_ORBIT_DEG)
        * about_x(ORBIT_ON_ECLIPTIC)
        * about_z(node_deg - NODE_OF_ORBIT_DEG)
        * about_x(EQUATOR_ON_ORBIT)
}

/// Precession of the equator from B1950 to J2000, by columns.
const J2000_FROM_B1950: DMat3 = DMat3::from_cols(
    DVec3::new(0.999_925_679_495_687_7, 0.011_181_483_239_171_7, 0.004_859_003_772_314_3),
    DVec3::new(-0.011_181_483_220_466_2, 0.999_937_484_893_313_5, -0.000_027_170_293_744_0),
    DVec3::new(-0.004_859_003_815_359_2, -0.000_027_162_594_714_2, 0.999_988_194_602_374_2),
);

#[cfg(test)]
mod tests {
    use super::*;

    fn day(jd: f64) -> JulianDate<Tdb> {
        JulianDate::from_jd(jd)
    }

    #[test]
    fn precession_turns_and_does_nothing_else() {
        let product = J2000_FROM_B1950 * J2000_FROM_B1950.transpose();
        assert!((product - DMat3::IDENTITY).abs_diff_eq(DMat3::ZERO, 1e-9), "{product:?}");
    }

    #[test]
    fn orbits_lie_about_the_equator_of_jupiter() {
        // Inclinations to the equator: 0.04, 0.47, 0.2 and 0.3 degrees (Lieske 1998), Callisto's
        // about a plane that leans by 0.4.
        for (moon, most_deg) in Galilean::ALL.into_iter().zip([0.1, 0.6, 0.5, 0.9]) {
            for step in 0..200 {
                let tdb = day(2_455_000.5 + 20.37 * f64::from(step));
                let sin = moon.from_jupiter(tdb).dir().dot(jupiter_pole(tdb));
                assert!(sin.asin().to_degrees().abs() < most_deg, "{moon}: {sin}");
            }
        }
    }

    #[test]
    fn the_three_inner_moons_keep_laplace_s_relation() {
        // l1 - 3 l2 + 2 l3 = 180 degrees; true longitudes stray by the equations of the centre.
        for step in 0..100 {
            let tdb = day(2_455_000.5 + 11.3 * f64::from(step));
            let node = jupiter_pole(tdb).vector().any_orthonormal_vector();
            let across = jupiter_pole(tdb).vector().cross(node);
            let longitude = |moon: Galilean| {
                let at = moon.from_jupiter(tdb).km();
                Angle::from_rad(at.dot(across).atan2(at.dot(node)))
            };
            let sum = longitude(Galilean::Io) - longitude(Galilean::Europa) * 3.0
                + longitude(Galilean::Ganymede) * 2.0;
            let off = (sum - Angle::from_deg(180.0)).signed();
            assert!(off.deg().abs() < 5.0, "{}", off.deg());
        }
    }
}
