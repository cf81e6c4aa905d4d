// What the eye makes of the light of each pixel, shown on the screen.

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var<uniform> retina: Retina;
@group(0) @binding(2) var<uniform> display: Display;
// What cones and rods give of X, Y, Z and V, in shares of the screen's peak.
@group(0) @binding(3) var shown: texture_2d<f32>;
@group(0) @binding(4) var frame: texture_2d<f32>;
@group(0) @binding(5) var spread: texture_2d<f32>;
// Where the eye does not resolve all that the frame holds.
@group(0) @binding(6) var blurred: texture_2d<f32>;
@group(0) @binding(7) var levels_resolved: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

// All that the frame holds is resolved.
@fragment
fn sharp(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return picture_of(textureLoad(frame, vec2u(pixel.xy), 0), pixel.xy);
}

// Some of it is not.
@fragment
fn soft(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let fine = textureLoad(frame, vec2u(pixel.xy), 0);
    let coarse = from_half(blurred, between, pixel.xy);
    let lost = clamp(level_resolved(levels_resolved, between, coarse), 0.0, 1.0);
    return picture_of(mix(fine, coarse, lost), pixel.xy);
}

// Given the light that is resolved at a pixel, what is shown there.
fn picture_of(resolved: LuminanceXyzv, pixel: vec2f) -> vec4f {
    let light = retina.in_place * resolved + retina.spread * from_half(spread, between, pixel);
    let by = at_light(shown, between, light);
    return display_code(display, by.x * light.xyz + light.w * by.yzw, pixel);
}
