// How much of a lamp a ball hides from a place: `to` leads to the ball's middle, `way` is the unit
// vector to the lamp. The farther the ball, the softer: a shade is some 0.17 m wide to each side, a
// metre away.
float hidden_by_ball(vec3 to, float radius, vec3 way) {
    float along = dot(to, way);
    if (along < 0.0) return 0.0;
    float miss = length(to - way * along) / radius;
    float soft = clamp(0.17 * along / radius, 0.06, 1.2);
    // A ball that is smaller than the shade never hides all of it.
    return (1.0 - smoothstep(1.0 - soft, 1.0 + soft, miss)) / max(1.0, soft);
}
