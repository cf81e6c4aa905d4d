// Uniform cubic B-spline, whole support 4 pixels.
//
// Given the distance from the centre in pixels, the share of the light on one axis. Over the
// pixels of a grid the shares sum to one and their mean is the centre, wherever it lies between
// the pixels: a splat made of it conserves flux and place by construction.
fn cubic_b_spline(distance: Pixels) -> f32 {
    let d = abs(distance);
    if d < 1.0 {
        return (4.0 + d * d * (3.0 * d - 6.0)) / 6.0;
    }
    let e = max(2.0 - d, 0.0);
    return e * e * e / 6.0;
}
