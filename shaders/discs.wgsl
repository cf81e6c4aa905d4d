// Spheres that show a disc: the Sun, the Moon, and planets when the field is narrow.
//
// Where a pixel lies on the disc is said by lib/disc_far.wgsl or, on narrow pictures, lib/disc_near.wgsl:
// `across_at`, `at_place`, `point_at`, `beyond_limb`, `beside_occluder`, of the same meaning in both.

const NODES: u32 = 33;

struct Disc {
    // Corners of the pixels that the disc can touch.
    first_px: vec2f,
    last_px: vec2f,
    // Where the lowest node is seen, at the azimuth of the centre: in camera axes, right and up, and
    // one less the cosine of its angle from the axis, in z.
    lowest_in_view: vec4f,
    // The same direction in local axes (east, north, up), and the length of its level part, in w.
    lowest: vec4f,
    // Sine and cosine of the altitude of the centre, without air, and the sine of the angular radius.
    centre: vec4f,
    // From the body to the Sun, in axes of the disc: level, up, away from the observer; w is the law:
    // 0 Sun, 2 Lambert, 3 corona.
    to_sun: vec4f,
    // What stands in front, in axes of the disc: level, up, and one less the part away from the
    // observer, in z; in w the chord of its angular radius.
    occluder: vec4f,
    // Samples in a pixel inside the disc and turn of their lattice; the same near an edge. Of a globe, in
    // x, the edge of a tile in pixels, in y the columns of tiles, in z how many times finer its picture is
    // than the frame, in w 1 if the horizon cuts it.
    samples: vec4u,
    // Nodes in a radian of apparent altitude.
    per_step: f32,
    // How near to an edge the samples are those of the edge, in radii.
    edge: f32,
    // Of a globe: sine and cosine of the angle from up to its north, growing to the right.
    north: vec2f,
    bands: u32,
}

// A disc in one band of colour.
struct Band {
    // Limb darkening: I(mu) / I(1) = sum of a_k mu^k. Of the corona what counts for the powers -2.5, -7 and
    // -17 of the distance in radii of the Sun, then how many of them the disc has.
    limb: array<vec4f, 2>,
    // By apparent altitude across the disc: the luminance of a surface whose shape is one, seen
    // through the air.
    luminance: array<vec4f, NODES>,
    // True altitude above the centre, and what it gains from one node to the next.
    above_centre: array<vec4f, NODES>,
}

const SUN: u32 = 0;
const CORONA: u32 = 3;
// Place among the nodes of what no horizon cuts.
const UNCUT: f32 = 1e6;
// Bands of light of a globe for each band of colour.
const CHANNELS: u32 = 4;

@group(0) @binding(0) var<storage, read> camera: Camera;
@group(0) @binding(1) var<storage, read> disc: Disc;
@group(0) @binding(2) var<storage, read> bands: array<Band>;
// The globe without air, its north up, by channel, and its mean over the disc.
@group(0) @binding(3) var globe: texture_2d<f32>;
@group(0) @binding(4) var across_globe: sampler;
@group(0) @binding(5) var<storage, read> globe_mean: vec4f;
@group(0) @binding(6) var outline: texture_2d<f32>;
@group(0) @binding(7) var around: sampler;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return clip_from_pixel(camera, mix(disc.first_px, disc.last_px, corner));
}

// Given a band, the outward normal in axes of the disc and the cosine of emission, the shape of the
// light on the disc.
fn shape(band: u32, normal: vec3f, cos_emission: f32) -> f32 {
    let law = u32(disc.to_sun.w);
    if law == SUN {
        let m = cos_emission;
        let low = bands[band].limb[0];
        let high = bands[band].limb[1];
        return low.x + m * (low.y + m * (low.z + m * (low.w + m * (high.x + m * high.y))));
    }
    if law == CORONA {
        let coefficients = bands[band].limb[0];
        let radii = length(normal.xy) * coefficients.w;
        let inverse = 1.0 / max(radii, 1.0);
        let square = inverse * inverse;
        let eighth = square * square * square * square;
        let powers = vec3f(square * sqrt(inverse), eighth / inverse, eighth * eighth * inverse);
        return select(0.0, dot(coefficients.xyz, powers), radii >= 1.0);
    }
    return max(dot(normal, disc.to_sun.xyz), 0.0);
}

// Whether a sight is one at which the disc may be.
fn is_on_disc(sight: Across) -> bool {
    return sight.place >= 0.0 && sight.place <= f32(NODES - 1u);
}

// Given a point in pixels, the light of the disc there; none below the horizon.
fn light_at(pixel: vec2f) -> LuminanceXyzv {
    let sight = across_at(pixel);
    var light = vec4f(0.0);
    if !is_on_disc(sight) {
        return light;
    }
    let node = min(u32(sight.place), NODES - 2u);
    let along = sight.place - f32(node);
    for (var band = 0u; band < disc.bands; band++) {
        let point = point_at(band, sight);
        if point.over < 0.0 && point.at.z < 0.5 && beside_occluder(point) >= 0.0 {
            let cos_emission = sqrt(-point.over);
            let normal = vec3f(point.at.xy, -cos_emission);
            let luminance =
                mix(bands[band].luminance[node], bands[band].luminance[node + 1u], along);
            light += luminance * shape(band, normal, cos_emission);
        }
    }
    return light;
}

// Given the middle of a pixel, how many samples it asks for and the turn of their lattice: many where
// an edge may run through it, of the disc, of what stands in front, or of the ground; none outside.
fn lattice_at(middle: vec2f) -> vec2u {
    let sight = across_at(middle);
    let margin = disc.edge * disc.centre.z;
    let low = sight.place / disc.per_step;
    let high = (sight.place - f32(NODES - 1u)) / disc.per_step;
    if low < -margin || high > margin {
        return vec2u(0u);
    }
    let nearest = at_place(sight, clamp(sight.place, 0.0, f32(NODES - 1u)));
    let point = point_at(disc.bands / 2u, nearest);
    let outside = beyond_limb(point);
    if outside > disc.edge || point.at.z > 0.5 {
        return vec2u(0u);
    }
    let is_inside = low > margin && high < -margin && outside < -disc.edge;
    let is_free = abs(beside_occluder(point)) > margin;
    return select(disc.samples.zw, disc.samples.xy, is_inside && is_free);
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) LuminanceXyzv {
    let first = floor(position.xy);
    let lattice = lattice_at(first + 0.5);
    var sum = vec4f(0.0);
    for (var k = 0u; k < lattice.x; k++) {
        let row = (k * lattice.y) % lattice.x;
        sum += light_at(first + (vec2f(f32(k), f32(row)) + 0.5) / f32(lattice.x));
    }
    return sum / f32(max(lattice.x, 1u));
}

// A globe is drawn in square tiles: where it is seen and the air before it change slowly.
struct Seen {
    @builtin(position) position: vec4f,
    // Point of the picture of the globe in radii, and place among the nodes where the horizon may cut it.
    @location(0) @interpolate(linear) at: vec2f,
    @location(1) @interpolate(linear) place: f32,
    // Light through the air of a surface that has one on the picture, by channel.
    @location(2) @interpolate(linear) red: vec4f,
    @location(3) @interpolate(linear) green: vec4f,
    @location(4) @interpolate(linear) blue: vec4f,
    @location(5) @interpolate(linear) earthlit: vec4f,
}

// Given the number of a corner, row by row, and the band.
fn globe_corner(index: u32, band: u32) -> Seen {
    let first = band * CHANNELS;
    let corners = disc.samples.y + 1u;
    let corner = vec2u(index % corners, index / corners);
    let pixel = disc.first_px + vec2f(corner * disc.samples.x);
    let position = clip_from_pixel(camera, pixel);
    let sight = across_at(pixel);
    if sight.place < -1e8 {
        return Seen(position, vec2f(9.0), 0.0, vec4f(0.0), vec4f(0.0), vec4f(0.0), vec4f(0.0));
    }
    let last = f32(NODES - 1u);
    let place = clamp(sight.place, 0.0, last);
    let node = min(u32(place), NODES - 2u);
    let along = place - f32(node);
    // A picture of nothing has no mean.
    let shares = select(1.0 / globe_mean, vec4f(0.0), globe_mean <= vec4f(0.0));
    var lights: array<vec4f, CHANNELS>;
    for (var channel = 0u; channel < CHANNELS; channel++) {
        let low = bands[first + channel].luminance[node];
        lights[channel] = mix(low, bands[first + channel].luminance[node + 1u], along) * shares[channel];
    }
    // Beyond the nodes the point goes on as it went.
    var at = point_at(first, at_place(sight, place)).at;
    let rise = bands[first].above_centre[select(0u, NODES - 1u, sight.place > 0.0)].y;
    at.y += (sight.place - place) * rise / disc.centre.z;
    let turned = vec2f(at.x * disc.north.y - at.y * disc.north.x, at.x * disc.north.x + at.y * disc.north.y);
    let point = select(vec2f(9.0), turned, at.z < 0.5);
    let cut = select(UNCUT, sight.place, disc.samples.w == 1u);
    return Seen(position, point, cut, lights[0], lights[1], lights[2], lights[3]);
}

@vertex
fn globe_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) band: u32) -> Seen {
    return globe_corner(index, band);
}

// Given a point of the disc in radii, what the picture of the globe shows there to a sample of that width.
fn globe_at(at: vec2f, width: f32) -> vec4f {
    let flipped = vec2f(at.x, -at.y) / EXTENT;
    let light = textureSampleLevel(globe, across_globe, 0.5 + 0.5 * flipped, 0.0);
    return light * within_limb(outline, around, at, width);
}

// What of a pixel is over the ground that stands before what lies below the first node.
fn over_ground(seen: Seen) -> f32 {
    let width = max(fwidth(seen.place), 1e-6);
    return select(1.0, clamp(0.5 + seen.place / width, 0.0, 1.0), seen.place < UNCUT);
}

// Given the light of the picture by channel, the light through the air.
fn through_air(seen: Seen, light: vec4f) -> LuminanceXyzv {
    return seen.red * light.x + seen.green * light.y + seen.blue * light.z + seen.earthlit * light.w;
}

@fragment
fn globe_fragment(seen: Seen) -> @location(0) LuminanceXyzv {
    let width = 0.5 * (length(dpdx(seen.at)) + length(dpdy(seen.at)));
    let seen_part = over_ground(seen);
    if length(seen.at) > EXTENT {
        return vec4f(0.0);
    }
    return through_air(seen, globe_at(seen.at, width) * seen_part);
}

// The same with as many samples along a pixel as the picture has pixels there.
@fragment
fn small_globe_fragment(seen: Seen) -> @location(0) LuminanceXyzv {
    let right = dpdx(seen.at);
    let down = dpdy(seen.at);
    let seen_part = over_ground(seen);
    if length(seen.at) > EXTENT + length(right) + length(down) {
        return vec4f(0.0);
    }
    let count = disc.samples.z;
    let width = 0.5 * (length(right) + length(down)) / f32(count);
    var sum = vec4f(0.0);
    for (var row = 0u; row < count; row++) {
        let start = seen.at + down * ((f32(row) + 0.5) / f32(count) - 0.5);
        for (var column = 0u; column < count; column++) {
            sum += globe_at(start + right * ((f32(column) + 0.5) / f32(count) - 0.5), width);
        }
    }
    return through_air(seen, sum * (seen_part / f32(count * count)));
}
