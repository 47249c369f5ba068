//! The same stroke at any phase of the world's steps.

use super::bench::{Ripple, bare, spec};
use crate::ball::SOLID_SPHERE;
use crate::cue::{CUE_END_MASS_KG, TIP_RADIUS_M};
use crate::haptic::simulated::{Guide, HandScript, Leg, SimulatedDevice};
use crate::haptic::{
    Buttons, CouplingSettings, CueBody, Device, DeviceSpec, HapticBall, HapticScene, Reach,
    SafetySettings, Servo, ServoSettings,
};
use crate::ids::BallId;
use crate::physics::{Contact, Parameters};
use crate::validation::error::{Trouble, unsupported};
use crate::validation::observed::Observations;
use crate::validation::setup::Setup;
use glam::DVec3;

/// The hand moves at its speed for this long before it meets the ball [s], so that the grip has
/// come to rest, and for this long after it.
const RUN_IN_S: f64 = 0.5;
const FOLLOW_S: f64 = 0.15;
/// Longest step of the physics [s].
const STEP_MAX_S: f64 = 1.0;
/// Most strokes of a run.
const PHASES_MAX: u64 = 1_000;

/// What one stroke showed.
struct Stroke {
    /// From where the device is where the tip meets the ball to the force [ticks].
    delay_ticks: f64,
    peak_n: f64,
}

/// Everything that a stroke needs.
struct Range<'s> {
    setup: &'s Setup<'s>,
    spec: DeviceSpec,
    settings: ServoSettings,
    scene: HapticScene,
    speed_m_s: f64,
    step_s: f64,
    mass_kg: f64,
}

/// Strokes whose starts are equally spaced over one step of the physics.
pub(in crate::validation) fn strike_repeatability(
    setup: &Setup<'_>,
) -> Result<Observations, Trouble> {
    let phases = setup.count("phases")?.unwrap_or(1);
    if !(1..=PHASES_MAX).contains(&phases) {
        return Err(setup.error("phases", format!("{phases}"), "write 1 to 1000").into());
    }
    let range = Range::new(setup)?;
    let mut strokes = Vec::new();
    for phase in 0..phases {
        strokes.push(range.stroke((phase as f64 + 0.5) / phases as f64)?);
    }
    let count = strokes.len() as f64;
    let mean = strokes.iter().map(|stroke| stroke.peak_n).sum::<f64>() / count;
    let square = strokes.iter().map(|stroke| (stroke.peak_n - mean) * (stroke.peak_n - mean));
    let deviation = (square.sum::<f64>() / count).sqrt();
    let mut peak = Ripple::new();
    strokes.iter().for_each(|stroke| peak.take(stroke.peak_n));
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);

    let mut seen = Observations::default();
    let delay = most(&mut strokes.iter().map(|stroke| stroke.delay_ticks));
    seen.set("detection_delay_ticks", delay);
    seen.set("force_peak_relative_sd", deviation / mean);
    seen.set("force_peak_N", most(&mut strokes.iter().map(|stroke| stroke.peak_n)));
    Ok(seen)
}

impl<'s> Range<'s> {
    fn new(setup: &'s Setup<'s>) -> Result<Self, Trouble> {
        let spec = spec(setup)?;
        let bare = bare(&spec);
        let settings = ServoSettings {
            coupling: CouplingSettings { stiffness_n_m: setup.positive("K_N_m")?, ..bare.coupling },
            transient: setup.transient()?,
            safety: SafetySettings {
                force_max_n: setup.positive("force_limit_N")?,
                ..SafetySettings::OFF
            },
            ..bare
        };
        let mass_kg = setup.positive("ball_mass_kg")?;
        let radius_m = setup.positive("ball_R_m")?;
        let pool = Parameters::pool();
        let mut scene = HapticScene {
            reach: Some(Reach {
                serial: 1,
                pivot: DVec3::ZERO,
                azimuth_rad: 0.0,
                elevation_rad: 0.0,
                scale: 1.0,
                stroke_gain: 1.0,
                turns: false,
                solid: true,
                tip_radius_m: TIP_RADIUS_M,
                cue: Some(CueBody {
                    mass_kg: setup.positive("cue_mass_kg")?,
                    end_mass_kg: CUE_END_MASS_KG,
                    contact: Contact { restitution: setup.number("e_tip")?, ..pool.tip },
                    coupling_rad_s: pool.cue_coupling_rad_s,
                }),
            }),
            ..HapticScene::default()
        };
        scene.add(HapticBall {
            id: BallId::CUE,
            radius_m,
            inverse_mass: 1.0 / mass_kg,
            inverse_inertia: 1.0 / (SOLID_SPHERE * mass_kg * radius_m * radius_m),
            ..HapticBall::NONE
        });
        let speed_m_s = setup.positive("speed_m_s")?;
        let step_s = setup.positive("physics_step_s")?;
        if step_s > STEP_MAX_S {
            return unsupported(format!("steps of {step_s} s"));
        }
        Ok(Range { setup, spec, settings, scene, speed_m_s, step_s, mass_kg })
    }

    /// A straight stroke along −z of the device, which is +x of the world.
    fn stroke(&self, phase: f64) -> Result<Stroke, Trouble> {
        let period_s = self.spec.period_s();
        let reach_m = self.scene.balls[0].radius_m + TIP_RADIUS_M;
        // The pivot's place in the device, and the contact in front of it.
        let contact_z = -0.2 * self.settings.reach.box_m.z + reach_m;
        let run_in_s = RUN_IN_S + self.step_s * phase;
        let start = DVec3::Z * (contact_z + self.speed_m_s * run_in_s);
        let whole_s = run_in_s + FOLLOW_S;
        let end = start - DVec3::Z * (self.speed_m_s * whole_s);
        let legs = vec![Leg::ramp(end, whole_s).holding(Buttons::FRONT)];
        let velocity = DVec3::NEG_Z * self.speed_m_s;
        let guide = Guide::Script(HandScript::practised(start, legs));
        let hand = self.setup.hand()?;
        let mut device = SimulatedDevice::new(self.spec, hand, guide).pushed(DVec3::ZERO, velocity);
        let mut servo = Servo::new(self.settings);

        let mut scene = self.scene;
        let (mut crossed_s, mut felt_s, mut peak_n) = (None, None, 0.0_f64);
        let mut ball_velocity = DVec3::ZERO;
        for tick in 0..libm::ceil(whole_s / period_s) as u64 {
            let before = device.position().z;
            let state = device.read(if tick == 0 { 0.0 } else { period_s });
            let (now_s, here) = (tick as f64 * period_s, device.position().z);
            if here <= contact_z && crossed_s.is_none() {
                crossed_s = Some(now_s - period_s * (contact_z - here) / (before - here));
            }
            // The world's step: the ball moves on, and the stroke that came before is known.
            if now_s + 1e-9 >= self.step_s * scene.serial as f64 {
                scene.serial += 1;
                scene.sample_seen = tick;
                scene.balls[0].velocity = ball_velocity;
                scene.balls[0].position += ball_velocity * self.step_s;
            }
            let force = servo.tick(&state, &scene, period_s);
            device.write(force);
            peak_n = peak_n.max(force.0.length());
            if let Some(contact) = servo.report().contact {
                felt_s.get_or_insert(now_s);
                ball_velocity += contact.impulse / self.mass_kg;
            }
        }
        match (crossed_s, felt_s) {
            (Some(crossed_s), Some(felt_s)) => {
                Ok(Stroke { delay_ticks: (felt_s - crossed_s) / period_s, peak_n })
            }
            _ => Err(Trouble::Failed(String::from("the stroke misses the ball"))),
        }
    }
}
