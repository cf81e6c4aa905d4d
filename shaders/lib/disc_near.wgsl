// Where a pixel lies on a disc, on a narrow picture: as polynomials of its offset from a pixel in the middle
// of what is seen, made in 64 bits by src/plan/near.rs. The values there are in the polynomials, so that
// the limb, other limbs and texels are met by small differences.

struct Near {
    // Where the offsets are counted from.
    anchor_px: vec2f,
    // There: the place among the nodes. The width of a pixel in radii.
    place: f32,
    pixel: f32,
    // What the place gains a pixel to the right and down; then by their squares: xx, xy, yy.
    place_gain: vec2f,
    place_bend: array<f32, 3>,
    // Of a globe: texels of its picture in a radius; steps of its outline in a unit of the tangent.
    texels: f32,
    outline_steps: f32,
    // Distance from the middle of the anchor, and the anchor with the globe's north up, in the first band.
    radius: f32,
    first: vec2f,
    // What brings a point of the globe to where its picture has it: two rows; in the first w what
    // counts for a point that is higher towards the observer.
    shift: array<vec4f, 2>,
    // The outline less the radius of the anchor, by the tangent of the angle from the anchor.
    outline: array<f32, 260>,
}

// A band of colour, at the anchor.
struct NearBand {
    // Point of the disc, level and up, in radii; its squared distance from the middle, less one.
    at: vec2f,
    over: f32,
    // Squared distance from the middle of what stands in front, less its squared radius, in squared radii.
    beside: f32,
    // What the point gains a pixel to the right and down, and by their squares.
    right: vec2f,
    down: vec2f,
    bend_xx: vec2f,
    bend_xy: vec2f,
    bend_yy: vec2f,
    // Half of what `beside` gains in a radius.
    from_occluder: vec2f,
    // Of a globe: the texel of its picture, and the part of a texel beyond.
    texel: vec2i,
    texel_part: vec2f,
    // The anchor with the globe's north up, less that of the first band.
    from_first: vec2f,
}

// Nodes of the outline.
const OUTLINE_NODES: u32 = 257u;

@group(0) @binding(9) var<storage, read> near: Near;
@group(0) @binding(10) var<storage, read> near_bands: array<NearBand>;

// A point of the picture as the disc has it.
struct Across {
    // Place among the nodes by apparent altitude, 0 at the lowest.
    place: f32,
    // Pixels from the anchor.
    off: vec2f,
}

// The same sight at another place among the nodes.
fn at_place(sight: Across, place: f32) -> Across {
    return Across(place, sight.off);
}

// A point of the disc in a band.
struct Point {
    // Level and up, in radii; the angle from the centre is small.
    at: vec3f,
    // Its squared distance from the middle, less one.
    over: f32,
    // From the anchor, level and up, in radii.
    off: vec2f,
    band: u32,
}

// Given a point in pixels, where it lies across the disc.
fn across_at(pixel: vec2f) -> Across {
    let off = pixel - near.anchor_px;
    let bend = vec3f(near.place_bend[0], near.place_bend[1], near.place_bend[2]);
    let squares = vec3f(off.x * off.x, off.x * off.y, off.y * off.y);
    return Across(near.place + (dot(near.place_gain, off) + dot(bend, squares)), off);
}

// Given a sight, the point of the disc in a band.
fn point_at(band: u32, sight: Across) -> Point {
    let x = sight.off.x;
    let y = sight.off.y;
    let bend_x = x * near_bands[band].bend_xx + y * near_bands[band].bend_xy;
    let bend_y = y * near_bands[band].bend_yy;
    let off = x * (near_bands[band].right + bend_x) + y * (near_bands[band].down + bend_y);
    let at = near_bands[band].at;
    let over = near_bands[band].over + dot(2.0 * at + off, off);
    return Point(vec3f(at + off, 0.0), over, off, band);
}

// How far a point is from the middle, less one, in radii.
fn beyond_limb(point: Point) -> f32 {
    return point.over / (1.0 + sqrt(max(1.0 + point.over, 0.0)));
}

// How far a point of the disc is from what stands in front, less its radius; both as chords.
fn beside_occluder(point: Point) -> f32 {
    let gain = dot(2.0 * near_bands[point.band].from_occluder + point.off, point.off);
    let beside = near_bands[point.band].beside + gain;
    let radius = disc.occluder.w / disc.centre.z;
    return beside / (radius + sqrt(max(beside + radius * radius, 1e-20))) * disc.centre.z;
}

// A globe in tiles, the air before it between their corners and the point of it by pixel.
struct SeenNear {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) red: vec4f,
    @location(1) @interpolate(linear) green: vec4f,
    @location(2) @interpolate(linear) blue: vec4f,
    @location(3) @interpolate(linear) earthlit: vec4f,
    @location(4) @interpolate(flat) band: u32,
}

@vertex
fn near_globe_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) band: u32) -> SeenNear {
    let seen = globe_corner(index, band);
    return SeenNear(seen.position, seen.red, seen.green, seen.blue, seen.earthlit, band * CHANNELS);
}

// With the globe's north up.
fn turned_north(v: vec2f) -> vec2f {
    return vec2f(v.x * disc.north.y - v.y * disc.north.x, v.x * disc.north.x + v.y * disc.north.y);
}

// Given a point from the anchor of the first band, the globe's north up, the part of a pixel around it that is
// within the outline.
fn within_near_outline(off: vec2f) -> f32 {
    let along = dot(near.first, off);
    let gained = 2.0 * along + dot(off, off);
    let gain = gained / (near.radius + sqrt(max(near.radius * near.radius + gained, 1e-20)));
    let ahead = max(near.radius * near.radius + along, 0.1);
    let tangent = (near.first.x * off.y - near.first.y * off.x) / ahead;
    let last = f32(OUTLINE_NODES - 1u);
    let place = clamp(0.5 * last + tangent * near.outline_steps, 0.0, last);
    let node = min(u32(place), OUTLINE_NODES - 2u);
    let limb = mix(near.outline[node], near.outline[node + 1u], place - f32(node));
    return clamp((limb - gain) / near.pixel + 0.5, 0.0, 1.0);
}

// Given a texel and how far from it, what the picture of the globe shows between it and the next ones; in 32
// bits, since samplers have few steps between texels.
fn between_texels(texel: vec2i, part: vec2f) -> vec4f {
    let last = vec2i(textureDimensions(globe)) - 1;
    let low = clamp(texel, vec2i(0), last);
    let high = clamp(texel + 1, vec2i(0), last);
    let top = mix(textureLoad(globe, low, 0), textureLoad(globe, vec2i(high.x, low.y), 0), part.x);
    let bottom = mix(textureLoad(globe, vec2i(low.x, high.y), 0), textureLoad(globe, high, 0), part.x);
    return mix(top, bottom, part.y);
}

@fragment
fn near_globe_fragment(seen: SeenNear) -> @location(0) LuminanceXyzv {
    let sight = across_at(seen.position.xy);
    let point = point_at(seen.band, sight);
    if point.over > EXTENT * EXTENT - 1.0 {
        return vec4f(0.0);
    }
    let off = turned_north(point.off);
    let from_first = near_bands[seen.band].from_first + off;
    // Where the picture has it, whose observer stands where directions are rounded to.
    let away = -sqrt(max(-point.over, 0.0));
    let place = vec3f(near.first + from_first, away);
    let shift = vec2f(dot(near.shift[0].xyz, place), dot(near.shift[1].xyz, place))
        - place.xy * (away * near.shift[0].w);
    let texels = near_bands[seen.band].texel_part + vec2f(near.texels, -near.texels) * (off + shift);
    let whole = floor(texels);
    let light = between_texels(near_bands[seen.band].texel + vec2i(whole), texels - whole);
    let softness = max(abs(near.place_gain.x) + abs(near.place_gain.y), 1e-12);
    let cut = clamp(0.5 + sight.place / softness, 0.0, 1.0);
    let over_horizon = select(1.0, cut, disc.samples.w == 1u);
    let part = over_horizon * within_near_outline(from_first);
    return seen.red * (light.x * part) + seen.green * (light.y * part) + seen.blue * (light.z * part)
        + seen.earthlit * (light.w * part);
}
