//! Lenses: the field that they show, the light that they lose beside the axis, the spikes of their
//! aperture.
//!
//! *Natural vignetting.* The illuminance of the sensor falls with the fourth power of the cosine of the
//! angle in a lens that keeps straight lines straight; in a fisheye, whose pupil turns towards the ray, only
//! with the sky on a unit of sensor: fourth power of the cosine of half the angle (stereographic), none
//! (equal-area). Both are `(1 + k r^2)^-2` with r in focal lengths and k of 1, 1/4 and 0. For equidistant ones,
//! sin(theta)/theta, k of 1/12 is 1.5 % off at 60 degrees and 8 % at 90. *Mechanical vignetting*
//! is of the tube of the lens and differs from lens to lens: ours takes [`MECHANICAL_STOPS`] in
//! the corner wide open, growing with the fourth power of the height in the picture, and is gone two stops
//! further down.
//!
//! *Spikes.* A straight edge of the aperture, of length a, sends light at right angles to it. By Fraunhofer
//! diffraction (Born & Wolf, section 8.5; Parseval's theorem for the whole) the share beyond a distance x on one side
//! is `a lambda f / (4 pi^2 S x)`, S the area of the aperture: it falls as 1/x^2 along the spike.
//! An even number of blades has as many spikes, each of two edges; an odd one twice as many. The fringes
//! along them, which differ from colour to colour, are left out, as is what the round corners do.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::camera::Projection;
use crate::units::{Angle, Xyzv};

use super::sensor::Sensor;
use super::{PhotoError, within};

/// What the tube of a lens takes in the corner wide open, factors of two. Chosen: fast lenses take half a
/// stop to two.
pub const MECHANICAL_STOPS: f64 = 0.7;

/// A lens.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lens {
    pub focal_mm: f64,
    /// Focal length over the width of the aperture.
    pub f_number: f64,
    /// The lowest aperture number that the lens has.
    pub widest_f_number: f64,
    /// Share of the light that comes through.
    pub transmission: f64,
    /// Whether less light falls beside the axis.
    pub vignetting: bool,
    /// Straight blades of the aperture, each with a spike or two; 0: round, without spikes.
    pub blades: u32,
    /// Turn of the blades; at 0 degrees one edge is level.
    pub blades_turn_deg: f64,
}

impl Default for Lens {
    fn default() -> Self {
        Lens {
            focal_mm: 24.0,
            f_number: 2.8,
            widest_f_number: 2.8,
            transmission: 0.9,
            vignetting: true,
            blades: 0,
            blades_turn_deg: 0.0,
        }
    }
}

/// How light falls off beside the axis: `(1 + natural r^2)^-2 (1 - mechanical h^4)`, r in focal lengths, h the
/// share of the way to the corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Falloff {
    pub natural: f64,
    pub mechanical: f64,
}

impl Falloff {
    /// The share that is left, of the squares of r and h.
    pub fn at(&self, r2: f64, h2: f64) -> f64 {
        let natural = 1.0 + self.natural * r2;
        (1.0 - self.mechanical * h2 * h2) / (natural * natural)
    }
}

impl Lens {
    /// Checks every value.
    pub fn validate(&self) -> Result<(), PhotoError> {
        within("lens.focal_mm", Some(self.focal_mm), 0.1, 100_000.0)?;
        within("lens.f_number", Some(self.f_number), 0.5, 1000.0)?;
        within("lens.widest_f_number", Some(self.widest_f_number), 0.5, 1000.0)?;
        within("lens.transmission", Some(self.transmission), 0.001, 1.0)?;
        within("lens.blades_turn_deg", Some(self.blades_turn_deg), -360.0, 360.0)?;
        match self.blades {
            0 | 3..=32 => Ok(()),
            blades => Err(PhotoError::Blades(blades)),
        }
    }

    /// The angle that the width of a picture spans, by a lens that keeps lines straight.
    pub fn field_of_view(&self, sensor: &Sensor) -> Angle {
        Angle::from_rad(2.0 * (sensor.width_mm / 2.0 / self.focal_mm).atan())
    }

    /// The same lens with the focal length whose picture spans an angle; none for half a turn and more.
    pub fn spanning(&self, field_of_view: Angle, sensor: &Sensor) -> Option<Lens> {
        let half = field_of_view.rad() / 2.0;
        let focal_mm = sensor.width_mm / 2.0 / half.tan();
        (half > 0.0 && half < PI / 2.0).then_some(Lens { focal_mm, ..*self })
    }

    /// How light falls off in a picture of a projection.
    pub fn falloff(&self, projection: Projection) -> Falloff {
        if !self.vignetting {
            return Falloff { natural: 0.0, mechanical: 0.0 };
        }
        let natural = match projection {
            Projection::Perspective => 1.0,
            Projection::Stereographic => 0.25,
            Projection::Equidistant => 1.0 / 12.0,
            Projection::EqualArea | Projection::Equirectangular => 0.0,
        };
        let stops_down = 2.0 * (self.f_number / self.widest_f_number).log2();
        let wide_open = 1.0 - (-MECHANICAL_STOPS).exp2();
        let mechanical = wide_open * (1.0 - stops_down / 2.0).clamp(0.0, 1.0);
        Falloff { natural, mechanical }
    }

    /// The spikes of this lens in pictures of a sensor, so many pixels across; none with round apertures.
    pub fn spikes(&self, sensor: &Sensor, width_px: u32) -> Option<Spikes> {
        (self.blades >= 3).then(|| {
            let pixel_mm = sensor.width_mm / f64::from(width_px);
            // A polygon of n sides and of area S has edges of 2 sqrt(S tan(pi/n)/n); S is that of a round
            // aperture as wide as the focal length over the aperture number.
            let n = f64::from(self.blades);
            let root_area_mm = PI.sqrt() / 2.0 * self.focal_mm / self.f_number;
            let edge_over_area = 2.0 * ((PI / n).tan() / n).sqrt() / root_area_mm;
            // a lambda f / (4 pi^2 S), in pixels for each millimetre of wavelength.
            let per_mm = edge_over_area * self.focal_mm / (4.0 * PI * PI) / pixel_mm;
            let (lines, edges) = match self.blades % 2 {
                0 => (self.blades / 2, 2.0),
                _ => (self.blades, 1.0),
            };
            Spikes {
                lines,
                turn: Angle::from_deg(self.blades_turn_deg),
                reach_px: SPIKE_NM.map(|nm| edges * per_mm * nm * 1e-6),
            }
        })
    }
}

/// Mean wavelengths of X, Y, Z and V, nm.
const SPIKE_NM: [f64; 4] = [595.0, 560.0, 450.0, 505.0];

/// The spikes of an aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spikes {
    /// Lines through a point, each two spikes.
    pub lines: u32,
    /// Of the first line from the upright, clockwise.
    turn: Angle,
    /// Share of the light beyond a distance on one side of a line, times that distance, pixels.
    pub reach_px: [f64; 4],
}

/// A line of light through a point: both spikes of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spike {
    pub centre_px: [f64; 2],
    /// Unit vector, right and down.
    pub direction: [f64; 2],
    /// From the centre to either end, pixels.
    pub half_length_px: f64,
    /// From the middle to either side: where it is gone, pixels.
    pub half_width_px: f64,
    /// At a distance x along the line there are `amplitude profile(x)` lux on a pixel of its length.
    pub amplitude: Xyzv,
}

/// The profile `1/(x^2 + CORE^2)` of a spike, which ends in the light of its point, pixels.
pub const CORE_PX: f64 = 1.0;

impl Spike {
    /// Light on a unit of length, over the amplitude, a distance from the centre: `1/x^2` beyond the core, going
    /// smoothly to zero at the end.
    pub fn profile(&self, x_px: f64) -> f64 {
        let t = x_px / self.half_length_px;
        let end = (1.0 - t * t).max(0.0);
        end * end / (x_px * x_px + CORE_PX * CORE_PX)
    }

    /// The light of the whole line, lux.
    pub fn total(&self) -> Xyzv {
        // The integral of (1 - t^2)^2 / (t^2 + c^2) from 0 to 1.
        let c = CORE_PX / self.half_length_px;
        let one = 1.0 + c * c;
        let half = 1.0 / 3.0 - 2.0 - c * c + one * one * c.recip().atan() / c;
        self.amplitude * (2.0 * half / self.half_length_px)
    }
}

/// Spikes shorter than this are lost in their point, pixels.
const SHORTEST_PX: f64 = 4.0;

impl Spikes {
    /// The spikes of a point of light, and what is left of the point: their sum is what it was.
    ///
    /// Given its illuminance, lux, its radius in the picture (0 for a star), and the illuminance of a pixel that
    /// can no longer be seen, lux; a spike ends where it falls below, or at the longest length.
    pub fn of(
        &self,
        centre_px: [f64; 2],
        illuminance: Xyzv,
        radius_px: f64,
        faintest_lx: f64,
        longest_px: f64,
    ) -> (Xyzv, Vec<Spike>) {
        let Xyzv { x, y, z, v } = illuminance;
        let [of_x, of_y, of_z, of_v] = self.reach_px;
        let amplitude = Xyzv::new(x * of_x, y * of_y, z * of_z, v * of_v);
        // Across the line light lies on some 1.5 pixels, or the width of the disc.
        let half_width_px = radius_px.max(0.0) + HALF_WIDTH_PX;
        let visible_px = (amplitude.y / (faintest_lx.max(1e-30) * half_width_px)).sqrt();
        let half_length_px = visible_px.min(longest_px);
        // No number is too short as well.
        if half_length_px.is_nan() || half_length_px < SHORTEST_PX {
            return (illuminance, Vec::new());
        }
        let spike = |line: u32| {
            let turn = self.turn.rad() + PI * f64::from(line) / f64::from(self.lines);
            let direction = [turn.sin(), -turn.cos()];
            Spike { centre_px, direction, half_length_px, half_width_px, amplitude }
        };
        let spikes: Vec<Spike> = (0..self.lines).map(spike).collect();
        let taken: Xyzv = spikes.iter().map(Spike::total).sum();
        // Never more than half, whatever the lens.
        let most = (taken.x / x).max(taken.y / y).max(taken.z / z).max(taken.v / v) / 0.5;
        let scale = if most > 1.0 { most.recip() } else { 1.0 };
        let dimmed = |spike: Spike| Spike { amplitude: spike.amplitude * scale, ..spike };
        let left = illuminance + taken * -scale;
        (left, spikes.into_iter().map(dimmed).collect())
    }
}

/// Half the width of a spike of a star, pixels.
const HALF_WIDTH_PX: f64 = 1.5;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::sensor::SensorKind;

    #[test]
    fn focal_length_and_field_are_inverse() {
        let sensor = SensorKind::FullFrame.sensor();
        // Known of lenses: 24 mm span 73.7 degrees of the width of a full frame, 50 mm 39.6, 200 mm 10.3.
        for (focal_mm, field_deg) in [(24.0, 73.74), (50.0, 39.60), (200.0, 10.29)] {
            let lens = Lens { focal_mm, ..Lens::default() };
            let field = lens.field_of_view(&sensor);
            assert!((field.deg() - field_deg).abs() < 0.01, "{focal_mm}: {}", field.deg());
            let back = Lens::default().spanning(field, &sensor).unwrap();
            assert!((back.focal_mm - focal_mm).abs() < 1e-9);
        }
        assert!(Lens::default().spanning(Angle::from_deg(180.0), &sensor).is_none());
    }

    #[test]
    fn light_falls_off_by_cosines() {
        let open = Lens { widest_f_number: 2.8, f_number: 2.8, ..Lens::default() };
        let down = Lens { f_number: 5.6, ..open };
        for theta_deg in [0.0, 20.0, 45.0, 60.0] {
            let theta = Angle::from_deg(theta_deg);
            let natural = |projection, r: f64| down.falloff(projection).at(r * r, 1.0);
            let straight = natural(Projection::Perspective, theta.tan());
            assert!((straight - theta.cos().powi(4)).abs() < 1e-12, "{theta_deg}: {straight}");
            let half = theta / 2.0;
            let fisheye = natural(Projection::Stereographic, 2.0 * half.tan());
            assert!((fisheye - half.cos().powi(4)).abs() < 1e-12, "{theta_deg}: {fisheye}");
            let equidistant = natural(Projection::Equidistant, theta.rad());
            let exact = if theta_deg > 0.0 { theta.sin() / theta.rad() } else { 1.0 };
            assert!((equidistant / exact - 1.0).abs() < 0.016, "{theta_deg}: {equidistant}");
        }
        let corner = open.falloff(Projection::EqualArea).at(0.5, 1.0);
        assert!((corner - 0.5f64.powf(0.7)).abs() < 1e-12, "{corner}");
        let off = Lens { vignetting: false, ..open };
        assert_eq!(off.falloff(Projection::Perspective).at(3.0, 1.0), 1.0);
    }

    /// The share of the light of a square aperture beyond u widths of lambda N, on one side: the integral
    /// of the square of the sinc function.
    fn beyond_in_square(u0: f64) -> f64 {
        let step = 1e-4;
        let sinc2 = |u: f64| ((PI * u).sin() / (PI * u)).powi(2);
        let within: f64 = (0..(u0 / step) as usize).map(|i| sinc2((i as f64 + 0.5) * step)).sum();
        0.5 - within * step
    }

    #[test]
    fn spikes_of_a_square_are_those_of_fraunhofer() {
        let sensor = SensorKind::FullFrame.sensor();
        let lens = Lens { blades: 4, f_number: 8.0, ..Lens::default() };
        let spikes = lens.spikes(&sensor, 1920).unwrap();
        assert_eq!(spikes.lines, 2);
        // A square as large as the round aperture.
        let width_mm = PI.sqrt() / 2.0 * lens.focal_mm / lens.f_number;
        let pixel_mm = 36.0 / 1920.0;
        let unit_px = 560e-6 * lens.focal_mm / width_mm / pixel_mm;
        for x_px in [5.0 * unit_px, 20.0 * unit_px] {
            let exact = beyond_in_square(x_px / unit_px);
            let stated = spikes.reach_px[1] / x_px;
            assert!((stated / exact - 1.0).abs() < 0.03, "{x_px}: {stated}, not {exact}");
        }
        let odd = Lens { blades: 5, ..lens }.spikes(&sensor, 1920).unwrap();
        assert_eq!(odd.lines, 5);
        assert!(Lens { blades: 0, ..lens }.spikes(&sensor, 1920).is_none());
    }

    #[test]
    fn spikes_take_from_their_point_what_they_have() {
        let lens = Lens { blades: 7, f_number: 16.0, ..Lens::default() };
        let spikes = lens.spikes(&SensorKind::FullFrame.sensor(), 1920).unwrap();
        let star = Xyzv::new(2e-6, 2.5e-6, 3e-6, 5e-6);
        let (left, lines) = spikes.of([100.0, 80.0], star, 0.0, 1e-13, 500.0);
        assert_eq!(lines.len(), 7);
        // The profile, summed pixel by pixel, against the integral.
        let line = lines[0];
        let sum: f64 = (-600..=600).map(|x| line.profile(f64::from(x))).sum();
        let total = line.total();
        assert!((sum * line.amplitude.y / total.y - 1.0).abs() < 5e-3, "{sum}");
        let all: Xyzv = lines.iter().map(Spike::total).sum();
        let back = left + all;
        for (back, was) in [(back.x, star.x), (back.y, star.y), (back.z, star.z), (back.v, star.v)]
        {
            assert!((back / was - 1.0).abs() < 1e-12);
        }
        assert!(left.y < star.y && left.y > 0.5 * star.y, "{}", left.y / star.y);
        // Too faint to be seen: nothing is drawn and nothing taken.
        let (left, none) = spikes.of([100.0, 80.0], star, 0.0, 1e-6, 500.0);
        assert!(none.is_empty() && left == star);
    }
}
