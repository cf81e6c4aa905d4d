//! Refraction of rays that were followed through the air.
//!
//! *Theory.* The bending of a ray through spherical shells ([`crate::air`], `air/ray.rs`), through
//! the air of `profile.rs` with the index of `refractivity.rs`.
//!
//! *How.* Some hundred rays from the horizon to the zenith are followed once for each air. A cubic
//! spline through them, in the logarithm of the altitude above the horizon plus 1.5 degrees, gives the
//! refraction against the apparent altitude; a second one against the true altitude starts Newton's
//! method on the first, so that the two directions are inverse to the last digits.
//!
//! *Accuracy.* Within 0.0002" of the rays themselves for observers below 11 km; from higher
//! up, 40" for rays that graze the tropopause, where the slope of the temperature jumps. What the air leaves out is in `profile.rs`.
//!
//! *Below the horizon* nothing is seen. The refraction is carried on with the same slope, levels off
//! within a degree and falls to zero at the nadir: a choice, made so that every direction has one
//! image.

use std::f64::consts::FRAC_PI_2;

use super::profile::{ObserverAir, Profile};
use crate::air::AirError;
use crate::air::ray::{Ray, RefractiveAir};
use crate::units::Angle;

/// Pieces of a spline.
const CELLS: usize = 128;
/// Added to the altitude above the horizon before its logarithm is taken: refraction changes over
/// some such angle near the horizon.
const OFFSET_DEG: f64 = 1.5;
/// Depth below the horizon over which the refraction levels off.
const LEVELLING_DEG: f64 = 1.0;
/// Least slope of `n r` on the ground: below it rays almost circle the Earth.
const LEAST_SLOPE: f64 = 0.3;

/// The refraction that one observer sees. A few kilobytes; some milliseconds to make.
#[derive(Debug, Clone, PartialEq)]
pub struct Traced {
    horizon: Angle,
    true_horizon: Angle,
    by_apparent: Spline,
    by_true: Spline,
    /// At the horizon: refraction in degrees, and what it gains for each degree downwards.
    refraction_deg: f64,
    gain: f64,
}

/// Rays followed one by one: exact, without the tables of [`Traced`]. For a few altitudes in each of
/// many colours.
pub struct Rays {
    profile: Profile,
    height_km: f64,
    ground_km: f64,
}

impl Rays {
    /// Through the air over ground of a height above sea level, metres; an observer below it stands
    /// on it.
    ///
    /// # Errors
    ///
    /// A number outside the range that [`ObserverAir`] states, or air so dense that it bends light
    /// around the Earth.
    pub fn over_ground(air: &ObserverAir, ground_m: f64) -> Result<Rays, AirError> {
        check(air)?;
        let profile = Profile::over(air);
        let height_km = air.height_m / 1000.0;
        let ground_km = height_km.min(ground_m / 1000.0);
        for low_km in [ground_km, height_km] {
            let slope = profile.bending_at(low_km).scaled_radius_slope(low_km);
            if slope < LEAST_SLOPE || slope.is_nan() {
                return Err(AirError::Duct {
                    pressure_mbar: air.pressure_mbar,
                    height_m: air.height_m,
                });
            }
        }
        Ok(Rays { profile, height_km, ground_km })
    }

    /// Apparent altitude of the horizon of the ground.
    pub fn horizon(&self) -> Angle {
        self.profile.horizon_altitude(self.height_km, self.ground_km)
    }

    /// Apparent minus true altitude, given the apparent one, not below the horizon; some
    /// microseconds.
    pub fn at_apparent_altitude(&self, apparent: Angle) -> Angle {
        Ray::new(&self.profile, self.height_km, apparent).bending()
    }
}

impl Traced {
    /// Follows rays through the air, over the sea.
    ///
    /// # Errors
    ///
    /// See [`Rays::over_ground`].
    pub fn through(air: &ObserverAir) -> Result<Traced, AirError> {
        Traced::over_ground(air, 0.0)
    }

    /// Follows rays through the air over ground of a height above sea level, metres. The ground says
    /// how low the horizon lies; an observer below it stands on it.
    ///
    /// # Errors
    ///
    /// See [`Rays::over_ground`].
    pub fn over_ground(air: &ObserverAir, ground_m: f64) -> Result<Traced, AirError> {
        let rays = Rays::over_ground(air, ground_m)?;
        let horizon = rays.horizon();
        let follow = |apparent_deg: f64| match apparent_deg {
            // The vertical ray is not bent; its altitude in radians is rounded.
            90.0.. => 0.0,
            _ => rays.at_apparent_altitude(Angle::from_deg(apparent_deg)).deg(),
        };
        let by_apparent = Spline::through(horizon.deg(), follow);
        let (refraction_deg, slope) = by_apparent.value_and_slope(horizon.deg());
        let true_horizon_deg = horizon.deg() - refraction_deg;
        let by_true = Spline::through(true_horizon_deg, |true_deg| {
            // The refraction of the apparent altitude is a little less than that of the true one.
            newton(true_deg, true_deg, |apparent_deg| {
                by_apparent.value_and_slope(apparent_deg.max(horizon.deg()))
            }) - true_deg
        });
        Ok(Traced {
            horizon,
            true_horizon: Angle::from_deg(true_horizon_deg),
            by_apparent,
            by_true,
            refraction_deg,
            gain: -slope,
        })
    }

    /// Apparent altitude of the horizon of the ground.
    pub fn horizon(&self) -> Angle {
        self.horizon
    }

    /// True altitude of what is seen at the horizon.
    pub fn true_horizon(&self) -> Angle {
        self.true_horizon
    }

    /// Apparent minus true altitude, given the apparent one.
    pub fn at_apparent_altitude(&self, apparent: Angle) -> Angle {
        Angle::from_deg(self.value_and_slope(apparent.deg()).0)
    }

    /// What the refraction gains in a unit of the apparent altitude: negative.
    pub(super) fn slope_at_apparent_altitude(&self, apparent: Angle) -> f64 {
        self.value_and_slope(apparent.deg()).1
    }

    /// The apparent altitude of what stands at a true one.
    pub fn apparent_from_true(&self, altitude: Angle) -> Angle {
        let true_deg = altitude.deg();
        let guess_deg = if altitude >= self.true_horizon {
            true_deg + self.by_true.value_and_slope(true_deg).0
        } else {
            true_deg + self.below_horizon(self.horizon.deg() - true_deg).0
        };
        Angle::from_deg(newton(true_deg, guess_deg, |deg| self.value_and_slope(deg)))
    }

    /// Refraction in degrees and its slope against the apparent altitude.
    fn value_and_slope(&self, apparent_deg: f64) -> (f64, f64) {
        let depth_deg = self.horizon.deg() - apparent_deg;
        if depth_deg <= 0.0 {
            self.by_apparent.value_and_slope(apparent_deg)
        } else {
            self.below_horizon(depth_deg)
        }
    }

    /// The same where nothing is seen, given the depth below the horizon.
    fn below_horizon(&self, depth_deg: f64) -> (f64, f64) {
        let fading = (-depth_deg / LEVELLING_DEG).exp();
        let level_deg = self.refraction_deg + self.gain * LEVELLING_DEG * (1.0 - fading);
        let per_deg = FRAC_PI_2 / (90.0 + self.horizon.deg());
        let (sin, cos) = (depth_deg * per_deg).sin_cos();
        let value_deg = level_deg * cos * cos;
        (value_deg, 2.0 * level_deg * sin * cos * per_deg - self.gain * fading * cos * cos)
    }
}

/// The apparent altitude `a` for which `a` less its refraction is the true altitude, all in degrees.
fn newton(true_deg: f64, guess_deg: f64, refraction: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut apparent_deg = guess_deg;
    for _ in 0..20 {
        let (value_deg, slope) = refraction(apparent_deg);
        let step_deg = (apparent_deg - value_deg - true_deg) / (1.0 - slope);
        apparent_deg = (apparent_deg - step_deg).clamp(-90.0, 90.0);
        // The error that is left is of the order of its square.
        if step_deg.abs() < 1e-6 {
            break;
        }
    }
    apparent_deg
}

fn check(air: &ObserverAir) -> Result<(), AirError> {
    let checks = [
        ("height_m", air.height_m, -430.0, 100_000.0),
        ("pressure_mbar", air.pressure_mbar, 0.0, 1100.0),
        ("temperature_c", air.temperature_c, -90.0, 60.0),
        ("relative_humidity", air.relative_humidity, 0.0, 1.0),
        ("wavelength_nm", air.wavelength_nm, 300.0, 1700.0),
    ];
    for (what, value, low, high) in checks {
        // Written so that NaN, which is in no range, is refused too.
        if !(low..=high).contains(&value) {
            return Err(AirError::Range { what: what.to_owned(), value, low, high });
        }
    }
    Ok(())
}

/// A function of the altitude from a lowest one to the zenith, as cubic pieces that join with two
/// derivatives.
#[derive(Debug, Clone, PartialEq)]
struct Spline {
    /// Altitude of which the logarithm is zero, degrees.
    origin_deg: f64,
    /// Logarithm of the lowest altitude above the origin, and pieces for each unit of it.
    start: f64,
    cells_per_unit: f64,
    /// Coefficients of the powers of the place in the piece, 0 to 1.
    cells: Box<[[f64; 4]; CELLS]>,
}

impl Spline {
    fn through(lowest_deg: f64, value: impl Fn(f64) -> f64) -> Spline {
        let origin_deg = lowest_deg - OFFSET_DEG;
        let start = OFFSET_DEG.ln();
        let width = ((90.0 - origin_deg).ln() - start) / CELLS as f64;
        let knots: Vec<f64> = (0..=CELLS)
            .map(|knot| match knot {
                0 => value(lowest_deg),
                CELLS => value(90.0),
                _ => value(origin_deg + (start + width * knot as f64).exp()),
            })
            .collect();
        let curves = second_derivatives(&knots);
        let cell = |at: usize| {
            let (value, curve, next) = (knots[at], curves[at], curves[at + 1]);
            let slope = knots[at + 1] - value - (2.0 * curve + next) / 6.0;
            [value, slope, 0.5 * curve, (next - curve) / 6.0]
        };
        let cells = Box::new(std::array::from_fn(cell));
        Spline { origin_deg, start, cells_per_unit: width.recip(), cells }
    }

    fn value_and_slope(&self, altitude_deg: f64) -> (f64, f64) {
        let above_deg = altitude_deg - self.origin_deg;
        let place = (above_deg.ln() - self.start) * self.cells_per_unit;
        let cell = (place.max(0.0) as usize).min(CELLS - 1);
        let x = place - cell as f64;
        let [a, b, c, d] = self.cells[cell];
        let slope = b + x * (2.0 * c + x * 3.0 * d);
        (a + x * (b + x * (c + x * d)), slope * self.cells_per_unit / above_deg)
    }
}

/// Second derivatives of the cubic spline through equidistant values, in units of their distance,
/// whose third derivative is the same on both sides of the last knot but one at each end.
fn second_derivatives(knots: &[f64]) -> Vec<f64> {
    let last = knots.len() - 1;
    let curve = |at: usize| 6.0 * (knots[at + 1] - 2.0 * knots[at] + knots[at - 1]);
    let mut seconds = vec![0.0; knots.len()];
    seconds[1] = curve(1) / 6.0;
    seconds[last - 1] = curve(last - 1) / 6.0;
    // m[i-1] + 4 m[i] + m[i+1] = curve(i) between them: elimination, then back.
    let mut diagonal = vec![4.0; knots.len()];
    for at in 2..last - 1 {
        let known = if at == 2 { seconds[1] } else { seconds[at - 1] / diagonal[at - 1] };
        if at > 2 {
            diagonal[at] -= diagonal[at - 1].recip();
        }
        seconds[at] = curve(at) - known;
    }
    for at in (2..last - 1).rev() {
        seconds[at] = (seconds[at] - seconds[at + 1]) / diagonal[at];
    }
    seconds[0] = 2.0 * seconds[1] - seconds[2];
    seconds[last] = 2.0 * seconds[last - 1] - seconds[last - 2];
    seconds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spline_is_the_bending_of_the_rays_between_those_that_were_followed() {
        let air = ObserverAir {
            height_m: 0.0,
            pressure_mbar: 1013.25,
            temperature_c: 15.0,
            relative_humidity: 0.5,
            wavelength_nm: 550.0,
        };
        for (height_m, pressure_mbar, temperature_c, within_arcsec) in [
            (0.0, 1013.25, 15.0, 0.0002),
            (0.0, 1080.0, -50.0, 0.0002),
            (2635.0, 743.0, 12.0, 0.0002),
            (4205.0, 615.0, 2.0, 0.0002),
            (10_000.0, 265.0, -50.0, 0.0003),
            // Rays that graze the tropopause are bent by a jump in the slope of the temperature.
            (30_000.0, 12.0, -46.0, 40.0),
        ] {
            let air = ObserverAir { height_m, pressure_mbar, temperature_c, ..air };
            let (traced, profile) = (Traced::through(&air).unwrap(), Profile::over(&air));
            let horizon_deg = traced.horizon().deg();
            let mut largest = 0.0f64;
            for step in 0..2000 {
                let deg = horizon_deg + (90.0 - horizon_deg) * (f64::from(step) / 2000.0).powi(3);
                let altitude = Angle::from_deg(deg);
                let ray = Ray::new(&profile, height_m / 1000.0, altitude).bending();
                let off = (traced.at_apparent_altitude(altitude) - ray).abs().arcsec();
                assert!(off < within_arcsec, "{height_m} m, {deg}°: {off}\"");
                largest = largest.max(off);
            }
            println!("{height_m} m, {temperature_c} °C: {largest:.6}\"");
            // The rays themselves would leave nothing.
            assert!(largest > 1e-6, "{height_m} m: {largest}");
        }
    }

    #[test]
    fn splines_keep_cubic_curves() {
        // In the logarithm that they run in.
        let curve = |deg: f64| {
            let x = (deg + OFFSET_DEG).ln();
            (
                1.0 + x * (2.0 - x * (0.5 - 0.1 * x)),
                (2.0 - x * (1.0 - 0.3 * x)) / (deg + OFFSET_DEG),
            )
        };
        let spline = Spline::through(0.0, |deg| curve(deg).0);
        for deg in [0.0, 0.001, 0.7, 5.0, 44.0, 89.99, 90.0] {
            let (got, wanted) = (spline.value_and_slope(deg), curve(deg));
            assert!((got.0 - wanted.0).abs() < 1e-12 && (got.1 - wanted.1).abs() < 1e-10, "{deg}");
        }
    }
}
