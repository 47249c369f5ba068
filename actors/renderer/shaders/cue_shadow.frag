// The shadow of the cue on the cloth: by how much its light is less.

in vec3 pos;
// Tip and butt, and their radii.
uniform vec4 tip;
uniform vec4 butt;
uniform vec3 pockets[6];
layout (location = 0) out vec4 colour;

// How much of a lamp in the direction `way` the rod hides.
float hidden_by_rod(vec3 at, vec3 way) {
    vec3 rod = butt.xyz - tip.xyz;
    vec3 to = tip.xyz - at;
    // Where ray and rod come nearest to each other.
    float b = dot(rod, way);
    float c = dot(rod, rod);
    float d = dot(way, to);
    float e = dot(rod, to);
    float s = clamp((b * d - e) / max(c - b * b, 1e-5), 0.0, 1.0);
    float t = d + s * b;
    if (t <= 0.0) return 0.0;
    float miss = length(to + rod * s - way * t);
    float radius = mix(tip.w, butt.w, s);
    float soft = max(0.17 * t, 0.1 * radius);
    return (1.0 - smoothstep(max(radius - soft, 0.0), radius + soft, miss))
        * min(1.0, radius / soft);
}

void main() {
    if (bed.x > 0.0) {
        if (abs(pos.x) > bed.x || abs(pos.y) > bed.y) discard;
        for (int i = 0; i < 6; i++) {
            vec2 away = pos.xy - pockets[i].xy;
            if (dot(away, away) < pockets[i].z * pockets[i].z) discard;
        }
    }
    vec3 at = vec3(pos.xy, 0.0);
    vec3 of_lamps = shares(at, vec3(0.0, 0.0, 1.0));
    vec3 seen;
    for (int i = 0; i < 3; i++) {
        seen[i] = 1.0 - hidden_by_rod(at, normalize(lamp(i) - at));
    }
    float all = 0.92 * (of_lamps.x + of_lamps.y + of_lamps.z) + 0.055;
    float left = (0.92 * dot(of_lamps, seen) + 0.055) / all;
    float root = sqrt(clamp(left, 0.0, 1.0));
    colour = vec4(vec3(root * (1.22 - 0.22 * root)), 1.0);
}
