//! The Moon as a globe: its relief, the shadows of its mountains, and how light leaves it.
//!
//! A large disc is drawn in two steps. First the globe, a mesh displaced by the measured relief, is
//! drawn as it would look without air, onto a square picture of its own, the Moon's north up: where its
//! mountains stand on the limb, what the Sun and the Earth light, relative to the mean of the disc. Then
//! the disc is drawn through the air with that picture as its surface, turned as it stands in the sky.
//! The first step knows nothing of the air, the second nothing of the Moon.
//!
//! *Kept.* The picture hangs only on where Sun and observer stand over the Moon, and both move by half a
//! degree an hour. They are rounded to a [`QUARTER`] of a pixel of the picture, so that frames in a row
//! share one: the same picture whichever was drawn before.
//!
//! *Accuracy.* The relief has 8 samples a degree, 3.8 km: peaks are lower than in truth by what lies
//! between samples. Rounding moves the terminator and the surface by an eighth of a pixel at most.

pub mod ground;
pub mod limb;
pub mod mesh;
pub mod near_side;
pub mod shadows;
pub mod turn;
pub mod umbra;

use std::sync::Arc;

use glam::{DMat3, DVec3};

use crate::catalog::{MoonMap, MoonMaps, MoonRelief};
use crate::light::moon::{MoonSurface, Reflectance};
use crate::units::{Angle, MOON_RADIUS_KM};

use ground::Ground;
use limb::Limb;
use near_side::NearSide;
use shadows::Shadows;
use umbra::UmbraTable;

/// The picture of the globe reaches over the mean radius by this share: the highest mountains are 0.6 %.
pub const EXTENT: f64 = 1.01;
/// Colours of the surface: reflectances at 643, 566 and 415 nm; and what the Earth lights.
pub const CHANNELS: usize = 4;
/// Wavelengths of the colours, nanometres.
const COLOURS_NM: [f64; 3] = [643.0, 566.0, 415.0];

/// Edges of the smallest and the largest picture of a globe, and the step from one size to the next.
const PICTURE_PX: [f64; 2] = [64.0, 4096.0];
const PICTURE_STEP: f64 = 1.125;
/// What directions over the Moon are rounded to, pixels.
const QUARTER: f64 = 0.25;
/// What the distance of the observer is rounded to, radii of the Moon, and the radius of the Sun.
const DISTANCE_STEP: f64 = 0.5;
const SUN_STEP: Angle = Angle::from_arcsec(2.0);

/// All that the picture of a globe hangs on but the maps, rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct GlobeView {
    pub law: Reflectance,
    /// Edge of the picture, pixels.
    pub picture_px: u32,
    /// Of the observer from the centre, in radii of the Moon.
    pub distance: f64,
    /// From the Moon's centre, in its own axes.
    pub to_observer: DVec3,
    pub to_sun: DVec3,
    pub sun_radius: Angle,
    /// The shadow of the Earth, in an eclipse. It moves too fast to be rounded.
    pub shadow: Option<UmbraTable>,
}

impl GlobeView {
    /// For a disc of so many pixels across; directions are from the Moon's centre in its own axes.
    pub fn of(
        law: Reflectance,
        across_px: f64,
        distance_km: f64,
        [to_observer, to_sun]: [DVec3; 2],
        sun_radius: Angle,
        shadow: Option<UmbraTable>,
    ) -> GlobeView {
        let [least_px, most_px] = PICTURE_PX;
        let steps = ((across_px * EXTENT / least_px).ln() / PICTURE_STEP.ln()).ceil().max(0.0);
        let picture_px = (least_px * PICTURE_STEP.powf(steps)).min(most_px).round();
        let step = Angle::from_rad(QUARTER * 2.0 / picture_px);
        GlobeView {
            law,
            picture_px: picture_px as u32,
            distance: rounded(distance_km / MOON_RADIUS_KM, DISTANCE_STEP),
            to_observer: rounded_direction(to_observer, step),
            to_sun: rounded_direction(to_sun, step),
            sun_radius: Angle::from_rad(rounded(sun_radius.rad(), SUN_STEP.rad())),
            shadow,
        }
    }

    /// The phase angle.
    pub fn phase(&self) -> Angle {
        Angle::from_rad(self.to_sun.angle_between(self.to_observer))
    }

    /// How much of what would hide the Sun from the ground hides the ground from the observer too, where both
    /// stand low over it: `exp(-2 tan(g / 2))` of the angle between them (Hapke 1984, *Icarus* 59, 41).
    pub fn hidden_alike(&self) -> f64 {
        (-2.0 * (0.5 * self.phase().rad()).tan()).exp()
    }

    /// Axes of the picture in the Moon's own: to the right, up, away from the observer.
    pub fn body_from_picture(&self) -> DMat3 {
        body_from_picture(self.to_observer)
    }
}

/// Axes of the picture of a globe in its own, given the direction of the observer: to the right, up, away.
pub fn body_from_picture(to_observer: DVec3) -> DMat3 {
    let away = -to_observer;
    let right = away.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::Y);
    DMat3::from_cols(right, right.cross(away), away)
}

fn rounded(value: f64, step: f64) -> f64 {
    (value / step).round() * step
}

/// With longitude and latitude rounded.
fn rounded_direction(direction: DVec3, step: Angle) -> DVec3 {
    let longitude = rounded(direction.y.atan2(direction.x), step.rad());
    let latitude = rounded(direction.z.clamp(-1.0, 1.0).asin(), step.rad());
    let (sin, cos) = longitude.sin_cos();
    let (up, level) = latitude.sin_cos();
    DVec3::new(level * cos, level * sin, up)
}

/// What the picture of the globe is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Globe {
    pub view: GlobeView,
    /// Height over the mean radius, radii of the Moon.
    pub relief: Arc<NearSide<f32>>,
    /// Reflectances at 643, 566 and 415 nm.
    pub albedo: Arc<NearSide<[f32; 3]>>,
    pub ground: Ground,
    pub shadows: Shadows,
    pub limb: Limb,
}

/// A globe as it stands in the sky.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenGlobe {
    pub globe: Arc<Globe>,
    /// From up in the sky to the Moon's north, growing to the right.
    pub north: Angle,
    /// Radius on the frame, pixels.
    pub radius_px: f64,
    /// Axes of the picture in the Moon's own as they are, not rounded.
    pub body_from_picture: DMat3,
    /// Of the observer from the centre, not rounded, in radii of the Moon.
    pub distance: f64,
}

impl SeenGlobe {
    /// Pixels of the picture along a pixel of the frame, rounded.
    pub fn fineness(&self) -> u32 {
        let across_px = 2.0 * EXTENT * self.radius_px;
        (f64::from(self.globe.view.picture_px) / across_px).round().max(1.0) as u32
    }
}

/// The globe of the frame before, and what of the maps it was made with.
#[derive(Default)]
pub struct KeptGlobe {
    globe: Option<Arc<Globe>>,
    maps: Option<KeptMaps>,
}

/// The maps on the near side, as fine as was last asked for.
struct KeptMaps {
    of: MoonMaps,
    surface: MoonSurface,
    relief: (u32, Arc<NearSide<f32>>),
    albedo: (u32, Arc<NearSide<[f32; 3]>>),
}

impl KeptGlobe {
    /// The globe seen so: the one of the frame before, if it was the same.
    pub fn of(&mut self, view: GlobeView, maps: &MoonMaps) -> Arc<Globe> {
        let are_kept = self.maps.as_ref().is_some_and(|kept| kept.are_of(maps));
        if let Some(globe) = self.globe.as_ref().filter(|globe| are_kept && globe.view == view) {
            return Arc::clone(globe);
        }
        let last = self.maps.take().filter(|_| are_kept);
        let kept = self.maps.insert(KeptMaps::of(maps, view.picture_px, last));
        let phase = view.phase();
        let relief = Arc::clone(&kept.relief.1);
        let radius_px = 0.5 * f64::from(view.picture_px) / EXTENT;
        let globe = Globe {
            ground: Ground::at_phase(view.law, &kept.surface, phase),
            shadows: Shadows::cast(&relief, view.to_sun, view.sun_radius, radius_px),
            limb: Limb::of(&relief, view.body_from_picture(), view.distance),
            albedo: Arc::clone(&kept.albedo.1),
            relief,
            view,
        };
        Arc::clone(self.globe.insert(Arc::new(globe)))
    }
}

impl KeptMaps {
    fn are_of(&self, maps: &MoonMaps) -> bool {
        Arc::ptr_eq(&self.of.relief, &maps.relief)
            && Arc::ptr_eq(&self.of.albedo, &maps.albedo)
            && Arc::ptr_eq(&self.of.hapke, &maps.hapke)
    }

    fn of(maps: &MoonMaps, picture_px: u32, last: Option<KeptMaps>) -> KeptMaps {
        let relief_level = halvings(maps.relief.width, picture_px);
        let albedo_level = halvings(maps.albedo.width, picture_px);
        let (surface, relief, albedo) = match last {
            Some(kept) => (Some(kept.surface), Some(kept.relief), Some(kept.albedo)),
            None => (None, None, None),
        };
        KeptMaps {
            of: maps.clone(),
            surface: surface.unwrap_or_else(|| MoonSurface::new(&maps.albedo, &maps.hapke)),
            relief: relief.filter(|(level, _)| *level == relief_level).unwrap_or_else(|| {
                (relief_level, Arc::new(near_relief(&maps.relief, relief_level)))
            }),
            albedo: albedo.filter(|(level, _)| *level == albedo_level).unwrap_or_else(|| {
                (albedo_level, Arc::new(near_albedo(&maps.albedo, albedo_level)))
            }),
        }
    }
}

fn near_relief(relief: &MoonRelief, level: u32) -> NearSide<f32> {
    let radius_m = (1000.0 * MOON_RADIUS_KM) as f32;
    let radii: Vec<f32> = relief.elevation_m.iter().map(|&m| f32::from(m) / radius_m).collect();
    NearSide::of(&radii, relief.width, level)
}

fn near_albedo(albedo: &MoonMap, level: u32) -> NearSide<[f32; 3]> {
    NearSide::of(&albedo.reff, albedo.width, level)
}

/// How often a map may be halved and still have a cell for each pixel of the picture: in the middle of
/// the disc a picture of `px` shows a turn of the globe in `pi px` pixels.
fn halvings(width: usize, px: u32) -> u32 {
    let cells_per_px = width as f64 / (std::f64::consts::PI * f64::from(px));
    cells_per_px.log2().floor().max(0.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::moon::{HapkeCell, MoonHapke};

    fn maps() -> MoonMaps {
        let cell = HapkeCell { w: 0.338, b: 0.233, c: 0.370, b_s0: 1.716, h_s: 0.060 };
        MoonMaps {
            albedo: Arc::new(MoonMap { width: 64, height: 32, reff: vec![[0.1; 3]; 64 * 32] }),
            relief: Arc::new(MoonRelief { width: 64, height: 32, elevation_m: vec![0; 64 * 32] }),
            hapke: Arc::new(MoonHapke { width: 8, height: 4, cells: vec![[cell; 3]; 32] }),
        }
    }

    fn view(across_px: f64, sun_deg: f64) -> GlobeView {
        let (sin, cos) = sun_deg.to_radians().sin_cos();
        let directions = [DVec3::new(0.995, 0.07, 0.07).normalize(), DVec3::new(cos, sin, 0.0)];
        let sun_radius = Angle::from_arcmin(16.0);
        GlobeView::of(Reflectance::Hapke, across_px, 384_400.0, directions, sun_radius, None)
    }

    #[test]
    fn frames_in_a_row_share_a_globe_and_what_they_share_does_not_hang_on_their_order() {
        let maps = maps();
        let mut kept = KeptGlobe::default();
        let first = kept.of(view(1000.0, 70.0), &maps);
        // Half a degree of the Sun is an hour; a quarter of a pixel two and a half minutes.
        let soon = kept.of(view(1000.0, 70.002), &maps);
        assert!(Arc::ptr_eq(&first, &soon));
        let later = kept.of(view(1000.0, 70.06), &maps);
        assert!(!Arc::ptr_eq(&first, &later) && Arc::ptr_eq(&first.relief, &later.relief));
        assert_eq!(*kept.of(view(1000.0, 70.002), &maps), *first);
        // Other maps are other globes.
        let other = MoonMaps { albedo: Arc::new((*maps.albedo).clone()), ..maps.clone() };
        assert!(!Arc::ptr_eq(&kept.of(view(1000.0, 70.002), &other), &first));
    }

    #[test]
    fn rounding_moves_nothing_by_more_than_it_says() {
        for across_px in [10.0, 200.0, 1080.0, 5000.0] {
            for step in 0..50 {
                let sun_deg = 60.0 + 0.013 * f64::from(step);
                let view = view(across_px, sun_deg);
                let true_sun =
                    DVec3::new(sun_deg.to_radians().cos(), sun_deg.to_radians().sin(), 0.0);
                let off_px = (view.to_sun - true_sun).length() * 0.5 * f64::from(view.picture_px);
                assert!(off_px < 0.126 && view.picture_px >= 64, "{off_px}");
            }
        }
    }

    #[test]
    fn the_picture_has_the_north_of_the_moon_up_and_its_east_to_the_right() {
        let axes = view(1000.0, 60.0).body_from_picture();
        assert!((axes.determinant() + 1.0).abs() < 1e-12, "{}", axes.determinant());
        assert!(axes.x_axis.y > 0.99 && axes.y_axis.z > 0.99 && axes.z_axis.x < -0.99);
    }

    #[test]
    fn maps_are_halved_as_far_as_a_picture_allows() {
        assert_eq!((halvings(2880, 128), halvings(2880, 1090), halvings(2048, 400)), (2, 0, 0));
    }
}
