// Something with a colour at each vertex: the cue.

in vec3 pos;
in vec3 nor;
in vec4 col;
layout (location = 0) out vec4 colour;

void main() {
    vec3 n = normalize(nor);
    vec3 v = normalize(eye - pos);
    // Vertex colours come linear.
    vec3 albedo = col.rgb;
    float rim = 1.0 - max(dot(n, v), 0.0);
    vec3 light = albedo * received(pos, n, vec3(1.0));
    light += surroundings(pos, reflect(-v, n), 0.04) * (0.035 + 0.3 * rim * rim * rim * rim);
    colour = vec4(developed(light), 1.0);
}
