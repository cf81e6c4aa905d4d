//! What is in a picture, as JSON: where every object is, in the sky and on the picture, and how
//! bright. The keys are a public contract: they are added to, never renamed.

use std::io;

use serde::Serialize;

use crate::catalog::MoonFeature;
use crate::ephemeris::Body;
use crate::light::night::{Kind, LitObject, Night};
use crate::scene::Setting;
use crate::units::Angle;

use super::{ExportError, OutputFile};

/// A picture and what is in it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Description {
    pub instant_utc: String,
    /// Julian date on the clock TT.
    pub jd_tt: f64,
    /// Julian date on the clock UT1.
    pub jd_ut1: f64,
    /// TT - UT1, seconds.
    pub delta_t_s: f64,
    pub place: DescribedPlace,
    pub camera: DescribedCamera,
    pub objects: Vec<DescribedObject>,
    /// Named places on the Moon, where its disc is large; absent else.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub moon_features: Vec<DescribedFeature>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DescribedPlace {
    pub name: Option<String>,
    pub latitude_deg: f64,
    pub longitude_deg: f64,
    pub height_m: f64,
    /// Apparent altitude of the horizon; below zero from above the ground around.
    pub horizon_altitude_deg: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DescribedCamera {
    pub projection: &'static str,
    /// Angle that the width of the picture spans, through its centre.
    pub field_of_view_deg: f64,
    pub azimuth_deg: f64,
    pub altitude_deg: f64,
    pub roll_deg: f64,
    pub width_px: u32,
    pub height_px: u32,
    /// Pixels per radian at the centre of the picture.
    pub focal_px: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DescribedObject {
    pub name: String,
    /// `sun`, `moon`, `planet`, `satellite` or `star`.
    pub kind: &'static str,
    /// Number in a catalogue, such as `HR 2491`.
    pub catalogue: Option<String>,
    /// Pixels from the top left corner, pixel centres at .5; none when out of view.
    pub x_px: Option<f64>,
    pub y_px: Option<f64>,
    /// From north through east.
    pub azimuth_deg: f64,
    /// Without air.
    pub altitude_deg: f64,
    /// As refracted.
    pub apparent_altitude_deg: f64,
    /// Stated bound of the error of the direction.
    pub error_bound_arcsec: f64,
    /// Johnson V outside the air.
    pub magnitude_v: f64,
    /// Outside the air.
    pub illuminance_lx: f64,
    /// Through the air; zero below the horizon. Of the Sun and the Moon that of what stands above.
    pub illuminance_ground_lx: f64,
    /// Solid angle of the pixel that it falls on; none when out of view.
    pub pixel_solid_angle_sr: Option<f64>,
}

/// A named place on the Moon.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DescribedFeature {
    pub name: String,
    /// `moon feature`.
    pub kind: &'static str,
    /// `crater`, `sea`, `mountain`, `valley`, `scarp`, `swirl` or `landing site`.
    pub feature: String,
    /// Selenographic, east positive.
    pub longitude_deg: f64,
    pub latitude_deg: f64,
    /// Zero for a point.
    pub diameter_km: f64,
    /// As of an object; none when out of view or on the far side.
    pub x_px: Option<f64>,
    pub y_px: Option<f64>,
    pub azimuth_deg: f64,
    pub altitude_deg: f64,
    pub apparent_altitude_deg: f64,
    /// Whether it faces the observer.
    pub is_on_near_side: bool,
    /// Whether the centre of the Sun is above its level horizon.
    pub is_lit: bool,
    /// Height of the Sun over it.
    pub sun_altitude_deg: f64,
}

/// A disc of the Moon smaller than this has no places to name, pixels.
const MOON_FEATURES_PX: f64 = 40.0;

/// The places on the Moon, if its disc is large enough on the picture.
fn described_features(setting: &Setting, night: &Night) -> Vec<DescribedFeature> {
    let camera = &setting.camera;
    let moon = &night.sky.moon.state;
    let centre = night.refraction.apparent_from_horizon(moon.dir);
    let Some(pixel_sr) =
        camera.pixel_from_apparent(centre).map(|pixel| camera.pixel_solid_angle_sr(pixel))
    else {
        return Vec::new();
    };
    if 2.0 * moon.angular_radius.rad() < MOON_FEATURES_PX * pixel_sr.sqrt() {
        return Vec::new();
    }
    let described = |feature: &MoonFeature| {
        let (point, apparent) = night.on_moon(feature);
        let is_on_near_side = point.observer_altitude > Angle::ZERO;
        let pixel = camera
            .pixel_from_apparent(apparent)
            .filter(|_| is_on_near_side && apparent.altitude() >= night.horizon)
            .filter(|&pixel| camera.contains(pixel));
        DescribedFeature {
            name: feature.name.clone(),
            kind: "moon feature",
            feature: feature.kind.clone(),
            longitude_deg: as_written(feature.longitude),
            latitude_deg: as_written(feature.latitude),
            diameter_km: feature.diameter_km,
            x_px: pixel.map(|[x, _]| x),
            y_px: pixel.map(|[_, y]| y),
            azimuth_deg: point.dir.azimuth().deg(),
            altitude_deg: point.dir.altitude().deg(),
            apparent_altitude_deg: apparent.altitude().deg(),
            is_on_near_side,
            is_lit: point.sun_altitude > Angle::ZERO,
            sun_altitude_deg: point.sun_altitude.deg(),
        }
    };
    night.moon_features.iter().map(described).collect()
}

/// Degrees of an angle that somebody wrote, without the rounding of radians: 30, not 29.999...96.
fn as_written(angle: Angle) -> f64 {
    const DECIMALS: f64 = 1e11;
    (angle.deg() * DECIMALS).round() / DECIMALS
}

impl Description {
    /// Describes the picture that the camera of a setting takes of a night.
    pub fn of(setting: &Setting, night: &Night) -> Description {
        let (instant, place, camera) = (&setting.instant, &setting.place, &setting.camera);
        let described = |object: &LitObject| {
            let pixel = camera
                .pixel_from_apparent(object.apparent)
                .filter(|_| object.apparent.altitude() >= night.horizon)
                .filter(|&pixel| camera.contains(pixel));
            let (kind, catalogue) = match object.kind {
                Kind::Body(Body::Sun) => ("sun", None),
                Kind::Body(Body::Moon) => ("moon", None),
                Kind::Body(_) => ("planet", None),
                Kind::Satellite(_) => ("satellite", None),
                Kind::Star(index) => ("star", Some(format!("HR {}", night.stars[index].hr))),
            };
            DescribedObject {
                name: night.label(object),
                kind,
                catalogue,
                x_px: pixel.map(|[x, _]| x),
                y_px: pixel.map(|[_, y]| y),
                azimuth_deg: object.dir.azimuth().deg(),
                altitude_deg: object.dir.altitude().deg(),
                apparent_altitude_deg: object.apparent.altitude().deg(),
                error_bound_arcsec: object.error_bound.arcsec(),
                magnitude_v: object.magnitude.0,
                illuminance_lx: object.outside.lx(),
                illuminance_ground_lx: object.ground.y,
                pixel_solid_angle_sr: pixel.map(|pixel| camera.pixel_solid_angle_sr(pixel)),
            }
        };
        Description {
            instant_utc: instant.to_string(),
            jd_tt: instant.tt.jd(),
            jd_ut1: instant.ut1.jd(),
            delta_t_s: instant.delta_t_s(),
            place: DescribedPlace {
                name: place.name.clone(),
                latitude_deg: as_written(place.latitude),
                longitude_deg: as_written(place.longitude),
                height_m: place.height_m,
                horizon_altitude_deg: night.horizon.deg(),
            },
            camera: DescribedCamera {
                projection: camera.projection.name(),
                field_of_view_deg: as_written(camera.field_of_view),
                azimuth_deg: as_written(camera.azimuth),
                altitude_deg: as_written(camera.altitude),
                roll_deg: as_written(camera.roll),
                width_px: camera.width_px,
                height_px: camera.height_px,
                focal_px: camera.focal_px(),
            },
            objects: {
                let near = night.objects.iter().map(described);
                near.chain(night.lit_stars().map(|star| described(&star))).collect()
            },
            moon_features: described_features(setting, night),
        }
    }

    /// Writes the description.
    pub fn write(&self, file: OutputFile) -> Result<(), ExportError> {
        file.write(|writer| self.write_to(writer))
    }

    /// Writes the description to anything that takes bytes.
    pub fn write_to(&self, writer: &mut impl io::Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *writer, self).map_err(io::Error::from)?;
        writeln!(writer)
    }
}
