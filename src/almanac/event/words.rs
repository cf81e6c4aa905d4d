//! What events are called: by machines, and in a few words by people.

use std::fmt;

use super::{
    Apsis, Class, Contact, Coordinate, Edge, Meridian, Quarter, Season, Side, Twilight, What,
};
use crate::almanac::eclipse::{Cover, LunarKind, SolarKind};
use crate::ephemeris::Body;
use crate::units::Angle;

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
            Contact::C2 => "Total or annular phase begins (C2)",
            Contact::C3 => "Total or annular phase ends (C3)",
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
    use crate::almanac::Target;

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
