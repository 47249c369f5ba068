// The place on the cloth that a cue can darken.

uniform mat4 view_projection;
in vec3 position;
out vec3 pos;

void main() {
    pos = position;
    gl_Position = view_projection * vec4(position, 1.0);
}
