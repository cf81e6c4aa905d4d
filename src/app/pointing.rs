//! Where things are on the picture, and what is under the pointer.

use crate::catalog::{messier, messier_objects};
use crate::ephemeris::Body;
use crate::eye::limiting_magnitude::{TYPICAL_FIELD_FACTOR, limiting_magnitude};
use crate::frame::{Apparent, Dir, Horizon, Icrs};
use crate::light::night::{Kind, LitObject, Night};
use crate::sky::Target;
use crate::units::{Angle, Magnitude};

use super::model::Model;
use super::sky::Shown;

/// A Moon at least so wide shows its places, pixels.
const MOON_WITH_PLACES_PX: f64 = 60.0;
/// How much a magnitude counts against the way from the pointer to the edge of its reach.
const MAGNITUDE_WEIGHT: f64 = 0.05;
/// Who looks at a screen may see stars fainter by this than an eye outside, magnitudes.
const FAINTER: f64 = 1.0;
/// What has its name beside it is meant as often as a star of this magnitude.
const NAMED: f64 = 3.0;
/// The name of a constellation is meant where nothing else is.
const NAME_ALONE: f64 = 9.0;

/// Where a target is seen; none for what is not known here. Of a constellation it is the place of its
/// (first) name; that and objects of Messier's stand without aberration (20"), which is less than
/// their places are good to.
pub fn towards(target: &Target, night: &Night) -> Option<Dir<Apparent>> {
    match target {
        Target::Body(_) | Target::Satellite(_) | Target::Star { .. } => {
            object(target, night).map(|object| object.apparent)
        }
        Target::MoonFeature(name) => {
            night.moon_feature(name).map(|feature| night.on_moon(feature).1)
        }
        Target::Constellation(id) => {
            id.get().labels.first().map(|label| seen_from_icrs(*label, night))
        }
        Target::Messier(number) => {
            messier(*number).map(|object| seen_from_icrs(object.dir_j2000, night))
        }
    }
}

/// Where a target stands without air, for what [`towards`] knows.
pub fn geometric(target: &Target, night: &Night) -> Option<Dir<Horizon>> {
    match target {
        Target::Body(_) | Target::Satellite(_) | Target::Star { .. } => {
            object(target, night).map(|object| object.dir)
        }
        Target::MoonFeature(name) => {
            night.moon_feature(name).map(|feature| night.on_moon(feature).0.dir)
        }
        Target::Constellation(id) => {
            id.get().labels.first().map(|label| night.sky.horizon_from_icrs * *label)
        }
        Target::Messier(number) => {
            messier(*number).map(|object| night.sky.horizon_from_icrs * object.dir_j2000)
        }
    }
}

/// The object with its light, of what has light of its own here.
pub fn object(target: &Target, night: &Night) -> Option<LitObject> {
    let near = |kind: Kind| night.objects.iter().find(|object| object.kind == kind).cloned();
    match target {
        Target::Body(body) => near(Kind::Body(*body)),
        Target::Satellite(satellite) => near(Kind::Satellite(*satellite)),
        Target::Star { hr } => Some(night.star(star(*hr, night)?)),
        Target::MoonFeature(_) | Target::Constellation(_) | Target::Messier(_) => None,
    }
}

/// The place of a star in [`Night::stars`].
pub fn star(hr: u16, night: &Night) -> Option<usize> {
    // The catalogue is in the order of its numbers.
    let by_order = night.stars.binary_search_by_key(&hr, |star| star.hr).ok();
    by_order.or_else(|| night.stars.iter().position(|star| star.hr == hr))
}

/// Half the angle that the disc of a target fills; zero for what is a point, or has no disc.
pub fn angular_radius(target: &Target, night: &Night) -> Angle {
    match target {
        Target::Body(body) => night.sky.body(*body).map(|state| state.angular_radius),
        Target::Satellite(satellite) => {
            night.sky.satellite(*satellite).map(|state| state.angular_radius)
        }
        Target::MoonFeature(name) => night.moon_feature(name).map(|feature| {
            let distance_km = night.sky.moon.state.distance_km;
            Angle::from_rad(0.5 * feature.diameter_km / distance_km)
        }),
        Target::Messier(number) => messier(*number).and_then(|m| m.size).map(|size| size.0 / 2.0),
        Target::Star { .. } | Target::Constellation(_) => None,
    }
    .unwrap_or(Angle::ZERO)
}

fn seen_from_icrs(dir: Dir<Icrs>, night: &Night) -> Dir<Apparent> {
    night.refraction.apparent_from_horizon(night.sky.horizon_from_icrs * dir)
}

/// The direction under a pixel of the picture; none where the picture has no sky.
pub fn direction(pixel: [f64; 2], shown: &Shown) -> Option<Dir<Apparent>> {
    let camera = &shown.setting.camera;
    Some(camera.view_from_apparent().inverse() * camera.view_from_pixel(pixel)?)
}

/// What a person means who points at a pixel of the picture: a disc that it lies on, with a place on
/// a large Moon; else, of what can be seen within reach, what is near and bright.
pub fn under(pixel: [f64; 2], reach_px: f64, shown: &Shown, model: &Model) -> Option<Target> {
    let dir = direction(pixel, shown)?;
    let night = &*shown.night;
    if model.layers.ground && dir.altitude() < night.horizon {
        return None;
    }
    let pointer = Pointer { pixel, reach_px, shown };
    pointer.disc(model).or_else(|| pointer.nearest(dir, model))
}

struct Pointer<'a> {
    pixel: [f64; 2],
    reach_px: f64,
    shown: &'a Shown,
}

impl Pointer<'_> {
    fn off_px(&self, dir: Dir<Apparent>) -> Option<f64> {
        let [x, y] = self.shown.setting.camera.pixel_from_apparent(dir)?;
        Some((x - self.pixel[0]).hypot(y - self.pixel[1]))
    }

    fn radius_px(&self, angle: Angle) -> f64 {
        angle.rad() / self.shown.setting.camera.pixel_angle().rad()
    }

    /// The nearest of the discs that the pointer lies on: the smallest is in front of the others.
    fn disc(&self, model: &Model) -> Option<Target> {
        let night = &*self.shown.night;
        let under = |object: &&LitObject| {
            let Some(target) = target_of(object, night) else { return false };
            let radius_px = self.radius_px(angular_radius(&target, night));
            let hidden = matches!(object.kind, Kind::Satellite(_)) && !is_apart(object, night);
            !hidden && self.off_px(object.apparent).is_some_and(|off_px| off_px < radius_px)
        };
        let radius = |object: &LitObject| {
            target_of(object, night).map_or(Angle::ZERO, |target| angular_radius(&target, night))
        };
        let found = night
            .objects
            .iter()
            .filter(under)
            .min_by(|a, b| radius(a).rad().total_cmp(&radius(b).rad()))?;
        if found.kind == Kind::Body(Body::Moon) && model.layers.moon {
            let width_px = 2.0 * self.radius_px(radius(found));
            if width_px > MOON_WITH_PLACES_PX
                && let Some(place) = self.moon_place()
            {
                return Some(place);
            }
        }
        target_of(found, night)
    }

    /// The place on the Moon whose middle is nearest, if it is within reach: of two, the greater counts
    /// as nearer.
    fn moon_place(&self) -> Option<Target> {
        let night = &*self.shown.night;
        let near = night.moon_features.iter().filter_map(|feature| {
            let (point, seen) = night.on_moon(feature);
            if point.observer_altitude <= Angle::ZERO {
                return None;
            }
            let off_px = self.off_px(seen).filter(|off_px| *off_px <= self.reach_px)?;
            let greater = (feature.diameter_km.max(1.0) / 1000.0).ln();
            Some((off_px / self.reach_px - MAGNITUDE_WEIGHT * greater, feature))
        });
        let (_, feature) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Target::MoonFeature(feature.name.clone()))
    }

    fn nearest(&self, dir: Dir<Apparent>, model: &Model) -> Option<Target> {
        let night = &*self.shown.night;
        let mut best: Option<(f64, Target)> = None;
        let mut offer = |off_px: Option<f64>, reach_px: f64, magnitude: f64, target: Target| {
            let Some(off_px) = off_px.filter(|off_px| *off_px <= reach_px) else { return };
            let score = off_px / reach_px + MAGNITUDE_WEIGHT * magnitude;
            if best.as_ref().is_none_or(|(least, _)| score < *least) {
                best = Some((score, target));
            }
        };
        let sky = self.shown.plan.sky.luminance(dir).y;
        let faintest = Magnitude(limiting_magnitude(sky, TYPICAL_FIELD_FACTOR) + FAINTER);
        let is_up = |dir: Dir<Apparent>| !model.layers.ground || dir.altitude() >= night.horizon;
        for object in &night.objects {
            let Some(target) = target_of(object, night) else { continue };
            let is_planet = matches!(object.kind, Kind::Body(_));
            let layers = &model.layers;
            let is_wanted = match object.kind {
                Kind::Body(Body::Sun) => layers.sun,
                Kind::Body(Body::Moon) => layers.moon,
                _ => layers.planets,
            };
            let is_named = is_planet && model.overlays.planet_names;
            let magnitude = match is_named {
                true => object.magnitude.0.min(NAMED),
                false => object.magnitude.0,
            };
            let seen = is_named || object.magnitude <= faintest;
            if is_wanted && seen && is_up(object.apparent) && is_apart(object, night) {
                offer(self.off_px(object.apparent), self.reach_px, magnitude, target);
            }
        }
        if model.layers.stars {
            let edge = [self.pixel[0] + self.reach_px, self.pixel[1]];
            let beside = [self.pixel[0], self.pixel[1] + self.reach_px];
            let widest = [edge, beside].into_iter().filter_map(|at| direction(at, self.shown));
            let reach = widest.map(|at| at.separation(dir).rad()).fold(0.0, f64::max);
            for star in night.stars_in(dir, Angle::from_rad(reach * 1.2), Some(faintest)) {
                if let Some(target) = target_of(&star, night) {
                    let (off_px, magnitude) = (self.off_px(star.apparent), star.magnitude.0);
                    offer(off_px, self.reach_px, magnitude, target);
                }
            }
        }
        if model.overlays.deep_sky {
            for object in messier_objects() {
                let target = Target::Messier(object.number);
                let Some(seen) = towards(&target, night).filter(|dir| is_up(*dir)) else {
                    continue;
                };
                let reach_px = self.reach_px.max(self.radius_px(angular_radius(&target, night)));
                offer(self.off_px(seen), reach_px, object.magnitude.0.min(NAMED), target);
            }
        }
        if model.overlays.constellation_names {
            for id in crate::catalog::ConstellationId::all() {
                for &label in &id.get().labels {
                    let seen = seen_from_icrs(label, night);
                    if is_up(seen) {
                        let target = Target::Constellation(id);
                        offer(self.off_px(seen), 2.0 * self.reach_px, NAME_ALONE, target);
                    }
                }
            }
        }
        best.map(|(_, target)| target)
    }
}

/// Whether a moon of Jupiter can be told from Jupiter: neither behind it nor before its disc. Everything
/// else stands by itself.
fn is_apart(object: &LitObject, night: &Night) -> bool {
    match object.kind {
        Kind::Satellite(satellite) => night.sky.satellite(satellite).is_some_and(|state| {
            state.share_seen > 0.0 && state.share_sunlit > 0.0 && !state.is_before_jupiter
        }),
        Kind::Body(_) | Kind::Star(_) => true,
    }
}

fn target_of(object: &LitObject, night: &Night) -> Option<Target> {
    Some(match object.kind {
        Kind::Body(body) => Target::Body(body),
        Kind::Satellite(satellite) => Target::Satellite(satellite),
        Kind::Star(index) => Target::Star { hr: night.stars.get(index)?.hr },
    })
}
