//! PNG: the picture as it is shown, in 8 or 16 bits.
//!
//! Pictures in sRGB have no profile: it is what PNG means without one. Display P3 and linear light have
//! an ICC profile (version 4, made by the crate `moxcms`), its date set to the first of 2000 so that the
//! same picture has the same bytes.

use std::io;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use moxcms::{ColorProfile, LocalizableString, ProfileText, ToneReprCurve};

use crate::display::ColourSpace;
use crate::image::{Codes, Image};

use super::exif::About;
use super::{ExportError, OutputFile};

/// Writes a picture of sRGB in 8 bits that says nothing about itself.
pub fn write(file: OutputFile, picture: &Image<[u8; 3]>) -> Result<(), ExportError> {
    let pixels = picture.pixels().as_flattened();
    let size = (picture.width_px(), picture.height_px());
    encode(file, pixels, size, ExtendedColorType::Rgb8, None, None)
}

/// Writes a picture with its colours and what it says about itself.
pub fn write_with(
    file: OutputFile,
    codes: &Codes,
    space: ColourSpace,
    about: Option<&About>,
) -> Result<(), ExportError> {
    let profile = profile(space);
    match codes {
        Codes::Eight(picture) => {
            let size = (picture.width_px(), picture.height_px());
            let pixels = picture.pixels().as_flattened();
            encode(file, pixels, size, ExtendedColorType::Rgb8, profile, about)
        }
        Codes::Sixteen(picture) => {
            let size = (picture.width_px(), picture.height_px());
            let samples = picture.pixels().as_flattened();
            // The encoder takes them as the machine has them.
            let bytes: Vec<u8> = samples.iter().flat_map(|code| code.to_ne_bytes()).collect();
            encode(file, &bytes, size, ExtendedColorType::Rgb16, profile, about)
        }
    }
}

fn encode(
    file: OutputFile,
    bytes: &[u8],
    (width, height): (u32, u32),
    kind: ExtendedColorType,
    profile: Option<ColorProfile>,
    about: Option<&About>,
) -> Result<(), ExportError> {
    file.write(|writer| {
        let (compression, filter) = (CompressionType::Default, FilterType::Adaptive);
        let mut encoder = PngEncoder::new_with_quality(writer, compression, filter);
        if let Some(profile) = profile {
            encoder.set_icc_profile(icc(&profile)?).map_err(io::Error::other)?;
        }
        if let Some(about) = about {
            encoder.set_exif_metadata(about.block()?).map_err(io::Error::other)?;
        }
        encoder.write_image(bytes, width, height, kind).map_err(io::Error::other)
    })
}

/// The profile of a colour space; none for that which PNG means without one.
fn profile(space: ColourSpace) -> Option<ColorProfile> {
    let mut profile = match space {
        ColourSpace::Srgb => return None,
        ColourSpace::DisplayP3 => ColorProfile::new_display_p3(),
        ColourSpace::Linear => {
            let mut profile = ColorProfile::new_srgb();
            let curve = Some(ToneReprCurve::Parametric(vec![1.0]));
            profile.red_trc.clone_from(&curve);
            profile.green_trc.clone_from(&curve);
            profile.blue_trc = curve;
            let [en, us, name] = ["en", "US", "Linear sRGB"].map(str::to_owned);
            let name = vec![LocalizableString::new(en, us, name)];
            profile.description = Some(ProfileText::Localizable(name));
            profile
        }
    };
    // Code points would name the white of cinemas.
    profile.cicp = None;
    Some(profile)
}

/// Where an ICC profile has its date, six numbers of 16 bits (ICC.1:2022, table 17).
const ICC_DATE: std::ops::Range<usize> = 24..36;

/// The bytes of a profile, the same every day.
fn icc(profile: &ColorProfile) -> io::Result<Vec<u8>> {
    let mut bytes = profile.encode().map_err(|error| io::Error::other(error.to_string()))?;
    let date = [2000u16, 1, 1, 0, 0, 0].map(u16::to_be_bytes);
    if let Some(place) = bytes.get_mut(ICC_DATE) {
        place.copy_from_slice(date.as_flattened());
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use image::ImageDecoder;
    use image::codecs::png::PngDecoder;

    use super::*;
    use crate::display::Display;
    use crate::place::Place;
    use crate::time;

    fn written(codes: &Codes, space: ColourSpace) -> Vec<u8> {
        let instant = time::to_instant(&time::parse("2026-08-13T04:30Z").unwrap(), None).unwrap();
        let place = Place::new(35.0, -111.0, 2106.0).unwrap();
        let about = About { instant: &instant, place: &place, exposure: None };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.png");
        write_with(OutputFile::create(&path).unwrap(), codes, space, Some(&about)).unwrap();
        std::fs::read(&path).unwrap()
    }

    #[test]
    fn codes_profile_and_tags_come_back() {
        let deep = Image::filled(3, 2, [0.25f32, 0.5, 1.0]);
        let eight = Codes::Eight(Image::filled(3, 2, [7, 130, 255]));
        for space in [ColourSpace::Srgb, ColourSpace::DisplayP3, ColourSpace::Linear] {
            for codes in [
                Codes::Sixteen(Display { space, ..Display::default() }.sixteen_bits(&deep)),
                eight.clone(),
            ] {
                let bytes = written(&codes, space);
                assert_eq!(bytes, written(&codes, space));
                let mut decoder = PngDecoder::new(io::Cursor::new(&bytes)).unwrap();
                let profile = decoder.icc_profile().unwrap();
                assert_eq!(profile.is_none(), space == ColourSpace::Srgb);
                if let Some(profile) = profile {
                    check_profile(&profile, space);
                }
                let block = decoder.exif_metadata().unwrap().expect("tags");
                let tags = exif::Reader::new().read_raw(block).unwrap();
                assert!(tags.get_field(exif::Tag::Model, exif::In::PRIMARY).is_some());
                match codes {
                    Codes::Eight(_) => {
                        let mut pixels = vec![0; decoder.total_bytes() as usize];
                        decoder.read_image(&mut pixels).unwrap();
                        assert_eq!(pixels[..3], [7, 130, 255]);
                    }
                    Codes::Sixteen(_) => {
                        let mut pixels = vec![0; decoder.total_bytes() as usize];
                        decoder.read_image(&mut pixels).unwrap();
                        let code =
                            |i: usize| u16::from_ne_bytes([pixels[2 * i], pixels[2 * i + 1]]);
                        let linear = matches!(space, ColourSpace::Linear);
                        let half = if linear { [16384, 32768] } else { [35199, 48192] };
                        assert_eq!([code(0), code(1), code(2)], [half[0], half[1], 65535]);
                    }
                }
            }
        }
    }

    /// The profile means the primaries that we draw with, seen from the white of profiles.
    fn check_profile(bytes: &[u8], space: ColourSpace) {
        let profile = ColorProfile::new_from_slice(bytes).unwrap();
        let to_d50 = profile.rgb_to_xyz_matrix();
        // The row of Y, adapted: 0.2225 0.7169 0.0606 of sRGB, 0.2412 0.6922 0.0666 of Display P3 (Lindbloom;
        // the profiles of the ICC and of Apple).
        let meant = match space {
            ColourSpace::DisplayP3 => [0.2412, 0.6922, 0.0666],
            _ => [0.2225, 0.7169, 0.0606],
        };
        for (found, meant) in to_d50.v[1].iter().zip(meant) {
            assert!((f64::from(*found as f32) - meant).abs() < 5e-4, "{space:?}: {found} {meant}");
        }
        assert!(Display { space, ..Display::default() }.validate().is_ok());
    }
}
