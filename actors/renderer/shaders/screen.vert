// Everything: one triangle that is larger than the screen.

in vec2 corner;
out vec2 uvs;

void main() {
    uvs = corner * 0.5 + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
