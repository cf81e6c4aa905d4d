// The sky and the ground below it, tile by tile. In a smooth tile the light is looked up in the
// corners and straight between; in the others it is looked up for each pixel.

@group(0) @binding(0) var<storage, read> camera: Camera;

// A corner of a tile and its light; straight on the picture, whatever the projection.
struct Corner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) light: vec4f,
}

// Given a tile by its first and last corners in pixels, one of its four.
fn corner_px(tile: vec4u, index: u32) -> vec2f {
    return vec2f(select(tile.xy, tile.zw, vec2(index & 1u, index >> 1u) == vec2(1u)));
}

// Given a point in pixels and the direction seen there, its altitude.
fn altitude_at(pixel: vec2f, dir: vec3f) -> Radians {
    let is_narrow = abs(sky.over_right) + abs(sky.over_down) > 0.0;
    return select(altitude_of(dir), sky.horizon + 2.0 * sky.half_pixel * over_px(pixel), is_narrow);
}

// Given a point in pixels of a narrow picture, how far it is over the horizon, in pixels.
fn over_px(pixel: vec2f) -> Pixels {
    let off = pixel - 0.5 * camera.size_px;
    return sky.middle_over + sky.over_right * off.x + sky.over_down * off.y;
}

// Given a corner that smooth tiles share, in pixels.
@vertex
fn smooth_vertex(@location(0) corner: vec2u) -> Corner {
    let pixel = vec2f(corner);
    let dir = apparent_from_pixel(camera, pixel).dir;
    let altitude = altitude_at(pixel, dir);
    let light = light_of_side(dir, altitude, altitude >= sky.horizon);
    return Corner(clip_from_pixel(camera, pixel), light);
}

@fragment
fn smooth_fragment(corner: Corner) -> @location(0) LuminanceXyzv {
    return corner.light;
}

@vertex
fn exact_vertex(
    @location(0) tile: vec4u,
    @builtin(vertex_index) index: u32,
) -> @builtin(position) vec4f {
    return clip_from_pixel(camera, corner_px(tile, index));
}

@fragment
fn exact_fragment(@builtin(position) position: vec4f) -> @location(0) LuminanceXyzv {
    let sight = apparent_from_pixel(camera, position.xy);
    if !sight.exists {
        return vec4f(0.0);
    }
    let altitude = altitude_at(position.xy, sight.dir);
    let is_narrow = abs(sky.over_right) + abs(sky.over_down) > 0.0;
    let height = select(0.5 * (altitude - sky.horizon) / sky.half_pixel, over_px(position.xy), is_narrow);
    let over = clamp(0.5 + height, 0.0, 1.0);
    if over > 0.0 && over < 1.0 {
        let ground = light_of_side(sight.dir, altitude, false);
        return mix(ground, light_of_side(sight.dir, altitude, true), over);
    }
    return light_of_side(sight.dir, altitude, over == 1.0);
}
