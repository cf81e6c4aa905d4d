// The picture on a window, pixel by pixel where it has the size of its place.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var reader: sampler;

// Whether the window turns light into codes by itself.
override TAKES_LIGHT: bool = false;

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) place: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) number: u32) -> Corner {
    // One triangle that covers the place.
    let place = vec2f(f32((number << 1u) & 2u), f32(number & 2u));
    return Corner(vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0), place);
}

// IEC 61966-2-1.
fn light_of_code(code: vec3f) -> vec3f {
    return select(pow((code + 0.055) / 1.055, vec3f(2.4)), code / 12.92, code <= vec3f(0.04045));
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let code = textureSampleLevel(picture, reader, corner.place, 0.0);
    if TAKES_LIGHT {
        return vec4f(light_of_code(code.rgb), 1.0);
    }
    return code;
}
