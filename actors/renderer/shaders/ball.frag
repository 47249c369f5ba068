// A phenolic ball: what is painted on it follows from the direction in its own frame.

in vec3 pos;
in vec3 nor;
uniform vec3 centre;
uniform mat3 turned;
uniform vec3 paint;
uniform vec3 ivory;
uniform float striped;
// The layer of the number; negative without discs.
uniform float number;
uniform float radius;
uniform sampler2DArray digits;
layout (location = 0) out vec4 colour;

const float DISC = 0.47;

void main() {
    vec3 n = normalize(pos - centre);
    vec3 v = normalize(eye - pos);
    vec3 own = transpose(turned) * n;

    float edge = max(fwidth(own.z), 0.002);
    float band = 1.0 - smoothstep(0.52 - edge, 0.52 + edge, abs(own.z));
    vec3 albedo = mix(paint, mix(ivory, paint, band), striped);
    if (number >= 0.0) {
        // Seen from outside, right is +y on the disc at +x and −y on the one at −x.
        vec2 at = vec2(own.x > 0.0 ? own.y : -own.y, own.z) / DISC;
        float away = length(at);
        float soft = max(edge / DISC, 0.004);
        float disc = 1.0 - smoothstep(1.0 - soft, 1.0 + soft, away);
        float ink = texture(digits, vec3(at * vec2(0.5, 0.5) + 0.5, number)).r;
        albedo = mix(albedo, mix(ivory, vec3(0.012), ink), disc);
    } else {
        // Six spots, so that the spin of a plain ball is seen.
        vec3 far = abs(own);
        float nearest = max(far.x, max(far.y, far.z));
        float spot = smoothstep(0.986 - edge * 0.4, 0.986 + edge * 0.4, nearest);
        albedo = mix(albedo, vec3(0.55, 0.02, 0.02), spot);
    }

    // The cloth below takes light away and gives some of its green back.
    float height = pos.z / radius;
    float open = bed.x > 0.0 ? 0.45 + 0.55 * smoothstep(-0.1, 1.4, height) : 1.0;
    vec3 bounce = vec3(0.010, 0.12, 0.062) * max(-n.z, 0.0) * 0.8;
    vec3 light = albedo * (received(pos, n) * open + bounce);
    float rim = 1.0 - max(dot(n, v), 0.0);
    float fresnel = 0.042 + 0.55 * rim * rim * rim * rim * rim;
    light += surroundings(pos, reflect(-v, n), 0.0) * fresnel * mix(0.7, 1.0, open);
    colour = vec4(developed(light), 1.0);
}
