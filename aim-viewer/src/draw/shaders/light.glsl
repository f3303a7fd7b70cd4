uniform vec3 eye;
uniform vec3 key;
uniform vec3 fill;
uniform vec3 sky;

vec3 encoded(vec3 light) {
    light = clamp(light, 0.0, 1.0);
    return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}

vec3 decoded(vec3 colour) {
    return mix(colour / 12.92, pow((colour + 0.055) / 1.055, vec3(2.4)), step(0.04045, colour));
}

// What is seen of a surface of that linear base colour, as sRGB.
vec3 lit(vec3 base, vec3 place, vec3 normal) {
    vec3 outwards = normalize(eye - place);
    float facing = max(dot(normal, outwards), 0.0);
    vec3 around = mix(vec3(0.12, 0.11, 0.105), vec3(0.36, 0.39, 0.43), 0.5 + 0.5 * dot(normal, sky));
    float direct = max((dot(normal, key) + 0.2) / 1.2, 0.0);
    vec3 light = around + vec3(0.92, 0.88, 0.82) * direct + vec3(0.13, 0.16, 0.21) * max(dot(normal, fill), 0.0);
    float gloss = pow(max(dot(normal, normalize(key + outwards)), 0.0), 48.0);
    float rim = pow(1.0 - facing, 4.0);
    vec3 seen = base * light + 0.07 * gloss + 0.05 * rim * (0.4 + base);
    // Bright colours come near to white, and never there at once.
    seen = mix(seen, 1.0 - 0.25 * exp((0.75 - seen) / 0.25), step(0.75, seen));
    return encoded(seen);
}
