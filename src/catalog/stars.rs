//! `stars.bin`: a sealed file of star records and the strings they share.
//!
//! Counts in the header: records, bytes per record, bytes of text. A record, little-endian:
//!
//! ```text
//! offset  type   what
//!      0  u16    HR number
//!      2  u32    HIP number, 0 for none
//!      6  f64    right ascension, rad, J2000.0
//!     14  f64    declination, rad, J2000.0
//!     22  f64    proper motion in right ascension times cos(declination), arcsec/yr
//!     30  f64    proper motion in declination, arcsec/yr
//!     38  f64    parallax, arcsec, 0 for none
//!     46  f64    radial velocity, km/s
//!     54  f64    V, mag
//!     62  f64    B-V, mag
//!     70  u8     1 if B-V was estimated from the spectral type, else 0
//!     71  u32+u8 designation: offset and length in the text, length 0 for none
//!     76  u32+u8 name approved by the IAU, likewise
//!     81  u32+u8 spectral type, likewise
//!     86  u32+u8 name as a variable star, likewise
//!     91  f64    distance of a companion, arcsec, -1 for none
//!     99  f64    how much fainter it is, mag, -1 for unknown
//!    107  u32    HD number, 0 for none
//!    111  u8     number of Flamsteed, 0 for none; its constellation is that of the designation
//! ```

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::RangeInclusive;

use super::seal::{self, Kind};
use super::{Companion, Star};
use crate::frame::Dir;
use crate::units::{Angle, Magnitude};

pub(super) const KIND: Kind = Kind { magic: b"NOCTSTAR", version: 3 };
const RECORD_LEN: usize = 112;
/// What stands for a number that is not known.
const UNKNOWN: f64 = -1.0;

/// What a star of this catalogue may be. The extremes in it are V -1.46 (HR 2491) and 7.96,
/// B-V -0.28 and 5.74 (HR 1607), 6.6 arcsec/yr, 0.751 arcsec, -140 and +289 km/s.
const V_RANGE: RangeInclusive<f64> = -2.0..=10.0;
const B_V_RANGE: RangeInclusive<f64> = -0.6..=7.0;
const PROPER_MOTION_RANGE_ARCSEC_YR: RangeInclusive<f64> = -11.0..=11.0;
const PARALLAX_RANGE_ARCSEC: RangeInclusive<f64> = 0.0..=1.0;
const SEPARATION_RANGE_ARCSEC: RangeInclusive<f64> = 0.0..=3600.0;
const DIFFERENCE_RANGE: RangeInclusive<f64> = 0.0..=20.0;
const RADIAL_VELOCITY_RANGE_KM_S: RangeInclusive<f64> = -1000.0..=1000.0;

/// A star as the file holds it: numbers only, without frames.
#[derive(Debug, Clone, PartialEq)]
pub struct StarRecord {
    pub hr: u16,
    pub hip: Option<u32>,
    pub hd: Option<u32>,
    /// In `[0, 2 pi)`, J2000.0.
    pub ra_rad: f64,
    pub dec_rad: f64,
    /// Times the cosine of the declination.
    pub proper_motion_ra_arcsec_yr: f64,
    pub proper_motion_dec_arcsec_yr: f64,
    /// Zero when unknown.
    pub parallax_arcsec: f64,
    /// Positive away from us, zero when unknown.
    pub radial_velocity_km_s: f64,
    /// Johnson V.
    pub v: f64,
    /// Johnson B-V.
    pub b_v: f64,
    /// B-V was not measured but estimated from the spectral type.
    pub b_v_estimated: bool,
    pub designation: Option<String>,
    /// Number of Flamsteed in the constellation of the designation.
    pub flamsteed: Option<u8>,
    pub name: Option<String>,
    pub spectral_type: String,
    pub variable: Option<String>,
    pub companion: Option<Companion>,
}

impl StarRecord {
    /// Says what cannot be true of a star, if anything.
    fn check(&self) -> Result<(), String> {
        let hr = self.hr;
        // Written so that NaN, which is in no range, is refused too.
        let within = |what: &str, value: f64, range: RangeInclusive<f64>| {
            if range.contains(&value) {
                Ok(())
            } else {
                let (low, high) = range.into_inner();
                Err(format!("HR {hr} has {what} {value}, outside {low} to {high}"))
            }
        };
        if hr == 0 {
            return Err("a star has the number HR 0".into());
        }
        if !(0.0..TAU).contains(&self.ra_rad) {
            return Err(format!("HR {hr} has right ascension {} rad", self.ra_rad));
        }
        within("declination (rad)", self.dec_rad, -FRAC_PI_2..=FRAC_PI_2)?;
        let motion = PROPER_MOTION_RANGE_ARCSEC_YR;
        within("proper motion (arcsec/yr)", self.proper_motion_ra_arcsec_yr, motion.clone())?;
        within("proper motion (arcsec/yr)", self.proper_motion_dec_arcsec_yr, motion)?;
        within("parallax (arcsec)", self.parallax_arcsec, PARALLAX_RANGE_ARCSEC)?;
        within("radial velocity (km/s)", self.radial_velocity_km_s, RADIAL_VELOCITY_RANGE_KM_S)?;
        within("V", self.v, V_RANGE)?;
        within("B-V", self.b_v, B_V_RANGE)?;
        if let Some(companion) = self.companion {
            let separation = companion.separation_arcsec;
            within("a companion at (arcsec)", separation, SEPARATION_RANGE_ARCSEC)?;
            if let Some(fainter) = companion.magnitude_difference {
                within("a companion fainter by (mag)", fainter, DIFFERENCE_RANGE)?;
            }
        }
        if self.flamsteed.is_some() && self.flamsteed_designation().is_none() {
            return Err(format!("HR {hr} has a number of Flamsteed and no constellation"));
        }
        if self.spectral_type.is_empty() {
            return Err(format!("HR {hr} has no spectral type"));
        }
        Ok(())
    }

    fn flamsteed_designation(&self) -> Option<String> {
        let (_, constellation) = self.designation.as_deref()?.rsplit_once(' ')?;
        Some(format!("{} {constellation}", self.flamsteed?))
    }
}

impl From<StarRecord> for Star {
    fn from(record: StarRecord) -> Star {
        Star {
            hr: record.hr,
            hip: record.hip,
            hd: record.hd,
            flamsteed: record.flamsteed_designation(),
            designation: record.designation,
            name: record.name,
            dir_j2000: Dir::from_spherical(
                Angle::from_rad(record.ra_rad),
                Angle::from_rad(record.dec_rad),
            ),
            proper_motion_ra_arcsec_yr: record.proper_motion_ra_arcsec_yr,
            proper_motion_dec_arcsec_yr: record.proper_motion_dec_arcsec_yr,
            parallax_arcsec: record.parallax_arcsec,
            radial_velocity_km_s: record.radial_velocity_km_s,
            magnitude: Magnitude(record.v),
            b_v: record.b_v,
            spectral_type: record.spectral_type,
            variable: record.variable,
            companion: record.companion,
        }
    }
}

/// The bytes of `stars.bin`; refuses what [`decode`] would refuse.
pub fn encode(records: &[StarRecord]) -> Result<Vec<u8>, String> {
    let mut text = Text::default();
    let mut payload = Vec::with_capacity(records.len() * RECORD_LEN);
    let mut last_hr = 0;
    for record in records {
        record.check()?;
        check_order(last_hr, record.hr)?;
        last_hr = record.hr;
        payload.extend(record.hr.to_le_bytes());
        payload.extend(record.hip.unwrap_or(0).to_le_bytes());
        for number in [
            record.ra_rad,
            record.dec_rad,
            record.proper_motion_ra_arcsec_yr,
            record.proper_motion_dec_arcsec_yr,
            record.parallax_arcsec,
            record.radial_velocity_km_s,
            record.v,
            record.b_v,
        ] {
            payload.extend(number.to_le_bytes());
        }
        payload.push(u8::from(record.b_v_estimated));
        for string in [
            record.designation.as_deref().unwrap_or(""),
            record.name.as_deref().unwrap_or(""),
            record.spectral_type.as_str(),
            record.variable.as_deref().unwrap_or(""),
        ] {
            let (offset, length) = text.place(string)?;
            payload.extend(offset.to_le_bytes());
            payload.push(length);
        }
        let companion = record.companion;
        let separation = companion.map_or(UNKNOWN, |c| c.separation_arcsec);
        let difference = companion.and_then(|c| c.magnitude_difference).unwrap_or(UNKNOWN);
        payload.extend(separation.to_le_bytes());
        payload.extend(difference.to_le_bytes());
        payload.extend(record.hd.unwrap_or(0).to_le_bytes());
        payload.push(record.flamsteed.unwrap_or(0));
    }
    let counts = [u32_from(records.len())?, u32_from(RECORD_LEN)?, u32_from(text.bytes.len())?];
    payload.extend(text.bytes);
    Ok(seal::seal(KIND, counts, &payload))
}

/// The records of `stars.bin`, every one checked; an error says what is wrong with the file.
pub fn decode(bytes: &[u8]) -> Result<Vec<StarRecord>, String> {
    let ([count, record_len, text_len], payload) = seal::open(KIND, bytes)?;
    if record_len as usize != RECORD_LEN {
        return Err(format!("has records of {record_len} bytes instead of {RECORD_LEN}"));
    }
    let wanted = u64::from(count) * u64::from(record_len) + u64::from(text_len);
    if payload.len() as u64 != wanted {
        return Err(format!("holds {} bytes where its header says {wanted}", payload.len()));
    }
    let (records, text) = payload.split_at(payload.len() - text_len as usize);
    let text = std::str::from_utf8(text).map_err(|_| "holds text that is not UTF-8")?;
    let mut stars = Vec::with_capacity(count as usize);
    let mut last_hr = 0;
    for record in records.chunks_exact(RECORD_LEN) {
        let star = record_from_bytes(record, text)?;
        star.check()?;
        check_order(last_hr, star.hr)?;
        last_hr = star.hr;
        stars.push(star);
    }
    Ok(stars)
}

fn record_from_bytes(bytes: &[u8], text: &str) -> Result<StarRecord, String> {
    let mut fields = Fields { rest: bytes };
    let hr = u16::from_le_bytes(fields.take());
    let hip = u32::from_le_bytes(fields.take());
    let mut number = || f64::from_le_bytes(fields.take());
    let [ra_rad, dec_rad, motion_ra, motion_dec, parallax_arcsec, radial_velocity_km_s, v, b_v] =
        [number(), number(), number(), number(), number(), number(), number(), number()];
    let b_v_estimated = match fields.take() {
        [0] => false,
        [1] => true,
        [flag] => return Err(format!("HR {hr} has the flag {flag}, neither 0 nor 1")),
    };
    let mut string = || {
        let start = u32::from_le_bytes(fields.take()) as usize;
        let [length] = fields.take();
        text.get(start..start.saturating_add(length as usize))
            .map(str::to_owned)
            .ok_or_else(|| format!("HR {hr} points outside the text"))
    };
    let [designation, name, spectral_type, variable] = [string()?, string()?, string()?, string()?];
    let mut known = || Some(f64::from_le_bytes(fields.take())).filter(|&value| value != UNKNOWN);
    let (separation, magnitude_difference) = (known(), known());
    let companion =
        separation.map(|separation_arcsec| Companion { separation_arcsec, magnitude_difference });
    let hd = u32::from_le_bytes(fields.take());
    let [flamsteed] = fields.take();
    Ok(StarRecord {
        hr,
        hip: (hip != 0).then_some(hip),
        hd: (hd != 0).then_some(hd),
        ra_rad,
        dec_rad,
        proper_motion_ra_arcsec_yr: motion_ra,
        proper_motion_dec_arcsec_yr: motion_dec,
        parallax_arcsec,
        radial_velocity_km_s,
        v,
        b_v,
        b_v_estimated,
        designation: (!designation.is_empty()).then_some(designation),
        flamsteed: (flamsteed != 0).then_some(flamsteed),
        name: (!name.is_empty()).then_some(name),
        spectral_type,
        variable: (!variable.is_empty()).then_some(variable),
        companion,
    })
}

fn check_order(last_hr: u16, hr: u16) -> Result<(), String> {
    if hr > last_hr {
        Ok(())
    } else {
        Err(format!("HR {hr} follows HR {last_hr}: stars go in the order of HR, each once"))
    }
}

fn u32_from(length: usize) -> Result<u32, String> {
    u32::try_from(length).map_err(|_| format!("a length of {length} does not fit the format"))
}

/// A record, field by field.
struct Fields<'a> {
    rest: &'a [u8],
}

impl Fields<'_> {
    /// The next field. The layout above adds up to `RECORD_LEN`, so a record always has it.
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut field = [0; N];
        let (head, rest) = self.rest.split_at(N);
        field.copy_from_slice(head);
        self.rest = rest;
        field
    }
}

/// Strings one after another, each different one once.
#[derive(Default)]
struct Text {
    bytes: Vec<u8>,
    placed: HashMap<String, (u32, u8)>,
}

impl Text {
    fn place(&mut self, string: &str) -> Result<(u32, u8), String> {
        if string.is_empty() {
            return Ok((0, 0));
        }
        if let Some(&place) = self.placed.get(string) {
            return Ok(place);
        }
        let length = u8::try_from(string.len())
            .map_err(|_| format!("the text {string:?} has more than 255 bytes"))?;
        let place = (u32_from(self.bytes.len())?, length);
        self.bytes.extend(string.as_bytes());
        self.placed.insert(string.to_owned(), place);
        Ok(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn records() -> Vec<StarRecord> {
        let sirius = StarRecord {
            hr: 2491,
            hip: Some(32349),
            hd: Some(48915),
            ra_rad: 1.767_8,
            dec_rad: -0.291_75,
            proper_motion_ra_arcsec_yr: -0.553,
            proper_motion_dec_arcsec_yr: -1.205,
            parallax_arcsec: 0.375,
            radial_velocity_km_s: -8.0,
            v: -1.46,
            b_v: 0.0,
            b_v_estimated: false,
            designation: Some("α CMa".into()),
            flamsteed: Some(9),
            name: Some("Sirius".into()),
            spectral_type: "A1Vm".into(),
            variable: Some("NSV 17173".into()),
            companion: Some(Companion {
                separation_arcsec: 11.2,
                magnitude_difference: Some(10.3),
            }),
        };
        let plain = StarRecord {
            hr: 2492,
            hip: None,
            hd: None,
            b_v_estimated: true,
            designation: None,
            flamsteed: None,
            name: None,
            variable: None,
            companion: Some(Companion { separation_arcsec: 0.0, magnitude_difference: None }),
            ..sirius.clone()
        };
        vec![sirius, plain]
    }

    #[test]
    fn records_come_back_as_they_went() {
        let records = records();
        assert_eq!(decode(&encode(&records).unwrap()).unwrap(), records);
        assert_eq!(decode(&encode(&[]).unwrap()).unwrap(), []);
    }

    #[test]
    fn a_string_that_two_stars_share_is_stored_once() {
        let bytes = encode(&records()).unwrap();
        let text_len = "α CMa".len() + "Sirius".len() + "A1Vm".len() + "NSV 17173".len();
        assert_eq!(bytes.len(), seal::HEADER_LEN + 2 * RECORD_LEN + text_len);
    }

    #[test]
    fn impossible_values_are_refused_in_a_sealed_file_too() {
        type Spoil = fn(&mut StarRecord);
        let spoils: [(Spoil, &str); 11] = [
            (|star| star.hr = 0, "HR 0"),
            (|star| star.ra_rad = -1e-9, "right ascension"),
            (|star| star.dec_rad = f64::NAN, "declination"),
            (|star| star.proper_motion_ra_arcsec_yr = 12.0, "proper motion"),
            (|star| star.parallax_arcsec = -0.001, "parallax"),
            (|star| star.radial_velocity_km_s = f64::INFINITY, "radial velocity"),
            (|star| star.v = -26.7, "V"),
            (|star| star.b_v = 9.0, "B-V"),
            (
                |star| {
                    let far = Companion { separation_arcsec: 1e5, magnitude_difference: None };
                    star.companion = Some(far);
                },
                "a companion",
            ),
            (|star| star.designation = None, "Flamsteed"),
            (|star| star.spectral_type.clear(), "spectral type"),
        ];
        for (spoil, what) in spoils {
            let mut star = records().remove(0);
            spoil(&mut star);
            let message = encode(&[star]).unwrap_err();
            assert!(message.contains(what), "{message}");
        }
        // The same through the reader: rewrite V of the first star and seal the file again.
        let ([a, b, c], payload) = seal::open(KIND, &encode(&records()).unwrap())
            .map(|(counts, payload)| (counts, payload.to_vec()))
            .unwrap();
        let mut spoilt = payload.clone();
        spoilt[54..62].copy_from_slice(&(-26.7f64).to_le_bytes());
        let message = decode(&seal::seal(KIND, [a, b, c], &spoilt)).unwrap_err();
        assert!(message.contains("HR 2491 has V -26.7"), "{message}");
        // Counts that do not fit the payload, and a pointer outside the text.
        assert!(decode(&seal::seal(KIND, [a + 1, b, c], &payload)).is_err());
        assert!(decode(&seal::seal(KIND, [a, b + 1, c], &payload)).is_err());
        let mut outside = payload.clone();
        outside[81..85].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(decode(&seal::seal(KIND, [a, b, c], &outside)).unwrap_err().contains("outside"));
    }

    #[test]
    fn stars_out_of_order_are_refused() {
        let mut records = records();
        records.swap(0, 1);
        assert!(encode(&records).unwrap_err().contains("HR 2491 follows HR 2492"));
    }
}
