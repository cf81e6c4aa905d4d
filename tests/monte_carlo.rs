//! Our Monte Carlo against another (`truth/sky_radiance_mc.csv`, `truth/sky_radiance_ground_mc.csv`).
//!
//! Rows differ by both standard errors: the sum of squares of differences over them must look like
//! chi-square, and no single row may be far off.

use nocturne::air::monte_carlo::{Effort, MonteCarlo};
use nocturne::air::{Atmosphere, Ground};
use nocturne::units::Angle;

const WAVELENGTHS_NM: [f64; 3] = [450.0, 550.0, 650.0];
const OBSERVER_KM: f64 = 0.001;

fn solver(case: &str) -> MonteCarlo {
    let air = match case.starts_with('A') {
        true => Atmosphere::molecular(),
        false => Atmosphere::default(),
    };
    let ground = Ground { height_m: Some(0.0), ..Ground::default() };
    MonteCarlo::new(&Atmosphere { ground, ..air.straight() }, 1.0, &WAVELENGTHS_NM).unwrap()
}

/// Rows of one case: numbers from the second column on.
fn rows(text: &str, case: &str) -> Vec<Vec<f64>> {
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| line.starts_with(case))
        .map(|line| line.split(',').skip(1).map(|f| f.parse().unwrap()).collect())
        .collect();
    assert!(rows.len() > 10, "truth for {case} is missing");
    rows
}

fn lane(wavelength_nm: f64) -> usize {
    WAVELENGTHS_NM.iter().position(|&nm| nm == wavelength_nm).unwrap()
}

/// Sums up the squares of deviations, given in standard errors.
#[derive(Default)]
struct ChiSquare {
    sum: f64,
    rows: f64,
    largest: f64,
}

impl ChiSquare {
    fn add(&mut self, got: f64, want: f64, errors: [f64; 2]) {
        let sigma = errors[0].hypot(errors[1]);
        let deviation = (got - want) / sigma;
        self.sum += deviation * deviation;
        self.rows += 1.0;
        self.largest = self.largest.max(deviation.abs());
    }

    fn per_row(&self) -> f64 {
        self.sum / self.rows
    }

    fn check(&self) {
        // Three standard deviations of chi-square over so many rows. Below -9 degrees both samples
        // have heavy tails: a single row may lie off by 4.5.
        let most = 1.0 + 3.0 * (2.0 / self.rows).sqrt();
        assert!(self.per_row() < most && self.largest < 4.5, "{} {}", self.per_row(), self.largest);
        // And errors are not overstated.
        assert!(self.per_row() > 1.0 - 3.0 * (2.0 / self.rows).sqrt(), "{}", self.per_row());
    }
}

/// Every so many-th row of a case.
fn compare(case: &str, every: usize) {
    // Cheap: 1 % by day, what so few paths give in deep twilight.
    let effort = Effort { relative_error: 0.01, most_paths: 20_000, seed: 1 };
    let solver = solver(case);
    let mut all = ChiSquare::default();
    for row in rows(include_str!("truth/sky_radiance_mc.csv"), case).iter().step_by(every) {
        let i = lane(row[0]);
        let [sun, elevation, azimuth] = [row[1], row[2], row[3]].map(Angle::from_deg);
        let got = solver.radiance(OBSERVER_KM, sun.sin(), elevation, azimuth, &effort)[i];
        // The first order is without noise in both.
        let off = (got.first_order - row[4]).abs();
        assert!(off < 2e-3 * row[4] + 1e-6 * row[6], "{case} {row:?}: {}", got.first_order);
        println!(
            "{case},{row:?}: {:.4e} +- {:.1e}, {:+.2} sigma, {} paths",
            got.total(),
            got.standard_error,
            (got.total() - row[6]) / got.standard_error.hypot(row[7]),
            got.paths
        );
        all.add(got.total(), row[6], [got.standard_error, row[7]]);
    }
    println!("{case}: chi-square per row {:.2}, largest {:.1}", all.per_row(), all.largest);
    all.check();
}

#[test]
fn molecules_and_ozone_follow_the_reference() {
    compare("A_rayleigh_ozone", 3);
}

#[test]
fn aerosol_follows_the_reference() {
    compare("B_rayleigh_ozone_aerosol", 3);
}

#[test]
fn ground_irradiance_follows_the_reference() {
    let effort = Effort { relative_error: 0.01, most_paths: 20_000, seed: 2 };
    let mut all = ChiSquare::default();
    for case in ["A_rayleigh_ozone", "B_rayleigh_ozone_aerosol"] {
        let solver = solver(case);
        for row in rows(include_str!("truth/sky_radiance_ground_mc.csv"), case).iter().step_by(2) {
            let sun = Angle::from_deg(row[1]);
            let (diffuse, direct) = solver.ground_irradiance(sun.sin(), &effort);
            let i = lane(row[0]);
            all.add(diffuse[i].total(), row[2], [diffuse[i].standard_error, row[3]]);
            // The reference stands 1 m above the ground, which is 0.3 % in haze at 2 degrees.
            let off = (direct[i] - row[4]).abs();
            assert!(off <= 0.004 * row[4], "{case} {row:?}: {}", direct[i]);
        }
    }
    println!("ground: chi-square per row {:.2}, largest {:.1}", all.per_row(), all.largest);
    all.check();
}
