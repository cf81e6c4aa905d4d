//! Everything in the sky that is drawn as itself: where it stands, where it is seen, how bright.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::refraction::Refraction;
use crate::catalog::MoonFeature;
use crate::ephemeris::{Body, Galilean};
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::clear_view::ClearView;
use crate::light::disc_light::{point_light, visible_light};
use crate::light::earth_shadow::{Danjon, EarthShadow, ShadowedMoon};
use crate::light::earthshine::{self, EarthView};
use crate::light::moon::{self, MoonView};
use crate::light::planets::{self, Planet, PlanetView};
use crate::light::satellites;
use crate::light::solar_eclipse::CoveredSun;
use crate::light::spectrum::{Spectrum, Transmittance};
use crate::light::star_light::StarLight;
use crate::light::star_spectrum::StarShape;
use crate::light::sun;
use crate::sky::star_index::{StarIndex, folded};
use crate::sky::{BodyState, RingTilt, SatelliteState, SkyState, SurfacePoint};
use crate::units::{AU_KM, Angle, Illuminance, Magnitude, Xyzv};

/// How good the direction of a star of the Yale catalogue is: it gives right ascensions to 0.1 s
/// and declinations to 1 arcsecond, in the FK5.
pub const STAR_ERROR_BOUND: Angle = Angle::from_arcsec(3.0);

/// Days in a Julian year, which proper motions count.
const JULIAN_YEAR_DAYS: f64 = 365.25;

/// What an object is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    Body(Body),
    /// A great moon of Jupiter.
    Satellite(Galilean),
    /// A star, by its place in [`Night::stars`].
    Star(usize),
}

/// An object and its light.
#[derive(Debug, Clone, PartialEq)]
pub struct LitObject {
    pub kind: Kind,
    /// Geometric direction, without air.
    pub dir: Dir<Horizon>,
    /// Where it is seen.
    pub apparent: Dir<Apparent>,
    /// Stated bound of the error of its direction.
    pub error_bound: Angle,
    /// Johnson V, outside the air.
    pub magnitude: Magnitude,
    /// Photopic illuminance outside the air, on a plane that faces it.
    pub outside: Illuminance,
    /// Illuminance through the air, lux; black below the horizon. Of the Sun and the Moon that of
    /// what is above it, if the air says that they are [discs](crate::air::LightPaths).
    pub ground: Xyzv,
}

/// The sky of an instant and a place with everything that shines in it.
#[derive(Debug, Clone)]
pub struct Night {
    pub sky: SkyState,
    pub air: Atmosphere,
    /// How the air bends light, made once for the night; clones share its tables.
    pub refraction: Refraction,
    /// Apparent altitude of the horizon of the ground around.
    pub horizon: Angle,
    /// Sun, Moon, planets, moons of Jupiter. Stars are lit when they are asked for.
    pub objects: Vec<LitObject>,
    /// The stars in the order of the catalogue, to be found by where they stand.
    pub stars: StarIndex,
    /// What arrives of the light of stars, made when the first is lit.
    starlight: Arc<OnceLock<StarLight>>,
    /// Places on the Moon that have a name, if somebody [gave](Night::with_moon_features) them.
    pub moon_features: Vec<MoonFeature>,
    /// What an eclipse takes from the Sun and the Moon.
    pub eclipse: Eclipsed,
}

/// Which stars are wanted: those that may be seen within a cone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StarSearch {
    /// Middle of the cone, as seen.
    pub centre: Dir<Apparent>,
    pub radius: Angle,
    /// Nobody asks for fainter ones, wherever they stand.
    pub limit: Option<Magnitude>,
    /// Fainter ones cannot be told from the sky.
    pub drowned: Option<Magnitude>,
}

/// The stars of a search, and how many were not touched.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StarsFound {
    /// Above the horizon, within the cone or beside it by less than a cell and refraction.
    pub stars: Vec<LitObject>,
    pub fainter_than_limit: usize,
    pub below_horizon: usize,
    pub out_of_view: usize,
    pub drowned: usize,
}

/// What stands in the way of sunlight: the Moon before the Sun, the Earth before the Moon. Outside
/// eclipses neither.
#[derive(Debug, Clone, Default)]
pub struct Eclipsed {
    pub sun: Option<CoveredSun>,
    pub moon: Option<MoonInShadow>,
}

/// The Moon in the shadow of the Earth.
#[derive(Debug, Clone)]
pub struct MoonInShadow {
    pub shadow: Arc<EarthShadow>,
    pub place: ShadowedMoon,
    /// What is left of the light of the whole disc.
    pub mean: Transmittance,
}

impl Eclipsed {
    /// Air that cannot be makes no shadow.
    fn of(sky: &SkyState, view: &ClearView, danjon: Danjon) -> Eclipsed {
        let sun = Some(CoveredSun::of(sky)).filter(|sun| !sun.is_whole());
        let place = ShadowedMoon::of(sky);
        let in_shadow = || {
            let shadow = view.earth_shadow(danjon, place.distances)?;
            let mean = shadow.over_disc(place.offset, place.disc_radius());
            Some(MoonInShadow { shadow, place, mean })
        };
        let moon = if place.is_outside() { None } else { in_shadow() };
        Eclipsed { sun, moon }
    }
}

impl Night {
    /// Lights the sky. The stars are those of the catalogue; an eclipse of the Moon is as dark as
    /// most are.
    pub fn of(sky: SkyState, stars: impl Into<StarIndex>, air: &Atmosphere) -> Night {
        Night::with_danjon(sky, stars, air, Danjon::default())
    }

    /// The same, with a number that says how dark an eclipse of the Moon is.
    pub fn with_danjon(
        sky: SkyState,
        stars: impl Into<StarIndex>,
        air: &Atmosphere,
        danjon: Danjon,
    ) -> Night {
        let view = ClearView::new(air, sky.place.height_m);
        Night::seen_through(&view, sky, stars, danjon)
    }

    /// The same through air that is ready to be looked through; the height of the place is its height.
    pub fn seen_through(
        view: &ClearView,
        sky: SkyState,
        stars: impl Into<StarIndex>,
        danjon: Danjon,
    ) -> Night {
        let air = view.air();
        let eclipse = Eclipsed::of(&sky, view, danjon);
        let refraction = view.refraction().clone();
        let sight = view.sight();
        let horizon = view.horizon();
        let body = |state: &BodyState| {
            let apparent = refraction.apparent_from_horizon(state.dir);
            let spectrum = irradiance(state, &sky, &eclipse);
            let outside = spectrum.xyzv();
            let ground = match state.body {
                Body::Sun if air.paths.source_disc => {
                    visible_light(state, &spectrum, sight, &refraction)
                }
                Body::Moon if air.paths.source_disc => {
                    // The Earth, beside the observer, lights the whole disc.
                    let earthlit = BodyState { dir_to_sun: -state.dir, ..*state };
                    let sunlight = sunlit_moon(&sky, &eclipse);
                    visible_light(state, &sunlight, sight, &refraction)
                        + visible_light(&earthlit, &earthlit_moon(&sky), sight, &refraction)
                }
                _ => point_light(apparent.altitude(), &spectrum, sight, &refraction),
            };
            LitObject {
                kind: Kind::Body(state.body),
                dir: state.dir,
                apparent,
                error_bound: state.error_bound,
                magnitude: Illuminance::from_lx(outside.y).magnitude(),
                outside: Illuminance::from_lx(outside.y),
                ground,
            }
        };
        let mut objects: Vec<LitObject> = bodies(&sky).map(body).collect();
        objects.extend(sky.satellites.iter().map(|state: &SatelliteState| {
            let light = satellites::light(state);
            let apparent = refraction.apparent_from_horizon(state.dir);
            LitObject {
                kind: Kind::Satellite(state.satellite),
                dir: state.dir,
                apparent,
                error_bound: state.error_bound,
                magnitude: light.magnitude,
                outside: light.magnitude.illuminance(),
                ground: point_light(apparent.altitude(), &light.spectrum, sight, &refraction),
            }
        }));

        Night {
            sky,
            air: air.clone(),
            refraction,
            horizon,
            objects,
            stars: stars.into(),
            starlight: view.starlight(),
            eclipse,
            moon_features: Vec::new(),
        }
    }

    /// The same night with what a night before has made of the light of stars, if the air and the
    /// height of the place are the same.
    pub fn keeping_starlight_of(self, before: &Night) -> Night {
        let is_same = self.air == before.air
            && self.sky.place.height_m.to_bits() == before.sky.place.height_m.to_bits();
        let starlight = if is_same { before.starlight.clone() } else { self.starlight };
        Night { starlight, ..self }
    }

    /// What arrives of the light of stars here.
    pub fn starlight(&self) -> &StarLight {
        self.starlight.get_or_init(|| StarLight::new(&self.air, self.sky.place.height_m))
    }

    /// A star by its place in [`Night::stars`], which is less than their number.
    pub fn star(&self, index: usize) -> LitObject {
        self.lit(index, self.sky.star(&self.stars[index]))
    }

    /// All stars, lit one by one, in the order of the catalogue.
    pub fn lit_stars(&self) -> impl Iterator<Item = LitObject> {
        (0..self.stars.len()).map(|index| self.star(index))
    }

    /// The stars above the horizon within a cone around an apparent direction, lit; those in reach
    /// are found without touching the others. Cell by cell, the brightest of each first.
    pub fn stars_in(
        &self,
        centre: Dir<Apparent>,
        radius: Angle,
        faintest: Option<Magnitude>,
    ) -> Vec<LitObject> {
        let search = StarSearch { centre, radius, limit: faintest, drowned: None };
        let mut stars = self.search_stars(&search).stars;
        stars.retain(|star| star.apparent.separation(centre) <= radius);
        stars
    }

    /// The same, somewhat beyond the edge of the cone, with an account of the stars left alone.
    pub fn search_stars(&self, search: &StarSearch) -> StarsFound {
        let mut found = StarsFound::default();
        let mut wanted = Vec::new();
        let years = self.sky.instant.tdb.days_since_j2000() / JULIAN_YEAR_DAYS;
        let lowest = self.refraction.true_from_apparent(self.horizon);
        // What is above the horizon stands lower than it is seen, by no more than at the horizon.
        let reach = search.radius + (self.horizon - lowest).max(Angle::ZERO);
        let beyond = |a: Angle, b: Angle| (a + b).rad().min(std::f64::consts::PI).cos();
        let below = Angle::from_deg(90.0) - lowest;
        for cell in self.stars.cells() {
            let asked = self.stars.bright(cell, search.limit);
            found.fainter_than_limit += cell.len() - asked;
            let dir = (self.sky.horizon_from_icrs * cell.axis()).vector();
            let radius = cell.radius(years);
            if dir.dot(search.centre.vector()) < beyond(reach, radius) {
                found.out_of_view += asked;
            } else if dir.z < beyond(below, radius) {
                found.below_horizon += asked;
            } else {
                let bright = self.stars.bright(cell, search.drowned).min(asked);
                found.drowned += asked - bright;
                wanted.extend(self.stars.brightest(cell, bright));
            }
        }
        if wanted.is_empty() {
            return found;
        }
        let reach_cos = beyond(reach, Angle::ZERO);
        let low_sin = lowest.sin();
        let seen: Vec<Result<LitObject, bool>> = wanted
            .par_iter()
            .with_min_len(256)
            .map(|&(index, motion)| {
                let dir = self.sky.star(motion);
                let is_in_view = dir.vector().dot(search.centre.vector()) >= reach_cos;
                match is_in_view && dir.vector().z >= low_sin {
                    true => Ok(self.lit(index, dir)),
                    false => Err(is_in_view),
                }
            })
            .collect();
        found.stars.reserve(seen.len());
        for star in seen {
            match star {
                Ok(star) => found.stars.push(star),
                Err(is_in_view) if is_in_view => found.below_horizon += 1,
                Err(_) => found.out_of_view += 1,
            }
        }
        found
    }

    /// A star that stands in a direction.
    fn lit(&self, index: usize, dir: Dir<Horizon>) -> LitObject {
        let star = &self.stars[index];
        let apparent = self.refraction.apparent_from_horizon(dir);
        let outside = star.magnitude.illuminance();
        let altitude = apparent.altitude();
        let ground = if altitude < self.horizon {
            Xyzv::BLACK
        } else {
            self.starlight().at_eye(StarShape::of(star), altitude, outside)
                * self.refraction.divergence(altitude)
        };
        LitObject {
            kind: Kind::Star(index),
            dir,
            apparent,
            error_bound: STAR_ERROR_BOUND,
            magnitude: star.magnitude,
            outside,
            ground,
        }
    }

    /// The same night with the names of places on the Moon.
    pub fn with_moon_features(self, moon_features: Vec<MoonFeature>) -> Night {
        Night { moon_features, ..self }
    }

    /// A place on the Moon by name: `Tycho`, or `Moon/Copernicus` where a star is called the same.
    pub fn moon_feature(&self, name: &str) -> Option<&MoonFeature> {
        let wanted = folded(name);
        let wanted = wanted.strip_prefix("moon/").unwrap_or(&wanted);
        self.moon_features.iter().find(|feature| folded(&feature.name) == wanted)
    }

    /// How a place on the Moon stands in the sky, and where it is seen.
    pub fn on_moon(&self, feature: &MoonFeature) -> (SurfacePoint, Dir<Apparent>) {
        let point = self.sky.moon.surface_point(feature.longitude, feature.latitude);
        (point, self.refraction.apparent_from_horizon(point.dir))
    }

    /// Where the Sun, the Moon and the planets stand.
    pub fn bodies(&self) -> impl Iterator<Item = &BodyState> {
        bodies(&self.sky)
    }

    /// Spectral irradiance of a body outside the air, W m-2 nm-1, on a plane that faces it; of the Sun
    /// and the Moon what an eclipse leaves. Of the Moon it is [what the Sun lights](Night::sunlit_moon)
    /// and [what the Earth lights](Night::earthlit_moon) together.
    pub fn irradiance(&self, state: &BodyState) -> Spectrum {
        irradiance(state, &self.sky, &self.eclipse)
    }

    /// The same without any eclipse: the light of a disc of which a part is hidden as it is drawn.
    pub fn irradiance_without_eclipse(&self, state: &BodyState) -> Spectrum {
        irradiance(state, &self.sky, &Eclipsed::default())
    }

    /// Spectral irradiance of the Moon by the light of the Sun alone, W m-2 nm-1, outside the air, on a
    /// plane that faces it: what an eclipse leaves of it.
    pub fn sunlit_moon(&self) -> Spectrum {
        sunlit_moon(&self.sky, &self.eclipse)
    }

    /// The same by the light of the Earth alone; the sunlit part of the disc is lit by it too.
    pub fn earthlit_moon(&self) -> Spectrum {
        earthlit_moon(&self.sky)
    }

    /// The Sun, the Moon or a planet.
    pub fn body(&self, body: Body) -> Option<&LitObject> {
        self.objects.iter().find(|object| object.kind == Kind::Body(body))
    }

    /// What people call an object: a proper name, a designation, or a catalogue number.
    pub fn label(&self, object: &LitObject) -> String {
        match object.kind {
            Kind::Body(body) => body.name().to_owned(),
            Kind::Satellite(satellite) => satellite.name().to_owned(),
            Kind::Star(index) => {
                let star = &self.stars[index];
                let name = star.name.as_ref().or(star.designation.as_ref());
                name.cloned().unwrap_or_else(|| format!("HR {}", star.hr))
            }
        }
    }

    /// An object by name: `Moon`, `Sirius`, `α CMa`, `61 Cyg`, `HR 2491`, `HIP 32349`.
    pub fn find(&self, name: &str) -> Option<LitObject> {
        let wanted = folded(name);
        let is_it = |object: &&LitObject| match object.kind {
            Kind::Body(body) => folded(body.name()) == wanted,
            Kind::Satellite(satellite) => folded(satellite.name()) == wanted,
            Kind::Star(_) => false,
        };
        let near = self.objects.iter().find(is_it).cloned();
        near.or_else(|| self.stars.find(name).map(|index| self.star(index)))
    }
}

fn bodies(sky: &SkyState) -> impl Iterator<Item = &BodyState> {
    [&sky.sun, &sky.moon.state].into_iter().chain(&sky.planets)
}

fn irradiance(state: &BodyState, sky: &SkyState, eclipse: &Eclipsed) -> Spectrum {
    let planet = match state.body {
        Body::Sun => {
            let covered = eclipse.sun.map(|covered| covered.irradiance(state.distance_km));
            return covered.unwrap_or_else(|| sun::irradiance(state.distance_km));
        }
        Body::Moon => return sunlit_moon(sky, eclipse) + earthlit_moon(sky),
        Body::Mercury => Planet::Mercury,
        Body::Venus => Planet::Venus,
        Body::Mars => Planet::Mars,
        Body::Jupiter => Planet::Jupiter,
        Body::Saturn => Planet::Saturn,
        Body::Uranus => Planet::Uranus,
        Body::Neptune => Planet::Neptune,
        Body::Pluto => Planet::Pluto,
    };
    let latitude = |of: fn(&RingTilt) -> Angle| state.rings.as_ref().map_or(Angle::ZERO, of);
    let view = PlanetView {
        sun_distance_au: state.sun_distance_km / AU_KM,
        observer_distance_au: state.distance_km / AU_KM,
        phase: state.phase_angle,
        sun_latitude: latitude(|rings| rings.sun_latitude),
        observer_latitude: latitude(|rings| rings.observer_latitude),
        year: 2000.0 + 100.0 * sky.instant.tt.centuries_since_j2000(),
    };
    planets::light(planet, &view).spectrum
}

fn sunlit_moon(sky: &SkyState, eclipse: &Eclipsed) -> Spectrum {
    let left = eclipse.moon.as_ref().map_or(Transmittance::CLEAR, |moon| moon.mean);
    moon::irradiance(&moon_view(sky)) * left
}

fn earthlit_moon(sky: &SkyState) -> Spectrum {
    let [to_sun, to_earth] = ShadowedMoon::of(sky).to_sun_and_earth_km();
    let earth_to_sun = to_sun - to_earth;
    let earth = EarthView {
        phase: Angle::from_rad(earth_to_sun.angle_between(-to_earth)),
        moon_distance_km: to_earth.length(),
        sun_distance_km: earth_to_sun.length(),
    };
    earthshine::disc_irradiance(&moon_view(sky), &earth)
}

fn moon_view(sky: &SkyState) -> MoonView {
    let moon = &sky.moon;
    MoonView {
        phase: moon.state.phase_angle,
        sun_longitude: Some(moon.subsolar.longitude),
        observer_longitude: moon.libration.longitude,
        observer_latitude: moon.libration.latitude,
        sun_distance_km: moon.state.sun_distance_km,
        observer_distance_km: moon.state.distance_km,
    }
}
