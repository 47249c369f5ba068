// The light of the room, shared by all materials. Colours are linear.

uniform vec3 eye;
// Half the length and width between the noses; zero without a table.
uniform vec2 bed;

const float LAMP_HEIGHT = 1.05;
const vec3 LAMP_COLOUR = vec3(1.0, 0.93, 0.80);
const vec3 ROOM = vec3(0.010, 0.0095, 0.011);

// Light that falls on a surface: three shades in a row over the table, and what the room throws
// back.
vec3 received(vec3 at, vec3 normal) {
    float sum = 0.0;
    for (int i = -1; i <= 1; i++) {
        vec3 way = vec3(0.78 * float(i), 0.0, LAMP_HEIGHT) - at;
        float square = dot(way, way);
        // Shades are wide: a surface that turns away darkens slowly.
        float facing = clamp((dot(normal, way) * inversesqrt(square) + 0.12) / 1.12, 0.0, 1.0);
        // A shade throws its light downwards.
        float down = clamp(way.z * inversesqrt(square), 0.0, 1.0);
        sum += facing * down / (0.35 + square);
    }
    return LAMP_COLOUR * sum * 0.92 + vec3(0.055, 0.058, 0.068) * (0.6 + 0.4 * normal.z);
}

// What a mirror at `at` sees in the direction `way`; `soft` [m] blurs the lamp of a rough one.
vec3 surroundings(vec3 at, vec3 way, float soft) {
    if (way.z > 0.02) {
        vec2 hit = at.xy + way.xy * ((LAMP_HEIGHT - at.z) / way.z);
        float shade = abs(fract(hit.x / 0.78 + 0.5) - 0.5) * 0.78;
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

// From light to screen: a gentle shoulder, then the gamma of screens.
vec3 developed(vec3 light) {
    light *= 1.35;
    light = light * (1.0 + light * 0.16) / (1.0 + light * 0.62);
    return pow(clamp(light, 0.0, 1.0), vec3(1.0 / 2.2));
}
