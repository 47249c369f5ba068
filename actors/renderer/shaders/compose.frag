// One picture of what one or two eyes saw. Red is for the left eye, green and blue for the right
// one. What is red alone would flicker between the eyes: the left eye sees brightness.

in vec2 uvs;
uniform sampler2D left;
#if EYES == 2
uniform sampler2D right;
#endif
layout (location = 0) out vec4 colour;

void main() {
    vec3 seen = texture(left, uvs).rgb;
#if EYES == 2
    seen = vec3(dot(seen, vec3(0.4, 0.45, 0.15)), texture(right, uvs).gb);
#endif
    colour = vec4(seen, 1.0);
}
