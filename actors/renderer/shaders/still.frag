// What stands still, as it was drawn once.

in vec2 uvs;
uniform sampler2D colours;
layout (location = 0) out vec4 colour;

void main() {
    colour = texture(colours, uvs);
}
