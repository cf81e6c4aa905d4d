//! New and full moons: when about they come, which of them can bring an eclipse, and in which
//! Saros.
//!
//! *Theory.* Mean lunations and the largest periodic terms of the greatest eclipse: Meeus 1998,
//! *Astronomical Algorithms*, 2nd ed., eq. 49.1 to 49.7 and 54.1. No eclipse comes where the Moon
//! stands farther from its node than `|sin F| = 0.36` (p. 380).
//!
//! *Accuracy.* Estimates are within a quarter of an hour of the greatest eclipse from -4000 to
//! +4000. The Saros is that of the Swiss Ephemeris, wherever that knows it from -3000 to 3000.

use crate::time::{JulianDate, Tt};
use crate::units::Angle;

/// The first new moon of 2000 by the mean lunation, Julian date in TT (Meeus, eq. 49.1).
const EPOCH_JD: f64 = 2_451_550.097_66;
/// Mean synodic month, days.
const MONTH_DAYS: f64 = 29.530_588_861;
/// Lunations in a Julian century (Meeus, eq. 49.3).
const LUNATIONS_PER_CENTURY: f64 = 1236.85;
/// Beyond this distance from the node no eclipse comes.
const ECLIPTIC_LIMIT_SIN: f64 = 0.36;

/// At new moons the Sun is eclipsed, at full moons the Moon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    New,
    Full,
}

/// A new moon, or the full moon that follows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lunation {
    /// New moons since that of 2000-01-06; Brown's lunation number less 953.
    pub number: i32,
    pub phase: Phase,
}

/// Meeus, eq. 49.2 to 49.6.
struct Arguments {
    /// Lunations since that of 2000-01-06; a half more for a full moon.
    k: f64,
    /// About Julian centuries since 2000.
    t: f64,
    /// Mean anomaly of the Sun.
    sun: Angle,
    /// Mean anomaly of the Moon.
    moon: Angle,
    /// Argument of latitude: how far the Moon is past its ascending node.
    node: Angle,
}

impl Lunation {
    /// The last one that is sure to come before an instant.
    pub fn before(tt: JulianDate<Tt>, phase: Phase) -> Lunation {
        let mean = (tt.jd() - EPOCH_JD) / MONTH_DAYS;
        // Half a month for the phase, a day and a half for the terms of eq. 49.1 and 54.1.
        Lunation { number: mean.floor() as i32 - 2, phase }
    }

    pub fn next(self) -> Lunation {
        Lunation { number: self.number + 1, ..self }
    }

    /// Whether the Moon stands near enough to its node.
    pub fn is_near_node(self) -> bool {
        self.arguments().node.sin().abs() < ECLIPTIC_LIMIT_SIN
    }

    /// When the eclipse is greatest, to some minutes (Meeus, eq. 49.1 and 54.1).
    pub fn estimate(self) -> JulianDate<Tt> {
        let Arguments { k, t, sun, moon, node } = self.arguments();
        let e = 1.0 - t * (0.002_516 + t * 0.000_007_4);
        let (of_moon, of_sun) = match self.phase {
            Phase::New => (-0.4075, 0.1721),
            Phase::Full => (-0.4065, 0.1727),
        };
        let periodic_days =
            of_moon * moon.sin() + of_sun * e * sun.sin() + 0.0161 * (moon * 2.0).sin()
                - 0.0097 * (node * 2.0).sin()
                + 0.0073 * e * (moon - sun).sin()
                - 0.0050 * e * (moon + sun).sin()
                - 0.0023 * (moon - node * 2.0).sin()
                + 0.0021 * e * (sun * 2.0).sin();
        let secular_days = t * t * (0.000_154_37 + t * (-1.5e-7 + t * 7.3e-10));
        JulianDate::from_parts(EPOCH_JD, MONTH_DAYS * k).plus_days(secular_days + periodic_days)
    }

    fn arguments(self) -> Arguments {
        let k = f64::from(self.number)
            + match self.phase {
                Phase::New => 0.0,
                Phase::Full => 0.5,
            };
        let t = k / LUNATIONS_PER_CENTURY;
        let angle = |start: f64, rate: f64, [square, cube, fourth]: [f64; 3]| {
            Angle::from_deg((start + rate * k + t * t * (square + t * (cube + t * fourth))) % 360.0)
        };
        Arguments {
            k,
            t,
            sun: angle(2.5534, 29.105_356_70, [-1.4e-6, -1.1e-7, 0.0]),
            moon: angle(201.5643, 385.816_935_28, [0.010_758_2, 1.238e-5, -5.8e-8]),
            node: angle(160.7108, 390.670_502_84, [-0.001_611_8, -2.27e-6, 1.1e-8]),
        }
    }

    /// The number of the Saros series, as van den Bergh counted them.
    ///
    /// All eclipses are inexes (358 lunations) and saroses (223 lunations) apart, and an inex
    /// leads to the series with the next number (van den Bergh 1955, *Periodicity and Variation of
    /// Solar (and Lunar) Eclipses*). So `358 s = number + constant` modulo 223, and since `38 *
    /// 358 = 1` modulo 223, `s = 38 number + constant`. Which of the numbers 223 apart is meant
    /// the epoch says: some forty series run at a time, and their middle moves on by one in 31.6
    /// years.
    pub fn saros(self) -> i32 {
        // The series of the lunation with number 0.
        let constant = match self.phase {
            Phase::New => 112,
            Phase::Full => 124,
        };
        let residue = (38 * self.number + constant).rem_euclid(223);
        let years = f64::from(self.number) * MONTH_DAYS / 365.25;
        let middle = 137.0 + years / 31.6;
        residue + 223 * ((middle - f64::from(residue)) / 223.0).round() as i32
    }
}
