//! What an almanac lists: events, and what is said of each.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use thiserror::Error;

use super::eclipse::{Cover, LunarKind, SolarKind};
use crate::catalog::Star;
use crate::ephemeris::Body;
use crate::time::Instant;
use crate::units::Angle;

/// What an event happens to.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    Body(Body),
    Star(Arc<Star>),
}

/// Something that happens in the sky.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// When; of what lasts, when it begins.
    pub instant: Instant,
    pub what: What,
}

/// What happens, with the quantities that belong to it. Altitudes and azimuths are topocentric and
/// airless; everything else is geocentric.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    Rise {
        target: Target,
        azimuth: Angle,
    },
    Set {
        target: Target,
        azimuth: Angle,
    },
    /// Hour angle 0, or 12 hours.
    Transit {
        target: Target,
        meridian: Meridian,
        azimuth: Angle,
        altitude: Angle,
    },
    Twilight {
        twilight: Twilight,
        edge: Edge,
        azimuth: Angle,
    },
    MoonPhase(Quarter),
    Season(Season),
    /// Distance of the centres of the Earth and of the other body at that moment, no light time.
    Apsis {
        apsis: Apsis,
        distance_km: f64,
    },
    /// `offset` is how far north of the second the first stands.
    Conjunction {
        of: [Target; 2],
        coordinate: Coordinate,
        offset: Angle,
    },
    /// With the Sun, in ecliptic longitude; `offset` is how far north of it.
    SolarConjunction {
        planet: Body,
        side: Side,
        offset: Angle,
    },
    /// 180 degrees from the Sun in ecliptic longitude; `separation` from the Sun.
    Opposition {
        planet: Body,
        separation: Angle,
    },
    GreatestElongation {
        planet: Body,
        elongation: Angle,
        is_east: bool,
    },
    /// Two targets as near each other as they come.
    Appulse {
        of: [Target; 2],
        separation: Angle,
    },
    /// Sun and Moon both stay down until `end`.
    Dark {
        end: Instant,
    },
}

/// Where on the meridian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meridian {
    Upper,
    Lower,
}

/// Depth of the Sun at the edge of a twilight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Twilight {
    Civil,
    Nautical,
    Astronomical,
}

/// Which way the Sun goes through it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    Dawn,
    Dusk,
}

/// Phases of the Moon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quarter {
    New,
    First,
    Full,
    Last,
}

/// Where the Sun stands in the year, named by the month so that it is true in both hemispheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Season {
    MarchEquinox,
    JuneSolstice,
    SeptemberEquinox,
    DecemberSolstice,
}

/// Ends of the orbits of the Earth and of the Moon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Apsis {
    Perihelion,
    Aphelion,
    Perigee,
    Apogee,
}

/// What two targets have in common at a conjunction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    RightAscension,
    EclipticLongitude,
}

/// Where a planet stands when the Sun is in line with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Between the Earth and the Sun.
    Inferior,
    /// Beyond the Sun, of a planet that also comes between.
    Superior,
    /// Beyond the Sun, of a planet that never comes between.
    Outer,
}

/// Kinds of events that are asked for together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    Rise,
    Set,
    Transit,
    LowerTransit,
    Twilight,
    Phase,
    Season,
    Apsis,
    Conjunction,
    LongitudeConjunction,
    Opposition,
    Elongation,
    Appulse,
    Eclipse,
    Dark,
}

/// No class of events has this name.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("events '{0}' are unknown; give some of {names}, or all", names = names())]
pub struct UnknownClass(pub String);

impl Class {
    pub const ALL: [Class; 15] = [
        Class::Rise,
        Class::Set,
        Class::Transit,
        Class::LowerTransit,
        Class::Twilight,
        Class::Phase,
        Class::Season,
        Class::Apsis,
        Class::Conjunction,
        Class::LongitudeConjunction,
        Class::Opposition,
        Class::Elongation,
        Class::Appulse,
        Class::Eclipse,
        Class::Dark,
    ];

    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Class::Rise => "rise",
            Class::Set => "set",
            Class::Transit => "transit",
            Class::LowerTransit => "lower-transit",
            Class::Twilight => "twilight",
            Class::Phase => "phases",
            Class::Season => "seasons",
            Class::Apsis => "apsides",
            Class::Conjunction => "conjunctions",
            Class::LongitudeConjunction => "longitude-conjunctions",
            Class::Opposition => "oppositions",
            Class::Elongation => "elongations",
            Class::Appulse => "appulses",
            Class::Eclipse => "eclipses",
            Class::Dark => "dark",
        }
    }

    /// Whether it depends on where one stands.
    pub const fn is_local(self) -> bool {
        matches!(
            self,
            Class::Rise
                | Class::Set
                | Class::Transit
                | Class::LowerTransit
                | Class::Twilight
                | Class::Dark
        )
    }
}

fn names() -> String {
    Class::ALL.map(Class::name).join(", ")
}

impl FromStr for Class {
    type Err = UnknownClass;
    /// The name, in any case, with or without the plural.
    fn from_str(text: &str) -> Result<Class, UnknownClass> {
        let plain = |name: &str| name.trim().to_lowercase().trim_end_matches('s').to_owned();
        Class::ALL
            .into_iter()
            .find(|class| plain(class.name()) == plain(text))
            .ok_or_else(|| UnknownClass(text.trim().to_owned()))
    }
}

impl Target {
    /// The name of a body; of a star its name, else its designation, else its number.
    pub fn name(&self) -> String {
        match self {
            Target::Body(body) => body.name().to_owned(),
            Target::Star(star) => star
                .name
                .clone()
                .or_else(|| star.designation.clone())
                .unwrap_or_else(|| format!("HR {}", star.hr)),
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.name())
    }
}

impl Twilight {
    pub const ALL: [Twilight; 3] = [Twilight::Civil, Twilight::Nautical, Twilight::Astronomical];

    /// Altitude of the centre of the Sun at its edge.
    pub const fn sun_altitude(self) -> Angle {
        match self {
            Twilight::Civil => Angle::from_deg(-6.0),
            Twilight::Nautical => Angle::from_deg(-12.0),
            Twilight::Astronomical => Angle::from_deg(-18.0),
        }
    }
}

impl What {
    /// The class under which it is asked for.
    pub const fn class(&self) -> Class {
        match self {
            What::Rise { .. } => Class::Rise,
            What::Set { .. } => Class::Set,
            What::Transit { meridian: Meridian::Upper, .. } => Class::Transit,
            What::Transit { meridian: Meridian::Lower, .. } => Class::LowerTransit,
            What::Twilight { .. } => Class::Twilight,
            What::MoonPhase(_) => Class::Phase,
            What::Season(_) => Class::Season,
            What::Apsis { .. } => Class::Apsis,
            What::Conjunction { coordinate: Coordinate::RightAscension, .. } => Class::Conjunction,
            What::Conjunction { coordinate: Coordinate::EclipticLongitude, .. } => {
                Class::LongitudeConjunction
            }
            What::SolarConjunction { .. } => Class::Conjunction,
            What::Opposition { .. } => Class::Opposition,
            What::GreatestElongation { .. } => Class::Elongation,
            What::Appulse { .. } => Class::Appulse,
            What::LunarEclipse { .. }
            | What::SolarEclipse { .. }
            | What::SolarEclipseHere { .. }
            | What::EclipseContact { .. } => Class::Eclipse,
            What::Dark { .. } => Class::Dark,
        }
    }

    /// One word for machines, such as `rise`, `civil-dawn`, `full-moon`.
    pub const fn code(&self) -> &'static str {
        match self {
            What::Rise { .. } => "rise",
            What::Set { .. } => "set",
            What::Transit { meridian: Meridian::Upper, .. } => "transit",
            What::Transit { meridian: Meridian::Lower, .. } => "lower-transit",
            What::Twilight { twilight, edge, .. } => match (twilight, edge) {
                (Twilight::Civil, Edge::Dawn) => "civil-dawn",
                (Twilight::Civil, Edge::Dusk) => "civil-dusk",
                (Twilight::Nautical, Edge::Dawn) => "nautical-dawn",
                (Twilight::Nautical, Edge::Dusk) => "nautical-dusk",
                (Twilight::Astronomical, Edge::Dawn) => "astronomical-dawn",
                (Twilight::Astronomical, Edge::Dusk) => "astronomical-dusk",
            },
            What::MoonPhase(Quarter::New) => "new-moon",
            What::MoonPhase(Quarter::First) => "first-quarter",
            What::MoonPhase(Quarter::Full) => "full-moon",
            What::MoonPhase(Quarter::Last) => "last-quarter",
            What::Season(Season::MarchEquinox) => "march-equinox",
            What::Season(Season::JuneSolstice) => "june-solstice",
            What::Season(Season::SeptemberEquinox) => "september-equinox",
            What::Season(Season::DecemberSolstice) => "december-solstice",
            What::Apsis { apsis: Apsis::Perihelion, .. } => "perihelion",
            What::Apsis { apsis: Apsis::Aphelion, .. } => "aphelion",
            What::Apsis { apsis: Apsis::Perigee, .. } => "perigee",
            What::Apsis { apsis: Apsis::Apogee, .. } => "apogee",
            What::Conjunction { coordinate: Coordinate::RightAscension, .. } => "conjunction-ra",
            What::Conjunction { coordinate: Coordinate::EclipticLongitude, .. } => {
                "conjunction-longitude"
            }
            What::SolarConjunction { side: Side::Inferior, .. } => "inferior-conjunction",
            What::SolarConjunction { side: Side::Superior, .. } => "superior-conjunction",
            What::SolarConjunction { side: Side::Outer, .. } => "solar-conjunction",
            What::Opposition { .. } => "opposition",
            What::GreatestElongation { is_east: true, .. } => "greatest-elongation-east",
            What::GreatestElongation { is_east: false, .. } => "greatest-elongation-west",
            What::Appulse { .. } => "appulse",
            What::LunarEclipse { kind, .. } => match kind {
                LunarKind::Penumbral => "penumbral-lunar-eclipse",
                LunarKind::Partial => "partial-lunar-eclipse",
                LunarKind::Total => "total-lunar-eclipse",
            },
            What::SolarEclipse { kind, .. } => match kind {
                SolarKind::Partial => "partial-solar-eclipse",
                SolarKind::Annular => "annular-solar-eclipse",
                SolarKind::Total => "total-solar-eclipse",
                SolarKind::Hybrid => "hybrid-solar-eclipse",
            },
            What::SolarEclipseHere { kind, .. } => match kind {
                Cover::Partial => "partial-solar-eclipse-here",
                Cover::Annular => "annular-solar-eclipse-here",
                Cover::Total => "total-solar-eclipse-here",
            },
            What::EclipseContact { contact, .. } => contact.code(),
            What::Dark { .. } => "dark",
        }
    }

    /// Whom it happens to.
    pub fn targets(&self) -> Vec<Target> {
        match self {
            What::Rise { target, .. } | What::Set { target, .. } | What::Transit { target, .. } => {
                vec![target.clone()]
            }
            What::Twilight { .. } | What::Season(_) => vec![Target::Body(Body::Sun)],
            What::MoonPhase(_) | What::LunarEclipse { .. } => vec![Target::Body(Body::Moon)],
            What::SolarEclipse { .. } | What::SolarEclipseHere { .. } => {
                vec![Target::Body(Body::Sun)]
            }
            What::EclipseContact { contact, .. } => vec![Target::Body(contact.eclipsed())],
            What::Apsis { apsis: Apsis::Perihelion | Apsis::Aphelion, .. } => {
                vec![Target::Body(Body::Sun)]
            }
            What::Apsis { apsis: Apsis::Perigee | Apsis::Apogee, .. } => {
                vec![Target::Body(Body::Moon)]
            }
            What::Conjunction { of, .. } | What::Appulse { of, .. } => of.to_vec(),
            What::SolarConjunction { planet, .. }
            | What::Opposition { planet, .. }
            | What::GreatestElongation { planet, .. } => {
                vec![Target::Body(*planet), Target::Body(Body::Sun)]
            }
            What::Dark { .. } => vec![Target::Body(Body::Sun), Target::Body(Body::Moon)],
        }
    }

    pub fn azimuth(&self) -> Option<Angle> {
        match self {
            What::Rise { azimuth, .. }
            | What::Set { azimuth, .. }
            | What::Transit { azimuth, .. }
            | What::Twilight { azimuth, .. } => Some(*azimuth),
            _ => self.view().map(|view| view.azimuth),
        }
    }

    pub fn altitude(&self) -> Option<Angle> {
        match self {
            What::Transit { altitude, .. } => Some(*altitude),
            _ => self.view().map(|view| view.altitude),
        }
    }

    /// Angle between the two whom it happens to.
    pub fn separation(&self) -> Option<Angle> {
        match self {
            What::Conjunction { offset, .. } | What::SolarConjunction { offset, .. } => {
                Some(offset.abs())
            }
            What::Opposition { separation, .. } | What::Appulse { separation, .. } => {
                Some(*separation)
            }
            What::GreatestElongation { elongation, .. } => Some(*elongation),
            _ => None,
        }
    }

    pub fn distance_km(&self) -> Option<f64> {
        match self {
            What::Apsis { distance_km, .. } => Some(*distance_km),
            _ => None,
        }
    }

    /// Of an eclipse: part of the diameter that is covered, or within the shadow (the umbra, if the
    /// Moon reaches it).
    pub fn magnitude(&self) -> Option<f64> {
        match self {
            What::LunarEclipse { kind: LunarKind::Penumbral, penumbral_magnitude, .. } => {
                Some(*penumbral_magnitude)
            }
            What::LunarEclipse { umbral_magnitude, .. } => Some(*umbral_magnitude),
            What::SolarEclipse { magnitude, .. } | What::SolarEclipseHere { magnitude, .. } => {
                Some(*magnitude)
            }
            _ => None,
        }
    }

    /// Part of the disc of the Sun that is covered.
    pub fn obscuration(&self) -> Option<f64> {
        match self {
            What::SolarEclipse { obscuration, .. } | What::SolarEclipseHere { obscuration, .. } => {
                Some(*obscuration)
            }
            _ => None,
        }
    }

    /// Where what is eclipsed stands.
    fn view(&self) -> Option<View> {
        match self {
            What::LunarEclipse { view, .. } | What::EclipseContact { view, .. } => *view,
            What::SolarEclipseHere { view, .. } => Some(*view),
            _ => None,
        }
    }

    /// When it is over, if it lasts.
    pub fn end(&self) -> Option<&Instant> {
        match self {
            What::Dark { end } => Some(end),
            _ => None,
        }
    }
}

impl Contact {
    /// Its name in canons, after whom it is about.
    pub const fn code(self) -> &'static str {
        match self {
            Contact::P1 => "lunar-eclipse-p1",
            Contact::U1 => "lunar-eclipse-u1",
            Contact::U2 => "lunar-eclipse-u2",
            Contact::U3 => "lunar-eclipse-u3",
            Contact::U4 => "lunar-eclipse-u4",
            Contact::P4 => "lunar-eclipse-p4",
            Contact::C1 => "solar-eclipse-c1",
            Contact::C2 => "solar-eclipse-c2",
            Contact::C3 => "solar-eclipse-c3",
            Contact::C4 => "solar-eclipse-c4",
        }
    }

    pub const fn eclipsed(self) -> Body {
        match self {
            Contact::C1 | Contact::C2 | Contact::C3 | Contact::C4 => Body::Sun,
            _ => Body::Moon,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Contact::P1 => "Moon touches the penumbra (P1)",
            Contact::U1 => "Moon touches the umbra (U1)",
            Contact::U2 => "Moon is wholly in the umbra (U2)",
            Contact::U3 => "Moon begins to leave the umbra (U3)",
            Contact::U4 => "Moon has left the umbra (U4)",
            Contact::P4 => "Moon has left the penumbra (P4)",
            Contact::C1 => "Moon touches the Sun (C1)",
            Contact::C2 => "Moon is wholly before the Sun (C2)",
            Contact::C3 => "Moon begins to leave the Sun (C3)",
            Contact::C4 => "Moon has left the Sun (C4)",
        }
    }
}

/// What happens, in a few words: `Mars rises`, `Full Moon`, `Venus 1.2° north of Jupiter`.
impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            What::Rise { target, .. } => write!(f, "{target} rises"),
            What::Set { target, .. } => write!(f, "{target} sets"),
            What::Transit { target, meridian: Meridian::Upper, .. } => {
                write!(f, "{target} on the meridian")
            }
            What::Transit { target, meridian: Meridian::Lower, .. } => {
                write!(f, "{target} on the lower meridian")
            }
            What::Twilight { twilight, edge, .. } => {
                let edge = match edge {
                    Edge::Dawn => "dawn",
                    Edge::Dusk => "dusk",
                };
                match twilight {
                    Twilight::Civil => write!(f, "Civil {edge}"),
                    Twilight::Nautical => write!(f, "Nautical {edge}"),
                    Twilight::Astronomical => write!(f, "Astronomical {edge}"),
                }
            }
            What::MoonPhase(Quarter::New) => f.write_str("New Moon"),
            What::MoonPhase(Quarter::First) => f.write_str("Moon at first quarter"),
            What::MoonPhase(Quarter::Full) => f.write_str("Full Moon"),
            What::MoonPhase(Quarter::Last) => f.write_str("Moon at last quarter"),
            What::Season(Season::MarchEquinox) => f.write_str("March equinox"),
            What::Season(Season::JuneSolstice) => f.write_str("June solstice"),
            What::Season(Season::SeptemberEquinox) => f.write_str("September equinox"),
            What::Season(Season::DecemberSolstice) => f.write_str("December solstice"),
            What::Apsis { apsis: Apsis::Perihelion, .. } => f.write_str("Earth at perihelion"),
            What::Apsis { apsis: Apsis::Aphelion, .. } => f.write_str("Earth at aphelion"),
            What::Apsis { apsis: Apsis::Perigee, .. } => f.write_str("Moon at perigee"),
            What::Apsis { apsis: Apsis::Apogee, .. } => f.write_str("Moon at apogee"),
            What::Conjunction { of: [first, second], coordinate, offset } => {
                write!(f, "{first} {} of {second}", North(*offset))?;
                match coordinate {
                    Coordinate::RightAscension => Ok(()),
                    Coordinate::EclipticLongitude => f.write_str(" in ecliptic longitude"),
                }
            }
            What::SolarConjunction { planet, side, offset } => {
                let side = match side {
                    Side::Inferior => "inferior conjunction",
                    Side::Superior => "superior conjunction",
                    Side::Outer => "conjunction",
                };
                write!(f, "{planet} in {side}, {} of the Sun", North(*offset))
            }
            What::Opposition { planet, .. } => write!(f, "{planet} in opposition"),
            What::GreatestElongation { planet, elongation, is_east } => {
                let side = if *is_east { "east" } else { "west" };
                let deg = elongation.deg();
                write!(f, "{planet} at greatest elongation, {deg:.1}° {side} of the Sun")
            }
            What::Appulse { of: [first, second], separation } => {
                write!(f, "{first} nearest to {second}, {} away", Short(*separation))
            }
            What::LunarEclipse { kind, .. } => write!(f, "Greatest eclipse of the Moon, {kind}"),
            What::SolarEclipse { kind, .. } => write!(f, "Greatest eclipse of the Sun, {kind}"),
            What::SolarEclipseHere { kind, .. } => {
                let kind = match kind {
                    Cover::Partial => "partial",
                    Cover::Annular => "annular",
                    Cover::Total => "total",
                };
                write!(f, "Eclipse of the Sun here, {kind}")
            }
            What::EclipseContact { contact, .. } => f.write_str(contact.words()),
            What::Dark { .. } => f.write_str("Dark, Sun and Moon down"),
        }
    }
}

/// `1.2° north`, `12' south`.
struct North(Angle);

impl fmt::Display for North {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let wind = if self.0 < Angle::ZERO { "south" } else { "north" };
        write!(f, "{} {wind}", Short(self.0.abs()))
    }
}

/// Degrees, or minutes of arc where it is less than one.
struct Short(Angle);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        // 59.95' would be shown as 60.0'.
        match self.0.arcmin() {
            arcmin if arcmin < 59.95 => write!(f, "{arcmin:.1}'"),
            arcmin => write!(f, "{:.1}°", arcmin / 60.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_are_read_back_in_any_number() {
        for class in Class::ALL {
            assert_eq!(class.name().to_uppercase().parse(), Ok(class));
        }
        assert_eq!("conjunction".parse(), Ok(Class::Conjunction));
        assert_eq!("twilights".parse(), Ok(Class::Twilight));
        let message = "tides".parse::<Class>().unwrap_err().to_string();
        assert!(message.contains("'tides'") && message.contains("phases"), "{message}");
    }

    #[test]
    fn what_happens_is_said_in_a_few_words() {
        let [moon, mars] = [Body::Moon, Body::Mars].map(Target::Body);
        let of = [moon, mars];
        let coordinate = Coordinate::RightAscension;
        let offset = Angle::from_deg(-1.26);
        let what = What::Conjunction { of: of.clone(), coordinate, offset };
        assert_eq!(what.to_string(), "Moon 1.3° south of Mars");
        assert!((what.separation().unwrap().deg() - 1.26).abs() < 1e-12);
        let what = What::Appulse { of, separation: Angle::from_arcmin(6.14) };
        assert_eq!(what.to_string(), "Moon nearest to Mars, 6.1' away");
    }
}
