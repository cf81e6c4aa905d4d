//! What an almanac lists: events, and what is said of each.

mod class;
mod words;

use std::fmt;
use std::sync::Arc;

use super::eclipse::{Cover, LunarKind, SolarKind};
use crate::catalog::Star;
use crate::ephemeris::Body;
use crate::time::Instant;
use crate::units::Angle;

pub use class::{Class, UnknownClass};

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
    /// Greatest eclipse of the Moon; magnitudes are parts of her diameter. With a place, where she
    /// stands there.
    LunarEclipse {
        kind: LunarKind,
        umbral_magnitude: f64,
        penumbral_magnitude: f64,
        view: Option<View>,
    },
    /// Greatest eclipse of the Sun, and where on the Earth that is: magnitude and obscuration are the
    /// parts of his diameter and of his disc that are covered there.
    SolarEclipse {
        kind: SolarKind,
        magnitude: f64,
        obscuration: f64,
        latitude: Angle,
        longitude: Angle,
    },
    /// The most of an eclipse of the Sun that is seen at the place.
    SolarEclipseHere {
        kind: Cover,
        magnitude: f64,
        obscuration: f64,
        view: View,
    },
    /// A phase of an eclipse begins or ends: of the Moon anywhere, of the Sun at the place.
    EclipseContact {
        contact: Contact,
        view: Option<View>,
    },
    /// Sun and Moon both stay down until `end`; cut where the time asked for begins or ends.
    Dark {
        end: Instant,
    },
}

/// Where something stands in the sky of a place: topocentric, airless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    pub azimuth: Angle,
    pub altitude: Angle,
}

/// Contacts of eclipses, in the order of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// The Moon touches the penumbra.
    P1,
    /// The Moon touches the umbra.
    U1,
    /// The Moon is wholly in the umbra.
    U2,
    U3,
    U4,
    P4,
    /// The Moon touches the Sun.
    C1,
    /// The total or annular phase begins.
    C2,
    C3,
    C4,
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
