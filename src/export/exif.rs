//! EXIF: what a picture says about when, where and with which settings it was taken.
//!
//! The block is a TIFF file of tags (Exif 2.32, CIPA DC-008), which PNG holds in its chunk `eXIf`. Written by
//! the crate `kamadak-exif`, whose order of tags is always the same: so the same picture has the
//! same bytes.

use std::io;

use exif::experimental::Writer;
use exif::{Field, In, Rational, Tag, Value};

use crate::photo::exposure::Exposure;
use crate::place::Place;
use crate::time::Instant;

/// The width of a full frame, to which focal lengths are compared, millimetres.
const FULL_FRAME_MM: f64 = 36.0;

/// What a picture says about itself.
#[derive(Debug, Clone, Copy)]
pub struct About<'a> {
    pub instant: &'a Instant,
    pub place: &'a Place,
    /// The settings of a camera; none for what an eye sees.
    pub exposure: Option<&'a Exposure>,
}

impl About<'_> {
    /// The block of tags, as `eXIf` holds it.
    ///
    /// Years beyond 1 to 9999 cannot be written as EXIF has it and are left out.
    pub fn block(&self) -> io::Result<Vec<u8>> {
        let mut fields = Vec::new();
        let mut tag = |tag, value| fields.push(Field { tag, ifd_num: In::PRIMARY, value });
        tag(Tag::Make, ascii("Nocturne"));
        tag(Tag::Model, ascii("Nocturne"));
        tag(Tag::Software, ascii(concat!("Nocturne ", env!("CARGO_PKG_VERSION"))));
        tag(Tag::ExifVersion, Value::Undefined(b"0232".to_vec(), 0));
        self.write_instant(&mut tag);
        self.write_place(&mut tag);
        if let Some(exposure) = self.exposure {
            write_exposure(exposure, &mut tag);
        }
        let mut writer = Writer::new();
        fields.iter().for_each(|field| writer.push_field(field));
        let mut block = io::Cursor::new(Vec::new());
        writer.write(&mut block, true).map_err(io::Error::other)?;
        Ok(block.into_inner())
    }

    fn write_instant(&self, tag: &mut impl FnMut(Tag, Value)) {
        let civil = self.instant.utc_civil();
        if !(1..=9999).contains(&civil.year) {
            return;
        }
        // A leap second is the last of its minute: readers know no 60.
        let second = (civil.second as u32).min(59);
        let date = format!("{:04}:{:02}:{:02}", civil.year, civil.month, civil.day);
        let (hour, minute) = (civil.hour, civil.minute);
        tag(Tag::DateTimeOriginal, ascii(&format!("{date} {hour:02}:{minute:02}:{second:02}")));
        tag(Tag::OffsetTimeOriginal, ascii("+00:00"));
        tag(Tag::GPSDateStamp, ascii(&date));
        let time =
            [u32::from(hour), u32::from(minute), second].map(|num| Rational { num, denom: 1 });
        tag(Tag::GPSTimeStamp, Value::Rational(time.to_vec()));
    }

    fn write_place(&self, tag: &mut impl FnMut(Tag, Value)) {
        let Place { latitude, longitude, height_m, .. } = self.place;
        tag(Tag::GPSVersionID, Value::Byte(vec![2, 3, 0, 0]));
        tag(Tag::GPSLatitudeRef, ascii(if latitude.deg() < 0.0 { "S" } else { "N" }));
        tag(Tag::GPSLatitude, degrees(latitude.deg()));
        let longitude_deg = longitude.signed().deg();
        tag(Tag::GPSLongitudeRef, ascii(if longitude_deg < 0.0 { "W" } else { "E" }));
        tag(Tag::GPSLongitude, degrees(longitude_deg));
        tag(Tag::GPSAltitudeRef, Value::Byte(vec![u8::from(*height_m < 0.0)]));
        tag(Tag::GPSAltitude, rational(height_m.abs(), 100));
    }
}

fn write_exposure(exposure: &Exposure, tag: &mut impl FnMut(Tag, Value)) {
    let whole = |value: f64| Value::Short(vec![value.round().clamp(1.0, 65_535.0) as u16]);
    tag(Tag::ExposureTime, exposure_time(exposure.shutter_s));
    tag(Tag::FNumber, rational(exposure.f_number, 100));
    tag(Tag::PhotographicSensitivity, whole(exposure.iso));
    tag(Tag::FocalLength, rational(exposure.focal_mm, 100));
    let alike_mm = exposure.focal_mm * FULL_FRAME_MM / exposure.sensor_width_mm;
    tag(Tag::FocalLengthIn35mmFilm, whole(alike_mm));
}

fn ascii(text: &str) -> Value {
    Value::Ascii(vec![text.as_bytes().to_vec()])
}

/// A number that is not negative, in parts of a whole.
fn rational(value: f64, denom: u32) -> Value {
    let num = (value * f64::from(denom)).round().clamp(0.0, f64::from(u32::MAX)) as u32;
    Value::Rational(vec![Rational { num, denom }])
}

/// Seconds: as 1/n below a quarter of one.
fn exposure_time(seconds: f64) -> Value {
    match seconds {
        short if short < 0.25 => {
            let denom = short.recip().round().clamp(1.0, f64::from(u32::MAX)) as u32;
            Value::Rational(vec![Rational { num: 1, denom }])
        }
        long => rational(long, 100),
    }
}

/// Degrees, minutes and seconds to a ten-thousandth, without sign.
fn degrees(angle_deg: f64) -> Value {
    const PARTS: u64 = 10_000;
    let parts = (angle_deg.abs() * 3600.0 * PARTS as f64).round() as u64;
    let whole = |num: u64| Rational { num: num as u32, denom: 1 };
    let second = Rational { num: (parts % (60 * PARTS)) as u32, denom: PARTS as u32 };
    let minutes = parts / (60 * PARTS);
    Value::Rational(vec![whole(minutes / 60), whole(minutes % 60), second])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Projection};
    use crate::photo::Photo;
    use crate::photo::exposure::metered;
    use crate::time;
    use crate::units::Angle;

    /// The tags of a block, as people read them.
    fn read(block: Vec<u8>) -> impl Fn(Tag) -> Option<String> {
        let exif = exif::Reader::new().read_raw(block).unwrap();
        move |tag| {
            let field = exif.get_field(tag, In::PRIMARY)?;
            Some(field.display_value().with_unit(&exif).to_string())
        }
    }

    #[test]
    fn tags_come_back_as_they_were_meant() {
        let written = time::parse("2026-08-13T04:30:07Z").unwrap();
        let instant = time::to_instant(&written, None).unwrap();
        let place = Place::new(-24.627, -70.404, 2635.5).unwrap();
        let camera = Camera {
            projection: Projection::Perspective,
            field_of_view: Angle::from_deg(70.0),
            azimuth: Angle::ZERO,
            altitude: Angle::ZERO,
            roll: Angle::ZERO,
            width_px: 640,
            height_px: 360,
        };
        let photo = Photo { shutter_s: Some(1.0 / 60.0), iso: Some(3200.0), ..Photo::default() };
        let exposure = photo.exposed(&metered(&[]), &camera);
        let about = About { instant: &instant, place: &place, exposure: Some(&exposure) };
        let block = about.block().unwrap();
        assert_eq!(block, about.block().unwrap());
        let said = read(block);
        for (tag, meant) in [
            (Tag::Model, "\"Nocturne\""),
            (Tag::DateTimeOriginal, "2026-08-13 04:30:07"),
            (Tag::OffsetTimeOriginal, "\"+00:00\""),
            (Tag::GPSLatitude, "24 deg 37 min 37.2 sec S"),
            (Tag::GPSLongitude, "70 deg 24 min 14.4 sec W"),
            (Tag::GPSAltitude, "2635.5 meters above sea level"),
            (Tag::ExposureTime, "1/60 s"),
            (Tag::FNumber, "f/2.8"),
            (Tag::PhotographicSensitivity, "3200"),
            (Tag::FocalLength, "24 mm"),
            (Tag::FocalLengthIn35mmFilm, "24 mm"),
        ] {
            assert_eq!(said(tag).as_deref(), Some(meant), "{tag}");
        }
        // An eye has no lens to speak of.
        let said = read(About { exposure: None, ..about }.block().unwrap());
        assert!(said(Tag::DateTimeOriginal).is_some() && said(Tag::FNumber).is_none());
    }

    #[test]
    fn years_that_exif_does_not_know_are_left_out() {
        let written = time::parse("-0584-05-28T12:00:00Z").unwrap();
        let instant = time::to_instant(&written, None).unwrap();
        let place = Place::new(0.0, 0.0, -400.0).unwrap();
        let about = About { instant: &instant, place: &place, exposure: None };
        let said = read(about.block().unwrap());
        assert_eq!(said(Tag::DateTimeOriginal), None);
        assert_eq!(said(Tag::GPSAltitude).as_deref(), Some("400 meters below sea level"));
    }
}
