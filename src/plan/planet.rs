//! A planet as its disc shows it: a flattened globe, and the rings of Saturn with all shadows.
//!
//! *Theory.* In axes of the disc (level, up, away from the observer), lengths in radii of the equator,
//! sight runs along the third axis. Stretched along its pole, the globe is a ball of radius one, and a
//! sight meets it where a quadratic has its nearer root; its normal is the place stretched twice. The
//! sight meets the plane of the rings in a point; what is nearer hides the other, the rings as much as
//! they are [dense](crate::light::saturn_rings::transmittance). A place of the globe gets the
//! sunlight that passes the rings on its way; a place in the rings none behind the globe.
//!
//! *Share of the rings.* Globe and rings are in one unit, I/F: that of the globe has
//! [`GLOBE_ALBEDO`] as a mean at full phase, that of the rings is of
//! [`crate::light::saturn_rings`]. The disc is then scaled so that all of it has the planet's light.
//!
//! *Belts* of Jupiter: [`crate::light::belts`]; the normal gives the planetographic latitude.
//!
//! *Omitted.* Perspective within the disc (1e-4 of a radius from the Earth), the penumbra (0.002 radii
//! on the rings), light of the rings on the globe and back, colours of their own for the
//! rings. Air parts the colours of limbs and edges of rings, not of shadows within.

use glam::{DMat3, DVec2, DVec3};

use crate::frame::{Dir, Horizon};
use crate::light::belts::{self, Belt};
use crate::light::disc_light::disc_axes;
use crate::light::limb_law::LimbLaw;
use crate::light::saturn_rings::{
    self, GLOBE_ALBEDO, RINGS, RingView, SATURN_EQUATORIAL_RADIUS_KM,
};
use crate::sky::BodyState;

/// A ring as it is lit and seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenRing {
    /// Edges, radii of the equator.
    pub inner: f64,
    pub outer: f64,
    /// I/F where the globe does not shade it.
    pub brightness: f64,
    /// Share of the light that passes it towards the observer, and from the Sun.
    pub to_observer: f64,
    pub from_sun: f64,
}

impl SeenRing {
    /// The rings of Saturn, from within.
    fn all(view: &RingView) -> Vec<SeenRing> {
        let seen = RINGS.iter().map(|ring| {
            let middle_km = 0.5 * (ring.inner_km + ring.outer_km);
            let [inner, outer] =
                [ring.inner_km, ring.outer_km].map(|edge| edge / SATURN_EQUATORIAL_RADIUS_KM);
            SeenRing {
                inner,
                outer,
                brightness: saturn_rings::ring_brightness(middle_km, view),
                to_observer: saturn_rings::transmittance(middle_km, view.observer_latitude),
                from_sun: saturn_rings::transmittance(middle_km, view.sun_latitude),
            }
        });
        seen.collect()
    }
}

/// What the light of a planet depends on, in axes of its disc.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanetDisc {
    pub law: LimbLaw,
    /// I/F where light falls and leaves straight; one where there are no rings to compare with.
    pub albedo: f64,
    /// North pole: level, up, away from the observer.
    pub pole: DVec3,
    /// Radius at the poles over that at the equator.
    pub polar_ratio: f64,
    /// Towards the Sun, in the same axes.
    pub to_sun: DVec3,
    /// Of Jupiter alone.
    pub belts: &'static [Belt],
    /// From within; none but for Saturn.
    pub rings: Vec<SeenRing>,
}

impl PlanetDisc {
    pub fn of(state: &BodyState) -> PlanetDisc {
        let disc_from_horizon = DMat3::from_cols_array_2d(&disc_axes(state.dir).map(Into::into));
        let disc_from_horizon = disc_from_horizon.transpose();
        let in_disc = |dir: Dir<Horizon>| disc_from_horizon * dir.vector();
        let law = LimbLaw::of(state.body);
        let rings = state.rings.map_or_else(Vec::new, |tilt| {
            let view = RingView {
                sun_latitude: tilt.sun_latitude,
                observer_latitude: tilt.observer_latitude,
                phase: state.phase_angle,
            };
            SeenRing::all(&view)
        });
        PlanetDisc {
            law,
            albedo: if rings.is_empty() { 1.0 } else { GLOBE_ALBEDO / law.full_mean() },
            pole: state.pole.map_or(DVec3::Y, in_disc),
            polar_ratio: state.body.polar_ratio(),
            to_sun: in_disc(state.dir_to_sun),
            belts: belts::of(state.body),
            rings,
        }
    }

    /// How far it reaches from its middle, radii.
    pub fn reach(&self) -> f64 {
        self.rings.last().map_or(1.0, |ring| ring.outer)
    }

    /// Makes the globe a ball.
    fn stretched(&self, v: DVec3) -> DVec3 {
        v + self.pole * (v.dot(self.pole) * (1.0 / self.polar_ratio - 1.0))
    }

    /// How far away from the plane of the disc the globe begins on a sight.
    fn globe_at(&self, at: DVec2) -> Option<f64> {
        let (start, along) = (self.stretched(at.extend(0.0)), self.stretched(DVec3::Z));
        let (a, b) = (along.length_squared(), start.dot(along));
        let square = b * b - a * (start.length_squared() - 1.0);
        (square > 0.0).then(|| -(b + square.sqrt()) / a)
    }

    /// The ring that holds a place of their plane.
    fn ring_at(&self, place: DVec3) -> Option<&SeenRing> {
        let radius = place.length();
        self.rings.iter().find(|ring| (ring.inner..ring.outer).contains(&radius))
    }

    /// Where a line from a place meets the plane of the rings, in lengths of its direction.
    fn to_plane(&self, place: DVec3, dir: DVec3) -> f64 {
        -place.dot(self.pole) / dir.dot(self.pole)
    }

    fn globe_light(&self, place: DVec3) -> f64 {
        let normal = self.stretched(self.stretched(place)).normalize();
        let sin_latitude = normal.dot(self.pole);
        let light = self.law.reflectance(normal.dot(self.to_sun), -normal.z)
            * self.belts.iter().map(|belt| belt.leaves(sin_latitude)).product::<f64>();
        let way = self.to_plane(place, self.to_sun);
        let ring = if way > 0.0 { self.ring_at(place + self.to_sun * way) } else { None };
        self.albedo * light * ring.map_or(1.0, |ring| ring.from_sun)
    }

    fn is_shaded(&self, place: DVec3) -> bool {
        let (place, to_sun) = (self.stretched(place), self.stretched(self.to_sun).normalize());
        let along = place.dot(to_sun);
        along < 0.0 && place.length_squared() - along * along < 1.0
    }

    /// The shape of the light at a point of the disc, level and up, in radii: the twin of `planet_at`
    /// in `shaders/planet.wgsl`.
    pub fn shape(&self, at: DVec2) -> f64 {
        let globe = self.globe_at(at);
        let globe_light = || globe.map_or(0.0, |away| self.globe_light(at.extend(away)));
        let way = self.to_plane(at.extend(0.0), DVec3::Z);
        let in_plane = at.extend(way);
        match self.ring_at(in_plane).filter(|_| globe.is_none_or(|away| way < away)) {
            Some(ring) => {
                let own = if self.is_shaded(in_plane) { 0.0 } else { ring.brightness };
                own + globe_light() * ring.to_observer
            }
            None => globe_light(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Angle;

    /// Saturn with both Sun and observer so high over the rings, the pole upright.
    fn saturn(sun_deg: f64, observer_deg: f64) -> PlanetDisc {
        let view = RingView {
            sun_latitude: Angle::from_deg(sun_deg),
            observer_latitude: Angle::from_deg(observer_deg),
            phase: Angle::from_deg((sun_deg - observer_deg).abs()),
        };
        let toward = |latitude_deg: f64| {
            let (sin, cos) = Angle::from_deg(latitude_deg - observer_deg).sin_cos();
            DVec3::new(0.0, sin, -cos)
        };
        let (sin, cos) = view.observer_latitude.sin_cos();
        let radius_km = saturn_rings::SATURN_EQUATORIAL_RADIUS_KM;
        let law = LimbLaw::Minnaert { exponent: 0.9 };
        PlanetDisc {
            law,
            albedo: GLOBE_ALBEDO / law.full_mean(),
            pole: DVec3::new(0.0, cos, -sin),
            polar_ratio: saturn_rings::SATURN_POLAR_RADIUS_KM / radius_km,
            to_sun: toward(sun_deg),
            belts: &[],
            rings: SeenRing::all(&view),
        }
    }

    /// Sum of the shape over everything, square radii.
    fn sum(planet: &PlanetDisc, cells: i32) -> f64 {
        let at = |k: i32| ((f64::from(k) + 0.5) / f64::from(cells) * 2.0 - 1.0) * 2.3;
        let cell = (2.0 * 2.3 / f64::from(cells)).powi(2);
        let all = (0..cells).flat_map(|i| (0..cells).map(move |j| DVec2::new(at(i), at(j))));
        all.map(|point| planet.shape(point) * cell).sum()
    }

    #[test]
    fn globe_is_flattened_and_has_its_albedo() {
        let bare = PlanetDisc { rings: Vec::new(), ..saturn(0.0, 0.0) };
        assert!(
            bare.shape(DVec2::new(0.999, 0.0)) > 0.0 && bare.shape(DVec2::new(1.001, 0.0)) == 0.0
        );
        let (inside, outside) = (DVec2::Y * 0.9, DVec2::Y * 0.904);
        assert!(bare.shape(inside) > 0.0 && bare.shape(outside) == 0.0);
        // A ball that is seen along its pole is round again.
        let from_above = PlanetDisc { rings: Vec::new(), ..saturn(90.0, 90.0) };
        assert!(from_above.shape(DVec2::Y * 0.999) > 0.0);
        let mean = sum(&from_above, 600) / std::f64::consts::PI;
        // Flattened, its normals lean less than those of a ball do.
        assert!((1.0..1.06).contains(&(mean / GLOBE_ALBEDO)), "{mean}");
    }

    #[test]
    fn the_near_half_is_before_the_globe_and_the_far_half_behind() {
        // Seen from the north the near half is below the middle.
        let planet = saturn(20.0, 20.0);
        let bare = PlanetDisc { rings: Vec::new(), ..planet.clone() };
        let b = 1.75 * 20f64.to_radians().sin();
        let (near, far) = (DVec2::new(0.0, -b), DVec2::new(0.0, b));
        let ring = planet.rings[2].brightness;
        assert!((planet.shape(near) - ring).abs() < 0.01 * ring);
        assert_eq!(planet.shape(far), bare.shape(far));
        // Sideways there is only the ring.
        let aside = DVec2::new(1.75, 0.0);
        assert_eq!(planet.shape(aside), planet.rings[2].brightness);
        assert_eq!(planet.shape(DVec2::new(1.08, 0.0)), 0.0);
        assert_eq!(planet.shape(DVec2::new(2.29, 0.0)), 0.0);
        // From the south all is upside down.
        let south = saturn(-20.0, -20.0);
        assert!((south.shape(far) - south.rings[2].brightness).abs() < 0.01 * ring);
    }

    #[test]
    fn globe_and_rings_shade_each_other() {
        // The Sun to the left: the shadow of the globe lies on the right of the far half.
        let (sin, cos) = 6f64.to_radians().sin_cos();
        let mut planet = saturn(20.0, 20.0);
        planet.to_sun = DVec3::new(-sin, 0.0, -cos);
        let far = 2.0 * 20f64.to_radians().sin();
        let dark = DVec2::new(0.75, far);
        assert_eq!(planet.shape(dark), 0.0);
        assert!(planet.shape(DVec2::new(-dark.x, dark.y)) > 0.0);
        // The Sun higher than the observer: the rings' shadow falls to the south of them.
        let planet = saturn(24.0, 20.0);
        let bare = PlanetDisc { rings: Vec::new(), ..planet.clone() };
        let shaded = (0..100)
            .map(|step| DVec2::new(0.0, -0.89 + 0.001 * f64::from(step)))
            .filter(|&at| planet.shape(at) < 0.5 * bare.shape(at))
            .count();
        assert!(shaded >= 30, "{shaded}");
    }

    #[test]
    fn rings_are_dark_where_the_sun_is_on_their_other_side() {
        let (lit, dark) = (saturn(3.0, 3.0), saturn(-3.0, 3.0));
        let aside = DVec2::new(1.75, 0.0);
        assert!(dark.shape(aside) < 1e-6 * lit.shape(aside));
        // Edge-on nothing of them is seen.
        let edge_on = saturn(0.0, 0.0);
        assert!(edge_on.shape(DVec2::new(1.75, 0.0)) == 0.0);
        assert!(edge_on.shape(DVec2::ZERO) > 0.0);
    }

    #[test]
    fn share_of_the_rings_is_that_of_mallama_and_hilton() {
        for tilt_deg in [10.0f64, 20.0, 26.0] {
            let planet = saturn(tilt_deg, tilt_deg);
            let bare = PlanetDisc { rings: Vec::new(), ..planet.clone() };
            // Eqs. 10 and 11 at full phase.
            let sin = tilt_deg.to_radians().sin();
            let published = 10f64.powf(-0.4 * (-8.914 - 2.203 * sin + 8.95));
            let ours = sum(&planet, 500) / sum(&bare, 500);
            assert!((ours / published - 1.0).abs() < 0.08, "{tilt_deg}°: {ours} {published}");
        }
    }
}
