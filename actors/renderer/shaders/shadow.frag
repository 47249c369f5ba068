// The shadow of one ball on the cloth: contact, and the three shades of the lamp.

in vec3 pos;
uniform vec3 centre;
uniform float radius;
// Middle and radius of each pocket.
uniform vec3 pockets[6];
layout (location = 0) out vec4 colour;

void main() {
    for (int i = 0; i < 6; i++) {
        if (distance(pos.xy, pockets[i].xy) < pockets[i].z) discard;
    }
    if (bed.x > 0.0 && (abs(pos.x) > bed.x || abs(pos.y) > bed.y)) discard;
    vec3 up = centre - vec3(pos.xy, 0.0);
    float square = dot(up, up);
    // The share of the sky that the ball covers, weighted by the cosine: h R^2 / d^3.
    float covered = clamp(up.z * radius * radius * inversesqrt(square * square * square), 0.0, 1.0);
    float shade = 0.80 * covered;
    for (int i = -1; i <= 1; i++) {
        vec3 way = normalize(vec3(0.78 * float(i), 0.0, LAMP_HEIGHT) - vec3(pos.xy, 0.0));
        float miss = length(up - way * dot(up, way)) / radius;
        shade += (1.0 - shade) * 0.24 * (1.0 - smoothstep(0.55, 1.30, miss));
    }
    float end = length(pos.xy - centre.xy) / (5.0 * radius);
    colour = vec4(0.0, 0.006, 0.003, shade * (1.0 - smoothstep(0.75, 1.0, end)));
}
