// The light of stars that are not drawn one by one: a map of the sphere, seen through the air.

@group(0) @binding(0) var<storage, read> camera: Camera;
// Light outside the air in S10(V), of the bluest and of the reddest mix of stars, on an octahedron in
// galactic axes. A border of one texel repeats what lies across each edge.
@group(0) @binding(1) var map: texture_2d<f32>;
@group(0) @binding(2) var across_map: sampler;

struct Corner {
    // In pixels.
    @location(0) pixel: vec2f,
    // Where it looks, galactic axes, of any length.
    @location(1) dir: vec3f,
    // What arrives of 1 S10(V), of the bluest and of the reddest mix.
    @location(2) blue: vec4f,
    @location(3) red: vec4f,
    // Height over the horizon, in heights of the soft edge that it is drawn with.
    @location(4) over: f32,
}

struct Seen {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) dir: vec3f,
    @location(1) @interpolate(linear) blue: vec4f,
    @location(2) @interpolate(linear) red: vec4f,
    @location(3) @interpolate(linear) over: f32,
}

@vertex
fn vertex(corner: Corner) -> Seen {
    let position = clip_from_pixel(camera, corner.pixel);
    return Seen(position, corner.dir, corner.blue, corner.red, corner.over);
}

// Given a direction of any length, its place on the map, -1 to 1: the octahedron, its lower half
// folded out.
fn octahedral(dir: vec3f) -> vec2f {
    let p = dir.xy / (abs(dir.x) + abs(dir.y) + abs(dir.z));
    let folded = (1.0 - abs(p.yx)) * select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0));
    return select(p, folded, dir.z < 0.0);
}

@fragment
fn fragment(seen: Seen) -> @location(0) LuminanceXyzv {
    let size = vec2f(textureDimensions(map));
    let place = 0.5 + 0.5 * octahedral(seen.dir) * (size - 2.0) / size;
    let s10 = textureSampleLevel(map, across_map, place, 0.0).xy;
    let light = s10.x * seen.blue + s10.y * seen.red;
    return light * clamp(0.5 + seen.over, 0.0, 1.0);
}
