//! The system's outputs, by cpal.

use super::backend::{Backend, NoSound, Output, Playing};
use super::callback::{Callback, Counters, Loss};
use cpal::traits::{DeviceTrait, HostTrait, StreamTrait};
use cpal::{
    BufferSize, Device, ErrorKind, FromSample, Host, I24, SampleFormat, SizedSample, Stream,
    StreamConfig, SupportedBufferSize, SupportedStreamConfigRange, U24,
};
use hapticbillard::sound::parameters::RATES_HZ;
use std::sync::Arc;

/// The rate that is asked for [Hz]; where a device has another one the mixer takes that.
const RATE_HZ: u32 = 48_000;
/// Frames a period that are asked for: 11 ms.
const PERIOD: u32 = 512;
/// Formats, the best first; signed before unsigned where they are as fine.
const FORMATS: [SampleFormat; 10] = [
    SampleFormat::F32,
    SampleFormat::F64,
    SampleFormat::I32,
    SampleFormat::U32,
    SampleFormat::I24,
    SampleFormat::U24,
    SampleFormat::I16,
    SampleFormat::U16,
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
/// told in one line of ours. This holds for the thread that calls it, which looks for devices and
/// opens them; the library's own thread that plays may still write.
fn keep_library_quiet() {
    #[cfg(target_os = "linux")]
    {
        // Without effect if there is no memory for it.
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
    let Some((range, sample_rate)) = best(device.supported_output_configs()?) else {
        return Err(cpal::Error::new(ErrorKind::UnsupportedConfig));
    };
    let takes_period = match range.buffer_size() {
        SupportedBufferSize::Range { min, max } => (*min..=*max).contains(&PERIOD),
        SupportedBufferSize::Unknown => false,
    };
    let buffer_size = if takes_period { BufferSize::Fixed(PERIOD) } else { BufferSize::Default };
    let config = StreamConfig { channels: range.channels(), sample_rate, buffer_size };
    Ok((range.sample_format(), config, takes_period))
}

/// The best of what a device offers, and its rate [Hz] nearest to the one that is asked for; none
/// if nothing can be mixed for.
fn best(
    ranges: impl Iterator<Item = SupportedStreamConfigRange>,
) -> Option<(SupportedStreamConfigRange, u32)> {
    let ranked = ranges.filter_map(|range| Some((rank(&range)?, range)));
    let (_, range) = ranked.min_by_key(|(rank, _)| *rank)?;
    let sample_rate = nearest_rate(&range)?;
    Some((range, sample_rate))
}

/// The lower the better: by channels, then by format, then by the nearest rate. None if the format,
/// the channels or all its rates are beyond the mixer.
fn rank(range: &SupportedStreamConfigRange) -> Option<(u8, usize, u32)> {
    let format = FORMATS.iter().position(|format| *format == range.sample_format())?;
    let channels = match range.channels() {
        2 => 0,
        1 => 2,
        0 => return None,
        _ => 1,
    };
    Some((channels, format, nearest_rate(range)?.abs_diff(RATE_HZ)))
}

/// The rate nearest to the one that is asked for, among those that can be mixed at [Hz].
fn nearest_rate(range: &SupportedStreamConfigRange) -> Option<u32> {
    let [low, high] = RATES_HZ.map(|rate_hz| rate_hz as u32);
    let (low, high) = (low.max(range.min_sample_rate()), high.min(range.max_sample_rate()));
    (low <= high).then(|| RATE_HZ.clamp(low, high))
}

fn build(
    device: &Device,
    format: SampleFormat,
    config: StreamConfig,
    callback: Callback,
) -> Result<Stream, cpal::Error> {
    match format {
        SampleFormat::I24 => build_as::<I24>(device, config, callback),
        SampleFormat::U24 => build_as::<U24>(device, config, callback),
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
        ErrorKind::DeviceChanged => {}
        ErrorKind::DeviceNotAvailable | ErrorKind::HostUnavailable => counters.lose(Loss::Gone),
        _ => counters.lose(Loss::Invalid),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(
        channels: u16,
        rates_hz: [u32; 2],
        format: SampleFormat,
    ) -> SupportedStreamConfigRange {
        let [low, high] = rates_hz;
        let period = SupportedBufferSize::Unknown;
        SupportedStreamConfigRange::new(channels, low, high, period, format)
    }

    #[test]
    fn two_channels_go_before_the_format_and_the_format_before_the_rate() {
        use SampleFormat::{F32, I16, I24, U8};
        let (cd, studio, any) = ([44_100; 2], [48_000; 2], [8_000, 192_000]);
        // The best stands first; whichever order they come in it is taken.
        for (better, worse, rate_hz) in [
            (range(2, cd, F32), range(2, studio, U8), 44_100),
            (range(2, cd, I16), range(6, studio, F32), 44_100),
            (range(6, cd, I16), range(1, studio, F32), 44_100),
            (range(2, any, I24), range(2, any, I16), 48_000),
            (range(2, studio, I16), range(2, cd, I16), 48_000),
            (range(2, [88_200, 192_000], I16), range(2, [8_000; 2], U8), 88_200),
            (range(2, [96_000; 2], I16), range(2, [384_000; 2], F32), 96_000),
            (range(2, any, I16), range(2, any, SampleFormat::DsdU8), 48_000),
            (range(1, [4_000, 11_025], U8), range(0, any, F32), 11_025),
            (range(2, [96_000, 768_000], F32), range(2, [4_000; 2], F32), 96_000),
        ] {
            for offered in [[better, worse], [worse, better]] {
                assert_eq!(best(offered.into_iter()), Some((better, rate_hz)));
            }
        }
    }

    #[test]
    fn what_cannot_be_mixed_for_is_not_opened() {
        let beyond =
            [range(2, [384_000; 2], SampleFormat::F32), range(2, [4_000; 2], SampleFormat::F32)];
        assert_eq!(best(beyond.into_iter()), None);
        assert_eq!(best([].into_iter()), None);
    }
}
