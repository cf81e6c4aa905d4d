// What the eye makes of the light of each pixel, shown on the screen.

// Grain of the rods: its seed's place in the noise, its size in pixels, and its strength.
struct Grain {
    place: vec2f,
    size_px: f32,
    strength: f32,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var<uniform> retina: Retina;
@group(0) @binding(2) var<uniform> display: DisplayRows;
// What cones and rods give of X, Y, Z and V, in shares of the screen's peak.
@group(0) @binding(3) var shown: texture_2d<f32>;
@group(0) @binding(4) var frame: texture_2d<f32>;
@group(0) @binding(5) var spread: texture_2d<f32>;
// What is shown, finished at a coarser level.
@group(0) @binding(6) var coarse: texture_2d<f32>;
@group(0) @binding(7) var nearest: sampler;
@group(0) @binding(8) var<uniform> grain: Grain;
@group(0) @binding(9) var noise: texture_2d<f32>;
@group(0) @binding(10) var repeated: sampler;

override HAS_GRAIN: bool = false;

// What is the same for all pixels reaches them through the corners: the software driver reads a uniform anew
// for each.
struct Corner {
    @builtin(position) position: vec4f,
    // Rows of the display's matrix, and the luminance of its primaries.
    @location(0) @interpolate(flat) red: vec4f,
    @location(1) @interpolate(flat) green: vec4f,
    @location(2) @interpolate(flat) blue: vec4f,
    // Shares of the light that are in place and spread; a pixel on the level that spreads.
    @location(3) @interpolate(flat) retina: vec4f,
    // A pixel on the coarse picture, and the place in the noise.
    @location(4) @interpolate(flat) coarse: vec4f,
    @location(5) @interpolate(flat) grain: vec2f,
    // A pixel on the frame, from 0 to 1 across it.
    @location(6) @interpolate(flat) pixel: vec2f,
}

@vertex
fn vertex(@location(0) tile: vec4u, @builtin(vertex_index) index: u32) -> Corner {
    let is_far = vec2<bool>((index & 1u) == 1u, (index >> 1u) == 1u);
    let place = vec2f(select(tile.xy, tile.zw, is_far)) / retina.size_px;
    return Corner(
        vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0),
        display.red,
        display.green,
        display.blue,
        vec4f(retina.in_place, retina.spread, retina.around_scale),
        vec4f(retina.soft_scale, grain.place / 256.0),
        vec2f(1.0 / (256.0 * grain.size_px), grain.strength),
        1.0 / retina.size_px,
    );
}

// Where the eye resolves all that the frame holds, and nothing bright is near.
@fragment
fn plain(corner: Corner) -> @location(0) vec4f {
    return codes(corner, sent(corner, at_pixel(corner)));
}

// Where glare matters.
@fragment
fn sharp(corner: Corner) -> @location(0) vec4f {
    let scattered = textureSampleLevel(spread, between, corner.position.xy * corner.retina.zw, 0.0);
    let light = corner.retina.x * at_pixel(corner) + corner.retina.y * scattered;
    return codes(corner, sent(corner, light));
}

// Where a coarser level holds all that it resolves.
@fragment
fn soft(corner: Corner) -> @location(0) vec4f {
    return codes(corner, textureSampleLevel(coarse, between, corner.position.xy * corner.coarse.xy, 0.0));
}

// The frame at a pixel: sampled at its centre, which the software driver does faster than loading it.
fn at_pixel(corner: Corner) -> LuminanceXyzv {
    return textureSampleLevel(frame, nearest, corner.position.xy * corner.pixel, 0.0);
}

// Given the light on the retina, what the primaries are sent, and its luminance.
fn sent(corner: Corner, light: LuminanceXyzv) -> vec4f {
    let seen = seen_of(shown, between, light);
    return vec4f(sent_of(corner.red, corner.green, corner.blue, seen.xyz), seen.w);
}

// Given what the primaries are sent, and the luminance that it comes of.
fn codes(corner: Corner, sent: vec4f) -> vec4f {
    var rgb = sent.rgb;
    if HAS_GRAIN {
        let place = corner.position.xy * corner.grain.x + corner.coarse.zw;
        let here = textureSampleLevel(noise, repeated, place, 0.0).x;
        // The fewer quanta are caught, the more their number varies.
        let strength = corner.grain.y;
        let of_counts = min(strength * inverseSqrt(sent.w + strength * strength), 0.5);
        rgb *= max(1.0 + here * of_counts, 0.0);
    }
    return shown_code(saturate(rgb), corner.position.xy);
}
