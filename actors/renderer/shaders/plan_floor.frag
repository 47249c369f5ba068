// A floor that is hardly seen: lighter about the table, in whose shadow it lies, and dark far away.

in vec3 pos;
uniform vec2 outer;
layout (location = 0) out vec4 colour;

void main() {
    vec2 beside = max(abs(pos.xy) - outer, 0.0);
    float square = dot(beside, beside);
    float lit = 0.03 + 0.07 * clamp(square, 0.0, 1.0);
    vec3 wood = vec3(1.15, 0.85, 0.68) * lit;
    colour = vec4(mix(wood, vec3(0.130, 0.127, 0.136), clamp(square * 0.105 - 0.1, 0.0, 1.0)), 1.0);
}
