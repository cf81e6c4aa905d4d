//! Names that people write, and what they mean: bodies and stars.

use std::collections::HashMap;

use crate::catalog::{CatalogError, Catalogs};
use crate::cli::error::CliError;
use crate::ephemeris::Body;
use crate::ephemeris::stars::SpaceMotion;

/// Longer than any name.
const LONGEST: usize = 64;

/// What a row is about: a body with a theory, or a star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    Body(Body),
    Star(SpaceMotion),
}

/// The stars by all their names, in lower case.
pub struct Names {
    stars: HashMap<String, SpaceMotion>,
}

impl Names {
    /// Name, designation, HR and HIP of the catalogue; what is known to the milliarcsecond comes
    /// before it.
    pub fn read(catalogs: &Catalogs) -> Result<Names, CatalogError> {
        let mut stars = HashMap::new();
        let astrometry = catalogs.astrometry()?;
        for star in &astrometry {
            let motion = SpaceMotion::from(star);
            stars.insert(format!("hip {}", star.hip), motion);
            stars.extend(star.names.iter().map(|name| (name.to_lowercase(), motion)));
        }
        for star in &catalogs.stars()? {
            let precise = astrometry.iter().find(|precise| Some(precise.hip) == star.hip);
            let motion = precise.map_or_else(|| SpaceMotion::from(star), SpaceMotion::from);
            let names = [
                star.name.as_ref().map(|name| name.to_lowercase()),
                star.designation.as_ref().map(|name| name.to_lowercase()),
                star.hip.map(|hip| format!("hip {hip}")),
                Some(format!("hr {}", star.hr)),
            ];
            for name in names.into_iter().flatten() {
                stars.entry(name).or_insert(motion);
            }
        }
        Ok(Names { stars })
    }

    /// What a name means, in any case; "HR2491" is "HR 2491".
    pub fn find(&self, name: &str) -> Option<Target> {
        if let Some(body) = body(name) {
            return Some(Target::Body(body));
        }
        if name.len() > LONGEST {
            return None;
        }
        // Where no letter is foreign, nothing has to be put into memory.
        let mut buffer = [0; LONGEST];
        let lower = &mut buffer[..name.len()];
        lower.copy_from_slice(name.as_bytes());
        lower.make_ascii_lowercase();
        let star = std::str::from_utf8(lower).ok().and_then(|lower| self.stars.get(lower));
        star.or_else(|| self.stars.get(&spelt(name))).copied().map(Target::Star)
    }

    /// The meaning of a list with commas; `all` is every body.
    pub fn list<'a>(&self, list: &'a str) -> Result<Vec<(&'a str, Target)>, CliError> {
        let mut targets = Vec::new();
        for name in list.split(',').map(str::trim) {
            if name.eq_ignore_ascii_case("all") {
                targets.extend(Body::ALL.map(|body| (body.name(), Target::Body(body))));
            } else {
                let target = self.find(name).ok_or_else(|| CliError::Usage(unknown(name)))?;
                targets.push((name, target));
            }
        }
        Ok(targets)
    }
}

/// A sentence about a name that means nothing.
pub fn unknown(name: &str) -> String {
    let name: String = name.chars().take(LONGEST).collect();
    format!(
        "nothing is called '{name}'; give the Sun, the Moon, a planet, or a star by its name, \
         designation or number, as `nocturne objects` lists them"
    )
}

fn body(name: &str) -> Option<Body> {
    Body::ALL.into_iter().find(|body| body.name().eq_ignore_ascii_case(name))
}

/// In lower case whatever the alphabet, with one blank before the number of a catalogue.
fn spelt(name: &str) -> String {
    let lower = name.to_lowercase();
    let words: Vec<&str> = lower.split_whitespace().collect();
    let plain = words.join(" ");
    for catalogue in ["hr", "hip"] {
        if let Some(number) = plain.strip_prefix(catalogue)
            && number.starts_with(|c: char| c.is_ascii_digit())
        {
            return format!("{catalogue} {number}");
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names() -> Names {
        Names::read(&Catalogs::locate(None).unwrap()).unwrap()
    }

    #[test]
    fn a_star_answers_to_all_its_names() {
        let names = names();
        let vega = names.find("Vega").unwrap();
        for name in ["VEGA", "α Lyr", "Α LYR", "HR 7001", "hr7001", "HIP 91262", " vega "] {
            assert_eq!(names.find(name), Some(vega), "{name}");
        }
        for name in ["", "Veg", "HR", "HR 0", "HR 9999", "Vulcan", &"x".repeat(1000)] {
            assert_eq!(names.find(name), None, "{name}");
        }
    }

    #[test]
    fn the_best_astrometry_is_taken_under_every_name() {
        let names = names();
        let sirius = Catalogs::locate(None).unwrap().astrometry().unwrap()[0].clone();
        let sirius = Some(Target::Star(SpaceMotion::from(&sirius)));
        for name in ["sirius", "α CMa", "HR 2491", "HIP 32349"] {
            assert_eq!(names.find(name), sirius, "{name}");
        }
        assert_eq!(names.find("barnard"), names.find("Barnard's Star"));
        assert!(names.find("barnard").is_some());
    }

    #[test]
    fn lists_keep_their_order_and_say_what_is_wrong() {
        let names = names();
        let list = names.list("Moon, all,hr 1").unwrap();
        assert_eq!(list.len(), 12);
        assert_eq!((list[0].0, list[1].0, list[11].0), ("Moon", "Sun", "hr 1"));
        for (wrong, said) in [("Mars,Vulcan", "'Vulcan'"), ("", "''"), ("Mars,", "''")] {
            let message = names.list(wrong).unwrap_err().message().unwrap();
            assert!(message.contains(said), "{message}");
        }
    }
}
