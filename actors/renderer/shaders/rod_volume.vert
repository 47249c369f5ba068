// The body of darkness behind the cue, corner by corner.

uniform mat4 view_projection;
in vec3 position;
uniform float lamp_number;
flat out float which;

void main() {
    which = lamp_number;
    gl_Position = view_projection * vec4(position, 1.0);
}
