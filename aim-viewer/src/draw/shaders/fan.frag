in vec4 tinted;

layout (location = 0) out vec4 seen;

void main() {
    seen = tinted;
}
