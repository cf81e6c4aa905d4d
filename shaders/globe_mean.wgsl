// The mean light of the picture of a globe over a disc of radius one, as far as it is within the outline:
// tiles are summed, then the tiles.

struct Mean {
    // Area of a pixel in discs of radius one.
    pixel_share: f32,
    tiles: u32,
}

const TILE: u32 = 64;

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var<storage, read> mean: Mean;
@group(0) @binding(2) var<storage, read_write> sums: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> result: array<vec4f>;
@group(0) @binding(4) var outline: texture_2d<f32>;
@group(0) @binding(5) var around: sampler;

var<workgroup> parts: array<vec4f, 64>;

// Adds up what the threads of a group hold; the first gets it all.
fn gathered(thread: u32, part: vec4f) -> vec4f {
    parts[thread] = part;
    workgroupBarrier();
    for (var half = 32u; half > 0u; half = half / 2u) {
        if thread < half {
            parts[thread] += parts[thread + half];
        }
        workgroupBarrier();
    }
    return parts[0];
}

// The sum of what is within the outline, from one pixel to another of a row.
fn edge_sum(ends: vec2u, y: u32, up: f32, pixel: f32) -> vec4f {
    var part = vec4f(0.0);
    for (var x = ends.x; x < ends.y; x++) {
        let at = vec2f(pixel * (f32(x) + 0.5) - EXTENT, up);
        part += within_limb(outline, around, at, pixel) * textureLoad(picture, vec2u(x, y), 0);
    }
    return part;
}

@compute @workgroup_size(64)
fn sum_tile(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(num_workgroups) tiles: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let size = textureDimensions(picture);
    let pixel = 2.0 * EXTENT / f32(size.x);
    let y = tile.y * TILE + thread;
    var part = vec4f(0.0);
    if y < size.y {
        let end = min(tile.x * TILE + TILE, size.x);
        let up = EXTENT - pixel * (f32(y) + 0.5);
        // From here to there no pixel is near the limb.
        let half = sqrt(max(INSIDE * INSIDE - up * up, 0.0)) / pixel - 1.0;
        let middle = 0.5 * f32(size.x);
        let first = tile.x * TILE;
        let inside = clamp(u32(max(middle - half, 0.0)), first, end);
        let outside = clamp(u32(max(middle + half, 0.0)), inside, end);
        part += edge_sum(vec2u(first, inside), y, up, pixel) + edge_sum(vec2u(outside, end), y, up, pixel);
        for (var x = inside; x < outside; x++) {
            part += textureLoad(picture, vec2u(x, y), 0);
        }
    }
    let all = gathered(thread, part);
    if thread == 0u {
        sums[tile.y * tiles.x + tile.x] = all;
    }
}

@compute @workgroup_size(64)
fn sum_all(@builtin(local_invocation_index) thread: u32) {
    var part = vec4f(0.0);
    for (var tile = thread; tile < mean.tiles; tile += 64u) {
        part += sums[tile];
    }
    let all = gathered(thread, part);
    if thread == 0u {
        result[0] = all * mean.pixel_share;
    }
}
