//! The film of a shot: what was seen of it, to be seen again.

use super::between;
use crate::cue::CuePose;
use crate::ids::BallId;
use crate::input::BallWay;
use crate::physics::Snapshot;
use crate::units::Seconds;
use std::collections::VecDeque;
use std::sync::Arc;

/// How much of the time before a stroke belongs to its film [s]: the cue is seen to swing.
const LEAD_S: Seconds = 0.8;
/// How much of the time after the balls have come to rest [s].
const TAIL_S: Seconds = 0.3;
/// Two pictures of a film are at least so far apart [s] in its first part, and in all that comes
/// after [`DENSE`] pictures.
const STEP_S: [Seconds; 2] = [0.0035, 0.0155];
/// See [`STEP_S`]: 16 s.
const DENSE: usize = 4_000;
/// No film has more pictures: two minutes. What comes after is not filmed.
const MOST: usize = 11_000;
/// A new point of a way is at least so far from the last [m].
const WAY_STEP_M: f64 = 0.012;

/// A shot, from before the stroke until its balls have come to rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// In the order of time; never empty.
    frames: Vec<Arc<Snapshot>>,
    /// The ball that was struck.
    cue_ball: BallId,
    ways: Vec<BallWay>,
}

impl Film {
    /// How long it takes [s].
    pub fn length_s(&self) -> Seconds {
        let times = self.frames.first().zip(self.frames.last());
        times.map_or(0.0, |(first, last)| last.time_s - first.time_s)
    }

    /// What is seen so long after its beginning [s].
    pub fn at(&self, after_s: Seconds) -> Snapshot {
        let Some(first) = self.frames.first() else { return Snapshot::default() };
        let time_s = first.time_s + after_s;
        let next = self.frames.partition_point(|frame| frame.time_s <= time_s);
        match (next.checked_sub(1).map(|last| &self.frames[last]), self.frames.get(next)) {
            (Some(last), Some(next)) => between(last, next, time_s),
            (Some(only), None) | (None, Some(only)) => (**only).clone(),
            (None, None) => Snapshot::default(),
        }
    }

    /// The ball that was struck.
    pub fn cue_ball(&self) -> BallId {
        self.cue_ball
    }

    /// The ways of its balls.
    pub fn ways(&self) -> &[BallWay] {
        &self.ways
    }

    /// The cue at the beginning, if there is one.
    pub fn cue(&self) -> Option<CuePose> {
        self.frames.iter().find_map(|frame| frame.cue)
    }
}

/// Films shots: it keeps the last one, and what may become the beginning of the next.
#[derive(Debug, Clone, Default)]
pub struct Reel {
    /// The last moments, or the shot that goes on.
    now: VecDeque<Arc<Snapshot>>,
    is_rolling: bool,
    /// Balls have come to rest then, and the film goes on for a moment.
    rests_s: Option<Seconds>,
    last: Option<Arc<Film>>,
    /// The ball that was struck last.
    cue_ball: BallId,
    ways: Vec<BallWay>,
}

impl Reel {
    /// Takes a state of the world; they come in the order of time.
    pub fn take(&mut self, frame: &Arc<Snapshot>) {
        if self.rests_s.is_some_and(|rests_s| rests_s + TAIL_S < frame.time_s) {
            self.cut();
        }
        let step_s = if self.now.len() < DENSE { STEP_S[0] } else { STEP_S[1] };
        let is_next = self.now.back().is_none_or(|last| last.time_s + step_s <= frame.time_s);
        if !is_next || MOST <= self.now.len() {
            return;
        }
        self.now.push_back(frame.clone());
        if self.is_rolling {
            self.follow(frame);
        } else if self.rests_s.is_none() {
            let begin_s = frame.time_s - LEAD_S;
            while self.now.front().is_some_and(|old| old.time_s < begin_s) {
                self.now.pop_front();
            }
        }
    }

    /// A ball was struck.
    pub fn struck(&mut self, ball: BallId) {
        if !self.is_rolling {
            // What is left of the shot before.
            self.cut();
            (self.cue_ball, self.is_rolling) = (ball, true);
            self.ways.clear();
        }
    }

    /// The shot is taken back: what it was nobody wants to see.
    pub fn forget(&mut self) {
        self.now.clear();
        self.ways.clear();
        (self.is_rolling, self.rests_s, self.last) = (false, None, None);
    }

    /// All balls have come to rest at this time [s].
    pub fn settled(&mut self, time_s: Seconds) {
        if std::mem::take(&mut self.is_rolling) {
            self.rests_s = Some(time_s);
        }
    }

    /// The last shot, or as much of it as there is.
    pub fn film(&mut self) -> Option<Arc<Film>> {
        self.cut();
        self.last.clone()
    }

    /// Whether there is one.
    pub fn has_film(&self) -> bool {
        self.last.is_some() || self.rests_s.is_some()
    }

    /// The ways of the balls in the last shot, or in the one that goes on.
    pub fn ways(&self) -> &[BallWay] {
        &self.ways
    }

    /// What was taken of a shot whose balls have come to rest becomes a film.
    fn cut(&mut self) {
        let Some(rests_s) = self.rests_s.take() else { return };
        let end = self.now.partition_point(|frame| frame.time_s <= rests_s + TAIL_S);
        let frames: Vec<_> = self.now.drain(..end).collect();
        if !frames.is_empty() {
            let (cue_ball, ways) = (self.cue_ball, self.ways.clone());
            self.last = Some(Arc::new(Film { frames, cue_ball, ways }));
        }
    }

    /// The ways go on.
    fn follow(&mut self, frame: &Snapshot) {
        for ball in frame.on_table() {
            let Some(way) = self.ways.iter_mut().find(|way| way.ball == ball.id) else {
                let points = vec![ball.position];
                self.ways.push(BallWay { ball: ball.id, points, rests: false });
                continue;
            };
            // Whoever falls is not followed under the table.
            let is_far = way.points.last().is_none_or(|last| {
                WAY_STEP_M <= last.distance(ball.position) && -0.02 <= ball.position.z
            });
            if is_far {
                way.points.push(ball.position);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::BallState;
    use glam::DVec3;

    /// A ball that is struck after two seconds and rolls at 1 m/s for three.
    fn at(time_s: f64) -> Arc<Snapshot> {
        let way = (time_s - 2.0).clamp(0.0, 3.0);
        let mut ball = BallState::at_rest(BallId::CUE, DVec3::new(way, 0.0, 0.028));
        ball.velocity = DVec3::X * f64::from(u8::from(0.0 < way && way < 3.0));
        let other = BallState::at_rest(BallId(1), DVec3::new(0.0, 0.5, 0.028));
        Arc::new(Snapshot { time_s, balls: vec![ball, other], cue: None })
    }

    fn reel(step_s: f64, until_s: f64) -> Reel {
        let mut reel = Reel::default();
        let mut tick = 0.0;
        while tick * step_s < until_s {
            tick += 1.0;
            let time_s = tick * step_s;
            reel.take(&at(time_s));
            if (time_s - 2.0).abs() < 0.5 * step_s {
                reel.struck(BallId::CUE);
            }
            if (time_s - 5.0).abs() < 0.5 * step_s {
                reel.settled(5.0);
            }
        }
        reel
    }

    #[test]
    fn a_film_begins_before_the_stroke_and_ends_after_the_balls() {
        let film = reel(0.001, 9.0).film().expect("a shot was made");
        assert!((film.length_s() - 4.1).abs() < 0.02, "{}", film.length_s());
        assert!(film.frames.len() < 1_100, "{}", film.frames.len());
        // It shows the ball where it was, between its pictures as well.
        for n in 0..400 {
            let after_s = 0.01 * f64::from(n) + 0.0007;
            let seen = film.at(after_s);
            let truth = at(film.frames[0].time_s + after_s);
            let [seen, truth] = [&seen, &*truth].map(|world| world.balls[0].position);
            assert!(seen.distance(truth) < 1e-3, "{after_s}: {seen} {truth}");
        }
        assert_eq!(film.at(-1.0), *film.frames[0]);
        assert_eq!(film.at(99.0).balls[0].position.x, 3.0);
    }

    #[test]
    fn there_is_none_before_a_shot_and_the_one_before_until_the_next_is_over() {
        let mut reel = reel(0.001, 1.9);
        assert!(!reel.has_film() && reel.film().is_none());
        let mut reel = self::reel(0.001, 5.05);
        // Early: as much as there is.
        assert!(reel.has_film());
        assert!((reel.film().unwrap().length_s() - 3.85).abs() < 0.02);
        let first = reel.film().unwrap();
        for n in 0..400 {
            reel.take(&at(5.06 + 0.004 * f64::from(n)));
        }
        reel.struck(BallId::CUE);
        for n in 0..100 {
            reel.take(&at(6.7 + 0.004 * f64::from(n)));
        }
        assert_eq!(reel.film().unwrap(), first, "the second one goes on");
        reel.settled(7.1);
        assert!(reel.film().unwrap().frames[0].time_s > 5.5);
    }

    #[test]
    fn a_ball_that_lies_has_no_way_and_one_that_rolls_has_its_own() {
        let reel = reel(0.001, 9.0);
        let ways = reel.ways();
        assert_eq!(ways.len(), 2);
        assert_eq!(ways[1].points.len(), 1);
        let ends = (ways[0].points[0].x, ways[0].points.last().unwrap().x);
        assert!(ends.0 < 0.02 && 2.98 < ends.1, "{ends:?}");
        assert!((200..270).contains(&ways[0].points.len()), "{}", ways[0].points.len());
    }

    #[test]
    fn a_shot_without_an_end_is_filmed_so_long_and_no_longer() {
        let mut reel = Reel::default();
        reel.struck(BallId::CUE);
        for n in 0..300_000 {
            reel.take(&at(2.0 + 0.001 * f64::from(n)));
        }
        assert_eq!(reel.now.len(), MOST);
        reel.settled(302.0);
        assert!(100.0 < reel.film().unwrap().length_s());
    }
}
