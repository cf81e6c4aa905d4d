//! Nutation as a table: what IAU 2000B leaves out of IAU 2000A, resampled.
//!
//! The short series is the reference of the codec, and gives the locator within 0.0000005"; stored is
//! the rest in longitude and obliquity, 0.003" at most, in segments of 16 days. The tides of five and
//! seven days ask for that many coefficients.

use super::Nutation;
use crate::ephemeris::resampled::{
    Channel, ChannelSource, Depth, Folding, Recipe, Reference, encode as encode_channels,
};
use crate::time::{JulianDate, Tdb, Tt};
use crate::units::Angle;

/// The file among the catalogues.
pub const FILE: &str = "nutation.bin";
/// The name of the channel: longitude, obliquity and locator in radians.
pub(super) const CHANNEL: &str = "nutation";

/// 1549-12-07 to 2650-03-06.
const START_JD: f64 = 2_287_160.5;
const SEGMENT_DAYS: f64 = 16.0;
const SEGMENTS: u32 = 25_116;
const DEGREE: usize = 14;
/// With what is cut off, roundings add up to 0.000036" at most (600,000 dates over the span).
const QUANTUM: Angle = Angle::from_arcsec(5e-6);
/// The degree to which a segment is folded with the short series: 2e-6" are lost.
const FOLDED_DEGREE: usize = 17;

/// The bytes of the table, from the series.
///
/// # Errors
///
/// None with these numbers; else a sentence by the codec.
pub fn encode() -> Result<Vec<u8>, String> {
    let quantum = QUANTUM.rad();
    let recipe = Recipe {
        id: CHANNEL.into(),
        start_jd: START_JD,
        segment_days: SEGMENT_DAYS,
        segments: SEGMENTS,
        components: 2,
        degree: DEGREE,
        quantum: [quantum, quantum, 0.0],
        omitted_bits: [0, 0],
        reference: Reference::ShortNutation,
        folding: [Folding { pieces: 1, degree: FOLDED_DEGREE }; 3],
    };
    let sample = |tdb: JulianDate<Tdb>| Nutation::iau2000a(tdb.read_on(0.0)).vector_rad();
    encode_channels(&[ChannelSource { recipe, sample: &sample }])
}

/// The moment of a table, which counts in TDB: 2 ms from TT, in which nutation moves by 1e-9".
pub(super) fn moment(tt: JulianDate<Tt>) -> JulianDate<Tdb> {
    tt.read_on(0.0)
}

/// What the table says at a moment that it holds.
pub(super) fn value(channel: &Channel, tt: JulianDate<Tt>) -> Nutation {
    Nutation::from_vector_rad(channel.value(moment(tt), Depth::Thousandth))
}
