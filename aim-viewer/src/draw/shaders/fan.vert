uniform mat4 viewProjection;

in vec3 position;
in vec4 colour;

out vec4 tinted;

void main() {
    tinted = colour;
    gl_Position = viewProjection * vec4(position, 1.0);
}
