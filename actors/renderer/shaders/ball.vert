// A ball among many: a unit sphere that each instance puts somewhere.

uniform mat4 view_projection;
in vec3 position;
// Middle and radius.
in vec4 place;
in vec4 turn;
in vec4 paint;
in vec4 traits;
out vec3 pos;
flat out vec4 own_place;
flat out vec4 own_turn;
flat out vec4 own_paint;
flat out vec4 own_traits;

void main() {
    pos = place.xyz + place.w * position;
    own_place = place;
    own_turn = turn;
    own_paint = paint;
    own_traits = traits;
    gl_Position = view_projection * vec4(pos, 1.0);
}
