//! A Haply service with a simulated arm in a hand, in the formats of service 3.1 and 3.5, and with
//! faults when a test wants them.

use glam::DVec3;
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{Device, DeviceSpec, DeviceState, Force, Format, INVERSE3};
use serde_json::{Value, json};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tungstenite::{Message, WebSocket};

/// What goes wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// Nothing.
    None,
    /// Every answer is this text.
    Says(String),
    /// Every answer ends in the middle.
    Half,
    /// The height of the arm is no number.
    NoNumber,
    /// The arm is no longer listed.
    NoArm,
    /// This flag of its status is false.
    Status(&'static str),
    /// Answers wait as long as this holds.
    Silent,
    /// Answers are this late.
    Late(Duration),
    /// The connection is cut without a word.
    Cut,
    /// The connection is closed in order.
    Closed,
}

/// What service and test know of each other.
pub struct Shared {
    fault: Mutex<Fault>,
    heard: Mutex<Vec<Value>>,
    /// The last force, and the largest, in the device frame [N].
    forces: Mutex<(DVec3, f64)>,
    connections: AtomicU64,
    answers: AtomicU64,
    is_over: AtomicBool,
}

/// A service that runs until it is dropped.
pub struct HaplyService {
    shared: Arc<Shared>,
    port: u16,
    thread: Option<JoinHandle<()>>,
}

/// What the service says of its arm besides where it is.
#[derive(Clone)]
pub struct Arm {
    /// In which format.
    pub format: Format,
    /// Whether there is a grip; its button a is held.
    pub has_grip: bool,
    /// What the first message is, if not the right one.
    pub greeting: Option<String>,
}

impl Arm {
    /// At a service 3.1, without a grip.
    pub const OLD: Arm = Arm { format: Format::Values, has_grip: false, greeting: None };
    /// At a service 3.5, with one.
    pub const NEW: Arm = Arm { format: Format::Vector, has_grip: true, greeting: None };
}

impl HaplyService {
    /// A service with an arm in a hand that rests 30 mm to the right of the middle.
    pub fn start(arm: Arm, fault: Fault) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        listener.set_nonblocking(true).unwrap();
        let shared = Arc::new(Shared {
            fault: Mutex::new(fault),
            heard: Mutex::default(),
            forces: Mutex::default(),
            connections: AtomicU64::new(0),
            answers: AtomicU64::new(0),
            is_over: AtomicBool::new(false),
        });
        let thread = {
            let shared = shared.clone();
            std::thread::spawn(move || {
                while !shared.is_over.load(Ordering::SeqCst) {
                    match listener.accept() {
                        Ok((stream, _)) => serve(stream, &arm, &shared),
                        Err(_) => std::thread::sleep(Duration::from_millis(1)),
                    }
                }
            })
        };
        HaplyService { shared, port, thread: Some(thread) }
    }

    /// Where it is.
    pub fn address(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    /// From now on this goes wrong.
    pub fn fault(&self, fault: Fault) {
        *self.shared.fault.lock().unwrap() = fault;
    }

    /// The size of the last force that was heard [N].
    pub fn force_n(&self) -> f64 {
        self.shared.forces.lock().unwrap().0.length()
    }

    /// The last force, in the device frame [N].
    pub fn force(&self) -> DVec3 {
        self.shared.forces.lock().unwrap().0
    }

    /// The largest force [N].
    pub fn most_n(&self) -> f64 {
        self.shared.forces.lock().unwrap().1
    }

    /// The first messages that were heard.
    pub fn heard(&self) -> Vec<Value> {
        self.shared.heard.lock().unwrap().clone()
    }

    /// How often somebody called, and how often it answered.
    pub fn counts(&self) -> [u64; 2] {
        [&self.shared.connections, &self.shared.answers].map(|n| n.load(Ordering::SeqCst))
    }
}

impl Drop for HaplyService {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::SeqCst);
        self.thread.take().unwrap().join().unwrap();
    }
}

fn serve(stream: TcpStream, arm: &Arm, shared: &Shared) {
    stream.set_nonblocking(false).unwrap();
    stream.set_nodelay(true).unwrap();
    stream.set_read_timeout(Some(Duration::from_millis(500))).unwrap();
    shared.connections.fetch_add(1, Ordering::SeqCst);
    let Ok(mut socket) = tungstenite::accept(stream) else { return };
    let place = DVec3::X * 0.03;
    let script = HandScript::practised(place, vec![Leg::to(place, 1e6)]);
    let spec = DeviceSpec { quantum_m: 0.0, ..INVERSE3 };
    let mut device = SimulatedDevice::new(spec, HandModel::GRIP, Guide::Script(script));
    let greeting = arm.greeting.clone().unwrap_or_else(|| message(arm, &device.read(0.0), true));
    if socket.send(Message::text(greeting)).is_err() {
        return;
    }
    let mut last = Instant::now();
    while !shared.is_over.load(Ordering::SeqCst) {
        let text = match socket.read() {
            Ok(Message::Text(text)) => text,
            Ok(_) => continue,
            Err(tungstenite::Error::Io(error))
                if matches!(
                    error.kind(),
                    std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut
                ) =>
            {
                continue;
            }
            Err(_) => return,
        };
        let heard: Value = serde_json::from_str(&text).unwrap();
        let force = force_in(&heard, arm.format);
        device.write(Force(force));
        {
            let mut forces = shared.forces.lock().unwrap();
            *forces = (force, forces.1.max(force.length()));
            let mut all = shared.heard.lock().unwrap();
            if all.len() < 8 {
                all.push(heard);
            }
        }
        let dt = last.elapsed().as_secs_f64();
        last = Instant::now();
        let state = device.read(dt.max(1e-6));
        if !answer(&mut socket, arm, &state, shared) {
            return;
        }
    }
}

/// False: the connection is no more.
fn answer(
    socket: &mut WebSocket<TcpStream>,
    arm: &Arm,
    state: &DeviceState,
    shared: &Shared,
) -> bool {
    let fault = || shared.fault.lock().unwrap().clone();
    while fault() == Fault::Silent && !shared.is_over.load(Ordering::SeqCst) {
        std::thread::sleep(Duration::from_millis(1));
    }
    let right = message(arm, state, false);
    let text = match fault() {
        Fault::None | Fault::Silent => right,
        Fault::Says(text) => text,
        Fault::Half => right[..right.len() / 2].to_string(),
        Fault::NoNumber => {
            let mut message: Value = serde_json::from_str(&right).unwrap();
            message["inverse3"][0]["state"]["cursor_position"]["z"] = Value::Null;
            message.to_string()
        }
        Fault::NoArm => json!({ "inverse3": [] }).to_string(),
        Fault::Status(flag) => {
            let mut message: Value = serde_json::from_str(&right).unwrap();
            message["inverse3"][0]["status"][flag] = json!(false);
            message.to_string()
        }
        Fault::Late(time) => {
            std::thread::sleep(time);
            right
        }
        Fault::Cut => {
            let _ = socket.get_ref().shutdown(std::net::Shutdown::Both);
            return false;
        }
        Fault::Closed => {
            let _ = socket.close(None);
            let _ = socket.flush();
            return false;
        }
    };
    shared.answers.fetch_add(1, Ordering::SeqCst);
    socket.send(Message::text(text)).is_ok()
}

/// The force of a message, in the device frame; the wrong format is a defect.
fn force_in(heard: &Value, format: Format) -> DVec3 {
    let device = &heard["inverse3"][0];
    assert_eq!(device["device_id"], "049D", "{heard}");
    let command = &device["commands"]["set_cursor_force"];
    let key = if format == Format::Values { "values" } else { "vector" };
    let [x, y, z] = ["x", "y", "z"].map(|axis| command[key][axis].as_f64().expect("a number"));
    DVec3::new(x, z, -y)
}

/// What the service says of a state.
fn message(arm: &Arm, state: &DeviceState, is_first: bool) -> String {
    let haply = |v: DVec3| DVec3::new(v.x, -v.z, v.y);
    let xyz = |v: DVec3| json!({ "x": v.x, "y": v.y, "z": v.z });
    // An older service counts from the base.
    let centre = match arm.format {
        Format::Values => DVec3::new(0.0, -0.10, 0.18),
        Format::Vector => DVec3::ZERO,
    };
    let mut device = json!({
        "device_id": "049D",
        "state": {
            "cursor_position": xyz(haply(state.position) + centre),
            "cursor_velocity": xyz(haply(state.velocity)),
            "angular_position": { "a0": 0.0, "a1": 0.0, "a2": 0.0 },
            "body_orientation": { "w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0 },
            "mode": "idle",
        },
        "status": {
            "calibrated": true, "in_use": true, "power_supply": true, "ready": true,
            "started": true,
        },
    });
    if is_first {
        device["config"] = match arm.format {
            Format::Values => json!({
                "type": "inverse3", "handedness": "right", "coordinate_origin": "device_base",
                "basis": { "permutation": "XYZ" },
            }),
            Format::Vector => json!({
                "type": "inverse3", "handedness": "right", "preset": "defaults",
                "basis": { "permutation": "XYZ" }, "filters": { "damping": { "scalar": 0.0 } },
            }),
        };
    }
    let mut message = json!({ "session_id": 7, "inverse3": [device], "verse_grip": [] });
    if arm.has_grip {
        message["wireless_verse_grip"] = json!([{
            "device_id": "1102",
            "state": {
                "orientation": { "w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0 },
                "buttons": { "a": true, "b": false, "c": false },
                "battery_level": 0.6,
            },
            "status": { "ready": true, "connected": true, "awake": true },
        }]);
    }
    message.to_string()
}
