//! Everything that is known of a target, in words, each number to its error.

use crate::almanac::delta_t_error_s;
use crate::app::pointing;
use crate::catalog::{Star, messier};
use crate::ephemeris::orientation::{Orientation, ecliptic_from_icrs};
use crate::ephemeris::{Body, Ephemeris};
use crate::frame::{Apparent, Dir, Horizon, Icrs, Rot, TrueOfDate, WINDS, galactic_from_icrs};
use crate::light::night::{LitObject, Night};
use crate::sky::constellation::constellation_at;
use crate::sky::{BodyState, Target};
use crate::units::{AU_KM, Angle, Illuminance, LIGHT_SPEED_KM_S};

use super::written::{self, SECOND};

/// The sky turns by so much in a second of the Earth.
const TURN_ARCSEC_S: f64 = 15.041_07;
/// Axes of the Earth are asked to be so good.
const AXES: Angle = Angle::from_arcsec(0.001);
/// Refraction differs from that of standard air by this share of itself; an estimate.
const REFRACTION_SHARE: f64 = 0.1;
/// Objects of Messier's and places of names are so good.
const LISTED: Angle = Angle::from_arcmin(1.0);
const NAMES: Angle = Angle::from_deg(1.0);
/// Centres of places on the Moon are good to 0.1 degrees on the Moon.
const MOON_PLACE_DEG: f64 = 0.1;
/// What the theories of magnitudes of planets leave, and what air differs from the one that is set;
/// estimates.
const PLANET_MAG: f64 = 0.1;
const STAR_MAG: f64 = 0.01;
/// Standard error of parallaxes of the Bright Star Catalogue, arcseconds; an estimate.
const PARALLAX_ERROR_ARCSEC: f64 = 0.01;
const LIGHT_YEARS_IN_PARSEC: f64 = 3.261_56;

/// Something that is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fact {
    pub what: &'static str,
    pub value: String,
}

/// What a panel says of a target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts {
    pub rows: Vec<Fact>,
}

impl Facts {
    pub fn add(&mut self, what: &'static str, value: impl Into<String>) {
        self.rows.push(Fact { what, value: value.into() });
    }

    fn add_if(&mut self, what: &'static str, value: Option<impl Into<String>>) {
        if let Some(value) = value {
            self.add(what, value);
        }
    }

    /// Lines of text, to be copied.
    pub fn text(&self, title: &str) -> String {
        let lines = self.rows.iter().map(|fact| format!("{}: {}\n", fact.what, fact.value));
        std::iter::once(format!("{title}\n")).chain(lines).collect()
    }
}

/// The axes of a night.
pub struct Axes {
    icrs_from_horizon: Rot<Icrs, Horizon>,
    true_from_icrs: Rot<TrueOfDate, Icrs>,
    ecliptic_from_icrs: Rot<crate::frame::EclipticOfDate, Icrs>,
    latitude: Angle,
    /// What the turn of the Earth is uncertain by.
    pub turn_error: Angle,
}

impl Axes {
    pub fn of(night: &Night) -> Axes {
        let instant = &night.sky.instant;
        let nutation = Ephemeris::analytic().nutation(AXES, instant.tt);
        Axes {
            icrs_from_horizon: night.sky.horizon_from_icrs.inverse(),
            true_from_icrs: Orientation::at(instant, &nutation).true_from_icrs,
            ecliptic_from_icrs: ecliptic_from_icrs(instant.tt),
            latitude: night.sky.place.latitude,
            turn_error: Angle::from_arcsec(TURN_ARCSEC_S * delta_t_error_s(instant)),
        }
    }

    /// In ICRS axes, as it is seen: aberration is in it.
    pub fn icrs(&self, dir: Dir<Horizon>) -> Dir<Icrs> {
        self.icrs_from_horizon * dir
    }

    /// From the upper meridian, west positive.
    fn hour_angle(&self, dir: Dir<Horizon>) -> Angle {
        let (sin, cos) = self.latitude.sin_cos();
        let v = dir.vector();
        Angle::from_rad((-v.x).atan2(v.z * cos - v.y * sin))
    }

    /// A direction in all frames, the direction itself within an error among the stars.
    pub fn add_directions(
        &self,
        facts: &mut Facts,
        dir: Dir<Horizon>,
        seen: Dir<Apparent>,
        error: Angle,
    ) {
        let turned = error + self.turn_error;
        let [azimuth, altitude] = [seen.azimuth(), dir.altitude()];
        let lifted = seen.altitude() - altitude;
        let seen_error = turned.max(lifted.abs() * REFRACTION_SHARE);
        let wind = WINDS[(azimuth.deg() / 22.5).round() as usize % WINDS.len()];
        // At the zenith all azimuths are near.
        let around = turned / seen.altitude().cos().max(1e-3);
        facts.add("Azimuth", format!("{} {wind}", written::longitude(azimuth, around)));
        facts.add("Altitude, as seen", written::latitude(seen.altitude(), seen_error));
        facts.add("Altitude, without air", written::latitude(altitude, turned));
        let icrs = self.icrs(dir);
        let of_date = self.true_from_icrs * icrs;
        let equatorial = |longitude: Angle, latitude: Angle| {
            let (right, up) = (error / latitude.cos().max(1e-3), error);
            format!("{}  {}", written::hours(longitude, right), written::latitude(latitude, up))
        };
        facts.add("RA, Dec of date", equatorial(of_date.longitude(), of_date.latitude()));
        facts.add("RA, Dec in axes of J2000", equatorial(icrs.longitude(), icrs.latitude()));
        let around = turned / of_date.latitude().cos().max(1e-3);
        facts.add("Hour angle", written::hour_angle(self.hour_angle(dir), around));
        let pair = |longitude: Angle, latitude: Angle| {
            let around = error / latitude.cos().max(1e-3);
            format!(
                "{}  {}",
                written::longitude(longitude, around),
                written::latitude(latitude, error)
            )
        };
        let ecliptic = self.ecliptic_from_icrs * icrs;
        facts.add("Ecliptic of date", pair(ecliptic.longitude(), ecliptic.latitude()));
        let galactic = galactic_from_icrs() * icrs;
        facts.add("Galactic", pair(galactic.longitude(), galactic.latitude()));
    }

    /// The constellation around a direction.
    pub fn constellation(&self, dir: Dir<Horizon>) -> &'static str {
        constellation_at(self.icrs(dir)).get().latin
    }
}

/// Bound of the error of the direction to a target.
fn error_of(target: &Target, object: Option<&LitObject>, night: &Night) -> Angle {
    match (target, object) {
        (Target::MoonFeature(_), _) => {
            let moon = &night.sky.moon.state;
            moon.error_bound + moon.angular_radius * MOON_PLACE_DEG.to_radians()
        }
        (Target::Constellation(_), _) => NAMES,
        (_, Some(object)) => object.error_bound,
        (_, None) => LISTED,
    }
}

/// All that is known of a target in a night; none of what is not in it.
pub fn facts(target: &Target, night: &Night) -> Option<Facts> {
    let mut facts = Facts::default();
    let dir = pointing::geometric(target, night)?;
    let seen = pointing::towards(target, night)?;
    let object = pointing::object(target, night);
    let error = error_of(target, object.as_ref(), night);
    let axes = Axes::of(night);
    if let Some(object) = &object {
        add_light(&mut facts, object, night);
    }
    if let Target::Messier(number) = target {
        facts.add_if("Magnitude", messier(*number).map(|m| written::number(m.magnitude.0, 0.1)));
    }
    axes.add_directions(&mut facts, dir, seen, error);
    match target {
        Target::Constellation(_) => {}
        Target::Star { hr } => {
            let star = &night.stars[pointing::star(*hr, night)?];
            let own = constellation_at(star.dir_j2000).get();
            facts.add("Constellation", own.latin);
        }
        _ => facts.add("Constellation", axes.constellation(dir)),
    }
    match target {
        Target::Body(body) => add_body(&mut facts, night.sky.body(*body)?, night),
        Target::Satellite(satellite) => {
            let state = night.sky.satellite(*satellite)?;
            add_distance(&mut facts, state.distance_km, state.sun_distance_km, state.error_bound);
            add_size(&mut facts, state.angular_radius, state.distance_km, state.error_bound);
            let share = |share: f64| format!("{:.0} %", 100.0 * share);
            facts.add("Not hidden by Jupiter", share(state.share_seen));
            facts.add("In sunlight", share(state.share_sunlit));
        }
        Target::Star { hr } => {
            add_star(&mut facts, &night.stars[pointing::star(*hr, night)?]);
        }
        Target::MoonFeature(name) => {
            let feature = night.moon_feature(name)?;
            let (point, _) = night.on_moon(feature);
            let on_moon = |angle: Angle, plus: char, minus: char| {
                let side = if angle.rad() < 0.0 { minus } else { plus };
                format!("{:.1}° {side}", angle.deg().abs())
            };
            let place = [on_moon(feature.latitude, 'N', 'S'), on_moon(feature.longitude, 'E', 'W')];
            facts.add("On the Moon", place.join("  "));
            if feature.diameter_km > 0.0 {
                facts.add("Extent", format!("{:.0} km", feature.diameter_km));
            }
            let tenth = Angle::from_deg(0.1);
            facts.add(
                "Sun above it",
                format!("{}°", written::number(point.sun_altitude.deg(), tenth.deg())),
            );
            let height = written::number(point.observer_altitude.deg(), tenth.deg());
            facts.add("Earth above it", format!("{height}°"));
        }
        Target::Constellation(id) => {
            let one = id.get();
            facts.add("In English", one.english);
            facts.add("Genitive", one.genitive);
            facts.add("Abbreviation", one.abbreviation);
        }
        Target::Messier(number) => {
            let object = messier(*number)?;
            facts.add_if(
                "Extent",
                object.size.map(|(long, short)| {
                    let tenth = Angle::from_arcmin(0.1);
                    format!("{} by {}", written::small(long, tenth), written::small(short, tenth))
                }),
            );
        }
    }
    if !matches!(target, Target::Constellation(_)) {
        facts.add("Error of the direction", format!("at most {}", written::bound(error)));
        if axes.turn_error > error {
            let turned = written::bound(axes.turn_error);
            facts.add("Error of the turn of the Earth", format!("about {turned}"));
        }
    }
    Some(facts)
}

fn add_light(facts: &mut Facts, object: &LitObject, night: &Night) {
    let is_star = matches!(object.kind, crate::light::night::Kind::Star(_));
    let error = if is_star { STAR_MAG } else { PLANET_MAG };
    if object.magnitude.0.is_finite() {
        facts.add("Magnitude, outside the air", written::number(object.magnitude.0, error));
    }
    let arrives = Illuminance::from_lx(object.ground.y).magnitude().0;
    let words = match arrives.is_finite() {
        true => written::number(arrives, PLANET_MAG),
        false if object.apparent.altitude() < night.horizon => "below the horizon".to_owned(),
        false => "nothing".to_owned(),
    };
    facts.add("Magnitude, through the air", words);
}

/// How well a distance is known: an error of so much across is taken for one of as much along.
fn share_of(error: Angle) -> f64 {
    error.rad().max(1e-8)
}

fn add_distance(facts: &mut Facts, distance_km: f64, sun_distance_km: f64, error: Angle) {
    let share = share_of(error);
    let (au, km) =
        (written::relative(distance_km / AU_KM, share), written::relative(distance_km, share));
    facts.add("Distance", format!("{au} au"));
    facts.add("Distance in kilometres", format!("{km} km"));
    facts.add("Light takes", written::light_time(distance_km / LIGHT_SPEED_KM_S, share));
    if sun_distance_km > 0.0 {
        facts.add(
            "From the Sun",
            format!("{} au", written::relative(sun_distance_km / AU_KM, share)),
        );
    }
}

fn add_size(facts: &mut Facts, radius: Angle, distance_km: f64, error: Angle) {
    let diameter = radius * 2.0;
    // Radii are good to a few kilometres.
    let share = share_of(error).max(1e-4).max(1.0 / distance_km);
    facts.add("Apparent diameter", written::small(diameter, diameter * share));
}

fn add_body(facts: &mut Facts, state: &BodyState, night: &Night) {
    let error = state.error_bound;
    add_distance(facts, state.distance_km, state.sun_distance_km, error);
    add_size(facts, state.angular_radius, state.distance_km, error);
    if state.body != Body::Sun {
        let lit = 50.0 * (1.0 + state.phase_angle.cos());
        let hundredth = Angle::from_deg(0.01);
        let degrees =
            |angle: Angle| format!("{}°", written::number(angle.deg(), hundredth.max(error).deg()));
        facts.add("Lit part of the disc", format!("{} %", written::number(lit, 0.1)));
        facts.add("Phase angle", degrees(state.phase_angle));
        let elongation = state.dir.separation(night.sky.sun.dir);
        facts.add("Elongation from the Sun", degrees(elongation));
    }
    if state.body == Body::Moon {
        let libration = &night.sky.moon.libration;
        let degrees = |angle: Angle| {
            let sign = if angle.rad() < 0.0 { "" } else { "+" };
            format!("{sign}{}°", written::number(angle.signed().deg(), 0.01))
        };
        let (along, across) = (degrees(libration.longitude), degrees(libration.latitude));
        facts.add("Libration", format!("{along} in longitude, {across} in latitude"));
        let subsolar = &night.sky.moon.subsolar;
        // Where the Sun rises on the Moon.
        let colongitude = (Angle::from_deg(90.0) - subsolar.longitude).positive();
        facts.add("Colongitude", format!("{}°", written::number(colongitude.deg(), 0.1)));
    }
    if let Some(rings) = &state.rings {
        let degrees = |angle: Angle| format!("{}°", written::number(angle.deg(), 0.1));
        facts.add("Rings open to us", degrees(rings.observer_latitude));
        facts.add("Rings open to the Sun", degrees(rings.sun_latitude));
    }
    facts.add("Theory", state.tier.to_string());
}

fn add_star(facts: &mut Facts, star: &Star) {
    let error = Angle::from_arcsec(1.0);
    let (ra, dec) = (star.dir_j2000.longitude(), star.dir_j2000.latitude());
    facts.add(
        "RA, Dec J2000.0, catalogue",
        format!("{}  {}", written::hours(ra, error), written::latitude(dec, error)),
    );
    let parallax = star.parallax_arcsec;
    if parallax > 2.0 * PARALLAX_ERROR_ARCSEC {
        let parsec = 1.0 / parallax;
        let error = parsec * (PARALLAX_ERROR_ARCSEC / parallax);
        let parsec_words = written::number(parsec, error);
        let years = written::number(parsec * LIGHT_YEARS_IN_PARSEC, error * LIGHT_YEARS_IN_PARSEC);
        facts.add("Distance", format!("about {parsec_words} pc, {years} light-years"));
    }
    if parallax > 0.0 {
        facts.add("Parallax", format!("{}{SECOND}", written::number(parallax, 0.001)));
    }
    let motion = [star.proper_motion_ra_arcsec_yr, star.proper_motion_dec_arcsec_yr];
    let [east, north] = motion.map(|arcsec| written::number(arcsec, 0.001));
    facts.add("Proper motion", format!("{east}{SECOND} east, {north}{SECOND} north a year"));
    if star.radial_velocity_km_s != 0.0 {
        let away = star.radial_velocity_km_s > 0.0;
        let speed = written::number(star.radial_velocity_km_s.abs(), 1.0);
        facts.add(
            "Radial velocity",
            format!("{speed} km/s {}", if away { "away" } else { "towards us" }),
        );
    }
    facts.add("Spectral type", star.spectral_type.clone());
    facts.add("B−V", written::number(star.b_v, 0.01));
    facts.add_if("Variable star", star.variable.clone());
    facts.add_if(
        "Companion",
        star.companion.map(|companion| {
            let apart = written::number(companion.separation_arcsec, 0.1);
            let fainter = companion.magnitude_difference.map(|mag| written::number(mag, 0.1));
            match fainter {
                Some(mag) => format!("{apart}{SECOND} apart, {mag} mag fainter"),
                None => format!("{apart}{SECOND} apart"),
            }
        }),
    );
}
