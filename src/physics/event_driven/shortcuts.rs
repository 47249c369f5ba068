//! What makes detection quick changes nothing: with the plans of the bed and without them a ball
//! meets the same at the same time.

use super::segment::{Course, Segment};
use super::sweep::{self, Meeting};
use super::terrain::{Feature, Terrain};
use crate::physics::Work;
use crate::table::Table;
use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const R: f64 = 0.028575;
const G: f64 = 9.81;

/// The first meeting of a ball of that radius; `held` carries it.
fn met(terrain: &Terrain, segment: &Segment, radius: f64, held: &[Feature]) -> Option<Meeting> {
    let mut work = Work::default();
    sweep::first_meeting(terrain, segment, radius, 0.0, segment.end_s, held, &mut work)
}

fn segment(position: DVec3, velocity: DVec3, acceleration: DVec3, course: Course) -> Segment {
    let still = Segment::still(0.0, position, DQuat::IDENTITY);
    Segment { end_s: 5.0, velocity, acceleration, course, ..still }
}

#[test]
fn plans_of_the_bed_change_no_meeting() {
    let table = Table::preset("pool-9ft").unwrap();
    let (with, mut without) = (Terrain::new(&table, R), Terrain::new(&table, R));
    assert!(with.plans(R).is_some());
    without.forget_plans();
    let main = [with.main_patch()];
    let mut random = Pcg64::seed_from_u64(11);
    let mut meetings = 0;
    for case in 0..20_000 {
        let mut one = |size: f64| random.random_range(-size..size);
        let place = DVec3::new(one(1.24), one(0.6), R);
        let velocity = DVec3::new(one(5.0), one(5.0), 0.0);
        let pull = DVec3::new(one(2.0), one(2.0), 0.0);
        let hop = DVec3::Z * one(0.4).abs();
        let (path, held) = if case % 2 == 0 {
            (segment(place, velocity, pull, Course::Sliding), &main[..])
        } else {
            let fall = DVec3::NEG_Z * G;
            (segment(place, velocity + hop, fall, Course::Flying), &[][..])
        };
        let (one, other) = (met(&with, &path, R, held), met(&without, &path, R, held));
        assert_eq!(one.map(|m| m.feature), other.map(|m| m.feature), "{case}");
        if let (Some(one), Some(other)) = (one, other) {
            meetings += 1;
            assert!((one.at - other.at).abs() <= 1e-12, "{case}: {} {}", one.at, other.at);
            assert!(one.normal.distance(other.normal) < 1e-9, "{case}");
        }
    }
    assert!(meetings > 19_000, "{meetings}");
}
