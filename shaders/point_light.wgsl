// The light of points in a level of the pyramid, from where it is spread far over the picture.

struct Point {
    @location(0) centre_px: vec2f,
    @location(1) illuminance: vec4f,
}

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) centre: vec2f,
    @location(1) @interpolate(flat) luminance: vec4f,
}

struct Level {
    size: vec2f,
    // Texels to a pixel, and what a lux on a texel is in cd/m2.
    scale: f32,
    per_lux: f32,
}

@group(0) @binding(0) var<uniform> level: Level;

@vertex
fn vertex(point: Point, @builtin(vertex_index) index: u32) -> Corner {
    let centre = level.scale * point.centre_px;
    let first = floor(centre) - 1.0;
    let corner = (first + 3.0 * vec2f(f32(index & 1u), f32(index >> 1u))) / level.size;
    let position = vec4f(2.0 * corner.x - 1.0, 1.0 - 2.0 * corner.y, 0.0, 1.0);
    return Corner(position, centre, level.per_lux * point.illuminance);
}

// Quadratic B-spline: what the steps down make of a point, in the mean.
fn quadratic_b_spline(distance: f32) -> f32 {
    let d = abs(distance);
    let outer = max(1.5 - d, 0.0);
    return select(0.5 * outer * outer, 0.75 - d * d, d < 0.5);
}

@fragment
fn fragment(corner: Corner) -> @location(0) LuminanceXyzv {
    let off = corner.position.xy - corner.centre;
    return corner.luminance * (quadratic_b_spline(off.x) * quadratic_b_spline(off.y));
}
