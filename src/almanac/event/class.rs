//! Classes of events: what can be asked for.

use std::str::FromStr;

use thiserror::Error;

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
}
