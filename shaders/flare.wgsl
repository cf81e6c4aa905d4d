// Needles and the ring that wide pupils see around bright points, added to what is shown.

struct Point {
    @location(0) centre_px: vec2f,
    // As far as it is seen.
    @location(1) radius_px: f32,
    @location(2) illuminance: vec4f,
}

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) centre_px: vec2f,
    @location(1) @interpolate(flat) illuminance: vec4f,
    @location(2) @interpolate(flat) background: vec4f,
    // What the primaries are sent of the background, and the radius that is seen.
    @location(3) @interpolate(flat) sent: vec4f,
    // Size of a code of each primary, and the radius of the whole flare in pixels.
    @location(4) @interpolate(flat) code: vec4f,
    @location(5) @interpolate(flat) red: vec4f,
    @location(6) @interpolate(flat) green: vec4f,
    @location(7) @interpolate(flat) blue: vec4f,
}

struct Flare {
    radius_px: f32,
    pad: vec3f,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var<uniform> retina: Retina;
@group(0) @binding(2) var<uniform> flare: Flare;
@group(0) @binding(3) var<uniform> display: DisplayRows;
@group(0) @binding(4) var shown: texture_2d<f32>;
@group(0) @binding(5) var around: texture_2d<f32>;
@group(0) @binding(6) var spread_around: texture_2d<f32>;
// Light per steradian of one unit of X, Y, Z and V: across a turn, down the root of the radius.
@group(0) @binding(7) var pattern: texture_2d<f32>;
@group(0) @binding(8) var turning: sampler;

@vertex
fn vertex(point: Point, @builtin(vertex_index) index: u32) -> Corner {
    let place = point.centre_px * retina.around_scale;
    let background = retina.in_place * textureSampleLevel(around, between, place, 0.0)
        + retina.spread * textureSampleLevel(spread_around, between, place, 0.0);
    let sent = sent_of(display.red, display.green, display.blue, seen_of(shown, between, background).xyz);
    let sides = 2.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    let corner = (point.centre_px + point.radius_px * sides) / retina.size_px;
    return Corner(
        vec4f(2.0 * corner.x - 1.0, 1.0 - 2.0 * corner.y, 0.0, 1.0),
        point.centre_px,
        point.illuminance,
        background,
        vec4f(sent, point.radius_px),
        vec4f(code_sizes(saturate(sent)), flare.radius_px),
        display.red,
        display.green,
        display.blue,
    );
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let off = corner.position.xy - corner.centre_px;
    let distance = length(off);
    let place = vec2f(atan2(off.y, off.x) / (2.0 * PI), sqrt(distance / corner.code.w));
    let fading = 1.0 - smoothstep(0.6, 1.0, distance / corner.sent.w);
    let light = corner.illuminance * textureSampleLevel(pattern, turning, place, 0.0) * fading;
    let seen = seen_of(shown, between, corner.background + light).xyz;
    let sent = sent_of(corner.red, corner.green, corner.blue, seen);
    let more = max(saturate(sent) - saturate(corner.sent.xyz), vec3f(0.0));
    return vec4f(whole_codes(more, corner.code.xyz, corner.position.xy), 0.0);
}
