uniform mat4 viewProjection;
uniform vec3 centre;
uniform vec3 across;
uniform vec3 along;
uniform float radius;

in vec2 corner;

out vec2 at;

void main() {
    at = radius * corner;
    gl_Position = viewProjection * vec4(centre + across * at.x + along * at.y, 1.0);
}
