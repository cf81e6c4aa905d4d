// A picture at half its resolution again and again, and the way back up: each step keeps the sum of the
// light, and keeps an even picture even.

// The step up: how much of the light of this level stays on it, and what the coarser level counts.
struct Step {
    share: f32,
    coarser: f32,
    level: f32,
    pad: f32,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var picture: texture_2d<f32>;
// The step up alone.
@group(0) @binding(2) var coarser: texture_2d<f32>;
@group(0) @binding(3) var<uniform> step: Step;
// The step up of a picture that is blurred.
@group(0) @binding(4) var blurred: texture_2d<f32>;
@group(0) @binding(5) var levels_resolved: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

// Means of two by two pixels; the last ones alone where their number is odd.
@fragment
fn first(@builtin(position) pixel: vec4f) -> @location(0) LuminanceXyzv {
    let size = vec2f(textureDimensions(picture));
    return textureSampleLevel(picture, between, min(2.0 * pixel.xy, size - 0.5) / size, 0.0);
}

// Weights 1 3 3 1 on each axis, 1 3 at an odd end; beyond the other ends the picture is mirrored.
@fragment
fn halved(@builtin(position) pixel: vec4f) -> @location(0) LuminanceXyzv {
    let size = vec2f(textureDimensions(picture));
    let first = 2.0 * pixel.xy - 1.0;
    let near = (first + 0.25) / size;
    let far = select((first + 1.75) / size, near, first + 1.0 >= size);
    let above = textureSampleLevel(picture, between, near, 0.0)
        + textureSampleLevel(picture, between, vec2f(far.x, near.y), 0.0);
    let below = textureSampleLevel(picture, between, vec2f(near.x, far.y), 0.0)
        + textureSampleLevel(picture, between, far, 0.0);
    return 0.25 * (above + below);
}

// Given a pixel of this level, its light in a picture of the coarser one.
fn from_coarser(coarse: texture_2d<f32>, pixel: vec2f) -> LuminanceXyzv {
    let place = 0.5 * pixel / vec2f(textureDimensions(coarse));
    return textureSampleLevel(coarse, between, place, 0.0);
}

// What this level and all coarser ones spread.
@fragment
fn spread(@builtin(position) pixel: vec4f) -> @location(0) LuminanceXyzv {
    let here = textureLoad(picture, vec2u(pixel.xy), 0);
    return step.share * here + step.coarser * from_coarser(coarser, pixel.xy);
}

struct SpreadAndBlurred {
    @location(0) spread: LuminanceXyzv,
    @location(1) blurred: LuminanceXyzv,
}

// The same, and the picture as fine as the eye resolves it here.
@fragment
fn spread_and_blurred(@builtin(position) pixel: vec4f) -> SpreadAndBlurred {
    let here = textureLoad(picture, vec2u(pixel.xy), 0);
    let spread = step.share * here + step.coarser * from_coarser(coarser, pixel.xy);
    let coarse = from_coarser(blurred, pixel.xy);
    let lost = clamp(level_resolved(levels_resolved, between, coarse) - step.level, 0.0, 1.0);
    return SpreadAndBlurred(spread, mix(here, coarse, lost));
}
