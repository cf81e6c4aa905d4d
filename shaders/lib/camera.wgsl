// The camera's projections, as in src/camera.rs: the same names, in 32 bits.

struct Camera {
    // Columns: the camera's right, up and backward axes in local axes (east, north, up).
    apparent_from_view: mat3x3f,
    size_px: vec2f,
    focal_px: Pixels,
    projection: u32,
}

const PERSPECTIVE: u32 = 0;
const STEREOGRAPHIC: u32 = 1;
const EQUIDISTANT: u32 = 2;
const EQUAL_AREA: u32 = 3;
const EQUIRECTANGULAR: u32 = 4;

// A direction and whether the plane has one there.
struct Sight {
    dir: vec3f,
    exists: bool,
}

// Given a point in pixels, the point on the plane in focal lengths, y up.
fn plane_from_pixel(camera: Camera, pixel: vec2f) -> vec2f {
    let off_centre = (pixel - 0.5 * camera.size_px) / camera.focal_px;
    return vec2f(off_centre.x, -off_centre.y);
}

// Given the distance from the centre in focal lengths, the angle from it; negative for no sky.
fn theta_from_radius(projection: u32, radius: f32) -> Radians {
    switch projection {
        case PERSPECTIVE: { return atan(radius); }
        case STEREOGRAPHIC: { return 2.0 * atan(0.5 * radius); }
        case EQUAL_AREA: {
            // The arctangent keeps its digits where the arcsine of a GPU does not.
            let half = min(0.5 * radius, 1.0);
            return select(2.0 * atan2(half, sqrt(1.0 - half * half)), -1.0, radius > 2.0);
        }
        default: { return select(radius, -1.0, radius > PI); }
    }
}

// Given a point in pixels, the direction seen there in camera axes.
fn view_from_pixel(camera: Camera, pixel: vec2f) -> Sight {
    let plane = plane_from_pixel(camera, pixel);
    if camera.projection == EQUIRECTANGULAR {
        let dir = vec3f(cos(plane.y) * sin(plane.x), sin(plane.y), -cos(plane.y) * cos(plane.x));
        return Sight(dir, abs(plane.x) <= PI && abs(plane.y) <= 0.5 * PI);
    }
    let radius = length(plane);
    let theta = theta_from_radius(camera.projection, radius);
    let scale = select(1.0, sin(theta) / radius, radius > 1e-6);
    return Sight(vec3f(plane * scale, -cos(theta)), theta >= 0.0);
}

// Given a point in pixels, the apparent direction seen there in local axes (east, north, up).
fn apparent_from_pixel(camera: Camera, pixel: vec2f) -> Sight {
    let sight = view_from_pixel(camera, pixel);
    return Sight(normalize(camera.apparent_from_view * sight.dir), sight.exists);
}

// Given the centre of a pixel, the solid angle that it sees; zero where there is no sky.
fn pixel_solid_angle(camera: Camera, pixel: vec2f) -> Steradians {
    let plane = plane_from_pixel(camera, pixel);
    let focal_squared = camera.focal_px * camera.focal_px;
    if camera.projection == EQUIRECTANGULAR {
        let exists = abs(plane.x) <= PI && abs(plane.y) <= 0.5 * PI;
        return select(0.0, cos(plane.y) / focal_squared, exists);
    }
    let theta = theta_from_radius(camera.projection, length(plane));
    if theta < 0.0 {
        return 0.0;
    }
    var per_area = 1.0;
    switch camera.projection {
        case PERSPECTIVE: { let c = cos(theta); per_area = c * c * c; }
        case STEREOGRAPHIC: { let c = cos(0.5 * theta); per_area = c * c * c * c; }
        case EQUIDISTANT: { per_area = select(sin(theta) / theta, 1.0 - theta * theta / 6.0, theta < 1e-2); }
        default: {}
    }
    return per_area / focal_squared;
}

// Three corners of a triangle that covers the picture, in clip space.
fn full_screen_corner(index: u32) -> vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// Given a point in pixels, its place in clip space.
fn clip_from_pixel(camera: Camera, pixel: vec2f) -> vec4f {
    let unit = pixel / camera.size_px;
    return vec4f(2.0 * unit.x - 1.0, 1.0 - 2.0 * unit.y, 0.0, 1.0);
}
