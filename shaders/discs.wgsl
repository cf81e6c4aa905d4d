// Spheres that show a disc: the Sun, the Moon, and planets when the field is narrow.

const NODES: u32 = 9;

struct Disc {
    // Corners of the pixels that the disc can touch.
    first_px: vec2f,
    last_px: vec2f,
    // Geometric direction of the centre, and the sine of the angular radius, in w.
    centre: vec4f,
    // From the body to the Sun; w is the law: 0 Sun, 1 Moon, 2 Lambert.
    to_sun: vec4f,
    // Rows: the body's own axes in local ones.
    body_from_horizon: mat3x3f,
    // Limb darkening: I(mu) / I(1) = sum of a_k mu^k.
    limb: array<vec4f, 2>,
    // Apparent altitude of the lowest node, step between nodes, samples per pixel and axis.
    lowest_rad: f32,
    step_rad: f32,
    samples: u32,
    map_width: u32,
    // What stands in front: geometric direction, and the sine of its angular radius in w.
    occluder: vec4f,
    // By apparent altitude across the disc: the luminance of a surface whose shape is one,
    // seen through the air, and the geometric altitude.
    luminance: array<vec4f, NODES>,
    geometric_altitude: array<vec4f, NODES>,
}

const SUN: u32 = 0;
const MOON: u32 = 1;

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var<uniform> disc: Disc;
// Relative albedo, longitude -180 to 180 along x, latitude 90 to -90 down y.
@group(0) @binding(2) var<storage, read> albedo: array<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return clip_from_pixel(camera, mix(disc.first_px, disc.last_px, corner));
}

// Given the outward normal in the body's own axes, the relative albedo there.
fn albedo_at(normal: vec3f) -> f32 {
    let width = i32(disc.map_width);
    let height = width / 2;
    let longitude = atan2(normal.y, normal.x);
    let latitude = atan2(normal.z, length(normal.xy));
    let x = (longitude / PI * 0.5 + 0.5) * f32(width) - 0.5;
    let y = clamp((0.5 - latitude / PI) * f32(height) - 0.5, 0.0, f32(height) - 1.0);
    let x0 = i32(floor(x));
    let y0 = min(i32(y), height - 2);
    let left = (x0 + width) % width;
    let right = (x0 + 1) % width;
    let top = mix(albedo[y0 * width + left], albedo[y0 * width + right], x - f32(x0));
    let low = (y0 + 1) * width;
    let bottom = mix(albedo[low + left], albedo[low + right], x - f32(x0));
    return mix(top, bottom, y - f32(y0));
}

// Given the outward normal and the cosine of emission, the shape of the light on the disc.
fn shape(normal: vec3f, cos_emission: f32) -> f32 {
    let law = u32(disc.to_sun.w);
    if law == SUN {
        let m = cos_emission;
        let low = disc.limb[0];
        let high = disc.limb[1];
        return low.x + m * (low.y + m * (low.z + m * (low.w + m * (high.x + m * high.y))));
    }
    let cos_incidence = dot(normal, disc.to_sun.xyz);
    if cos_incidence <= 0.0 {
        return 0.0;
    }
    if law == MOON {
        // Lommel and Seeliger: no limb darkening at full phase.
        let lit = cos_incidence / (cos_incidence + cos_emission);
        return lit * albedo_at(disc.body_from_horizon * normal);
    }
    return cos_incidence;
}

// Given a point in pixels, the light of the disc there; none below the horizon.
fn light_at(pixel: vec2f) -> LuminanceXyzv {
    let sight = apparent_from_pixel(camera, pixel);
    if !sight.exists || sight.dir.z < 0.0 {
        return vec4f(0.0);
    }
    let flat = length(sight.dir.xy);
    let apparent = atan2(sight.dir.z, flat);
    let place = clamp((apparent - disc.lowest_rad) / disc.step_rad, 0.0, f32(NODES - 1u));
    let node = min(u32(place), NODES - 2u);
    let along = place - f32(node);
    let altitude = mix(disc.geometric_altitude[node].x, disc.geometric_altitude[node + 1u].x, along);
    let level = select(vec2f(0.0), sight.dir.xy / flat, flat > 0.0);
    let dir = vec3f(level * cos(altitude), sin(altitude));
    let off_centre = (dir - disc.centre.xyz * dot(dir, disc.centre.xyz)) / disc.centre.w;
    let squared = dot(off_centre, off_centre);
    if squared >= 1.0 || dot(dir, disc.centre.xyz) < 0.0 {
        return vec4f(0.0);
    }
    let beside = length(cross(dir, disc.occluder.xyz));
    if beside < disc.occluder.w && dot(dir, disc.occluder.xyz) > 0.0 {
        return vec4f(0.0);
    }
    let cos_emission = sqrt(1.0 - squared);
    let normal = off_centre - disc.centre.xyz * cos_emission;
    return mix(disc.luminance[node], disc.luminance[node + 1u], along) * shape(normal, cos_emission);
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) LuminanceXyzv {
    let first = floor(position.xy);
    var sum = vec4f(0.0);
    for (var y = 0u; y < disc.samples; y++) {
        for (var x = 0u; x < disc.samples; x++) {
            let within = (vec2f(f32(x), f32(y)) + 0.5) / f32(disc.samples);
            sum += light_at(first + within);
        }
    }
    return sum / f32(disc.samples * disc.samples);
}
