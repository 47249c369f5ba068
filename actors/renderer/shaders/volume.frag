// Counts bodies of darkness that end behind what is seen, less those that begin there: a channel for
// each lamp. Whatever lies in a body has one more end than beginnings behind it.

flat in float which;
layout (location = 0) out vec4 colour;

void main() {
    float one = gl_FrontFacing ? -1.0 : 1.0;
    colour = vec4(vec3(which == 0.0, which == 1.0, which == 2.0) * one, 0.0);
}
