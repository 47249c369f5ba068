// A phenolic ball: what is painted on it follows from the direction in its own frame, so that there
// is no seam.

in vec3 pos;
flat in vec4 own_place;
flat in vec4 own_turn;
flat in vec4 own_paint;
// A stripe, six discs, how much of reflections and of scratches there is.
flat in vec4 own_traits;
uniform vec3 ivory;
uniform sampler2DArray digits;
#if SCRATCHES
// Slopes to the right and up.
uniform sampler2D scratches;
#endif
#if ENVIRONMENT == 2
uniform vec4 ball_turns[BALLS];
uniform vec4 ball_paints[BALLS];
uniform vec4 ball_traits[BALLS];
#endif
layout (location = 0) out vec4 colour;

#if SCRATCHES
// The normal of a scratched ball, in its own frame: three pictures, each along an axis, that fade
// into each other, so that there is no seam either.
vec3 scratched(vec3 own, float much) {
    vec3 weight = own * own;
    weight *= weight;
    weight /= weight.x + weight.y + weight.z;
    vec2 shift = vec2(own_paint.a, own_paint.g) * 0.37;
    vec2 x = texture(scratches, own.yz * 0.8 + shift).rg - 0.5;
    vec2 y = texture(scratches, own.zx * 0.8 + shift.yx).rg - 0.5;
    vec2 z = texture(scratches, own.xy * 0.8 - shift).rg - 0.5;
    vec3 slope = vec3(0.0, x) * weight.x + vec3(y.y, 0.0, y.x) * weight.y
        + vec3(z, 0.0) * weight.z;
    return normalize(own + slope * (0.9 * much));
}
#endif

#if SHADOWS != 0
// How much of the sky, and of each lamp, the other balls leave. A ball of radius R at the distance
// d covers (R / d)^2 of the half sky, weighted by the cosine.
vec4 left_by_balls(vec3 at, vec3 n) {
    vec4 left = vec4(1.0);
#if SHADOWS == 1
    vec3 ways[3];
    for (int k = 0; k < 3; k++) {
        ways[k] = normalize(lamp(k) - at);
    }
#endif
    for (int i = 0; i < ball_count; i++) {
        vec3 to = ball_places[i].xyz - at;
        float radius = ball_places[i].w;
        float square = dot(to, to);
        // The ball itself, and those that are far away.
        if (square > 90.0 * radius * radius || distance(ball_places[i].xyz, own_place.xyz) < 0.5 * radius) continue;
        float facing = dot(n, to) * inversesqrt(square);
        left.a *= 1.0 - clamp(0.5 + 0.5 * facing, 0.0, 1.0) * clamp(facing + 0.3, 0.0, 1.0)
            * radius * radius / square;
#if SHADOWS == 1
        for (int k = 0; k < 3; k++) {
            left[k] *= 1.0 - hidden_by_ball(to, radius, ways[k]);
        }
#endif
    }
    return left;
}
#endif

// What is seen in the polish: the other balls, the cushions and rails, the room.
vec3 mirrored(vec3 at, vec3 way, vec3 n) {
#if ENVIRONMENT == 2
    float nearest = 1e3;
    int found = -1;
    for (int i = 0; i < ball_count; i++) {
        vec3 from = at - ball_places[i].xyz;
        float radius = ball_places[i].w;
        float along = dot(from, way);
        float inside = along * along - dot(from, from) + radius * radius;
        float t = -along - sqrt(max(inside, 0.0));
        if (inside > 0.0 && t > 1e-4 && t < nearest) {
            nearest = t;
            found = i;
        }
    }
    if (found >= 0) {
        vec3 hit = at + way * nearest;
        vec3 normal = (hit - ball_places[found].xyz) / ball_places[found].w;
        vec3 own = in_frame(ball_turns[found], normal);
        vec3 paint = painted(own, ball_paints[found], ball_traits[found], ivory, 0.02);
        float height = hit.z / ball_places[found].w;
        float open = 0.35 + 0.65 * smoothstep(0.0, 1.6, height);
        return paint * received(hit, normal, vec3(1.0)) * open
            + surroundings(hit, reflect(way, normal), 0.02) * 0.05;
    }
    if (bed.x > 0.0) {
        vec2 toward = vec2(way.x < 0.0 ? -bed.x : bed.x, way.y < 0.0 ? -bed.y : bed.y) - at.xy;
        vec2 times = toward / (way.xy + vec2(way.x < 0.0 ? -1e-5 : 1e-5, way.y < 0.0 ? -1e-5 : 1e-5));
        float t = min(times.x, times.y);
        float height = at.z + way.z * t;
        if (t > 0.0 && height > 0.0 && height < 0.042) {
            // The cushion up to its nose, the wood behind it.
            vec3 hit = at + way * t;
            vec3 cushion = vec3(0.010, 0.150, 0.072) * mix(0.35, 0.9, height / 0.037);
            vec3 wood = vec3(0.16, 0.060, 0.024);
            vec3 light = received(hit, vec3(0.0, 0.0, 1.0), vec3(1.0));
            return mix(cushion, wood, smoothstep(0.034, 0.037, height)) * light;
        }
    }
#endif
    vec3 seen = surroundings(at, way, 0.0);
    if (bed.x > 0.0 && way.z < -0.02) {
        // The cloth near the ball lies in its shadow.
        vec2 hit = at.xy - way.xy * (at.z / way.z);
        vec3 up = vec3(own_place.xy - hit, own_place.z);
        float square = dot(up, up);
        float radius = own_place.w;
        float covered = up.z * radius * radius * inversesqrt(square * square * square);
        seen *= 1.0 - 0.85 * clamp(covered, 0.0, 1.0);
    }
    return seen;
}

void main() {
    vec3 n = normalize(pos - own_place.xyz);
    vec3 v = normalize(eye - pos);
    vec3 own = in_frame(own_turn, n);

    float edge = max(fwidth(own.x) + fwidth(own.y) + fwidth(own.z), 0.004) * 0.5;
    vec3 albedo = painted(own, own_paint, own_traits, ivory, edge);
    vec2 place = on_disc(own, own_traits.y);
    if (own_paint.a >= 0.0 && dot(place, place) < 1.0) {
        // The picture is as wide as the disc; its mip levels follow from the edge of a pixel.
        float level = log2(max(float(textureSize(digits, 0).x) * edge * 0.5 / DISC, 1.0));
        float ink = textureLod(digits, vec3(place * 0.5 + 0.5, own_paint.a), level).r;
        albedo = mix(albedo, vec3(0.012), ink);
    }
#if SCRATCHES
    if (own_traits.w > 0.0) {
        vec3 rough = scratched(own, own_traits.w);
        // Back into the world, by the opposite turn.
        n = in_frame(vec4(-own_turn.xyz, own_turn.w), rough);
    }
#endif

    // The cloth below takes light away and gives some of its green back.
    float height = pos.z / own_place.w;
    float open = bed.x > 0.0 ? 0.45 + 0.55 * smoothstep(-0.1, 1.4, height) : 1.0;
    vec3 seen = vec3(1.0);
#if SHADOWS != 0
    vec4 left = left_by_balls(pos, n);
    open *= left.a;
    seen = left.rgb;
#endif
#if SHADOWS >= 2
    // At the edge of its own night a ball would be lit in steps.
    vec3 towards;
    for (int i = 0; i < 3; i++) {
        towards[i] = dot(n, normalize(lamp(i) - pos));
    }
    seen = mix(vec3(1.0), seen_of_lamps(pos, n), smoothstep(0.12, 0.45, towards));
#endif
    vec3 bounce = vec3(0.010, 0.12, 0.062) * max(-n.z, 0.0) * 0.8;
    vec3 light = albedo * (received(pos, n, seen) * open + bounce);
    vec3 way = reflect(-v, n);
    vec3 gleam = vec3(0.0);
#if ENVIRONMENT != 0
    if (own_traits.z > 0.0) {
        float rim = 1.0 - max(dot(n, v), 0.0);
        float fresnel = 0.042 + 0.55 * rim * rim * rim * rim * rim;
        gleam = mirrored(pos, way, n) * fresnel * mix(0.7, 1.0, open);
    }
#endif
    if (own_traits.z < 1.0) {
        // A highlight of each lamp: (r . l)^128.
        vec3 shine;
        for (int i = 0; i < 3; i++) {
            shine[i] = max(dot(way, normalize(lamp(i) - pos)), 0.0);
        }
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        shine *= shine;
        gleam = mix(LAMP_COLOUR * (0.22 * dot(shine, seen)), gleam, own_traits.z);
    }
    colour = vec4(developed(light + gleam), 1.0);
}
