in vec3 place;
in vec3 direction;
in vec4 tinted;
in float isLit;

layout (location = 0) out vec4 seen;

void main() {
    vec3 colour = isLit > 0.5 ? lit(tinted.rgb, place, normalize(direction)) : encoded(tinted.rgb);
    seen = vec4(colour, tinted.a);
}
