uniform mat4 viewProjection;

in vec3 normal;
in vec2 textureCoordinates;
in vec4 tint;

out vec3 place;
out vec3 direction;
out vec2 at;
out vec4 tinted;

void main() {
    skin(normal, place, direction);
    at = textureCoordinates;
    tinted = tint;
    gl_Position = viewProjection * vec4(place, 1.0);
}
