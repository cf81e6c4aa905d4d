//! The Moon from -3000 to +3000 by a series fitted to JPL's ephemeris DE431.
//!
//! *Theory.* As in ELP-2000 (Chapront-Touzé & Chapront 1983, A&A 124, 50), longitude, latitude and
//! distance in the ecliptic of date are sums of sines and cosines of whole multiples of the Delaunay
//! arguments D, l', l, F, of the mean longitudes of five planets, and of the precession.
//!
//! *How we differ.* No coefficient comes from a theory: terms, coefficients and the polynomials of the
//! Moon's arguments are fitted to DE431 (Folkner et al. 2014, IPN Progress Report 42-196) by
//! `scripts/de431_moon.py`. Where the Earth's shrinking eccentricity changes a coefficient, powers of
//! time follow it. The ecliptic is that of DE431's own Earth, smoothed, and longitudes count from a
//! point in it that does not turn, so that no model of precession comes in.
//!
//! *Accuracy.* Within 1" and 1.8 km of DE431, the largest of 100,000 dates (`pack` prints it). What DE440
//! has changed since is as much: 0.8" at 1550, 1.6" at 2650.

mod arguments;
mod distance;
mod latitude;
mod longitude;

use glam::DVec3;

use arguments::{ARGUMENTS, LONGITUDE, MIDDLE_CENTURIES, POLE, REACH, UNIT_CENTURIES};

use super::polynomial::polynomial;
use crate::frame::{Icrs, Pos, turn_axes_x};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Multiples of the arguments, power of time, coefficients of sine and cosine.
type Term = ([i8; ARGUMENTS.len()], u8, i32, i32);

/// Unit of the coefficients of longitude and latitude.
const UNIT: Angle = Angle::from_arcsec(1e-4);
/// Obliquity of the ecliptic J2000.0 with which the series was fitted, arcseconds.
const OBLIQUITY_J2000_ARCSEC: f64 = 84_381.406;
/// Largest multiple of any argument.
const LARGEST: usize = 30;
/// Powers of time that a coefficient may have: 0 to 3.
const POWERS: usize = 4;

/// A cosine and a sine, multiplied like complex numbers: their angles add.
#[derive(Clone, Copy)]
struct Phasor {
    cos: f64,
    sin: f64,
}

impl Phasor {
    const ONE: Phasor = Phasor { cos: 1.0, sin: 0.0 };

    fn times(self, other: Phasor) -> Phasor {
        Phasor {
            cos: self.cos * other.cos - self.sin * other.sin,
            sin: self.sin * other.cos + self.cos * other.sin,
        }
    }
}

/// Phasors of all multiples of all arguments at one moment.
struct Multiples([[Phasor; 2 * LARGEST + 1]; ARGUMENTS.len()]);

impl Multiples {
    fn at(time: f64) -> Multiples {
        let mut table = [[Phasor::ONE; 2 * LARGEST + 1]; ARGUMENTS.len()];
        for ((row, powers), reach) in table.iter_mut().zip(&ARGUMENTS).zip(REACH) {
            let (sin, cos) = polynomial(powers, time).sin_cos();
            for multiple in 1..=reach {
                let phasor = row[LARGEST + multiple - 1].times(Phasor { cos, sin });
                row[LARGEST + multiple] = phasor;
                row[LARGEST - multiple] = Phasor { sin: -phasor.sin, ..phasor };
            }
        }
        Multiples(table)
    }

    fn phasor(&self, multiples: &[i8; ARGUMENTS.len()]) -> Phasor {
        let mut product = Phasor::ONE;
        for (row, &multiple) in self.0.iter().zip(multiples) {
            if multiple != 0 {
                product = product.times(row[(LARGEST as i32 + i32::from(multiple)) as usize]);
            }
        }
        product
    }

    /// The sum of all terms, in their unit.
    fn sum(&self, terms: &[Term], time: f64) -> f64 {
        let mut by_power = [0.0; POWERS];
        let (mut known, mut phasor) = ([0; ARGUMENTS.len()], Phasor::ONE);
        for (multiples, power, sine, cosine) in terms {
            // Terms that differ in the power alone follow one another.
            if *multiples != known {
                (known, phasor) = (*multiples, self.phasor(multiples));
            }
            by_power[usize::from(*power)] +=
                f64::from(*sine) * phasor.sin + f64::from(*cosine) * phasor.cos;
        }
        polynomial(&by_power, time)
    }
}

/// Geocentric geometric position of the Moon, for Julian years -3000 to +3001.
///
/// Outside these years the polynomials in time run away.
pub fn moon(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let time = (tdb.centuries_since_j2000() - MIDDLE_CENTURIES) / UNIT_CENTURIES;
    let multiples = Multiples::at(time);
    let longitude = Angle::from_rad(polynomial(&LONGITUDE, time))
        + UNIT * multiples.sum(&longitude::TERMS, time);
    let latitude = UNIT * multiples.sum(&latitude::TERMS, time);
    let distance_km = multiples.sum(&distance::TERMS, time) * 1e-3;
    let (sin_longitude, cos_longitude) = longitude.sin_cos();
    let (sin_latitude, cos_latitude) = latitude.sin_cos();
    let of_date =
        DVec3::new(cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude);
    let j2000 = from_ecliptic_of_date(of_date, POLE.map(|powers| polynomial(&powers, time)));
    let equator = turn_axes_x(-Angle::from_arcsec(OBLIQUITY_J2000_ARCSEC)) * j2000;
    Pos::from_km(equator * distance_km)
}

/// The smallest rotation that takes z to the pole, whose first two coordinates are given.
fn from_ecliptic_of_date(v: DVec3, [x, y]: [f64; 2]) -> DVec3 {
    let height = (1.0 - x * x - y * y).sqrt();
    let along = x * v.x + y * v.y;
    let shift = v.z - along / (1.0 + height);
    DVec3::new(v.x + x * shift, v.y + y * shift, height * v.z - along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::moon;

    #[test]
    fn every_term_is_within_reach() {
        for terms in [&longitude::TERMS[..], &latitude::TERMS, &distance::TERMS] {
            assert!(terms.is_sorted_by_key(|(multiples, power, ..)| (multiples, power)));
            for (multiples, power, ..) in terms {
                assert!(usize::from(*power) < POWERS, "{multiples:?}");
                for (multiple, reach) in multiples.iter().zip(REACH) {
                    let multiple = usize::from(multiple.unsigned_abs());
                    assert!(multiple <= reach && reach <= LARGEST, "{multiples:?}");
                }
            }
        }
    }

    #[test]
    fn the_ecliptic_is_turned_and_not_bent() {
        let pole = [0.01, -0.02];
        let turned = from_ecliptic_of_date(DVec3::Z, pole);
        assert!((turned.truncate() - glam::DVec2::from(pole)).length() < 1e-16);
        let (a, b) = (DVec3::new(0.3, -0.5, 0.2), DVec3::new(-0.7, 0.1, 0.6));
        let dot = from_ecliptic_of_date(a, pole).dot(from_ecliptic_of_date(b, pole));
        assert!((dot - a.dot(b)).abs() < 1e-15);
        // The smallest turn leaves its own axis where it is.
        let axis = DVec3::new(0.02, 0.01, 0.0);
        assert!((from_ecliptic_of_date(axis, pole) - axis).length() < 1e-17);
    }

    #[test]
    fn it_agrees_with_the_truncated_theory() {
        for year in [1600.0, 1800.0, 2000.0, 2200.0, 2400.0, 2600.0] {
            for day in 0..60 {
                let jd = 2_451_545.0 + 365.25 * (year - 2000.0) + 7.0 * f64::from(day);
                let tdb = JulianDate::from_jd(jd);
                let (here, there) = (super::moon(tdb), moon::moon(tdb));
                let apart = here.dir().separation(there.dir()).arcsec();
                // The bound of the truncation, which is worse by far.
                assert!(apart < 28.0, "JD {jd}: {apart}");
                let further_km = here.distance_km() - there.distance_km();
                assert!(further_km.abs() < 30.0, "JD {jd}: {further_km} km");
            }
        }
    }
}
