//! Zodiacal light, the bridge along the ecliptic and the gegenschein: sunlight that dust between the
//! planets scatters.
//!
//! *Source.* Leinert et al. 1998, *A&AS* 127, 1, Table 17: radiance at 500 nm seen from the Earth, by
//! the difference of ecliptic longitude from the Sun and by ecliptic latitude, both without sign. The
//! spectrum is the Sun's, reddened by their Eq. 22.
//!
//! *Between the nodes.* The logarithm of the radiance is split into a law of the distance from the Sun
//! and a rest. The rest is a bicubic Hermite surface whose slopes at the nodes are those of Fritsch &
//! Carlson (monotone along the lines of the table): exact at the nodes, with a continuous slope
//! everywhere, the poles of the ecliptic and the Sun included. Between two neighbours of one line of
//! the table it leaves their range by less than 1 %.
//!
//! *Near the Sun* the table is blank. There the law holds: radiance goes as the -2.3rd power of a
//! distance whose circles are ellipses, 1.76 times as long as wide, so that 15 degrees away it is 3.7
//! times as bright in the ecliptic as across, as the table has it; the rest goes on evenly. The F
//! corona has the powers -2.25 along and -2.47 across (Koutchmy & Lamy 1985, recalled). Within 10 radii
//! of the Sun, where [`crate::light::corona`] has its light, it levels out: 4 % of that at 3 radii, 16 %
//! at 5.
//!
//! *Left out.* The tilt of the plane of the dust against the ecliptic with the distance of the Earth
//! from it (10 % over the year), dust bands, polarisation (up to 20 %), the change with the distance
//! of the Earth from the Sun (8 % over the year).
//!
//! *Accuracy.* That of the table, 10 to 15 % in the parts that are well observed. The spectrum meets
//! their Table 19 at 90 degrees within 5 % at 400, 500 and 700 nm.

use std::sync::LazyLock;

use crate::light::spectrum::Spectrum;
use crate::light::sun;
use crate::units::Angle;

const TABLE_17: &str = include_str!("../../catalogs/night/zodiacal_leinert1998_table17.csv");
/// Unit of the table in W m-2 sr-1 nm-1.
const UNIT: f64 = 1e-11;

/// Absolute helioecliptic longitudes of the table, degrees.
const LONGITUDES_DEG: [f64; 19] = [
    0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0,
    135.0, 150.0, 165.0, 180.0,
];
/// Absolute ecliptic latitudes of the table, degrees.
const LATITUDES_DEG: [f64; 11] = [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 45.0, 60.0, 75.0, 90.0];
const ROWS: usize = LONGITUDES_DEG.len();
const COLUMNS: usize = LATITUDES_DEG.len();

/// Power of the distance from the Sun with which radiance falls.
const POWER: f64 = 2.3;
/// Length over width of lines of equal radiance around the Sun.
const FLATTENING: f64 = 1.76;
/// Distance at which the law fades, degrees; far outside, the table alone is left.
const FADE_DEG: f64 = 30.0;
/// Distance within which it levels out: 10 radii of the Sun, degrees.
const CORE_DEG: f64 = 2.67;

/// Logarithm of the law that is taken out before the table is interpolated.
///
/// Distances are those of a stereographic map with the Sun in its middle. Seen from the point opposite
/// the Sun the law is flat, so that it has one value there.
fn ln_law(longitude_rad: f64, latitude_rad: f64) -> f64 {
    let across = latitude_rad.cos();
    let (along, up) = (across * longitude_rad.sin(), latitude_rad.sin());
    let towards = across * longitude_rad.cos();
    let sideways = along * along + up * up;
    // 1 + towards, exact opposite the Sun.
    let turned = if towards < 0.0 { sideways / (1.0 - towards) } else { 1.0 + towards };
    // The square of the distance, and of its unit, both times `turned` squared.
    let ellipse = 4.0 * (along * along + (FLATTENING * up).powi(2));
    let unit = turned * turned;
    let core = CORE_DEG.to_radians().powi(2) * unit;
    let squared = ellipse.hypot(core);
    -0.5 * POWER * (squared / (unit + squared / FADE_DEG.to_radians().powi(2))).ln()
}

/// The rest at a node with its slopes, per degree: along longitude, along latitude, along both.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    value: f64,
    by_longitude: f64,
    by_latitude: f64,
    by_both: f64,
}

static NODES: LazyLock<[[Node; COLUMNS]; ROWS]> = LazyLock::new(|| {
    let table = table();
    let mut rest = [[f64::NAN; COLUMNS]; ROWS];
    for (row, longitude_deg) in LONGITUDES_DEG.iter().enumerate() {
        for (column, latitude_deg) in LATITUDES_DEG.iter().enumerate() {
            let law = ln_law(longitude_deg.to_radians(), latitude_deg.to_radians());
            if let Some(tabulated) = table[row][column] {
                rest[row][column] = tabulated.ln() - law;
            }
        }
    }
    fill_blanks(&mut rest);
    let mut nodes = [[Node::default(); COLUMNS]; ROWS];
    // At the pole all longitudes meet: the slope there is one direction's, seen from all of them.
    let last = COLUMNS - 1;
    let pole = 0.5 * (rest[0][last - 1] - rest[ROWS - 1][last - 1])
        / (LATITUDES_DEG[last] - LATITUDES_DEG[last - 1]);
    let mut by_latitude = [[0.0; COLUMNS]; ROWS];
    for row in 0..ROWS {
        by_latitude[row] = slopes(&LATITUDES_DEG, &rest[row]);
        // The ecliptic is a line of symmetry.
        by_latitude[row][0] = 0.0;
        by_latitude[row][last] = -pole * LONGITUDES_DEG[row].to_radians().cos();
    }
    for column in 0..COLUMNS {
        let line = |of: &[[f64; COLUMNS]; ROWS]| {
            let mut slopes = slopes(&LONGITUDES_DEG, &of.each_ref().map(|row| row[column]));
            (slopes[0], slopes[ROWS - 1]) = (0.0, 0.0);
            slopes
        };
        let (along, both) = (line(&rest), line(&by_latitude));
        for row in 0..ROWS {
            nodes[row][column] = Node {
                value: rest[row][column],
                by_longitude: along[row],
                by_latitude: by_latitude[row][column],
                by_both: both[row],
            };
        }
    }
    nodes
});

/// The published table in its unit; `None` where it is blank.
fn table() -> [[Option<f64>; COLUMNS]; ROWS] {
    let mut table = [[None; COLUMNS]; ROWS];
    let lines = TABLE_17.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    for (row, line) in table.iter_mut().zip(lines) {
        for (cell, text) in row.iter_mut().zip(line.split(',').skip(1)) {
            *cell = text.trim().parse().ok();
        }
    }
    table
}

/// Goes on evenly into cells without a value: each the mean of its neighbours, over the edges of the
/// table by symmetry.
fn fill_blanks(cells: &mut [[f64; COLUMNS]; ROWS]) {
    let blank = cells.map(|row| row.map(f64::is_nan));
    let known = cells[3][0];
    for (cell, blank) in cells.iter_mut().flatten().zip(blank.iter().flatten()) {
        if *blank {
            *cell = known;
        }
    }
    for _ in 0..200 {
        for row in 0..ROWS - 1 {
            for column in 0..COLUMNS - 1 {
                if blank[row][column] {
                    let before = |index: usize| if index == 0 { 1 } else { index - 1 };
                    cells[row][column] = 0.25
                        * (cells[before(row)][column]
                            + cells[row + 1][column]
                            + cells[row][before(column)]
                            + cells[row][column + 1]);
                }
            }
        }
    }
}

/// Slopes at the nodes after Fritsch & Carlson 1980, *SIAM J. Numer. Anal.* 17, 238, with the weighted
/// harmonic mean of Fritsch & Butland 1984: none at extremes, so that none is overshot.
fn slopes<const N: usize>(at: &[f64; N], values: &[f64; N]) -> [f64; N] {
    let step = |k: usize| at[k + 1] - at[k];
    let secant = |k: usize| (values[k + 1] - values[k]) / step(k);
    std::array::from_fn(|k| {
        if k == 0 || k == N - 1 {
            return secant(k.min(N - 2));
        }
        let (before, after) = (secant(k - 1), secant(k));
        if before * after <= 0.0 {
            return 0.0;
        }
        let (w1, w2) = (2.0 * step(k) + step(k - 1), step(k) + 2.0 * step(k - 1));
        (w1 + w2) / (w1 / before + w2 / after)
    })
}

/// The cubic Hermite weights of a place from 0 to 1: of both values, of both slopes.
fn hermite(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [2.0 * t3 - 3.0 * t2 + 1.0, 3.0 * t2 - 2.0 * t3, t3 - 2.0 * t2 + t, t3 - t2]
}

/// Interval of a place among rising nodes, its width, and where in it, 0 to 1.
fn interval(nodes: &[f64], at: f64) -> (usize, f64, f64) {
    let k = nodes.partition_point(|node| *node <= at).clamp(1, nodes.len() - 1) - 1;
    let width = nodes[k + 1] - nodes[k];
    (k, width, ((at - nodes[k]) / width).clamp(0.0, 1.0))
}

/// Angles without sign, within the table: 0 to 180 and 0 to 90 degrees.
fn folded(helioecliptic_longitude: Angle, latitude: Angle) -> (f64, f64) {
    let longitude_deg = (helioecliptic_longitude.deg() + 180.0).rem_euclid(360.0) - 180.0;
    (longitude_deg.abs(), latitude.deg().abs().min(90.0))
}

/// Radiance at 500 nm, W m-2 sr-1 nm-1, given the ecliptic longitude less that of the Sun (any turn)
/// and the ecliptic latitude (-90 to 90 degrees), of date. Outside the air, 1 au from the Sun.
pub fn radiance_500(helioecliptic_longitude: Angle, latitude: Angle) -> f64 {
    let (longitude_deg, latitude_deg) = folded(helioecliptic_longitude, latitude);
    let (row, row_width, u) = interval(&LONGITUDES_DEG, longitude_deg);
    let (column, column_width, v) = interval(&LATITUDES_DEG, latitude_deg);
    let (along, up) = (hermite(u), hermite(v));
    let mut rest = 0.0;
    for i in 0..2 {
        for j in 0..2 {
            let node = &NODES[row + i][column + j];
            let slope_u = along[i + 2] * row_width;
            let slope_v = up[j + 2] * column_width;
            rest += along[i] * up[j] * node.value
                + slope_u * up[j] * node.by_longitude
                + along[i] * slope_v * node.by_latitude
                + slope_u * slope_v * node.by_both;
        }
    }
    UNIT * (rest + ln_law(longitude_deg.to_radians(), latitude_deg.to_radians())).exp()
}

/// Eq. 22: the factor by which sunlight is redder at a wavelength, with the slopes below and above
/// 500 nm.
fn reddening(slopes: [f64; 2], nm: f64) -> f64 {
    1.0 + slopes[usize::from(nm > 500.0)] * (nm / 500.0).log10()
}

/// Two spectra for radiance 1 at 500 nm: the reddest, 30 degrees from the Sun and nearer, and the
/// least red, 90 degrees and farther.
pub fn spectra() -> &'static [Spectrum; 2] {
    static SPECTRA: LazyLock<[Spectrum; 2]> = LazyLock::new(|| {
        let sunlight = sun::irradiance_1au();
        let sunlight = sunlight * sunlight.at_nm(500.0).recip();
        [[1.2, 0.8], [0.9, 0.6]].map(|slopes| sunlight.weighted(|nm| reddening(slopes, nm)))
    });
    &SPECTRA
}

/// How red the light is at an angle from the Sun: 1 to 30 degrees, 0 from 90 on, straight between. The
/// spectrum is `spectra[1] + redness * (spectra[0] - spectra[1])` of [`spectra`].
pub fn redness(elongation: Angle) -> f64 {
    ((90.0 - elongation.deg()) / 60.0).clamp(0.0, 1.0)
}

/// The angle from the Sun.
pub fn elongation(helioecliptic_longitude: Angle, latitude: Angle) -> Angle {
    let across = latitude.cos() * helioecliptic_longitude.sin();
    let towards = latitude.cos() * helioecliptic_longitude.cos();
    Angle::from_rad(across.hypot(latitude.sin()).atan2(towards))
}

/// Spectral radiance, W m-2 sr-1 nm-1; see [`radiance_500`].
pub fn radiance(helioecliptic_longitude: Angle, latitude: Angle) -> Spectrum {
    let redness = redness(elongation(helioecliptic_longitude, latitude));
    let [red, pale] = *spectra();
    (red * redness + pale * (1.0 - redness)) * radiance_500(helioecliptic_longitude, latitude)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_read_and_met() {
        let table = table();
        assert_eq!(table.iter().flatten().filter(|cell| cell.is_none()).count(), 8);
        for (row, longitude_deg) in LONGITUDES_DEG.iter().enumerate() {
            for (column, latitude_deg) in LATITUDES_DEG.iter().enumerate() {
                let Some(expected) = table[row][column] else { continue };
                for (a, b) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
                    let got = radiance_500(
                        Angle::from_deg(a * longitude_deg),
                        Angle::from_deg(b * latitude_deg),
                    );
                    let off = got / (expected * UNIT) - 1.0;
                    assert!(off.abs() < 1e-9, "{longitude_deg} {latitude_deg}: off {off}");
                }
            }
        }
    }

    #[test]
    fn nothing_is_overshot_between_neighbours() {
        let table = table();
        let mut most = 0.0f64;
        let mut along = |a: [f64; 2], b: [f64; 2], from: Option<f64>, to: Option<f64>| {
            let (Some(from), Some(to)) = (from, to) else { return };
            for step in 1..20 {
                let t = f64::from(step) / 20.0;
                let at = |k: usize| Angle::from_deg(a[k] + t * (b[k] - a[k]));
                let got = radiance_500(at(0), at(1)) / UNIT;
                let over = (got / from.max(to)).max(from.min(to) / got) - 1.0;
                most = most.max(over);
            }
        };
        for i in 0..ROWS {
            for j in 0..COLUMNS {
                let place = [LONGITUDES_DEG[i], LATITUDES_DEG[j]];
                if i + 1 < ROWS {
                    let next = [LONGITUDES_DEG[i + 1], LATITUDES_DEG[j]];
                    along(place, next, table[i][j], table[i + 1][j]);
                }
                if j + 1 < COLUMNS {
                    let next = [LONGITUDES_DEG[i], LATITUDES_DEG[j + 1]];
                    along(place, next, table[i][j], table[i][j + 1]);
                }
            }
        }
        assert!(most < 0.01, "{most}");
    }
}
