// Uniform cubic B-spline, whole support 4 pixels.
//
// Given the distance from the centre in pixels, the share of the light on one axis. Over the
// pixels of a grid the shares sum to one and their mean is the centre, wherever it lies between
// the pixels: a splat made of it conserves flux and place by construction.
fn cubic_b_spline(distance: Pixels) -> f32 {
    let outer = max(2.0 - abs(distance), 0.0);
    let inner = max(1.0 - abs(distance), 0.0);
    return (outer * outer * outer - 4.0 * inner * inner * inner) / 6.0;
}
