// What a camera records of the frame, developed and shown: the twin of src/photo/exposure.rs.

struct Exposure {
    // Channels as shares of saturation of X, Y and Z, cd/m2, on the axis.
    raw_from_xyz: mat3x3f,
    // X, Y and Z as shares of the screen's white, of balanced channels.
    xyz_from_balanced: mat3x3f,
    balance: vec3f,
    // Variance of a share for each share: counting.
    shot: f32,
    centre_px: vec2f,
    // Over the squares of the focal length and of the way to the corner, pixels.
    natural: f32,
    mechanical_root: f32,
    // Variance in the dark: reading.
    read: f32,
    seed: u32,
}

struct Setting {
    exposure: Exposure,
    display: Display,
}

// Whether there is noise, and whether the curve is that of film.
override IS_NOISY: bool = true;
override IS_FILM: bool = true;

@group(0) @binding(0) var<uniform> setting: Setting;
@group(0) @binding(1) var frame: texture_2d<f32>;

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

// The share of the light that the lens leaves.
fn falloff(exposure: Exposure, pixel: vec2f) -> f32 {
    let off = pixel - exposure.centre_px;
    let square = dot(off, off);
    let natural = 1.0 + exposure.natural * square;
    let mechanical = exposure.mechanical_root * square;
    return (1.0 - mechanical * mechanical) / (natural * natural);
}

// Given the light of a pixel, shares of saturation, the black level subtracted.
fn raw(exposure: Exposure, light: LuminanceXyzv, pixel: vec2f) -> vec3f {
    let mean = max(exposure.raw_from_xyz * light.xyz * falloff(exposure, pixel), vec3f(0.0));
    var recorded = mean;
    if IS_NOISY {
        let deviation = sqrt(mean * exposure.shot + exposure.read);
        recorded += deviation * sensor_noise(vec2u(pixel), exposure.seed);
    }
    return min(recorded, vec3f(1.0));
}

// Given what was recorded, linear RGB of the screen, within its gamut.
fn developed(exposure: Exposure, display: Display, raw: vec3f) -> vec3f {
    let balanced = min(raw * exposure.balance, vec3f(1.0));
    let xyz = exposure.xyz_from_balanced * balanced;
    let rgb = gamut(display.rgb_from_xyz * xyz, xyz.y);
    if IS_FILM {
        let room = 1.0 - min(rgb, vec3f(1.0));
        return 1.0 - room * sqrt(room);
    }
    return rgb;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that holds the whole picture.
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(4.0 * corner - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let light = textureLoad(frame, vec2i(position.xy), 0);
    let recorded = raw(setting.exposure, light, position.xy);
    let rgb = developed(setting.exposure, setting.display, recorded);
    return rgb_code(setting.display, rgb, position.xy);
}
