// The place on the cloth that a ball can darken.

uniform mat4 view_projection;
in vec3 position;
in vec4 place;
// Half the side of the square, its height over the cloth, how dark it may be.
in vec3 square;
out vec3 pos;
flat out vec4 own_place;
flat out float depth;

void main() {
    pos = vec3(place.xy + position.xy * square.x, square.y);
    own_place = place;
    depth = square.z;
    gl_Position = view_projection * vec4(pos, 1.0);
}
