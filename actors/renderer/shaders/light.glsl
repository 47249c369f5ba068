// The light of the room, shared by all materials. Colours are linear. ROOM is 1 where a room is
// drawn, whose light is baked.

uniform vec3 eye;
// Half the length and width between the noses; zero without a table.
uniform vec2 bed;

// The light map of the room. Where in it is, by middle and half side, what mirrors see of the room,
// and, by offset and factor of x and y, the light on bed and rails.
uniform sampler2D room_light;
uniform vec4 room_mirror;
uniform vec4 bed_light;
uniform vec4 rail_light;
// The light on the sides of the rails.
uniform vec3 side_light;

const float LAMP_HEIGHT = 1.05;
const float LAMP_PITCH = 0.78;
const vec3 LAMP_COLOUR = vec3(1.0, 0.93, 0.80);
const vec3 DARK = vec3(0.010, 0.0095, 0.011);

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

// The light of a place in the map, in units of a white surface in full light.
vec3 baked(vec2 place) {
    vec3 root = texture(room_light, place).rgb;
    return root * root * 2.0;
}

// What there is of the room in a direction, seen from the table: an octahedron, unfolded.
vec3 room_towards(vec3 way) {
#if ROOM == 1
    way /= abs(way.x) + abs(way.y) + abs(way.z);
    vec2 back = (1.0 - abs(way.yx)) * vec2(way.x < 0.0 ? -1.0 : 1.0, way.y < 0.0 ? -1.0 : 1.0);
    return baked(room_mirror.xy + (way.z < 0.0 ? back : way.xy) * room_mirror.zw);
#else
    return DARK * 3.0;
#endif
}

// What a mirror at `at` sees in the direction `way`; `soft` [m] blurs the lamp of a rough one.
vec3 surroundings(vec3 at, vec3 way, float soft) {
    vec3 room = room_towards(way);
    if (way.z > 0.02 && at.z < LAMP_HEIGHT) {
        vec2 hit = at.xy + way.xy * ((LAMP_HEIGHT - at.z) / way.z);
        hit.x -= LAMP_PITCH * clamp(floor(hit.x / LAMP_PITCH + 0.5), -1.0, 1.0);
        float away = length(hit);
        float shade = 1.0 - smoothstep(0.25 - soft, 0.255 + soft, away);
        float glass = 1.0 - smoothstep(0.185 - soft, 0.195 + soft, away);
        return mix(room, LAMP_COLOUR * mix(1.2, 5.0, glass), shade);
    }
    // Only what is on the table sees the cloth: from afar rails and balls would be before it.
    if (way.z >= 0.0 || at.z < -0.01 || 0.25 < at.z) return room;
    vec2 hit = at.xy - way.xy * (at.z / min(way.z, -0.02));
    float cloth = (1.0 - smoothstep(0.0, 0.06, abs(hit.x) - bed.x))
        * (1.0 - smoothstep(0.0, 0.06, abs(hit.y) - bed.y));
    return mix(room, vec3(0.012, 0.16, 0.085), cloth);
}

// From light to screen: a gentle shoulder, then the gamma of screens.
vec3 developed(vec3 light) {
    light *= 1.35;
    light = light * (1.0 + light * 0.16) / (1.0 + light * 0.62);
    light = clamp(light, 0.0, 1.0);
    // light^(1 / 2.2) within a 340th: roots are cheap on a processor, powers are not.
    vec3 root = sqrt(light);
    return 0.98026 * root + 0.08312 * sqrt(root) - 0.06501 * light;
}
