uniform sampler2D picture;
uniform vec4 colour;
uniform float cutoff;
uniform float ownOpacity;

in vec3 place;
in vec3 direction;
in vec2 at;
in vec4 tinted;

layout (location = 0) out vec4 seen;

void main() {
    vec4 texel = texture(picture, at);
    vec4 base = colour * tinted * vec4(decoded(texel.rgb), texel.a);
    if (base.a < cutoff) {
        discard;
    }
    vec3 normal = normalize(direction);
    if (!gl_FrontFacing) {
        normal = -normal;
    }
    seen = vec4(lit(base.rgb, place, normal), mix(1.0, base.a, ownOpacity));
}
