// What the eye makes of the light of each pixel, shown on the screen.

// Grain of the rods: its seed's place in the noise, its size in pixels, and its strength.
struct Grain {
    place: vec2f,
    size_px: f32,
    strength: f32,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var<uniform> retina: Retina;
@group(0) @binding(2) var<uniform> display: Display;
// What cones and rods give of X, Y, Z and V, in shares of the screen's peak.
@group(0) @binding(3) var shown: texture_2d<f32>;
@group(0) @binding(4) var frame: texture_2d<f32>;
@group(0) @binding(5) var spread: texture_2d<f32>;
// The frame where the eye does not resolve all that it holds.
@group(0) @binding(6) var blurred: texture_2d<f32>;
@group(0) @binding(7) var levels_resolved: texture_2d<f32>;
// What is shown, finished at a coarser level.
@group(0) @binding(8) var coarse: texture_2d<f32>;
@group(0) @binding(9) var<uniform> grain: Grain;
@group(0) @binding(10) var noise: texture_2d<f32>;
@group(0) @binding(11) var repeated: sampler;

override HAS_GRAIN: bool = false;

@vertex
fn vertex(@location(0) tile: vec4u, @builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(select(tile.xy, tile.zw, vec2<bool>((index & 1u) == 1u, (index >> 1u) == 1u)));
    let place = corner / retina.size_px;
    return vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0);
}

// Where the eye resolves all that the frame holds, and nothing bright is near.
@fragment
fn plain(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let light = textureLoad(frame, vec2u(pixel.xy), 0);
    return codes(seen_of(shown, between, light), pixel.xy);
}

// Where it resolves all.
@fragment
fn sharp(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return codes(seen_with_glare(textureLoad(frame, vec2u(pixel.xy), 0), pixel.xy), pixel.xy);
}

// Where it resolves some.
@fragment
fn mixed(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let fine = textureLoad(frame, vec2u(pixel.xy), 0);
    let soft = from_level(blurred, between, pixel.xy, 0.5);
    let lost = clamp(level_resolved(levels_resolved, between, soft), 0.0, 1.0);
    return codes(seen_with_glare(mix(fine, soft, lost), pixel.xy), pixel.xy);
}

// Where it resolves no more than a coarser level holds.
@fragment
fn soft(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return codes(from_level(coarse, between, pixel.xy, retina.soft_scale), pixel.xy);
}

// Given the light that is resolved at a pixel, what is shown there.
fn seen_with_glare(resolved: LuminanceXyzv, pixel: vec2f) -> vec4f {
    let scattered = retina.spread * from_level(spread, between, pixel, 0.5);
    return seen_of(shown, between, retina.in_place * resolved + scattered);
}

// Given X, Y and Z in shares of the screen's peak, and the luminance that they come of.
fn codes(seen: vec4f, pixel: vec2f) -> vec4f {
    var xyz = seen.xyz;
    if HAS_GRAIN {
        let here = textureSampleLevel(noise, repeated, (pixel / grain.size_px + grain.place) / 256.0, 0.0).x;
        // The fewer quanta are caught, the more their number varies.
        let spread_of_counts = grain.strength * inverseSqrt(seen.w + grain.strength * grain.strength);
        xyz *= max(1.0 + here * min(spread_of_counts, 0.5), 0.0);
    }
    return display_code(display, xyz, pixel);
}
