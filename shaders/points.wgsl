// Points of light as the eye sees them, added to what is shown: each as far above the threshold of who
// looks at the screen as it is above that of who looks at the sky.

struct Point {
    @location(0) centre_px: vec2f,
    // Linear shares of the screen's white with a luminance of one.
    @location(1) colour: vec3f,
    // Lux.
    @location(2) illuminance: f32,
    // How much of its light is the core, and what remains of its halo beside a flare.
    @location(3) parts: vec2f,
}

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) centre_px: vec2f,
    // Shares of white, times square pixels.
    @location(1) @interpolate(flat) shown: vec3f,
    // Size of a code of the picture here, shares of white of each primary; 0 where there are no codes.
    @location(2) @interpolate(flat) code: vec3f,
    @location(3) @interpolate(flat) parts: vec2f,
}

// The table of halos.
struct Halo {
    rows_per_octave: f32,
    first_log2_px: f32,
    rows: f32,
    pad: f32,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var<uniform> retina: Retina;
@group(0) @binding(2) var<uniform> halo: Halo;
// For a background: shares of white times square pixels for a lux, and the faintest point that is seen in lux.
@group(0) @binding(3) var visible: texture_2d<f32>;
// The frame around, and what is spread of it, coarse.
@group(0) @binding(4) var around: texture_2d<f32>;
@group(0) @binding(5) var spread_around: texture_2d<f32>;
// Light of the halo per square pixel, by the logarithm of the distance.
@group(0) @binding(6) var halo_rows: texture_2d<f32>;
@group(0) @binding(7) var<uniform> display: DisplayRows;
@group(0) @binding(8) var shown: texture_2d<f32>;
// Where the halo has no more than so much light per square pixel, pixels, by the logarithm of that light.
@group(0) @binding(9) var reaches: texture_2d<f32>;

// A point begins to show at this share of the threshold, a tenth of a magnitude below.
const GLIMPSED: f32 = 0.91;
// A halo ends where it is less than this share of a code.
const LEAST_CODE: f32 = 0.2;
// The columns of the table of reaches; src/render/eye.rs knows them too.
const LEAST_LOG2: f32 = -48.0;
const REACHES_PER_OCTAVE: f32 = 2.0;
const REACHES: f32 = 129.0;
// The code of a deep picture, that has none, is taken to be this.
const DEEP_CODE: f32 = 1e-5;

@vertex
fn vertex(point: Point, @builtin(vertex_index) index: u32) -> Corner {
    let centre = point.centre_px;
    let place = centre * retina.around_scale;
    let background = retina.in_place * textureSampleLevel(around, between, place, 0.0)
        + retina.spread * textureSampleLevel(spread_around, between, place, 0.0);
    let seen = at_light(visible, between, background);
    let share = smoothstep(GLIMPSED, 1.0, point.illuminance / seen.y);
    if share <= 0.0 {
        // Nowhere: four corners in one place.
        return Corner(vec4f(0.0, 0.0, 0.0, 1.0), centre, vec3f(0.0), vec3f(0.0), vec2f(0.0));
    }
    let strength = point.illuminance * seen.x * share;
    let brightest = strength * max(point.colour.r, max(point.colour.g, point.colour.b));
    // The pixels whose centres lie within two pixels of the point at least.
    let sent = sent_of(display.red, display.green, display.blue, seen_of(shown, between, background).xyz);
    let code = code_sizes(saturate(sent));
    let least = LEAST_CODE * max(max(code.r, code.g), max(code.b, DEEP_CODE));
    let reach = max(halo_reach(least / brightest), 2.0);
    let first = floor(centre - 0.5) + 1.0 - ceil(reach);
    let extent = 2.0 * ceil(reach);
    let corner = (first + extent * vec2f(f32(index & 1u), f32(index >> 1u))) / retina.size_px;
    let position = vec4f(2.0 * corner.x - 1.0, 1.0 - 2.0 * corner.y, 0.0, 1.0);
    return Corner(position, centre, strength * point.colour, code, point.parts);
}

// Given a row of the table of the halo, its light per square pixel; none beyond the last.
fn halo_row(row: f32) -> f32 {
    return textureSampleLevel(halo_rows, between, vec2f((row + 0.5) / halo.rows, 0.5), 0.0).x;
}

// Given light per square pixel, the distance at which the halo has no more, pixels.
fn halo_reach(least: f32) -> f32 {
    let column = clamp((log2(least) - LEAST_LOG2) * REACHES_PER_OCTAVE, 0.0, REACHES - 1.0);
    return textureSampleLevel(reaches, between, vec2f((column + 0.5) / REACHES, 0.5), 0.0).x;
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let off = corner.position.xy - corner.centre_px;
    let row = (log2(max(length(off), 1e-3)) - halo.first_log2_px) * halo.rows_per_octave;
    let core = corner.parts.x * cubic_b_spline(off.x) * cubic_b_spline(off.y);
    let light = corner.shown * (core + corner.parts.y * halo_row(row));
    // What is too bright for the screen keeps its colour.
    let held = light / max(1.0, max(light.r, max(light.g, light.b)));
    return vec4f(whole_codes(held, corner.code, corner.position.xy), 0.0);
}
