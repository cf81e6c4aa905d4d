//! How well the rotation of the Earth is known at a date: standard error of Delta-T.
//!
//! *Theory.* -1000 to 1200: `0.8 t^2` seconds with `t` in centuries from 1820 (Morrison & Stephenson
//! 2004, *J. Hist. Astron.* 35, 327). Before and after what was measured: Brownian motion of the
//! length of the day (Huber 2000), `365.25 N sqrt(N Q / 3 (1 + N / M)) / 1000` seconds, `N` years
//! away, with `Q` = 0.058 ms^2 a year and `M` = 2500 years; both as given by Espenak & Meeus 2006,
//! *Five Millennium Canon of Solar Eclipses*, "Uncertainty in Delta T". Between, the errors given there
//! for 1300 to 1800; what the smooth curve used here misses from 1900 to 1972 ([`crate::time::delta_t`]);
//! the interpolation of the measured values after that.

use crate::time::Instant;

/// Years and seconds, joined by straight lines.
const KNOWN: [(f64, f64); 9] = [
    (1200.0, 31.0),
    (1300.0, 20.0),
    (1600.0, 20.0),
    (1700.0, 5.0),
    (1800.0, 1.0),
    (1900.0, 0.7),
    (1972.0, 0.7),
    (1972.001, 0.001),
    (MEASURED_UNTIL, 0.001),
];
/// First and last year with observations; the first is that from which drift is counted.
const OBSERVED_FROM: f64 = -500.0;
const MEASURED_UNTIL: f64 = 2026.8;

/// Standard error of Delta-T at an instant, seconds.
pub fn delta_t_error_s(instant: &Instant) -> f64 {
    error_s(2000.0 + instant.tt.centuries_since_j2000() * 100.0)
}

fn error_s(year: f64) -> f64 {
    let last = KNOWN[KNOWN.len() - 1];
    if year < -1000.0 {
        return brownian_s(OBSERVED_FROM - year);
    }
    if year >= last.0 {
        return last.1 + brownian_s(year - last.0);
    }
    let after = KNOWN.partition_point(|&(known, _)| known <= year);
    match after.checked_sub(1) {
        None => 0.8 * ((year - 1820.0) / 100.0).powi(2),
        Some(before) => {
            let ((year_0, error_0), (year_1, error_1)) = (KNOWN[before], KNOWN[after]);
            error_0 + (error_1 - error_0) * (year - year_0) / (year_1 - year_0)
        }
    }
}

fn brownian_s(years: f64) -> f64 {
    365.25 * years * (years * 0.058 / 3.0 * (1.0 + years / 2500.0)).sqrt() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_those_that_were_published() {
        // Espenak & Meeus 2006, the tables of "Uncertainty in Delta T".
        let published =
            [(-1000.0, 636.0), (0.0, 265.0), (500.0, 139.0), (1000.0, 54.0), (1700.0, 5.0)];
        for (year, expected_s) in published {
            assert!((error_s(year) - expected_s).abs() < 1.0, "{year}: {}", error_s(year));
        }
    }

    #[test]
    fn errors_have_no_steps_but_where_measuring_began() {
        for tenth in -40_000..40_000 {
            let (year, next) = (f64::from(tenth) / 10.0, f64::from(tenth + 1) / 10.0);
            let step = (error_s(next) - error_s(year)).abs();
            let is_known_step = year < -999.0 && next > -1001.0 || (1971.8..1972.1).contains(&year);
            assert!(is_known_step || step < 0.02 * error_s(year) + 0.02, "{year}: {step}");
            assert!(error_s(year) > 0.0);
        }
    }
}
