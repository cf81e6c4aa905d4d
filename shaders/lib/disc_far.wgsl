// Where a pixel lies on a disc, whatever the field.
//
// A field of 0.02 degrees has pixels of 2e-7 radians, less than a direction in 32 bits can tell. All
// is therefore reckoned as a difference: from the point of the disc where the lowest node is seen,
// then from the centre of the disc. Small differences keep their digits: on the Moon, whose radius is the
// longest of them, 2e-9 radians. Narrower pictures have disc_near.wgsl.

// The sine of an angle over the angle, with all digits for small ones.
fn sinc(angle: Radians) -> f32 {
    let square = angle * angle;
    let series = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
    return select(sin(angle) / angle, series, square < 0.1);
}

// Given a point in pixels, the direction seen there in camera axes: right, up, and one less the
// cosine of the angle from the axis, in z; w is negative where there is no sky.
fn offset_from_pixel(pixel: vec2f) -> vec4f {
    let plane = plane_from_pixel(camera, pixel);
    let square = dot(plane, plane);
    switch camera.projection {
        case PERSPECTIVE: {
            let cosine = inverseSqrt(1.0 + square);
            return vec4f(plane * cosine, square * cosine * cosine / (1.0 + cosine), 1.0);
        }
        case STEREOGRAPHIC: {
            let scale = 1.0 / (1.0 + 0.25 * square);
            return vec4f(plane * scale, 0.5 * square * scale, 1.0);
        }
        case EQUAL_AREA: {
            let rest = 1.0 - 0.25 * square;
            return vec4f(plane * sqrt(max(rest, 0.0)), 0.5 * square, rest);
        }
        case EQUIRECTANGULAR: {
            let half = 0.5 * vec2f(sinc(0.5 * plane.x), sinc(0.5 * plane.y)) * plane;
            let level = 1.0 - 2.0 * half.y * half.y;
            let versine = 2.0 * half.y * half.y + 2.0 * level * half.x * half.x;
            let dir = vec2f(level * sinc(plane.x) * plane.x, sinc(plane.y) * plane.y);
            return vec4f(dir, versine, select(-1.0, 1.0, abs(plane.x) <= PI && abs(plane.y) <= 0.5 * PI));
        }
        default: {
            let radius = sqrt(square);
            let half = 0.5 * sinc(0.5 * radius) * radius;
            return vec4f(plane * sinc(radius), 2.0 * half * half, PI - radius);
        }
    }
}

// A point of the picture as the disc has it.
struct Across {
    // Place among the nodes by apparent altitude, 0 at the lowest; negative where nothing is seen.
    place: f32,
    // Sine of the azimuth from the centre, and one less its cosine.
    sin_azimuth: f32,
    versine_azimuth: f32,
}

const NOTHING = Across(-1e9, 0.0, 0.0);

// The same sight at another place among the nodes.
fn at_place(sight: Across, place: f32) -> Across {
    return Across(place, sight.sin_azimuth, sight.versine_azimuth);
}

// A point of the disc in a band.
struct Point {
    // Level and up, in radii; in z one less the cosine of its angle from the centre.
    at: vec3f,
    // Its squared distance from the middle, less one.
    over: f32,
}

// Given a point in pixels, where it lies across the disc.
fn across_at(pixel: vec2f) -> Across {
    let view = offset_from_pixel(pixel);
    if view.w < 0.0 {
        return NOTHING;
    }
    let off = camera.apparent_from_view * (view.xyz - disc.lowest_in_view.xyz);
    let flat = disc.lowest.xy + off.xy;
    let level = max(length(flat), 1e-12);
    // sin(a - b) = sin a cos b - cos a sin b, in differences from b.
    let narrowing = -off.z * (2.0 * disc.lowest.z + off.z) / (level + disc.lowest.w);
    let sine = off.z * disc.lowest.w - narrowing * disc.lowest.z;
    let above = sine * (1.0 + sine * sine / 6.0);
    let lengths = level * max(disc.lowest.w, 1e-12);
    let sin_azimuth = (off.x * disc.lowest.y - off.y * disc.lowest.x) / lengths;
    let cos_azimuth = sqrt(max(1.0 - sin_azimuth * sin_azimuth, 0.0));
    let ahead = dot(flat, disc.lowest.xy) >= 0.0;
    let near = sin_azimuth * sin_azimuth / (1.0 + cos_azimuth);
    return Across(above * disc.per_step, sin_azimuth, select(2.0 - near, near, ahead));
}

// Given a sight, the point of the disc in a band.
fn point_at(band: u32, sight: Across) -> Point {
    let node = min(u32(sight.place), NODES - 2u);
    let t = sight.place - f32(node);
    // Hermite's cubic through two nodes and their slopes.
    let low = bands[band].above_centre[node].xy;
    let high = bands[band].above_centre[node + 1u].xy;
    let gain = high.x - low.x;
    let bend = (low.y - gain) * (1.0 - t) - (high.y - gain) * t;
    let above = low.x + t * (gain + (1.0 - t) * bend);
    let half = 0.5 * above * sinc(0.5 * above);
    let versine = 2.0 * half * half;
    let sine = above * sinc(above);
    let cos_altitude = disc.centre.y * (1.0 - versine) - disc.centre.x * sine;
    let across = cos_altitude * sight.sin_azimuth;
    let up = sine + cos_altitude * disc.centre.x * sight.versine_azimuth;
    let away = versine + cos_altitude * disc.centre.y * sight.versine_azimuth;
    let flat = vec2f(across, up) / disc.centre.z;
    return Point(vec3f(flat, away), dot(flat, flat) - 1.0);
}

// How far a point is from the middle, less one, in radii.
fn beyond_limb(point: Point) -> f32 {
    return length(point.at.xy) - 1.0;
}

// How far a point of the disc is from what stands in front, less its radius; both as chords.
fn beside_occluder(point: Point) -> f32 {
    let off = point.at.xy * disc.centre.z - disc.occluder.xy;
    return length(vec3f(off, point.at.z - disc.occluder.z)) - disc.occluder.w;
}
