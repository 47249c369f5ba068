// The room: everything is where it is.

uniform mat4 view_projection;
in vec3 position;
in vec3 normal;
// Colour; how much of a mirror it is, or, below zero, how much it shines by itself.
in vec4 paint;
// Place in the tile of the grain, and which tile.
in vec3 grain;
in vec2 light;
out vec3 pos;
out vec3 nor;
out vec4 made;
out vec3 tile;
out vec2 lit;

void main() {
    pos = position;
    nor = normal;
    made = paint;
    tile = grain;
    lit = light;
    gl_Position = view_projection * vec4(position, 1.0);
}
