uniform float fading;

in float height;

layout (location = 0) out vec4 seen;

void main() {
    seen = vec4(exp(-max(height, 0.0) / fading));
}
