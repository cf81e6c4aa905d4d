//! The integrated librations, resampled.
//!
//! *Theory.* The rotation of the Moon was integrated together with its motion for JPL's ephemeris
//! DE421 (Folkner, Williams & Boggs 2009, *IPN Progress Report* 42-178; Williams, Boggs & Folkner
//! 2008, *JPL IOM* 335-JW,DB,WF-20080314-001) and fitted to ranges of the laser reflectors. Three Euler
//! angles turn the axes of the ICRS to the principal axes of inertia, three constant ones those to the
//! axes of mean Earth and mean rotation, in which maps of the Moon are drawn.
//!
//! *How.* The codec of [`crate::ephemeris::resampled`] on the angles, the third one less a steady turn.
//!
//! *Accuracy.* Within 0.03" of DE421 all over its span. DE421 itself is good to some milliarcseconds
//! while there have been laser ranges; the newer DE430 and DE440 are integrated with other cores of
//! the Moon, and their librations are in no package that this project could take them from.

use glam::{DMat3, DVec3};

use super::DEPTH;
use super::de421::{De421, SEGMENT_DAYS, START_JD};
use crate::ephemeris::resampled::{
    Channel, ChannelSource, Folding, Recipe, Reference, Table, encode,
};
use crate::frame::{Icrs, MoonFixed, Rot, turn_axes_x, turn_axes_y, turn_axes_z};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Name of the channel.
const CHANNEL: &str = "librations";
/// The steady part of psi, radians a day: a turn in a sidereal month. Another value would change what
/// is stored, not its sum.
const STEADY_RAD_PER_DAY: f64 = 0.229_970_834_5;

/// From the principal axes to those of mean Earth and mean rotation (Williams, Boggs & Folkner 2008):
/// about z, then y, then x.
const PRINCIPAL_OFFSETS: [Angle; 3] =
    [Angle::from_arcsec(67.92), Angle::from_arcsec(78.56), Angle::from_arcsec(0.30)];

/// The librations of DE421.
#[derive(Debug)]
pub(super) struct Integrated {
    channel: Channel,
    mean_from_principal: DMat3,
}

/// What the packing of the librations gives.
pub struct PackedLibrations {
    /// The file.
    pub bytes: Vec<u8>,
    /// Largest distance of its angles from those of DE421, at eight moments of each segment.
    pub largest_error: Angle,
}

impl Integrated {
    /// An error says what is wrong with the table, to be read behind its name.
    pub fn new(table: Table) -> Result<Integrated, String> {
        let channels = table.into_channels();
        let Some(channel) = channels.into_iter().find(|channel| channel.id() == CHANNEL) else {
            return Err(format!("has no channel {CHANNEL:?}: it is another table"));
        };
        let [z, y, x] = PRINCIPAL_OFFSETS;
        let mean_from_principal = turn_axes_x(-x) * turn_axes_y(-y) * turn_axes_z(-z);
        Ok(Integrated { channel, mean_from_principal })
    }

    /// First and last moment.
    pub fn span(&self) -> (JulianDate<Tdb>, JulianDate<Tdb>) {
        self.channel.span()
    }

    /// Within the span.
    pub fn moon_fixed_from_icrs(&self, tdb: JulianDate<Tdb>) -> Rot<MoonFixed, Icrs> {
        let angles = self.channel.value(tdb, DEPTH) + steady(tdb);
        let [phi, theta, psi] = angles.to_array().map(Angle::from_rad);
        // The meaning of DE421's angles.
        Rot::claim(
            self.mean_from_principal * turn_axes_z(psi) * turn_axes_x(theta) * turn_axes_z(phi),
        )
    }
}

/// What is not stored.
fn steady(tdb: JulianDate<Tdb>) -> DVec3 {
    DVec3::Z * (STEADY_RAD_PER_DAY * tdb.days_since_j2000())
}

/// `libration.bin` from `jpl-librations.npy` of the Python package `de421`; an error says what is
/// wrong with that.
pub fn pack(npy: &[u8]) -> Result<PackedLibrations, String> {
    /// Segments of the source in one of the table.
    const TOGETHER: usize = 4;
    let de421 = De421::from_npy(npy)?;
    if de421.segments() < TOGETHER {
        return Err(format!("has {} segments, too few for one of the table", de421.segments()));
    }
    let quantum = Angle::from_arcsec(0.005).rad();
    let recipe = Recipe {
        id: CHANNEL.into(),
        start_jd: START_JD,
        segment_days: SEGMENT_DAYS * TOGETHER as f64,
        segments: (de421.segments() / TOGETHER) as u32,
        components: 3,
        degree: 22,
        quantum: [quantum; 3],
        omitted_bits: [0, 0],
        reference: Reference::None,
        folding: [Folding { pieces: TOGETHER, degree: 11 }; 3],
    };
    let residual = |tdb: JulianDate<Tdb>| de421.angles_rad(tdb) - steady(tdb);
    let bytes = encode(&[ChannelSource { recipe, sample: &residual }])?;
    let packed = Table::from_bytes(&bytes, DEPTH)?;
    let channel = packed.channel(CHANNEL).ok_or("was not packed")?;
    let (first, last) = channel.span();
    let mut largest = DVec3::ZERO;
    for day in 0..(last - first) as u32 {
        let tdb = first.plus_days(f64::from(day) + 0.37);
        largest = largest.max((channel.value(tdb, DEPTH) - residual(tdb)).abs());
    }
    Ok(PackedLibrations { bytes, largest_error: Angle::from_rad(largest.max_element()) })
}

#[cfg(test)]
mod tests {
    use super::super::de421::tests::npy;
    use super::*;

    /// Angles that grow steadily, in radians a day; the third one almost as the Moon turns.
    const START_RAD: DVec3 = DVec3::new(0.05, 0.4, -5800.0);
    const RATE_RAD: DVec3 = DVec3::new(1e-4, -2e-5, 0.23);

    fn angles(days: f64) -> DVec3 {
        START_RAD + RATE_RAD * days
    }

    fn array(segments: usize) -> Vec<u8> {
        npy(segments, 3, |segment, angle, n| match n {
            0 => angles((segment as f64 + 0.5) * SEGMENT_DAYS)[angle],
            1 => RATE_RAD[angle] * 0.5 * SEGMENT_DAYS,
            _ => 0.0,
        })
    }

    #[test]
    fn what_was_packed_turns_the_moon() {
        let packed = pack(&array(9)).unwrap();
        assert!(packed.largest_error.arcsec() < 0.02, "{:?}", packed.largest_error);
        let table = Table::from_bytes(&packed.bytes, DEPTH).unwrap();
        let integrated = Integrated::new(table).unwrap();
        // Nine segments are two of the table and one to spare.
        assert_eq!(integrated.span().1 - integrated.span().0, 64.0);
        for days in [0.0, 7.9, 32.0, 50.3, 64.0] {
            let got = integrated.moon_fixed_from_icrs(JulianDate::from_parts(START_JD, days));
            let [phi, theta, psi] = angles(days).to_array().map(Angle::from_rad);
            let principal = turn_axes_z(psi) * turn_axes_x(theta) * turn_axes_z(phi);
            let offset = got.matrix() * principal.transpose();
            // Off diagonal stand the three small angles (Williams, Boggs & Folkner 2008).
            let arcsec = |rad: f64| Angle::from_rad(rad).arcsec();
            assert!((arcsec(offset.x_axis.y) - 67.92).abs() < 0.05, "day {days}");
            assert!((arcsec(offset.z_axis.x) - 78.56).abs() < 0.05, "day {days}");
            assert!((arcsec(offset.y_axis.z) - 0.30).abs() < 0.05, "day {days}");
        }
    }

    #[test]
    fn other_tables_and_too_short_arrays_are_refused() {
        assert!(pack(&array(3)).err().unwrap().contains("too few"));
        let recipe = Recipe {
            id: "moon".into(),
            start_jd: START_JD,
            segment_days: 8.0,
            segments: 1,
            components: 3,
            degree: 3,
            quantum: [1.0; 3],
            omitted_bits: [0, 0],
            reference: Reference::None,
            folding: [Folding { pieces: 1, degree: 3 }; 3],
        };
        let bytes = encode(&[ChannelSource { recipe, sample: &|_| DVec3::ONE }]).unwrap();
        let table = Table::from_bytes(&bytes, DEPTH).unwrap();
        assert!(Integrated::new(table).err().unwrap().contains("another table"));
    }
}
