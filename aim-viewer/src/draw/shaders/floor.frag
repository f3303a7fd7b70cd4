uniform sampler2D shadow;
uniform vec2 middle;
uniform float extent;
uniform float blur;
uniform float radius;
uniform float gap;
uniform float isDark;

in vec2 at;

layout (location = 0) out vec4 seen;

// How much of a pixel a grid's lines cover; less where they are too many to be told apart.
float lines(float gap) {
    vec2 scaled = at / gap;
    vec2 pixel = max(fwidth(scaled), 1e-6);
    vec2 off = abs(fract(scaled - 0.5) - 0.5) / pixel;
    vec2 covered = clamp(1.2 - off, 0.0, 1.0) * clamp(0.35 / pixel - 0.4, 0.0, 1.0);
    return max(covered.x, covered.y);
}

// How much of the light from above is kept off: the mean of what is around, the further off the coarser.
float shade() {
    if (extent <= 0.0) {
        return 0.0;
    }
    vec2 place = 0.5 + 0.5 * (at - middle) / extent;
    float around = 0.5 * blur / extent;
    float finest = log2(around * float(textureSize(shadow, 0).x)) - 3.0;
    float sum = 0.0;
    for (int i = 0; i < 16; i++) {
        float reach = sqrt((float(i) + 0.5) / 16.0);
        // The golden angle fills a disc evenly.
        float turn = 2.39996323 * float(i);
        sum += textureLod(shadow, place + around * reach * vec2(cos(turn), sin(turn)), max(finest + 2.5 * reach, 0.0)).r;
    }
    return sum / 16.0;
}

void main() {
    float fade = 1.0 - smoothstep(0.25, 1.0, length(at) / radius);
    float grid = max(0.6 * lines(gap), lines(4.0 * gap));
    vec3 plain = mix(vec3(0.90, 0.91, 0.93), vec3(0.16, 0.17, 0.19), isDark);
    vec3 line = mix(vec3(0.35, 0.40, 0.48), vec3(0.62, 0.68, 0.76), isDark);
    vec3 colour = mix(plain, line, mix(0.28, 0.22, isDark) * grid);
    float dim = mix(0.55, 0.80, isDark) * shade();
    seen = vec4(colour * (1.0 - dim), max(0.85 * fade, dim * fade));
}
