// Points of light as the eye sees them, added to what is shown: each as far above the threshold of who
// looks at the screen as it is above that of who looks at the sky.

struct Point {
    @location(0) centre_px: vec2f,
    // Linear shares of the screen's white with a luminance of one.
    @location(1) colour: vec3f,
    // Lux.
    @location(2) illuminance: f32,
}

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) centre_px: vec2f,
    // Shares of white, times square pixels.
    @location(1) @interpolate(flat) shown: vec3f,
    // Size of a code of the picture here, shares of white.
    @location(2) @interpolate(flat) code: f32,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var<uniform> retina: Retina;
// For a background: shares of white times square pixels for a lux, the faintest point that is seen in lux, and
// the size of a code.
@group(0) @binding(2) var visible: texture_2d<f32>;
@group(0) @binding(3) var spread: texture_2d<f32>;
// The frame at half its resolution, without points.
@group(0) @binding(4) var half_frame: texture_2d<f32>;

// A point begins to show at this share of the threshold.
const GLIMPSED: f32 = 0.7;

@vertex
fn vertex(point: Point, @builtin(vertex_index) index: u32) -> Corner {
    let background = retina.in_place * from_half(half_frame, between, point.centre_px)
        + retina.spread * from_half(spread, between, point.centre_px);
    let seen = at_light(visible, between, background);
    let share = smoothstep(GLIMPSED, 1.0, point.illuminance / seen.y);
    let shown = point.colour * (point.illuminance * seen.x * share);
    // The pixels whose centres lie within two pixels of the point; none of a point that is not seen.
    let first = floor(point.centre_px - 0.5) - 1.0;
    let extent = select(0.0, 4.0, share > 0.0);
    let corner = (first + extent * vec2f(f32(index & 1u), f32(index >> 1u))) / retina.size_px;
    let position = vec4f(2.0 * corner.x - 1.0, 1.0 - 2.0 * corner.y, 0.0, 1.0);
    return Corner(position, point.centre_px, shown, seen.z);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let off = corner.position.xy - corner.centre_px;
    let light = corner.shown * (cubic_b_spline(off.x) * cubic_b_spline(off.y));
    // What is too bright for the screen keeps its colour.
    let held = light / max(1.0, max(light.r, max(light.g, light.b)));
    let noise = (dither(corner.position.yx) - 0.5) * corner.code;
    return vec4f(max(held + noise * step(vec3f(1e-6), held), vec3f(0.0)), 0.0);
}
