//! Which country a time zone belongs to.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::fold::folded;

/// Folded names and code of the country of each time zone (`catalogs/place/zone_countries.csv`).
static NAMES_BY_ZONE: LazyLock<HashMap<&str, Vec<String>>> = LazyLock::new(|| {
    let table = include_str!("../../../catalogs/place/zone_countries.csv");
    let row = |line: &'static str| {
        let mut fields = line.split(',');
        let (zone, code, names) = (fields.next()?, fields.next()?, fields.next()?);
        Some((zone, names.split('|').chain([code]).map(folded).collect()))
    };
    table.lines().filter(|line| !line.starts_with('#')).filter_map(row).collect()
});

/// Whether the country of a time zone goes by this folded name or code.
pub(super) fn is_named(zone: &str, name: &str) -> bool {
    NAMES_BY_ZONE.get(zone).is_some_and(|names| names.iter().any(|known| known == name))
}

/// The country of a time zone, as the table writes it.
pub(super) fn name(zone: &str) -> Option<&'static str> {
    static NAME_BY_ZONE: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| {
        let table = include_str!("../../../catalogs/place/zone_countries.csv");
        let row = |line: &'static str| {
            let mut fields = line.split(',');
            let (zone, _, names) = (fields.next()?, fields.next()?, fields.next()?);
            Some((zone, names.split('|').next()?))
        };
        table.lines().filter(|line| !line.starts_with('#')).filter_map(row).collect()
    });
    NAME_BY_ZONE.get(zone).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_know_their_countries() {
        for (zone, name) in [
            ("Europe/Paris", "france"),
            ("Europe/London", "uk"),
            ("Asia/Seoul", "south korea"),
            ("America/Phoenix", "us"),
            ("Europe/Kiev", "ukraine"),
            ("America/Curacao", "curacao"),
        ] {
            assert!(is_named(zone, name), "{zone}");
        }
        assert!(!is_named("Europe/Paris", "germany"));
        assert!(!is_named("Mars/Olympus", "france"));
    }

    #[test]
    fn every_zone_of_the_table_is_a_time_zone() {
        // "timezone" is the head of its column.
        let unknown: Vec<_> = NAMES_BY_ZONE
            .keys()
            .filter(|zone| zone.parse::<chrono_tz::Tz>().is_err() && **zone != "timezone")
            .collect();
        assert!(unknown.is_empty(), "{unknown:?}");
        assert!(NAMES_BY_ZONE.len() > 420);
    }
}
