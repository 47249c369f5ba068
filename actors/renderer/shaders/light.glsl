// The light of the room, shared by all materials. Colours are linear. LAMP_HEIGHT and LAMP_APART
// are set before this text.

uniform vec3 eye;
// Half the length and width between the noses; zero without a table.
uniform vec2 bed;

const vec3 LAMP_COLOUR = vec3(1.0, 0.93, 0.80);
const vec3 ROOM = vec3(0.010, 0.0095, 0.011);

// The middle of a shade: three in a row over the table.
vec3 lamp(int i) {
    return vec3(LAMP_APART * float(i - 1), 0.0, LAMP_HEIGHT);
}

// What a surface gets of each lamp if nothing stands between.
vec3 shares(vec3 at, vec3 normal) {
    vec3 sum;
    for (int i = 0; i < 3; i++) {
        vec3 way = lamp(i) - at;
        float square = dot(way, way);
        float inverse = inversesqrt(square);
        // Shades are wide: a surface that turns away darkens slowly.
        float facing = clamp((dot(normal, way) * inverse + 0.12) / 1.12, 0.0, 1.0);
        // A shade throws its light downwards.
        float down = clamp(way.z * inverse, 0.0, 1.0);
        sum[i] = facing * down / (0.35 + square);
    }
    return sum;
}

// What the room throws back.
vec3 ambient(vec3 normal) {
    return vec3(0.055, 0.058, 0.068) * (0.6 + 0.4 * normal.z);
}

// Light that falls on a surface from which so much of each lamp is seen.
vec3 received(vec3 at, vec3 normal, vec3 seen) {
    return LAMP_COLOUR * (0.92 * dot(shares(at, normal), seen)) + ambient(normal);
}

// What a mirror at `at` sees in the direction `way`; `soft` [m] blurs the lamp of a rough one.
vec3 surroundings(vec3 at, vec3 way, float soft) {
    if (way.z > 0.02) {
        vec2 hit = at.xy + way.xy * ((LAMP_HEIGHT - at.z) / way.z);
        float shade = abs(fract(hit.x / LAMP_APART + 0.5) - 0.5) * LAMP_APART;
        float lamp = (1.0 - smoothstep(0.21 - soft, 0.25 + soft, shade))
            * (1.0 - smoothstep(0.14 - soft, 0.18 + soft, abs(hit.y)))
            * (1.0 - smoothstep(1.0 - soft, 1.06 + soft, abs(hit.x)));
        return mix(ROOM * 3.0, vec3(0.05), way.z * 0.5) + LAMP_COLOUR * lamp * 5.0;
    }
    vec2 hit = at.xy - way.xy * (at.z / min(way.z, -0.02));
    float cloth = (1.0 - smoothstep(0.0, 0.06, abs(hit.x) - bed.x))
        * (1.0 - smoothstep(0.0, 0.06, abs(hit.y) - bed.y));
    return mix(ROOM * 2.0, vec3(0.012, 0.16, 0.085), cloth);
}

// From light to screen: a gentle shoulder, then the gamma of screens. The curve is
// (l (1 + 0.16 l) / (1 + 0.62 l))^(1/2.2) with l = 1.35 times the light, within 0.005 of it by a
// cubic of the root: processors that draw are several times faster at that.
vec3 developed(vec3 light) {
    vec3 root = min(sqrt(light), 1.0755);
    return root * (1.44794 - root * (0.69956 - 0.20288 * root));
}
