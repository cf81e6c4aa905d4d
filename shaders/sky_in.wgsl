// The light of the sky in directions that are given.

// Unit vectors in local axes (east, north, up).
@group(0) @binding(4) var<storage, read> dirs: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> lights: array<vec4f>;

@compute @workgroup_size(64)
fn sky_in(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&dirs) {
        lights[id.x] = skylight(dirs[id.x].xyz);
    }
}
