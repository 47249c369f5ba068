// How much of each lamp a place sees, where shadows are maps (SHADOWS 2) or volumes (SHADOWS 3).

#if SHADOWS == 2
// How far behind the lamp's plane something is, a layer for each lamp.
uniform sampler2DArray dark;
// Half the length and width of what the maps show of the cloth's plane.
uniform vec2 dark_frame;
// Distances of the nearest and the farthest plane of the maps.
uniform vec2 dark_range;

float distance_in_map(vec3 texel) {
    float depth = 2.0 * texture(dark, texel).r - 1.0;
    float near = dark_range.x;
    float far = dark_range.y;
    return 2.0 * far * near / (far + near - depth * (far - near));
}

vec3 seen_of_lamps(vec3 place, vec3 normal) {
    vec3 seen = vec3(1.0);
    // A slope would be in the shadow of its own steps in the map.
    vec3 at = place + normal * (0.010 * (1.0 - normal.z * normal.z));
    vec2 texel = 1.0 / vec2(textureSize(dark, 0).xy);
    for (int i = 0; i < 3; i++) {
        vec3 from = lamp(i);
        float far = from.z - at.z;
        vec2 hit = from.xy + (at.xy - from.xy) * (from.z / far);
        vec2 uv = 0.5 + 0.5 * hit / dark_frame;
        // Beside the map, and under the table.
        if (any(greaterThan(abs(uv - 0.5), vec2(0.499))) || at.z < -0.1) continue;
        // A surface in its own map: the more it turns away, the deeper a texel.
        float limit = far - 0.004;
        float lit = 0.0;
        for (int k = 0; k < 4; k++) {
            vec2 step = (vec2(k & 1, k >> 1) - 0.5) * 1.4;
            lit += distance_in_map(vec3(uv + step * texel, float(i))) < limit ? 0.0 : 0.25;
        }
        seen[i] = lit;
    }
    return seen;
}
#elif SHADOWS == 3
// For every pixel and lamp, in how many volumes lies what is seen there.
uniform sampler2D counted;
// Size of a pixel of the picture that is drawn, in that one.
uniform vec2 counted_pixel;

vec3 seen_of_lamps(vec3 at, vec3 normal) {
    return vec3(lessThan(texture(counted, gl_FragCoord.xy * counted_pixel).rgb, vec3(0.5)));
}
#else
vec3 seen_of_lamps(vec3 at, vec3 normal) {
    return vec3(1.0);
}
#endif
