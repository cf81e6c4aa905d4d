// Points of light: each is spread over 4 x 4 pixels and added.

struct Splat {
    @location(0) centre_px: vec2f,
    // For fragment_of_even_pixels over the solid angle of a pixel.
    @location(1) illuminance: vec4f,
}

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) centre_px: vec2f,
    @location(1) @interpolate(flat) illuminance: vec4f,
}

@group(0) @binding(0) var<storage, read> camera: Camera;

@vertex
fn vertex(splat: Splat, @builtin(vertex_index) index: u32) -> Corner {
    // The pixels whose centres lie within two pixels of the splat's centre.
    let first = floor(splat.centre_px - 0.5) - 1.0;
    let corner = first + 4.0 * vec2f(f32(index & 1u), f32(index >> 1u));
    return Corner(clip_from_pixel(camera, corner), splat.centre_px, splat.illuminance);
}

// Where pixels of a splat differ in solid angle.
@fragment
fn fragment(corner: Corner) -> @location(0) LuminanceXyzv {
    let off = corner.position.xy - corner.centre_px;
    let share = cubic_b_spline(off.x) * cubic_b_spline(off.y);
    let solid_angle = pixel_solid_angle(camera, corner.position.xy);
    if solid_angle <= 0.0 {
        return vec4f(0.0);
    }
    return corner.illuminance * (share / solid_angle);
}

// Where they do not.
@fragment
fn fragment_of_even_pixels(corner: Corner) -> @location(0) LuminanceXyzv {
    let off = corner.position.xy - corner.centre_px;
    return corner.illuminance * (cubic_b_spline(off.x) * cubic_b_spline(off.y));
}
