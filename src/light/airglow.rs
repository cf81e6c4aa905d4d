//! Airglow: the light that atoms and molecules of the high air give off at night.
//!
//! *Source.* PALACE v1.0, Noll et al. 2025, *Geosci. Model Dev.* 18, 4353 (CC BY 4.0), from ten years of
//! spectra of Paranal, 24.6 degrees south. From it come the lines of oxygen, at 557.7 nm from 97 km and
//! 630.0 and 636.4 nm from 250 km, and the continuum of HO2, FeO and O2 from 81 to 94 km, which stands
//! here at [`MESOPAUSE_KM`] with hydroxyl (OH) and sodium. Beyond 650 nm, where the table ends, the
//! continuum keeps its rayleighs per nanometre: between the lines of OH in the relative sky spectrum of
//! Paranal 3 to 6 are left when zodiacal light and stars are taken off.
//!
//! *Change.* For each kind PALACE has, by month and local solar time, a factor `f` of the mean at a solar
//! radio flux of 100 sfu and its growth `m` by 100 sfu more: `f (1 + m (S - 100) / 100)`. (That `m` is
//! relative is read from the table: added to `f` it would darken the red lines below nothing.) It was
//! measured from 67 to 166 sfu; the law is drawn out to [`FLUX_RANGE_SFU`]. Months are mixed straight
//! from middle to middle, hours too; by day the hour nearest to it stands.
//!
//! *Hydroxyl.* What stands above the continuum in the relative sky spectrum of Paranal, its oxygen line
//! at 557.7 nm taken for 200 R: what PALACE gives it for the winter of 2001 (some 150 sfu), when that
//! spectrum was likely taken (recalled). The bands then have, in rayleighs, 8-2 25, 5-0 19, 9-3 53, 6-1
//! 106, 7-2 116, 8-3 349, 4-0 with 9-4 520, 5-1 530, and 6-2, at the end of the grid, 905; measurements
//! of others lie within a third (recalled). Sodium has 40 R (recalled). Both get 10 % brighter by
//! 100 sfu and keep still by season and hour, which in truth change them by a quarter.
//!
//! *Left out.* Latitude: north of the equator the months are those half a year on, between 10 degrees
//! south and north the mean of both, and nothing else differs; in truth the red lines are brightest
//! within 20 degrees of the magnetic equator and aurora begins poleward of 60. Waves and clouds of the
//! glow, and what differs from night to night: 30 % in the continuum, 40 % in the green line, 80 % in
//! the red ones. N 520 nm, K, the bands of O2 in the violet as single lines.
//!
//! *Accuracy.* In V the zenith has 131 S10 at 80 sfu, 153 at 130 and 184 at 200; the law of Roach &
//! Gordon as it is usually quoted, 145 + 130 (S - 0.8) / 1.2 in hundreds of sfu, has 145, 199 and 275,
//! and grows faster with the Sun than PALACE found. With zodiacal light and 30 S10 of starlight 180 sfu
//! give V 21.56, B 22.70, R 20.83, where Patat 2003 measured 21.61, 22.64, 20.87 at Paranal near the
//! Sun's maximum. All before the air takes its part, a few hundredths of a magnitude in V.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::light::spectrum::{Spectrum, shipped_column};
use crate::units::Angle;

const CONTINUUM: &str = include_str!("../../catalogs/night/airglow_palace_continuum.csv");
const CLIMATOLOGY: &str = include_str!("../../catalogs/night/airglow_palace_climatology.csv");
const HYDROXYL: &str = include_str!("../../catalogs/night/airglow_hydroxyl.csv");

/// Height of the layer of hydroxyl, sodium and the continuum.
pub const MESOPAUSE_KM: f64 = 88.0;
/// Height of the green line of oxygen.
pub const GREEN_KM: f64 = 97.0;
/// Height of the red lines of oxygen.
pub const RED_KM: f64 = 250.0;
/// Fluxes outside are brought to the end.
pub const FLUX_RANGE_SFU: [f64; 2] = [60.0, 250.0];

/// Lines of oxygen at 100 sfu: nanometres in air, rayleighs.
const GREEN: (f64, f64) = (557.73, 162.67);
const RED: [(f64, f64); 2] = [(630.03, 122.67), (636.38, 41.05)];
/// Lines of sodium, in the ratio 2 to 1.
const SODIUM: [(f64, f64); 2] = [(589.0, 26.7), (589.6, 13.3)];
/// Relative growth of hydroxyl and sodium by 100 sfu.
const HYDROXYL_GROWTH: f64 = 0.1;
/// Flux when the spectrum was taken that hydroxyl is from.
const HYDROXYL_FLUX_SFU: f64 = 150.0;

/// When and where airglow is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirglowConditions {
    /// Radio flux of the Sun at 10.7 cm, in 1e-22 W m-2 Hz-1: 65 to 250, see
    /// [`crate::light::solar_cycle`].
    pub solar_flux_sfu: f64,
    /// Months since the year began, 0 to 12; NaN for the mean of all nights.
    pub month: f64,
    /// Local solar time in hours, 0 at midnight; NaN for the mean of all nights.
    pub local_time_h: f64,
    /// Geographic latitude, north positive.
    pub latitude: Angle,
}

impl AirglowConditions {
    /// The mean of all dark hours of the year, at any latitude.
    pub const fn mean(solar_flux_sfu: f64) -> Self {
        AirglowConditions {
            solar_flux_sfu,
            month: f64::NAN,
            local_time_h: f64::NAN,
            latitude: Angle::ZERO,
        }
    }
}

/// A thin glowing layer.
#[derive(Debug, Clone, PartialEq)]
pub struct GlowLayer {
    /// Height above sea level.
    pub height_km: f64,
    /// Spectral radiance towards straight below, outside the air, W m-2 sr-1 nm-1.
    pub zenith: Spectrum,
}

/// Kinds of glow that change in their own ways, as PALACE lists them.
const KINDS: usize = 5;
const GREEN_KIND: usize = 3;
const RED_KIND: usize = 4;

/// An hour of a month.
#[derive(Debug, Clone, Copy, Default)]
struct Bin {
    /// Share of its nights in which it is dark.
    share: f64,
    /// Factor and relative growth by 100 sfu.
    kinds: [[f64; 2]; KINDS],
}

const MONTHS: usize = 12;
const HOURS: usize = 12;

static BINS: LazyLock<[[Bin; HOURS]; MONTHS]> = LazyLock::new(|| {
    let mut bins = [[Bin::default(); HOURS]; MONTHS];
    let lines = CLIMATOLOGY.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    for (bin, line) in bins.iter_mut().flatten().zip(lines) {
        let mut cells = line.split(',').skip(2).filter_map(|cell| cell.trim().parse().ok());
        bin.share = cells.next().unwrap_or_default();
        for value in bin.kinds.iter_mut().flatten() {
            *value = cells.next().unwrap_or_default();
        }
    }
    bins
});

/// What glows at 100 sfu: the three parts of the continuum, hydroxyl with sodium.
static PARTS: LazyLock<[Spectrum; 4]> = LazyLock::new(|| {
    let continuum = |column: usize| {
        let mut table = shipped_column(CONTINUUM, column);
        let last = table.last().map_or(0.0, |(_, rayleighs)| *rayleighs);
        table.extend([(700.0, last), (835.0, last)]);
        of_rayleighs(&table)
    };
    let hydroxyl = of_rayleighs(&shipped_column(HYDROXYL, 1));
    let now = 1.0 + HYDROXYL_GROWTH * (HYDROXYL_FLUX_SFU - 100.0) / 100.0;
    let sodium: Spectrum = SODIUM.iter().map(|(nm, rayleighs)| line(*nm, *rayleighs)).sum();
    [continuum(1), continuum(2), continuum(3), hydroxyl * now.recip() + sodium]
});

/// Radiance of a rayleigh at a wavelength, W m-2 sr-1: 1e10 / (4 pi) photons s-1 m-2 sr-1.
pub fn rayleigh_w_m2_sr(nm: f64) -> f64 {
    /// Planck constant times speed of light, joule nanometres (SI, exact).
    const PHOTON_J_NM: f64 = 1.986_445_857e-16;
    1e10 / (4.0 * PI) * PHOTON_J_NM / nm
}

fn line(nm: f64, rayleighs: f64) -> Spectrum {
    Spectrum::line(nm, rayleighs * rayleigh_w_m2_sr(nm))
}

/// From a table of wavelengths in nanometres and rayleighs per nanometre.
fn of_rayleighs(table: &[(f64, f64)]) -> Spectrum {
    let power = |row: &(f64, f64)| (row.0, row.1 * rayleigh_w_m2_sr(row.0));
    // Straight lines between far rows would cut the corner of 1 / wavelength by less than 1 %.
    Spectrum::from_table(&table.iter().map(power).collect::<Vec<_>>())
}

/// Factors of the kinds, 1 for the mean at 100 sfu.
fn factors(conditions: &AirglowConditions) -> [f64; KINDS] {
    let flux = conditions.solar_flux_sfu.clamp(FLUX_RANGE_SFU[0], FLUX_RANGE_SFU[1]);
    let more = if flux.is_finite() { (flux - 100.0) / 100.0 } else { 0.0 };
    // No hour of a month goes quite dark, however the law is drawn out.
    let of = |bin: &Bin| bin.kinds.map(|[factor, growth]| factor * (1.0 + growth * more).max(0.1));
    let mut sum = [0.0; KINDS];
    let mut add = |weight: f64, values: [f64; KINDS]| {
        sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
    };
    let (month, hour) = (conditions.month, conditions.local_time_h);
    if !(month.is_finite() && hour.is_finite()) {
        let nights: f64 = BINS.iter().flatten().map(|bin| bin.share).sum();
        BINS.iter().flatten().for_each(|bin| add(bin.share / nights, of(bin)));
        return sum;
    }
    // Hours since 18, and for the day the end of night that is nearer.
    let since = (hour - 18.0).rem_euclid(24.0);
    let since = if since > 18.0 { 0.0 } else { since };
    let (early, late) = mixed(since, HOURS, false);
    let north = (0.5 + conditions.latitude.deg() / 20.0).clamp(0.0, 1.0);
    for (share, months) in [(1.0 - north, month), (north, month + 6.0)] {
        let (before, after) = mixed(months, MONTHS, true);
        for (m, in_month) in [before, after] {
            for (h, in_hour) in [early, late] {
                add(share * in_month * in_hour, of(&BINS[m][h]));
            }
        }
    }
    sum
}

/// The two bins whose middles a place lies between, with their shares; over the end, or up to it.
fn mixed(place: f64, bins: usize, round: bool) -> ((usize, f64), (usize, f64)) {
    let last = (bins - 1) as f64;
    let place =
        if round { (place - 0.5).rem_euclid(bins as f64) } else { (place - 0.5).clamp(0.0, last) };
    let before = (place as usize).min(bins - 1);
    let after = if round { (before + 1) % bins } else { (before + 1).min(bins - 1) };
    let share = place - before as f64;
    ((before, 1.0 - share), (after, share))
}

/// The layers that glow, by height. Before van Rhijn's factor, which
/// [`crate::air::scattering::above::glowing_layer`] has.
pub fn airglow(conditions: &AirglowConditions) -> Vec<GlowLayer> {
    let factors = factors(conditions);
    let flux = conditions.solar_flux_sfu.clamp(FLUX_RANGE_SFU[0], FLUX_RANGE_SFU[1]);
    let more = if flux.is_finite() { (flux - 100.0) / 100.0 } else { 0.0 };
    let [ho2, feo, o2, hydroxyl] = *PARTS;
    let low = ho2 * factors[0]
        + feo * factors[1]
        + o2 * factors[2]
        + hydroxyl * (1.0 + HYDROXYL_GROWTH * more);
    let green = line(GREEN.0, GREEN.1) * factors[GREEN_KIND];
    let red: Spectrum = RED.iter().map(|(nm, rayleighs)| line(*nm, *rayleighs)).sum();
    [(MESOPAUSE_KM, low), (GREEN_KM, green), (RED_KM, red * factors[RED_KIND])]
        .map(|(height_km, zenith)| GlowLayer { height_km, zenith })
        .to_vec()
}

/// The airglow of Jensen et al. 2001, *A Physically-Based Night Sky Model*, section 6.2: peaks at 557.7,
/// 583.0 and 630.0 nm that light the ground with 5.1e-8 W m-2, from 80 km.
///
/// As they print it. Sodium shines at 589, not 583 nm; the red line comes from 250 km; their text has
/// 110 km elsewhere. How the light is shared between the peaks they do not say: a third each, even over
/// the sky.
pub fn paper_airglow() -> Vec<GlowLayer> {
    let radiance = 5.1e-8 / PI;
    let zenith = [557.7, 583.0, 630.0].map(|nm| Spectrum::line(nm, radiance / 3.0));
    vec![GlowLayer { height_km: 80.0, zenith: zenith.into_iter().sum() }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::spectrum::interpolate;

    fn rayleighs(table: &[(f64, f64)], from_nm: f64, to_nm: f64) -> f64 {
        let steps = 1000;
        let width = (to_nm - from_nm) / f64::from(steps);
        (0..steps).map(|k| interpolate(table, from_nm + (f64::from(k) + 0.5) * width) * width).sum()
    }

    #[test]
    fn the_tables_are_whole() {
        let bins: Vec<&Bin> = BINS.iter().flatten().collect();
        assert!(bins.iter().all(|bin| bin.kinds.iter().all(|[factor, _]| *factor > 0.1)));
        let nights: f64 = bins.iter().map(|bin| bin.share).sum();
        for kind in 0..KINDS {
            let mean = bins.iter().map(|bin| bin.share * bin.kinds[kind][0]).sum::<f64>() / nights;
            assert!((mean - 1.0).abs() < 1e-3, "{kind}: {mean}");
        }
        let hydroxyl = shipped_column(HYDROXYL, 1);
        for (from_nm, to_nm, expected) in [
            (615.0, 624.0, 19.0),
            (624.0, 645.0, 53.0),
            (682.0, 706.0, 116.0),
            (723.0, 748.0, 349.0),
        ] {
            let got = rayleighs(&hydroxyl, from_nm, to_nm);
            assert!((got - expected).abs() < 3.0, "{from_nm}: {got}");
        }
    }

    #[test]
    fn it_changes_smoothly_around_the_year_and_through_the_night() {
        let at = |month: f64, local_time_h: f64| {
            factors(&AirglowConditions {
                solar_flux_sfu: 100.0,
                month,
                local_time_h,
                latitude: Angle::from_deg(-24.6),
            })
        };
        assert_eq!(at(0.0, 1.0), at(12.0, 25.0));
        for step in 0..1200 {
            let month = f64::from(step) * 0.01;
            let (a, b) = (at(month, 23.0), at(month + 0.01, 23.0));
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.02), "{month}");
            // From 13 h over midnight to 11 h.
            let hour = 13.0 + f64::from(step % 1100) * 0.02;
            let (a, b) = (at(4.3, hour), at(4.3, hour + 0.02));
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.03), "{hour}");
        }
        // The middle of April between 20 h and 21 h: the table itself.
        assert_eq!(at(3.5, 20.5)[GREEN_KIND], BINS[3][2].kinds[GREEN_KIND][0]);
        // Half a year on in the north.
        let north = AirglowConditions {
            solar_flux_sfu: 100.0,
            month: 9.5,
            local_time_h: 20.5,
            latitude: Angle::from_deg(40.0),
        };
        assert_eq!(factors(&north), at(3.5, 20.5));
    }
}
