// A colour without light: lines of aim and see-through balls, brighter at the rim, and bodies that
// are round by being darker there.

in vec3 pos;
in vec3 nor;
uniform vec4 tint;
uniform float rim;
uniform float shade;
layout (location = 0) out vec4 colour;

void main() {
    float facing = abs(dot(normalize(nor), normalize(eye - pos)));
    colour = vec4(tint.rgb * mix(1.0, 0.4 + 0.6 * facing, shade), tint.a * mix(1.0, 0.35 + 1.3 * (1.0 - facing), rim));
}
