//! Polar motion: where the axis of rotation comes out of the crust of the Earth.
//!
//! *Theory.* IERS Conventions 2010, eq. 5.3: the turns about x and y by the measured coordinates of
//! the pole, and s', which keeps the origin of longitudes from rotating.
//!
//! *Accuracy.* The shipped table has a row every five days, from 1962 to the end of the prediction,
//! and is interpolated linearly. A row lies 0.001" from the line through its neighbours, 0.005" at
//! most since 1995 and 0.018" before: interpolation costs less than that. Outside the table there is
//! no polar motion, and at most 0.6" is left out.

use std::sync::LazyLock;

use glam::DMat3;

use crate::ephemeris::polynomial::polynomial;
use crate::frame::{turn_axes_x, turn_axes_y, turn_axes_z};
use crate::time::{JulianDate, Tt, Utc};
use crate::units::Angle;

/// Julian date of the modified Julian date 0.
const MJD_ZERO_JD: f64 = 2_400_000.5;

/// Coordinates of the celestial intermediate pole on the crust of the Earth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PolarMotion {
    /// Towards the prime meridian.
    pub x: Angle,
    /// Towards 90 degrees west.
    pub y: Angle,
}

/// A row of the table: MJD (UTC), x and y in arcseconds.
type Row = [f64; 3];

static TABLE: LazyLock<Vec<Row>> = LazyLock::new(|| {
    read(include_str!("../../../catalogs/time/ut1_utc.csv"))
        .expect("the embedded Earth orientation table is well formed (a test reads it)")
});

fn read(table: &str) -> Option<Vec<Row>> {
    let is_row = |line: &&str| line.starts_with(|c: char| c.is_ascii_digit());
    let row = |line: &str| {
        let fields: Option<Vec<f64>> = line.split(',').map(|field| field.parse().ok()).collect();
        match fields?[..] {
            [mjd, _, x_arcsec, y_arcsec] => Some([mjd, x_arcsec, y_arcsec]),
            _ => None,
        }
    };
    table.lines().filter(is_row).map(row).collect()
}

/// Polar motion by the shipped IERS table; zero outside of it.
pub fn polar_motion(utc: JulianDate<Utc>) -> PolarMotion {
    let mjd = (utc.day() - MJD_ZERO_JD) + utc.fraction();
    let after = TABLE.partition_point(|row| row[0] <= mjd);
    let Some((low, high)) = after.checked_sub(1).and_then(|i| TABLE.get(i).zip(TABLE.get(after)))
    else {
        return PolarMotion::default();
    };
    let u = (mjd - low[0]) / (high[0] - low[0]);
    let at = |i: usize| Angle::from_arcsec(low[i] + u * (high[i] - low[i]));
    PolarMotion { x: at(1), y: at(2) }
}

impl PolarMotion {
    /// Axes of the crust from axes that turn with the Earth about the intermediate pole: the inverse
    /// of `W` of IERS Conventions 2010, eq. 5.3; s' by eq. 5.13.
    pub(super) fn matrix(self, tt: JulianDate<Tt>) -> DMat3 {
        let s_prime = Angle::from_arcsec(polynomial(&[0.0, -47e-6], tt.centuries_since_j2000()));
        turn_axes_x(-self.y) * turn_axes_y(-self.x) * turn_axes_z(s_prime)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_interpolated_and_ends() {
        // Rows of the table: 61698 and 61703.
        let at = |mjd: f64| polar_motion(JulianDate::from_parts(MJD_ZERO_JD, mjd));
        assert!((at(61_698.0).x.arcsec() - 0.1959).abs() < 1e-9);
        assert!((at(61_700.5).y.arcsec() - 0.27885).abs() < 1e-9);
        assert_eq!(at(61_710.0), PolarMotion::default());
        assert_eq!(at(0.0), PolarMotion::default());
    }

    #[test]
    fn broken_tables_are_noticed() {
        assert!(read("41315,0.1,0.2").is_none());
        assert!(read("41315,0.1,x,0.2").is_none());
    }

    /// `pom00` of ERFA 2.0.1 for x 0.2", y -0.35" and s' of the year 2100, -0.000047".
    #[rustfmt::skip]
    const ERFA_POM00: [[f64; 3]; 3] = [
        [ 9.999_999_999_995_3e-1, -2.278_624_301_213_7e-10, 9.696_273_622_189_2e-7],
        [ 2.262_171_199_834_2e-10, 9.999_999_999_985_604e-1, 1.696_847_883_881_8e-6],
        [-9.696_273_626_041_7e-7, -1.696_847_883_661_6e-6, 9.999_999_999_980_903e-1],
    ];

    #[test]
    fn the_matrix_is_that_of_erfa() {
        let polar_motion = PolarMotion { x: Angle::from_arcsec(0.2), y: Angle::from_arcsec(-0.35) };
        let matrix = polar_motion.matrix(JulianDate::from_jd(2_451_545.0 + 36_525.0));
        for (row, expected) in ERFA_POM00.into_iter().enumerate() {
            assert!(matrix.row(row).abs_diff_eq(expected.into(), 1e-15), "{matrix}");
        }
    }
}
