// A table at the price of one look into a picture: what it looks like from above, with all its
// light, and darker where it is steep.

in vec3 pos;
in vec3 nor;
uniform sampler2D plan;
// Half the length and width of what is in the picture.
uniform vec2 plan_frame;
layout (location = 0) out vec4 colour;

void main() {
    vec3 seen = texture(plan, 0.5 + 0.5 * pos.xy / plan_frame).rgb;
    colour = vec4(seen * (0.34 + 0.66 * clamp(nor.z, 0.0, 1.0)), 1.0);
}
