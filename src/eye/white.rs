//! The white that an eye takes for white: chromatic adaptation.
//!
//! Theory: the cones adapt each for themselves to what they are lit with (von Kries), in the sharpened
//! cone space of Bradford (Lam 1985; ICC.1:2022, Annex E), and not completely.
//!
//! What lights the scene is taken from the picture: the mean colour of what cones see of it, with no more
//! weight to any place than [`BRIGHTEST_CD_M2`] gives it. A scene that is bluer than daylight is not adapted
//! to: nobody takes the sky for white. One that is yellower is, to [`DEGREE`]; so the full Moon is white with
//! a breath of cream, and the Moon on the horizon and the Moon eclipsed stay as orange and as red as
//! they are. These rules and numbers are chosen, not measured.

use glam::{DMat3, DVec3};

use super::rods::cone_share;

/// X and Z of daylight D65 with a luminance of one.
const D65: [f64; 2] = [0.950_456, 1.089_058];
/// The Sun's disc counts no more than this.
const BRIGHTEST_CD_M2: f64 = 1e4;
/// How far an eye adapts to what is this yellow or more, Z over Y; to bluer light it adapts less.
const DEGREE: f64 = 0.75;
const YELLOW: f64 = 0.85;
/// It adapts to no light that is yellower than this, Z over Y: some 4000 kelvin.
const YELLOWEST: f64 = 0.65;

/// X, Y and Z as seen by daylight of X, Y and Z in the light of a scene, from what falls on the fovea,
/// cd/m2.
pub fn adapted_from_seen(fovea: impl Iterator<Item = [f64; 3]>) -> DMat3 {
    let mut sum = DVec3::ZERO;
    for [x, y, z] in fovea.filter(|[_, y, _]| *y > 0.0) {
        let weight = cone_share(y) * y.min(BRIGHTEST_CD_M2) / y;
        sum += weight * DVec3::new(x, y, z);
    }
    if sum.y <= 0.0 || !sum.is_finite() {
        return DMat3::IDENTITY;
    }
    let [x, z] = [sum.x / sum.y, sum.z / sum.y];
    let [day_x, day_z] = D65;
    let degree = DEGREE * ((day_z - z) / (day_z - YELLOW)).clamp(0.0, 1.0);
    let within = ((day_z - YELLOWEST) / (day_z - z).max(f64::MIN_POSITIVE)).min(1.0);
    let towards = degree * within;
    let white = DVec3::new(day_x + towards * (x - day_x), 1.0, day_z + towards * (z - day_z));
    let [day, white] = [DVec3::new(day_x, 1.0, day_z), white].map(|white| BRADFORD * white);
    BRADFORD.inverse() * DMat3::from_diagonal(day / white) * BRADFORD
}

/// Cones of X, Y and Z, as Bradford sharpened them.
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

#[cfg(test)]
mod tests {
    use super::*;

    const MOONLIT: [f64; 3] = [0.98 * 3000.0, 3000.0, 0.80 * 3000.0];

    #[test]
    fn daylight_and_blue_skies_are_as_they_are() {
        let [x, z] = D65;
        for scene in [[x * 4e3, 4e3, z * 4e3], [0.98 * 4e3, 4e3, 1.5 * 4e3], [0.0; 3]] {
            let matrix = adapted_from_seen([scene].into_iter());
            assert!(matrix.abs_diff_eq(DMat3::IDENTITY, 1e-4), "{scene:?}: {matrix}");
        }
    }

    #[test]
    fn moonlight_becomes_nearly_white_in_any_frame_and_keeps_its_luminance() {
        let sky = [0.008, 0.01, 0.014];
        let matrix = adapted_from_seen(std::iter::once(MOONLIT).chain([sky; 4000]));
        let seen = matrix * DVec3::from_array(MOONLIT);
        let yellow = (D65[1] - seen.z / seen.y) / (D65[1] - 0.80);
        assert!((0.1..0.5).contains(&yellow), "{yellow}");
        assert!((seen.y / 3000.0 - 1.0).abs() < 0.03, "{}", seen.y);
    }

    #[test]
    fn red_stays_red() {
        let red = [1.4, 1.0, 0.1];
        let seen = adapted_from_seen([red; 10].into_iter()) * DVec3::from_array(red);
        assert!(seen.z / seen.y < 0.2, "{seen}");
    }

    #[test]
    fn no_light_is_too_much() {
        for scene in [[1e10; 3], [f64::INFINITY; 3], [1e-300; 3]] {
            assert!(adapted_from_seen([scene].into_iter()).is_finite(), "{scene:?}");
        }
    }
}
