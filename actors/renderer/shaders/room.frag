// The room: grain times baked light. DETAIL 0 leaves out grain and reflections.

in vec3 pos;
in vec3 nor;
in vec4 made;
in vec3 tile;
in vec2 lit;
uniform sampler2DArray grains;
// How much of it is seen, from 0 to 1.
uniform float seen;
layout (location = 0) out vec4 colour;

void main() {
    // What fades does so pixel by pixel: nothing behind it must be sorted.
    if (seen < 1.0) {
        float order = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
        if (seen <= order) discard;
    }
    if (made.a < 0.0) {
        colour = vec4(developed(made.rgb * -made.a), 1.0);
        return;
    }
    vec3 here = baked(lit);
#if DETAIL == 0
    vec3 light = made.rgb * here;
#else
    vec3 light = made.rgb * texture(grains, tile).rgb * (255.0 / 128.0) * here;
    if (made.a > 0.0) {
        vec3 n = normalize(nor);
        vec3 v = normalize(eye - pos);
        float rim = 1.0 - max(dot(n, v), 0.0);
        float fresnel = 0.04 + 0.4 * rim * rim * rim * rim;
        // Metal has a colour of its own in what it mirrors.
        float metal = clamp(made.a - 1.0, 0.0, 1.0);
        vec3 mirrored = surroundings(pos, reflect(-v, n), 0.10);
        // Where no light comes, no lamp is seen either.
        mirrored = min(mirrored, 12.0 * here + 0.02);
        light += mirrored * mix(vec3(fresnel * made.a), made.rgb * 1.6, metal);
    }
#endif
    colour = vec4(developed(light), 1.0);
}
