//! The system's outputs, by cpal.

use super::backend::{Backend, NoSound, Output, Playing};
use super::callback::{Callback, Counters, Loss};
use cpal::traits::{DeviceTrait, HostTrait, StreamTrait};
use cpal::{
    BufferSize, Device, ErrorKind, FromSample, Host, SampleFormat, SizedSample, Stream,
    StreamConfig, SupportedBufferSize, SupportedStreamConfigRange,
};
use std::sync::Arc;

/// The rate that is asked for [Hz]; where a device has another one the mixer takes that.
const RATE_HZ: u32 = 48_000;
/// Frames a period that are asked for: 11 ms.
const PERIOD: u32 = 512;
/// Formats, the best first.
const FORMATS: [SampleFormat; 8] = [
    SampleFormat::F32,
    SampleFormat::I16,
    SampleFormat::I32,
    SampleFormat::U16,
    SampleFormat::U32,
    SampleFormat::F64,
    SampleFormat::I8,
    SampleFormat::U8,
];

/// Sound cards and sound servers.
pub struct Card;

impl Backend for Card {
    fn outputs(&mut self) -> Result<Vec<Output>, NoSound> {
        keep_library_quiet();
        let devices = cpal::default_host().output_devices();
        let devices = devices.map_err(|error| NoSound::NoDevice(error.to_string()))?;
        Ok(devices
            .map(|device| Output { name: name(&device), description: said(&device) })
            .collect())
    }

    fn open(
        &mut self,
        wanted: Option<&str>,
        make: &mut dyn FnMut(u32) -> Callback,
    ) -> Result<Playing, NoSound> {
        keep_library_quiet();
        let device = find(&cpal::default_host(), wanted)?;
        let failed = |error: cpal::Error| match (error.kind(), wanted) {
            (ErrorKind::DeviceNotAvailable | ErrorKind::HostUnavailable, None) => {
                NoSound::NoDevice(in_a_line(&error))
            }
            _ => NoSound::Refused { device: name(&device), reason: in_a_line(&error) },
        };
        let (format, config, is_held_to) = choose(&device).map_err(failed)?;
        let build = |config: StreamConfig, callback| build(&device, format, config, callback);
        let opened = build(config, make(config.sample_rate));
        let stream = match opened {
            // Some drivers offer a range of periods and refuse all but their own.
            Err(_) if is_held_to => {
                let config = StreamConfig { buffer_size: BufferSize::Default, ..config };
                build(config, make(config.sample_rate))
            }
            opened => opened,
        };
        let stream = stream.map_err(failed)?;
        stream.play().map_err(failed)?;
        Ok(Playing { stream: Box::new(stream), device: name(&device) })
    }
}

/// libasound writes to stderr what it thinks of its configuration and of missing cards; a player is
/// told in one line of ours.
fn keep_library_quiet() {
    #[cfg(target_os = "linux")]
    {
        // For this thread, and without effect if there is no memory for it.
        let _ = alsa::Output::local_error_handler();
    }
}

fn find(host: &Host, wanted: Option<&str>) -> Result<Device, NoSound> {
    let Some(wanted) = wanted else {
        let none = || NoSound::NoDevice("the system names none".into());
        return host.default_output_device().ok_or_else(none);
    };
    let not_there = || NoSound::NotThere { name: wanted.to_string() };
    let mut devices = host.output_devices().map_err(|_| not_there())?;
    devices.find(|device| name(device) == wanted || said(device) == wanted).ok_or_else(not_there)
}

/// What its driver calls it.
fn name(device: &Device) -> String {
    device.id().map_or_else(|_| "unnamed".to_string(), |id| id.id().to_string())
}

/// What it says of itself.
fn said(device: &Device) -> String {
    device.description().map(|description| description.name().to_string()).unwrap_or_default()
}

fn in_a_line(error: &cpal::Error) -> String {
    error.to_string().lines().collect::<Vec<_>>().join(" ")
}

/// Format and configuration, the best that there is, and whether it holds the device to a period.
fn choose(device: &Device) -> Result<(SampleFormat, StreamConfig, bool), cpal::Error> {
    let rank = |range: &SupportedStreamConfigRange| {
        let format = FORMATS.iter().position(|format| *format == range.sample_format())?;
        let channels = match range.channels() {
            2 => 0,
            1 => 2,
            0 => return None,
            _ => 1,
        };
        let rates = range.min_sample_rate()..=range.max_sample_rate();
        Some((channels, !rates.contains(&RATE_HZ), format))
    };
    let ranges = device.supported_output_configs()?;
    let best =
        ranges.filter_map(|range| Some((rank(&range)?, range))).min_by_key(|(rank, _)| *rank);
    let Some((_, range)) = best else {
        return Err(cpal::Error::new(ErrorKind::UnsupportedConfig));
    };
    let sample_rate = RATE_HZ.clamp(range.min_sample_rate(), range.max_sample_rate());
    let takes_period = match range.buffer_size() {
        SupportedBufferSize::Range { min, max } => (*min..=*max).contains(&PERIOD),
        SupportedBufferSize::Unknown => false,
    };
    let buffer_size = if takes_period { BufferSize::Fixed(PERIOD) } else { BufferSize::Default };
    let config = StreamConfig { channels: range.channels(), sample_rate, buffer_size };
    Ok((range.sample_format(), config, takes_period))
}

fn build(
    device: &Device,
    format: SampleFormat,
    config: StreamConfig,
    callback: Callback,
) -> Result<Stream, cpal::Error> {
    match format {
        SampleFormat::F32 => build_as::<f32>(device, config, callback),
        SampleFormat::I16 => build_as::<i16>(device, config, callback),
        SampleFormat::I32 => build_as::<i32>(device, config, callback),
        SampleFormat::U16 => build_as::<u16>(device, config, callback),
        SampleFormat::U32 => build_as::<u32>(device, config, callback),
        SampleFormat::F64 => build_as::<f64>(device, config, callback),
        SampleFormat::I8 => build_as::<i8>(device, config, callback),
        SampleFormat::U8 => build_as::<u8>(device, config, callback),
        _ => Err(cpal::Error::new(ErrorKind::UnsupportedConfig)),
    }
}

fn build_as<T: SizedSample + FromSample<f32>>(
    device: &Device,
    config: StreamConfig,
    mut callback: Callback,
) -> Result<Stream, cpal::Error> {
    let counters = callback.counters().clone();
    let channels = usize::from(config.channels);
    device.build_output_stream::<T, _, _>(
        config,
        move |out, _| callback.fill(out, channels, T::from_sample_),
        move |error| note(&counters, error.kind()),
        None,
    )
}

/// Said in the audio thread: it is counted and nothing else.
fn note(counters: &Arc<Counters>, kind: ErrorKind) {
    match kind {
        ErrorKind::Xrun => counters.note_xrun(),
        // It goes on.
        ErrorKind::RealtimeDenied | ErrorKind::DeviceChanged => {}
        ErrorKind::DeviceNotAvailable | ErrorKind::HostUnavailable => counters.lose(Loss::Gone),
        _ => counters.lose(Loss::Invalid),
    }
}
