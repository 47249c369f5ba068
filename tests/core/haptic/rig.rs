//! A simulated Omni in a simulated hand that plays on a real table.

use glam::DVec3;
use hapticbillard::ball::{Ball, BallState, POOL_RADIUS_M};
use hapticbillard::cue::Aim;
use hapticbillard::events::{Fact, FactKind};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript};
use hapticbillard::haptic::{ContactEvent, DeviceSpec, Rehearsal};
use hapticbillard::ids::BallId;
use hapticbillard::table::Table;

pub const TICK_S: f64 = 0.001;
/// The cue is drawn back and waits.
pub const READY_TICKS: u64 = 1_100;

/// The cue ball on its spot and an object ball far away.
pub fn balls(table: &Table) -> Vec<(Ball, BallState)> {
    let spot = table.bed.unwrap().head_spot();
    [(0, spot.x, spot.y), (1, 0.9, 0.3)]
        .map(|(id, x, y)| {
            let (id, place) = (BallId(id), DVec3::new(x, y, POOL_RADIUS_M));
            (Ball::pool(id), BallState::at_rest(id, place))
        })
        .to_vec()
}

/// A stroke; `phase_s` shifts it against the ticks.
pub fn stroke(speed_m_s: f64, phase_s: f64) -> HandScript {
    HandScript::stroke(speed_m_s, 0.3 + phase_s)
}

/// Everything before the stroke, which is the same for all of them: the cue is drawn back.
pub fn drawn_back(hand: HandModel, aim: &Aim) -> Rehearsal {
    let table = Table::preset("pool-9ft").unwrap();
    let (balls, spec) = (balls(&table), DeviceSpec::OMNI);
    let mut rig = Rehearsal::new(&table, balls, spec, hand, stroke(1.0, 0.0), aim).unwrap();
    for _ in 0..READY_TICKS {
        rig.tick().unwrap();
    }
    assert!(rig.servo.report().sample.stabilised);
    rig
}

/// What a stroke showed.
#[derive(Debug, Clone)]
pub struct Felt {
    pub contact: ContactEvent,
    /// From the contact in the physics to the end of the tick that felt it [s].
    pub late_s: f64,
    /// Before the safety chain, within 30 ms of the contact.
    pub peak_wanted_n: f64,
    pub peak_sent_n: f64,
    /// Of the sent force along the stroke, within 30 ms of the contact [N s].
    pub impulse_ns: f64,
    /// Of the cue ball two ticks after the stroke [m/s].
    pub ball: DVec3,
    /// Closing speed that the physics saw [m/s].
    pub struck_m_s: f64,
    /// How often the physics saw the tip meet the ball.
    pub strikes: usize,
}

/// Goes on with `script`, and says what was felt of the first contact with a ball.
pub fn play(ready: &Rehearsal, script: HandScript) -> Felt {
    let ticks = (script.duration_s() / TICK_S) as u64 - READY_TICKS;
    let mut rig = ready.clone();
    *rig.device.guide_mut() = Guide::Script(script);
    let (mut contact, mut after) = (None, 0_u64);
    let (mut peak_wanted_n, mut peak_sent_n, mut impulse_ns) = (0.0_f64, 0.0_f64, 0.0);
    let mut ball = DVec3::ZERO;
    for _ in 0..ticks {
        let report = rig.tick().unwrap();
        if let (None, Some(event)) = (contact, report.contact) {
            contact = Some(event);
        }
        if contact.is_some() && after < 30 {
            peak_wanted_n = peak_wanted_n.max(report.wanted.0.length());
            impulse_ns += report.force.0.z * TICK_S;
            if after == 2 {
                ball = rig.ball(BallId::CUE).unwrap().velocity;
            }
            after += 1;
        }
        peak_sent_n = peak_sent_n.max(report.force.0.length());
    }
    let struck = |fact: &&Fact| matches!(fact.kind, FactKind::CueBallStruck { .. });
    let first = rig.facts.iter().find(struck).expect("the physics saw no stroke");
    let contact = contact.expect("the hand felt no stroke");
    let struck_m_s = match first.kind {
        FactKind::CueBallStruck { normal_speed_m_s, .. } => normal_speed_m_s,
        _ => 0.0,
    };
    let late_s = contact.tick as f64 * TICK_S - first.time_s;
    let strikes = rig.facts.iter().filter(struck).count();
    Felt { contact, late_s, peak_wanted_n, peak_sent_n, impulse_ns, ball, struck_m_s, strikes }
}
