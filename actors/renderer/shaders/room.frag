// The room: grain times baked light. With GLOSS 1 it mirrors, too; with FADING 1 it may be seen
// partly, which costs: nothing that is hidden can be left out before it is computed.

in vec3 pos;
in vec3 nor;
in vec4 made;
in vec3 tile;
in vec2 lit;
uniform sampler2DArray grains;
layout (location = 0) out vec4 colour;
#if FADING == 1
// How much of it is seen, from 0 to 1.
uniform float seen;
#endif

void main() {
#if FADING == 1
    // What fades does so pixel by pixel: nothing behind it must be sorted.
    float order = dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715));
    if (seen <= fract(52.9829189 * fract(order))) discard;
#endif
    vec3 here = baked(lit);
    vec3 light = made.rgb * texture(grains, tile).rgb * (255.0 / 128.0) * here;
#if GLOSS == 1
    vec3 n = normalize(nor);
    vec3 v = normalize(eye - pos);
    float rim = 1.0 - max(dot(n, v), 0.0);
    float fresnel = 0.04 + 0.4 * rim * rim * rim * rim;
    // Metal has a colour of its own in what it mirrors.
    float metal = clamp(made.a - 1.0, 0.0, 1.0);
    vec3 mirrored = surroundings(pos, reflect(-v, n), 0.10);
    // Where no light comes, no lamp is seen either.
    mirrored = min(mirrored, 5.0 * here + 0.02);
    light += mirrored * mix(vec3(fresnel * max(made.a, 0.0)), made.rgb * 1.6, metal);
    // What shines does so by itself.
    light = made.a < 0.0 ? made.rgb * -made.a : light;
#endif
    colour = vec4(developed(light), 1.0);
}
