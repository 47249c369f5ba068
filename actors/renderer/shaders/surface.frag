// Everything of a table and its room. KIND and DETAIL are set before this text.

in vec3 pos;
in vec3 nor;
in vec2 uvs;
uniform sampler2D grain;
// Half the outer length and width of the table.
uniform vec2 outer;
// x of the line across the bed, and the radius of the D behind it; 0 without.
uniform vec2 line_and_d;
uniform vec2 spots[6];
uniform int spot_count;
layout (location = 0) out vec4 colour;

#if KIND < 2
// The nap of the cloth. From afar it is not seen (paper, section 4.3.4).
float nap(vec3 at) {
#if DETAIL
    float left = 1.0 - smoothstep(1.2, 3.2, distance(at, eye));
    return mix(0.5, texture(grain, uvs * 3.4).r, left);
#else
    return 0.5;
#endif
}
#endif

// The grain of wood.
float wooden(vec2 scale) {
#if DETAIL || KIND < 8
    return texture(grain, uvs * scale).r;
#else
    return 0.5;
#endif
}

// How much of baked light is left where lamps are hidden.
float left_of(vec3 at, vec3 n) {
#if SHADOWS >= 2
    vec3 share = shares(at, n);
    return mix(1.0, dot(share, seen_of_lamps(at, n)) / max(dot(share, vec3(1.0)), 1e-4), 0.9);
#else
    return 1.0;
#endif
}

// Light on this kind of surface: baked where there is a room, else that of the lamps through what
// is open of it.
vec3 falling(vec3 at, vec3 n, float open) {
#if ROOM == 1 && KIND == 0
    vec3 above = baked(bed_light.xy + at.xy * bed_light.zw);
    // Under the noses it is darker than texels so large can tell.
    float near = mix(0.68, 1.0, smoothstep(-0.012, 0.05, min(bed.x - abs(at.x), bed.y - abs(at.y))));
    return above * (near * smoothstep(-0.03, -0.001, at.z) * left_of(at, n));
#elif ROOM == 1 && KIND == 1
    // The map is seen from above; noses face the lamp.
    vec3 above = baked(rail_light.xy + at.xy * rail_light.zw);
    vec3 nose = received(at, n, vec3(1.0));
    return mix(nose, above, smoothstep(0.1, 0.8, n.z)) * (open * left_of(at, n));
#elif ROOM == 1 && (KIND == 2 || KIND == 4 || KIND == 6)
    // Sides of rails look away from the lamp.
    vec3 above = baked(rail_light.xy + at.xy * rail_light.zw);
    return mix(side_light, above, smoothstep(0.1, 0.8, n.z)) * left_of(at, n);
#else
    return received(at, n, seen_of_lamps(at, n)) * open;
#endif
}

void main() {
    vec3 n = normalize(nor);
    vec3 v = normalize(eye - pos);
    vec3 albedo = vec3(0.5);
    float gloss = 0.0;
    float open = 1.0;
#if KIND == 0
    // Cloth: a fine nap, darker under the cushions.
    albedo = vec3(0.012, 0.205, 0.098) * (0.86 + 0.28 * nap(pos));
    vec2 inside = bed - abs(pos.xy);
    // The line across, the D and the spots, never thinner than the picture can show.
    float wide = max(fwidth(pos.x), fwidth(pos.y));
    float behind = line_and_d.x - pos.x;
    float off = abs(behind);
    if (line_and_d.y > 0.0 && behind > 0.0) {
        off = min(off, abs(length(vec2(behind, pos.y)) - line_and_d.y));
    }
    float line = (1.0 - smoothstep(0.0008, 0.0008 + wide, off))
        * step(0.0, inside.y) * min(1.0, 0.0035 / wide);
    float square = 1e3;
    for (int i = 0; i < spot_count; ++i) {
        vec2 away = pos.xy - spots[i];
        square = min(square, dot(away, away));
    }
    float spot = 1.0 - smoothstep(0.006, 0.006 + wide, sqrt(square));
    albedo = mix(albedo, vec3(0.50, 0.60, 0.50), bed.x > 0.0 ? max(0.6 * line, 0.8 * spot) : 0.0);
    if (bed.x > 0.0) {
        open = mix(0.42, 1.0, smoothstep(-0.012, 0.055, min(inside.x, inside.y)));
        open *= 0.15 + 0.85 * smoothstep(-0.03, -0.001, pos.z);
    }
#elif KIND == 1
    albedo = vec3(0.010, 0.170, 0.082) * (0.86 + 0.28 * nap(pos));
    open = mix(0.35, 1.0, smoothstep(-0.005, 0.03, pos.z));
#elif KIND == 2
    float wood = wooden(vec2(0.8, 3.0));
    albedo = mix(vec3(0.075, 0.022, 0.010), vec3(0.30, 0.115, 0.045), wood);
    gloss = 0.32;
#elif KIND == 3
    float wood = wooden(vec2(0.8, 3.0));
    albedo = mix(vec3(0.040, 0.012, 0.006), vec3(0.150, 0.055, 0.024), wood);
    gloss = 0.15;
    open = 0.75;
#elif KIND == 4
    albedo = vec3(0.30, 0.26, 0.20);
    gloss = 1.6;
#elif KIND == 5
    albedo = vec3(0.012, 0.010, 0.009);
    open = 0.10 + 0.9 * smoothstep(-0.06, 0.02, pos.z);
#elif KIND == 6
    albedo = vec3(0.80, 0.77, 0.68);
    gloss = 0.3;
#elif KIND == 7
    albedo = vec3(0.52, 0.62, 0.52);
#else
    // Floor boards, in the table's shadow below it.
    float wood = wooden(vec2(0.45, 2.2));
    float board = fract(uvs.y / 0.14);
    float joint = smoothstep(0.0, 0.03, board) * smoothstep(1.0, 0.97, board);
    float tint = 0.8 + 0.4 * fract(sin(floor(uvs.y / 0.14) * 12.9898) * 43758.5453);
    albedo = mix(vec3(0.050, 0.026, 0.014), vec3(0.16, 0.088, 0.046), wood) * tint;
    albedo *= mix(0.45, 1.0, joint);
    vec2 away = max(abs(pos.xy) - outer, 0.0);
    open = mix(0.10, 0.62, smoothstep(0.0, 0.9, length(away)));
#endif
    vec3 light = albedo * falling(pos, n, open);
    if (gloss > 0.0) {
        float rim = 1.0 - max(dot(n, v), 0.0);
        float fresnel = 0.045 + 0.5 * rim * rim * rim * rim;
        light += surroundings(pos, reflect(-v, n), 0.12) * fresnel * gloss * open;
    }
#if KIND == 8
    light = mix(light, DARK, smoothstep(1.2, 3.2, length(away)));
#endif
    colour = vec4(developed(light), 1.0);
}
