// The shadow of one ball on the cloth: by how much its light is less. What is drawn there already
// is multiplied by it, so that shadows add up.

in vec3 pos;
flat in vec4 own_place;
flat in float depth;
#if AT_EDGE
// Middle and radius of each pocket.
uniform vec3 pockets[6];
#endif
layout (location = 0) out vec4 colour;

void main() {
#if AT_EDGE
    if (bed.x > 0.0) {
        if (abs(pos.x) > bed.x || abs(pos.y) > bed.y) discard;
        for (int i = 0; i < 6; i++) {
            vec2 away = pos.xy - pockets[i].xy;
            if (dot(away, away) < pockets[i].z * pockets[i].z) discard;
        }
    }
#endif
    vec3 at = vec3(pos.xy, 0.0);
    vec3 up = own_place.xyz - at;
    float radius = own_place.w;
    float square = dot(up, up);
    // The share of the sky that the ball covers, weighted by the cosine: h R^2 / d^3.
    float covered = clamp(up.z * radius * radius * inversesqrt(square * square * square), 0.0, 1.0);
    vec3 of_lamps = shares(at, vec3(0.0, 0.0, 1.0));
    vec3 seen;
    for (int i = 0; i < 3; i++) {
        seen[i] = 1.0 - hidden_by_ball(up, radius, normalize(lamp(i) - at));
    }
    // Near the ball the shades themselves are seen only in part.
    float open = 1.0 - 0.9 * covered;
    float all = 0.92 * (of_lamps.x + of_lamps.y + of_lamps.z) + 0.055;
    float left = (0.92 * dot(of_lamps, seen) * mix(open, 1.0, 0.35) + 0.055 * open) / all;
    // x^(1/2.2) nearly, as the picture has it.
    float root = sqrt(clamp(mix(1.0, left, depth), 0.0, 1.0));
    float share = root * (1.22 - 0.22 * root);
    colour = vec4(vec3(share), 1.0);
}
