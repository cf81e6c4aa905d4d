//! `hipparcos.csv`: stars whose places are wanted to the milliarcsecond.

use std::str::FromStr;

use super::csv::{RowError, rows};
use crate::frame::{Dir, Icrs};
use crate::units::Angle;

const COLUMNS: &str =
    "name,also,hip,ra_deg,dec_deg,parallax_mas,pm_ra_mas_yr,pm_dec_mas_yr,radial_velocity_km_s";

/// A star of the Hipparcos catalogue (ESA 1997, SP-1200), at its epoch J1991.25.
#[derive(Debug, Clone, PartialEq)]
pub struct Astrometry {
    /// What people call it; at least one name.
    pub names: Vec<String>,
    /// Number in the Hipparcos catalogue.
    pub hip: u32,
    /// Direction from the barycentre of the solar system at J1991.25.
    pub dir_j1991_25: Dir<Icrs>,
    /// Proper motion in right ascension times the cosine of declination, arcseconds a year.
    pub proper_motion_ra_arcsec_yr: f64,
    /// Proper motion in declination, arcseconds a year.
    pub proper_motion_dec_arcsec_yr: f64,
    /// Annual parallax, arcseconds.
    pub parallax_arcsec: f64,
    /// Radial velocity, kilometres per second, positive away from us.
    pub radial_velocity_km_s: f64,
}

/// The stars of the file; an error says in which line what is wrong.
pub(super) fn parse(text: &str) -> Result<Vec<Astrometry>, RowError> {
    let stars = rows(text, COLUMNS)?.into_iter().map(|(line, fields)| {
        let fields: Vec<&str> = fields.iter().map(AsRef::as_ref).collect();
        astrometry(&fields).map_err(|what| (line, what))
    });
    stars.collect()
}

fn astrometry(fields: &[&str]) -> Result<Astrometry, String> {
    let &[name, also, hip, ra, dec, parallax, motion_ra, motion_dec, velocity] = fields else {
        return Err("the columns are not those of the head".into());
    };
    if name.is_empty() {
        return Err("a star has no name".into());
    }
    let (ra_deg, dec_deg): (f64, f64) = (number(ra)?, number(dec)?);
    if !(0.0..360.0).contains(&ra_deg) || !(-90.0..=90.0).contains(&dec_deg) {
        return Err(format!("{ra_deg}, {dec_deg} is no place in the sky"));
    }
    let arcsec = |mas: &str| number::<f64>(mas).map(|mas| mas / 1000.0);
    Ok(Astrometry {
        names: [name, also].into_iter().filter(|n| !n.is_empty()).map(str::to_owned).collect(),
        hip: number(hip)?,
        dir_j1991_25: Dir::from_spherical(Angle::from_deg(ra_deg), Angle::from_deg(dec_deg)),
        proper_motion_ra_arcsec_yr: arcsec(motion_ra)?,
        proper_motion_dec_arcsec_yr: arcsec(motion_dec)?,
        parallax_arcsec: arcsec(parallax)?,
        radial_velocity_km_s: number(velocity)?,
    })
}

fn number<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{text:?} is not a number"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_star() {
        let line = "Barnard,Barnard's Star,87937,269.5,4.5,549.01,-797.84,10326.93,-110.6";
        let stars = parse(&format!("{COLUMNS}\n{line}\n")).unwrap();
        let [star] = &stars[..] else { panic!("{stars:?}") };
        assert_eq!((star.names.len(), star.hip), (2, 87_937));
        assert!((star.dir_j1991_25.longitude().deg() - 269.5).abs() < 1e-12);
        assert!((star.dir_j1991_25.latitude().deg() - 4.5).abs() < 1e-12);
        assert_eq!((star.parallax_arcsec, star.radial_velocity_km_s), (0.549_01, -110.6));
        let motion = (star.proper_motion_ra_arcsec_yr, star.proper_motion_dec_arcsec_yr);
        assert_eq!(motion, (-0.797_84, 10.326_93));
    }

    #[test]
    fn lines_that_are_no_stars_are_refused() {
        for wrong in
            ["X,,1,0,91,0,0,0,0", "X,,1,360,0,0,0,0,0", ",,1,0,0,0,0,0,0", "X,,1,0,0,0,0,0"]
        {
            assert_eq!(parse(&format!("{COLUMNS}\n{wrong}\n")).unwrap_err().0, 2, "{wrong}");
        }
        let message = parse(&format!("{COLUMNS}\nX,,1,0,0,near,0,0,0\n")).unwrap_err().1;
        assert!(message.contains("\"near\""), "{message}");
    }
}
