// The part of the cloth that a cue can darken.

uniform mat4 view_projection;
in vec3 position;
// Middle of the square, and its half sides.
uniform vec3 middle;
uniform vec2 along;
uniform vec2 aside;
out vec3 pos;

void main() {
    pos = middle + vec3(along * position.x + aside * position.y, 0.0);
    gl_Position = view_projection * vec4(pos, 1.0);
}
