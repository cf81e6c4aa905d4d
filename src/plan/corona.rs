//! The corona of the eclipsed Sun as the picture needs it: a disc of ten radii around the Sun's.
//!
//! *Theory.* [`crate::light::corona`] gives its radiance by the distance from the Sun's centre, of the Sun's
//! colour; the air before it, refraction and what the Moon hides are those of any
//! [disc](super::disc). It is laid when less than [`COVERED`] of the Sun is left: before, no eye sees it
//! beside the crescent.
//!
//! *Left out.* What the law leaves out: streamers, prominences, the chromosphere.
//!
//! *Accuracy.* What is drawn sums up to the law less what the Moon hides within 2 % (`tests/corona.rs`).

use crate::air::extinction::SightLines;
use crate::camera::Camera;
use crate::light::corona;
use crate::light::disc_light::point_light;
use crate::light::night::{LitObject, Night};
use crate::sky::BodyState;
use crate::units::{Angle, Xyzv};

use super::body::SeenBody;
use super::disc::{Disc, DiscShape, SurfaceLaw};

/// Part of the light of the Sun, at 550 nm, below which its corona is laid.
pub const COVERED: f64 = 0.02;

/// Where the Sun is smaller than this, its corona is a point of light: most of it is in one pixel.
const POINT_PX: f64 = 3.0;

const SUN_SHINES: &str = "the Sun outshines it";
const OUT_OF_VIEW: &str = "out of view";
const BELOW_HORIZON: &str = "below the horizon";
const IN_A_POINT: &str = "in the light of the Sun, which is a point";

/// The corona on the picture.
pub enum Corona {
    Disc(Box<Disc>),
    /// Its light through the air, lux.
    Point(Xyzv),
}

/// What the GPU draws, or why there is nothing. Given the Sun.
pub fn seen(object: &LitObject, night: &Night, camera: &Camera) -> Result<Corona, &'static str> {
    let covered = night.eclipse.sun.ok_or(SUN_SHINES)?;
    if covered.visible().at_nm(550.0) >= COVERED {
        return Err(SUN_SHINES);
    }
    let sun = &night.sky.sun;
    if SeenBody::of(sun, object, night, camera).is_point() {
        return Err(IN_A_POINT);
    }
    let pixel_sr = camera
        .pixel_from_apparent(object.apparent)
        .map_or(0.0, |pixel| camera.pixel_solid_angle_sr(pixel));
    if pixel_sr > 0.0 && 2.0 * sun.angular_radius.rad() < POINT_PX * pixel_sr.sqrt() {
        let light = corona::irradiance(sun.distance_km) * covered.visible_corona();
        let sight = SightLines::over(&night.air, night.sky.place.height_m);
        let altitude = object.apparent.altitude();
        return Ok(Corona::Point(point_light(altitude, &light, &sight, &night.refraction)));
    }
    let radius = Angle::from_rad((sun.angular_radius.sin() * corona::OUTER_RADII).min(1.0).asin());
    let wide = BodyState { angular_radius: radius, ..*sun };
    let seen = SeenBody::of(&wide, object, night, camera);
    if seen.is_below_horizon() {
        return Err(BELOW_HORIZON);
    }
    let bounds_px = seen.bounds_px().ok_or(OUT_OF_VIEW)?;
    let air = seen.air_of_one_band().ok_or(BELOW_HORIZON)?;
    let shape = DiscShape { law: SurfaceLaw::Corona, ..seen.shape(None) };
    let whole = DiscShape { angular_radius: sun.angular_radius, ..seen.shape(None) };
    // A disc has the light of the whole Sun over the mean of its shape; the corona's is in units of the
    // mean radiance of the Sun.
    let scale = shape.mean() * shape.solid_angle_sr() / whole.solid_angle_sr();
    let mut disc = seen.disc(shape, None, &air, bounds_px);
    disc.label = "corona";
    for band in &mut disc.bands {
        band.limb_darkening = corona::law();
        for node in &mut band.nodes {
            node.luminance = node.luminance * scale;
        }
    }
    Ok(Corona::Disc(Box::new(disc)))
}
