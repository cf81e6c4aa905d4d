//! A turn that is quickly reckoned.
//!
//! *Theory.* Walking around the square `|x| + |y| = 1` instead of the circle, the way from the x axis is a
//! quarter of `1 - x` above and of `3 + x` below it: 0 to 1 for a turn, through y. Equal steps of it are
//! angles that differ by a factor of two, finest beside the axes. Tables by direction are kept in it, since a
//! shader then finds a place in them without an arc tangent.

use glam::DVec2;

/// The direction, of length one, at a share of a turn.
pub fn towards(share: f64) -> DVec2 {
    let along = 4.0 * share.rem_euclid(1.0);
    let x = if along < 2.0 { 1.0 - along } else { along - 3.0 };
    let y = 1.0 - x.abs();
    DVec2::new(x, if along < 2.0 { y } else { -y }).normalize()
}

/// The share of a turn of a direction: the twin of `quick_turn` in `shaders/lib/globe.wgsl`.
pub fn share(direction: DVec2) -> f64 {
    let x = direction.x / (direction.x.abs() + direction.y.abs());
    0.25 * if direction.y >= 0.0 { 1.0 - x } else { 3.0 + x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        for step in 0..1000 {
            let turn = f64::from(step) / 1000.0;
            assert!((share(towards(turn)) - turn).abs() < 1e-12, "{turn}");
        }
        assert_eq!(
            [0.0, 0.25, 0.5, 0.75].map(towards).map(|d| d.round()),
            [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y]
        );
    }
}
