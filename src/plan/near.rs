//! A disc on a narrow picture: polynomials of the pixel, so that 32 bits are enough for what is left.
//!
//! *Theory.* From a pixel to the point of the disc that it shows leads a chain: projection, turn of the
//! camera, altitude, refraction, azimuth. On a field of a minute of arc it is as good as quadratic. It is
//! reckoned here in 64 bits at nine pixels of what is seen of the disc; what the shader gets is the value at
//! the middle one, the [`Near::anchor_px`], and how it grows with the pixels from there. Where a value is
//! only compared with another (the radius of the disc, the edge of what stands in front, the outline of the
//! globe), the difference at the anchor is taken here, and so is the whole part of a texel.
//!
//! *Error.* The polynomials are off by less than 0.01 pixels anywhere on a field of
//! [`WIDEST`](Near::WIDEST), at the horizon too. Within a degree of the zenith altitude is no polynomial:
//! light there is that of the anchor, as the air over it does not change.
//!
//! *The rounded globe.* The picture of the Moon's globe is made for directions that are rounded, to be kept from
//! frame to frame ([`super::globe`]). Here an eighth of its pixels would be a hundred of the frame's. The
//! small turn from the true to the rounded directions moves each point of the picture to where it belongs; what
//! is left, of heights and of the shape of the limb, is 1e-6 radii.

use glam::{DMat3, DVec2, DVec3};

use crate::camera::Camera;
use crate::frame::{Apparent, Dir};
use crate::light::disc_light::disc_axes;
use crate::units::Angle;

use super::disc::{Disc, DiscBand, NODES};
use super::globe::limb::Limb;
use super::globe::{EXTENT, SeenGlobe, turn};

/// A value and its gains by the offset in pixels, right and down: x, y, xx, xy, yy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadratic<T> {
    pub middle: T,
    pub gains: [T; 5],
}

/// A disc in one band, around the anchor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearBand {
    /// Level and up, radii of the disc.
    pub at: Quadratic<DVec2>,
    /// Squared distance of the anchor from the middle of the disc, less one, squared radii.
    pub over: f64,
    /// Squared distance of the anchor from the middle of what stands in front, less the square of its
    /// radius, squared radii of the disc; one where nothing does.
    pub beside: f64,
    /// Half of what that gains for each radius.
    pub from_occluder: DVec2,
}

/// The globe around the anchor, its north up.
#[derive(Debug, Clone, PartialEq)]
pub struct NearGlobe {
    /// The anchor in each band, radii.
    pub turned: Vec<DVec2>,
    /// Texel of the globe's picture at the anchor, in each band, and the part of a texel beyond.
    pub texels: Vec<([f64; 2], DVec2)>,
    /// Texels in a radius.
    pub texels_per_radius: f64,
    /// Rows that bring a point to where the picture has it: right and up from right, up, away.
    pub shift: [DVec3; 2],
    /// The same for each radius that a point is nearer to the observer, of itself.
    pub growth: f64,
    /// Distance of the outline from the middle less that of the first band's anchor, radii, by the tangent
    /// of the angle around the middle from the anchor.
    pub outline: Vec<f64>,
    /// Steps of the outline for a unit of the tangent.
    pub outline_steps: f64,
}

/// A disc on a narrow picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Near {
    /// In the middle of what is seen of the disc.
    pub anchor_px: [f64; 2],
    /// Among the nodes by apparent altitude.
    pub place: Quadratic<f64>,
    /// Width of a pixel in the first band, radii.
    pub pixel: f64,
    /// One for each of the disc's.
    pub bands: Vec<NearBand>,
    pub globe: Option<NearGlobe>,
}

impl Near {
    /// Fields below this are narrow: above, small differences in 32 bits are finer than a hundredth of
    /// a pixel by themselves.
    pub const WIDEST: Angle = Angle::from_arcsec(71.9);
    /// Nodes of the outline.
    pub const OUTLINE_NODES: usize = 257;
    /// Beyond this altitude what is seen through the air is taken as even.
    const ZENITH: Angle = Angle::from_deg(89.0);
    /// Offsets that the polynomials are made from are at least this, pixels.
    const LEAST_PX: f64 = 8.0;

    /// None where the field is wide, or no sky is where the disc is seen.
    pub fn of(disc: &Disc, camera: &Camera) -> Option<Near> {
        if camera.field_of_view >= Near::WIDEST {
            return None;
        }
        let [first, last] = disc.bounds_px;
        let anchor_px = [0, 1].map(|axis| (0.5 * (first[axis] + last[axis])).floor());
        let half_px =
            [0, 1].map(|axis| (0.5 * (last[axis] - first[axis])).max(Near::LEAST_PX).ceil());
        let chain = Chain::of(disc, camera);
        let place =
            quadratic(half_px, |off| chain.place([anchor_px[0] + off[0], anchor_px[1] + off[1]]))?;
        let is_even = chain.altitude(anchor_px)? > Near::ZENITH;
        let bands: Option<Vec<NearBand>> = (disc.bands.iter())
            .map(|band| {
                let at = quadratic(half_px, |off| {
                    let pixel = [anchor_px[0] + off[0], anchor_px[1] + off[1]];
                    chain.point(band, pixel).map(|point| point.truncate())
                })?;
                Some(near_band(disc, at, chain.point(band, anchor_px)?))
            })
            .collect();
        let bands = bands?;
        let [right, down, ..] = bands.first()?.at.gains;
        let globe = (disc.globe.as_ref()).map(|seen| near_globe(seen, &bands, half_px));
        Some(Near {
            anchor_px,
            place: if is_even {
                let middle = place.middle.clamp(0.0, (NODES - 1) as f64);
                Quadratic { middle, gains: [0.0; 5] }
            } else {
                place
            },
            pixel: 0.5 * (right.length() + down.length()),
            bands,
            globe,
        })
    }
}

/// What leads from a pixel to a point of the disc, in 64 bits: the twin of `shaders/lib/disc_far.wgsl`.
struct Chain<'a> {
    disc: &'a Disc,
    camera: &'a Camera,
    lowest: Angle,
    azimuth: Angle,
    radius: f64,
}

impl Chain<'_> {
    /// So far beyond the first and the last node their curves hold.
    const BEYOND: f64 = 1.5;

    fn of<'a>(disc: &'a Disc, camera: &'a Camera) -> Chain<'a> {
        Chain {
            disc,
            camera,
            lowest: disc.lowest.altitude(),
            azimuth: disc.lowest.azimuth(),
            radius: disc.shape.angular_radius.sin(),
        }
    }

    fn dir(&self, pixel: [f64; 2]) -> Option<Dir<Apparent>> {
        let view = self.camera.view_from_pixel(pixel)?;
        Some(self.camera.view_from_apparent().inverse() * view)
    }

    fn altitude(&self, pixel: [f64; 2]) -> Option<Angle> {
        self.dir(pixel).map(Dir::altitude)
    }

    /// Place among the nodes.
    fn place(&self, pixel: [f64; 2]) -> Option<f64> {
        Some((self.altitude(pixel)? - self.lowest).rad() / self.disc.step.rad())
    }

    /// The point of the disc in a band: level, up, away, radii. Far beyond the nodes it goes
    /// on as it went.
    fn point(&self, band: &DiscBand, pixel: [f64; 2]) -> Option<DVec3> {
        let dir = self.dir(pixel)?;
        let place = (dir.altitude() - self.lowest).rad() / self.disc.step.rad();
        // A little beyond the ends their curves go on: what is seen there counts for the polynomials.
        let within = place.clamp(-Chain::BEYOND, (NODES - 1) as f64 + Chain::BEYOND);
        let node = (within.max(0.0) as usize).min(NODES - 2);
        let t = within - node as f64;
        let [low, high] = [0, 1].map(|next| &band.nodes[node + next]);
        let gain = (high.above_centre - low.above_centre).rad();
        let bend = (low.rise.rad() - gain) * (1.0 - t) - (high.rise.rad() - gain) * t;
        let beyond = if place > within { high.rise } else { low.rise };
        let above = low.above_centre.rad()
            + t * (gain + (1.0 - t) * bend)
            + (place - within) * beyond.rad();
        let (sin_centre, cos_centre) = self.disc.shape.centre.altitude().sin_cos();
        // One less the cosine, which keeps its digits.
        let versine = |angle: f64| 2.0 * (0.5 * angle).sin().powi(2);
        let azimuth = (dir.azimuth() - self.azimuth).rad();
        let cos_altitude = cos_centre * (1.0 - versine(above)) - sin_centre * above.sin();
        let point = DVec3::new(
            cos_altitude * azimuth.sin(),
            above.sin() + cos_altitude * sin_centre * versine(azimuth),
            versine(above) + cos_altitude * cos_centre * versine(azimuth),
        );
        Some(point / self.radius)
    }
}

/// The polynomial through nine values, of which those at the corners count for one gain alone.
fn quadratic<T>(half_px: [f64; 2], value: impl Fn([f64; 2]) -> Option<T>) -> Option<Quadratic<T>>
where
    T: Copy
        + std::ops::Add<Output = T>
        + std::ops::Sub<Output = T>
        + std::ops::Mul<f64, Output = T>,
{
    let [x, y] = half_px;
    let middle = value([0.0, 0.0])?;
    let [right, left] = [value([x, 0.0])? - middle, value([-x, 0.0])? - middle];
    let [below, over] = [value([0.0, y])? - middle, value([0.0, -y])? - middle];
    let corner = |across: f64, down: f64| Some(value([across * x, down * y])? - middle);
    let crossed = corner(1.0, 1.0)? - corner(-1.0, 1.0)? - corner(1.0, -1.0)? + corner(-1.0, -1.0)?;
    let gains = [
        (right - left) * (0.5 / x),
        (below - over) * (0.5 / y),
        (right + left) * (0.5 / (x * x)),
        crossed * (0.25 / (x * y)),
        (below + over) * (0.5 / (y * y)),
    ];
    Some(Quadratic { middle, gains })
}

/// Given the point of the disc at the anchor: level, up, away.
fn near_band(disc: &Disc, at: Quadratic<DVec2>, point: DVec3) -> NearBand {
    let over = at.middle.length_squared() - 1.0;
    let radius = disc.shape.angular_radius.sin();
    let Some((dir, occluder)) = disc.occluder.filter(|(_, occluder)| occluder.rad() > 0.0) else {
        return NearBand { at, over, beside: 1.0, from_occluder: DVec2::ZERO };
    };
    let [level, up, toward] = disc_axes(disc.shape.centre).map(|axis| axis.dot(dir.vector()));
    let chord = 2.0 * (0.5 * occluder.rad()).sin() / radius;
    let middle = DVec3::new(level, up, 1.0 - toward) / radius;
    let off = point - middle;
    NearBand {
        at,
        over,
        beside: off.length_squared() - chord * chord,
        // What is farther from the middle of the disc is farther away.
        from_occluder: off.truncate() + at.middle * (off.z * radius),
    }
}

fn near_globe(seen: &SeenGlobe, bands: &[NearBand], half_px: [f64; 2]) -> NearGlobe {
    let (sin, cos) = seen.north.sin_cos();
    let turned = |v: DVec2| DVec2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos);
    let turned: Vec<DVec2> = bands.iter().map(|band| turned(band.at.middle)).collect();
    let view = &seen.globe.view;
    let size = f64::from(view.picture_px);
    let texels_per_radius = 0.5 * size / EXTENT;
    let texel = |at: &DVec2| {
        let texel = DVec2::new(at.x, -at.y) * texels_per_radius + 0.5 * size - 0.5;
        (texel.floor().to_array(), texel - texel.floor())
    };
    let shift = view.body_from_picture().transpose() * seen.body_from_picture - DMat3::IDENTITY;
    let (outline, outline_steps) = outline(&seen.globe.limb, &turned, bands, half_px);
    NearGlobe {
        texels: turned.iter().map(texel).collect(),
        turned,
        texels_per_radius,
        shift: [shift.row(0), shift.row(1)],
        growth: 1.0 / view.distance - 1.0 / seen.distance,
        outline,
        outline_steps,
    }
}

/// The outline around the anchor of the first band as far as the picture goes, and its steps in a unit of
/// the tangent.
fn outline(
    limb: &Limb,
    turned: &[DVec2],
    bands: &[NearBand],
    [across_px, down_px]: [f64; 2],
) -> (Vec<f64>, f64) {
    /// No limb is this near to the middle.
    const INSIDE: f64 = 0.8;
    let first = turned[0];
    let radius = first.length();
    if radius < INSIDE {
        return (vec![9.0; Near::OUTLINE_NODES], 1.0);
    }
    let reach = |band: (&NearBand, &DVec2)| {
        let [right, down, ..] = band.0.at.gains;
        right.length() * across_px + down.length() * down_px + (*band.1 - first).length()
    };
    let reach = bands.iter().zip(turned).map(reach).fold(0.0, f64::max);
    // A little farther than the tangent goes where the limb is seen.
    let farthest = 1.2 * reach / radius;
    let half = 0.5 * (Near::OUTLINE_NODES - 1) as f64;
    let (outward, around) = (first / radius, DVec2::new(-first.y, first.x) / radius);
    let at = |node: usize| {
        let tangent = (node as f64 / half - 1.0) * farthest;
        1.0 + over_mean(limb, outward + around * tangent) - radius
    };
    ((0..Near::OUTLINE_NODES).map(at).collect(), half / farthest)
}

/// How far beyond the mean radius the limb is in a direction.
fn over_mean(limb: &Limb, direction: DVec2) -> f64 {
    let count = limb.over_mean.len();
    let place = turn::share(direction) * count as f64;
    let along = place - place.floor();
    let node = place.floor() as usize;
    let [low, high] = [0, 1].map(|next| limb.over_mean[(node + next) % count]);
    low * (1.0 - along) + high * along
}

#[cfg(test)]
mod tests {
    use crate::frame::Horizon;
    use crate::plan::disc::{DiscNode, DiscShape, Lattice, SurfaceLaw};
    use crate::units::Xyzv;

    use super::*;

    /// Refraction that changes as fast as that of real air does at the horizon.
    fn refraction_deg(apparent_deg: f64) -> f64 {
        (1.0 / (apparent_deg + 7.31 / (apparent_deg + 4.4)).to_radians().tan()) / 60.0
    }

    /// The Sun, its lower limb seen at an altitude.
    fn sun(lowest_deg: f64) -> Disc {
        let (step_deg, radius_deg) = (0.52 / (NODES - 1) as f64, 0.26);
        let true_deg: Vec<f64> = (0..NODES)
            .map(|node| lowest_deg + step_deg * node as f64)
            .map(|apparent| apparent - refraction_deg(apparent))
            .collect();
        let centre_deg = true_deg[0] + radius_deg;
        let slope = |node: usize| {
            let apparent = lowest_deg + step_deg * node as f64;
            let off = |by: f64| apparent + by - refraction_deg(apparent + by);
            (off(1e-4) - off(-1e-4)) / 2e-4 * step_deg
        };
        let nodes = (0..NODES).map(|node| DiscNode {
            above_centre: Angle::from_deg(true_deg[node] - centre_deg),
            rise: Angle::from_deg(slope(node)),
            luminance: Xyzv::BLACK,
        });
        let azimuth = Angle::from_deg(250.0);
        let centre: Dir<Horizon> = Dir::from_azimuth_altitude(azimuth, Angle::from_deg(centre_deg));
        let lowest = Dir::from_azimuth_altitude(azimuth, Angle::from_deg(lowest_deg));
        Disc {
            label: "Sun",
            shape: DiscShape {
                centre,
                angular_radius: Angle::from_deg(radius_deg),
                dir_to_sun: centre,
                body_from_horizon: DMat3::IDENTITY,
                law: SurfaceLaw::Lambert,
            },
            bounds_px: [[0.0, 0.0], [1280.0, 720.0]],
            lowest,
            lowest_in_view: Dir::from_vector(DVec3::NEG_Z),
            step: Angle::from_deg(step_deg),
            bands: vec![DiscBand { limb_darkening: [0.0; 6], nodes: nodes.collect() }],
            is_cut_by_horizon: false,
            globe: None,
            samples: [Lattice { points: 1, turn: 1 }; 2],
            edge: 0.1,
            occluder: Some((centre, Angle::from_deg(0.2))),
        }
    }

    fn camera(field_arcsec: f64, azimuth_deg: f64, altitude_deg: f64) -> Camera {
        Camera {
            projection: crate::camera::Projection::Stereographic,
            field_of_view: Angle::from_arcsec(field_arcsec),
            azimuth: Angle::from_deg(azimuth_deg),
            altitude: Angle::from_deg(altitude_deg),
            roll: Angle::from_deg(20.0),
            width_px: 1280,
            height_px: 720,
        }
    }

    fn at<T>(quadratic: &Quadratic<T>, [x, y]: [f64; 2]) -> T
    where
        T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        let [right, down, xx, xy, yy] = quadratic.gains;
        quadratic.middle + right * x + down * y + xx * (x * x) + xy * (x * y) + yy * (y * y)
    }

    #[test]
    fn polynomials_are_the_chain_to_a_hundredth_of_a_pixel() {
        for (lowest_deg, up_deg) in [(0.0, 0.0), (0.0, 0.3), (2.0, 0.52), (40.0, 0.1), (88.0, 0.3)]
        {
            let disc = sun(lowest_deg);
            for field_arcsec in [71.0, 10.0, 1.0] {
                let camera = camera(field_arcsec, 250.1, lowest_deg + up_deg);
                let near = Near::of(&disc, &camera).expect("narrow");
                let chain = Chain::of(&disc, &camera);
                for pixel in [[0.5, 0.5], [1279.5, 0.5], [300.0, 719.0], [900.0, 200.0]] {
                    let off = [pixel[0] - near.anchor_px[0], pixel[1] - near.anchor_px[1]];
                    let exact = chain.point(&disc.bands[0], pixel).expect("sky").truncate();
                    let off_px = (at(&near.bands[0].at, off) - exact).length() / near.pixel;
                    assert!(off_px < 0.02, "{lowest_deg} {field_arcsec}: {off_px} px");
                    // Of the altitude, in pixels.
                    let place = chain.place(pixel).expect("sky");
                    let off_px =
                        (at(&near.place, off) - place) * disc.step.rad() * camera.focal_px();
                    assert!(off_px.abs() < 0.02, "{lowest_deg} {field_arcsec}: {off_px} px");
                }
            }
        }
    }

    #[test]
    fn differences_at_the_anchor_are_those_of_the_point_there() {
        let disc = sun(30.0);
        let near = Near::of(&disc, &camera(1.0, 250.05, 30.2)).expect("narrow");
        let band = near.bands[0];
        assert!((band.at.middle.length_squared() - 1.0 - band.over).abs() < 1e-15);
        // What stands in front is around the same middle, and has 0.2 of 0.26 degrees.
        let radius = Angle::from_deg(0.1).sin() * 2.0 / Angle::from_deg(0.26).sin();
        let beside = band.at.middle.length_squared() - radius * radius;
        assert!((band.beside - beside).abs() < 1e-5, "{} {beside}", band.beside);
        assert!((band.from_occluder - band.at.middle).length() < 1e-4);
    }

    #[test]
    fn wide_pictures_have_none() {
        assert!(Near::of(&sun(30.0), &camera(72.0, 250.0, 30.2)).is_none());
    }
}
