//! Haply Inverse3 at its service, over a WebSocket.
//!
//! A thread of its own ([`talk`]) says a force and hears the state that answers it, again and
//! again; servo and thread meet in two latest-value slots. So reading and writing return at once:
//! they take no lock, allocate nothing, make no system call.
//!
//! | what happens | the servo | the player is told |
//! |---|---|---|
//! | no service, no arm, not calibrated, no power at the start | does not start | what to do |
//! | no power, not ready later | no force, from the next state on | the same |
//! | not calibrated, or gone from the service later | no force; the last place | the same |
//! | 50 ms of silence, or of messages that are not understood | the same | for how long, or why |
//! | a number that is none | no force, at its next tick | that it says no numbers |
//! | the connection ends, or 2 s of silence | no force; the last place, for good | what to start |
//!
//! What passes by itself over a connection that stands is forgotten: the arm is ready again, and
//! the force comes back over the servo's ramp. A connection that ended is not made again while the
//! servo runs, for a device must not come back to life in somebody's hand by surprise.
//!
//! A force that is not to go on is said to be zero: at every silence, and when the device is
//! dropped, before the connection is closed.
//!
//! The way of a force is longer than a period: the time from the say to the answer and the pause
//! between two of them count as latency. What is usual when the device is opened stands in its
//! specification; what is worse later lowers the stiffness like lateness of the servo.

mod line;
mod talk;

use super::device::Opened;
use super::turns::Explain;
use hapticbillard::haptic::{
    Device, DeviceSpec, DeviceState, DeviceStatus, Force, Inverse3Trouble,
};
use hapticbillard::units::Seconds;
use line::Line;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use talk::{Shared, Talk};

/// Where the service is unless somebody moved it.
pub const ADDRESS: &str = "localhost:10001";

/// After this time without a state nothing is known of the arm [s].
const SILENCE_S: Seconds = 0.05;

/// Why there is no Inverse3.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoHaply {
    /// Nobody listens there.
    #[error(
        "no Haply Inverse service answers at {address} ({reason}); open the Haply Hub or start \
         the service, or say where it is: device = \"haply:HOST:PORT\""
    )]
    Unreachable {
        /// Where it was sought.
        address: String,
        /// What the operating system says.
        reason: String,
    },
    /// Somebody else listens there.
    #[error(
        "what answers at {address} is no Haply Inverse service ({reason}); its port is 10001 \
         unless it was changed: device = \"haply:HOST:PORT\""
    )]
    NoService {
        /// Where it was sought.
        address: String,
        /// What it says instead.
        reason: String,
    },
    /// It listens and says nothing, or stops in the middle.
    #[error("the Haply Inverse service at {address} does not answer ({reason}); restart it")]
    Silent {
        /// Where it is.
        address: String,
        /// Since when, or why.
        reason: String,
    },
    /// The arm cannot be used.
    #[error("Haply at {address}: {trouble}")]
    Trouble {
        /// Where its service is.
        address: String,
        /// Why.
        trouble: Inverse3Trouble,
    },
    /// The operating system gives no thread.
    #[error("the Haply device gets no thread ({0}); end other programs")]
    NoThread(String),
}

/// Opens the arm at the service at `address` (`HOST:PORT`), which may take `patience` to answer.
///
/// # Errors
/// [`NoHaply`].
pub fn open(address: &str, patience: Duration) -> Result<Opened, NoHaply> {
    let line = Line::connect(address, patience)?;
    let (states, read_states) = triple_buffer::triple_buffer(&DeviceState::default());
    let (write_forces, forces) = triple_buffer::triple_buffer(&Force::ZERO);
    let shared = Arc::new(Shared::new(address));
    let talk = Talk::begin(line, states, forces, shared.clone(), patience)?;
    let spec = talk.spec();
    let builder = std::thread::Builder::new().name("haply".to_string());
    let thread =
        builder.spawn(move || talk.run()).map_err(|error| NoHaply::NoThread(error.to_string()))?;
    let device = HaplyDevice {
        spec,
        states: read_states,
        forces: write_forces,
        quiet_s: 0.0,
        shared: shared.clone(),
        thread: Some(thread),
    };
    Ok(Opened { explains: Some(shared), ..Opened::new(device) })
}

/// An Inverse3.
struct HaplyDevice {
    spec: DeviceSpec,
    states: triple_buffer::Output<DeviceState>,
    forces: triple_buffer::Input<Force>,
    /// Since the last state [s].
    quiet_s: Seconds,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Device for HaplyDevice {
    fn spec(&self) -> DeviceSpec {
        self.spec
    }

    fn read(&mut self, dt: Seconds) -> DeviceState {
        self.quiet_s = if self.states.update() { 0.0 } else { self.quiet_s + dt };
        let mut state = *self.states.output_buffer();
        if self.quiet_s > SILENCE_S {
            state.status = DeviceStatus::Lost;
        }
        state
    }

    fn write(&mut self, force: Force) {
        self.forces.write(force);
    }
}

impl Drop for HaplyDevice {
    fn drop(&mut self) {
        self.forces.write(Force::ZERO);
        self.shared.stop();
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            tracing::error!("the talk with the Haply service ended by a defect");
        }
    }
}

impl Explain for Shared {
    fn why(&self) -> Option<String> {
        Shared::why(self)
    }

    fn late_s(&self) -> Seconds {
        Shared::late_s(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_50_ms_without_a_state_the_device_is_lost_and_with_the_next_it_is_not() {
        let (mut said, states) = triple_buffer::triple_buffer(&DeviceState::default());
        let (forces, _) = triple_buffer::triple_buffer(&Force::ZERO);
        let shared = Arc::new(Shared::new(ADDRESS));
        let spec = hapticbillard::haptic::INVERSE3;
        let mut device = HaplyDevice { spec, states, forces, quiet_s: 0.0, shared, thread: None };
        let mut statuses = |n: u32, dt| (0..n).map(|_| device.read(dt).status).collect::<Vec<_>>();
        for _ in 0..3 {
            said.write(DeviceState::default());
            assert_eq!(statuses(50, 0.001), [DeviceStatus::Ready; 50]);
            assert_eq!(statuses(5, 0.0011), [DeviceStatus::Lost; 5]);
        }
        // A servo that slept itself finds the state that came meanwhile.
        said.write(DeviceState::default());
        assert_eq!(statuses(1, 10.0), [DeviceStatus::Ready]);
    }
}
