//! How much of each species lies along a straight path through spherical air.
//!
//! Columns instead of optical depths: they know no wavelength, so one table serves them all. In a
//! layer with density `c + b r`, along a line whose closest approach to the centre is `p`, with `s`
//! counted from there: `Int (c + b r) ds = c s + b/2 (s r + p^2 ln(s + r))`.

#[cfg(test)]
use super::profile::TOP_KM;
use super::profile::{EARTH_RADIUS_KM, Profile, SPECIES};

#[cfg(test)]
const TOP_RADIUS_KM: f64 = EARTH_RADIUS_KM + TOP_KM;

/// Columns between two radii on the outgoing half of a line, `p2 = p^2 <= near^2 <= far^2`.
///
/// In km of relative density. Exact for densities that are linear in height.
pub(crate) fn between(profile: &Profile, p2: f64, near_km: f64, far_km: f64) -> [f64; SPECIES] {
    let mut sum = [0.0; SPECIES];
    let (heights, densities) = (profile.heights_km(), profile.densities());
    let antiderivative = |r: f64| {
        let s = (r * r - p2).max(0.0).sqrt();
        (s, 0.5 * (s * r + if p2 > 0.0 { p2 * (s + r).ln() } else { 0.0 }))
    };
    let mut low = antiderivative(near_km);
    let mut layer = profile.layer(near_km - EARTH_RADIUS_KM);
    loop {
        let is_last = layer + 2 >= heights.len();
        let layer_top = EARTH_RADIUS_KM + heights[layer + 1];
        let ends = is_last || far_km <= layer_top;
        let high = antiderivative(if ends { far_km } else { layer_top });
        let (ds, dq) = (high.0 - low.0, high.1 - low.1);
        let bottom = EARTH_RADIUS_KM + heights[layer];
        for (k, sum) in sum.iter_mut().enumerate() {
            let (a, b) = (densities[layer][k], densities[layer + 1][k]);
            let slope = (b - a) / (layer_top - bottom);
            *sum += (a - slope * bottom) * ds + slope * dq;
        }
        if ends {
            return sum;
        }
        low = high;
        layer += 1;
    }
}

/// Columns from a height to the end of the air; `None` if the ground is in between.
///
/// Exact, no table: what tables are tested against.
#[cfg(test)]
pub(crate) fn to_space(
    profile: &Profile,
    height_km: f64,
    cos_zenith: f64,
) -> Option<[f64; SPECIES]> {
    let r = EARTH_RADIUS_KM + height_km;
    let p2 = r * r * (1.0 - cos_zenith * cos_zenith);
    if cos_zenith >= 0.0 {
        return Some(between(profile, p2, r, TOP_RADIUS_KM));
    }
    let tangent = p2.sqrt();
    if tangent < EARTH_RADIUS_KM {
        return None;
    }
    let down = between(profile, p2, tangent, r);
    let up = between(profile, p2, tangent, TOP_RADIUS_KM);
    Some(std::array::from_fn(|k| down[k] + up[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uniform_column_is_its_length() {
        let uniform =
            Profile::from_nodes(vec![0.0, 7.0, 60.0, TOP_KM], vec![[1.0, 2.0, 0.0, 0.0]; 4]);
        for (height, mu) in [(0.0, 1.0), (0.0, 0.3), (5.0, 0.0), (30.0, -0.05), (119.0, 0.7)] {
            let r = EARTH_RADIUS_KM + height;
            let length = -r * mu + (r * r * (mu * mu - 1.0) + TOP_RADIUS_KM.powi(2)).sqrt();
            let [one, two, none, _] = to_space(&uniform, height, mu).unwrap();
            assert!((one - length).abs() < 1e-8 * length, "{height} km, {mu}: {one} {length}");
            assert!((two - 2.0 * length).abs() < 1e-8 * length && none == 0.0);
        }
        assert_eq!(to_space(&uniform, 1.0, -0.5), None);
    }

    #[test]
    fn a_linear_column_is_its_integral() {
        let linear = Profile::from_nodes(
            vec![0.0, TOP_KM],
            vec![[1.0, 0.0, 0.0, 0.0], [0.25, 0.0, 0.0, 0.0]],
        );
        let (height, mu) = (10.0, 0.02);
        let r = EARTH_RADIUS_KM + height;
        let length = -r * mu + (r * r * (mu * mu - 1.0) + TOP_RADIUS_KM.powi(2)).sqrt();
        let n = 20_000;
        let sum: f64 = (0..n)
            .map(|i| {
                let s = length * (i as f64 + 0.5) / n as f64;
                let h = (r * r + s * s + 2.0 * r * mu * s).sqrt() - EARTH_RADIUS_KM;
                (1.0 - 0.75 * h / TOP_KM) * length / n as f64
            })
            .sum();
        let got = to_space(&linear, height, mu).unwrap()[0];
        assert!((got / sum - 1.0).abs() < 1e-8, "{got} {sum}");
    }
}
