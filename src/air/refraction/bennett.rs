//! Bennett's formula, which knows pressure and temperature alone.
//!
//! *Theory.* Bennett 1982, *Journal of Navigation* 35, 255: at apparent altitude `a` in degrees the
//! refraction is `cot(a + 7.31 / (a + 4.4))` arcminutes at 1010 mbar and 10 degrees Celsius,
//! proportional to pressure and to the inverse of absolute temperature.
//!
//! *How we differ.* 0.00135' are added, so that the zenith stays exactly where it is (Meeus 1998,
//! ch. 16). Below -1.70 degrees, where Bennett's formula has its maximum of 57', the refraction is
//! carried on to zero at the nadir by a squared cosine, which joins with the same slope: a choice,
//! made so that every direction has one image.

use crate::units::Angle;

/// Pressure and temperature that the formula is written for.
const REFERENCE_PRESSURE_MBAR: f64 = 1010.0;
const REFERENCE_TEMPERATURE_K: f64 = 283.0;
/// Melting point of ice as Bennett's scaling rounds it, kelvin.
const ICE_POINT_K: f64 = 273.0;

/// Constants of the formula, degrees squared and degrees.
const A: f64 = 7.31;
const B: f64 = 4.4;
/// Where the argument of the cotangent is least and the refraction greatest: `sqrt(7.31) - 4.4`.
const GREATEST_AT_DEG: f64 = -1.696_298_8;

/// The formula for one pressure and one temperature.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bennett {
    /// Relative to 1010 mbar and 10 degrees Celsius.
    scale: f64,
}

impl Bennett {
    /// No air.
    pub const NONE: Bennett = Bennett { scale: 0.0 };

    /// For the pressure and the temperature at the observer: 0 to 1100 mbar, -90 to 60 degrees
    /// Celsius; what lies outside is brought to the nearer end.
    pub fn new(pressure_mbar: f64, temperature_c: f64) -> Bennett {
        let pressure = pressure_mbar.clamp(0.0, 1100.0) / REFERENCE_PRESSURE_MBAR;
        let temperature_k = temperature_c.clamp(-90.0, 60.0) + ICE_POINT_K;
        Bennett { scale: pressure * REFERENCE_TEMPERATURE_K / temperature_k }
    }

    /// Apparent minus true altitude, given the apparent one.
    pub fn at_apparent_altitude(&self, apparent: Angle) -> Angle {
        Angle::from_arcmin(self.scale * bennett(apparent.deg()).0)
    }

    /// What the refraction gains in a unit of the apparent altitude.
    pub(super) fn slope_at_apparent_altitude(&self, apparent: Angle) -> f64 {
        self.scale * bennett(apparent.deg()).1 / 60.0
    }

    /// The apparent altitude of what stands at a true one.
    pub fn apparent_from_true(&self, altitude: Angle) -> Angle {
        let true_deg = altitude.deg();
        let mut apparent_deg = true_deg;
        // Newton's method; the slope of the true altitude against the apparent one lies between
        // 0.97 and 1.5, so that a handful of steps do.
        for _ in 0..20 {
            let (arcmin, slope) = bennett(apparent_deg);
            let excess_deg = apparent_deg - self.scale * arcmin / 60.0 - true_deg;
            let step_deg = excess_deg / (1.0 - self.scale * slope / 60.0);
            apparent_deg = (apparent_deg - step_deg).clamp(-90.0, 90.0);
            if step_deg.abs() < 1e-13 {
                break;
            }
        }
        Angle::from_deg(apparent_deg)
    }
}

/// Refraction in arcminutes at an apparent altitude in degrees, and its slope, arcminutes a degree.
fn bennett(apparent_deg: f64) -> (f64, f64) {
    debug_assert!((-90.001..=90.001).contains(&apparent_deg), "altitude {apparent_deg}°");
    let at_zenith = cotangent_formula(90.0).0;
    if apparent_deg >= GREATEST_AT_DEG {
        let (arcmin, slope) = cotangent_formula(apparent_deg);
        return (arcmin - at_zenith, slope);
    }
    let greatest = cotangent_formula(GREATEST_AT_DEG).0 - at_zenith;
    let quarter_turn_deg = 90.0 + GREATEST_AT_DEG;
    let rad_per_deg = std::f64::consts::FRAC_PI_2 / quarter_turn_deg;
    let (sin, cos) = ((GREATEST_AT_DEG - apparent_deg) * rad_per_deg).sin_cos();
    (greatest * cos * cos, greatest * 2.0 * sin * cos * rad_per_deg)
}

/// Bennett's formula as printed, and its slope.
fn cotangent_formula(apparent_deg: f64) -> (f64, f64) {
    let denominator = apparent_deg + B;
    let argument = Angle::from_deg(apparent_deg + A / denominator);
    let cotangent = 1.0 / argument.tan();
    let argument_slope = 1.0 - A / (denominator * denominator);
    let rad_per_deg = Angle::from_deg(1.0).rad();
    (cotangent, -(1.0 + cotangent * cotangent) * argument_slope * rad_per_deg)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arcmin(apparent_deg: f64) -> f64 {
        Bennett::new(1010.0, 10.0).at_apparent_altitude(Angle::from_deg(apparent_deg)).arcmin()
    }

    #[test]
    fn the_published_values_come_out() {
        // Meeus 1998, example 16.a: 28.754' at half a degree.
        assert!((arcmin(0.5) - 28.754).abs() < 2e-3, "{}", arcmin(0.5));
        // Explanatory tables (Nautical Almanac, altitude correction of stars): apparent altitude
        // in degrees, arcminutes.
        for (deg, table) in [(0.0, 34.5), (5.0, 9.9), (10.0, 5.3), (20.0, 2.6), (45.0, 1.0)] {
            assert!((arcmin(deg) - table).abs() < 0.07 + 0.05, "{deg}°: {}", arcmin(deg));
        }
        assert_eq!(arcmin(90.0), 0.0);
        assert!(arcmin(-90.0).abs() < 1e-12);
    }

    #[test]
    fn pressure_and_cold_refract_more() {
        let thin = Bennett::new(505.0, 10.0).at_apparent_altitude(Angle::ZERO).arcmin();
        assert!((thin / arcmin(0.0) - 0.5).abs() < 1e-12);
        let cold = Bennett::new(1010.0, -40.0).at_apparent_altitude(Angle::ZERO).arcmin();
        assert!((cold / arcmin(0.0) - 283.0 / 233.0).abs() < 1e-12);
        let none = Bennett::NONE.apparent_from_true(Angle::from_deg(0.3));
        assert!((none.deg() - 0.3).abs() < 1e-12);
    }

    #[test]
    fn the_join_below_the_horizon_is_smooth() {
        let step = 1e-6;
        let (below, above) = (bennett(GREATEST_AT_DEG - step), bennett(GREATEST_AT_DEG + step));
        assert!((below.0 - above.0).abs() < 1e-6 && (below.1 - above.1).abs() < 1e-3);
        for deg in [-89.0, -40.0, -1.8, -1.0, 0.0, 3.0, 40.0, 89.0] {
            let slope = (bennett(deg + step).0 - bennett(deg - step).0) / (2.0 * step);
            assert!((slope - bennett(deg).1).abs() < 1e-6, "{deg}°");
        }
    }
}
