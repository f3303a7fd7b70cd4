uniform float isDark;

in vec2 at;

layout (location = 0) out vec4 seen;

void main() {
    vec3 below = mix(vec3(0.80, 0.82, 0.85), vec3(0.085, 0.092, 0.105), isDark);
    vec3 above = mix(vec3(0.965, 0.97, 0.975), vec3(0.185, 0.20, 0.225), isDark);
    // A grain of less than one step, for steps would show as bands.
    float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    seen = vec4(mix(below, above, at.y) + grain / 255.0, 1.0);
}
