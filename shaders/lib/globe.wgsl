// The globe of the Moon and its picture: numbers of src/plan/globe and src/render/globe_maps.rs.

// Half of the edge of the picture, in radii of the Moon.
const EXTENT: f32 = 1.01;
// Half of the edge of the maps of the near side.
const MAP_EDGE: f32 = 1.61;
// Cosines of the angles from the subsolar point of the first and the last row of the shadows.
const COS_FIRST_SHADOW: f32 = 0.52991926;
const COS_LAST_SHADOW: f32 = -0.12186934;
// Least ratios that a texel of colours holds.
const LEAST_RED: f32 = 0.6;
const LEAST_BLUE: f32 = 0.3;
// Within this no valley of the limb reaches, in radii of the Moon; and what a texel of the outline counts in.
const INSIDE: f32 = 0.99;
const OUTLINE_UNIT: f32 = 0.01;

// Given a direction, the share of a turn from x through y, in steps that are not quite even: the twin of
// `share` in src/plan/globe/turn.rs.
fn quick_turn(direction: vec2f) -> f32 {
    let x = direction.x / max(abs(direction.x) + abs(direction.y), 1e-9);
    return 0.25 * select(3.0 + x, 1.0 - x, direction.y >= 0.0);
}

// Given a point of the picture in radii of the Moon, the part of a pixel of that width around it that is
// within the outline.
fn within_limb(outline: texture_2d<f32>, around: sampler, at: vec2f, width: f32) -> f32 {
    // Values belong to the nodes: the middles of the texels.
    let place = vec2f(quick_turn(at) + 0.5 / f32(textureDimensions(outline).x), 0.5);
    let limb = 1.0 + OUTLINE_UNIT * textureSampleLevel(outline, around, place, 0.0).x;
    return clamp((limb - length(at)) / width + 0.5, 0.0, 1.0);
}
