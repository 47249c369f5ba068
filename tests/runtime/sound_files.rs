use crate::cli::{folder, lines, program, text};
use glam::Vec3;
use hapticbillard::sound::{Bank, Onset, SoundClass, Voice};
use hapticbillard_actors::sound::NoSound;
use hapticbillard_actors::sound::bank_files::read_folder;
use hound::{SampleFormat, WavSpec, WavWriter};
use std::f32::consts::TAU;
use std::path::Path;

const RATE_HZ: u32 = 48_000;

/// A tone of 1 kHz that dies away, from -1 to 1.
fn tone(rate_hz: u32) -> Vec<f32> {
    let at = |i: u32| i as f32 / rate_hz as f32;
    let tone = |t: f32| libm::sinf(TAU * 1_000.0 * t) * libm::expf(-20.0 * t);
    (0..rate_hz / 2).map(|i| 0.8 * tone(at(i))).collect()
}

fn spec(channels: u16, sample_rate: u32, bits_per_sample: u16) -> WavSpec {
    let sample_format = if bits_per_sample == 0 { SampleFormat::Float } else { SampleFormat::Int };
    let bits_per_sample = if bits_per_sample == 0 { 32 } else { bits_per_sample };
    WavSpec { channels, sample_rate, bits_per_sample, sample_format }
}

/// Writes a file; in every channel the same.
fn write(path: &Path, spec: WavSpec, samples: &[f32]) {
    let mut writer = WavWriter::create(path, spec).unwrap();
    let full = (1_i64 << (spec.bits_per_sample - 1)) as f32 - 1.0;
    for &sample in samples {
        for _ in 0..spec.channels {
            match spec.sample_format {
                SampleFormat::Float => writer.write_sample(sample).unwrap(),
                SampleFormat::Int => writer.write_sample((sample * full) as i32).unwrap(),
            }
        }
    }
    writer.finalize().unwrap();
}

/// What a bank plays for a cushion at 1 m/s.
fn cushion(bank: &Bank) -> Vec<f32> {
    let onset = Onset {
        time_s: 0.0,
        class: SoundClass::Cushion,
        speed_m_s: 1.0,
        position_m: Vec3::ZERO,
        axis: Vec3::ZERO,
        seed: 1,
    };
    let mut voice = Voice::begin(&onset, bank, RATE_HZ as f32);
    let mut samples = vec![0.0; voice.remaining() as usize];
    voice.fill(bank, &mut samples);
    samples
}

/// Periods a second in the first 0.1 s.
fn frequency_hz(samples: &[f32]) -> f32 {
    let piece = &samples[..RATE_HZ as usize / 10];
    10.0 * piece.windows(2).filter(|two| two[0] < 0.0 && 0.0 <= two[1]).count() as f32
}

#[test]
fn recordings_of_any_format_and_rate_are_heard_at_their_pitch() {
    let folder = folder("sound_formats");
    let file = folder.join("cushion_v1_1.wav");
    for bits in [8, 16, 24, 32, 0] {
        for channels in [1, 2] {
            for rate_hz in [22_050, 44_100, 48_000, 96_000] {
                let what = format!("{bits} bits, {channels} channels, {rate_hz} Hz");
                write(&file, spec(channels, rate_hz, bits), &tone(rate_hz));
                let (bank, refused) = read_folder(&folder, RATE_HZ).unwrap();
                assert!(refused.is_empty(), "{what}: {}", refused[0]);
                assert_eq!(bank.count(SoundClass::Cushion), 1, "{what}");
                let heard = cushion(&bank);
                assert!((frequency_hz(&heard) - 1_000.0).abs() <= 10.0, "{what}");
                // Half a second less what is softer than can be heard.
                let seconds = heard.len() as f32 / RATE_HZ as f32;
                assert!((0.2..0.51).contains(&seconds), "{what}: {seconds} s");
            }
        }
    }
}

/// A tone that is above half the new rate must vanish, not fold down.
#[test]
fn resampling_does_not_alias() {
    let folder = folder("sound_alias");
    let high = |i: u32| 0.5 * libm::sinf(TAU * 15_000.0 * i as f32 / 44_100.0);
    let low = |i: u32| 0.5 * libm::sinf(TAU * 500.0 * i as f32 / 44_100.0);
    let samples: Vec<f32> = (0..22_050).map(|i| high(i) + low(i)).collect();
    write(&folder.join("cushion_v1_1.wav"), spec(1, 44_100, 0), &samples);
    let (bank, refused) = read_folder(&folder, 16_000).unwrap();
    assert!(refused.is_empty());
    let heard = cushion(&bank);
    // A pure tone: x[n+1] + x[n-1] is in proportion to x[n].
    let turn = 2.0 * libm::cosf(TAU * 500.0 / 16_000.0);
    let middle = &heard[1_000..6_000];
    let rest: f32 = middle.windows(3).map(|x| (x[2] + x[0] - turn * x[1]).powi(2)).sum();
    let all: f32 = middle.windows(3).map(|x| x[1] * x[1]).sum();
    assert!(rest < 1e-5 * all, "{} of the energy is not the tone", rest / all);
}

#[test]
fn bad_files_are_refused_in_a_sentence_and_good_ones_are_heard() {
    let folder = folder("sound_bad");
    let good = tone(RATE_HZ);
    write(&folder.join("cushion_v1_1.wav"), spec(1, RATE_HZ, 16), &good);
    write(&folder.join("cushion_v1_2.wav"), spec(3, RATE_HZ, 16), &good);
    write(&folder.join("cushion_v1_3.wav"), spec(1, 4_000, 16), &good);
    write(&folder.join("cushion_v1_4.wav"), spec(1, RATE_HZ, 16), &[0.0; 1_000]);
    write(&folder.join("cushion_v1_5.wav"), spec(1, 44_100, 0), &[0.1, f32::NAN, 0.1]);
    write(&folder.join("cushion_v1_51.wav"), spec(1, 44_100, 0), &[0.1, -1e20, 0.1]);
    write(&folder.join("cushion_v1_6.wav"), spec(1, 8_000, 8), &vec![0.1; 81_000]);
    write(&folder.join("gong_v1_1.wav"), spec(1, RATE_HZ, 16), &good);
    write(&folder.join("cushion_fast_1.wav"), spec(1, RATE_HZ, 16), &good);
    std::fs::write(folder.join("cushion_v1_7.wav"), "no wave at all").unwrap();
    let whole = std::fs::read(folder.join("cushion_v1_1.wav")).unwrap();
    std::fs::write(folder.join("cushion_v1_8.wav"), &whole[..30]).unwrap();
    std::fs::create_dir(folder.join("cushion_v1_9.wav")).unwrap();
    std::fs::write(folder.join("CREDITS.md"), "Recorded at home.").unwrap();

    let (bank, refused) = read_folder(&folder, RATE_HZ).unwrap();
    assert_eq!(bank.count(SoundClass::Cushion), 1);
    let said: Vec<String> = refused.iter().map(ToString::to_string).collect();
    let expected = [
        ("cushion_fast_1.wav", "the name is not CLASS_vSPEED_VARIANT.wav"),
        ("cushion_v1_2.wav", "it has 3 channels; one or two are read"),
        ("cushion_v1_3.wav", "it has 4000 samples a second; 8000 to 384000 are read"),
        ("cushion_v1_4.wav", "nothing can be heard in it"),
        ("cushion_v1_5.wav", "sample 1 is no finite number"),
        ("cushion_v1_51.wav", "sample 1 is -1e20 times full scale"),
        ("cushion_v1_6.wav", "it lasts longer than 10 s"),
        ("cushion_v1_7.wav", "it is no WAV file that can be read"),
        ("cushion_v1_8.wav", "it is no WAV file that can be read"),
        ("cushion_v1_9.wav", "is not a plain file"),
        ("gong_v1_1.wav", "\"gong\" is no class of sounds; there are ball_click"),
    ];
    assert_eq!(said.len(), expected.len(), "{said:#?}");
    for (sentence, (file, reason)) in said.iter().zip(expected) {
        let path = folder.join(file).display().to_string();
        assert!(sentence.starts_with(&format!("{path} is not used: ")), "{sentence}");
        assert!(sentence.contains(reason), "{sentence}");
    }
}

#[test]
fn a_folder_that_was_named_and_is_not_there_is_an_error() {
    let folder = folder("sound_nowhere");
    let nowhere = folder.join("soundz");
    let error = read_folder(&nowhere, RATE_HZ).err().unwrap();
    assert!(matches!(&error, NoSound::NoRecordings { folder, .. } if *folder == nowhere));

    let scene = folder.join("scene.toml");
    std::fs::write(&scene, "[scene]\nname = \"x\"\n[physics]\n[sound]\nrecordings = \"soundz\"\n")
        .unwrap();
    let (scene, out) = (scene.to_str().unwrap(), folder.join("out.wav"));
    let render = ["sound", "render", "--seconds", "0.1", "--out", out.to_str().unwrap()];
    for what in [
        &["--scene", scene][..],
        &["--scene", "break_shot", "--recordings", nowhere.to_str().unwrap()],
    ] {
        let output = program(&[&render[..], what].concat());
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let said = text(&output.stderr);
        assert!(said.starts_with("error: ") && said.contains("soundz cannot be listed"), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(!out.exists());
    }
    // Another folder goes before the one that is missing.
    let output = program(
        &[&render[..], &["--scene", scene, "--recordings", folder.to_str().unwrap()]].concat(),
    );
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn every_class_is_written_and_read_back() {
    let folder = folder("sound_bank");
    let out = folder.to_str().unwrap();
    let written = program(&["sound", "bank", "--out", out, "--variants", "1", "--json"]);
    assert!(written.status.success() && written.stderr.is_empty(), "{written:?}");
    let rows = lines(&written.stdout);
    let (summary, rows) = rows.split_last().unwrap();
    assert_eq!(summary["summary"]["files"], rows.len());
    for row in rows {
        let file = folder.join(row["file"].as_str().unwrap());
        let reader = hound::WavReader::open(&file).unwrap();
        let seconds = f64::from(reader.duration()) / f64::from(reader.spec().sample_rate);
        assert!((seconds - row["length_s"].as_f64().unwrap()).abs() < 1e-4, "{row}");
        let level = row["peak_db_spl"].as_f64().unwrap();
        assert!((25.0..130.0).contains(&level), "{row}");
    }
    // Nothing else is left behind, no drafts either.
    let names: Vec<_> = std::fs::read_dir(&folder).unwrap().flatten().collect();
    let clips = rows.iter().filter(|row| !row["file"].as_str().unwrap().contains('/')).count();
    assert_eq!(names.len(), clips + 1);

    let (bank, refused) = read_folder(&folder, RATE_HZ).unwrap();
    assert!(refused.is_empty(), "{}", refused[0]);
    for class in SoundClass::ALL {
        let count = rows.iter().filter(|row| row["class"] == class.name()).count();
        assert!(count > 0 && bank.count(class) == count, "{class:?}: {}", bank.count(class));
    }

    let table = program(&["sound", "bank", "--out", out, "--variants", "1", "--rate", "44100"]);
    let table = text(&table.stdout);
    assert!(table.contains("ball_click_v2_1.wav"), "{table}");
    assert_eq!(table.lines().count(), rows.len() + 2);
}
