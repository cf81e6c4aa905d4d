// The Moon without air, on a square picture of its own: a mesh displaced by the relief, lit by the
// Sun and by the Earth. The picture has axes of the disc: level to the right, up; its edges lie at
// `extent` radii of the Moon as the observer sees them.

struct Globe {
    // Columns: level, up and away from the observer, in the Moon's own axes.
    body_from_disc: mat3x3f,
    // Columns: two axes across and the direction of the Sun, in the Moon's own axes.
    body_from_sun: mat3x3f,
    // Of the observer, in radii of the Moon.
    distance: f32,
    extent: f32,
    // Angles from the subsolar point, of the first and last row of the shadows.
    first_shadow: Radians,
    last_shadow: Radians,
    // Single-scattering albedo over that at 566 nm, by colour.
    darkness: vec4f,
    // In an eclipse, in radii of the Moon and its own axes: towards the Sun, in w the angle between Sun and
    // Earth at the rim of the Earth's shadow; towards the Earth, in w its distance.
    sun: vec4f,
    earth: vec4f,
}

// A band of the mesh around the point below the observer: rings of corners, each a full turn.
struct MeshBand {
    first: Radians,
    last: Radians,
    rings: u32,
    sectors: u32,
}

@group(0) @binding(0) var<storage, read> globe: Globe;
@group(0) @binding(1) var<storage, read> band: MeshBand;
// Slope of the ground to the east and to the north, and elevation in radii of the Moon.
@group(0) @binding(2) var relief: texture_2d<f32>;
// Reflectances at 643, 566 and 415 nm.
@group(0) @binding(3) var albedo: texture_2d<f32>;
// The share of the Sun's disc that is seen, by azimuth around the subsolar point and angle from it.
@group(0) @binding(4) var shadows: texture_2d<f32>;
@group(0) @binding(5) var across_maps: sampler;
// By colour, what grains scatter once over the reflectance, and a quarter of what they scatter often; in
// w of the first the single-scattering albedo at 566 nm.
@group(0) @binding(6) var once: texture_2d<f32>;
@group(0) @binding(7) var often: texture_2d<f32>;
// What roughness makes of the cosines of incidence, along x, and emission, along y, at nodes in steps of
// their roots: effective cosines, and the light that is left.
@group(0) @binding(8) var facets: texture_2d<f32>;
@group(0) @binding(9) var across_facets: sampler;
// What the Earth leaves of the Sun's light, by colour, from the axis of its shadow to the rim.
@group(0) @binding(10) var umbra: texture_2d<f32>;

struct Ground {
    @builtin(position) position: vec4f,
    // Outward direction of the smooth globe, in the Moon's own axes.
    @location(0) normal: vec3f,
    // What the law says of the ground around: no finer than the mesh.
    @location(1) once: vec4f,
    @location(2) often: vec3f,
}

// Given a direction in the Moon's own axes, its place on the maps: west to east, north to south.
fn on_map(normal: vec3f) -> vec2f {
    let longitude = atan2(normal.y, normal.x);
    let latitude = atan2(normal.z, length(normal.xy));
    return vec2f(0.5 + longitude / (2.0 * PI), 0.5 - latitude / PI);
}

// Given the number of a corner, ring by ring.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Ground {
    let corners = band.sectors + 1u;
    let theta = mix(band.first, band.last, f32(index / corners) / f32(band.rings));
    let turn = 2.0 * PI * f32(index % corners) / f32(band.sectors);
    let out = vec3f(sin(theta) * cos(turn), sin(theta) * sin(turn), -cos(theta));
    let normal = globe.body_from_disc * out;
    let at = on_map(normal);
    let elevation = textureSampleLevel(relief, across_maps, at, 0.0).z;
    let single = textureSampleLevel(once, across_maps, at, 0.0);
    let multiple = textureSampleLevel(often, across_maps, at, 0.0).xyz;
    let place = out * (1.0 + elevation);
    let from_observer = place + vec3f(0.0, 0.0, globe.distance);
    let away = length(from_observer);
    let seen = place.xy * (globe.distance / away);
    // From in front of the nearest mountain to behind the centre.
    let depth = (away - globe.distance + 1.02) / 1.2;
    return Ground(vec4f(seen / globe.extent, depth, 1.0), normal, single, multiple);
}

// The share of the Sun that is seen from a point of the globe.
fn sunlit(in_sun: vec3f) -> f32 {
    if in_sun.z >= cos(globe.first_shadow) {
        return 1.0;
    }
    if in_sun.z <= cos(globe.last_shadow) {
        return 0.0;
    }
    let angle = acos(in_sun.z);
    let size = vec2f(textureDimensions(shadows));
    let turn = atan2(in_sun.y, in_sun.x) / (2.0 * PI);
    let row = (angle - globe.first_shadow) / (globe.last_shadow - globe.first_shadow);
    // Values belong to the nodes: the middles of the texels.
    let at = vec2f(fract(turn) + 0.5 / size.x, (row * (size.y - 1.0) + 0.5) / size.y);
    return textureSampleLevel(shadows, across_maps, at, 0.0).x;
}

// What the Earth leaves of the Sun's light at a point of the globe, by colour.
fn beside_earth(outward: vec3f) -> vec3f {
    if globe.sun.w == 0.0 {
        return vec3f(1.0);
    }
    let to_earth = globe.earth.xyz - outward;
    let away = length(to_earth);
    // A point nearer to the Earth sees it larger.
    let chord = length(normalize(globe.sun.xyz - outward) - to_earth / away) * (away / globe.earth.w);
    let size = f32(textureDimensions(umbra).x);
    let at = min(chord / globe.sun.w, 1.0) * ((size - 1.0) / size) + 0.5 / size;
    return textureSampleLevel(umbra, across_facets, vec2f(at, 0.5), 0.0).xyz;
}

// Chandrasekhar's function, by colour, in Hapke's approximation; dim is the root of 1 - w.
fn h_function(cosine: f32, dim: vec3f) -> vec3f {
    return (1.0 + 2.0 * cosine) / (1.0 + 2.0 * cosine * dim);
}

// The radiance factor over the reflectance, by colour: Hapke 2012, see src/light/moon/hapke.rs.
fn law(ground: Ground, cos_incidence: f32, cos_emission: f32) -> vec3f {
    let size = f32(textureDimensions(facets).x);
    let node = sqrt(vec2f(cos_incidence, cos_emission)) * ((size - 1.0) / size) + 0.5 / size;
    let facet = textureSampleLevel(facets, across_facets, node, 0.0);
    let dim = sqrt(max(1.0 - ground.once.w * globe.darkness.xyz, vec3f(0.0)));
    let again = h_function(facet.x, dim) * h_function(facet.y, dim) - 1.0;
    return (ground.once.xyz + ground.often * again) * (facet.x / (facet.x + facet.y) * facet.z);
}

@fragment
fn fragment(ground: Ground) -> @location(0) vec4f {
    let outward = normalize(ground.normal);
    let at = on_map(outward);
    let slopes = textureSampleLevel(relief, across_maps, at, 0.0).xy;
    let reflectance = textureSampleLevel(albedo, across_maps, at, 0.0).xyz;
    let level = max(length(outward.xy), 1e-6);
    let east = vec3f(-outward.y, outward.x, 0.0) / level;
    let north = cross(outward, east);
    let normal = normalize(outward - east * slopes.x - north * slopes.y);
    let observer = -globe.body_from_disc[2] * globe.distance;
    let cos_emission = max(dot(normal, normalize(observer - outward)), 0.02);
    let in_sun = outward * globe.body_from_sun;
    let cos_incidence = max(dot(normal, globe.body_from_sun[2]), 0.0);
    // The Earth stands behind the observer: its light comes back the way it went.
    let earthlit = 0.5 * reflectance.y;
    let sun = sunlit(in_sun);
    if cos_incidence <= 0.0 || sun == 0.0 {
        return vec4f(vec3f(0.0), earthlit);
    }
    let light = beside_earth(outward) * sun;
    return vec4f(reflectance * law(ground, cos_incidence, cos_emission) * light, earthlit);
}
