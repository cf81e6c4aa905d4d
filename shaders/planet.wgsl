// Planets: a flattened globe, and the rings of Saturn. The twin of src/plan/planet.rs. Lengths are radii
// of the equator, axes those of the disc: level, up, away from the observer.

struct Ring {
    inner: f32,
    outer: f32,
    // I/F where the globe does not shade it.
    brightness: f32,
    // Share of the light that passes it towards the observer, and from the Sun.
    to_observer: f32,
    from_sun: f32,
    padding: array<f32, 3>,
}

struct Planet {
    // North pole; in w the radius at the poles.
    pole: vec4f,
    // I/F where light falls and leaves straight.
    albedo: f32,
    // Of Minnaert's law, which stays as it is within a cosine of the limb.
    exponent: f32,
    limb_cosine: f32,
    // How far all of it reaches from the middle.
    reach: f32,
    ring_count: u32,
    is_lommel_seeliger: u32,
    belt_count: u32,
    // Half of the width of their edges, in the sine of the latitude.
    belt_edge: f32,
    // Sines of the planetographic latitudes of the edges, and the share of light that it takes.
    belts: array<vec4f, 8>,
    rings: array<Ring, 6>,
}

const NO_RING: u32 = 99;

@group(0) @binding(8) var<storage, read> planet: Planet;

// Makes the globe a ball.
fn stretched(v: vec3f) -> vec3f {
    return v + planet.pole.xyz * (dot(v, planet.pole.xyz) * (1.0 / planet.pole.w - 1.0));
}

// A sight and the globe: squared distance from its axis as a ball, in x, and where it begins, in y.
fn globe_on(at: vec2f) -> vec2f {
    let start = stretched(vec3f(at, 0.0));
    let along = stretched(vec3f(0.0, 0.0, 1.0));
    let a = dot(along, along);
    let b = dot(start, along);
    let beside = dot(start, start) - b * b / a;
    return vec2f(beside, -(b + sqrt(max(a * (1.0 - beside), 0.0))) / a);
}

// The number of the ring at a distance from the middle.
fn ring_at(radius: f32) -> u32 {
    for (var ring = 0u; ring < planet.ring_count; ring++) {
        if radius >= planet.rings[ring].inner && radius < planet.rings[ring].outer {
            return ring;
        }
    }
    return NO_RING;
}

// Where a line from a place meets the plane of the rings, in lengths of its direction; a line along the
// plane meets it far away.
fn to_plane(place: vec3f, dir: vec3f) -> f32 {
    let rise = dot(dir, planet.pole.xyz);
    return -dot(place, planet.pole.xyz) / select(rise, 1e-7, abs(rise) < 1e-7);
}

fn planet_law(cos_incidence: f32, cos_emission: f32) -> f32 {
    if planet.is_lommel_seeliger == 1u {
        return 2.0 * cos_incidence / (cos_incidence + cos_emission);
    }
    let emission = max(cos_emission, planet.limb_cosine);
    return pow(cos_incidence, planet.exponent) * pow(emission, planet.exponent - 1.0);
}

// Share of light that belts leave.
fn through_belts(sin_latitude: f32) -> f32 {
    var left = 1.0;
    for (var belt = 0u; belt < planet.belt_count; belt++) {
        let edges = planet.belts[belt];
        let inside = smoothstep(-planet.belt_edge, planet.belt_edge, sin_latitude - edges.x)
            * smoothstep(-planet.belt_edge, planet.belt_edge, edges.y - sin_latitude);
        left *= 1.0 - edges.z * inside;
    }
    return left;
}

fn globe_light(place: vec3f) -> f32 {
    let normal = normalize(stretched(stretched(place)));
    let cos_incidence = dot(normal, disc.to_sun.xyz);
    if cos_incidence <= 0.0 {
        return 0.0;
    }
    let light = planet.albedo * planet_law(cos_incidence, max(-normal.z, 0.0))
        * through_belts(dot(normal, planet.pole.xyz));
    let way = to_plane(place, disc.to_sun.xyz);
    if planet.ring_count == 0u || way <= 0.0 {
        return light;
    }
    let ring = ring_at(length(place + disc.to_sun.xyz * way));
    if ring == NO_RING {
        return light;
    }
    return light * planet.rings[ring].from_sun;
}

// Whether the globe stands between a place and the Sun.
fn is_shaded(place: vec3f) -> bool {
    let to_sun = normalize(stretched(disc.to_sun.xyz));
    let ball = stretched(place);
    let along = dot(ball, to_sun);
    return along < 0.0 && dot(ball, ball) - along * along < 1.0;
}

// The shape of the light at a point of the disc.
fn planet_at(at: vec2f) -> f32 {
    let globe = globe_on(at);
    let has_globe = globe.x < 1.0;
    var light = 0.0;
    if planet.ring_count > 0u {
        let way = to_plane(vec3f(at, 0.0), vec3f(0.0, 0.0, 1.0));
        let place = vec3f(at, way);
        let ring = ring_at(length(place));
        if ring != NO_RING && !(has_globe && globe.y < way) {
            light = select(planet.rings[ring].brightness, 0.0, is_shaded(place));
            if has_globe {
                light += planet.rings[ring].to_observer * globe_light(vec3f(at, globe.y));
            }
            return light;
        }
    }
    if has_globe {
        light = globe_light(vec3f(at, globe.y));
    }
    return light;
}

// Given a point in pixels, the light of the planet there; none below the horizon.
fn planet_light(pixel: vec2f) -> LuminanceXyzv {
    let sight = across_at(pixel);
    var light = vec4f(0.0);
    if !is_on_disc(sight) {
        return light;
    }
    let node = min(u32(sight.place), NODES - 2u);
    let along = sight.place - f32(node);
    for (var band = 0u; band < disc.bands; band++) {
        let point = point_at(band, sight);
        if length(point.at.xy) < planet.reach && point.at.z < 0.5 && beside_occluder(point) >= 0.0 {
            let luminance =
                mix(bands[band].luminance[node], bands[band].luminance[node + 1u], along);
            light += luminance * planet_at(point.at.xy);
        }
    }
    return light;
}

// The light of a surface whose shape is one, of all bands together.
fn luminance_at(sight: Across) -> LuminanceXyzv {
    let node = min(u32(sight.place), NODES - 2u);
    let along = sight.place - f32(node);
    var light = vec4f(0.0);
    for (var band = 0u; band < disc.bands; band++) {
        light += mix(bands[band].luminance[node], bands[band].luminance[node + 1u], along);
    }
    return light;
}

// How far, at least, a point of the disc is from the nearest limb or edge of a ring.
fn beside_edges(at: vec2f) -> f32 {
    var least = abs(sqrt(globe_on(at).x) - 1.0) * planet.pole.w;
    if planet.ring_count > 0u {
        let way = to_plane(vec3f(at, 0.0), vec3f(0.0, 0.0, 1.0));
        let radius = length(vec3f(at, way));
        for (var ring = 0u; ring < planet.ring_count; ring++) {
            let off = min(abs(radius - planet.rings[ring].inner), abs(radius - planet.rings[ring].outer));
            least = min(least, off * abs(planet.pole.z));
        }
    }
    return least;
}

// How a pixel is sampled.
struct Sampling {
    // Samples, none outside, and the turn of their lattice.
    lattice: vec2u,
    // Whether its colours are taken together: no limb and no edge of a ring is near, and the disc is nearly
    // full, so that what the middle colour wins at one limb it loses at the other.
    is_together: bool,
}

// As `lattice_at` for a planet.
fn planet_sampling(middle: vec2f) -> Sampling {
    let outside = Sampling(vec2u(0u), false);
    let sight = across_at(middle);
    let margin = disc.edge * disc.centre.z;
    let low = sight.place / disc.per_step;
    let high = (sight.place - f32(NODES - 1u)) / disc.per_step;
    if low < -margin || high > margin {
        return outside;
    }
    let nearest = at_place(sight, clamp(sight.place, 0.0, f32(NODES - 1u)));
    let point = point_at(disc.bands / 2u, nearest);
    let at = point.at;
    let beside = beside_edges(at.xy);
    let is_empty = globe_on(at.xy).x > 1.0 && planet.ring_count == 0u && beside > disc.edge;
    if length(at.xy) > planet.reach + disc.edge || at.z > 0.5 || is_empty {
        return outside;
    }
    let is_inside = low > margin && high < -margin && beside > disc.edge
        && abs(beside_occluder(point)) > margin;
    let is_full = disc.to_sun.z < -0.9;
    return Sampling(select(disc.samples.zw, disc.samples.xy, is_inside), is_inside && is_full);
}

@fragment
fn planet_fragment(@builtin(position) position: vec4f) -> @location(0) LuminanceXyzv {
    let first = floor(position.xy);
    let sampling = planet_sampling(first + 0.5);
    let count = sampling.lattice.x;
    var sum = vec4f(0.0);
    var shapes = 0.0;
    for (var k = 0u; k < count; k++) {
        let row = (k * sampling.lattice.y) % count;
        let pixel = first + (vec2f(f32(k), f32(row)) + 0.5) / f32(count);
        if sampling.is_together {
            // All colours of a smooth surface as the middle one.
            let point = point_at(disc.bands / 2u, across_at(pixel));
            shapes += select(planet_at(point.at.xy), 0.0, beside_occluder(point) < 0.0);
        } else {
            sum += planet_light(pixel);
        }
    }
    if sampling.is_together {
        sum = luminance_at(across_at(first + 0.5)) * shapes;
    }
    return sum / f32(max(count, 1u));
}
