uniform mat4 viewProjection;
uniform float pixel;

in vec4 corner;
in vec3 from;
in vec3 to;
in vec2 kind;
in vec4 colour;

out vec3 place;
out vec3 direction;
out vec4 tinted;
out float isLit;

void main() {
    vec3 along = to - from;
    float size = length(along);
    vec3 axis = size > 0.0 ? along / size : vec3(0.0, 0.0, 1.0);
    vec3 side = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
    direction = side * corner.x + cross(axis, side) * corner.y + axis * corner.z;
    vec3 end = mix(from, to, corner.w);
    // Thinner than a pixel it would come and go.
    float thin = 0.7 * pixel * (viewProjection * vec4(end, 1.0)).w;
    place = end + max(kind.x, thin) * direction;
    tinted = colour;
    isLit = kind.y;
    gl_Position = viewProjection * vec4(place, 1.0);
}
