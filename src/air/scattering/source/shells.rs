//! Columns, bending and spreading of one bent ray, in closed form, shell by shell.
//!
//! *Theory.* In spherical air `p = n r sin(zenith distance)` keeps its value along a ray (Bouguer).
//! With the scaled radius `x = n r` in the place of `r` and `u = sqrt(x^2 - p^2)`, signed as the
//! altitude, the length of path is `ds = du / (dx/dr)`: a bent ray in `x` is a straight ray with
//! densities `rho / (dx/dr)`. If these are linear in `x` between two levels, `c + b x`, then
//!
//! ```text
//! Int (c + b x) du = c u + b/2 (u x + p^2 ln(u + x))
//! ```
//!
//! as for straight rays (`columns`), with nothing singular where the ray is level. The ray turns by
//! `p Int q du`, `q = -(dn/dr) / (n x dx/dr)`, which is the same integral again. So is its slope: `x`
//! moves with `p` by `p/x` at fixed `u`, and `Int q'(x) / x du` is `b ln(u + x)`.
//!
//! *Spreading.* A parallel beam with impact parameters `p` to `p + dp` carries the power `p dp` (each
//! per `2 pi` and per unit irradiance). At the radius `r` it crosses, at the true zenith distance `t` and
//! the apparent one `a`, an area of `r^2 sin t dt cos a`. With `p = n r sin a` its irradiance has
//! changed by `n^2 (sin a / sin t) (da/dt)`. But for `n^2`, 1.0006 at most, this is the dilution of
//! refracted light known from occultations and lunar eclipses.
//!
//! *Index of refraction.* Proportional to the density of molecules, but smooth. Spreading asks for its
//! second derivative: each node of the profile would focus light, and so would the sharp tropopause of
//! the standard atmosphere, which in real air lies at many heights along one ray. The index is that
//! of the profile, blurred in its logarithm by a bell of 1.2 km (standard deviation).
//!
//! *Omitted.* Dispersion (2 % of the bending from 450 to 650 nm), water vapour.
//!
//! *Accuracy.* Columns of straight rays are exact. For bent rays `rho / (dx/dr)` and `q` are taken for
//! linear in a shell, 0.25 km thick below 12 km. Refraction at the horizon agrees with
//! `air::refraction` within 0.2" at sea level and 0.7" at 2 km; the spreading with differences of rays
//! within 0.5 %; the first order of light at the zenith, not spread, with sasktran2 within 0.16 %.

use super::super::profile::{EARTH_RADIUS_KM, Profile, SPECIES, TOP_KM};

/// The slope of the scaled radius is not let fall below this: air that would bend light around the
/// Earth is refused elsewhere, and only needs an answer here.
const LEAST_SLOPE: f64 = 0.05;
/// Levels are not closer than this, km.
const SAME_KM: f64 = 1e-6;

/// What is integrated along a ray: the species, then the bending.
const INTEGRANDS: usize = SPECIES + 1;
const BENDING: usize = SPECIES;

/// The air at one height, as rays need it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Level {
    pub height_km: f64,
    /// Index of refraction times distance from the Earth's centre.
    pub x_km: f64,
    /// Per km of `u`: relative densities, and the bending over `p`.
    integrands: [f64; INTEGRANDS],
}

impl Level {
    fn index(&self) -> f64 {
        self.x_km / (EARTH_RADIUS_KM + self.height_km)
    }
}

/// The light of a distant source that comes to a place along one ray.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beam {
    /// Zenith distance in which the source would stand without air, radians.
    pub true_zenith: f64,
    /// Zenith distance from which the light comes, radians.
    pub apparent_zenith: f64,
    /// km of relative density.
    pub columns: [f64; SPECIES],
    /// Irradiance on a plane that faces the light, per irradiance outside, in air that takes nothing.
    pub divergence: f64,
}

/// Integrals over a part of a ray.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    integrals: [f64; INTEGRANDS],
    /// `Int q'(x) / x du`.
    bending_slope: f64,
}

impl Sums {
    fn plus(&self, other: &Sums, times: f64) -> Sums {
        Sums {
            integrals: std::array::from_fn(|k| self.integrals[k] + times * other.integrals[k]),
            bending_slope: self.bending_slope + times * other.bending_slope,
        }
    }
}

/// A point of a ray: what the antiderivatives are made of.
#[derive(Debug, Clone, Copy)]
struct Place {
    u_km: f64,
    logarithm: f64,
    /// Of `x`.
    area: f64,
}

impl Place {
    fn new(p_km: f64, x_km: f64) -> Place {
        let u_km = ((x_km - p_km) * (x_km + p_km)).max(0.0).sqrt();
        let logarithm = (u_km + x_km).ln();
        Place { u_km, logarithm, area: 0.5 * (u_km * x_km + p_km * p_km * logarithm) }
    }
}

/// Air in spherical shells.
#[derive(Debug, Clone)]
pub(super) struct Shells {
    levels: Vec<Level>,
    /// Slopes of the integrands in `x`, shell by shell.
    slopes: Vec<[f64; INTEGRANDS]>,
    is_straight: bool,
}

impl Shells {
    /// From the ground up. Each shell is cut in `fineness` times as many as need be.
    pub fn new(
        profile: &Profile,
        ground_km: f64,
        sea_level_refractivity: f64,
        fineness: usize,
    ) -> Shells {
        let is_straight = sea_level_refractivity == 0.0;
        let refractivity = Refractivity::new(profile, sea_level_refractivity);
        let mut levels: Vec<Level> = Vec::new();
        for height_km in heights_km(profile, ground_km, fineness) {
            let r_km = EARTH_RADIUS_KM + height_km;
            let (excess, per_km) =
                if is_straight { (0.0, 0.0) } else { refractivity.at(height_km) };
            let slope = (1.0 + excess + r_km * per_km).max(LEAST_SLOPE);
            let mut x_km = (1.0 + excess) * r_km;
            if let Some(below) = levels.last() {
                x_km = x_km.max(below.x_km + LEAST_SLOPE * (height_km - below.height_km));
            }
            let mut integrands = [0.0; INTEGRANDS];
            for (to, density) in integrands.iter_mut().zip(profile.density(height_km)) {
                *to = density / slope;
            }
            integrands[BENDING] = -per_km / ((1.0 + excess) * x_km * slope);
            levels.push(Level { height_km, x_km, integrands });
        }
        let slopes = levels
            .windows(2)
            .map(|ends| {
                let thickness_km = ends[1].x_km - ends[0].x_km;
                let rise = |k: usize| ends[1].integrands[k] - ends[0].integrands[k];
                std::array::from_fn(|k| rise(k) / thickness_km)
            })
            .collect();
        Shells { levels, slopes, is_straight }
    }

    pub fn levels(&self) -> &[Level] {
        &self.levels
    }
    pub fn is_straight(&self) -> bool {
        self.is_straight
    }
    pub fn ground(&self) -> &Level {
        &self.levels[0]
    }
    fn top(&self) -> &Level {
        &self.levels[self.levels.len() - 1]
    }

    /// The shell that holds a height: its lower level.
    pub fn shell(&self, height_km: f64) -> usize {
        let above = self.levels.partition_point(|l| l.height_km <= height_km);
        above.clamp(1, self.levels.len() - 1) - 1
    }

    /// The air at any height; clamped to the ends.
    pub fn level_at(&self, height_km: f64) -> Level {
        let height_km = height_km.clamp(self.ground().height_km, self.top().height_km);
        let at = self.shell(height_km);
        let (low, high) = (&self.levels[at], &self.levels[at + 1]);
        let x_km = low.x_km
            + (high.x_km - low.x_km) * (height_km - low.height_km)
                / (high.height_km - low.height_km);
        let rise_km = x_km - low.x_km;
        Level {
            height_km,
            x_km,
            integrands: std::array::from_fn(|k| low.integrands[k] + self.slopes[at][k] * rise_km),
        }
    }

    /// The part of a ray in one shell.
    fn in_shell(&self, shell: usize, from: &Place, to: &Place) -> Sums {
        let (low, slopes) = (&self.levels[shell], &self.slopes[shell]);
        let (du, area) = (to.u_km - from.u_km, to.area - from.area);
        Sums {
            integrals: std::array::from_fn(|k| {
                (low.integrands[k] - slopes[k] * low.x_km) * du + slopes[k] * area
            }),
            bending_slope: slopes[BENDING] * (to.logarithm - from.logarithm),
        }
    }

    /// The light of a ray at a place, given the integrals from there to space. `u` carries the sign
    /// of the apparent altitude.
    fn beam(&self, p_km: f64, level: &Level, u_km: f64, to_space: &Sums) -> Beam {
        let apparent_zenith = p_km.atan2(u_km);
        let mut columns = [0.0; SPECIES];
        columns.copy_from_slice(&to_space.integrals[..SPECIES]);
        if self.is_straight {
            return Beam {
                true_zenith: apparent_zenith,
                apparent_zenith,
                columns,
                divergence: 1.0,
            };
        }
        let turn = to_space.integrals[BENDING];
        let true_zenith = apparent_zenith + p_km * turn;
        // d(true)/d(apparent): the ends of the integral move with p too.
        let p2 = p_km * p_km;
        let widening =
            1.0 + u_km * (turn + p2 * to_space.bending_slope) + p2 * level.integrands[BENDING];
        let sines = if true_zenith > 1e-6 {
            p_km / (level.x_km * true_zenith.sin())
        } else {
            1.0 / (1.0 + level.x_km * turn)
        };
        let index = level.index();
        // Below LEAST_SLOPE the beam is as good as folded: a mirage, refused elsewhere.
        let divergence = index * index * sines / widening.max(LEAST_SLOPE);
        Beam { true_zenith, apparent_zenith, columns, divergence }
    }

    /// The light that comes to a height from an apparent zenith distance, radians; the ground does not
    /// hide it.
    pub fn beam_at(&self, height_km: f64, apparent_zenith: f64) -> Beam {
        let level = self.level_at(height_km);
        let p_km = level.x_km * apparent_zenith.sin();
        let here = Place::new(p_km, level.x_km);
        let descends = apparent_zenith > std::f64::consts::FRAC_PI_2;
        let mut sums = self.outwards(p_km, level.x_km);
        if descends {
            let lowest_km = p_km.max(self.ground().x_km);
            let up = self.outwards(p_km, lowest_km);
            // Down to the lowest point as from there up to here.
            sums = up.plus(&up, 1.0).plus(&sums, -1.0);
        }
        self.beam(p_km, &level, if descends { -here.u_km } else { here.u_km }, &sums)
    }

    /// Integrals from a scaled radius, not below `p`, out to space.
    fn outwards(&self, p_km: f64, from_x_km: f64) -> Sums {
        let above = self.levels.partition_point(|l| l.x_km <= from_x_km).max(1);
        let mut sums = Sums::default();
        let mut from = Place::new(p_km, from_x_km);
        for (i, level) in self.levels.iter().enumerate().skip(above) {
            let to = Place::new(p_km, level.x_km);
            sums = sums.plus(&self.in_shell(i - 1, &from, &to), 1.0);
            from = to;
        }
        sums
    }

    /// A whole ray: at each level that it crosses, from the lowest, the light on its way down to it
    /// and, if the ray misses the ground, the light that has passed its lowest point.
    pub fn trace(&self, p_km: f64) -> Trace {
        let meets_ground = p_km < self.ground().x_km;
        let lowest_x_km = if meets_ground { self.ground().x_km } else { p_km };
        // The first level that is not below the lowest point.
        let first = self.levels.partition_point(|l| l.x_km < lowest_x_km);
        let mut below = Vec::with_capacity(self.levels.len() - first);
        let mut sums = Sums::default();
        let mut from = Place::new(p_km, lowest_x_km);
        for (i, level) in self.levels.iter().enumerate().skip(first) {
            let to = Place::new(p_km, level.x_km);
            if i > 0 {
                sums = sums.plus(&self.in_shell(i - 1, &from, &to), 1.0);
            }
            below.push((to.u_km, sums));
            from = to;
        }
        let along = |descends: bool| {
            let beams = self.levels[first..].iter().zip(&below);
            beams
                .map(|(level, (u_km, below))| {
                    let (u_km, times) = if descends { (-u_km, 1.0) } else { (*u_km, -1.0) };
                    self.beam(p_km, level, u_km, &sums.plus(below, times))
                })
                .collect()
        };
        let after_lowest = if meets_ground { Vec::new() } else { along(true) };
        Trace { first, before_lowest: along(false), after_lowest }
    }
}

/// One ray, level by level.
#[derive(Debug, Clone)]
pub(super) struct Trace {
    /// The lowest level that it reaches.
    pub first: usize,
    /// The light at that level and those above, coming down from space.
    pub before_lowest: Vec<Beam>,
    /// The same on its way out again; empty if it meets the ground.
    pub after_lowest: Vec<Beam>,
}

/// Where shells begin: at the ground and the nodes of the profile, and between.
fn heights_km(profile: &Profile, ground_km: f64, fineness: usize) -> Vec<f64> {
    let ground_km = ground_km.clamp(0.0, 0.5 * TOP_KM);
    let mut borders = vec![ground_km];
    borders.extend(profile.heights_km().iter().filter(|&&h| h > ground_km + SAME_KM));
    let mut heights = borders.clone();
    // The horizon sinks as the square root of the height.
    const LOWEST: usize = 10;
    let lowest = LOWEST * fineness;
    heights.extend((1..=lowest).map(|i| ground_km + (i as f64 / lowest as f64).powi(2)));
    for ends in borders.windows(2) {
        let longest_km = match ends[1] - ground_km {
            ..=12.0 => 0.25,
            ..=40.0 => 0.5,
            ..=60.0 => 1.0,
            _ => 2.5,
        };
        let parts = ((ends[1] - ends[0]) / longest_km - SAME_KM).ceil() as usize * fineness;
        let cut = |k: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / parts as f64;
        heights.extend((1..parts).map(cut).filter(|h| *h > ground_km + 1.0 + SAME_KM));
    }
    heights.sort_by(f64::total_cmp);
    heights.retain(|h| *h <= TOP_KM);
    // Borders of the profile keep their exact place.
    let near_border = |h: f64| borders.iter().any(|b| *b != h && (b - h).abs() < 1e-3);
    heights.retain(|&h| !near_border(h) || borders.contains(&h));
    heights.dedup();
    heights
}

/// Index of refraction less one, and its slope: a uniform cubic B-spline whose control points are
/// logarithms of the density.
struct Refractivity {
    /// The first lies one step below sea level.
    controls: Vec<f64>,
}

/// Step of the control points, km.
const SPLINE_STEP_KM: f64 = 2.0;

impl Refractivity {
    fn new(profile: &Profile, at_sea_level: f64) -> Refractivity {
        let last = (TOP_KM / SPLINE_STEP_KM).ceil() as usize;
        // Densities are interpolated in their logarithms too.
        let logarithm = |i: usize| {
            let height_km = SPLINE_STEP_KM * i as f64;
            let at = profile.layer(height_km);
            let ends = [at, at + 1].map(|k| {
                let density = profile.densities()[k][0] * at_sea_level;
                (profile.heights_km()[k], density.max(f64::MIN_POSITIVE).ln())
            });
            let ((low_km, low), (high_km, high)) = (ends[0], ends[1]);
            low + (high - low) * (height_km - low_km) / (high_km - low_km)
        };
        let mut controls: Vec<f64> = (0..=last).map(logarithm).collect();
        // Ends: the curvature next to them goes on.
        let beyond = |a: f64, b: f64, c: f64| 3.0 * (a - b) + c;
        let n = controls.len();
        let above = beyond(controls[n - 1], controls[n - 2], controls[n - 3]);
        let below = beyond(controls[0], controls[1], controls[2]);
        controls.push(above);
        controls.insert(0, below);
        // A curve is blurred off its nodes; at sea level it is put back.
        let off = (below - 2.0 * controls[1] + controls[2]) / 6.0;
        controls.iter_mut().for_each(|c| *c -= off);
        Refractivity { controls }
    }

    /// Refractivity and its slope per km.
    fn at(&self, height_km: f64) -> (f64, f64) {
        let place = height_km / SPLINE_STEP_KM;
        let i = (place.max(0.0) as usize).min(self.controls.len() - 4);
        let t = place - i as f64;
        let s = 1.0 - t;
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| self.controls[i + k]);
        let middle = |t: f64| 4.0 + t * t * (3.0 * t - 6.0);
        let logarithm = (s * s * s * a + middle(t) * b + middle(s) * c + t * t * t * d) / 6.0;
        let slope = |t: f64| t * (3.0 * t - 4.0);
        let slope = (-s * s * a + slope(t) * b - slope(s) * c + t * t * d) / (2.0 * SPLINE_STEP_KM);
        let value = logarithm.exp();
        (value, value * slope)
    }
}
