uniform vec3 centre;
uniform vec3 across;
uniform vec3 along;
uniform vec3 up;
uniform vec2 middle;
uniform float extent;

out float height;

void main() {
    vec3 place;
    vec3 direction;
    skin(vec3(0.0), place, direction);
    vec3 off = place - centre;
    height = dot(off, up);
    vec2 at = (vec2(dot(off, across), dot(off, along)) - middle) / extent;
    gl_Position = vec4(at, 0.0, 1.0);
}
