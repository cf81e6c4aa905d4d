//! Rays bent by air in spherical shells, from the observer out to space.
//!
//! *Theory.* On a sphere `n r cos(altitude)`, refractive index times distance from the centre times
//! cosine of the altitude, keeps its value along a ray (Bouguer). Integrals along the ray are taken in
//! `u = n r sin(altitude)`, signed as the altitude: it grows steadily from the perigee of the ray to
//! space, and the length of path is `ds = du / (d(n r) / dr)`, so nothing diverges at the horizon.
//! Auer & Standish 2000, *AJ* 119, 2472, choose the zenith angle itself for the same end.
//!
//! *Accuracy.* Gauss and Legendre's rule between heights where the profiles are smooth: of order 6
//! between those of [`LEVELS_KM`] for the bending, of order 3 between the nodes of densities that are
//! straight there. Columns and bending agree with stepping along the ray as far as stepping is good,
//! 0.02 % (tested in `tests/light.rs` and `tests/refraction.rs`).

use crate::air::{AIR_TOP_KM, EARTH_RADIUS_KM};
use crate::units::Angle;

/// What bends a ray at one height.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bending {
    /// Refractive index less one.
    pub refractivity: f64,
    /// How it changes with height; negative.
    pub slope_per_km: f64,
}

impl Bending {
    /// Refractive index times distance from the Earth's centre.
    fn scaled_radius_km(self, height_km: f64) -> f64 {
        (1.0 + self.refractivity) * (EARTH_RADIUS_KM + height_km)
    }
    /// Its slope against the height: about 0.84 at sea level, 1 in space. Where it is not positive
    /// the air bends rays more than the Earth is curved.
    pub fn scaled_radius_slope(self, height_km: f64) -> f64 {
        1.0 + self.refractivity + (EARTH_RADIUS_KM + height_km) * self.slope_per_km
    }
}

/// Air whose index depends on the height alone and falls so gently that every ray gets out.
pub(super) trait RefractiveAir {
    /// At a height above sea level, kilometres; from the ground to the top of the air.
    fn bending_at(&self, height_km: f64) -> Bending;

    fn scaled_radius_km(&self, height_km: f64) -> f64 {
        self.bending_at(height_km).scaled_radius_km(height_km)
    }

    /// The height of a scaled radius and the bending there, by Newton's method from a guess.
    fn at_scaled_radius(&self, scaled_radius_km: f64, guess_km: f64) -> (f64, Bending) {
        let mut height_km = guess_km;
        let mut bending = self.bending_at(height_km);
        // The slope is near 1 and hardly changes: the error falls by a factor of 50 at least.
        for _ in 0..8 {
            let excess_km = bending.scaled_radius_km(height_km) - scaled_radius_km;
            // A millimetre: a ten-millionth of the density.
            if excess_km.abs() < 1e-6 {
                break;
            }
            height_km -= excess_km / bending.scaled_radius_slope(height_km);
            bending = self.bending_at(height_km);
        }
        (height_km, bending)
    }

    /// The apparent altitude of the horizon of smooth ground all around: zero at its level and below,
    /// lower from a height above it.
    fn horizon_altitude(&self, height_km: f64, ground_km: f64) -> Angle {
        let ground = self.scaled_radius_km(ground_km);
        let here = self.scaled_radius_km(height_km.max(ground_km));
        // By the tangent: the cosine of a small angle loses half its digits.
        let sine_squared = ((here - ground) * (here + ground)).max(0.0);
        Angle::from_rad(-sine_squared.sqrt().atan2(ground))
    }
}

/// A piece of a ray.
pub(super) struct Step {
    pub height_km: f64,
    /// Length of path that it stands for.
    pub length_km: f64,
    /// Cosine of the altitude at which the ray runs there.
    pub cos_altitude: f64,
    pub bending: Bending,
}

/// A ray from the top of the air to the observer, traced from its lowest point.
pub(super) struct Ray<'a, A> {
    air: &'a A,
    /// `n r cos(altitude)`, the same all along the ray, kilometres.
    invariant_km: f64,
    /// Height of the observer, and of the lowest point on the way; `u` at both.
    observer_km: f64,
    lowest_km: f64,
    observer_u_km: f64,
    lowest_u_km: f64,
}

impl<'a, A: RefractiveAir> Ray<'a, A> {
    /// The ray that an observer sees at an apparent altitude, not below the horizon.
    pub fn new(air: &'a A, observer_km: f64, altitude: Angle) -> Self {
        let scaled_radius_km = air.scaled_radius_km(observer_km);
        let invariant_km = scaled_radius_km * altitude.cos();
        let observer_u_km = scaled_radius_km * altitude.sin().abs();
        let (lowest_km, lowest_u_km) = if altitude >= Angle::ZERO {
            (observer_km, observer_u_km)
        } else {
            (air.at_scaled_radius(invariant_km, observer_km).0, 0.0)
        };
        Ray { air, invariant_km, observer_km, lowest_km, observer_u_km, lowest_u_km }
    }

    /// Visits the ray in steps, by a rule of Gauss and Legendre between ascending heights; the last of
    /// them is where the air ends.
    pub fn for_each_step(
        &self,
        levels_km: &[f64],
        rule: &[(f64, f64)],
        mut visit: impl FnMut(&Step),
    ) {
        let mut from_u_km = self.lowest_u_km;
        // The last point that was found, from which the next one is guessed.
        let mut known_km = self.lowest_km;
        let mut known = self.air.bending_at(known_km);
        let mut step_to = |end_u_km: f64, passes: f64| {
            let (middle, half) = (0.5 * (from_u_km + end_u_km), 0.5 * (end_u_km - from_u_km));
            for &(node, weight) in rule {
                let scaled_radius_km = self.invariant_km.hypot(middle + half * node);
                let rise_km = (scaled_radius_km - known.scaled_radius_km(known_km))
                    / known.scaled_radius_slope(known_km);
                let (height_km, bending) =
                    self.air.at_scaled_radius(scaled_radius_km, known_km + rise_km);
                (known_km, known) = (height_km, bending);
                visit(&Step {
                    height_km,
                    length_km: passes * half * weight / bending.scaled_radius_slope(height_km),
                    cos_altitude: self.invariant_km / scaled_radius_km,
                    bending,
                });
            }
            from_u_km = end_u_km;
        };
        // What lies below the observer is passed twice.
        for &level_km in levels_km {
            if level_km > self.lowest_km && level_km < self.observer_km {
                step_to(self.u_km(level_km), 2.0);
            }
        }
        if self.lowest_u_km < self.observer_u_km {
            step_to(self.observer_u_km, 2.0);
        }
        for &level_km in levels_km {
            if level_km > self.observer_km {
                step_to(self.u_km(level_km), 1.0);
            }
        }
    }

    /// How far the ray turns on its way, `-1/n dn/dr cos(altitude) ds` summed up: the refraction.
    pub fn bending(&self) -> Angle {
        let mut rad = 0.0;
        self.for_each_step(&LEVELS_KM, &GAUSS_6, |step| {
            let Bending { refractivity, slope_per_km } = step.bending;
            rad -= slope_per_km / (1.0 + refractivity) * step.cos_altitude * step.length_km;
        });
        Angle::from_rad(rad)
    }

    fn u_km(&self, height_km: f64) -> f64 {
        let scaled_radius_km = self.air.scaled_radius_km(height_km);
        let square =
            (scaled_radius_km - self.invariant_km) * (scaled_radius_km + self.invariant_km);
        square.max(0.0).sqrt()
    }
}

/// Heights between which the index is smooth, and near enough for six nodes each, kilometres.
const LEVELS_KM: [f64; 27] = [
    0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 11.02, 13.0, 16.0, 20.06, 25.0, 28.0,
    32.16, 36.0, 40.0, 47.35, 51.41, 60.0, 71.8, 86.0, 100.0, AIR_TOP_KM,
];

/// Nodes and weights of Gauss and Legendre's rule of order 3 on [-1, 1].
pub(super) const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// The same of order 6.
const GAUSS_6: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170_4),
    (-0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (-0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_4),
];
