uniform sampler2D pixels;

in vec2 at;

layout (location = 0) out vec4 seen;

void main() {
    seen = vec4(texture(pixels, at).rgb, 1.0);
}
