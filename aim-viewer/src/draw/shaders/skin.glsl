// Numbers of the figures, one after the other: three rows a joint, world ← mesh, then weights of morph targets, four a texel.
uniform highp sampler2D numbers;
// Two texels for each vertex that a morph target moves: the way of its place with the target's index, and of its normal.
uniform highp sampler2D shifts;
// Texels of a figure, and those of its joints.
uniform int stride;
uniform int rows;

in vec3 position;
in uvec4 joints;
in vec4 weights;
// The first of the vertex's shifts, and their number.
in uvec2 shifted;

vec4 texel(highp sampler2D texels, int at) {
    ivec2 size = textureSize(texels, 0);
    // Rows are sent from the last to the first.
    return texelFetch(texels, ivec2(at % size.x, size.y - 1 - at / size.x), 0);
}

// Place and direction in the world of the vertex with this normal: morphed, then moved by the mean of its joints.
void skin(vec3 normal, out vec3 place, out vec3 direction) {
    int figure = gl_InstanceID * stride;
    vec4 morphed = vec4(position, 1.0);
    for (uint k = 0u; k < shifted.y; k++) {
        int at = 2 * int(shifted.x + k);
        vec4 shift = texel(shifts, at);
        int target = int(shift.w);
        float weight = texel(numbers, figure + rows + target / 4)[target % 4];
        morphed.xyz += weight * shift.xyz;
        normal += weight * texel(shifts, at + 1).xyz;
    }
    vec4 x = vec4(0.0);
    vec4 y = vec4(0.0);
    vec4 z = vec4(0.0);
    for (int k = 0; k < 4; k++) {
        if (weights[k] != 0.0) {
            int at = figure + 3 * int(joints[k]);
            x += weights[k] * texel(numbers, at);
            y += weights[k] * texel(numbers, at + 1);
            z += weights[k] * texel(numbers, at + 2);
        }
    }
    place = vec3(dot(x, morphed), dot(y, morphed), dot(z, morphed));
    // Normals turn by the cofactors: the inverse's transpose times the determinant, whose sign a mirror has changed.
    vec3 turned = vec3(
        dot(cross(y.xyz, z.xyz), normal), dot(cross(z.xyz, x.xyz), normal), dot(cross(x.xyz, y.xyz), normal));
    if (dot(x.xyz, cross(y.xyz, z.xyz)) < 0.0) {
        turned = -turned;
    }
    float size = dot(turned, turned);
    // What is as small as this has lost its direction.
    direction = size > 1e-30 ? turned * inversesqrt(size) : vec3(0.0, 1.0, 0.0);
}
