// What a camera records of the frame, developed and shown: the twin of src/photo/exposure.rs.
//
// The settings reach the fragments through the corners, flat: the software driver reads a uniform
// anew for each pixel, which would double the cost.

struct Setting {
    // Balanced channels as shares of saturation of X, Y and Z, cd/m2, on the axis.
    balanced_from_xyz: mat3x3f,
    // Linear RGB of the screen of balanced channels, and their luminance.
    rgb_from_balanced: mat3x3f,
    luminance_from_balanced: vec3f,
    // Over the square of the way from the centre, pixels.
    natural: f32,
    // Variance of a share for each share: counting.
    shot: vec3f,
    mechanical_root: f32,
    // Variance in the dark: reading.
    read: vec3f,
    seed: u32,
    // Luminance of the screen's RGB.
    luminance_from_rgb: vec3f,
    pad: f32,
    centre_px: vec2f,
}

struct Corner {
    @builtin(position) position: vec4f,
    // Rows of the matrices, with single numbers beside them.
    @location(0) @interpolate(flat) red_from_xyz: vec4f,
    @location(1) @interpolate(flat) green_from_xyz: vec4f,
    @location(2) @interpolate(flat) blue_from_xyz: vec4f,
    @location(3) @interpolate(flat) red_from_balanced: vec4f,
    @location(4) @interpolate(flat) green_from_balanced: vec4f,
    @location(5) @interpolate(flat) blue_from_balanced: vec4f,
    @location(6) @interpolate(flat) luminance: vec4f,
    @location(7) @interpolate(flat) shot: vec3f,
    @location(8) @interpolate(flat) read: vec3f,
    @location(9) @interpolate(flat) seed: u32,
    @location(10) off_centre_px: vec2f,
}

// Whether there is noise, whether the curve is that of film, and whether all is shown in red.
override IS_NOISY: bool = true;
override IS_FILM: bool = true;
override IS_RED: bool = false;

@group(0) @binding(0) var<uniform> setting: Setting;
@group(0) @binding(1) var frame: texture_2d<f32>;
// The nearest texel, which is that of the pixel: the software driver reads it faster than by number.
@group(0) @binding(2) var nearest: sampler;

// PCG3D of Jarzynski & Olano 2020.
fn pcg3d(seeds: vec3u) -> vec3u {
    var v = seeds * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// Noise of the three channels of a pixel: mean 0, variance 1.
fn sensor_noise(pixel: vec2u, seed: u32) -> vec3f {
    let hash = pcg3d(vec3u(pixel, seed));
    let pairs = (hash & vec3u(0x00ff00ffu)) + ((hash >> vec3u(8u)) & vec3u(0x00ff00ffu));
    let sum = (pairs & vec3u(0xffffu)) + (pairs >> vec3u(16u));
    return (vec3f(vec3i(sum)) - 510.0) * 0.0067658751;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    // One triangle that holds the whole picture.
    let clip = 4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    let recorded = transpose(setting.balanced_from_xyz);
    let shown = transpose(setting.rgb_from_balanced);
    let red = setting.luminance_from_rgb;
    return Corner(
        vec4f(clip, 0.0, 1.0),
        vec4f(recorded[0], setting.natural),
        vec4f(recorded[1], setting.mechanical_root),
        vec4f(recorded[2], 0.5 / setting.centre_px.x),
        vec4f(shown[0], red.x),
        vec4f(shown[1], red.y),
        vec4f(shown[2], red.z),
        vec4f(setting.luminance_from_balanced, 0.5 / setting.centre_px.y),
        setting.shot,
        setting.read,
        setting.seed,
        setting.centre_px * vec2f(clip.x, -clip.y),
    );
}

// The share of the light that the lens leaves.
fn falloff(corner: Corner) -> f32 {
    let square = dot(corner.off_centre_px, corner.off_centre_px);
    let natural = 1.0 + corner.red_from_xyz.w * square;
    let mechanical = corner.green_from_xyz.w * square;
    return (1.0 - mechanical * mechanical) / (natural * natural);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let pixel = corner.position.xy;
    // Across and down the picture, 0 to 1.
    let place = 0.5 + corner.off_centre_px * vec2f(corner.blue_from_xyz.w, corner.luminance.w);
    let light = textureSampleLevel(frame, nearest, place, 0.0).xyz * falloff(corner);
    // What the sensor records, the black level subtracted, balanced to white.
    var balanced = max(
        vec3f(
            dot(corner.red_from_xyz.xyz, light),
            dot(corner.green_from_xyz.xyz, light),
            dot(corner.blue_from_xyz.xyz, light),
        ),
        vec3f(0.0),
    );
    if IS_NOISY {
        let deviation = sqrt(balanced * corner.shot + corner.read);
        balanced += deviation * sensor_noise(vec2u(pixel), corner.seed);
    }
    balanced = min(balanced, vec3f(1.0));
    // What is shown of it.
    let linear = vec3f(
        dot(corner.red_from_balanced.xyz, balanced),
        dot(corner.green_from_balanced.xyz, balanced),
        dot(corner.blue_from_balanced.xyz, balanced),
    );
    var rgb = gamut(linear, dot(corner.luminance.xyz, balanced));
    if IS_FILM {
        rgb = rgb * (1.5 - 0.5 * rgb * rgb);
    }
    if IS_RED {
        let red = vec3f(corner.red_from_balanced.w, corner.green_from_balanced.w, corner.blue_from_balanced.w);
        rgb = vec3f(dot(red, rgb), 0.0, 0.0);
    }
    return shown_code(rgb, pixel);
}
