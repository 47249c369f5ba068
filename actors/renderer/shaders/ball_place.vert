// Where a ball is, and nothing else.

uniform mat4 view_projection;
in vec3 position;
in vec4 place;

void main() {
    gl_Position = view_projection * vec4(place.xyz + place.w * position, 1.0);
}
