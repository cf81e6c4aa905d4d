//! The line that a ray follows, straight or bent, and what lies along it.
//!
//! *Theory.* In spherical shells of refractive index `n`, `p = n r sin(zenith distance)` keeps its value
//! along a ray (Bouguer). Points are told by `u = n r cos(zenith distance)`, signed, which grows steadily
//! along the ray and is the distance from the closest point where the ray is straight; a piece of length
//! is `ds = du / (d(n r) / dr)`, and the vertical turns by `p ds / (n r^2)`.
//!
//! *How.* `n - 1` is proportional to the density of molecules, which is linear in height between the
//! nodes of the profile. Straight lines have exact columns; bent ones Gauss and Legendre's rule of order
//! 4 in each layer they cross.

use super::columns;
use super::profile::{Profile, SPECIES};
use crate::air::EARTH_RADIUS_KM;

/// A ray from a start, by its invariant.
pub(crate) struct Path<'a> {
    profile: &'a Profile,
    refractivity: f64,
    invariant_km: f64,
    start: Point,
    lowest_km: f64,
}

/// A point of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    /// `n r` times the cosine of the zenith distance of the ray, running outwards.
    pub u_km: f64,
    pub height_km: f64,
}

impl<'a> Path<'a> {
    /// From a height, in a direction; the refractivity is that of the air at sea level, 0 for a straight
    /// line.
    pub fn new(
        profile: &'a Profile,
        refractivity: f64,
        height_km: f64,
        cos_zenith: f64,
    ) -> Path<'a> {
        let scaled_km =
            (1.0 + refractivity * profile.density(height_km)[0]) * (EARTH_RADIUS_KM + height_km);
        let mut path = Path {
            profile,
            refractivity,
            invariant_km: scaled_km * (1.0 - cos_zenith * cos_zenith).max(0.0).sqrt(),
            start: Point { u_km: scaled_km * cos_zenith, height_km },
            lowest_km: height_km,
        };
        if cos_zenith < 0.0 {
            path.lowest_km = path.height_of(path.invariant_km, height_km);
        }
        path
    }

    pub fn start(&self) -> Point {
        self.start
    }

    /// Height of the closest point to the Earth; that of the start if the ray rises from there. Below
    /// sea level it only says that the ground is met.
    pub fn lowest_km(&self) -> f64 {
        self.lowest_km
    }

    /// `u` on the outgoing side, at a height.
    pub fn u_at(&self, height_km: f64) -> f64 {
        let scaled_km = self.scaled_radius_km(height_km);
        ((scaled_km - self.invariant_km) * (scaled_km + self.invariant_km)).max(0.0).sqrt()
    }

    pub fn point(&self, u_km: f64) -> Point {
        let scaled_km = self.invariant_km.hypot(u_km);
        Point { u_km, height_km: self.height_of(scaled_km, scaled_km - EARTH_RADIUS_KM) }
    }

    /// Cosine of the zenith distance of the ray there.
    pub fn cosine_at(&self, point: &Point) -> f64 {
        (point.u_km / self.invariant_km.hypot(point.u_km).max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0)
    }

    /// Columns of all species between two points on one side of the closest one, and by how much the
    /// vertical turns, radians.
    pub fn between(&self, from: &Point, to: &Point) -> ([f64; SPECIES], f64) {
        let (low, high) = if from.u_km.abs() < to.u_km.abs() { (from, to) } else { (to, from) };
        if self.refractivity == 0.0 {
            let near_km = EARTH_RADIUS_KM + low.height_km;
            let far_km = EARTH_RADIUS_KM + high.height_km;
            let p = self.invariant_km;
            // The angle between two directions from the centre, by its tangent.
            let turn = (p * (to.u_km - from.u_km)).atan2(p * p + to.u_km * from.u_km);
            return (columns::between(self.profile, p * p, near_km, far_km), turn);
        }
        let mut columns = [0.0; SPECIES];
        let mut turn_rad = 0.0;
        let (mut u_km, end_km) = (low.u_km.abs(), high.u_km.abs());
        let heights = self.profile.heights_km();
        let mut layer = self.profile.layer(low.height_km);
        loop {
            let is_last = layer + 2 >= heights.len() || heights[layer + 1] >= high.height_km;
            let next_km = if is_last { end_km } else { self.u_at(heights[layer + 1]).min(end_km) };
            let (middle, half) = (0.5 * (u_km + next_km), 0.5 * (next_km - u_km));
            for (node, weight) in GAUSS_4 {
                let scaled_km = self.invariant_km.hypot(middle + half * node);
                let height_km = self.height_of(scaled_km, scaled_km - EARTH_RADIUS_KM);
                let length_km = half * weight / self.scaled_slope(height_km);
                for (sum, density) in columns.iter_mut().zip(self.profile.density(height_km)) {
                    *sum += density * length_km;
                }
                turn_rad +=
                    self.invariant_km / scaled_km * length_km / (EARTH_RADIUS_KM + height_km);
            }
            if is_last {
                return (columns, turn_rad);
            }
            u_km = next_km;
            layer += 1;
        }
    }

    fn scaled_radius_km(&self, height_km: f64) -> f64 {
        let index = 1.0 + self.refractivity * self.profile.density(height_km)[0];
        index * (EARTH_RADIUS_KM + height_km)
    }

    /// `d(n r) / dr`.
    fn scaled_slope(&self, height_km: f64) -> f64 {
        let layer = self.profile.layer(height_km);
        let (heights, densities) = (self.profile.heights_km(), self.profile.densities());
        let slope =
            (densities[layer + 1][0] - densities[layer][0]) / (heights[layer + 1] - heights[layer]);
        let density = self.profile.density(height_km)[0];
        1.0 + self.refractivity * (density + (EARTH_RADIUS_KM + height_km) * slope)
    }

    /// The height where `n r` has a value, by Newton's method.
    fn height_of(&self, scaled_km: f64, guess_km: f64) -> f64 {
        if self.refractivity == 0.0 {
            return scaled_km - EARTH_RADIUS_KM;
        }
        let mut height_km = guess_km;
        for _ in 0..6 {
            let excess_km = self.scaled_radius_km(height_km) - scaled_km;
            if excess_km.abs() < 1e-9 {
                break;
            }
            // Air that bends more than the Earth is curved is refused before it comes here.
            height_km -= excess_km / self.scaled_slope(height_km).max(0.05);
        }
        height_km
    }
}

/// Nodes and weights of Gauss and Legendre's rule of order 4 on [-1, 1].
const GAUSS_4: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::Atmosphere;
    use crate::air::scattering::profile::TOP_KM;

    #[test]
    fn bent_paths_without_bending_are_straight() {
        let profile = Profile::new(&Atmosphere::default(), 0.0);
        for (height_km, cosine) in [(0.0, 1.0), (0.0, 0.02), (12.3, 0.0), (40.0, 0.3)] {
            let straight = Path::new(&profile, 0.0, height_km, cosine);
            let bent = Path::new(&profile, 1e-15, height_km, cosine);
            let ends = |path: &Path| (path.start(), path.point(path.u_at(TOP_KM)));
            let ((from, to), (a, b)) = (ends(&straight), ends(&bent));
            let ((exact, turn), (sum, sum_turn)) =
                (straight.between(&from, &to), bent.between(&a, &b));
            for (sum, exact) in sum.iter().zip(exact) {
                assert!(
                    (sum - exact).abs() <= 1e-6 * exact,
                    "{height_km} km, {cosine}: {sum} {exact}"
                );
            }
            assert!((turn - sum_turn).abs() < 1e-7, "{turn} {sum_turn}");
        }
    }

    #[test]
    fn the_ray_of_the_horizon_is_bent_as_the_tables_say() {
        // 35' at the level of the sea in standard air at 15 degrees; this refractivity and density.
        let profile = Profile::new(&Atmosphere::default(), 0.0);
        let path = Path::new(&profile, 2.777e-4, 0.0, 0.0);
        let end = path.point(path.u_at(TOP_KM));
        let (_, turn) = path.between(&path.start(), &end);
        let true_altitude = path.cosine_at(&end).asin() - turn;
        let arcmin = -true_altitude.to_degrees() * 60.0;
        assert!((arcmin - 33.0).abs() < 1.5, "{arcmin}");
    }
}
