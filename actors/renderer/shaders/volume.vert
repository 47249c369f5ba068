// The bodies of darkness behind the balls: for each ball and lamp a cone cut off where the lamp's
// rays touch the ball, whose outline from a lamp is a circle however many triangles the ball has.

uniform mat4 view_projection;
// Cosine and sine round the axis, 0 at the ball and 1 far away, 0 on the axis and 1 at the rim.
in vec4 corner;
in vec4 place;
// The lamp, and its number.
in vec4 source;
flat out float which;

// Bodies end so high [m]: under a table's cloth nothing is to be darkened.
uniform float lowest;

const float REACH = 4.0;

void main() {
    which = source.w;
    vec3 axis = place.xyz - source.xyz;
    float far = length(axis);
    axis /= far;
    vec3 side = normalize(cross(axis, abs(axis.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    vec3 other = cross(axis, side);
    // The tangents touch the ball at a circle nearer to the lamp than its middle.
    float slope = place.w / far;
    float cosine = sqrt(max(1.0 - slope * slope, 0.0));
    float end = min(REACH, (lowest - source.z) / min(axis.z, -0.01));
    float along = mix(far * cosine * cosine, max(end, far), corner.z);
    float radius = along * slope / cosine * corner.w;
    vec3 at = source.xyz + axis * along + (side * corner.x + other * corner.y) * radius;
    gl_Position = view_projection * vec4(at, 1.0);
}
