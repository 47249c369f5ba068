//! The service RealtimeKit, which grants real-time rights to the programs of ordinary users: it is
//! asked over the D-Bus system bus where the kernel itself has refused.
//!
//! It demands a limit on the processor time that a real-time thread may use without a pause
//! (`RLIMIT_RTTIME`), and itself sees to it that child processes inherit nothing
//! (`SCHED_RESET_ON_FORK`). A thread over that limit is killed with its program: the servo sleeps
//! in every period, see [`super::rights::SPIN_MAX_US`].

use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use std::time::Duration;
use zbus::Connection;
use zbus::zvariant::OwnedValue;

const SERVICE: &str = "org.freedesktop.RealtimeKit1";
const PATH: &str = "/org/freedesktop/RealtimeKit1";
const PROPERTIES: &str = "org.freedesktop.DBus.Properties";
/// How long a game waits for the answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// Why RealtimeKit grants nothing.
#[derive(Debug, thiserror::Error)]
pub enum NoGrant {
    /// There is nobody to ask.
    #[error("there is no D-Bus system bus: {0}")]
    NoBus(String),
    /// Nobody of that name is on the bus.
    #[error("RealtimeKit is not installed: {0}")]
    NoService(String),
    /// It says no.
    #[error("RealtimeKit: {0}")]
    Refused(String),
    /// Its condition cannot be met.
    #[error("RealtimeKit: the limit RLIMIT_RTTIME cannot be lowered to {limit_us} µs: {reason}")]
    NoLimit {
        /// What it demands.
        limit_us: u64,
        /// What the operating system says.
        reason: String,
    },
    /// It says nothing.
    #[error("RealtimeKit does not answer")]
    Silent,
}

impl NoGrant {
    /// What would help.
    pub fn remedy(&self) -> &'static str {
        match self {
            NoGrant::NoBus(_) => "start the D-Bus system bus and install the package rtkit",
            NoGrant::NoService(_) => "install the package rtkit",
            NoGrant::Refused(_) => "allow acquire-real-time of RealtimeKit in polkit",
            NoGrant::NoLimit { .. } => "raise RLIMIT_RTTIME of this login",
            NoGrant::Silent => "restart the service rtkit-daemon",
        }
    }
}

/// Asks on the system bus for thread `thread` of this process, and waits for the answer.
/// Returns the priority that was granted: what is wanted, or the most that RealtimeKit gives.
///
/// # Errors
/// [`NoGrant`]
pub fn ask(thread: u64, wanted: u8) -> Result<u32, NoGrant> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|error| NoGrant::NoBus(error.to_string()))?;
    runtime.block_on(async {
        let asked = async {
            let bus = Connection::system().await;
            let bus = bus.map_err(|error| NoGrant::NoBus(error.to_string()))?;
            ask_on(&bus, thread, wanted).await
        };
        tokio::time::timeout(PATIENCE, asked).await.unwrap_or(Err(NoGrant::Silent))
    })
}

/// The same on a given bus.
async fn ask_on(bus: &Connection, thread: u64, wanted: u8) -> Result<u32, NoGrant> {
    let most: i32 = property(bus, "MaxRealtimePriority").await?;
    let limit_us: i64 = property(bus, "RTTimeUSecMax").await?;
    limit_time(u64::try_from(limit_us).unwrap_or_default())?;
    let priority = u32::from(wanted).min(u32::try_from(most).unwrap_or_default());
    let arguments = (thread, priority);
    bus.call_method(Some(SERVICE), PATH, Some(SERVICE), "MakeThreadRealtime", &arguments)
        .await
        .map_err(refused)?;
    Ok(priority)
}

async fn property<T: TryFrom<OwnedValue>>(bus: &Connection, name: &str) -> Result<T, NoGrant> {
    let arguments = (SERVICE, name);
    let reply = bus.call_method(Some(SERVICE), PATH, Some(PROPERTIES), "Get", &arguments).await;
    let value: OwnedValue = reply.map_err(refused)?.body().deserialize().map_err(refused)?;
    value.try_into().map_err(|_| NoGrant::Refused(format!("{name} is not a number")))
}

fn refused(error: zbus::Error) -> NoGrant {
    let zbus::Error::MethodError(name, detail, _) = &error else {
        return NoGrant::Refused(error.to_string());
    };
    let detail = detail.clone().unwrap_or_else(|| name.to_string());
    match name.as_str() {
        "org.freedesktop.DBus.Error.ServiceUnknown"
        | "org.freedesktop.DBus.Error.NameHasNoOwner"
        | "org.freedesktop.DBus.Error.Spawn.ServiceNotFound" => NoGrant::NoService(detail),
        _ => NoGrant::Refused(detail),
    }
}

/// Real-time threads of this process may compute for `limit_us` without a pause, and no longer.
fn limit_time(limit_us: u64) -> Result<(), NoGrant> {
    let now = getrlimit(Resource::Rttime);
    let lower = |value: Option<u64>| Some(value.map_or(limit_us, |value| value.min(limit_us)));
    let limit = Rlimit { current: lower(now.current), maximum: lower(now.maximum) };
    setrlimit(Resource::Rttime, limit)
        .map_err(|error| NoGrant::NoLimit { limit_us, reason: error.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};
    use zbus::fdo;

    /// Grants up to priority 20, for threads with a limit; takes notes.
    struct Fake {
        refuses: bool,
        asked: Arc<Mutex<Vec<(u64, u32)>>>,
    }

    #[zbus::interface(name = "org.freedesktop.RealtimeKit1")]
    impl Fake {
        fn make_thread_realtime(&self, thread: u64, priority: u32) -> fdo::Result<()> {
            let limit = getrlimit(Resource::Rttime).maximum;
            if self.refuses || limit.is_none_or(|limit| limit > 200_000) {
                return Err(fdo::Error::AccessDenied("not for you".into()));
            }
            self.asked.lock().unwrap().push((thread, priority));
            Ok(())
        }

        #[zbus(property, name = "MaxRealtimePriority")]
        fn max_realtime_priority(&self) -> i32 {
            20
        }

        #[zbus(property, name = "RTTimeUSecMax")]
        fn rt_time_usec_max(&self) -> i64 {
            200_000
        }
    }

    /// What a client hears over a private connection.
    fn hear(wanted: u8, refuses: bool) -> (Result<u32, NoGrant>, Vec<(u64, u32)>) {
        let asked = Arc::new(Mutex::new(Vec::new()));
        let service = Fake { refuses, asked: asked.clone() };
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        let heard = runtime.block_on(async {
            let (ours, theirs) = tokio::net::UnixStream::pair().unwrap();
            let guid = zbus::Guid::generate();
            let server = zbus::connection::Builder::unix_stream(theirs)
                .server(guid)
                .unwrap()
                .p2p()
                .serve_at(PATH, service)
                .unwrap();
            let client = zbus::connection::Builder::unix_stream(ours).p2p();
            let (_server, client) = tokio::try_join!(server.build(), client.build()).unwrap();
            ask_on(&client, 4711, wanted).await
        });
        let asked = asked.lock().unwrap().clone();
        (heard, asked)
    }

    #[test]
    fn the_priority_is_what_is_wanted_as_far_as_it_is_given() {
        for (wanted, expected) in [(80, 20), (5, 5)] {
            let (granted, asked) = hear(wanted, false);
            assert_eq!(granted.unwrap(), expected);
            assert_eq!(asked, [(4711, expected)]);
        }
    }

    #[test]
    fn a_refusal_is_told_in_the_words_of_the_service() {
        let (granted, asked) = hear(80, true);
        let why = granted.unwrap_err();
        assert!(matches!(&why, NoGrant::Refused(reason) if reason == "not for you"), "{why}");
        assert!(why.remedy().contains("polkit") && asked.is_empty());
    }
}
