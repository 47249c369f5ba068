//! The line to a service: texts over a WebSocket, without encryption.

use super::NoHaply;
use std::io::ErrorKind;
use std::net::{TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{
    Error, HandshakeError, Message, Utf8Bytes, WebSocket, client::client_with_config,
};

/// How long a look for an answer takes at most.
const LOOK: Duration = Duration::from_millis(10);
/// How long a force may wait in front of a full line.
const WRITE: Duration = Duration::from_millis(50);
/// The longest message [bytes]; all devices together need some thousand.
const MESSAGE_MAX: usize = 1 << 20;
const BUFFER: usize = 16 << 10;

/// A line that stands.
pub struct Line {
    socket: WebSocket<TcpStream>,
}

impl Line {
    /// Calls `address`, `HOST:PORT`.
    ///
    /// # Errors
    /// [`NoHaply`] if nobody is there, or somebody else.
    pub fn connect(address: &str, patience: Duration) -> Result<Self, NoHaply> {
        let unreachable = |reason: String| NoHaply::Unreachable { address: address.into(), reason };
        let stream = reach(address, patience).map_err(|error| unreachable(error.to_string()))?;
        let set_up = stream
            .set_nodelay(true)
            .and_then(|()| stream.set_read_timeout(Some(patience)))
            .and_then(|()| stream.set_write_timeout(Some(WRITE)));
        set_up.map_err(|error| unreachable(error.to_string()))?;
        let config = WebSocketConfig::default()
            .max_message_size(Some(MESSAGE_MAX))
            .max_frame_size(Some(MESSAGE_MAX))
            .read_buffer_size(BUFFER)
            .write_buffer_size(0);
        let met = client_with_config(format!("ws://{address}/"), stream, Some(config));
        let (socket, _) = met.map_err(|error| match error {
            HandshakeError::Interrupted(_) => NoHaply::Silent {
                address: address.into(),
                reason: format!("no word within {} ms", patience.as_millis()),
            },
            HandshakeError::Failure(error) => {
                NoHaply::NoService { address: address.into(), reason: error.to_string() }
            }
        })?;
        let looks = socket.get_ref().set_read_timeout(Some(LOOK));
        looks.map_err(|error| unreachable(error.to_string()))?;
        Ok(Line { socket })
    }

    /// Says something.
    ///
    /// # Errors
    /// Why the line is broken.
    pub fn say(&mut self, text: &str) -> Result<(), String> {
        self.socket.send(Message::text(text)).map_err(|error| error.to_string())
    }

    /// What it hears next; none if that is nothing for some milliseconds.
    ///
    /// # Errors
    /// Why the line is broken.
    pub fn hear(&mut self) -> Result<Option<Utf8Bytes>, String> {
        match self.socket.read() {
            Ok(Message::Text(text)) => Ok(Some(text)),
            Ok(Message::Close(_)) => Err("the service closed it".to_string()),
            // Signs of life are answered by themselves.
            Ok(_) => Ok(None),
            Err(Error::Io(error)) if is_only_late(error.kind()) => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }

    /// What it hears within `patience`; none if that is nothing.
    ///
    /// # Errors
    /// Why the line is broken.
    pub fn hear_within(&mut self, patience: Duration) -> Result<Option<Utf8Bytes>, String> {
        let end = Instant::now() + patience;
        loop {
            let heard = self.hear()?;
            if heard.is_some() || Instant::now() >= end {
                return Ok(heard);
            }
        }
    }

    /// Hangs up.
    pub fn close(&mut self) {
        // A line that is broken already is as good.
        let _ = self.socket.close(None);
        let _ = self.socket.flush();
    }
}

fn is_only_late(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted)
}

/// The first of the places of this name where somebody listens.
fn reach(address: &str, patience: Duration) -> std::io::Result<TcpStream> {
    let mut failure = std::io::Error::new(ErrorKind::NotFound, "the name has no place");
    for place in address.to_socket_addrs()? {
        match TcpStream::connect_timeout(&place, patience) {
            Ok(stream) => return Ok(stream),
            Err(error) => failure = error,
        }
    }
    Err(failure)
}
