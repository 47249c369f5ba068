//! What the program says about itself: lines on stderr, and the same in a file.
//!
//! Who says it is the module's path, so that `RUST_LOG` can choose by actor:
//! `hapticbillard_actors::rules=debug`. What dependencies say through the `log` crate comes the
//! same way. From `info` on a line also tells in which shot it was said, see [`crate::shot`].
//!
//! The file of [`LogFile::Daily`] is begun anew every day; [`KEPT`] of them stay. Lines reach a
//! file through a queue and a thread of its own, so that nobody waits for a disk: when [`WAITING`]
//! lines wait, further ones are dropped, and how many is said on stderr at the end.
//!
//! The servo's thread and the audio callback say nothing here: they only count.

use crate::error::Error;
use crate::files;
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::panic;
use std::path::PathBuf;
use tracing::{Event, Level, Subscriber};
use tracing_appender::non_blocking::{ErrorCounter, NonBlocking, NonBlockingBuilder, WorkerGuard};
use tracing_appender::rolling::{RollingFileAppender, Rotation};
use tracing_log::NormalizeEvent;
use tracing_subscriber::filter::EnvFilter;
use tracing_subscriber::fmt::format::Writer;
use tracing_subscriber::fmt::{FmtContext, FormatEvent, FormatFields, FormattedFields};
use tracing_subscriber::layer::{Layer, SubscriberExt};
use tracing_subscriber::registry::LookupSpan;
use tracing_subscriber::util::SubscriberInitExt;

/// How many days are kept.
const KEPT: usize = 7;
/// Lines that wait for the file at most.
const WAITING: usize = 4096;
/// Who is said to have said what a panic says; stderr has it from the panic itself.
const PANIC: &str = "panic";

/// Where lines go besides stderr.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LogFile {
    /// Nowhere.
    None,
    /// Into this file, behind what is there.
    At(PathBuf),
    /// Into a file a day in the user's data folder.
    Daily,
}

/// Ends the log when it is dropped: everything that was said is in the file then.
pub struct Logging(Option<(WorkerGuard, ErrorCounter)>);

/// Begins to listen. `verbose` counts how much more than warnings is wanted; `RUST_LOG` is stronger
/// than that. A file that cannot be opened is said once, and the program goes on.
pub fn start(verbose: u8, file: &LogFile) -> Logging {
    let on_stderr = ["warn", "info", "debug", "trace"][usize::from(verbose.min(3))];
    // Nobody reads a file while it is written: it may say a little more.
    let in_file = match verbose {
        0 => "warn,hapticbillard=info,hapticbillard_actors=info",
        _ => on_stderr,
    };
    let opened = open(file);
    let (writer, open, refused) = match opened {
        Ok(Some((writer, open))) => (Some(writer), Some(open), None),
        Ok(None) => (None, None, None),
        Err(error) => (None, None, Some(error)),
    };
    let has_file = writer.is_some();

    let colours = io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let to_stderr = tracing_subscriber::fmt::layer()
        .with_writer(io::stderr)
        .with_ansi(false)
        .log_internal_errors(false)
        .event_format(Line { colours })
        .with_filter(filter(on_stderr).add_directive(nothing_of(PANIC)));
    let to_file = writer.map(|writer| {
        tracing_subscriber::fmt::layer()
            .with_writer(writer)
            .with_ansi(false)
            .log_internal_errors(false)
            .event_format(Line { colours: false })
            .with_filter(filter(in_file))
    });
    let all = tracing_subscriber::registry().with(to_file).with(to_stderr);
    #[cfg(feature = "console")]
    let all = all.with(console_subscriber::spawn());
    // Somebody may listen already: then this one does not.
    let _ = all.try_init();

    if has_file {
        tell_panics();
    }
    if let Some(error) = refused {
        tracing::warn!("there is no log file: {error}");
    }
    Logging(open)
}

/// What `RUST_LOG` wants, or what is usual. What is wrong in it is said on stderr and left out.
fn filter(usual: &str) -> EnvFilter {
    let wanted = std::env::var(EnvFilter::DEFAULT_ENV).unwrap_or_default();
    EnvFilter::builder().parse_lossy(if wanted.is_empty() { usual } else { &wanted })
}

fn nothing_of(target: &str) -> tracing_subscriber::filter::Directive {
    // Plain words, and a test: it cannot fail.
    format!("{target}=off").parse().unwrap_or_else(|_| Level::ERROR.into())
}

type Open = (NonBlocking, (WorkerGuard, ErrorCounter));

fn open(file: &LogFile) -> Result<Option<Open>, Error> {
    match file {
        LogFile::None => Ok(None),
        LogFile::At(path) => Ok(Some(behind_a_queue(files::append_to(path)?))),
        LogFile::Daily => {
            let folder = files::logs_folder()?;
            let failed = |reason: io::Error| Error::Write { path: folder.clone(), reason };
            // Where there is none the appender would complain on stderr.
            files::make_folder(&folder)?;
            let daily = RollingFileAppender::builder()
                .rotation(Rotation::DAILY)
                .filename_prefix("hapticbillard")
                .filename_suffix("log")
                .max_log_files(KEPT)
                .build(&folder)
                .map_err(|error| failed(io::Error::other(error)))?;
            Ok(Some(behind_a_queue(daily)))
        }
    }
}

fn behind_a_queue(file: impl Write + Send + 'static) -> Open {
    let builder = NonBlockingBuilder::default().buffered_lines_limit(WAITING).lossy(true);
    let (writer, guard) = builder.thread_name("log").finish(file);
    let dropped = writer.error_counter();
    (writer, (guard, dropped))
}

/// A panic stands in the file too.
fn tell_panics() {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        tracing::error!(target: PANIC, "{panic}");
        before(panic);
    }));
}

impl Drop for Logging {
    fn drop(&mut self) {
        if let Some((guard, dropped)) = self.0.take() {
            drop(guard);
            match dropped.dropped_lines() {
                0 => {}
                // The file is closed, and who closes stderr reads no more.
                lost => drop(writeln!(io::stderr(), "the log file lacks {lost} lines")),
            }
        }
    }
}

/// A line: when, how important, who, in which shot, what.
struct Line {
    colours: bool,
}

impl Line {
    fn level(&self, level: &Level) -> (&'static str, &'static str) {
        let colour = match *level {
            Level::ERROR => "\x1b[1;31m",
            Level::WARN => "\x1b[33m",
            Level::INFO => "\x1b[32m",
            Level::DEBUG => "\x1b[34m",
            Level::TRACE => "\x1b[36m",
        };
        if self.colours { (colour, "\x1b[0m") } else { ("", "") }
    }
}

impl<S, N> FormatEvent<S, N> for Line
where
    S: Subscriber + for<'a> LookupSpan<'a>,
    N: for<'a> FormatFields<'a> + 'static,
{
    fn format_event(
        &self,
        context: &FmtContext<'_, S, N>,
        mut line: Writer<'_>,
        event: &Event<'_>,
    ) -> fmt::Result {
        let of_log = event.normalized_metadata();
        let about = of_log.as_ref().unwrap_or_else(|| event.metadata());
        let (on, off) = self.level(about.level());
        let (level, target) = (about.level().as_str(), about.target());
        write!(line, "[{} {on}{level:<5}{off} {target}] ", files::time_of_now())?;
        for span in context.event_scope().into_iter().flat_map(|scope| scope.from_root()) {
            write!(line, "{}", span.name())?;
            let extensions = span.extensions();
            match extensions.get::<FormattedFields<N>>() {
                Some(fields) if !fields.is_empty() => write!(line, "{{{fields}}}: ")?,
                _ => write!(line, ": ")?,
            }
        }
        context.format_fields(line.by_ref(), event)?;
        writeln!(line)
    }
}
