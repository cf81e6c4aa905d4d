//! The Sun, the Moon and planets as the camera has them: as a point, a few points, or a disc.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::DMat3;

use crate::air::extinction::SightLines;
use crate::air::refraction::{Rays, Refraction};
use crate::camera::Camera;
use crate::catalog::MoonMaps;
use crate::ephemeris::Body;
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::disc_light::disc_axes;
use crate::light::moon::{Reflectance, bands};
use crate::light::night::{LitObject, Night};
use crate::light::saturn_rings;
use crate::light::spectrum::Spectrum;
use crate::light::sun::LimbDarkening;
use crate::sky::BodyState;
use crate::units::{Angle, MOON_RADIUS_KM, SUN_RADIUS_KM, Xyzv};

use super::disc::{Disc, DiscBand, DiscNode, DiscShape, Lattice, NODES, SurfaceLaw};
use super::globe::umbra::UmbraTable;
use super::globe::{self, CHANNELS, GlobeView, KeptGlobe, SeenGlobe};
use super::planet::PlanetDisc;

/// A disc smaller than this is a point.
const POINT_PX: f64 = 0.5;
/// A disc smaller than this is a handful of points.
const SMALL_PX: f64 = 8.0;
/// Rings of points in a small disc: 3 n^2 points.
pub const SMALL_DISC_RINGS: usize = 12;
/// A disc smaller than this has as many samples inside as at its edges.
const COARSE_PX: f64 = 48.0;
/// Samples in a pixel, inside a large disc and at edges.
const INSIDE: Lattice = Lattice { points: 5, turn: 3 };
const EDGE: Lattice = Lattice { points: 34, turn: 21 };
/// Inside rings, where the edges of shadows are not looked for; and at the edges of a planet in bands of
/// colour, which stand apart and share the samples out.
const BETWEEN: Lattice = Lattice { points: 13, turn: 8 };
/// Samples are those of an edge within this many pixels of it: the scale of a picture may differ by
/// half along and across.
const EDGE_PX: f64 = 2.5;
/// Wavelength whose limb darkening stands for all where one does: near the peak of photopic sight.
const LIMB_NM: f64 = 555.0;
/// Points of the limb that find out where on the picture a disc lies.
const LIMB_POINTS: usize = 64;
/// The nodes reach beyond a limb by this share of the radius.
const BEYOND_LIMB: f64 = 0.01;

/// Wavelengths whose refraction tells whether colours come apart, and how far they may unseen, pixels.
const DISPERSION_NM: [f64; 2] = [650.0, 450.0];
const UNSEEN_PX: f64 = 0.2;
/// The same on a globe, whose limb is not as sharp as the Sun's.
const UNSEEN_ON_GLOBE_PX: f64 = 1.0;
/// Wavelengths of the first and the last band: beyond them low air leaves no light, or eyes see none.
const BANDS_NM: [f64; 2] = [680.0, 420.0];
/// Bands that a disc is divided into: more where they would stand more than a pixel apart.
const BANDS: [usize; 2] = [8, 32];
const BANDS_OF_GLOBE: usize = 3;

/// A body, its light, and the camera that looks at it.
pub struct SeenBody<'a> {
    state: &'a BodyState,
    object: &'a LitObject,
    night: &'a Night,
    camera: &'a Camera,
    px_per_rad: f64,
}

/// The air across a disc: by apparent altitude from its lowest visible point up.
pub struct DiscAir {
    lowest: Angle,
    step: Angle,
    /// From red to blue, or one alone.
    bands: Vec<BandAir>,
}

/// The first alone, where there is no globe.
type Channels = [Xyzv; CHANNELS];

struct BandAir {
    /// Where the limb darkening is taken.
    nm: f64,
    /// True altitudes of the nodes, and the light of the whole body through the air there, lux, by
    /// channel.
    nodes: Vec<(Angle, Channels)>,
}

impl DiscAir {
    /// Bands of colour that the disc is drawn in.
    pub fn bands(&self) -> usize {
        self.bands.len()
    }

    /// Light of the whole body if all of it stood at this apparent altitude, in a single band, lux.
    fn light_at(&self, altitude: Angle) -> Xyzv {
        let nodes = &self.bands[0].nodes;
        let place =
            ((altitude - self.lowest).rad() / self.step.rad()).clamp(0.0, (NODES - 1) as f64);
        let low = (place as usize).min(NODES - 2);
        let along = place - low as f64;
        let all = |node: usize| -> Xyzv { nodes[node].1.iter().copied().sum() };
        all(low) * (1.0 - along) + all(low + 1) * along
    }
}

impl<'a> SeenBody<'a> {
    pub fn of(
        state: &'a BodyState,
        object: &'a LitObject,
        night: &'a Night,
        camera: &'a Camera,
    ) -> SeenBody<'a> {
        let pixel_sr = camera
            .pixel_from_apparent(object.apparent)
            .map_or(0.0, |pixel| camera.pixel_solid_angle_sr(pixel));
        // Where the plane has no place for the centre, the scale of the picture's own centre.
        let px_per_rad = if pixel_sr > 0.0 { pixel_sr.sqrt().recip() } else { camera.focal_px() };
        SeenBody { state, object, night, camera, px_per_rad }
    }

    fn across_px(&self) -> f64 {
        2.0 * self.state.angular_radius.rad() * self.px_per_rad
    }
    fn refraction(&self) -> &Refraction {
        &self.night.refraction
    }
    pub fn is_point(&self) -> bool {
        self.across_px() < POINT_PX
    }
    pub fn is_small(&self) -> bool {
        self.across_px() < SMALL_PX
    }
    pub fn apparent(&self) -> Dir<Apparent> {
        self.object.apparent
    }
    /// Light of the body, lux: see [`LitObject::ground`].
    pub fn light(&self) -> Xyzv {
        self.object.ground
    }

    /// Whether all of it has set.
    pub fn is_below_horizon(&self) -> bool {
        self.limb(self.reach()) < self.night.horizon
    }

    /// How far the body reaches from its middle, radii.
    fn reach(&self) -> f64 {
        if self.state.rings.is_some() { saturn_rings::REACH } else { 1.0 }
    }

    /// Apparent altitude of the lower (-1) or upper (+1) limb, or of a height in radii between.
    fn limb(&self, radii: f64) -> Angle {
        let altitude = self.state.dir.altitude() + self.state.angular_radius * radii;
        let altitude = Angle::from_rad(altitude.rad().clamp(-FRAC_PI_2, FRAC_PI_2));
        self.refraction().apparent_from_true(altitude)
    }

    /// How far refraction draws the colours of [`DISPERSION_NM`] apart where the disc is lowest.
    fn dispersion(&self) -> Angle {
        let [red, blue] = DISPERSION_NM.map(|nm| self.rays(nm));
        let (Some(red), Some(blue)) = (red, blue) else { return Angle::ZERO };
        let lowest = self.limb(-self.reach()).max(self.night.horizon);
        blue.at_apparent_altitude(lowest) - red.at_apparent_altitude(lowest)
    }

    /// Rays of one wavelength; none if they run straight.
    fn rays(&self, wavelength_nm: f64) -> Option<Rays> {
        let (air, height_m) = (&self.night.air, self.night.sky.place.height_m);
        let observer = air.observer_air(height_m, wavelength_nm);
        let ground_m = 1000.0 * air.ground_km(height_m);
        air.paths.refracted.then(|| Rays::over_ground(&observer, ground_m).ok()).flatten()
    }

    /// The air across the disc; none when no part of it is above the horizon.
    pub fn air(&self) -> Option<DiscAir> {
        self.air_in(true)
    }

    /// The same for what has no edge by which colours could be seen apart.
    pub fn air_of_one_band(&self) -> Option<DiscAir> {
        self.air_in(false)
    }

    fn air_in(&self, colours: bool) -> Option<DiscAir> {
        let dispersion = self.dispersion();
        let apart_px = dispersion.rad() * self.px_per_rad;
        let unseen_px = if self.is_globe() { UNSEEN_ON_GLOBE_PX } else { UNSEEN_PX };
        let is_coloured = colours && apart_px > unseen_px && !self.is_small();
        // Blue is lifted, red is lowered, by about half of what parts them.
        let spread = if is_coloured { dispersion } else { Angle::ZERO };
        let lowest = (self.limb(-self.reach() - BEYOND_LIMB) - spread).max(self.night.horizon);
        let highest = self.limb(self.reach() + BEYOND_LIMB) + spread;
        if highest <= lowest {
            return None;
        }
        let step = (highest - lowest) / (NODES - 1) as f64;
        let altitudes: [Angle; NODES] = std::array::from_fn(|node| lowest + step * node as f64);

        let sight = SightLines::over(&self.night.air, self.night.sky.place.height_m);
        let channels = self.irradiances();
        let through = altitudes.map(|altitude| sight.transmittance(altitude));
        let spectra = through.map(|through| channels.map(|irradiance| irradiance * through));
        let bands = if is_coloured { self.coloured(apart_px, &altitudes, &spectra) } else { None };
        let bands = bands.unwrap_or_else(|| {
            let node = |(altitude, spectra): (&Angle, &[Spectrum; CHANNELS])| {
                let lights = spectra.map(|spectrum| spectrum.xyzv());
                (self.refraction().true_from_apparent(*altitude), lights)
            };
            let nodes = altitudes.iter().zip(&spectra).map(node).collect();
            vec![BandAir { nm: LIMB_NM, nodes }]
        });
        Some(DiscAir { lowest, step, bands })
    }

    /// The bands of colour, equally far apart in refraction, which goes nearly as the inverse square
    /// of the wavelength. Between the middles of two bands light is shared out between them.
    fn coloured(
        &self,
        apart_px: f64,
        altitudes: &[Angle; NODES],
        spectra: &[[Spectrum; CHANNELS]; NODES],
    ) -> Option<Vec<BandAir>> {
        let [red, blue] = BANDS_NM.map(|nm: f64| nm.powi(-2));
        let [red_of, blue_of] = DISPERSION_NM.map(|nm: f64| nm.powi(-2));
        let across_px = apart_px * (blue - red) / (blue_of - red_of);
        let fewest = if self.is_globe() { BANDS_OF_GLOBE } else { BANDS[0] };
        let last = (across_px.ceil() as usize).clamp(fewest - 1, BANDS[1] - 1);
        let band = |band: usize| {
            let nm = (red + (blue - red) * band as f64 / last as f64).powf(-0.5);
            let share = |nm: f64| {
                let place = (nm.powi(-2) - red) / (blue - red) * last as f64;
                (1.0 - (place.clamp(0.0, last as f64) - band as f64).abs()).max(0.0)
            };
            let rays = self.rays(nm)?;
            let nodes = altitudes.iter().zip(spectra).map(|(&altitude, spectra)| {
                let stands = altitude - rays.at_apparent_altitude(altitude);
                (stands, spectra.map(|spectrum| spectrum.weighted(share).xyzv()))
            });
            Some(BandAir { nm, nodes: nodes.collect() })
        };
        (0..=last).map(band).collect()
    }

    pub fn is_moon(&self) -> bool {
        self.state.body == Body::Moon
    }

    /// Whether the Moon is drawn as a globe: when it shows more than points of light.
    fn is_globe(&self) -> bool {
        self.is_moon() && !self.is_small()
    }

    /// Spectral irradiance outside the air. Of a globe, what its surface sends by each of its colours, and
    /// what the Earth lights; else all in the first channel.
    fn irradiances(&self) -> [Spectrum; CHANNELS] {
        if !self.is_globe() {
            // What the Moon hides of the Sun is left out as it is drawn.
            let irradiance = match self.state.body {
                Body::Sun => self.night.irradiance_without_eclipse(self.state),
                _ => self.night.irradiance(self.state),
            };
            return [irradiance, Spectrum::DARK, Spectrum::DARK, Spectrum::DARK];
        }
        let sunlit = self.night.sunlit_moon();
        let [blue, green, red] =
            [0, 1, 2].map(|band| sunlit.weighted(|nm| bands::weights(nm)[band]));
        [red, green, blue, self.night.earthlit_moon()]
    }

    /// The globe of the Moon; none where it is not drawn as one.
    pub fn globe(
        &self,
        maps: &MoonMaps,
        law: Reflectance,
        kept: &mut KeptGlobe,
    ) -> Option<SeenGlobe> {
        if !self.is_globe() {
            return None;
        }
        let horizon_from_body = self.night.sky.moon.horizon_from_moon_fixed.matrix();
        let body_from_horizon = horizon_from_body.transpose();
        let view = GlobeView::of(
            law,
            self.across_px(),
            self.state.distance_km,
            [-self.state.dir.vector(), self.state.dir_to_sun.vector()]
                .map(|v| body_from_horizon * v),
            Angle::from_rad((SUN_RADIUS_KM / self.state.sun_distance_km).asin()),
            self.night.eclipse.moon.as_ref().map(|eclipsed| {
                UmbraTable::of(&eclipsed.shadow, &eclipsed.place, &body_from_horizon)
            }),
        );
        let [level, up, _] = disc_axes(self.state.dir);
        let north = horizon_from_body.z_axis;
        Some(SeenGlobe {
            globe: kept.of(view, maps),
            north: Angle::from_rad(north.dot(level).atan2(north.dot(up))),
            radius_px: 0.5 * self.across_px(),
            body_from_picture: globe::body_from_picture(
                body_from_horizon * -self.state.dir.vector(),
            ),
            distance: self.state.distance_km / MOON_RADIUS_KM,
        })
    }

    /// The points of light of a small disc that are above the horizon and not hidden.
    pub fn points<'s>(
        &'s self,
        shape: &DiscShape,
        air: &'s DiscAir,
    ) -> impl Iterator<Item = (Dir<Apparent>, Xyzv)> + 's {
        let seen = shape.samples(SMALL_DISC_RINGS).into_iter();
        seen.filter(|sample| !self.is_hidden(sample.dir)).filter_map(|sample| {
            let apparent = self.refraction().apparent_from_horizon(sample.dir);
            let altitude = apparent.altitude();
            let light = air.light_at(altitude) * self.refraction().divergence(altitude);
            (altitude >= self.night.horizon).then_some((apparent, light * sample.share))
        })
    }

    /// Whether the Moon stands in front of this direction, and this is not the Moon.
    fn is_hidden(&self, dir: Dir<Horizon>) -> bool {
        self.state.body != Body::Moon && self.night.sky.moon.state.covers(dir)
    }

    /// The rectangle of whole pixels that the disc can touch; none when it is out of view.
    pub fn bounds_px(&self) -> Option<[[f64; 2]; 2]> {
        let (width, height) = (f64::from(self.camera.width_px), f64::from(self.camera.height_px));
        let everything = Some([[0.0, 0.0], [width, height]]);
        let centre = self.state.dir.vector();
        let side = centre.any_orthonormal_vector();
        let across = centre.cross(side);
        let (sin_radius, cos_radius) = (self.state.angular_radius * self.reach()).sin_cos();
        let (mut first, mut last) = ([f64::MAX; 2], [f64::MIN; 2]);
        for step in 0..LIMB_POINTS {
            let turn = std::f64::consts::TAU * step as f64 / LIMB_POINTS as f64;
            let limb = centre * cos_radius + (side * turn.cos() + across * turn.sin()) * sin_radius;
            let apparent = self.refraction().apparent_from_horizon(Dir::from_vector(limb));
            let Some(pixel) = self.camera.pixel_from_apparent(apparent) else {
                // Some of it is where the plane ends. If the centre is too, there is nothing.
                return self.camera.pixel_from_apparent(self.apparent()).and(everything);
            };
            for axis in 0..2 {
                first[axis] = f64::min(first[axis], pixel[axis]);
                last[axis] = f64::max(last[axis], pixel[axis]);
            }
        }
        // Across the seam of a panorama, or around its pole, the limb spans the whole width.
        if self.camera.wrap_px().is_some_and(|wrap| last[0] - first[0] > 0.5 * wrap) {
            return everything;
        }
        // The limb bulges between its points, and its colours stand apart.
        let bulge = 1.0 - (std::f64::consts::PI / LIMB_POINTS as f64).cos();
        let across_px = f64::max(last[0] - first[0], last[1] - first[1]);
        let margin_px = 1.0 + bulge * across_px + self.dispersion().rad() * self.px_per_rad;
        let first = first.map(|v| (v - margin_px).floor().max(0.0));
        let last =
            [(last[0] + margin_px).ceil().min(width), (last[1] + margin_px).ceil().min(height)];
        (first[0] < last[0] && first[1] < last[1]).then_some([first, last])
    }

    /// How the body's light is spread over its disc.
    pub fn shape(&self, surface: Option<&MoonMaps>) -> DiscShape {
        let law = match self.state.body {
            Body::Sun => {
                let limb_darkening = LimbDarkening::at_nm(LIMB_NM).coefficients();
                SurfaceLaw::Sun { limb_darkening }
            }
            Body::Moon => match surface {
                Some(surface) => SurfaceLaw::Moon { map: Arc::clone(&surface.albedo) },
                None => SurfaceLaw::Lambert,
            },
            _ => SurfaceLaw::Planet(PlanetDisc::of(self.state)),
        };
        let body_from_horizon = match self.state.body {
            Body::Moon => self.night.sky.moon.horizon_from_moon_fixed.inverse().matrix(),
            _ => DMat3::IDENTITY,
        };
        DiscShape {
            centre: self.state.dir,
            angular_radius: self.state.angular_radius,
            dir_to_sun: self.state.dir_to_sun,
            body_from_horizon,
            law,
        }
    }

    /// The disc that the GPU draws.
    pub fn disc(
        &self,
        shape: DiscShape,
        globe: Option<SeenGlobe>,
        air: &DiscAir,
        bounds_px: [[f64; 2]; 2],
    ) -> Disc {
        let solid_angle_sr = shape.solid_angle_sr();
        let mean_of_all = match shape.law {
            SurfaceLaw::Sun { .. } => None,
            // The picture of a globe is divided by its own mean.
            _ if globe.is_some() => Some(1.0),
            _ => Some(shape.mean()),
        };
        let channels = if globe.is_some() { CHANNELS } else { 1 };
        let band = |(band, channel): (&BandAir, usize)| {
            let law = LimbDarkening::at_nm(band.nm);
            let mean = mean_of_all.unwrap_or_else(|| law.disc_mean());
            // Nothing of a new Moon is lit, and nothing of it is drawn.
            let per_lux = if mean > 0.0 { 1.0 / (mean * solid_angle_sr) } else { 0.0 };
            let altitude = |node: usize| band.nodes[node].0;
            let nodes = (0..NODES).map(|node| DiscNode {
                above_centre: altitude(node) - self.state.dir.altitude(),
                rise: match node {
                    0 => altitude(1) * 2.0 - (altitude(2) + altitude(0) * 3.0) / 2.0,
                    n if n == NODES - 1 => {
                        (altitude(n) * 3.0 + altitude(n - 2)) / 2.0 - altitude(n - 1) * 2.0
                    }
                    n => (altitude(n + 1) - altitude(n - 1)) / 2.0,
                },
                luminance: band.nodes[node].1[channel] * per_lux,
            });
            DiscBand { limb_darkening: law.coefficients(), nodes: nodes.collect() }
        };
        let moon = &self.night.sky.moon.state;
        let lowest = Dir::from_azimuth_altitude(self.state.dir.azimuth(), air.lowest);
        let radius_px = 0.5 * self.across_px();
        let edge = match shape.law {
            SurfaceLaw::Planet(_) => planet_edge(radius_px, air.bands() > 1),
            _ => EDGE,
        };
        let apart_px = match air.bands() {
            1 => 0.0,
            _ => self.dispersion().rad() * self.px_per_rad,
        };
        Disc {
            label: self.state.body.name(),
            bounds_px,
            lowest,
            lowest_in_view: self.camera.view_from_apparent() * lowest,
            is_cut_by_horizon: air.lowest <= self.night.horizon,
            step: air.step,
            bands: air
                .bands
                .iter()
                .flat_map(|band| (0..channels).map(move |channel| (band, channel)))
                .map(band)
                .collect(),
            samples: [
                match shape.reach() {
                    _ if radius_px < 0.5 * COARSE_PX => edge,
                    reach if reach > 1.0 => BETWEEN,
                    _ => INSIDE,
                },
                edge,
            ],
            edge: (EDGE_PX + apart_px) / radius_px,
            globe,
            occluder: (self.state.body != Body::Moon).then_some((moon.dir, moon.angular_radius)),
            shape,
        }
    }
}

/// Samples at the edges of a planet: as many in a pixel as a crescent asks for that is thinner than it.
fn planet_edge(radius_px: f64, is_coloured: bool) -> Lattice {
    match (radius_px, is_coloured) {
        (tiny, false) if tiny < SMALL_PX => Lattice { points: 610, turn: 377 },
        (small, false) if small < 0.5 * COARSE_PX => Lattice { points: 233, turn: 144 },
        (small, true) if small < 0.5 * COARSE_PX => Lattice { points: 89, turn: 55 },
        (_, true) => BETWEEN,
        (_, false) => EDGE,
    }
}
