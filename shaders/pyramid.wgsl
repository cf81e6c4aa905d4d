// A picture at half its resolution again and again, and the way back up: each step keeps the sum of the
// light, and keeps an even picture even. The twin is src/eye/glare/pyramid.rs.

struct Step {
    // How much of the light of this level is spread, and what the coarser level counts.
    share: f32,
    coarser: f32,
    level: f32,
    // Share of the light that is not spread at all.
    in_place: f32,
    // How much of the last three texels of each axis lies in the picture, and the number of its texels.
    within_x: vec4f,
    within_y: vec4f,
}

@group(0) @binding(0) var between: sampler;
@group(0) @binding(1) var picture: texture_2d<f32>;
// The step up alone.
@group(0) @binding(2) var coarser: texture_2d<f32>;
@group(0) @binding(3) var<uniform> step: Step;
// The step up of a picture that is blurred.
@group(0) @binding(4) var blurred: texture_2d<f32>;
@group(0) @binding(5) var levels_resolved: texture_2d<f32>;
@group(0) @binding(7) var nearest: sampler;

struct Corner {
    @builtin(position) position: vec4f,
    // What is the same for all texels, which the software driver would read anew for each.
    @location(0) @interpolate(flat) shares: vec4f,
    @location(1) @interpolate(flat) within_x: vec4f,
    @location(2) @interpolate(flat) within_y: vec4f,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

@vertex
fn upward(@builtin(vertex_index) index: u32) -> Corner {
    let shares = vec4f(step.share, step.coarser, step.level, step.in_place);
    return Corner(full_screen_corner(index), shares, step.within_x, step.within_y);
}

// Brighter than any light that there is, cd/m2.
const ENDLESS: f32 = 1e15;

// Two by two pixels; at an odd end a texel has half of its light, as it has half of its place.
@fragment
fn first(@builtin(position) pixel: vec4f) -> @location(0) LuminanceXyzv {
    let size = vec2f(textureDimensions(picture));
    let mean = textureSampleLevel(picture, between, min(2.0 * pixel.xy, size - 0.5) / size, 0.0);
    let part = select(vec2f(1.0), vec2f(0.5), 2.0 * pixel.xy > size - 0.5);
    // What is no number or endless is dark here, so that it does not spread.
    let is_light = (mean > vec4f(0.0)) & (mean < vec4f(ENDLESS));
    return part.x * part.y * select(vec4f(0.0), mean, is_light);
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
    let part = select(vec2f(1.0), vec2f(0.5), first + 1.0 >= size);
    return 0.25 * part.x * part.y * (above + below);
}

// Given the number of a texel of an axis, counted from 1 at its end, how much of it lies in the picture.
fn within(from_end: f32, last: vec4f) -> f32 {
    return select(select(select(1.0, last.x, from_end == 3.0), last.y, from_end == 2.0), last.z, from_end == 1.0);
}

// Given a texel of this level, the luminance there.
fn luminance(corner: Corner) -> LuminanceXyzv {
    let texels = vec2f(corner.within_x.w, corner.within_y.w);
    let from_end = texels - floor(corner.position.xy);
    let part = within(from_end.x, corner.within_x) * within(from_end.y, corner.within_y);
    let place = corner.position.xy / texels;
    return textureSampleLevel(picture, nearest, place, 0.0) / part;
}

// Given a texel of this level, its light in a picture of the coarser one.
fn from_coarser(coarse: texture_2d<f32>, texel: vec2f) -> LuminanceXyzv {
    let place = 0.5 * texel / vec2f(textureDimensions(coarse));
    return textureSampleLevel(coarse, between, place, 0.0);
}

// What this level and all coarser ones spread.
@fragment
fn spread(corner: Corner) -> @location(0) LuminanceXyzv {
    let wider = from_coarser(coarser, corner.position.xy);
    return corner.shares.x * luminance(corner) + corner.shares.y * wider;
}

struct SpreadAndBlurred {
    @location(0) spread: LuminanceXyzv,
    @location(1) blurred: LuminanceXyzv,
}

fn stepped_up(corner: Corner) -> SpreadAndBlurred {
    let here = luminance(corner);
    let wider = from_coarser(coarser, corner.position.xy);
    let soft = from_coarser(blurred, corner.position.xy);
    let lost = level_resolved(levels_resolved, between, soft) - corner.shares.z;
    let spread = corner.shares.x * here + corner.shares.y * wider;
    return SpreadAndBlurred(spread, mix(here, soft, clamp(lost, 0.0, 1.0)));
}

// The same, and the picture as fine as the eye resolves it here.
@fragment
fn spread_and_blurred(corner: Corner) -> SpreadAndBlurred {
    return stepped_up(corner);
}

// What is shown where the eye resolves no more than this level, or there is no more to resolve.
@group(0) @binding(6) var shown: texture_2d<f32>;
@group(0) @binding(8) var<uniform> display: DisplayRows;

struct TileCorner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) shares: vec4f,
    @location(1) @interpolate(flat) within_x: vec4f,
    @location(2) @interpolate(flat) within_y: vec4f,
    @location(3) @interpolate(flat) red: vec4f,
    @location(4) @interpolate(flat) green: vec4f,
    @location(5) @interpolate(flat) blue: vec4f,
}

// A tile of the picture with a texel around it.
@vertex
fn tile(@location(0) tile: vec4u, @builtin(vertex_index) index: u32) -> TileCorner {
    let scale = exp2(-step.level);
    let first = floor(scale * vec2f(tile.xy)) - 1.0;
    let last = ceil(scale * vec2f(tile.zw)) + 1.0;
    let is_far = vec2<bool>((index & 1u) == 1u, (index >> 1u) == 1u);
    let place = select(first, last, is_far) / vec2f(step.within_x.w, step.within_y.w);
    return TileCorner(
        vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0),
        vec4f(step.share, step.coarser, step.level, step.in_place),
        step.within_x,
        step.within_y,
        display.red,
        display.green,
        display.blue,
    );
}

// Linear shares of the screen's primaries, and the light that they come of.
@fragment
fn seen(corner: TileCorner) -> @location(0) vec4f {
    let here = Corner(corner.position, corner.shares, corner.within_x, corner.within_y);
    let wider = from_coarser(coarser, corner.position.xy);
    let retina = corner.shares.x * luminance(here) + corner.shares.y * wider;
    let seen = seen_of(shown, between, retina);
    return vec4f(sent_of(corner.red, corner.green, corner.blue, seen.xyz), seen.w);
}

// The same where less is resolved in places.
@fragment
fn seen_blurred(corner: TileCorner) -> @location(0) vec4f {
    let up = stepped_up(Corner(corner.position, corner.shares, corner.within_x, corner.within_y));
    let seen = seen_of(shown, between, corner.shares.w * up.blurred + up.spread);
    return vec4f(sent_of(corner.red, corner.green, corner.blue, seen.xyz), seen.w);
}

// Given a pixel of the frame and a level finished by `spread`, the light on the retina: what measurements use.
// The step has the share in place, and in `level` what a pixel is on that level.
@fragment
fn retina(corner: Corner) -> @location(0) LuminanceXyzv {
    let pixel = corner.position.xy;
    let here = textureSampleLevel(picture, nearest, pixel / vec2f(textureDimensions(picture)), 0.0);
    let place = corner.shares.z * pixel / vec2f(textureDimensions(coarser));
    return corner.shares.w * here + corner.shares.y * textureSampleLevel(coarser, between, place, 0.0);
}
