//! Geometry for tests, independent of the solvers' own.

use glam::DVec3;

/// The point of these faces that is nearest to `p`, and its distance.
pub fn closest_point(faces: &[[DVec3; 3]], p: DVec3) -> (DVec3, f64) {
    let nearest = |face: &[DVec3; 3]| {
        let [a, b, c] = *face;
        let n = (b - a).cross(c - a);
        let foot = p - n * ((p - a).dot(n) / n.length_squared());
        let is_within =
            [(a, b), (b, c), (c, a)].iter().all(|(x, y)| (*y - *x).cross(foot - *x).dot(n) >= 0.0);
        if is_within {
            return foot;
        }
        let on_edge = |x: DVec3, y: DVec3| {
            let along = y - x;
            x + along * ((p - x).dot(along) / along.length_squared()).clamp(0.0, 1.0)
        };
        [on_edge(a, b), on_edge(b, c), on_edge(c, a)]
            .into_iter()
            .min_by(|x, y| x.distance(p).total_cmp(&y.distance(p)))
            .unwrap()
    };
    let points = faces.iter().map(nearest);
    let best = points.min_by(|x, y| x.distance(p).total_cmp(&y.distance(p))).unwrap();
    (best, best.distance(p))
}
