// The light of the room, shared by all materials. Colours are linear. LAMP_HEIGHT and LAMP_APART
// are set before this text; ROOM is 1 where a room is drawn, whose light is baked.

uniform vec3 eye;
// Half the length and width between the noses; zero without a table.
uniform vec2 bed;

#if ROOM == 1
// The light map of the room. Where in it is, by middle and half side, what mirrors see of the room,
// and, by offset and factor of x and y, the light on bed and rails.
uniform sampler2D room_light;
uniform vec4 room_mirror;
uniform vec4 bed_light;
uniform vec4 rail_light;
// The light on the sides of the rails.
uniform vec3 side_light;
#endif

const vec3 LAMP_COLOUR = vec3(1.0, 0.93, 0.80);
const vec3 DARK = vec3(0.010, 0.0095, 0.011);

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

#if ROOM == 1
// The light of a place in the map, in units of a white surface in full light.
vec3 baked(vec2 place) {
    vec3 root = texture(room_light, place).rgb;
    return root * root * 2.0;
}
#endif

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
        hit.x -= LAMP_APART * clamp(floor(hit.x / LAMP_APART + 0.5), -1.0, 1.0);
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

// From light to screen: a gentle shoulder, then the gamma of screens. The curve is
// (l (1 + 0.16 l) / (1 + 0.62 l))^(1/2.2) with l = 1.35 times the light, within 0.005 of it by a
// cubic of the root: processors that draw are several times faster at that.
vec3 developed(vec3 light) {
    vec3 root = min(sqrt(light), 1.0755);
    return root * (1.44794 - root * (0.69956 - 0.20288 * root));
}
