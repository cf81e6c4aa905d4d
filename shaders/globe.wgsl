// The Moon without air, on a square picture of its own: a mesh displaced by the relief, lit by the
// Sun and by the Earth. The Moon's north is up; the edges of the picture lie at EXTENT radii of the Moon
// as the observer sees them.

struct Globe {
    // Columns: right, up and away from the observer, in the Moon's own axes.
    body_from_picture: mat3x3f,
    // Columns: two axes across and the direction of the Sun, in the Moon's own axes.
    body_from_sun: mat3x3f,
    // Of the observer from the centre, in the Moon's own axes and its radii; in w how far he is.
    observer: vec4f,
    // In an eclipse, in radii of the Moon and its own axes: towards the Sun, in w the angle between Sun and
    // Earth at the rim of the Earth's shadow; towards the Earth, in w its distance.
    sun: vec4f,
    earth: vec4f,
    // In x, how much of what would hide the Sun hides the ground from the observer too.
    alike: vec4f,
}

// A band of the mesh around the point below the observer: rings of corners, each a full turn.
struct MeshBand {
    first: Radians,
    last: Radians,
    rings: u32,
    sectors: u32,
    // Whether its last ring is drawn out over the limb.
    is_skirt: u32,
}

// Only reckoned with: a branch that hung on it would have the software driver compile the shader anew.
@group(0) @binding(0) var<uniform> globe: Globe;
@group(0) @binding(1) var<storage, read> band: MeshBand;
// The near side: slopes of the ground along its two axes, elevation in radii of the Moon, reflectance at
// 566 nm.
@group(0) @binding(2) var relief: texture_2d<f32>;
// The near side: reflectances at 643 and 415 nm over that at 566 nm, less the least.
@group(0) @binding(3) var colours: texture_2d<f32>;
@group(0) @binding(4) var across_near_side: sampler;
// The share of the Sun's disc that is seen, by quick turn around the subsolar point and cosine of the angle
// from it.
@group(0) @binding(5) var shadows: texture_2d<f32>;
// By colour, what the ground scatters once and often over its reflectance, west to east and north to south.
@group(0) @binding(6) var once: texture_2d<f32>;
@group(0) @binding(7) var often: texture_2d<f32>;
@group(0) @binding(8) var around: sampler;
// What multiplies the one and the other, by the roots of the cosines of incidence, along x, and emission.
@group(0) @binding(9) var by_directions: texture_2d<f32>;
// What the Earth leaves of the Sun's light, by colour, from the axis of its shadow to the rim.
@group(0) @binding(10) var umbra: texture_2d<f32>;

// What a part of the ground may have: sunlight, shadows, the shadow of the Earth. Said for each pipeline, as the
// software driver reckons both sides of a branch.
override SUN: bool;
override SHADOWS: bool;
override ECLIPSE: bool;

// How far the skirt is drawn out.
const SKIRT: f32 = 1.03;
// Of the angle between the ground and the sight.
const LEAST_COSINE: f32 = 0.05;

struct Ground {
    @builtin(position) position: vec4f,
    // Outward direction of the smooth globe, in the Moon's own axes.
    @location(0) normal: vec3f,
    // What the law says of the ground around: no finer than the mesh.
    @location(1) once: vec3f,
    @location(2) often: vec3f,
}

// Given a direction in the Moon's own axes, its place on maps of all of it: west to east, north to south.
fn on_map(normal: vec3f) -> vec2f {
    let longitude = atan2(normal.y, normal.x);
    let latitude = atan2(normal.z, length(normal.xy));
    return vec2f(0.5 + longitude / (2.0 * PI), 0.5 - latitude / PI);
}

// Given a direction in the Moon's own axes, its place on the maps of the near side.
fn on_near_side(normal: vec3f) -> vec2f {
    return 0.5 + vec2f(normal.y, -normal.z) * (0.5 / MAP_EDGE * sqrt(2.0 / (1.0 + normal.x)));
}

// Given the number of a corner, ring by ring.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Ground {
    let corners = band.sectors + 1u;
    let theta = mix(band.first, band.last, f32(index / corners) / f32(band.rings));
    let turn = 2.0 * PI * f32(index % corners) / f32(band.sectors);
    let out = vec3f(sin(theta) * cos(turn), sin(theta) * sin(turn), -cos(theta));
    let normal = globe.body_from_picture * out;
    let elevation = textureSampleLevel(relief, across_near_side, on_near_side(normal), 0.0).z;
    let at = on_map(normal);
    let single = textureSampleLevel(once, around, at, 0.0).xyz;
    let multiple = textureSampleLevel(often, around, at, 0.0).xyz;
    let place = out * (1.0 + elevation);
    let distance = globe.observer.w;
    let from_observer = place + vec3f(0.0, 0.0, distance);
    let away = length(from_observer);
    let is_skirt = band.is_skirt == 1u;
    let reach = select(1.0, SKIRT, is_skirt && index / corners == band.rings);
    let seen = place.xy * (distance / away * reach / EXTENT);
    return Ground(vec4f(seen, 0.0, 1.0), normal, single, multiple);
}

// The share of the Sun that is seen from a point of the globe.
fn sunlit(in_sun: vec3f) -> f32 {
    let size = vec2f(textureDimensions(shadows));
    let row = (in_sun.z - COS_FIRST_SHADOW) / (COS_LAST_SHADOW - COS_FIRST_SHADOW);
    // Values belong to the nodes: the middles of the texels.
    let at = vec2f(quick_turn(in_sun.xy) + 0.5 / size.x, (row * (size.y - 1.0) + 0.5) / size.y);
    return textureSampleLevel(shadows, around, at, 0.0).x;
}

// What the Earth leaves of the Sun's light at a point of the globe, by colour.
fn beside_earth(outward: vec3f) -> vec3f {
    let to_earth = globe.earth.xyz - outward;
    let away = length(to_earth);
    // A point nearer to the Earth sees it larger.
    let chord = length(normalize(globe.sun.xyz - outward) - to_earth / away) * (away / globe.earth.w);
    let size = f32(textureDimensions(umbra).x);
    let at = min(chord / globe.sun.w, 1.0) * ((size - 1.0) / size) + 0.5 / size;
    return textureSampleLevel(umbra, across_near_side, vec2f(at, 0.5), 0.0).xyz;
}

// The radiance factor over the reflectance, by colour: see src/plan/globe/ground.rs.
fn law(ground: Ground, cos_incidence: f32, cos_emission: f32) -> vec3f {
    let size = f32(textureDimensions(by_directions).x);
    let node = sqrt(vec2f(cos_incidence, cos_emission)) * ((size - 1.0) / size) + 0.5 / size;
    let lit = textureSampleLevel(by_directions, across_near_side, node, 0.0).xy;
    return ground.once * lit.x + ground.often * lit.y;
}

// The sunlight that a place of the globe sends, by colour.
fn sunlight(ground: Ground, outward: vec3f, soil: vec4f, at: vec2f) -> vec3f {
    // Along the axes of the map, see src/plan/globe/near_side.rs.
    let bent = outward.yz / (1.0 + outward.x);
    let along = vec3f(-outward.y, 1.0 - bent.x * outward.y, -bent.x * outward.z);
    let up = vec3f(-outward.z, -bent.y * outward.y, 1.0 - bent.y * outward.z);
    let sloping = normalize(outward - along * soil.x - up * soil.y);
    // Slopes are finer than the mesh: what would face away from the observer is not what he sees there.
    let to_observer = normalize(globe.observer.xyz - outward);
    let hidden = max(LEAST_COSINE - dot(sloping, to_observer), 0.0);
    let normal = normalize(sloping + to_observer * hidden);
    // What stands in its own shadow, or in another's, is not seen aslant from where the Sun stands higher.
    let to_sun = globe.body_from_sun[2];
    let rise = dot(outward, to_sun) - dot(outward, to_observer);
    let seen_lit = globe.alike.x * smoothstep(-0.05, 0.0, rise);
    let cosine = dot(normal, to_sun);
    let cos_incidence = max(cosine, 0.0) + seen_lit * max(LEAST_COSINE - max(cosine, 0.0), 0.0);
    let cos_emission = max(dot(normal, to_observer), LEAST_COSINE);
    let ratios = textureSampleLevel(colours, across_near_side, at, 0.0).xy + vec2f(LEAST_RED, LEAST_BLUE);
    let reflectance = soil.w * vec3f(ratios.x, 1.0, ratios.y);
    var light = reflectance * law(ground, cos_incidence, cos_emission);
    if SHADOWS {
        light *= mix(sunlit(outward * globe.body_from_sun), 1.0, seen_lit);
    }
    if ECLIPSE {
        light *= beside_earth(outward);
    }
    return light;
}

@fragment
fn fragment(ground: Ground) -> @location(0) vec4f {
    let outward = normalize(ground.normal);
    let at = on_near_side(outward);
    let soil = textureSampleLevel(relief, across_near_side, at, 0.0);
    // The Earth stands behind the observer: its light comes back the way it went.
    var light = vec4f(vec3f(0.0), 0.5 * soil.w);
    if SUN {
        light = vec4f(sunlight(ground, outward, soil, at), light.w);
    }
    return light;
}
