// The balls, and what is painted on them.

const int BALLS = 32;
// How many there are.
uniform int ball_count;
// Middles and radii.
uniform vec4 ball_places[BALLS];

// A vector of the world in the frame of a ball that is turned by a unit quaternion.
vec3 in_frame(vec4 turn, vec3 way) {
    vec3 twice = 2.0 * cross(way, turn.xyz);
    return way + turn.w * twice + cross(twice, turn.xyz);
}

const float DISC = 0.47;

// Where on a disc the direction `own` is, right and up as seen from outside, in radii of the disc.
vec2 on_disc(vec3 own, float six) {
    vec3 far = abs(own);
    if (six > 0.5 && max(far.y, far.z) > far.x) {
        if (far.y > far.z) {
            return vec2(own.y > 0.0 ? -own.x : own.x, own.z) / DISC;
        }
        return vec2(own.z > 0.0 ? own.x : -own.x, own.y) / DISC;
    }
    return vec2(own.x > 0.0 ? own.y : -own.y, own.z) / DISC;
}

// The paint of a ball in a direction of its own frame, without the digits. `paint.a` is the layer
// of its number, negative without discs; `traits` are a stripe and six discs; `edge` is how far
// the direction changes from pixel to pixel.
vec3 painted(vec3 own, vec4 paint, vec4 traits, vec3 ivory, float edge) {
    float band = 1.0 - smoothstep(0.52 - edge, 0.52 + edge, abs(own.z));
    vec3 albedo = mix(paint.rgb, mix(ivory, paint.rgb, band), traits.x);
    if (paint.a < 0.0) {
        // Six spots, so that the spin of a plain ball is seen.
        vec3 far = abs(own);
        float nearest = max(far.x, max(far.y, far.z));
        float spot = smoothstep(0.986 - edge * 0.4, 0.986 + edge * 0.4, nearest);
        return mix(albedo, vec3(0.55, 0.02, 0.02), spot);
    }
    float away = length(on_disc(own, traits.y));
    float soft = max(edge / DISC, 0.004);
    return mix(albedo, ivory, 1.0 - smoothstep(1.0 - soft, 1.0 + soft, away));
}
